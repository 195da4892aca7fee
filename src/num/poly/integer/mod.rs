//! Polynomials with integer coefficients of any size, exactly.

mod complex_roots;
mod dyadic;
mod gcd;
mod isolate;
mod kronecker;
mod modular;
mod sturm;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Zero};

pub use complex_roots::{ComplexRoot, NotSeparated, complex_roots};
pub use dyadic::Dyadic;
pub use gcd::{SquarefreeFactor, gcd, squarefree_factors};
pub use isolate::{RealRoot, real_roots};
pub use sturm::{sturm_count, sturm_count_of_line};

/// `c_0 + c_1 x + .. + c_n x^n` with integer coefficients, `c_n != 0`.
///
/// The zero polynomial has no coefficients and no degree. Products use Kronecker substitution, so that they cost one
/// product of large integers.
///
/// ```
/// # mod equipod { pub use equipod_num::Cancel; pub mod methods { pub use equipod_num::poly; } }
/// use equipod::methods::poly::IntPoly;
/// let p = IntPoly::from_i64(&[-1, 1]); // x - 1
/// let q = IntPoly::from_i64(&[2, 1]); // x + 2
/// assert_eq!(&p * &q, IntPoly::from_i64(&[-2, 1, 1]));
/// assert_eq!((&p * &q).exact_div(&q), Some(p));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct IntPoly(Vec<BigInt>);

impl IntPoly {
    /// From coefficients, the constant one first; zeros at the end are dropped.
    #[must_use]
    pub fn new(mut coefficients: Vec<BigInt>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// From small coefficients, the constant one first.
    #[must_use]
    pub fn from_i64(coefficients: &[i64]) -> Self {
        Self::new(coefficients.iter().map(|c| BigInt::from(*c)).collect())
    }

    /// A constant.
    #[must_use]
    pub fn constant(value: BigInt) -> Self {
        Self::new(vec![value])
    }

    /// The unknown.
    #[must_use]
    pub fn x() -> Self {
        Self::from_i64(&[0, 1])
    }

    /// The coefficients, the constant one first.
    #[must_use]
    pub fn coefficients(&self) -> &[BigInt] {
        &self.0
    }

    /// The degree, `None` for the zero polynomial.
    #[must_use]
    pub fn degree(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }

    /// Whether this is the zero polynomial.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The coefficient of the highest power, zero for the zero polynomial.
    #[must_use]
    pub fn leading(&self) -> BigInt {
        self.0.last().cloned().unwrap_or_default()
    }

    /// Bits of the largest coefficient.
    #[must_use]
    pub fn bits(&self) -> u64 {
        self.0.iter().map(BigInt::bits).max().unwrap_or(0)
    }

    /// The greatest common divisor of the coefficients, non-negative.
    #[must_use]
    pub fn content(&self) -> BigInt {
        let mut smallest_first: Vec<&BigInt> = self.0.iter().collect();
        smallest_first.sort_by_key(|c| c.bits());
        let mut found = BigInt::zero();
        for c in smallest_first {
            if found.is_one() {
                break;
            }
            // the remainder first, since the binary algorithm is slow for numbers of very different size
            found = if found.is_zero() { found.gcd(c) } else { found.gcd(&(c % &found)) };
        }
        found
    }

    /// The polynomial divided by its content, with a positive leading coefficient.
    #[must_use]
    pub fn primitive(&self) -> Self {
        let content = self.content();
        if content.is_zero() {
            return self.clone();
        }
        let divisor = if self.leading().sign() == Sign::Minus { -content } else { content };
        if divisor.is_one() {
            return self.clone();
        }
        Self(self.0.iter().map(|c| c / &divisor).collect())
    }

    /// The derivative.
    #[must_use]
    pub fn derivative(&self) -> Self {
        Self::new(self.0.iter().enumerate().skip(1).map(|(k, c)| c * k).collect())
    }

    /// Every coefficient times `factor`.
    #[must_use]
    pub fn scaled(&self, factor: &BigInt) -> Self {
        Self::new(self.0.iter().map(|c| c * factor).collect())
    }

    /// `p(-x)`.
    #[must_use]
    pub fn reflected(&self) -> Self {
        let sign = |(k, c): (usize, &BigInt)| if k % 2 == 1 { -c } else { c.clone() };
        Self(self.0.iter().enumerate().map(sign).collect())
    }

    /// `self / divisor` if that is a polynomial with integer coefficients; otherwise `None`, also for `divisor = 0`.
    #[must_use]
    pub fn exact_div(&self, divisor: &Self) -> Option<Self> {
        let n = divisor.degree()?;
        if self.is_zero() {
            return Some(Self::default());
        }
        let count = (self.0.len()).checked_sub(n)?;
        if !modular::may_divide(divisor, self) {
            return None;
        }
        let mut rest = self.0.clone();
        let mut quotient = vec![BigInt::zero(); count];
        let lead = divisor.leading();
        for k in (0..count).rev() {
            let (q, r) = rest[k + n].div_rem(&lead);
            if !r.is_zero() {
                return None;
            }
            for (j, d) in divisor.0.iter().enumerate() {
                rest[k + j] -= &q * d;
            }
            quotient[k] = q;
        }
        rest.iter().all(Zero::is_zero).then(|| Self::new(quotient))
    }

    /// The sign of the value at a dyadic number, exactly.
    #[must_use]
    pub fn sign_at(&self, x: &Dyadic) -> Sign {
        self.value_at(x).sign()
    }

    /// The value at a dyadic number times a positive power of two.
    fn value_at(&self, x: &Dyadic) -> BigInt {
        let (m, e) = (x.mantissa(), x.exponent());
        let mut value = BigInt::zero();
        if e >= 0 {
            let x = m << e.unsigned_abs();
            for c in self.0.iter().rev() {
                value = value * &x + c;
            }
        } else {
            let e = e.unsigned_abs();
            for (k, c) in self.0.iter().rev().enumerate() {
                value = value * m + (c << (e * k as u64));
            }
        }
        value
    }

    /// `2^(n k) p(x / 2^k)`, or `p(2^-k x)` for `k < 0`: the roots times `2^k`.
    pub fn stretched(&self, k: i64) -> Self {
        let n = self.0.len().saturating_sub(1);
        let shift = |(i, c): (usize, &BigInt)| {
            let places = if k >= 0 { n - i } else { i };
            c << (k.unsigned_abs() * places as u64)
        };
        Self(self.0.iter().enumerate().map(shift).collect())
    }

    /// `p(x + 1)`.
    fn shifted_by_one(&self) -> Self {
        let mut c = self.0.clone();
        let n = c.len();
        for i in 0..n {
            for j in (i..n.saturating_sub(1)).rev() {
                let (low, high) = c.split_at_mut(j + 1);
                low[j] += &high[0];
            }
        }
        Self(c)
    }

    /// `x^n p(1/x)`.
    fn reversed(&self) -> Self {
        Self::new(self.0.iter().rev().cloned().collect())
    }

    /// A small `k` such that all roots have moduli below `2^k` (Fujiwara 1916, in powers of two).
    fn root_bound(&self) -> i64 {
        let n = self.0.len() - 1;
        let top = self.0[n].bits().cast_signed() - 1;
        let ratio = |k: usize| {
            // |c_(n-k) / c_n|^(1/k) < 2^((bits - top) / k)
            let excess = self.0[n - k].bits().cast_signed() - top;
            excess.div_euclid(k.cast_signed() as i64) + 1
        };
        let nonzero = (1..=n).filter(|k| !self.0[n - k].is_zero());
        nonzero.map(ratio).max().unwrap_or(0) + 1
    }
}

crate::operators! {
    [inline] [] &IntPoly => IntPoly;
    Add::add(x, y) {
        let (long, short) = if x.0.len() >= y.0.len() { (x, y) } else { (y, x) };
        let mut out = long.0.clone();
        for (o, s) in out.iter_mut().zip(&short.0) {
            *o += s;
        }
        IntPoly::new(out)
    }
    Neg::neg(x) {
        IntPoly(x.0.iter().map(|c| -c).collect())
    }
    Sub::sub(x, y) {
        x + &-y
    }
    Mul::mul(x, y) {
        IntPoly::new(kronecker::product(&x.0, &y.0))
    }
}

#[cfg(test)]
mod tests;
