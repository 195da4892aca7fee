//! Answers on how far joints may be off for the pose to stay within a bound.

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
    /// What `assess` says of the design; null: it requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// The greatest error allowed.
    pub bound: PoseErrorRecord,
    /// The tool point, platform frame.
    pub tool: [Number; 3],
    /// The unit of lengths.
    pub units: String,
    /// How far every joint may be off in any direction, to first order.
    pub all_joints_radius: LimitedAllowance,
    /// How far every coordinate may be off, to first order.
    pub all_coordinates: LimitedAllowance,
    /// The joints, the most critical first.
    pub joints: Vec<JointBudgetRecord>,
    /// Errors of the pose with the joints off in the worst way, solved.
    pub worst_errors: WorstErrorsRecord,
    /// What solving says about the radius.
    pub solved: SolvedBudgetRecord,
    /// Random errors in the budget.
    pub trials: TrialsRecord,
    /// Random errors of joints and leg offsets with the covariance of the calibration; null: not asked for.
    pub calibrated: Option<TrialsRecord>,
    /// How uncertain computed poses are by what the calibration does not know, to first order; null: not asked for.
    pub calibrated_poses: Option<CalibratedPosesRecord>,
    /// The greatest errors by joints, leg lengths and temperature together; null: not asked for.
    pub map: Option<ErrorMapRecord>,
    /// The poses looked at.
    pub poses: BudgetPosesRecord,
}

/// Standard deviations of poses computed from lengths with the calibrated machine; the noise of these lengths comes on
/// top.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CalibratedPosesRecord {
    /// Whether the design file has correlations.
    pub correlations: CorrelationsWord,
    /// Poses looked at.
    pub poses: usize,
    /// Root mean square of the distance by which the tool point is off, design units.
    pub position: DeviationRecord,
    /// Root mean square of the angle by which the orientation is off, degrees.
    pub rotation_deg: DeviationRecord,
}

/// A standard deviation over the poses looked at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DeviationRecord {
    /// Half of the poses have at most this.
    pub median: Number,
    /// The greatest.
    pub greatest: Number,
    /// What it would be at the same pose if every coordinate and offset were off for itself.
    pub independent: Number,
    /// The pose.
    pub pose: PoseQuaternionRecord,
    /// Covariance of the shift of the tool point (design units) and the rotation vector (degrees) at the pose, base
    /// frame.
    pub covariance: [[Number; 6]; 6],
}

/// What the calibration leaves open at a pose.
#[derive(Debug, Clone, Copy)]
pub struct PoseDeviations {
    /// The pose.
    pub pose: Pose,
    /// With the correlations of the design.
    pub kept: PoseCovariance,
    /// With the same standard deviations, each for itself.
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
    /// Of the poses looked at; `None` without one.
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

/// How far one joint may be off while the others are where they should be.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointBudgetRecord {
    /// Its body.
    pub body: Body,
    /// Its name.
    pub joint: String,
    /// In any direction.
    pub alone: LimitedAllowance,
    /// The worst direction, frame of the body.
    pub direction: [Number; 3],
    /// Error of the tool point for each unit of error in the worst direction.
    pub position_per_unit: Number,
    /// Error of the orientation for each unit of error in the worst direction.
    pub rotation_deg_per_unit: Number,
    /// Along x, y and z of the body; null: no influence.
    pub along_axes: [Option<Number>; 3],
    /// Half widths of the box of largest volume for all joints together; null: no influence.
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

/// Errors of the pose with all joints off in the worst way, solved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorstErrorsRecord {
    /// By the radius; null: the pose was lost.
    pub in_budget: Option<PoseErrorRecord>,
    /// By one and a half times the radius; null: the pose was lost.
    pub times_1_5: Option<PoseErrorRecord>,
    /// The pose.
    pub pose: PoseQuaternionRecord,
}

/// What solving says about the radius, which is of first order.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SolvedBudgetRecord {
    /// No error looked at in the budget goes beyond the bound when its pose is solved.
    pub within_bound: bool,
    /// The largest share of the bound that was used up; null: a pose was lost.
    pub largest_share: Option<Number>,
    /// The worst errors of this length at their pose keep the bound when they are solved.
    pub radius: Option<Number>,
}

/// Random errors in the budget.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TrialsRecord {
    /// How many.
    pub count: usize,
    /// Poses that were lost.
    pub lost: usize,
    /// Poses within the bound.
    pub within_bound: usize,
    /// Poses beyond it.
    pub beyond_bound: usize,
    /// Errors of the pose by the nominal formula.
    pub formula: ErrorSpread,
    /// By how much their first order is off.
    pub first_order_discrepancy: ErrorSpread,
    /// Errors after one Newton step with the joints as they are.
    pub after_one_step: ErrorSpread,
    /// Errors after two.
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

/// The poses looked at.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BudgetPosesRecord {
    /// How many.
    pub count: usize,
    /// Whether the workspace is that of the design.
    pub workspace: WorkspaceWord,
}

/// Where a workspace comes from.
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
    /// Every joint is off by at most this in any direction.
    pub joint_error: Number,
    /// Every leg is longer or shorter than it shows by at most this.
    pub length_error: Number,
    /// Growth of base, platform and legs, as shares; with either sign.
    pub growth: [Number; 3],
    /// Poses looked at: the corners and a sample of the region, and those that are listed.
    pub poses: usize,
    /// Of the tool point, design units.
    pub position: GreatestErrorRecord,
    /// Of the orientation, degrees.
    pub rotation_deg: GreatestErrorRecord,
    /// The table of all poses that was written; null: none.
    pub path: Option<String>,
}

/// The greatest error over the poses of a map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GreatestErrorRecord {
    /// By all causes.
    pub greatest: Number,
    /// By joints alone, at the same pose.
    pub joints: Number,
    /// By leg lengths alone.
    pub lengths: Number,
    /// By growth alone.
    pub growth: Number,
    /// The pose.
    pub pose: PoseQuaternionRecord,
    /// Half of the poses have at most this by all causes.
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
    /// Of the tool point, design units.
    pub position: Number,
    /// Of the orientation.
    pub rotation_deg: Number,
}

impl From<(f64, f64)> for PoseErrorRecord {
    fn from((position, rotation_deg): (f64, f64)) -> Self {
        Self { position: Number(position), rotation_deg: Number(rotation_deg) }
    }
}
