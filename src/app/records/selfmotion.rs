//! Answers about the curves of poses with constant leg lengths.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseQuaternionRecord};
use ask::MotionOrigin;
use fk::CompletenessWord;
use synthesis::singularity::{
    CriticalPoses, CurveCrossing, CurveDegree, MotionCurve, MotionEvidence, MotionPoint, PoseVerdict,
};

/// The answer of `singular motion`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SelfmotionAnswer {
    /// The name of the design.
    pub name: String,
    /// Unit of lengths.
    pub units: String,
    /// Dimension of the set of poses, at the given pose if there is one; null: undecided.
    pub dimension: Option<usize>,
    /// The evidence for the dimension.
    pub evidence: MotionEvidenceWord,
    /// Number of first-order freedoms: six minus the rank of the leg lines; null with `--lengths`.
    pub tangent_dimension: Option<usize>,
    /// The ball around the pose that holds no pose of these lengths but near its centre; null: no such ball is proved.
    pub isolated: Option<IsolatedRecord>,
    /// The start pose; null with `--lengths`.
    pub start: Option<PoseQuaternionRecord>,
    /// The leg lengths, design units.
    pub lengths: [Number; 6],
    /// Singular values of the leg equations, largest first.
    pub singular_values: [Number; 8],
    /// Number of further start poses.
    pub further_starts: usize,
    /// Real poses on sets of higher dimension, with `--lengths`; these sets are not traced.
    pub real_poses: Vec<PoseQuaternionRecord>,
    /// The completeness of the curves. Proved: with these lengths there are none. Other lists are traced numerically,
    /// without a proof.
    pub completeness: CompletenessWord,
    /// Whether every real component is accounted for, numerically; null: no search for other components was made.
    pub components_accounted: Option<bool>,
    /// Degrees of the complex irreducible components; null: not computed.
    pub complex_components: Option<Vec<CurveDegree>>,
    /// Critical points of a distance, at least one on each real component; null: not computed.
    pub critical_points: Option<CriticalPointsRecord>,
    /// Largest error of a leg length over the size.
    pub worst_length_error: Number,
    /// Crossings of curves.
    pub crossings: Vec<PoseQuaternionRecord>,
    /// The curves.
    pub curves: Vec<MotionCurveRecord>,
}

/// The evidence for the dimension of a self-motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionEvidenceWord {
    /// Proved: the leg lines are independent at the pose.
    FirstOrder,
    /// Proved: no freedom of first order satisfies the equations of second order. Without a `dimension`, a motion
    /// within `isolated.within` is not excluded.
    SecondOrder,
    /// Proved: the rank of the leg lines is constant around the pose.
    ConstantRank,
    /// Proved: all joints of one body are on a line, and the platform turns about it. The dimension is sampled.
    CommonLine,
    /// Tracing found poses along a stretch, and the dimension is sampled: no proof.
    Traced,
    /// Random sections cut the set of poses with these lengths: no proof of a motion.
    Sections,
    /// No evidence: the question is undecided.
    Undecided,
}

impl From<PoseVerdict> for MotionEvidenceWord {
    fn from(verdict: PoseVerdict) -> Self {
        match verdict {
            PoseVerdict::Isolated { order: 1, .. } => Self::FirstOrder,
            PoseVerdict::Isolated { .. } | PoseVerdict::Confined { .. } => Self::SecondOrder,
            PoseVerdict::Moves { evidence: MotionEvidence::ConstantRank, .. } => Self::ConstantRank,
            PoseVerdict::Moves { evidence: MotionEvidence::CommonLine, .. } => Self::CommonLine,
            PoseVerdict::Moves { evidence: MotionEvidence::Traced, .. } => Self::Traced,
            PoseVerdict::Undecided => Self::Undecided,
        }
    }
}

/// The neighbourhood of a pose without others of its lengths, in displacements `(t / size, c)`: translation divided by
/// the size, and axis times tangent of half the angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IsolatedRecord {
    /// Radius of the ball: every pose with these lengths inside it lies within the distance `within`.
    pub radius: Number,
    /// The distance left by rounding; 0 for a first-order proof.
    pub within: Number,
}

impl IsolatedRecord {
    /// The record of the ball.
    #[must_use]
    pub fn of(verdict: PoseVerdict) -> Option<Self> {
        match verdict {
            PoseVerdict::Isolated { radius, within, .. } | PoseVerdict::Confined { radius, within } => {
                Some(Self { radius: Number(radius), within: Number(within) })
            }
            PoseVerdict::Moves { .. } | PoseVerdict::Undecided => None,
        }
    }
}

view! {
    /// The outcomes of the paths to critical points.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct CriticalPointsRecord {
        /// Number of paths followed.
        pub paths: usize = c.paths,
        /// Number of real critical points found.
        pub real: usize = c.poses.len(),
        /// Number of regular path ends.
        pub regular: usize = c.regular,
        /// Number of singular path ends.
        pub singular: usize = c.singular,
        /// Number of path ends that are no pose.
        pub no_pose: usize = c.no_pose,
        /// Number of lost paths.
        pub lost: usize = c.lost,
        /// Number of starts left unused.
        pub unused_starts: usize = c.unused,
    }
    impl From(c: &CriticalPoses) {}
}

view! {
    /// A curve of poses.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MotionCurveRecord {
        /// End of the curve: closed, joined, unfinished or stuck.
        #[schemars(extend("enum" = ["closed", "joined", "unfinished", "stuck"]))]
        pub end: String = curve.end.name().to_owned(),
        /// The crossings with other curves.
        pub crossings: Vec<CurveCrossing> = curve.crossings.clone(),
        /// The degree of the curve; null: not computed.
        pub degree: Option<CurveDegree> = degree.copied(),
        /// Origin of its first pose.
        pub found_by: Option<MotionOrigin> = found_by,
        /// Poses of the curve.
        pub points: Vec<MotionPoint> = curve.points.clone(),
    }
    /// The record of a curve.
    pub fn new(curve: &MotionCurve, degree: Option<&CurveDegree>, found_by: Option<MotionOrigin>) {}
}
