//! Requirements of a machine with their margins and proofs, drives, limits, motion, tolerances and calibration.
//!
//! It depends on `num`, `platform`, `fk`, `synthesis` and `verify`, and reads no files.
//!
//! * [`Requirements`](requirements::Requirements): the requirements of a platform, with the poses for which they hold.
//! * [`Terms`](requirements::Terms): the margins of all requirements at a pose.
//! * [`MarginProof`](requirements::MarginProof): their proved bounds over a workspace.
//!
//! Requirements of a manipulator become margins at poses. A search finds the worst pose, and interval arithmetic proves
//! that no pose is worse.

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
