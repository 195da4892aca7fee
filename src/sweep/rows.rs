//! The rows of a range of candidates, in their order, from several threads.

use std::ops::Range;
use std::sync::Arc;

use super::column::SweepCell;
use super::evaluate::Sweep;
use crate::num::Cancel;
use crate::num::stream::Stream;

/// A row as the columns of its sweep have it.
pub(crate) type SweepRow = Vec<SweepCell>;

/// Candidates that a thread takes at a time: many are done in some microseconds each.
const AT_ONCE: u64 = 32;

/// What came of some candidates that follow one another: the rows that are kept, in one piece, which takes less time than rows that
/// are allocated and freed one by one.
#[derive(Debug, PartialEq)]
pub(crate) struct RowChunk {
    /// How many candidates they are, kept or not.
    pub(crate) candidates: u64,
    cells: Vec<SweepCell>,
    columns: usize,
}

impl RowChunk {
    /// The rows that are kept.
    pub(crate) fn rows(&mut self) -> impl Iterator<Item = &mut [SweepCell]> {
        self.cells.chunks_exact_mut(self.columns)
    }
}

impl Sweep {
    /// What came of the candidates of a range, in their order. Results do not depend on the number of threads, and
    /// what waits to be taken is limited, so that memory does not grow with the range. Ends early when it is cancelled.
    pub(crate) fn rows(
        self: &Arc<Self>,
        range: Range<u64>,
        threads: usize,
        cancel: &Cancel,
    ) -> impl Iterator<Item = RowChunk> + use<> {
        let sweep = Arc::clone(self);
        let end = range.end;
        let starts = (0..range.end.saturating_sub(range.start).div_ceil(AT_ONCE))
            .map(move |n| range.start + n * AT_ONCE);
        let chunk = move |start: u64| {
            let (candidates, columns) = (end.min(start + AT_ONCE) - start, sweep.columns.len());
            let mut cells = Vec::with_capacity(columns * candidates as usize);
            for k in start..start + candidates {
                sweep.row_onto(k, &mut cells);
            }
            RowChunk { candidates, cells, columns }
        };
        Stream::new(starts, threads, cancel.clone(), chunk)
    }
}

/// The candidates of shard `shard` of `shards`: the ranges of all shards are as equal as they can be, and follow one another.
pub(crate) fn shard_range(count: u64, shard: u64, shards: u64) -> Range<u64> {
    let at = |s: u64| (u128::from(count) * u128::from(s) / u128::from(shards)) as u64;
    at(shard)..at(shard + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

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
