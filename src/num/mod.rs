//! Numbers with known errors: double-double, interval and exact arithmetic, polynomials in one unknown, decompositions of small matrices, seeded random numbers, and the doors to faer and clarabel.
//!
//! It knows nothing of platforms and names no other room.
//!
//! * [`Interval`](interval::Interval): all real numbers between two doubles; every operation encloses the exact result.
//! * [`Surd`](surd::Surd): a number of a field of square roots, exactly.
//! * [`Rng`]: random numbers from a seed, a stream for each purpose.
//!
//! A number is made from a double or from a written expression, goes through the rooms above in the arithmetic that the question needs, and becomes a double with a bound of its error.

pub(crate) mod algebraic;
pub mod ball;
pub(crate) mod batch;
pub mod complex;
#[cfg(feature = "optimize")]
pub(crate) mod conic;
#[cfg_attr(
    not(feature = "files"),
    allow(dead_code, reason = "without design files exact numbers are doubles")
)]
pub(crate) mod cosine;
#[cfg(feature = "lab")]
pub mod dense;
pub mod double_double;
pub(crate) mod echelon;
pub(crate) mod exact;
#[cfg(feature = "optimize")]
pub(crate) mod farkas;
pub mod interval;
pub(crate) mod jet;
#[cfg(any(feature = "lab", feature = "synthesis"))]
pub mod linalg;
pub(crate) mod modular;
pub(crate) mod names;
pub(crate) mod octuple;
pub(crate) mod parallel;
pub(crate) mod poly;
#[cfg(feature = "files")]
pub(crate) mod real;
pub mod rounding;
mod seed;
#[cfg(feature = "files")]
pub(crate) mod shown;
pub(crate) mod small;
pub(crate) mod split;
pub(crate) mod stream;
#[cfg_attr(
    not(feature = "files"),
    allow(dead_code, reason = "without design files exact numbers are doubles")
)]
pub(crate) mod surd;
pub(crate) mod vector_unit;

pub(crate) use seed::Purpose;
pub use seed::Rng;
pub use stream::Cancel;
