//! One pose followed from angles to angles.

use nalgebra::{Point3, Vector3};

use super::RotaryPlatform;
use fk::{NearEvidence, NearOutcome, NearSolver, WhyLost};
use platform::geom::{Pose, turn_between};
use platform::manipulator::InvalidManipulator;

/// Angles move by at most this much at once, radians.
const LONGEST: f64 = 0.05;
/// Greatest number of parts of a step: 79 turns, since further ones would need longer parts.
const PARTS: f64 = 1e4;

/// Follows the pose of a machine with cranks.
///
/// A step goes from the last angles to the new ones by equal parts of at most a twentieth of a radian. In each part the
/// platform on the new tips is followed by [`NearSolver`]. It goes from the squared distances of the last pose to the
/// squared rod lengths. Regular poses on the new tips join the new pose to the last one.
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

    /// The current pose of the platform.
    #[must_use]
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// The angles of the cranks there.
    #[must_use]
    pub fn angles(&self) -> &[f64; 6] {
        &self.angles
    }

    /// Moves to other angles; the tracker keeps its pose if that is lost or a singular pose is in the way. `fraction`
    /// of the outcome counts from the last angles to the new ones. The evidence covers all parts: residual and
    /// Frobenius ratio at the pose, total segments and Newton steps, the greatest Kantorovich number.
    ///
    /// Angles more than 79 turns away count as lost: [`WhyLost::AnglesTooFar`].
    ///
    /// # Errors
    /// Angles are not finite, or tips and joints define no platform.
    pub fn step(&mut self, angles: &[f64; 6]) -> Result<NearOutcome, InvalidManipulator> {
        let largest = (0..6).map(|i| (angles[i] - self.angles[i]).abs()).fold(0.0, f64::max);
        let parts = (largest / LONGEST).ceil().max(1.0);
        let squares = self.platform.rods().squared();
        if parts > PARTS {
            self.platform.at(angles)?;
            let here = NearSolver::new(&self.platform.at(&self.angles)?).solve(&squares, &self.pose);
            let (reason, evidence) = (WhyLost::AnglesTooFar, *here.evidence());
            return Ok(NearOutcome::Lost { pose: self.pose, reason, fraction: 0.0, evidence });
        }
        let (mut pose, mut part) = (self.pose, 1.0);
        let mut before: Option<NearEvidence> = None;
        loop {
            let at: [f64; 6] =
                std::array::from_fn(|i| self.angles[i] + (angles[i] - self.angles[i]) * (part / parts));
            let solver = NearSolver::new(&self.platform.at(&at)?);
            let mut outcome = solver.solve(&squares, &pose);
            let reached = *outcome.pose();
            match &mut outcome {
                NearOutcome::Tracked { evidence, .. } => self.add(evidence, before.as_ref(), &reached),
                NearOutcome::NearSingularity { evidence, fraction, .. }
                | NearOutcome::Lost { evidence, fraction, .. } => {
                    self.add(evidence, before.as_ref(), &reached);
                    *fraction = (part - 1.0 + *fraction) / parts;
                }
            }
            if outcome.tracked().is_none() {
                return Ok(outcome);
            }
            (pose, before) = (reached, Some(*outcome.evidence()));
            if part >= parts {
                (self.pose, self.angles) = (pose, *angles);
                return Ok(outcome);
            }
            part += 1.0;
        }
    }

    /// Extends the evidence of a part to the whole way from the last pose.
    fn add(&self, part: &mut NearEvidence, before: Option<&NearEvidence>, reached: &Pose) {
        if let Some(before) = before {
            part.segments += before.segments;
            part.newton_steps += before.newton_steps;
            part.kantorovich = part.kantorovich.max(before.kantorovich);
        }
        let joints = self.platform.legs().iter().map(|leg| leg.platform.coords);
        let centroid = Point3::from(joints.sum::<Vector3<f64>>() / 6.0);
        part.distance = (reached.transform(&centroid) - self.pose.transform(&centroid)).norm();
        part.angle = turn_between(&self.pose.rotation, &reached.rotation).norm();
    }
}
