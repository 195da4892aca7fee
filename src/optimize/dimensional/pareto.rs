//! Fronts of two or three objectives: platforms of which none is better than another in every objective.

use std::ops::ControlFlow;

use super::model::Model;
use super::outcome::{DimensionalOutcome, DimensionalReport, DimensionalSolution, evaluate, outcome};
use super::problem::{DimensionalProblem, InvalidProblem};
use super::search::{
    Progress, ProgressReport, RefinedRun, ShapeSearchOptions, Stage, better, refine, search_task,
};
use crate::climb::Task;
use num::parallel::parallel;

/// Number of Halton points of the dense evaluation, and of random ones.
const POINTS: usize = 1000;
/// Small weight of the bounded objectives, which avoids unnecessary losses.
const AUGMENTED: f64 = 1e-3;
/// Dense values within this, relative to the range of the objective, count as equal.
const SAME: f64 = 1e-4;

/// A member of a front.
#[derive(Debug, Clone, PartialEq)]
pub struct ParetoPoint {
    /// The platform.
    pub solution: DimensionalSolution,
    /// The objectives over many poses, by [`evaluate`].
    pub dense: Vec<f64>,
}

/// A front.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ParetoReport {
    /// Members, by falling gain of the first objective; none dominates another in the dense evaluation.
    pub front: Vec<ParetoPoint>,
    /// Number of runs that met their bounds but were dominated by others or equal to one.
    pub dominated: usize,
    /// Number of bounds that no run met.
    pub unmet: usize,
    /// The search under the same requirements if it found nothing, so that there is no front: infeasible or undecided.
    pub failure: Option<Box<DimensionalReport>>,
    /// Whether the search was interrupted; the front is then the part found so far, possibly empty.
    pub interrupted: bool,
    /// Number of solved conic programs.
    pub conic_programs: u64,
}

/// The front by a sweep of bounds on all objectives but the first (epsilon constraints, augmented by small weights).
///
/// First every objective is optimised alone; the extremes span the bounds, with `points` steps each. Every run starts
/// from the extremes and from its neighbours. Members are kept if no other is at least as good in every objective of
/// the dense evaluation. If `progress` returns break, the front found so far is returned.
///
/// # Errors
/// [`InvalidProblem`], also for fewer than two or more than three objectives.
pub fn pareto(
    problem: &DimensionalProblem,
    points: usize,
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<ParetoReport, InvalidProblem> {
    let n = problem.objectives.len();
    if !(2..=3).contains(&n) {
        return Err(InvalidProblem::FrontOf(n));
    }
    let model = Model::new(problem)?;
    let mut watch = ProgressReport::new(&model, progress);
    let mut known: Vec<RefinedRun> = Vec::new();
    for m in 0..n {
        if model.is_stopped() {
            break;
        }
        let weights = (0..n).map(|k| if k == m { 1.0 } else { AUGMENTED }).collect();
        let task = Task { weights, floors: vec![None; n], ..Task::default() };
        let given: Vec<Vec<f64>> = known.iter().map(|r| r.run.x.clone()).collect();
        let found = search_task(&model, &task, &given, options, &mut watch);
        match found.refined.into_iter().next().filter(|r| r.run.is_feasible()) {
            Some(first) => known.push(first),
            None if model.is_stopped() => break,
            None => {
                let one = super::search::optimize(problem, &[], options, progress)?;
                return Ok(ParetoReport {
                    front: Vec::new(),
                    dominated: 0,
                    unmet: 0,
                    interrupted: one.interrupted,
                    conic_programs: model.conic.count() + one.conic_programs,
                    failure: Some(Box::new(one)),
                });
            }
        }
    }
    let gains: Vec<Vec<f64>> = known.iter().map(|r| r.run.judged.gains.clone()).collect();
    let range = |m: usize| {
        let values = || gains.iter().map(|g| g[m]);
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
    };
    let steps = points.max(2);
    let bound = |m: usize, k: usize| {
        let (low, high) = range(m);
        low + (high - low) * k as f64 / (steps - 1) as f64
    };
    let cells: Vec<Vec<usize>> = if n == 2 {
        (0..steps).map(|k| vec![k]).collect()
    } else {
        (0..steps).flat_map(|j| (0..steps).map(move |k| vec![j, k])).collect()
    };
    let extremes = known.len();
    let mut unmet = 0;
    let mut previous: Option<RefinedRun> = None;
    for (done, cell) in cells.iter().enumerate() {
        if model.is_stopped() {
            break;
        }
        let floors: Vec<Option<f64>> = std::iter::once(None)
            .chain(cell.iter().enumerate().map(|(m, k)| Some(bound(m + 1, *k))))
            .collect();
        let weights = (0..n).map(|k| if k == 0 { 1.0 } else { AUGMENTED }).collect();
        let task = Task { weights, floors, ..Task::default() };
        let from: Vec<&RefinedRun> = known[..extremes].iter().chain(&previous).collect();
        let run = |k: usize| refine(&model, &task, &from[k].run.x, from[k].poses.clone(), options.seed);
        let mut tell = |done| watch.tell(Stage::Polishing, (done, cells.len()), None);
        let mut runs = parallel(from.len(), options.threads, run, &mut |_, _| tell(done));
        runs.sort_by(|a, b| better(&task, &a.run, &b.run));
        let best = runs.swap_remove(0);
        if best.run.is_feasible() {
            known.push(best.clone());
            previous = Some(best);
        } else if !model.is_stopped() {
            unmet += 1;
        }
        watch.tell(Stage::Polishing, (done + 1, cells.len()), None);
    }
    Ok(front(problem, &model, &known, unmet, options.seed))
}

/// The members that no other dominates.
fn front(
    p: &DimensionalProblem,
    model: &Model<'_>,
    known: &[RefinedRun],
    unmet: usize,
    seed: u64,
) -> ParetoReport {
    let n = p.objectives.len();
    let task = Task { weights: vec![1.0; n], floors: vec![None; n], ..Task::default() };
    let mut members: Vec<ParetoPoint> = Vec::new();
    for refined in known {
        if let DimensionalOutcome::Optimal(s) | DimensionalOutcome::NotConverged(s) =
            outcome(model, &task, refined)
        {
            let space = p.space.with_home(s.home);
            let dense = evaluate(p, &s.manipulator, &space, &s.poses, POINTS, seed);
            members.push(ParetoPoint { solution: *s, dense });
        }
    }
    let gain = |point: &ParetoPoint, m: usize| {
        if p.objectives[m].0.is_cost() { -point.dense[m] } else { point.dense[m] }
    };
    let width = |m: usize| {
        let all = || members.iter().map(|q| gain(q, m));
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    let widths: Vec<f64> = (0..n).map(width).collect();
    let beats = |a: &ParetoPoint, b: &ParetoPoint| {
        (0..n).all(|m| gain(a, m) >= gain(b, m) - SAME * widths[m])
            && (0..n).any(|m| gain(a, m) > gain(b, m) + SAME * widths[m])
    };
    let same = |a: &ParetoPoint, b: &ParetoPoint| {
        (0..n).all(|m| (gain(a, m) - gain(b, m)).abs() <= SAME * widths[m])
    };
    let keep = |k: &usize| {
        let own = &members[*k];
        let worse = members.iter().any(|other| beats(other, own));
        !worse && !members[..*k].iter().any(|other| same(other, own))
    };
    let kept: Vec<usize> = (0..members.len()).filter(keep).collect();
    let dominated = members.len() - kept.len();
    let mut front: Vec<ParetoPoint> = kept.into_iter().map(|k| members[k].clone()).collect();
    front.sort_by(|a, b| gain(b, 0).total_cmp(&gain(a, 0)));
    ParetoReport {
        front,
        dominated,
        unmet,
        failure: None,
        interrupted: model.is_stopped(),
        conic_programs: model.conic.count(),
    }
}
