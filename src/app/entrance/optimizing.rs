//! The best platform for a design.

use std::ops::ControlFlow;
use std::time::Instant;

use super::equivalence::sample_plan;
use super::platform_search::find_platform;
use super::{AssessReport, Error, SingularHome};
use crate::app::Design;
use files::design::{Combination, DesignModel, Origin};
use fk::{FkOptions, Threads};
use machine::requirements::{
    AssessOptions, Assessment, JointAxes, Objective, Requirements, StartSymmetry, TermKind, VariableKind,
    assess,
};
use num::Cancel;
use optimize::dimensional::{
    self, DimensionalOutcome, DimensionalProblem, DimensionalReport, DimensionalSolution, InvalidProblem,
    Mode, ShapeSearchOptions, Triangles, Variables, evaluate,
};
use optimize::offsets::{self, OffsetOutcome, OffsetProblem, OffsetReport, OffsetSolution};
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, Octahedral, inverse_condition, jacobian};
use synthesis::{joint_free, sliding_body};
use verify::{Verification, VerifyError, verify};

/// Points of the dense evaluation, and as many random ones.
const POINTS: usize = 5000;
/// Samples of the comparison with the design.
const SAMPLES: usize = 3;
/// How far a joint may stand beyond a corner, in lengths of its side, where nothing is said: room for the joint, and a body half as wide again at most.
pub(crate) const EXTENSION: f64 = 0.3;
/// The reserve on every limit that `explore` keeps where the design states none, percent.
pub(crate) const RESERVE_PERCENT: f64 = 5.0;
/// Most worker threads.
const MOST_THREADS: usize = 256;

/// How far the search is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum OptimizeProgress {
    /// Of the search for offsets.
    Offsets(offsets::OffsetProgress),
    /// Of the search for a platform that meets its requirements.
    Dimensions(dimensional::Progress),
}

impl std::fmt::Display for OptimizeProgress {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Offsets(p) => p.fmt(f),
            Self::Dimensions(p) => p.fmt(f),
        }
    }
}

type OnProgress<'a> = Box<dyn FnMut(OptimizeProgress) -> ControlFlow<()> + 'a>;

/// Options of [`Design::optimize_with`].
pub struct OptimizeOptions<'a> {
    seed: u64,
    threads: Threads,
    extension: f64,
    survey: bool,
    gap: f64,
    candidates: bool,
    cancel: Cancel,
    on_progress: Option<OnProgress<'a>>,
}

impl std::fmt::Debug for OptimizeOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { seed, threads, extension, survey, gap, candidates, cancel, on_progress } = self;
        f.debug_struct("OptimizeOptions")
            .field("seed", seed)
            .field("threads", threads)
            .field("extension", extension)
            .field("survey", survey)
            .field("gap", gap)
            .field("candidates", candidates)
            .field("cancel", cancel)
            .field("on_progress", &on_progress.is_some())
            .finish()
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
            cancel: Cancel::new(),
            on_progress: None,
        }
    }
}

impl<'a> OptimizeOptions<'a> {
    /// The defaults: seed 1, a thread for each processor, joints at most 0.3 of a side beyond its corners, optimal within one per cent.
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

    /// Greatest relative gap between the answer and the proved upper bound over all offsets at which the answer counts as optimal.
    #[must_use]
    pub fn gap(mut self, gap: f64) -> Self {
        self.gap = gap;
        self
    }

    /// Whether the other local optima under requirements are judged too, which takes as long for each as for the answer.
    #[must_use]
    pub fn candidates(mut self, candidates: bool) -> Self {
        self.candidates = candidates;
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
        if self.cancel.is_cancelled() {
            return ControlFlow::Break(());
        }
        self.on_progress.as_mut().map_or(ControlFlow::Continue(()), |look| look(progress))
    }
}

/// What became of an optimisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum OptimizeStatus {
    /// Feasible by a check of its own, and proved to be within the gap of the best offsets.
    Optimal,
    /// Feasible by a check of its own, and a local optimum, the best of all starts; that none is better is not proved.
    BestFound,
    /// Feasible by a check of its own; how much better others could be is not known well enough.
    Feasible,
    /// Proved for offsets: none meets the limits. Under requirements: no start met them together.
    Infeasible,
    /// Nothing feasible was found, and that there is nothing is not known.
    Undecided,
    /// A platform was found that misses requirements between the poses at which the search held them: `assess` names them.
    Violated,
    /// Told to end; the answer is the best until then.
    Interrupted,
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
    /// What became of it.
    pub status: OptimizeStatus,
    /// The platform, with the tables of the design it is from.
    pub design: Option<Design>,
    /// Where nothing that meets the requirements was found: the platform that misses them least, as the search sees it.
    pub nearest: Option<Box<Checked>>,
    /// Where they were asked for: other local optima that meet the requirements at the poses that the search held, best first.
    pub candidates: Vec<Checked>,
    /// What became of the three-fold symmetry of a design that names no symmetry; `None` where it has none, names one, or the search could not break it.
    pub symmetry: Option<StartSymmetry>,
    /// What was found on the way.
    pub evidence: OptimizeEvidence,
}

/// The evidence of an [`OptimizeReport`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum OptimizeEvidence {
    /// Of offsets alone, for the best worst-case conditioning: branches, bound, re-check.
    Offsets(Box<OffsetReport>),
    /// Of a platform under requirements.
    Dimensions {
        /// The search.
        report: Box<DimensionalReport>,
        /// The platform it found, evaluated by code that the search does not use.
        checked: Option<Box<Checked>>,
    },
}

/// The status and the value of what was optimised.
impl std::fmt::Display for OptimizeReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.status)?;
        match &self.evidence {
            OptimizeEvidence::Offsets(report) => match report.solution() {
                Some(s) => {
                    let (value, det) = (s.recheck.objective, s.recheck.det.abs());
                    write!(f, ": worst inverse condition number {value:.6}, |det A| {det:.6}")
                }
                None => Ok(()),
            },
            OptimizeEvidence::Dimensions { checked, .. } => {
                let objectives = checked.iter().flat_map(|c| &c.objectives);
                for (k, (objective, value)) in objectives.enumerate() {
                    write!(f, "{}{} {value:.6}", if k == 0 { ": " } else { ", " }, objective.code())?;
                }
                Ok(())
            }
        }
    }
}

impl Design {
    /// The best platform for this design: under all its requirements where it has any, else the equivalent platform without shared joints with the best
    /// worst-case conditioning.
    ///
    /// # Errors
    /// A design that cannot be optimised as it asks: one that is not octahedral and names no other variables, for instance.
    pub fn optimize(&self) -> Result<OptimizeReport, Error> {
        self.optimize_with(OptimizeOptions::new())
    }

    /// As [`optimize`](Self::optimize), with options.
    ///
    /// # Errors
    /// As [`optimize`](Self::optimize).
    pub fn optimize_with(&self, mut options: OptimizeOptions<'_>) -> Result<OptimizeReport, Error> {
        let (seed, threads) = (options.seed, options.threads.count(MOST_THREADS));
        if let Some(file) = &self.drive_table {
            return Err(Error::DriveTable(file.clone()));
        }
        if let Some(home) = hopeless_home(self, options.extension) {
            return Err(Error::SingularHome(home));
        }
        if let Some(sized) = with_sizes_to_choose(self) {
            return sized.optimize_with(options);
        }
        if asks_for_more(self) {
            if let Some(Combination::Pareto { .. }) = self.search.mode {
                return Err(Error::ParetoFront);
            }
            let search = ShapeSearchOptions { seed, threads, ..ShapeSearchOptions::default() };
            let found = find_platform(self, options.extension, &search, true, &mut |p| {
                options.flow(OptimizeProgress::Dimensions(p))
            })?;
            let judging = Judging::from(&search);
            let of = |s: &DimensionalSolution| checked(self, &found.problem, s, judging);
            let others = if options.candidates { &found.report.others[..] } else { &[] };
            let candidates = others.iter().map(of).collect::<Result<Vec<Checked>, VerifyError>>()?;
            return Ok(OptimizeReport {
                status: found.status(),
                design: found.checked.as_ref().map(|c| c.design.clone()),
                nearest: found.nearest.map(Box::new),
                candidates,
                symmetry: found.symmetry,
                evidence: OptimizeEvidence::Dimensions {
                    report: Box::new(found.report),
                    checked: found.checked.map(Box::new),
                },
            });
        }
        let octahedral = Octahedral::recognise(self.manipulator())?;
        let search = offsets::OffsetSearchOptions {
            seed,
            threads,
            survey: options.survey,
            gap: options.gap,
            ..offsets::OffsetSearchOptions::default()
        };
        let poses = self.workspace_or_default().sample(&self.home_or_default());
        let problem = offset_problem(self, octahedral, poses, options.extension);
        let report =
            offsets::optimize(&problem, &search, &mut |p| options.flow(OptimizeProgress::Offsets(p)))?;
        let judging = Judging { seed, until: None };
        let of = |s: &OffsetSolution| checked_offsets(self, &problem, s, judging);
        let checked = report.solution().map(of).transpose()?;
        Ok(OptimizeReport {
            status: offset_status(&report, checked.as_ref()),
            design: checked.map(|c| c.design),
            nearest: None,
            candidates: Vec::new(),
            symmetry: None,
            evidence: OptimizeEvidence::Offsets(Box::new(report)),
        })
    }
}

/// A singular home pose that the search cannot leave: neither the triangles nor the height of home are chosen, and
/// `det J` of an equivalent platform is that of the
/// design times a constant.
pub(crate) fn hopeless_home(design: &Design, extension: f64) -> Option<SingularHome> {
    let variables = dimensional_problem(design, extension).variables;
    let stays = variables.triangles == Triangles::Fixed && !variables.home_height;
    design.home_that_no_equivalent_holds().filter(|_| stays)
}

/// What became of a search for offsets, with the check that does not use its code.
pub(crate) fn offset_status(report: &OffsetReport, checked: Option<&Checked>) -> OptimizeStatus {
    let met = checked.map(Checked::met);
    match report.outcome {
        _ if report.interrupted => OptimizeStatus::Interrupted,
        _ if met.is_some_and(|met| met != Some(true)) => missed(met.flatten()),
        OffsetOutcome::Optimal(_) => OptimizeStatus::Optimal,
        OffsetOutcome::LocalOptimum(_) | OffsetOutcome::NotConverged(_) => OptimizeStatus::Feasible,
        OffsetOutcome::Infeasible => OptimizeStatus::Infeasible,
        OffsetOutcome::Undecided { .. } => OptimizeStatus::Undecided,
    }
}

/// What became of a search for a platform under requirements, with the check that does not use its code.
pub(crate) fn dimensional_status(report: &DimensionalReport, checked: Option<&Checked>) -> OptimizeStatus {
    match (&report.outcome, checked) {
        _ if report.interrupted => OptimizeStatus::Interrupted,
        (DimensionalOutcome::Infeasible(_), _) => OptimizeStatus::Infeasible,
        (_, None) => OptimizeStatus::Undecided,
        (outcome, Some(c)) => match (c.met(), outcome) {
            (Some(true), DimensionalOutcome::Optimal(_)) => OptimizeStatus::BestFound,
            (Some(true), _) => OptimizeStatus::Feasible,
            (met, _) => missed(met),
        },
    }
}

/// A platform that is not proved to meet its requirements is not called optimal or feasible.
fn missed(met: Option<bool>) -> OptimizeStatus {
    if met == Some(false) { OptimizeStatus::Violated } else { OptimizeStatus::Undecided }
}

/// What is known of the requirements with their reserves; `Some(true)` where there are none.
pub(crate) fn met_or_nothing_required(assessed: Option<&AssessReport>) -> Option<bool> {
    assessed.map_or(Some(true), AssessReport::met_with_reserve)
}

/// Whether a design asks for anything besides offsets with the best worst-case conditioning: requirements, other variables or objectives, or legs moved on families
/// because it has no offsets.
pub(crate) fn asks_for_more(design: &Design) -> bool {
    let plain = Requirements {
        min_joint_distance: design.optimize.min_joint_distance,
        reserves: design.reserves.clone(),
        ..Requirements::default()
    };
    design.search != files::design::SearchTable::default()
        || design.requirements() != plain
        || Octahedral::recognise(design.manipulator()).is_err()
}

/// The design with a reserve on every limit; `None` where it states one.
pub(crate) fn with_default_reserve(design: &Design) -> Option<Design> {
    let mut careful = design.clone();
    careful.reserves.all = Some(RESERVE_PERCENT);
    design.reserves.is_empty().then_some(careful)
}

/// The limits of a search for offsets without and with the reserves of the design: the least distance of joints and the least `|det A|`.
fn offset_limits(design: &Design, octahedral: &Octahedral) -> [[f64; 2]; 2] {
    let default = OffsetProblem::with_defaults(octahedral.clone(), Vec::new());
    let table = &design.optimize;
    let distance = table.min_joint_distance.unwrap_or(default.min_joint_distance);
    let det = table.min_abs_det.unwrap_or(default.min_abs_det);
    let required = Requirements { min_joint_distance: Some(distance), ..design.requirements() };
    let reserve = [TermKind::BaseSpacing, TermKind::PlatformSpacing].map(|kind| required.reserve(kind));
    let share = design.reserves.all.unwrap_or(0.0) / 100.0;
    [[distance, distance + reserve[0].max(reserve[1])], [det, det * (1.0 + share)]]
}

/// What the reserves add to the least distance of joints and to the least `|det A|` in a search for offsets.
pub(crate) fn offset_reserves(design: &Design, octahedral: &Octahedral) -> [f64; 2] {
    offset_limits(design, octahedral).map(|[stated, held]| held - stated)
}

/// The offsets of an octahedral design over these poses, within the limits of its `[optimize]` and with its reserves on them.
pub(crate) fn offset_problem(
    design: &Design,
    octahedral: Octahedral,
    poses: Vec<Pose>,
    extension: f64,
) -> OffsetProblem {
    let [[_, min_joint_distance], [_, min_abs_det]] = offset_limits(design, &octahedral);
    let default = OffsetProblem::with_defaults(octahedral, poses);
    OffsetProblem {
        characteristic_length: design.optimize.characteristic_length.unwrap_or(default.characteristic_length),
        min_joint_distance,
        min_abs_det,
        bounds: [(0.0 - extension, 1.0 + extension); 6],
        ..default
    }
}

/// The optimised platform as a design with the tables of the one it comes from.
pub(crate) fn optimised_design(
    design: &Design,
    problem: &OffsetProblem,
    s: &OffsetSolution,
    seed: u64,
) -> Design {
    let mut out = joint_free_design(design, &problem.octahedral, &s.manipulator, s.offsets);
    out.source.clone_from(&design.source);
    out.description = Some(format!(
        "Offsets optimised by equipod {} (seed {seed}) from the design \"{}\": worst inverse condition number {}",
        env!("CARGO_PKG_VERSION"),
        design.name,
        s.recheck.objective
    ));
    out.with_tables_of(design).into()
}

/// The platform with names: vertices keep theirs, an edge joint is named after its edge and given by its offset on it.
fn joint_free_design(design: &Design, o: &Octahedral, m: &Manipulator, t: [f64; 6]) -> DesignModel {
    let (base, platform) = (design.base_names(), design.platform_names());
    let base_name = |k: usize| base[o.base_indices()[k % 3]].clone();
    let platform_name = |k: usize| platform[o.platform_indices()[k % 3]].clone();
    // names belong to joints, whose order need not be that of the legs
    let (mut a, mut b) =
        (vec![String::new(); m.base_joints().len()], vec![String::new(); m.platform_joints().len()]);
    let mut origins = [vec![Origin::New; a.len()], vec![Origin::New; b.len()]];
    for (i, leg) in o.order().into_iter().enumerate() {
        let k = i / 2;
        let (on_base, on_platform) = m.pairs()[leg.get()];
        let corner = |of: [usize; 3], k: usize| of[k % 3];
        let edge = |of: [usize; 3]| Origin::Between([corner(of, k), corner(of, k + 1)], t[i]);
        let (first, second) = (o.base_indices(), o.platform_indices());
        (a[on_base], b[on_platform]) = match sliding_body(i) {
            Body::Base => (format!("{}_{}", base_name(k), base_name(k + 1)), platform_name(k)),
            Body::Platform => (base_name(k + 1), format!("{}_{}", platform_name(k), platform_name(k + 1))),
        };
        (origins[0][on_base], origins[1][on_platform]) = match sliding_body(i) {
            Body::Base => (edge(first), Origin::Kept(corner(second, k))),
            Body::Platform => (Origin::Kept(corner(first, k + 1)), edge(second)),
        };
    }
    let plain =
        DesignModel::new(format!("{}, separate joints", design.name), design.units.clone(), m.clone());
    let distinct = |v: &[String]| v.iter().enumerate().all(|(i, x)| !v[..i].contains(x));
    let named =
        if distinct(&a) && distinct(&b) { plain.clone().with_joint_names(a, b) } else { Ok(plain.clone()) };
    named.unwrap_or(plain).constructed_from(design, [&origins[0], &origins[1]])
}

/// A platform with the evidence gathered by other code.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Checked {
    /// The platform as a design.
    pub design: Design,
    /// Requirements of the search, densely: those of the design, and the room of joints that offsets separate.
    pub assessment: Assessment,
    /// What [`Design::assess`] says of the design; `None` where it requires nothing.
    pub assessed: Option<AssessReport>,
    /// Objectives, densely.
    pub objectives: Vec<(Objective, f64)>,
    /// Of the poses that the search held, the one with the worst conditioning and its place among them, where the first objective is the worst conditioning.
    pub worst_pose: Option<(usize, Pose)>,
    /// Equivalence with the design, where the variables keep it.
    pub verification: Option<Verification>,
}

impl Checked {
    /// Whether the platform meets the requirements with the reserve on each: proved by [`Design::assess`] either way, or `None`.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        if self.assessment.all_met() { met_or_nothing_required(self.assessed.as_ref()) } else { Some(false) }
    }
}

/// The design with the sizes of its bodies and the height of home to choose, where it requires something, names no variables, and no leg of it can be replaced; else `None`.
pub(crate) fn with_sizes_to_choose(design: &Design) -> Option<Design> {
    let usual = design.search.variables.is_empty() && Octahedral::recognise(design.manipulator()).is_err();
    if !usual || design.requirements() == Requirements::default() {
        return None;
    }
    let problem = dimensional_problem(design, EXTENSION);
    if !matches!(dimensional::why_not(&problem), Some(InvalidProblem::NoFamily)) {
        return None;
    }
    let mut out = design.clone();
    out.search.variables = vec![VariableKind::TriangleSizes, VariableKind::HomeHeight];
    Some(out)
}

/// The problem of a design.
pub(crate) fn dimensional_problem(design: &Design, extension: f64) -> DimensionalProblem {
    let (m, table, search) = (design.manipulator(), &design.optimize, &design.search);
    let home = design.home_or_default();
    let space = design.workspace_or_default().space(&home);
    let usual =
        if Octahedral::recognise(m).is_ok() { VariableKind::Offsets } else { VariableKind::Components };
    let kinds =
        if search.variables.is_empty() { std::slice::from_ref(&usual) } else { &search.variables[..] };
    let mut variables = Variables::of(kinds);
    variables.symmetry = search.symmetry.unwrap_or_default();
    variables.fixed_ends = fixed_ends(design);
    if Body::BOTH.into_iter().all(|body| variables.keeps_body(body)) {
        variables.triangles = Triangles::Fixed;
    }
    variables.offset_bounds = [search.offset_bounds.unwrap_or((0.0 - extension, 1.0 + extension)); 6];
    variables.stretch_bounds = search.stretch_bounds.unwrap_or(variables.stretch_bounds);
    variables.height_bounds = search.height_bounds.unwrap_or(variables.height_bounds);
    let mut requirements = design.requirements();
    let octahedral = Octahedral::recognise(m).ok().map(|o| OffsetProblem::with_defaults(o, Vec::new()));
    if let (true, Some(default)) = (variables.offsets, &octahedral) {
        // joints that offsets separate need room, also where the design says nothing
        requirements.min_joint_distance.get_or_insert(default.min_joint_distance);
    }
    let objectives = if search.objectives.is_empty() {
        vec![(Objective::WorstConditioning, 1.0)]
    } else {
        search.objectives.clone()
    };
    let mode = match search.mode {
        Some(Combination::Lexicographic { slack }) => Mode::Lexicographic { slack },
        _ => Mode::Weighted,
    };
    DimensionalProblem {
        characteristic_length: design.characteristic_length(),
        min_abs_det: table.min_abs_det.unwrap_or(optimize::offsets::DEFAULT_MIN_ABS_DET),
        manipulator: m.clone(),
        requirements,
        space,
        variables,
        objectives,
        mode,
    }
}

/// Legs whose ends are at joints that no search may move, base first.
fn fixed_ends(design: &Design) -> [[bool; 6]; 2] {
    let fixed = Body::BOTH.map(|body| design.fixed_joints(body));
    let pairs = design.manipulator().pairs();
    [pairs.map(|(base, _)| fixed[0][base]), pairs.map(|(_, platform)| fixed[1][platform])]
}

/// How a platform that was found is judged.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Judging {
    /// Seed of the search, and of the poses looked at.
    pub(crate) seed: u64,
    /// When proofs end with what they have.
    pub(crate) until: Option<Instant>,
}

impl From<&ShapeSearchOptions> for Judging {
    fn from(options: &ShapeSearchOptions) -> Self {
        Self { seed: options.seed, until: options.until }
    }
}

/// The platform as a design, evaluated by code that the optimiser does not use.
pub(crate) fn checked(
    design: &Design,
    problem: &DimensionalProblem,
    s: &DimensionalSolution,
    judging: Judging,
) -> Result<Checked, VerifyError> {
    let out = optimised(design, problem, s, judging.seed);
    let v = &problem.variables;
    let keeps_class = (v.offsets || v.components) && v.triangles == Triangles::Fixed;
    judged(design, problem, out, (&s.home, &s.poses), keeps_class, judging)
}

/// The platform of a search for offsets, evaluated in the same way.
pub(crate) fn checked_offsets(
    design: &Design,
    problem: &OffsetProblem,
    s: &OffsetSolution,
    judging: Judging,
) -> Result<Checked, VerifyError> {
    let general = as_dimensional(design, problem);
    let out = optimised_design(design, problem, s, judging.seed);
    judged(design, &general, out, (&design.home_or_default(), &problem.poses), true, judging)
}

/// The question of a search for offsets as that of a search under requirements.
fn as_dimensional(design: &Design, problem: &OffsetProblem) -> DimensionalProblem {
    let mut general = dimensional_problem(design, EXTENSION);
    general.variables.offset_bounds = problem.bounds;
    general.characteristic_length = problem.characteristic_length;
    let [[min_joint_distance, _], [min_abs_det, _]] = offset_limits(design, &problem.octahedral);
    general.min_abs_det = min_abs_det;
    general.requirements.min_joint_distance = Some(min_joint_distance);
    general
}

/// A platform found for a design over poses that were held, evaluated by code that no search uses; `keeps_class`: it is meant to be equivalent to the design.
fn judged(
    design: &Design,
    problem: &DimensionalProblem,
    out: Design,
    (home, held): (&Pose, &[Pose]),
    keeps_class: bool,
    Judging { seed, until }: Judging,
) -> Result<Checked, VerifyError> {
    let space = problem.space.with_home(*home);
    let requirements = Requirements { hardware: out.hardware, ..problem.requirements.clone() };
    let options = AssessOptions::new().points(POINTS).seed(seed);
    // the platform that is written, which may differ from that of the search by rounding
    let platform = out.manipulator();
    let assessment = assess(platform, &requirements, &space, &options);
    let values = evaluate(problem, platform, &space, held, POINTS, seed);
    let objectives: Vec<(Objective, f64)> = problem.objectives.iter().map(|o| o.0).zip(values).collect();
    let conditioned = objectives.first().is_some_and(|o| o.0 == Objective::WorstConditioning);
    let worst_pose =
        if conditioned { worst_conditioned(platform, held, problem.characteristic_length) } else { None };
    let verification = if keeps_class {
        let plan = sample_plan(design, SAMPLES, seed);
        let options = FkOptions::new().seed(seed);
        Some(verify(design.manipulator(), platform, &plan, &options)?)
    } else {
        None
    };
    let assessed = out.assessed_until(seed, until);
    Ok(Checked { design: out, assessment, assessed, objectives, worst_pose, verification })
}

/// The pose with the least inverse condition number, with its place.
fn worst_conditioned(m: &Manipulator, poses: &[Pose], length: f64) -> Option<(usize, Pose)> {
    let value = |pose: &Pose| inverse_condition(&jacobian(m, pose, length));
    let values = poses.iter().map(value).enumerate();
    let (k, _) = values.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((k, poses[k]))
}

/// The platform with the tables of the design, its axes and its home.
fn optimised(design: &Design, problem: &DimensionalProblem, s: &DimensionalSolution, seed: u64) -> Design {
    let octahedral = Octahedral::recognise(design.manipulator()).ok().zip(s.offsets);
    let mut out = if let Some((o, t)) = octahedral {
        // triangles that are not chosen are those of the design, to the last digit
        let fixed = problem.variables.triangles == Triangles::Fixed;
        let own = if fixed { joint_free(&o, t).ok() } else { None };
        joint_free_design(design, &o, own.as_ref().map_or(&s.manipulator, |(m, _)| m), t)
    } else {
        let name = format!("{}, optimised", design.name);
        let plain = DesignModel::new(name, design.units.clone(), s.manipulator.clone());
        let (base, platform) = (design.base_names().to_vec(), design.platform_names().to_vec());
        let kept = [base.len(), platform.len()].map(|n| (0..n).map(Origin::Kept).collect::<Vec<_>>());
        let named = plain.clone().with_joint_names(base, platform);
        // joints that have stayed where they were
        named.map_or(plain, |named| named.constructed_from(design, [&kept[0], &kept[1]]))
    };
    out.source.clone_from(&design.source);
    let best: Vec<String> = s.objectives.iter().map(|(o, v)| format!("{} {v}", o.code())).collect();
    out.description = Some(format!(
        "Optimised by equipod {} (seed {seed}) from the design \"{}\": {}",
        env!("CARGO_PKG_VERSION"),
        design.name,
        best.join(", ")
    ));
    let mut out = out.with_tables_of(design);
    if design.home.is_some() || problem.variables.home_height {
        out.home = Some(s.home);
    }
    for (swing, axes) in
        [(&mut out.hardware.base_swing, s.axes[0]), (&mut out.hardware.platform_swing, s.axes[1])]
    {
        if let (Some(swing), Some(axes)) = (swing, axes) {
            swing.axes = JointAxes::Given(axes);
        }
    }
    out.into()
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use num::Rng;

    /// Over random triangles, leg orders and offsets: the joint `X` is where the design has it, the joint `X_Y` on the line of `X` and `Y` and on no vertex.
    #[test]
    fn joints_are_where_their_names_say() {
        let mut rng = Rng::new(8);
        for _ in 0..60 {
            let mut triangle = |z: f64| -> Vec<Point3<f64>> {
                (0..3).map(|_| Point3::new(rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), z)).collect()
            };
            let (base, platform) = (triangle(0.0), triangle(1.0));
            let mut legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
            for k in (1..6).rev() {
                legs.swap(k, (rng.next_u64() % (k as u64 + 1)) as usize);
            }
            let m = Manipulator::try_new(base, platform, legs).unwrap();
            let names = |letter: &str| (1..=3).map(|k| format!("{letter}{k}")).collect::<Vec<_>>();
            let design = Design::new("drawn", "mm", m).with_joint_names(names("B"), names("Q")).unwrap();
            let o = Octahedral::recognise(design.manipulator()).unwrap();
            let t: [f64; 6] = std::array::from_fn(|_| rng.uniform(-1.0, 2.0));
            let (platform, _) = joint_free(&o, t).unwrap();
            let built = joint_free_design(&design, &o, &platform, t);
            let mut on_edges = 0;
            let old_joints = [design.manipulator().base_joints(), design.manipulator().platform_joints()];
            let old_names = [design.base_names(), design.platform_names()];
            let new_joints = [built.manipulator().base_joints(), built.manipulator().platform_joints()];
            for (body, list) in [built.base_names(), built.platform_names()].into_iter().enumerate() {
                let place =
                    |name: &str| old_joints[body][old_names[body].iter().position(|n| n == name).unwrap()];
                for (name, joint) in list.iter().zip(new_joints[body]) {
                    let Some((x, y)) = name.split_once('_') else {
                        assert!((joint - place(name)).norm() < 1e-12, "{name}");
                        continue;
                    };
                    let (edge, gap) = (place(y) - place(x), joint - place(x));
                    assert!(edge.cross(&gap).norm() < 1e-9 * edge.norm(), "{name} is off its line");
                    assert!(old_joints[body].iter().all(|v| (joint - v).norm() > 1e-9), "{name} is a vertex");
                    on_edges += 1;
                }
            }
            assert_eq!(on_edges, 6);
        }
    }
}
