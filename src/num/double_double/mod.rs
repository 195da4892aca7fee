//! Double-double arithmetic: a real number as the unevaluated sum `hi + lo` of two doubles, about 32 digits.
//!
//! The error-free transforms are those of Dekker (1971) and Knuth (TAOCP 2, 4.2.2). Algorithms and bounds of the
//! operations are from Joldes, Muller, Popescu (ACM TOMS 44, 2017). With `u = 2^-53` their relative errors are
//!
//! | operation | algorithm | bound |
//! |---|---|---|
//! | `+`, `-` | accurate sum of two double-doubles | `3 u^2 + 13 u^3` |
//! | `*` | product with the low parts' cross terms | `7 u^2` |
//! | `/` | two quotient digits | `15 u^2 + 56 u^3` |
//!
//! all below [`DoubleDouble::UNIT`] `= 2^-102 = 16 u^2`, without overflow and underflow. Operands and results between
//! `2^-400` and `2^400` in modulus, or zero, are safe (low parts of products then stay normal). Results do not depend
//! on a fused multiply-add: the exact product is Dekker's unless the target has one.

use num_complex::Complex64;

use super::complex::Complex;

/// An unevaluated sum `hi + lo` with `hi = fl(hi + lo)`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// `a + b = s + t` exactly, `s = fl(a + b)` (Knuth; any order of magnitudes, no overflow).
#[must_use]
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// `a + b = s + t` exactly provided `|a| >= |b|` or `a = 0` (Dekker).
#[inline]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// Veltkamp's split into two halves of at most 26 bits each; exact for `|a| < 2^996`.
#[inline]
fn split(a: f64) -> (f64, f64) {
    const FACTOR: f64 = 134_217_729.0; // 2^27 + 1
    let t = FACTOR * a;
    let high = t - (t - a);
    (high, a - high)
}

/// `a b = p + e` exactly, `p = fl(a b)`; needs `|a|, |b| < 2^996` and `|a b|` zero or in `[2^-960, 2^1020]`.
#[must_use]
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    if cfg!(target_feature = "fma") {
        return (p, a.mul_add(b, -p)); // the error is representable, so the fused operation returns it
    }
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (p, al * bl - (((p - ah * bh) - al * bh) - ah * bl))
}

impl DoubleDouble {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    /// One.
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };
    /// Relative error bound of every operation, see the module's table.
    pub const UNIT: f64 = 16.0 * f64::EPSILON * f64::EPSILON / 4.0;

    /// The exact sum of two doubles.
    #[must_use]
    #[inline]
    pub fn from_sum(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, b);
        Self { hi, lo }
    }

    /// The exact product of two doubles (in the range of [`two_product`]).
    #[must_use]
    #[inline]
    pub fn from_product(a: f64, b: f64) -> Self {
        let (hi, lo) = two_product(a, b);
        Self { hi, lo }
    }

    /// The nearest double.
    #[must_use]
    #[inline]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// The remainder beside the nearest double, at most half a unit in its last place.
    #[must_use]
    #[inline]
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// Product with a power of two: exact barring overflow and underflow.
    #[must_use]
    #[inline]
    pub fn scaled(self, power_of_two: f64) -> Self {
        Self { hi: self.hi * power_of_two, lo: self.lo * power_of_two }
    }

    /// Absolute value, exact.
    #[must_use]
    #[inline]
    pub fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }
}

crate::operators! {
    [inline] [] DoubleDouble;
    Neg::neg(x) {
        Self { hi: -x.hi, lo: -x.lo }
    }
    Add::add(x, y) {
        let (sh, sl) = two_sum(x.hi, y.hi);
        let (th, tl) = two_sum(x.lo, y.lo);
        let (vh, vl) = fast_two_sum(sh, sl + th);
        let (hi, lo) = fast_two_sum(vh, tl + vl);
        Self { hi, lo }
    }
    Sub::sub(x, y) {
        x + -y
    }
    Mul::mul(x, y) {
        let (ch, cl) = two_product(x.hi, y.hi);
        let cross = x.hi * y.lo + x.lo * y.hi;
        let (hi, lo) = fast_two_sum(ch, cl + cross);
        Self { hi, lo }
    }
    Div::div(x, y) {
        // q1 = first quotient digit, remainder computed with an exact product, q2 = second digit
        let q1 = x.hi / y.hi;
        let (ph, pl) = two_product(y.hi, q1);
        let product_low = pl + y.lo * q1;
        let (rh, rl) = fast_two_sum(ph, product_low);
        let (dh, dl) = ((x.hi - rh), (x.lo - rl));
        let (hi, lo) = fast_two_sum(q1, (dh + dl) / y.hi);
        Self { hi, lo }
    }
}

/// A complex number with double-double parts.
///
/// Sums have relative error [`DoubleDouble::UNIT`] in each part; a product has error at most
/// `3 UNIT |z| |w|` in each part (two products and one sum).
pub type ComplexDoubleDouble = Complex<DoubleDouble>;

impl ComplexDoubleDouble {
    /// Zero.
    pub const ZERO: Self = Self { re: DoubleDouble::ZERO, im: DoubleDouble::ZERO };

    /// The nearest double in each part.
    #[must_use]
    #[inline]
    pub fn hi(self) -> Complex64 {
        Complex64::new(self.re.hi, self.im.hi)
    }

    /// The remainder beside [`hi`](Self::hi).
    #[must_use]
    #[inline]
    pub fn lo(self) -> Complex64 {
        Complex64::new(self.re.lo, self.im.lo)
    }

    /// Product with a power of two: exact barring overflow and underflow.
    #[must_use]
    #[inline]
    pub fn scaled(self, power_of_two: f64) -> Self {
        Self { re: self.re.scaled(power_of_two), im: self.im.scaled(power_of_two) }
    }
}

#[cfg(test)]
mod tests;
