//! Polynomials in one unknown.

mod octic;
mod roots;

pub(crate) use octic::octic_roots;
pub use roots::{RootsError, roots};
