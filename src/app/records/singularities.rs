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
    /// Unit of lengths.
    pub units: String,
    /// Whether the region is free of singular poses: the workspace of the design, or the region of `--box` about the
    /// pose; null: no region is given.
    pub regular: Option<RegularityRecord>,
    /// The given pose.
    pub pose: PoseFiguresRecord,
    /// The leg lengths, design units.
    pub lengths: [f64; 6],
    /// The real poses with these lengths.
    pub assembly_modes: Vec<PoseFiguresRecord>,
    /// Whether every path is accounted for; false: poses may be missing.
    pub assembly_modes_accounted: bool,
    /// Box of regular poses.
    #[serde(rename = "box")]
    pub regular_box: RegularBoxRecord,
    /// det J along a path, with `--path`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<SignPathRecord>,
    /// det J between all modes, with `--between`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub between: Option<SignPairsRecord>,
}

/// A pose with figures of its Jacobian.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct PoseFiguresRecord {
    /// The pose.
    #[serde(flatten)]
    pub pose: PoseQuaternionRecord,
    /// det J of the leg lines, divided by the size to the sixth power.
    pub determinant: Number,
    /// Inverse condition number of the Jacobian: 1 at best, 0 at a singular pose.
    pub inverse_condition: Number,
    /// Conditions for four planes through a point, for octahedral designs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub four_planes: Option<[Number; 2]>,
}

/// A box of regular poses around a pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct RegularBoxRecord {
    /// Half widths of positions at scale 1, design units, base frame.
    pub translation: [f64; 3],
    /// Half widths of the rotation vector at scale 1, base frame, degrees.
    pub rotation_deg: [f64; 3],
    /// Point of the platform about which it rotates, platform frame, design units.
    pub pivot: [f64; 3],
    /// Shape.
    pub region: Region,
    /// Scale proved free of singular poses.
    pub proved_scale: Number,
    /// Pose in the smallest box that holds a singular one; null: no such box is known.
    pub singular_within: Option<ScaledPoseRecord>,
    /// Greatest scale searched for a sign change.
    pub searched_scale: Number,
    /// Number of cells of the proof.
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

/// The proved sign of det J: 1 or -1; null: not proved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct SignRecord(#[schemars(extend("enum" = [1, -1, null]))] pub Option<i8>);

impl From<Option<Sign>> for SignRecord {
    fn from(sign: Option<Sign>) -> Self {
        Self(sign.map(Sign::value))
    }
}

/// The sign of det J along a straight path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SignOutcome {
    /// Proved: det J keeps its sign.
    KeepsSign,
    /// Proved: det J changes its sign.
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
    /// First assembly mode, from 1; 0: the given pose.
    pub from: usize,
    /// Last assembly mode, from 1.
    pub to: usize,
    /// Poses on the path.
    pub poses: Vec<PoseQuaternionRecord>,
    /// Whether det J keeps its sign: true and false are proved; null: neither.
    pub keeps_sign: Option<bool>,
    /// The straight parts in order.
    pub parts: Vec<SignPartRecord>,
}

/// det J along a straight part of a path, with parameter u from 0 to 1.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SignPartRecord {
    /// Sign of det J along the part.
    pub outcome: SignOutcome,
    /// Number of proved sign changes.
    pub changes: usize,
    /// Number of pieces without proof.
    pub doubtful: usize,
    /// The pieces with their signs.
    pub pieces: Vec<SignPieceRecord>,
    /// Samples [u, det J].
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
    /// First parameter u.
    pub from: Number,
    /// Last parameter u.
    pub to: Number,
    /// Sign of det J.
    pub sign: SignRecord,
    /// Whether it holds a singular pose: det J has proved, opposite signs before and after it.
    pub singular: bool,
}

impl SignPieceRecord {
    fn new(p: &PathPiece, singular: bool) -> Self {
        Self { from: Number(p.from), to: Number(p.to), sign: p.sign.into(), singular }
    }
}

/// The assembly modes joined by paths without singular pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SignPairsRecord {
    /// Sign of det J by assembly mode.
    pub signs: Vec<SignRecord>,
    /// All pairs of assembly modes.
    pub pairs: Vec<SignPairRecord>,
    /// Modes joined by such paths, numbers from 1.
    pub groups: Vec<Vec<usize>>,
    /// The paths found.
    pub paths: Vec<JoiningPathRecord>,
}

/// The straight path between two assembly modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SignPairRecord {
    /// Numbers of the two modes, from 1.
    pub modes: [usize; 2],
    /// Sign of det J along the straight path.
    pub straight: SignOutcome,
    /// Number of proved sign changes on the straight path.
    pub changes: usize,
    /// Whether some regular path joins them; null: none was found.
    pub joined: Option<bool>,
}

/// A path without singular pose between two assembly modes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JoiningPathRecord {
    /// Numbers of the two modes, from 1.
    pub modes: [usize; 2],
    /// Poses of the path, joined by straight segments.
    pub poses: Vec<PoseQuaternionRecord>,
}

impl From<&Way> for JoiningPathRecord {
    fn from(w: &Way) -> Self {
        Self {
            modes: [w.from + 1, w.to + 1],
            poses: w.poses.iter().map(PoseQuaternionRecord::from).collect(),
        }
    }
}
