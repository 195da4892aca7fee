//! Complex numbers with parts of any type.
//!
//! Complex numbers in double are those of `num_complex`. Its generic type requires remainders and parsing of its parts,
//! which double-double and octuple numbers lack. This type requires only sums and products.

use std::ops::{Add, Div, Mul, Neg, Sub};

use num_complex::Complex64;

/// `re + i im`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Complex<T> {
    /// Real part.
    pub re: T,
    /// Imaginary part.
    pub im: T,
}

impl<T: Copy + Neg<Output = T> + Add<Output = T> + Mul<Output = T>> Complex<T> {
    /// The complex conjugate.
    #[must_use]
    pub fn conj(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// The square of the modulus.
    #[must_use]
    pub fn norm_sqr(self) -> T {
        self.re * self.re + self.im * self.im
    }

    /// Product with a real number.
    #[must_use]
    pub fn times(self, k: T) -> Self {
        Self { re: self.re * k, im: self.im * k }
    }
}

impl<T: From<f64>> From<Complex64> for Complex<T> {
    fn from(z: Complex64) -> Self {
        Self { re: z.re.into(), im: z.im.into() }
    }
}

impl<T: Neg<Output = T>> Neg for Complex<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl<T: Add<Output = T>> Add for Complex<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<T: Sub<Output = T>> Sub for Complex<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl<T> Div for Complex<T>
where
    T: Copy + Neg<Output = T> + Add<Output = T> + Sub<Output = T> + Mul<Output = T> + Div<Output = T>,
{
    type Output = Self;
    /// `z conj(w) / |w|^2`: accurate relative to `|z / w|`, not in each part by itself.
    fn div(self, other: Self) -> Self {
        let n = other.norm_sqr();
        let z = self * other.conj();
        Self { re: z.re / n, im: z.im / n }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn arithmetic_is_that_of_num_complex() {
        let rng = &mut Rng::new(9);
        for _ in 0..100 {
            let mut draw = || Complex64::new(rng.normal(), rng.normal());
            let (z, w) = (draw(), draw());
            let (a, b) = (Complex::<f64>::from(z), Complex::<f64>::from(w));
            let near =
                |x: Complex<f64>, y: Complex64| (x.re - y.re).hypot(x.im - y.im) <= 1e-14 * (1.0 + y.norm());
            assert!(near(a + b, z + w) && near(a - b, z - w) && near(a * b, z * w) && near(a / b, z / w));
            assert!(near(-a, -z) && near(a.conj(), z.conj()) && near(a.times(3.0), z * 3.0));
            assert!((a.norm_sqr() - z.norm_sqr()).abs() <= 1e-14 * z.norm_sqr());
        }
    }
}
