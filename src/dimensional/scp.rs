//! Sequential convex programming with a trust region and an exact penalty.
//!
//! Every step solves one conic subproblem and is judged by the true values over all held poses: merit = weighted gains less
//! `penalty` times the largest violation of each group. Smooth constraints and pieces get their curvature from damped BFGS
//! updates of the Lagrangian (Powell 1978); cones and clusters of singular values carry their own.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::judging::Judged;
use super::kinematics::HeldPose;
use super::linear::{LinearBound, Linearised};
use super::model::{Model, Task};
use super::subproblem::{Step, Subproblem};
use crate::num::conic::SolverFailure;

/// How hard to try.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub(crate) iterations: usize,
    /// Stop when the model promises less.
    pub(crate) tolerance: f64,
}

impl Effort {
    /// Enough to compare starts.
    pub(crate) const RANK: Self = Self { iterations: 30, tolerance: 1e-5 };
    /// To the accuracy of the conic solver.
    pub(crate) const POLISH: Self = Self { iterations: 80, tolerance: 1e-8 };
}

/// One step of the best run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryStep {
    /// Weighted gain after the step.
    pub gain: f64,
    /// Largest violation after the step, in the scale of its constraint.
    pub violation: f64,
    /// Trust radius.
    pub radius: f64,
    /// Poses at which the requirements were held.
    pub poses: usize,
    /// `true` when the step was taken.
    pub accepted: bool,
}

/// Where a run ended.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub(crate) x: Vec<f64>,
    pub(crate) judged: Judged,
    pub(crate) converged: bool,
    /// Gain still promised for a unit of the variables, less the violation.
    pub(crate) stationarity: f64,
    pub(crate) history: Vec<HistoryStep>,
    pub(crate) failure: Option<SolverFailure>,
}

/// Price of a violation that a climb begins with.
pub(crate) const PENALTY: f64 = 10.0;
const LARGEST_PENALTY: f64 = 1e6;
const FIRST_RADIUS: f64 = 0.15;
const LARGEST_RADIUS: f64 = 0.5;
const SMALLEST_RADIUS: f64 = 1e-9;
const PROBE_RADIUS: f64 = 1e-3;

impl Run {
    /// The same with the steps that led to its start.
    pub(crate) fn after(mut self, mut earlier: Vec<HistoryStep>) -> Self {
        earlier.append(&mut self.history);
        Self { history: earlier, ..self }
    }

    /// Violations below half of the spare are inside it.
    pub(crate) fn is_feasible(&self, model: &Model<'_>) -> bool {
        self.judged.violation() <= 0.5 * model.backoff
    }
}

struct State<'a> {
    model: &'a Model<'a>,
    poses: &'a [HeldPose],
    task: &'a Task,
    sign: f64,
    penalty: f64,
    x: Vec<f64>,
    judged: Judged,
    curvature: DMatrix<f64>,
    updates: usize,
}

impl State<'_> {
    fn merit(&self, j: &Judged) -> f64 {
        let gain = j.gain(self.task);
        let value = gain - self.penalty * j.total_violation(self.task);
        if value.is_nan() { f64::NEG_INFINITY } else { value }
    }

    fn linearised(&self, radius: f64) -> Option<Linearised> {
        self.model.linearise(self.poses, &self.x, self.task, self.sign, radius)
    }

    fn subproblem<'b>(&'b self, near: &'b Linearised, radius: f64, curved: bool) -> Subproblem<'b> {
        let curvature = (curved && self.updates > 0).then_some(&self.curvature);
        Subproblem {
            model: self.model,
            task: self.task,
            x: &self.x,
            near,
            radius,
            penalty: self.penalty,
            curvature,
        }
    }

    /// Damped BFGS with the change of the gradient of `- gains + multipliers . constraints` between two points.
    fn learn(&mut self, old: &Linearised, new: &Linearised, step: &Step) {
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
                && !has_cluster(&after.bound)
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
}

fn has_cluster(bound: &LinearBound) -> bool {
    matches!(bound, LinearBound::Spectral { low, high, .. } if !low.others.is_empty() || !high.others.is_empty())
}

/// Climbs from `start`.
pub(crate) fn climb(
    model: &Model<'_>,
    poses: &[HeldPose],
    task: &Task,
    start: &[f64],
    effort: Effort,
) -> Run {
    let n = start.len();
    let sign = model.sign(start);
    let judged = model.judge(poses, start, task, sign);
    let mut s = State {
        model,
        poses,
        task,
        sign,
        penalty: PENALTY,
        x: start.to_vec(),
        judged,
        curvature: DMatrix::zeros(n, n),
        updates: 0,
    };
    let (mut radius, mut converged, mut failure) = (FIRST_RADIUS, false, None);
    let mut history = Vec::new();
    let mut near = s.linearised(LARGEST_RADIUS);
    for _ in 0..effort.iterations {
        if model.is_stopped() {
            break;
        }
        let Some(here) = &near else {
            failure = Some(SolverFailure::Data);
            break;
        };
        let step = match s.subproblem(here, radius, true).solve() {
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
            converged = s.judged.violation() <= 0.5 * model.backoff;
            // with no objective the penalty has no weight to find
            if converged || s.penalty >= LARGEST_PENALTY || task.weights.iter().all(|w| *w <= 0.0) {
                converged = true;
                break;
            }
            s.penalty *= 10.0;
            continue;
        }
        let trial: Vec<f64> = s.x.iter().zip(&step.d).map(|(x, d)| x + d).collect();
        let judged = model.judge(poses, &trial, task, sign);
        let actual = s.merit(&judged) - now;
        let length = step.d.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let accepted = actual > 0.05 * predicted;
        if accepted {
            (s.x, s.judged) = (trial, judged);
            let next = s.linearised(LARGEST_RADIUS);
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
            poses: poses.len(),
            accepted,
        });
        if radius < SMALLEST_RADIUS {
            break;
        }
    }
    let stationarity = if effort.tolerance < 1e-6 { stationarity(&s) } else { f64::INFINITY };
    Run { x: s.x, judged: s.judged, converged, stationarity, history, failure }
}

/// First-order gain promised within [`PROBE_RADIUS`] for a unit of the variables.
fn stationarity(s: &State<'_>) -> f64 {
    let Some(near) = s.linearised(PROBE_RADIUS) else { return f64::INFINITY };
    match s.subproblem(&near, PROBE_RADIUS, false).solve() {
        Ok(step) => (step.merit - s.merit(&s.judged)) / PROBE_RADIUS,
        Err(_) => f64::INFINITY,
    }
}
