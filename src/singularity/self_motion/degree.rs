//! Degree of a curve of poses among the dual quaternions `(e : g)` of projective 7-space.
//!
//! A general hyperplane meets the curve in as many points as its degree. From one point the others are reached by carrying the hyperplane around random
//! triangles (monodromy). They are all of an irreducible curve when, for parallel hyperplanes `h(y) = tau` in an affine chart, the sum of the points is a linear function
//! of `tau` (trace test; Sommese, Verschelde, Wampler 2002). Numerical, not a proof.

use nalgebra::{SMatrix, SVector};
use num_complex::Complex64;

use super::equations::{EQUATIONS, LegEquations, Point};
use super::point;
use crate::geom::Pose;
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::num::Rng;

type Z = Complex64;
type System = SMatrix<Z, 8, 8>;
type Plane = SVector<Z, 8>;

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
    let real = point(pose, m.size());
    let singular_values = equations.jacobian(&real).singular_values();
    if !(singular_values[6] < ON_CURVE * singular_values[0])
        || singular_values[5] < OFF_CROSSING * singular_values[0]
    {
        return None;
    }
    let start: Plane = real.map(Z::from);
    let mut normal = || Z::new(rng.normal(), rng.normal());
    let mix = SMatrix::<Z, 6, EQUATIONS>::from_fn(|_, _| normal());
    let mut draw = || Plane::from_fn(|_, _| normal());
    let chart = draw();
    let slicer = Slicer { equations: &equations, mix, chart };
    let start = start / chart.dot(&start);
    // a hyperplane through the first point
    let mut home = draw();
    home -= chart * home.dot(&start);
    let first = slicer.newton(start, &home)?;
    let mut points = vec![first];
    let mut quiet = 0;
    let mut defect = f64::INFINITY;
    for _ in 0..LOOPS {
        let (one, two) = (draw(), draw());
        let mut fresh = Vec::new();
        for y in &points {
            let around = slicer
                .carry(*y, &home, &one)
                .and_then(|y| slicer.carry(y, &one, &two))
                .and_then(|y| slicer.carry(y, &two, &home));
            if let Some(y) = around {
                let known = |z: &Point<Z>| (z - y).norm() < 1e-7 * y.norm();
                if !points.iter().any(known) && !fresh.iter().any(known) {
                    fresh.push(y);
                }
            }
        }
        quiet = if fresh.is_empty() { quiet + 1 } else { 0 };
        points.extend(fresh);
        if quiet > 0 {
            defect = slicer.trace_defect(&points, &home).unwrap_or(f64::INFINITY);
            if defect < LINEAR && quiet >= PATIENCE {
                return Some(CurveDegree { degree: points.len(), complete: true, defect });
            }
        }
    }
    Some(CurveDegree { degree: points.len(), complete: false, defect })
}

/// The curve in the chart `chart.y = 1`, cut by hyperplanes.
struct Slicer<'a> {
    equations: &'a LegEquations,
    /// Six combinations of the seven equations, which have rank six on the curve.
    mix: SMatrix<Z, 6, EQUATIONS>,
    chart: Plane,
}

impl Slicer<'_> {
    fn values(&self, y: &Plane, plane: &Plane) -> Plane {
        let f = self.mix * self.equations.values(y);
        Plane::from_fn(|i, _| match i {
            6 => self.chart.dot(y) - 1.0,
            7 => plane.dot(y),
            _ => f[i],
        })
    }

    fn jacobian(&self, y: &Plane, plane: &Plane) -> System {
        let mut j = System::zeros();
        j.fixed_view_mut::<6, 8>(0, 0).copy_from(&(self.mix * self.equations.jacobian(y)));
        j.set_row(6, &self.chart.transpose());
        j.set_row(7, &plane.transpose());
        j
    }

    /// Newton's method; `None` unless it settles in a few steps.
    fn newton(&self, start: Plane, plane: &Plane) -> Option<Plane> {
        let mut y = start;
        let mut last = f64::INFINITY;
        for _ in 0..6 {
            let step = self.jacobian(&y, plane).lu().solve(&self.values(&y, plane))?;
            y -= step;
            let size = step.norm() / y.norm();
            if size < 1e-13 || size < 1e-11 && size > 0.3 * last {
                return Some(y);
            }
            if !(size < 0.5 * last) && last < 1e-2 {
                return None;
            }
            last = size;
        }
        None
    }

    /// From the hyperplane `from` to `to` along the segment between them.
    fn carry(&self, start: Plane, from: &Plane, to: &Plane) -> Option<Plane> {
        let change = to - from;
        let (mut y, mut t, mut step) = (start, 0.0, 0.02);
        while t < 1.0 {
            if step < 1e-6 {
                return None;
            }
            let dt = f64::min(step, 1.0 - t);
            let here = from + change * Z::from(t);
            let mut right = Plane::zeros();
            right[7] = -change.dot(&y);
            let slope = self.jacobian(&y, &here).lu().solve(&right)?;
            let guess = y + slope * Z::from(dt);
            let next = self.newton(guess, &(from + change * Z::from(t + dt)));
            // a corrector that goes far may have left the path
            match next.filter(|n| (n - guess).norm() < 0.02 * n.norm()) {
                Some(n) => {
                    let easy = (n - guess).norm() < 0.002 * n.norm();
                    (y, t) = (n, t + dt);
                    if easy {
                        step *= 1.6;
                    }
                }
                None => step *= 0.4,
            }
        }
        Some(y)
    }

    /// Second difference of the sum of the points over parallel hyperplanes, relative to the first.
    fn trace_defect(&self, points: &[Plane], home: &Plane) -> Option<f64> {
        let shift = self.chart * Z::from(0.1 * home.norm() / self.chart.norm());
        let mut sums = [Plane::zeros(); 3];
        let mut moved = 0.0;
        for y in points {
            let up = self.carry(*y, home, &(home + shift))?;
            let down = self.carry(*y, home, &(home - shift))?;
            sums[0] += up;
            sums[1] += y;
            sums[2] += down;
            moved += (up - down).norm();
        }
        Some((sums[0] - sums[1] * Z::from(2.0) + sums[2]).norm() / moved)
    }
}
