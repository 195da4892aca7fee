//! Errors of the library as Python exceptions with code, place and help; interrupts.

use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::{PyKeyboardInterrupt, PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use ask::Error;
use files::design::Code;

/// A fault at one place of a design.
type TextFault = (String, usize, usize, String, String);

/// The exception for an error: `DesignError` for bad input, `OSError` for files, `KeyboardInterrupt` for an interrupt.
pub(super) fn raised(py: Python<'_>, error: Error) -> PyErr {
    match error {
        Error::Cancelled => PyKeyboardInterrupt::new_err("interrupted"),
        Error::File { path, source } => PyOSError::new_err((
            source.raw_os_error().unwrap_or(0),
            source.to_string(),
            path.display().to_string(),
        )),
        other => {
            let faults: Vec<TextFault> = other
                .violations()
                .iter()
                .map(|v| (v.code.name().to_owned(), v.line, v.column, v.message.clone(), v.help.clone()))
                .collect();
            design_error(py, code_of(&other), &other.to_string(), &faults)
        }
    }
}

/// Whether a signal requests the end; runs without the lock of the interpreter.
#[allow(clippy::redundant_closure_for_method_calls, reason = "the method itself is not general enough")]
pub(super) fn interrupted() -> bool {
    Python::attach(|py| py.check_signals()).is_err()
}

/// The interval at which a long computation checks for signals.
const SIGNALS: Duration = Duration::from_millis(100);

/// Computes on a separate thread while the caller checks for signals. After an interrupt the computation continues
/// unobserved until it ends, since it cannot be stopped.
pub(super) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> PyResult<T> {
    let (answer, found) = mpsc::channel();
    let found = py.detach(move || {
        let worker = thread::spawn(move || answer.send(work()));
        loop {
            match found.recv_timeout(SIGNALS) {
                Ok(found) => return found,
                Err(RecvTimeoutError::Timeout) if interrupted() => return Err(Error::Cancelled),
                Err(RecvTimeoutError::Timeout) => {}
                // a panic ended it without an answer; the caller gets the panic
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        match worker.join() {
            Err(panic) => std::panic::resume_unwind(panic),
            Ok(_) => Err(Error::Cancelled),
        }
    });
    found.map_err(|e| raised(py, e))
}

/// Bad input that the library does not check: shapes and names of arguments.
pub(super) fn refused(py: Python<'_>, code: &str, message: &str) -> PyErr {
    design_error(py, code, message, &[])
}

/// The refusal of cranks for questions about legs of variable length, with the question to ask instead.
pub(super) fn refused_for_cranks(py: Python<'_>, instead: &str) -> PyErr {
    let message =
        format!("the design has rods on cranks, but this question needs legs of variable length: {instead}");
    refused(py, Code::Rotary.name(), &message)
}

fn design_error(py: Python<'_>, code: &str, message: &str, faults: &[TextFault]) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("equipod._errors")?.getattr("DesignError")?;
        let words = PyDict::new(py);
        words.set_item("code", code)?;
        words.set_item("faults", faults.to_vec())?;
        Ok(PyErr::from_value(class.call((message,), Some(&words))?))
    };
    made().unwrap_or_else(|_| PyRuntimeError::new_err(message.to_owned()))
}

/// A stable code for the kind of error.
fn code_of(error: &Error) -> &'static str {
    match error {
        Error::Design { violations, .. } => violations.first().map_or("design", |v| v.code.name()),
        Error::Trajectory { .. } => "trajectory",
        Error::Joint(_) => "joint",
        Error::Name(_) => "unknown_name",
        Error::Manipulator(_) => "manipulator",
        Error::Lengths(_) => "lengths",
        Error::Pose(_) => "pose",
        Error::Overflow => "overflow",
        Error::NotOctahedral(_) => "not_octahedral",
        Error::Fk(_) => "fk",
        Error::Units(_) => "different_units",
        Error::Verify(_) => "verify",
        Error::Pattern(_) => "pattern",
        Error::Offsets(_) | Error::OffsetText(_) => "offsets",
        Error::NothingRequired => "nothing_required",
        Error::Export(_) | Error::Format(_) => "export",
        _ => "computation",
    }
}
