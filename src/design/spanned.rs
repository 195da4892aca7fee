//! The tree with places that designs are read through, for other files in the same two notations: they are refused with the same lines, columns and nearest keys.

use super::{Format, json_text, toml_text};

pub(crate) use super::tree::{Entry, Node, Span, Value, find};
pub(crate) use super::validate::{check_keys, nearest_help, number, shown, table, text};
pub(crate) use super::violation::Findings;

/// Reads a text; `None` where it is not TOML or not JSON, with the reasons in the report.
pub(crate) fn read(text: &str, format: Format, report: &mut Findings<'_>) -> Option<Node> {
    match format {
        Format::Toml => toml_text::read(text, report),
        Format::Json => json_text::read(text, report),
    }
}
