//! Gauss-Newton steps on a pair of rigid motions, until the moved legs lie in the span or cannot come nearer.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::super::components::spectrum::{Spectrum, dot, norm, unit};
use super::super::leg_vector::leg_vector;
use super::candidates::Turns;
use super::leg_space::LegSpace;
use crate::geom::{Pose, nearest_rotation};
use crate::manipulator::Leg;
use crate::num::linalg::{LinalgError, svd};

const STEPS: usize = 40;
/// Singular values of the Jacobian below this times the largest belong to motions that keep the span.
const FREE: f64 = 1e-7;

/// A pair of motions of centred, normalised coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    pub(super) base: Pose,
    pub(super) platform: Pose,
    /// Dimensions in which the motions can move on without changing this to first order.
    pub(super) freedom: usize,
}

/// Improves the pair of rotations `turns`, joined by translations, so that the moved `legs` come near to `space`.
pub(super) fn refine(space: &LegSpace, legs: &[Leg; 6], turns: &Turns) -> Result<Fit, LinalgError> {
    let normals = Spectrum::of(&space.basis, 16)?.kernel(space.dimension()).to_vec();
    let still = |m: &Matrix3<f64>| Pose { rotation: nearest_rotation(m), position: Vector3::zeros() };
    let mut at = (still(&turns.0), still(&turns.1));
    let mut errors = residuals(&normals, legs, &at);
    let mut freedom = 12;
    for _ in 0..STEPS {
        let d = svd(&tangents(&normals, legs, &at))?;
        let open = d.s.iter().filter(|s| **s > FREE * d.s[0]).count();
        freedom = 12 - open;
        let mut step = vec![0.0; 12];
        for k in 0..open {
            let along: f64 = errors.iter().zip(&d.v).map(|(e, row)| e * row[k]).sum::<f64>() / d.s[k];
            step.iter_mut().zip(&d.u).for_each(|(x, row)| *x -= along * row[k]);
        }
        let Some(next) = descend(&normals, legs, &at, &step, norm(&errors)) else { break };
        at = next;
        errors = residuals(&normals, legs, &at);
    }
    Ok(Fit { base: at.0, platform: at.1, freedom })
}

/// The step, halved until it brings the legs nearer; `None` when it does not.
fn descend(
    normals: &[Vec<f64>],
    legs: &[Leg; 6],
    at: &(Pose, Pose),
    step: &[f64],
    best: f64,
) -> Option<(Pose, Pose)> {
    let mut factor = 1.0;
    for _ in 0..8 {
        let part = |k: usize| Vector3::new(step[k], step[k + 1], step[k + 2]) * factor;
        let next = (moved(&at.0, &part(0), &part(3)), moved(&at.1, &part(6), &part(9)));
        if norm(&residuals(normals, legs, &next)) < best {
            return Some(next);
        }
        factor *= 0.5;
    }
    None
}

/// `x -> exp([w]x) (R x + p) + u`.
fn moved(pose: &Pose, turn: &Vector3<f64>, shift: &Vector3<f64>) -> Pose {
    let turn = Rotation3::new(*turn);
    Pose { rotation: turn * pose.rotation, position: turn * pose.position + shift }
}

fn image(leg: &Leg, at: &(Pose, Pose)) -> Leg {
    Leg { base: at.0.transform(&leg.base), platform: at.1.transform(&leg.platform) }
}

/// Components of the moved leg vectors, of unit length, along the normals of the span.
fn residuals(normals: &[Vec<f64>], legs: &[Leg; 6], at: &(Pose, Pose)) -> Vec<f64> {
    let vectors = legs.iter().map(|leg| unit(&leg_vector(&image(leg, at))));
    vectors.flat_map(|v| normals.iter().map(|n| dot(n, &v)).collect::<Vec<_>>()).collect()
}

/// Derivatives of [`residuals`] by turn and shift of the base, turn and shift of the platform: one list each. The length of a leg
/// vector is taken as constant, which is exact where the residuals vanish.
fn tangents(normals: &[Vec<f64>], legs: &[Leg; 6], at: &(Pose, Pose)) -> Vec<Vec<f64>> {
    let moves: Vec<(usize, bool, Vector3<f64>)> = (0..12)
        .map(|k| {
            let axis = Vector3::from_fn(|i, _| if i == k % 3 { 1.0 } else { 0.0 });
            (k / 6, (k / 3) % 2 == 0, axis)
        })
        .collect();
    let column = |(body, turn, axis): &(usize, bool, Vector3<f64>)| -> Vec<f64> {
        let one = |leg: &Leg| -> Vec<f64> {
            let leg = image(leg, at);
            let size = norm(&leg_vector(&leg));
            let v = velocity(&leg, *body, *turn, axis);
            normals.iter().map(|n| dot(n, &v) / size).collect()
        };
        legs.iter().flat_map(one).collect()
    };
    moves.iter().map(column).collect()
}

fn velocity(leg: &Leg, body: usize, turn: bool, axis: &Vector3<f64>) -> [f64; 16] {
    let along = |x: &Point3<f64>| if turn { axis.cross(&x.coords) } else { *axis };
    let place = |x: &Point3<f64>| [1.0, x.x, x.y, x.z];
    let speed = |x: &Point3<f64>| {
        let v = along(x);
        [0.0, v.x, v.y, v.z]
    };
    let (a, b) = match body {
        0 => (speed(&leg.base), place(&leg.platform)),
        _ => (place(&leg.base), speed(&leg.platform)),
    };
    std::array::from_fn(|k| a[k / 4] * b[k % 4])
}
