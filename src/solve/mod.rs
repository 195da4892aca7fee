//! Tools for systems of equations.

pub mod certify;
