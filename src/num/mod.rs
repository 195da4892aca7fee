//! Seeded random numbers, double-double, interval and exact rational arithmetic, and the one door to faer.

pub(crate) mod batch;
pub mod disc;
pub mod double_double;
pub(crate) mod exact;
pub mod interval;
pub mod linalg;
pub(crate) mod modular;
mod seed;

pub use seed::Rng;
