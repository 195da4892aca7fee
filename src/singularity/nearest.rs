//! How far a design is from being architecturally singular.
//!
//! Distance is the Euclidean norm of the change of all joints together, design units; a shared joint moves as one. What is found is an explicit
//! singular design, hence an upper bound of the distance; nothing is claimed about the best one.

use nalgebra::{Point3, Vector3};

use super::projection::{Start, project};
use super::{nearby_case, strata};
use crate::manipulator::{InvalidManipulator, Manipulator};
use crate::num::linalg::LinalgError;
use crate::synthesis::LegSpan;

/// A singular design near a given one.
#[derive(Debug, Clone, PartialEq)]
pub struct NearestSingular {
    /// Norm of the change of all joints, design units.
    pub distance: f64,
    /// What makes it singular: a name as in [`Case::name`](super::Case::name).
    pub kind: &'static str,
    /// The legs (0-based) that depend on each other there.
    pub legs: Vec<usize>,
    /// The relation between leg vectors, where that is what makes it singular; of norm 1.
    pub coefficients: Option<[f64; 6]>,
    /// Base joints of the singular design, in the order of the manipulator; joints no leg uses stay.
    pub base: Vec<Point3<f64>>,
    /// Its platform joints.
    pub platform: Vec<Point3<f64>>,
    /// What rounding of these joints leaves: smallest over largest singular value of the normalised leg vectors for a relation between them,
    /// otherwise 0.
    pub residual: f64,
    /// Whether every coordinate changes by at most `2^-50` of the largest coordinate of its body: rounding of the file may hide it.
    pub within_rounding: bool,
}

/// Changes of the joints that make a design singular.
#[derive(Debug, Clone)]
pub(super) struct Change {
    pub(super) kind: &'static str,
    pub(super) legs: Vec<usize>,
    pub(super) coefficients: Option<[f64; 6]>,
    pub(super) base: Vec<Vector3<f64>>,
    pub(super) platform: Vec<Vector3<f64>>,
}

impl Change {
    pub(super) fn norm(&self) -> f64 {
        self.base.iter().chain(&self.platform).map(Vector3::norm_squared).sum::<f64>().sqrt()
    }
}

/// Share of the largest coordinate that counts as rounding: eight half units in its last place.
const ROUNDING: f64 = 1.0 / (1u64 << 50) as f64;
/// Two distances that differ by less than this are one.
const SAME: f64 = 1e-6;
/// Random starts besides the six singular vectors.
const STARTS: u64 = 12;

/// The nearest singular design found: closed forms for joints that have to meet or to line up, local optimisation from several
/// starts (with `seed`) for relations between leg vectors.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub fn nearest_singular(m: &Manipulator, seed: u64) -> Result<Option<NearestSingular>, LinalgError> {
    let least = |all: Vec<Change>| {
        all.into_iter().filter(|c| c.norm().is_finite()).min_by(|x, y| x.norm().total_cmp(&y.norm()))
    };
    let closed = least(strata::changes(m));
    let searched = least(Start::all(m, seed, STARTS).iter().filter_map(|start| project(m, start)).collect());
    let best = match (closed, searched) {
        // a design found both ways is the exact one, whatever rounding says
        (Some(x), Some(y)) => Some(if x.norm() <= y.norm() * (1.0 + SAME) { x } else { y }),
        (x, y) => x.or(y),
    };
    best.map(|change| describe(m, change)).transpose()
}

fn describe(m: &Manipulator, change: Change) -> Result<NearestSingular, LinalgError> {
    let moved = |from: &[Point3<f64>], by: &[Vector3<f64>]| -> Vec<Point3<f64>> {
        from.iter().zip(by).map(|(p, d)| p + d).collect()
    };
    let base = moved(m.base_joints(), &change.base);
    let platform = moved(m.platform_joints(), &change.platform);
    let rebuilt: Result<Manipulator, InvalidManipulator> =
        Manipulator::try_new(base.clone(), platform.clone(), m.pairs());
    let (residual, kind) = match (&change.coefficients, rebuilt) {
        (Some(_), Ok(there)) => {
            (LegSpan::of(&there, 0.0)?.inverse_condition(), nearby_case::name(&there, &change.legs)?)
        }
        _ => (0.0, change.kind),
    };
    let small = |from: &[Point3<f64>], by: &[Vector3<f64>]| {
        let largest = from.iter().flat_map(|p| p.iter().copied()).fold(0.0, |x: f64, y| x.max(y.abs()));
        by.iter().all(|d| d.amax() <= ROUNDING * largest)
    };
    let within_rounding =
        small(m.base_joints(), &change.base) && small(m.platform_joints(), &change.platform);
    Ok(NearestSingular {
        distance: change.norm(),
        kind,
        legs: change.legs,
        coefficients: change.coefficients,
        base,
        platform,
        residual,
        within_rounding,
    })
}
