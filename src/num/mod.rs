//! Seeded random numbers, double-double and interval arithmetic, and the one door to faer.

pub mod disc;
pub mod double_double;
pub mod interval;
pub mod linalg;
mod seed;

pub use seed::Rng;
