//! Number types for formulas with products: plain, enclosures, and both with derivatives.

use std::ops::Neg;

use super::interval::{self, Interval};
use super::jet::Jet;
use super::ordered::Sloped;
use super::vector::RingNumber;
pub use super::vector::{cross, dot};

/// Numbers with products and square roots.
pub trait SmoothNumber: RingNumber + Neg<Output = Self> {
    /// Constant factors.
    type Factor: From<f64>;

    /// An angle in radians.
    fn radians(degrees: f64) -> Self::Factor;
    /// A constant in the same variables.
    #[must_use]
    fn alike(&self, value: f64) -> Self;
    /// A multiple.
    #[must_use]
    fn times(&self, factor: Self::Factor) -> Self;
    /// `x^2`.
    #[must_use]
    fn square(&self) -> Self {
        *self * *self
    }
    /// `1 / sqrt(x)`, `None` unless `x` is positive.
    fn inverse_root(&self) -> Option<Self>;
}

impl SmoothNumber for f64 {
    type Factor = Self;

    fn radians(degrees: f64) -> Self {
        degrees.to_radians()
    }

    fn alike(&self, value: f64) -> Self {
        value
    }

    fn times(&self, factor: Self) -> Self {
        self * factor
    }

    fn inverse_root(&self) -> Option<Self> {
        (*self > 0.0).then(|| 1.0 / self.sqrt())
    }
}

impl SmoothNumber for Interval {
    type Factor = Self;

    fn radians(degrees: f64) -> Self {
        interval::radians(degrees)
    }

    fn alike(&self, value: f64) -> Self {
        Self::from(value)
    }

    fn times(&self, factor: Self) -> Self {
        *self * factor
    }

    fn square(&self) -> Self {
        Self::square(*self)
    }

    fn inverse_root(&self) -> Option<Self> {
        Self::from(1.0).checked_div(self.sqrt()?)
    }
}

impl SmoothNumber for Sloped {
    type Factor = f64;

    fn radians(degrees: f64) -> f64 {
        degrees.to_radians()
    }

    fn alike(&self, value: f64) -> Self {
        Self::from(value)
    }

    fn times(&self, factor: f64) -> Self {
        Self { value: self.value * factor, slope: self.slope * factor }
    }

    fn inverse_root(&self) -> Option<Self> {
        let value = self.value.inverse_root()?;
        Some(Self { value, slope: self.slope * (-0.5 * value / self.value) })
    }
}

impl SmoothNumber for Jet {
    type Factor = Interval;

    fn radians(degrees: f64) -> Interval {
        interval::radians(degrees)
    }

    fn alike(&self, value: f64) -> Self {
        Self::alike(self, Interval::from(value))
    }

    fn times(&self, factor: Interval) -> Self {
        Self::times(self, factor)
    }

    fn square(&self) -> Self {
        Self::square(self)
    }

    fn inverse_root(&self) -> Option<Self> {
        Self::inverse_root(self)
    }
}

/// `a . a`.
pub fn norm_squared<N: SmoothNumber>(a: &[N; 3]) -> N {
    a[0].square() + a[1].square() + a[2].square()
}
