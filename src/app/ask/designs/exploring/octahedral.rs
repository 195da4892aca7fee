//! Octahedral designs.

use std::time::Instant;

use super::{ExploreOptions, ExploreProgress, ExploreVerdict, NoExploration, OwnPoses};
use crate::optimizing::with_default_safety_margin;
use crate::rounding::{DesignOnHoles, FirstSearch, on_stated_holes};
use crate::{
    Checked, ComparedDesigns, Design, FoundOffsets, OptimizeEvidence, OptimizeProgress, OptimizeReport,
    OptimizeStatus,
};
use machine::manufacture::NoRounding;
use machine::requirements::{KeptSymmetry, StartSymmetry};
use optimize::dimensional::Triangles;
use platform::manipulator::Octahedral;
use synthesis::Family;
use verify::{Verdict, VerdictWord};

/// The platform on the holes that the design states; `None` if it states none, or no platform was found.
type OnHoles = Option<Result<DesignOnHoles, NoRounding>>;

/// The results for an octahedral design.
#[derive(Debug)]
#[non_exhaustive]
pub struct ExploredClass {
    /// Its triangles.
    pub octahedral: Octahedral,
    /// The platforms that are equivalent to an octahedral one.
    pub family: Family,
    /// The best platform.
    pub search: OptimizeReport,
    /// The platform on the holes that the design states; `None` if it states none, or no platform was found.
    pub holes: Option<Result<DesignOnHoles, NoRounding>>,
    /// The result for the default safety margin; `None` if the design states its own.
    pub default_safety_margin: Option<DefaultSafetyMargin>,
    /// Whether the time limit or the caller ended the search, or an assessment before its verdict.
    pub interrupted: bool,
    /// The time at which the assessments end with the result so far, if there is a time limit.
    pub until: Option<Instant>,
    /// The comparison of the design with the best platform; `None` if there is none, or it has other triangles.
    pub compared: Option<ComparedDesigns>,
    /// Poses of the design.
    pub poses: OwnPoses,
}

/// The result for the default safety margin of a design that states none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DefaultSafetyMargin {
    /// The platform found keeps it.
    Kept,
    /// No platform was found that keeps it, and the search was repeated without it.
    GivenUp,
    /// The search with it was ended before a platform was proved to keep it.
    Undecided,
}

/// The decisive fact about the platform found: its requirements first, then the comparison.
#[derive(Debug)]
pub enum ExploreFinding<'a> {
    /// There is no platform, and this is proved or no start led to one.
    Infeasible,
    /// No platform was found.
    NotFound,
    /// The platform violates requirements.
    Violated(&'a Design),
    /// The platform is not proved to meet its requirements.
    Unproved(&'a Design),
    /// The platform meets its requirements; the comparison with the design decides.
    Compared(&'a ComparedDesigns),
    /// The platform meets its requirements, and has other kinematics than the design by intention.
    New,
    /// The platform meets its requirements with its joints on the holes that the design states.
    OnHoles,
    /// No platform has its joints on these holes, for this reason.
    NoHoles(String),
}

impl ExploredClass {
    pub(super) fn of(
        design: &Design,
        octahedral: Octahedral,
        mut options: ExploreOptions<'_>,
    ) -> Result<Self, NoExploration> {
        options.stage(1, "equivalence class");
        let family = Family::octahedral();

        options.stage(2, "the best platform");
        let (mut search, holes, default_safety_margin) = searched_carefully(design, &mut options)?;
        let met = if holes.is_some() { is_met(&holes) } else { search.met_by_a_platform() };
        let is_over = options.watch.flow(ExploreProgress::Searched).is_break();
        let interrupted = search.status == OptimizeStatus::Interrupted || (is_over && !met);
        search.take_lengths_of(design);
        search.open_freedoms(&mut options.optimize(true)).map_err(NoExploration::Search)?;

        options.stage(3, "verification");
        let new = search.design().filter(|_| search.keeps_class());
        let compared =
            new.map(|new| ComparedDesigns::of([design, new], options.samples, &options.fk())).transpose()?;

        options.stage(4, "forward kinematics");
        let poses = design.own_poses(&options.fk())?;
        let until = options.watch.ends.map(|[_, assessing]| assessing);
        Ok(Self {
            octahedral,
            family,
            search,
            holes,
            default_safety_margin,
            interrupted,
            until,
            compared,
            poses,
        })
    }

    /// The platform to build: on the holes, if the design states them.
    #[must_use]
    pub fn built(&self) -> Option<&Design> {
        match &self.holes {
            Some(Ok(on)) => on.found.as_ref().map(|(_, design)| design),
            Some(Err(_)) => None,
            None => self.search.design(),
        }
    }

    /// The decisive fact about the platform found.
    #[must_use]
    pub fn finding(&self) -> ExploreFinding<'_> {
        match &self.holes {
            Some(Err(why)) => return ExploreFinding::NoHoles(why.to_string()),
            Some(Ok(on)) => {
                let Some((_, design)) = &on.found else { return ExploreFinding::NoHoles(why_none(on)) };
                return match on.met() {
                    Some(true) => ExploreFinding::OnHoles,
                    Some(false) => ExploreFinding::Violated(design),
                    None => ExploreFinding::Unproved(design),
                };
            }
            None => (),
        }
        match (self.search.design(), self.search.met(), &self.compared) {
            (None, ..) => match self.search.status {
                OptimizeStatus::Infeasible | OptimizeStatus::Violated => ExploreFinding::Infeasible,
                _ => ExploreFinding::NotFound,
            },
            (Some(design), Some(false), _) => ExploreFinding::Violated(design),
            (Some(design), None, _) => ExploreFinding::Unproved(design),
            (Some(_), Some(true), Some(compared)) => ExploreFinding::Compared(compared),
            (Some(_), Some(true), None) => ExploreFinding::New,
        }
    }

    /// The verdict of the exploration.
    #[must_use]
    pub fn verdict(&self) -> ExploreVerdict {
        match self.finding() {
            ExploreFinding::Infeasible => ExploreVerdict::Infeasible,
            ExploreFinding::Violated(_) | ExploreFinding::NoHoles(_) => ExploreVerdict::Violated,
            ExploreFinding::OnHoles => ExploreVerdict::OnHoles,
            ExploreFinding::New => ExploreVerdict::NewKinematics,
            ExploreFinding::Compared(c) => ExploreVerdict::Compared(c.found.verdict.word()),
            ExploreFinding::NotFound | ExploreFinding::Unproved(_) => {
                ExploreVerdict::Compared(VerdictWord::Inconclusive)
            }
        }
    }
}

/// The obstacles to both roundings.
fn why_none(on: &DesignOnHoles) -> String {
    let exact = on.rounding.exact.as_ref().err().map(ToString::to_string);
    let nearest = on.rounding.nearest.as_ref().err().map(ToString::to_string);
    exact.into_iter().chain(nearest).collect::<Vec<_>>().join("; ")
}

/// Searches first with the default safety margin, if the design states none, and without it if no platform is found.
/// Also returns the result for this margin.
fn searched_carefully(
    design: &Design,
    options: &mut ExploreOptions<'_>,
) -> Result<(OptimizeReport, OnHoles, Option<DefaultSafetyMargin>), NoExploration> {
    let Some(careful) = with_default_safety_margin(design) else {
        let (found, holes) = searched(design, true, options)?;
        return Ok((found, holes, None));
    };
    let (found, holes) = searched(&careful, false, options)?;
    let keeps = match &holes {
        None => found.met_by_a_platform(),
        Some(_) => is_met(&holes),
    };
    if keeps {
        return Ok((found, holes, Some(DefaultSafetyMargin::Kept)));
    }
    if options.watch.flow(ExploreProgress::Searched).is_break() {
        return Ok((found, holes, Some(DefaultSafetyMargin::Undecided)));
    }
    let (found, holes) = searched(design, true, options)?;
    Ok((found, holes, Some(DefaultSafetyMargin::GivenUp)))
}

/// Searches for the best platform, and for the same on the holes that the design states. A symmetry kept unasked may
/// prevent a platform on the holes that is proved to meet its requirements. The search without the symmetry is then the
/// answer, if it leads to such a platform.
fn searched(
    design: &Design,
    explains: bool,
    options: &mut ExploreOptions<'_>,
) -> Result<(OptimizeReport, OnHoles), NoExploration> {
    let (found, holes) = search_once(design, explains, options)?;
    let is_last =
        holes.is_none() || is_met(&holes) || options.watch.flow(ExploreProgress::Searched).is_break();
    if is_last || found.symmetry() != Some(StartSymmetry::Kept) {
        return Ok((found, holes));
    }
    let mut free = design.clone();
    free.search.symmetry = Some(KeptSymmetry::None);
    let (mut other, on_holes) = search_once(&free, explains, options)?;
    if !is_met(&on_holes) {
        return Ok((found, holes));
    }
    if let OptimizeEvidence::Dimensions(found) = &mut other.evidence {
        found.symmetry = Some(StartSymmetry::GivenUp);
    }
    Ok((other, on_holes))
}

/// One search; freedoms are opened later, if at all.
fn search_once(
    design: &Design,
    explains: bool,
    options: &mut ExploreOptions<'_>,
) -> Result<(OptimizeReport, OnHoles), NoExploration> {
    let found = design.optimize_with(options.optimize(explains).freedoms(false));
    let found = found.map_err(NoExploration::Search)?;
    let holes = on_holes(design, &found, options)?;
    Ok((found, holes))
}

/// The platform found, or the one with the least violation, with its joints on the holes of the design; `None` without
/// platform or holes.
fn on_holes(
    design: &Design,
    found: &OptimizeReport,
    options: &mut ExploreOptions<'_>,
) -> Result<OnHoles, NoExploration> {
    let Some((grids, given)) = design.holes.zip(found.closest()) else { return Ok(None) };
    let first = match &found.evidence {
        OptimizeEvidence::Dimensions(of_shape) => {
            let solution = of_shape.report.solution().or(of_shape.report.nearest.as_deref());
            let (design, problem) = (&found.asked, &of_shape.problem);
            solution.map(|s| FirstSearch { design, problem, point: &s.point })
        }
        OptimizeEvidence::Offsets(_) | OptimizeEvidence::Front(_) => None,
    };
    let search = options.optimize(true).search();
    let rounded = on_stated_holes(given, &grids, first, &search, &mut |p| {
        options.watch.flow(ExploreProgress::Search(OptimizeProgress::Dimensions(p)))
    });
    rounded.map(Some).map_err(NoExploration::Holes)
}

/// Whether a platform is on the holes and is proved to meet its requirements.
fn is_met(holes: &OnHoles) -> bool {
    matches!(holes, Some(Ok(on)) if on.found.is_some() && on.met() == Some(true))
}

impl OptimizeReport {
    /// The platform found, or the one with the least violation.
    #[must_use]
    pub fn closest(&self) -> Option<&Design> {
        self.checked().or(self.nearest()).map(|c| &c.design)
    }

    /// Whether the platform found meets its requirements; `Some(true)` without requirements.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        self.checked().map_or(Some(true), Checked::met)
    }

    /// Whether there is a platform that is proved to meet its requirements.
    fn met_by_a_platform(&self) -> bool {
        self.design().is_some() && self.met() == Some(true)
    }

    /// Whether the platform has the kinematics of the design by construction; with other triangles it has not.
    #[must_use]
    pub fn keeps_class(&self) -> bool {
        match &self.evidence {
            OptimizeEvidence::Dimensions(found) => found.problem.variables.triangles == Triangles::Fixed,
            OptimizeEvidence::Offsets(_) | OptimizeEvidence::Front(_) => true,
        }
    }

    /// The offsets and `det A` of the leg map from the design, if both exist.
    #[must_use]
    pub fn offsets(&self) -> Option<([f64; 6], f64)> {
        match &self.evidence {
            OptimizeEvidence::Offsets(found) => found.report.solution().map(|s| (s.offsets, s.recheck.det)),
            OptimizeEvidence::Dimensions(found) => {
                let offsets = found.report.solution()?.offsets?;
                let map = &found.checked.as_ref()?.verification.as_ref()?.map;
                Some((offsets, map.determinant))
            }
            OptimizeEvidence::Front(_) => None,
        }
    }

    /// Gives the platform found leg lengths: those at the pose of the design's own lengths.
    fn take_lengths_of(&mut self, design: &Design) {
        let lengths = design.lengths.map(|l| l.squared());
        match &mut self.evidence {
            OptimizeEvidence::Offsets(found) => {
                let FoundOffsets { checked, report, .. } = &mut **found;
                if let (Some(c), Some(s)) = (checked, report.solution()) {
                    c.design.lengths = lengths.and_then(|l| s.map.apply(&l).ok()).map(|s| s.lengths());
                }
            }
            OptimizeEvidence::Dimensions(found) => {
                if let Some(c) = &mut found.checked {
                    let kept = c.verification.as_ref().filter(|v| v.verdict == Verdict::Equivalent);
                    let map = kept.map(|v| &v.map.closest);
                    c.design.lengths =
                        map.zip(lengths).and_then(|(m, l)| m.apply(&l).ok()).map(|s| s.lengths());
                }
            }
            OptimizeEvidence::Front(_) => (),
        }
    }
}
