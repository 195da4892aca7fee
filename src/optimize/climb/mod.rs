//! Sequential convex programming with a trust region and an exact penalty, the common climb of both searches.
//!
//! Each step solves one conic program; the true values over all held poses judge it. The merit is the weighted gains
//! minus `penalty` times the largest violation of each group. Smooth constraints and pieces get their curvature from
//! damped BFGS updates of the Lagrangian (Powell 1978). Cones and clusters of singular values carry their own
//! curvature.

mod linear;
mod program;
mod values;

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use num::conic::{ConicTally, SolverFailure};
use program::{ClimbStep, Program};

pub(crate) use linear::{
    AffineCone, CLUSTER, LinearBound, LinearCluster, LinearItem, LinearPiece, Linearised, NO_POSE, TermId,
};
pub(crate) use values::{ConstraintGroup, PointValues, Task};

/// A problem for the climb: its values and its linear models at a point.
pub(crate) trait Climbable {
    /// Weights, floors and dropped constraints.
    fn task(&self) -> &Task;

    /// Ranges of the variables.
    fn bounds(&self) -> &[(f64, f64)];

    /// First variables of vectors of three components that are at most unit vectors.
    fn unit_vectors(&self) -> Vec<usize> {
        Vec::new()
    }

    /// Margin with which constraints are held.
    fn backoff(&self) -> f64;

    /// Number of held poses of the requirements.
    fn poses(&self) -> usize;

    /// Values at a point. The evaluation stops once the values so far are `refused`, since further poses only make them
    /// worse.
    fn judge(&self, x: &[f64], refused: &dyn Fn(&PointValues) -> bool) -> PointValues;

    /// Linear models of everything relevant within `radius`; `None` if a number is not finite.
    fn linearise(&self, x: &[f64], radius: f64) -> Option<Linearised>;

    /// The counter of conic programs.
    fn conic(&self) -> &ConicTally;

    /// Whether the climb must end at its current point.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Limits of one climb.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub iterations: usize,
    /// The climb stops if the model predicts less gain.
    pub tolerance: f64,
    /// First price of a violation.
    pub penalty: f64,
}

impl Effort {
    /// Effort that suffices to compare starts.
    pub(crate) const RANK: Self = Self { iterations: 30, tolerance: 1e-5, penalty: PENALTY };
    /// Effort up to the accuracy of the conic solver.
    pub(crate) const POLISH: Self = Self { iterations: 80, tolerance: 1e-8, penalty: PENALTY };

    /// Whether the run measures stationarity; only for a polished run is the additional program worthwhile.
    fn measures_stationarity(self) -> bool {
        self.tolerance < 1e-6
    }
}

/// A step of the run that found the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "SearchStepRecord", transform = num::nullable))]
pub struct HistoryStep {
    /// Value after the step: the weighted gain of the objectives; for offsets the worst inverse condition number.
    #[cfg_attr(feature = "serde", serde(rename = "objective"))]
    pub gain: f64,
    /// Greatest scaled violation; lengths relative to the size.
    pub violation: f64,
    /// Trust region radius.
    pub radius: f64,
    /// Number of poses held.
    pub poses: usize,
    /// Whether it was accepted.
    pub accepted: bool,
    /// Predicted gain of the merit function.
    pub predicted: f64,
    /// Actual gain of the merit function; for a rejected step, at the poses that rejected it.
    pub actual: f64,
}

/// The result of a run.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub x: Vec<f64>,
    pub judged: PointValues,
    /// Margin with which constraints were held.
    backoff: f64,
    pub converged: bool,
    /// Predicted gain per unit of the variables, minus the violation.
    pub stationarity: f64,
    pub history: Vec<HistoryStep>,
    pub failure: Option<SolverFailure>,
}

/// Penalty of a violation at the start of a climb.
pub(crate) const PENALTY: f64 = 10.0;
/// Greatest penalty of a violation.
const LARGEST_PENALTY: f64 = 1e6;
/// Trust region of the first step, in units of the variables.
const FIRST_RADIUS: f64 = 0.15;
/// Trust region of the longest step.
const LARGEST_RADIUS: f64 = 0.5;
/// Trust region at which a climb ends.
const SMALLEST_RADIUS: f64 = 1e-9;
/// A step is taken if it gains more than this share of the predicted gain.
const ACCEPTED: f64 = 0.05;
/// Stationarity below this counts as zero.
const STATIONARY: f64 = 1e-3;
/// Radius at which stationarity is measured.
const PROBE_RADIUS: f64 = 1e-3;

impl Run {
    /// The run with the steps that led to its start.
    pub(crate) fn after(mut self, mut earlier: Vec<HistoryStep>) -> Self {
        earlier.append(&mut self.history);
        Self { history: earlier, ..self }
    }

    /// Whether no gain remains near the end: the model predicts none, or less than its accuracy.
    pub(crate) fn is_settled(&self) -> bool {
        self.converged || self.stationarity.abs() < STATIONARY
    }

    /// Whether violations are below half of the margin.
    pub(crate) fn is_feasible(&self) -> bool {
        self.judged.violation() <= 0.5 * self.backoff
    }
}

struct State<'a> {
    problem: &'a dyn Climbable,
    penalty: f64,
    x: Vec<f64>,
    judged: PointValues,
    curvature: DMatrix<f64>,
    updates: usize,
}

impl State<'_> {
    fn merit(&self, j: &PointValues) -> f64 {
        let task = self.problem.task();
        let value = j.gain(task) - self.penalty * j.total_violation(task);
        if value.is_nan() { f64::NEG_INFINITY } else { value }
    }

    fn program<'b>(&'b self, near: &'b Linearised, radius: f64, curved: bool) -> Program<'b> {
        let curvature = (curved && self.updates > 0).then_some(&self.curvature);
        Program { problem: self.problem, x: &self.x, near, radius, penalty: self.penalty, curvature }
    }

    /// Damped BFGS with the change of the gradient of `- gains + multipliers . constraints` between two points.
    fn learn(&mut self, old: &Linearised, new: &Linearised, step: &ClimbStep) {
        let n = self.x.len();
        let mut change = DVector::zeros(n);
        let mut add = |weight: f64, before: &[f64], after: &[f64]| {
            for j in 0..n {
                change[j] -= weight * (after[j] - before[j]);
            }
        };
        let items: BTreeMap<_, _> = new.items.iter().map(|i| ((i.group, i.id), &i.gradient)).collect();
        for (item, weight) in old.items.iter().zip(&step.items).filter(|(_, w)| **w > 1e-9) {
            if let Some(after) = items.get(&(item.group, item.id)) {
                add(*weight, &item.gradient, after);
            }
        }
        let pieces: BTreeMap<_, _> = new.pieces.iter().map(|p| ((p.objective, p.id), p)).collect();
        for (piece, weight) in old.pieces.iter().zip(&step.pieces).filter(|(_, w)| **w > 1e-9) {
            if let Some(after) = pieces.get(&(piece.objective, piece.id))
                && !after.has_cluster()
            {
                add(*weight, &piece.gradient, &after.gradient);
            }
        }
        let s = DVector::from_column_slice(&step.d);
        let ss = s.norm_squared();
        if !(ss > 0.0 && change.iter().all(|x: &f64| x.is_finite())) {
            return;
        }
        if self.updates == 0 {
            let scale = (change.norm() / ss.sqrt()).clamp(1e-6, 1e3);
            self.curvature = DMatrix::identity(n, n) * (0.1 * scale);
        }
        let bs = &self.curvature * &s;
        let (sbs, sy) = (s.dot(&bs), s.dot(&change));
        let theta = if sy >= 0.2 * sbs { 1.0 } else { 0.8 * sbs / (sbs - sy) };
        let y = change * theta + &bs * (1.0 - theta);
        let sy = s.dot(&y);
        if sbs > 0.0 && sy > 0.0 {
            self.curvature += &y * y.transpose() / sy - &bs * bs.transpose() / sbs;
            self.curvature = (&self.curvature + self.curvature.transpose()) * 0.5;
            self.updates += 1;
        }
    }

    /// First-order gain predicted within [`PROBE_RADIUS`], per unit of the variables.
    fn stationarity(&self) -> f64 {
        let Some(near) = self.problem.linearise(&self.x, PROBE_RADIUS) else { return f64::INFINITY };
        match self.program(&near, PROBE_RADIUS, false).solve() {
            Ok(step) => (step.merit - self.merit(&self.judged)) / PROBE_RADIUS,
            Err(_) => f64::INFINITY,
        }
    }
}

/// Climbs from `start`.
pub(crate) fn climb(problem: &dyn Climbable, start: &[f64], effort: Effort) -> Run {
    let (n, task, backoff) = (start.len(), problem.task(), problem.backoff());
    let mut s = State {
        problem,
        penalty: effort.penalty,
        x: start.to_vec(),
        judged: problem.judge(start, &|_| false),
        curvature: DMatrix::zeros(n, n),
        updates: 0,
    };
    let (mut radius, mut converged, mut failure) = (FIRST_RADIUS, false, None);
    let mut history = Vec::new();
    let mut near = problem.linearise(start, LARGEST_RADIUS);
    for _ in 0..effort.iterations {
        if problem.is_stopped() {
            break;
        }
        let Some(here) = &near else {
            failure = Some(SolverFailure::Data);
            break;
        };
        let step = match s.program(here, radius, true).solve() {
            Ok(step) => step,
            Err(why) => {
                failure = Some(why);
                radius *= 0.3;
                s.updates = 0;
                if radius < SMALLEST_RADIUS {
                    break;
                }
                continue;
            }
        };
        failure = None;
        let now = s.merit(&s.judged);
        let predicted = step.merit - now;
        if !(predicted > effort.tolerance * (1.0 + 1e-2 * s.penalty * s.judged.violation())) {
            converged = s.judged.violation() <= 0.5 * backoff;
            // without an objective the penalty has no weight to find
            if converged || s.penalty >= LARGEST_PENALTY || task.weights.iter().all(|w| *w <= 0.0) {
                converged = true;
                break;
            }
            s.penalty *= 10.0;
            continue;
        }
        let trial: Vec<f64> = s.x.iter().zip(&step.d).map(|(x, d)| x + d).collect();
        let gains_enough = |values: &PointValues| s.merit(values) - now > ACCEPTED * predicted;
        let judged = problem.judge(&trial, &|so_far| !gains_enough(so_far));
        let actual = s.merit(&judged) - now;
        let length = step.d.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let accepted = actual > ACCEPTED * predicted;
        if accepted {
            (s.x, s.judged) = (trial, judged);
            let next = problem.linearise(&s.x, LARGEST_RADIUS);
            if let (Some(old), Some(new)) = (&near, &next) {
                s.learn(old, new, &step);
            }
            near = next;
            if actual > 0.7 * predicted && length > 0.8 * radius {
                radius = (2.0 * radius).min(LARGEST_RADIUS);
            } else if actual < 0.25 * predicted {
                radius = 0.5 * radius.min(length);
            }
        } else {
            radius = 0.35 * radius.min(length);
        }
        history.push(HistoryStep {
            gain: s.judged.gain(task),
            violation: s.judged.violation(),
            radius,
            poses: problem.poses(),
            predicted,
            actual,
            accepted,
        });
        if radius < SMALLEST_RADIUS {
            break;
        }
    }
    let stationarity = if effort.measures_stationarity() { s.stationarity() } else { f64::INFINITY };
    Run { x: s.x, judged: s.judged, backoff, converged, stationarity, history, failure }
}
