//! Universal joints: two hinges in a row, each with a limit of its own.
//!
//! The first axis `a` is fixed in the body. The second is perpendicular to it and to the leg, and rotates with the leg
//! about the first. Let `k` be the axis of the joint (`base_axes`, `platform_axes`). The rest direction `n` is the part
//! of `k` across `a` as a unit vector, and `e = a x n`. A leg with the direction `u`, in the frame of the body, stands
//! at the angles
//!
//! ```text
//! first = atan2(u.e, u.n),   second = atan2(u.a, |u - (u.a) a|).
//! ```
//!
//! Along the first axis the first angle is undetermined and the second one is 90 degrees. The joint is singular there,
//! and both limits count as violated.

use nalgebra::{Unit, Vector3};

use super::hardware::JointAxes;

/// The universal joints of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniversalJoint {
    /// Direction of the first axis of each joint, in leg order, in the frame of the body. None if the joint of a leg is
    /// of another kind.
    pub first_axes: [Option<Unit<Vector3<f64>>>; 6],
    /// Greatest angles about the first and about the second axis of each joint, in both senses, degrees: at most 180,
    /// and below 90.
    pub limits_deg: [Option<[f64; 2]>; 6],
    /// The rest directions of the legs, where the first angles are zero.
    pub axes: JointAxes,
    /// Distance of the two axes, design units: 0 if they intersect.
    pub offset: f64,
}

impl UniversalJoint {
    /// Whether the joints of all legs are universal.
    #[must_use]
    pub fn is_of_all(&self) -> bool {
        self.first_axes.iter().all(Option::is_some)
    }
}

/// The angle about one axis of a universal joint, with its own limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HingeAngle {
    /// About the axis that is fixed in the body.
    First,
    /// About the axis that rotates with the leg.
    Second,
}

/// One universal joint.
#[derive(Debug, Clone, Copy)]
pub struct Hinge {
    /// The first axis.
    pub first: Vector3<f64>,
    /// The rest direction; `None` if the axis of the joint is parallel to the first axis.
    pub rest: Option<Vector3<f64>>,
}

impl Hinge {
    /// The joint with this first axis and this axis, unit vectors.
    pub fn new(first: Vector3<f64>, axis: &Vector3<f64>) -> Self {
        // a x (k x a) keeps its direction where k is nearly a
        Self { first, rest: first.cross(&axis.cross(&first)).try_normalize(0.0) }
    }

    /// Parts of a line along the rest direction, across it about the first axis, and along the first axis; `None`
    /// without a rest direction.
    fn parts(&self, line: &Vector3<f64>) -> Option<[f64; 3]> {
        let rest = self.rest?;
        Some([line.dot(&rest), line.dot(&self.first.cross(&rest)), line.dot(&self.first)])
    }

    /// Both angles of a leg, degrees; the first is 0 if undetermined.
    pub fn angles_deg(&self, line: &Vector3<f64>) -> [f64; 2] {
        let along = line.dot(&self.first);
        let Some([up, across, _]) = self.parts(line) else {
            let away = self.first.cross(line).norm();
            return [0.0, along.atan2(away).to_degrees()];
        };
        [across.atan2(up), along.atan2(across.hypot(up))].map(f64::to_degrees)
    }

    /// A limit minus its angle, degrees; an undetermined angle counts as the greatest possible, 180 or 90 degrees.
    pub(crate) fn margin_deg(&self, line: &Vector3<f64>, angle: HingeAngle, limit_deg: f64) -> f64 {
        let parts = self.parts(line).filter(|[up, across, _]| across.hypot(*up) > 0.0);
        match (angle, parts) {
            (HingeAngle::First, None) => limit_deg - 180.0,
            (HingeAngle::First, Some([up, across, _])) => limit_deg - across.atan2(up).to_degrees().abs(),
            (HingeAngle::Second, None) if self.rest.is_some() => limit_deg - 90.0,
            (HingeAngle::Second, _) => {
                let along = line.dot(&self.first).abs();
                limit_deg - along.atan2(self.first.cross(line).norm()).to_degrees()
            }
        }
    }

    /// Amplification of a direction error of a leg in the first angle.
    pub fn amplification(&self, line: &Vector3<f64>, axis: &Vector3<f64>) -> f64 {
        line.norm() / self.first.cross(line).norm() + 1.0 / self.first.cross(axis).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;
    use num::Rng;

    #[test]
    fn the_two_turns_take_the_rest_direction_to_the_leg() {
        let mut rng = Rng::new(4);
        for _ in 0..200 {
            let mut vector = || Vector3::from_fn(|_, _| rng.normal());
            let (first, axis, line) = (vector().normalize(), vector().normalize(), vector() * 2.0);
            let hinge = Hinge::new(first, &axis);
            let rest = hinge.rest.unwrap();
            assert!(
                rest.dot(&first).abs() < 1e-14 && rest.dot(&axis) > 0.0,
                "across the axis, as near to k as it can be"
            );
            let [a, b] = hinge.angles_deg(&line).map(f64::to_radians);
            let turn = |axis: &Vector3<f64>, angle: f64| {
                Rotation3::from_axis_angle(&Unit::new_normalize(*axis), angle)
            };
            // the second axis at rest is n x a; the first turn takes it along
            let led = turn(&first, a) * (turn(&rest.cross(&first), b) * rest);
            assert!((led - line.normalize()).norm() < 1e-13);
            for (angle, found) in [(HingeAngle::First, a), (HingeAngle::Second, b)] {
                let margin = hinge.margin_deg(&line, angle, 50.0);
                assert!((margin - (50.0 - found.to_degrees().abs())).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn along_the_first_axis_both_limits_are_violated() {
        let hinge = Hinge::new(Vector3::x(), &Vector3::z());
        for line in [Vector3::x(), -3.0 * Vector3::x(), Vector3::zeros()] {
            assert!((hinge.margin_deg(&line, HingeAngle::First, 120.0) + 60.0).abs() < 1e-12);
            assert!((hinge.margin_deg(&line, HingeAngle::Second, 80.0) + 10.0).abs() < 1e-12);
            assert!(hinge.angles_deg(&line).iter().all(|x| x.is_finite()));
        }
        // no rest direction: the first limit cannot be met, the second one is that of the leg
        let none = Hinge::new(Vector3::x(), &Vector3::x());
        assert!((none.margin_deg(&Vector3::z(), HingeAngle::First, 120.0) + 60.0).abs() < 1e-12);
        assert!((none.margin_deg(&Vector3::z(), HingeAngle::Second, 80.0) - 80.0).abs() < 1e-12);
    }
}
