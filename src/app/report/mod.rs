//! Shows a folder of results as one HTML page: inputs, verdicts with their evidence, pictures, and where every file
//! comes from.
//!
//! Pure text in, text out. Nothing is computed here: every number of the page stands in one of the files, which are
//! named with their SHA-256 so that a reader can tell whether the page belongs to them, or in the comparison of the
//! designs among them.

mod comparison;
mod kind;
mod page;
mod parts;

pub use comparison::{Comparison, comparison_page};
pub use kind::ResultVerdict;
pub use page::html;

/// One file of the folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportFile {
    /// Name from the folder of the page on, parts separated by `/`.
    pub name: String,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// What goes into the page.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Title; the name of the folder says nothing to a reader.
    pub title: String,
    /// The files, in the order in which they are to appear.
    pub files: Vec<ReportFile>,
    /// The designs among the files side by side, where there are several.
    pub comparison: Option<Comparison>,
    /// A page of its own to embed (the live view of a design), as HTML.
    pub view: Option<String>,
}

#[cfg(test)]
mod tests;
