//! One pose followed from angles to angles.

use super::RotaryPlatform;
use crate::fk::{NearOutcome, NearSolver};
use crate::geom::Pose;
use crate::manipulator::InvalidManipulator;

/// Angles move by at most this much at once, radians.
const LONGEST: f64 = 0.05;

/// Follows the pose of a machine with cranks.
///
/// A step goes from the last angles to the new ones by equal parts of at most a twentieth of a radian. In each the platform on the new tips is followed from the squared distances that the last pose gives
/// its rods to those that the rods have ([`NearSolver`]): the pose found is joined to the last one, on the new tips, by regular poses.
#[derive(Debug, Clone)]
pub struct RotaryTracker {
    platform: RotaryPlatform,
    pose: Pose,
    angles: [f64; 6],
}

impl RotaryTracker {
    /// Begins at a pose with the angles that the cranks have there.
    #[must_use]
    pub fn new(platform: RotaryPlatform, pose: Pose, angles: [f64; 6]) -> Self {
        Self { platform, pose, angles }
    }

    /// Where the platform is.
    #[must_use]
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Continues to other angles; where the pose is lost or a singular one is in the way the tracker stays where it was. `fraction` of the outcome counts within the part of the step that failed.
    ///
    /// # Errors
    /// Angles that are not finite, or tips and joints that make no platform.
    pub fn step(&mut self, angles: &[f64; 6]) -> Result<NearOutcome, InvalidManipulator> {
        let largest = (0..6).map(|i| (angles[i] - self.angles[i]).abs()).fold(0.0, f64::max);
        let parts = (largest / LONGEST).ceil().clamp(1.0, 1e4);
        let squares = self.platform.rods().squared();
        let mut pose = self.pose;
        let mut part = 1.0;
        loop {
            let at: [f64; 6] =
                std::array::from_fn(|i| self.angles[i] + (angles[i] - self.angles[i]) * (part / parts));
            let solver = NearSolver::new(&self.platform.at(&at)?);
            let outcome = solver.solve(&squares, &pose);
            match &outcome {
                NearOutcome::Tracked { pose: next, .. } => pose = *next,
                _ => return Ok(outcome),
            }
            if part >= parts {
                (self.pose, self.angles) = (pose, *angles);
                return Ok(outcome);
            }
            part += 1.0;
        }
    }
}
