//! The branches of the offsets: a zone for each, its outcome, and the bound over all of them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::platform::ZONES;
use crate::Number;
use optimize::offsets::{BranchReport, BranchVerdict, BranchWord, Conflict};

view! {
    /// A branch: one zone for each offset.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct BranchRecord {
        /// Zone of each offset: before, inside or beyond its edge.
        #[schemars(extend("pattern" = ZONES))]
        pub branch: String = b.branch.to_string(),
        /// Outcome.
        pub verdict: BranchWord = b.verdict.word(),
        /// The best objective of the branch, if it is dominated.
        pub objective: Option<Number> = own.map(|o| Number(o.0)),
        /// The offsets with this objective.
        pub offsets: Option<[Number; 6]> = own.map(|o| o.1.map(Number)),
        /// Number of searched parts.
        pub cells: usize = b.cells,
        /// Proved conflicts.
        pub conflicts: Vec<BranchConflictRecord> =
            b.conflicts.iter().map(BranchConflictRecord::from).collect(),
    }
    impl From(b: &BranchReport) {
        let own = match &b.verdict {
            BranchVerdict::Dominated { value, offsets, .. } => Some((*value, *offsets)),
            _ => None,
        };
    }
}

/// A proof that a branch or a part of it is empty.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BranchConflictRecord {
    /// A short stable code.
    #[schemars(extend("enum" = Conflict::CODES))]
    pub code: String,
    /// Proof in words, with its numbers.
    pub message: String,
}

impl From<&Conflict> for BranchConflictRecord {
    fn from(c: &Conflict) -> Self {
        Self { code: c.code().into(), message: c.to_string() }
    }
}
