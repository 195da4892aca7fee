//! The questions that are put to a design with names, units and requirements.

mod assessing;
mod at_pose;
pub mod calibrating;
mod comparing;
pub mod design;
pub mod driving;
mod equivalence;
pub mod equivalents;
#[cfg(feature = "optimize")]
pub mod exploring;
pub mod exporting;
mod file_io;
mod frames;
mod holding;
mod locus;
mod moved_legs;
mod moving;
#[cfg(feature = "optimize")]
pub mod optimizing;
mod pentapod;
pub mod presets;
mod reaching;
mod reaching_space;
#[cfg(feature = "files")]
mod recognising;
mod relocating;
mod replaceable;
pub mod rounding;
mod self_motions;
mod singular_poses;
#[cfg(not(target_family = "wasm"))]
pub mod whole;

use crate::Error;

pub use assessing::{AssessReport, AssessedPoses, BOX_CELLS, CheckReport};
pub use at_pose::{
    AtPoseOptions, AtPoseReport, AxisCapacity, DrivesAt, HeldWrench, NoAtPose, StuckLeg, meets_all,
};
pub use comparing::{CrankFigures, DesignFigures, FigureOptions, Separation};
pub use design::Design;
pub use equivalence::{ComparedDesigns, SAMPLES, VerifyOptions, leg_map, sample_plan, verify, verify_with};
#[cfg(feature = "optimize")]
pub use exploring::{
    DefaultSafetyMargin, ExploreFinding, ExploreOptions, ExploreProgress, ExploreReport, ExploreVerdict,
    ExploredClass, ExploredDesign, LengthsOrigin, NoExploration, NoOwnPoses, OwnPoses,
};
pub use frames::PoseFrames;
pub use holding::SingularHome;
pub use locus::{LocusOptions, LocusPoint, LocusReport, LocusWord, NoLocus, VirtualLeg};
pub use moved_legs::{
    InvalidMove, LegMoveRequest, MoveOptions, MovedAtOnce, MovesReport, NamedFamily, NoMoves,
};
pub use moving::{MotionMasses, MotionReport, PlatformMotion, StiffnessReport, TimedMargin};
#[cfg(feature = "optimize")]
pub use optimizing::{
    Checked, ConflictFreedom, DriveOutcome, DriveRanking, DriveSearch, DrivenPlatform, FoundFront,
    FoundOffsets, FoundPlatform, FreedomOutcome, FreedomWord, OpenedFreedom, OptimizeEvidence,
    OptimizeOptions, OptimizeProgress, OptimizeReport, OptimizeStatus, RelaxedRequirement, SearchedDrive,
};
pub use pentapod::{HeldLine, PentapodReport, about_five_legs};
pub use reaching::{FreePart, StatedRange};
pub use reaching_space::{FreeSize, FreeTurn, RAYS, WorkspaceSize};
pub use relocating::{MoveSearchReport, MoveTargets, MovedPlatform, SearchWord, targets_in_words};
pub use replaceable::{NoPlanes, NoReplaceableLegs, ReplaceableFamily, ReplaceableLegs, ReplaceableOptions};
pub use self_motions::{MotionOrigin, MotionStart, NoSelfMotion, SelfMotionOptions, SelfMotionReport};
pub use singular_poses::{
    NoSingularPoses, PoseFigures, SignPath, SignsBetween, SingularPosesOptions, SingularPosesReport,
};
