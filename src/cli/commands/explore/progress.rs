//! What stage a run is in, on standard error, when a person watches.

use std::io::{IsTerminal, Write};

/// Writes nothing unless standard error is a terminal.
#[derive(Debug)]
pub(super) struct Progress {
    on: bool,
    shown: Option<usize>,
}

impl Progress {
    pub(super) fn new(quiet: bool) -> Self {
        Self { on: !quiet && std::io::stderr().is_terminal(), shown: None }
    }

    fn put(&self, text: &str) {
        if self.on {
            // the terminal may be gone; the run goes on without a watcher
            let _ = std::io::stderr().write_all(text.as_bytes());
        }
    }

    /// A stage begins.
    pub(super) fn stage(&mut self, number: usize, what: &str) {
        self.shown = None;
        self.put(&format!("[{number}/5] {what}\n"));
    }

    /// `done` of `total` within a stage, in whole percents.
    pub(super) fn part(&mut self, what: &str, done: usize, total: usize) {
        let percent = 100 * done / total.max(1);
        if self.shown == Some(percent) {
            return;
        }
        self.shown = Some(percent);
        let end = if done >= total { "\n" } else { "" };
        self.put(&format!("\r      {what}: {percent:>3} %{end}"));
    }
}
