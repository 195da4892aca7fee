//! The conic program of one step.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::Climbable;
use super::linear::{AffineCone, LinearBound, LinearCluster, LinearItem, LinearPiece, Linearised};
use super::values::ConstraintGroup;
use num::conic::{ConicAnswer, ConicPoint, ConicProgram, ConicRow, SolverFailure};

/// Subproblem points with a larger violation (data of order one) are refused.
const ACCEPTED_RESIDUAL: f64 = 1e-6;
/// Violation at which an omitted row is added (data of order one).
const UNSEEN: f64 = 1e-9;
/// Initial number of rows of a group and of pieces of an objective in the program.
const FIRST: usize = 6;

/// The data of one step.
pub(super) struct Program<'a> {
    pub problem: &'a dyn Climbable,
    pub x: &'a [f64],
    pub near: &'a Linearised,
    pub radius: f64,
    pub penalty: f64,
    pub curvature: Option<&'a DMatrix<f64>>,
}

/// A step with its predicted values.
#[derive(Debug, Clone)]
pub(super) struct ClimbStep {
    pub d: Vec<f64>,
    /// Weighted gain minus penalised slacks, curvature included.
    pub merit: f64,
    /// Multipliers of the smooth constraints and pieces, by their position.
    pub items: Vec<f64>,
    pub pieces: Vec<f64>,
}

/// The constraints and pieces in the program.
struct Held {
    items: Vec<bool>,
    pieces: Vec<bool>,
}

impl Held {
    /// The initial choice: those with the least values of every group and objective.
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

/// A program under construction, with the indices of its variables.
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

impl Program<'_> {
    /// Solves for the step; refuses a point whose plain residual is too large.
    ///
    /// Few rows are active. The program begins with the rows of least value and adds those that its point violates.
    /// Once none is violated, the point solves the program with all rows.
    pub(super) fn solve(&self) -> Result<ClimbStep, SolverFailure> {
        let mut held = Held::first(self.near);
        loop {
            let (draft, rows) = self.write(&held);
            let point = match draft.p.solve(self.problem.conic()) {
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
        let task = self.problem.task();
        let p = ConicProgram { variables: n, linear: vec![0.0; n], ..Default::default() };
        let mut draft =
            Draft { p, gains: BTreeMap::new(), lengths: BTreeMap::new(), slacks: BTreeMap::new() };
        self.trust_region(&mut draft);
        for (m, weight) in task.weights.iter().enumerate() {
            if *weight > 0.0 || task.floors[m].is_some() {
                let y = draft.variable(-weight);
                draft.gains.insert(m, y);
            }
        }
        let used = self.near.items.iter().zip(&held.items).filter(|(_, h)| **h).map(|(i, _)| i.group);
        let floors = (0..task.floors.len()).filter(|m| task.floors[*m].is_some()).map(ConstraintGroup::Floor);
        for group in used.chain(floors) {
            if !draft.slacks.contains_key(&group) {
                let s = draft.variable(self.penalty * task.cost(group));
                draft.p.at_least_zero(vec![(s, -1.0)], 0.0);
                draft.slacks.insert(group, s);
            }
        }
        for (m, floor) in task.floors.iter().enumerate() {
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

    /// Marks the rows that the point violates; `false` if there are none.
    fn add_violated(&self, held: &mut Held, draft: &Draft, point: &[f64]) -> bool {
        let d = &point[..self.x.len()];
        let mut any = false;
        for (item, held) in self.near.items.iter().zip(&mut held.items).filter(|(_, h)| !**h) {
            let slack = draft.slacks.get(&item.group).map_or(0.0, |s| point[*s]);
            *held = item.room(d, slack, self.problem.backoff()) < -UNSEEN;
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

    fn step(&self, draft: &Draft, rows: [Vec<Option<usize>>; 2], point: &ConicPoint) -> ClimbStep {
        let n = self.x.len();
        let d: Vec<f64> = (0..n)
            .map(|j| {
                let (low, high) = self.problem.bounds()[j];
                (self.x[j] + point.x[j]).clamp(low, high) - self.x[j]
            })
            .collect();
        let gain: f64 = draft.gains.iter().map(|(m, y)| self.problem.task().weights[*m] * point.x[*y]).sum();
        let slack: f64 =
            draft.slacks.iter().map(|(g, s)| self.problem.task().cost(*g) * point.x[*s].max(0.0)).sum();
        let bend = self.curvature.map_or(0.0, |h| {
            let v = DVector::from_column_slice(&point.x[..n]);
            0.5 * v.dot(&(h * &v))
        });
        let dual =
            |rows: Vec<Option<usize>>| rows.into_iter().map(|r| r.map_or(0.0, |r| point.dual[r])).collect();
        let [items, pieces] = rows.map(dual);
        ClimbStep { d, merit: gain - self.penalty * slack - bend, items, pieces }
    }

    fn trust_region(&self, draft: &mut Draft) {
        for (j, (low, high)) in self.problem.bounds().iter().enumerate() {
            draft.p.at_least_zero(vec![(j, 1.0)], (high - self.x[j]).min(self.radius));
            draft.p.at_least_zero(vec![(j, -1.0)], (self.x[j] - low).min(self.radius));
        }
        for first in self.problem.unit_vectors() {
            let component = |j: usize| ConicRow { coefficients: vec![(j, -1.0)], rhs: self.x[j] };
            let head = ConicRow { coefficients: Vec::new(), rhs: 1.0 };
            draft.p.second_order(std::iter::once(head).chain((first..first + 3).map(component)).collect());
        }
    }

    /// Writes a constraint and returns the row of its multiplier if it is linear.
    fn item(&self, draft: &mut Draft, item: &LinearItem) -> Option<usize> {
        let s = draft.slacks[&item.group];
        if let Some(cone) = &item.cone {
            let head = row(cone.head.0, &cone.head.1, 1.0, &[(s, cone.slack)]);
            second_order(&mut draft.p, head, cone);
            return None;
        }
        let value = item.value - self.problem.backoff();
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

/// `y <= value + f (low - sigma_6) - h (high - sigma_1)`. `low` is at most the least and `high` at least the greatest
/// eigenvalue of the linear models of the clusters, pair by pair.
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
