//! Legs as the rational numbers that their doubles are, for ranks that no tolerance decides.
//!
//! A point is homogeneous, `(1, x, y, z)`; the leg `(a, b)` is the vector `(1, a) (x) (1, b)` of `R^16`.

use nalgebra::Point3;

use super::{Body, Leg};
use crate::num::exact::{ExactVector, Rational, product, rank, rational};

/// A leg between two points in exact homogeneous coordinates, first coordinates 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ExactLeg {
    pub(crate) base: ExactVector,
    pub(crate) platform: ExactVector,
}

/// The six legs.
#[derive(Debug, Clone)]
pub(crate) struct ExactLegs {
    /// `(1, a_i)`.
    pub(crate) base: Vec<ExactVector>,
    /// `(1, b_i)`.
    pub(crate) platform: Vec<ExactVector>,
    /// `(1, a_i) (x) (1, b_i)`.
    pub(crate) vectors: Vec<ExactVector>,
}

/// `(1, x)`; `None` when a coordinate is not finite.
pub(crate) fn homogeneous(p: &Point3<f64>) -> Option<ExactVector> {
    [1.0, p.x, p.y, p.z].iter().map(|x| rational(*x)).collect()
}

/// Dimension of the flat of homogeneous points: 0 a point, 1 a line, 2 a plane, 3 space.
pub(crate) fn flat_dimension<'a>(points: impl IntoIterator<Item = &'a ExactVector>) -> usize {
    rank(&points.into_iter().cloned().collect::<Vec<_>>()).saturating_sub(1)
}

fn squares(a: &[Rational], b: &[Rational]) -> Rational {
    a[1..].iter().chain(&b[1..]).map(|x| x * x).sum()
}

impl ExactLeg {
    /// `None` when a coordinate is not finite, which no manipulator has.
    pub(crate) fn of(leg: &Leg) -> Option<Self> {
        Some(Self { base: homogeneous(&leg.base)?, platform: homogeneous(&leg.platform)? })
    }

    /// `(1, a) (x) (1, b)`.
    pub(crate) fn vector(&self) -> ExactVector {
        product(&self.base, &self.platform)
    }

    /// `|a|^2 + |b|^2`.
    pub(crate) fn squares(&self) -> Rational {
        squares(&self.base, &self.platform)
    }
}

impl ExactLegs {
    /// `None` when a coordinate is not finite, which no manipulator has.
    pub(crate) fn of(legs: &[Leg; 6]) -> Option<Self> {
        let legs = legs.iter().map(ExactLeg::of).collect::<Option<Vec<_>>>()?;
        let vectors = legs.iter().map(ExactLeg::vector).collect();
        let (base, platform) = legs.into_iter().map(|l| (l.base, l.platform)).unzip();
        Some(Self { base, platform, vectors })
    }

    /// The ends on `body`.
    pub(crate) fn ends(&self, body: Body) -> &[ExactVector] {
        body.of((&self.base, &self.platform))
    }

    /// Dimension of the flat of the ends of some legs on `body`.
    pub(crate) fn dimension(&self, body: Body, legs: &[usize]) -> usize {
        flat_dimension(legs.iter().map(|i| &self.ends(body)[*i]))
    }

    /// `|a|^2 + |b|^2` of a leg.
    pub(crate) fn squares(&self, leg: usize) -> Rational {
        squares(&self.base[leg], &self.platform[leg])
    }

    /// The vectors of some legs.
    pub(crate) fn vectors_of(&self, legs: &[usize]) -> Vec<ExactVector> {
        legs.iter().map(|i| self.vectors[*i].clone()).collect()
    }

    /// Rank of the vectors of some legs.
    pub(crate) fn rank(&self, legs: &[usize]) -> usize {
        rank(&self.vectors_of(legs))
    }
}
