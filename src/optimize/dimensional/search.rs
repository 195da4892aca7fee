//! Populations, climbs from their best members, and polishing of the best ends with added poses until none is worse.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::time::Instant;

use super::conflict::{ConflictOutcome, conflict, demand, elastic, no_objective, unmet};
use super::leg_lines::HeldPose;
use super::model::Model;
use super::outcome::{
    ChosenVariable, ConstraintConflict, Demand, DimensionalOutcome, DimensionalReport, DimensionalSolution,
    outcome, solution,
};
use super::population::{Judge, PointMerit, evolve, is_close, leaders_first, offspring};
use super::problem::{DimensionalProblem, InvalidProblem, Mode};
use super::worst_pose::worse_poses;
use crate::climb::{Effort, PENALTY, Run, Task};
use num::Purpose;
use num::parallel::parallel;

/// Options of the search; none of them changes the requirements of a feasible design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShapeSearchOptions {
    /// Seed of the populations. The same seed gives the same answer for any number of threads.
    pub seed: u64,
    /// Worker threads (0 counts as 1).
    pub threads: usize,
    /// Number of separate populations.
    pub populations: usize,
    /// Generations of each.
    pub generations: usize,
    /// Number of members of each population with climbs in the first pass.
    pub starts: usize,
    /// Number of polished runs.
    pub polished: usize,
    /// Optional end time of everything, including the judgement of the results. `progress` ends the search itself.
    pub until: Option<Instant>,
}

impl ShapeSearchOptions {
    /// Whether the time of everything is over.
    #[must_use]
    pub fn is_late(&self) -> bool {
        self.until.is_some_and(|end| Instant::now() >= end)
    }
}

impl Default for ShapeSearchOptions {
    fn default() -> Self {
        Self { seed: 1, threads: 1, populations: 12, generations: 15, starts: 6, polished: 8, until: None }
    }
}

/// A stage of the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Evolution of populations.
    Populations,
    /// Climbs of the first pass.
    Climbs,
    /// Polished runs, or steps of a front.
    Polishing,
    /// Search for conflicting requirements, if no run meets all of them.
    Conflict,
}

/// Progress of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Stage.
    pub stage: Stage,
    /// Done in this stage.
    pub done: usize,
    /// Total number.
    pub total: usize,
    /// Best value of the first objective so far among runs that meet the requirements, in its unit.
    pub best: Option<f64>,
    /// The least violation so far at the held poses, in the scale of the most violated constraint, and that constraint.
    /// `None` before the first run.
    pub violation: Option<(Demand, f64)>,
}

/// The progress in words.
impl std::fmt::Display for Progress {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.best, self.violation) {
            (Some(best), _) => write!(f, "best {best:.6}; ")?,
            (None, Some((demand, x))) if x > 0.0 => {
                write!(f, "nothing meets the requirements yet, {demand} is off by {x:.1e} of its scale; ")?;
            }
            _ => {}
        }
        let stage = match self.stage {
            Stage::Populations => "population",
            Stage::Climbs => "climb",
            Stage::Polishing => "polish",
            Stage::Conflict => "conflict, run",
        };
        write!(f, "{stage} {} of {}", self.done, self.total)
    }
}

/// One in this many populations evolves longer: young populations cover many basins, old ones the deep ones.
const LONG_EVERY: usize = 3;
/// Factor of the generations of such a population.
const LONG_FACTOR: usize = 4;
/// Number of poses of the first pass.
const FEW_POSES: usize = 16;
/// Greatest number of batches of polished runs while others are more promising.
const BATCHES: usize = 6;
/// Number of generations of mixtures of the ends.
const GENERATIONS_OF_ENDS: usize = 2;
/// Number of starts per mixture of a generation.
const STARTS_PER_MIXTURE: usize = 4;
/// Greatest number of rounds of adding poses in the first pass.
const SHORT_ROUNDS: usize = 3;
/// Greatest number of rounds of adding poses.
const ROUNDS: usize = 12;
/// Starts, and ends, that differ by less in every variable count as one.
const DISTINCT: f64 = 0.1;
/// Ends whose values differ by less, relatively, count as equal.
const DISTINCT_GAINS: f64 = 1e-4;
/// The same for ends of the first pass, whose climbs are less accurate.
const SAME_END: f64 = 1e-3;

/// A polished run with its final poses.
#[derive(Debug, Clone)]
pub(crate) struct RefinedRun {
    pub run: Run,
    pub poses: Vec<HeldPose>,
    pub complete: bool,
}

/// The rule for adding poses to a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PoseAdding {
    /// Until the result is worse at no further pose.
    UntilNoneIsWorse,
    /// While the run meets the requirements too: more poses only increase an existing violation.
    WhileMet,
}

/// Climbs, adds the poses at which the result is worse, and repeats.
pub(super) fn refine(
    model: &Model<'_>,
    task: &Task,
    start: &[f64],
    poses: Vec<HeldPose>,
    seed: u64,
) -> RefinedRun {
    refine_adding(PoseAdding::UntilNoneIsWorse, model, task, start, poses, seed)
}

/// [`refine`] with a rule for adding poses.
pub(crate) fn refine_adding(
    adding: PoseAdding,
    model: &Model<'_>,
    task: &Task,
    start: &[f64],
    mut poses: Vec<HeldPose>,
    seed: u64,
) -> RefinedRun {
    let mut run = model.climb(&poses, task, start, Effort::POLISH);
    // a run with an objective ends once it misses a requirement; one without continues to the best it can meet
    let only_while_met = adding == PoseAdding::WhileMet || task.weights.iter().any(|w| *w > 0.0);
    let mut complete = false;
    for round in 0..ROUNDS {
        if only_while_met && !run.is_feasible() || model.is_stopped() {
            break;
        }
        let sign = model.sign(&run.x);
        let worse = worse_poses(model, &run.x, task, &poses, sign, seed.wrapping_add(round as u64));
        complete = worse.is_empty();
        if complete {
            break;
        }
        poses.extend(worse);
        run = model.climb(&poses, task, &run.x, Effort::POLISH).after(run.history);
    }
    RefinedRun { run, poses, complete }
}

/// A climb of the first pass.
struct Climbed {
    /// The population of its start; none for a mixture of ends.
    population: Option<usize>,
    run: Run,
}

/// A point with its most important poses.
pub(crate) struct SearchStart {
    pub x: Vec<f64>,
    few: Vec<HeldPose>,
    /// The population it comes from; none for a mixture of ends.
    population: Option<usize>,
}

/// Distinct members of a population: the best of every niche, then others.
pub(super) fn population(
    model: &Model<'_>,
    task: &Task,
    given: &[Vec<f64>],
    k: usize,
    o: &ShapeSearchOptions,
) -> Vec<SearchStart> {
    let mut judge = Judge::new(model, task);
    let is_long = k % LONG_EVERY == LONG_EVERY - 1;
    let generations = if is_long { LONG_FACTOR * o.generations } else { o.generations };
    let members = evolve(&mut judge, given, generations, &mut Purpose::POPULATIONS.item(o.seed, k as u64));
    let few: Vec<HeldPose> = judge.poses().iter().take(FEW_POSES).copied().collect();
    let mut out: Vec<SearchStart> = Vec::new();
    for m in leaders_first(model, members) {
        if out.len() < o.starts.max(1) && !out.iter().any(|s| are_near(&s.x, &m.x, DISTINCT)) {
            out.push(SearchStart { x: m.x, few: few.clone(), population: Some(k) });
        }
    }
    out
}

fn are_near(a: &[f64], b: &[f64], within: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < within)
}

pub(super) fn better(task: &Task, a: &Run, b: &Run) -> std::cmp::Ordering {
    let (fa, fb) = (a.is_feasible(), b.is_feasible());
    fb.cmp(&fa).then(if fa && fb {
        b.judged.gain(task).total_cmp(&a.judged.gain(task))
    } else {
        a.judged.total_violation(task).total_cmp(&b.judged.total_violation(task))
    })
}

/// The first task of the levels: weights and the share that later levels may give up.
fn first_task(p: &DimensionalProblem) -> Task {
    let n = p.objectives.len();
    let weights = match p.mode {
        Mode::Weighted => p.objectives.iter().map(|o| o.1).collect(),
        Mode::Lexicographic { .. } => (0..n).map(|m| if m == 0 { 1.0 } else { 0.0 }).collect(),
    };
    Task { weights, floors: vec![None; n], dropped: Vec::new(), soft: None }
}

/// The result of the search for one task.
pub(crate) struct SearchedShape {
    /// Best first; feasible ones before the others.
    pub refined: Vec<RefinedRun>,
    pub starts: usize,
    pub feasible: usize,
}

/// A short climb over few poses, repeated with those at which its end is worse.
fn rank(model: &Model<'_>, task: &Task, start: &SearchStart) -> Run {
    let mut few = start.few.clone();
    let mut run = model.climb(&few, task, &start.x, Effort::RANK);
    let judge = Judge::new(model, task);
    for _ in 0..SHORT_ROUNDS {
        let mut more = judge.worst(&run.x, FEW_POSES);
        more.retain(|at| !few.contains(at));
        if more.is_empty() {
            break;
        }
        few.extend(more);
        run = model.climb(&few, task, &run.x, Effort::RANK).after(run.history);
    }
    run
}

/// Reports progress; stops when the caller asks.
pub(crate) struct ProgressReport<'w, 'm, 'a> {
    model: &'m Model<'a>,
    best: Option<f64>,
    violation: Option<(Demand, f64)>,
    progress: &'w mut dyn FnMut(Progress) -> ControlFlow<()>,
}

impl<'w, 'm, 'a> ProgressReport<'w, 'm, 'a> {
    pub(super) fn new(
        model: &'m Model<'a>,
        progress: &'w mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Self {
        Self { model, best: None, violation: None, progress }
    }

    /// Records the violation of a run.
    fn see(&mut self, run: &Run) {
        let worst = run.judged.violations.iter().max_by(|a, b| a.1.total_cmp(b.1));
        let missed = worst.map(|(group, x)| (demand(self.model, *group), *x));
        let is_less = |x: f64| self.violation.is_none_or(|(_, least)| x < least);
        self.violation = missed.filter(|(_, x)| is_less(*x)).or(self.violation);
    }

    pub(super) fn tell(&mut self, stage: Stage, (done, total): (usize, usize), run: Option<&Run>) {
        if let Some(run) = run.filter(|r| r.is_feasible())
            && let (Some(o), Some(gain)) = (self.model.objectives.first(), run.judged.gains.first())
        {
            let (value, unit) = (gain * self.model.unit(*o), self.model.unit(*o));
            self.best = Some(match self.best {
                Some(best) if best * unit.signum() >= value * unit.signum() => best,
                _ => value,
            });
        }
        let Self { best, violation, .. } = *self;
        self.model.heed((self.progress)(Progress { stage, done, total, best, violation }));
    }
}

/// An end of the first pass.
struct FirstPassEnd {
    /// Values of all variables.
    x: Vec<f64>,
    run: Run,
}

impl FirstPassEnd {
    fn new(model: &Model<'_>, without_axes: bool, run: Run) -> Self {
        let mut x = run.x.clone();
        x.resize(model.shape.start.len(), 0.0);
        if without_axes {
            model.aim(&mut x);
        }
        Self { x, run }
    }
}

/// The ends of the first pass, and the poses learnt from refining some of them.
struct FirstPass {
    points: Vec<FirstPassEnd>,
    tried: Vec<usize>,
    /// Initial poses of the refinement.
    poses: Vec<HeldPose>,
}

impl FirstPass {
    /// The most promising untried ends with different values, better than `best`, by their merit over the known poses.
    fn choose(&self, model: &Model<'_>, task: &Task, best: f64, count: usize) -> Vec<usize> {
        let mut judge = Judge::over(model, task, self.poses.clone());
        let worths: Vec<Option<PointMerit>> =
            self.points.iter().map(|e| judge.worth(&e.run.x, usize::MAX, None)).collect();
        let tried: Vec<PointMerit> = self.tried.iter().filter_map(|k| worths[*k]).collect();
        let mut order: Vec<(usize, PointMerit)> =
            worths.into_iter().enumerate().filter_map(|(k, w)| Some((k, w?))).collect();
        // the merit of the climbs: a small violation at new poses can outweigh a poor value without one
        order.sort_by(|a, b| b.1.merit(PENALTY).total_cmp(&a.1.merit(PENALTY)).then(a.0.cmp(&b.0)));
        let mut chosen: Vec<(usize, PointMerit)> = Vec::new();
        for (k, worth) in order {
            // symmetric platforms have the same optimum repeatedly
            let known = chosen.iter().map(|c| &c.1).chain(&tried);
            let is_known = known.into_iter().any(|w| w.is_close(&worth, DISTINCT_GAINS));
            let promises_more = worth.merit(PENALTY) > best;
            if chosen.len() < count && promises_more && !is_known {
                chosen.push((k, worth));
            }
        }
        chosen.into_iter().map(|c| c.0).collect()
    }

    /// Records poses of refined ends, which are also important for the others.
    fn learn(&mut self, poses: impl Iterator<Item = HeldPose>) {
        for at in poses {
            if !self.poses.contains(&at) {
                self.poses.push(at);
            }
        }
    }
}

/// Populations, short climbs from their best members and from mixtures of the ends, and polishing of the best ends.
pub(crate) fn search_task(
    model: &Model<'_>,
    task: &Task,
    given: &[Vec<f64>],
    options: &ShapeSearchOptions,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> SearchedShape {
    let without_axes = model.without_axes();
    let coarse = without_axes.as_ref().unwrap_or(model);
    let search = TaskSearch { model, coarse, task, options };
    let (runs, unmet) = search.first_pass(&search.given(given), watch);
    let (climbed, feasible) = (runs.len(), runs.iter().filter(|c| c.run.is_feasible()).count());
    let mut refined = unmet.unwrap_or_else(|| {
        let points =
            runs.into_iter().map(|c| FirstPassEnd::new(model, without_axes.is_some(), c.run)).collect();
        let ends = FirstPass { poses: model.first_poses(), points, tried: Vec::new() };
        search.polished(ends, watch)
    });
    refined.sort_by(|a, b| better(task, &a.run, &b.run));
    SearchedShape { refined, starts: climbed, feasible }
}

/// Whether no other end is expected after `trials` independent trials with `ends` different ends.
///
/// The Bayesian estimate of the number of ends is `w (n - 1) / (n - w - 2)` for `w` ends of `n` trials. No other end is
/// expected if the estimate is below `w + 1/2` (Boender, Rinnooy Kan 1987). This is no proof: an end that few trials
/// reach may be missing.
pub(super) fn expects_no_other(trials: usize, ends: usize) -> bool {
    let (n, w) = (trials as f64, ends as f64);
    n > w + 2.0 && w * (n - 1.0) / (n - w - 2.0) < w + 0.5
}

/// Common data of the steps of a search for one task.
#[derive(Clone, Copy)]
struct TaskSearch<'s, 'a> {
    model: &'s Model<'a>,
    /// The model of the first pass: joint axes follow from the legs and are not variables.
    coarse: &'s Model<'a>,
    task: &'s Task,
    options: &'s ShapeSearchOptions,
}

impl TaskSearch<'_, '_> {
    /// The given points, and the design itself unless its offsets are variables, in the variables of the first pass.
    fn given(&self, given: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let start = &self.model.shape.start;
        let mut out: Vec<Vec<f64>> = given.iter().filter(|x| x.len() == start.len()).cloned().collect();
        if self.model.shape.offset_variables().is_none() {
            out.push(start.clone());
        }
        for x in &mut out {
            x.truncate(self.coarse.shape.start.len());
        }
        out
    }

    /// The best members of some populations and the given points, which also start the first population.
    fn starts(
        &self,
        populations: std::ops::Range<usize>,
        given: &[Vec<f64>],
        watch: &mut ProgressReport<'_, '_, '_>,
    ) -> Vec<SearchStart> {
        let o = self.options;
        let (first, last) = (populations.start, populations.end);
        let given = if first == 0 { given } else { &[] };
        // the long ones, which are last in their batches, begin first
        let number = |i: usize| last - 1 - i;
        let evolved = |i: usize| {
            let known = if number(i) == 0 { given } else { &[] };
            population(self.coarse, self.task, known, number(i), o)
        };
        let total = o.populations.max(1);
        let tick = &mut |done: usize, _: &Vec<SearchStart>| {
            watch.tell(Stage::Populations, (first + done, total), None);
        };
        let mut members = parallel(last - first, o.threads, evolved, tick);
        members.reverse();
        let few: Vec<HeldPose> =
            members.first().and_then(|m| m.first()).map_or(Vec::new(), |s| s.few.clone());
        let given = given.iter().map(|x| SearchStart { x: x.clone(), few: few.clone(), population: Some(0) });
        members.into_iter().flatten().chain(given).collect()
    }

    /// Short climbs from the best members of the populations, batch after batch while other ends are expected, then
    /// from mixtures of their ends.
    ///
    /// If the requirements appear infeasible ([`unmet`]), it also returns runs towards the least violation, without
    /// further climbs.
    fn first_pass(
        &self,
        given: &[Vec<f64>],
        watch: &mut ProgressReport<'_, '_, '_>,
    ) -> (Vec<Climbed>, Option<Vec<RefinedRun>>) {
        let populations = self.options.populations.max(1);
        let mut runs: Vec<Climbed> = Vec::new();
        for first in (0..populations).step_by(LONG_EVERY) {
            let batch = first..populations.min(first + LONG_EVERY);
            let starts = self.starts(batch, given, watch);
            runs.extend(self.climbs(&starts, runs.len(), watch));
            let ended = self.are_all_found(&runs);
            let least = if ended { None } else { self.unmet(&runs, watch) };
            if ended || least.is_some() || self.model.is_stopped() {
                return (runs, least);
            }
        }
        let mixtures = runs.len().div_ceil(STARTS_PER_MIXTURE);
        let mut rng = Purpose::MIXTURES.rng(self.options.seed);
        for _ in 0..GENERATIONS_OF_ENDS {
            let mut judge = Judge::new(self.coarse, self.task);
            let ends: Vec<&[f64]> = runs.iter().map(|r| r.run.x.as_slice()).collect();
            let trials = offspring(&mut judge, &ends, mixtures, &mut rng);
            let with_poses =
                |x: Vec<f64>| SearchStart { few: judge.worst(&x, FEW_POSES), x, population: None };
            let mixed: Vec<SearchStart> = trials.into_iter().map(with_poses).collect();
            runs.extend(self.climbs(&mixed, runs.len(), watch));
            if self.model.is_stopped() {
                break;
            }
        }
        (runs, None)
    }

    /// [`unmet`], called if no climb met the requirements.
    fn unmet(&self, runs: &[Climbed], watch: &mut ProgressReport<'_, '_, '_>) -> Option<Vec<RefinedRun>> {
        if runs.iter().any(|c| c.run.is_feasible()) {
            return None;
        }
        let (model, without_axes) = (self.model, !std::ptr::eq(self.model, self.coarse));
        let ends: Vec<Vec<f64>> =
            runs.iter().map(|c| FirstPassEnd::new(model, without_axes, c.run.clone()).x).collect();
        unmet(model, &ends, self.options.threads, watch)
    }

    /// Whether further populations are unlikely to lead to another end.
    ///
    /// A trial of [`expects_no_other`] is a whole population, because its starts depend on each other; its outcome is
    /// its best end. Ends count as equal by their merit over the same poses.
    fn are_all_found(&self, runs: &[Climbed]) -> bool {
        let mut judge = Judge::new(self.coarse, self.task);
        let mut best: BTreeMap<usize, PointMerit> = BTreeMap::new();
        for Climbed { population, run } in runs {
            if let (Some(k), Some(end)) = (population, judge.worth(&run.x, usize::MAX, None)) {
                let own = best.entry(*k).or_insert(end);
                *own = if end.order(own).is_lt() { end } else { *own };
            }
        }
        let mut ends: Vec<PointMerit> = Vec::new();
        for end in best.values() {
            if !ends.iter().any(|known| known.is_close(end, SAME_END)) {
                ends.push(*end);
            }
        }
        expects_no_other(best.len(), ends.len())
    }

    /// A short climb from each start; `known` climbs of `total` are already done.
    fn climbs(
        &self,
        starts: &[SearchStart],
        known: usize,
        watch: &mut ProgressReport<'_, '_, '_>,
    ) -> Vec<Climbed> {
        let total = known + starts.len();
        let climbed = |k: usize| Climbed {
            population: starts[k].population,
            run: rank(self.coarse, self.task, &starts[k]),
        };
        let tick = &mut |done: usize, c: &Climbed| {
            watch.see(&c.run);
            watch.tell(Stage::Climbs, (known + done, total), None);
        };
        parallel(starts.len(), self.options.threads, climbed, tick)
    }

    /// Polishes the most promising ends, batch after batch, while others are more promising than the best result.
    fn polished(&self, mut ends: FirstPass, watch: &mut ProgressReport<'_, '_, '_>) -> Vec<RefinedRun> {
        let Self { model, coarse, task, options } = *self;
        let mut refined: Vec<RefinedRun> = Vec::new();
        for _ in 0..BATCHES {
            let gains = refined.iter().filter(|r| r.run.is_feasible()).map(|r| r.run.judged.gain(task));
            let best = gains.fold(f64::NEG_INFINITY, f64::max);
            let batch = ends.choose(coarse, task, best, options.polished.max(1));
            let polish = |i: usize| {
                let end = &ends.points[batch[i]];
                let (adding, poses) = (PoseAdding::WhileMet, ends.poses.clone());
                let refined = refine_adding(adding, model, task, &end.x, poses, options.seed);
                RefinedRun { run: refined.run.after(end.run.history.clone()), ..refined }
            };
            let size = batch.len();
            let tick =
                &mut |done: usize, r: &RefinedRun| watch.tell(Stage::Polishing, (done, size), Some(&r.run));
            let found = parallel(size, options.threads, polish, tick);
            ends.tried.extend(batch);
            ends.learn(found.iter().flat_map(|r| r.poses.iter().copied()));
            refined.extend(found);
            if size == 0 || model.is_stopped() {
                break;
            }
        }
        refined
    }
}

/// Finds the best platform that meets the requirements; the method is in `docs/theory/dimensional-synthesis.md`.
///
/// `given` are further starts, in the variables of [`super::DimensionalSolution::point`]. The answer is a local
/// optimum, the best of all starts. Requirements hold at the held poses, to which the worst poses between them were
/// added until none was worse. [`machine::requirements::assess`] checks this at separate poses.
///
/// # Errors
/// [`InvalidProblem`]. An infeasible problem is a regular outcome.
pub fn optimize(
    problem: &DimensionalProblem,
    given: &[Vec<f64>],
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<DimensionalReport, InvalidProblem> {
    searched(problem, given, options, true, progress)
}

/// [`optimize`] for a question that is repeated in another form after a failure. If no run meets the requirements, no
/// conflict is searched and the outcome is undecided.
///
/// # Errors
/// The errors of [`optimize`].
pub fn optimize_without_conflict(
    problem: &DimensionalProblem,
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<DimensionalReport, InvalidProblem> {
    searched(problem, &[], options, false, progress)
}

/// The reason why a problem is invalid; `None` for a valid one.
pub fn why_not(problem: &DimensionalProblem) -> Option<InvalidProblem> {
    Model::new(problem).err()
}

/// See [`optimize`]; `explains`: search for a conflict if no run meets the requirements.
fn searched(
    problem: &DimensionalProblem,
    given: &[Vec<f64>],
    options: &ShapeSearchOptions,
    explains: bool,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<DimensionalReport, InvalidProblem> {
    let model = Model::new(problem)?;
    let task = first_task(problem);
    let mut watch = ProgressReport::new(&model, progress);
    let SearchedShape { refined, starts, feasible } = search_task(&model, &task, given, options, &mut watch);
    let polished = refined.iter().map(|r| r.run.is_feasible().then(|| r.run.judged.gain(&task))).collect();
    let Conclusion { outcome, nearest, others } =
        concluded(&model, task, refined, (options, explains), &mut watch);
    Ok(DimensionalReport {
        outcome,
        starts,
        feasible,
        nearest,
        others,
        polished,
        seed: options.seed,
        interrupted: model.is_stopped(),
        conic_programs: model.conic.count(),
    })
}

/// A platform that meets the requirements of a problem at the held poses of the search, a local optimum; `None` if no
/// run meets them.
///
/// The search first meets the requirements without an objective, and then climbs for the objectives from the platform
/// found. `known` are values of variables by name, from which the first run starts, for instance those of a problem
/// with fewer variables.
///
/// # Errors
/// The errors of [`optimize`].
pub fn meet(
    problem: &DimensionalProblem,
    known: &[ChosenVariable],
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Option<DimensionalSolution>, InvalidProblem> {
    let model = Model::new(problem)?;
    let (task, plain) = (first_task(problem), no_objective(&model, Vec::new()));
    let mut start = model.shape.start.clone();
    for (x, name) in start.iter_mut().zip(&model.shape.names) {
        if let Some(known) = known.iter().find(|v| v.name == *name) {
            *x = known.value;
        }
    }
    let mut watch = ProgressReport::new(&model, progress);
    let (poses, seed) = (model.first_poses(), options.seed);
    let first = refine_adding(PoseAdding::WhileMet, &model, &plain, &start, poses, seed);
    watch.see(&first.run);
    let met = if first.run.is_feasible() {
        Some(first)
    } else {
        let found = search_task(&model, &plain, &[start], options, &mut watch);
        found.refined.into_iter().next().filter(|r| r.run.is_feasible())
    };
    let Some(met) = met else { return Ok(None) };
    let best = refine(&model, &task, &met.run.x, met.poses.clone(), seed);
    let best = if best.run.is_feasible() { &best } else { &met };
    Ok(solution(&model, &task, best))
}

/// The conclusion from polished runs.
struct Conclusion {
    outcome: DimensionalOutcome,
    /// The platform with the least violation, if none meets the requirements.
    nearest: Option<Box<DimensionalSolution>>,
    /// See [`DimensionalReport::others`].
    others: Vec<DimensionalSolution>,
}

/// The answer from the polished runs of the first task.
fn concluded(
    model: &Model<'_>,
    task: Task,
    mut refined: Vec<RefinedRun>,
    (options, explains): (&ShapeSearchOptions, bool),
    watch: &mut ProgressReport<'_, '_, '_>,
) -> Conclusion {
    let is_met = |refined: &[RefinedRun]| refined.first().is_some_and(|r| r.run.is_feasible());
    let unmet = |outcome, refined: &[RefinedRun]| {
        let nearest = refined.first().and_then(|r| solution(model, &task, r)).map(Box::new);
        Conclusion { outcome, nearest, others: Vec::new() }
    };
    if refined.is_empty() || !is_met(&refined) && model.is_stopped() {
        return unmet(DimensionalOutcome::Undecided(None), &refined);
    }
    if !is_met(&refined)
        && let Some(conflict) = met_or_conflict(model, &task, &mut refined, (options, explains), watch)
    {
        return unmet(DimensionalOutcome::Infeasible(conflict), &refined);
    }
    if !is_met(&refined) {
        return unmet(DimensionalOutcome::Undecided(refined[0].run.failure), &refined);
    }
    let (last_task, refined) = match model.problem.mode {
        Mode::Lexicographic { slack } => through_levels(model, task, refined, slack, options, watch),
        Mode::Weighted => (task, refined),
    };
    let others = other_optima(&last_task, &refined);
    let others = others.into_iter().filter_map(|r| solution(model, &last_task, r)).collect();
    Conclusion { outcome: outcome(model, &last_task, &refined[0]), nearest: None, others }
}

/// Runs that meet the requirements, best first, with ends distinct from the first and from each other.
fn other_optima<'r>(task: &Task, refined: &'r [RefinedRun]) -> Vec<&'r RefinedRun> {
    let others = refined.iter().skip(1).filter(|r| r.run.is_feasible());
    let mut kept = distinct(refined.iter().take(1).chain(others), |r| r.run.judged.gain(task));
    kept.split_off(kept.len().min(1))
}

/// Runs with distinct ends, the first of each end. Ends with equal values count as one, since symmetric platforms have
/// the same end repeatedly. Ends with nearly equal variables also count as one, as approached from two sides.
pub(super) fn distinct<'r>(
    runs: impl Iterator<Item = &'r RefinedRun>,
    value: impl Fn(&RefinedRun) -> f64,
) -> Vec<&'r RefinedRun> {
    let is_one = |a: &RefinedRun, b: &RefinedRun| {
        is_close(value(a), value(b), DISTINCT_GAINS) || are_near(&a.run.x, &b.run.x, DISTINCT)
    };
    let mut kept: Vec<&RefinedRun> = Vec::new();
    for run in runs {
        if !kept.iter().any(|known| is_one(known, run)) {
            kept.push(run);
        }
    }
    kept
}

/// Handles the case that no run meets the requirements. Climbs restart from runs without an objective that do, or the
/// conflict is returned if the question `explains`. Runs that only reduce the violation are merged with the others.
fn met_or_conflict(
    model: &Model<'_>,
    task: &Task,
    refined: &mut Vec<RefinedRun>,
    (options, explains): (&ShapeSearchOptions, bool),
    watch: &mut ProgressReport<'_, '_, '_>,
) -> Option<ConstraintConflict> {
    let settled = elastic(model, task, refined, options.threads, watch);
    let mut met = settled.iter().find(|r| r.run.is_feasible()).cloned();
    if met.is_none() && !explains {
        among(task, refined, settled);
        return None;
    }
    if met.is_none() {
        match conflict(model, &settled, options, watch) {
            ConflictOutcome::Conflict(conflict) => {
                among(task, refined, settled);
                return Some(conflict);
            }
            ConflictOutcome::Met(refined) => met = Some(*refined),
            ConflictOutcome::Unsettled => among(task, refined, settled),
        }
    }
    if let Some(met) = met {
        refined.insert(0, refine(model, task, &met.run.x, met.poses, options.seed));
        refined.sort_by(|a, b| better(task, &a.run, &b.run));
    }
    None
}

/// Merges runs into a list, best first.
fn among(task: &Task, refined: &mut Vec<RefinedRun>, more: Vec<RefinedRun>) {
    refined.extend(more);
    refined.sort_by(|a, b| better(task, &a.run, &b.run));
}

/// One objective after the other, each run giving up at most a share `slack` of the earlier ones; returns the last task
/// and its runs.
fn through_levels(
    model: &Model<'_>,
    mut task: Task,
    mut refined: Vec<RefinedRun>,
    slack: f64,
    options: &ShapeSearchOptions,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> (Task, Vec<RefinedRun>) {
    let levels = model.problem.objectives.len();
    for level in 1..levels {
        let gain = refined[0].run.judged.gains[level - 1];
        let floor = gain - slack * gain.abs();
        // local optima below the bound of this level cannot reach it
        let is_below = |r: &RefinedRun| r.run.judged.gains[level - 1] < floor;
        refined.retain(|r| r.run.is_feasible() && !is_below(r));
        task.floors[level - 1] = Some(floor);
        task.weights = (0..levels).map(|m| f64::from(u8::from(m == level))).collect();
        let again = |k: usize| {
            let from = &refined[k];
            refine(model, &task, &from.run.x, from.poses.clone(), options.seed)
        };
        let total = refined.len();
        let tick =
            &mut |done: usize, r: &RefinedRun| watch.tell(Stage::Polishing, (done, total), Some(&r.run));
        refined = parallel(total, options.threads, again, tick);
        refined.sort_by(|a, b| better(&task, &a.run, &b.run));
    }
    (task, refined)
}
