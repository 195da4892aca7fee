//! Degree of a curve of poses among the dual quaternions `(e : g)` of projective 7-space.
//!
//! A general hyperplane meets the curve in as many points as its degree. From one point the others are reached by carrying the hyperplane around random
//! triangles (monodromy). They are all of an irreducible curve when, for parallel hyperplanes `h(y) = tau` in an affine chart, the sum of the points is a linear function
//! of `tau` (trace test; Sommese, Verschelde, Wampler 2002). Numerical, not a proof.

use super::equations::LegEquations;
use super::point;
use super::slices::{Plane, Slicer, Sweep, Z};
use crate::geom::Pose;
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::num::Rng;

/// Loops without a new point and with a linear trace after which the points are called all.
const PATIENCE: usize = 3;
/// Most loops.
const LOOPS: usize = 120;
/// Largest defect of the trace over the sum of the points' sizes.
const LINEAR: f64 = 1e-7;

/// The seventh singular value of the equations on a curve, and the sixth away from crossings, over the first.
const ON_CURVE: f64 = 1e-9;
const OFF_CROSSING: f64 = 1e-6;

/// What was found about the degree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveDegree {
    /// Points in which a general hyperplane meets the irreducible curve through the pose; those found, when not complete.
    pub degree: usize,
    /// The trace test holds.
    pub complete: bool,
    /// Its defect, relative.
    pub defect: f64,
}

/// Degree in the projective space of `(e, g)`, over the complex numbers, of the irreducible curve of poses through a regular pose of a self-motion.
///
/// `None` when the pose is on no curve or too near a crossing to be followed.
#[must_use]
pub fn curve_degree(m: &Manipulator, s: &SquaredLegLengths, pose: &Pose, seed: u64) -> Option<CurveDegree> {
    let mut rng = Rng::new(seed);
    let equations = LegEquations::new(m, s);
    let start: Plane = point(pose, m.size()).map(Z::from);
    if !is_regular(&equations, &start) {
        return None;
    }
    let slicer = Slicer::new(&equations, &mut rng);
    // a hyperplane through the first point
    let start = start / slicer.chart.dot(&start);
    let mut home = draw(&mut rng);
    home -= slicer.chart * home.dot(&start);
    Some(gather(&slicer, start, &home, &mut rng)?.1)
}

/// Whether the point is on one curve of poses: rank six.
pub(super) fn is_regular(equations: &LegEquations, y: &Plane) -> bool {
    let jacobian = equations.jacobian(&(y / Z::from(y.norm())));
    jacobian.try_svd(false, false, f64::EPSILON, 1000).is_some_and(|d| {
        let values = d.singular_values;
        values[6] < ON_CURVE * values[0] && values[5] >= OFF_CROSSING * values[0]
    })
}

pub(super) fn draw(rng: &mut Rng) -> Plane {
    Plane::from_fn(|_, _| Z::new(rng.normal(), rng.normal()))
}

pub(super) fn same(x: &Plane, y: &Plane) -> bool {
    (x - y).norm() < 1e-7 * y.norm()
}

/// The points in which the hyperplane `home` meets the irreducible curve through its point `start`.
pub(super) fn gather(
    slicer: &Slicer<'_>,
    start: Plane,
    home: &Plane,
    rng: &mut Rng,
) -> Option<(Vec<Plane>, CurveDegree)> {
    let mut points = vec![slicer.newton(start, &Sweep::new(home, home), 0.0)?];
    let mut quiet = 0;
    let mut defect = f64::INFINITY;
    for _ in 0..LOOPS {
        let (one, two) = (draw(rng), draw(rng));
        let mut fresh: Vec<Plane> = Vec::new();
        for y in &points {
            let around = slicer
                .carry(*y, &Sweep::new(home, &one))
                .and_then(|y| slicer.carry(y, &Sweep::new(&one, &two)))
                .and_then(|y| slicer.carry(y, &Sweep::new(&two, home)));
            if let Ok(y) = around
                && !points.iter().chain(&fresh).any(|z| same(z, &y))
            {
                fresh.push(y);
            }
        }
        quiet = if fresh.is_empty() { quiet + 1 } else { 0 };
        points.extend(fresh);
        if quiet > 0 {
            defect = slicer.trace_defect(&points, home).unwrap_or(f64::INFINITY);
            if defect < LINEAR && quiet >= PATIENCE {
                let degree = CurveDegree { degree: points.len(), complete: true, defect };
                return Some((points, degree));
            }
        }
    }
    let degree = CurveDegree { degree: points.len(), complete: false, defect };
    Some((points, degree))
}
