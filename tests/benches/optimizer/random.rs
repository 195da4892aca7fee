//! The best of many random feasible points.

use std::sync::atomic::{AtomicUsize, Ordering};

use equipod::methods::num::Rng;

use super::judge::Judge;
use super::record::{Record, Rival};

/// Uniform draws from the box of the variables until `wanted` feasible ones were evaluated, or `seconds` of processor
/// time are over.
pub(crate) fn random_search(
    judge: &dyn Judge,
    wanted: usize,
    seconds: f64,
    threads: usize,
    seed: u64,
) -> Rival {
    shared(judge, wanted, threads, |k, share, record| {
        let mut rng = Rng::stream(seed, k as u64);
        let (mut found, mut drawn) = (0, 0);
        while found < share {
            if drawn % 1000 == 0 && record.clock.spent().cpu > seconds {
                break;
            }
            let x: Vec<f64> = judge.bounds().iter().map(|b| rng.uniform(b.0, b.1)).collect();
            drawn += 1;
            if judge.is_feasible(&x) {
                record.evaluate(judge, &x);
                found += 1;
            }
        }
        drawn
    })
}

/// Runs threads that evaluate their share of the wanted designs each and return the number of points they asked for.
/// Each gets its number, its share and the record.
fn shared(
    judge: &dyn Judge,
    wanted: usize,
    threads: usize,
    work: impl Fn(usize, usize, &Record) -> usize + Sync,
) -> Rival {
    let record = Record::new();
    let draws = AtomicUsize::new(0);
    let share = wanted.div_ceil(threads.max(1));
    std::thread::scope(|scope| {
        for k in 0..threads.max(1) {
            let (record, draws, work) = (&record, &draws, &work);
            scope.spawn(move || draws.fetch_add(work(k, share, record), Ordering::Relaxed));
        }
    });
    Rival { draws: draws.into_inner(), ..record.finish(judge) }
}

/// Feasible designs that a walk takes from one start.
const STEPS: usize = 500;
/// A chord is given up when so short a share of it is left.
const SHORTEST: f64 = 1e-9;

/// Feasible designs without rejection of nearly all, by hit-and-run walks. Their points tend to the uniform
/// distribution on the feasible set around their start (Smith 1984; chords shrunk as by Neal 2003).
///
/// The walks take turns with feasible starts until `wanted` designs were evaluated, or `seconds` of processor time are
/// over. Nothing without starts.
pub(crate) fn walks(
    judge: &dyn Judge,
    starts: &[Vec<f64>],
    wanted: usize,
    seconds: f64,
    threads: usize,
    seed: u64,
) -> Rival {
    shared(judge, wanted, threads, |k, share, record| {
        let mut rng = Rng::stream(seed ^ 0x6872, k as u64);
        let (mut found, mut idle, mut asked) = (0, 0, 0);
        let is_over = || record.clock.spent().cpu > seconds;
        for start in starts.iter().rev().cycle().skip(k) {
            let before = found;
            let mut x = start.clone();
            while found < share && found - before < STEPS && !is_over() {
                let Some(next) = step(judge, &x, &mut asked, &mut rng) else { break };
                record.evaluate(judge, &next);
                x = next;
                found += 1;
            }
            // starts that poses found later refute lead nowhere
            idle = if found > before { 0 } else { idle + 1 };
            if found >= share || idle > starts.len() || is_over() {
                break;
            }
        }
        asked
    })
}

/// A uniform point of the feasible part, near `x`, of a chord of random direction through it; `None` where none is
/// found.
fn step(judge: &dyn Judge, x: &[f64], asked: &mut usize, rng: &mut Rng) -> Option<Vec<f64>> {
    let bounds = judge.bounds();
    // directions in the unit cube of the variables
    let d: Vec<f64> = bounds.iter().map(|b| (b.1 - b.0) * rng.normal()).collect();
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for ((x, d), b) in x.iter().zip(&d).zip(bounds).filter(|((_, d), _)| **d != 0.0) {
        let ends = ((b.0 - x) / d, (b.1 - x) / d);
        low = low.max(ends.0.min(ends.1)).min(0.0);
        high = high.min(ends.0.max(ends.1)).max(0.0);
    }
    let whole = high - low;
    while whole.is_finite() && high - low > SHORTEST * whole {
        let t = rng.uniform(low, high);
        let there: Vec<f64> = x.iter().zip(&d).map(|(x, d)| x + t * d).collect();
        *asked += 1;
        if judge.is_feasible(&there) {
            return Some(there);
        }
        if t < 0.0 { low = t } else { high = t }
    }
    None
}
