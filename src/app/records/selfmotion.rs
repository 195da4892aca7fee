//! Answers about the curves of poses with constant leg lengths.

use schemars::JsonSchema;
use serde::Serialize;

use super::{Number, PoseQuaternionRecord};
use ask::MotionOrigin;
use fk::CompletenessWord;
use synthesis::singularity::{
    CriticalPoses, CurveCrossing, CurveDegree, MotionCurve, MotionEvidence, MotionPoint, PoseVerdict,
};

/// The answer of `singular motion`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SelfmotionAnswer {
    /// The name of the design.
    pub name: String,
    /// The unit of its lengths.
    pub units: String,
    /// Dimension of the set of poses with these lengths, at the pose where one is given; null where it is undecided.
    pub dimension: Option<usize>,
    /// What shows the dimension.
    pub evidence: MotionEvidenceWord,
    /// Freedoms of first order at the pose: six less the rank of the leg lines; null with `--lengths`.
    pub tangent_dimension: Option<usize>,
    /// The ball around an isolated pose without any other pose of these lengths; null elsewhere.
    pub isolated: Option<IsolatedRecord>,
    /// The pose it begins at; null with `--lengths`.
    pub start: Option<PoseQuaternionRecord>,
    /// The leg lengths, design units.
    pub lengths: [Number; 6],
    /// Singular values of the leg equations, largest first.
    pub singular_values: [Number; 8],
    /// Starting poses beside the one given.
    pub further_starts: usize,
    /// With `--lengths`: real poses on surfaces and sets of higher dimension, which are not followed.
    pub real_poses: Vec<PoseQuaternionRecord>,
    /// Curves are followed numerically: nothing proves that they are all.
    pub completeness: CompletenessWord,
    /// Every real component is accounted for, numerically; null: no search for other components was made.
    pub components_accounted: Option<bool>,
    /// Irreducible components over the complex numbers.
    pub complex_components: Option<Vec<CurveDegree>>,
    /// Critical points of a distance on the curves, one at least on each real component.
    pub critical_points: Option<CriticalPointsRecord>,
    /// The largest error of a leg length over the size.
    pub worst_length_error: Number,
    /// Poses at which curves cross.
    pub crossings: Vec<PoseQuaternionRecord>,
    /// The curves.
    pub curves: Vec<MotionCurveRecord>,
}

/// What shows the dimension of a self-motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionEvidenceWord {
    /// Proved: the leg lines are independent at the pose.
    FirstOrder,
    /// Proved: no freedom of first order satisfies the equations of second order.
    SecondOrder,
    /// Proved: the rank of the leg lines is constant around the pose.
    ConstantRank,
    /// Poses were found along a stretch by tracing, and the dimension is sampled: no proof.
    Traced,
    /// The poses with the lengths were cut by random sections: no proof.
    Sections,
    /// Nothing: the question is undecided.
    Undecided,
}

impl From<PoseVerdict> for MotionEvidenceWord {
    fn from(verdict: PoseVerdict) -> Self {
        match verdict {
            PoseVerdict::Isolated { order: 1, .. } => Self::FirstOrder,
            PoseVerdict::Isolated { .. } => Self::SecondOrder,
            PoseVerdict::Moves { evidence: MotionEvidence::ConstantRank, .. } => Self::ConstantRank,
            PoseVerdict::Moves { evidence: MotionEvidence::Traced, .. } => Self::Traced,
            PoseVerdict::Undecided => Self::Undecided,
        }
    }
}

/// The surroundings of an isolated pose, in displacements `(t / size, c)`: translation over the size, axis times
/// tangent of half the angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct IsolatedRecord {
    /// Every pose with these lengths within this distance lies within `within`.
    pub radius: Number,
    /// Distance left by rounding; 0 for a proof of first order.
    pub within: Number,
}

impl IsolatedRecord {
    /// The record of an isolated pose.
    #[must_use]
    pub fn of(verdict: PoseVerdict) -> Option<Self> {
        match verdict {
            PoseVerdict::Isolated { radius, within, .. } => {
                Some(Self { radius: Number(radius), within: Number(within) })
            }
            PoseVerdict::Moves { .. } | PoseVerdict::Undecided => None,
        }
    }
}

/// What became of the paths to critical points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct CriticalPointsRecord {
    /// Paths followed.
    pub paths: usize,
    /// Real ones found.
    pub real: usize,
    /// Regular ends.
    pub regular: usize,
    /// Singular ends.
    pub singular: usize,
    /// Ends that are no pose.
    pub no_pose: usize,
    /// Paths that were lost.
    pub lost: usize,
    /// Starts that were not used.
    pub unused_starts: usize,
}

impl From<&CriticalPoses> for CriticalPointsRecord {
    fn from(c: &CriticalPoses) -> Self {
        Self {
            paths: c.paths,
            real: c.poses.len(),
            regular: c.regular,
            singular: c.singular,
            no_pose: c.no_pose,
            lost: c.lost,
            unused_starts: c.unused,
        }
    }
}

/// A curve of poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MotionCurveRecord {
    /// How it ends: closed, joined, unfinished or stuck.
    #[schemars(extend("enum" = ["closed", "joined", "unfinished", "stuck"]))]
    pub end: String,
    /// Where it crosses others.
    pub crossings: Vec<CurveCrossing>,
    /// Its degree, where that was computed.
    pub degree: Option<CurveDegree>,
    /// How its first pose was found.
    pub found_by: Option<MotionOrigin>,
    /// Its poses.
    pub points: Vec<MotionPoint>,
}

impl MotionCurveRecord {
    /// The record of a curve.
    #[must_use]
    pub fn new(curve: &MotionCurve, degree: Option<&CurveDegree>, found_by: Option<MotionOrigin>) -> Self {
        Self {
            end: curve.end.name().to_owned(),
            crossings: curve.crossings.clone(),
            degree: degree.copied(),
            found_by,
            points: curve.points.clone(),
        }
    }
}
