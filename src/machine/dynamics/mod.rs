//! Inverse dynamics, stiffness and natural frequencies: the leg motions and drive forces for a motion of the platform
//! with its payload.
//!
//! All functions take lengths in design units, masses in kilograms and times in seconds. Forces are then in kilograms
//! times design units per second squared; [`MovingBodies::newtons`] converts them to newtons. `docs/theory/motion.md`
//! derives the formulas and names their sources.

mod extremes;
mod inverse;
mod manoeuvre;
mod spline;
#[cfg(test)]
mod tests;

pub use extremes::{DriveExtremes, Extreme, LegExtremes, LegInstant};
pub use inverse::{LegMotion, drive_forces, leg_motions};
pub use manoeuvre::{InvalidManoeuvre, Manoeuvre, PlatformFreedom};
pub use spline::{InvalidPath, PathEnds, PosePath};

pub use crate::requirements::{
    LeastStiffness, MovingBodies, Vibration, least_stiffness, mass_matrix, stiffness_matrix, vibration,
};

use nalgebra::Vector3;

use platform::geom::Pose;

/// A pose with the first and second derivatives of the motion through it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionState {
    /// The pose.
    pub pose: Pose,
    /// Velocity of the platform origin, base frame, design units per second.
    pub velocity: Vector3<f64>,
    /// Angular velocity, base frame, radians per second.
    pub angular_velocity: Vector3<f64>,
    /// Acceleration of the platform origin, base frame, design units per second squared.
    pub acceleration: Vector3<f64>,
    /// Angular acceleration, base frame, radians per second squared.
    pub angular_acceleration: Vector3<f64>,
}

impl MotionState {
    /// At rest.
    #[must_use]
    pub fn at_rest(pose: Pose) -> Self {
        let none = Vector3::zeros();
        Self { pose, velocity: none, angular_velocity: none, acceleration: none, angular_acceleration: none }
    }

    /// Velocity and acceleration of a point of the platform whose arm from the platform origin is given in the base
    /// frame: `v + w x r` and `a + w' x r + w x (w x r)`.
    #[must_use]
    pub fn of_arm(&self, arm: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let turning = self.angular_velocity.cross(arm);
        let velocity = self.velocity + turning;
        let centripetal = self.angular_velocity.cross(&turning);
        (velocity, self.acceleration + self.angular_acceleration.cross(arm) + centripetal)
    }
}
