//! What became of the symmetry of a design that names none.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use machine::requirements::StartSymmetry;

/// What became of the three-fold symmetry that a design has at home and does not ask for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SymmetryRecord {
    /// What became of it.
    pub three_fold: StartSymmetry,
    /// One sentence: why, and how it is turned off.
    pub message: String,
}

impl From<StartSymmetry> for SymmetryRecord {
    fn from(s: StartSymmetry) -> Self {
        Self { three_fold: s, message: s.message().to_owned() }
    }
}
