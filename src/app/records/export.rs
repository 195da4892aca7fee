//! Answers of `export`.

use schemars::JsonSchema;
use serde::Serialize;

use super::AssessAnswer;
use files::export::{Export, ExportFormat, LengthUnit, SizeChoice};

/// The answer of `export`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ExportAnswer {
    /// The name of the design.
    pub name: String,
    /// The folder.
    pub output: String,
    /// What `assess` says of the design; null: it requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// What one unit of the design is.
    pub design_unit: LengthUnit,
    /// What became of each format.
    pub formats: Vec<FormatRecord>,
    /// The sizes that were chosen.
    pub sizes: Vec<SizeChoice>,
    /// Assumptions of the simulator's model about masses and units that the file leaves open; empty where no model was
    /// written.
    pub assumptions: Vec<String>,
}

impl ExportAnswer {
    /// The answer of a model whose files stand in a folder.
    #[must_use]
    pub fn new(
        export: &Export,
        assessment: Option<AssessAnswer>,
        output: String,
        formats: Vec<FormatRecord>,
        assumptions: Vec<String>,
    ) -> Self {
        Self {
            name: export.name.clone(),
            output,
            assessment,
            design_unit: export.unit,
            formats,
            sizes: export.choices.clone(),
            assumptions,
        }
    }
}

/// The files of a format.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FormatRecord {
    /// Its name.
    #[schemars(extend("enum" = ExportFormat::ALL.map(ExportFormat::name)))]
    pub format: String,
    /// What it is for.
    pub purpose: String,
    /// The files written.
    pub files: Vec<String>,
    /// Whether it could hold the design.
    #[serde(flatten)]
    pub outcome: FormatOutcome,
}

/// What became of a format.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FormatOutcome {
    /// It was written.
    Written {
        /// What of the design it does not carry.
        leaves_out: String,
    },
    /// It was not.
    Refused {
        /// Why it cannot hold the design.
        refused: String,
    },
}
