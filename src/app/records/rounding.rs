//! Answers about joints on grids of holes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tolerances::joint_name;
use super::{AssessAnswer, DesignRecord, Number, PoseErrorRecord};
use ask::Design;
use ask::rounding::RoundingWay;
use machine::manufacture::{
    ErrorSpread, ExactRounding, Judgement, NearestRounding, NoRounding, NoRoundingWord, RoundedJoint,
};
use machine::requirements::{Grid, HoleCircle, HoleCircles, HolePattern};
use platform::manipulator::Body;
use verify::{VerdictWord, Verification, VerifyError};

/// The answer of `build round`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundAnswer {
    /// The name of the design.
    pub name: String,
    /// The unit of its lengths.
    pub units: String,
    /// The grids asked for.
    pub grids: GridsRecord,
    /// Origins and angles of the grids are chosen too.
    pub free_grid: bool,
    /// The design as it is wanted.
    pub wanted: Judgement,
    /// The best rounding that is exactly equivalent to an octahedral platform.
    pub exact: ExactRoundingOutcome,
    /// The rounding with every joint next to where it is wanted.
    pub nearest: NearestRoundingOutcome,
    /// What `assess` says of the rounded design; null: there is none, or the design requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// Which of them the rule takes; null: none meets the requirements.
    pub chosen: Option<RoundingWay>,
    /// Where none meets the requirements, the one that misses them least, by the greatest violation as a share of what
    /// is limited; null otherwise.
    pub least_missed: Option<RoundingWay>,
    /// The rounded design: the one chosen, or the one that misses the requirements least.
    pub design: Option<DesignRecord>,
    /// The file written.
    pub output: Option<String>,
}

/// The grids of both bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GridsRecord {
    /// Of the base; null: its joints stay where they are.
    pub base: Option<GridRecord>,
    /// Of the platform; null: its joints stay where they are.
    pub platform: Option<GridRecord>,
}

/// A grid of holes in the plane of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GridRecord {
    /// How the holes lie.
    pub pattern: HolePattern,
    /// Distance of neighbouring holes, or of the rings of a polar grid; null for bolt circles.
    pub pitch: Option<Number>,
    /// The first ring of a polar grid, or all bolt circles; empty for the other patterns.
    pub circles: Vec<HoleCircle>,
    /// A hole, or the centre of the circles.
    pub origin: [Number; 2],
    /// The turn of the grid.
    pub angle_deg: Number,
}

impl From<&Grid> for GridRecord {
    fn from(g: &Grid) -> Self {
        Self {
            pattern: g.pattern,
            pitch: (g.pattern != HolePattern::BoltCircle).then_some(Number(g.pitch)),
            circles: g.circles.as_slice().to_vec(),
            origin: g.origin.map(Number),
            angle_deg: Number(g.angle_deg),
        }
    }
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

/// The exact rounding, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ExactRoundingOutcome {
    /// There is one.
    Found(Box<ExactRoundingRecord>),
    /// There is none.
    None(NoRoundingRecord),
}

/// The nearest rounding, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum NearestRoundingOutcome {
    /// There is one.
    Found(Box<NearestRoundingRecord>),
    /// There is none.
    None(NoRoundingRecord),
}

/// Why there is no rounding.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct NoRoundingRecord {
    /// What stands against it.
    pub error: NoRoundingError,
}

/// What stands against a rounding.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct NoRoundingError {
    /// A short code.
    pub code: NoRoundingWord,
    /// One sentence.
    pub message: String,
}

impl From<NoRounding> for NoRoundingRecord {
    fn from(why: NoRounding) -> Self {
        Self { error: NoRoundingError { code: why.word(), message: why.to_string() } }
    }
}

/// The word for a verification that may not have been computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RoundingVerdict {
    /// It could not be computed.
    NotComputed,
    /// What it says.
    #[serde(untagged)]
    Computed(VerdictWord),
}

impl RoundingVerdict {
    /// The word.
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

/// All joints exactly on the sides of two triangles whose corners are holes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ExactRoundingRecord {
    /// The grids used.
    pub grids: GridsRecord,
    /// Equivalence with its own octahedral platform is proved in exact arithmetic.
    pub proved: bool,
    /// What leg map and forward kinematics say of it.
    pub verdict: RoundingVerdict,
    /// Turns by 120 degrees take both triangles with their joints to themselves.
    pub three_fold: bool,
    /// Round the hexagon: [m, g] for t = m / g.
    pub fractions: Option<[[i64; 2]; 6]>,
    /// The joints.
    pub joints: Vec<RoundedJointRecord>,
    /// How good it is.
    pub judgement: Judgement,
    /// How it was found.
    pub search: RoundingSearchRecord,
}

/// How an exact rounding was found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundingSearchRecord {
    /// Triangles of base and platform that were combined.
    pub triangles: [usize; 2],
    /// All triangles up to this distance were.
    pub complete_to: [Number; 2],
    /// Improvements by replacing one triangle.
    pub replacements: usize,
}

/// All joints on holes next to where they are wanted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearestRoundingRecord {
    /// The grids used.
    pub grids: GridsRecord,
    /// What leg map and forward kinematics say of it and the wanted design.
    pub verdict: RoundingVerdict,
    /// The residual of the leg map; null where it could not be computed.
    pub map_residual: Option<Number>,
    /// The joints.
    pub joints: Vec<RoundedJointRecord>,
    /// How good it is.
    pub judgement: Judgement,
    /// The error of the pose by the formula of the wanted design.
    pub pose_error: RoundingErrorRecord,
    /// Joints that are not on the nearest hole.
    pub not_nearest: usize,
    /// Turns by 120 degrees take the joints of both bodies to themselves.
    pub three_fold: bool,
}

/// The error of the pose when a rounded platform is controlled as the wanted one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundingErrorRecord {
    /// To first order.
    pub first_order: PoseErrorRecord,
    /// The same with every joint on the nearest hole.
    pub first_order_nearest_points: PoseErrorRecord,
    /// Solved at random poses.
    pub solved: ErrorSpread,
    /// How many.
    pub solved_poses: usize,
}

/// A joint on a hole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundedJointRecord {
    /// Its body.
    pub body: Body,
    /// Its name.
    pub joint: String,
    /// The hole: counted along the axes of the grid, or its circle and its number on it; null: the joint stays where it
    /// was.
    pub cell: Option<[i64; 2]>,
    /// How it moved, frame of the body.
    pub moved: [Number; 3],
    /// How far.
    pub distance: Number,
    /// Distance from the line of its side; null for corners.
    pub off_line: Option<Number>,
}

fn joints(design: &Design, list: &[RoundedJoint]) -> Vec<RoundedJointRecord> {
    let one = |j: &RoundedJoint| RoundedJointRecord {
        body: j.joint.body,
        joint: joint_name(design, j.joint).to_owned(),
        cell: j.cell,
        moved: [j.moved.x, j.moved.y, j.moved.z].map(Number),
        distance: Number(j.moved.norm()),
        off_line: j.off_line.map(Number),
    };
    list.iter().map(one).collect()
}

impl ExactRoundingOutcome {
    /// The record of a search on the joints of a design.
    #[must_use]
    pub fn new(design: &Design, found: &Result<ExactRounding, NoRounding>) -> Self {
        let e = match found {
            Ok(e) => e,
            Err(why) => return Self::None((*why).into()),
        };
        Self::Found(Box::new(ExactRoundingRecord {
            grids: (&e.grids).into(),
            proved: e.proved,
            verdict: (&e.verification).into(),
            three_fold: e.three_fold,
            fractions: e.fractions.map(|f| f.map(|(k, n)| [k, n])),
            joints: joints(design, &e.joints),
            judgement: e.judgement.clone(),
            search: RoundingSearchRecord {
                triangles: e.pool,
                complete_to: e.complete_to.map(Number),
                replacements: e.replacements,
            },
        }))
    }
}

impl NearestRoundingOutcome {
    /// The record of a search on the joints of a design.
    #[must_use]
    pub fn new(design: &Design, found: &Result<NearestRounding, NoRounding>) -> Self {
        let n = match found {
            Ok(n) => n,
            Err(why) => return Self::None((*why).into()),
        };
        Self::Found(Box::new(NearestRoundingRecord {
            grids: (&n.grids).into(),
            verdict: (&n.verification).into(),
            map_residual: n.verification.as_ref().ok().map(|v| Number(v.map.residual)),
            joints: joints(design, &n.joints),
            judgement: n.judgement.clone(),
            pose_error: RoundingErrorRecord {
                first_order: n.first_order.into(),
                first_order_nearest_points: n.first_order_nearest.into(),
                solved: n.solved.0,
                solved_poses: n.solved.1,
            },
            not_nearest: n.not_nearest,
            three_fold: n.three_fold,
        }))
    }
}
