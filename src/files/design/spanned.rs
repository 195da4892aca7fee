//! The tree with places behind the design reader, for other files in the same two notations. Their errors have the same
//! lines, columns and suggestions.

pub use super::keys::{check_keys, nearest_help, number, shown, table, text};
pub use super::tree::{Entry, Node, Span, Value, find, read};
pub use super::violation::Findings;
