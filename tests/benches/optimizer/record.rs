//! The best feasible answer of several threads, with the curve to it and its cost.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use super::judge::Judge;
use super::verdict::Judged;

/// Processor time of all threads of this process in seconds; `None` where the system does not tell.
pub(crate) fn cpu_seconds() -> Option<f64> {
    // Linux: fields 14 and 15 in hundredths of a second; the name before them may hold blanks but ends with the last
    // bracket
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let mut fields = stat.rsplit(')').next()?.split_whitespace().skip(11);
    let ticks: f64 = fields.next()?.parse::<f64>().ok()? + fields.next()?.parse::<f64>().ok()?;
    Some(ticks / 100.0)
}

/// Elapsed and processor time since it was made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    start: Instant,
    cpu: Option<f64>,
}

/// Seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spent {
    pub(crate) elapsed: f64,
    /// Elapsed time where the system does not tell.
    pub(crate) cpu: f64,
}

impl Clock {
    pub(crate) fn start() -> Self {
        Self { start: Instant::now(), cpu: cpu_seconds() }
    }

    pub(crate) fn spent(&self) -> Spent {
        let elapsed = self.start.elapsed().as_secs_f64();
        let cpu = self.cpu.zip(cpu_seconds()).map_or(elapsed, |(from, to)| to - from);
        Spent { elapsed, cpu }
    }
}

/// One improvement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    pub(crate) elapsed: f64,
    pub(crate) value: f64,
}

#[derive(Debug)]
struct Best {
    x: Vec<f64>,
    /// All that were the best at their time.
    path: Vec<Vec<f64>>,
    value: f64,
    curve: Vec<Point>,
}

/// Shared by the threads of one rival.
#[derive(Debug)]
pub(crate) struct Record {
    pub(crate) clock: Clock,
    evaluations: AtomicUsize,
    best: Mutex<Best>,
}

impl Record {
    pub(crate) fn new() -> Self {
        let best = Best { x: Vec::new(), path: Vec::new(), value: f64::NEG_INFINITY, curve: Vec::new() };
        Self { clock: Clock::start(), evaluations: AtomicUsize::new(0), best: Mutex::new(best) }
    }

    /// The value of a feasible point, counted and kept when it is the best so far.
    pub(crate) fn evaluate(&self, judge: &dyn Judge, x: &[f64]) -> f64 {
        let value = judge.value(x);
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        let best_so_far = || self.best.lock().map_or(f64::INFINITY, |b| b.value);
        if value > best_so_far()
            && let Some(confirmed) = judge.confirm(x)
            && let Ok(mut best) = self.best.lock()
            && confirmed > best.value
        {
            (best.x, best.value) = (x.to_vec(), confirmed);
            best.path.push(x.to_vec());
            let elapsed = self.clock.spent().elapsed;
            best.curve.push(Point { elapsed, value: confirmed });
        }
        value
    }

    pub(crate) fn evaluations(&self) -> usize {
        self.evaluations.load(Ordering::Relaxed)
    }

    /// The best point so far; empty before the first.
    pub(crate) fn best(&self) -> Vec<f64> {
        self.best.lock().map(|b| b.x.clone()).unwrap_or_default()
    }

    /// The result, judged once more.
    pub(crate) fn finish(self, judge: &dyn Judge) -> Rival {
        let spent = self.clock.spent();
        let evaluations = self.evaluations();
        let (x, curve, path) = self.best.into_inner().map(|b| (b.x, b.curve, b.path)).unwrap_or_default();
        let judged = (!x.is_empty()).then(|| judge.last_word(&x));
        Rival { judged, curve, path, evaluations, spent, draws: 0 }
    }
}

/// A rival's answer.
#[derive(Debug, Clone)]
pub(crate) struct Rival {
    pub(crate) judged: Option<Judged>,
    pub(crate) curve: Vec<Point>,
    /// Points that were the best at their time, best last.
    pub(crate) path: Vec<Vec<f64>>,
    /// Objectives evaluated, of feasible points only.
    pub(crate) evaluations: usize,
    pub(crate) spent: Spent,
    /// Points drawn or asked for, infeasible ones as well.
    pub(crate) draws: usize,
}

impl Rival {
    /// The same rival after another run: the better answer of both, the costs of both.
    pub(crate) fn then(self, later: Self) -> Self {
        let accepted = |r: &Self| r.judged.filter(|j| j.violation <= 0.0).map(|j| j.value);
        let judged = match (accepted(&self), accepted(&later)) {
            (Some(a), Some(b)) if a > b => self.judged,
            (Some(_), None) => self.judged,
            (None, None) => self.judged.or(later.judged),
            _ => later.judged,
        };
        let best = self.curve.last().map_or(f64::NEG_INFINITY, |p| p.value);
        let after = |p: &Point| Point { elapsed: self.spent.elapsed + p.elapsed, value: p.value };
        let curve = later.curve.iter().map(after).filter(|p| p.value > best);
        Self {
            judged,
            curve: self.curve.iter().copied().chain(curve).collect(),
            path: self.path.into_iter().chain(later.path).collect(),
            evaluations: self.evaluations + later.evaluations,
            spent: Spent {
                elapsed: self.spent.elapsed + later.spent.elapsed,
                cpu: self.spent.cpu + later.spent.cpu,
            },
            draws: self.draws + later.draws,
        }
    }
}
