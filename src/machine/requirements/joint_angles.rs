//! Angles of the joints at the ends of a leg at a pose.

use nalgebra::Vector3;

use super::term::{Terms, angle_deg};
use super::universal::Hinge;
use platform::geom::{Pose, any_across};

/// The angles of a joint at one end of a leg, measured from its axis `n`.
///
/// Let `x` be a unit vector across `n` (the coordinate axis farthest from `n`, made normal to it) and `y = n x x`. The
/// leg has the direction of `n` rotated by `universal_deg[1]` about `y`, then by `universal_deg[0]` about `x`:
/// `u = Rx(first) Ry(second) n`. The first axis belongs to the body, the second to the leg. The model from
/// `export --to mjcf` has the same axes for joints that follow the legs at home.
///
/// A universal joint of the design has `x` along its first axis. The part of its axis across `x` then replaces `n`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointAngles {
    /// Angle of leg and axis, degrees, 0 to 180.
    pub cone_angle_deg: f64,
    /// Both angles of a universal joint, degrees: the first from -180 to 180, the second from -90 to 90. At +-90 the
    /// first is undetermined.
    pub universal_deg: [f64; 2],
}

impl JointAngles {
    fn of(line: &Vector3<f64>, axis: &Vector3<f64>, hinge: Option<&Hinge>) -> Self {
        let cone_angle_deg = angle_deg(line, axis);
        if let Some(hinge) = hinge {
            return Self { cone_angle_deg, universal_deg: hinge.angles_deg(line) };
        }
        let x = any_across(axis);
        let y = axis.cross(&x);
        let (along, across, up) = (line.dot(&x), line.dot(&y), line.dot(axis));
        // u = (sin b, -cos b sin a, cos b cos a)
        let first = (-across + 0.0).atan2(up);
        let second = along.atan2(across.hypot(up));
        Self { cone_angle_deg, universal_deg: [first, second].map(f64::to_degrees) }
    }
}

impl Terms<'_> {
    /// The angles of the joints at a pose, leg by leg: at the base, then at the platform.
    #[must_use]
    pub fn joint_angles(&self, pose: &Pose) -> [[JointAngles; 6]; 2] {
        let lines = self.manipulator.legs().map(|leg| pose.transform(&leg.platform) - leg.base);
        self.angles_of(&lines, pose)
    }

    /// The same for legs with given lines, base frame.
    #[must_use]
    pub fn angles_of(&self, lines: &[Vector3<f64>; 6], pose: &Pose) -> [[JointAngles; 6]; 2] {
        let [base, platform] = self.axes();
        let back = pose.rotation.inverse();
        [
            std::array::from_fn(|i| JointAngles::of(&lines[i], &base[i], self.hinge(0, i))),
            std::array::from_fn(|i| JointAngles::of(&(back * lines[i]), &platform[i], self.hinge(1, i))),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Unit};
    use num::Rng;

    #[test]
    fn the_two_turns_take_the_axis_to_the_leg() {
        let mut rng = Rng::new(2);
        for _ in 0..100 {
            let mut vector = || Vector3::from_fn(|_, _| rng.normal());
            let (line, axis) = (vector() * 3.0, vector().normalize());
            let found = JointAngles::of(&line, &axis, None);
            let x = any_across(&axis);
            let y = axis.cross(&x);
            let turn = |axis: Vector3<f64>, deg: f64| {
                Rotation3::from_axis_angle(&Unit::new_normalize(axis), deg.to_radians())
            };
            let [a, b] = found.universal_deg;
            let led = turn(x, a) * (turn(y, b) * axis);
            assert!((led - line.normalize()).norm() < 1e-14);
            let cosine = a.to_radians().cos() * b.to_radians().cos();
            assert!((found.cone_angle_deg.to_radians().cos() - cosine).abs() < 1e-14);
        }
        let still = JointAngles::of(&Vector3::z(), &Vector3::z(), None);
        assert_eq!((still.cone_angle_deg, still.universal_deg), (0.0, [0.0, 0.0]));
    }
}
