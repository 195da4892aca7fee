//! Parameter homotopy over linear sections of `SE(3)`, from 40 known solutions of six general sections to the solutions
//! of six leg equations. Doubly planar platforms need 20, one of each mirror pair.

// One step of the tracker has to compile to one function, or the lanes do not stay in registers.
#![allow(clippy::inline_always)]

#[cfg(test)]
mod allocation_tests;
mod dispatch;
mod endgame;
mod fast_tracker;
mod lanes;
mod lengths;
mod limits;
mod lu;
mod monodromy;
mod paths;
mod polish;
mod predictor;
mod quadrics;
mod start;
mod system;
mod tail;
mod tracker;

pub use monodromy::{GENERIC_COUNT, StartKind};
pub use start::{SHIPPED_SEED, StartError, start_system_text};

pub(crate) use endgame::projective_distance;
pub(crate) use lengths::LengthStart;
pub(crate) use paths::follow_finely;
pub use paths::{EndKind, HomotopyPath, solve_sections, unit};
pub(crate) use tail::TailEnd;
