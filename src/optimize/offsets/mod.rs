//! Separates the shared joints of an octahedral platform: finds the best equivalent 6-6 platform without shared joints.
//!
//! Leg `i` of the new platform is on the line through the cyclic legs `i` and `i + 1`, at offset `t_i`. The objective
//! is the worst inverse condition number over given poses, maximised over the six offsets. Sequential convex
//! programming searches the `3^6` branches (joint before, inside or beyond its edge). Branch and bound compares the
//! result with all other offsets. Derivation and limits: `docs/theory/offset-optimisation.md`.

mod bound;
mod branch;
mod climb;
mod conditioning;
mod feasibility;
mod limits;
mod outcome;
mod problem;
mod search;
#[cfg(test)]
mod soundness_tests;
#[cfg(test)]
mod tests;
mod verdict;

pub use self::verdict::Conflict;
pub use crate::climb::HistoryStep;
pub use bound::GlobalBound;
pub use branch::{Branch, Zone};
pub use num::conic::SolverFailure;
pub use outcome::{
    BranchCounts, BranchReport, BranchVerdict, BranchWord, LocalEvidence, Margins, OffsetOutcome,
    OffsetReport, OffsetSolution, Recheck,
};
pub use problem::{
    DEFAULT_BOUNDS, DEFAULT_MIN_ABS_DET, DEFAULT_SPACING_SHARE, InvalidOffsetProblem, OffsetProblem,
};
pub use search::{OffsetProgress, OffsetSearchOptions, optimize};
