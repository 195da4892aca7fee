//! Discs of complex numbers: a centre and a radius that takes up every rounding error.
//!
//! Error analysis, with `u = 2^-53` and `|z|_1 = |re z| + |im z|`, which is computed without underflow and
//! satisfies `|z| <= |z|_1 <= sqrt 2 |z|`. Rounding to nearest gives each part of a sum relative error `u`;
//! each part of a product `ac - bd` error `2u(1+u)(|ac| + |bd|)`, so that the modulus of the product's error is at most
//! `2u(1+u) (|z|_1 |w|_1)`. The radii are sums and products of non-negative numbers in fewer than 60 operations,
//! hence computed with relative error below `61 u < 2^-40`; the factor `1 + 2^-40` makes them upper bounds again.
//! Underflow adds at most `2^-1074` an operation, which the `2^-900` added to radii covers as long as moduli stay below `2^100`.
//! A radius that is infinite or NaN says nothing and makes every test that would prove something fail.

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

/// Factor that turns a computed sum of non-negative terms into an upper bound: `1 + 2^-40`.
pub(crate) const UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;
/// More than what underflow can add up to in a computation with numbers below `2^100`: `2^-900`.
pub(crate) const TINY: f64 = f64::from_bits((1023 - 900) << 52);
const U: f64 = f64::EPSILON / 2.0;

/// All `z` with `|z - centre| <= radius`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Centre.
    pub centre: Complex64,
    /// Radius; infinite or NaN means that nothing is known.
    pub radius: f64,
}

/// `|z| <= |z|_1`.
fn size(z: Complex64) -> f64 {
    z.re.abs() + z.im.abs()
}

impl Disc {
    /// The single number `z`.
    #[must_use]
    pub fn point(z: Complex64) -> Self {
        Self { centre: z, radius: 0.0 }
    }

    /// Upper bound of the moduli in the disc.
    #[must_use]
    pub fn magnitude(&self) -> f64 {
        (size(self.centre) + self.radius) * UP
    }

    /// Lower bound of the moduli in the disc, zero when it may hold zero.
    #[must_use]
    pub fn mignitude(&self) -> f64 {
        let low = lower_modulus(self.centre) - self.radius * UP;
        if low > 0.0 { low.next_down() } else { 0.0 }
    }

    /// Proves that no number is in both discs.
    #[must_use]
    pub fn is_disjoint(&self, other: &Self) -> bool {
        let gap = self.centre - other.centre; // each part with relative error u
        lower_modulus(gap) > (self.radius + other.radius) * UP
    }

    /// Proves that no number of the disc is real.
    #[must_use]
    pub fn excludes_reals(&self) -> bool {
        self.centre.im.abs() > self.radius
    }

    /// Proves that `z` lies in the disc.
    #[must_use]
    pub fn contains(&self, z: Complex64) -> bool {
        size(z - self.centre) * UP <= self.radius || (z - self.centre).norm() * UP <= self.radius
    }

    /// Encloses `1 / z`, `None` when the disc may hold zero.
    ///
    /// `|1/z - 1/c| = |z - c| / (|z| |c|)`; the computed `1/c = conj(c) / |c|^2` has relative error below `8u`.
    #[must_use]
    pub fn reciprocal(&self) -> Option<Self> {
        let low = self.mignitude();
        if low > TINY && self.centre.norm_sqr() > TINY {
            let centre = self.centre.conj() / self.centre.norm_sqr();
            let radius =
                (self.radius / (lower_modulus(self.centre) * low) + 8.0 * U * size(centre) + TINY) * UP;
            return Some(Self { centre, radius });
        }
        None
    }

    /// Product with a power of two, exact barring overflow and underflow.
    #[must_use]
    pub fn scaled(&self, power_of_two: f64) -> Self {
        Self { centre: self.centre * power_of_two, radius: self.radius * power_of_two }
    }
}

/// Below `|z|` although computed: `max` part when the squares could underflow, else the norm less `2^-40` of it.
fn lower_modulus(z: Complex64) -> f64 {
    let square = z.norm_sqr();
    if square > TINY && square.is_finite() {
        square.sqrt() * (2.0 - UP)
    } else {
        z.re.abs().max(z.im.abs()) * (2.0 - UP)
    }
}

impl Neg for Disc {
    type Output = Self;
    fn neg(self) -> Self {
        Self { centre: -self.centre, radius: self.radius }
    }
}

impl Add for Disc {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let centre = self.centre + other.centre;
        Self { centre, radius: (self.radius + other.radius + U * size(centre) + TINY) * UP }
    }
}

impl Sub for Disc {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Disc {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (z, w) = (size(self.centre), size(other.centre));
        let (r, t) = (self.radius, other.radius);
        let radius = (z * t + r * (w + t) + 3.0 * U * z * w + TINY) * UP;
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

    fn lift(z: Complex64) -> Pair {
        (exact(z.re), exact(z.im))
    }

    fn holds(d: &Disc, (re, im): &Pair) -> bool {
        let (x, y) = (re - exact(d.centre.re), im - exact(d.centre.im));
        &x * &x + &y * &y <= exact(d.radius) * exact(d.radius)
    }

    fn random(rng: &mut Rng) -> (Disc, Complex64) {
        let scale = 10f64.powi((rng.next_u64() % 7) as i32 - 3);
        let centre = Complex64::new(rng.normal(), rng.normal()) * scale;
        let radius = if rng.next_u64().is_multiple_of(2) { 0.0 } else { 1e-3 * rng.unit() * scale };
        let member = centre + Complex64::from_polar(radius * 0.999, rng.uniform(0.0, 6.0));
        (Disc { centre, radius }, if radius == 0.0 { centre } else { member })
    }

    #[test]
    fn operations_enclose_the_exact_result() {
        let mut rng = Rng::new(31);
        for _ in 0..500 {
            let ((a, x), (b, y)) = (random(&mut rng), random(&mut rng));
            let ((xr, xi), (yr, yi)) = (lift(x), lift(y));
            assert!(holds(&(a + b), &(&xr + &yr, &xi + &yi)) && holds(&(a - b), &(&xr - &yr, &xi - &yi)));
            let product = (&xr * &yr - &xi * &yi, &xr * &yi + &xi * &yr);
            assert!(holds(&(a * b), &product));
            let n = &xr * &xr + &xi * &xi;
            if let Some(inverse) = a.reciprocal() {
                assert!(holds(&inverse, &(&xr / &n, -&xi / &n)));
            }
            assert!(
                exact(a.magnitude()) * exact(a.magnitude()) >= n
                    && exact(a.mignitude()) * exact(a.mignitude()) <= n
            );
            assert!(a.contains(x) && !(a - b).is_disjoint(&Disc::point(x - y)));
        }
    }

    #[test]
    fn disjointness_and_reality_are_proved_only_when_true() {
        let disc = |re, im, radius| Disc { centre: Complex64::new(re, im), radius };
        assert!(disc(0.0, 0.0, 1.0).is_disjoint(&disc(2.1, 0.0, 1.0)));
        assert!(!disc(0.0, 0.0, 1.0).is_disjoint(&disc(2.0, 0.0, 1.0)));
        assert!(!disc(0.0, 0.0, f64::NAN).is_disjoint(&disc(9.0, 0.0, 1.0)));
        assert!(!disc(0.0, 9.0, f64::NAN).excludes_reals() && disc(0.0, 9.0, 8.0).excludes_reals());
        assert!(disc(1.0, 0.0, 1.0).reciprocal().is_none() && disc(1e-200, 0.0, 0.0).reciprocal().is_none());
        assert!(disc(3e-320, 0.0, 0.0).is_disjoint(&disc(0.0, 0.0, 0.0)));
    }
}
