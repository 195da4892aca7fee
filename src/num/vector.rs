//! Vectors of three coordinates in any kind of number.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use std::ops::{Add, Mul, Sub};

/// A number that can be copied, added, subtracted and multiplied.
pub trait RingNumber: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> RingNumber for T {}

/// `a . b`, without conjugation.
#[inline(always)]
pub fn dot<T: RingNumber>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a x b`.
#[inline(always)]
pub fn cross<T: RingNumber>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a - b`.
#[inline(always)]
pub fn minus<T: RingNumber>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
