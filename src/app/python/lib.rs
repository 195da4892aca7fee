//! The native module of the Python package: arrays in, arrays and answers out.
//!
//! Nothing is computed here. Arrays become poses and lengths. Questions go to the front page of the library or to the
//! program. Answers leave as arrays or, for records, as the JSON of the command line. The Python sources in this folder
//! make typed objects of both.

#![cfg(feature = "module")]
#![allow(clippy::needless_pass_by_value, reason = "arguments of functions that Python calls are handed over")]
#![allow(clippy::cast_possible_wrap, reason = "counts that fit in memory, as the integers that numpy has")]

mod answers;
mod arrays;
mod command;
mod design;
mod failure;
mod forms;
mod pentapod;
mod solutions;
mod tracker;

use pyo3::prelude::*;

/// Runs the program `equipod` on its arguments; the exit code.
#[pyfunction]
fn main(py: Python<'_>, args: Vec<String>) -> u8 {
    py.detach(|| equipod::cli::status(args.into_iter().map(Into::into)))
}

/// The native part of the package `equipod`.
#[pymodule(gil_used = true)]
#[pyo3(name = "_core")]
mod core {
    #[pymodule_export]
    use super::answers::{leg_map, preset_names, sheet_html, verify};
    #[pymodule_export]
    use super::command::ask;
    #[pymodule_export]
    use super::design::NativeDesign;
    #[pymodule_export]
    use super::forms::{
        angles_of, frames_sentence, poses_as_numbers, poses_in_frames, quaternions_of, rotations_of_angles,
        rotations_of_quaternions,
    };
    #[pymodule_export]
    use super::main;
    #[pymodule_export]
    use super::pentapod::NativeFiveLegs;
    #[pymodule_export]
    use super::solutions::NativeSolutions;
    #[pymodule_export]
    use super::tracker::NativeTracker;

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "the name that Python packages have for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
