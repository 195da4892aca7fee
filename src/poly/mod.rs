//! Polynomials in one unknown.

mod batch;
mod octic;
mod roots;

pub(crate) use batch::{Batch, LANES};
pub(crate) use octic::octic_roots;
pub use roots::{RootsError, roots};
