//! Streams and interrupts of a run: of the process, or of a caller inside the process.

use std::cell::RefCell;
use std::io::{self, IsTerminal as _, Read, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;

/// A request to end, from one thread to a command on another.
#[derive(Debug, Default)]
pub struct Stop {
    asked: AtomicBool,
    heeded: AtomicBool,
}

impl Stop {
    /// Asks the command to end. Returns true for the first request to a command that obeys it; its answer is the best
    /// so far.
    pub fn ask(&self) -> bool {
        !self.asked.swap(true, Ordering::Relaxed) && self.heeded.load(Ordering::Relaxed)
    }

    /// Whether an end was requested.
    pub(super) fn is_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}

/// A caller inside the process, and the standard output of the run so far.
#[derive(Debug)]
struct Caller {
    said: Sender<String>,
    stop: Arc<Stop>,
    output: String,
}

thread_local! {
    /// The caller of the run on this thread. Without a caller the run has the streams of the process.
    static CALLER: RefCell<Option<Caller>> = const { RefCell::new(None) };
}

/// Runs a command for a caller: its result and its standard output. `said` gets the texts for standard error.
pub(super) fn for_caller<T>(said: Sender<String>, stop: Arc<Stop>, run: impl FnOnce() -> T) -> (T, String) {
    CALLER.set(Some(Caller { said, stop, output: String::new() }));
    let result = run();
    (result, CALLER.take().map(|caller| caller.output).unwrap_or_default())
}

fn has_caller() -> bool {
    CALLER.with_borrow(Option::is_some)
}

/// The stop that the command obeys from now on.
///
/// Without a caller, Ctrl-C or a request to terminate triggers the stop, and a second one ends the process.
#[allow(clippy::exit, reason = "the second Ctrl-C ends the program without an answer")]
pub(super) fn heeded_stop() -> Arc<Stop> {
    let stop = CALLER.with_borrow(|caller| caller.as_ref().map(|caller| Arc::clone(&caller.stop)));
    let is_of_caller = stop.is_some();
    let stop = stop.unwrap_or_default();
    stop.heeded.store(true, Ordering::Relaxed);
    if !is_of_caller {
        let asked = Arc::clone(&stop);
        // an error means that another handler exists: the search then cannot be interrupted gently
        let _ = ctrlc::set_handler(move || {
            if !asked.ask() {
                std::process::exit(INTERRUPTED);
            }
        });
    }
    stop
}

/// Exit code of a process ended by Ctrl-C (128 + SIGINT).
const INTERRUPTED: i32 = 130;

/// Standard input, which is empty for a caller.
pub(super) fn input() -> Box<dyn Read> {
    if has_caller() { Box::new(io::empty()) } else { Box::new(io::stdin().lock()) }
}

/// Whether standard input is a terminal, so that a person can answer questions.
pub(super) fn input_is_terminal() -> bool {
    !has_caller() && io::stdin().is_terminal()
}

/// Whether standard output is a terminal.
pub(super) fn output_is_terminal() -> bool {
    !has_caller() && io::stdout().is_terminal()
}

/// Whether standard output accepts colours.
pub(super) fn output_is_coloured() -> bool {
    !has_caller() && anstream::AutoStream::choice(&io::stdout()) != anstream::ColorChoice::Never
}

/// Writes to standard output.
pub(super) fn write_output(text: &str) -> io::Result<()> {
    CALLER.with_borrow_mut(|caller| {
        if let Some(caller) = caller {
            caller.output.push_str(text);
            return Ok(());
        }
        let mut out = io::stdout().lock();
        out.write_all(text.as_bytes()).and_then(|()| out.flush())
    })
}

/// Standard error of a run, shared by its threads.
#[derive(Debug)]
pub(super) struct Errors(Option<Sender<String>>);

impl Errors {
    /// Standard error of the run on this thread.
    pub(super) fn of_run() -> Self {
        Self(CALLER.with_borrow(|caller| caller.as_ref().map(|caller| caller.said.clone())))
    }

    pub(super) fn is_terminal(&self) -> bool {
        self.0.is_none() && io::stderr().is_terminal()
    }

    /// Writes a text unchanged.
    pub(super) fn write(&self, text: &str) {
        // the reader may be gone; the run continues without it
        let _ = match &self.0 {
            Some(said) => said.send(text.to_owned()).map_err(io::Error::other),
            None => io::stderr().write_all(text.as_bytes()),
        };
    }

    /// Writes a text, with colours only on a terminal.
    pub(super) fn write_styled(&self, text: &str) {
        if self.0.is_some() {
            self.write(&anstream::adapter::strip_str(text).to_string());
        } else {
            // standard error may be closed: nobody can be told
            let _ = anstream::stderr().lock().write_all(text.as_bytes());
        }
    }
}
