//! Answers about joints on grids of holes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tolerances::joint_name;
use super::{AssessAnswer, DesignRecord, Number, PoseErrorRecord};
use ask::Design;
use ask::rounding::RoundingWay;
use machine::manufacture::{
    ErrorSpread, Evaluation, ExactRounding, NearestRounding, NoRounding, NoRoundingWord, RoundedJoint,
};
use machine::requirements::{Grid, HoleCircle, HoleCircles, HolePattern};
use platform::manipulator::Body;
use verify::{VerdictWord, Verification, VerifyError};

/// The answer of `build round`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundAnswer {
    /// The name of the design.
    pub name: String,
    /// Unit of lengths.
    pub units: String,
    /// The grids asked for.
    pub grids: GridsRecord,
    /// Whether grid origins and angles are optimised.
    pub free_grid: bool,
    /// Figures of the given design.
    pub given: Evaluation,
    /// Best rounding equivalent to an octahedral platform.
    pub exact: ExactRoundingOutcome,
    /// Every joint on a hole near its position.
    pub nearest: NearestRoundingOutcome,
    /// Result of `assess`; null: there is none, or the design has no requirements.
    pub assessment: Option<AssessAnswer>,
    /// The rounding chosen; null: none meets the requirements.
    pub chosen: Option<RoundingWay>,
    /// The rounding with the least violation, measured by the greatest violation as a share of its limit; null: a
    /// rounding meets the requirements.
    pub least_missed: Option<RoundingWay>,
    /// The rounded design: the chosen one, or the one with the least violation.
    pub design: Option<DesignRecord>,
    /// The file written.
    pub output: Option<String>,
}

/// The grids of both bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GridsRecord {
    /// The grid of the base; null: the base joints stay in place.
    pub base: Option<GridRecord>,
    /// The grid of the platform; null: the platform joints stay in place.
    pub platform: Option<GridRecord>,
}

view! {
    /// A grid of holes in the plane of a body.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct GridRecord {
        /// Hole pattern.
        pub pattern: HolePattern = g.pattern,
        /// Distance of neighbouring holes, or of the rings of a polar grid, design units; null for bolt circles.
        pub pitch: Option<Number> = (g.pattern != HolePattern::BoltCircle).then_some(Number(g.pitch)),
        /// The circles of the grid: the first ring of a polar grid, or all bolt circles; empty for the other patterns.
        pub circles: Vec<HoleCircle> = g.circles.as_slice().to_vec(),
        /// Hole, or centre of the circles, body frame, design units.
        pub origin: [Number; 2] = g.origin.map(Number),
        /// The angle of the grid, degrees.
        pub angle_deg: Number = Number(g.angle_deg),
    }
    impl From(g: &Grid) {}
}

impl GridRecord {
    /// The grid in words.
    #[must_use]
    pub fn in_words(&self) -> String {
        Grid {
            pattern: self.pattern,
            pitch: self.pitch.map_or(0.0, |x| x.0),
            circles: HoleCircles::new(&self.circles).unwrap_or_default(),
            origin: self.origin.map(|x| x.0),
            angle_deg: self.angle_deg.0,
        }
        .to_string()
    }
}

impl From<&[Option<Grid>; 2]> for GridsRecord {
    fn from([base, platform]: &[Option<Grid>; 2]) -> Self {
        Self { base: base.as_ref().map(GridRecord::from), platform: platform.as_ref().map(GridRecord::from) }
    }
}

/// The exact rounding, or the reason why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ExactRoundingOutcome {
    /// A rounding was found.
    Found(Box<ExactRoundingRecord>),
    /// No rounding.
    None(NoRoundingRecord),
}

/// The nearest rounding, or the reason why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum NearestRoundingOutcome {
    /// A rounding was found.
    Found(Box<NearestRoundingRecord>),
    /// No rounding.
    None(NoRoundingRecord),
}

view! {
    /// The reason why there is no rounding.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct NoRoundingRecord {
        /// The obstacle.
        pub error: NoRoundingError = NoRoundingError { code: why.word(), message: why.to_string() },
    }
    impl From(why: NoRounding) {}
}

/// The obstacle to a rounding.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct NoRoundingError {
    /// A short code.
    pub code: NoRoundingWord,
    /// Message in words.
    pub message: String,
}

/// The verdict of a verification, if one was computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RoundingVerdict {
    /// No verification could be computed.
    NotComputed,
    /// The verdict.
    #[serde(untagged)]
    Computed(VerdictWord),
}

impl RoundingVerdict {
    /// The code of the verdict.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::NotComputed => "not_computed",
            Self::Computed(verdict) => verdict.name(),
        }
    }
}

impl From<&Result<Verification, VerifyError>> for RoundingVerdict {
    fn from(v: &Result<Verification, VerifyError>) -> Self {
        v.as_ref().map_or(Self::NotComputed, |v| Self::Computed(v.verdict.word()))
    }
}

view! {
    /// A rounding with all joints exactly on the sides of two triangles, with holes as their corners.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct ExactRoundingRecord {
        /// The grids used.
        pub grids: GridsRecord = (&e.grids).into(),
        /// Whether equivalence with its own octahedral platform is proved.
        pub proved: bool = e.proved,
        /// Verdict of leg map and forward kinematics.
        pub verdict: RoundingVerdict = (&e.verification).into(),
        /// Whether rotations by 120 degrees keep both bodies.
        pub three_fold: bool = e.three_fold,
        /// Offsets around the hexagon: [m, g] for t = m / g.
        pub fractions: Option<[[i64; 2]; 6]> = e.fractions.map(|f| f.map(|(k, n)| [k, n])),
        /// The joints.
        pub joints: Vec<RoundedJointRecord> = joints(design, &e.joints),
        /// Figures of the rounded design.
        pub evaluation: Evaluation = e.evaluation.clone(),
        /// Search statistics.
        pub search: RoundingSearchRecord = RoundingSearchRecord {
            triangles: e.pool,
            complete_to: e.complete_to.map(Number),
            replacements: e.replacements,
        },
    }
    fn of(design: &Design, e: &ExactRounding) {}
}

/// Statistics of the search for an exact rounding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundingSearchRecord {
    /// Triangles of base and platform combined.
    pub triangles: [usize; 2],
    /// Distances to which all triangles were combined, design units.
    pub complete_to: [Number; 2],
    /// Number of improvements by one triangle.
    pub replacements: usize,
}

view! {
    /// A rounding with all joints on holes near their given positions.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NearestRoundingRecord {
        /// The grids used.
        pub grids: GridsRecord = (&n.grids).into(),
        /// Verdict of leg map and forward kinematics.
        pub verdict: RoundingVerdict = (&n.verification).into(),
        /// Leg map residual; null: it could not be computed.
        pub map_residual: Option<Number> = n.verification.as_ref().ok().map(|v| Number(v.map.residual)),
        /// The joints.
        pub joints: Vec<RoundedJointRecord> = joints(design, &n.joints),
        /// Figures of the rounded design.
        pub evaluation: Evaluation = n.evaluation.clone(),
        /// Pose error when computing with the given design.
        pub pose_error: RoundingErrorRecord = RoundingErrorRecord {
            first_order: n.first_order.into(),
            first_order_nearest_points: n.first_order_nearest.into(),
            solved: n.solved.0,
            solved_poses: n.solved.1,
        },
        /// Number of joints on another than the nearest hole.
        pub not_nearest: usize = n.not_nearest,
        /// Whether rotations by 120 degrees keep both bodies.
        pub three_fold: bool = n.three_fold,
    }
    fn of(design: &Design, n: &NearestRounding) {}
}

/// The error of the pose if a rounded platform is controlled like the given one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundingErrorRecord {
    /// The error to first order.
    pub first_order: PoseErrorRecord,
    /// First-order error with all joints on nearest holes.
    pub first_order_nearest_points: PoseErrorRecord,
    /// Errors solved at random poses.
    pub solved: ErrorSpread,
    /// Number of random poses.
    pub solved_poses: usize,
}

view! {
    /// A joint on a hole.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct RoundedJointRecord {
        /// The body of the joint.
        pub body: Body = j.joint.body,
        /// The name of the joint.
        pub joint: String = joint_name(design, j.joint).to_owned(),
        /// Hole by its counts along the axes, or its circle and its number on the circle. Null: the joint stays in
        /// place.
        pub cell: Option<[i64; 2]> = j.cell,
        /// The displacement, body frame, design units.
        pub moved: [Number; 3] = [j.moved.x, j.moved.y, j.moved.z].map(Number),
        /// The size of the displacement, design units.
        pub distance: Number = Number(j.moved.norm()),
        /// Distance from its side, design units; null for corners.
        pub off_line: Option<Number> = j.off_line.map(Number),
    }
    fn of(design: &Design, j: &RoundedJoint) {}
}

fn joints(design: &Design, list: &[RoundedJoint]) -> Vec<RoundedJointRecord> {
    list.iter().map(|j| RoundedJointRecord::of(design, j)).collect()
}

impl ExactRoundingOutcome {
    /// The record of the search for an exact rounding of the joints of a design.
    #[must_use]
    pub fn new(design: &Design, found: &Result<ExactRounding, NoRounding>) -> Self {
        let e = match found {
            Ok(e) => e,
            Err(why) => return Self::None((*why).into()),
        };
        Self::Found(Box::new(ExactRoundingRecord::of(design, e)))
    }
}

impl NearestRoundingOutcome {
    /// The record of the nearest rounding of the joints of a design.
    #[must_use]
    pub fn new(design: &Design, found: &Result<NearestRounding, NoRounding>) -> Self {
        let n = match found {
            Ok(n) => n,
            Err(why) => return Self::None((*why).into()),
        };
        Self::Found(Box::new(NearestRoundingRecord::of(design, n)))
    }
}
