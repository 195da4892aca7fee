//! Number types for formulas of margins: plain, with a gradient, and enclosures.

use std::ops::{Add, Sub};

use nalgebra::Vector3;

use super::interval::Interval;

/// Numbers with an order and a distance.
pub trait OrderedNumber: Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> {
    /// Its size.
    #[must_use]
    fn abs(self) -> Self;
    /// The greater one.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller one.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// `sqrt(x^2 + y^2 + z^2)`.
    fn norm(v: [Self; 3]) -> Self;
}

impl OrderedNumber for f64 {
    fn abs(self) -> Self {
        self.abs()
    }

    fn max(self, other: Self) -> Self {
        self.max(other)
    }

    fn min(self, other: Self) -> Self {
        self.min(other)
    }

    fn norm([x, y, z]: [Self; 3]) -> Self {
        (x * x + y * y + z * z).sqrt()
    }
}

/// The numbers between two ordered ends.
fn between(lo: f64, hi: f64) -> Interval {
    Interval::new(lo, hi).unwrap_or(Interval::WHOLE)
}

impl OrderedNumber for Interval {
    fn abs(self) -> Self {
        let least = if self.contains(0.0) { 0.0 } else { self.lo().abs().min(self.hi().abs()) };
        between(least, self.magnitude())
    }

    fn max(self, other: Self) -> Self {
        between(self.lo().max(other.lo()), self.hi().max(other.hi()))
    }

    fn min(self, other: Self) -> Self {
        between(self.lo().min(other.lo()), self.hi().min(other.hi()))
    }

    fn norm([x, y, z]: [Self; 3]) -> Self {
        (x.square() + y.square() + z.square()).sqrt().unwrap_or(Self::WHOLE)
    }
}

/// A value with its gradient by the coordinates of a point (Wengert 1964).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sloped {
    /// The value.
    pub value: f64,
    /// The gradient; a one-sided one at a kink.
    pub slope: Vector3<f64>,
}

impl Sloped {
    /// The coordinates of a point.
    #[must_use]
    pub fn point(at: &Vector3<f64>) -> [Self; 3] {
        std::array::from_fn(|k| Self { value: at[k], slope: Vector3::ith(k, 1.0) })
    }
}

impl From<f64> for Sloped {
    fn from(value: f64) -> Self {
        Self { value, slope: Vector3::zeros() }
    }
}

crate::operators! {
    [inline] [] Sloped;
    Add::add(x, y) {
        Self { value: x.value + y.value, slope: x.slope + y.slope }
    }
    Neg::neg(x) {
        Self { value: -x.value, slope: -x.slope }
    }
    Sub::sub(x, y) {
        x + -y
    }
    Mul::mul(x, y) {
        let slope = x.slope * y.value + y.slope * x.value;
        Self { value: x.value * y.value, slope }
    }
}

impl OrderedNumber for Sloped {
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }

    fn max(self, other: Self) -> Self {
        if self.value < other.value { other } else { self }
    }

    fn min(self, other: Self) -> Self {
        if other.value < self.value { other } else { self }
    }

    fn norm(v: [Self; 3]) -> Self {
        let value = f64::norm(v.map(|x| x.value));
        let slope = v.iter().map(|x| x.slope * x.value).sum::<Vector3<f64>>();
        Self { value, slope: if value > 0.0 { slope / value } else { slope } }
    }
}
