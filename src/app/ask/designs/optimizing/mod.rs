//! The best platform for a design: one question, whoever asks it.

pub mod drive_search;
pub mod freedoms;
mod judged;
mod platform_search;
mod problem;

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use self::drive_search::search_drives;
pub use self::drive_search::{DriveOutcome, DriveRanking, DriveSearch, DrivenPlatform, SearchedDrive};
use self::freedoms::FreedomSearch;
pub use self::freedoms::{ConflictFreedom, EasedDemand, FreedomOutcome, FreedomWord, OpenedFreedom};
pub use self::judged::Checked;
pub(crate) use self::judged::checked;
pub use self::judged::{Judging, met_or_nothing_required};
use self::judged::{checked_offsets, offset_status};
pub use self::platform_search::{FoundFront, FoundPlatform};
use self::platform_search::{find_front, find_platform};
pub use self::problem::{
    EXTENSION, RESERVE_PERCENT, SearchKind, dimensional_problem, hopeless_home, offset_reserves,
    with_default_reserve,
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

/// Most worker threads.
const MOST_THREADS: usize = 1024;
/// The part of a limit of time that the judging has: one over this number, and this long at most.
const FOR_JUDGING: (u32, Duration) = (4, Duration::from_secs(10));

/// How far the search is.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum OptimizeProgress {
    /// Of the search for offsets.
    Offsets(offsets::OffsetProgress),
    /// Of the search for a platform that meets its requirements.
    Dimensions(dimensional::Progress),
    /// Of that search with the drive of this name.
    Drive(String, dimensional::Progress),
    /// Of that search with one more freedom.
    Freedom(ConflictFreedom, dimensional::Progress),
    /// Other local optima are judged.
    Judging,
}

impl std::fmt::Display for OptimizeProgress {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Offsets(p) => p.fmt(f),
            Self::Dimensions(p) => p.fmt(f),
            Self::Drive(name, p) => write!(f, "{name}: {p}"),
            Self::Freedom(freedom, p) => write!(f, "with {} open: {p}", freedom.name()),
            Self::Judging => f.write_str("other local optima are judged"),
        }
    }
}

/// When a search that has so much time ends, and when the judging of what it found.
pub fn ends_of(limit: Duration) -> Option<[Instant; 2]> {
    let now = Instant::now();
    let kept = (limit / FOR_JUDGING.0).min(FOR_JUDGING.1);
    Some([now.checked_add(limit.saturating_sub(kept))?, now.checked_add(limit)?])
}

type OnProgress<'a> = Box<dyn FnMut(OptimizeProgress) -> ControlFlow<()> + 'a>;

/// Options of [`Design::optimize_with`].
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
    drives: Option<&'a DriveTable>,
    ends: Option<Instant>,
    until: Option<Instant>,
    cancel: Cancel,
    on_progress: Option<OnProgress<'a>>,
}

impl std::fmt::Debug for OptimizeOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("OptimizeOptions")
            .field("seed", &self.seed)
            .field("threads", &self.threads)
            .field("extension", &self.extension)
            .field("survey", &self.survey)
            .field("gap", &self.gap)
            .field("candidates", &self.candidates)
            .field("freedoms", &self.freedoms)
            .field("drives", &self.drives.map(|table| table.drives.len()))
            .field("until", &self.until)
            .finish_non_exhaustive()
    }
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
            ends: None,
            until: None,
            cancel: Cancel::new(),
            on_progress: None,
        }
    }
}

impl<'a> OptimizeOptions<'a> {
    /// The defaults: seed 1, a thread for each processor, joints at most 0.3 of a side beyond its corners, optimal
    /// within one per cent.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Seed of starting points. Same seed, same answer, whatever the number of threads.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// How many threads search.
    #[must_use]
    pub fn threads(mut self, threads: Threads) -> Self {
        self.threads = threads;
        self
    }

    /// How far a joint may sit out on the extension of its edge, edge lengths; 0 keeps joints inside the edges.
    #[must_use]
    pub fn extension(mut self, extension: f64) -> Self {
        self.extension = extension;
        self
    }

    /// Whether every branch of offsets is searched for its own best, which takes ten times as long.
    #[must_use]
    pub fn survey(mut self, survey: bool) -> Self {
        self.survey = survey;
        self
    }

    /// Greatest relative gap between the answer and the proved upper bound over all offsets at which the answer counts
    /// as optimal.
    #[must_use]
    pub fn gap(mut self, gap: f64) -> Self {
        self.gap = gap;
        self
    }

    /// Whether the other local optima under requirements are judged too, which takes as long for each as for the
    /// answer.
    #[must_use]
    pub fn candidates(mut self, candidates: bool) -> Self {
        self.candidates = candidates;
        self
    }

    /// Whether, where nothing meets the requirements, the search is made again with one more freedom each: a longer
    /// stroke, another height of home, a wider envelope.
    #[must_use]
    pub fn freedoms(mut self, freedoms: bool) -> Self {
        self.freedoms = freedoms;
        self
    }

    /// The drives to choose from: the search is made with each drive that could win, and the answer is the best
    /// platform with its drive, the cheapest with which the requirements are met where every drive has a price.
    #[must_use]
    pub fn drives(mut self, table: &'a DriveTable) -> Self {
        self.drives = Some(table);
        self
    }

    /// How long it may take from now on. The last quarter of the time, at most ten seconds, is for the judging of the
    /// best until then.
    #[must_use]
    pub fn time_limit(mut self, limit: Duration) -> Self {
        let ends = ends_of(limit);
        (self.ends, self.until) = (ends.map(|[search, _]| search), ends.map(|[_, judging]| judging));
        self
    }

    /// When the judging ends of what a search found that is ended otherwise.
    pub fn until(mut self, until: Option<Instant>) -> Self {
        self.until = until;
        self
    }

    /// Whether a conflict is looked for where nothing meets the requirements.
    pub fn explains(mut self, explains: bool) -> Self {
        self.explains = explains;
        self
    }

    /// What ends the search before its time; the answer is then the best until then.
    #[must_use]
    pub fn cancel(mut self, cancel: &Cancel) -> Self {
        self.cancel = cancel.clone();
        self
    }

    /// Is told how far the search is, and may end it.
    #[must_use]
    pub fn on_progress(mut self, look: impl FnMut(OptimizeProgress) -> ControlFlow<()> + 'a) -> Self {
        self.on_progress = Some(Box::new(look));
        self
    }

    fn flow(&mut self, progress: OptimizeProgress) -> ControlFlow<()> {
        let late = self.ends.is_some_and(|ends| Instant::now() >= ends);
        if late || self.cancel.is_cancelled() {
            return ControlFlow::Break(());
        }
        self.on_progress.as_mut().map_or(ControlFlow::Continue(()), |look| look(progress))
    }

    /// The options of a search under requirements.
    pub fn search(&self) -> ShapeSearchOptions {
        let threads = self.threads.count(MOST_THREADS);
        ShapeSearchOptions { seed: self.seed, threads, until: self.until, ..ShapeSearchOptions::default() }
    }
}

/// What came of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "OptimizeWord")]
pub enum OptimizeStatus {
    /// The requirements are met, and no offsets are better by more than `tolerance`: proved.
    Optimal,
    /// The requirements are met, and the platform is a local optimum, the best of all starts; that none is better is
    /// not proved.
    BestFound,
    /// The requirements are met; better platforms may be near, or a bound on all others was asked for and is not proved
    /// to within `tolerance`.
    Feasible,
    /// There is no platform: proved where `conflict` says so, else no start met the requirements.
    Infeasible,
    /// Nothing that meets the requirements was found, or what was found is not proved to meet them.
    Undecided,
    /// The platform found misses requirements; the assessment names them.
    Violated,
    /// The search was told to end; the answer is the best until then.
    Interrupted,
    /// With mode = "pareto": a front whose members are proved to meet their requirements.
    Front,
}

impl OptimizeStatus {
    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::BestFound => "best_found",
            Self::Feasible => "feasible",
            Self::Infeasible => "infeasible",
            Self::Undecided => "undecided",
            Self::Violated => "violated",
            Self::Interrupted => "interrupted",
            Self::Front => "front",
        }
    }
}

impl std::fmt::Display for OptimizeStatus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// The best platform found, with the evidence for it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OptimizeReport {
    /// The outcome in a word.
    pub status: OptimizeStatus,
    /// The design that the search began with: the one asked about, with the drive chosen, or with the variables that
    /// were chosen for it.
    pub asked: Design,
    /// Whether the sizes of the bodies and the height of home were chosen because no leg of the design can be replaced.
    pub chooses_sizes: bool,
    /// The drives of a table; `None` where none was given.
    pub drives: Option<DriveSearch>,
    /// Where nothing that meets the requirements was found: what came of one more freedom; `None` where none was tried.
    pub freedoms: Option<Vec<OpenedFreedom>>,
    /// Other local optima that meet the requirements at the poses that the search held, best first; `None` where they
    /// were not asked for.
    pub candidates: Option<Vec<Checked>>,
    /// The platforms, with the evidence for them.
    pub evidence: OptimizeEvidence,
}

/// The platforms of an [`OptimizeReport`], with the evidence for them.
#[derive(Debug, Clone, PartialEq)]
pub enum OptimizeEvidence {
    /// Of offsets alone, for the best worst-case conditioning: branches, bound, re-check.
    Offsets(Box<FoundOffsets>),
    /// Of a platform under requirements.
    Dimensions(Box<FoundPlatform>),
    /// Of platforms of which none is better in every objective.
    Front(Box<FoundFront>),
}

/// The result of a search for offsets, judged by code that the search does not use.
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

/// The status and the value of what was optimised.
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
    /// The report of a search alone.
    fn new(asked: Design, status: OptimizeStatus, evidence: OptimizeEvidence) -> Self {
        let (drives, freedoms, candidates) = (None, None, None);
        Self { status, asked, chooses_sizes: false, drives, freedoms, candidates, evidence }
    }

    /// The platform found, judged; `None` where there is none, and for a front.
    #[must_use]
    pub fn checked(&self) -> Option<&Checked> {
        match &self.evidence {
            OptimizeEvidence::Offsets(found) => found.checked.as_ref(),
            OptimizeEvidence::Dimensions(found) => found.checked.as_ref(),
            OptimizeEvidence::Front(_) => None,
        }
    }

    /// Where nothing that meets the requirements was found: the platform that misses them least, as the search sees it.
    #[must_use]
    pub fn nearest(&self) -> Option<&Checked> {
        match &self.evidence {
            OptimizeEvidence::Dimensions(found) => found.nearest.as_ref(),
            OptimizeEvidence::Offsets(_) | OptimizeEvidence::Front(_) => None,
        }
    }

    /// The platform found, with the tables of the design it is from.
    #[must_use]
    pub fn design(&self) -> Option<&Design> {
        self.checked().map(|c| &c.design)
    }

    /// What became of the three-fold symmetry of a design that names no symmetry; `None` where it has none, names one,
    /// or the search could not break it.
    #[must_use]
    pub fn symmetry(&self) -> Option<StartSymmetry> {
        match &self.evidence {
            OptimizeEvidence::Offsets(_) => None,
            OptimizeEvidence::Dimensions(found) => found.symmetry,
            OptimizeEvidence::Front(found) => found.symmetry,
        }
    }

    /// Where nothing was found: the searches with one more freedom each.
    ///
    /// # Errors
    /// As of [`Design::optimize_with`].
    pub fn open_freedoms(&mut self, options: &mut OptimizeOptions<'_>) -> Result<(), Error> {
        let report = match &self.evidence {
            OptimizeEvidence::Dimensions(found) if found.checked.is_none() => Some(&found.report),
            OptimizeEvidence::Front(found) => found.report.failure.as_deref(),
            _ => None,
        };
        let Some(report) = report.filter(|_| self.status != OptimizeStatus::Interrupted) else {
            return Ok(());
        };
        let search = FreedomSearch {
            design: &self.asked,
            extension: options.extension,
            report,
            options: options.search(),
            progress: &mut |freedom, p| options.flow(OptimizeProgress::Freedom(freedom, p)),
        };
        self.freedoms = Some(search.run()?);
        Ok(())
    }

    /// Judges the other local optima as the answer was judged.
    fn judge_candidates(&mut self, options: &mut OptimizeOptions<'_>) -> Result<(), VerifyError> {
        let OptimizeEvidence::Dimensions(found) = &self.evidence else { return Ok(()) };
        // an end that is asked for now is one of the judging, which ends by itself
        let _ = options.flow(OptimizeProgress::Judging);
        let judging = Judging::from(&options.search());
        let of = |(k, s): (usize, &DimensionalSolution)| {
            let mut other = checked(&self.asked, &found.problem, s, judging)?;
            other.design.name = format!("{}, candidate {}", other.design.name, k + 2);
            Ok(other)
        };
        let all = found.report.others.iter().enumerate().map(of).collect::<Result<Vec<_>, VerifyError>>();
        self.candidates = Some(all?);
        Ok(())
    }
}

impl Design {
    /// The best platform for this design: under all its requirements where it has any, else the equivalent platform
    /// without shared joints with the best worst-case conditioning.
    ///
    /// # Errors
    /// A design that cannot be optimised as it asks: one that is not octahedral and names no other variables, for
    /// instance.
    pub fn optimize(&self) -> Result<OptimizeReport, Error> {
        self.optimize_with(OptimizeOptions::new())
    }

    /// As [`optimize`](Self::optimize), with options. The command `equipod optimize`, `explore`, sweeps and the Python
    /// package ask this function.
    ///
    /// # Errors
    /// As [`optimize`](Self::optimize).
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
            report.judge_candidates(&mut options)?;
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
            offsets::optimize(&problem, &search, &mut |p| options.flow(OptimizeProgress::Offsets(p)))?;
        let judging = Judging::from(&options.search());
        let of = |s: &OffsetSolution| checked_offsets(&self, &problem, s, judging);
        let checked = report.solution().map(of).transpose()?;
        let status = offset_status(&report, checked.as_ref());
        let found = FoundOffsets { problem, report, checked };
        Ok(OptimizeReport::new(self, status, OptimizeEvidence::Offsets(Box::new(found))))
    }

    fn best_platform(self, options: &mut OptimizeOptions<'_>) -> Result<OptimizeReport, Error> {
        let (search, extension, explains) = (options.search(), options.extension, options.explains);
        let Some(table) = options.drives else {
            let found = find_platform(&self, extension, &search, explains, &mut |p| {
                options.flow(OptimizeProgress::Dimensions(p))
            })?;
            let status = found.status();
            return Ok(OptimizeReport::new(self, status, OptimizeEvidence::Dimensions(Box::new(found))));
        };
        let drives = search_drives(&self, table, extension, &search, &mut |drive, p| {
            options.flow(OptimizeProgress::Drive(drive.name.clone(), p))
        })?;
        let DrivenPlatform { design, found } = drives.answer().cloned().ok_or(Error::NoDrive)?;
        let status = if drives.interrupted { OptimizeStatus::Interrupted } else { found.status() };
        let report = OptimizeReport::new(design, status, OptimizeEvidence::Dimensions(Box::new(found)));
        Ok(OptimizeReport { drives: Some(drives), ..report })
    }

    fn front(self, points: usize, options: &mut OptimizeOptions<'_>) -> Result<OptimizeReport, Error> {
        let search = options.search();
        let found = find_front(&self, points, options.extension, &search, &mut |p| {
            options.flow(OptimizeProgress::Dimensions(p))
        })?;
        let status = found.status();
        Ok(OptimizeReport::new(self, status, OptimizeEvidence::Front(Box::new(found))))
    }
}
