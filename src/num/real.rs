//! Real numbers, exact if they are sums of square roots, otherwise between two close fractions.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use thiserror::Error;

use super::exact::{Rational, farthest, nearest};
use super::surd::Surd;

/// Bits to which the ends of an enclosure are rounded outward.
const BITS: u64 = 192;

/// A real number.
#[derive(Debug, Clone, PartialEq)]
pub enum RealNumber {
    /// An exactly known number.
    Exact(Surd),
    /// A number within an enclosure.
    Within(Enclosure),
}

/// The numbers from `low` to `high`.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosure {
    low: Rational,
    high: Rational,
}

/// The reason why an operation has no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoReal {
    /// The divisor is zero.
    #[error("division by zero")]
    DivisionByZero,
    /// The radicand is negative.
    #[error("square root of a negative number")]
    NegativeRoot,
    /// The divisor is an enclosure that contains zero.
    #[error("division by a number that cannot be told from zero")]
    DivisorNearZero,
    /// The radicand is an enclosure that contains negative numbers.
    #[error("square root of a number that may be negative")]
    RootNearZero,
    /// The exact result is too long.
    #[error("the result has thousands of digits")]
    TooLong,
}

impl Enclosure {
    /// The numbers between two fractions, with ends of few digits; an error for absurd magnitudes.
    fn outward(low: &Rational, high: &Rational) -> Result<Self, NoReal> {
        Ok(Self { low: rounded(low, false)?, high: rounded(high, true)? })
    }

    /// The ends.
    pub fn ends(&self) -> (&Rational, &Rational) {
        (&self.low, &self.high)
    }

    fn holds_zero(&self) -> bool {
        !self.low.is_positive() && !self.high.is_negative()
    }
}

/// Rounded to [`BITS`] leading bits, up or down.
fn rounded(x: &Rational, up: bool) -> Result<Rational, NoReal> {
    let (n, d) = (x.numer(), x.denom());
    let (length, divisor) = (n.bits().cast_signed(), d.bits().cast_signed());
    // far beyond any coordinate
    if length - divisor > 4096 || divisor - length > 1 << 16 {
        return Err(NoReal::TooLong);
    }
    if n.bits() <= BITS && d.bits() <= BITS {
        return Ok(x.clone());
    }
    let shift = BITS.cast_signed() + divisor - length;
    let two = Rational::from_integer(BigInt::one() << shift.unsigned_abs());
    let scaled = if shift >= 0 { x * &two } else { x / &two };
    let whole = if up { scaled.ceil() } else { scaled.floor() };
    Ok(if shift >= 0 { whole / two } else { whole * two })
}

impl RealNumber {
    /// A whole number.
    pub fn integer(x: i64) -> Self {
        Self::Exact(Surd::integer(x))
    }

    /// A fraction; an enclosure if it is very long.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn rational(x: &Rational) -> Result<Self, NoReal> {
        Surd::rational(x).map_or_else(|| Ok(Self::Within(Enclosure::outward(x, x)?)), |x| Ok(Self::Exact(x)))
    }

    /// The number if it is known exactly.
    pub fn exact(&self) -> Option<&Surd> {
        if let Self::Exact(x) = self { Some(x) } else { None }
    }

    /// An enclosure of the number.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn enclosure(&self) -> Result<Enclosure, NoReal> {
        match self {
            Self::Within(e) => Ok(e.clone()),
            Self::Exact(x) => {
                let (low, high) = x.between(BITS);
                Enclosure::outward(&low, &high)
            }
        }
    }

    /// The nearest double; for an enclosure that of the middle.
    pub fn nearest(&self) -> f64 {
        match self {
            Self::Exact(x) => x.nearest(),
            Self::Within(e) => nearest(&((&e.low + &e.high) / Rational::from_integer(2.into()))),
        }
    }

    /// An upper bound of its distance from a finite double; zero if it is the double.
    pub fn distance_from(&self, double: f64) -> f64 {
        match self {
            Self::Exact(x) => x.distance_from(double),
            Self::Within(e) => farthest(double, &e.low, &e.high),
        }
    }

    /// The exact result, or that of the enclosures.
    fn combined(
        &self,
        other: &Self,
        exact: impl Fn(&Surd, &Surd) -> Option<Surd>,
        enclosed: impl Fn(&Rational, &Rational) -> Rational,
    ) -> Result<Self, NoReal> {
        if let (Self::Exact(x), Self::Exact(y)) = (self, other)
            && let Some(z) = exact(x, y)
        {
            return Ok(Self::Exact(z));
        }
        let (x, y) = (self.enclosure()?, other.enclosure()?);
        let corners = [
            enclosed(&x.low, &y.low),
            enclosed(&x.low, &y.high),
            enclosed(&x.high, &y.low),
            enclosed(&x.high, &y.high),
        ];
        let [first, rest @ ..] = &corners;
        let low = rest.iter().fold(first, |l, c| l.min(c));
        let high = rest.iter().fold(first, |h, c| h.max(c));
        Ok(Self::Within(Enclosure::outward(low, high)?))
    }

    /// The sum.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn plus(&self, other: &Self) -> Result<Self, NoReal> {
        self.combined(other, Surd::plus, |x, y| x + y)
    }

    /// The difference.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn minus(&self, other: &Self) -> Result<Self, NoReal> {
        self.combined(other, Surd::minus, |x, y| x - y)
    }

    /// The product.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn times(&self, other: &Self) -> Result<Self, NoReal> {
        // zero times anything is zero, for any enclosure
        if [self, other].iter().any(|x| x.exact().is_some_and(Surd::is_zero)) {
            return Ok(Self::integer(0));
        }
        self.combined(other, Surd::times, |x, y| x * y)
    }

    /// Whether it is zero, or indistinguishable from zero.
    pub fn may_be_zero(&self) -> bool {
        match self {
            Self::Exact(x) => x.is_zero(),
            Self::Within(e) => e.holds_zero(),
        }
    }

    /// The quotient.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn over(&self, divisor: &Self) -> Result<Self, NoReal> {
        if divisor.exact().is_some_and(Surd::is_zero) {
            return Err(NoReal::DivisionByZero);
        }
        if divisor.may_be_zero() {
            return Err(NoReal::DivisorNearZero);
        }
        self.combined(divisor, |x, y| x.times(&y.inverse()?), |x, y| x / y)
    }

    /// `-x`.
    pub fn negated(&self) -> Self {
        match self {
            Self::Exact(x) => Self::Exact(x.negated()),
            Self::Within(e) => Self::Within(Enclosure { low: -&e.high, high: -&e.low }),
        }
    }

    /// `x^n`.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn power(&self, n: i32) -> Result<Self, NoReal> {
        let (mut result, mut square, mut left) = (Self::integer(1), self.clone(), n.unsigned_abs());
        while left > 0 {
            if left % 2 == 1 {
                result = result.times(&square)?;
            }
            left /= 2;
            if left > 0 {
                square = square.times(&square)?;
            }
        }
        if n < 0 { Self::integer(1).over(&result) } else { Ok(result) }
    }

    /// The square root.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn sqrt(&self) -> Result<Self, NoReal> {
        if let Self::Exact(x) = self {
            if x.sign() == Ordering::Less {
                return Err(NoReal::NegativeRoot);
            }
            if let Some(root) = x.sqrt() {
                return Ok(Self::Exact(root));
            }
        }
        let e = self.enclosure()?;
        if e.high.is_negative() {
            return Err(NoReal::NegativeRoot);
        }
        if e.low.is_negative() {
            return Err(NoReal::RootNearZero);
        }
        Ok(Self::Within(Enclosure::outward(&root_bound(&e.low, false), &root_bound(&e.high, true))?))
    }

    /// `cos` and `sin` of this number of degrees, exactly if [`Surd::turn`] has them.
    ///
    /// # Errors
    /// [`NoReal`] names the reason.
    pub fn turn(&self) -> Result<(Self, Self), NoReal> {
        let (angle, slack) = if let Some(angle) = self.exact().and_then(Surd::as_rational) {
            if let Some((c, s)) = Surd::turn(&angle) {
                return Ok((Self::Exact(c), Self::Exact(s)));
            }
            (angle, Rational::zero())
        } else {
            let e = self.enclosure()?;
            let middle = (&e.low + &e.high) / Rational::from_integer(2.into());
            // the derivative by degrees is below 1/57
            (middle.clone(), (&e.high - middle) / Rational::from_integer(57.into()))
        };
        let right = Rational::from_integer(90.into());
        let quarter = (&angle / &right).floor();
        let rest = angle - &quarter * right;
        let (c, s) = acute(&rest, &slack)?;
        let four = BigInt::from(4);
        let quarter = quarter.to_integer();
        let quarter = i32::try_from(((quarter % &four) + &four) % &four).unwrap_or(0);
        Ok(match quarter {
            0 => (c, s),
            1 => (s.negated(), c),
            2 => (c.negated(), s.negated()),
            _ => (s, c.negated()),
        })
    }
}

/// A fraction near the square root of a non-negative number.
fn root_bound(x: &Rational, up: bool) -> Rational {
    let (n, d) = (x.numer(), x.denom());
    let shift = 2 * BITS + d.bits();
    // sqrt(n / d) = sqrt(n d 4^k) / (d 2^k)
    let root = ((n * d) << (2 * shift)).sqrt() + BigInt::from(u8::from(up && !n.is_zero()));
    Rational::new(root, d << shift)
}

/// Cosine and sine of 0 to 90 degrees, for an angle within the slack.
fn acute(angle: &Rational, slack: &Rational) -> Result<(RealNumber, RealNumber), NoReal> {
    let integer = |n: i64| Rational::from_integer(n.into());
    // x <= pi/2 in radians, between two fractions
    let ten = BigInt::from(10).pow(80);
    let digits = "314159265358979323846264338327950288419716939937510582097494459230781640628620899";
    let pi: BigInt = digits.parse().map_err(|_| NoReal::TooLong)?;
    let (pi_low, pi_high) = (Rational::new(pi.clone(), ten.clone()), Rational::new(pi + 1, ten));
    let (low, high) = (angle * pi_low / integer(180), angle * pi_high / integer(180));
    let series = |first: u32| -> Result<RealNumber, NoReal> {
        let (l, h) = (taylor(&low, first), taylor(&high, first));
        // rounding in the series, and of pi
        let margin = Rational::new(BigInt::one(), BigInt::one() << 230) + slack;
        let (low, high) = if l < h { (l, h) } else { (h, l) };
        Ok(RealNumber::Within(Enclosure::outward(&(low - &margin), &(high + margin))?))
    };
    Ok((series(0)?, series(1)?))
}

/// `cos x` (`first = 0`) or `sin x` (1) for `0 <= x < 2`, with an error below `2^-235`.
fn taylor(x: &Rational, first: u32) -> Rational {
    const FIXED: u64 = 256;
    let x = (x.numer() << FIXED) / x.denom();
    let square = (&x * &x) >> FIXED;
    let mut term = if first == 0 { BigInt::one() << FIXED } else { x };
    let (mut sum, mut n) = (BigInt::zero(), first);
    while !term.is_zero() {
        sum += &term;
        // towards zero: a shift would never pass -1
        term = -(term * &square / (BigInt::one() << FIXED)) / BigInt::from((n + 1) * (n + 2));
        n += 2;
    }
    Rational::new(sum, BigInt::one() << FIXED)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fraction(n: i64, d: i64) -> RealNumber {
        RealNumber::rational(&Rational::new(n.into(), d.into())).unwrap()
    }

    fn holds(x: &RealNumber, value: &Rational) -> bool {
        let e = x.enclosure().unwrap();
        e.low <= *value && *value <= e.high
    }

    #[test]
    fn angles_agree_with_doubles_and_with_the_theorem_of_pythagoras() {
        for k in -90..90 {
            for angle in [fraction(k * 9, 1), fraction(7 * k, 3), fraction(15 * k, 1)] {
                let (c, s) = angle.turn().unwrap();
                let radians = angle.nearest().to_radians();
                assert!((c.nearest() - radians.cos()).abs() < 3e-14, "{k}");
                assert!((s.nearest() - radians.sin()).abs() < 3e-14, "{k}");
                let one = c.times(&c).unwrap().plus(&s.times(&s).unwrap()).unwrap();
                assert!(holds(&one, &Rational::one()), "{k}");
                let e = one.enclosure().unwrap();
                assert!(e.high - e.low < Rational::new(BigInt::one(), BigInt::one() << 150));
            }
        }
    }

    #[test]
    fn the_series_agrees_with_the_known_cosines() {
        for degrees in [0i64, 5, 10, 15, 18, 27, 30, 36, 45, 60, 72, 75, 90] {
            let exact = Surd::turn(&Rational::from_integer(degrees.into())).unwrap().0;
            // a slack of zero width forces the series
            let angle = Rational::new((degrees * 1_000_000_000 + 1).into(), 1_000_000_000.into());
            let near = acute(&angle, &Rational::zero()).unwrap().0;
            let wide = acute(
                &Rational::from_integer(degrees.into()),
                &Rational::new(1.into(), BigInt::one() << 200),
            );
            let wide = wide.unwrap().0.enclosure().unwrap();
            let (low, high) = exact.between(300);
            assert!(wide.low <= low && high <= wide.high, "{degrees}");
            assert!((near.nearest() - exact.nearest()).abs() < 1e-10);
        }
    }

    #[test]
    fn what_leaves_the_field_is_enclosed() {
        let x = fraction(2, 1).sqrt().unwrap();
        assert!(x.exact().is_some());
        let y = x.plus(&fraction(3, 1)).unwrap().sqrt().unwrap();
        assert!(y.exact().is_none());
        assert!((y.nearest() - (3.0 + 2f64.sqrt()).sqrt()).abs() < 1e-15);
        let back = y.times(&y).unwrap().minus(&x).unwrap();
        assert!(holds(&back, &Rational::from_integer(3.into())));
        assert_eq!(y.times(&RealNumber::integer(0)), Ok(RealNumber::integer(0)));
        let third = RealNumber::integer(1).over(&y.negated()).unwrap();
        assert!((third.nearest() + 1.0 / y.nearest()).abs() < 1e-15);
    }

    #[test]
    fn impossible_operations_are_named() {
        let zero = RealNumber::integer(0);
        assert_eq!(RealNumber::integer(1).over(&zero), Err(NoReal::DivisionByZero));
        assert_eq!(RealNumber::integer(-1).sqrt(), Err(NoReal::NegativeRoot));
        let s = fraction(2, 1).sqrt().unwrap().plus(&fraction(3, 1)).unwrap().sqrt().unwrap();
        assert_eq!(RealNumber::integer(1).over(&s.minus(&s).unwrap()), Err(NoReal::DivisorNearZero));
        assert_eq!(s.minus(&s).unwrap().sqrt(), Err(NoReal::RootNearZero));
        assert_eq!(zero.power(-2), Err(NoReal::DivisionByZero));
        assert_eq!(fraction(2, 3).power(-3), Ok(fraction(27, 8)));
        let long = RealNumber::integer(10).power(600).unwrap();
        assert!(long.exact().is_some());
        let longer = long.times(&long).unwrap();
        assert!(longer.exact().is_none());
        assert_eq!(longer.times(&longer), Err(NoReal::TooLong));
    }
}
