//! The text of a design from a few main dimensions: sizes of a symmetric hexapod with legs or servos, or the corners of
//! two triangles.

mod servo;

use std::fmt::Write as _;

use thiserror::Error;

use num::shown::rounded;

pub use servo::{InvalidServoSizes, ServoHexapod, ServoHome, ServoSizes};

/// The usual dimensions of a hexapod: the joints of each body stand in three pairs on a circle, and legs join
/// neighbouring pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HexapodSizes {
    /// Radii of the circles of the base and platform joints, design units.
    pub radius: [f64; 2],
    /// Angles between the two joints of a pair, seen from the centre, degrees; 0: the pair is one joint of two legs.
    pub spread_deg: [f64; 2],
    /// Height of the platform above the base at home, design units.
    pub height: f64,
}

/// The reason why sizes or corners give no design.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct InvalidOutline(String);

/// Angle between the pairs of the two bodies: a sixth of a turn, so that legs of equal length cross from pair to pair.
const PLATFORM_TURN_DEG: f64 = 60.0;
/// Angle from pair to pair.
const PAIRS_DEG: f64 = 120.0;

impl HexapodSizes {
    /// Whether the sizes are those of a hexapod.
    ///
    /// # Errors
    /// The first invalid size. Spreads that make the hexagons similar also fail: the legs of such a hexapod cannot hold
    /// it.
    pub fn check(&self) -> Result<(), InvalidOutline> {
        self.check_each()?;
        if self.spread_deg[0] + self.spread_deg[1] == PAIRS_DEG {
            let message = format!(
                "the sum of the spreads is {PAIRS_DEG} degrees: base and platform are similar hexagons, so the design is architecturally singular{}",
                self.regular_reading()
            );
            return Err(InvalidOutline(message));
        }
        Ok(())
    }

    /// The same for the crank centres of a rotary hexapod. Its rods end at crank tips, so similar hexagons are allowed.
    /// Each crank needs its own centre.
    pub(in crate::design) fn check_rotary(&self) -> Result<(), InvalidOutline> {
        self.check_each()?;
        if self.spread_deg[0] == 0.0 {
            let message = "the spread of the base is 0 degrees, and two cranks cannot have one centre";
            return Err(InvalidOutline(message.into()));
        }
        Ok(())
    }

    /// Whether each size alone is possible.
    fn check_each(&self) -> Result<(), InvalidOutline> {
        let [base, platform] = self.radius;
        for (what, x) in
            [("radius of the base", base), ("radius of the platform", platform), ("height", self.height)]
        {
            if !(x > 0.0 && x.is_finite()) {
                return Err(InvalidOutline(format!("the {what} is {x}, not a positive length")));
            }
        }
        for (body, x) in ["base", "platform"].into_iter().zip(self.spread_deg) {
            if !(0.0..PAIRS_DEG).contains(&x) {
                let message = format!(
                    "the spread of the {body} is {x} degrees; spreads are from 0 to less than {PAIRS_DEG} degrees"
                );
                return Err(InvalidOutline(message));
            }
        }
        Ok(())
    }

    /// The places of the joints and the meaning of the spreads, one sentence each.
    pub fn understood(&self, units: &str) -> [String; 3] {
        self.understood_as("base joints", units)
    }

    /// The same, with another name for the joints of the base.
    fn understood_as(&self, base_joints: &str, units: &str) -> [String; 3] {
        let pair = |k: usize, middle: f64| {
            let half = self.spread_deg[k] / 2.0;
            if half > 0.0 { vec![middle - half, middle + half] } else { vec![middle] }
        };
        let body = |k: usize, first: f64| {
            let angles = [0.0, 1.0, 2.0].into_iter().flat_map(|n| pair(k, first + n * PAIRS_DEG));
            let angles: Vec<String> = angles.map(degrees).collect();
            format!("on a circle of radius {} {units}, at {} degrees", self.radius[k], angles.join(", "))
        };
        [
            format!("The {base_joints} are {}.", body(0, 0.0)),
            format!("The platform joints are {}.", body(1, PLATFORM_TURN_DEG)),
            format!(
                "The spread is the angle between the two joints of a pair on one body. Makers who measure the platform spread between the legs of a base pair write {} instead of {} degrees.",
                degrees(self.other_reading().spread_deg[1]),
                self.spread_deg[1]
            ),
        ]
    }

    /// The other reading, if its hexagons are not similar too.
    fn regular_reading(self) -> String {
        let spread = self.other_reading().spread_deg;
        if spread[0] + spread[1] == PAIRS_DEG {
            return String::new();
        }
        format!(
            ". If the platform spread is meant between the legs of a base pair, give {} degrees",
            degrees(spread[1])
        )
    }

    /// The same numbers if the pair of the platform is counted from the legs of a base pair, as some makers do.
    #[must_use]
    pub fn other_reading(self) -> Self {
        Self { spread_deg: [self.spread_deg[0], PAIRS_DEG - self.spread_deg[1]], ..self }
    }

    /// The design file in TOML, without leg lengths.
    pub fn to_toml(self, name: &str, units: &str) -> String {
        self.written(name, units, false)
    }

    /// The design file of a rotary hexapod in TOML, without its cranks; the base joints are their centres.
    pub(in crate::design) fn to_toml_of_rotary(self, name: &str, units: &str) -> String {
        self.written(name, units, true)
    }

    fn written(self, name: &str, units: &str, is_rotary: bool) -> String {
        let [(base, base_ends), (platform, platform_ends)] =
            [self.body(0, "A", 0.0), self.body(1, "B", PLATFORM_TURN_DEG)];
        let legs: Vec<String> =
            base_ends.iter().zip(&platform_ends).map(|(a, b)| format!("[\"{a}\", \"{b}\"]")).collect();
        let (kind, drive) = if is_rotary {
            ("rotary hexapod", "drive = \"rotary\" # the base joints are the centres of the cranks\n")
        } else {
            ("hexapod", "")
        };
        let mut out = format!(
            "# A {kind} with threefold symmetry. The joints of each body stand in three pairs on a circle; the spread is the angle\n# between the two joints of a pair, seen from the centre.\n",
        );
        let _ = writeln!(
            out,
            "# The spread is {} degrees on the base and {} degrees on the platform.",
            self.spread_deg[0], self.spread_deg[1]
        );
        let _ = write!(out, "name = {}\nunits = {}\n{drive}", quoted(name), quoted(units));
        let _ = writeln!(out, "legs = [{}]\n\n[parameters]", legs.join(", "));
        for (body, k) in [("base", 0), ("platform", 1)] {
            let _ = writeln!(out, "{body}_radius = {}", self.radius[k]);
            if let Some(degrees) = self.inexact_angle(k) {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let _ = writeln!(out, "{body}_cos = {cos:?} # cosine and sine of {degrees} degrees");
                let _ = writeln!(out, "{body}_sin = {sin:?}");
            }
        }
        let _ = write!(out, "\n[base]\n{base}\n[platform]\n{platform}\n");
        out + &home(self.height)
    }

    /// Angle of the second joint of a body on its circle, degrees from the x axis.
    fn angle(self, k: usize) -> f64 {
        let half = self.spread_deg[k] / 2.0;
        if k == 0 { half } else { PLATFORM_TURN_DEG - half }
    }

    /// This angle, if its cosine and sine are not sums of square roots. They are then written as decimals, since poses
    /// cannot be counted for joints known only between bounds.
    fn inexact_angle(self, k: usize) -> Option<f64> {
        let angle = self.angle(k);
        (self.spread_deg[k] > 0.0 && angle % 15.0 != 0.0).then_some(angle)
    }

    /// The joints of a body with its first pair at `turn` degrees, and the joints at the ends of the six legs.
    fn body(self, k: usize, letter: &str, turn: f64) -> (String, [String; 6]) {
        let body = ["base", "platform"][k];
        let joint = |n: u8| format!("{letter}{n}");
        let mut out = String::new();
        if self.spread_deg[k] > 0.0 {
            let _ = writeln!(out, "{letter}1 = {{ mirror = \"{letter}2\", plane = \"xz\" }}");
            let second = match self.inexact_angle(k) {
                Some(_) => format!("[\"{body}_radius*{body}_cos\", \"{body}_radius*{body}_sin\", 0]"),
                None => format!("{{ radius = \"{body}_radius\", angle_deg = {} }}", self.angle(k)),
            };
            let _ = writeln!(out, "{letter}2 = {second}");
            for n in 3..=6_u8 {
                let (from, deg) = (joint(2 - n % 2), PAIRS_DEG * f64::from((n - 1) / 2));
                let _ = writeln!(out, "{letter}{n} = {{ turn = \"{from}\", deg = {deg} }}");
            }
            return (out, [1, 2, 3, 4, 5, 6].map(joint));
        }
        let _ = writeln!(out, "{letter}1 = {{ radius = \"{body}_radius\", angle_deg = {} }}", -turn);
        for n in 2..=3_u8 {
            let deg = PAIRS_DEG * f64::from(n - 1);
            let _ = writeln!(out, "{letter}{n} = {{ turn = \"{letter}1\", deg = {deg} }}");
        }
        // the first leg goes to the pair before the first one of the base, the second to the one after it
        let ends = if turn > 0.0 { [1, 2, 2, 3, 3, 1] } else { [1, 1, 2, 2, 3, 3] };
        (out, ends.map(joint))
    }
}

/// A computed angle without the digits of its rounding.
fn degrees(x: f64) -> String {
    rounded(x, 12)
}

/// The design file of an octahedral platform in TOML, without leg lengths: each corner of the base is joined to two
/// corners of the platform.
pub fn octahedral_toml(corners: &[[[f64; 3]; 3]; 2], name: &str, units: &str, height: f64) -> String {
    let mut out =
        String::from("# An octahedral platform: three joints on each body, two legs at each joint.\n");
    let _ = writeln!(out, "name = {}\nunits = {}", quoted(name), quoted(units));
    out.push_str("legs = [[\"A1\", \"B1\"], [\"A2\", \"B1\"], [\"A2\", \"B2\"], [\"A3\", \"B2\"], [\"A3\", \"B3\"], [\"A1\", \"B3\"]]\n");
    for ((body, letter), list) in [("base", 'A'), ("platform", 'B')].into_iter().zip(corners) {
        let _ = writeln!(out, "\n[{body}]");
        for (n, p) in list.iter().enumerate() {
            let _ = writeln!(out, "{letter}{} = {p:?}", n + 1);
        }
    }
    out.push('\n');
    out + &home(height)
}

fn home(height: f64) -> String {
    format!("[home]\nposition = [0, 0, {height}]\nrpy_deg = [0, 0, 0]\n")
}

/// A text in quotes: JSON strings are basic strings of TOML, except for one character.
fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default().replace('\u{7f}', "\\u007f")
}

/// The same file with the leg lengths at home, before its legs.
pub fn with_lengths(text: &str, lengths: [f64; 6]) -> String {
    text.replacen("\nlegs = ", &format!("\nlengths = {lengths:?} # at home\nlegs = "), 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{DesignModel, Exactness, Format, parse};
    use platform::manipulator::Octahedral;

    fn sizes(spread_deg: [f64; 2]) -> HexapodSizes {
        HexapodSizes { radius: [500.0, 300.0], spread_deg, height: 400.0 }
    }

    fn design(text: &str) -> DesignModel {
        parse(text, Format::Toml).unwrap_or_else(|v| panic!("{v:?}\n{text}")).0
    }

    #[test]
    fn joints_stand_where_the_sizes_say_and_all_legs_are_equal_at_home() {
        for spread in [[20.0, 20.0], [0.0, 20.0], [20.0, 0.0], [0.0, 0.0], [119.5, 0.25], [30.0, 60.0]] {
            let design = design(&sizes(spread).to_toml("mine \"x\"", "mm"));
            assert!(design.exactness().exactness < Some(Exactness::Interval), "{spread:?}");
            let m = design.manipulator();
            let home = design.home.unwrap();
            let lengths = home.lengths(m).unwrap().get();
            assert!(lengths.iter().all(|l| (l - lengths[0]).abs() < 1e-9), "{spread:?}: {lengths:?}");
            for (k, joints) in [m.base_joints(), m.platform_joints()].into_iter().enumerate() {
                assert_eq!(joints.len(), if spread[k] > 0.0 { 6 } else { 3 });
                let radius = sizes(spread).radius[k];
                assert!(joints.iter().all(|p| (p.coords.norm() - radius).abs() < 1e-9), "{spread:?}");
            }
            // the pair of the base that legs 1 and 2 leave is around the x axis, and each leg goes to the pair beside
            // it
            let [a, b] = [m.legs()[1].base, m.legs()[1].platform].map(|p| p.y.atan2(p.x).to_degrees());
            assert!(
                (a - spread[0] / 2.0).abs() < 1e-9 && (b - 60.0 + spread[1] / 2.0).abs() < 1e-9,
                "{a} {b}"
            );
            let octahedral = Octahedral::recognise(m).is_ok();
            assert_eq!(octahedral, spread == [0.0, 0.0]);
        }
    }

    #[test]
    fn lengths_stand_in_the_file_and_impossible_sizes_are_refused() {
        let text = with_lengths(&sizes([20.0, 20.0]).to_toml("mine", "mm"), [1.5; 6]);
        assert_eq!(design(&text).lengths.unwrap().get().map(f64::to_bits), [1.5f64.to_bits(); 6]);
        for bad in [
            HexapodSizes { radius: [0.0, 1.0], ..sizes([1.0, 1.0]) },
            HexapodSizes { height: f64::NAN, ..sizes([1.0, 1.0]) },
            sizes([120.0, 1.0]),
            sizes([1.0, -1.0]),
            sizes([100.0, 20.0]),
        ] {
            assert!(bad.check().is_err(), "{bad:?}");
        }
        assert_eq!(sizes([0.0, 119.0]).check(), Ok(()));
    }

    #[test]
    fn corners_give_an_octahedral_design() {
        let corners = [
            [[0.0, 0.0, 0.0], [12.0, 0.0, 0.0], [6.0, 10.5, 0.0]],
            [[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [3.0, 5.2, 0.0]],
        ];
        let design = design(&octahedral_toml(&corners, "mine", "mm", 9.0));
        assert!(Octahedral::recognise(design.manipulator()).is_ok());
        assert!((design.home.unwrap().position.z - 9.0).abs() < 1e-15);
    }
}
