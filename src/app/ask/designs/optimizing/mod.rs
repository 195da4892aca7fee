//! The best platform for a design; all callers ask the same question here.

mod assessed;
pub mod drives;
pub mod freedoms;
mod platform_search;
mod problem;

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

pub use self::assessed::Checked;
pub(crate) use self::assessed::checked;
pub use self::assessed::{Assessing, met_or_nothing_required};
use self::assessed::{checked_offsets, offset_status};
use self::drives::search_drives;
pub use self::drives::{DriveOutcome, DriveRanking, DriveSearch, DrivenPlatform, SearchedDrive};
use self::freedoms::FreedomSearch;
pub use self::freedoms::{ConflictFreedom, FreedomOutcome, FreedomWord, OpenedFreedom, RelaxedRequirement};
pub use self::platform_search::{FoundFront, FoundPlatform};
use self::platform_search::{find_front, find_platform};
pub use self::problem::{
    EXTENSION, SAFETY_MARGIN_PERCENT, SearchKind, dimensional_problem, hopeless_home, offset_safety_margins,
    with_default_safety_margin,
};
use self::problem::{offset_problem, with_sizes_to_choose};
use super::Error;
use crate::Design;
use files::design::DriveTable;
use fk::Threads;
use machine::requirements::StartSymmetry;
use num::Cancel;
use num::shown::rounded;
use optimize::dimensional::{self, DimensionalSolution, ShapeSearchOptions};
use optimize::offsets::{self, OffsetProblem, OffsetReport, OffsetSolution};
use platform::manipulator::Octahedral;
use verify::VerifyError;

/// Greatest number of worker threads.
const MOST_THREADS: usize = 1024;
/// The share of a time limit kept for assessments: one over this number, and at most this time.
const FOR_JUDGING: (u32, Duration) = (4, Duration::from_secs(10));

/// The progress of the search.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum OptimizeProgress {
    /// The progress of the search for offsets.
    Offsets(offsets::OffsetProgress),
    /// The progress of the search for a platform that meets its requirements.
    Dimensions(dimensional::Progress),
    /// The progress of this search with the drive of this name.
    Drive(String, dimensional::Progress),
    /// The progress of this search with one more freedom.
    Freedom(ConflictFreedom, dimensional::Progress),
    /// The other local optima are being assessed.
    Assessing,
}

impl std::fmt::Display for OptimizeProgress {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Offsets(p) => p.fmt(f),
            Self::Dimensions(p) => p.fmt(f),
            Self::Drive(name, p) => write!(f, "{name}: {p}"),
            Self::Freedom(freedom, p) => write!(f, "with {} open: {p}", freedom.name()),
            Self::Assessing => f.write_str("other local optima are assessed"),
        }
    }
}

/// The end of a search with this time limit, and the end of the assessments of its results.
pub(crate) fn ends_of(limit: Duration) -> Option<[Instant; 2]> {
    let now = Instant::now();
    let kept = (limit / FOR_JUDGING.0).min(FOR_JUDGING.1);
    Some([now.checked_add(limit.saturating_sub(kept))?, now.checked_add(limit)?])
}

/// The caller of a search, who may end it and sees its progress.
pub(crate) struct Watch<'a, P> {
    /// The end of the search, and the end of the assessments of its results.
    pub(crate) ends: Option<[Instant; 2]>,
    pub(crate) cancel: Cancel,
    pub(crate) on_progress: Option<Box<dyn FnMut(P) -> ControlFlow<()> + 'a>>,
}

impl<P> std::fmt::Debug for Watch<'_, P> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watch").field("ends", &self.ends).finish_non_exhaustive()
    }
}

impl<P> Default for Watch<'_, P> {
    fn default() -> Self {
        Self { ends: None, cancel: Cancel::new(), on_progress: None }
    }
}

impl<P> Watch<'_, P> {
    /// Whether the search has to end, by its time or by the caller.
    pub(crate) fn is_over(&self) -> bool {
        self.cancel.is_cancelled() || self.ends.is_some_and(|[search, _]| Instant::now() >= search)
    }

    /// Tells the caller, who may end the search.
    pub(crate) fn tell(&mut self, progress: P) -> ControlFlow<()> {
        self.on_progress.as_mut().map_or(ControlFlow::Continue(()), |observe| observe(progress))
    }

    /// Tells the caller, unless the search has to end, and returns whether it continues.
    pub(crate) fn flow(&mut self, progress: P) -> ControlFlow<()> {
        if self.is_over() { ControlFlow::Break(()) } else { self.tell(progress) }
    }

    /// The same caller for a part of the search.
    pub(crate) fn of_part<Q: 'static>(&mut self, progress: fn(Q) -> P) -> Watch<'_, Q> {
        Watch {
            ends: self.ends,
            cancel: self.cancel.clone(),
            on_progress: Some(Box::new(move |part| self.flow(progress(part)))),
        }
    }
}

/// Options of [`Design::optimize_with`].
#[derive(Debug)]
#[allow(clippy::struct_excessive_bools, reason = "independent choices")]
pub struct OptimizeOptions<'a> {
    seed: u64,
    threads: Threads,
    extension: f64,
    survey: bool,
    gap: f64,
    candidates: bool,
    freedoms: bool,
    explains: bool,
    pub(crate) drives: Option<&'a DriveTable>,
    pub(crate) watch: Watch<'a, OptimizeProgress>,
}

impl Default for OptimizeOptions<'_> {
    fn default() -> Self {
        Self {
            seed: 1,
            threads: Threads::All,
            extension: EXTENSION,
            survey: false,
            gap: offsets::OffsetSearchOptions::default().gap,
            candidates: false,
            freedoms: true,
            explains: true,
            drives: None,
            watch: Watch::default(),
        }
    }
}

impl<'a> OptimizeOptions<'a> {
    /// The defaults: seed 1, one thread for each processor, joints at most 0.3 of a side beyond its corners, optimal
    /// within one per cent.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    num::setters! {
        /// Sets the seed of the starting points. The answer depends on the seed and not on the number of threads.
        fn seed(seed: u64) = seed;
        /// Sets the number of search threads.
        fn threads(threads: Threads) = threads;
        /// Sets the greatest distance of a joint on the extension of its edge, in edge lengths; 0 keeps joints inside
        /// the edges.
        fn extension(extension: f64) = extension;
        /// Sets whether every branch of offsets is searched for its own best, which takes ten times as long.
        fn survey(survey: bool) = survey;
        /// Sets the greatest relative gap between the answer and the proved upper bound over all offsets at which the
        /// answer counts as optimal.
        fn gap(gap: f64) = gap;
        /// Sets whether the other local optima under requirements are assessed too; each takes as long as the answer.
        fn candidates(candidates: bool) = candidates;
        /// Sets whether a search without success is repeated with one more freedom each: a longer stroke, another
        /// height of home, a wider envelope.
        fn freedoms(freedoms: bool) = freedoms;
        /// Sets the drives to choose from. Each drive that could win is searched, and the answer is the best platform
        /// with its drive. If every drive has a price, the cheapest that meets the requirements wins.
        fn drives(table: &'a DriveTable) = Some(table);
    }

    num::setters! {
        /// Sets the time limit from now on. The last quarter of the time, at most ten seconds, is for assessing the
        /// best result until then.
        fn time_limit(limit: Option<Duration>) watch.ends = limit.and_then(ends_of);
        /// Sets whether a conflict is searched for if no platform meets the requirements.
        fn explains(explains: bool) = explains;
        /// Sets the cancellation of the search; the answer is then the best until then.
        fn cancel(cancel: &Cancel) watch.cancel = cancel.clone();
        /// Sets a function that sees the progress, and may end the search.
        fn on_progress(observe: impl FnMut(OptimizeProgress) -> ControlFlow<()> + 'a) watch.on_progress = Some(Box::new(observe));
    }

    /// The options of a search under requirements.
    pub fn search(&self) -> ShapeSearchOptions {
        let threads = self.threads.count(MOST_THREADS);
        let until = self.watch.ends.map(|[_, assessing]| assessing);
        ShapeSearchOptions { seed: self.seed, threads, until, ..ShapeSearchOptions::default() }
    }
}

num::words! {
    /// The status of a search.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
    #[serde(rename_all = "snake_case")]
    #[schemars(rename = "OptimizeWord")]
    pub enum OptimizeStatus as name, Display {
        /// The requirements are met, and it is proved that no offsets are better by more than `tolerance`.
        Optimal = "optimal",
        /// The requirements are met, and the platform is a local optimum, the best of all starts; a better one is
        /// possible.
        BestFound = "best_found",
        /// The requirements are met; better platforms may be near, or a requested bound is not proved to within
        /// `tolerance`.
        Feasible = "feasible",
        /// There is no platform: proved if `conflict` says so, otherwise no start met the requirements.
        Infeasible = "infeasible",
        /// No platform was found that is proved to meet the requirements.
        Undecided = "undecided",
        /// The platform found violates requirements; the assessment names them.
        Violated = "violated",
        /// The search was interrupted; the answer is the best until then.
        Interrupted = "interrupted",
        /// A Pareto front with mode = "pareto"; its members are proved to meet their requirements.
        Front = "front",
    }
}

/// The best platform found, with the evidence for it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OptimizeReport {
    /// The status.
    pub status: OptimizeStatus,
    /// The design at the start of the search: the requested one, with the chosen drive or the variables chosen for it.
    pub asked: Design,
    /// Whether the sizes of the bodies and the height of home are variables because no leg of the design can be
    /// replaced.
    pub chooses_sizes: bool,
    /// The drives of a table; `None` without a table.
    pub drives: Option<DriveSearch>,
    /// The results of one more freedom each, after a search without success; `None` if none was tried.
    pub freedoms: Option<Vec<OpenedFreedom>>,
    /// Other local optima that meet the requirements at the held poses, best first; `None`: not requested.
    pub candidates: Option<Vec<Checked>>,
    /// The platforms, with the evidence for them.
    pub evidence: OptimizeEvidence,
}

/// The platforms of an [`OptimizeReport`], with the evidence for them.
#[derive(Debug, Clone, PartialEq)]
pub enum OptimizeEvidence {
    /// A search for offsets alone with the best worst-case conditioning: branches, bound, independent check.
    Offsets(Box<FoundOffsets>),
    /// A search for a platform under requirements.
    Dimensions(Box<FoundPlatform>),
    /// A search for a Pareto front.
    Front(Box<FoundFront>),
}

/// The result of a search for offsets, assessed independently of the search code.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FoundOffsets {
    /// The problem of the search.
    pub problem: OffsetProblem,
    /// The search.
    pub report: OffsetReport,
    /// The platform found.
    pub checked: Option<Checked>,
}

/// The status and the value of the objective.
impl std::fmt::Display for OptimizeReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.status)?;
        match &self.evidence {
            OptimizeEvidence::Offsets(found) => match found.report.solution() {
                Some(s) => {
                    let (value, det) = (s.recheck.objective, s.recheck.det.abs());
                    write!(f, ": worst conditioning {}, |det A| {}", rounded(value, 3), rounded(det, 3))
                }
                None => Ok(()),
            },
            OptimizeEvidence::Front(found) => write!(f, ": {} platforms", found.members.len()),
            OptimizeEvidence::Dimensions(found) => {
                let objectives = found.checked.iter().flat_map(|c| &c.objectives);
                for (k, (objective, value)) in objectives.enumerate() {
                    let before = if k == 0 { ": " } else { ", " };
                    let name = objective.code().replace('_', " ");
                    write!(f, "{before}{name} {}", rounded(*value, 3))?;
                }
                Ok(())
            }
        }
    }
}

impl OptimizeReport {
    /// The report of a search without further results.
    fn new(asked: Design, status: OptimizeStatus, evidence: OptimizeEvidence) -> Self {
        let (drives, freedoms, candidates) = (None, None, None);
        Self { status, asked, chooses_sizes: false, drives, freedoms, candidates, evidence }
    }

    /// The platform found, assessed; `None` if there is none, and for a front.
    #[must_use]
    pub fn checked(&self) -> Option<&Checked> {
        match &self.evidence {
            OptimizeEvidence::Offsets(found) => found.checked.as_ref(),
            OptimizeEvidence::Dimensions(found) => found.checked.as_ref(),
            OptimizeEvidence::Front(_) => None,
        }
    }

    /// The platform with the least violation, as seen by the search, if none meets the requirements.
    #[must_use]
    pub fn nearest(&self) -> Option<&Checked> {
        match &self.evidence {
            OptimizeEvidence::Dimensions(found) => found.nearest.as_ref(),
            OptimizeEvidence::Offsets(_) | OptimizeEvidence::Front(_) => None,
        }
    }

    /// The platform found, with the tables of its original design.
    #[must_use]
    pub fn design(&self) -> Option<&Design> {
        self.checked().map(|c| &c.design)
    }

    /// The search result for the three-fold symmetry of a design that names none. `None` if it has none, names one, or
    /// the search could not break it.
    #[must_use]
    pub fn symmetry(&self) -> Option<StartSymmetry> {
        match &self.evidence {
            OptimizeEvidence::Offsets(_) => None,
            OptimizeEvidence::Dimensions(found) => found.symmetry,
            OptimizeEvidence::Front(found) => found.symmetry,
        }
    }

    /// After a search without success: searches with one more freedom each.
    ///
    /// # Errors
    /// The errors of [`Design::optimize_with`].
    pub fn open_freedoms(&mut self, options: &mut OptimizeOptions<'_>) -> Result<(), Error> {
        let report = match &self.evidence {
            OptimizeEvidence::Dimensions(found) if found.checked.is_none() => Some(&found.report),
            OptimizeEvidence::Front(found) => found.report.failure.as_deref(),
            _ => None,
        };
        let ended = self.status == OptimizeStatus::Interrupted || options.watch.is_over();
        let Some(report) = report.filter(|_| !ended) else { return Ok(()) };
        let search = FreedomSearch {
            design: &self.asked,
            extension: options.extension,
            report,
            options: options.search(),
            progress: &mut |freedom, p| options.watch.flow(OptimizeProgress::Freedom(freedom, p)),
        };
        self.freedoms = Some(search.run()?);
        Ok(())
    }

    /// Assesses the other local optima like the answer.
    fn assess_candidates(&mut self, options: &mut OptimizeOptions<'_>) -> Result<(), VerifyError> {
        let OptimizeEvidence::Dimensions(found) = &self.evidence else { return Ok(()) };
        // an interruption now concerns the assessment, which ends by itself
        let _ = options.watch.flow(OptimizeProgress::Assessing);
        let assessing = Assessing::from(&options.search());
        let of = |(k, s): (usize, &DimensionalSolution)| {
            let mut other = checked(&self.asked, &found.problem, s, assessing)?;
            other.design.name = format!("{}, candidate {}", other.design.name, k + 2);
            Ok(other)
        };
        let all = found.report.others.iter().enumerate().map(of).collect::<Result<Vec<_>, VerifyError>>();
        self.candidates = Some(all?);
        Ok(())
    }
}

impl Design {
    /// The best platform for this design under all its requirements. Without requirements, the equivalent platform
    /// without shared joints that has the best worst-case conditioning.
    ///
    /// # Errors
    /// A design that cannot be optimised as requested, for instance one that is not octahedral and names no other
    /// variables.
    pub fn optimize(&self) -> Result<OptimizeReport, Error> {
        self.optimize_with(OptimizeOptions::new())
    }

    /// As [`optimize`](Self::optimize), with options. The command `equipod optimize`, `explore`, sweeps and the Python
    /// package call this function.
    ///
    /// # Errors
    /// The errors of [`optimize`](Self::optimize).
    pub fn optimize_with(&self, mut options: OptimizeOptions<'_>) -> Result<OptimizeReport, Error> {
        let table = options.drives;
        if let (None, Some(file)) = (table, &self.drive_table) {
            return Err(Error::DriveTable(file.clone()));
        }
        if let Some(home) = hopeless_home(self, options.extension) {
            return Err(Error::SingularHome(home));
        }
        let sized = with_sizes_to_choose(self);
        let chooses_sizes = sized.is_some();
        let asked = sized.unwrap_or_else(|| self.clone());
        let mut report = match SearchKind::of(&asked, table.is_some()) {
            SearchKind::Offsets => asked.best_offsets(&mut options)?,
            SearchKind::Front(_) if table.is_some() => return Err(Error::FrontWithDrives),
            SearchKind::Front(points) => asked.front(points, &mut options)?,
            SearchKind::Platform => asked.best_platform(&mut options)?,
        };
        report.chooses_sizes = chooses_sizes;
        if options.freedoms {
            report.open_freedoms(&mut options)?;
        }
        if options.candidates {
            report.assess_candidates(&mut options)?;
        }
        Ok(report)
    }

    fn best_offsets(self, options: &mut OptimizeOptions<'_>) -> Result<OptimizeReport, Error> {
        let octahedral = Octahedral::recognise(self.manipulator())?;
        let search = offsets::OffsetSearchOptions {
            seed: options.seed,
            threads: options.threads.count(MOST_THREADS),
            survey: options.survey,
            gap: options.gap,
            ..offsets::OffsetSearchOptions::default()
        };
        let poses = self.workspace_or_default().sample(&self.home_or_default());
        let problem = offset_problem(&self, octahedral, poses, options.extension);
        let report =
            offsets::optimize(&problem, &search, &mut |p| options.watch.flow(OptimizeProgress::Offsets(p)))?;
        let assessing = Assessing::from(&options.search());
        let of = |s: &OffsetSolution| checked_offsets(&self, &problem, s, assessing);
        let checked = report.solution().map(of).transpose()?;
        let status = offset_status(&report, checked.as_ref());
        let found = FoundOffsets { problem, report, checked };
        Ok(OptimizeReport::new(self, status, OptimizeEvidence::Offsets(Box::new(found))))
    }

    fn best_platform(self, options: &mut OptimizeOptions<'_>) -> Result<OptimizeReport, Error> {
        let (search, extension, explains) = (options.search(), options.extension, options.explains);
        let Some(table) = options.drives else {
            let found = find_platform(&self, extension, &search, explains, &mut |p| {
                options.watch.flow(OptimizeProgress::Dimensions(p))
            })?;
            let status = found.status();
            return Ok(OptimizeReport::new(self, status, OptimizeEvidence::Dimensions(Box::new(found))));
        };
        let drives = search_drives(&self, table, extension, &search, &mut |drive, p| {
            options.watch.flow(OptimizeProgress::Drive(drive.name.clone(), p))
        })?;
        let DrivenPlatform { design, found } = drives.answer().cloned().ok_or(Error::NoDrive)?;
        let status = if drives.interrupted { OptimizeStatus::Interrupted } else { found.status() };
        let report = OptimizeReport::new(design, status, OptimizeEvidence::Dimensions(Box::new(found)));
        Ok(OptimizeReport { drives: Some(drives), ..report })
    }

    fn front(self, points: usize, options: &mut OptimizeOptions<'_>) -> Result<OptimizeReport, Error> {
        let search = options.search();
        let found = find_front(&self, points, options.extension, &search, &mut |p| {
            options.watch.flow(OptimizeProgress::Dimensions(p))
        })?;
        let status = found.status();
        Ok(OptimizeReport::new(self, status, OptimizeEvidence::Front(Box::new(found))))
    }
}
