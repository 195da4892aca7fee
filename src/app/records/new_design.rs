//! The answer of `new`.

use schemars::JsonSchema;
use serde::Serialize;

use super::{PoseRecord, PresetFile};
use synthesis::singularity::SingularEvidence;

/// The answer of `new`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NewAnswer {
    /// The name of the design.
    pub name: String,
    /// Unit of lengths.
    pub units: String,
    /// The design file, or its path if it was written.
    #[serde(flatten)]
    pub file: PresetFile,
    /// The home pose of the platform.
    pub home: PoseRecord,
    /// The leg lengths at home, or the rod lengths of a design with cranks, design units.
    pub lengths: [f64; 6],
    /// The crank angles at home, degrees; null: legs of variable length.
    pub crank_angles_deg: Option<[f64; 6]>,
    /// Whether every pose is singular, decided exactly for the joints as written.
    pub architecturally_singular: bool,
    /// Evidence that home is singular; null: it is regular.
    pub singular_home: Option<SingularEvidence>,
    /// Guesses about the table, one sentence each.
    pub guesses: Vec<String>,
}
