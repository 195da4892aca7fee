//! Polynomials through values on an interval, by Chebyshev polynomials.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::roots::{RootCondition, zeros};

/// A polynomial `sum over -n..=n of b_m v^m`, `t = (v + 1/v) / 2`, `b_-m = b_m` real: a sum of Chebyshev polynomials
/// `T_m(t)`.
#[derive(Debug, Clone)]
pub(super) struct Chebyshev {
    /// `b_0, .., b_n`.
    coefficients: Vec<f64>,
    /// Term over the largest on the ellipse each was found on: about rounding over its relative error.
    weight: Vec<f64>,
    /// The term beyond the degree over the largest.
    pub(super) excess: f64,
}

/// Terms below this part of the largest on their ellipse say little.
const TRUSTED: f64 = 1e-9;

/// The points with positive imaginary part that determine a polynomial of this degree with real coefficients. They are
/// equidistant for `v` on a circle, and lie on an ellipse about the interval `[-1, 1]` for `t`.
pub(super) fn nodes(degree: usize, radius: f64) -> Vec<Complex64> {
    (0..count(degree)).map(|k| of_circle(Complex64::from_polar(radius, angle(degree, k)))).collect()
}

/// Half the number of coefficients of the Laurent polynomial in `v`, and one more.
fn count(degree: usize) -> usize {
    degree + 2
}

fn angle(degree: usize, k: usize) -> f64 {
    PI * (k as f64 + 0.5) / count(degree) as f64
}

fn of_circle(v: Complex64) -> Complex64 {
    (v + v.inv()) * 0.5
}

/// Points of a narrow ellipse, to start from.
pub(super) fn around(degree: usize) -> Vec<Complex64> {
    (0..degree)
        .map(|k| of_circle(Complex64::from_polar(1.3, TAU * (k as f64 + 0.3) / degree as f64)))
        .collect()
}

impl Chebyshev {
    /// The polynomial from values at the [`nodes`].
    pub(super) fn through(values: &[Complex64], degree: usize, radius: f64) -> Self {
        let term = |m: usize| {
            let terms = values.iter().enumerate();
            let sum: f64 =
                terms.map(|(k, v)| (v * Complex64::from_polar(1.0, -(m as f64) * angle(degree, k))).re).sum();
            sum / values.len() as f64
        };
        let mut terms: Vec<f64> = (0..=degree + 1).map(term).collect();
        let beyond = terms.pop().map_or(0.0, f64::abs);
        let scale = terms.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        Self {
            coefficients: terms.iter().enumerate().map(|(m, t)| t * radius.powf(-(m as f64))).collect(),
            weight: terms.iter().map(|t| t.abs() / scale).collect(),
            excess: beyond / scale,
        }
    }

    /// The radius for another attempt: a wider ellipse when the last coefficients are small here, a narrower one when
    /// the first are.
    pub(super) fn doubtful(&self, radius: f64) -> Option<f64> {
        let small = |list: &[f64]| list.iter().all(|w| *w < TRUSTED);
        let n = self.weight.len();
        if small(&self.weight[n - 2..]) {
            Some(radius * radius)
        } else if small(&self.weight[..4]) {
            Some(radius.sqrt())
        } else {
            None
        }
    }

    /// Takes the coefficients that stand out more in another.
    pub(super) fn improve(&mut self, other: &Self) {
        for m in 0..self.weight.len() {
            if other.weight[m] > self.weight[m] {
                self.weight[m] = other.weight[m];
                self.coefficients[m] = other.coefficients[m];
            }
        }
    }

    /// All zeros, from points around the interval.
    pub(super) fn zeros(&self) -> Vec<Complex64> {
        let start = around(self.coefficients.len() - 1);
        // the sum by T_m has c_0 = b_0, c_m = 2 b_m
        let scale = self.coefficients.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let factor = |m: usize| if m == 0 { 1.0 / scale } else { 2.0 / scale };
        let series: Vec<f64> = self.coefficients.iter().enumerate().map(|(m, b)| b * factor(m)).collect();
        zeros(&mut Series(&series), &start).0.into_iter().map(|z| z.at).collect()
    }
}

struct Series<'a>(&'a [f64]);

impl RootCondition for Series<'_> {
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
        let values: Vec<Complex64> =
            nodes(5, 1.5).iter().map(|t| known.iter().map(|z| t - z).product()).collect();
        let p = Chebyshev::through(&values, 5, 1.5);
        assert!(p.excess < 1e-14 && p.doubtful(1.5).is_none());
        let found = p.zeros();
        for z in known {
            assert_eq!(found.iter().filter(|f| (*f - z).norm() < 1e-9).count(), 1, "{found:?}");
        }
        let cubic: Vec<Complex64> = nodes(3, 2.0).iter().map(|t| t * t * t * t).collect();
        assert!(Chebyshev::through(&cubic, 3, 2.0).excess > 1e-3, "a degree too low shows");
    }
}
