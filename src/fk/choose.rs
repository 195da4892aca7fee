//! Chooses the method that solves a problem.

use super::{
    FkError, FkOptions, FkSolutions, ForwardKinematics, Homotopy, Method, NeedsStart, Octic, PreparedDesign,
    Trilateration,
};
#[cfg(feature = "lab")]
use super::{Sylvester, Template};
use crate::manipulator::{Manipulator, SquaredLegLengths};

/// The solver for a method by name, or for `None` the automatic choice.
#[must_use]
pub fn solver(method: Option<Method>) -> Box<dyn ForwardKinematics> {
    match method {
        None => Box::new(Automatic),
        Some(Method::Octic) => Box::new(Octic),
        Some(Method::Homotopy) => Box::new(Homotopy),
        Some(Method::Near) => Box::new(NeedsStart),
        #[cfg(feature = "lab")]
        Some(Method::Sylvester) => Box::new(Sylvester),
        #[cfg(feature = "lab")]
        Some(Method::Template) => Box::new(Template),
        Some(Method::Trilateration) => Box::new(Trilateration::default()),
    }
}

/// The octic where it applies and accounts for all sixteen poses, otherwise the homotopy.
///
/// The result names the method that was used.
#[derive(Debug, Clone, Copy, Default)]
pub struct Automatic;

impl ForwardKinematics for Automatic {
    fn method(&self) -> Method {
        Method::Homotopy
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        match Octic.solve(m, s, o) {
            Ok(found) if found.all_accounted() => Ok(found),
            _ => Homotopy.solve(m, s, o),
        }
    }

    fn prepare(&self, m: &Manipulator, o: &FkOptions) -> Option<Box<dyn PreparedDesign>> {
        let Some(octic) = Octic.prepare(m, o) else { return Homotopy.prepare(m, o) };
        Some(Box::new(PreparedAutomatic { octic, manipulator: m.clone() }))
    }
}

/// [`Automatic`] for an octahedral design.
struct PreparedAutomatic {
    octic: Box<dyn PreparedDesign>,
    manipulator: Manipulator,
}

impl PreparedDesign for PreparedAutomatic {
    fn solve(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        match self.octic.solve(s, o) {
            Ok(found) if found.all_accounted() => Ok(found),
            _ => Homotopy.solve(&self.manipulator, s, o),
        }
    }
}
