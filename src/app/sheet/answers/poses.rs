//! Poses as people read and type them: position, roll, pitch and yaw.

use crate::figure::figure;
use platform::geom::Pose;
use records::{PoseConventionRecord, PoseInFrames, PoseQuaternionRecord};

/// The names of a pose's numbers in their order.
pub(super) const POSE: &str = "x,y,z,roll,pitch,yaw";
/// A number of a pose below this share of the greatest one of its kind is rounding.
const ROUNDING: f64 = 1e-12;

/// The text with a capital letter and a full stop: explanations begin in lower case, because they also follow a colon.
pub(super) fn full_sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

/// The pose by its numbers with commas, as `--pose` takes it; angles are degrees.
pub(super) fn pose<'a, R>(record: &'a R) -> String
where
    Pose: From<&'a R>,
{
    numbers(&record.into()).map(figure).join(",")
}

/// The units of a pose after its numbers, in brackets; designs without a unit of length have the label `1`.
pub(super) fn units(length: &str, angles: &str) -> String {
    if length == "1" { format!(" ({angles})") } else { format!(" ({length}, {angles})") }
}

/// The pose where there is one; a requirement without one does not depend on the pose.
pub(super) fn place(pose_or_any: Option<&PoseQuaternionRecord>) -> String {
    pose_or_any.map_or_else(|| "any".to_owned(), pose)
}

/// Position, then roll, pitch and yaw in degrees; numbers that are rounding are zero.
pub(super) fn numbers(pose: &Pose) -> [f64; 6] {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let [x, y, z] = without_rounding(pose.position.into(), 0.0);
    let [roll, pitch, yaw] = without_rounding([roll, pitch, yaw].map(f64::to_degrees), 360.0);
    [x, y, z, roll, pitch, yaw]
}

/// Position and angles as the convention of an answer has them; numbers that are rounding are zero.
pub(super) fn written(found: &PoseInFrames) -> [f64; 6] {
    let [x, y, z] = without_rounding(found.position.map(|x| x.0), 0.0);
    let [a, b, c] = without_rounding(found.angles.map(|x| x.0), 1.0);
    [x, y, z, a, b, c]
}

/// An angle in degrees; zero if it is rounding.
pub(super) fn angle(degrees: f64) -> f64 {
    without_rounding([degrees; 3], 360.0)[0]
}

/// The names of the six numbers of a pose in the convention of an answer.
pub(super) fn words(frames: &PoseConventionRecord) -> &'static str {
    if frames.is_usual() { POSE } else { "x,y,z,a,b,c" }
}

pub(super) fn without_rounding(numbers: [f64; 3], least_scale: f64) -> [f64; 3] {
    let scale = numbers.iter().fold(least_scale, |most, x| most.max(x.abs()));
    numbers.map(|x| if x.abs() <= ROUNDING * scale { 0.0 } else { x })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_six_numbers_without_rounding() {
        let turned = Pose::new([1e-14, -2.5, 210.0], nalgebra::Rotation3::from_euler_angles(0.1, 0.0, -0.2));
        let mut sheet = crate::Sheet::new();
        sheet.line(pose(&PoseQuaternionRecord::from(&turned)));
        assert_eq!(sheet.to_string(), "0,-2.5,210,5.73,0,-11.5\n");
    }
}
