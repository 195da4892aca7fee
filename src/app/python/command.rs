//! Commands of the program `equipod`, run inside this process.

use std::ffi::OsString;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use equipod::cli::{self, Stop};

/// The interval at which the calling thread checks for signals.
const SIGNALS: Duration = Duration::from_millis(50);

/// Twice the program's stack on the main thread of a process, bytes.
const STACK: usize = 16 << 20;

/// Runs a command: exit code, standard output and standard error. `progress` gets each line of standard error.
///
/// The first interrupt asks the command for its best result so far. The second interrupt is raised at once. So are an
/// interrupt of a command without such a result, and an exception of `progress`. The command then continues unobserved
/// until it sees the request or ends.
#[pyfunction]
pub(super) fn ask(
    py: Python<'_>,
    args: Vec<OsString>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(u8, String, String)> {
    let (said, heard) = mpsc::channel();
    let stop = Arc::<Stop>::default();
    let of_command = Arc::clone(&stop);
    let command =
        thread::Builder::new().stack_size(STACK).spawn(move || cli::asked(args, said, of_command))?;
    py.detach(|| {
        let said = listen(heard, &stop, progress.as_ref())?;
        let (code, output) = command.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok((code, output, said))
    })
}

/// Passes on the lines of a command until it ends, and checks for signals. Returns the whole text.
fn listen(heard: Receiver<String>, stop: &Stop, progress: Option<&Py<PyAny>>) -> PyResult<String> {
    let (mut said, mut told) = (String::new(), 0);
    loop {
        match heard.recv_timeout(SIGNALS) {
            Ok(text) => said.push_str(&text),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(said),
        }
        let checked = Python::attach(|py| -> PyResult<()> {
            py.check_signals()?;
            while let Some(length) = said[told..].find('\n') {
                let line = &said[told..told + length];
                told += length + 1;
                progress.map(|p| p.call1(py, (line,))).transpose()?;
            }
            Ok(())
        });
        let Err(error) = checked else { continue };
        let gives_best = stop.ask();
        if !gives_best || !Python::attach(|py| error.is_instance_of::<PyKeyboardInterrupt>(py)) {
            return Err(error);
        }
    }
}
