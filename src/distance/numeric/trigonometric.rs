//! Zeros of a polynomial in `u` and `1/u` from its values on a circle.

use num_complex::Complex64;

use crate::poly::approximate_roots;

/// Relative step at which a zero is near enough for Newton's method on the closure, of which it is a simple zero.
const STEP: f64 = 1e-6;
/// Sweeps after which zeros are taken as they are.
const SWEEPS: usize = 40;

/// Coefficients `c_{-D}, .., c_D` of `sum c_k v^k` from values at the `n > 2 D` roots of unity `v = exp(2 pi i j / n)`.
pub(super) fn coefficients(values: &[Complex64], degree: usize) -> Vec<Complex64> {
    let n = values.len();
    let turn: Vec<Complex64> = unit_circle(n);
    let sum = |k: usize| {
        // k counts from -D
        let step = (k + n - degree % n) % n;
        let mut place = 0;
        let mut sum = Complex64::ZERO;
        for v in values {
            sum += v * turn[place].conj();
            place = (place + step) % n;
        }
        sum / n as f64
    };
    (0..=2 * degree).map(sum).collect()
}

/// The `n`-th roots of unity.
pub(super) fn unit_circle(n: usize) -> Vec<Complex64> {
    (0..n).map(|j| Complex64::cis(std::f64::consts::TAU * j as f64 / n as f64)).collect()
}

/// The zeros, and how many are lost at zero and infinity: end coefficients below `1e-15` of the largest are rounding.
pub(super) fn zeros(coefficients: &[Complex64]) -> (Vec<Complex64>, usize) {
    let largest = coefficients.iter().map(|c| c.norm()).fold(0.0, f64::max);
    let counts = |c: &Complex64| c.norm() > 1e-15 * largest;
    let ends = coefficients.iter().position(counts).zip(coefficients.iter().rposition(counts));
    let Some((low, top)) = ends else { return (Vec::new(), coefficients.len().saturating_sub(1)) };
    let found = approximate_roots(&coefficients[low..=top], STEP, SWEEPS).unwrap_or_default();
    let lost = coefficients.len() - 1 - found.len();
    (found, lost)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_come_back_from_values() {
        let wanted =
            [Complex64::new(0.5, 0.2), Complex64::new(-1.1, 0.7), Complex64::I, Complex64::new(2.0, 0.0)];
        let value = |v: &Complex64| wanted.iter().map(|w| v - w).product::<Complex64>() / (v * v);
        let values: Vec<Complex64> = unit_circle(8).iter().map(value).collect();
        let c = coefficients(&values, 3);
        assert!(c[0].norm() < 1e-15 && c[6].norm() < 1e-15 && (c[5] - 1.0).norm() < 1e-15);
        let (found, lost) = zeros(&c[1..6]);
        assert_eq!((found.len(), lost), (4, 0));
        for w in wanted {
            assert!(found.iter().any(|z| (z - w).norm() < 1e-9));
        }
        let (found, lost) = zeros(&c);
        assert!(found.len() == 4 && lost == 2 || found.len() + lost == 6);
    }
}
