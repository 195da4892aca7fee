//! Choice of a method for a manipulator.

use super::{FkError, ForwardKinematics, Method};
use crate::manipulator::Manipulator;

/// The solver for `method`, or the best one for `m` when `method` is `None`.
///
/// # Errors
/// [`FkError::NotApplicable`] when the method cannot take this manipulator.
pub fn solver(method: Option<Method>, _m: &Manipulator) -> Result<Box<dyn ForwardKinematics>, FkError> {
    let method = method.unwrap_or(Method::Homotopy);
    Err(FkError::NotApplicable { method, reason: "it is not part of this version".into() })
}
