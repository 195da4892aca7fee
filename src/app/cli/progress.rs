//! The progress of a run, on standard error.

use std::ops::ControlFlow;
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use super::streams::{self, Errors, Stop};
use ask::optimizing::ends_of;

/// On a terminal one changing line; elsewhere one line every ten seconds, so that short runs write none.
#[derive(Debug)]
pub(crate) struct ProgressLine {
    watcher: Watcher,
    /// The number and the name of the stage.
    stage: String,
    shown: Option<usize>,
}

#[derive(Debug)]
enum Watcher {
    Nobody,
    Terminal(Errors),
    Log(Ticker),
}

impl ProgressLine {
    pub(crate) fn new(quiet: bool) -> Self {
        let errors = Errors::of_run();
        let watcher = if quiet {
            Watcher::Nobody
        } else if errors.is_terminal() {
            Watcher::Terminal(errors)
        } else {
            Watcher::Log(Ticker::start(errors))
        };
        Self { watcher, stage: String::new(), shown: None }
    }

    /// Shows the text on the terminal, or the words in the log.
    fn put(&self, text: &str, words: &str) {
        match &self.watcher {
            Watcher::Nobody => {}
            Watcher::Terminal(errors) => errors.write(text),
            Watcher::Log(ticker) => ticker.say(&format!("{}{words}", self.stage)),
        }
    }

    /// Begins a stage.
    pub(crate) fn stage(&mut self, number: usize, what: &str) {
        self.shown = None;
        self.stage = format!("[{number}/5] {what} ");
        self.put(&format!("[{number}/5] {what}\n"), "");
    }

    /// Shows `done` of `total` within a stage, in whole percents.
    pub(crate) fn part(&mut self, what: &str, done: usize, total: usize) {
        let percent = 100 * done / total.max(1);
        if self.shown == Some(percent) {
            return;
        }
        self.shown = Some(percent);
        let end = if done >= total { "\n" } else { "" };
        self.put(&format!("\r      {what}: {percent:>3} %{end}"), &format!("{what}: {percent} %"));
    }

    /// Shows words about an open-ended stage, replacing the last ones.
    pub(crate) fn note(&mut self, words: &str) {
        self.put(&format!("\r      {words}\x1b[K"), words);
        self.shown = None;
    }

    /// Ends the line of [`ProgressLine::note`].
    pub(crate) fn end(&mut self) {
        self.put("\n", "");
    }
}

/// Time between two lines of the log.
const TICK: Duration = Duration::from_secs(10);

/// A thread that writes the last words every ten seconds.
#[derive(Debug)]
struct Ticker {
    shared: Arc<(Mutex<Said>, Condvar)>,
}

/// The last words, and whether the run has ended.
#[derive(Debug, Default)]
struct Said {
    words: String,
    over: bool,
}

impl Ticker {
    fn start(errors: Errors) -> Self {
        let shared = Arc::new((Mutex::new(Said::default()), Condvar::new()));
        let of_thread = Arc::clone(&shared);
        // without a thread there is no log
        let _ = std::thread::Builder::new().spawn(move || {
            let (said, changed) = &*of_thread;
            let begin = Instant::now();
            let mut next = begin + TICK;
            let Ok(mut now) = said.lock() else { return };
            while !now.over {
                let left = next.saturating_duration_since(Instant::now());
                if left.is_zero() {
                    let words = now.words.trim_end();
                    errors.write(&format!("{:>5} s  {words}\n", begin.elapsed().as_secs()));
                    next += TICK;
                    continue;
                }
                match changed.wait_timeout(now, left) {
                    Ok((guard, _)) => now = guard,
                    Err(_) => return,
                }
            }
        });
        Self { shared }
    }

    fn say(&self, words: &str) {
        if let Ok(mut said) = self.shared.0.lock() {
            words.clone_into(&mut said.words);
        }
    }
}

impl Drop for Ticker {
    fn drop(&mut self) {
        if let Ok(mut said) = self.shared.0.lock() {
            said.over = true;
        }
        self.shared.1.notify_all();
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

/// Stops a search on Ctrl-C, on a request to terminate, or at a time limit; the search then shows its result so far.
#[derive(Debug, Clone)]
pub(crate) struct Interrupt {
    stop: Arc<Stop>,
    /// The end of the search, and the end of the assessment of its result.
    ends: Option<[Instant; 2]>,
}

impl Interrupt {
    /// Watches for the stop of the caller from now on, or for Ctrl-C. If Ctrl-C cannot be handled, it ends the process.
    pub(crate) fn watch() -> Self {
        Self::watch_for(None)
    }

    /// The same with a time limit for everything: the search ends earlier, so that its result can be assessed.
    pub(crate) fn watch_for(limit: Option<TimeLimit>) -> Self {
        Self { stop: streams::heeded_stop(), ends: limit.and_then(|TimeLimit(time)| ends_of(time)) }
    }

    /// The time at which the assessment of a result ends.
    pub(crate) fn until(&self) -> Option<Instant> {
        self.ends.map(|[_, assessing]| assessing)
    }

    /// Whether the search shall continue.
    pub(crate) fn flow(&self) -> ControlFlow<()> {
        let late = self.ends.is_some_and(|[search, _]| Instant::now() >= search);
        if late || self.stop.is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
