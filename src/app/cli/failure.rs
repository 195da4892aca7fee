//! The reasons why a command has no answer.

use super::exit::Exit;
use files::design::Violation;
use records::{FailureRecord, ViolationRecord};

/// A refusal or failure: the content of `"error"` in JSON and of standard error.
#[derive(Debug, Clone)]
pub(crate) struct Failure {
    /// The exit code.
    pub(crate) exit: Exit,
    /// Stable code, `fk::not_applicable` for example.
    pub(crate) code: String,
    /// One sentence.
    pub(crate) message: String,
    /// The remedy.
    pub(crate) help: Option<String>,
    /// The design file concerned.
    pub(crate) design: Option<Box<BadDesign>>,
}

/// A design file and its violations.
#[derive(Debug, Clone)]
pub(crate) struct BadDesign {
    pub(crate) path: String,
    pub(crate) text: String,
    pub(crate) violations: Vec<Violation>,
}

impl Failure {
    /// A failure with exit code, code and message.
    pub(crate) fn new(exit: Exit, code: impl Into<String>, message: impl Into<String>) -> Self {
        Self { exit, code: code.into(), message: message.into(), help: None, design: None }
    }

    /// Exit 2.
    pub(crate) fn refused(code: impl Into<String>, message: impl Into<String>) -> Self {
        Self::new(Exit::Refused, code, message)
    }

    /// Exit 4.
    pub(crate) fn internal(message: impl Into<String>) -> Self {
        let help = "this is a fault of the program; please report it with the command and the design";
        Self::new(Exit::Internal, "internal", message).with_help(help)
    }

    /// Adds the remedy.
    pub(crate) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// A design file with violations.
    pub(crate) fn bad_design(path: String, text: String, violations: Vec<Violation>) -> Self {
        let message = match violations.len() {
            1 => format!("{path}: 1 violation"),
            n => format!("{path}: {n} violations"),
        };
        let mut failure = Self::refused("design::invalid", message);
        failure.design = Some(Box::new(BadDesign { path, text, violations }));
        failure
    }
}

impl From<&Failure> for FailureRecord {
    fn from(f: &Failure) -> Self {
        let violations = f.design.as_ref().map(|d| d.violations.as_slice()).unwrap_or_default();
        let violation = |v: &Violation| ViolationRecord {
            code: v.code.name().into(),
            line: v.line,
            column: v.column,
            message: v.message.clone(),
            help: v.help.clone(),
        };
        Self {
            code: f.code.clone(),
            message: f.message.clone(),
            help: f.help.clone(),
            path: f.design.as_ref().map(|d| d.path.clone()),
            violations: violations.iter().map(violation).collect(),
        }
    }
}
