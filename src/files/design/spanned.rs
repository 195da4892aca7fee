//! The tree with places that designs are read through, for other files in the same two notations: they are refused with
//! the same lines, columns and nearest keys.

pub use super::keys::{check_keys, nearest_help, number, shown, table, text};
pub use super::tree::{Entry, Node, Span, Value, find, read};
pub use super::violation::Findings;
