//! The pins of `LinuxCNC`'s hexapod kinematics: lines `setp genhexkins.base.0.x 300`, as in machine files and in the
//! output of `export --to hal`.

use nalgebra::Point3;

use super::points::InvalidPointTable;
use platform::geom::{Angles, Pose};
use platform::manipulator::Leg;

/// The contents of the settings.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HexapodPins {
    /// Legs in order: pins with the number N belong to leg N + 1.
    pub(super) legs: [Leg; 6],
    /// The home pose, from the comment that this program writes.
    pub(super) home: Option<Pose>,
    pub(super) guesses: Vec<String>,
}

/// A pin of a joint: body (0: base), number, coordinate.
type JointPin = [usize; 3];

/// The joint of `COMPONENT.base.N.AXIS` or `COMPONENT.platform.N.AXIS`; `None` for other pins.
fn joint_pin(name: &str) -> Option<JointPin> {
    let parts: Vec<&str> = name.split('.').collect();
    let [_, body, number, axis] = parts[..] else { return None };
    let body = ["base", "platform"].iter().position(|b| *b == body)?;
    let axis = ["x", "y", "z"].iter().position(|a| *a == axis)?;
    let number = number.parse().ok().filter(|n: &usize| *n < 6)?;
    Some([body, number, axis])
}

/// The note that a home pose was read.
pub(super) const HOME_OF_COMMENT: &str = "Home is the pose of the comment `Home pose X Y Z A B C`.";

/// The six numbers of the comment on home.
pub(super) fn home_of(line: &str) -> Option<Pose> {
    let numbers = line.trim_start_matches('#').trim().strip_prefix("Home pose X Y Z A B C:")?;
    let numbers: Vec<f64> = numbers.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let [x, y, z, a, b, c] = numbers[..] else { return None };
    Some(Pose::new([x, y, z], Angles::from_degrees([a, b, c])))
}

impl HexapodPins {
    /// Reads settings; `None` if the text sets no joint of a hexapod.
    ///
    /// # Errors
    /// All invalid numbers, and all duplicate or missing pins.
    pub(super) fn read(text: &str) -> Option<Result<Self, InvalidPointTable>> {
        let mut values = [[[None::<f64>; 3]; 6]; 2];
        let (mut found, mut faults, mut guesses) = (0, Vec::new(), Vec::new());
        let (mut home, mut passed_over) = (None, Vec::new());
        for (k, line) in text.lines().enumerate() {
            home = home.or_else(|| home_of(line));
            let words: Vec<&str> = line.split('#').next().unwrap_or_default().split_whitespace().collect();
            let ["setp", pin, value] = words[..] else { continue };
            let Some([body, number, axis]) = joint_pin(pin) else {
                let of_hexapod = pin.contains("hexkins") || pin.contains("equipodkins");
                passed_over.extend(of_hexapod.then(|| pin.to_string()));
                continue;
            };
            found += 1;
            let place = &mut values[body][number][axis];
            match value.parse().ok().filter(|x: &f64| x.is_finite()) {
                Some(x) if place.is_none() => *place = Some(x),
                Some(_) => faults.push(format!("line {}: {pin} is set before", k + 1)),
                None => faults.push(format!("line {}: {value} is no number", k + 1)),
            }
        }
        if found == 0 {
            return None;
        }
        let all = |body: usize, leg: usize| -> Option<Point3<f64>> {
            let [x, y, z] = values[body][leg];
            Some(Point3::new(x?, y?, z?))
        };
        let legs: Option<Vec<Leg>> =
            (0..6).map(|i| Some(Leg { base: all(0, i)?, platform: all(1, i)? })).collect();
        if legs.is_none() && faults.is_empty() {
            faults.push(format!("{found} of the 36 pins base.0.x to platform.5.z are set: all have to be"));
        }
        let legs = match legs.map(<[Leg; 6]>::try_from) {
            Some(Ok(legs)) if faults.is_empty() => legs,
            _ => return Some(Err(InvalidPointTable::Form(faults.join("; ")))),
        };
        guesses.push(
            "The pins of LinuxCNC's hexapod kinematics: pins with the number N are of leg N + 1.".to_string(),
        );
        if !passed_over.is_empty() {
            guesses
                .push(format!("Not taken, since a design has no place for it: {}.", passed_over.join(", ")));
        }
        if home.is_some() {
            guesses.push(HOME_OF_COMMENT.to_string());
        }
        Some(Ok(Self { legs, home, guesses }))
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;

    fn pins(value: impl Fn(usize, usize, usize) -> f64) -> String {
        let mut out = String::from("loadrt genhexkins\n# Home pose X Y Z A B C: 0 0 400 0 10 0\n");
        for (b, body) in ["base", "platform"].iter().enumerate() {
            for n in 0..6 {
                for (k, axis) in ["x", "y", "z"].iter().enumerate() {
                    let _ = writeln!(out, "setp genhexkins.{body}.{n}.{axis} {} # a pin", value(b, n, k));
                }
            }
        }
        out
    }

    fn value(b: usize, n: usize, k: usize) -> f64 {
        (b * 100 + n * 10 + k) as f64 + 0.25
    }

    #[test]
    fn thirty_six_pins_are_twelve_points() {
        let text = pins(value) + "setp genhexkins.screw-lead 5\nsetp motion.x 1\n";
        let found = HexapodPins::read(&text).unwrap().unwrap();
        assert_eq!(found.legs[3].platform, Point3::new(130.25, 131.25, 132.25));
        assert_eq!(found.legs[5].base, Point3::new(50.25, 51.25, 52.25));
        let home = found.home.unwrap();
        assert!((home.position.z - 400.0).abs() < 1e-12 && (home.angles().degrees()[1] - 10.0).abs() < 1e-12);
        assert!(found.guesses[1].contains("genhexkins.screw-lead") && !found.guesses[1].contains("motion"));
    }

    #[test]
    fn other_texts_are_none_and_gaps_are_named() {
        assert!(HexapodPins::read("1,2,3\n").is_none());
        assert!(HexapodPins::read("setp motion.x 1\n").is_none());
        let message = |text: &str| HexapodPins::read(text).unwrap().unwrap_err().to_string();
        let whole = pins(value);
        let short: String =
            whole.lines().filter(|l| !l.contains("base.2.y")).map(|l| l.to_string() + "\n").collect();
        assert!(message(&short).contains("35 of the 36"));
        assert!(message(&whole.replace("base.1.x 10.25", "base.1.x ten")).contains("ten is no number"));
        assert!(message(&(whole.clone() + "setp genhexkins.base.1.x 3\n")).contains("is set before"));
    }
}
