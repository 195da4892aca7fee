//! Polynomials in one unknown.

mod roots;

pub use roots::{RootsError, roots};
