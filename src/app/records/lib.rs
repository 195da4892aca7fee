//! Every answer of the program as plain data: the content of `--json`, read by the page and other programs, and
//! described by the schemas.
//!
//! The type name of a command's answer ends in `Answer`. Its parts are library values that write themselves (feature
//! `serde` of their packages), or records. A record is a view that names joints, counts legs from 1, or joins several
//! values. Commands print the same value as text, and as JSON by [`Document`]. It is described by [`schema()`], so each
//! field is defined once. The script `.ci/generate` makes the tables of the documents and the records of Python from
//! the schemas. The only `Deserialize` types are those that the program reads from its own folders.
//!
//! Numbers that may be infinite or not a number are `null` in JSON: [`Number`]s, or doubles under [`num::nullable`]. A
//! truth value that may be undecided is an `Option<bool>`, `null` for undecided. Names of fields carry their unit
//! (`angle_deg`) if it differs from the units of the design. Legs are counted from 1.

#[macro_use]
mod view;

mod at_pose;
#[cfg(feature = "lab")]
mod bench;
mod calibrate;
mod check;
mod compare;
mod components;
mod coupled;
mod derivation;
mod design;
mod drives;
mod explore;
mod export;
mod failure;
mod family;
mod fk;
mod ik;
mod limits;
mod locus;
mod map;
mod motion;
mod moves;
mod near;
mod nearest;
mod new_design;
mod number;
mod optimize;
mod pentapod;
mod polynomial;
mod pose;
mod presets;
mod proof;
mod provenance;
mod rearrangement;
mod requirement;
mod rotary;
mod rounding;
mod schema;
mod selfmotion;
mod singularities;
mod sweep;
mod tolerances;
mod topologies;
mod uncertainty;
mod verify;
mod written;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::at_pose::*;
#[cfg(feature = "lab")]
pub use self::bench::*;
pub use self::calibrate::*;
pub use self::check::*;
pub use self::compare::*;
pub use self::components::*;
pub use self::coupled::*;
pub use self::derivation::*;
pub use self::design::*;
pub use self::drives::*;
pub use self::explore::*;
pub use self::export::*;
pub use self::failure::*;
pub use self::family::*;
pub use self::fk::*;
pub use self::ik::*;
pub use self::limits::*;
pub use self::locus::*;
pub use self::map::*;
pub use self::motion::*;
pub use self::moves::*;
pub use self::near::*;
pub use self::nearest::*;
pub use self::new_design::*;
pub use self::number::*;
pub use self::optimize::*;
pub use self::pentapod::*;
pub use self::polynomial::*;
pub use self::pose::*;
pub use self::presets::*;
pub use self::proof::ProofFile;
pub use self::provenance::*;
pub use self::rearrangement::*;
pub use self::requirement::*;
pub use self::rotary::*;
pub use self::rounding::*;
pub use self::schema::*;
pub use self::selfmotion::*;
pub use self::singularities::*;
pub use self::sweep::*;
pub use self::tolerances::*;
pub use self::topologies::*;
pub use self::uncertainty::{CorrelationsWord, PoseUncertaintyRecord};
pub use self::verify::*;
pub use self::written::*;
pub use num::Number;

/// The version of the answer format. Later versions of the program may add fields to objects and words to lists of
/// words under the same version.
pub const SCHEMA_VERSION: u32 = 1;

/// One JSON document: an answer with the fields that all answers have.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Document<T> {
    /// The version of the answer format, always 1.
    #[schemars(extend("const" = SCHEMA_VERSION))]
    pub schema_version: u32,
    /// The fields of the answer.
    #[serde(flatten)]
    pub answer: T,
    /// The program, seed and files behind the answer.
    pub provenance: ProvenanceRecord,
    /// Warnings about the design files read.
    pub warnings: Vec<WarningRecord>,
}

impl<T> Document<T> {
    /// The document of an answer.
    pub fn new(answer: T, provenance: ProvenanceRecord, warnings: Vec<WarningRecord>) -> Self {
        Self { schema_version: SCHEMA_VERSION, answer, provenance, warnings }
    }
}
