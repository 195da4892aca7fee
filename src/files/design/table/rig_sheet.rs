//! Hexapod parameters in motion-simulator programs: four side lengths, with crank and rod or a middle length.
//!
//! The joints of each body stand in three pairs on a circle. The sides of the hexagon of the joints alternate between
//! `short` (inside a pair) and `long` (from pair to pair). Neighbouring sides enclose 120 degrees, so every second
//! corner is at the distance `sqrt(3) R` from the next one, and
//!
//! ```text
//! R^2 = (long^2 + short^2 + long short) / 3,      spread = 2 asin(short / (2 R)).
//! ```
//!
//! `L1` and `L2` are the sides of the platform, the long one first, in every known program. `L3` and `L4` are those of
//! the base; programs disagree on which is the long one ([`SheetDialect`]).

use std::f64::consts::PI;
use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};
use thiserror::Error;

use super::text::decode;
use crate::design::{DesignModel, HexapodSizes, InvalidOutline};
use machine::rotary::{Elbow, RotaryPlatform};

num::words! {
    /// The program of a sheet; it determines which of `L3` and `L4` is the long side of the base.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum SheetDialect as name, FromStr("dialect") {
        /// `Motion4Sim`, whose parameters are those of `FlyPT` Mover: `L3` is the short side of the base, `L4` the long
        /// one.
        Motion4Sim = "motion4sim",
        /// DR Sim Manager of Departed Reality: `L3` is the long side of the base, `L4` the short one.
        DrSimManager = "dr-sim-manager",
    }
}

impl SheetDialect {
    fn other(self) -> Self {
        match self {
            Self::Motion4Sim => Self::DrSimManager,
            Self::DrSimManager => Self::Motion4Sim,
        }
    }

    /// `[L3, L4]` from the long and the short side of the base, and the reverse.
    fn ordered(self, [first, second]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Motion4Sim => [second, first],
            Self::DrSimManager => [first, second],
        }
    }

    /// The name of the long side.
    fn long_side(self) -> &'static str {
        match self {
            Self::Motion4Sim => "L4",
            Self::DrSimManager => "L3",
        }
    }
}

/// The drives of the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SheetLegs {
    /// Legs of variable length: the middle length, and the travel to either side.
    Linear {
        /// `middle`.
        middle: f64,
        /// `range`.
        range: f64,
    },
    /// Rods on cranks.
    Cranks {
        /// `crank`: from the axis to the tip.
        crank: f64,
        /// `rod`.
        rod: f64,
        /// `middle_angle`: of the cranks above the plane of the base at home, degrees.
        middle_deg: f64,
        /// `crank_angle_1` to `crank_angle_6`: directions of the axes in the plane of the base, degrees. They count
        /// from x, counterclockwise seen from above. At the angle 0 a crank points to the left of its axis.
        axes_deg: [f64; 6],
    },
}

/// The parameters of a hexapod.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigSheet {
    /// Long and short side of the platform.
    pub platform: [f64; 2],
    /// Long and short side of the base.
    pub base: [f64; 2],
    /// Drives.
    pub legs: SheetLegs,
}

/// Reasons why a sheet or a design cannot be converted.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum InvalidRigSheet {
    /// It is not readable as text.
    #[error("{0}")]
    Text(String),
    /// A line without a name and a number.
    #[error("line {line}: `{text}` is not `name = number`")]
    Line {
        /// From 1.
        line: usize,
        /// The line.
        text: String,
    },
    /// An unknown name.
    #[error("line {line}: `{name}` is no parameter of a sheet")]
    Unknown {
        /// From 1.
        line: usize,
        /// The name.
        name: String,
    },
    /// A parameter that is given twice.
    #[error("line {line}: `{name}` is given twice")]
    Twice {
        /// From 1.
        line: usize,
        /// The name.
        name: String,
    },
    /// A parameter that is missing.
    #[error("`{0}` is missing")]
    Missing(String),
    /// A parameter that is not a positive number.
    #[error("`{name}` is {value}, not a positive number")]
    NotPositive {
        /// The name.
        name: String,
        /// The value.
        value: f64,
    },
    /// `L1` is the long side of the platform in every dialect.
    #[error("L1 = {long} is shorter than L2 = {short}: L1 is the long side of the platform")]
    Platform {
        /// `L1`.
        long: f64,
        /// `L2`.
        short: f64,
    },
    /// The sides of the base are those of another dialect.
    #[error("L3 = {l3} and L4 = {l4}: in the dialect {} {} is the long side of the base", dialect.name(), dialect.long_side())]
    Dialect {
        /// `L3`.
        l3: f64,
        /// `L4`.
        l4: f64,
        /// The named dialect.
        dialect: SheetDialect,
    },
    /// Legs or rods too short to reach from the base to the platform.
    #[error("leg {leg} does not reach the platform: {what} is too short by {by}")]
    OutOfReach {
        /// From 1.
        leg: usize,
        /// The part that is too short.
        what: &'static str,
        /// The missing length.
        by: f64,
    },
    /// Cranks that lift the platform joints to different heights.
    #[error(
        "with these angles of the axes the cranks hold the joints of the platform at heights from {0} to {1}: no platform is level on them at the middle angle"
    )]
    Uneven(f64, f64),
    /// A design whose joints are not in pairs on circles.
    #[error("{0}")]
    NotSymmetric(String),
}

impl InvalidRigSheet {
    /// The remedy.
    pub fn help(&self) -> String {
        match self {
            Self::Dialect { dialect, .. } => format!(
                "if the sheet is one of {0}, name that: --dialect {0}; {1} is the long side there",
                dialect.other().name(),
                dialect.other().long_side()
            ),
            Self::NotSymmetric(_) => "a sheet holds six joints in three pairs on a circle on each body, level above each other, with equal legs or cranks".into(),
            _ => "a sheet has the lines L1, L2, L3, L4 and either crank, rod, middle_angle and crank_angle_1 to crank_angle_6, or middle and range, each as `name = number`".into(),
        }
    }
}

/// Names in the order of writing.
const SIDES: [&str; 4] = ["L1", "L2", "L3", "L4"];
const LINEAR: [&str; 2] = ["middle", "range"];
const CRANKS: [&str; 9] = [
    "crank",
    "rod",
    "middle_angle",
    "crank_angle_1",
    "crank_angle_2",
    "crank_angle_3",
    "crank_angle_4",
    "crank_angle_5",
    "crank_angle_6",
];

/// Greatest deviation of heights and joints over the size of the hexapod: sheets have rounded numbers.
const ROUNDED: f64 = 1e-3;

/// Radius and spread in radians of the circle of joints with these sides.
fn circle([long, short]: [f64; 2]) -> (f64, f64) {
    let radius = ((long * long + short * short + long * short) / 3.0).sqrt();
    (radius, 2.0 * (0.5 * short / radius).clamp(-1.0, 1.0).asin())
}

/// Joints in leg order as in [`HexapodSizes`]: the pairs of the base around 0, 120 and 240 degrees, those of the
/// platform between them.
fn joints((radius, spread): (f64, f64), is_platform: bool) -> [Point3<f64>; 6] {
    std::array::from_fn(|i| {
        let side = if i % 2 == 0 { -1.0 } else { 1.0 };
        let half = if is_platform { PI / 3.0 - 0.5 * spread } else { 0.5 * spread };
        let angle = (i / 2) as f64 * 2.0 * PI / 3.0 + side * half;
        Point3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    })
}

impl RigSheet {
    /// Reads a sheet: lines `name = number`, in any order, `:` or `,` or a tab in place of `=`, comments after `#`.
    ///
    /// # Errors
    /// [`InvalidRigSheet`].
    pub fn read(bytes: &[u8], dialect: SheetDialect) -> Result<Self, InvalidRigSheet> {
        let text = decode(bytes).map_err(InvalidRigSheet::Text)?.text;
        let known = || SIDES.iter().chain(&LINEAR).chain(&CRANKS);
        let mut found: Vec<(&str, f64)> = Vec::new();
        for (k, whole) in text.lines().enumerate() {
            let content = whole.split('#').next().unwrap_or_default().trim();
            if content.is_empty() {
                continue;
            }
            let line = k + 1;
            let pair = content.split_once(['=', ':', ',', '\t', ';']);
            let number =
                pair.and_then(|(_, value)| value.trim().parse::<f64>().ok()).filter(|x| x.is_finite());
            let (Some((name, _)), Some(value)) = (pair, number) else {
                return Err(InvalidRigSheet::Line { line, text: content.into() });
            };
            let name = name.trim();
            let Some(own) = known().find(|n| n.eq_ignore_ascii_case(name)) else {
                return Err(InvalidRigSheet::Unknown { line, name: name.into() });
            };
            if found.iter().any(|(n, _)| n == own) {
                return Err(InvalidRigSheet::Twice { line, name: (*own).into() });
            }
            found.push((own, value));
        }
        let get = |name: &str| {
            let value = found.iter().find(|(n, _)| *n == name).map(|(_, x)| *x);
            value.ok_or_else(|| InvalidRigSheet::Missing(name.into()))
        };
        let positive = |name: &str| {
            let value = get(name)?;
            if value > 0.0 {
                Ok(value)
            } else {
                Err(InvalidRigSheet::NotPositive { name: name.into(), value })
            }
        };
        let [l1, l2, l3, l4] = [positive("L1")?, positive("L2")?, positive("L3")?, positive("L4")?];
        if l1 < l2 {
            return Err(InvalidRigSheet::Platform { long: l1, short: l2 });
        }
        let base = dialect.ordered([l3, l4]);
        if base[0] < base[1] {
            return Err(InvalidRigSheet::Dialect { l3, l4, dialect });
        }
        let legs = if found.iter().any(|(n, _)| LINEAR.contains(n)) {
            if let Some((name, _)) = found.iter().find(|(n, _)| CRANKS.contains(n)) {
                let message = format!(
                    "`{name}` is about rods on cranks, `middle` and `range` about legs of variable length: give one kind"
                );
                return Err(InvalidRigSheet::NotSymmetric(message));
            }
            SheetLegs::Linear { middle: positive("middle")?, range: positive("range")? }
        } else {
            let mut axes_deg = [0.0; 6];
            for (k, angle) in axes_deg.iter_mut().enumerate() {
                *angle = get(CRANKS[3 + k])?;
            }
            SheetLegs::Cranks {
                crank: positive("crank")?,
                rod: positive("rod")?,
                middle_deg: get("middle_angle")?,
                axes_deg,
            }
        };
        Ok(Self { platform: [l1, l2], base, legs })
    }

    /// The sheet in the form of a dialect.
    pub fn text(&self, dialect: SheetDialect, design: &DesignModel) -> String {
        let mut out = format!(
            "# {}: parameters for {}, lengths in {}, angles in degrees\n# L1, L2: long and short side of the platform; {} is the long side of the base\n",
            design.name.replace('\n', " "),
            dialect.name(),
            design.units,
            dialect.long_side()
        );
        let [l3, l4] = dialect.ordered(self.base);
        let mut line = |name: &str, x: f64| {
            let _ = writeln!(out, "{name} = {x}");
        };
        for (name, x) in SIDES.into_iter().zip([self.platform[0], self.platform[1], l3, l4]) {
            line(name, x);
        }
        match self.legs {
            SheetLegs::Linear { middle, range } => {
                line("middle", middle);
                line("range", range);
            }
            SheetLegs::Cranks { crank, rod, middle_deg, axes_deg } => {
                for (name, x) in CRANKS.into_iter().zip([crank, rod, middle_deg].into_iter().chain(axes_deg))
                {
                    line(name, x);
                }
            }
        }
        out
    }

    /// Height of the platform at home: legs at mid-stroke, or cranks at their middle angle.
    fn height(&self) -> Result<f64, InvalidRigSheet> {
        let [base, platform] = [joints(circle(self.base), false), joints(circle(self.platform), true)];
        let size = circle(self.base).0 + circle(self.platform).0;
        let mut heights = [0.0; 6];
        for (i, height) in heights.iter_mut().enumerate() {
            let d = platform[i] - base[i];
            let (tip, length, what) = match self.legs {
                SheetLegs::Linear { middle, .. } => (Vector3::zeros(), middle, "`middle`"),
                SheetLegs::Cranks { crank, rod, middle_deg, axes_deg } => {
                    let [axis, up] = [axes_deg[i].to_radians(), middle_deg.to_radians()];
                    let tip = Vector3::new(-axis.sin() * up.cos(), axis.cos() * up.cos(), up.sin()) * crank;
                    (tip, rod, "`rod`")
                }
            };
            let across = (d - tip).xy().norm();
            if !(across < length) {
                return Err(InvalidRigSheet::OutOfReach { leg: i + 1, what, by: across - length });
            }
            *height = tip.z + (length * length - across * across).sqrt();
        }
        let [least, most] =
            [f64::min, f64::max].map(|f: fn(f64, f64) -> f64| heights.into_iter().fold(heights[0], f));
        if most - least > ROUNDED * size {
            return Err(InvalidRigSheet::Uneven(least, most));
        }
        Ok(heights.iter().sum::<f64>() / 6.0)
    }

    /// The design file in TOML, without leg lengths.
    ///
    /// # Errors
    /// [`InvalidRigSheet`]: legs and rods that do not hold the platform.
    pub fn to_toml(self, name: &str, units: &str) -> Result<String, InvalidRigSheet> {
        let height = self.height()?;
        let [(rb, sb), (rp, sp)] = [circle(self.base), circle(self.platform)];
        let sizes = HexapodSizes { radius: [rb, rp], spread_deg: [sb.to_degrees(), sp.to_degrees()], height };
        let not_symmetric = |why: InvalidOutline| InvalidRigSheet::NotSymmetric(why.to_string());
        match self.legs {
            SheetLegs::Linear { middle, range } => {
                sizes.check().map_err(not_symmetric)?;
                let lengths =
                    format!("\n[hardware]\nleg_length = [{:?}, {:?}]\n", middle - range, middle + range);
                Ok(sizes.to_toml(name, units) + &lengths)
            }
            SheetLegs::Cranks { crank, rod, middle_deg, axes_deg } => {
                sizes.check_rotary().map_err(not_symmetric)?;
                let mut out = sizes.to_toml_of_rotary(name, units);
                let _ = write!(out, "\n[cranks]\nlength = {crank:?}\nrod_length = {rod:?}\n");
                let [base, platform] = [joints((rb, sb), false), joints((rp, sp), true)];
                for (i, degrees) in axes_deg.into_iter().enumerate() {
                    let (sin, cos) = degrees.to_radians().sin_cos();
                    // angle of the tip nearest to the platform joint: cranks above it are on the side of the greater
                    // angle
                    let d = platform[i] - base[i] + Vector3::z() * height;
                    let nearest = d.z.atan2(d.y * cos - d.x * sin);
                    let away = (middle_deg.to_radians() - nearest).sin();
                    let elbow = if away >= 0.0 { Elbow::Plus } else { Elbow::Minus };
                    let _ = write!(
                        out,
                        "\n[cranks.A{}]\naxis = [{cos:?}, {sin:?}, 0]\nzero = [{:?}, {cos:?}, 0]\nelbow = \"{}\"\n",
                        i + 1,
                        -sin,
                        elbow.name()
                    );
                }
                Ok(out)
            }
        }
    }

    /// The parameters of a design.
    ///
    /// # Errors
    /// [`InvalidRigSheet::NotSymmetric`]: a design that a sheet does not hold.
    pub fn of(design: &DesignModel, cranks: Option<&RotaryPlatform>) -> Result<Self, InvalidRigSheet> {
        let no = |what: &str| InvalidRigSheet::NotSymmetric(format!("{}: {what}", design.name));
        let m = design.manipulator();
        let home = design.home_or_default();
        let legs = m.legs();
        let size = m.size();
        let near = |a: f64, b: f64| (a - b).abs() <= ROUNDED * 1e-3 * size;
        let mut sides = [[0.0; 2]; 2];
        for (k, at) in
            [legs.map(|l| l.base), legs.map(|l| home.transform(&l.platform))].into_iter().enumerate()
        {
            let body = ["base", "platform"][k];
            // legs in order around the axis: alternately sides inside a pair and from pair to pair
            let side = |i: usize| (at[(i + 1) % 6] - at[i]).norm();
            let flat = (0..6).all(|i| near(at[i].z, at[0].z));
            let turned = (0..6).all(|i| {
                near(side(i), side(i % 2)) && near(at[i].coords.xy().norm(), at[0].coords.xy().norm())
            });
            if !flat || !turned {
                return Err(no(&format!(
                    "the joints of the {body} are not six in three pairs on a level circle about z, in the order of the legs"
                )));
            }
            sides[k] = [side(0).max(side(1)), side(0).min(side(1))];
            let is_short = side(0) <= side(1);
            let first = at[0].y.atan2(at[0].x) + at[1].y.atan2(at[1].x);
            // pairs of the base about x, those of the platform between them
            let placed = if k == 0 {
                is_short && near(first * size, 0.0)
            } else {
                !is_short && near(first * size, 0.0)
            };
            if !placed {
                return Err(no(&format!(
                    "the pairs of the {body} are not where a sheet has them: those of the base about 0, 120 and 240 degrees with legs 1 and 2 from the first, those of the platform between them"
                )));
            }
        }
        let [base, platform] = sides;
        let legs = match cranks {
            None => {
                let (least, greatest) = design
                    .hardware
                    .leg_length
                    .map(|l| l.range())
                    .ok_or_else(|| no("`leg_length` is missing, which gives `middle` and `range`"))?;
                SheetLegs::Linear { middle: 0.5 * (least + greatest), range: 0.5 * (greatest - least) }
            }
            Some(rotary) => {
                let all = rotary.legs();
                let angles = rotary
                    .ik(&home)
                    .map_err(|why| no(&format!("the cranks do not hold the home pose: {why}")))?;
                let mut axes_deg = [0.0; 6];
                for (i, leg) in all.iter().enumerate() {
                    let [zero, up] = rotary.directions()[i];
                    let level =
                        near(leg.crank.axis.z * size, 0.0) && near((up - Vector3::z()).norm() * size, 0.0);
                    let equal = near(leg.crank.length, all[0].crank.length) && near(leg.rod, all[0].rod);
                    if !level || !equal || !near((angles[i] - angles[0]) * size, 0.0) {
                        return Err(no(
                            "a sheet has equal cranks and rods, level axes, angles from the plane of the base upwards, and one middle angle for all at home",
                        ));
                    }
                    axes_deg[i] = (-zero.x).atan2(zero.y).to_degrees();
                }
                SheetLegs::Cranks {
                    crank: all[0].crank.length,
                    rod: all[0].rod,
                    middle_deg: angles[0].to_degrees(),
                    axes_deg,
                }
            }
        };
        Ok(Self { platform, base, legs })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, parse, parse_with_cranks};

    const LINEAR_SHEET: &str = "# a rig\nL1 = 900\nL2: 150\nL3, 200\nL4 = 1100\nmiddle = 900\nrange = 150\n";

    #[test]
    fn a_sheet_gives_the_sides_of_the_design_and_comes_back_in_either_dialect() {
        let sheet = RigSheet::read(LINEAR_SHEET.as_bytes(), SheetDialect::Motion4Sim).unwrap();
        assert_eq!((sheet.platform, sheet.base), ([900.0, 150.0], [1100.0, 200.0]));
        let toml = sheet.to_toml("rig", "mm").unwrap();
        let (design, _) = parse(&toml, Format::Toml).unwrap();
        let m = design.manipulator();
        let side = |list: &[Point3<f64>], i: usize| (list[(i + 1) % 6] - list[i]).norm();
        let legs = m.legs();
        let (base, platform) = (legs.map(|l| l.base), legs.map(|l| l.platform));
        for i in 0..6 {
            let (long, short) = if i % 2 == 0 { (200.0, 900.0) } else { (1100.0, 150.0) };
            assert!((side(&base, i) - long).abs() < 1e-9, "{toml}");
            assert!((side(&platform, i) - short).abs() < 1e-9, "{toml}");
        }
        for length in design.home_or_default().lengths(m).unwrap().get() {
            assert!((length - 900.0).abs() < 1e-9);
        }
        assert_eq!(design.hardware.leg_length.unwrap().range(), (750.0, 1050.0));
        let back = RigSheet::of(&design, None).unwrap();
        for dialect in SheetDialect::ALL {
            let text = back.text(dialect, &design);
            let again = RigSheet::read(text.as_bytes(), dialect).unwrap();
            for (a, b) in
                again.base.iter().chain(&again.platform).zip(sheet.base.iter().chain(&sheet.platform))
            {
                assert!((a - b).abs() < 1e-9, "{text}");
            }
            // the other dialect refuses it and names the right one
            let why = RigSheet::read(text.as_bytes(), dialect.other()).unwrap_err();
            assert!(
                matches!(why, InvalidRigSheet::Dialect { .. }) && why.help().contains(dialect.name()),
                "{why}"
            );
        }
    }

    #[test]
    fn a_sheet_of_cranks_holds_the_platform_at_the_middle_angle() {
        // radial axes, the two of a pair reversed: cranks point away from each other
        let mut text = String::from(
            "L1 = 700\nL2 = 120\nL3 = 900\nL4 = 250\ncrank = 90\nrod = 600\nmiddle_angle = 10\n",
        );
        for (i, angle) in [0, 180, 120, 300, 240, 60].into_iter().enumerate() {
            let _ = writeln!(text, "crank_angle_{} = {}", i + 1, angle + 180);
        }
        let sheet = RigSheet::read(text.as_bytes(), SheetDialect::DrSimManager).unwrap();
        let toml = sheet.to_toml("rig", "mm").unwrap();
        let (design, _) = parse_with_cranks(&toml, Format::Toml).unwrap_or_else(|e| panic!("{e:?}\n{toml}"));
        let rotary = design.rotary().unwrap().unwrap();
        let angles = rotary.ik(&design.home_or_default()).unwrap();
        for angle in angles {
            assert!((angle.to_degrees() - 10.0).abs() < 1e-9, "{angles:?}\n{toml}");
        }
        let back = RigSheet::of(&design, Some(&rotary)).unwrap();
        let (SheetLegs::Cranks { axes_deg: a, middle_deg, .. }, SheetLegs::Cranks { axes_deg: b, .. }) =
            (back.legs, sheet.legs)
        else {
            panic!("{back:?}")
        };
        assert!((middle_deg - 10.0).abs() < 1e-9);
        for (x, y) in a.iter().zip(b) {
            assert!(((x - y).to_radians().cos() - 1.0).abs() < 1e-12, "{x} {y}");
        }
        // axes with equal sense of rotation cannot hold a level platform
        let uneven = text.replace("crank_angle_2 = 360", "crank_angle_2 = 180");
        let why = RigSheet::read(uneven.as_bytes(), SheetDialect::DrSimManager)
            .unwrap()
            .to_toml("rig", "mm")
            .unwrap_err();
        assert!(matches!(why, InvalidRigSheet::Uneven(..)), "{why}");
    }

    #[test]
    fn what_is_no_sheet_is_refused_with_its_place() {
        let why =
            |text: &str| RigSheet::read(text.as_bytes(), SheetDialect::Motion4Sim).unwrap_err().to_string();
        assert_eq!(why("L1 = 900\nL2\n"), "line 2: `L2` is not `name = number`");
        assert_eq!(why("L1 = 900\nL9 = 3\n"), "line 2: `L9` is no parameter of a sheet");
        assert_eq!(why("L1 = 900\nl1 = 3\n"), "line 2: `L1` is given twice");
        assert_eq!(why(&LINEAR_SHEET.replace("L4 = 1100\n", "")), "`L4` is missing");
        assert_eq!(
            why(&LINEAR_SHEET.replace("range = 150", "range = -1")),
            "`range` is -1, not a positive number"
        );
        assert_eq!(
            why(&LINEAR_SHEET.replace("L1 = 900", "L1 = 90")),
            "L1 = 90 is shorter than L2 = 150: L1 is the long side of the platform"
        );
        assert_eq!(
            why(&LINEAR_SHEET.replace("L3, 200", "L3, 2000")),
            "L3 = 2000 and L4 = 1100: in the dialect motion4sim L4 is the long side of the base"
        );
        assert!(why(&format!("{LINEAR_SHEET}crank = 4\n")).contains("give one kind"));
        let short = RigSheet::read(
            LINEAR_SHEET.replace("middle = 900", "middle = 90").as_bytes(),
            SheetDialect::Motion4Sim,
        )
        .unwrap();
        assert!(matches!(short.to_toml("rig", "mm"), Err(InvalidRigSheet::OutOfReach { leg: 1, .. })));
        assert!("flypt".parse::<SheetDialect>().is_err());
    }
}
