//! Asks: one function for each question, which every door calls.
//!
//! It knows all rooms below. It computes nothing by itself: each question names the modules that answer it, with their
//! defaults.
//!
//! * [`Design`]: a platform with names, units, home pose and requirements; its methods are the questions.
//! * [`Kinematics`]: the questions that need a platform alone.
//! * [`Error`]: why a question has no answer.
//!
//! A design is read from a text, a question is put to it with its options, and the answer is a value with its evidence.

#[cfg(feature = "lab")]
pub mod bench;
#[cfg(feature = "files")]
pub mod calibrating;
#[cfg(feature = "files")]
mod comparing;
#[cfg(feature = "files")]
pub mod design;
#[cfg(feature = "files")]
pub mod driving;
#[cfg(feature = "files")]
mod equivalence;
#[cfg(feature = "files")]
pub mod equivalents;
mod error;
#[cfg(all(feature = "files", feature = "optimize"))]
pub mod exploring;
#[cfg(feature = "files")]
pub mod exporting;
#[cfg(feature = "files")]
mod file_io;
#[cfg(feature = "files")]
mod holding;
#[cfg(feature = "files")]
mod judging;
#[cfg(feature = "files")]
mod locus;
#[cfg(feature = "files")]
mod moving;
#[cfg(all(feature = "files", feature = "optimize"))]
pub mod optimizing;
#[cfg(feature = "files")]
pub mod presets;
#[cfg(feature = "files")]
mod reaching;
#[cfg(feature = "files")]
mod reaching_space;
#[cfg(feature = "files")]
mod relocating;
#[cfg(feature = "files")]
mod replaceable;
#[cfg(feature = "files")]
pub mod rounding;
#[cfg(feature = "files")]
mod self_motions;
#[cfg(feature = "files")]
mod singular_poses;
mod solving;
#[cfg(all(feature = "files", not(target_family = "wasm")))]
pub mod whole;

#[cfg(feature = "files")]
pub use comparing::{DesignFigures, FigureOptions, Separation};
#[cfg(feature = "files")]
pub use design::Design;
#[cfg(feature = "files")]
pub use equivalence::{ComparedDesigns, SAMPLES, VerifyOptions, leg_map, sample_plan, verify, verify_with};
pub use error::Error;
#[cfg(all(feature = "files", feature = "optimize"))]
pub use exploring::{
    ExploreJudgement, ExploreOptions, ExploreProgress, ExploreReport, ExploreVerdict, ExploredClass,
    ExploredDesign, LengthsOrigin, NoExploration, NoOwnPoses, OwnPoses,
};
#[cfg(feature = "files")]
pub use holding::SingularHome;
#[cfg(feature = "files")]
pub use judging::{AssessReport, BOX_CELLS, CheckReport, JudgedPoses};
#[cfg(feature = "files")]
pub use locus::{LocusOptions, LocusPoint, LocusReport, LocusWord, NoLocus, VirtualLeg};
#[cfg(feature = "files")]
pub use moving::{MotionMasses, MotionReport, PlatformMotion, StiffnessReport, TimedMargin};
#[cfg(all(feature = "files", feature = "optimize"))]
pub use optimizing::{
    Checked, ConflictFreedom, DriveOutcome, DriveRanking, DriveSearch, DrivenPlatform, EasedDemand,
    FoundFront, FoundOffsets, FoundPlatform, FreedomOutcome, FreedomWord, OpenedFreedom, OptimizeEvidence,
    OptimizeOptions, OptimizeProgress, OptimizeReport, OptimizeStatus, SearchedDrive,
};
#[cfg(feature = "files")]
pub use reaching_space::{FreeSize, FreeTurn, RAYS, WorkspaceSize};
#[cfg(feature = "files")]
pub use relocating::{MoveSearchReport, MoveWishes, MovedPlatform, SearchWord, wishes_in_words};
#[cfg(feature = "files")]
pub use replaceable::{NoPlanes, NoReplaceableLegs, ReplaceableFamily, ReplaceableLegs, ReplaceableOptions};
#[cfg(feature = "files")]
pub use self_motions::{MotionOrigin, MotionStart, NoSelfMotion, SelfMotionOptions, SelfMotionReport};
#[cfg(feature = "files")]
pub use singular_poses::{
    NoSingularPoses, PoseFigures, SignPath, SignsBetween, SingularPosesOptions, SingularPosesReport,
};
#[cfg(feature = "files")]
pub use solving::solve_angles;
pub use solving::{Batch, Kinematics, Solver, Tracker};
