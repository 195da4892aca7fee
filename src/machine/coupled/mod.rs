//! Pose tracking for machines whose drive lengths differ from the distances of their joints, with a proved error bound.
//!
//! `src/machine/requirements/coupled` describes the legs, since limits need them too. `docs/theory/joints.md` has
//! derivations and proofs.

mod proof;
#[cfg(test)]
mod tests;
mod track;

pub use crate::requirements::coupled::{CoupledLegs, DriveState, NoDriveLength};
pub use proof::PoseBound;
pub use track::{CoupledOutcome, CoupledStatus, CoupledTracker, DriveSolutionWord};
