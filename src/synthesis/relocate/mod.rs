//! Moves legs of any platform along their families of replaceable legs, which gives the equivalent platforms.
//!
//! Let `v' = sum c_l v_l` be the vector of a replaceable leg (see [`components`](super::components)). If it replaces
//! leg `k`, row `k` of the leg map is `c`, and the other rows are those of the identity: `det A = c_k`. Several legs
//! moved together give the matrix with their rows `c`. Its determinant decides, not those of the single moves.
//!
//! A regular move does not change the span of the six leg vectors. So **the families never change** under moves, and
//! single moves in a suitable order reach every platform equivalent to a given one (`docs/theory/moves.md`).
//!
//! [`relocate`] moves legs, [`Chain`] composes successive moves, and [`search`](mod@search) searches for equivalent
//! platforms that meet requirements.

mod names;
pub mod search;
mod singular;
#[cfg(test)]
mod tests;

use nalgebra::Point3;
use thiserror::Error;

pub use self::names::{counted_from, family_between, spanning_joints};
pub use self::singular::SingularParameters;
use super::components::{Component, Components, Parametrisation, exactly_replaceable};
use super::leg_map::{AffineLegMap, LegMapOutcome, LegMapTolerances, leg_map_to_legs};
use num::linalg::LinalgError;
use platform::manipulator::{InvalidManipulator, Leg, LegIndex, Manipulator};

/// One leg and its target.
#[derive(Debug, Clone, PartialEq)]
pub struct LegMove {
    /// The leg that is replaced.
    pub leg: LegIndex,
    /// Index of the family in [`Components::components`], from 0.
    pub family: usize,
    /// Parameters of the new leg, as many as the family has dimensions.
    pub parameters: Vec<f64>,
    /// The formulas of the parameters, if not those of the family itself (see [`counted_from()`]).
    pub formulas: Option<Parametrisation>,
}

impl LegMove {
    /// The formulas of its parameters.
    fn formulas<'a>(&'a self, family: &'a Component) -> &'a Parametrisation {
        self.formulas.as_ref().unwrap_or(&family.parametrisation)
    }
}

/// A moved leg.
#[derive(Debug, Clone, PartialEq)]
pub struct MovedLeg {
    /// The requested move.
    pub request: LegMove,
    /// The old leg.
    pub from: Leg,
    /// The new leg, in doubles; an end within rounding of a joint of the platform has the coordinates of that joint.
    pub to: Leg,
    /// Coefficients of its vector in those of the six old legs: the row of `A`.
    pub coefficients: [f64; 6],
    /// Distance of its vector from their span over its length.
    pub residual: f64,
    /// Whether the doubles of the new joints, as rational numbers, satisfy the span condition exactly. In general they
    /// are rounded and do not.
    pub exact: bool,
    /// Parameters on the family at which the determinant of the whole move vanishes, with the other moves and
    /// parameters fixed.
    pub singular: SingularParameters,
}

/// Legs moved together.
#[derive(Debug, Clone, PartialEq)]
pub struct Relocation {
    /// The new platform, with the origins of its joints.
    pub assembled: Assembled,
    /// The result for each moved leg.
    pub moved: Vec<MovedLeg>,
    /// The map from the old platform, with the relation.
    pub map: LegMapOutcome,
}

impl Relocation {
    /// Whether the new platform is equivalent to the old one, within the rounding of its computed joints.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.map.is_regular_within_rounding()
    }
}

/// Reasons why legs cannot be moved as requested.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RelocateError {
    /// The family does not exist.
    #[error("there is no family {}; the platform has {count} families", index + 1)]
    NoSuchFamily {
        /// The requested index, from 0.
        index: usize,
        /// The number of families.
        count: usize,
    },
    /// A family has another number of parameters.
    #[error("family {} needs {expected} parameters, but {given} were given", family + 1)]
    ParameterCount {
        /// The family, from 0.
        family: usize,
        /// Its dimension.
        expected: usize,
        /// The given number.
        given: usize,
    },
    /// An end is at infinity at these parameters, or they have no real leg.
    #[error("family {} has no leg at {parameters:?}: an end is at infinity or not real", family + 1)]
    NoLeg {
        /// The family, from 0.
        family: usize,
        /// The parameters.
        parameters: Vec<f64>,
    },
    /// The coefficient of the leg is zero all along the family.
    #[error("{leg} cannot be replaced by a leg of family {}: the squared lengths of that family do not depend on that of the leg", family + 1)]
    NotCarried {
        /// The leg.
        leg: LegIndex,
        /// The family, from 0.
        family: usize,
    },
    /// A leg is moved twice at once.
    #[error("{0} is moved twice in one step; move it once, or in one step after the other")]
    Twice(LegIndex),
    /// A decomposition failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

/// Moves legs together. The families of all moves are those of `m`,
/// [`components`](super::components::components())`(m, ..)`.
///
/// A result with `det A = 0` is returned too: [`Relation::Singular`](super::Relation::Singular), with the singular
/// parameters. A single move of a leg whose coefficient vanishes on the whole family is refused.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_synthesis as synthesis; pub use platform::manipulator; } }
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
        if found.leg_rank.numerical == 6 && !family.support.contains(&only.leg) {
            return Err(RelocateError::NotCarried { leg: only.leg, family: only.family });
        }
    }
    let assembled = Assembled::of(m, &legs);
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

/// The target leg of a move.
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

/// A new end within this of a joint, relative to the size, is that joint: rounding of formulas, not of data.
const SNAP: f64 = 1e-12;

/// The origin of a joint of the new platform, with indices of the same body of the old one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointOrigin {
    /// The unchanged joint.
    Kept(usize),
    /// The displaced joint: all legs left the old joint, and the first of them went here.
    Displaced(usize),
    /// A leg left the old joint for this one.
    Split(usize),
}

impl JointOrigin {
    /// The index of the old joint, if it is unchanged.
    #[must_use]
    pub fn kept(&self) -> Option<usize> {
        match self {
            Self::Kept(k) => Some(*k),
            Self::Displaced(_) | Self::Split(_) => None,
        }
    }
}

/// The new platform.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled {
    /// Joints and legs. Two coincident legs form no platform.
    pub platform: Result<Manipulator, InvalidManipulator>,
    /// The six legs.
    pub legs: [Leg; 6],
    /// Origins of the base joints.
    pub base: Vec<JointOrigin>,
    /// Origins of the platform joints.
    pub platform_joints: Vec<JointOrigin>,
}

/// Joints of one body, and the joint of each leg.
struct BodyJoints {
    points: Vec<Point3<f64>>,
    origins: Vec<JointOrigin>,
    of_leg: [usize; 6],
}

impl Assembled {
    /// Replaces the old legs by the given ones. An end that is within rounding of a joint shares it.
    #[must_use]
    pub fn of(m: &Manipulator, new: &[Option<Leg>; 6]) -> Self {
        let limit = SNAP * m.size();
        let pairs = m.pairs();
        let base = side(m.base_joints(), pairs.map(|p| p.0), new.map(|l| l.map(|l| l.base)), limit);
        let platform =
            side(m.platform_joints(), pairs.map(|p| p.1), new.map(|l| l.map(|l| l.platform)), limit);
        let pairs: [(usize, usize); 6] = std::array::from_fn(|k| (base.of_leg[k], platform.of_leg[k]));
        Self {
            legs: pairs.map(|(a, b)| Leg { base: base.points[a], platform: platform.points[b] }),
            platform: Manipulator::try_new(base.points, platform.points, pairs),
            base: base.origins,
            platform_joints: platform.origins,
        }
    }
}

fn side(old: &[Point3<f64>], of_leg: [usize; 6], new: [Option<Point3<f64>>; 6], limit: f64) -> BodyJoints {
    let mut points = old.to_vec();
    let mut origins: Vec<JointOrigin> = (0..old.len()).map(JointOrigin::Kept).collect();
    let mut ends = of_leg;
    for (k, p) in new.iter().enumerate().filter_map(|(k, p)| p.map(|p| (k, p))) {
        let near = |q: &Point3<f64>| (p - q).norm() <= limit;
        // the leg's own joint first, since two joints may coincide
        let found = if near(&points[of_leg[k]]) { Some(of_leg[k]) } else { points.iter().position(near) };
        ends[k] = found.unwrap_or_else(|| {
            points.push(p);
            origins.push(JointOrigin::Split(of_leg[k]));
            points.len() - 1
        });
    }
    // a joint without legs is removed, and the first new joint from it takes its place in the list
    let mut order: Vec<(usize, JointOrigin)> = Vec::new();
    for j in 0..old.len() {
        if ends.contains(&j) || !of_leg.contains(&j) {
            order.push((j, JointOrigin::Kept(j)));
        } else if let Some(l) = (old.len()..points.len()).find(|l| origins[*l] == JointOrigin::Split(j)) {
            order.push((l, JointOrigin::Displaced(j)));
        }
    }
    for l in old.len()..points.len() {
        if !order.iter().any(|(x, _)| *x == l) {
            order.push((l, origins[l]));
        }
    }
    BodyJoints {
        points: order.iter().map(|(l, _)| points[*l]).collect(),
        origins: order.iter().map(|(_, o)| *o).collect(),
        of_leg: ends.map(|e| order.iter().position(|(l, _)| *l == e).unwrap_or_default()),
    }
}

/// A sequence of moves as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The map composed of those of the steps.
    pub composed: AffineLegMap,
    /// The map computed from the first platform and the legs of the last one.
    pub direct: LegMapOutcome,
    /// Largest difference of the two matrices over the largest entry, and of the constants over the squared size. It is
    /// of the size of rounding for a correct chain.
    pub disagreement: f64,
}

impl Chain {
    /// Composes successive moves from `first`; only the last one may be singular.
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
