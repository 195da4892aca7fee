//! Answers about the joint errors allowed for a given accuracy of the pose.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::uncertainty::{CorrelationsWord, in_degrees};
use super::{AssessAnswer, Number, PoseQuaternionRecord};
use ask::Design;
use machine::manufacture::{
    ErrorAtPose, ErrorParts, ErrorSpread, Joint, JointBudget, LimitedAllowance, MachineErrors,
    PoseCovariance, Trials,
};
use platform::geom::Pose;
use platform::manipulator::Body;

/// The answer of `build tolerances`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TolerancesAnswer {
    /// Result of `assess`; null: it has no requirements.
    pub assessment: Option<AssessAnswer>,
    /// Allowed pose error.
    pub bound: PoseErrorRecord,
    /// The tool point, platform frame.
    pub tool: [Number; 3],
    /// The unit of lengths.
    pub units: String,
    /// Error allowed at all joints together, in any direction, to first order.
    pub all_joints_radius: LimitedAllowance,
    /// Error allowed in all coordinates together, to first order.
    pub all_coordinates: LimitedAllowance,
    /// Joints, most critical first.
    pub joints: Vec<JointBudgetRecord>,
    /// Pose errors of the worst joint errors, solved exactly.
    pub worst_errors: WorstErrorsRecord,
    /// Exact check of the first-order radius.
    pub solved: SolvedBudgetRecord,
    /// Random errors in the budget.
    pub trials: TrialsRecord,
    /// Random errors with the calibration covariance; null: not requested.
    pub calibrated: Option<TrialsRecord>,
    /// Uncertainty of computed poses by calibration errors, to first order; null: not requested.
    pub calibrated_poses: Option<CalibratedPosesRecord>,
    /// Greatest errors from all causes (joints, leg lengths, temperature); null: not requested.
    pub map: Option<ErrorMapRecord>,
    /// The poses evaluated.
    pub poses: BudgetPosesRecord,
}

/// Standard deviations of poses computed from lengths with the calibrated machine. The noise of the lengths adds to
/// them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CalibratedPosesRecord {
    /// Source of correlations.
    pub correlations: CorrelationsWord,
    /// Number of poses evaluated.
    pub poses: usize,
    /// RMS error of the tool point, design units.
    pub position: DeviationRecord,
    /// RMS error of the orientation, degrees.
    pub rotation_deg: DeviationRecord,
}

/// A standard deviation over the poses evaluated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DeviationRecord {
    /// The median over the poses.
    pub median: Number,
    /// The greatest value.
    pub greatest: Number,
    /// Value with independent errors at the same pose.
    pub independent: Number,
    /// The pose with the greatest value.
    pub pose: PoseQuaternionRecord,
    /// Covariance of tool point (design units) and rotation vector (degrees) there, base frame.
    pub covariance: [[Number; 6]; 6],
}

/// The covariance of a pose due to the errors of the calibration.
#[derive(Debug, Clone, Copy)]
pub struct PoseDeviations {
    /// The pose.
    pub pose: Pose,
    /// The covariance with the correlations of the design.
    pub kept: PoseCovariance,
    /// The covariance with the same standard deviations and independent errors.
    pub independent: PoseCovariance,
}

impl DeviationRecord {
    fn new(poses: &[PoseDeviations], of: fn(&PoseCovariance) -> f64) -> Option<Self> {
        let worst = poses.iter().max_by(|a, b| of(&a.kept).total_cmp(&of(&b.kept)))?;
        let mut all: Vec<f64> = poses.iter().map(|p| of(&p.kept)).collect();
        all.sort_by(f64::total_cmp);
        Some(Self {
            median: Number(all[(all.len() - 1) / 2]),
            greatest: Number(of(&worst.kept)),
            independent: Number(of(&worst.independent)),
            pose: (&worst.pose).into(),
            covariance: in_degrees(&worst.kept),
        })
    }
}

impl CalibratedPosesRecord {
    /// The record over these poses; `None` for an empty list.
    #[must_use]
    pub fn new(design: &Design, poses: &[PoseDeviations]) -> Option<Self> {
        Some(Self {
            correlations: CorrelationsWord::of(design),
            poses: poses.len(),
            position: DeviationRecord::new(poses, |c| c.position)?,
            rotation_deg: DeviationRecord::new(poses, |c| c.rotation.to_degrees())?,
        })
    }
}

/// The error allowed at one joint while the others are exact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointBudgetRecord {
    /// The body of the joint.
    pub body: Body,
    /// The name of the joint.
    pub joint: String,
    /// Error allowed in any direction.
    pub alone: LimitedAllowance,
    /// The worst direction of the error, body frame.
    pub direction: [Number; 3],
    /// Tool point error per joint error in that direction.
    pub position_per_unit: Number,
    /// Orientation error per joint error in that direction, degrees per design unit.
    pub rotation_deg_per_unit: Number,
    /// Errors allowed along the axes of the body, design units; null: no influence.
    pub along_axes: [Option<Number>; 3],
    /// Half widths of the box of largest volume for all joints, design units; null: no influence.
    pub largest_product: [Option<Number>; 3],
}

impl JointBudgetRecord {
    /// The record of a joint of the design.
    #[must_use]
    pub fn new(design: &Design, b: &JointBudget) -> Self {
        Self {
            body: b.joint.body,
            joint: joint_name(design, b.joint).to_owned(),
            alone: b.alone,
            direction: [b.direction.x, b.direction.y, b.direction.z].map(Number),
            position_per_unit: Number(b.per_unit.0),
            rotation_deg_per_unit: Number(b.per_unit.1),
            along_axes: b.along.map(|x| x.map(Number)),
            largest_product: b.product_box.map(|x| x.map(Number)),
        }
    }
}

/// The name of a joint in the design.
pub(super) fn joint_name(design: &Design, joint: Joint) -> &str {
    &joint.body.of((design.base_names(), design.platform_names()))[joint.index]
}

/// Errors of the pose for the worst errors of all joints, solved exactly.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorstErrorsRecord {
    /// Pose errors at this radius; null: the pose was lost.
    pub in_budget: Option<PoseErrorRecord>,
    /// Pose errors at 1.5 times the radius; null: the pose was lost.
    pub times_1_5: Option<PoseErrorRecord>,
    /// Pose at which the errors were solved.
    pub pose: PoseQuaternionRecord,
}

/// Exact check of the first-order radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SolvedBudgetRecord {
    /// Whether all solved errors stay within the bound.
    pub within_bound: bool,
    /// Largest share of the bound reached; null: a pose was lost.
    pub largest_share: Option<Number>,
    /// Joint error that keeps the bound, solved exactly at their pose.
    pub radius: Option<Number>,
}

/// Random errors in the budget.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TrialsRecord {
    /// Number of random samples.
    pub count: usize,
    /// Number of lost poses.
    pub lost: usize,
    /// Number of poses within the bound.
    pub within_bound: usize,
    /// Number of poses beyond the bound.
    pub beyond_bound: usize,
    /// Pose errors of the nominal formula.
    pub formula: ErrorSpread,
    /// Differences from their first-order values.
    pub first_order_discrepancy: ErrorSpread,
    /// Errors after one Newton step with actual joints.
    pub after_one_step: ErrorSpread,
    /// Errors after two Newton steps.
    pub after_two_steps: ErrorSpread,
}

impl From<&Trials> for TrialsRecord {
    fn from(t: &Trials) -> Self {
        Self {
            count: t.count,
            lost: t.lost,
            within_bound: t.within,
            beyond_bound: t.count - t.lost - t.within,
            formula: t.formula,
            first_order_discrepancy: t.discrepancy,
            after_one_step: t.corrected[0],
            after_two_steps: t.corrected[1],
        }
    }
}

/// The poses evaluated.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BudgetPosesRecord {
    /// Number of poses.
    pub count: usize,
    /// Source of the workspace.
    pub workspace: WorkspaceWord,
}

/// The source of a workspace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WorkspaceWord {
    /// The design.
    Design,
    /// A box about home, because the design has none.
    Default,
}

/// The greatest errors of the pose by all causes together, to first order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ErrorMapRecord {
    /// Greatest joint error, in any direction, design units.
    pub joint_error: Number,
    /// Greatest error of a leg length, design units.
    pub length_error: Number,
    /// Relative expansion by part: base, platform and legs, with either sign.
    pub growth: [Number; 3],
    /// Number of poses evaluated: the corners and a sample of the region, and the listed poses.
    pub poses: usize,
    /// Error of the tool point, design units.
    pub position: GreatestErrorRecord,
    /// Error of the orientation, degrees.
    pub rotation_deg: GreatestErrorRecord,
    /// Table written; null: none.
    pub path: Option<String>,
}

/// The greatest error over the poses of a map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GreatestErrorRecord {
    /// Greatest error by all causes.
    pub greatest: Number,
    /// Part by joints, at the same pose.
    pub joints: Number,
    /// Part by lengths, at the same pose.
    pub lengths: Number,
    /// Part by expansion, at the same pose.
    pub growth: Number,
    /// The pose with the greatest error.
    pub pose: PoseQuaternionRecord,
    /// The median over the poses, by all causes together.
    pub median: Number,
}

impl GreatestErrorRecord {
    fn new(map: &[ErrorAtPose], of: fn(&ErrorAtPose) -> &ErrorParts) -> Option<Self> {
        let worst = map.iter().max_by(|a, b| of(a).total.total_cmp(&of(b).total))?;
        let mut all: Vec<f64> = map.iter().map(|e| of(e).total).collect();
        all.sort_by(f64::total_cmp);
        let parts = of(worst);
        Some(Self {
            greatest: Number(parts.total),
            joints: Number(parts.joints),
            lengths: Number(parts.lengths),
            growth: Number(parts.growth),
            pose: (&worst.pose).into(),
            median: Number(all[(all.len() - 1) / 2]),
        })
    }
}

impl ErrorMapRecord {
    /// The record of a map that was written to `path`; `None` for a map without poses.
    #[must_use]
    pub fn new(errors: &MachineErrors, map: &[ErrorAtPose], path: Option<String>) -> Option<Self> {
        Some(Self {
            joint_error: Number(errors.joints),
            length_error: Number(errors.lengths),
            growth: errors.growth.map(Number),
            poses: map.len(),
            position: GreatestErrorRecord::new(map, |e| &e.position)?,
            rotation_deg: GreatestErrorRecord::new(map, |e| &e.rotation_deg)?,
            path,
        })
    }
}

/// The error of a pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseErrorRecord {
    /// Error of the tool point, design units.
    pub position: Number,
    /// Error of the orientation, degrees.
    pub rotation_deg: Number,
}

impl From<(f64, f64)> for PoseErrorRecord {
    fn from((position, rotation_deg): (f64, f64)) -> Self {
        Self { position: Number(position), rotation_deg: Number(rotation_deg) }
    }
}
