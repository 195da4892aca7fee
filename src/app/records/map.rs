//! Answers about the affine map between the squared leg lengths of two designs, and the frames in which they are
//! compared.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseRecord, leg_number};
use platform::manipulator::Level;
use synthesis::alignment::{Alignment, AlignmentUndecided, AlignmentWord, Difference, Motion, NearestMotion};
use synthesis::{AffineLegMap, LegCorrespondence, LegMapOutcome, Relation};

/// The answer of `equivalents map`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MapAnswer {
    /// The map.
    #[serde(flatten)]
    pub map: MapRecord,
    /// Correspondence of the legs.
    pub correspondence: CorrespondenceRecord,
    /// Lengths carried from FROM to TO, with `--lengths`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lengths: Option<MappedLengthsRecord>,
    /// The changes of frames of the second design.
    #[serde(flatten)]
    pub frames: FramesRecord,
}

/// Lengths of the legs of both designs at the same poses, as the legs show them, design units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MappedLengthsRecord {
    /// Given lengths.
    pub from: [Number; 6],
    /// The lengths of TO; null: there are none.
    pub to: Option<[Number; 6]>,
    /// Reason for none: no regular map, or a squared length that is not positive.
    pub reason: Option<String>,
}

view! {
    /// The affine map s(TO) = A s(FROM) + c between the squared leg lengths of two designs.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MapRecord {
        /// The relation of the two designs; null: undecided, exit 3.
        pub relation: Option<Relation> = o.relation.decided(),
        /// The level of the proof; within rounding: nothing is proved.
        pub level: Level = o.level,
        /// Whether the relation holds up to rounding; true for an exact relation too.
        pub holds_within_rounding: bool = o.holds_within_rounding,
        /// Relation in words, with the numbers that decided.
        pub explanation: String = o.explanation(),
        /// Rows of A: s(TO) = A s(FROM) + c of squared leg lengths.
        #[serde(rename = "A")]
        pub matrix: [[Number; 6]; 6] = matrix(&o.closest),
        /// The constant terms, design units squared.
        #[serde(rename = "c")]
        pub constants: [Number; 6] = c.map(Number),
        /// The determinant of A.
        #[serde(rename = "det")]
        pub determinant: Number = Number(o.determinant),
        /// Exact determinant, such as 64/243. Null: the identity of leg vectors is not proved in exact arithmetic, or
        /// the number is too long to read.
        pub det_exact: Option<String> = exact.map(|numbers| numbers.determinant.clone()),
        /// Rows of A, exact; null if `det_exact` is null.
        #[serde(rename = "A_exact")]
        pub matrix_exact: Option<[[String; 6]; 6]> = exact.map(|numbers| numbers.a.clone()),
        /// Constant terms, exact, design units squared; null if `det_exact` is null.
        #[serde(rename = "c_exact")]
        pub constants_exact: Option<[String; 6]> = exact.map(|numbers| numbers.c.clone()),
        /// Zeros of det A for single legs, exact. Such a leg has its ends on edges of FROM at the offset t. Its row of
        /// A has the entries 1 - t and t, the others zero. The list has the t for which det A vanishes while other legs
        /// stay fixed. An entry is null for other legs, or if no t exists. The list is null if `det_exact` is null.
        pub singular_offsets: Option<[Option<String>; 6]> =
            exact.map(|numbers| numbers.singular_offsets.clone()),
        /// det A as an exact polynomial in the offsets t1 to t6, the other legs fixed. TO is singular exactly at its
        /// zeros. Null: no leg is of this kind, or `det_exact` is null.
        pub det_of_offsets: Option<String> = exact.and_then(|numbers| numbers.determinant_of_offsets.clone()),
        /// Largest residual.
        pub residual: Number = Number(o.residual),
        /// Relative distance of each leg of TO from the span of FROM.
        pub residuals: [Number; 6] = o.residuals.map(Number),
        /// Rank of the leg vectors of FROM.
        pub leg_rank: usize = o.leg_rank,
        /// Singular values of the normalised leg vectors of FROM.
        pub singular_values: [Number; 6] = o.singular_values.map(Number),
        /// Smallest over largest singular value of A.
        pub inverse_condition: Number = Number(o.inverse_condition),
        /// Decision thresholds.
        pub tolerances: MapTolerancesRecord = MapTolerancesRecord {
            residual: o.tolerances.residual,
            rank: o.tolerances.rank,
            inverse_condition: o.singular_limit,
        },
    }
    impl From(o: &LegMapOutcome) {
        let (c, exact): ([f64; 6], _) = (o.closest.c.into(), o.exact_numbers.as_ref());
    }
}

/// The thresholds of the decision about a map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MapTolerancesRecord {
    /// Greatest `residual` of a valid map.
    pub residual: f64,
    /// Singular value threshold, relative to the largest.
    pub rank: f64,
    /// Least `inverse_condition` of a regular map.
    pub inverse_condition: f64,
}

/// Rows of A.
pub(super) fn matrix(map: &AffineLegMap) -> [[Number; 6]; 6] {
    let rows = [0, 1, 2, 3, 4, 5];
    rows.map(|i| rows.map(|j| Number(map.a[(i, j)])))
}

view! {
    /// The leg of FROM that corresponds to each leg of TO.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CorrespondenceRecord {
        /// Leg of FROM for each leg of TO, from 1; null: none.
        pub legs: [Option<usize>; 6] = c.legs.map(|leg| leg.map(leg_number)),
        /// Distances of the two legs over the size.
        pub distances: [Number; 6] = c.distances.map(Number),
        /// Whether every leg of FROM is one of TO.
        pub permutation: bool = c.is_permutation(),
        /// Whether all distances are zero.
        pub exact: bool = c.is_exact(),
    }
    impl From(c: &LegCorrespondence) {}
}

/// The effect of `--exchange`, `--align` and `--output` on the second design.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct FramesRecord {
    /// Whether base and platform of the second design were exchanged.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub exchanged: bool,
    /// Rigid motions that make the second design equivalent, with `--align`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alignment: Option<AlignmentRecord>,
    /// The file written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
}

view! {
    /// The rigid motions that make one design equivalent to another.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct AlignmentRecord {
        /// Result in words, with the numbers that decided.
        pub explanation: String = found.explanation(),
        /// The result of the search for motions.
        #[serde(flatten)]
        pub outcome: AlignmentOutcome = found.into(),
        /// With base and platform of the second design exchanged.
        pub exchanged: OtherAlignmentRecord = exchanged.into(),
        /// With the mirror image of the second design.
        pub mirrored: OtherAlignmentRecord = mirrored.into(),
    }
    /// The record of an alignment, and of the alignments with the exchanged and the mirrored second design.
    pub fn new(found: &Alignment, exchanged: &Alignment, mirrored: &Alignment) {}
}

/// The result of a search for rigid motions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "status", rename_all = "snake_case")]
pub enum AlignmentOutcome {
    /// Motions exist.
    Found {
        /// Smallest first.
        motions: Vec<MotionRecord>,
        /// Whether `motions` is complete.
        all: bool,
        /// Dimension of the families of motions.
        freedom: usize,
    },
    /// No motion.
    None {
        /// Difference of the designs, which proves it.
        difference: Difference,
        /// Nearest motion.
        nearest: Option<NearestMotion>,
    },
    /// The search is undecided.
    Undecided {
        /// The reason.
        reason: AlignmentUndecided,
        /// Nearest motion.
        nearest: Option<NearestMotion>,
    },
}

impl From<&Alignment> for AlignmentOutcome {
    fn from(a: &Alignment) -> Self {
        match a {
            Alignment::Found { motions, all, freedom } => Self::Found {
                motions: motions.iter().map(MotionRecord::from).collect(),
                all: *all,
                freedom: *freedom,
            },
            Alignment::None { difference, nearest } => {
                Self::None { difference: *difference, nearest: *nearest }
            }
            Alignment::Undecided { reason, nearest } => {
                Self::Undecided { reason: *reason, nearest: *nearest }
            }
        }
    }
}

view! {
    /// A pair of rigid motions of the second design.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MotionRecord {
        /// The motion of its base.
        pub base: PoseRecord = (&m.base).into(),
        /// The motion of its platform.
        pub platform: PoseRecord = (&m.platform).into(),
        /// Residual of the leg map.
        pub residual: Number = Number(m.map.residual),
        /// Determinant of this map.
        pub det: Number = Number(m.map.determinant),
        /// Relation to the first design; null: undecided.
        pub relation: Option<Relation> = m.map.relation.decided(),
    }
    impl From(m: &Motion) {}
}

/// The result for the exchanged or mirrored second design.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct OtherAlignmentRecord {
    /// Whether motions exist.
    pub status: AlignmentWord,
    /// Number of motions.
    pub motions: usize,
}

impl From<&Alignment> for OtherAlignmentRecord {
    fn from(a: &Alignment) -> Self {
        Self { status: a.word(), motions: a.motions().len() }
    }
}
