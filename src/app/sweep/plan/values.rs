//! The values of the free quantities of candidate `k`.

use super::{FreeQuantity, SweepPlan};
use crate::column::{SweepCell, SweepColumn};
use crate::sample::{PointPlace, PointSpread};

/// Quantities that vary together.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanBlock {
    pub(crate) spreading: Spreading,
    /// Number of candidates of the block.
    pub count: u64,
    pub(crate) axes: Vec<PlanAxis>,
}

/// The order of the candidates of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spreading {
    /// All combinations, the last axis fastest.
    Grid,
    /// Candidate `j` takes element `j` of each list.
    List,
    /// Points of the unit cube.
    Points(PointSpread),
}

/// A free quantity with its values.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanAxis {
    pub(crate) quantity: FreeQuantity,
    pub(crate) column: SweepColumn,
    pub(crate) values: AxisValues,
}

/// The values of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisValues {
    /// A range of numbers in steps of equal size or, on a logarithmic scale, of equal ratio; `count` values on a grid.
    Range {
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// Whether the steps are factors.
        logarithmic: bool,
        /// Number of values.
        count: u64,
    },
    /// Listed numbers.
    Numbers(Vec<f64>),
    /// Listed texts.
    Words(Vec<String>),
}

impl AxisValues {
    /// Number of values on a grid or in a list.
    pub(crate) fn len(&self) -> u64 {
        match self {
            Self::Range { count, .. } => *count,
            Self::Numbers(list) => list.len() as u64,
            Self::Words(list) => list.len() as u64,
        }
    }

    /// The value of index `i`.
    fn at(&self, i: u64) -> SweepCell {
        match self {
            Self::Range { count, to, .. } if i + 1 == *count && i > 0 => SweepCell::Number(*to),
            Self::Range { count, .. } => self.within(i as f64 / count.saturating_sub(1).max(1) as f64),
            Self::Numbers(list) => SweepCell::Number(list[i as usize]),
            Self::Words(list) => SweepCell::Text(list[i as usize].clone()),
        }
    }

    /// The value at `u` in `[0, 1)`; a list is divided into equal shares of this interval.
    fn within(&self, u: f64) -> SweepCell {
        let element = |n: usize| ((u * n as f64) as usize).min(n - 1);
        match self {
            Self::Range { from, to, logarithmic: false, .. } => SweepCell::Number(from + (to - from) * u),
            Self::Range { from, to, .. } => SweepCell::Number(from * (to / from).powf(u)),
            Self::Numbers(list) => SweepCell::Number(list[element(list.len())]),
            Self::Words(list) => SweepCell::Text(list[element(list.len())].clone()),
        }
    }
}

impl PlanBlock {
    /// The values of candidate `j` of the block.
    fn values(&self, (seed, block): (u64, usize), mut j: u64, out: &mut Vec<SweepCell>) {
        match self.spreading {
            Spreading::List => out.extend(self.axes.iter().map(|a| a.values.at(j))),
            Spreading::Grid => {
                let first = out.len();
                for axis in self.axes.iter().rev() {
                    out.push(axis.values.at(j % axis.values.len()));
                    j /= axis.values.len();
                }
                out[first..].reverse();
            }
            Spreading::Points(spread) => {
                let place = PointPlace { seed, block: block as u64, count: self.count };
                let point = place.point(spread, j, self.axes.len());
                out.extend(self.axes.iter().zip(point).map(|(axis, u)| axis.values.within(u)));
            }
        }
    }

    /// Whether candidate `j` of the block has first values for the offsets from number `used` on. On a grid each offset
    /// counts alone; in lists and points only if nothing else varies with them.
    fn has_first_of_unused(&self, used: usize, mut j: u64) -> bool {
        let unused = |axis: &PlanAxis| matches!(axis.quantity, FreeQuantity::Offset(i) if i >= used);
        if self.spreading != Spreading::Grid {
            return j == 0 || !self.axes.iter().all(unused);
        }
        self.axes.iter().rev().all(|axis| {
            let at = j % axis.values.len();
            j /= axis.values.len();
            at == 0 || !unused(axis)
        })
    }
}

impl SweepPlan {
    /// The candidates `j` of each block that make up candidate `k`; the last block varies fastest.
    fn of_blocks(&self, k: u64) -> Vec<u64> {
        let mut numbers = vec![0; self.blocks.len()];
        let mut rest = k;
        for (number, block) in numbers.iter_mut().zip(&self.blocks).rev() {
            *number = rest % block.count;
            rest /= block.count;
        }
        numbers
    }

    /// Whether candidate `k` is the first of those that differ only in offsets from number `used` on, as far as blocks
    /// can tell. Points that mix these offsets with other quantities all count as first.
    pub fn has_first_of_unused(&self, k: u64, used: usize) -> bool {
        self.blocks.iter().zip(self.of_blocks(k)).all(|(block, j)| block.has_first_of_unused(used, j))
    }

    /// The values of the free quantities of candidate `k`, in the order of their columns: one candidate of each block.
    /// The last block varies fastest.
    ///
    /// They depend only on the plan, the seed and `k`.
    pub fn values(&self, seed: u64, k: u64) -> Vec<SweepCell> {
        let mut out = Vec::new();
        for (b, (block, j)) in self.blocks.iter().zip(self.of_blocks(k)).enumerate() {
            block.values((seed, b), j, &mut out);
        }
        out
    }
}
