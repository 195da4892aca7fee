//! Errors of poses and how they spread.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Number;
use machine::manufacture::{ErrorSpread, Quantiles};

/// How values spread.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct QuantilesRecord {
    /// Half of the values is at most this.
    pub median: Number,
    /// 90 of a hundred.
    pub p90: Number,
    /// 99 of a hundred.
    pub p99: Number,
    /// All.
    pub max: Number,
}

impl From<&Quantiles> for QuantilesRecord {
    fn from(q: &Quantiles) -> Self {
        Self { median: Number(q.median), p90: Number(q.p90), p99: Number(q.p99), max: Number(q.max) }
    }
}

/// How the errors of poses spread.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseErrorsRecord {
    /// Of the tool point, design units.
    pub position: QuantilesRecord,
    /// Of the orientation.
    pub rotation_deg: QuantilesRecord,
}

impl From<&ErrorSpread> for PoseErrorsRecord {
    fn from(s: &ErrorSpread) -> Self {
        Self { position: (&s.position).into(), rotation_deg: (&s.rotation_deg).into() }
    }
}

/// The error of a pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseErrorRecord {
    /// Of the tool point, design units.
    pub position: Number,
    /// Of the orientation.
    pub rotation_deg: Number,
}

impl From<(f64, f64)> for PoseErrorRecord {
    fn from((position, rotation_deg): (f64, f64)) -> Self {
        Self { position: Number(position), rotation_deg: Number(rotation_deg) }
    }
}
