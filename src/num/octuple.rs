//! Floating point with 256 bits (octuple precision), for cases beyond double-double. An example is the last part of
//! homotopy paths whose ends differ by products of several small numbers.
//!
//! Results are truncated. The error of every operation is below `2^-253` of its result, of a sum of the larger operand,
//! of a quotient four times that. The results prove nothing; the exponent has 32 bits and does not overflow in
//! practice.

use std::ops::{Add, Div};

use num_complex::Complex64;

use super::complex::Complex;

const LIMBS: usize = 4;
const BITS: i64 = 256;

/// `(-1)^negative 2^exponent m`, `m` in `[1/2, 1)` the fraction with the given limbs, least significant first; zero has
/// no bit set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Octuple {
    negative: bool,
    exponent: i32,
    limbs: [u64; LIMBS],
}

impl Octuple {
    /// Zero.
    pub const ZERO: Self = Self { negative: false, exponent: 0, limbs: [0; LIMBS] };
    /// One.
    pub const ONE: Self = Self { negative: false, exponent: 1, limbs: [0, 0, 0, 1 << 63] };

    /// Whether it is exactly zero.
    pub fn is_zero(&self) -> bool {
        self.limbs[LIMBS - 1] == 0
    }

    /// The nearest double up to truncation; numbers beyond the range of doubles become infinite or zero.
    pub fn rounded(self) -> f64 {
        if self.is_zero() {
            return 0.0;
        }
        let value =
            (self.limbs[LIMBS - 1] as f64 + self.limbs[LIMBS - 2] as f64 * 2f64.powi(-64)) * 2f64.powi(-64);
        let half = self.exponent / 2;
        let value = value * 2f64.powi(half) * 2f64.powi(self.exponent - half);
        if self.negative { -value } else { value }
    }

    /// The exponent `k` of `2^(k-1) <= |x| < 2^k`; zero has one far below all others.
    pub fn exponent(&self) -> i32 {
        if self.is_zero() { i32::MIN / 4 } else { self.exponent }
    }

    /// Product with `2^k`, exact.
    pub fn scaled(self, k: i32) -> Self {
        if self.is_zero() { self } else { Self { exponent: self.exponent + k, ..self } }
    }

    /// `limbs` with further bits below, shifted to a leading one.
    fn normalised(negative: bool, exponent: i32, limbs: [u64; LIMBS]) -> Self {
        let mut limbs = limbs;
        let mut exponent = exponent;
        let Some(top) = (0..LIMBS).rev().find(|k| limbs[*k] != 0) else { return Self::ZERO };
        let words = LIMBS - 1 - top;
        if words > 0 {
            for k in (0..LIMBS).rev() {
                limbs[k] = if k >= words { limbs[k - words] } else { 0 };
            }
            exponent -= 64 * (words as u32).cast_signed();
        }
        let bits = limbs[LIMBS - 1].leading_zeros();
        if bits > 0 {
            for k in (1..LIMBS).rev() {
                limbs[k] = limbs[k] << bits | limbs[k - 1] >> (64 - bits);
            }
            limbs[0] <<= bits;
            exponent -= bits.cast_signed();
        }
        Self { negative, exponent, limbs }
    }

    fn is_smaller_than(&self, other: &Self) -> bool {
        let key = |x: &Self| (x.exponent, x.limbs[3], x.limbs[2], x.limbs[1], x.limbs[0]);
        key(self) < key(other)
    }

    /// `2^-by` times the limbs, `0 <= by < BITS`.
    fn shifted(&self, by: u32) -> [u64; LIMBS] {
        let (words, bits) = ((by / 64) as usize, by % 64);
        let limb = |k: usize| if k < LIMBS { self.limbs[k] } else { 0 };
        std::array::from_fn(|k| {
            let low = limb(k + words) >> bits;
            if bits == 0 { low } else { low | limb(k + words + 1) << (64 - bits) }
        })
    }

    /// One over the number: Newton's method from the reciprocal in double, which doubles 52 digits three times.
    fn recip(self) -> Self {
        let fraction = Self { exponent: 0, negative: false, ..self };
        let mut y = Self::from(fraction.rounded().recip());
        for _ in 0..3 {
            y = y + y * (Self::ONE - fraction * y);
        }
        Self { negative: self.negative, exponent: y.exponent - self.exponent, ..y }
    }

    /// The square root of a non-negative number, by Newton's method for its reciprocal.
    pub fn sqrt(self) -> Self {
        if self.is_zero() || self.negative {
            return Self::ZERO;
        }
        let half = self.exponent.div_euclid(2);
        let fraction = self.scaled(-2 * half);
        let mut y = Self::from(fraction.rounded().sqrt().recip());
        for _ in 0..3 {
            y = y + (y * (Self::ONE - fraction * y * y)).scaled(-1);
        }
        (fraction * y).scaled(half)
    }
}

impl From<f64> for Octuple {
    /// Exact for finite numbers; NaN and infinities become zero.
    fn from(x: f64) -> Self {
        let (negative, x) = (x < 0.0, x.abs());
        if !(x > 0.0 && x.is_finite()) {
            return Self::ZERO;
        }
        // subnormal numbers are first scaled into the normal range
        let (x, shift) = if x < f64::MIN_POSITIVE { (x * 2f64.powi(64), 64) } else { (x, 0) };
        let exponent = ((x.to_bits() >> 52) & 0x7ff) as i32 - 1022 - shift;
        let mantissa = x.to_bits() & ((1 << 52) - 1) | 1 << 52;
        Self { negative, exponent, limbs: [0, 0, 0, mantissa << 11] }
    }
}

crate::operators! {
    [inline] [] Octuple;
    Neg::neg(x) {
        Self { negative: !x.negative, ..x }
    }
    Sub::sub(x, y) {
        x + -y
    }
    Mul::mul(x, y) {
        x.times(y)
    }
}

impl Add for Octuple {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let (large, small) = if self.is_smaller_than(&other) { (other, self) } else { (self, other) };
        let gap = i64::from(large.exponent) - i64::from(small.exponent);
        if gap >= BITS {
            return large;
        }
        let low = small.shifted(gap.unsigned_abs() as u32);
        let mut out = large.limbs;
        if large.negative == small.negative {
            let mut carry = false;
            for k in 0..LIMBS {
                let (sum, a) = out[k].overflowing_add(low[k]);
                let (sum, b) = sum.overflowing_add(u64::from(carry));
                (out[k], carry) = (sum, a | b);
            }
            if !carry {
                return Self { negative: large.negative, exponent: large.exponent, limbs: out };
            }
            for k in 0..LIMBS - 1 {
                out[k] = out[k] >> 1 | out[k + 1] << 63;
            }
            out[LIMBS - 1] = out[LIMBS - 1] >> 1 | 1 << 63;
            return Self { negative: large.negative, exponent: large.exponent + 1, limbs: out };
        }
        let mut borrow = false;
        for k in 0..LIMBS {
            let (rest, a) = out[k].overflowing_sub(low[k]);
            let (rest, b) = rest.overflowing_sub(u64::from(borrow));
            (out[k], borrow) = (rest, a | b);
        }
        Self::normalised(large.negative, large.exponent, out)
    }
}

impl Octuple {
    fn times(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        let mut product = [0u64; 2 * LIMBS];
        for i in 0..LIMBS {
            let mut carry = 0u128;
            for j in 0..LIMBS {
                let sum = u128::from(self.limbs[i]) * u128::from(other.limbs[j])
                    + u128::from(product[i + j])
                    + carry;
                product[i + j] = sum as u64;
                carry = sum >> 64;
            }
            product[i + LIMBS] = carry as u64;
        }
        let mut limbs = [0; LIMBS];
        limbs.copy_from_slice(&product[LIMBS..]);
        let mut exponent = self.exponent + other.exponent;
        if limbs[LIMBS - 1] >> 63 == 0 {
            for k in (1..LIMBS).rev() {
                limbs[k] = limbs[k] << 1 | limbs[k - 1] >> 63;
            }
            limbs[0] = limbs[0] << 1 | product[LIMBS - 1] >> 63;
            exponent -= 1;
        }
        Self { negative: self.negative != other.negative, exponent, limbs }
    }
}

impl Div for Octuple {
    type Output = Self;
    /// Division by zero gives zero.
    fn div(self, other: Self) -> Self {
        if other.is_zero() {
            return Self::ZERO;
        }
        self.times(other.recip())
    }
}

/// A complex number with such parts.
pub type ComplexOctuple = Complex<Octuple>;

impl ComplexOctuple {
    /// Zero.
    pub const ZERO: Self = Self { re: Octuple::ZERO, im: Octuple::ZERO };

    /// See [`Octuple::rounded`].
    pub fn rounded(self) -> Complex64 {
        Complex64::new(self.re.rounded(), self.im.rounded())
    }

    /// Product with `2^k`, exact.
    pub fn scaled(self, k: i32) -> Self {
        Self { re: self.re.scaled(k), im: self.im.scaled(k) }
    }

    /// The larger exponent of the parts.
    pub fn exponent(&self) -> i32 {
        self.re.exponent().max(self.im.exponent())
    }

    /// One over the number; zero for zero.
    pub fn recip(self) -> Self {
        self.conj().times(Octuple::ONE / self.norm_sqr())
    }
}

/// LU factors of a square matrix with row exchanges.
#[derive(Debug, Clone)]
pub struct OctupleLu<const N: usize> {
    /// The multipliers below the diagonal, the inverse pivots on it.
    factors: [[ComplexOctuple; N]; N],
    order: [usize; N],
}

impl<const N: usize> OctupleLu<N> {
    /// Factorises `a`; `None` if a column has no pivot. Pivots are the largest up to a factor of two, which suffices at
    /// this precision.
    pub fn factorise(mut a: [[ComplexOctuple; N]; N]) -> Option<Self> {
        let mut order: [usize; N] = std::array::from_fn(|k| k);
        for k in 0..N {
            let best = (k..N).max_by_key(|i| a[*i][k].exponent())?;
            a.swap(k, best);
            order.swap(k, best);
            if a[k][k].re.is_zero() && a[k][k].im.is_zero() {
                return None;
            }
            let inverse = a[k][k].recip();
            a[k][k] = inverse;
            let (top, below) = a.split_at_mut(k + 1);
            for row in below {
                let factor = row[k] * inverse;
                row[k] = factor;
                for j in k + 1..N {
                    row[j] = row[j] - factor * top[k][j];
                }
            }
        }
        Some(Self { factors: a, order })
    }

    /// Solves `A x = b`.
    pub fn solve(&self, b: &[ComplexOctuple; N]) -> [ComplexOctuple; N] {
        let mut x: [ComplexOctuple; N] = std::array::from_fn(|k| b[self.order[k]]);
        for i in 1..N {
            for j in 0..i {
                x[i] = x[i] - self.factors[i][j] * x[j];
            }
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                x[i] = x[i] - self.factors[i][j] * x[j];
            }
            x[i] = x[i] * self.factors[i][i];
        }
        x
    }

    /// Smallest over largest pivot modulus, a crude inverse condition number.
    pub fn pivot_ratio(&self) -> f64 {
        let logs = (0..N).map(|k| self.factors[k][k].exponent());
        let (least, most) = logs.fold((i32::MAX, i32::MIN), |(l, m), x| (l.min(x), m.max(x)));
        2f64.powi(least - most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use crate::exact::{Rational, rational};

    /// Bound of the relative errors.
    const UNIT: f64 = f64::EPSILON * f64::EPSILON * f64::EPSILON * f64::EPSILON / (1u64 << 45) as f64;

    fn value(x: Octuple) -> Rational {
        let two = rational(2.0).unwrap();
        let base = rational(2f64.powi(64)).unwrap();
        let fraction = x
            .limbs
            .iter()
            .fold(rational(0.0).unwrap(), |sum, limb| (sum + Rational::from_integer((*limb).into())) / &base);
        let power = two.pow(x.exponent);
        if x.negative { -(fraction * power) } else { fraction * power }
    }

    /// The sum of two doubles far apart fills all limbs.
    fn draw(rng: &mut Rng) -> Octuple {
        let mut part = |k: i32| Octuple::from(rng.normal() * 2f64.powi(k));
        (part(0) + part(-70) + part(-140) + part(-200)).scaled((rng.next_u64() % 300) as i32 - 150)
    }

    #[test]
    fn operations_agree_with_exact_rationals_to_their_unit() {
        let rng = &mut Rng::new(0x3136);
        let unit = rational(UNIT).unwrap();
        let size = |x: &Rational| if *x < rational(0.0).unwrap() { -x.clone() } else { x.clone() };
        for _ in 0..300 {
            let (x, y) = (draw(rng), draw(rng));
            // near cancellation as well
            let near = x + Octuple::from(x.rounded() * 1e-30);
            for (a, b) in [(x, y), (x, -y), (near, -x), (x, x)] {
                let (p, q) = (value(a), value(b));
                let scale = size(&p) + size(&q);
                assert!(size(&(value(a + b) - (&p + &q))) <= &scale * &unit);
                assert!(size(&(value(a - b) - (&p - &q))) <= &scale * &unit);
                let product = &p * &q;
                assert!(size(&(value(a * b) - &product)) <= size(&product) * &unit);
                let quotient = &p / &q;
                let error = size(&(value(a / b) - &quotient));
                assert!(error <= size(&quotient) * &unit * rational(4.0).unwrap());
            }
            let root = (x * x + y * y).sqrt();
            let defect = value(root) * value(root) - value(x * x + y * y);
            assert!(size(&defect) <= value(x * x + y * y) * &unit * rational(16.0).unwrap());
        }
    }

    #[test]
    fn doubles_go_in_and_come_out_unchanged() {
        let rng = &mut Rng::new(7);
        for k in [-1074, -1022, -500, 0, 1, 500, 1023] {
            let x = 2f64.powi(k);
            assert_eq!(Octuple::from(x).rounded().to_bits(), x.to_bits());
        }
        for _ in 0..100 {
            let x = rng.normal() * 2f64.powi((rng.next_u64() % 2000) as i32 - 1000);
            assert_eq!(Octuple::from(x).rounded().to_bits(), x.to_bits());
        }
        assert_eq!(Octuple::from(0.0).rounded().to_bits(), 0);
        assert!((Octuple::from(3.0) / Octuple::ZERO).is_zero());
    }

    #[test]
    fn linear_equations_are_solved_to_the_last_digits() {
        let rng = &mut Rng::new(0x1b);
        let mut next = || ComplexOctuple { re: draw(rng), im: draw(rng) }.scaled(0);
        let one = |z: ComplexOctuple| ComplexOctuple {
            re: z.re.scaled(-z.re.exponent()),
            im: z.im.scaled(-z.im.exponent()),
        };
        let a: [[ComplexOctuple; 5]; 5] = std::array::from_fn(|_| std::array::from_fn(|_| one(next())));
        let x: [ComplexOctuple; 5] = std::array::from_fn(|_| one(next()));
        let b = std::array::from_fn(|i| (0..5).fold(ComplexOctuple::ZERO, |sum, j| sum + a[i][j] * x[j]));
        let lu = OctupleLu::factorise(a).unwrap();
        for (p, q) in lu.solve(&b).iter().zip(&x) {
            let gap = *p - *q;
            assert!(gap.norm_sqr().rounded() < 1e-140, "{gap:?}");
        }
        assert!(lu.pivot_ratio() > 1e-6 && lu.pivot_ratio() <= 1.0);
        assert!(OctupleLu::factorise([[ComplexOctuple::ZERO; 3]; 3]).is_none());
    }
}
