//! The poses a page runs through.

use nalgebra::Vector6;
use serde::Serialize;
use std::f64::consts::TAU;

use super::session::Session;
use platform::geom::Pose;
use records::PoseRecord;

/// Number of steps between two poses of a trajectory.
const STEPS: usize = 24;
/// Number of periods of each coordinate in one round; they differ, so that the path is not a line.
const TURNS: [f64; 6] = [1.0, 2.0, 1.0, 3.0, 2.0, 1.0];
/// The share of the region that the path covers.
const SHARE: f64 = 0.9;

impl Session {
    /// The pose at the share `at` of a closed round. It follows the trajectory of the design and back, if there is one.
    /// Otherwise it follows a curve `x_k = 0.9 sin(2 pi n_k at)` through the region of poses, from home to home.
    pub(super) fn along(&self, at: f64) -> Pose {
        let at = if at.is_finite() { at.rem_euclid(1.0) } else { 0.0 };
        let space = self.design.workspace_or_default().space(&self.home);
        let steps = if space.trajectory.len() > 1 { space.along_trajectory(STEPS) } else { Vec::new() };
        let there_and_back = (1.0 - (2.0 * at - 1.0).abs()) * (steps.len() as f64 - 1.0);
        let off = |k: &usize| (*k as f64 - there_and_back).abs();
        if let Some(k) = (0..steps.len()).min_by(|a, b| off(a).total_cmp(&off(b))) {
            return steps[k];
        }
        space.pose(&Vector6::from_fn(|k, _| SHARE * (TAU * TURNS[k] * at).sin()))
    }
}

/// A pose to show.
#[derive(Debug, Serialize)]
pub(super) struct PathPose {
    pose: PoseRecord,
}

impl From<&Pose> for PathPose {
    fn from(pose: &Pose) -> Self {
        Self { pose: pose.into() }
    }
}

/// The pose at `at`.
pub(super) fn record(session: &Session, at: f64) -> PathPose {
    (&session.along(at)).into()
}
