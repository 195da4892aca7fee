//! Pulls the shared joints of an octahedral platform apart in the best way: finds the best equivalent 6-6 platform
//! without shared joints.
//!
//! Leg `i` of the new platform lies on the line through the cyclic legs `i` and `i + 1`, at offset `t_i`; the
//! worst case over given poses of the inverse condition number is maximised over the six offsets, by
//! sequential convex programming in the `3^6` branches (joint before, inside or beyond its edge), and compared with
//! all other offsets by branch and bound.
//! Derivation and limits: `docs/theory/offset-optimisation.md`.

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
mod soundness;
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
