//! What stage a run is in, on standard error, when a person watches.

use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Writes nothing unless standard error is a terminal.
#[derive(Debug)]
pub(crate) struct ProgressLine {
    on: bool,
    shown: Option<usize>,
}

impl ProgressLine {
    pub(crate) fn new(quiet: bool) -> Self {
        Self { on: !quiet && std::io::stderr().is_terminal(), shown: None }
    }

    fn put(&self, text: &str) {
        if self.on {
            // the terminal may be gone; the run goes on without a watcher
            let _ = std::io::stderr().write_all(text.as_bytes());
        }
    }

    /// A stage begins.
    pub(crate) fn stage(&mut self, number: usize, what: &str) {
        self.shown = None;
        self.put(&format!("[{number}/5] {what}\n"));
    }

    /// `done` of `total` within a stage, in whole percents.
    pub(crate) fn part(&mut self, what: &str, done: usize, total: usize) {
        let percent = 100 * done / total.max(1);
        if self.shown == Some(percent) {
            return;
        }
        self.shown = Some(percent);
        let end = if done >= total { "\n" } else { "" };
        self.put(&format!("\r      {what}: {percent:>3} %{end}"));
    }

    /// Some words about an open-ended stage, in the place of the last ones.
    pub(crate) fn note(&mut self, words: &str) {
        self.put(&format!("\r      {words}\x1b[K"));
        self.shown = None;
    }

    /// Ends the line of [`ProgressLine::note`].
    pub(crate) fn end(&mut self) {
        self.put("\n");
    }
}

/// A time after which a search ends, positive seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TimeLimit(Duration);

impl std::str::FromStr for TimeLimit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let seconds: f64 = text.parse().map_err(|_| "not a number of seconds".to_string())?;
        let limit = Duration::try_from_secs_f64(seconds).ok().filter(|d| !d.is_zero());
        limit.map(Self).ok_or_else(|| "seconds have to be positive".to_string())
    }
}

/// Ctrl-C, a request to terminate and a limit of time ask a search to stop and to show what it has; the second key or request ends the process.
#[derive(Debug, Clone)]
pub(crate) struct Interrupt {
    asked: Arc<AtomicBool>,
    end: Option<Instant>,
}

impl Interrupt {
    /// Takes over Ctrl-C from now on. Where that is not possible the key ends the process as ever.
    pub(crate) fn watch() -> Self {
        Self::watch_for(None)
    }

    /// The same, and after a limit of time the search is to end as well.
    pub(crate) fn watch_for(limit: Option<TimeLimit>) -> Self {
        let flag = Arc::new(AtomicBool::new(false));
        let seen = Arc::clone(&flag);
        let handler = move || {
            if seen.swap(true, Ordering::Relaxed) {
                std::process::exit(INTERRUPTED);
            }
        };
        // an error means that somebody else has the key: the search then cannot be interrupted gently
        let _ = ctrlc::set_handler(handler);
        let end = limit.and_then(|TimeLimit(time)| Instant::now().checked_add(time));
        Self { asked: flag, end }
    }

    /// What a search is told.
    pub(crate) fn flow(&self) -> ControlFlow<()> {
        let late = self.end.is_some_and(|end| Instant::now() >= end);
        if late || self.asked.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// Exit code of a process ended by Ctrl-C (128 + SIGINT).
const INTERRUPTED: i32 = 130;
