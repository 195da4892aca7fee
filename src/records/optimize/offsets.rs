//! Answers about the offsets of an octahedral design.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::OptimalityWord;
use crate::design::Design;
use crate::entrance::optimizing::{met_or_nothing_required, offset_status};
use crate::entrance::{AssessReport, OptimizeStatus};
use crate::geom::Pose;
use crate::offsets::{
    BranchReport, BranchVerdict, Conflict, GlobalBound, OffsetHistoryStep, OffsetOutcome, OffsetProblem,
    OffsetReport, OffsetSolution,
};
use crate::records::map::matrix;
use crate::records::{AllOrNone, AssessAnswer, DesignRecord, Number, PoseRecord, SourceWord, leg_number};

/// Runners-up that are listed.
const RUNNERS_UP: usize = 5;

/// Everything there is to tell of a search for offsets.
#[derive(Debug, Clone, Copy)]
pub struct OffsetsFound<'a> {
    /// The design it began with.
    pub design: &'a Design,
    /// What was asked.
    pub problem: &'a OffsetProblem,
    /// What was found.
    pub report: &'a OffsetReport,
    /// The home pose.
    pub home: &'a Pose,
    /// Where it comes from.
    pub home_origin: SourceWord,
    /// Where the workspace comes from.
    pub workspace_origin: SourceWord,
    /// The optimised platform, when there is one.
    pub optimised: Option<&'a Design>,
    /// What `assess` says of it; `None` where nothing is required.
    pub assessed: Option<&'a AssessReport>,
}

/// The answer of `optimize` about the offsets of an octahedral design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OffsetsAnswer {
    /// What came of the search.
    pub status: OffsetsStatus,
    /// What is known of better ones; null: nothing, or there is no platform.
    pub optimality: Option<OptimalityWord>,
    /// The best offsets found.
    #[serde(flatten)]
    pub solution: AllOrNone<OffsetSolutionRecord>,
    /// What was required.
    pub requirements: OffsetLimitsRecord,
    /// The poses the worst case is taken over.
    pub poses: PoseSetRecord,
    /// What `assess` says of the platform; null: there is none, or the design requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// What became of the branches.
    pub branch_counts: BranchCountsRecord,
    /// What no offsets can exceed; null: not proved, or there is no solution.
    pub global_bound: Option<GlobalBoundRecord>,
    /// Greatest gap at which the answer counts as optimal.
    pub tolerance: f64,
    /// The best other branches.
    pub runners_up: Vec<BranchRecord>,
    /// All branches: a zone for each offset.
    pub branches: Vec<BranchRecord>,
    /// The platform; null: there is none.
    pub design: Option<DesignRecord>,
    /// The file written.
    pub output: Option<String>,
}

impl OffsetsAnswer {
    /// The answer of a search, with the file written.
    #[must_use]
    pub fn new(found: &OffsetsFound<'_>, output: Option<&str>) -> Self {
        let (p, r) = (found.problem, found.report);
        let status = OffsetsStatus::of(r, met_or_nothing_required(found.assessed));
        Self {
            status,
            optimality: match status {
                OffsetsStatus::Optimal => Some(OptimalityWord::ProvedWithinGap),
                OffsetsStatus::LocalOptimum => Some(OptimalityWord::BestOfStarts),
                _ => None,
            },
            solution: r.solution().map(|s| OffsetSolutionRecord::new(p, s)).into(),
            requirements: OffsetLimitsRecord {
                min_joint_distance: p.min_joint_distance,
                min_abs_det: p.min_abs_det,
                characteristic_length: p.characteristic_length,
                bounds: p.bounds.map(|b| [Number(b.0), Number(b.1)]),
                units: found.design.units.clone(),
            },
            poses: PoseSetRecord {
                count: p.poses.len(),
                home: found.home_origin,
                home_position: <[f64; 3]>::from(found.home.position).map(Number),
                workspace: found.workspace_origin,
            },
            assessment: found
                .assessed
                .zip(found.optimised)
                .map(|(assessed, design)| AssessAnswer::new(design, assessed)),
            branch_counts: r.into(),
            global_bound: r.bound.as_ref().map(GlobalBoundRecord::from),
            tolerance: r.tolerance,
            runners_up: r.runners_up.iter().take(RUNNERS_UP).map(|k| (&r.branches[*k]).into()).collect(),
            branches: r.branches.iter().map(BranchRecord::from).collect(),
            design: found.optimised.map(DesignRecord::from),
            output: output.map(str::to_owned),
        }
    }
}

/// What came of a search for offsets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OffsetsStatus {
    /// No offsets exceed the objective by more than the tolerance: proved.
    Optimal,
    /// None near do, by evidence, and the proved gap is wider or there is none.
    LocalOptimum,
    /// The limits are met; better offsets may be near.
    Feasible,
    /// Every branch is proved to violate the limits.
    Infeasible,
    /// Nothing was found, and some branches are not proved empty; or what was found is not proved to meet its requirements.
    Undecided,
    /// The platform found misses requirements; the assessment names them.
    Violated,
    /// The search was told to end.
    Interrupted,
}

impl OffsetsStatus {
    /// The status of a search; `met`: what is known of the requirements of the platform found.
    #[must_use]
    pub fn of(r: &OffsetReport, met: Option<bool>) -> Self {
        match offset_status(r, met) {
            OptimizeStatus::Optimal => Self::Optimal,
            OptimizeStatus::Feasible if matches!(r.outcome, OffsetOutcome::LocalOptimum(_)) => {
                Self::LocalOptimum
            }
            OptimizeStatus::Feasible => Self::Feasible,
            OptimizeStatus::Infeasible => Self::Infeasible,
            OptimizeStatus::Undecided => Self::Undecided,
            OptimizeStatus::Violated => Self::Violated,
            OptimizeStatus::Interrupted => Self::Interrupted,
        }
    }
}

impl OffsetsStatus {
    /// The word.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::LocalOptimum => "local optimum",
            Self::Feasible => "feasible",
            Self::Infeasible => "infeasible",
            Self::Undecided => "undecided",
            Self::Violated => "violated",
            Self::Interrupted => "interrupted",
        }
    }
}

/// Offsets with their evidence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OffsetSolutionRecord {
    /// Worst inverse condition number.
    pub objective: Number,
    /// Zone of each offset: before, inside, beyond its edge.
    #[schemars(extend("pattern" = ZONES))]
    pub branch: String,
    /// The numbers `t_i`, cyclic order.
    pub offsets: [Number; 6],
    /// `t_i d_i`, design units.
    pub shifts: [Number; 6],
    /// `d_i`, design units.
    pub edge_lengths: [Number; 6],
    /// The legs of the cycle, from 1.
    pub cyclic_order: [usize; 6],
    /// det A by the product formula.
    pub det: Number,
    /// det A of the matrix.
    pub det_of_matrix: Number,
    /// s' = A s + c, legs in the order of the design; rows.
    #[serde(rename = "A")]
    pub matrix: [[Number; 6]; 6],
    /// The constant terms, design units squared.
    #[serde(rename = "c")]
    pub constants: [Number; 6],
    /// By how much the limits are met.
    pub constraint_margins: OffsetMarginsRecord,
    /// Where the objective is reached.
    pub worst_pose: WorstPoseRecord,
    /// Evidence of local optimality.
    pub local_optimality: LocalOptimalityRecord,
    /// Steps of the run that found it.
    pub history: Vec<OffsetStepRecord>,
}

/// How the zones of the six offsets are written.
const ZONES: &str = "^[-0+]{6}$";

impl OffsetSolutionRecord {
    fn new(problem: &OffsetProblem, s: &OffsetSolution) -> Self {
        let r = &s.recheck;
        let constants: [f64; 6] = s.map.c.into();
        Self {
            objective: Number(r.objective),
            branch: s.branch.to_string(),
            offsets: s.offsets.map(Number),
            shifts: s.shifts.map(Number),
            edge_lengths: problem.edge_lengths().map(Number),
            cyclic_order: problem.octahedral.order().map(leg_number),
            det: Number(r.det),
            det_of_matrix: Number(r.det_of_matrix),
            matrix: matrix(&s.map),
            constants: constants.map(Number),
            constraint_margins: OffsetMarginsRecord {
                base_spacing: Number(r.margins.base_spacing),
                platform_spacing: Number(r.margins.platform_spacing),
                abs_det: Number(r.margins.det),
                bounds: Number(r.margins.bounds),
            },
            worst_pose: WorstPoseRecord { index: r.worst_pose, pose: (&problem.poses[r.worst_pose]).into() },
            local_optimality: LocalOptimalityRecord {
                converged: s.evidence.converged,
                stationarity: Number(s.evidence.stationarity),
                pattern_gain: Number(s.evidence.pattern_gain),
                pattern_trials: s.evidence.pattern_trials,
            },
            history: s.history.iter().map(OffsetStepRecord::from).collect(),
        }
    }
}

/// By how much limits of offsets are met.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OffsetMarginsRecord {
    /// Least distance of two base joints less the required one, design units.
    pub base_spacing: Number,
    /// The same on the platform.
    pub platform_spacing: Number,
    /// |det A| less the required value.
    pub abs_det: Number,
    /// Least distance of an offset from its bounds.
    pub bounds: Number,
}

/// The pose with the worst conditioning.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorstPoseRecord {
    /// Its place among the poses, from 0.
    pub index: usize,
    /// The pose.
    #[serde(flatten)]
    pub pose: PoseRecord,
}

/// Evidence of local optimality.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LocalOptimalityRecord {
    /// The model promised no further gain.
    pub converged: bool,
    /// Gain still promised for a unit of offset.
    pub stationarity: Number,
    /// Gained by a pattern search from there.
    pub pattern_gain: Number,
    /// Points it tried.
    pub pattern_trials: usize,
}

/// A step of the run that found the offsets.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OffsetStepRecord {
    /// Worst inverse condition number after the step.
    pub objective: Number,
    /// Lengths relative to the size.
    pub violation: Number,
    /// Of the trust region.
    pub radius: Number,
    /// Gain the model promised, relative.
    pub predicted: Number,
    /// Gain found, relative.
    pub actual: Number,
    /// The step was taken.
    pub accepted: bool,
}

impl From<&OffsetHistoryStep> for OffsetStepRecord {
    fn from(h: &OffsetHistoryStep) -> Self {
        Self {
            objective: Number(h.value),
            violation: Number(h.violation),
            radius: Number(h.radius),
            predicted: Number(h.predicted),
            actual: Number(h.actual),
            accepted: h.accepted,
        }
    }
}

/// What was required of offsets.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OffsetLimitsRecord {
    /// Of joint centres of a body, design units.
    pub min_joint_distance: f64,
    /// The least |det A|.
    pub min_abs_det: f64,
    /// By which the lengths in the Jacobian are divided.
    pub characteristic_length: f64,
    /// Of the offsets, edge lengths.
    pub bounds: [[Number; 2]; 6],
    /// Label of the length unit.
    pub units: String,
}

/// The poses the worst case is taken over.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseSetRecord {
    /// How many.
    pub count: usize,
    /// Where home comes from.
    pub home: SourceWord,
    /// Its position.
    pub home_position: [Number; 3],
    /// Where the workspace comes from.
    pub workspace: SourceWord,
}

/// What became of the branches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BranchCountsRecord {
    /// All of them.
    pub total: usize,
    /// Feasible ones.
    pub feasible: usize,
    /// Proved empty: nothing of a zone lies within the bounds.
    pub infeasible_bounds: usize,
    /// Proved empty: no room for the joints.
    pub infeasible_spacing: usize,
    /// Proved empty: |det A| is too small.
    pub infeasible_det: usize,
    /// Covered by the bound over all offsets, not searched.
    pub bounded: usize,
    /// Not decided.
    pub unproved: usize,
    /// The conic solver failed.
    pub solver_failure: usize,
}

impl From<&OffsetReport> for BranchCountsRecord {
    fn from(r: &OffsetReport) -> Self {
        let n = r.counts();
        Self {
            total: r.branches.len(),
            feasible: n.feasible,
            infeasible_bounds: n.outside_bounds,
            infeasible_spacing: n.spacing,
            infeasible_det: n.det,
            bounded: n.bounded,
            unproved: n.unproved,
            solver_failure: n.failed,
        }
    }
}

/// What no offsets can exceed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GlobalBoundRecord {
    /// No offsets within the limits reach more.
    pub upper: Number,
    /// By how much that is above the solution, relative.
    pub gap: Number,
    /// Boxes of offsets that were looked at.
    pub boxes: usize,
}

impl From<&GlobalBound> for GlobalBoundRecord {
    fn from(b: &GlobalBound) -> Self {
        Self { upper: Number(b.upper), gap: Number(b.gap), boxes: b.boxes }
    }
}

/// A branch: a zone for each offset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BranchRecord {
    /// Zone of each offset: before, inside, beyond its edge.
    #[schemars(extend("pattern" = ZONES))]
    pub branch: String,
    /// What became of it.
    pub verdict: BranchWord,
    /// Its own best, where it is dominated.
    pub objective: Option<Number>,
    /// Where that is reached.
    pub offsets: Option<[Number; 6]>,
    /// Parts of the branch searched.
    pub cells: usize,
    /// Proved conflicts of the branch or of parts of it.
    pub conflicts: Vec<BranchConflictRecord>,
}

/// What became of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BranchWord {
    /// It holds the best solution.
    Best,
    /// It is feasible, and does not reach the best value.
    Dominated,
    /// No feasible point was looked for: the bound over all offsets covers it.
    Bounded,
    /// It is proved empty.
    Infeasible,
    /// No feasible point was found.
    Unproved,
    /// No feasible point was found because the conic solver failed.
    SolverFailure,
}

impl From<&BranchReport> for BranchRecord {
    fn from(b: &BranchReport) -> Self {
        let (verdict, own) = match &b.verdict {
            BranchVerdict::Best => (BranchWord::Best, None),
            BranchVerdict::Dominated { value, offsets, .. } => {
                (BranchWord::Dominated, Some((*value, *offsets)))
            }
            BranchVerdict::Bounded => (BranchWord::Bounded, None),
            BranchVerdict::Infeasible => (BranchWord::Infeasible, None),
            BranchVerdict::Unproved => (BranchWord::Unproved, None),
            BranchVerdict::SolverFailure(_) => (BranchWord::SolverFailure, None),
        };
        Self {
            branch: b.branch.to_string(),
            verdict,
            objective: own.map(|o| Number(o.0)),
            offsets: own.map(|o| o.1.map(Number)),
            cells: b.cells,
            conflicts: b.conflicts.iter().map(BranchConflictRecord::from).collect(),
        }
    }
}

/// Why a branch or a part of it is empty.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BranchConflictRecord {
    /// A short stable code.
    #[schemars(extend("enum" = Conflict::CODES))]
    pub code: String,
    /// One sentence with the numbers.
    pub message: String,
}

impl From<&Conflict> for BranchConflictRecord {
    fn from(c: &Conflict) -> Self {
        Self { code: c.code().into(), message: c.to_string() }
    }
}
