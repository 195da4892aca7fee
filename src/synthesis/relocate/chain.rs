//! Moves made one after another.

use super::Relocation;
use crate::manipulator::Manipulator;
use crate::num::linalg::LinalgError;
use crate::synthesis::leg_map::{AffineLegMap, LegMapOutcome, LegMapTolerances, leg_map_to_legs};

/// A sequence of moves as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The map composed of those of the steps.
    pub composed: AffineLegMap,
    /// The map computed from the first platform and the legs of the last one.
    pub direct: LegMapOutcome,
    /// Largest difference of the two matrices over the largest entry, and of the constants over the squared size: rounding, when all is well.
    pub disagreement: f64,
}

impl Chain {
    /// Composes moves that were made one after another from `first`; a singular one can only be the last.
    ///
    /// # Errors
    /// When a decomposition does not converge.
    pub fn of(
        first: &Manipulator,
        steps: &[Relocation],
        tolerances: LegMapTolerances,
    ) -> Result<Self, LinalgError> {
        let composed = steps.iter().fold(AffineLegMap::identity(), |map, s| map.then(&s.map.closest));
        let legs = steps.last().map_or(first.legs(), |s| s.assembled.legs);
        let direct = leg_map_to_legs(first, &legs, tolerances)?;
        let top = composed.a.abs().max().max(1.0);
        let matrices = (composed.a - direct.closest.a).abs().max() / top;
        let constants = (composed.c - direct.closest.c).abs().max() / (first.size() * first.size() * top);
        Ok(Self { composed, direct, disagreement: matrices.max(constants) })
    }
}
