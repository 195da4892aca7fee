//! A family of replaceable legs, as returned by the search.

use super::shape::Parametrisation;
use super::spectrum::{Decision, real_roots};
use crate::leg_vector::LegSpan;
use num::Rng;
use num::linalg::LinalgError;
use platform::manipulator::{Leg, LegIndex};

/// The name of a flat by its dimension.
#[must_use]
pub fn flat_name(dimension: usize) -> &'static str {
    match dimension {
        0 => "point",
        1 => "line",
        2 => "plane",
        _ => "space",
    }
}

num::words! {
    /// The kind of curve or surface of a family of legs.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum FamilyKind: name {
        /// Every leg between two flats.
        AllPairs = "all_pairs",
        /// For every point of a line of one body a flat of points of the other; polynomials of these degrees.
        OverLine = "over_line",
        /// The same for the points of a conic.
        OverConic = "over_conic",
        /// One partner for every point of a plane.
        OverPlane = "over_plane",
        /// An irreducible plane cubic, and its partner.
        OverCubic = "over_cubic",
    }
}

/// One irreducible family of replaceable legs.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// The pairing of its ends.
    pub kind: FamilyKind,
    /// Dimension of the flat that its base ends span.
    pub base_span: usize,
    /// Dimension of the flat that its platform ends span.
    pub platform_span: usize,
    /// Dimension.
    pub dimension: usize,
    /// Legs of the manipulator that belong to the family.
    pub legs: Vec<LegIndex>,
    /// Legs whose squared lengths combine to those of its legs.
    pub support: Vec<LegIndex>,
    /// Formulas.
    pub parametrisation: Parametrisation,
    /// `Some(true)`: the design has this family exactly, with its doubles as rational numbers. `Some(false)`: it exists
    /// only within the tolerance. `None`: found in floating point and undecided.
    pub exact: Option<bool>,
    /// The numbers of the decisions.
    pub decisions: Vec<Decision>,
    /// Indices of the larger families that contain this one.
    pub contained_in: Vec<usize>,
    /// Parameters at which an end is at infinity, for rational families with one parameter.
    pub at_infinity: Vec<f64>,
}

/// A leg drawn from a family, with its check.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledLeg {
    /// The leg.
    pub leg: Leg,
    /// Its parameters.
    pub parameters: Vec<f64>,
    /// Coefficients of its vector in the six leg vectors (the shortest ones if these are dependent).
    pub coefficients: [f64; 6],
    /// Distance of its vector from the span of the six, over its length.
    pub residual: f64,
}

impl Component {
    /// The type, for example `"point-line"`, with the smaller flat first.
    #[must_use]
    pub fn type_name(&self) -> String {
        let (low, high) = (self.base_span.min(self.platform_span), self.base_span.max(self.platform_span));
        format!("{}-{}", flat_name(low), flat_name(high))
    }

    /// A random leg at moderate parameters with both ends within a few sizes of the joints. `None` after 200 attempts
    /// without success, since the family has no real leg there.
    ///
    /// # Errors
    /// When a singular value decomposition does not converge.
    pub fn sample(&self, span: &LegSpan, rng: &mut Rng) -> Result<Option<SampledLeg>, LinalgError> {
        self.sample_within(6.0, span, rng)
    }

    /// The same with both ends within `limit` sizes.
    pub(super) fn sample_within(
        &self,
        limit: f64,
        span: &LegSpan,
        rng: &mut Rng,
    ) -> Result<Option<SampledLeg>, LinalgError> {
        for _ in 0..200 {
            let parameters: Vec<f64> = (0..self.parametrisation.parameters())
                .map(|_| match self.kind {
                    FamilyKind::OverCubic => rng.uniform(0.0, 2.0),
                    FamilyKind::OverConic => (rng.uniform(-1.45, 1.45)).tan(),
                    _ => rng.uniform(-0.75, 1.75),
                })
                .collect();
            let Some(leg) = self.parametrisation.leg_at(&parameters)? else { continue };
            let n = span.normalisation();
            let reach = n.apply(&leg);
            if reach.base.coords.norm().max(reach.platform.coords.norm()) < limit {
                let (coefficients, residual) = (span.coefficients(&leg), span.distance(&leg));
                return Ok(Some(SampledLeg { leg, parameters, coefficients, residual }));
            }
        }
        Ok(None)
    }
}

/// Parameters at which an end of a rational family with one parameter is at infinity.
pub(super) fn infinite_parameters(p: &Parametrisation) -> Result<Vec<f64>, LinalgError> {
    let Parametrisation::Rational { parameters: 1, base, platform } = p else { return Ok(Vec::new()) };
    let mut out = real_roots(&base.denominator())?;
    out.extend(real_roots(&platform.denominator())?);
    out.sort_by(f64::total_cmp);
    Ok(out)
}
