//! Balls of real and complex numbers: a centre and a radius that includes every rounding error.
//!
//! One type serves reals ([`Ball<f64>`], within the crate `Real`), complex numbers ([`Disc`]) and complex numbers about
//! a centre in double-double (`WideDisc`). The centre defines the rounding errors of its operations by [`BallCentre`].
//! An [`Interval`] encloses reals too, by its two ends. It suits computations with signs and ends (ranges, bisection,
//! square roots near zero). A ball suits long chains of products and sums, at half of the cost.
//!
//! The error analysis uses the unit `u = 2^-53` of double, or [`DoubleDouble::UNIT`], and `|z|_1 = |re z| + |im z|`.
//! The latter is computed without underflow and satisfies `|z| <= |z|_1 <= sqrt 2 |z|`. Rounding to nearest gives each
//! part of a sum of doubles relative error `u`. Each part of a product `ac - bd` has error `2u(1+u)(|ac| + |bd|)`, so
//! the modulus of the product's error is at most `2u(1+u) (|z|_1 |w|_1)`. In double-double the two parts of a sum have
//! relative error `u` each, together `2u`. A product of two parts takes two products and a sum, below `4u |z|_1 |w|_1`
//! for the modulus. The inverse, `conj z / |z|^2`, takes a product, a sum without cancellation and a quotient in each
//! part: below `8u |1/z|_1`. The radii are computed in double from sums and products of non-negative numbers in fewer
//! than 60 operations. Their relative error is below `61 * 2^-53 < 2^-40`; the factor `1 + 2^-40` makes them upper
//! bounds again. Moduli of centres in double-double are those of their leading doubles, with a relative error of
//! `2^-53`, which the factor also covers. Underflow adds at most `2^-1074` an operation, which the `2^-900` added to
//! radii covers as long as moduli stay below `2^100`. An infinite or NaN radius carries no information and makes every
//! proving test fail.

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use super::double_double::{ComplexDoubleDouble, DoubleDouble};
use super::interval::Interval;

/// Factor that turns a computed sum of non-negative terms into an upper bound: `1 + 2^-40`.
pub const UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;
/// More than what underflow can add up to in a computation with numbers below `2^100`: `2^-900`.
pub const TINY: f64 = f64::from_bits((1023 - 900) << 52);
const U: f64 = f64::EPSILON / 2.0;

/// The centre of a ball, with the rounding errors of its arithmetic.
pub trait BallCentre:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Bound of the rounding error of a sum, as a multiple of its [`size`](Self::size).
    const SUM: f64;
    /// Bound of the rounding error of a product, as a multiple of the product of the sizes.
    const PRODUCT: f64;
    /// Bound of the rounding error of [`inverse`](Self::inverse), as a multiple of its size.
    const INVERSE: f64;

    /// At least the modulus, up to the rounding covered by `UP`.
    fn size(self) -> f64;
    /// A lower bound of the modulus, rounding included.
    fn lower_modulus(self) -> f64;
    /// `1 / z` with rounding; `None` if its parts overflow or underflow.
    fn inverse(self) -> Option<Self>;
    /// Product with a power of two, exact barring overflow and underflow.
    #[must_use]
    fn scaled(self, power_of_two: f64) -> Self;
}

impl BallCentre for f64 {
    const SUM: f64 = U;
    const PRODUCT: f64 = U;
    const INVERSE: f64 = 2.0 * U;

    #[inline]
    fn size(self) -> f64 {
        self.abs()
    }
    #[inline]
    fn lower_modulus(self) -> f64 {
        self.abs()
    }
    #[inline]
    fn inverse(self) -> Option<Self> {
        (self.abs() > TINY && self.is_finite()).then(|| self.recip())
    }
    #[inline]
    fn scaled(self, power_of_two: f64) -> Self {
        self * power_of_two
    }
}

impl BallCentre for Complex64 {
    const SUM: f64 = U;
    const PRODUCT: f64 = 3.0 * U;
    const INVERSE: f64 = 8.0 * U;

    #[inline]
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
    /// The larger part if the squares could underflow, otherwise the norm, minus `2^-40` of it.
    #[inline]
    fn lower_modulus(self) -> f64 {
        let square = self.norm_sqr();
        if square > TINY && square.is_finite() {
            square.sqrt() * (2.0 - UP)
        } else {
            self.re.abs().max(self.im.abs()) * (2.0 - UP)
        }
    }
    #[inline]
    fn inverse(self) -> Option<Self> {
        let square = self.norm_sqr();
        (square > TINY && square.is_finite()).then(|| self.conj() / square)
    }
    #[inline]
    fn scaled(self, power_of_two: f64) -> Self {
        self * power_of_two
    }
}

impl BallCentre for ComplexDoubleDouble {
    const SUM: f64 = 2.0 * DoubleDouble::UNIT;
    const PRODUCT: f64 = 4.0 * DoubleDouble::UNIT;
    const INVERSE: f64 = 8.0 * DoubleDouble::UNIT;

    #[inline]
    fn size(self) -> f64 {
        self.hi().size()
    }
    #[inline]
    fn lower_modulus(self) -> f64 {
        self.hi().lower_modulus()
    }
    #[inline]
    fn inverse(self) -> Option<Self> {
        let square = self.hi().norm_sqr();
        let n = self.norm_sqr();
        (square > TINY && square.is_finite()).then(|| Self { re: self.re / n, im: -self.im / n })
    }
    #[inline]
    fn scaled(self, power_of_two: f64) -> Self {
        self.scaled(power_of_two)
    }
}

/// All numbers within `radius` of `centre`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball<C> {
    /// Centre.
    pub centre: C,
    /// Radius; infinite or NaN means no information.
    pub radius: f64,
}

/// A real number with an error radius.
pub type Real = Ball<f64>;
/// A disc of complex numbers about a centre in double.
pub type Disc = Ball<Complex64>;
/// A disc of complex numbers about a centre in double-double.
pub type WideDisc = Ball<ComplexDoubleDouble>;

impl<C: BallCentre> Ball<C> {
    /// The single number `z`.
    #[must_use]
    #[inline]
    pub fn point(z: C) -> Self {
        Self { centre: z, radius: 0.0 }
    }

    /// Upper bound of the moduli.
    #[must_use]
    #[inline]
    pub fn magnitude(&self) -> f64 {
        (self.centre.size() + self.radius) * UP
    }

    /// Lower bound of the moduli, zero if the ball may contain zero.
    #[must_use]
    #[inline]
    pub fn mignitude(&self) -> f64 {
        let low = self.centre.lower_modulus() - self.radius * UP;
        if low > 0.0 { low.next_down() } else { 0.0 }
    }

    /// Proves that no number is in both balls.
    #[must_use]
    #[inline]
    pub fn is_disjoint(&self, other: &Self) -> bool {
        // the parts of the difference have relative errors far below 2^-40
        (self.centre - other.centre).lower_modulus() > (self.radius + other.radius) * UP
    }

    /// Encloses `1 / z`; `None` if the ball may contain zero. `|1/z - 1/c| = |z - c| / (|z| |c|)`.
    #[must_use]
    #[inline]
    pub fn reciprocal(&self) -> Option<Self> {
        let low = self.mignitude();
        if !(low > TINY) {
            return None;
        }
        let centre = self.centre.inverse()?;
        let moved = self.radius / (self.centre.lower_modulus() * low);
        Some(Self { centre, radius: (moved + C::INVERSE * centre.size() + TINY) * UP })
    }

    /// Product with a power of two, exact barring overflow and underflow.
    #[must_use]
    #[inline]
    pub fn scaled(&self, power_of_two: f64) -> Self {
        Self { centre: self.centre.scaled(power_of_two), radius: self.radius * power_of_two }
    }
}

impl Real {
    /// The point zero.
    pub const ZERO: Self = Self { centre: 0.0, radius: 0.0 };

    /// Upper bound of the numbers.
    #[must_use]
    #[inline]
    pub fn high(&self) -> f64 {
        (self.centre + self.radius).next_up()
    }

    /// Encloses the positive roots; `None` unless all numbers are positive. `|sqrt z - sqrt c| <= |z - c| / sqrt c`.
    #[must_use]
    #[inline]
    pub fn sqrt(&self) -> Option<Self> {
        let centre = self.centre.sqrt();
        (self.centre > self.radius * UP && centre > TINY)
            .then(|| Self { centre, radius: (self.radius / centre + 2.0 * U * centre + TINY) * UP })
    }
}

impl From<Interval> for Real {
    #[inline]
    fn from(x: Interval) -> Self {
        let (centre, radius) = x.centre_and_radius();
        Self { centre, radius }
    }
}

impl Disc {
    /// Proves that `z` lies in the disc.
    #[must_use]
    #[inline]
    pub fn contains(&self, z: Complex64) -> bool {
        (z - self.centre).size() * UP <= self.radius || (z - self.centre).norm() * UP <= self.radius
    }
}

impl WideDisc {
    /// All `z` with `|z - hi - low| <= radius`.
    #[inline]
    pub fn about(hi: Complex64, low: Complex64, radius: f64) -> Self {
        let centre = ComplexDoubleDouble {
            re: DoubleDouble::from_sum(hi.re, low.re),
            im: DoubleDouble::from_sum(hi.im, low.im),
        };
        Self { centre, radius }
    }

    /// A disc about a double that holds this one.
    #[inline]
    pub fn rounded(&self) -> Disc {
        Disc { centre: self.centre.hi(), radius: (self.radius + self.centre.lo().size()) * UP }
    }
}

crate::operators! {
    [inline] [C: BallCentre] Ball<C>;
    Neg::neg(x) {
        Self { centre: -x.centre, radius: x.radius }
    }
    Add::add(x, y) {
        let centre = x.centre + y.centre;
        Self { centre, radius: (x.radius + y.radius + C::SUM * centre.size() + TINY) * UP }
    }
    Sub::sub(x, y) {
        x + -y
    }
    Mul::mul(x, y) {
        let (z, w) = (x.centre.size(), y.centre.size());
        let (r, t) = (x.radius, y.radius);
        let radius = (z * t + r * (w + t) + C::PRODUCT * z * w + TINY) * UP;
        Self { centre: x.centre * y.centre, radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use num_rational::BigRational;

    /// Real and imaginary part.
    type Pair = (BigRational, BigRational);

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).unwrap()
    }

    trait Lift: BallCentre {
        /// Digits of the sums and products of points.
        const WIDTH: f64;
        /// Size of random nonzero radii, below the leading digits of the centre.
        const RADIUS: f64;
        fn draw(rng: &mut Rng, scale: f64) -> Self;
        fn lift(self) -> Pair;
        /// A direction for a number of the ball: real for reals.
        fn direction(rng: &mut Rng) -> Complex64 {
            Complex64::from_polar(0.999, rng.uniform(0.0, 6.0))
        }
    }

    impl Lift for f64 {
        const WIDTH: f64 = 1e-15;
        const RADIUS: f64 = 1e-3;
        fn draw(rng: &mut Rng, scale: f64) -> Self {
            rng.normal() * scale
        }
        fn lift(self) -> Pair {
            (exact(self), exact(0.0))
        }
        fn direction(rng: &mut Rng) -> Complex64 {
            Complex64::new(rng.uniform(-0.999, 0.999), 0.0)
        }
    }

    impl Lift for Complex64 {
        const WIDTH: f64 = 1e-15;
        const RADIUS: f64 = 1e-3;
        fn draw(rng: &mut Rng, scale: f64) -> Self {
            Complex64::new(rng.normal(), rng.normal()) * scale
        }
        fn lift(self) -> Pair {
            (exact(self.re), exact(self.im))
        }
    }

    impl Lift for ComplexDoubleDouble {
        const WIDTH: f64 = 1e-28;
        const RADIUS: f64 = 1e-20;
        fn draw(rng: &mut Rng, scale: f64) -> Self {
            let mut part = || Complex64::new(rng.normal(), rng.normal()) * scale;
            WideDisc::about(part(), part() * 1e-17, 0.0).centre
        }
        fn lift(self) -> Pair {
            let value = |d: DoubleDouble| exact(d.hi()) + exact(d.lo());
            (value(self.re), value(self.im))
        }
    }

    fn gap((a, b): &Pair, (c, d): &Pair) -> BigRational {
        (a - c) * (a - c) + (b - d) * (b - d)
    }

    fn holds<C: Lift>(d: &Ball<C>, z: &Pair) -> bool {
        gap(&d.centre.lift(), z) <= exact(d.radius) * exact(d.radius)
    }

    /// A ball and a number in it.
    fn random<C: Lift>(rng: &mut Rng) -> (Ball<C>, Pair) {
        let scale = 10f64.powi((rng.next_u64() % 7) as i32 - 3);
        let centre = C::draw(rng, scale);
        let radius = if rng.next_u64().is_multiple_of(2) { 0.0 } else { C::RADIUS * rng.unit() * scale };
        let away = C::direction(rng) * radius;
        let (re, im) = centre.lift();
        (Ball { centre, radius }, (re + exact(away.re), im + exact(away.im)))
    }

    fn operations_enclose_the_exact_result<C: Lift + std::fmt::Debug>(rng: &mut Rng) {
        for _ in 0..400 {
            let ((a, (xr, xi)), (b, (yr, yi))) = (random::<C>(rng), random::<C>(rng));
            assert!(holds(&(a + b), &(&xr + &yr, &xi + &yi)) && holds(&(a - b), &(&xr - &yr, &xi - &yi)));
            let product = a * b;
            assert!(holds(&product, &(&xr * &yr - &xi * &yi, &xr * &yi + &xi * &yr)));
            // the enclosures are useful: nearly all digits of the centre
            let points = a.radius + b.radius <= 0.0;
            assert!(!points || product.radius < C::WIDTH * product.centre.size());
            let n = &xr * &xr + &xi * &xi;
            if let Some(inverse) = a.reciprocal() {
                assert!(holds(&inverse, &(&xr / &n, -&xi / &n)));
            } else {
                assert!(a.radius > 0.0);
            }
            let (high, low) = (exact(a.magnitude()), exact(a.mignitude()));
            assert!(&high * &high >= n && &low * &low <= n);
            assert!(!a.is_disjoint(&a), "{a:?}");
        }
    }

    #[test]
    fn operations_of_every_kind_of_ball_enclose_the_exact_result() {
        let rng = &mut Rng::new(31);
        operations_enclose_the_exact_result::<f64>(rng);
        operations_enclose_the_exact_result::<Complex64>(rng);
        operations_enclose_the_exact_result::<ComplexDoubleDouble>(rng);
    }

    #[test]
    fn rounding_keeps_what_a_wide_disc_holds_and_membership_is_proved() {
        let rng = &mut Rng::new(32);
        for _ in 0..300 {
            let (a, x) = random::<ComplexDoubleDouble>(rng);
            assert!(holds(&a.rounded(), &x));
            let disc = random::<Complex64>(rng).0;
            let member = disc.centre + Complex64::direction(rng) * disc.radius;
            assert!(
                disc.contains(member)
                    && !(disc - Disc::point(member)).is_disjoint(&Disc::point(Complex64::ZERO))
            );
        }
    }

    #[test]
    fn roots_of_reals_hold_the_exact_ones() {
        let rng = &mut Rng::new(3);
        for _ in 0..2000 {
            let (a, (x, _)) = random::<f64>(rng);
            assert!(exact(a.high()) >= x);
            let Some(root) = a.sqrt() else {
                assert!(a.centre <= a.radius * UP);
                continue;
            };
            let (low, high) =
                (exact(root.centre) - exact(root.radius), exact(root.centre) + exact(root.radius));
            assert!((low < exact(0.0) || &low * &low <= x) && x <= &high * &high);
        }
        let ball = |centre, radius| Ball { centre, radius };
        assert!(ball(1.0, 1.5).reciprocal().is_none() && ball(1.0, f64::NAN).reciprocal().is_none());
        assert!(ball(1.0, f64::NAN).sqrt().is_none() && ball(1.0, 1.0).sqrt().is_none());
        // the product of the smallest numbers underflows
        let tiny = Ball::point(5e-324);
        assert!(holds(&(tiny * tiny), &(exact(5e-324) * exact(5e-324), exact(0.0))));
    }

    #[test]
    fn disjointness_is_proved_only_when_true() {
        let disc = |re, im, radius| Disc { centre: Complex64::new(re, im), radius };
        assert!(disc(0.0, 0.0, 1.0).is_disjoint(&disc(2.1, 0.0, 1.0)));
        assert!(!disc(0.0, 0.0, 1.0).is_disjoint(&disc(2.0, 0.0, 1.0)));
        assert!(!disc(0.0, 0.0, f64::NAN).is_disjoint(&disc(9.0, 0.0, 1.0)));
        assert!(disc(1.0, 0.0, 1.0).reciprocal().is_none() && disc(1e-200, 0.0, 0.0).reciprocal().is_none());
        assert!(disc(3e-320, 0.0, 0.0).is_disjoint(&disc(0.0, 0.0, 0.0)));
    }

    #[test]
    fn numbers_that_differ_in_the_twentieth_digit_are_told_apart() {
        let one = Complex64::new(1.0, 0.0);
        let disc = |low: f64, radius| WideDisc::about(one, Complex64::new(low, 0.0), radius);
        assert!(disc(1e-20, 1e-22).is_disjoint(&disc(0.0, 1e-22)));
        assert!(!disc(1e-20, 1e-20).is_disjoint(&disc(0.0, 1e-22)));
        assert!(!disc(1e-20, f64::NAN).is_disjoint(&disc(0.0, 0.0)));
        assert!(disc(0.0, 1.0).reciprocal().is_none());
    }
}
