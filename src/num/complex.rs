//! Complex numbers with parts of any type.
//!
//! Complex numbers in double are those of `num_complex`. Its generic type requires remainders and parsing of its parts,
//! which double-double and octuple numbers lack. This type requires only sums and products.

use std::ops::{Div, Neg};

use num_complex::Complex64;

use super::vector::RingNumber;

/// `re + i im`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Complex<T> {
    /// Real part.
    pub re: T,
    /// Imaginary part.
    pub im: T,
}

impl<T: RingNumber + Neg<Output = T>> Complex<T> {
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

crate::operators! {
    [inline] [T: RingNumber + Neg<Output = T>] Complex<T>;
    Neg::neg(x) {
        Self { re: -x.re, im: -x.im }
    }
    Add::add(x, y) {
        Self { re: x.re + y.re, im: x.im + y.im }
    }
    Sub::sub(x, y) {
        Self { re: x.re - y.re, im: x.im - y.im }
    }
    Mul::mul(x, y) {
        Self { re: x.re * y.re - x.im * y.im, im: x.re * y.im + x.im * y.re }
    }
}

crate::operators! {
    [inline] [T: RingNumber + Neg<Output = T> + Div<Output = T>] Complex<T>;
    // `z conj(w) / |w|^2`: accurate relative to `|z / w|`, not in each part by itself.
    Div::div(x, y) {
        let n = y.norm_sqr();
        let z = x * y.conj();
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
