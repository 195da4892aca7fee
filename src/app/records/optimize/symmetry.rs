//! The symmetry of a design that names none.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use machine::requirements::StartSymmetry;

/// The search result for the three-fold symmetry that a design has at home and does not require.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SymmetryRecord {
    /// Result.
    pub three_fold: StartSymmetry,
    /// Reason, and how to switch it off, in one sentence.
    pub message: String,
}

impl From<StartSymmetry> for SymmetryRecord {
    fn from(s: StartSymmetry) -> Self {
        Self { three_fold: s, message: s.message().to_owned() }
    }
}
