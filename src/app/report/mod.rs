//! Shows a folder of results as one HTML page: inputs, verdicts with their evidence, pictures, and where every file
//! comes from.
//!
//! Pure text in, text out. Nothing is computed here: every number comes from one of the files or from the comparison of
//! the designs among them. The page gives the SHA-256 of each file, so that a reader can tell whether the page belongs
//! to it.

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
    /// Path relative to the folder of the page, with parts separated by `/`.
    pub name: String,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// The content of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Title of the page; the name of the folder tells a reader nothing.
    pub title: String,
    /// The files, in the order of the page.
    pub files: Vec<ReportFile>,
    /// The comparison of the designs among the files, if there are several.
    pub comparison: Option<Comparison>,
    /// A page of its own to embed (the live view of a design), as HTML.
    pub view: Option<String>,
}

#[cfg(test)]
mod tests;
