//! The questions: one function for each, which the command line, the page, Python and C call.
//!
//! It depends on all packages of the library. It computes nothing itself: each question calls the modules that answer
//! it, with their defaults.
//!
//! * [`Design`]: a platform with names, units, home pose and requirements; its methods are the questions.
//! * [`Kinematics`]: the questions that need only a platform.
//! * [`Error`]: the reason why a question has no answer.
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
