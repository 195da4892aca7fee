//! Reals with an error bound, centre and radius: faster than intervals where many small sums and products are taken.
//!
//! Every operation rounds its centre to nearest and adds more than that can cost to the radius: half a unit in the last place is at most
//! `EPSILON / 2` of the rounded number, or of the smallest normal number where it underflows.

use std::ops::{Add, Mul, Sub};

use crate::num::interval::Interval;

/// The reals within `r` of `c`. A radius that is infinite or no number means that nothing is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub(super) c: f64,
    pub(super) r: f64,
}

/// More than the relative error of eight roundings.
const ROUNDED: f64 = 1.0 + 8.0 * f64::EPSILON;

impl Ball {
    pub(super) const ZERO: Self = Self { c: 0.0, r: 0.0 };

    pub(super) fn point(c: f64) -> Self {
        Self { c, r: 0.0 }
    }

    /// Twice the number, exactly.
    pub(super) fn twice(self) -> Self {
        Self { c: 2.0 * self.c, r: 2.0 * self.r }
    }

    /// Upper bound.
    pub(super) fn high(self) -> f64 {
        (self.c + self.r).next_up()
    }

    pub(super) fn square(self) -> Self {
        self * self
    }

    /// Square root; `None` unless all numbers are above zero.
    pub(super) fn root(self) -> Option<Self> {
        let low = (self.c - self.r).next_down();
        if !(low > 0.0) {
            return None;
        }
        Some(Interval::new(low, self.high())?.sqrt()?.into())
    }

    /// `1 / x`; `None` unless all numbers are above zero.
    pub(super) fn inverse(self) -> Option<Self> {
        let (low, high) = ((self.c - self.r).next_down(), self.high());
        if !(low > f64::MIN_POSITIVE && high < f64::MAX) {
            return None;
        }
        let range = Interval::new((1.0 / high).next_down(), (1.0 / low).next_up())?;
        Some(range.into())
    }
}

impl From<Interval> for Ball {
    fn from(x: Interval) -> Self {
        let (c, r) = x.centre_and_radius();
        Self { c, r }
    }
}

impl Add for Ball {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let c = self.c + other.c;
        Self { c, r: (self.r + other.r + c.abs() * f64::EPSILON) * ROUNDED }
    }
}

impl Sub for Ball {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Self { c: -other.c, r: other.r }
    }
}

impl Mul for Ball {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let c = self.c * other.c;
        let spread = self.c.abs() * other.r + self.r * (other.c.abs() + other.r);
        Self { c, r: (spread + c.abs() * f64::EPSILON + f64::MIN_POSITIVE) * ROUNDED }
    }
}

/// `a . b`.
pub(super) fn dot(a: &[Ball; 6], b: &[Ball; 6]) -> Ball {
    let mut sum = a[0] * b[0];
    for k in 1..6 {
        sum = sum + a[k] * b[k];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;
    use crate::num::exact::{Rational, rational};

    fn holds(b: Ball, x: &Rational) -> bool {
        let exact = |x: f64| rational(x).unwrap();
        exact(b.c) - exact(b.r) <= *x && *x <= exact(b.c) + exact(b.r)
    }

    #[test]
    fn results_hold_the_exact_ones_and_are_not_much_wider() {
        let mut rng = Rng::new(3);
        for _ in 0..2000 {
            let mut draw = || {
                let c = rng.normal() * 10f64.powf(rng.uniform(-9.0, 9.0));
                let r = c.abs() * 10f64.powf(rng.uniform(-17.0, 0.0));
                // a number of the ball, as a rational
                let inside =
                    rational(c).unwrap() + rational(r).unwrap() * rational(rng.uniform(-1.0, 1.0)).unwrap();
                (Ball { c, r }, inside)
            };
            let ((a, x), (b, y)) = (draw(), draw());
            assert!(holds(a + b, &(&x + &y)) && holds(a - b, &(&x - &y)) && holds(a * b, &(&x * &y)));
            let size = a.c.abs() + b.c.abs();
            assert!((a + b).r <= (a.r + b.r) * (1.0 + 1e-12) + 1e-15 * size);
            if a.c > 0.0
                && let Some(inverse) = a.inverse()
            {
                assert!(holds(inverse, &(rational(1.0).unwrap() / &x)));
            }
            if a.c > 0.0
                && let Some(root) = a.root()
            {
                let exact = |x: f64| rational(x).unwrap();
                let (low, high) = (exact(root.c) - exact(root.r), exact(root.c) + exact(root.r));
                assert!(&low * &low <= x && x <= &high * &high);
            }
        }
        assert!(Ball { c: 1.0, r: 1.5 }.inverse().is_none());
        assert!(Ball { c: 1.0, r: f64::NAN }.inverse().is_none());
        // the smallest numbers: the product underflows
        let tiny = Ball::point(5e-324);
        assert!(holds(tiny * tiny, &(rational(5e-324).unwrap() * rational(5e-324).unwrap())));
    }
}
