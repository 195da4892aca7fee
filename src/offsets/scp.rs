//! Sequential convex programming with a trust region, on one cell.
//!
//! Every step solves one conic subproblem, then is judged by the true worst case over all poses and the true
//! constraints (merit `value / reference - penalty * violation`).

use super::branch::Cell;
use super::conditioning::{worst_case, worst_case_above};
use super::problem::{BACKOFF, Model};
use super::subproblem::{ActivePose, Multipliers, Subproblem, lagrangian_curvature, violation};
use crate::num::conic::SolverFailure;

/// How hard to try.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub(crate) max_iterations: usize,
    /// Stop when the model promises less than this, relative to the value.
    pub(crate) tolerance: f64,
}

impl Effort {
    /// Enough to rank a cell.
    pub(crate) const RANK: Self = Self { max_iterations: 12, tolerance: 1e-3 };
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
pub struct HistoryStep {
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
    pub(crate) t: [f64; 6],
    pub(crate) value: f64,
    pub(crate) violation: f64,
    pub(crate) converged: bool,
    /// First-order gain the model still promises, relative to the value, for a unit of offset.
    pub(crate) stationarity: f64,
    pub(crate) history: Vec<HistoryStep>,
    pub(crate) failure: Option<SolverFailure>,
}

impl LocalResult {
    /// A feasible point that was drawn and not climbed from.
    pub(crate) fn drawn(t: [f64; 6], value: f64) -> Self {
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
const LARGEST_PENALTY: f64 = 1e7;
const FIRST_RADIUS: f64 = 0.15;
const LARGEST_RADIUS: f64 = 0.6;
const SMALLEST_RADIUS: f64 = 1e-8;
/// Poses in the first working set.
const FIRST_POSES: usize = 6;
/// Radius at which stationarity is measured.
const PROBE_RADIUS: f64 = 1e-2;

struct Run<'a> {
    m: &'a Model,
    cell: &'a Cell,
    t: [f64; 6],
    value: f64,
    worst: usize,
    violation: f64,
    /// Poses the subproblem sees; grows by every pose that refuted a step.
    working: Vec<usize>,
    multipliers: Multipliers,
    penalty: f64,
}

impl Run<'_> {
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

    fn subproblem<'b>(&'b self, active: &'b [ActivePose], radius: f64, curved: bool) -> Subproblem<'b> {
        let (t, reference) = (self.t, self.reference());
        let bend = || lagrangian_curvature(self.m, self.cell, &t, active, reference, &self.multipliers);
        let curvature = (curved && !self.multipliers.poses.is_empty()).then(bend);
        Subproblem {
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

fn lowest_poses(m: &Model, t: &[f64; 6], count: usize) -> Vec<usize> {
    let mut ranked: Vec<(f64, usize)> =
        m.poses.iter().enumerate().map(|(k, p)| (p.inverse_condition(t), k)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    ranked.truncate(count);
    let limit = ranked[0].0 * 2.0;
    ranked.into_iter().filter(|r| r.0 <= limit).map(|r| r.1).collect()
}

/// Climbs from `start` within the cell.
pub(crate) fn climb(m: &Model, cell: &Cell, start: [f64; 6], effort: Effort) -> LocalResult {
    let (value, worst) = worst_case(&m.poses, &start);
    let mut run = Run {
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
        history.push(HistoryStep {
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
fn stationarity(run: &Run<'_>) -> f64 {
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
