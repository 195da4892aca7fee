//! Searches for the best platform: offsets with the kinematics of an octahedral platform, and platforms of any size
//! under all requirements.
//!
//! The crate uses `num`, `platform`, `synthesis` and `machine`; it never computes poses from lengths.
//!
//! * [`OffsetProblem`](offsets::OffsetProblem): six offsets along the sides of two triangles, with their limits.
//! * [`DimensionalProblem`](dimensional::DimensionalProblem): variables, objectives and requirements.
//! * [`DimensionalOutcome`](dimensional::DimensionalOutcome): the result of a search.
//!
//! Starts are drawn, evolved and climbed by conic programs over linearised margins; `machine` judges the results over
//! the whole workspace.

mod climb;
pub mod dimensional;
pub mod offsets;
