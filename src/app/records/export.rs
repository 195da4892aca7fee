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
    /// Result of `assess`; null: it has no requirements.
    pub assessment: Option<AssessAnswer>,
    /// Length of one design unit.
    pub design_unit: LengthUnit,
    /// Formats.
    pub formats: Vec<FormatRecord>,
    /// Dimensions chosen; empty: no format with parts of the machine was written.
    pub sizes: Vec<SizeChoice>,
    /// Assumptions of the simulator model about masses and units; empty: no model was written.
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
        let is_written = |format: ExportFormat| formats.iter().any(|f| f.format == format.name());
        let has_parts = ExportFormat::ALL.into_iter().any(|format| format.has_parts() && is_written(format));
        Self {
            name: export.name.clone(),
            output,
            assessment,
            design_unit: export.unit,
            formats,
            sizes: if has_parts { export.choices.clone() } else { Vec::new() },
            assumptions,
        }
    }
}

/// The files of a format.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FormatRecord {
    /// Format.
    #[schemars(extend("enum" = ExportFormat::ALL.map(ExportFormat::name)))]
    pub format: String,
    /// Purpose.
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
        /// Parts of the design omitted.
        leaves_out: String,
    },
    /// The format was refused.
    Refused {
        /// Part that the format cannot hold.
        refused: String,
    },
}
