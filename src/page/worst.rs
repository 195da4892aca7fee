//! Conditioning over all poses of the workspace.

use serde::Serialize;

use super::request::Refusal;
use super::session::{Equivalent, Session};
use crate::design::Design;
use crate::geom::Pose;
use crate::manipulator::{inverse_condition, jacobian};
use crate::records::PoseRecord;

/// The worst conditioning of the platforms.
#[derive(Debug, Serialize)]
pub(super) struct WorstRecord {
    /// How many poses were looked at.
    poses: usize,
    first: Option<LeastRecord>,
    second: Option<LeastRecord>,
}

/// The least inverse condition number of a platform and where it is reached.
#[derive(Debug, Serialize)]
struct LeastRecord {
    inverse_condition: f64,
    pose: PoseRecord,
}

impl Session {
    /// `sigma_min / sigma_max` of the length-normalised Jacobian.
    pub(super) fn inverse_condition(design: &Design, pose: &Pose) -> f64 {
        inverse_condition(&jacobian(design.manipulator(), pose, design.characteristic_length()))
    }

    fn worst(design: &Design, poses: &[Pose]) -> Option<LeastRecord> {
        let values = poses.iter().map(|p| (Self::inverse_condition(design, p), p));
        let least = values.min_by(|x, y| x.0.total_cmp(&y.0));
        least.map(|(inverse_condition, p)| LeastRecord { inverse_condition, pose: p.into() })
    }
}

/// The least inverse condition number of both platforms and the pose where it is reached.
pub(super) fn record(session: &Session, e: Option<&Equivalent>) -> Result<WorstRecord, Refusal> {
    let poses = session.judged();
    let second = match e {
        Some(e) => Session::worst(&session.second(e)?.0, &poses),
        None => None,
    };
    Ok(WorstRecord { poses: poses.len(), first: Session::worst(session.first(), &poses), second })
}
