//! Answers about the joint errors allowed for a given accuracy of the pose.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::uncertainty::{CorrelationsWord, in_degrees};
use super::{AssessAnswer, Number, PoseQuaternionRecord, SourceWord};
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

view! {
    /// Standard deviations of poses computed from lengths with the calibrated machine. The noise of the lengths adds to
    /// them.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CalibratedPosesRecord {
        /// Source of correlations.
        pub correlations: CorrelationsWord = CorrelationsWord::of(design),
        /// Number of poses evaluated.
        pub poses: usize = poses.len(),
        /// RMS error of the tool point, design units.
        pub position: DeviationRecord = DeviationRecord::new(poses, |c| c.position)?,
        /// RMS error of the orientation, degrees.
        pub rotation_deg: DeviationRecord = DeviationRecord::new(poses, |c| c.rotation.to_degrees())?,
    }
    /// The record over these poses; `None` for an empty list.
    pub fn new(design: &Design, poses: &[PoseDeviations]) -> Option<Self> {}
}

view! {
    /// A standard deviation over the poses evaluated.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct DeviationRecord {
        /// The median over the poses.
        pub median: Number = Number(all[(all.len() - 1) / 2]),
        /// The greatest value.
        pub greatest: Number = Number(of(&worst.kept)),
        /// Value with independent errors at the same pose.
        pub independent: Number = Number(of(&worst.independent)),
        /// The pose with the greatest value.
        pub pose: PoseQuaternionRecord = (&worst.pose).into(),
        /// Covariance of tool point (design units) and rotation vector (degrees) there, base frame.
        pub covariance: [[Number; 6]; 6] = in_degrees(&worst.kept),
    }
    fn new(poses: &[PoseDeviations], of: fn(&PoseCovariance) -> f64) -> Option<Self> {
        let worst = poses.iter().max_by(|a, b| of(&a.kept).total_cmp(&of(&b.kept)))?;
        let mut all: Vec<f64> = poses.iter().map(|p| of(&p.kept)).collect();
        all.sort_by(f64::total_cmp);
    }
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

view! {
    /// The error allowed at one joint while the others are exact.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct JointBudgetRecord {
        /// The body of the joint.
        pub body: Body = b.joint.body,
        /// The name of the joint.
        pub joint: String = joint_name(design, b.joint).to_owned(),
        /// Error allowed in any direction.
        pub alone: LimitedAllowance = b.alone,
        /// The worst direction of the error, body frame.
        pub direction: [Number; 3] = [b.direction.x, b.direction.y, b.direction.z].map(Number),
        /// Tool point error per joint error in that direction.
        pub position_per_unit: Number = Number(b.per_unit.0),
        /// Orientation error per joint error in that direction, degrees per design unit.
        pub rotation_deg_per_unit: Number = Number(b.per_unit.1),
        /// Errors allowed along the axes of the body, design units; null: no influence.
        pub along_axes: [Option<Number>; 3] = b.along.map(|x| x.map(Number)),
        /// Half widths of the box of largest volume for all joints, design units; null: no influence.
        pub largest_product: [Option<Number>; 3] = b.product_box.map(|x| x.map(Number)),
    }
    /// The record of a joint of the design.
    pub fn new(design: &Design, b: &JointBudget) {}
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

view! {
    /// Random errors in the budget.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct TrialsRecord {
        /// Number of random samples.
        pub count: usize = t.count,
        /// Number of lost poses.
        pub lost: usize = t.lost,
        /// Number of poses within the bound.
        pub within_bound: usize = t.within,
        /// Number of poses beyond the bound.
        pub beyond_bound: usize = t.count - t.lost - t.within,
        /// Pose errors of the nominal formula.
        pub formula: ErrorSpread = t.formula,
        /// Differences from their first-order values.
        pub first_order_discrepancy: ErrorSpread = t.discrepancy,
        /// Errors after one Newton step with actual joints.
        pub after_one_step: ErrorSpread = t.corrected[0],
        /// Errors after two Newton steps.
        pub after_two_steps: ErrorSpread = t.corrected[1],
    }
    impl From(t: &Trials) {}
}

/// The poses evaluated.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BudgetPosesRecord {
    /// Number of poses.
    pub count: usize,
    /// Source of the workspace.
    pub workspace: SourceWord,
}

view! {
    /// The greatest errors of the pose by all causes together, to first order.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct ErrorMapRecord {
        /// Greatest joint error, in any direction, design units.
        pub joint_error: Number = Number(errors.joints),
        /// Greatest error of a leg length, design units.
        pub length_error: Number = Number(errors.lengths),
        /// Relative expansion by part: base, platform and legs, with either sign.
        pub growth: [Number; 3] = errors.growth.map(Number),
        /// Number of poses evaluated: the corners and a sample of the region, and the listed poses.
        pub poses: usize = map.len(),
        /// Error of the tool point, design units.
        pub position: GreatestErrorRecord = GreatestErrorRecord::new(map, |e| &e.position)?,
        /// Error of the orientation, degrees.
        pub rotation_deg: GreatestErrorRecord = GreatestErrorRecord::new(map, |e| &e.rotation_deg)?,
        /// Table written; null: none.
        pub path: Option<String> = path,
    }
    /// The record of a map that was written to `path`; `None` for a map without poses.
    pub fn new(errors: &MachineErrors, map: &[ErrorAtPose], path: Option<String>) -> Option<Self> {}
}

view! {
    /// The greatest error over the poses of a map.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct GreatestErrorRecord {
        /// Greatest error by all causes.
        pub greatest: Number = Number(parts.total),
        /// Part by joints, at the same pose.
        pub joints: Number = Number(parts.joints),
        /// Part by lengths, at the same pose.
        pub lengths: Number = Number(parts.lengths),
        /// Part by expansion, at the same pose.
        pub growth: Number = Number(parts.growth),
        /// The pose with the greatest error.
        pub pose: PoseQuaternionRecord = (&worst.pose).into(),
        /// The median over the poses, by all causes together.
        pub median: Number = Number(all[(all.len() - 1) / 2]),
    }
    fn new(map: &[ErrorAtPose], of: fn(&ErrorAtPose) -> &ErrorParts) -> Option<Self> {
        let worst = map.iter().max_by(|a, b| of(a).total.total_cmp(&of(b).total))?;
        let mut all: Vec<f64> = map.iter().map(|e| of(e).total).collect();
        all.sort_by(f64::total_cmp);
        let parts = of(worst);
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
