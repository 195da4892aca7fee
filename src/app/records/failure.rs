//! Warnings, refusals and failures.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something odd about a design file that does not keep it from being used.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct WarningRecord {
    /// A stable short code.
    pub code: String,
    /// The design file.
    pub path: String,
    /// The line it is about, from 1.
    pub line: usize,
    /// What is odd.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

/// Why there is no answer: a refusal of what was asked, or a failure of the program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ErrorAnswer {
    /// What went wrong.
    pub error: FailureRecord,
}

/// A refusal or a failure.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FailureRecord {
    /// A stable short code, `fk::not_applicable` for example.
    pub code: String,
    /// One sentence.
    pub message: String,
    /// What to do about it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
    /// The design file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// What is wrong with the design file; empty where the failure is not about one.
    pub violations: Vec<ViolationRecord>,
}

/// One thing that is wrong with a design file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ViolationRecord {
    /// A stable short code.
    pub code: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub help: String,
}

/// What `--help`, `--version` and `--licences` print.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct HelpAnswer {
    /// The text.
    pub help: String,
}
