//! Populations, climbs from their best members, and the best ends polished while poses are added until none is worse.

use std::ops::ControlFlow;

use super::conflict::{Clash, conflict, elastic};
use super::model::{Model, Task};
use super::outcome::{DimensionalOutcome, DimensionalReport, outcome};
use super::population::{Judge, Worth, evolve, offspring};
use super::problem::{DimensionalProblem, InvalidProblem, Mode};
use super::scp::{Effort, PENALTY, Run, climb};
use super::terms::HeldPose;
use super::worst_pose::worse_poses;
use crate::num::Rng;
use crate::num::parallel::parallel;

/// Options of the search; none of them changes what is feasible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SearchOptions {
    /// Seed of the populations. Same seed, same answer, whatever the number of threads.
    pub seed: u64,
    /// Worker threads (0 counts as 1).
    pub threads: usize,
    /// Populations that evolve apart from each other.
    pub populations: usize,
    /// Generations of each.
    pub generations: usize,
    /// Members of each population from which the first pass climbs.
    pub starts: usize,
    /// Runs that are polished.
    pub polished: usize,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self { seed: 1, threads: 1, populations: 12, generations: 15, starts: 12, polished: 8 }
    }
}

/// A stage of the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Populations that evolve.
    Populations,
    /// Climbs of the first pass.
    Climbs,
    /// Polished runs, or steps of a front.
    Polishing,
}

/// How far the search is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Stage.
    pub stage: Stage,
    /// Done in this stage.
    pub done: usize,
    /// Of how many.
    pub total: usize,
    /// Best value of the first objective so far among runs that meet the requirements, in its unit.
    pub best: Option<f64>,
}

/// Every so many populations one evolves so many times as long: young populations have many basins, old ones the deep ones.
const LONG: (usize, usize) = (3, 4);
/// Poses of the first pass.
const FEW_POSES: usize = 16;
/// Batches of runs that are polished while others promise more.
const BATCHES: usize = 6;
/// Generations of mixtures of the ends, each a quarter as many as the starts.
const GENERATIONS_OF_ENDS: usize = 2;
/// Rounds of adding poses in the first pass.
const SHORT_ROUNDS: usize = 3;
/// Rounds of adding poses.
const ROUNDS: usize = 12;
/// Members that differ by more in some variable are starts of their own.
const DISTINCT_STARTS: f64 = 0.1;

/// A polished run with the poses it ended with.
#[derive(Debug, Clone)]
pub(crate) struct Refined {
    pub(crate) run: Run,
    pub(crate) poses: Vec<HeldPose>,
    pub(crate) complete: bool,
}

/// Climbs, adds the poses at which the result is worse, and climbs again.
pub(crate) fn refine(
    model: &Model<'_>,
    task: &Task,
    start: &[f64],
    mut poses: Vec<HeldPose>,
    seed: u64,
) -> Refined {
    let mut run = climb(model, &poses, task, start, Effort::POLISH);
    // more poses only make worse what misses a requirement already
    let hopeless = task.weights.iter().any(|w| *w > 0.0) && !run.is_feasible(model);
    let mut complete = false;
    for round in 0..ROUNDS {
        if hopeless || model.is_stopped() {
            break;
        }
        let sign = model.sign(&run.x);
        let worse = worse_poses(model, &run.x, task, &poses, sign, seed.wrapping_add(round as u64));
        complete = worse.is_empty();
        if complete {
            break;
        }
        poses.extend(worse);
        run = climb(model, &poses, task, &run.x, Effort::POLISH).after(run.history);
    }
    Refined { run, poses, complete }
}

/// A point with the poses that matter most near it.
pub(crate) struct Start {
    pub(crate) x: Vec<f64>,
    few: Vec<HeldPose>,
}

/// The best distinct members of a population.
pub(crate) fn population(
    model: &Model<'_>,
    task: &Task,
    given: &[Vec<f64>],
    k: usize,
    o: &SearchOptions,
) -> Vec<Start> {
    let mut judge = Judge::new(model, task);
    let generations = if k % LONG.0 == LONG.0 - 1 { LONG.1 * o.generations } else { o.generations };
    let members = evolve(&mut judge, given, generations, &mut Rng::stream(o.seed, 0x5347 + k as u64));
    let few: Vec<HeldPose> = judge.poses().iter().take(FEW_POSES).copied().collect();
    let mut out: Vec<Start> = Vec::new();
    for m in members {
        if out.len() < o.starts.max(1) && !out.iter().any(|s| are_near(&s.x, &m.x, DISTINCT_STARTS)) {
            out.push(Start { x: m.x, few: few.clone() });
        }
    }
    out
}

fn are_near(a: &[f64], b: &[f64], within: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < within)
}

pub(crate) fn better(model: &Model<'_>, task: &Task, a: &Run, b: &Run) -> std::cmp::Ordering {
    let (fa, fb) = (a.is_feasible(model), b.is_feasible(model));
    fb.cmp(&fa).then(if fa && fb {
        b.judged.gain(task).total_cmp(&a.judged.gain(task))
    } else {
        a.judged.total_violation(task).total_cmp(&b.judged.total_violation(task))
    })
}

/// The tasks of the levels: weights and the share that later levels may take.
fn first_task(p: &DimensionalProblem) -> Task {
    let n = p.objectives.len();
    let weights = match p.mode {
        Mode::Weighted => p.objectives.iter().map(|o| o.1).collect(),
        Mode::Lexicographic { .. } => (0..n).map(|m| if m == 0 { 1.0 } else { 0.0 }).collect(),
    };
    Task { weights, floors: vec![None; n], dropped: Vec::new(), soft: None }
}

/// What a search for one task found.
pub(crate) struct Searched {
    /// Best first; feasible ones before the others.
    pub(crate) refined: Vec<Refined>,
    pub(crate) starts: usize,
    pub(crate) feasible: usize,
}

/// A short climb over few poses, and again with those at which its end is worse.
fn rank(model: &Model<'_>, task: &Task, start: &Start) -> Run {
    let mut few = start.few.clone();
    let mut run = climb(model, &few, task, &start.x, Effort::RANK);
    let judge = Judge::new(model, task);
    for _ in 0..SHORT_ROUNDS {
        let mut more = judge.worst(&run.x, FEW_POSES);
        more.retain(|at| !few.contains(at));
        if more.is_empty() {
            break;
        }
        few.extend(more);
        run = climb(model, &few, task, &run.x, Effort::RANK).after(run.history);
    }
    run
}

fn climbs(
    model: &Model<'_>,
    task: &Task,
    starts: &[Start],
    o: &SearchOptions,
    tick: &mut dyn FnMut(usize),
) -> Vec<Run> {
    parallel(starts.len(), o.threads, |k| rank(model, task, &starts[k]), &mut |done, _| tick(done))
}

/// Tells how far the search is, and heeds the answer.
pub(crate) struct Watch<'w, 'm, 'a> {
    model: &'m Model<'a>,
    best: Option<f64>,
    progress: &'w mut dyn FnMut(Progress) -> ControlFlow<()>,
}

impl<'w, 'm, 'a> Watch<'w, 'm, 'a> {
    pub(crate) fn new(
        model: &'m Model<'a>,
        progress: &'w mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Self {
        Self { model, best: None, progress }
    }

    pub(crate) fn tell(&mut self, stage: Stage, (done, total): (usize, usize), run: Option<&Run>) {
        if let Some(run) = run.filter(|r| r.is_feasible(self.model))
            && let (Some(o), Some(gain)) = (self.model.objectives.first(), run.judged.gains.first())
        {
            let (value, unit) = (gain * self.model.unit(*o), self.model.unit(*o));
            self.best = Some(match self.best {
                Some(best) if best * unit.signum() >= value * unit.signum() => best,
                _ => value,
            });
        }
        self.model.heed((self.progress)(Progress { stage, done, total, best: self.best }));
    }
}

/// Populations, short climbs from their best members, and the best ends polished.
pub(crate) fn search_task(
    model: &Model<'_>,
    task: &Task,
    given: &[Vec<f64>],
    o: &SearchOptions,
    watch: &mut Watch<'_, '_, '_>,
) -> Searched {
    let coarse = model.without_axes();
    let first = coarse.as_ref().unwrap_or(model);
    let fits = |x: &&Vec<f64>| x.len() == model.shape.start.len();
    let mut given: Vec<Vec<f64>> = given.iter().filter(fits).cloned().collect();
    if model.shape.offset_variables().is_none() {
        given.push(model.shape.start.clone());
    }
    for x in &mut given {
        x.truncate(first.shape.start.len());
    }
    let total = o.populations.max(1);
    // the first population knows what is given
    let live = |k: usize| population(first, task, if k == 0 { &given } else { &[] }, k, o);
    let found =
        parallel(total, o.threads, live, &mut |done, _| watch.tell(Stage::Populations, (done, total), None));
    let few: Vec<HeldPose> = found.first().and_then(|f| f.first()).map_or(Vec::new(), |s| s.few.clone());
    let given = given.into_iter().map(|x| Start { x, few: few.clone() });
    let starts: Vec<Start> = found.into_iter().flatten().chain(given).collect();
    let total = starts.len() + GENERATIONS_OF_ENDS * starts.len().div_ceil(4);
    let mut ranked =
        climbs(first, task, &starts, o, &mut |done| watch.tell(Stage::Climbs, (done, total), None));
    let mut rng = Rng::stream(o.seed, 0x4d65);
    for _ in 0..GENERATIONS_OF_ENDS {
        let mut judge = Judge::new(first, task);
        let ends: Vec<&[f64]> = ranked.iter().map(|r| r.x.as_slice()).collect();
        let trials = offspring(&mut judge, &ends, starts.len().div_ceil(4), &mut rng);
        let with_poses = |x: Vec<f64>| Start { few: judge.worst(&x, FEW_POSES), x };
        let starts: Vec<Start> = trials.into_iter().map(with_poses).collect();
        let known = ranked.len();
        let tick = &mut |done| watch.tell(Stage::Climbs, (known + done, total), None);
        ranked.extend(climbs(first, task, &starts, o, tick));
    }
    let total = ranked.len();
    let feasible = ranked.iter().filter(|r| r.is_feasible(first)).count();
    let mut ends = Ends { poses: model.first_poses(), points: Vec::new(), tried: Vec::new() };
    ends.points = ranked.into_iter().map(|run| End::new(model, coarse.is_some(), run)).collect();
    let mut refined: Vec<Refined> = Vec::new();
    for _ in 0..BATCHES {
        let best = refined.iter().filter(|r| r.run.is_feasible(model)).map(|r| r.run.judged.gain(task));
        let batch = ends.choose(first, task, best.fold(f64::NEG_INFINITY, f64::max), o.polished.max(1));
        let polish = |i: usize| {
            let end = &ends.points[batch[i]];
            let refined = refine(model, task, &end.x, ends.poses.clone(), o.seed);
            Refined { run: refined.run.after(end.run.history.clone()), ..refined }
        };
        let total = batch.len();
        let tick = &mut |done: usize, r: &Refined| watch.tell(Stage::Polishing, (done, total), Some(&r.run));
        let found = parallel(total, o.threads, polish, tick);
        ends.tried.extend(batch);
        let more = found.iter().flat_map(|r| r.poses.iter().copied());
        ends.learn(more.collect());
        refined.extend(found);
        if total == 0 || model.is_stopped() {
            break;
        }
    }
    refined.sort_by(|a, b| better(model, task, &a.run, &b.run));
    Searched { refined, starts: total, feasible }
}

/// Finds the best platform that meets the requirements; `docs/theory/dimensional-synthesis.md` has the method.
///
/// `given` are further starts, in the variables of [`super::DimensionalSolution::point`]. The answer is a local optimum, the best of all starts.
/// Requirements hold at the held poses, to which the worst ones found between them were added until none was worse;
/// [`crate::requirements::assess`] checks that with formulas of its own.
///
/// # Errors
/// [`InvalidProblem`] when the problem cannot be asked. An infeasible problem is a value.
pub fn optimize(
    problem: &DimensionalProblem,
    given: &[Vec<f64>],
    options: &SearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<DimensionalReport, InvalidProblem> {
    let model = Model::new(problem)?;
    let mut task = first_task(problem);
    let mut watch = Watch::new(&model, progress);
    let mut found = search_task(&model, &task, given, options, &mut watch);
    let (starts, feasible) = (found.starts, found.feasible);
    let polished =
        found.refined.iter().map(|r| r.run.is_feasible(&model).then(|| r.run.judged.gain(&task))).collect();
    let report = |outcome| {
        let interrupted = model.is_stopped();
        DimensionalReport { outcome, starts, feasible, polished, seed: options.seed, interrupted }
    };
    let Some(first) = found.refined.first() else { return Ok(report(DimensionalOutcome::Undecided(None))) };
    if !first.run.is_feasible(&model) && model.is_stopped() {
        return Ok(report(DimensionalOutcome::Undecided(None)));
    }
    if !first.run.is_feasible(&model) {
        let settled = elastic(&model, &found.refined, options.threads);
        // a run without an objective that met all requirements is where to climb again
        let mut met = settled.iter().find(|r| r.run.is_feasible(&model)).cloned();
        if met.is_none() {
            match conflict(&model, &settled, options) {
                Clash::Conflict(conflict) => return Ok(report(DimensionalOutcome::Infeasible(conflict))),
                Clash::Met(refined) => met = Some(*refined),
                Clash::Unsettled => {}
            }
        }
        if let Some(met) = met {
            let again = refine(&model, &task, &met.run.x, met.poses, options.seed);
            found.refined.insert(0, again);
            found.refined.sort_by(|a, b| better(&model, &task, &a.run, &b.run));
        }
        if !found.refined[0].run.is_feasible(&model) {
            let failure = found.refined[0].run.failure;
            return Ok(report(DimensionalOutcome::Undecided(failure)));
        }
    }
    if let Mode::Lexicographic { slack } = problem.mode {
        for level in 1..problem.objectives.len() {
            let gain = found.refined[0].run.judged.gains[level - 1];
            task.floors[level - 1] = Some(gain - slack * gain.abs());
            task.weights = (0..problem.objectives.len()).map(|m| f64::from(u8::from(m == level))).collect();
            let again = |k: usize| {
                let from = &found.refined[k];
                refine(&model, &task, &from.run.x, from.poses.clone(), options.seed)
            };
            let total = found.refined.len();
            let tick =
                &mut |done: usize, r: &Refined| watch.tell(Stage::Polishing, (done, total), Some(&r.run));
            let mut refined = parallel(total, options.threads, again, tick);
            refined.sort_by(|a, b| better(&model, &task, &a.run, &b.run));
            found.refined = refined;
        }
    }
    Ok(report(outcome(&model, &task, &found.refined[0])))
}

/// Ends whose values differ by less, relatively, count as one.
const DISTINCT_GAINS: f64 = 1e-4;

/// An end of the first pass.
pub(crate) struct End {
    /// In all variables.
    pub(crate) x: Vec<f64>,
    pub(crate) run: Run,
}

impl End {
    pub(crate) fn new(model: &Model<'_>, without_axes: bool, run: Run) -> Self {
        let mut x = run.x.clone();
        x.resize(model.shape.start.len(), 0.0);
        if without_axes {
            model.aim(&mut x);
        }
        Self { x, run }
    }
}

/// The ends of the first pass, and what refining some of them taught.
pub(crate) struct Ends {
    pub(crate) points: Vec<End>,
    pub(crate) tried: Vec<usize>,
    /// Poses that refine starts with.
    pub(crate) poses: Vec<HeldPose>,
}

impl Ends {
    /// The most promising ends with different values that were not tried yet and promise more than `best`, by their worth over the poses known.
    pub(crate) fn choose(&self, model: &Model<'_>, task: &Task, best: f64, count: usize) -> Vec<usize> {
        let mut judge = Judge::over(model, task, self.poses.clone());
        let worths: Vec<Option<Worth>> =
            self.points.iter().map(|e| judge.worth(&e.run.x, usize::MAX, None)).collect();
        let mut order: Vec<(usize, Worth)> =
            worths.into_iter().enumerate().filter_map(|(k, w)| Some((k, w?))).collect();
        // the merit of the climbs: an end that misses little at poses it did not know is worth more than a poor one that misses nothing
        order.sort_by(|a, b| b.1.merit(PENALTY).total_cmp(&a.1.merit(PENALTY)).then(a.0.cmp(&b.0)));
        let mut chosen: Vec<(usize, Worth)> = Vec::new();
        for (k, worth) in order {
            // symmetric platforms have the same optimum many times
            let known = chosen.iter().any(|(_, w)| w.is_close(&worth, DISTINCT_GAINS));
            let promises_more = worth.merit(PENALTY) > best;
            if chosen.len() < count && promises_more && !known && !self.tried.contains(&k) {
                chosen.push((k, worth));
            }
        }
        chosen.into_iter().map(|c| c.0).collect()
    }

    /// Poses that mattered to refined ends matter to the others.
    pub(crate) fn learn(&mut self, poses: Vec<HeldPose>) {
        for at in poses {
            if !self.poses.contains(&at) {
                self.poses.push(at);
            }
        }
    }
}
