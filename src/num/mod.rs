//! Seeded random numbers and the one door to faer.

pub mod linalg;
mod seed;

pub use seed::Rng;
