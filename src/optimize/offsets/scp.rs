//! Sequential convex programming with a trust region, on one cell.
//!
//! Every step solves one conic subproblem, then is judged by the true worst case over all poses and the true
//! constraints (merit `value / reference - penalty * violation`).

use nalgebra::Matrix6;

use super::branch::BranchCell;
use super::conditioning::{PoseSpectrum, worst_case, worst_case_above};
use super::limits::SlidingPair;
use super::problem::{BACKOFF, OffsetModel};
use num::conic::{ConicAnswer, ConicPoint, ConicProgram, ConicRow, SolverFailure};
use synthesis::{determinant_gradient, determinant_hessian, offset_determinant};

/// How hard to try.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OffsetEffort {
    max_iterations: usize,
    /// Stop when the model promises less than this, relative to the value.
    pub tolerance: f64,
}

impl OffsetEffort {
    /// Enough to rank a cell.
    pub(super) const RANK: Self = Self { max_iterations: 12, tolerance: 1e-3 };
    /// To the solver's accuracy.
    pub(crate) const POLISH: Self = Self { max_iterations: 80, tolerance: 2e-8 };
    /// Enough to get rid of a violation where sampling found no feasible point.
    pub(crate) const RESTORE: Self = Self { max_iterations: 60, tolerance: 1e-3 };

    /// Only a polished run is worth the subproblem that measures stationarity.
    fn measures_stationarity(self) -> bool {
        self.tolerance < 1e-6
    }
}

/// One accepted or refused step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffsetHistoryStep {
    /// Worst-case inverse condition number after the step.
    pub value: f64,
    /// Largest constraint violation after the step (lengths relative to the size).
    pub violation: f64,
    /// Trust radius of the step (offset units).
    pub radius: f64,
    /// Gain the model promised, relative.
    pub predicted: f64,
    /// Gain found, relative.
    pub actual: f64,
    /// `true` when the step was taken.
    pub accepted: bool,
}

/// Where a run ended.
#[derive(Debug, Clone)]
pub(crate) struct LocalResult {
    pub t: [f64; 6],
    pub value: f64,
    pub violation: f64,
    pub converged: bool,
    /// First-order gain the model still promises, relative to the value, for a unit of offset.
    pub stationarity: f64,
    pub history: Vec<OffsetHistoryStep>,
    pub failure: Option<SolverFailure>,
}

impl LocalResult {
    /// A feasible point that was drawn and not climbed from.
    pub(super) fn drawn(t: [f64; 6], value: f64) -> Self {
        Self {
            t,
            value,
            violation: 0.0,
            converged: false,
            stationarity: f64::INFINITY,
            history: Vec::new(),
            failure: None,
        }
    }

    /// Violations below this are inside the back-off from the true limits.
    pub(crate) fn is_feasible(&self) -> bool {
        self.violation <= 0.5 * BACKOFF
    }
}

/// First weight of the violation; raised tenfold while a run settles at an infeasible point.
const PENALTY: f64 = 100.0;
/// A run that would need a larger one is given up.
const LARGEST_PENALTY: f64 = 1e7;
/// Trust region of the first step, of the longest one, and the one at which a run has come to its end; offsets are fractions of an edge.
const FIRST_RADIUS: f64 = 0.15;
const LARGEST_RADIUS: f64 = 0.6;
const SMALLEST_RADIUS: f64 = 1e-8;
/// Poses in the first working set.
const FIRST_POSES: usize = 6;
/// Radius at which stationarity is measured.
const PROBE_RADIUS: f64 = 1e-2;

struct OffsetRun<'a> {
    m: &'a OffsetModel,
    cell: &'a BranchCell,
    t: [f64; 6],
    value: f64,
    worst: usize,
    violation: f64,
    /// Poses the subproblem sees; grows by every pose that refuted a step.
    working: Vec<usize>,
    multipliers: Multipliers,
    penalty: f64,
}

impl OffsetRun<'_> {
    fn reference(&self) -> f64 {
        self.value.max(1e-9)
    }

    fn merit(&self, value: f64, violation: f64) -> f64 {
        value / self.reference() - self.penalty * violation
    }

    fn active(&self) -> Option<Vec<ActivePose>> {
        let decompose =
            |&pose: &usize| Some(ActivePose { pose, spectrum: self.m.poses[pose].spectrum(&self.t)? });
        self.working.iter().map(decompose).collect()
    }

    fn subproblem<'b>(&'b self, active: &'b [ActivePose], radius: f64, curved: bool) -> OffsetSubproblem<'b> {
        let (t, reference) = (self.t, self.reference());
        let bend = || lagrangian_curvature(self.m, self.cell, &t, active, reference, &self.multipliers);
        let curvature = (curved && !self.multipliers.poses.is_empty()).then(bend);
        OffsetSubproblem {
            model: self.m,
            cell: self.cell,
            t,
            active,
            reference,
            radius,
            penalty: self.penalty,
            curvature,
        }
    }
}

fn lowest_poses(m: &OffsetModel, t: &[f64; 6], count: usize) -> Vec<usize> {
    let mut ranked: Vec<(f64, usize)> =
        m.poses.iter().enumerate().map(|(k, p)| (p.inverse_condition(t), k)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    ranked.truncate(count);
    let limit = ranked[0].0 * 2.0;
    ranked.into_iter().filter(|r| r.0 <= limit).map(|r| r.1).collect()
}

/// Climbs from `start` within the cell.
pub(super) fn climb(
    m: &OffsetModel,
    cell: &BranchCell,
    start: [f64; 6],
    effort: OffsetEffort,
) -> LocalResult {
    let (value, worst) = worst_case(&m.poses, &start);
    let mut run = OffsetRun {
        m,
        cell,
        t: start,
        value,
        worst,
        violation: violation(m, cell, &start),
        working: lowest_poses(m, &start, FIRST_POSES),
        multipliers: Multipliers::default(),
        penalty: PENALTY,
    };
    let (mut radius, mut converged, mut failure) = (FIRST_RADIUS, false, None);
    let mut history = Vec::new();
    for _ in 0..effort.max_iterations {
        let Some(active) = run.active() else {
            failure = Some(SolverFailure::Data);
            break;
        };
        let step = match run.subproblem(&active, radius, true).solve() {
            Ok(step) => step,
            Err(why) => {
                failure = Some(why);
                radius *= 0.3;
                if radius < SMALLEST_RADIUS {
                    break;
                }
                continue;
            }
        };
        failure = None;
        let now = run.merit(run.value, run.violation);
        let predicted = step.value - run.penalty * step.slack - now;
        run.multipliers = step.multipliers;
        if predicted < effort.tolerance {
            converged = run.violation <= 0.5 * BACKOFF;
            if converged || run.penalty >= LARGEST_PENALTY {
                break;
            }
            run.penalty *= 10.0;
            continue;
        }
        let trial: [f64; 6] = std::array::from_fn(|i| run.t[i] + step.d[i]);
        let trial_violation = violation(m, cell, &trial);
        // below this value the step cannot be accepted
        let floor = (now + 0.1 * predicted + run.penalty * trial_violation) * run.reference();
        let (trial_value, trial_worst, enough) = match worst_case_above(&m.poses, &trial, floor, run.worst) {
            Ok((value, pose)) => (value, pose, true),
            Err((value, pose)) => (value, pose, false),
        };
        let actual = run.merit(trial_value, trial_violation) - now;
        let known = run.working.contains(&trial_worst);
        let length = step.d.iter().fold(0.0, |x: f64, d| x.max(d.abs()));
        history.push(OffsetHistoryStep {
            value: if enough { trial_value } else { run.value },
            violation: if enough { trial_violation } else { run.violation },
            radius,
            predicted,
            actual,
            accepted: enough,
        });
        if !known {
            run.working.push(trial_worst);
        }
        if enough {
            (run.t, run.value, run.worst, run.violation) = (trial, trial_value, trial_worst, trial_violation);
            if actual > 0.7 * predicted && length > 0.8 * radius {
                radius = (2.0 * radius).min(LARGEST_RADIUS);
            }
        } else if known {
            radius = 0.35 * radius.min(length);
        } else {
            radius = radius.min(1.5 * length); // same step size again, now with the pose that refuted it
        }
        if radius < SMALLEST_RADIUS {
            break;
        }
    }
    let stationarity = if effort.measures_stationarity() { stationarity(&run) } else { f64::INFINITY };
    LocalResult {
        t: run.t,
        value: run.value,
        violation: run.violation,
        converged,
        stationarity,
        history,
        failure,
    }
}

/// First-order gain promised within [`PROBE_RADIUS`], relative, per unit of offset; all poses are seen.
///
/// The subproblem is accurate to about 1e-8, so values below 1e-6 (of either sign) mean none.
fn stationarity(run: &OffsetRun<'_>) -> f64 {
    let decompose = |(pose, p): (usize, &super::conditioning::PoseLegs)| {
        Some(ActivePose { pose, spectrum: p.spectrum(&run.t)? })
    };
    let active: Option<Vec<ActivePose>> = run.m.poses.iter().enumerate().map(decompose).collect();
    let step = active.map(|active| run.subproblem(&active, PROBE_RADIUS, false).solve());
    match step {
        Some(Ok(step)) => {
            let now = run.merit(run.value, run.violation);
            (step.value - run.penalty * step.slack - now) / PROBE_RADIUS
        }
        _ => f64::INFINITY,
    }
}

/// Singular values within this factor of the extreme one are modelled together, by a cone, so that a
/// crossing is not a kink of the model.
const CLUSTER_RATIO: f64 = 2.0;
/// A subproblem point with a larger violation (data of order one) is refused.
const ACCEPTED_RESIDUAL: f64 = 1e-6;

/// A pose in the working set with its decomposition at the current offsets.
#[derive(Debug, Clone)]
pub(crate) struct ActivePose {
    pub pose: usize,
    pub spectrum: PoseSpectrum,
}

impl ActivePose {
    /// Singular values close to the least one (`sigma_6`), nearest first, at most two.
    fn low_cluster(&self) -> Vec<usize> {
        let s = &self.spectrum.sigma;
        [4, 3].into_iter().filter(|&k| s[k] < CLUSTER_RATIO * s[5]).collect()
    }

    fn high_cluster(&self) -> Vec<usize> {
        let s = &self.spectrum.sigma;
        [1, 2].into_iter().filter(|&k| s[k] * CLUSTER_RATIO.sqrt() > s[0]).collect()
    }
}

/// Multipliers of the last subproblem: they weigh the curvatures of the next.
#[derive(Debug, Clone, Default)]
pub(crate) struct Multipliers {
    /// (pose, weight); the weights add up to one at a solution.
    pub poses: Vec<(usize, f64)>,
    pub det: f64,
    /// One a close pair of the cell.
    pub pairs: Vec<f64>,
}

/// A step with what the model promises.
#[derive(Debug, Clone)]
pub(crate) struct OffsetStep {
    pub d: [f64; 6],
    /// Predicted worst case relative to the reference value, curvature included.
    pub value: f64,
    /// Predicted violation that is left.
    pub slack: f64,
    pub multipliers: Multipliers,
}

/// What a subproblem is made of. `reference` scales the objective to order one; `penalty` weighs the slack.
#[derive(Debug)]
pub(crate) struct OffsetSubproblem<'a> {
    pub model: &'a OffsetModel,
    pub cell: &'a BranchCell,
    pub t: [f64; 6],
    active: &'a [ActivePose],
    pub reference: f64,
    pub radius: f64,
    pub(crate) penalty: f64,
    pub curvature: Option<Matrix6<f64>>,
}

/// `2 m` times the radius of the body: turns a difference of squared distances into a length relative to the body.
fn pair_unit(m: &OffsetModel, pair: &SlidingPair) -> f64 {
    2.0 * m.kept_spacing(pair.first) * m.radius(pair.first)
}

/// Constraint values that must be at least 0: `sign det A - delta`, then `(q - m^2) / (2 m)` of every close pair relative to the radius of its body.
fn constraint_values(m: &OffsetModel, cell: &BranchCell, t: &[f64; 6]) -> Vec<f64> {
    let det = cell.sign * offset_determinant(t) - m.kept_det();
    let pairs =
        cell.pairs.iter().map(|(p, _)| (p.squared(t) - m.kept_spacing(p.first).powi(2)) / pair_unit(m, p));
    std::iter::once(det).chain(pairs).collect()
}

/// Largest violation of [`constraint_values`].
pub(super) fn violation(m: &OffsetModel, cell: &BranchCell, t: &[f64; 6]) -> f64 {
    constraint_values(m, cell, t).into_iter().fold(0.0, |v, c| v.max(-c))
}

/// Columns of the subproblem after the six steps: the bound of the objective that is raised, and the violation that is paid for.
const GAMMA: usize = 6;
const SLACK: usize = 7;

fn along(d: &[f64; 6], factor: f64) -> Vec<(usize, f64)> {
    (0..6).map(|j| (j, factor * d[j])).collect()
}

/// Hessian of the Lagrangian at `t`, made negative semidefinite by dropping what curves upwards.
fn lagrangian_curvature(
    m: &OffsetModel,
    cell: &BranchCell,
    t: &[f64; 6],
    active: &[ActivePose],
    reference: f64,
    multipliers: &Multipliers,
) -> Matrix6<f64> {
    let mut h = determinant_hessian(t) * (cell.sign * multipliers.det);
    for a in active {
        let weight = multipliers.poses.iter().find(|w| w.0 == a.pose).map_or(0.0, |w| w.1);
        if weight > 1e-9 {
            h += a.spectrum.smooth_ratio_hessian(&a.low_cluster(), &a.high_cluster()) * (weight / reference);
        }
    }
    for ((pair, _), weight) in cell.pairs.iter().zip(&multipliers.pairs) {
        let (i, j) = (pair.first, pair.second);
        let [ii, ij, jj] = pair.hessian().map(|x| x * weight / pair_unit(m, pair));
        h[(i, i)] += ii;
        h[(i, j)] += ij;
        h[(j, i)] += ij;
        h[(j, j)] += jj;
    }
    let e = h.symmetric_eigen();
    let mut out = Matrix6::zeros();
    for k in 0..6 {
        let v = e.eigenvectors.column(k);
        out += v * v.transpose() * e.eigenvalues[k].min(0.0);
    }
    out
}

impl OffsetSubproblem<'_> {
    /// Solves for the step; refuses a point whose plain residual is too large.
    pub(super) fn solve(&self) -> Result<OffsetStep, SolverFailure> {
        let mut p = ConicProgram { variables: 8, linear: vec![0.0; 8], ..Default::default() };
        p.linear[GAMMA] = -1.0;
        p.linear[SLACK] = self.penalty;
        let first_pair = self.add_linear_rows(&mut p);
        let pose_rows: Vec<Vec<(usize, f64)>> =
            self.active.iter().map(|a| self.add_pose(&mut p, a)).collect();
        if let Some(h) = &self.curvature {
            let upper = (0..6).flat_map(|j| (0..=j).map(move |i| (i, j)));
            p.quadratic = upper.map(|(i, j)| (i, j, -h[(i, j)])).collect();
        }
        let point = match p.solve() {
            ConicAnswer::Point(point) => point,
            ConicAnswer::Infeasible(_) => return Err(SolverFailure::Numerical), // slack makes it feasible
            ConicAnswer::Failed(why) => return Err(why),
        };
        if point.residual > ACCEPTED_RESIDUAL {
            return Err(SolverFailure::Residual);
        }
        Ok(self.step(&point, first_pair, &pose_rows))
    }

    /// Trust region within the box, slack, order, determinant, close pairs. Returns the row of the determinant.
    fn add_linear_rows(&self, p: &mut ConicProgram) -> usize {
        for (i, (low, high)) in self.cell.bounds.into_iter().enumerate() {
            p.at_least_zero(vec![(i, 1.0)], (high - self.t[i]).min(self.radius));
            p.at_least_zero(vec![(i, -1.0)], (self.t[i] - low).min(self.radius));
        }
        p.at_least_zero(vec![(SLACK, -1.0)], 0.0);
        p.at_least_zero(vec![(GAMMA, 1.0)], 1e3); // keeps the program bounded with no pose in it
        for (i, j, [c, x, y]) in self.cell.order_rows() {
            p.at_least_zero(vec![(i, -x), (j, -y), (SLACK, -1.0)], c + x * self.t[i] + y * self.t[j]);
        }
        let det_row = p.rows.len();
        let values = constraint_values(self.model, self.cell, &self.t);
        let mut det = along(&determinant_gradient(&self.t), -self.cell.sign);
        det.push((SLACK, -1.0));
        p.at_least_zero(det, values[0]);
        for (k, (pair, _)) in self.cell.pairs.iter().enumerate() {
            let [x, y] = pair.gradient(&self.t).map(|g| g / pair_unit(self.model, pair));
            p.at_least_zero(vec![(pair.first, -x), (pair.second, -y), (SLACK, -1.0)], values[k + 1]);
        }
        det_row
    }

    /// `sigma_6 model >= gamma sigma_1 + g (sigma_1 model - sigma_1)`, divided by `sigma_1 reference`.
    ///
    /// A cluster of two: `lambda_min [[a, b], [b, c]] >= z` is the rotated cone `a + c - 2 z >= |(a - c, 2 b)|`.
    /// Returns the rows whose multipliers add up to the weight of the pose, with their factors.
    fn add_pose(&self, p: &mut ConicProgram, active: &ActivePose) -> Vec<(usize, f64)> {
        let s = &active.spectrum;
        let (top, g) = (s.sigma[0], s.inverse_condition());
        let unit = top * self.reference;
        // omega = (sigma_1 model - sigma_1) g / unit, as a combination of variables
        let high = active.high_cluster();
        let omega: Vec<(usize, f64)> = if high.is_empty() {
            along(&s.block_gradient(0, 0), g / unit)
        } else {
            let w = p.variables;
            p.variables += 1;
            p.linear.push(0.0);
            for o in high {
                add_cone(p, s, (0, o), -g / unit, &[(w, 1.0)], top);
            }
            vec![(w, 1.0)]
        };
        let mut z = omega;
        z.push((GAMMA, 1.0));
        let low = active.low_cluster();
        if low.is_empty() {
            let mut row = z;
            row.extend(along(&s.block_gradient(5, 5), -1.0 / unit));
            p.at_least_zero(merged(row), s.sigma[5] / unit);
            return vec![(p.rows.len() - 1, 1.0)];
        }
        let cones = low.into_iter().map(|o| (add_cone(p, s, (5, o), 1.0 / unit, &z, 0.0), 2.0));
        cones.collect()
    }

    fn step(&self, point: &ConicPoint, det_row: usize, pose_rows: &[Vec<(usize, f64)>]) -> OffsetStep {
        // solver residuals of 1e-9 must not leave the box of the branch
        let d: [f64; 6] = std::array::from_fn(|i| {
            let (low, high) = self.cell.bounds[i];
            (self.t[i] + point.x[i]).clamp(low, high) - self.t[i]
        });
        let bend = self.curvature.as_ref().map_or(0.0, |h| {
            let v = nalgebra::Vector6::from(d);
            0.5 * v.dot(&(h * v))
        });
        let weight = |rows: &Vec<(usize, f64)>| rows.iter().map(|&(r, f)| f * point.dual[r]).sum::<f64>();
        let poses = self.active.iter().zip(pose_rows).map(|(a, rows)| (a.pose, weight(rows))).collect();
        let pairs = (0..self.cell.pairs.len()).map(|k| point.dual[det_row + 1 + k]).collect();
        let multipliers = Multipliers { poses, det: point.dual[det_row], pairs };
        OffsetStep { d, value: point.x[GAMMA] + bend, slack: point.x[SLACK].max(0.0), multipliers }
    }
}

/// The cone `a + c - 2 z >= |(a - c, 2 b)|` with `a, b, c` the block of singular values `k, o`, shifted by
/// `base` and scaled by `f` (negative: upper bound). Returns the first row.
fn add_cone(
    p: &mut ConicProgram,
    s: &PoseSpectrum,
    (k, o): (usize, usize),
    f: f64,
    z: &[(usize, f64)],
    base: f64,
) -> usize {
    let at = p.rows.len();
    let (a, b, c) = (s.block_gradient(k, k), s.block_gradient(k, o), s.block_gradient(o, o));
    let (va, vc) = (f * (s.sigma[k] - base), f * (s.sigma[o] - base));
    let sum: [f64; 6] = std::array::from_fn(|j| a[j] + c[j]);
    let difference: [f64; 6] = std::array::from_fn(|j| a[j] - c[j]);
    // for an upper bound w the roles turn: 2 w + (a + c) f >= ..., f < 0
    let sign = f.signum();
    let mut first = along(&sum, -f);
    first.extend(z.iter().map(|&(j, v)| (j, 2.0 * sign * v)));
    p.second_order(vec![
        ConicRow { coefficients: merged(first), rhs: va + vc },
        ConicRow { coefficients: along(&difference, -f), rhs: va - vc },
        ConicRow { coefficients: along(&b, -2.0 * f), rhs: 0.0 },
    ]);
    at
}

/// Adds up repeated variables: the solver's matrix must not have duplicate entries.
fn merged(coefficients: Vec<(usize, f64)>) -> Vec<(usize, f64)> {
    let mut out: Vec<(usize, f64)> = Vec::with_capacity(coefficients.len());
    for (j, v) in coefficients {
        match out.iter_mut().find(|c| c.0 == j) {
            Some(c) => c.1 += v,
            None => out.push((j, v)),
        }
    }
    out
}
