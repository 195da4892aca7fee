//! What became of the symmetry of a design that names none.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use machine::requirements::StartSymmetry;

/// What became of the three-fold symmetry that a design has at home and does not ask for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SymmetryRecord {
    /// What became of it.
    pub three_fold: SymmetryWord,
    /// One sentence: why, and how it is turned off.
    pub message: String,
}

/// What became of a symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SymmetryWord {
    /// The answer has it.
    Kept,
    /// With it nothing was found that is proved to meet the requirements: the answer is of a search without it.
    GivenUp,
}

impl From<StartSymmetry> for SymmetryRecord {
    fn from(s: StartSymmetry) -> Self {
        let three_fold = match s {
            StartSymmetry::Kept => SymmetryWord::Kept,
            StartSymmetry::GivenUp => SymmetryWord::GivenUp,
        };
        Self { three_fold, message: s.message().to_owned() }
    }
}
