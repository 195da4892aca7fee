//! The best of many random feasible points.

use std::sync::atomic::{AtomicUsize, Ordering};

use equipod::num::Rng;

use crate::judge::Judge;
use crate::record::{Record, Rival};

/// Uniform draws from the box of the variables until `wanted` feasible ones were evaluated, or `seconds` of processor time are over.
pub(crate) fn random_search(
    judge: &dyn Judge,
    wanted: usize,
    seconds: f64,
    threads: usize,
    seed: u64,
) -> Rival {
    let record = Record::new();
    let draws = AtomicUsize::new(0);
    let share = wanted.div_ceil(threads.max(1));
    std::thread::scope(|scope| {
        for k in 0..threads.max(1) {
            let (record, draws) = (&record, &draws);
            scope.spawn(move || {
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
                draws.fetch_add(drawn, Ordering::Relaxed);
            });
        }
    });
    Rival { draws: draws.into_inner(), ..record.finish(judge) }
}
