//! Answers of `optimize`.

mod conflict;
mod dimensional;
mod drive;
mod freedom;
mod front;
mod offsets;
mod symmetry;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::conflict::{ConflictRecord, DemandWord, GiveRecord, SpecialDemand};
pub use self::dimensional::{
    DimensionalAnswer, DimensionalSolutionRecord, DimensionalStatus, DimensionalStepRecord, HeldPosesRecord,
    JointAxesRecord, NearestPlatformRecord, ObjectiveRecord, OptimumRecord, SearchRecord, StationarityRecord,
    VariableRecord, VerifiedRecord,
};
pub use self::drive::{DriveSearchRecord, DriveSearchWord, SearchedDriveRecord};
pub use self::freedom::{FreedomRecord, FreedomWord};
pub use self::front::{FrontAnswer, FrontMemberRecord, FrontStatus};
pub use self::offsets::{
    BranchConflictRecord, BranchCountsRecord, BranchRecord, BranchWord, GlobalBoundRecord,
    LocalOptimalityRecord, OffsetLimitsRecord, OffsetMarginsRecord, OffsetSolutionRecord, OffsetStepRecord,
    OffsetsAnswer, OffsetsFound, OffsetsStatus, PoseSetRecord, WorstPoseRecord,
};
pub use self::symmetry::{SymmetryRecord, SymmetryWord};

/// What is known of platforms better than the one found: the word `optimal` of a status means one or the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OptimalityWord {
    /// No platform that could be chosen exceeds it by more than the tolerance: proved by branch and bound.
    ProvedWithinGap,
    /// It is a local optimum, the best of all starts; that there is none better is not proved.
    BestOfStarts,
}

/// The answer of `optimize`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum OptimizeAnswer {
    /// mode = "pareto".
    Front(FrontAnswer),
    /// Offsets of an octahedral design.
    Offsets(Box<OffsetsAnswer>),
    /// A design that asks for more.
    Dimensional(Box<DimensionalAnswer>),
}
