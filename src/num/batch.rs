//! Eight complex numbers side by side, so that the compiler can fill vector units.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;

/// Lanes.
pub const LANES: usize = 8;

/// Eight complex numbers, real and imaginary parts apart.
#[derive(Debug, Clone, Copy)]
pub struct ComplexBatch {
    /// Real parts.
    pub re: [f64; LANES],
    /// Imaginary parts.
    pub im: [f64; LANES],
}

impl ComplexBatch {
    /// All zero.
    pub const ZERO: Self = Self { re: [0.0; LANES], im: [0.0; LANES] };

    /// The same real number in every lane.
    #[inline(always)]
    pub fn real(x: f64) -> Self {
        Self { re: [x; LANES], im: [0.0; LANES] }
    }

    /// One number in all lanes.
    #[inline(always)]
    pub fn all(z: Complex64) -> Self {
        Self { re: [z.re; LANES], im: [z.im; LANES] }
    }

    /// The number in lane `k`.
    #[inline(always)]
    pub fn lane(&self, k: usize) -> Complex64 {
        Complex64::new(self.re[k], self.im[k])
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64, f64, f64) -> (f64, f64)) -> Self {
        let mut out = Self::ZERO;
        for k in 0..LANES {
            (out.re[k], out.im[k]) = f(self.re[k], self.im[k], other.re[k], other.im[k]);
        }
        out
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64, f64) -> (f64, f64)) -> Self {
        let mut out = Self::ZERO;
        for k in 0..LANES {
            (out.re[k], out.im[k]) = f(self.re[k], self.im[k]);
        }
        out
    }

    /// `z + c` for a real `c`.
    #[inline(always)]
    pub fn plus(self, c: f64) -> Self {
        self.map(|re, im| (re + c, im))
    }

    /// `c z` for a real `c`.
    #[inline(always)]
    pub fn times(self, c: f64) -> Self {
        self.map(|re, im| (re * c, im * c))
    }

    /// The imaginary unit times each.
    #[inline(always)]
    pub fn times_i(self) -> Self {
        let mut re = self.im;
        for x in &mut re {
            *x = -*x;
        }
        Self { re, im: self.re }
    }

    /// `1 / z`; not a number where `z = 0`.
    #[inline(always)]
    pub fn reciprocal(self) -> Self {
        self.map(|re, im| {
            let n = 1.0 / (re * re + im * im);
            (re * n, -im * n)
        })
    }

    /// Squared moduli.
    #[inline(always)]
    pub fn norm_sqr(self) -> [f64; LANES] {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            out[k] = self.re[k] * self.re[k] + self.im[k] * self.im[k];
        }
        out
    }

    /// A square root of each, with the real part not negative.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(|re, im| {
            let modulus = (re * re + im * im).sqrt();
            let large = (0.5 * (modulus + re.abs())).sqrt();
            let small = 0.5 * im / large.max(f64::MIN_POSITIVE);
            let swapped = if im < 0.0 { -large } else { large };
            if re >= 0.0 { (large, small) } else { (small.abs(), swapped) }
        })
    }

    /// Lane by lane, from `self` where `choose`, else from `other`.
    #[inline(always)]
    pub fn select(self, other: Self, choose: [bool; LANES]) -> Self {
        let mut out = other;
        for k in 0..LANES {
            if choose[k] {
                (out.re[k], out.im[k]) = (self.re[k], self.im[k]);
            }
        }
        out
    }
}

crate::operators! {
    [inline(always)] [] ComplexBatch;
    Add::add(x, y) {
        x.zip(y, |a, b, c, d| (a + c, b + d))
    }
    Sub::sub(x, y) {
        x.zip(y, |a, b, c, d| (a - c, b - d))
    }
    Mul::mul(x, y) {
        x.zip(y, |a, b, c, d| (a * c - b * d, a * d + b * c))
    }
    Neg::neg(x) {
        x.map(|re, im| (-re, -im))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn agrees_with_scalar_complex_numbers() {
        let mut rng = Rng::new(1);
        let mut draw = || ComplexBatch {
            re: std::array::from_fn(|_| rng.normal()),
            im: std::array::from_fn(|_| rng.normal()),
        };
        let (x, y) = (draw(), draw());
        let choice = std::array::from_fn(|k| k % 3 == 0);
        for k in 0..LANES {
            let (a, b) = (x.lane(k), y.lane(k));
            let same =
                |z: ComplexBatch, w: Complex64| assert!((z.lane(k) - w).norm() < 1e-14 * (1.0 + w.norm()));
            same(x + y, a + b);
            same(x - y, a - b);
            same(x * y, a * b);
            same(x.reciprocal(), a.inv());
            same(x.plus(2.0).times(3.0), (a + 2.0) * 3.0);
            same(x.sqrt() * x.sqrt(), a);
            same(x.select(y, choice), if k % 3 == 0 { a } else { b });
            assert!(x.sqrt().re[k] >= 0.0);
        }
        assert!(ComplexBatch::ZERO.sqrt().norm_sqr().iter().all(|n| *n < 1e-300));
        let square = ComplexBatch::real(-4.0).sqrt();
        assert!(square.re[0].abs() < 1e-15 && (square.im[0].abs() - 2.0).abs() < 1e-15);
    }
}
