//! Points by their number: candidate `k` of a block depends only on the seed, the block and `k`.

mod sobol;

use num::{Purpose, Rng};

pub(super) use sobol::DIMENSIONS;
use sobol::scrambled;

/// Greatest number of candidates of a block: stream numbers reserve eight bits for the block.
pub(super) const MOST: u64 = 1 << 48;

/// The distribution of the points of a block in the unit cube.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointSpread {
    /// Independent uniform numbers.
    Uniform,
    /// A Latin hypercube: each of as many equal intervals as there are points holds one point in each coordinate.
    LatinHypercube,
    /// A Sobol sequence with Owen's scrambling.
    Sobol,
}

/// The block of a point, with the seed.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointPlace {
    pub(super) seed: u64,
    /// Number of the block.
    pub(super) block: u64,
    /// Number of points of the block.
    pub(super) count: u64,
}

impl PointPlace {
    /// Point `k` of the block, below `count`: one coordinate in `[0, 1)` for each dimension.
    pub(super) fn point(&self, spread: PointSpread, k: u64, dimensions: usize) -> Vec<f64> {
        let mut own = Purpose::SWEPT_VALUES.item(self.seed, self.block << 48 | k);
        (0..dimensions)
            .map(|d| {
                let u = own.unit();
                match spread {
                    PointSpread::Uniform => u,
                    PointSpread::LatinHypercube => {
                        let cell = permuted(k, self.count, self.key(d));
                        ((cell as f64 + u) / self.count as f64).min(BELOW_ONE)
                    }
                    PointSpread::Sobol => scrambled(d, k, self.key(d), u),
                }
            })
            .collect()
    }

    /// The key of a dimension.
    fn key(&self, dimension: usize) -> u64 {
        Purpose::SWEPT_ORDERS.item(self.seed, self.block << 48 | dimension as u64).next_u64()
    }
}

/// The greatest double below 1.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// Number of rounds of the network below. Four make it indistinguishable from a random permutation in tests (Luby,
/// Rackoff 1988), and two more cost little.
const ROUNDS: u64 = 6;

/// The place of `k` in a permutation of the numbers below `count`. It is a Feistel network over the next even number of
/// bits, applied until the number is below `count` (cycle walking; Black, Rogaway 2002). The domain is less than four
/// times `count`, so a few rounds suffice on average.
fn permuted(k: u64, count: u64, key: u64) -> u64 {
    let bits = (64 - count.saturating_sub(1).leading_zeros()).max(2).next_multiple_of(2);
    let half = bits / 2;
    let mask = (1u64 << half) - 1;
    let mut x = k;
    loop {
        let (mut left, mut right) = (x >> half, x & mask);
        for round in 0..ROUNDS {
            let mixed = hashed(key, round, right) & mask;
            (left, right) = (right, left ^ mixed);
        }
        x = left << half | right;
        if x < count {
            return x;
        }
    }
}

/// Random bits that belong to a key and two numbers.
fn hashed(key: u64, a: u64, b: u64) -> u64 {
    Rng::new(Rng::new(key ^ a.wrapping_mul(0x9fb2_1c65_1e98_df25)).next_u64() ^ b).next_u64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permutations_have_every_number_once_and_change_with_the_key() {
        for count in [1, 2, 3, 7, 64, 65, 1000] {
            let images = |key| (0..count).map(|k| permuted(k, count, key)).collect::<Vec<_>>();
            let mut sorted = images(9);
            sorted.sort_unstable();
            assert_eq!(sorted, (0..count).collect::<Vec<_>>());
            assert!(count < 7 || images(9) != images(10), "{count}");
            assert!(count < 7 || images(9) != sorted, "{count}");
        }
    }

    #[test]
    fn a_latin_hypercube_has_one_point_in_each_interval_of_each_coordinate() {
        let place = PointPlace { seed: 3, block: 2, count: 150 };
        for d in 0..4 {
            let mut cells: Vec<u64> = (0..150)
                .map(|k| (place.point(PointSpread::LatinHypercube, k, 4)[d] * 150.0).floor() as u64)
                .collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..150).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_point_depends_on_seed_block_and_number_alone() {
        let place = PointPlace { seed: 5, block: 0, count: 100 };
        for spread in [PointSpread::Uniform, PointSpread::LatinHypercube, PointSpread::Sobol] {
            let point = |p: &PointPlace, k| p.point(spread, k, 3);
            assert_eq!(point(&place, 17), point(&place, 17));
            assert_ne!(point(&place, 17), point(&place, 18));
            assert_ne!(point(&place, 17), point(&PointPlace { seed: 6, ..place }, 17));
            assert_ne!(point(&place, 17), point(&PointPlace { block: 1, ..place }, 17));
            // further dimensions do not change the first ones
            assert_eq!(point(&place, 17), place.point(spread, 17, 5)[..3]);
            assert!((0..100).flat_map(|k| point(&place, k)).all(|x| (0.0..1.0).contains(&x)));
        }
    }

    #[test]
    fn uniform_points_have_the_moments_of_uniform_ones() {
        let place = PointPlace { seed: 1, block: 0, count: 20_000 };
        let points: Vec<Vec<f64>> = (0..20_000).map(|k| place.point(PointSpread::Uniform, k, 2)).collect();
        let mean = |f: &dyn Fn(&[f64]) -> f64| points.iter().map(|p| f(p)).sum::<f64>() / 20_000.0;
        assert!((mean(&|p| p[0]) - 0.5).abs() < 0.01 && (mean(&|p| p[1] * p[1]) - 1.0 / 3.0).abs() < 0.01);
        assert!((mean(&|p| p[0] * p[1]) - 0.25).abs() < 0.01);
    }
}
