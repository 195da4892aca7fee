//! Finds poses from distances alone, without unknown rotations: trilateration, closure conditions.
//!
//! With shared joints, a few additional distances between the bodies (virtual legs) make every joint reachable by
//! trilateration. As many known distances remain: these closures determine the additional ones. Theory:
//! `docs/theory/trilateration.md`. Source: Porta, Thomas, *Yet another approach to the Gough-Stewart platform forward
//! kinematics*.

mod exact;
mod hidden;
mod numeric;
mod plan;

pub use exact::{
    ClosureDegrees, ClosureError, ClosurePolynomial, SingularFactor, closure_degrees, closure_polynomial,
    generic_degrees,
};
pub use hidden::{HiddenLengths, HiddenPoses};
pub use numeric::{Configuration, Configurations, Evaluator, GenericDegrees};
pub use plan::{NoPlan, fit, plans};
