//! Numbers with known errors: double-double, interval and exact arithmetic, polynomials in one unknown, and
//! decompositions of small matrices. Also seeded random numbers and the interfaces to faer and clarabel.
//!
//! The crate is independent of platforms and of the other crates of the project.
//!
//! * [`Interval`](interval::Interval): all real numbers between two doubles; every operation encloses the exact result.
//! * [`Surd`](surd::Surd): a number of a field of square roots, exactly.
//! * [`Rng`]: random numbers from a seed, with a stream for each purpose.
//!
//! A number comes from a double or from a written expression. It passes through the modules above in the suitable
//! arithmetic, and becomes a double with an error bound.

pub mod algebraic;
pub mod ball;
pub mod batch;
pub mod complex;
#[cfg(feature = "clarabel")]
pub mod conic;
pub mod cosine;
#[cfg(feature = "faer")]
pub mod dense;
pub mod double_double;
pub mod echelon;
pub mod elimination;
pub mod exact;
#[cfg(feature = "clarabel")]
pub mod farkas;
pub mod interval;
pub mod jet;
pub mod linalg;
pub mod modular;
pub mod names;
#[cfg(feature = "serde")]
mod number;
pub mod octuple;
mod operators;
pub mod ordered;
pub mod parallel;
pub mod poly;
pub mod real;
pub mod rounding;
mod seed;
pub mod shown;
pub mod small;
pub mod smooth;
pub mod split;
pub mod stream;
pub mod surd;
pub mod vector;
pub mod vector_unit;

#[cfg(feature = "serde")]
pub use number::{Number, nullable};
pub use seed::Purpose;
pub use seed::Rng;
pub use stream::Cancel;
