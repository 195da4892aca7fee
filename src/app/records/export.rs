//! Answers of `export`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AssessAnswer, Number};
use files::export::{Export, ExportFormat, SizeChoice};

/// The answer of `export`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ExportAnswer {
    /// The name of the design.
    pub name: String,
    /// The folder.
    pub output: String,
    /// What `assess` says of the design; null: it requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// What one unit of the design is.
    pub design_unit: LengthUnitRecord,
    /// What became of each format.
    pub formats: Vec<FormatRecord>,
    /// The sizes that were chosen.
    pub sizes: Vec<SizeRecord>,
    /// Assumptions of the simulator's model about masses and units that the file leaves open; empty where no model was written.
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
            design_unit: LengthUnitRecord { label: export.unit.label.into(), mm: export.unit.millimetres },
            formats,
            sizes: export.choices.iter().map(SizeRecord::from).collect(),
            assumptions,
        }
    }
}

/// A length unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LengthUnitRecord {
    /// Its label.
    pub label: String,
    /// Millimetres.
    pub mm: f64,
}

/// The files of a format.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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

/// A size and where it comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SizeRecord {
    /// What it is the size of.
    pub what: String,
    /// Its value in `unit`.
    pub value: Number,
    /// Design units, or kilograms.
    pub unit: String,
    /// Option, table or rule.
    pub from: String,
}

impl From<&SizeChoice> for SizeRecord {
    fn from(c: &SizeChoice) -> Self {
        Self { what: c.what.clone(), value: Number(c.value), unit: c.unit.into(), from: c.from.into() }
    }
}
