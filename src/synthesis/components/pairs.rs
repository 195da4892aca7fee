//! Closed pairs of flats: which subsets of legs have to be looked at, exactly and within a tolerance.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::decision::{Decision, Question};
use super::exact::ExactLegs;
use super::flat::{Flat, spread};
use super::product::Product;
use crate::manipulator::Leg;
use crate::num::linalg::LinalgError;
use crate::synthesis::leg_vector::Normalisation;

/// Which reading of the joints a pair of flats belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reading {
    /// The doubles as rational numbers, and the tolerance as well.
    Both,
    /// The doubles as rational numbers only: within the tolerance the joints are more special, or less.
    ExactOnly,
    /// Within the tolerance only.
    ToleranceOnly,
}

impl Reading {
    /// The name used in JSON.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Both => "exact",
            Self::ExactOnly => "exact_only",
            Self::ToleranceOnly => "within_tolerance",
        }
    }
}

/// A closed pair: the legs between two flats that these legs span, and how it was decided.
#[derive(Debug, Clone)]
pub(super) struct ClosedPair {
    pub(super) legs: Vec<usize>,
    pub(super) base: usize,
    pub(super) platform: usize,
    pub(super) rank: usize,
    pub(super) reading: Reading,
    pub(super) product: Product,
    pub(super) decisions: Vec<Decision>,
}

/// The joints in both readings.
#[derive(Debug)]
pub(super) struct Ends {
    pub(super) base: [Vector3<f64>; 6],
    pub(super) platform: [Vector3<f64>; 6],
    pub(super) exact: ExactLegs,
    /// The legs in design units.
    pub(super) design: [Leg; 6],
    pub(super) tolerance: f64,
}

impl Ends {
    /// Ends of some legs.
    pub(super) fn of(&self, legs: &[usize]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        legs.iter().map(|i| (self.base[*i], self.platform[*i])).collect()
    }

    /// Design coordinates of a point: those of the joint where it is one.
    pub(super) fn design_point(&self, platform: bool, p: &Vector3<f64>, n: &Normalisation) -> Vector3<f64> {
        let joint = self.side(platform).iter().position(|q| q == p);
        match (joint, platform) {
            (Some(k), false) => self.design[k].base.coords,
            (Some(k), true) => self.design[k].platform.coords,
            (None, false) => n.base_centre.coords + p * n.base_unit,
            (None, true) => n.platform_centre.coords + p * n.platform_unit,
        }
    }

    pub(super) fn side(&self, platform: bool) -> &[Vector3<f64>; 6] {
        if platform { &self.platform } else { &self.base }
    }
}

pub(super) fn members(mask: usize) -> Vec<usize> {
    (0..6).filter(|i| mask >> i & 1 == 1).collect()
}

/// Dimensions of the flats of the ends of every subset of legs.
struct Dimensions {
    base: [usize; 64],
    platform: [usize; 64],
}

impl Dimensions {
    fn of(dimension: impl Fn(bool, &[usize]) -> Result<usize, LinalgError>) -> Result<Self, LinalgError> {
        let mut out = Self { base: [0; 64], platform: [0; 64] };
        for mask in 1..64 {
            out.base[mask] = dimension(false, &members(mask))?;
            out.platform[mask] = dimension(true, &members(mask))?;
        }
        Ok(out)
    }

    /// All legs between the flats of the legs of `mask`.
    fn closure(&self, mask: usize) -> usize {
        let inside = |i: &usize| {
            let more = mask | 1 << i;
            self.base[more] == self.base[mask] && self.platform[more] == self.platform[mask]
        };
        let next = (0..6).filter(inside).fold(mask, |m, i| m | 1 << i);
        // within a tolerance the union may span more than each leg alone
        let same = self.base[next] == self.base[mask] && self.platform[next] == self.platform[mask];
        if next == mask || !same { mask } else { self.closure(next) }
    }

    fn closed(&self) -> impl Iterator<Item = usize> + '_ {
        (1..64usize).filter(|m| m.count_ones() > 1 && self.closure(*m) == *m)
    }
}

/// All closed pairs that can hold a family, see `docs/theory/components.md`: `k' >= i + j + 1`, not both points.
pub(super) fn closed_pairs(ends: &Ends) -> Result<Vec<ClosedPair>, LinalgError> {
    let exact = Dimensions::of(|platform, legs| Ok(ends.exact.dimension(platform, legs)))?;
    let numerical = Dimensions::of(|platform, legs| {
        let points: Vec<Vector3<f64>> = legs.iter().map(|i| ends.side(platform)[*i]).collect();
        Ok(spread(&points)?.iter().filter(|s| **s > ends.tolerance).count())
    })?;
    // legs, i, j, rank -> (exact, within the tolerance)
    let mut found: BTreeMap<(usize, usize, usize, usize), (bool, bool)> = BTreeMap::new();
    for mask in exact.closed() {
        let rank = ends.exact.leg_rank(&members(mask));
        found.entry((mask, exact.base[mask], exact.platform[mask], rank)).or_default().0 = true;
    }
    for mask in numerical.closed() {
        let (i, j) = (numerical.base[mask], numerical.platform[mask]);
        let rank = product(ends, &members(mask), i, j, None)?.rank;
        found.entry((mask, i, j, rank)).or_default().1 = true;
    }
    let mut out = Vec::new();
    for ((mask, i, j, rank), (is_exact, is_numerical)) in found {
        if i + j == 0 || rank < i + j + 1 {
            continue;
        }
        let reading = match (is_exact, is_numerical) {
            (true, true) => Reading::Both,
            (true, false) => Reading::ExactOnly,
            _ => Reading::ToleranceOnly,
        };
        let legs = members(mask);
        let product = product(ends, &legs, i, j, Some(rank))?;
        let mut decisions = Vec::new();
        for (on_platform, question, used, by_exact) in [
            (false, Question::BaseDimension, i, exact.base[mask]),
            (true, Question::PlatformDimension, j, exact.platform[mask]),
        ] {
            let points: Vec<Vector3<f64>> = legs.iter().map(|k| ends.side(on_platform)[*k]).collect();
            let decision = Decision::rank(question, &spread(&points)?, 1.0, ends.tolerance);
            decisions.push(decision.taken(used).beside(Some(by_exact)));
        }
        decisions.push(product.decision.beside(Some(ends.exact.leg_rank(&legs))));
        out.push(ClosedPair { legs, base: i, platform: j, rank, reading, product, decisions });
    }
    Ok(out)
}

fn product(
    ends: &Ends,
    legs: &[usize],
    i: usize,
    j: usize,
    rank: Option<usize>,
) -> Result<Product, LinalgError> {
    let pairs = ends.of(legs);
    let base = Flat::nearest(&pairs.iter().map(|p| p.0).collect::<Vec<_>>(), i)?;
    let platform = Flat::nearest(&pairs.iter().map(|p| p.1).collect::<Vec<_>>(), j)?;
    Product::new(base, platform, &pairs, rank, ends.tolerance)
}

/// All six legs between the flats they span within the tolerance.
pub(super) fn whole(ends: &Ends) -> Result<ClosedPair, LinalgError> {
    let legs: Vec<usize> = (0..6).collect();
    let dimension = |platform: bool| -> Result<usize, LinalgError> {
        Ok(spread(ends.side(platform))?.iter().filter(|s| **s > ends.tolerance).count())
    };
    let (i, j) = (dimension(false)?, dimension(true)?);
    let product = product(ends, &legs, i, j, None)?;
    let same = ends.exact.dimension(false, &legs) == i
        && ends.exact.dimension(true, &legs) == j
        && ends.exact.leg_rank(&legs) == product.rank;
    let reading = if same { Reading::Both } else { Reading::ToleranceOnly };
    let decisions = vec![product.decision.beside(Some(ends.exact.leg_rank(&legs)))];
    Ok(ClosedPair { legs, base: i, platform: j, rank: product.rank, reading, product, decisions })
}
