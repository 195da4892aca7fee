//! The branches of the offsets: a zone for each, what became of it, and the bound over all of them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::platform::ZONES;
use crate::Number;
use optimize::offsets::{BranchReport, BranchVerdict, Conflict};

/// A branch: a zone for each offset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BranchRecord {
    /// Zone of each offset: before, inside, beyond its edge.
    #[schemars(extend("pattern" = ZONES))]
    pub branch: String,
    /// What became of it.
    pub verdict: BranchWord,
    /// Its own best, where it is dominated.
    pub objective: Option<Number>,
    /// Where that is reached.
    pub offsets: Option<[Number; 6]>,
    /// Parts of the branch searched.
    pub cells: usize,
    /// Proved conflicts of the branch or of parts of it.
    pub conflicts: Vec<BranchConflictRecord>,
}

/// What became of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BranchWord {
    /// It holds the best solution.
    Best,
    /// It is feasible, and does not reach the best value.
    Dominated,
    /// No feasible point was looked for: the bound over all offsets covers it.
    Bounded,
    /// It is proved empty.
    Infeasible,
    /// No feasible point was found.
    Unproved,
    /// No feasible point was found because the conic solver failed.
    SolverFailure,
}

impl From<&BranchReport> for BranchRecord {
    fn from(b: &BranchReport) -> Self {
        let (verdict, own) = match &b.verdict {
            BranchVerdict::Best => (BranchWord::Best, None),
            BranchVerdict::Dominated { value, offsets, .. } => {
                (BranchWord::Dominated, Some((*value, *offsets)))
            }
            BranchVerdict::Bounded => (BranchWord::Bounded, None),
            BranchVerdict::Infeasible => (BranchWord::Infeasible, None),
            BranchVerdict::Unproved => (BranchWord::Unproved, None),
            BranchVerdict::SolverFailure(_) => (BranchWord::SolverFailure, None),
        };
        Self {
            branch: b.branch.to_string(),
            verdict,
            objective: own.map(|o| Number(o.0)),
            offsets: own.map(|o| o.1.map(Number)),
            cells: b.cells,
            conflicts: b.conflicts.iter().map(BranchConflictRecord::from).collect(),
        }
    }
}

/// Why a branch or a part of it is empty.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BranchConflictRecord {
    /// A short stable code.
    #[schemars(extend("enum" = Conflict::CODES))]
    pub code: String,
    /// One sentence with the numbers.
    pub message: String,
}

impl From<&Conflict> for BranchConflictRecord {
    fn from(c: &Conflict) -> Self {
        Self { code: c.code().into(), message: c.to_string() }
    }
}
