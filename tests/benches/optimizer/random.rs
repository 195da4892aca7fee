//! The best of many random feasible points.

use std::sync::atomic::{AtomicUsize, Ordering};

use equipod::num::Rng;

use crate::judge::Judge;
use crate::record::{Record, Rival};

/// No more than this many draws for each feasible point wanted, on average.
const MOST_DRAWS: usize = 20_000;

/// Uniform draws from the box of the variables until `wanted` feasible ones were evaluated.
pub(crate) fn random_search(judge: &dyn Judge, wanted: usize, threads: usize, seed: u64) -> Rival {
    let record = Record::new();
    let draws = AtomicUsize::new(0);
    let share = wanted.div_ceil(threads.max(1));
    std::thread::scope(|scope| {
        for k in 0..threads.max(1) {
            let (record, draws) = (&record, &draws);
            scope.spawn(move || {
                let mut rng = Rng::stream(seed, k as u64);
                let (mut found, mut drawn) = (0, 0);
                while found < share && drawn < share.saturating_mul(MOST_DRAWS) {
                    let x: Vec<f64> = judge.bounds().iter().map(|b| rng.uniform(b.0, b.1)).collect();
                    drawn += 1;
                    if judge.violation(&x) <= 0.0 {
                        record.evaluate(judge, &x);
                        found += 1;
                    }
                }
                draws.fetch_add(drawn, Ordering::Relaxed);
            });
        }
    });
    Rival { draws: draws.into_inner(), ..record.finish(judge) }
}
