//! Chooses the method that solves a problem.

use std::sync::OnceLock;

use super::bounds::class_bound;
use super::trilateration::{Evaluation, Prepared as PreparedTrilateration};
use super::{
    FkError, FkOptions, FkSolutions, ForwardKinematics, Homotopy, Method, NeedsStart, Octic, OcticSolver,
    PreparedDesign, SolutionSet, Trilateration,
};
#[cfg(feature = "lab")]
use super::{Sylvester, Template};
use platform::manipulator::{Manipulator, SquaredLegLengths};

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

/// The fastest method that applies and accounts for all poses: the octic, trilateration for designs with few poses,
/// otherwise the homotopy.
///
/// The result names the method that was used.
#[derive(Debug, Clone, Copy, Default)]
pub struct Automatic;

/// Designs with more poses take the homotopy no longer than trilateration, whose sequences are worked out first.
const FEW_POSES: usize = 16;
/// The same limit for prepared designs.
const PREPARED_POSES: usize = 24;

impl ForwardKinematics for Automatic {
    fn method(&self) -> Method {
        Method::Homotopy
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        match Octic.solve(m, s, o) {
            Ok(found) if found.is_complete() => return Ok(found),
            Ok(_) => return Homotopy.solve(m, s, o),
            Err(_) => {}
        }
        // bounding the poses of the class takes longer than the octic
        if class_bound(m).is_none_or(|t| t.bound() > FEW_POSES) {
            return Homotopy.solve(m, s, o);
        }
        let evaluated = match Trilateration::default().evaluate(m, s, o).map(Evaluation::proved) {
            Ok(Ok(found)) => return Ok(found),
            Ok(Err(unproved)) => Some(unproved),
            Err(_) => None,
        };
        let found = Homotopy.solve(m, s, o)?;
        if found.is_complete() || found.solution_set != SolutionSet::Isolated {
            return Ok(found);
        }
        // the exact polynomial may take many times as long as the paths
        let exact = evaluated.and_then(|e| e.finished(m, s, o).ok()).filter(FkSolutions::is_complete);
        Ok(exact.unwrap_or(found))
    }

    fn prepare(&self, m: &Manipulator, o: &FkOptions) -> Option<Box<dyn PreparedDesign>> {
        let few = || class_bound(m).is_some_and(|t| t.bound() <= PREPARED_POSES);
        let by_trilateration = || {
            if few() { Trilateration::default().prepared(m).ok().map(Box::new) } else { None }
        };
        let by_octic = OcticSolver::new(m).ok().map(|solver| QuickDesign::Octic(Box::new(solver)));
        let by_distances = by_octic.or_else(|| Some(QuickDesign::Trilateration(by_trilateration()?)));
        let Some(quick) = by_distances else { return Homotopy.prepare(m, o) };
        let paths = OnceLock::new();
        Some(Box::new(PreparedAutomatic { quick, manipulator: m.clone(), options: *o, paths }))
    }
}

/// The methods that are tried before paths.
enum QuickDesign {
    Octic(Box<OcticSolver>),
    Trilateration(Box<PreparedTrilateration>),
}

/// [`Automatic`] for a design that the octic or trilateration applies to.
struct PreparedAutomatic {
    quick: QuickDesign,
    manipulator: Manipulator,
    /// The options of the preparation.
    options: FkOptions,
    /// The homotopy, prepared for the first lengths that need it.
    paths: OnceLock<Option<Box<dyn PreparedDesign>>>,
}

impl PreparedDesign for PreparedAutomatic {
    fn solve(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        // the general treatment, and counting poses, take longer than the paths of the prepared design
        let proved = match &self.quick {
            QuickDesign::Octic(solver) => solver.proved(s, o.seed),
            QuickDesign::Trilateration(design) => design.proved(s, o),
        };
        if let Some(found) = proved {
            return Ok(found);
        }
        let prepare = || Homotopy.prepare(&self.manipulator, &self.options);
        match self.paths.get_or_init(prepare) {
            Some(paths) => paths.solve(s, o),
            None => Homotopy.solve(&self.manipulator, s, o),
        }
    }
}
