//! Answers of `export`.

use schemars::JsonSchema;
use serde::Serialize;

use super::AssessAnswer;
use files::export::{Export, ExportFormat, LengthUnit, SizeChoice};

view! {
    /// The answer of `export`.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct ExportAnswer {
        /// The name of the design.
        pub name: String = export.name.clone(),
        /// The output folder.
        pub output: String = output,
        /// Result of `assess`; null: it has no requirements.
        pub assessment: Option<AssessAnswer> = assessment,
        /// Length of one design unit.
        pub design_unit: LengthUnit = export.unit,
        /// Formats.
        pub formats: Vec<FormatRecord> = formats,
        /// Dimensions chosen; empty: no format with parts of the machine was written.
        pub sizes: Vec<SizeChoice> = if has_parts { export.choices.clone() } else { Vec::new() },
        /// Assumptions of the simulator model about masses and units; empty: no model was written.
        pub assumptions: Vec<String> = assumptions,
    }
    /// The answer of a model whose files stand in a folder.
    pub fn new(
        export: &Export,
        assessment: Option<AssessAnswer>,
        output: String,
        formats: Vec<FormatRecord>,
        assumptions: Vec<String>,
    ) {
        let is_written = |format: ExportFormat| formats.iter().any(|f| f.format == format.name());
        let has_parts = ExportFormat::ALL.into_iter().any(|format| format.has_parts() && is_written(format));
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
