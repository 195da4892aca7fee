//! Polynomials in one unknown: their roots in floating point, and exact arithmetic on those with integer coefficients.

mod field;
mod integer;
mod octic;
mod roots;

pub use field::{EnclosedRoot, FieldPoly, RootCount, without_common_factor};
pub use integer::{
    ComplexRoot, Dyadic, IntPoly, NotSeparated, RealRoot, SquarefreeFactor, complex_roots, gcd, real_roots,
    squarefree_factors, sturm_count, sturm_count_of_line,
};
pub use octic::{octic_roots, repulsion, roots_in_lanes};
pub use roots::{RootsError, approximate_roots, newton_quotients, roots};
