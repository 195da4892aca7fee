//! The leg equations in dual quaternions, evaluated with error bounds.
//!
//! With `x = (e, g)`, `g = p e`, and lengths divided by a power of two,
//!
//! ```text
//! F_i(x) = ( |v_i|^2 - s_i e.e ) / 2,   v_i = g + e b_i - a_i e = g + T_i e,     i = 1..6,
//! F_7(x) = e.g,
//! T = [ 0  -d^T ; d  -[c]x ],   d = b - a,   c = a + b.
//! ```
//!
//! `T` is skew, so the gradient of `F_i` is `v_i` by `g` and `-T_i v_i - s_i e` by `e`.
//!
//! **Error bounds.** `U` is the unit of the arithmetic at hand, `2^-53` or [`DoubleDouble::UNIT`], and `u = 2^-53`. In
//! a sum of products let every term pass through at most `n` roundings. The error of the computed sum is at most
//! `gamma_n = nU/(1-nU)` times the sum of the terms' moduli (Higham 2002, lemma 3.1). Real coefficients act on real and
//! imaginary parts alike, so that bounds by moduli hold for the moduli of the complex errors. `E >= |e_j|`,
//! `G >= |g_j|`, `P >= sum |e_j|^2`, `t_i` >= the absolute row sums of `T_i`, `W_i` = sum of the `|v|^2` of the four
//! computed components.
//!
//! * `v`: four terms with at most five roundings (entry of `T`, product, three sums): `delta_i = 5U (G + t_i E)`.
//! * `F_i`: from `v`, `(1/2) sum |dv| (2|v| + |dv|) <= 2 delta sqrt W + 2 delta^2`; its own at most seven roundings in
//!   each part, factor `sqrt 2` for two parts: `(sqrt 2 / 2) 7 U (W + s P) < 5U (W + s P)`.
//! * joints known exactly have low parts as squared lengths have: data in double-double and with 256 bits, within the
//!   radii in double.
//! * data: in double the squared length is the double nearest to its middle. The rest, `|s_low| P / 2` in `F_i` and
//!   `|s_low| e` in its gradient, counts as rounding. In double-double it is part of the data.
//! * `F_7`: five roundings, two parts: `sqrt 2 * 5 U * 4 E G < 32 U E G`.
//! * gradient (always in double): `delta_i` by each `g_j`; `t_i delta_i + 5u (t_i sqrt W + s E)` by each `e_j`.
//!
//! **Joints within radii.** The coordinates of `a_i` and `b_i` may be any within radii of the doubles. Then `d` and `c`
//! change by at most the sum of both radii a coordinate. The absolute row sums of `T_i` change by at most three times
//! that, `tau_i`. With `V_i >= |v_i|` at the centre:
//!
//! * `v`: `omega = tau_i E` a component; `F_i`: `(1/2) sum |dv| (2|v| + |dv|) <= 2 omega V_i + 2 omega^2`, as above;
//! * gradient: `omega` by each `g_j`; `T v` by `dT v + T dv + dT dv`, `tau_i V_i + (t_i + tau_i) omega` by each `e_j`;
//! * `Q_i(h, k) = (w(h).w(k) - s h_e.k_e) / 2`, `w = h_g + T_i h_e`, on the unit polydisc: `|w_r| <= 1 + t_i`,
//!   `|dw_r| <= tau_i`, so `(1/2) sum_r (2 (1 + t_i) tau_i + tau_i^2) = 4 (1 + t_i) tau_i + 2 tau_i^2`.
//!
//! These are widths of the data, as those of the squared lengths are: a proof holds for every choice.
//!
//! **Second-order part of two vectors** (always in double, for the polar form of `F`, whose value on `h`, `h` is `F(h)`
//! where `h_patch = 0`). With `D_h = delta_h + omega_h`, what rounding and radii do to a component of
//! `w(h) = h_g + T h_e`, and `W_h = |w(h)|` as computed:
//!
//! * `Q_i(h, k) = (w(h).w(k) - s h_e.k_e) / 2`: from `w`, `D_h W_k + D_k W_h + 2 D_h D_k`; its own, as above, below
//!   `5U (W_h W_k + s sqrt(P_h P_k))`; the squared length's low part and radius, half of their sum times
//!   `sqrt(P_h P_k)`.
//! * `Q_7(h, k) = (h_e.k_g + k_e.h_g) / 2`: five roundings of eight products in each part, below
//!   `16U (E_h G_k + E_k G_h)`.
//!
//! `gamma_n < nU (1 + 2^-44)` and the rounding of the bounds themselves are covered by the factor [`UP`], underflow by
//! [`TINY`].

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use super::certificate::WhyUncertified;
use super::second_order::SecondOrder;
use num::ball::{TINY, UP};
use num::double_double::DoubleDouble;
use num::interval::Interval;
use num::rounding::check_arithmetic;
use platform::manipulator::{Body, Manipulator, SquaredLegLengths};

/// Unknowns on an affine patch, and equations.
pub(super) const N: usize = 7;
/// Unit roundoff of double.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// A real number type: `f64` with unit `2^-53` or [`DoubleDouble`] with [`DoubleDouble::UNIT`].
pub(super) trait RealScalar:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// `a + b`, with the relative error of the type.
    fn sum(a: f64, b: f64) -> Self;
    /// `a + b + low`, likewise, where `low` is below the error of doubles: these leave it out.
    fn sum_with(a: f64, b: f64, low: f64) -> Self;
    /// The nearest double.
    fn rounded(self) -> f64;
}

impl RealScalar for f64 {
    fn sum(a: f64, b: f64) -> Self {
        a + b
    }
    fn sum_with(a: f64, b: f64, _low: f64) -> Self {
        a + b
    }
    fn rounded(self) -> f64 {
        self
    }
}

impl RealScalar for DoubleDouble {
    fn sum(a: f64, b: f64) -> Self {
        Self::from_sum(a, b)
    }
    fn sum_with(a: f64, b: f64, low: f64) -> Self {
        // exact without a low part, so that plain joints cost no rounding
        if low.to_bits() << 1 == 0 { Self::from_sum(a, b) } else { Self::from_sum(a, b) + Self::from(low) }
    }
    fn rounded(self) -> f64 {
        self.hi()
    }
}

/// Squared leg lengths for a proof, design units squared. Negative numbers and unbounded intervals may be asked about;
/// the latter have no certificates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SquareData {
    pub(super) middle: [DoubleDouble; 6],
    pub(super) radius: [f64; 6],
}

impl SquareData {
    /// All numbers within radii of the middles.
    pub(crate) fn within(middle: [DoubleDouble; 6], radius: [f64; 6]) -> Self {
        Self { middle, radius }
    }
}

impl From<&SquaredLegLengths> for SquareData {
    fn from(s: &SquaredLegLengths) -> Self {
        Self { middle: s.middle(), radius: s.radius() }
    }
}

impl From<&[Interval; 6]> for SquareData {
    fn from(s: &[Interval; 6]) -> Self {
        let both = s.map(Interval::centre_and_radius);
        Self { middle: both.map(|b| b.0.into()), radius: both.map(|b| b.1) }
    }
}

/// Study coordinates `e_0..e_3, g_0..g_3` with `e_patch = 1`, lengths in units of [`LegSystem::unit`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Study<S> {
    pub(super) re: [S; 8],
    pub(super) im: [S; 8],
    pub(super) patch: usize,
}

impl<S: RealScalar> Study<S> {
    /// The nearest doubles.
    pub(super) fn rounded(&self) -> Study<f64> {
        Study { re: self.re.map(S::rounded), im: self.im.map(S::rounded), patch: self.patch }
    }
}

impl Study<f64> {
    /// The same point as double-doubles.
    pub(super) fn lifted(&self) -> Study<DoubleDouble> {
        Study { re: self.re.map(Into::into), im: self.im.map(Into::into), patch: self.patch }
    }

    /// Upper bounds `(E, G, P)` of the module's text.
    pub(super) fn magnitudes(&self) -> (f64, f64, f64) {
        let size = |j: usize| self.re[j].abs() + self.im[j].abs();
        let e = (0..4).map(size).fold(0.0, f64::max);
        let g = (4..8).map(size).fold(0.0, f64::max);
        let p: f64 = (0..4).map(|j| self.re[j] * self.re[j] + self.im[j] * self.im[j]).sum();
        (e * UP, g * UP, p * UP)
    }
}

/// Values `F` in the scalar type with the vectors `v` they are made of.
pub(super) struct Values<S> {
    pub(super) f_re: [S; N],
    pub(super) f_im: [S; N],
    v_re: [[S; 4]; 6],
    v_im: [[S; 4]; 6],
}

/// Gradients at a point, with their bounds. Column `patch` holds the gradient by `g_3`, lane 7 is zero.
pub(super) struct Jacobian {
    pub(super) re: [[f64; 8]; N],
    pub(super) im: [[f64; 8]; N],
    /// Bound of a row's sum of error moduli, width of the data included.
    pub(super) error: [f64; N],
}

/// A vector of increments with the quantities that the second-order part needs.
pub(super) struct Increment {
    x: Study<f64>,
    v_re: [[f64; 4]; 6],
    v_im: [[f64; 4]; 6],
    /// `W` and `D` of the module's text.
    size: [f64; 6],
    error: [f64; 6],
}

/// The equations of one problem; see the module's text.
#[derive(Debug, Clone)]
pub(super) struct LegSystem {
    unit: f64,
    pub(super) a: [[f64; 3]; 6],
    pub(super) b: [[f64; 3]; 6],
    pub(super) d: [[f64; 3]; 6],
    pub(super) c: [[f64; 3]; 6],
    /// Doubles nearest to the middles of the squared lengths.
    pub(super) s: [f64; 6],
    /// The rest of the middles beyond these doubles: part of the data in double-double, an error of evaluations in
    /// double.
    pub(super) s_low: [f64; 6],
    /// Radii of the data about the middles.
    pub(super) s_radius: [f64; 6],
    pub(super) t: [f64; 6],
    /// The low parts of the joints beyond the doubles: part of the data in double-double and with 256 bits, within the
    /// radii in double.
    pub(super) a_low: [[f64; 3]; 6],
    pub(super) b_low: [[f64; 3]; 6],
    /// `tau_i`: how much the radii of the joints may change the absolute row sums of `T_i`; zero for joints that are
    /// their doubles.
    pub(super) turn_radius: [f64; 6],
    /// The same bound for the radii that remain beside the low parts.
    pub(super) low_turn_radius: [f64; 6],
    /// `|Q_i(h, k)| <= q_i` for all `h`, `k` with coordinates of modulus at most 1 and `h_patch = k_patch = 0`.
    pub(super) q: [f64; N],
    pub(super) second_order: SecondOrder,
}

/// `2^k <= x < 2^(k+1)` for a positive normal `x`.
pub(super) fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

/// `x * factor` for a power of two, `None` when that is not exact.
pub(super) fn exact_product(x: f64, factor: f64) -> Option<f64> {
    let y = x * factor;
    (y.is_finite() && (y / factor).to_bits() == x.to_bits()).then_some(y)
}

pub(super) fn scale_point(p: [f64; 3], factor: f64) -> Option<[f64; 3]> {
    Some([exact_product(p[0], factor)?, exact_product(p[1], factor)?, exact_product(p[2], factor)?])
}

/// At least `radius * factor`, zero only for zero.
pub(super) fn scaled_radius(radius: f64, factor: f64) -> f64 {
    if radius <= 0.0 { 0.0 } else { (radius * factor).next_up() }
}

/// Sums of absolute values in the four rows of `T`.
pub(super) fn row_sums(d: &[f64; 3], c: &[f64; 3]) -> [f64; 4] {
    let ([dx, dy, dz], [cx, cy, cz]) = (d.map(f64::abs), c.map(f64::abs));
    [dx + dy + dz, dx + cy + cz, dy + cx + cz, dz + cx + cy]
}

/// `v = g + T e`, real coefficients on one part of the coordinates.
pub(super) fn leg_vector<S: RealScalar>(d: &[S; 3], c: &[S; 3], x: &[S; 8]) -> [S; 4] {
    [
        x[4] - (d[0] * x[1] + d[1] * x[2] + d[2] * x[3]),
        (x[5] + d[0] * x[0]) + (x[2] * c[2] - x[3] * c[1]),
        (x[6] + d[1] * x[0]) + (x[3] * c[0] - x[1] * c[2]),
        (x[7] + d[2] * x[0]) + (x[1] * c[1] - x[2] * c[0]),
    ]
}

/// `-T v - s e = T^T v - s e`.
fn rotation_gradient(d: &[f64; 3], c: &[f64; 3], s: f64, v: &[f64; 4], e: &[f64]) -> [f64; 4] {
    [
        (d[0] * v[1] + d[1] * v[2] + d[2] * v[3]) - s * e[0],
        ((c[1] * v[3] - c[2] * v[2]) - d[0] * v[0]) - s * e[1],
        ((c[2] * v[1] - c[0] * v[3]) - d[1] * v[0]) - s * e[2],
        ((c[0] * v[2] - c[1] * v[1]) - d[2] * v[0]) - s * e[3],
    ]
}

/// Bound of the change of `F_i` when `T_i` changes by row sums of at most `tau`.
fn width_of_value(tau: f64, e: f64, v: f64) -> f64 {
    let omega = tau * e;
    2.0 * omega * (v + omega)
}

impl LegSystem {
    /// Scales the data by a power of two, exactly, so that they are of order one.
    pub(super) fn new(m: &Manipulator, s: &SquareData) -> Result<Self, WhyUncertified> {
        check_arithmetic()?;
        let legs = m.legs();
        let largest = |p: &nalgebra::Point3<f64>| p.iter().fold(0.0_f64, |x, y| x.max(y.abs()));
        let joints = legs.iter().map(|l| largest(&l.base).max(largest(&l.platform))).fold(0.0, f64::max);
        let radii = std::array::from_fn(|i| m.end_radius(i, Body::Base) + m.end_radius(i, Body::Platform));
        let largest = |i: usize| (s.middle[i].hi().abs() + s.radius[i]).sqrt();
        let size = (0..6).map(largest).fold(joints, f64::max);
        // outside these limits squares of the unit, or of scaled data, may leave the range of doubles
        if size > 1e-120 && size < 1e120 {
            let mut system =
                Self::scaled(&legs, &radii, s, power_of_two_below(size)).ok_or(WhyUncertified::OutOfRange)?;
            if radii.iter().any(|r| *r > 0.0) {
                system.set_low_parts(m).ok_or(WhyUncertified::OutOfRange)?;
            }
            Ok(system)
        } else {
            Err(WhyUncertified::OutOfRange)
        }
    }

    /// Sets the low parts of the joints, beyond the doubles, and the radii that remain then.
    fn set_low_parts(&mut self, m: &Manipulator) -> Option<()> {
        let inverse = self.unit.recip();
        for i in 0..6 {
            let [(a, rest_a), (b, rest_b)] = Body::BOTH.map(|body| m.end_low(i, body));
            self.a_low[i] = scale_point(a, inverse)?;
            self.b_low[i] = scale_point(b, inverse)?;
            // the low parts of `d` and `c` are sums of two, rounded once
            let largest = |p: &[f64; 3]| p.iter().fold(0.0_f64, |x, y| x.max(y.abs()));
            let rounding = U * (largest(&a) + largest(&b));
            let rest = 3.0 * (rest_a + rest_b + rounding) * UP;
            self.low_turn_radius[i] = scaled_radius(rest, inverse).min(self.turn_radius[i]);
        }
        Some(())
    }

    /// `radii` are the sums of the radii of both ends of the legs.
    fn scaled(
        legs: &[platform::manipulator::Leg; 6],
        radii: &[f64; 6],
        s: &SquareData,
        unit: f64,
    ) -> Option<Self> {
        let (inverse, mut system) = (unit.recip(), Self::empty(unit));
        for (i, leg) in legs.iter().enumerate() {
            system.a[i] = scale_point(leg.base.coords.into(), inverse)?;
            system.b[i] = scale_point(leg.platform.coords.into(), inverse)?;
            system.set_square(i, s.middle[i], s.radius[i], inverse * inverse)?;
            system.set_turn_radius(i, 3.0 * radii[i] * UP, inverse)?;
            system.prepare_leg(i);
        }
        Some(system)
    }

    /// The same problem with lengths divided by a larger unit: `g` weighs less against `e` in the norm of the proofs.
    /// `None` when that is not exact.
    pub(super) fn coarser(&self, factor: f64) -> Option<Self> {
        let (inverse, mut system) = (factor.recip(), Self::empty(self.unit * factor));
        for i in 0..6 {
            system.a[i] = scale_point(self.a[i], inverse)?;
            system.b[i] = scale_point(self.b[i], inverse)?;
            let middle = DoubleDouble::from_sum(self.s[i], self.s_low[i]);
            system.set_square(i, middle, self.s_radius[i], inverse * inverse)?;
            system.set_turn_radius(i, self.turn_radius[i], inverse)?;
            system.a_low[i] = scale_point(self.a_low[i], inverse)?;
            system.b_low[i] = scale_point(self.b_low[i], inverse)?;
            system.low_turn_radius[i] = scaled_radius(self.low_turn_radius[i], inverse);
            system.prepare_leg(i);
        }
        Some(system)
    }

    /// The squared length of leg `i` times a power of two, `None` when that is not exact.
    fn set_square(&mut self, i: usize, middle: DoubleDouble, radius: f64, factor: f64) -> Option<()> {
        self.s[i] = exact_product(middle.hi(), factor)?;
        // a low part so small that it underflows joins the radius, which is only ever too large
        let low = exact_product(middle.lo(), factor);
        self.s_low[i] = low.unwrap_or(0.0);
        let lost = if low.is_some() { 0.0 } else { (middle.lo().abs() * factor).next_up() };
        self.s_radius[i] = (scaled_radius(radius, factor) + lost) * UP;
        self.s_radius[i].is_finite().then_some(())
    }

    /// `tau` of leg `i` times a power of two, `None` when nothing is known of a joint.
    fn set_turn_radius(&mut self, i: usize, radius: f64, factor: f64) -> Option<()> {
        self.turn_radius[i] = scaled_radius(radius, factor);
        self.low_turn_radius[i] = self.turn_radius[i];
        self.turn_radius[i].is_finite().then_some(())
    }

    /// Largest distance of the squared length of leg `i` from the double that stands for it.
    pub(super) fn s_blur(&self, i: usize) -> f64 {
        (self.s_low[i].abs() + self.s_radius[i]) * UP
    }

    /// Computes the quantities that follow from joints and lengths.
    fn prepare_leg(&mut self, i: usize) {
        let (a, b) = (self.a[i], self.b[i]);
        self.d[i] = std::array::from_fn(|j| b[j] - a[j]);
        self.c[i] = std::array::from_fn(|j| b[j] + a[j]);
        self.second_order.set_leg(i, &self.d[i], &self.c[i], self.s[i]);
        let rows = row_sums(&self.d[i], &self.c[i]);
        // with the low parts of the joints
        self.t[i] = (rows.into_iter().fold(0.0, f64::max) + self.turn_radius[i]) * UP;
        let squares: f64 = rows.iter().map(|r| (1.0 + r) * (1.0 + r)).sum();
        let own = 0.5 * (squares + 3.0 * (self.s[i].abs() + self.s_blur(i)));
        self.q[i] = (own + self.joint_width_of_second_order(i)) * UP;
    }

    /// Bound of the change of `F_i` over the joints' radii. The coordinates `e` have modulus at most `e`, and the leg
    /// vector has norm at most `v`.
    pub(super) fn joint_width_of_value(&self, i: usize, e: f64, v: f64) -> f64 {
        width_of_value(self.turn_radius[i], e, v)
    }

    /// The same where the low parts of the joints are part of the data.
    pub(super) fn low_joint_width_of_value(&self, i: usize, e: f64, v: f64) -> f64 {
        width_of_value(self.low_turn_radius[i], e, v)
    }

    /// The same of the gradient of `F_i`: a bound of the sum over all eight coordinates.
    pub(super) fn joint_width_of_gradient(&self, i: usize, e: f64, v: f64) -> f64 {
        let (tau, omega) = (self.turn_radius[i], self.turn_radius[i] * e);
        4.0 * (omega + tau * v + (self.t[i] + tau) * omega)
    }

    /// The bound for `Q_i(h, k)` on the unit polydisc.
    pub(super) fn joint_width_of_second_order(&self, i: usize) -> f64 {
        let tau = self.turn_radius[i];
        tau * (4.0 * (1.0 + self.t[i]) + 2.0 * tau)
    }

    fn empty(unit: f64) -> Self {
        let (points, six) = ([[0.0; 3]; 6], [0.0; 6]);
        let (a, b, d, c) = (points, points, points, points);
        // F_7 = e.g: the three e_j other than the patch, each at most 1
        Self {
            unit,
            a,
            b,
            d,
            c,
            s: six,
            s_low: six,
            s_radius: six,
            t: six,
            a_low: points,
            b_low: points,
            turn_radius: six,
            low_turn_radius: six,
            q: [3.0; N],
            second_order: SecondOrder::ZERO,
        }
    }

    /// The power of two all lengths are divided by.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    /// `d` and `c` of leg `i`, of which `T_i` is made.
    pub(super) fn turn<S: RealScalar>(&self, i: usize) -> ([S; 3], [S; 3]) {
        let (a, b, low_a, low_b) = (&self.a[i], &self.b[i], &self.a_low[i], &self.b_low[i]);
        (
            std::array::from_fn(|k| S::sum_with(b[k], -a[k], low_b[k] - low_a[k])),
            std::array::from_fn(|k| S::sum_with(b[k], a[k], low_b[k] + low_a[k])),
        )
    }

    /// `F` for the middles of the `s`; in double for the doubles nearest to these.
    pub(super) fn values<S: RealScalar>(&self, x: &Study<S>) -> Values<S> {
        let zero = S::from(0.0);
        let half = S::from(0.5);
        let mut out = Values { f_re: [zero; N], f_im: [zero; N], v_re: [[zero; 4]; 6], v_im: [[zero; 4]; 6] };
        let square = |re: &[S], im: &[S]| {
            let term = |j: usize| re[j] * re[j] - im[j] * im[j];
            let twin = |j: usize| re[j] * im[j];
            ((term(0) + term(1)) + (term(2) + term(3)), (twin(0) + twin(1)) + (twin(2) + twin(3)))
        };
        let (n_re, n_half_im) = square(&x.re[..4], &x.im[..4]);
        for i in 0..6 {
            let (d, c) = self.turn(i);
            let (v_re, v_im) = (leg_vector(&d, &c, &x.re), leg_vector(&d, &c, &x.im));
            let (w_re, w_half_im) = square(&v_re, &v_im);
            let s = S::sum(self.s[i], self.s_low[i]);
            out.f_re[i] = half * (w_re - s * n_re);
            out.f_im[i] = w_half_im - s * n_half_im;
            (out.v_re[i], out.v_im[i]) = (v_re, v_im);
        }
        let dot = |a: &[S; 8], b: &[S; 8]| (a[0] * b[4] + a[1] * b[5]) + (a[2] * b[6] + a[3] * b[7]);
        out.f_re[6] = dot(&x.re, &x.re) - dot(&x.im, &x.im);
        out.f_im[6] = dot(&x.re, &x.im) + dot(&x.im, &x.re);
        out
    }

    /// Bounds of the error of `F` computed in the arithmetic with unit `unit`, and of the change of `F` over the radii.
    /// These are the radii of squared lengths and joints.
    pub(super) fn value_bounds(
        &self,
        x: &Study<f64>,
        values: &Values<f64>,
        unit: f64,
    ) -> ([f64; N], [f64; N]) {
        let (e, g, p) = x.magnitudes();
        let (mut rounding, mut width) = ([0.0; N], [0.0; N]);
        for i in 0..6 {
            let w = square_sum(&values.v_re[i], &values.v_im[i]);
            // |v| of the centre itself: off by delta through rounding and by less than delta through the
            // centre's digits below double, in each of four components
            let slack = w.sqrt() + 6.0 * self.delta(i, e, g, U);
            let delta = self.delta(i, e, g, unit);
            let own = 5.0 * unit * (slack * slack + self.s[i].abs() * p);
            let low = if unit < U { 0.0 } else { 0.5 * self.s_low[i].abs() * p };
            rounding[i] = (2.0 * delta * slack + 2.0 * delta * delta + own + low + TINY) * UP;
            let joints = if unit < U {
                self.low_joint_width_of_value(i, e, slack)
            } else {
                self.joint_width_of_value(i, e, slack)
            };
            width[i] = (0.5 * self.s_radius[i] * p + joints) * UP;
        }
        rounding[6] = (32.0 * unit * e * g + TINY) * UP;
        (rounding, width)
    }

    /// Increments of the seven unknowns, in the order of the columns of [`jacobian`](Self::jacobian).
    pub(super) fn increment(&self, h: &[Complex64; N], patch: usize) -> Increment {
        let mut x = Study { re: [0.0; 8], im: [0.0; 8], patch };
        for (k, z) in h.iter().enumerate() {
            let j = if k == patch { 7 } else { k };
            (x.re[j], x.im[j]) = (z.re, z.im);
        }
        let (e, g, _) = x.magnitudes();
        let (mut v_re, mut v_im) = ([[0.0; 4]; 6], [[0.0; 4]; 6]);
        let (mut size, mut error) = ([0.0; 6], [0.0; 6]);
        for i in 0..6 {
            (v_re[i], v_im[i]) =
                (leg_vector(&self.d[i], &self.c[i], &x.re), leg_vector(&self.d[i], &self.c[i], &x.im));
            size[i] = square_sum(&v_re[i], &v_im[i]).sqrt() * UP;
            error[i] = (self.delta(i, e, g, U) + self.turn_radius[i] * e) * UP;
        }
        Increment { x, v_re, v_im, size, error }
    }

    /// `Q(h, k)`, and bounds of its error, width of the data included.
    pub(super) fn second_order_part(&self, h: &Increment, k: &Increment) -> ([Complex64; N], [f64; N]) {
        let term = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
        let sum = |t: [(f64, f64); 4]| {
            ((t[0].0 + t[1].0) + (t[2].0 + t[3].0), (t[0].1 + t[1].1) + (t[2].1 + t[3].1))
        };
        let of = |x: &Increment, j: usize| (x.x.re[j], x.x.im[j]);
        let turn = sum(std::array::from_fn(|j| term(of(h, j), of(k, j))));
        let ((e_h, g_h, p_h), (e_k, g_k, p_k)) = (h.x.magnitudes(), k.x.magnitudes());
        let p = (p_h * p_k).sqrt();
        let (mut value, mut error) = ([Complex64::ZERO; N], [0.0; N]);
        for i in 0..6 {
            let of = |x: &Increment, r: usize| (x.v_re[i][r], x.v_im[i][r]);
            let v = sum(std::array::from_fn(|r| term(of(h, r), of(k, r))));
            let s = self.s[i];
            value[i] = Complex64::new(0.5 * (v.0 - s * turn.0), 0.5 * (v.1 - s * turn.1));
            let from_vectors =
                h.error[i] * k.size[i] + k.error[i] * h.size[i] + 2.0 * h.error[i] * k.error[i];
            let own = 5.0 * U * (h.size[i] * k.size[i] + s.abs() * p) + 0.5 * self.s_blur(i) * p;
            error[i] = (from_vectors + own + TINY) * UP;
        }
        let mixed = |x: &Increment, y: &Increment| sum(std::array::from_fn(|j| term(of(x, j), of(y, 4 + j))));
        let (one, other) = (mixed(h, k), mixed(k, h));
        value[6] = Complex64::new(0.5 * (one.0 + other.0), 0.5 * (one.1 + other.1));
        error[6] = (16.0 * U * (e_h * g_k + e_k * g_h) + TINY) * UP;
        (value, error)
    }

    /// Bounds `|sum_i y_i Q_i(h, k)|` on the unit polydisc, `weights` being the `|y_i|_1`; see the `second_order`
    /// module.
    pub(super) fn second_order_bound(
        &self,
        y_re: &[f64; 8],
        y_im: &[f64; 8],
        weights: &[f64; N],
        patch: usize,
    ) -> f64 {
        let (mut coarse, mut width) = (0.0, 0.0);
        for i in 0..N {
            coarse += weights[i] * self.q[i];
            if i < 6 {
                width += weights[i] * 1.5 * self.s_blur(i) + weights[i] * self.joint_width_of_second_order(i);
            }
        }
        (self.second_order.bound(y_re, y_im, patch) + width + 32.0 * U * coarse + TINY) * UP
    }

    fn delta(&self, i: usize, e: f64, g: f64, unit: f64) -> f64 {
        5.0 * unit * (g + self.t[i] * e) + TINY
    }

    /// Gradients at `x`, from the vectors `v` computed there.
    pub(super) fn jacobian(&self, x: &Study<f64>, values: &Values<f64>) -> Jacobian {
        let (e, g, _) = x.magnitudes();
        let mut out = Jacobian { re: [[0.0; 8]; N], im: [[0.0; 8]; N], error: [0.0; N] };
        for i in 0..6 {
            for (row, v, x) in
                [(&mut out.re[i], &values.v_re[i], &x.re), (&mut out.im[i], &values.v_im[i], &x.im)]
            {
                row[..4].copy_from_slice(&rotation_gradient(&self.d[i], &self.c[i], self.s[i], v, &x[..4]));
                row[4..].copy_from_slice(v);
            }
            let w = square_sum(&values.v_re[i], &values.v_im[i]);
            let (delta, s) = (self.delta(i, e, g, U), self.s[i].abs());
            let by_e = self.t[i] * delta + 5.0 * U * (self.t[i] * w.sqrt() + s * e) + self.s_blur(i) * e;
            // as for values: off by rounding, and by the digits of a centre beyond doubles
            let v = w.sqrt() + 6.0 * delta;
            let width = self.joint_width_of_gradient(i, e, v);
            out.error[i] = (4.0 * delta + 3.0 * by_e + width + TINY) * UP;
        }
        for (row, x) in [(&mut out.re[6], &x.re), (&mut out.im[6], &x.im)] {
            row[..4].copy_from_slice(&x[4..]); // exact
            row[4..].copy_from_slice(&x[..4]);
        }
        for row in out.re.iter_mut().chain(&mut out.im) {
            row[x.patch] = row[7];
            row[7] = 0.0;
        }
        out
    }
}

fn square_sum(re: &[f64; 4], im: &[f64; 4]) -> f64 {
    let part = |v: &[f64; 4]| (v[0] * v[0] + v[1] * v[1]) + (v[2] * v[2] + v[3] * v[3]);
    (part(re) + part(im)) * UP
}

#[cfg(test)]
mod tests;
