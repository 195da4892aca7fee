//! Numbers and poses in the JSON of the page.

use nalgebra::{Matrix3, Vector3};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::geom::{Pose, nearest_rotation};

/// A pose as the page sends it: rows of `R`, and `p` in design units.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub(super) struct PoseRecord {
    #[serde(rename = "R")]
    rotation: [[f64; 3]; 3],
    p: [f64; 3],
}

impl From<&PoseRecord> for Pose {
    fn from(record: &PoseRecord) -> Self {
        let rows = Matrix3::from_fn(|i, j| record.rotation[i][j]);
        Self { rotation: nearest_rotation(&rows), position: Vector3::from(record.p) }
    }
}

/// A pose as the page gets it.
pub(super) fn pose(p: &Pose) -> Value {
    let rows: Value = (0..3).map(|i| numbers((0..3).map(|j| p.rotation[(i, j)]))).collect();
    json!({"R": rows, "p": numbers(p.position.iter().copied())})
}

/// `null` where a number is not finite.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> Value {
    values.into_iter().map(number).collect()
}

/// `null` where the number is not finite.
pub(super) fn number(x: f64) -> Value {
    serde_json::Number::from_f64(x).map_or(Value::Null, Value::Number)
}
