//! Numbers with known errors: double-double, interval and exact arithmetic, polynomials in one unknown, decompositions
//! of small matrices, seeded random numbers, and the doors to faer and clarabel.
//!
//! It knows nothing of platforms and names no other room.
//!
//! * [`Interval`](interval::Interval): all real numbers between two doubles; every operation encloses the exact result.
//! * [`Surd`](surd::Surd): a number of a field of square roots, exactly.
//! * [`Rng`]: random numbers from a seed, a stream for each purpose.
//!
//! A number is made from a double or from a written expression, goes through the rooms above in the arithmetic that the
//! question needs, and becomes a double with a bound of its error.

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
pub mod vector_unit;

#[cfg(feature = "serde")]
pub use number::{Number, nullable};
pub use seed::Purpose;
pub use seed::Rng;
pub use stream::Cancel;
