//! A design as a span about its own origins, and how far two such spans are apart at best.

use super::super::leg_vector::Normalisation;
use super::axes::{Axes, Projector};
use super::candidates::{Candidates, candidates, turned};
use super::centre::{Centred, centred};
use super::leg_space::{LegSpace, coordinates};
use crate::manipulator::{Leg, Manipulator};
use crate::num::Rng;
use crate::num::linalg::LinalgError;
use nalgebra::Vector3;

/// Size of the trial changes of joints that measure sensitivities, in units of the body; below the tolerance of every rank.
const TRIAL: f64 = 1e-11;
/// How many of them.
const TRIALS: u64 = 3;

/// A design in normalised coordinates, its span about its own origins, and the numbers that no rigid motion changes.
#[derive(Debug, Clone)]
pub(super) struct Canonical {
    pub(super) normalisation: Normalisation,
    pub(super) legs: [Leg; 6],
    pub(super) span: Centred,
    pub(super) projector: Projector,
    /// Principal values of base and platform.
    pub(super) values: [f64; 6],
}

impl Canonical {
    pub(super) fn of(m: &Manipulator, units: &Normalisation) -> Result<Self, LinalgError> {
        let normalisation = coordinates(m, units);
        Self::from_legs(normalisation, &m.legs().map(|leg| normalisation.apply(&leg)))
    }

    fn from_legs(normalisation: Normalisation, legs: &[Leg; 6]) -> Result<Self, LinalgError> {
        let span = centred(&LegSpace::of(legs)?)?;
        let projector = span.space.projector();
        let (x, y) = (Axes::of_base(&projector, None).values, Axes::of_platform(&projector, None).values);
        let values = [x[0], x[1], x[2], y[0], y[1], y[2]];
        Ok(Self { normalisation, legs: *legs, span, projector, values })
    }

    /// The legs about the origins of the span.
    pub(super) fn centred_legs(&self) -> [Leg; 6] {
        let (s, t) = self.span.shift;
        self.legs.map(|leg| Leg { base: leg.base + s, platform: leg.platform + t })
    }

    /// How much the principal values and the canonical form change for a change of the joints by one unit of their body, to first order.
    pub(super) fn sensitivity(&self, seed: u64) -> Result<Sensitivity, LinalgError> {
        let mut most = Sensitivity { values: [0.0; 6], distance: 0.0 };
        for trial in 0..TRIALS {
            let mut rng = Rng::stream(seed, trial);
            let mut change = || Vector3::from_fn(|_, _| rng.normal() * TRIAL);
            let legs =
                self.legs.map(|leg| Leg { base: leg.base + change(), platform: leg.platform + change() });
            let near = Self::from_legs(self.normalisation, &legs)?;
            for (most, (x, y)) in most.values.iter_mut().zip(self.values.iter().zip(near.values)) {
                *most = most.max((x - y).abs() / TRIAL);
            }
            most.distance = most.distance.max(self.nearest(&near, seed).0 / TRIAL);
        }
        Ok(most)
    }

    /// The smallest distance of the projectors over all candidates, and the candidates.
    pub(super) fn nearest(&self, other: &Self, seed: u64) -> (f64, Candidates) {
        let found = candidates(&self.projector, &other.projector, seed);
        let distances = found.turns.iter().map(|t| (self.projector - turned(&other.projector, t)).norm());
        (distances.fold(f64::INFINITY, f64::min), found)
    }
}

/// Largest changes seen, per unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sensitivity {
    pub(super) values: [f64; 6],
    pub(super) distance: f64,
}
