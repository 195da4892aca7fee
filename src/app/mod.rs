//! Answers users: it holds their questions, the answers as data, and the doors, which are the command line, the page,
//! Python, C and sweeps.
//!
//! It knows everything below. It proves nothing: each "proved", "singular", "equivalent" and "met" is copied from one
//! value of the packages below.
//!
//! * `ask` (a package): one function for each question.
//! * `records` (a package): every answer as plain data.
//! * `sheet` (a package): every answer as lines and tables, in text, Markdown and HTML.
//! * [`cli`]: the program.
//!
//! A door reads its arguments, asks one question, and shows the record of the answer as text, JSON, HTML or arrays.
//! The doors for many designs (`sweep`), for Python, for C and for the browser (`page/core`) are packages.

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "page")]
pub(crate) mod page;
#[cfg(feature = "files")]
pub(crate) mod presets;
#[cfg(feature = "page")]
pub(crate) mod report;
