//! Every answer of the program as plain data: what `--json` prints, what the page and other programs read, and what the schemas describe.
//!
//! An answer of a command is a type whose name ends in `Answer`; its parts end in `Record`. They are made `From` the values of the library, hold no
//! logic, and are read back by `serde`. The same value is printed as text by the command, as JSON by [`Document`], and described by [`schema`]:
//! no field is written in two places.
//!
//! Numbers that may be infinite or not a number are [`Number`]s and `null` in JSON; a truth that may be undecided is an `Option<bool>` and `null` where it is.
//! Units stand in the names of fields (`angle_deg`) where they are not those of the design; legs are counted from 1.

mod check;
mod explore;
mod failure;
mod family;
mod fk;
mod locus;
mod map;
mod near;
mod number;
mod pose;
mod rearrangement;
mod schema;
mod selfmotion;
mod topologies;
mod verify;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::check::{
    AssemblyRecord, CaseRecord, CheckAnswer, Checked, ConditioningRecord, CornerLengthsRecord,
    DependencyRecord, GriffisDuffyRecord, NearestSingularRecord, ProofWord, WitnessRecord,
};
pub use self::explore::{FkRunRecord, RunRecord};
pub use self::failure::{ErrorAnswer, FailureRecord, HelpAnswer, ViolationRecord, WarningRecord};
pub use self::family::{
    CountsRecord, FamilyAnswer, FamilyTopologyRecord, InstanceRecord, PatternLegRecord, PatternPlace,
    PatternRecord, SharedJointRecord,
};
pub use self::fk::{
    CertificateRecord, ClosurePolynomialRecord, ClosureRecord, CompletenessWord, ComplexPoseRecord,
    DiscsRecord, EnclosureRecord, EvidenceWord, FkAnswer, FkOneAnswer, FkRowOutcome, FkRowRecord,
    FkRowsAnswer, PathRecord, PoseCountRecord, RejectedRecord, RowFailure, SingularFactorRecord,
    SolutionRecord, SolutionSetRecord, SolvedRecord, TrilaterationStepRecord,
};
pub use self::locus::{LocusAnswer, LocusMeetingRecord, LocusRowRecord, LocusValueRecord, LocusWord};
pub use self::map::{
    AlignmentOutcome, AlignmentRecord, AlignmentWord, CorrespondenceRecord, DifferenceRecord, FramesRecord,
    MapAnswer, MapRecord, MapTolerancesRecord, MotionRecord, NearestMotionRecord, OtherAlignmentRecord,
};
pub use self::near::{NearRecord, NearWord};
pub use self::number::{ComplexRecord, Number};
pub use self::pose::{NamedPoints, PoseQuaternionRecord, PoseRecord, leg_number};
pub use self::rearrangement::{
    ArgumentWord, ExactDesignRecord, FamilyKind, FamilyRecord, ObstructionRecord, RearrangementRecord,
};
pub use self::schema::{schema, schema_names};
pub use self::selfmotion::{
    CriticalPointsRecord, CurveCrossingRecord, CurveDegreeRecord, MotionCurveRecord, MotionPointRecord,
    OriginWord, SelfmotionAnswer,
};
pub use self::topologies::{
    RecognisedRecord, TopologiesAnswer, TopologyFindings, TopologyRecord, VirtualLegsRecord,
};
pub use self::verify::{
    BeyondPrecisionRecord, CounterexampleRecord, SampleRecord, SamplingRecord, SolvedSampleRecord,
    VerdictWord, VerifyAnswer,
};

/// The version of the dialect: a later version of the program may add fields to every object, and words to lists of words, under the same one.
pub const SCHEMA_VERSION: u32 = 1;

/// One JSON document: an answer between what all answers have.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Document<T> {
    /// Always 1: the version of these definitions.
    #[schemars(extend("const" = SCHEMA_VERSION))]
    pub schema_version: u32,
    /// The fields of the answer.
    #[serde(flatten)]
    pub answer: T,
    /// What was odd about the design files that were read.
    pub warnings: Vec<WarningRecord>,
}

impl<T> Document<T> {
    /// The document of an answer.
    pub fn new(answer: T, warnings: Vec<WarningRecord>) -> Self {
        Self { schema_version: SCHEMA_VERSION, answer, warnings }
    }
}
