//! Conditioning over all poses of the workspace.

use serde_json::{Value, json};

use super::request::Refusal;
use super::session::{Equivalent, Session};
use super::wire::{number, pose};
use crate::design::Design;
use crate::geom::Pose;
use crate::manipulator::{inverse_condition, jacobian};

impl Session {
    /// `sigma_min / sigma_max` of the length-normalised Jacobian.
    pub(super) fn inverse_condition(&self, design: &Design, pose: &Pose) -> f64 {
        inverse_condition(&jacobian(design.manipulator(), pose, self.characteristic_length))
    }

    fn worst(&self, design: &Design, poses: &[Pose]) -> Value {
        let values = poses.iter().map(|p| (self.inverse_condition(design, p), p));
        values
            .min_by(|x, y| x.0.total_cmp(&y.0))
            .map_or(Value::Null, |(value, p)| json!({"inverse_condition": number(value), "pose": pose(p)}))
    }
}

/// The least inverse condition number of both platforms and the pose where it is reached.
pub(super) fn record(session: &Session, e: Option<&Equivalent>) -> Result<Value, Refusal> {
    let poses = session.judged();
    let second = match e {
        Some(e) => session.worst(&session.second(e)?.0, &poses),
        None => Value::Null,
    };
    Ok(json!({"poses": poses.len(), "first": session.worst(session.first(), &poses), "second": second}))
}
