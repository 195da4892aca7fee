//! The rows of a range of candidates, in their order, from several threads.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use super::column::SweepCell;
use super::evaluate::Sweep;
use num::Cancel;
use num::stream::Stream;

/// A row as the columns of its sweep have it.
pub type SweepRow = Vec<SweepCell>;

/// Candidates that a thread takes at a time, at most: many are done in some microseconds each.
const AT_ONCE: u64 = 32;

/// What they may take together: below the first more are taken, above the second fewer, so that slow candidates are
/// spread over all threads, and an interrupt waits for few of them.
const TOGETHER: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(20)];

/// How many candidates are taken next, after so many took this time. Rows do not depend on it.
fn next_at_once(n: u64, took: Duration) -> u64 {
    if took < TOGETHER[0] {
        (2 * n).min(AT_ONCE)
    } else if took > TOGETHER[1] {
        (n / 2).max(1)
    } else {
        n
    }
}

/// What came of some candidates that follow one another: the rows that are kept, in one piece, which takes less time
/// than rows that are allocated and freed one by one.
#[derive(Debug, PartialEq)]
pub struct RowChunk {
    /// How many candidates they are, kept or not.
    pub candidates: u64,
    cells: Vec<SweepCell>,
    columns: usize,
}

impl RowChunk {
    /// The rows that are kept.
    pub fn rows(&mut self) -> impl Iterator<Item = &mut [SweepCell]> {
        self.cells.chunks_exact_mut(self.columns)
    }
}

impl Sweep {
    /// What came of the candidates of a range, in their order. Results do not depend on the number of threads, and
    /// what waits to be taken is limited, so that memory does not grow with the range. Ends early when it is cancelled.
    pub fn rows(
        self: &Arc<Self>,
        range: Range<u64>,
        threads: usize,
        cancel: &Cancel,
    ) -> impl Iterator<Item = RowChunk> + use<> {
        let sweep = Arc::clone(self);
        // one at first: nothing is known of their time
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

/// The candidates of shard `shard` of `shards`: the ranges of all shards are as equal as they can be, and follow one
/// another.
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
        // between both as many as take some milliseconds
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
