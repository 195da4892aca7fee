//! The methods of the front page: what a user asks of a design, put together from the layers below.
//!
//! Nothing is computed here. Each question names the modules that answer it, with their defaults; the command line asks the same questions.

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
#[cfg(feature = "files")]
pub mod exporting;
#[cfg(feature = "files")]
mod file_io;
#[cfg(feature = "files")]
mod holding;
#[cfg(feature = "files")]
mod judging;
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
pub mod rounding;
mod solving;
#[cfg(all(feature = "files", not(target_family = "wasm")))]
pub mod whole;

#[cfg(feature = "files")]
pub use comparing::{DesignFigures, FigureOptions, Separation};
#[cfg(feature = "files")]
pub use design::Design;
#[cfg(feature = "files")]
pub use equivalence::{SAMPLES, sample_plan};
#[cfg(feature = "files")]
pub use equivalence::{VerifyOptions, leg_map, verify, verify_with};
pub use error::Error;
#[cfg(feature = "files")]
pub use holding::SingularHome;
#[cfg(feature = "files")]
pub use judging::{AssessReport, CheckReport};
#[cfg(feature = "files")]
pub use judging::{BOX_CELLS, JudgedPoses};
#[cfg(feature = "files")]
pub use moving::{MotionMasses, MotionReport, PlatformMotion, StiffnessReport, TimedMargin};
#[cfg(all(feature = "files", feature = "optimize"))]
pub use optimizing::{
    Checked, ConflictFreedom, DriveOutcome, DriveRanking, DriveSearch, DrivenPlatform, EasedDemand,
    FoundFront, FoundOffsets, FoundPlatform, FreedomOutcome, OpenedFreedom, OptimizeEvidence,
    OptimizeOptions, OptimizeProgress, OptimizeReport, OptimizeStatus, SearchedDrive,
};
#[cfg(feature = "files")]
pub use reaching_space::{FreeSize, FreeTurn, RAYS, WorkspaceSize};
#[cfg(feature = "files")]
pub use solving::solve_angles;
pub use solving::{Batch, Kinematics, Solver, Tracker};
