//! A cell of offsets as a problem for the climb.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

use super::branch::BranchCell;
use super::conditioning::{PoseSpectrum, worst_case};
use super::limits::SlidingPair;
use super::problem::{BACKOFF, OffsetModel};
use crate::climb::{
    self, CLUSTER, Climbable, ConstraintGroup, Effort, HistoryStep, LinearBound, LinearCluster, LinearItem,
    LinearPiece, Linearised, NO_POSE, PointValues, Run, Task, TermId,
};
use machine::requirements::TermKind;
use num::conic::{ConicTally, SolverFailure};
use synthesis::{determinant_gradient, offset_determinant};

/// Effort that ranks a cell; a higher penalty saves a tenth of the steps, measured over 1,700 cells.
pub(super) const RANK: Effort = Effort { iterations: 10, tolerance: 3e-3, penalty: 100.0 };
/// Effort that removes a violation if sampling found no feasible point.
pub(super) const RESTORE: Effort = Effort { iterations: 60, ..RANK };

/// The result of a climb in a cell.
#[derive(Debug, Clone)]
pub(crate) struct LocalResult {
    pub t: [f64; 6],
    /// Worst-case inverse condition number.
    pub value: f64,
    pub(super) feasible: bool,
    pub converged: bool,
    /// Predicted first-order gain, relative to the value, per unit of offset.
    pub stationarity: f64,
    pub history: Vec<HistoryStep>,
    pub failure: Option<SolverFailure>,
}

impl LocalResult {
    /// A random feasible point without a climb.
    pub(super) fn drawn(t: [f64; 6], value: f64) -> Self {
        Self {
            t,
            value,
            feasible: true,
            converged: false,
            stationarity: f64::INFINITY,
            history: Vec::new(),
            failure: None,
        }
    }

    fn new(run: &Run, reference: f64) -> Self {
        let mut t = [0.0; 6];
        t.copy_from_slice(&run.x);
        let step = |h: &HistoryStep| HistoryStep { gain: h.gain * reference, ..*h };
        Self {
            t,
            value: run.judged.gains[0] * reference,
            feasible: run.is_feasible(),
            converged: run.converged,
            stationarity: run.stationarity,
            history: run.history.iter().map(step).collect(),
            failure: run.failure,
        }
    }

    /// Whether violations are inside the back-off from the true limits.
    pub(crate) fn is_feasible(&self) -> bool {
        self.feasible
    }
}

/// A constraint of a cell, which must be at least 0 after subtraction of the back-off.
struct CellConstraint {
    group: ConstraintGroup,
    id: TermId,
    value: f64,
    gradient: [f64; 6],
}

/// `2 m` times the radius of the body: converts a difference of squared distances to a length relative to the body.
fn pair_unit(m: &OffsetModel, pair: &SlidingPair) -> f64 {
    2.0 * m.kept_spacing(pair.first) * m.radius(pair.first)
}

/// `(q - m^2) / (2 m)` of a close pair, relative to the radius of its body.
fn pair_value(m: &OffsetModel, pair: &SlidingPair, t: &[f64; 6]) -> f64 {
    (pair.squared(t) - m.kept_spacing(pair.first).powi(2)) / pair_unit(m, pair)
}

fn determinant_value(m: &OffsetModel, cell: &BranchCell, t: &[f64; 6]) -> f64 {
    cell.sign * offset_determinant(t) - m.kept_det()
}

/// Largest violation of `det A` and of the close pairs.
pub(super) fn violation(m: &OffsetModel, cell: &BranchCell, t: &[f64; 6]) -> f64 {
    let pairs = cell.pairs.iter().map(|(pair, _)| pair_value(m, pair, t));
    pairs.chain([determinant_value(m, cell, t)]).fold(0.0, |v, c| v.max(-c))
}

/// The kind of the joint distances on the sliding body of a side.
fn spacing_kind(side: usize) -> TermKind {
    [TermKind::BaseSpacing, TermKind::PlatformSpacing][side % 2]
}

/// The best worst-case inverse condition number within a cell.
struct CellClimb<'a> {
    m: &'a OffsetModel,
    cell: &'a BranchCell,
    task: Task,
    /// Unit of the gain.
    reference: f64,
    /// Pose that was worst at the last point.
    worst: Cell<usize>,
    /// Poses in the steps: those of low value at a point, and those that refused a step.
    working: RefCell<BTreeSet<usize>>,
    /// The last judged point, by its bits, and its values at the evaluated poses.
    judged: RefCell<([u64; 6], Vec<f64>)>,
}

impl CellClimb<'_> {
    fn constraints(&self, t: &[f64; 6], see: &mut dyn FnMut(CellConstraint)) {
        let kind = TermKind::BaseSpacing;
        see(CellConstraint {
            group: ConstraintGroup::Determinant,
            id: (kind, NO_POSE, NO_POSE, NO_POSE),
            value: determinant_value(self.m, self.cell, t),
            gradient: determinant_gradient(t).map(|g| self.cell.sign * g),
        });
        let mut of_pair = |(first, second): (usize, usize), part, value, [x, y]: [f64; 2]| {
            let mut gradient = [0.0; 6];
            (gradient[first], gradient[second]) = (x, y);
            let kind = spacing_kind(first);
            see(CellConstraint {
                group: ConstraintGroup::Term(kind),
                id: (kind, first, second, part),
                value,
                gradient,
            });
        };
        for (pair, _) in &self.cell.pairs {
            let gradient = pair.gradient(t).map(|g| g / pair_unit(self.m, pair));
            of_pair((pair.first, pair.second), 0, pair_value(self.m, pair, t), gradient);
        }
        for (i, j, [c, x, y]) in self.cell.order_rows() {
            of_pair((i, j), 1, c + x * t[i] + y * t[j], [x, y]);
        }
    }

    fn piece(&self, pose: usize, s: &PoseSpectrum) -> LinearPiece {
        let cluster = |k: usize, others: [usize; 2]| {
            let near = |o: &usize| s.sigma[*o].max(s.sigma[k]) < CLUSTER * s.sigma[*o].min(s.sigma[k]);
            let block = |a, b| s.block_gradient(a, b).to_vec();
            let others = others.into_iter().filter(near).map(|o| (s.sigma[o], block(k, o), block(o, o)));
            LinearCluster { sigma: s.sigma[k], own: block(k, k), others: others.collect() }
        };
        let value = s.inverse_condition() / self.reference;
        let f = 1.0 / (s.sigma[0] * self.reference);
        let h = value / s.sigma[0];
        let (low, high) = (cluster(5, [4, 3]), cluster(0, [1, 2]));
        let gradient = low.own.iter().zip(&high.own).map(|(l, u)| f * l - h * u).collect();
        let bound = LinearBound::Spectral { f, h, low, high };
        LinearPiece { objective: 0, id: (pose, 0), value, gradient, bound }
    }
}

/// Number of poses of least value in a step, if within this factor of the least value.
const FIRST_POSES: usize = 6;
const NEAR: f64 = 2.0;

fn offsets(x: &[f64]) -> [f64; 6] {
    std::array::from_fn(|i| x[i])
}

impl Climbable for CellClimb<'_> {
    fn task(&self) -> &Task {
        &self.task
    }

    fn bounds(&self) -> &[(f64, f64)] {
        &self.cell.bounds
    }

    fn backoff(&self) -> f64 {
        BACKOFF
    }

    fn conic(&self) -> &ConicTally {
        &self.m.conic
    }

    fn poses(&self) -> usize {
        self.m.poses.len()
    }

    fn judge(&self, x: &[f64], refused: &dyn Fn(&PointValues) -> bool) -> PointValues {
        let t = offsets(x);
        let mut judged = self.judged.borrow_mut();
        judged.0 = t.map(f64::to_bits);
        let mut values = PointValues { gains: vec![f64::INFINITY], violations: BTreeMap::new() };
        self.constraints(&t, &mut |c| values.hold(c.group, c.value, 0.0));
        let first = self.worst.get();
        for k in std::iter::once(first).chain((0..self.m.poses.len()).filter(|k| *k != first)) {
            judged.1[k] = self.m.poses[k].inverse_condition(&t);
            let gain = judged.1[k] / self.reference;
            if gain < values.gains[0] {
                values.gains[0] = gain;
                self.worst.set(k);
                if refused(&values) {
                    break;
                }
            }
        }
        self.working.borrow_mut().insert(self.worst.get());
        values
    }

    fn linearise(&self, x: &[f64], _radius: f64) -> Option<Linearised> {
        let t = offsets(x);
        let mut out = Linearised::default();
        self.constraints(&t, &mut |c| {
            out.items.push(LinearItem {
                group: c.group,
                id: (NO_POSE, c.id),
                value: c.value + BACKOFF,
                gradient: c.gradient.to_vec(),
                cone: None,
            });
        });
        // the point of an accepted step has just been judged at all poses
        if self.judged.borrow().0 != t.map(f64::to_bits) {
            self.judge(x, &|_| false);
        }
        let values = &self.judged.borrow().1;
        let mut lowest: Vec<usize> = (0..values.len()).collect();
        lowest.sort_by(|i, j| values[*i].total_cmp(&values[*j]));
        let mut working = self.working.borrow_mut();
        for k in
            lowest.into_iter().take(FIRST_POSES).filter(|k| values[*k] <= NEAR * values[self.worst.get()])
        {
            working.insert(k);
        }
        for k in working.iter() {
            out.pieces.push(self.piece(*k, &self.m.poses[*k].spectrum(&t)?));
        }
        Some(out)
    }
}

/// Least unit of gains; otherwise gains are in units of the value at the start.
const LEAST_REFERENCE: f64 = 1e-3;

/// Climbs from `start` within the cell.
pub(super) fn climb(m: &OffsetModel, cell: &BranchCell, start: [f64; 6], effort: Effort) -> LocalResult {
    let (value, worst) = worst_case(&m.poses, &start);
    let reference = value.max(LEAST_REFERENCE);
    let task = Task { weights: vec![1.0], floors: vec![None], ..Task::default() };
    let judged = RefCell::new(([f64::NAN.to_bits(); 6], vec![f64::NAN; m.poses.len()]));
    let problem =
        CellClimb { m, cell, task, reference, worst: Cell::new(worst), working: RefCell::default(), judged };
    LocalResult::new(&climb::climb(&problem, &start, effort), reference)
}
