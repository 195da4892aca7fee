//! Answers of `explore` and the files of its folder.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SolvedRecord;

/// A file of the folder: the answer of a command with what the run was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunRecord<T> {
    /// The version of the program.
    pub version: String,
    /// The seed of the run; absent where the answer has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// The answer.
    #[serde(flatten)]
    pub answer: T,
}

/// The poses of the original, with the lengths they belong to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FkRunRecord {
    /// Leg lengths, design units.
    pub lengths: [f64; 6],
    /// Where the lengths come from: the design, or its home pose.
    pub lengths_from: String,
    /// The poses.
    #[serde(flatten)]
    pub solved: SolvedRecord,
}
