//! The arithmetic that distances are computed in.

use std::fmt::Debug;

use num_complex::Complex64;

/// A commutative ring with as much division as it has: floating-point numbers, or exact algebras in which squared
/// distances are elements.
///
/// Constants are made beside an element, because the elements of an algebra know which one they belong to.
pub trait Scalar: Clone + Debug {
    /// The integer `n` in the ring of `self`.
    #[must_use]
    fn integer(&self, n: i64) -> Self;

    /// `self + other`.
    #[must_use]
    fn plus(&self, other: &Self) -> Self;

    /// `self - other`.
    #[must_use]
    fn minus(&self, other: &Self) -> Self;

    /// `self * other`.
    #[must_use]
    fn times(&self, other: &Self) -> Self;

    /// `self / other`; `None` when `other` is zero or divides zero (for floating-point numbers: exactly zero).
    #[must_use]
    fn over(&self, other: &Self) -> Option<Self>;

    /// Zero in the ring of `self`.
    #[must_use]
    fn zero(&self) -> Self {
        self.integer(0)
    }

    /// One in the ring of `self`.
    #[must_use]
    fn one(&self) -> Self {
        self.integer(1)
    }

    /// `-self`.
    #[must_use]
    fn negated(&self) -> Self {
        self.zero().minus(self)
    }
}

impl Scalar for f64 {
    fn integer(&self, n: i64) -> Self {
        n as f64
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn over(&self, other: &Self) -> Option<Self> {
        (other.abs() > 0.0).then(|| self / other)
    }
}

impl Scalar for Complex64 {
    fn integer(&self, n: i64) -> Self {
        Self::from(n as f64)
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn over(&self, other: &Self) -> Option<Self> {
        (other.norm_sqr() > 0.0).then(|| self / other)
    }
}
