//! Paths of the platform: constant velocity of its origin, constant angular velocity.

use nalgebra::{Rotation3, Vector3};

use platform::geom::{Pose, PoseSpace, turn_between};

num::answer_words! {
    /// The six numbers of a machine's pose: position, and `R = Rz(yaw) Ry(pitch) Rx(roll)`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum PoseAxis as name {
        /// Position along x of the base frame.
        X = "x",
        /// Position along y.
        Y = "y",
        /// Position along z.
        Z = "z",
        /// Rotation about the x axis of the platform.
        Roll = "roll",
        /// Rotation about the y axis of the base after the rotation by the yaw.
        Pitch = "pitch",
        /// Rotation about the z axis of the base.
        Yaw = "yaw",
    }
}

impl PoseAxis {
    /// Whether it is an angle.
    #[must_use]
    pub fn is_turn(self) -> bool {
        matches!(self, Self::Roll | Self::Pitch | Self::Yaw)
    }
}

/// A path from a pose: `R(t) = exp(t [w]) R`, while the pivot, a point `c` of the platform, moves on a line:
/// `R(t) c + p(t) = R c + p + t v`, base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightPath {
    /// The start, at `t = 0`.
    pub start: Pose,
    /// Velocity of the pivot, design units.
    pub velocity: Vector3<f64>,
    /// Angular velocity, radians.
    pub turn: Vector3<f64>,
    /// The pivot, platform frame: the origin of the platform, or the point about which it turns.
    pub pivot: Vector3<f64>,
}

impl StraightPath {
    /// The path on which one of the six numbers of a pose grows by `t` (design units, radians) and the others stay. A
    /// moving angle rotates about a fixed axis: `R e_x` for roll, `Rz(yaw) e_y` for pitch, `e_z` for yaw.
    #[must_use]
    pub fn axis(start: &Pose, axis: PoseAxis) -> Self {
        let still = Vector3::zeros();
        let turn = match axis {
            PoseAxis::X | PoseAxis::Y | PoseAxis::Z => still,
            PoseAxis::Roll => start.rotation * Vector3::x(),
            PoseAxis::Pitch => {
                let yaw = start.angles().radians()[2];
                Vector3::new(-yaw.sin(), yaw.cos(), 0.0)
            }
            PoseAxis::Yaw => Vector3::z(),
        };
        let velocity = match axis {
            PoseAxis::X => Vector3::x(),
            PoseAxis::Y => Vector3::y(),
            PoseAxis::Z => Vector3::z(),
            _ => still,
        };
        Self { start: *start, velocity, turn, pivot: still }
    }

    /// The path from home on which one coordinate of a region grows (design units, radians): the pivot moves along an
    /// axis of the base frame, or the platform rotates about this axis at the pivot.
    #[must_use]
    pub fn coordinate(space: &PoseSpace, k: usize) -> Self {
        let along = Vector3::ith(k % 3, 1.0);
        let [velocity, turn] = if k < 3 { [along, Vector3::zeros()] } else { [Vector3::zeros(), along] };
        Self { start: space.home, velocity, turn, pivot: space.pivot }
    }

    /// The straight path between two poses, which ends at `t = 1`. The origin moves on a line; the platform rotates
    /// about one axis by at most half a turn.
    #[must_use]
    pub fn between(from: &Pose, to: &Pose) -> Self {
        let turn = turn_between(&from.rotation, &to.rotation);
        let velocity = to.position - from.position;
        Self { start: *from, velocity, turn, pivot: Vector3::zeros() }
    }

    /// The same path backwards from its start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { velocity: -self.velocity, turn: -self.turn, ..*self }
    }

    /// The pose of the platform at `t`.
    #[must_use]
    pub fn at(&self, t: f64) -> Pose {
        let rotation = Rotation3::new(self.turn * t) * self.start.rotation;
        let arm = self.start.rotation * self.pivot - rotation * self.pivot;
        Pose { rotation, position: self.start.position + arm + self.velocity * t }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use platform::geom::random_rotation;

    #[test]
    fn a_way_ends_at_its_last_pose_after_half_a_turn_and_after_no_turn_but_rounding() {
        let rng = &mut Rng::new(5);
        for k in 0..60 {
            let from = Pose { rotation: random_rotation(rng), position: Vector3::zeros() };
            let turn = match k % 3 {
                0 => Vector3::z() * std::f64::consts::PI,
                1 => Vector3::x() * 1e-16,
                _ => Vector3::new(0.3, -0.2, 1.0),
            };
            let to = Pose {
                rotation: Rotation3::new(turn) * from.rotation,
                position: Vector3::new(1.0, 2.0, 3.0),
            };
            let end = StraightPath::between(&from, &to).at(1.0);
            assert!((end.rotation.matrix() - to.rotation.matrix()).amax() < 1e-14, "{k}");
            assert!((end.position - to.position).amax() < 1e-15);
        }
    }
}
