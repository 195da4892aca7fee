//! Poses of machines whose drives are not as long as the distances of their joints: followed from one to the next, with
//! a proved bound of the error.
//!
//! What a leg is like is in `src/machine/requirements/coupled`, since limits are about it too. `docs/theory/joints.md`
//! has derivations and proofs.

mod proof;
#[cfg(test)]
mod tests;
mod track;

pub use crate::requirements::coupled::{CoupledLegs, DriveState, NoDriveLength};
pub use proof::PoseBound;
pub use track::{CoupledOutcome, CoupledStatus, CoupledTracker, DriveSolutionWord};
