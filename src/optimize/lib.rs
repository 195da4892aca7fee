//! Searches for the best platform: offsets that keep the kinematics of an octahedral platform, and platforms of any
//! size under all requirements.
//!
//! It knows `num`, `platform`, `synthesis` and `machine`; it never computes poses from lengths.
//!
//! * [`OffsetProblem`](offsets::OffsetProblem): six offsets along the sides of two triangles, with their limits.
//! * [`DimensionalProblem`](dimensional::DimensionalProblem): variables, objectives and requirements.
//! * [`DimensionalOutcome`](dimensional::DimensionalOutcome): what came of a search.
//!
//! Starts are drawn, evolved and climbed by conic programs over linearised margins; what was found is judged by
//! `machine` over the whole workspace.

mod climb;
pub mod dimensional;
pub mod offsets;
