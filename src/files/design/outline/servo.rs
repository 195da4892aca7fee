//! A rotary hexapod from its main dimensions: six servos with equal cranks and rods.

use std::fmt::Write as _;

use thiserror::Error;

use super::{HexapodSizes, InvalidOutline, PAIRS_DEG};
use machine::rotary::{CrankReach, Elbow, angle_near};
use num::shown::{rounded, rounded_inward};

/// The usual dimensions of a rotary hexapod. Crank centres stand in three pairs on a circle, and platform joints on
/// another one, as in [`HexapodSizes`].
///
/// The axes of a pair are parallel to the radius through its middle. At the angle 0 both cranks are level and point
/// away from each other; positive angles lift them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoSizes {
    /// Radii of the circles of the crank centres and of the platform joints, design units.
    pub radius: [f64; 2],
    /// Angles between the two crank centres or platform joints of a pair, seen from the centre, degrees.
    pub spread_deg: [f64; 2],
    /// Length of each crank, from its axis to the rod, design units.
    pub crank: f64,
    /// Least and greatest angle of each crank, degrees; `None`: no limit.
    pub angle_deg: Option<[f64; 2]>,
    /// Height of home and length of the rods.
    pub home: ServoHome,
}

/// Height of the platform above the crank centres at home, and length of the rods, design units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ServoHome {
    /// The rods with which the cranks are level at this height.
    LevelAt {
        /// The height.
        height: f64,
    },
    /// The height at which the cranks are level with these rods.
    LevelWith {
        /// Length of the rods.
        rod: f64,
    },
    /// Both; the cranks have the angle that results.
    Stated {
        /// The height.
        height: f64,
        /// Length of the rods.
        rod: f64,
    },
}

/// The reason why sizes give no rotary hexapod.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InvalidServoSizes {
    /// A size that is not possible.
    #[error(transparent)]
    Size(#[from] InvalidOutline),
    /// The cranks and rods do not hold the home pose; the text has the lengths that do.
    #[error("{0}")]
    Home(String),
}

/// A rotary hexapod whose rods hold its home pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoHexapod {
    asked: ServoSizes,
    sizes: HexapodSizes,
    rod: f64,
}

/// The side of each crank: at the smaller of its two angles it is on the outer side of the rod.
const ELBOW: Elbow = Elbow::Minus;

impl ServoSizes {
    /// The hexapod with its home height and rods.
    ///
    /// # Errors
    /// [`InvalidServoSizes`]: an impossible size, or rods that do not hold home within the angles.
    pub fn solved(self) -> Result<ServoHexapod, InvalidServoSizes> {
        let (height, rod) = match self.home {
            ServoHome::LevelAt { height } => (Some(height), None),
            ServoHome::LevelWith { rod } => (None, Some(rod)),
            ServoHome::Stated { height, rod } => (Some(height), Some(rod)),
        };
        // a height still to be found passes as the radius
        self.sizes(height.unwrap_or(self.radius[0])).check_rotary()?;
        for (what, x) in [("crank", Some(self.crank)), ("rod", rod)] {
            if let Some(x) = x.filter(|x| !(*x > 0.0 && x.is_finite())) {
                return Err(
                    InvalidOutline(format!("the length of a {what} is {x}, not a positive length")).into()
                );
            }
        }
        if let Some([least, most]) = self.angle_deg.filter(|[a, b]| !(a < b && b - a <= 360.0)) {
            let message = format!(
                "the angles of a crank are from {least} to {most} degrees, not a range of at most a whole turn"
            );
            return Err(InvalidOutline(message).into());
        }
        let (height, rod) = match self.home {
            ServoHome::LevelAt { height } => (height, self.reach(height).rod(0.0)),
            ServoHome::LevelWith { rod } => (self.level_height(rod)?, rod),
            ServoHome::Stated { height, rod } => (height, rod),
        };
        self.check_home(height, rod)?;
        Ok(ServoHexapod { asked: self, sizes: self.sizes(height), rod })
    }

    fn sizes(&self, height: f64) -> HexapodSizes {
        HexapodSizes { radius: self.radius, spread_deg: self.spread_deg, height }
    }

    /// The way from a crank centre to its platform joint in the plane of the base: along the axis, and in the direction
    /// of the angle 0.
    fn way(&self) -> [f64; 2] {
        // second legs of pairs; mirroring and rotating them gives the others
        let sizes = self.sizes(0.0);
        let place = |body: usize| {
            let (sin, cos) = sizes.angle(body).to_radians().sin_cos();
            [self.radius[body] * cos, self.radius[body] * sin]
        };
        let [base, platform] = [place(0), place(1)];
        [platform[0] - base[0], platform[1] - base[1]]
    }

    fn reach(&self, height: f64) -> CrankReach {
        let [along, out] = self.way();
        CrankReach::new(self.crank, along * along + out * out + height * height, [out, height])
    }

    /// The height at which the cranks are level with these rods.
    fn level_height(&self, rod: f64) -> Result<f64, InvalidServoSizes> {
        let [along, out] = self.way();
        let across = along.hypot(out - self.crank);
        let square = (rod - across) * (rod + across);
        if square > 0.0 {
            return Ok(square.sqrt());
        }
        Err(InvalidServoSizes::Home(format!(
            "from level cranks rods of {rod} do not reach the platform joints, which are {} away at equal height: give longer rods, or the height of home",
            rounded(across, 4)
        )))
    }

    /// Whether the rods reach at home, and the cranks are then within their angles.
    fn check_home(&self, height: f64, rod: f64) -> Result<(), InvalidServoSizes> {
        let reach = self.reach(height);
        let refused = |message: String| Err(InvalidServoSizes::Home(message));
        let Ok(both) = reach.angles(rod) else {
            let [least, most] = rounded_inward(reach.rods());
            let heights = self.heights(rod).map_or_else(
                || "at no height".to_owned(),
                |heights| {
                    let [low, high] = rounded_inward(heights);
                    if heights[0] > 0.0 {
                        format!("at heights from {low} to {high}")
                    } else {
                        format!("at heights up to {high}")
                    }
                },
            );
            return refused(format!(
                "rods of {rod} do not reach the platform joints at the height {height}: rods from {least} to {most} do, and rods of {rod} do {heights}"
            ));
        };
        let Some([least, most]) = self.angle_deg else { return Ok(()) };
        let angle = angle_near((0.5 * (least + most)).to_radians(), both.of(ELBOW)).to_degrees();
        // an angle at the end of the range is within it up to rounding
        if least - ROUNDED_DEG <= angle && angle <= most + ROUNDED_DEG {
            return Ok(());
        }
        let rods = rods_within(&reach, [least, most]).map_or_else(
            || "no rods hold it within them".to_owned(),
            |rods| {
                let [shortest, longest] = rounded_inward(rods);
                format!("rods from {shortest} to {longest} hold it within them")
            },
        );
        refused(format!(
            "at home the cranks are at {} degrees, outside their angles from {least} to {most}: at the height {} {rods}",
            rounded((angle / ROUNDED_DEG).round() * ROUNDED_DEG, 3),
            rounded(height, 4)
        ))
    }

    /// The heights at which rods reach from the circles of the cranks: the distance `w` of the platform joint from the
    /// axis is from `|q - r|` to `q + r` with the crank `r` and `q^2 = l^2 - along^2`, and `w^2 = out^2 + height^2`.
    fn heights(&self, rod: f64) -> Option<[f64; 2]> {
        let [along, out] = self.way();
        let q = ((rod - along.abs()) * (rod + along.abs())).sqrt();
        let height = |w: f64| ((w - out.abs()) * (w + out.abs())).max(0.0).sqrt();
        let heights = [height((q - self.crank).abs()), height(q + self.crank)];
        (heights[0] < heights[1]).then_some(heights)
    }
}

/// The lengths of rods that hold home with cranks at these angles. On one side of the crank the rod gets shorter
/// while the crank turns towards the platform joint.
fn rods_within(reach: &CrankReach, [least, most]: [f64; 2]) -> Option<[f64; 2]> {
    let nearest = reach.middle.to_degrees();
    let middle = 0.5 * (least + most);
    let shift = angle_near((nearest - 90.0).to_radians(), middle.to_radians()).to_degrees() - middle;
    let (first, last) = ((least + shift).max(nearest - 180.0), (most + shift).min(nearest));
    (first < last).then(|| [last, first].map(|angle| reach.rod(angle.to_radians())))
}

/// Rounding of an angle at home, degrees.
const ROUNDED_DEG: f64 = 1e-9;

impl ServoHexapod {
    /// The places of the joints, the meaning of the sizes, and the length that was chosen, one sentence each.
    #[must_use]
    pub fn understood(&self, units: &str) -> Vec<String> {
        let mut told = self.sizes.understood_as("crank centres", units).to_vec();
        told.push(
            "At 0 degrees each crank is level and points away from the other crank of its pair; positive angles lift it."
                .into(),
        );
        let chosen = match self.asked.home {
            ServoHome::LevelAt { .. } => {
                format!(
                    "The rods are {} {units} long, so that the cranks are level at home.",
                    rounded(self.rod, 4)
                )
            }
            ServoHome::LevelWith { .. } => format!(
                "Home is {} {units} above the crank centres, so that the cranks are level there.",
                rounded(self.sizes.height, 4)
            ),
            ServoHome::Stated { .. } => return told,
        };
        told.push(chosen);
        told
    }

    /// The platform spread counted from the rods of a base pair, degrees, and the hexapod that this reading gives.
    ///
    /// # Errors
    /// [`InvalidServoSizes`]: there is none.
    pub fn other_reading(&self) -> (f64, Result<Self, InvalidServoSizes>) {
        let spread_deg = self.sizes.other_reading().spread_deg;
        (spread_deg[1], ServoSizes { spread_deg, ..self.asked }.solved())
    }

    /// The design file in TOML.
    #[must_use]
    pub fn to_toml(&self, name: &str, units: &str) -> String {
        let mut out = self.sizes.to_toml_of_rotary(name, units);
        let ServoSizes { crank, angle_deg, .. } = self.asked;
        let _ = write!(out, "\n[cranks]\nlength = {crank}\nrod_length = {}", self.rod);
        if matches!(self.asked.home, ServoHome::LevelAt { .. }) {
            out.push_str(" # the cranks are level at home");
        }
        let _ = writeln!(out, "\nelbow = \"{}\"", ELBOW.name());
        if let Some([least, most]) = angle_deg {
            let _ = writeln!(out, "angle_deg = [{least}, {most}]");
        }
        out.push_str(
            "\n[cranks.A2] # at 0 degrees level, away from A1; positive angles lift it\naxis = [1, 0, 0]\nzero = [0, 1, 0]\n",
        );
        out.push_str("\n[cranks.A1]\nmirror = \"A2\"\nplane = \"xz\"\n");
        for n in 3..=6_u8 {
            let deg = PAIRS_DEG * f64::from((n - 1) / 2);
            let _ = write!(out, "\n[cranks.A{n}]\nturn = \"A{}\"\ndeg = {deg}\n", 2 - n % 2);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{DesignModel, Exactness, Format, parse_with_cranks};

    const SIZES: ServoSizes = ServoSizes {
        radius: [80.0, 60.0],
        spread_deg: [20.0, 20.0],
        crank: 24.0,
        angle_deg: Some([-60.0, 60.0]),
        home: ServoHome::LevelAt { height: 110.0 },
    };

    fn design(made: &ServoHexapod) -> DesignModel {
        let text = made.to_toml("mine", "mm");
        parse_with_cranks(&text, Format::Toml).unwrap_or_else(|v| panic!("{v:?}\n{text}")).0
    }

    /// The crank angles at home, degrees.
    fn angles(made: &ServoHexapod) -> [f64; 6] {
        let design = design(made);
        let rotary = design.rotary().unwrap().unwrap();
        let angles = rotary.ik(&design.home.unwrap()).unwrap();
        assert!(rotary.within_limits(&angles), "{angles:?}");
        angles.map(f64::to_degrees)
    }

    #[test]
    fn cranks_are_level_with_the_chosen_rods_or_height_and_point_outward() {
        for spread_deg in [[20.0, 20.0], [13.0, 20.0], [60.0, 60.0], [40.0, 0.0]] {
            let level = ServoSizes { spread_deg, ..SIZES }.solved().unwrap();
            assert!(angles(&level).iter().all(|angle| angle.abs() < 1e-9), "{spread_deg:?}");
            let rod = level.rod;
            let again = ServoSizes { home: ServoHome::LevelWith { rod }, ..level.asked }.solved().unwrap();
            assert!((again.sizes.height - 110.0).abs() < 1e-9, "{again:?}");
            assert!(angles(&again).iter().all(|angle| angle.abs() < 1e-9));
            let model = design(&level);
            assert!(model.exactness().exactness < Some(Exactness::Interval));
            let rotary = model.rotary().unwrap().unwrap();
            for (leg, crank) in rotary.legs().iter().enumerate() {
                let [zero, up] = rotary.directions()[leg];
                let centre = crank.crank.centre;
                let other = rotary.legs()[leg ^ 1].crank.centre;
                assert!(zero.dot(&(centre - other)) > 0.0 && up.z > 1.0 - 1e-12, "leg {}", leg + 1);
                // tip and centre of level cranks are at one height, the tip farther from the axis of the machine
                let tip = rotary.tip(leg, 0.0);
                assert!(tip.z.abs() < 1e-12 && tip.coords.norm() > centre.coords.norm());
            }
        }
    }

    #[test]
    fn a_higher_home_lifts_the_cranks_and_all_have_one_angle() {
        let rod = SIZES.solved().unwrap().rod;
        for (height, sign) in [(116.0, 1.0), (103.0, -1.0)] {
            let made = ServoSizes { home: ServoHome::Stated { height, rod }, ..SIZES }.solved().unwrap();
            let angles = angles(&made);
            assert!(sign * angles[0] > 5.0, "{angles:?}");
            assert!(angles.iter().all(|angle| (angle - angles[0]).abs() < 1e-9));
        }
    }

    #[test]
    fn a_home_out_of_reach_is_refused_with_lengths_that_hold_it() {
        let stated = |height: f64, rod: f64| {
            ServoSizes { angle_deg: None, home: ServoHome::Stated { height, rod }, ..SIZES }.solved()
        };
        for (rod, count) in [(60.0, 1), (300.0, 2)] {
            let Err(InvalidServoSizes::Home(why)) = stated(110.0, rod) else { panic!("{rod}") };
            let words = why.split(' ').filter_map(|word| word.trim_end_matches([',', ':']).parse().ok());
            let quoted: Vec<f64> = words.collect();
            let [_, _, least, most, _, ref heights @ ..] = quoted[..] else { panic!("{why}") };
            // the quoted lengths hold home, and lengths a little beyond them do not
            for (x, beyond) in [(least, 1.02 * least - 0.02 * most), (most, 1.02 * most - 0.02 * least)] {
                assert!(stated(110.0, x).is_ok() && stated(110.0, beyond).is_err(), "{why}");
            }
            for (h, factor) in
                heights.iter().zip(if heights.len() == 2 { [0.99, 1.01] } else { [1.01, 1.01] })
            {
                assert!(stated(*h, rod).is_ok() && stated(factor * h, rod).is_err(), "{why}");
            }
            assert_eq!(heights.len(), count, "{why}");
        }
        let Err(InvalidServoSizes::Home(why)) = stated(110.0, 20.0) else { panic!() };
        assert!(why.contains("at no height"), "{why}");
        let with = |rod: f64| ServoSizes { home: ServoHome::LevelWith { rod }, ..SIZES }.solved();
        let Err(InvalidServoSizes::Home(why)) = with(30.0) else { panic!() };
        assert!(why.contains("from level cranks"), "{why}");
    }

    #[test]
    fn angles_beyond_the_range_are_refused_with_rods_that_keep_it() {
        let limited = |rod: f64, range: [f64; 2]| {
            let home = ServoHome::Stated { height: 110.0, rod };
            ServoSizes { angle_deg: Some(range), home, ..SIZES }.solved()
        };
        // a turn more is the same range
        for range in [[-20.0, 30.0], [340.0, 390.0], [-150.0, -60.0]] {
            let Err(InvalidServoSizes::Home(why)) = limited(100.0, range) else { panic!("{range:?}") };
            let rods = why.split("rods from ").nth(1).unwrap();
            let quoted: Vec<f64> = rods.split(' ').filter_map(|word| word.parse().ok()).collect();
            let [least, most] = quoted[..] else { panic!("{why}") };
            for rod in [least, most] {
                let made = limited(rod, range).unwrap_or_else(|again| panic!("{why}: {again}"));
                angles(&made);
            }
            for rod in [1.02 * least - 0.02 * most, 1.02 * most - 0.02 * least] {
                assert!(limited(rod, range).is_err(), "{why}: {rod}");
            }
        }
        // a level crank is outside these angles
        let level = ServoSizes { angle_deg: Some([10.0, 60.0]), ..SIZES }.solved();
        assert!(matches!(level, Err(InvalidServoSizes::Home(_))), "{level:?}");
    }

    #[test]
    fn impossible_sizes_are_refused() {
        for bad in [
            ServoSizes { crank: 0.0, ..SIZES },
            ServoSizes { crank: f64::NAN, ..SIZES },
            ServoSizes { radius: [80.0, -60.0], ..SIZES },
            ServoSizes { spread_deg: [0.0, 20.0], ..SIZES },
            ServoSizes { spread_deg: [20.0, 120.0], ..SIZES },
            ServoSizes { angle_deg: Some([60.0, -60.0]), ..SIZES },
            ServoSizes { angle_deg: Some([-300.0, 300.0]), ..SIZES },
            ServoSizes { home: ServoHome::LevelAt { height: -1.0 }, ..SIZES },
            ServoSizes { home: ServoHome::LevelWith { rod: 0.0 }, ..SIZES },
            ServoSizes { home: ServoHome::Stated { height: 110.0, rod: f64::INFINITY }, ..SIZES },
        ] {
            assert!(matches!(bad.solved(), Err(InvalidServoSizes::Size(_))), "{bad:?}");
        }
    }
}
