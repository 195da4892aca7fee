//! Asks: one function for each question, which every door calls.
//!
//! It knows all rooms below. It computes nothing by itself: each question names the modules that answer it, with their
//! defaults.
//!
//! * [`Design`]: a platform with names, units, home pose and requirements; its methods are the questions.
//! * [`Kinematics`]: the questions that need a platform alone.
//! * [`Error`]: why a question has no answer.
//!
//! A design is read from a text, a question is put to it with its options, and the answer is a value with its evidence.

#[cfg(feature = "lab")]
pub mod bench;
#[cfg(feature = "files")]
mod designs;
mod error;
mod solving;

#[cfg(feature = "files")]
pub use designs::*;
pub use error::Error;
#[cfg(feature = "files")]
pub use solving::solve_angles;
pub use solving::{Batch, Kinematics, Solver, Tracker};
