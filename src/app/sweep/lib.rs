//! Sweeps: many designs from a plan, computed one by one, as rows of a table.
//!
//! A plan ([`plan`]) names a base design, its free quantities, the computed results and the conditions on rows.
//! Candidate `k` depends only on plan, seed and `k` (`sample`). A table may thus be computed in any parts, on any
//! machines, in any order. A [`Sweep`] computes rows; [`part`] writes them as Parquet and reads them back. The command
//! line handles files and folders.

#![allow(
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    reason = "numbers of candidates stay below 2^53, and what is cast to them is a share of their number"
)]

mod candidate;
mod climb;
mod column;
mod digest;
mod evaluate;
pub mod part;
pub mod plan;
mod rows;
mod sample;
#[cfg(test)]
mod tests;

pub use column::{ColumnKind, SweepCell, SweepColumn};
pub use digest::{Digested, digest_of};
pub use evaluate::Sweep;
pub use rows::{RowChunk, SweepRow, shard_range};
