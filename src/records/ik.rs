//! Answers of inverse kinematics: the leg lengths at given poses.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PoseRecord;

/// The answer of `ik`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum IkAnswer {
    /// Several poses were given, or a table.
    Rows(IkRowsAnswer),
    /// One pose.
    One(Box<IkRecord>),
}

/// The lengths at several poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IkRowsAnswer {
    /// In the order given.
    pub rows: Vec<IkRecord>,
}

/// The lengths at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IkRecord {
    /// The line of the table, from 1; null: no table.
    pub line: Option<usize>,
    /// The time of the row, where the table has a column of times.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The pose.
    pub pose: PoseRecord,
    /// The six lengths in leg order, design units.
    pub lengths: [f64; 6],
    /// Whether all lengths are within `leg_length`, the ends included; null: the design limits none.
    pub within_limits: Option<bool>,
    /// The legs that are too short or too long, from 1.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<usize>,
}
