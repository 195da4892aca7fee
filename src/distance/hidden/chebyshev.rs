//! Polynomials through values on an interval, by Chebyshev polynomials.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::aberth::{Condition, zeros};

/// A polynomial `sum c_m T_m(t)`.
#[derive(Debug, Clone)]
pub(super) struct Chebyshev(Vec<f64>);

/// Larger than 1: sum of the half axes of the ellipse about the interval `[-1, 1]` on which values are taken.
const ELLIPSE: f64 = 2.0;

/// The points with positive imaginary part that a polynomial with real coefficients of this degree is known by: equidistant for `v` on a circle, `t = (v + 1/v) / 2`.
pub(super) fn nodes(degree: usize) -> Vec<Complex64> {
    (0..count(degree)).map(|k| of_circle(place(degree, k))).collect()
}

/// Half of what the Laurent polynomial in `v` has coefficients, and one more.
fn count(degree: usize) -> usize {
    degree + 2
}

fn place(degree: usize, k: usize) -> Complex64 {
    Complex64::from_polar(ELLIPSE, PI * (k as f64 + 0.5) / count(degree) as f64)
}

fn of_circle(v: Complex64) -> Complex64 {
    (v + v.inv()) * 0.5
}

/// Points of a narrower ellipse, to start from.
pub(super) fn around(degree: usize) -> Vec<Complex64> {
    (0..degree)
        .map(|k| of_circle(Complex64::from_polar(1.3, TAU * (k as f64 + 0.3) / degree as f64)))
        .collect()
}

impl Chebyshev {
    /// The polynomial from values at the [`nodes`], and the coefficient beyond its degree over the largest, both as on the ellipse.
    pub(super) fn through(values: &[Complex64], degree: usize) -> (Self, f64) {
        // F = sum over m of b_m v^m, b_-m = b_m real, c_0 = b_0, c_m = 2 b_m
        let coefficient = |m: usize| {
            let term = |(k, value): (usize, &Complex64)| {
                (value * Complex64::from_polar(1.0, -(m as f64) * place(degree, k).arg())).re
            };
            values.iter().enumerate().map(term).sum::<f64>() / values.len() as f64
        };
        let on_ellipse: Vec<f64> = (0..=degree + 1).map(coefficient).collect();
        let scale = on_ellipse.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let excess = on_ellipse[degree + 1].abs() / scale;
        let factor = |m: usize| if m == 0 { 1.0 } else { 2.0 * ELLIPSE.powf(-(m as f64)) };
        (Self((0..=degree).map(|m| on_ellipse[m] / scale * factor(m)).collect()), excess)
    }

    /// All zeros, from points around the interval.
    pub(super) fn zeros(&self) -> Vec<Complex64> {
        let degree = self.0.len() - 1;
        let start = around(degree);
        zeros(&mut Series(&self.0), &start).0.into_iter().map(|z| z.at).collect()
    }
}

struct Series<'a>(&'a [f64]);

impl Condition for Series<'_> {
    type Evidence = ();

    fn rate(&mut self, t: Complex64) -> Option<(Complex64, ())> {
        // T_m and U_{m-1}; T_m' = m U_{m-1}
        let (mut last, mut now) = (Complex64::ONE, t);
        let (mut before, mut second) = (Complex64::ZERO, Complex64::ONE);
        let (mut value, mut slope) = (Complex64::from(self.0[0]), Complex64::ZERO);
        for (m, c) in self.0.iter().enumerate().skip(1) {
            value += now * *c;
            slope += second * (*c * m as f64);
            (last, now) = (now, t * now * 2.0 - last);
            (before, second) = (second, t * second * 2.0 - before);
        }
        let rate = slope / value;
        (!rate.is_nan() || value == Complex64::ZERO).then_some((rate, ()))
    }

    fn floor(&self) -> f64 {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_found_again_by_its_zeros() {
        let known = [-0.9, -0.2, 0.1, 0.55, 1.4];
        let values: Vec<Complex64> = nodes(5).iter().map(|t| known.iter().map(|z| t - z).product()).collect();
        let (p, excess) = Chebyshev::through(&values, 5);
        assert!(excess < 1e-14);
        let found = p.zeros();
        for z in known {
            assert_eq!(found.iter().filter(|f| (*f - z).norm() < 1e-9).count(), 1, "{found:?}");
        }
        let cubic: Vec<Complex64> = nodes(3).iter().map(|t| t * t * t * t).collect();
        assert!(Chebyshev::through(&cubic, 3).1 > 1e-3, "a degree too low shows");
    }
}
