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
    /// The label of the length unit.
    pub units: String,
    /// The design file, or where it was written.
    #[serde(flatten)]
    pub file: PresetFile,
    /// The pose the platform is built for.
    pub home: PoseRecord,
    /// The leg lengths at home, design units.
    pub lengths: [f64; 6],
    /// Whether the leg lines are dependent at every pose, decided exactly for the joints as they are written.
    pub architecturally_singular: bool,
    /// What shows that the home pose is singular; null: it is regular.
    pub singular_home: Option<SingularEvidence>,
    /// What was guessed about the table, a sentence each.
    pub guesses: Vec<String>,
}
