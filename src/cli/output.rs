//! Answers and failures to standard output and standard error.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::context::FileWarning;
use super::diagnostic;
use super::exit::Exit;
use super::failure::Failure;
use crate::synthesis::Relation;

/// What a command found.
///
/// `json` holds the fields of the document without `schema_version` and `warnings`, which are added for all
/// commands alike; `text` is what people read, without `--json`.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) exit: Exit,
    pub(crate) json: Map<String, Value>,
    pub(crate) text: String,
}

/// Where results go.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Output {
    json: bool,
}

impl Output {
    pub(crate) fn new(json: bool) -> Self {
        Self { json }
    }

    pub(crate) fn answer(self, answer: Answer, warnings: &[FileWarning]) -> Exit {
        let text = if self.json { document(answer.json, warnings) } else { answer.text };
        write_out(&text, answer.exit)
    }

    pub(crate) fn failure(self, failure: &Failure, warnings: &[FileWarning]) -> Exit {
        diagnostic::print_failure(failure);
        if !self.json {
            return failure.exit;
        }
        let mut fields = Map::new();
        fields.insert("error".into(), failure.to_json());
        write_out(&document(fields, warnings), failure.exit)
    }

    /// What clap has to say: help and version, or a refusal of the arguments.
    pub(crate) fn usage(self, error: &clap::Error) -> Exit {
        if error.use_stderr() {
            let _ = error.print(); // standard error may be closed; nothing is lost that JSON does not say
            if !self.json {
                return Exit::Refused;
            }
            let text = error.to_string();
            let lines = text.lines().take_while(|l| !l.starts_with("Usage:")).map(str::trim);
            let message = lines.filter(|l| !l.is_empty()).collect::<Vec<_>>().join(" ");
            let message = message.trim_start_matches("error: ");
            let failure = Failure::refused("usage", message).with_help("see equipod --help");
            let mut fields = Map::new();
            fields.insert("error".into(), failure.to_json());
            return write_out(&document(fields, &[]), Exit::Refused);
        }
        if self.json {
            let mut fields = Map::new();
            fields.insert("help".into(), json!(error.to_string()));
            return write_out(&document(fields, &[]), Exit::Yes);
        }
        let _ = error.print();
        Exit::Yes
    }
}

/// A number as JSON: null when it is not finite, because JSON has no word for it.
pub(crate) fn number(x: f64) -> Value {
    serde_json::Number::from_f64(x).map_or(Value::Null, Value::Number)
}

/// The word for a relation; null where it is not decided, for which there is no word in documents.
pub(crate) fn relation(r: Relation) -> Value {
    if r == Relation::Undecided { Value::Null } else { json!(r.as_str()) }
}

/// The text of a document: `fields` between `schema_version` and `warnings`.
pub(crate) fn document(fields: Map<String, Value>, warnings: &[FileWarning]) -> String {
    let mut document = Map::new();
    document.insert("schema_version".into(), json!(1));
    document.extend(fields);
    let warnings = warnings.iter().map(|w| {
        json!({
            "code": w.warning.code(), "path": w.path, "line": w.warning.line(),
            "message": w.warning.to_string(), "help": w.warning.advice(),
        })
    });
    document.insert("warnings".into(), warnings.collect());
    let mut text = Value::Object(document).to_string();
    text.push('\n');
    text
}

/// Writes to standard output. A closed pipe (`| head`) ends quietly, any other failure is exit 4.
fn write_out(text: &str, exit: Exit) -> Exit {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => exit,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => exit,
        Err(error) => {
            let message = format!("standard output cannot be written: {error}");
            diagnostic::print_failure(&Failure::new(Exit::Internal, "output", message));
            Exit::Internal
        }
    }
}
