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
    /// The output folder.
    pub output: String,
    /// The result of `assess` for the design; null: it has no requirements.
    pub assessment: Option<AssessAnswer>,
    /// The length of one unit of the design.
    pub design_unit: LengthUnit,
    /// The formats, each written or refused.
    pub formats: Vec<FormatRecord>,
    /// The dimensions chosen for the model.
    pub sizes: Vec<SizeChoice>,
    /// Assumptions of the simulator's model about masses and units that the file leaves open; empty: no model was
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
    /// The name of the format.
    #[schemars(extend("enum" = ExportFormat::ALL.map(ExportFormat::name)))]
    pub format: String,
    /// The purpose of the format.
    pub purpose: String,
    /// The files written.
    pub files: Vec<String>,
    /// Whether the format can hold the design.
    #[serde(flatten)]
    pub outcome: FormatOutcome,
}

/// The outcome for a format.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FormatOutcome {
    /// The format was written.
    Written {
        /// The parts of the design that the format omits.
        leaves_out: String,
    },
    /// The format was refused.
    Refused {
        /// The reason: a part of the design that the format cannot hold.
        refused: String,
    },
}
