//! Many starts, the best of them polished while poses are added until none is worse.

use super::answer::outcome;
use super::conflict::{conflict, elastic};
use super::kinematics::HeldPose;
use super::model::{Model, Task};
use super::outcome::{DimensionalOutcome, DimensionalReport};
use super::problem::{DimensionalProblem, InvalidProblem, Mode};
use super::scp::{Effort, HistoryStep, Run, climb};
use super::worst_pose::worse_poses;
use crate::num::Rng;
use crate::num::parallel::parallel;

/// Options of the search; none of them changes what is feasible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SearchOptions {
    /// Seed of the starts. Same seed, same answer, whatever the number of threads.
    pub seed: u64,
    /// Worker threads (0 counts as 1).
    pub threads: usize,
    /// Random points that are compared before any climb.
    pub samples: usize,
    /// Points from which the first pass climbs.
    pub starts: usize,
    /// Runs that are polished.
    pub polished: usize,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self { seed: 1, threads: 1, samples: 2000, starts: 48, polished: 6 }
    }
}

/// How far the search is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Progress {
    /// Climbs of the first pass.
    Ranking {
        /// Done.
        done: usize,
        /// Of how many.
        total: usize,
    },
    /// Polished runs.
    Polishing {
        /// Done.
        done: usize,
        /// Of how many.
        total: usize,
    },
}

/// Poses of the first pass.
const FEW_POSES: usize = 16;
/// Runs that are polished though the first pass left them infeasible.
const UNMET: usize = 2;
/// Rounds of adding poses.
const ROUNDS: usize = 12;
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
    let mut history: Vec<HistoryStep> = std::mem::take(&mut run.history);
    if task.weights.iter().any(|w| *w > 0.0) && !run.is_feasible(model) {
        // more poses only make it worse
        run.history = history;
        return Refined { run, poses, complete: false };
    }
    for round in 0..ROUNDS {
        let sign = model.sign(&run.x);
        let worse = worse_poses(model, &run.x, task, &poses, sign, seed.wrapping_add(round as u64));
        if worse.is_empty() {
            run.history = history;
            return Refined { run, poses, complete: true };
        }
        poses.extend(worse);
        run = climb(model, &poses, task, &run.x, Effort::POLISH);
        history.append(&mut run.history);
    }
    run.history = history;
    Refined { run, poses, complete: false }
}

/// Random points, the most promising first.
fn starts(
    model: &Model<'_>,
    few: &[HeldPose],
    task: &Task,
    given: &[Vec<f64>],
    o: &SearchOptions,
) -> Vec<Vec<f64>> {
    let mut rng = Rng::stream(o.seed, 0x5347);
    let chosen = model.shape.axes.into_iter().flatten();
    let is_axis: Vec<bool> = {
        let mut out = vec![false; model.shape.start.len()];
        chosen.for_each(|first| out[first..first + 18].fill(true));
        out
    };
    let mut draw = || -> Vec<f64> {
        (0..is_axis.len())
            .map(|j| {
                let (low, high) = model.shape.bounds[j];
                // axes start along the legs at home
                if is_axis[j] { model.shape.start[j] } else { rng.uniform(low, high) }
            })
            .collect()
    };
    let mut points: Vec<Vec<f64>> = (0..o.samples.max(1)).map(|_| draw()).collect();
    if model.shape.offset_variables().is_none() {
        points.push(model.shape.start.clone());
    }
    let rate = |k: usize| {
        let j = model.judge(few, &points[k], task, model.sign(&points[k]));
        (j.total_violation(task), j.gain(task))
    };
    let rated = parallel(points.len(), o.threads, rate, &mut |_| ());
    let mut order: Vec<usize> = (0..points.len()).collect();
    // feasible points by their gain, then the others by their violation
    order.sort_by(|&i, &j| {
        let key = |k: usize| (rated[k].0.max(1e-3), -rated[k].1);
        key(i).0.total_cmp(&key(j).0).then(key(i).1.total_cmp(&key(j).1)).then(i.cmp(&j))
    });
    order.truncate(o.starts.max(1));
    let fits = |x: &&Vec<f64>| x.len() == model.shape.start.len();
    given.iter().filter(fits).cloned().chain(order.into_iter().map(|k| points[k].clone())).collect()
}

/// Evenly chosen ones.
fn few_of(poses: &[HeldPose], count: usize) -> Vec<HeldPose> {
    if poses.len() <= count {
        return poses.to_vec();
    }
    (0..count).map(|k| poses[k * poses.len() / count]).collect()
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
    pub(crate) starts: Vec<Vec<f64>>,
    pub(crate) feasible: usize,
}

/// Two passes over many starts.
pub(crate) fn search_task(
    model: &Model<'_>,
    task: &Task,
    given: &[Vec<f64>],
    o: &SearchOptions,
    progress: &mut dyn FnMut(Progress),
) -> Searched {
    let poses = model.first_poses();
    let few = few_of(&poses, FEW_POSES);
    let starts = starts(model, &few, task, given, o);
    let total = starts.len();
    let rank = |k: usize| climb(model, &few, task, &starts[k], Effort::RANK);
    let ranked = parallel(total, o.threads, rank, &mut |done| progress(Progress::Ranking { done, total }));
    let feasible = ranked.iter().filter(|r| r.is_feasible(model)).count();
    let mut order: Vec<usize> = (0..total).collect();
    order.sort_by(|&i, &j| better(model, task, &ranked[i], &ranked[j]).then(i.cmp(&j)));
    let mut chosen: Vec<usize> = Vec::new();
    for k in order {
        let near = |j: &usize| ranked[*j].x.iter().zip(&ranked[k].x).all(|(a, b)| (a - b).abs() < 1e-2);
        // where some starts led to feasible points the others are hardly worth the time
        let hopeful = ranked[k].is_feasible(model) || chosen.len() < UNMET;
        if hopeful && chosen.len() < o.polished.max(1) && !chosen.iter().any(near) {
            chosen.push(k);
        }
    }
    let total = chosen.len();
    let polish = |i: usize| {
        let first = &ranked[chosen[i]];
        let mut refined = refine(model, task, &first.x, poses.clone(), o.seed);
        refined.run.history.splice(0..0, first.history.iter().copied());
        refined
    };
    let mut refined =
        parallel(total, o.threads, polish, &mut |done| progress(Progress::Polishing { done, total }));
    refined.sort_by(|a, b| better(model, task, &a.run, &b.run));
    Searched { refined, starts, feasible }
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
    progress: &mut dyn FnMut(Progress),
) -> Result<DimensionalReport, InvalidProblem> {
    let model = Model::new(problem)?;
    let mut task = first_task(problem);
    let mut found = search_task(&model, &task, given, options, progress);
    let (starts, feasible) = (found.starts.len(), found.feasible);
    let polished =
        found.refined.iter().map(|r| r.run.is_feasible(&model).then(|| r.run.judged.gain(&task))).collect();
    let report = |outcome| DimensionalReport { outcome, starts, feasible, polished, seed: options.seed };
    let Some(first) = found.refined.first() else { return Ok(report(DimensionalOutcome::Undecided(None))) };
    if !first.run.is_feasible(&model) {
        let settled = elastic(&model, &found.refined, options.threads);
        if let Some(refined) = settled.iter().find(|r| r.run.is_feasible(&model)) {
            // restoration without an objective met all requirements: climb again from there
            let again = refine(&model, &task, &refined.run.x, refined.poses.clone(), options.seed);
            found.refined.insert(0, again);
            found.refined.sort_by(|a, b| better(&model, &task, &a.run, &b.run));
        }
        if !found.refined[0].run.is_feasible(&model) {
            let failure = found.refined[0].run.failure;
            let outcome = match conflict(&model, &settled, options) {
                Some(conflict) => DimensionalOutcome::Infeasible(conflict),
                None => DimensionalOutcome::Undecided(failure),
            };
            return Ok(report(outcome));
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
            let mut refined = parallel(found.refined.len(), options.threads, again, &mut |_| ());
            refined.sort_by(|a, b| better(&model, &task, &a.run, &b.run));
            found.refined = refined;
        }
    }
    Ok(report(outcome(&model, &task, &found.refined[0])))
}
