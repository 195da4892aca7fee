//! Answers of commands that write a text, a picture or a file.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};

use super::AssessAnswer;
use files::design::Format;

/// The answer of `shell completions`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct CompletionsAnswer {
    /// The shell.
    pub shell: String,
    /// The script for it.
    pub script: String,
}

/// The answer of `design convert`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ConvertAnswer {
    /// The name of the design.
    pub name: String,
    /// The file written.
    pub output: String,
    /// The notation of the file.
    pub format: Format,
}

/// The answer of `shell man`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ManAnswer {
    /// The files written.
    pub paths: Vec<String>,
}

/// The answer of `plot`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct PlotAnswer {
    /// The kind of picture.
    pub figure: FigureWord,
    /// The picture.
    #[serde(flatten)]
    pub picture: PictureRecord,
}

/// A picture.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum PictureRecord {
    /// Picture in a file.
    Written {
        /// The file written.
        output: String,
    },
    /// Picture in the answer.
    Given {
        /// The picture as SVG.
        svg: String,
    },
}

/// The kinds of pictures of `plot`; `plot locus` has its own answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FigureWord {
    /// Assembly modes.
    Modes,
    /// The curves of replaceable joints in two planes.
    Components,
    /// det A over two offsets.
    Det,
    /// Two designs at the same pose.
    Pair,
    /// A Pareto front of `optimize`.
    Pareto,
    /// A curve of poses with constant leg lengths.
    SelfMotion,
    /// The singular poses over two freedoms: zeros of det J.
    SingularPoses,
    /// Columns of a sweep's table.
    Sweep,
    /// Ways to share joints.
    Topologies,
    /// Poses within all limits over two freedoms.
    Workspace,
}

/// The answer of `report`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportAnswer {
    /// The page.
    pub output: String,
    /// Number of files shown.
    pub files: usize,
    /// Result of `assess`; null: there is none, or it has no requirements.
    pub assessment: Option<AssessAnswer>,
}

/// The answer of `design schema`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SchemaAnswer {
    /// The subject of the schema.
    pub of: String,
    /// A JSON Schema, draft 2020-12.
    pub schema: Map<String, Value>,
}

/// The answer of `view`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ViewAnswer {
    /// The name of the design.
    pub name: String,
    /// The page.
    pub output: String,
    /// Page size, bytes.
    pub bytes: usize,
    /// Whether the page contains the WebAssembly core.
    pub live: bool,
    /// Result of `assess`; null: it has no requirements.
    pub assessment: Option<AssessAnswer>,
}
