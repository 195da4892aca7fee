//! Certificates: every reference root has one, nothing else does.

mod as_given;
mod close_roots;
mod false_roots;
mod laws;
mod reference_roots;
mod support;
