//! Answers of commands whose result is a text, a picture or a file, and that have little to say besides.

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
    /// Its notation.
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
    /// What is drawn.
    pub figure: FigureWord,
    /// The picture.
    #[serde(flatten)]
    pub picture: PictureRecord,
}

/// A picture.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum PictureRecord {
    /// Written.
    Written {
        /// The file written.
        output: String,
    },
    /// Given.
    Given {
        /// The picture.
        svg: String,
    },
}

/// What `plot` draws; the answer of `plot locus` is its own.
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
    /// A front of `optimize`.
    Pareto,
    /// A curve of poses with constant leg lengths.
    SelfMotion,
    /// Where det J vanishes over two freedoms.
    SingularPoses,
    /// Columns of the table of a sweep.
    Sweep,
    /// Ways to share joints.
    Topologies,
    /// Poses within all limits over two freedoms.
    Workspace,
}

/// The answer of `reference`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ReferenceAnswer {
    /// The page with the options of this program.
    pub page: String,
}

/// The answer of `report`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportAnswer {
    /// The page.
    pub output: String,
    /// How many files it shows.
    pub files: usize,
    /// What `assess` says of the design that the page shows; null: there is none, or it requires nothing.
    pub assessment: Option<AssessAnswer>,
}

/// The answer of `design schema`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SchemaAnswer {
    /// What the schema describes.
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
    /// Its size.
    pub bytes: usize,
    /// The page has the core in WebAssembly.
    pub live: bool,
    /// What `assess` says of the platform that the page shows first; null: it requires nothing.
    pub assessment: Option<AssessAnswer>,
}
