//! Rows of the Jacobian as functions of one offset each, in intervals.

use nalgebra::{Matrix3, Point3};

use crate::offsets::limits::{Vector, cross, dot, minus, plus, point, vector};
use num::ball::Real;
use num::interval::Interval;
use platform::geom::Pose;
use platform::manipulator::Body;
use synthesis::HexagonSide;

fn difference(a: &Point3<f64>, b: &Vector) -> Vector {
    minus(&vector(&a.coords), b)
}

fn turned(r: &Matrix3<f64>, v: &Vector) -> Vector {
    [0, 1, 2].map(|i| point(r[(i, 0)]) * v[0] + point(r[(i, 1)]) * v[1] + point(r[(i, 2)]) * v[2])
}

/// Row `i` of the Jacobian at a pose: `(constant + t rate) / sqrt(q0 + q1 t + q2 t^2)`.
///
/// `arm = R b` and `line = R b + p - a` are affine in `t`. The direction of the row is `line`, its moment
/// `arm x line / L = arm x (p - a) / L`. One of `arm` and `a` is independent of `t`, so the moment is affine too.
#[derive(Debug, Clone, Copy)]
pub(super) struct LegRow {
    constant: [Interval; 6],
    rate: [Interval; 6],
    /// `q0, q1, q2` of the squared length.
    square: [Interval; 3],
    plain: PlainRow,
    balls: Balls,
}

/// Constant, rate and squared length as balls.
type Balls = ([Real; 6], [Real; 6], [Real; 3]);

/// The same in plain arithmetic, for choices without proofs.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlainRow {
    constant: [f64; 6],
    rate: [f64; 6],
    square: [f64; 3],
}

impl PlainRow {
    /// Squared leg length at `t`.
    pub(super) fn square_at(&self, t: f64) -> f64 {
        self.square[0] + t * (self.square[1] + t * self.square[2])
    }

    /// `constant . v` and `rate . v`.
    pub(super) fn along(&self, v: &[f64; 6]) -> (f64, f64) {
        let dot = |row: &[f64; 6]| -> f64 { row.iter().zip(v).map(|(r, v)| r * v).sum() };
        (dot(&self.constant), dot(&self.rate))
    }
}

impl LegRow {
    /// The row from data in design units; `None` if `L` is no divisor.
    pub(super) fn new(side: &HexagonSide, pose: &Pose, characteristic_length: f64) -> Option<Self> {
        let r = pose.rotation.matrix();
        let edge = difference(&side.end, &vector(&side.start.coords));
        let zero = [Interval::ZERO; 3];
        let (base, base_rate, end, end_rate) = match side.sliding {
            Body::Base => (side.start, edge, side.fixed, zero),
            Body::Platform => (side.fixed, zero, side.start, edge),
        };
        let (arm, arm_rate) = (turned(r, &vector(&end.coords)), turned(r, &end_rate));
        let reach = minus(&vector(&pose.position), &vector(&base.coords));
        let (line, line_rate) = (plus(&arm, &reach), minus(&arm_rate, &base_rate));
        let moment = cross(&arm, &reach);
        let moment_rate = minus(&cross(&arm_rate, &reach), &cross(&arm, &base_rate));
        let length = point(characteristic_length);
        let stack = |force: Vector, moment: Vector| -> Option<[Interval; 6]> {
            let mut out = [Interval::ZERO; 6];
            for k in 0..3 {
                out[k] = force[k];
                out[k + 3] = moment[k].checked_div(length)?;
            }
            Some(out)
        };
        let (constant, rate) = (stack(line, moment)?, stack(line_rate, moment_rate)?);
        let square = [dot(&line, &line), point(2.0) * dot(&line, &line_rate), dot(&line_rate, &line_rate)];
        let centre = |x: Interval| x.centre_and_radius().0;
        let plain =
            PlainRow { constant: constant.map(centre), rate: rate.map(centre), square: square.map(centre) };
        let balls = (constant.map(Real::from), rate.map(Real::from), square.map(Real::from));
        Some(Self { constant, rate, square, plain, balls })
    }

    pub(super) fn plain(&self) -> &PlainRow {
        &self.plain
    }

    /// `constant`, `rate` and `q0, q1, q2` as balls.
    pub(super) fn balls(&self) -> &Balls {
        &self.balls
    }

    /// `c (row . v)^2` as the numerator `n0 + n1 t + n2 t^2` over the squared length.
    fn square_of(&self, v: &[f64; 6], c: Interval) -> [Interval; 3] {
        let along =
            |row: &[Interval; 6]| (0..6).map(|k| row[k] * point(v[k])).fold(Interval::ZERO, |s, x| s + x);
        let (a, b) = (along(&self.constant), along(&self.rate));
        [c * a.square(), c * point(2.0) * a * b, c * b.square()]
    }

    /// `(row . v)^2 / |v|^2 - limit (row . w)^2 / |w|^2` as a function of `t`; `None` when `v` or `w` is zero.
    pub(super) fn excess(&self, v: &[f64; 6], w: &[f64; 6], limit: Interval) -> Option<QuadraticQuotient> {
        let norm = |v: &[f64; 6]| v.iter().map(|x| point(*x).square()).fold(Interval::ZERO, |s, x| s + x);
        let one = point(1.0);
        let low = self.square_of(v, one.checked_div(norm(v))?);
        let high = self.square_of(w, limit.checked_div(norm(w))?);
        Some(QuadraticQuotient { numerator: [0, 1, 2].map(|k| low[k] - high[k]), square: self.square })
    }
}

/// `(n0 + n1 t + n2 t^2) / (q0 + q1 t + q2 t^2)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct QuadraticQuotient {
    numerator: [Interval; 3],
    square: [Interval; 3],
}

fn quadratic(c: &[Interval; 3], t: Interval) -> Interval {
    c[0] + t * (c[1] + t * c[2])
}

fn slope(c: &[Interval; 3], t: Interval) -> Interval {
    c[1] + point(2.0) * t * c[2]
}

impl QuadraticQuotient {
    /// Its values; `None` where the leg may have length zero.
    pub(super) fn value(&self, t: Interval) -> Option<Interval> {
        quadratic(&self.numerator, t).checked_div(quadratic(&self.square, t))
    }

    /// Its derivative, `(n' - f q') / q` with the value `f`.
    fn derivative(&self, t: Interval) -> Option<Interval> {
        let f = self.value(t)?;
        (slope(&self.numerator, t) - f * slope(&self.square, t)).checked_div(quadratic(&self.square, t))
    }
}

/// Number of parts of a range of an offset.
const PARTS: u32 = 8;

/// An upper bound of `sum mu f(t)` over `low <= t <= high`, in intervals. On each part it is the value in the middle
/// plus the derivative over the part times half its width (mean value form).
pub(super) fn greatest(terms: &[(f64, QuadraticQuotient)], (low, high): (f64, f64)) -> f64 {
    let cut = |k: u32| if k == PARTS { high } else { low + (high - low) * (f64::from(k) / f64::from(PARTS)) };
    let part = |k: u32| -> Option<f64> {
        let range = Interval::new(cut(k), cut(k + 1))?;
        let middle = range.centre_and_radius().0;
        let offset = range - point(middle);
        let (mut value, mut rate) = (Interval::ZERO, Interval::ZERO);
        for (mu, f) in terms {
            value = value + point(*mu) * f.value(point(middle))?;
            rate = rate + point(*mu) * f.derivative(range)?;
        }
        Some((value + rate * offset).hi())
    };
    (0..PARTS).map(|k| part(k).unwrap_or(f64::INFINITY)).fold(f64::NEG_INFINITY, f64::max)
}
