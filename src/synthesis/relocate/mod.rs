//! Moving legs along families of replaceable legs, of any platform.
//!
//! With `v' = sum c_l v_l` the vector of a replaceable leg (see [`components`](super::components)), putting it in the place of leg `k` gives the
//! leg map whose row `k` is `c` and whose other rows are those of the identity: `det A = c_k`. Several legs moved together give the matrix with
//! their rows `c`; its determinant decides, not those of the single moves.
//!
//! A regular move does not change the span of the six leg vectors. So **the families never change**, whatever is moved, and every platform equivalent to a
//! given one is reached by single moves in a suitable order (`docs/theory/moves.md`).
//!
//! [`relocate`] moves legs, [`Chain`] composes moves made one after another, [`search`](mod@search) looks for equivalent platforms that fulfil wishes.

mod between;
mod chain;
mod counted_from;
mod joints;
pub mod search;
mod singular;
#[cfg(test)]
mod tests;

use thiserror::Error;

pub use between::{family_between, spanning_joints};
pub use chain::Chain;
pub use counted_from::counted_from;
pub use joints::{Assembled, JointOrigin};
pub use singular::SingularParameters;

use super::components::{Component, Components, Parametrisation, exactly_replaceable};
use super::leg_map::{LegMapOutcome, LegMapTolerances, Relation, leg_map_to_legs};
use crate::manipulator::{Leg, LegIndex, Manipulator};
use crate::num::linalg::LinalgError;

/// One leg and where it is to go.
#[derive(Debug, Clone, PartialEq)]
pub struct LegMove {
    /// The leg that is replaced.
    pub leg: LegIndex,
    /// Index of the family in [`Components::components`], from 0.
    pub family: usize,
    /// Parameters of the new leg, as many as the family has dimensions.
    pub parameters: Vec<f64>,
    /// Formulas the parameters are meant for, if not those of the family itself (see [`counted_from()`]).
    pub formulas: Option<Parametrisation>,
}

impl LegMove {
    /// The formulas its parameters are meant for.
    fn formulas<'a>(&'a self, family: &'a Component) -> &'a Parametrisation {
        self.formulas.as_ref().unwrap_or(&family.parametrisation)
    }
}

/// A leg that was moved.
#[derive(Debug, Clone, PartialEq)]
pub struct MovedLeg {
    /// What was asked.
    pub request: LegMove,
    /// The old leg.
    pub from: Leg,
    /// The new leg, its coordinates as doubles; an end that is a joint of the platform within rounding has the coordinates of that joint.
    pub to: Leg,
    /// Coefficients of its vector in those of the six legs it was moved from: the row of `A`.
    pub coefficients: [f64; 6],
    /// Distance of its vector from their span over its length.
    pub residual: f64,
    /// Whether the doubles of the new joints, as rational numbers, fulfil the span condition exactly. In general they are rounded and do not.
    pub exact: bool,
    /// Where on the family the determinant of the whole move vanishes, the other moves and the other parameters being what they are.
    pub singular: SingularParameters,
}

/// Legs moved together.
#[derive(Debug, Clone, PartialEq)]
pub struct Relocation {
    /// The new platform with the origin of its joints.
    pub assembled: Assembled,
    /// What became of each leg that was moved.
    pub moved: Vec<MovedLeg>,
    /// The map from the old platform, with the relation.
    pub map: LegMapOutcome,
}

impl Relocation {
    /// Whether the new platform is equivalent to the old one.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.map.relation == Relation::Equivalent
    }
}

/// Why legs cannot be moved as asked.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RelocateError {
    /// There is no such family.
    #[error("there is no family {}, the platform has {count}", index + 1)]
    NoSuchFamily {
        /// The index asked for, from 0.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A family has another number of parameters.
    #[error("family {} has {expected} parameter(s), {given} given", family + 1)]
    ParameterCount {
        /// The family, from 0.
        family: usize,
        /// Its dimension.
        expected: usize,
        /// What was given.
        given: usize,
    },
    /// An end is at infinity at these parameters, or they belong to no real leg.
    #[error("family {} has no leg at {parameters:?}: an end is at infinity or not real", family + 1)]
    NoLeg {
        /// The family, from 0.
        family: usize,
        /// The parameters.
        parameters: Vec<f64>,
    },
    /// The coefficient of the leg is zero all along the family.
    #[error("{leg} cannot be replaced by a leg of family {}: their squared lengths do not depend on its", family + 1)]
    NotCarried {
        /// The leg.
        leg: LegIndex,
        /// The family, from 0.
        family: usize,
    },
    /// A leg is moved twice at once.
    #[error("{0} is moved twice together")]
    Twice(LegIndex),
    /// A decomposition failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

/// Moves legs together: the families are those of `m`, [`components`](super::components::components())`(m, ..)`, for all of them.
///
/// The answer with `det A = 0` is a value too: [`Relation::Singular`], with the parameters where that happens. A single move of a leg on which the family does not
/// depend at all is refused.
///
/// ```
/// use equipod::methods::manipulator::{Leg, LegIndex, Manipulator};
/// use equipod::methods::synthesis::components::{ComponentOptions, components};
/// use equipod::methods::synthesis::relocate::{LegMove, relocate};
/// use equipod::methods::synthesis::LegMapTolerances;
/// use nalgebra::Point3;
/// let joint = |r: f64, k: u32| {
///     let (s, c) = (std::f64::consts::TAU * f64::from(k) / 3.0).sin_cos();
///     Point3::new(r * c, r * s, 0.0)
/// };
/// let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
/// let octahedral = Manipulator::from_legs(hexagon.map(|(i, j)| Leg { base: joint(2.0, i), platform: joint(1.0, j) }))?;
/// let families = components(&octahedral, ComponentOptions::default())?;
/// // the first leg on the line of legs that it spans with the second one, a quarter of the way
/// let (one, two) = (LegIndex::new(0).unwrap(), LegIndex::new(1).unwrap());
/// let family = families.components.iter().position(|c| c.legs == [one, two]).unwrap();
/// let moves = [LegMove { leg: one, family, parameters: vec![0.25], formulas: None }];
/// let moved = relocate(&octahedral, &families, &moves, LegMapTolerances::default())?;
/// assert!(moved.is_regular() && (moved.map.determinant - 0.75).abs() < 1e-12);
/// assert_eq!(moved.assembled.platform.unwrap().base_joints().len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RelocateError`].
pub fn relocate(
    m: &Manipulator,
    found: &Components,
    moves: &[LegMove],
    tolerances: LegMapTolerances,
) -> Result<Relocation, RelocateError> {
    let mut legs: [Option<Leg>; 6] = [None; 6];
    for step in moves {
        let leg = target(found, step)?;
        if legs[step.leg.get()].replace(leg).is_some() {
            return Err(RelocateError::Twice(step.leg));
        }
    }
    if let [only] = moves {
        let family = &found.components[only.family];
        if found.leg_rank.value == 6 && !family.support.contains(&only.leg) {
            return Err(RelocateError::NotCarried { leg: only.leg, family: only.family });
        }
    }
    let assembled = joints::assemble(m, &legs);
    let map = leg_map_to_legs(m, &assembled.legs, tolerances)?;
    let old = m.legs();
    let mut moved = Vec::new();
    for step in moves {
        let k = step.leg.get();
        let to = assembled.legs[k];
        moved.push(MovedLeg {
            request: step.clone(),
            from: old[k],
            to,
            coefficients: std::array::from_fn(|j| map.closest.a[(k, j)]),
            residual: map.residuals[k],
            exact: exactly_replaceable(&old, &to),
            singular: singular::singular_parameters(found, step, &map.closest.a)?,
        });
    }
    Ok(Relocation { assembled, moved, map })
}

/// The leg a move asks for.
fn target(found: &Components, step: &LegMove) -> Result<Leg, RelocateError> {
    let count = found.components.len();
    let family =
        found.components.get(step.family).ok_or(RelocateError::NoSuchFamily { index: step.family, count })?;
    let formulas = step.formulas(family);
    let (expected, given) = (formulas.parameters(), step.parameters.len());
    if expected != given {
        return Err(RelocateError::ParameterCount { family: step.family, expected, given });
    }
    let leg = formulas.leg_at(&step.parameters)?;
    leg.ok_or_else(|| RelocateError::NoLeg { family: step.family, parameters: step.parameters.clone() })
}
