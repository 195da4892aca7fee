//! Numbers `m 2^e`.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_traits::{ToPrimitive, Zero};

use crate::exact::Rational;

/// The rational number `mantissa * 2^exponent`, exactly. The mantissa is odd, or zero with exponent zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

impl Dyadic {
    /// `mantissa * 2^exponent`.
    #[must_use]
    pub fn new(mantissa: BigInt, exponent: i64) -> Self {
        match mantissa.trailing_zeros() {
            Some(zeros) => Self { mantissa: mantissa >> zeros, exponent: exponent + zeros.cast_signed() },
            None => Self { mantissa, exponent: 0 },
        }
    }

    /// The value of a double, `None` for NaN and infinities.
    #[must_use]
    pub fn from_f64(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        let (bits, sign) = (x.to_bits(), if x.is_sign_negative() { -1i64 } else { 1 });
        let (field, fraction) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
        // subnormal numbers have no hidden bit
        let (mantissa, exponent) =
            if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field.cast_signed() - 1075) };
        Some(Self::new(BigInt::from(mantissa.cast_signed() * sign), exponent))
    }

    /// The odd mantissa.
    #[must_use]
    pub fn mantissa(&self) -> &BigInt {
        &self.mantissa
    }

    /// The power of two.
    #[must_use]
    pub fn exponent(&self) -> i64 {
        self.exponent
    }

    /// The sign.
    #[must_use]
    pub fn sign(&self) -> Sign {
        self.mantissa.sign()
    }

    /// Half the sum.
    #[must_use]
    pub fn midpoint(&self, other: &Self) -> Self {
        let (a, b, e) = self.aligned(other);
        Self::new(a + b, e - 1)
    }

    /// `self - other`.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let (a, b, e) = self.aligned(other);
        Self::new(a - b, e)
    }

    /// `self * 2^k`.
    #[must_use]
    pub fn shifted(&self, k: i64) -> Self {
        if self.mantissa.is_zero() {
            self.clone()
        } else {
            Self::new(self.mantissa.clone(), self.exponent + k)
        }
    }

    /// `-self`.
    #[must_use]
    pub fn negated(&self) -> Self {
        Self { mantissa: -&self.mantissa, exponent: self.exponent }
    }

    /// `floor(log2 |x|)`, `None` for zero.
    #[must_use]
    pub fn log2_floor(&self) -> Option<i64> {
        (!self.mantissa.is_zero()).then(|| self.exponent + self.mantissa.bits().cast_signed() - 1)
    }

    /// The same number as a fraction.
    #[must_use]
    pub fn to_rational(&self) -> Rational {
        let power = BigInt::from(1) << self.exponent.unsigned_abs();
        if self.exponent < 0 {
            Rational::new(self.mantissa.clone(), power)
        } else {
            Rational::from_integer(&self.mantissa * power)
        }
    }

    /// The nearest double, ties away from zero; infinite on overflow.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let Some(log) = self.log2_floor() else { return 0.0 };
        if log > 1024 {
            return if self.sign() == Sign::Minus { f64::NEG_INFINITY } else { f64::INFINITY };
        }
        // the place of the last bit of a double of this size
        let last = (log - 52).max(-1074);
        let drop = last - self.exponent;
        let rounded = if drop > 0 {
            let half = BigInt::from(1) << (drop - 1).unsigned_abs();
            let magnitude = BigInt::from(self.mantissa.magnitude().clone()) + half;
            magnitude >> drop.unsigned_abs()
        } else {
            BigInt::from(self.mantissa.magnitude().clone()) << drop.unsigned_abs()
        };
        let value = rounded.to_f64().unwrap_or(f64::INFINITY);
        // two exact steps, since the power alone may be out of range
        let (first, second) = (last / 2, last - last / 2);
        let value = value * 2f64.powi(first as i32) * 2f64.powi(second as i32);
        if self.sign() == Sign::Minus { -value } else { value }
    }

    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let e = self.exponent.min(other.exponent);
        let lift = |x: &Self| &x.mantissa << (x.exponent - e).unsigned_abs();
        (lift(self), lift(other), e)
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b, _) = self.aligned(other);
        a.cmp(&b)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "the values are exact")]

    use super::*;
    use crate::Rng;

    #[test]
    fn doubles_read_back_bit_for_bit() {
        let mut rng = Rng::new(5);
        let special = [0.0, 1.0, -1.5, f64::MAX, f64::MIN_POSITIVE, 5e-324, -1.7e-310, 1.0 / 3.0];
        let drawn = (0..2000).map(|_| f64::from_bits(rng.next_u64())).filter(|x| x.is_finite());
        for x in special.into_iter().chain(drawn.collect::<Vec<_>>()) {
            assert_eq!(Dyadic::from_f64(x).unwrap().to_f64().to_bits(), (x + 0.0).to_bits(), "{x}");
        }
        assert!(Dyadic::from_f64(f64::NAN).is_none() && Dyadic::from_f64(f64::INFINITY).is_none());
    }

    #[test]
    fn rounding_is_to_nearest() {
        let d = |m: i64, e| Dyadic::new(BigInt::from(m), e);
        assert_eq!(d((1 << 54) + 1, 0).to_f64(), 2f64.powi(54));
        assert_eq!(d((1 << 54) + 3, 0).to_f64(), 2f64.powi(54) + 4.0);
        assert_eq!(d(3, 1023).to_f64(), f64::INFINITY);
        assert_eq!(d(-3, -2).midpoint(&d(1, 0)), d(1, -3));
        assert!(d(-3, -2) < d(1, -7));
    }
}
