//! Interpolation at roots of unity and roots of one polynomial, in double-double arithmetic.

use num_complex::Complex64;

use num::double_double::{ComplexDoubleDouble as Number, DoubleDouble};
use num::poly::{RootsError, roots as double_roots};

fn one() -> Number {
    Number::from(Complex64::ONE)
}

/// `exp(2 pi i k / n)` to double-double accuracy: two Newton steps on `z^n = 1` from the double value.
pub(super) fn root_of_unity(k: usize, n: usize) -> Number {
    let mut z = Number::from(Complex64::from_polar(1.0, std::f64::consts::TAU * k as f64 / n as f64));
    let count = Number::from(Complex64::new(n as f64, 0.0));
    for _ in 0..2 {
        let power = (0..n).fold(one(), |p, _| p * z);
        z = z - z * (power - one()) / (count * power);
    }
    z
}

/// The coefficients of the real polynomial of degree below `n` with the given values at the roots of unity `0..=n/2`.
/// `n` is even; the other values are conjugates.
pub(super) fn interpolate(values: &[Number], n: usize) -> Vec<DoubleDouble> {
    let unit: Vec<Number> = (0..n).map(|k| root_of_unity(k, n)).collect();
    let scale = DoubleDouble::ONE / DoubleDouble::from(n as f64);
    (0..n)
        .map(|k| {
            let mut sum = DoubleDouble::ZERO;
            for (j, v) in values.iter().enumerate() {
                let real = (*v * unit[(n - j * k % n) % n]).re;
                let self_conjugate = j == 0 || 2 * j == n;
                sum = sum + if self_conjugate { real } else { real.scaled(2.0) };
            }
            sum * scale
        })
        .collect()
}

/// Sweeps of the simultaneous iteration in double-double.
const SWEEPS: usize = 60;

/// All roots of the polynomial with these coefficients, constant first: Ehrlich-Aberth, started from the roots
/// in double arithmetic, with values and corrections in double-double.
///
/// # Errors
/// [`RootsError::NoPolynomial`] for non-finite or all-zero coefficients.
pub(super) fn roots(coefficients: &[DoubleDouble]) -> Result<Vec<Number>, RootsError> {
    let rounded: Vec<Complex64> = coefficients.iter().map(|c| Complex64::new(c.hi(), 0.0)).collect();
    let mut z: Vec<Number> = double_roots(&rounded)?.into_iter().map(Number::from).collect();
    for _ in 0..SWEEPS {
        let mut largest = 0.0f64;
        for k in 0..z.len() {
            let newton = newton_correction(coefficients, z[k]);
            let others = (0..z.len()).filter(|&j| j != k);
            let repulsion: Complex64 =
                others.map(|j| (z[k] - z[j]).hi().inv()).filter(|w| w.is_finite()).sum();
            // the repulsion decides how far to go only: double accuracy is enough for it
            let factor = (1.0 - newton.hi() * repulsion).inv();
            let step = newton * Number::from(factor);
            if step.hi().is_finite() {
                z[k] = z[k] - step;
                largest = largest.max(step.hi().norm() / z[k].hi().norm().max(f64::MIN_POSITIVE));
            }
        }
        if largest < 1e-24 {
            break;
        }
    }
    Ok(z)
}

/// `p / p'` at `x`, by the reversed polynomial outside the unit disc.
fn newton_correction(c: &[DoubleDouble], x: Number) -> Number {
    let n = c.len() - 1;
    let horner = |coefficient: &dyn Fn(usize) -> DoubleDouble, y: Number| {
        let (mut p, mut d) = (Number { re: coefficient(n), im: DoubleDouble::ZERO }, Number::ZERO);
        for k in (0..n).rev() {
            d = d * y + p;
            p = p * y;
            p.re = p.re + coefficient(k);
        }
        (p, d)
    };
    if x.hi().norm_sqr() <= 1.0 {
        let (p, d) = horner(&|k| c[k], x);
        if p == Number::ZERO { p } else { p / d }
    } else {
        let y = one() / x;
        let (q, d) = horner(&|k| c[n - k], y);
        let count = Number::from(Complex64::new(n as f64, 0.0));
        if q == Number::ZERO { q } else { x * q / (q * count - d * y) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilkinson_twenty_through_interpolation() {
        // (x - 1)(x - 2)..(x - 20), hopeless in doubles; scaled by 1/8 so that the circle is not far off
        let values: Vec<Number> = (0..=16)
            .map(|j| {
                let x = root_of_unity(j, 32);
                (1..=20).fold(one(), |p, k| p * (x - Number::from(Complex64::new(f64::from(k) / 8.0, 0.0))))
            })
            .collect();
        let c = interpolate(&values, 32);
        assert!(c[21..].iter().all(|x| x.hi().abs() < 1e-22));
        let found = roots(&c[..21]).unwrap();
        for k in 1..=20 {
            let near = found.iter().map(|z| (z.hi() - f64::from(k) / 8.0).norm()).fold(f64::MAX, f64::min);
            assert!(near < 1e-9, "{k}: {near}");
        }
    }
}
