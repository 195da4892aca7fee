//! Polynomials in one unknown: their roots in floating point, and exact arithmetic on those with integer coefficients.

mod integer;
mod octic;
mod roots;

pub use integer::{
    ComplexRoot, Dyadic, IntPoly, NotSeparated, RealRoot, SquarefreeFactor, complex_roots, gcd, real_roots,
    squarefree_factors, sturm_count,
};
pub use octic::{octic_roots, repulsion, roots_in_lanes};
pub use roots::approximate_roots;
pub use roots::{RootsError, roots};
