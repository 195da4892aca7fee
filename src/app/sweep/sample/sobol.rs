//! Sobol points by their number, with Owen's scrambling.
//!
//! No existing crate fits: `sobol_burley` has single precision and 2^16 points, and `sobol` and `sobol-qmc` enumerate
//! from the first point without scrambling. The direction numbers are those of Joe and Kuo (2008).

use std::sync::LazyLock;

use super::{BELOW_ONE, hashed};

/// Greatest number of dimensions of a block.
pub(crate) const DIMENSIONS: usize = 64;

/// Number of binary digits of a coordinate before scrambling: 2^32 points differ.
const DIGITS: usize = 32;

/// `2^32`.
const SCALE: f64 = 4_294_967_296.0;

/// The direction numbers of every dimension, the first digit in the highest bit.
static DIRECTIONS: LazyLock<Vec<[u32; DIGITS]>> = LazyLock::new(|| {
    let lines = include_str!("direction-numbers.txt").lines().filter(|l| !l.starts_with('#'));
    let first = std::array::from_fn(|i| 1 << (DIGITS - 1 - i));
    std::iter::once(first).chain(lines.map(directions)).collect()
});

/// The direction numbers from a line `d s a m_1 .. m_s`: with the primitive polynomial `x^s + a_1 x^(s-1) + .. + 1`
///
/// ```text
/// v_i = a_1 v_(i-1) ^ .. ^ a_(s-1) v_(i-s+1) ^ v_(i-s) ^ (v_(i-s) >> s),    v_i = m_i 2^(32-i) for i <= s.
/// ```
///
/// Source: Bratley, Fox (1988); Joe, Kuo (2003).
fn directions(line: &str) -> [u32; DIGITS] {
    let numbers: Vec<u32> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
    let (s, a, m) = (numbers[1] as usize, numbers[2], &numbers[3..]);
    let mut v = [0u32; DIGITS];
    for i in 0..DIGITS {
        v[i] = if i < s {
            m[i] << (DIGITS - 1 - i)
        } else {
            let inner = (1..s).filter(|j| a >> (s - 1 - j) & 1 == 1);
            inner.fold(v[i - s] ^ (v[i - s] >> s), |x, j| x ^ v[i - j])
        };
    }
    v
}

/// Coordinate `d` of point `k`, as 32 binary digits; only the lower 32 bits of `k` count.
fn digits(d: usize, k: u64) -> u32 {
    let v = &DIRECTIONS[d];
    (0..DIGITS).filter(|i| k >> i & 1 == 1).fold(0, |x, i| x ^ v[i])
}

/// Coordinate `d` of point `k` with nested uniform scrambling (Owen 1995). Random bits that depend on the preceding
/// digits decide whether a digit changes. After the last digit follows `rest`, uniform in `[0, 1)`.
///
/// As without scrambling, a number of points that is a power of two has one point in each elementary interval of that
/// volume. Each point by itself is uniform.
pub(super) fn scrambled(d: usize, k: u64, key: u64, rest: f64) -> f64 {
    let plain = digits(d, k);
    let mut out = 0u32;
    for i in 0..DIGITS {
        let before = if i == 0 { 0 } else { u64::from(plain >> (DIGITS - i)) };
        let change = hashed(key, i as u64, before) as u32 & 1;
        out = out << 1 | (plain >> (DIGITS - 1 - i) & 1 ^ change);
    }
    ((f64::from(out) + rest) / SCALE).min(BELOW_ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::float_cmp, reason = "binary fractions are exact")]
    fn the_first_points_are_those_of_the_literature() {
        // Joe and Kuo's own example: the first points in natural order, before the Gray code
        let point = |k| [0, 1, 2].map(|d| f64::from(digits(d, k)) / 2f64.powi(32));
        assert_eq!(point(1), [0.5, 0.5, 0.5]);
        assert_eq!(point(2), [0.25, 0.75, 0.75]);
        assert_eq!(point(3), [0.75, 0.25, 0.25]);
        assert_eq!(point(4), [0.125, 0.625, 0.375]);
        assert_eq!(DIRECTIONS.len(), DIMENSIONS);
        // every matrix of directions is regular, since its diagonal is one
        assert!(DIRECTIONS.iter().flat_map(|v| v.iter().enumerate()).all(|(i, x)| x >> (31 - i) & 1 == 1));
    }

    #[test]
    fn every_coordinate_has_one_point_in_each_interval_scrambled_or_not() {
        for d in 0..DIMENSIONS {
            let mut cells: Vec<u64> =
                (0..256).map(|k| (scrambled(d, k, 77 + d as u64, 0.3) * 256.0) as u64).collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..256).collect::<Vec<_>>(), "{d}");
        }
    }

    #[test]
    fn the_first_two_coordinates_have_one_point_in_each_elementary_interval() {
        for across in 0..=8 {
            let (wide, high) = (2f64.powi(across), 2f64.powi(8 - across));
            let mut cells: Vec<(u64, u64)> = (0..256)
                .map(|k| ((scrambled(0, k, 5, 0.5) * wide) as u64, (scrambled(1, k, 6, 0.5) * high) as u64))
                .collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len(), 256, "2^{across}");
        }
    }

    #[test]
    fn scrambling_depends_on_the_key() {
        let points = |key| (0..64).map(|k| scrambled(3, k, key, 0.0).to_bits()).collect::<Vec<_>>();
        assert_eq!(points(1), points(1));
        assert_ne!(points(1), points(2));
    }
}
