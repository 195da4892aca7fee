//! Warnings, refusals and failures.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A warning about a design file that can still be used.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct WarningRecord {
    /// A stable short code.
    pub code: String,
    /// The design file.
    pub path: String,
    /// Line, from 1.
    pub line: usize,
    /// The problem.
    pub message: String,
    /// The remedy.
    pub help: String,
}

/// The reason why there is no answer: a refusal of the request, or a failure of the program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ErrorAnswer {
    /// The failure.
    pub error: FailureRecord,
}

/// A refusal or a failure.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FailureRecord {
    /// A stable short code, `fk::not_applicable` for example.
    pub code: String,
    /// Message in words.
    pub message: String,
    /// The remedy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
    /// The design file concerned.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// Faults; empty for other failures.
    pub violations: Vec<ViolationRecord>,
}

/// One fault of a design file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ViolationRecord {
    /// A stable short code.
    pub code: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// The fault.
    pub message: String,
    /// The correction to write.
    pub help: String,
}

/// The text printed by `--help`, `--version` and `--licences`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct HelpAnswer {
    /// The text.
    pub help: String,
}
