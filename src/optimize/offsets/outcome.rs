//! The answer of the search, checked again on the original problem in design units by separate code.

use nalgebra::Matrix6;

use super::bound::GlobalBound;
use super::branch::Branch;
use super::problem::OffsetProblem;
use super::verdict::Conflict;
use crate::climb::HistoryStep;
use num::conic::SolverFailure;
use num::linalg::svd;
use platform::manipulator::{Manipulator, jacobian};
use synthesis::{AffineLegMap, joint_free, offset_determinant};

/// Distances from the limits; negative means violated. The signs are those of exact arithmetic on the offsets and the
/// design as written: zero is met exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margins {
    /// Least distance of two base joint centres minus the required one, design units.
    pub base_spacing: f64,
    /// The same on the platform.
    pub platform_spacing: f64,
    /// `|det A|` minus the required value.
    pub det: f64,
    /// Least distance of an offset from its bounds (offset units).
    pub bounds: f64,
}

impl Margins {
    /// Whether no limit is violated, exactly.
    #[must_use]
    pub fn all_met(&self) -> bool {
        self.base_spacing >= 0.0 && self.platform_spacing >= 0.0 && self.det >= 0.0 && self.bounds >= 0.0
    }
}

/// Independent evaluation of a set of offsets.
#[derive(Debug, Clone, PartialEq)]
pub struct Recheck {
    /// Worst inverse condition number over the poses, by a full SVD at every pose.
    pub objective: f64,
    /// The pose where it occurs (0-based).
    pub worst_pose: usize,
    /// Inverse condition number at every pose.
    pub per_pose: Vec<f64>,
    /// `det A` by the product formula.
    pub det: f64,
    /// `det A` of the numeric 6 x 6 matrix of the leg map.
    pub det_of_matrix: f64,
    /// Constraint margins.
    pub margins: Margins,
}

fn inverse_condition(j: &Matrix6<f64>) -> f64 {
    let rows: Vec<Vec<f64>> = j.row_iter().map(|r| r.iter().copied().collect()).collect();
    if rows.iter().flatten().any(|x| !x.is_finite()) {
        return 0.0;
    }
    match svd(&rows) {
        Ok(d) if d.s[0] > 0.0 => d.s[5] / d.s[0],
        _ => 0.0,
    }
}

impl OffsetProblem {
    /// Evaluates offsets on the original problem. It gives margins with exact signs, `det A` in two ways, and an SVD at
    /// every pose of the manipulator. `None` if the offsets form no manipulator (not finite).
    #[must_use]
    pub fn recheck(&self, t: &[f64; 6]) -> Option<Recheck> {
        let (m, map) = joint_free(&self.octahedral, *t).ok()?;
        let per_pose: Vec<f64> = self
            .poses
            .iter()
            .map(|p| inverse_condition(&jacobian(&m, p, self.characteristic_length)))
            .collect();
        let mut worst = (f64::INFINITY, 0);
        for (k, value) in per_pose.iter().enumerate() {
            if *value < worst.0 {
                worst = (*value, k);
            }
        }
        let det = offset_determinant(t);
        let det_of_matrix = map.determinant();
        let margins = self.margins(t)?;
        Some(Recheck { objective: worst.0, worst_pose: worst.1, per_pose, det, det_of_matrix, margins })
    }
}

/// Evidence that no nearby offsets are better, a local statement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalEvidence {
    /// Whether the conic solver's model predicted no further gain.
    pub converged: bool,
    /// Predicted first-order gain per unit of offset, relative to the objective (KKT residual).
    pub stationarity: f64,
    /// Relative gain of a derivative-free search around the solution, on the true problem.
    pub pattern_gain: f64,
    /// Number of trial points of that search.
    pub pattern_trials: usize,
}

/// Optimised offsets with their evidence.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OffsetSolution {
    /// `t_i`, dimensionless, cyclic order.
    pub offsets: [f64; 6],
    /// `Delta_i = t_i d_i`, design units: signed distance from the start of the edge.
    pub shifts: [f64; 6],
    /// Zones of the offsets.
    pub branch: Branch,
    /// Independent evaluation on the original problem.
    pub recheck: Recheck,
    /// Local optimality evidence.
    pub evidence: LocalEvidence,
    /// Steps of the run that found the solution.
    pub history: Vec<HistoryStep>,
    /// The platform, legs in the order of the design.
    pub manipulator: Manipulator,
    /// `s' = A s + c`, legs in the order of the design.
    pub map: AffineLegMap,
}

/// The answer.
#[derive(Debug, Clone, PartialEq)]
pub enum OffsetOutcome {
    /// Feasible by the re-check, and proved: no offsets exceed it by more than the requested gap
    /// ([`OffsetReport::bound`]).
    Optimal(Box<OffsetSolution>),
    /// Feasible by the re-check and locally optimal by the evidence. The bound over other offsets has a wider gap than
    /// requested, or is missing.
    LocalOptimum(Box<OffsetSolution>),
    /// Feasible by the re-check, but without evidence of local optimality and without proof of a small gap.
    NotConverged(Box<OffsetSolution>),
    /// Every branch is proved empty.
    Infeasible,
    /// No feasible point found, and some branches are not proved empty.
    Undecided {
        /// Number of these branches.
        unproved: usize,
    },
}

/// The verdict on one branch.
#[derive(Debug, Clone, PartialEq)]
pub enum BranchVerdict {
    /// Holds the best solution.
    Best,
    /// Feasible, with a best value below that of the solution.
    Dominated {
        /// Worst-case inverse condition number reached.
        value: f64,
        /// Its offsets.
        offsets: [f64; 6],
        /// `true` if the local search of the best cell converged.
        settled: bool,
    },
    /// No feasible point was drawn or searched: the bound over all offsets covers it.
    Bounded,
    /// Proved empty by the conflicts.
    Infeasible,
    /// No feasible point found, emptiness not proved.
    Unproved,
    /// No feasible point found because the conic solver failed.
    SolverFailure(SolverFailure),
}

impl BranchVerdict {
    /// The verdict as a word.
    #[must_use]
    pub fn word(&self) -> BranchWord {
        match self {
            Self::Best => BranchWord::Best,
            Self::Dominated { .. } => BranchWord::Dominated,
            Self::Bounded => BranchWord::Bounded,
            Self::Infeasible => BranchWord::Infeasible,
            Self::Unproved => BranchWord::Unproved,
            Self::SolverFailure(_) => BranchWord::SolverFailure,
        }
    }
}

/// The verdict on a branch, as a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum BranchWord {
    /// It holds the best solution.
    Best,
    /// It is feasible, but does not reach the best value.
    Dominated,
    /// No feasible point was searched: the bound over all offsets covers it.
    Bounded,
    /// It is proved empty.
    Infeasible,
    /// No feasible point was found.
    Unproved,
    /// No feasible point was found because the conic solver failed.
    SolverFailure,
}

/// A branch with its verdict.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchReport {
    /// The branch.
    pub branch: Branch,
    /// Cells searched (sign of `det A`, order of close joints, split zones).
    pub cells: usize,
    /// Proved conflicts of the branch or of parts of it.
    pub conflicts: Vec<Conflict>,
    /// The verdict.
    pub verdict: BranchVerdict,
}

/// All results of the search.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OffsetReport {
    /// The answer.
    pub outcome: OffsetOutcome,
    /// All 729 branches in the order of [`Branch::all`].
    pub branches: Vec<BranchReport>,
    /// The best other branches, best first: indices into `branches` with polished values.
    pub runners_up: Vec<usize>,
    /// The proved upper bound over all offsets; `None` without a solution, or without a proof.
    pub bound: Option<GlobalBound>,
    /// Requested gap: the greatest one at which a solution counts as optimal.
    pub tolerance: f64,
    /// `true` if the caller interrupted the search: the solution is the best until then.
    pub interrupted: bool,
    /// Seed of the starting points.
    pub seed: u64,
    /// Number of solved conic programs.
    pub conic_programs: u64,
}

/// Counts of the verdicts on the branches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "BranchCountsRecord")
)]
pub struct BranchCounts {
    /// All branches.
    pub total: usize,
    /// Feasible branches.
    // including the best one
    pub feasible: usize,
    /// Proved empty: zone outside the bounds.
    #[cfg_attr(feature = "serde", serde(rename = "infeasible_bounds"))]
    pub outside_bounds: usize,
    /// Proved empty: no space for joints.
    // of vertices, edge joints, or several together
    #[cfg_attr(feature = "serde", serde(rename = "infeasible_spacing"))]
    pub spacing: usize,
    /// Proved empty: |det A| too small.
    #[cfg_attr(feature = "serde", serde(rename = "infeasible_det"))]
    pub det: usize,
    /// Excluded by the bound over all offsets, without a search.
    pub bounded: usize,
    /// Undecided.
    pub unproved: usize,
    /// The conic solver failed.
    #[cfg_attr(feature = "serde", serde(rename = "solver_failure"))]
    pub failed: usize,
}

impl OffsetReport {
    /// The solution, if there is one.
    #[must_use]
    pub fn solution(&self) -> Option<&OffsetSolution> {
        match &self.outcome {
            OffsetOutcome::Optimal(s) | OffsetOutcome::LocalOptimum(s) | OffsetOutcome::NotConverged(s) => {
                Some(s)
            }
            OffsetOutcome::Infeasible | OffsetOutcome::Undecided { .. } => None,
        }
    }

    /// Counts the verdicts; an empty branch counts once, under its first conflict.
    #[must_use]
    pub fn counts(&self) -> BranchCounts {
        let mut n = BranchCounts { total: self.branches.len(), ..BranchCounts::default() };
        for b in &self.branches {
            let slot = match (&b.verdict, b.conflicts.first()) {
                (BranchVerdict::Best | BranchVerdict::Dominated { .. }, _) => &mut n.feasible,
                (BranchVerdict::Bounded, _) => &mut n.bounded,
                (BranchVerdict::Unproved, _) => &mut n.unproved,
                (BranchVerdict::SolverFailure(_), _) => &mut n.failed,
                (BranchVerdict::Infeasible, Some(Conflict::OutsideBounds { .. })) => &mut n.outside_bounds,
                (BranchVerdict::Infeasible, Some(Conflict::DetTooSmall { .. })) => &mut n.det,
                (BranchVerdict::Infeasible, _) => &mut n.spacing,
            };
            *slot += 1;
        }
        n
    }
}
