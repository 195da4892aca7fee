//! Intervals of reals with outward-rounded double ends.
//!
//! Every operation encloses the exact result for all choices of the operands within their intervals (Moore 1966). IEEE
//! 754 rounds `+ - * /` and `sqrt` to nearest, so the exact value lies between the neighbours of the rounded one. Each
//! end is therefore moved outward by one double. This also holds at the limits. A sum that overflows to `+inf` has its
//! lower end at the largest double. A product that underflows to zero has its ends at the smallest subnormals. Exactly
//! known results (an operand is the point zero) are not widened, so real data keep imaginary part zero.
//!
//! Empty intervals do not exist: operations that could yield one return `Option`.

/// The closed interval `[lo, hi]` of reals, `lo <= hi`; an infinite end means unbounded on that side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

impl Interval {
    /// The point zero.
    pub const ZERO: Self = Self { lo: 0.0, hi: 0.0 };
    /// All reals.
    pub const WHOLE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// `[lo, hi]`, or `None` unless `lo <= hi`, `lo < +inf` and `hi > -inf` (NaN is refused too).
    #[must_use]
    #[inline]
    pub fn new(lo: f64, hi: f64) -> Option<Self> {
        (lo <= hi && lo < f64::INFINITY && hi > f64::NEG_INFINITY).then_some(Self { lo, hi })
    }

    /// `[-radius, radius]`; all reals if the radius is negative, infinite or NaN.
    #[must_use]
    pub fn about_zero(radius: f64) -> Self {
        Self::new(-radius, radius).unwrap_or(Self::WHOLE)
    }

    /// The point `x`, or `None` when `x` is not finite.
    #[must_use]
    #[inline]
    pub fn point(x: f64) -> Option<Self> {
        Self::new(x, x)
    }

    /// Lower end.
    #[must_use]
    #[inline]
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// Upper end.
    #[must_use]
    #[inline]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// `true` when `x` is a real number in the interval.
    #[must_use]
    #[inline]
    pub fn contains(self, x: f64) -> bool {
        x.is_finite() && self.lo <= x && x <= self.hi
    }

    /// `true` when every number of `other` is in `self`.
    #[must_use]
    #[inline]
    pub fn encloses(self, other: Self) -> bool {
        self.lo <= other.lo && other.hi <= self.hi
    }

    /// A double `m` and a radius `r >= 0` with `[lo, hi]` inside `[m - r, m + r]`; `r` is infinite for unbounded
    /// intervals.
    #[must_use]
    #[inline]
    pub fn centre_and_radius(self) -> (f64, f64) {
        if !(self.lo.is_finite() && self.hi.is_finite()) {
            return (0.0, f64::INFINITY);
        }
        let m = (0.5 * self.lo + 0.5 * self.hi).clamp(self.lo, self.hi);
        let (below, above) = (Self::raw(m, m) - Self::raw(self.lo, self.lo), Self::raw(self.hi, self.hi));
        (m, below.hi.max((above - Self::raw(m, m)).hi))
    }

    /// Largest modulus of its numbers.
    #[must_use]
    #[inline]
    pub fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// Encloses `x^2`, never below zero.
    #[must_use]
    #[inline]
    pub fn square(self) -> Self {
        let large = self.magnitude();
        let least = if self.lo > 0.0 || self.hi < 0.0 {
            let small = self.lo.abs().min(self.hi.abs());
            mul_down(small, small).max(0.0)
        } else {
            0.0
        };
        Self::raw(least, mul_up(large, large))
    }

    /// Encloses the products with a double; all reals if it is not finite.
    #[must_use]
    #[inline]
    pub fn scaled(self, factor: f64) -> Self {
        let (a, b) = (self.lo * factor, self.hi * factor);
        let (lo, hi) = (a.min(b), a.max(b));
        if lo != 0.0 && hi != 0.0 && lo > f64::NEG_INFINITY && hi < f64::INFINITY {
            return Self::raw(below(lo), above(hi));
        }
        self * Self::from(factor)
    }

    /// Encloses the square roots of its non-negative numbers; `None` without any.
    #[must_use]
    #[inline]
    pub fn sqrt(self) -> Option<Self> {
        if self.hi < 0.0 {
            return None;
        }
        let root = |x: f64, widened: fn(f64) -> f64| if x > 0.0 { widened(x.sqrt()) } else { 0.0 };
        Some(Self::raw(root(self.lo, f64::next_down).max(0.0), root(self.hi, f64::next_up)))
    }

    /// The numbers in both; its own if no number is in both.
    #[must_use]
    pub fn narrowed(self, other: Self) -> Self {
        Self::new(self.lo.max(other.lo), self.hi.min(other.hi)).unwrap_or(self)
    }

    /// Encloses `x / y`; `None` if the divisor contains zero.
    #[must_use]
    #[inline]
    pub fn checked_div(self, divisor: Self) -> Option<Self> {
        if divisor.lo <= 0.0 && divisor.hi >= 0.0 {
            return None;
        }
        if self == Self::ZERO {
            return Some(self);
        }
        let ends =
            [(self.lo, divisor.lo), (self.lo, divisor.hi), (self.hi, divisor.lo), (self.hi, divisor.hi)];
        let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
        for (x, y) in ends {
            let quotient = if x == 0.0 { 0.0 } else { x / y };
            // inf / inf: both operands unbounded there, quotients near that corner reach down to zero and up to inf
            let (down, up) = if quotient.is_nan() {
                (corner((x, y), true), corner((x, y), false))
            } else {
                (down_unless_zero(quotient, x), up_unless_zero(quotient, x))
            };
            (lo, hi) = (lo.min(down), hi.max(up));
        }
        Some(Self::raw(lo, hi))
    }

    /// The product, each of the products of two ends rounded outward.
    #[cold]
    fn product_by_ends(self, other: Self) -> Self {
        if self == Self::ZERO || other == Self::ZERO {
            return Self::ZERO;
        }
        let pairs = [(self.lo, other.lo), (self.lo, other.hi), (self.hi, other.lo), (self.hi, other.hi)];
        let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
        for (x, y) in pairs {
            (lo, hi) = (lo.min(mul_down(x, y)), hi.max(mul_up(x, y)));
        }
        Self::raw(lo, hi)
    }

    #[inline]
    fn raw(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }
}

/// Bounds of `x / y` near the corner where both are infinite: between 0 and an infinity of the quotient's sign.
#[inline]
fn corner((x, y): (f64, f64), lower: bool) -> f64 {
    let positive = (x > 0.0) == (y > 0.0);
    match (positive, lower) {
        (true, true) | (false, false) => 0.0,
        (true, false) => f64::INFINITY,
        (false, true) => f64::NEG_INFINITY,
    }
}

#[inline]
fn down_unless_zero(x: f64, numerator: f64) -> f64 {
    if numerator == 0.0 { 0.0 } else { x.next_down() }
}

#[inline]
fn up_unless_zero(x: f64, numerator: f64) -> f64 {
    if numerator == 0.0 { 0.0 } else { x.next_up() }
}

/// Lower bound of `x y`; zero times infinity is zero because the infinite end is not attained.
#[inline]
fn mul_down(x: f64, y: f64) -> f64 {
    if x == 0.0 || y == 0.0 { 0.0 } else { (x * y).next_down() }
}

#[inline]
fn mul_up(x: f64, y: f64) -> f64 {
    if x == 0.0 || y == 0.0 { 0.0 } else { (x * y).next_up() }
}

impl From<f64> for Interval {
    /// The point `x`; a value that is not finite gives [`Interval::WHOLE`], which proves nothing.
    #[inline]
    fn from(x: f64) -> Self {
        Self::point(x).unwrap_or(Self::WHOLE)
    }
}

crate::operators! {
    [inline] [] Interval;
    Neg::neg(x) {
        Self::raw(-x.hi, -x.lo)
    }
    Add::add(x, y) {
        if x == Self::ZERO {
            return y;
        }
        if y == Self::ZERO {
            return x;
        }
        Self::raw((x.lo + y.lo).next_down(), (x.hi + y.hi).next_up())
    }
    Sub::sub(x, y) {
        x + -y
    }
    Mul::mul(x, y) {
        let (a, b, c, d) = (x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi);
        let (lo, hi) = (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
        // rounding is monotone, so only the ends are rounded; zeros (exact or underflow) and unbounded ends are handled
        // product by product
        if lo != 0.0 && hi != 0.0 && lo > f64::NEG_INFINITY && hi < f64::INFINITY {
            return Self::raw(below(lo), above(hi));
        }
        x.product_by_ends(y)
    }
}

/// An angle in radians.
pub fn radians(degrees: f64) -> Interval {
    // pi lies between these neighbours
    let pi = Interval::new(std::f64::consts::PI, std::f64::consts::PI.next_up()).unwrap_or(Interval::WHOLE);
    (Interval::from(degrees) * pi).checked_div(Interval::from(180.0)).unwrap_or(Interval::WHOLE)
}

/// The largest double below a finite one that is not zero.
#[inline]
fn below(x: f64) -> f64 {
    let bits = x.to_bits();
    f64::from_bits(if x > 0.0 { bits - 1 } else { bits + 1 })
}

/// The smallest double above a finite one that is not zero.
#[inline]
fn above(x: f64) -> f64 {
    -below(-x)
}

#[cfg(test)]
mod tests;
