//! Conditioning over all poses of the workspace.

use std::borrow::Cow;

use serde::Serialize;

use super::request::Refusal;
use super::session::{Equivalent, Session};
use ask::Design;
use platform::geom::Pose;
use platform::manipulator::{Manipulator, inverse_condition, jacobian};
use records::PoseRecord;

/// The worst conditioning of the platforms.
#[derive(Debug, Serialize)]
pub(super) struct WorstRecord {
    /// Number of poses evaluated.
    poses: usize,
    first: Option<LeastRecord>,
    second: Option<LeastRecord>,
}

/// The least inverse condition number of a platform, with its pose.
#[derive(Debug, Serialize)]
struct LeastRecord {
    inverse_condition: f64,
    pose: PoseRecord,
}

impl Session {
    /// `sigma_min / sigma_max` of the length-normalised Jacobian of the legs, or of the rods; 0 if a rod does not
    /// reach.
    pub(super) fn inverse_condition(&self, design: &Design, pose: &Pose) -> f64 {
        self.pushing(design, pose)
            .map_or(0.0, |m| inverse_condition(&jacobian(&m, pose, design.characteristic_length())))
    }

    /// The legs that act on the platform at a pose: legs of the design, or rods on the tips of its cranks. `None` if a
    /// rod does not reach.
    pub(super) fn pushing<'a>(&self, design: &'a Design, pose: &Pose) -> Option<Cow<'a, Manipulator>> {
        match &self.cranks {
            None => Some(Cow::Borrowed(design.manipulator())),
            Some(platform) => platform.at(&platform.ik(pose).ok()?).ok().map(Cow::Owned),
        }
    }

    fn worst(&self, design: &Design, poses: &[Pose]) -> Option<LeastRecord> {
        let values = poses.iter().map(|p| (self.inverse_condition(design, p), p));
        let least = values.min_by(|x, y| x.0.total_cmp(&y.0));
        least.map(|(inverse_condition, p)| LeastRecord { inverse_condition, pose: p.into() })
    }
}

/// The least inverse condition number of both platforms, with its pose.
pub(super) fn record(session: &Session, e: Option<&Equivalent>) -> Result<WorstRecord, Refusal> {
    let poses = session.assessed_poses();
    let second = match e {
        Some(e) => session.worst(&session.second(e)?.0, &poses),
        None => None,
    };
    Ok(WorstRecord { poses: poses.len(), first: session.worst(session.first(), &poses), second })
}
