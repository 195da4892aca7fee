//! The search for platforms under the requirements of a design. A three-fold symmetry that the design has and does not
//! name is kept first, and dropped if no symmetric platform meets the requirements.

use std::ops::ControlFlow;

use super::super::Error;
use super::OptimizeStatus;
use super::assessed::{Assessing, Checked, checked, dimensional_status};
use super::problem::dimensional_problem;
use crate::Design;
use machine::manufacture::holes_turn;
use machine::requirements::{KeptSymmetry, StartSymmetry};
use optimize::dimensional::{
    DimensionalOutcome, DimensionalProblem, DimensionalReport, DimensionalSolution, ParetoReport, Progress,
    ShapeSearchOptions, Triangles, optimize, optimize_without_conflict, pareto,
};
use platform::manipulator::{Body, Octahedral};
use verify::VerifyError;

/// Whether the search keeps the three-fold symmetry of a design that names none. The design must have it at home, and
/// the stated holes must share it. The variables of `free`, the problem without it, must be able to break it.
pub(super) fn keeps_symmetry_of_start(
    design: &Design,
    free: &DimensionalProblem,
) -> Option<DimensionalProblem> {
    let v = &free.variables;
    let could_break = v.offsets && !v.symmetric || v.triangles == Triangles::Shapes;
    if design.search.symmetry.is_some() || !could_break {
        return None;
    }
    let mut kept = free.clone();
    kept.variables.symmetry = KeptSymmetry::ThreeFold;
    kept.validate().ok()?;
    if let Some(grids) = &design.holes {
        let octahedral = Octahedral::recognise(&free.manipulator).ok()?;
        let (corners, size) = ([octahedral.base(), octahedral.platform()], free.manipulator.size());
        let turns = |body: Body| holes_turn(&corners[body.index()], grids[body.index()].as_ref(), size);
        if !Body::BOTH.into_iter().all(turns) {
            return None;
        }
    }
    Some(kept)
}

/// The result of a search under requirements, assessed independently of the search code.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FoundPlatform {
    /// The problem of the answer.
    pub problem: DimensionalProblem,
    /// The search.
    pub report: DimensionalReport,
    /// The platform found.
    pub checked: Option<Checked>,
    /// The platform with the least violation, if none meets the requirements.
    pub nearest: Option<Checked>,
    /// The result for the symmetry, if the design has one and names none.
    pub symmetry: Option<StartSymmetry>,
}

impl FoundPlatform {
    fn assessed(
        design: &Design,
        problem: DimensionalProblem,
        report: DimensionalReport,
        symmetry: Option<StartSymmetry>,
        assessing: Assessing,
    ) -> Result<Self, VerifyError> {
        let of = |s: &DimensionalSolution| checked(design, &problem, s, assessing);
        let found = report.solution().map(of).transpose()?;
        let nearest = report.nearest.as_deref().map(of).transpose()?;
        Ok(Self { checked: found, nearest, problem, report, symmetry })
    }

    /// The status of the search.
    #[must_use]
    pub fn status(&self) -> OptimizeStatus {
        dimensional_status(&self.report, self.checked.as_ref())
    }

    /// Whether the platform found is proved to meet all requirements with their safety margins.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.checked.as_ref().and_then(Checked::met) == Some(true)
    }

    /// The rank of the result: a platform that meets the requirements, an unproved one, one that violates some, none.
    pub fn rank(&self) -> u8 {
        match self.checked.as_ref().map(Checked::met) {
            Some(Some(true)) => 3,
            Some(None) => 2,
            Some(Some(false)) => 1,
            None => 0,
        }
    }
}

/// Searches for the best platform of a design under its requirements, with its symmetry if the search keeps it unasked.
/// With `explains`, a failed search is followed by a search for a conflict.
///
/// # Errors
/// An invalid problem, or a platform that cannot be compared with the design.
pub(crate) fn find_platform(
    design: &Design,
    extension: f64,
    options: &ShapeSearchOptions,
    explains: bool,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<FoundPlatform, Error> {
    let free = dimensional_problem(design, extension);
    let search = |problem: &DimensionalProblem, progress: &mut dyn FnMut(Progress) -> ControlFlow<()>| {
        if explains {
            optimize(problem, &[], options, progress)
        } else {
            optimize_without_conflict(problem, options, progress)
        }
    };
    let Some(kept) = keeps_symmetry_of_start(design, &free) else {
        let report = search(&free, progress)?;
        return Ok(FoundPlatform::assessed(design, free, report, None, options.into())?);
    };
    let report = optimize_without_conflict(&kept, options, progress)?;
    let mut symmetric =
        FoundPlatform::assessed(design, kept, report, Some(StartSymmetry::Kept), options.into())?;
    if symmetric.is_met() || symmetric.report.interrupted {
        return Ok(symmetric);
    }
    let mut report = search(&free, progress)?;
    report.conic_programs += symmetric.report.conic_programs;
    let conic_programs = report.conic_programs;
    let other = FoundPlatform::assessed(design, free, report, Some(StartSymmetry::GivenUp), options.into())?;
    if other.rank() >= symmetric.rank() {
        return Ok(other);
    }
    symmetric.report.interrupted = other.report.interrupted;
    symmetric.report.conic_programs = conic_programs;
    Ok(symmetric)
}

/// A Pareto front with its members assessed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FoundFront {
    /// The problem of the front.
    pub problem: DimensionalProblem,
    /// The search.
    pub report: ParetoReport,
    /// The members in the order of the front.
    pub members: Vec<Checked>,
    /// The result for the symmetry, if the design has one and names none.
    pub symmetry: Option<StartSymmetry>,
}

impl FoundFront {
    fn assessed(
        design: &Design,
        problem: DimensionalProblem,
        report: ParetoReport,
        symmetry: Option<StartSymmetry>,
        assessing: Assessing,
    ) -> Result<Self, VerifyError> {
        let of = |point: &optimize::dimensional::ParetoPoint| {
            checked(design, &problem, &point.solution, assessing)
        };
        let members = report.front.iter().map(of).collect::<Result<Vec<Checked>, VerifyError>>()?;
        Ok(Self { problem, report, members, symmetry })
    }

    /// The status of the search.
    #[must_use]
    pub fn status(&self) -> OptimizeStatus {
        match self.report.failure.as_deref().map(|r| &r.outcome) {
            _ if self.report.interrupted => OptimizeStatus::Interrupted,
            Some(DimensionalOutcome::Infeasible(_)) => OptimizeStatus::Infeasible,
            None if self.members.iter().all(|c| c.met() == Some(true)) => OptimizeStatus::Front,
            _ => OptimizeStatus::Undecided,
        }
    }

    /// Whether there are members, and all are proved to meet the requirements.
    fn is_met(&self) -> bool {
        !self.members.is_empty() && self.members.iter().all(|c| c.met() == Some(true))
    }
}

/// The Pareto front of a design, with its symmetry if the search keeps it unasked.
///
/// # Errors
/// The errors of [`find_platform`].
pub(crate) fn find_front(
    design: &Design,
    points: usize,
    extension: f64,
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<FoundFront, Error> {
    let free = dimensional_problem(design, extension);
    let symmetric = match keeps_symmetry_of_start(design, &free) {
        Some(kept) => {
            let report = pareto(&kept, points, options, progress)?;
            Some(FoundFront::assessed(design, kept, report, Some(StartSymmetry::Kept), options.into())?)
        }
        None => None,
    };
    match symmetric {
        Some(found) if found.is_met() || found.report.interrupted => Ok(found),
        symmetric => {
            let given_up = symmetric.as_ref().map(|_| StartSymmetry::GivenUp);
            let mut report = pareto(&free, points, options, progress)?;
            report.conic_programs += symmetric.as_ref().map_or(0, |s| s.report.conic_programs);
            let conic_programs = report.conic_programs;
            let other = FoundFront::assessed(design, free, report, given_up, options.into())?;
            Ok(match symmetric {
                Some(mut found) if other.members.is_empty() && !found.members.is_empty() => {
                    found.report.interrupted = other.report.interrupted;
                    found.report.conic_programs = conic_programs;
                    found
                }
                _ => other,
            })
        }
    }
}
