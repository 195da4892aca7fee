//! The rows of a range of candidates, in order, computed by several threads.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use super::column::SweepCell;
use super::evaluate::Sweep;
use num::Cancel;
use num::stream::Stream;

/// A row in the columns of its sweep.
pub type SweepRow = Vec<SweepCell>;

/// Greatest number of candidates that a thread takes at a time; many take only some microseconds each.
const AT_ONCE: u64 = 32;

/// Bounds on the time of candidates taken together. Below the first, more are taken; above the second, fewer. Slow
/// candidates are thus spread over all threads, and an interrupt waits for few of them.
const TOGETHER: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(20)];

/// The number of candidates to take next, after `n` took this time. Rows do not depend on it.
fn next_at_once(n: u64, took: Duration) -> u64 {
    if took < TOGETHER[0] {
        (2 * n).min(AT_ONCE)
    } else if took > TOGETHER[1] {
        (n / 2).max(1)
    } else {
        n
    }
}

/// The results of consecutive candidates: the rows kept, in one allocation, which is faster than one for each row.
#[derive(Debug, PartialEq)]
pub struct RowChunk {
    /// Number of candidates, kept or not.
    pub candidates: u64,
    cells: Vec<SweepCell>,
    columns: usize,
}

impl RowChunk {
    /// The rows kept.
    pub fn rows(&mut self) -> impl Iterator<Item = &mut [SweepCell]> {
        self.cells.chunks_exact_mut(self.columns)
    }
}

impl Sweep {
    /// The results of the candidates of a range, in order. They do not depend on the number of threads. The number of
    /// waiting results is limited, so that memory does not grow with the range. Ends early when cancelled.
    pub fn rows(
        self: &Arc<Self>,
        range: Range<u64>,
        threads: usize,
        cancel: &Cancel,
    ) -> impl Iterator<Item = RowChunk> + use<> {
        let sweep = Arc::clone(self);
        // one at first, since their time is unknown
        let at_once = Arc::new(AtomicU64::new(1));
        let (asked, mut next) = (Arc::clone(&at_once), range.start);
        let ranges = std::iter::from_fn(move || {
            let start = next;
            next = range.end.min(start + asked.load(Ordering::Relaxed));
            (start < range.end).then_some(start..next)
        });
        let chunk = move |range: Range<u64>| {
            let began = Instant::now();
            let (candidates, columns) = (range.end - range.start, sweep.columns.len());
            let mut cells = Vec::with_capacity(columns * candidates as usize);
            for k in range {
                sweep.row_onto(k, &mut cells);
            }
            at_once.store(next_at_once(candidates, began.elapsed()), Ordering::Relaxed);
            RowChunk { candidates, cells, columns }
        };
        Stream::new(ranges, threads, cancel.clone(), chunk)
    }
}

/// The candidates of shard `shard` of `shards`; the ranges of the shards are consecutive and as equal as possible.
pub fn shard_range(count: u64, shard: u64, shards: u64) -> Range<u64> {
    let at = |s: u64| (u128::from(count) * u128::from(s) / u128::from(shards)) as u64;
    at(shard)..at(shard + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_candidates_are_taken_one_by_one_and_fast_ones_together() {
        let after = |n: u64, each: f64| {
            (0..20).fold(n, |n, _| next_at_once(n, Duration::from_secs_f64(each * n as f64)))
        };
        assert_eq!([1e-6, 30e-6].map(|each| after(1, each)), [AT_ONCE; 2]);
        assert_eq!([0.05, 30.0].map(|each| after(AT_ONCE, each)), [1; 2]);
        // in between, as many as take some milliseconds
        let some = after(1, 4e-4);
        assert!(1 < some && some < AT_ONCE && after(AT_ONCE, 4e-4) > 1, "{some}");
    }

    #[test]
    fn shards_follow_one_another_and_are_nearly_equal() {
        for (count, shards) in [(10, 3), (3, 10), (1_000_000_007, 64), (0, 1), (1 << 53, 100_000)] {
            let mut next = 0;
            for s in 0..shards.min(1000) {
                let range = shard_range(count, s, shards);
                assert_eq!(range.start, next);
                assert!(range.end - range.start <= count / shards + 1);
                next = range.end;
            }
            assert_eq!(shard_range(count, shards - 1, shards).end, count);
        }
    }
}
