//! The methods of the front page: what a user asks of a design, put together from the layers below.
//!
//! Nothing is computed here. Each question names the modules that answer it, with their defaults; the command line asks the same questions.

#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) mod calibrating;
#[cfg(all(feature = "files", feature = "synthesis"))]
mod comparing;
#[cfg(all(feature = "files", feature = "optimize"))]
pub(crate) mod drive_search;
#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) mod driving;
#[cfg(all(feature = "files", feature = "synthesis"))]
mod equivalence;
mod error;
#[cfg(feature = "files")]
pub(crate) mod exporting;
#[cfg(feature = "files")]
mod files;
#[cfg(all(feature = "files", feature = "optimize"))]
pub(crate) mod freedoms;
#[cfg(all(feature = "files", feature = "synthesis"))]
mod holding;
#[cfg(all(feature = "files", feature = "synthesis"))]
mod judging;
#[cfg(all(feature = "files", feature = "synthesis"))]
mod moving;
#[cfg(all(feature = "files", feature = "optimize"))]
pub(crate) mod optimizing;
#[cfg(all(feature = "files", feature = "optimize"))]
pub(crate) mod platform_search;
#[cfg(feature = "files")]
mod reaching;
#[cfg(all(feature = "files", feature = "synthesis"))]
mod reaching_space;
#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) mod rounding;
mod solving;
#[cfg(all(feature = "files", not(target_family = "wasm")))]
pub(crate) mod whole;

#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) use comparing::{DesignFigures, FigureOptions, Separation};
#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) use equivalence::{SAMPLES, sample_plan};
#[cfg(all(feature = "files", feature = "synthesis"))]
pub use equivalence::{VerifyOptions, leg_map, verify, verify_with};
pub use error::Error;
#[cfg(all(feature = "files", feature = "synthesis"))]
pub use holding::SingularHome;
#[cfg(all(feature = "files", feature = "synthesis"))]
pub use judging::{AssessReport, CheckReport};
#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) use judging::{BOX_CELLS, JudgedPoses};
#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) use moving::{MotionMasses, MotionReport, PlatformMotion, StiffnessReport, TimedMargin};
#[cfg(all(feature = "files", feature = "optimize"))]
pub use optimizing::{OptimizeEvidence, OptimizeOptions, OptimizeProgress, OptimizeReport, OptimizeStatus};
#[cfg(all(feature = "files", feature = "synthesis"))]
pub(crate) use reaching_space::{FreeSize, FreeTurn, RAYS, WorkspaceSize};
#[cfg(feature = "python")]
pub(crate) use solving::solve_angles;
pub use solving::{Batch, Solver, Tracker};
