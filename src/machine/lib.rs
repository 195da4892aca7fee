//! Says what a built machine can do: requirements with their margins and proofs, drives, limits, motion, tolerances,
//! calibration.
//!
//! It knows `num`, `platform`, `fk` and, where tolerances ask whether two platforms are equivalent, `verify`; it reads
//! no files.
//!
//! * [`Requirements`](requirements::Requirements): what is asked of a platform, with the poses for which it is asked.
//! * [`Terms`](requirements::Terms): the margins of all requirements at a pose.
//! * [`MarginProof`](requirements::MarginProof): what is proved of them over a workspace.
//!
//! A manipulator with its requirements becomes margins at poses; a search looks for the worst pose and interval
//! arithmetic proves that there is no worse one.

pub mod calibration;
pub mod coupled;
pub mod dynamics;
#[cfg(test)]
#[path = "../platform/manipulator/fixtures.rs"]
mod fixtures;
pub mod manufacture;
pub mod reach;
pub mod requirements;
pub mod rotary;
pub mod statics;
