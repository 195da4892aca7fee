//! Discs of complex numbers about centres in double-double.
//!
//! As [`Disc`], with the unit of double-double `U = `[`DoubleDouble::UNIT`] for that of double. A sum has relative error `U` in each part. Each part of a product
//! `ac - bd` takes two products and a sum, error at most `2 U (1 + U) (|ac| + |bd|)`, together below `3 U |z|_1 |w|_1`. `1 / z = conj z / |z|^2` takes a
//! product, a sum without cancellation and a quotient: below `4 U |1/z|_1`. Radii are computed in double from fewer than 60 numbers that are not negative, which
//! `1 + 2^-40` takes up; moduli of centres are those of their leading doubles, off by `2^-53` of themselves, which it takes up too. Low parts that underflow lose less than
//! the `2^-900` added, as long as moduli stay below `2^100`.

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use super::disc::{Disc, TINY, UP};
use super::double_double::{ComplexDoubleDouble, DoubleDouble};

const U: f64 = DoubleDouble::UNIT;

/// All `z` with `|z - centre| <= radius`; an infinite or NaN radius says nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WideDisc {
    pub(crate) centre: ComplexDoubleDouble,
    pub(crate) radius: f64,
}

/// `|z| <= |z|_1`, up to the rounding that `UP` takes up.
fn size(z: ComplexDoubleDouble) -> f64 {
    let z: Complex64 = z.hi();
    z.re.abs() + z.im.abs()
}

impl WideDisc {
    /// All `z` with `|z - hi - low| <= radius`.
    pub(crate) fn about(hi: Complex64, low: Complex64, radius: f64) -> Self {
        let centre = ComplexDoubleDouble {
            re: DoubleDouble::from_sum(hi.re, low.re),
            im: DoubleDouble::from_sum(hi.im, low.im),
        };
        Self { centre, radius }
    }

    /// A disc about a double that holds this one.
    pub(crate) fn rounded(&self) -> Disc {
        let low = self.centre.lo();
        Disc { centre: self.centre.hi(), radius: (self.radius + (low.re.abs() + low.im.abs())) * UP }
    }

    /// Proves that no number is in both discs.
    pub(crate) fn is_disjoint(&self, other: &Self) -> bool {
        Disc::point(Complex64::ZERO).is_disjoint(&(*self - *other).rounded())
    }

    /// Encloses `1 / z`, `None` when the disc may hold zero: `|1/z - 1/c| = |z - c| / (|z| |c|)`.
    pub(crate) fn reciprocal(&self) -> Option<Self> {
        let c = self.centre;
        let square = c.hi().norm_sqr();
        if !(square > TINY && square.is_finite()) {
            return None;
        }
        let modulus = square.sqrt() * (2.0 - UP);
        let low = (modulus - self.radius * UP) * (2.0 - UP);
        if !(low > TINY) {
            return None;
        }
        let n = c.re * c.re + c.im * c.im;
        let centre = ComplexDoubleDouble { re: c.re / n, im: -c.im / n };
        Some(Self { centre, radius: (self.radius / (modulus * low) + 8.0 * U * size(centre) + TINY) * UP })
    }

    /// Product with a power of two, exact barring overflow and underflow.
    pub(crate) fn scaled(&self, power_of_two: f64) -> Self {
        Self { centre: self.centre.scaled(power_of_two), radius: self.radius * power_of_two }
    }
}

impl Neg for WideDisc {
    type Output = Self;
    fn neg(self) -> Self {
        Self { centre: -self.centre, radius: self.radius }
    }
}

impl Add for WideDisc {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let centre = self.centre + other.centre;
        Self { centre, radius: (self.radius + other.radius + 2.0 * U * size(centre) + TINY) * UP }
    }
}

impl Sub for WideDisc {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for WideDisc {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (z, w) = (size(self.centre), size(other.centre));
        let (r, t) = (self.radius, other.radius);
        let radius = (z * t + r * (w + t) + 4.0 * U * z * w + TINY) * UP;
        Self { centre: self.centre * other.centre, radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;
    use num_rational::BigRational;

    type Pair = (BigRational, BigRational);

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).unwrap()
    }

    fn lift(z: ComplexDoubleDouble) -> Pair {
        let value = |d: DoubleDouble| exact(d.hi()) + exact(d.lo());
        (value(z.re), value(z.im))
    }

    fn gap((a, b): &Pair, (c, d): &Pair) -> BigRational {
        (a - c) * (a - c) + (b - d) * (b - d)
    }

    fn holds(d: &WideDisc, z: &Pair) -> bool {
        gap(&lift(d.centre), z) <= exact(d.radius) * exact(d.radius)
    }

    /// A disc and a number in it.
    fn random(rng: &mut Rng) -> (WideDisc, Pair) {
        let scale = 10f64.powi((rng.next_u64() % 7) as i32 - 3);
        let mut part = || Complex64::new(rng.normal(), rng.normal()) * scale;
        let (hi, low) = (part(), part() * 1e-17);
        let radius = if rng.next_u64().is_multiple_of(2) { 0.0 } else { 1e-20 * rng.unit() * scale };
        let d = WideDisc::about(hi, low, radius);
        let away = Complex64::from_polar(radius * 0.999, rng.uniform(0.0, 6.0));
        let (re, im) = lift(d.centre);
        (d, (re + exact(away.re), im + exact(away.im)))
    }

    #[test]
    fn operations_enclose_the_exact_result() {
        let mut rng = Rng::new(32);
        for _ in 0..300 {
            let ((a, (xr, xi)), (b, (yr, yi))) = (random(&mut rng), random(&mut rng));
            assert!(holds(&(a + b), &(&xr + &yr, &xi + &yi)) && holds(&(a - b), &(&xr - &yr, &xi - &yi)));
            let product = a * b;
            assert!(holds(&product, &(&xr * &yr - &xi * &yi, &xr * &yi + &xi * &yr)));
            let n = &xr * &xr + &xi * &xi;
            let inverse = a.reciprocal().unwrap();
            assert!(holds(&inverse, &(&xr / &n, -&xi / &n)));
            let rounded = a.rounded();
            let centre = (exact(rounded.centre.re), exact(rounded.centre.im));
            assert!(gap(&centre, &(xr.clone(), xi.clone())) <= exact(rounded.radius) * exact(rounded.radius));
            assert!(!a.is_disjoint(&a), "{a:?}");
            // the enclosures are of use: some 30 digits
            let exact_factors = a.radius + b.radius <= 0.0;
            assert!(!exact_factors || product.radius < 1e-28 * size(product.centre));
        }
    }

    #[test]
    fn numbers_that_differ_in_the_twentieth_digit_are_told_apart() {
        let one = Complex64::new(1.0, 0.0);
        let disc = |low: f64, radius| WideDisc::about(one, Complex64::new(low, 0.0), radius);
        assert!(disc(1e-20, 1e-22).is_disjoint(&disc(0.0, 1e-22)));
        assert!(!disc(1e-20, 1e-20).is_disjoint(&disc(0.0, 1e-22)));
        assert!(!disc(1e-20, f64::NAN).is_disjoint(&disc(0.0, 0.0)));
        assert!(disc(0.0, 1.0).reciprocal().is_none());
    }
}
