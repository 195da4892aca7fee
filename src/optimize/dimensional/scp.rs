//! Sequential convex programming with a trust region and an exact penalty.
//!
//! Every step solves one conic subproblem and is judged by the true values over all held poses: merit = weighted gains less
//! `penalty` times the largest violation of each group. Smooth constraints and pieces get their curvature from damped BFGS
//! updates of the Lagrangian (Powell 1978); cones and clusters of singular values carry their own.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::leg_lines::HeldPose;
use super::linear::{AffineCone, LinearBound, LinearCluster, LinearItem, LinearPiece, Linearised};
use super::model::{ConstraintGroup, Model, Task};
use super::worst_pose::PointValues;
use num::conic::{ConicAnswer, ConicPoint, ConicProgram, ConicRow, SolverFailure};

/// How hard to try.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShapeEffort {
    pub iterations: usize,
    /// Stop when the model promises less.
    pub tolerance: f64,
}

impl ShapeEffort {
    /// Enough to compare starts.
    pub(super) const RANK: Self = Self { iterations: 30, tolerance: 1e-5 };
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
pub(crate) struct ShapeRun {
    pub x: Vec<f64>,
    pub judged: PointValues,
    pub converged: bool,
    /// Gain still promised for a unit of the variables, less the violation.
    pub stationarity: f64,
    pub history: Vec<HistoryStep>,
    pub failure: Option<SolverFailure>,
}

/// Price of a violation that a climb begins with.
pub(crate) const PENALTY: f64 = 10.0;
/// Price beyond which it is not raised.
const LARGEST_PENALTY: f64 = 1e6;
/// Trust region of the first step, of the longest one, and the one at which a climb has come to its end, in units of the variables.
const FIRST_RADIUS: f64 = 0.15;
const LARGEST_RADIUS: f64 = 0.5;
const SMALLEST_RADIUS: f64 = 1e-9;
/// Sizes of the stationarity that count as none.
const STATIONARY: f64 = 1e-3;
/// Radius at which stationarity is measured.
const PROBE_RADIUS: f64 = 1e-3;

impl ShapeRun {
    /// The same with the steps that led to its start.
    pub(super) fn after(mut self, mut earlier: Vec<HistoryStep>) -> Self {
        earlier.append(&mut self.history);
        Self { history: earlier, ..self }
    }

    /// Whether nothing more is to be gained near the end: the model promised nothing, or less than can be told from the accuracy of its steps.
    pub(crate) fn is_settled(&self) -> bool {
        self.converged || self.stationarity.abs() < STATIONARY
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
    judged: PointValues,
    curvature: DMatrix<f64>,
    updates: usize,
}

impl State<'_> {
    fn merit(&self, j: &PointValues) -> f64 {
        let gain = j.gain(self.task);
        let value = gain - self.penalty * j.total_violation(self.task);
        if value.is_nan() { f64::NEG_INFINITY } else { value }
    }

    fn linearised(&self, radius: f64) -> Option<Linearised> {
        self.model.linearise(self.poses, &self.x, self.task, self.sign, radius)
    }

    fn subproblem<'b>(&'b self, near: &'b Linearised, radius: f64, curved: bool) -> ShapeSubproblem<'b> {
        let curvature = (curved && self.updates > 0).then_some(&self.curvature);
        ShapeSubproblem {
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
    fn learn(&mut self, old: &Linearised, new: &Linearised, step: &ShapeStep) {
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
pub(super) fn climb(
    model: &Model<'_>,
    poses: &[HeldPose],
    task: &Task,
    start: &[f64],
    effort: ShapeEffort,
) -> ShapeRun {
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
    ShapeRun { x: s.x, judged: s.judged, converged, stationarity, history, failure }
}

/// First-order gain promised within [`PROBE_RADIUS`] for a unit of the variables.
fn stationarity(s: &State<'_>) -> f64 {
    let Some(near) = s.linearised(PROBE_RADIUS) else { return f64::INFINITY };
    match s.subproblem(&near, PROBE_RADIUS, false).solve() {
        Ok(step) => (step.merit - s.merit(&s.judged)) / PROBE_RADIUS,
        Err(_) => f64::INFINITY,
    }
}

/// A subproblem point with a larger violation (data of order one) is refused.
const ACCEPTED_RESIDUAL: f64 = 1e-6;
/// Violation at which a row that was left out is added (data of order one).
const UNSEEN: f64 = 1e-9;
/// Rows of a group, and pieces of an objective, that the program begins with.
const FIRST: usize = 6;

/// What a step is computed from.
#[derive(Debug)]
pub(crate) struct ShapeSubproblem<'a> {
    pub model: &'a Model<'a>,
    pub task: &'a Task,
    pub x: &'a [f64],
    pub near: &'a Linearised,
    pub radius: f64,
    pub(crate) penalty: f64,
    pub curvature: Option<&'a DMatrix<f64>>,
}

/// A step with what the model promises.
#[derive(Debug, Clone)]
pub(crate) struct ShapeStep {
    pub d: Vec<f64>,
    /// Weighted gain less penalised slacks, curvature included.
    pub merit: f64,
    /// Multipliers of the smooth constraints and pieces, by their position.
    pub items: Vec<f64>,
    pub pieces: Vec<f64>,
}

/// Which constraints and pieces are written into the program.
struct Held {
    items: Vec<bool>,
    pieces: Vec<bool>,
}

impl Held {
    /// Of every group and objective those with the least values.
    fn first(near: &Linearised) -> Self {
        let mut items = vec![false; near.items.len()];
        let mut pieces = vec![false; near.pieces.len()];
        let mut groups: BTreeMap<ConstraintGroup, Vec<usize>> = BTreeMap::new();
        near.items.iter().enumerate().for_each(|(k, i)| groups.entry(i.group).or_default().push(k));
        for mut list in groups.into_values() {
            list.sort_by(|i, j| near.items[*i].value.total_cmp(&near.items[*j].value));
            list.iter().take(FIRST).for_each(|k| items[*k] = true);
        }
        let mut objectives: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        near.pieces.iter().enumerate().for_each(|(k, p)| objectives.entry(p.objective).or_default().push(k));
        for mut list in objectives.into_values() {
            list.sort_by(|i, j| near.pieces[*i].value.total_cmp(&near.pieces[*j].value));
            // the greatest ones too: longest legs
            let ends = list.iter().take(FIRST).chain(list.iter().rev().take(FIRST));
            ends.for_each(|k| pieces[*k] = true);
        }
        Self { items, pieces }
    }
}

/// A program that is being written, with the places of its variables.
struct Draft {
    p: ConicProgram,
    /// Variable of each objective in use.
    gains: BTreeMap<usize, usize>,
    /// Least and greatest length, for the stroke.
    lengths: BTreeMap<usize, (usize, usize)>,
    slacks: BTreeMap<ConstraintGroup, usize>,
}

impl Draft {
    fn variable(&mut self, cost: f64) -> usize {
        self.p.linear.push(cost);
        self.p.variables += 1;
        self.p.variables - 1
    }
}

/// `value + gradient . d + more >= 0` as a row.
fn row(value: f64, gradient: &[f64], factor: f64, more: &[(usize, f64)]) -> ConicRow {
    let own = gradient.iter().enumerate().filter(|(_, g)| **g != 0.0).map(|(j, g)| (j, -factor * g));
    ConicRow { coefficients: own.chain(more.iter().map(|(j, v)| (*j, -v))).collect(), rhs: value }
}

fn add(p: &mut ConicProgram, row: ConicRow) -> usize {
    p.at_least_zero(row.coefficients, row.rhs);
    p.rows.len() - 1
}

impl ShapeSubproblem<'_> {
    /// Solves for the step; refuses a point whose plain residual is too large.
    ///
    /// Few rows bind. The program is written with those that are nearest to it, and rows that its point violates are added until there are
    /// none: the point is then that of the program with all rows.
    pub(super) fn solve(&self) -> Result<ShapeStep, SolverFailure> {
        let mut held = Held::first(self.near);
        loop {
            let (draft, rows) = self.write(&held);
            let point = match draft.p.solve() {
                ConicAnswer::Point(point) => point,
                ConicAnswer::Infeasible(_) => return Err(SolverFailure::Numerical), // slacks make it feasible
                ConicAnswer::Failed(why) => return Err(why),
            };
            if point.residual > ACCEPTED_RESIDUAL {
                return Err(SolverFailure::Residual);
            }
            if !self.add_violated(&mut held, &draft, &point.x) {
                return Ok(self.step(&draft, rows, &point));
            }
        }
    }

    fn write(&self, held: &Held) -> (Draft, [Vec<Option<usize>>; 2]) {
        let n = self.x.len();
        let p = ConicProgram { variables: n, linear: vec![0.0; n], ..Default::default() };
        let mut draft =
            Draft { p, gains: BTreeMap::new(), lengths: BTreeMap::new(), slacks: BTreeMap::new() };
        self.trust_region(&mut draft);
        for (m, weight) in self.task.weights.iter().enumerate() {
            if *weight > 0.0 || self.task.floors[m].is_some() {
                let y = draft.variable(-weight);
                draft.gains.insert(m, y);
            }
        }
        let used = self.near.items.iter().zip(&held.items).filter(|(_, h)| **h).map(|(i, _)| i.group);
        let floors = (0..self.task.floors.len())
            .filter(|m| self.task.floors[*m].is_some())
            .map(ConstraintGroup::Floor);
        for group in used.chain(floors) {
            if !draft.slacks.contains_key(&group) {
                let s = draft.variable(self.penalty * self.task.cost(group));
                draft.p.at_least_zero(vec![(s, -1.0)], 0.0);
                draft.slacks.insert(group, s);
            }
        }
        for (m, floor) in self.task.floors.iter().enumerate() {
            if let Some(floor) = floor {
                let (y, s) = (draft.gains[&m], draft.slacks[&ConstraintGroup::Floor(m)]);
                draft.p.at_least_zero(vec![(y, -1.0), (s, -1.0)], -floor);
            }
        }
        let items = self.near.items.iter().zip(&held.items);
        let items = items.map(|(i, held)| held.then(|| self.item(&mut draft, i)).flatten()).collect();
        let pieces = self.near.pieces.iter().zip(&held.pieces);
        let pieces = pieces.map(|(p, held)| held.then(|| Self::piece(&mut draft, p)).flatten()).collect();
        if let Some(h) = self.curvature {
            let upper = (0..n).flat_map(|j| (0..=j).map(move |i| (i, j)));
            draft.p.quadratic = upper.map(|(i, j)| (i, j, h[(i, j)])).collect();
        }
        (draft, [items, pieces])
    }

    /// Marks the rows that the point violates; `false` when there are none.
    fn add_violated(&self, held: &mut Held, draft: &Draft, point: &[f64]) -> bool {
        let d = &point[..self.x.len()];
        let mut any = false;
        for (item, held) in self.near.items.iter().zip(&mut held.items).filter(|(_, h)| !**h) {
            let slack = draft.slacks.get(&item.group).map_or(0.0, |s| point[*s]);
            *held = item.room(d, slack, self.model.backoff) < -UNSEEN;
            any |= *held;
        }
        for (piece, held) in self.near.pieces.iter().zip(&mut held.pieces).filter(|(_, h)| !**h) {
            *held = match &piece.bound {
                LinearBound::Length(_) => {
                    let (low, high) = draft.lengths[&piece.objective];
                    let (least, greatest) = piece.lengths(d);
                    point[low] > least + UNSEEN || point[high] < greatest - UNSEEN
                }
                _ => point[draft.gains[&piece.objective]] > piece.upper(d) + UNSEEN,
            };
            any |= *held;
        }
        any
    }

    fn step(&self, draft: &Draft, rows: [Vec<Option<usize>>; 2], point: &ConicPoint) -> ShapeStep {
        let n = self.x.len();
        let d: Vec<f64> = (0..n)
            .map(|j| {
                let (low, high) = self.model.shape.bounds[j];
                (self.x[j] + point.x[j]).clamp(low, high) - self.x[j]
            })
            .collect();
        let gain: f64 = draft.gains.iter().map(|(m, y)| self.task.weights[*m] * point.x[*y]).sum();
        let slack: f64 = draft.slacks.iter().map(|(g, s)| self.task.cost(*g) * point.x[*s].max(0.0)).sum();
        let bend = self.curvature.map_or(0.0, |h| {
            let v = nalgebra::DVector::from_column_slice(&point.x[..n]);
            0.5 * v.dot(&(h * &v))
        });
        let dual =
            |rows: Vec<Option<usize>>| rows.into_iter().map(|r| r.map_or(0.0, |r| point.dual[r])).collect();
        let [items, pieces] = rows.map(dual);
        ShapeStep { d, merit: gain - self.penalty * slack - bend, items, pieces }
    }

    fn trust_region(&self, draft: &mut Draft) {
        for (j, (low, high)) in self.model.shape.bounds.iter().enumerate() {
            draft.p.at_least_zero(vec![(j, 1.0)], (high - self.x[j]).min(self.radius));
            draft.p.at_least_zero(vec![(j, -1.0)], (self.x[j] - low).min(self.radius));
        }
        // joint axes are at most unit vectors: shorter ones only make the limits harder to meet
        for first in self.model.shape.axes.iter().flatten() {
            for leg in 0..6 {
                let tail = (0..3)
                    .map(|k| first + 3 * leg + k)
                    .map(|j| ConicRow { coefficients: vec![(j, -1.0)], rhs: self.x[j] });
                let head = ConicRow { coefficients: Vec::new(), rhs: 1.0 };
                draft.p.second_order(std::iter::once(head).chain(tail).collect());
            }
        }
    }

    /// Writes a constraint; the row of its multiplier when it is linear.
    fn item(&self, draft: &mut Draft, item: &LinearItem) -> Option<usize> {
        let s = draft.slacks[&item.group];
        if let Some(cone) = &item.cone {
            let head = row(cone.head.0, &cone.head.1, 1.0, &[(s, cone.slack)]);
            second_order(&mut draft.p, head, cone);
            return None;
        }
        let value = item.value - self.model.backoff;
        Some(add(&mut draft.p, row(value, &item.gradient, 1.0, &[(s, 1.0)])))
    }

    fn piece(draft: &mut Draft, piece: &LinearPiece) -> Option<usize> {
        let y = draft.gains[&piece.objective];
        match &piece.bound {
            LinearBound::Plain => {
                Some(add(&mut draft.p, row(piece.value, &piece.gradient, 1.0, &[(y, -1.0)])))
            }
            LinearBound::Length(cone) => {
                if !draft.lengths.contains_key(&piece.objective) {
                    let (low, high) = (draft.variable(0.0), draft.variable(0.0));
                    draft.p.at_least_zero(vec![(y, 1.0), (low, -1.0), (high, 1.0)], 0.0);
                    draft.lengths.insert(piece.objective, (low, high));
                }
                let (low, high) = draft.lengths[&piece.objective];
                let at = add(&mut draft.p, row(piece.value, &piece.gradient, 1.0, &[(low, -1.0)]));
                match cone {
                    Some(cone) => second_order(&mut draft.p, row(0.0, &[], 1.0, &[(high, 1.0)]), cone),
                    None => {
                        add(&mut draft.p, row(-piece.value, &piece.gradient, -1.0, &[(high, 1.0)]));
                    }
                }
                Some(at)
            }
            LinearBound::Spectral { f, h, low, high } => {
                if low.others.is_empty() && high.others.is_empty() {
                    return Some(add(&mut draft.p, row(piece.value, &piece.gradient, 1.0, &[(y, -1.0)])));
                }
                spectral(draft, piece.value, y, (*f, low), (*h, high));
                None
            }
        }
    }
}

fn second_order(p: &mut ConicProgram, head: ConicRow, cone: &AffineCone) {
    let tail = cone.tail.iter().map(|(v, g)| row(*v, g, 1.0, &[]));
    p.second_order(std::iter::once(head).chain(tail).collect());
}

/// `y <= value + f (low - sigma_6) - h (high - sigma_1)`, `low` at most the least and `high` at least the greatest eigenvalue of the
/// linear models of the clusters, pair by pair.
///
/// A pair: `lambda_min [[a, b], [b, c]] >= z` is the cone `a + c - 2 z >= |(a - c, 2 b)|`.
fn spectral(
    draft: &mut Draft,
    value: f64,
    y: usize,
    (f, low): (f64, &LinearCluster),
    (h, high): (f64, &LinearCluster),
) {
    let (z, w) = (draft.variable(0.0), draft.variable(0.0));
    // z and w count from sigma_6 and sigma_1
    draft.p.at_least_zero(vec![(y, 1.0), (z, -f), (w, h)], value);
    bound(&mut draft.p, low, z, 1.0);
    bound(&mut draft.p, high, w, -1.0);
}

/// `sign (model - sigma - z) >= 0` for every eigenvalue of the cluster.
fn bound(p: &mut ConicProgram, c: &LinearCluster, z: usize, sign: f64) {
    if c.others.is_empty() {
        add(p, row(0.0, &c.own, sign, &[(z, -sign)]));
    }
    for (sigma, across, other) in &c.others {
        let gap = sign * (sigma - c.sigma);
        let sum: Vec<f64> = c.own.iter().zip(other).map(|(a, b)| a + b).collect();
        let difference: Vec<f64> = c.own.iter().zip(other).map(|(a, b)| a - b).collect();
        p.second_order(vec![
            row(gap, &sum, sign, &[(z, -2.0 * sign)]),
            row(-gap, &difference, sign, &[]),
            row(0.0, across, 2.0, &[]),
        ]);
    }
}
