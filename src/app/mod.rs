//! Answers users: it holds their questions, the answers as data, and the doors, which are the command line, the page, Python, C and sweeps.
//!
//! It knows everything below. It proves nothing: each "proved", "singular", "equivalent" and "met" is copied from one value of the rooms below.
//!
//! * [`entrance`]: the questions as methods of the design.
//! * [`records`]: every answer as plain data.
//! * [`cli`]: the program.
//!
//! A door reads its arguments, asks one question of `entrance`, and shows the record of the answer as text, JSON, HTML or arrays.

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "page")]
pub(crate) mod page;
#[cfg(feature = "page")]
pub(crate) mod report;
