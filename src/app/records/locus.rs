//! Answers on the squared length of a virtual leg at all poses while one leg length varies.

use schemars::JsonSchema;
use serde::Serialize;

use super::Number;
use files::plot::LocusMeeting;
use fk::Method;

/// The answer of `plot locus`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LocusAnswer {
    /// The leg that varies, from 1.
    pub leg: u8,
    /// Base joint and platform joint of the virtual leg.
    pub between: [String; 2],
    /// One for each length.
    pub rows: Vec<LocusRowRecord>,
    /// Where two real values meet, about.
    pub meetings: Vec<LocusMeeting>,
}

/// What was found at one length.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LocusRowRecord {
    /// Its number, from 0.
    pub step: usize,
    /// The length of the leg that varies.
    pub length: Number,
    /// What the poses form; `failed` where they could not be computed.
    pub status: LocusWord,
    /// False: poses may be missing.
    pub all_paths_accounted: bool,
    /// The method that found them.
    pub method: Option<Method>,
    /// One for each pose.
    pub values: Vec<LocusValueRecord>,
}

/// What the poses at one length form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LocusWord {
    /// Isolated poses.
    Isolated,
    /// No pose.
    Empty,
    /// Curves or surfaces.
    PositiveDimensional,
    /// They could not be computed.
    Failed,
}

impl LocusWord {
    /// The word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Isolated => "isolated",
            Self::Empty => "empty",
            Self::PositiveDimensional => "positive_dimensional",
            Self::Failed => "failed",
        }
    }
}

/// The squared length of the virtual leg at one pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LocusValueRecord {
    /// Its real part.
    pub re: Number,
    /// Its imaginary part.
    pub im: Number,
    /// Whether the pose is real; null: undecided.
    pub real: Option<bool>,
    /// Whether the pose has a certificate.
    pub certified: bool,
    /// Paths, or roots of a polynomial, that end at the pose.
    pub multiplicity: u32,
}
