//! The small spanned tree that both file formats are read into.

use std::ops::Range;

use super::violation::Findings;
use super::{Code, Format, json_text, toml_text};
use num::names::changes_direction;

/// Byte range in the text.
pub type Span = Range<usize>;

/// Values nested deeper than this are refused; a design needs three levels.
pub(crate) const MAX_DEPTH: usize = 32;

/// A value with its place in the text.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its place.
    pub span: Span,
    /// The value.
    pub value: Value,
}

/// The kinds of values in a design file.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A string.
    Text(String),
    /// A number, correctly rounded; infinite when the text is too large for a double.
    Number(f64),
    /// An array.
    Array(Vec<Node>),
    /// Entries in the order of the file.
    Table(Vec<Entry>),
    /// A value that a design never contains, by name: "boolean", "null", "datetime".
    Other(&'static str),
}

/// `key = value`.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// The place of the key.
    pub key_span: Span,
    /// The value of the key.
    pub node: Node,
}

impl Value {
    /// The kind with its article, for messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Text(_) => "a string",
            Self::Number(_) => "a number",
            Self::Array(_) => "an array",
            Self::Table(_) => "a table",
            Self::Other(kind) => kind,
        }
    }
}

/// The entry named `key`.
pub fn find<'a>(entries: &'a [Entry], key: &str) -> Option<&'a Entry> {
    entries.iter().find(|e| e.key == key)
}

/// Reads a text; `None` if it is not TOML or not JSON, with the reasons in the report.
pub fn read(text: &str, format: Format, report: &mut Findings<'_>) -> Option<Node> {
    let root = match format {
        Format::Toml => toml_text::read(text, report),
        Format::Json => json_text::read(text, report),
    };
    if let Some(root) = &root {
        refuse_directions(root, report);
    }
    root
}

/// Refuses names and texts with characters that change the direction of text. A drawing, table or page would display
/// something other than the written text.
fn refuse_directions(node: &Node, report: &mut Findings<'_>) {
    let mut refuse = |text: &str, span: &Span| {
        if let Some(c) = text.chars().find(|c| changes_direction(*c)) {
            let message = format!(
                "the text holds {}, which changes the direction of what follows it",
                c.escape_unicode()
            );
            report.refuse(
                Code::TextDirection,
                span,
                message,
                "leave the character out: scripts that run from right to left need none",
            );
        }
    };
    match &node.value {
        Value::Text(text) => refuse(text, &node.span),
        Value::Array(list) => {
            for node in list {
                refuse_directions(node, report);
            }
        }
        Value::Table(entries) => {
            for entry in entries {
                refuse(&entry.key, &entry.key_span);
            }
            for entry in entries {
                refuse_directions(&entry.node, report);
            }
        }
        Value::Number(_) | Value::Other(_) => {}
    }
}
