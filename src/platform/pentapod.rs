//! Five legs between two bodies, with exact joints.
//!
//! A pentapod with all joints of one body on a line is *linear*. Its legs determine the line, and the body rotates
//! freely about it (Borras, Thomas 2009; Nawratil, Schicho 2015). In the frame of its body the line is `o + mu d`, with
//! the joint `o` of leg 1. In the frame of the other body it is `p + mu v` with `v . v = d . d`. The leg from `a` to
//! the joint at `mu` thus has the squared length
//!
//! ```text
//! s = P + 2 mu Q + mu^2 d.d - 2 a.p - 2 mu a.v + a.a,    P = p.p,  Q = p.v
//! ```
//!
//! which is linear in the eight numbers `(P, Q, p, v)`.

use crate::manipulator::Body;
use num::exact::{ExactVector, Rational, rank, rational};

/// A point with rational coordinates.
pub type RationalPoint = [Rational; 3];

/// Number of unknowns in which the squared length of a leg to a line is linear: `P, Q, p, v`.
pub const LINE_NUMBERS: usize = 8;

/// The ends of five legs, each in the frame of its body, as rational numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pentapod {
    /// Ends on the base, in leg order.
    pub base: [RationalPoint; 5],
    /// Ends on the platform, in leg order.
    pub platform: [RationalPoint; 5],
}

impl Default for Pentapod {
    /// All ends in the origins.
    fn default() -> Self {
        let zero = || std::array::from_fn(|_| std::array::from_fn(|_| Rational::from_integer(0.into())));
        Self { base: zero(), platform: zero() }
    }
}

/// A pentapod whose joints of one body lie on a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LinearPentapod {
    /// The body with the line.
    pub body: Body,
    /// The joint of leg 1.
    pub origin: RationalPoint,
    /// From the joint of leg 1 to the joint farthest from it.
    pub direction: RationalPoint,
    /// Position of the joint of each leg on the line: `o + mu d`.
    pub marks: [Rational; 5],
    /// The ends on the other body.
    pub others: [RationalPoint; 5],
}

/// `x . y`.
pub fn dot(x: &RationalPoint, y: &RationalPoint) -> Rational {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// `x x y`.
pub fn cross(x: &RationalPoint, y: &RationalPoint) -> RationalPoint {
    let minor = |i: usize, j: usize| &x[i] * &y[j] - &x[j] * &y[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn difference(x: &RationalPoint, y: &RationalPoint) -> RationalPoint {
    std::array::from_fn(|k| &x[k] - &y[k])
}

/// `(1, x)` of each point.
fn homogeneous<'a>(points: impl IntoIterator<Item = &'a RationalPoint>) -> Vec<ExactVector> {
    let one = || std::iter::once(Rational::from_integer(1.into()));
    points.into_iter().map(|x| one().chain(x.iter().cloned()).collect()).collect()
}

/// The dimension of the flat that the points span: 0 a point, 1 a line, 2 a plane, 3 space.
fn flat_dimension<'a>(points: impl IntoIterator<Item = &'a RationalPoint>) -> usize {
    rank(&homogeneous(points)).saturating_sub(1)
}

/// All legs but one, of `count` whose ends do not lie on a line together, where the ends of these do. `dimension` is
/// that of the flat that the ends of some legs, counted from 0, span.
pub fn lines_without_one_leg(count: usize, dimension: impl Fn(&[usize]) -> usize) -> Vec<Vec<usize>> {
    let without = |left: usize| (0..count).filter(move |leg| *leg != left).collect::<Vec<_>>();
    if dimension(&(0..count).collect::<Vec<_>>()) == 1 {
        return Vec::new();
    }
    (0..count).map(without).filter(|legs| dimension(legs) == 1).collect()
}

/// The legs at each joint that so many of `count` legs share, and no more.
pub fn joints_of_legs(
    count: usize,
    shared_by: usize,
    dimension: impl Fn(&[usize]) -> usize,
) -> Vec<Vec<usize>> {
    let at_joint = |i: usize| (0..count).filter(|leg| dimension(&[i, *leg]) == 0).collect::<Vec<_>>();
    let own = |(i, legs): &(usize, Vec<usize>)| legs.len() == shared_by && legs[0] == *i;
    (0..count).map(|i| (i, at_joint(i))).filter(own).map(|(_, legs)| legs).collect()
}

impl Pentapod {
    /// Joints given as doubles, which are rational numbers; `None` if a coordinate is not finite.
    #[must_use]
    pub fn from_doubles(base: &[[f64; 3]; 5], platform: &[[f64; 3]; 5]) -> Option<Self> {
        let point = |x: &[f64; 3]| Some([rational(x[0])?, rational(x[1])?, rational(x[2])?]);
        let all = |points: &[[f64; 3]; 5]| {
            let list: Option<Vec<RationalPoint>> = points.iter().map(point).collect();
            list?.try_into().ok()
        };
        Some(Self { base: all(base)?, platform: all(platform)? })
    }

    /// The ends on a body.
    #[must_use]
    pub fn ends(&self, body: Body) -> &[RationalPoint; 5] {
        body.of((&self.base, &self.platform))
    }

    /// The dimension of the flat that the ends of these legs, counted from 0, span on a body.
    #[must_use]
    pub fn dimension(&self, body: Body, legs: &[usize]) -> usize {
        flat_dimension(legs.iter().map(|leg| &self.ends(body)[*leg]))
    }

    /// The pentapod about the line of one of its bodies, the platform first. `None` if no body has all joints on a
    /// line, or a body has all at one point.
    #[must_use]
    pub fn linear(&self) -> Option<LinearPentapod> {
        [Body::Platform, Body::Base].into_iter().find_map(|body| self.linear_on(body))
    }

    /// The same about a line of this body.
    #[must_use]
    pub fn linear_on(&self, body: Body) -> Option<LinearPentapod> {
        let ends = self.ends(body);
        if flat_dimension(ends) != 1 {
            return None;
        }
        let origin = ends[0].clone();
        let from_origin = ends.each_ref().map(|end| difference(end, &origin));
        let direction = from_origin.iter().max_by_key(|x| dot(x, x))?.clone();
        let square = dot(&direction, &direction);
        let marks = from_origin.each_ref().map(|x| dot(x, &direction) / &square);
        Some(LinearPentapod { body, origin, direction, marks, others: self.ends(body.other()).clone() })
    }
}

impl LinearPentapod {
    /// `d . d`.
    #[must_use]
    pub fn square(&self) -> Rational {
        dot(&self.direction, &self.direction)
    }

    /// The coefficients of `(P, Q, p, v)` in the squared length of each leg.
    #[must_use]
    pub fn rows(&self) -> [ExactVector; 5] {
        let integer = |x: i64| Rational::from_integer(x.into());
        std::array::from_fn(|i| {
            let (mu, a) = (&self.marks[i], &self.others[i]);
            let mut row = vec![integer(1), integer(2) * mu];
            row.extend(a.iter().map(|x| integer(-2) * x));
            row.extend(a.iter().map(|x| integer(-2) * mu * x));
            row
        })
    }

    /// The constant part of the squared length: `mu^2 d.d + a.a`.
    #[must_use]
    pub fn constants(&self) -> [Rational; 5] {
        let square = self.square();
        std::array::from_fn(|i| {
            &self.marks[i] * &self.marks[i] * &square + dot(&self.others[i], &self.others[i])
        })
    }

    /// The dimension of the flat that the ends on the other body span.
    #[must_use]
    pub fn other_dimension(&self) -> usize {
        flat_dimension(&self.others)
    }
}
