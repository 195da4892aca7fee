//! Finds all families of replaceable legs of a design.
//!
//! Let `v_1, .., v_6` be the vectors of the six legs (see [`leg_vector`](super::leg_vector())). The squared length of a
//! leg `(a, b)` is an affine function of theirs exactly if `(1, a) (x) (1, b)` lies in their span. The leg may then
//! replace one of the legs in its combination. These legs form a variety. This module lists its components of positive
//! dimension with formulas and their inclusions.
//!
//! Let a combination of `k'` independent legs, all of them used, be a leg between the flats of dimensions `i` and `j`
//! that they span. Then `k' >= i + j + 1`, by Sylvester's inequality for the rank of `sum c_l (1, a_l) (1, b_l)^T`. So
//! six legs need a search of only these pairs of flats. They are a point and any flat, two lines (`k' = 3, 4`), line
//! and plane (4, 5, 6), and line and space (5, 6). Two planes (5, 6) and plane and space (6) complete the list. Proofs
//! and formulas: `docs/theory/components.md`.

mod component;
pub(super) mod exact;
mod exact_curve;
mod exact_form;
mod flats;
mod form;
mod found;
mod planes;
mod search;
mod shape;
pub(super) mod spectrum;
#[cfg(test)]
mod tests;

use nalgebra::Point3;
use thiserror::Error;

pub use self::exact_form::ExactKind;
pub use self::flats::Reading;
pub use self::form::{PartKind, SingularKind};
pub use self::planes::{CurvePart, Partners, PlaneCurve, PlanePair, SingularPoint, curve_value};
pub use self::shape::{CubicPencil, MovingPoint, Parametrisation};
pub use self::spectrum::{Decision, Question};
pub use component::{Component, FamilyKind, SampledLeg, flat_name};
pub use exact_curve::{ExactCurve, ExactPart, ExactPoint, NoExactCurve};

use self::flats::{BothReadings, ClosedPair, closed_pairs};
use self::search::FamilySearch;
use super::leg_vector::{LegSpan, Normalisation};
use num::Rng;
use num::algebraic::Algebraic;
use num::linalg::LinalgError;
use platform::manipulator::{
    AlgebraicVector, Body, ExactLegs, Leg, LegIndex, Level, Manipulator, homogeneous,
};

/// Limits of [`components`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComponentOptions {
    /// Threshold for zero in the numerical reading, for singular values, distances and residuals. It is relative to the
    /// size of the body, the largest singular value or the norm of the equation.
    pub tolerance: f64,
    /// Seed of the generic points.
    pub seed: u64,
}

impl Default for ComponentOptions {
    /// `1e-9`, seed 1.
    fn default() -> Self {
        Self { tolerance: 1e-9, seed: 1 }
    }
}

/// Reasons why there is no answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ComponentsError {
    /// The tolerance is not between 0 and 1/10.
    #[error("the tolerance {0} is not between 1e-14 and 0.1")]
    Tolerance(f64),
    /// A decomposition failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// A coordinate is not finite.
    #[error("a joint has a coordinate that is not a finite number")]
    NonFinite,
}

/// A pair of flats that its legs span, with the decisions about it.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatPair {
    /// The legs between the two flats.
    pub legs: Vec<LegIndex>,
    /// Dimension of the base flat.
    pub base: usize,
    /// Dimension of the platform flat.
    pub platform: usize,
    /// Rank of the leg vectors.
    pub rank: usize,
    /// `k' - 1 - i j`, or `i + j` if every pair of points is replaceable.
    pub expected_dimension: isize,
    /// Largest dimension of a family found between the flats.
    pub dimension: usize,
    /// The reading of the joints in which it exists.
    pub reading: Reading,
    /// Dimensions and rank with their gaps.
    pub decisions: Vec<Decision>,
}

/// All families of a design.
#[derive(Debug, Clone)]
pub struct Components {
    /// Irreducible families of dimension 1 or more, including those contained in others.
    pub components: Vec<Component>,
    /// The searched pairs of flats.
    pub pairs: Vec<FlatPair>,
    /// Pairs of planes with their curves.
    pub planes: Vec<PlanePair>,
    /// Rank of the six leg vectors.
    pub leg_rank: Decision,
    /// Reasons why the list may be incomplete (in the numerical reading); empty if it is complete.
    pub doubts: Vec<String>,
    /// The span of the six legs, for sampling.
    pub span: LegSpan,
    /// The options used.
    pub options: ComponentOptions,
}

/// All families of replaceable legs of `m`.
///
/// Every rank is decided twice: exactly, on the joints as exact numbers, and within the tolerance. The families of both
/// readings are listed with their reading ([`Component::exact`]).
///
/// # Errors
/// [`ComponentsError`].
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_synthesis as synthesis; pub use platform::manipulator; } }
/// use equipod::methods::manipulator::{Leg, Manipulator};
/// use equipod::methods::synthesis::components::{ComponentOptions, components};
/// use nalgebra::Point3;
/// let joint = |r: f64, k: u32| {
///     let (s, c) = (std::f64::consts::TAU * f64::from(k) / 3.0).sin_cos();
///     Point3::new(r * c, r * s, 0.0)
/// };
/// let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
/// let legs = hexagon.map(|(i, j)| Leg { base: joint(2.0, i), platform: joint(1.0, j) });
/// let found = components(&Manipulator::from_legs(legs)?, ComponentOptions::default())?;
/// let lines = found.components.iter().filter(|c| c.type_name() == "point-line").count();
/// assert_eq!((found.components.len(), lines), (6, 6)); // the sides of the hexagon, and nothing else
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn components(m: &Manipulator, options: ComponentOptions) -> Result<Components, ComponentsError> {
    if !(1e-14..=0.1).contains(&options.tolerance) {
        return Err(ComponentsError::Tolerance(options.tolerance));
    }
    let n = Normalisation::of(m);
    let legs = m.legs();
    let scaled = legs.map(|l| n.apply(&l));
    let all: Vec<usize> = (0..6).collect();
    let exact = ExactLegs::of(m);
    let ends = BothReadings {
        base: scaled.map(|l| l.base.coords),
        platform: scaled.map(|l| l.platform.coords),
        constructed: exact.is_some() && m.level() == Level::ExactJoints,
        exact: exact.or_else(|| ExactLegs::of_doubles(&legs)).ok_or(ComponentsError::NonFinite)?,
        design: legs,
        normalisation: n,
        tolerance: options.tolerance,
    };
    let exact_rank = ends.exact.rank(&all);
    let mut span = LegSpan::of(m, options.tolerance)?;
    let leg_rank = leg_rank(&span, exact_rank, options.tolerance);
    if !span.is_well_conditioned(exact_rank)
        && let Some(basis) = ends.basis(&all)
    {
        span = span.with_basis(&basis)?;
    }
    let mut pairs = closed_pairs(&ends)?;
    // families of the exact data first; those within the tolerance only are compared with them
    pairs.sort_by_key(|p| (p.reading == Reading::ToleranceOnly, p.base.min(p.platform), p.base + p.platform));
    let mut search = FamilySearch {
        ends: &ends,
        span: &span,
        rng: Rng::new(options.seed),
        found: Vec::new(),
        planes: Vec::new(),
        doubts: Vec::new(),
    };
    for (index, pair) in pairs.iter().enumerate() {
        search.pair(index, pair)?;
    }
    for whole in flats::whole(&ends)? {
        search.joints(&whole)?;
    }
    let mut planes = Vec::new();
    for (index, base, platform) in std::mem::take(&mut search.planes) {
        let pair = &pairs[index];
        let (sides, rng) = ((&base, &platform), &mut search.rng);
        planes.push(planes::plane_pair(index, pair, sides, &n, options.tolerance, rng)?);
    }
    let components = ordered(&mut search)?;
    let mut doubts = search.doubts;
    if leg_rank.value != leg_rank.numerical && !ends.constructed {
        doubts.push(format!(
            "the joints as written have leg vectors of rank {}, of rank {} within the tolerance: rounding decides which families exist",
            leg_rank.value, leg_rank.numerical
        ));
    }
    let pairs = pairs.iter().map(|p| record(p, &components)).collect();
    Ok(Components { components, pairs, planes, leg_rank, doubts, span, options })
}

/// The rank of the leg vectors: that of the joints, exact or as written, which the tolerance does not affect.
fn leg_rank(span: &LegSpan, exact: usize, tolerance: f64) -> Decision {
    let values = span.singular_values();
    Decision::rank(Question::LegRank, &values, values[0], tolerance).beside(Some(exact)).taken(exact)
}

/// Whether the vector of a leg is a combination of those of six, with all coordinates as rational numbers.
#[must_use]
pub fn exactly_replaceable(legs: &[Leg; 6], leg: &Leg) -> bool {
    ExactLegs::of_doubles(legs).is_some_and(|six| exact::contains(&six, leg))
}

/// Homogeneous partners of a point of one body: the `y` that form with it a leg in the span of the given legs. Exact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ExactPartners {
    /// Dimension of their space; zero is a proof that no replaceable leg ends there.
    pub(super) dimension: usize,
    /// Dimension of the part of it at infinity.
    pub(super) at_infinity: usize,
}

/// The partners of a point in combinations of the legs `among`.
pub(super) fn exact_partners(
    legs: &[Leg; 6],
    body: Body,
    point: &Point3<f64>,
    among: &[usize],
) -> Option<ExactPartners> {
    let x: AlgebraicVector = homogeneous(point)?.into_iter().map(Algebraic::Rational).collect();
    let exact = ExactLegs::of_doubles(legs)?;
    Some(ExactPartners {
        dimension: exact::fibre(&exact, body, &x, among),
        at_infinity: exact::fibre_at_infinity(&exact, body, &x, among),
    })
}

fn record(p: &ClosedPair, components: &[Component]) -> FlatPair {
    let (i, j) = (p.base, p.platform);
    let full = p.rank == (i + 1) * (j + 1);
    let legs: Vec<LegIndex> = p.legs.iter().filter_map(|k| LegIndex::new(*k)).collect();
    let inside = |c: &&Component| {
        c.base_span <= i && c.platform_span <= j && c.support.iter().all(|l| legs.contains(l))
    };
    FlatPair {
        dimension: components.iter().filter(inside).map(|c| c.dimension).max().unwrap_or(0),
        legs,
        base: i,
        platform: j,
        rank: p.rank,
        expected_dimension: if full {
            (i + j).cast_signed()
        } else {
            p.rank.cast_signed() - 1 - (i * j).cast_signed()
        },
        reading: p.reading,
        decisions: p.decisions.clone(),
    }
}

/// The families in a fixed order, with their inclusions.
fn ordered(search: &mut FamilySearch<'_>) -> Result<Vec<Component>, LinalgError> {
    search.found.sort_by(|(_, a), (_, b)| {
        let key = |c: &Component| {
            let (low, high) = (c.base_span.min(c.platform_span), c.base_span.max(c.platform_span));
            (low, high, c.dimension, c.exact == Some(false), c.base_span, c.legs.clone(), c.support.clone())
        };
        key(a).cmp(&key(b))
    });
    let limit = search.near();
    let count = search.found.len();
    for k in 0..count {
        let component = search.found[k].1.clone();
        let samples = search.samples(&component, 4)?;
        let mut inside = Vec::new();
        for (l, (found, other)) in search.found.iter().enumerate() {
            if other.dimension <= component.dimension || samples.is_empty() {
                continue;
            }
            let mut all = true;
            for (a, b) in &samples {
                all &= found.shape.distance(a, b) <= limit;
            }
            if all {
                inside.push(l);
            }
        }
        search.found[k].1.contained_in = inside;
    }
    Ok(search.found.iter().map(|(_, c)| c.clone()).collect())
}
