//! The small spanned tree both file formats are read into.

use std::ops::Range;

/// Byte range in the text.
pub(crate) type Span = Range<usize>;

/// Values nested deeper than this are refused; a design needs three levels.
pub(crate) const MAX_DEPTH: usize = 32;

/// A value with the place it stands at.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    pub(crate) span: Span,
    pub(crate) value: Value,
}

/// What a design file can be made of.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    Text(String),
    /// Correctly rounded; infinite when the text is too large for a double.
    Number(f64),
    Array(Vec<Node>),
    /// Entries in the order of the file.
    Table(Vec<Entry>),
    /// Anything a design never holds, by name: "boolean", "null", "datetime".
    Other(&'static str),
}

/// `key = value`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_span: Span,
    pub(crate) node: Node,
}

impl Value {
    /// The kind with its article, for messages.
    pub(crate) fn kind(&self) -> &'static str {
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
pub(crate) fn find<'a>(entries: &'a [Entry], key: &str) -> Option<&'a Entry> {
    entries.iter().find(|e| e.key == key)
}
