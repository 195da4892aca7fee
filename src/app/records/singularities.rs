//! Answers about singular poses: the sign of det J at poses, along paths and in a box.

use schemars::JsonSchema;
use serde::Serialize;

use super::{Number, PoseQuaternionRecord, RegularityRecord};
use platform::geom::Region;
use synthesis::singularity::{PathPiece, Sign, SignsAlong, Way};

/// The answer of `singular poses`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SingularitiesAnswer {
    /// The name of the design.
    pub name: String,
    /// The unit of its lengths.
    pub units: String,
    /// Whether the workspace of the design, or the region of `--box`, about the pose is free of singular poses; null
    /// where neither is given.
    pub regular: Option<RegularityRecord>,
    /// The pose asked about.
    pub pose: JudgedPoseRecord,
    /// The leg lengths, design units.
    pub lengths: [f64; 6],
    /// The real poses with these lengths.
    pub assembly_modes: Vec<JudgedPoseRecord>,
    /// False: some may be missing.
    pub assembly_modes_accounted: bool,
    /// A box of poses about the pose that holds no singular one.
    #[serde(rename = "box")]
    pub regular_box: RegularBoxRecord,
    /// det J along a path, with `--path`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<SignPathRecord>,
    /// det J between all assembly modes, with `--between`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub between: Option<SignPairsRecord>,
}

/// A pose with figures of its Jacobian.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct JudgedPoseRecord {
    /// The pose.
    #[serde(flatten)]
    pub pose: PoseQuaternionRecord,
    /// det J of the leg lines, over the size to the sixth.
    pub determinant: Number,
    /// 1 at best, 0 at a singular pose.
    pub inverse_condition: Number,
    /// The two conditions of four planes in one point, of octahedral designs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub four_planes: Option<[Number; 2]>,
}

/// A box of poses about a pose that holds no singular one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct RegularBoxRecord {
    /// Half widths of positions at scale 1, design units, base frame.
    pub translation: [f64; 3],
    /// Half widths of the rotation vector at scale 1, base frame.
    pub rotation_deg: [f64; 3],
    /// Its shape.
    pub region: Region,
    /// No singular pose up to this scale, proved.
    pub proved_scale: Number,
    /// A pose of the smallest box known to hold a singular one.
    pub singular_within: Option<ScaledPoseRecord>,
    /// Up to this scale a change of sign was looked for.
    pub searched_scale: Number,
    /// Cells the proof took.
    pub cells: usize,
}

/// A pose and the scale of the smallest box that holds it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ScaledPoseRecord {
    /// The pose.
    #[serde(flatten)]
    pub pose: PoseQuaternionRecord,
    /// The scale.
    pub scale: Number,
}

/// A proved sign of det J: 1 or -1; null: not proved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct SignRecord(#[schemars(extend("enum" = [1, -1, null]))] pub Option<i8>);

impl From<Option<Sign>> for SignRecord {
    fn from(sign: Option<Sign>) -> Self {
        Self(sign.map(Sign::value))
    }
}

/// What det J does along a straight path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SignOutcome {
    /// It keeps its sign, proved.
    KeepsSign,
    /// It changes its sign, proved.
    Crosses,
    /// Neither is proved.
    Undecided,
}

impl From<&SignsAlong> for SignOutcome {
    fn from(s: &SignsAlong) -> Self {
        if s.kept().is_some() {
            Self::KeepsSign
        } else if s.changes().next().is_some() {
            Self::Crosses
        } else {
            Self::Undecided
        }
    }
}

/// det J along a path of straight parts.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SignPathRecord {
    /// Number of the assembly mode it begins at, from 1; 0: the pose.
    pub from: usize,
    /// Number of the assembly mode it ends at.
    pub to: usize,
    /// Its poses.
    pub poses: Vec<PoseQuaternionRecord>,
    /// Whether det J keeps its sign: true and false are proved.
    pub keeps_sign: Option<bool>,
    /// One for each straight part.
    pub parts: Vec<SignPartRecord>,
}

/// det J along a straight part of a path, with parameter u from 0 to 1.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SignPartRecord {
    /// What it does.
    pub outcome: SignOutcome,
    /// Proved changes of sign.
    pub changes: usize,
    /// Pieces where neither a sign nor a change is proved.
    pub doubtful: usize,
    /// Pieces with their signs.
    pub pieces: Vec<SignPieceRecord>,
    /// [u, det J].
    pub values: Vec<[Number; 2]>,
}

impl SignPartRecord {
    /// The record of a part with values of det J on it.
    #[must_use]
    pub fn new(s: &SignsAlong, values: Vec<[Number; 2]>) -> Self {
        Self {
            outcome: s.into(),
            changes: s.changes().count(),
            doubtful: s.doubtful().count(),
            pieces: s.pieces.iter().map(|p| SignPieceRecord::new(p, s.changes().any(|c| c == *p))).collect(),
            values,
        }
    }
}

/// A piece of a straight path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct SignPieceRecord {
    /// Where it begins.
    pub from: Number,
    /// Where it ends.
    pub to: Number,
    /// The sign of det J on it.
    pub sign: SignRecord,
    /// It holds a singular pose: det J has proved signs before and after it, and they differ.
    pub singular: bool,
}

impl SignPieceRecord {
    fn new(p: &PathPiece, singular: bool) -> Self {
        Self { from: Number(p.from), to: Number(p.to), sign: p.sign.into(), singular }
    }
}

/// Which assembly modes paths without singular pose join.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SignPairsRecord {
    /// The sign of det J at each assembly mode.
    pub signs: Vec<SignRecord>,
    /// All pairs.
    pub pairs: Vec<SignPairRecord>,
    /// Groups of modes that such paths join, from 1.
    pub groups: Vec<Vec<usize>>,
    /// The paths found.
    pub ways: Vec<WayRecord>,
}

/// The straight path between two assembly modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SignPairRecord {
    /// Their numbers, from 1.
    pub modes: [usize; 2],
    /// What det J does on the straight path.
    pub straight: SignOutcome,
    /// Proved changes of sign on it.
    pub changes: usize,
    /// Whether some path without singular pose joins them; null: none was found.
    pub joined: Option<bool>,
}

/// A path without singular pose between two assembly modes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WayRecord {
    /// Their numbers, from 1.
    pub modes: [usize; 2],
    /// Its poses, joined by straight paths.
    pub poses: Vec<PoseQuaternionRecord>,
}

impl From<&Way> for WayRecord {
    fn from(w: &Way) -> Self {
        Self {
            modes: [w.from + 1, w.to + 1],
            poses: w.poses.iter().map(PoseQuaternionRecord::from).collect(),
        }
    }
}
