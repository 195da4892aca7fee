//! Points of a curve of poses that satisfy one more condition, carried along while the condition changes.

use nalgebra::{SMatrix, SVector};
use num_complex::Complex64;

use super::equations::{EQUATIONS, LegEquations};
use crate::num::Rng;

pub(super) type Z = Complex64;
pub(super) type Plane = SVector<Z, 8>;
pub(super) type System = SMatrix<Z, 8, 8>;

/// The smallest step.
const SMALLEST: f64 = 1e-9;

/// A condition on points of the curve that depends on a parameter from 0 to 1.
pub(super) trait Condition {
    /// Value, gradient, and derivative by the parameter.
    fn at(&self, t: f64, y: &Plane) -> (Z, Plane, Z);
}

/// A hyperplane that moves from one place to another.
pub(super) struct Sweep {
    from: Plane,
    change: Plane,
}

impl Sweep {
    pub(super) fn new(from: &Plane, to: &Plane) -> Self {
        Self { from: *from, change: to - from }
    }
}

impl Condition for Sweep {
    fn at(&self, t: f64, y: &Plane) -> (Z, Plane, Z) {
        let plane = self.from + self.change * Z::from(t);
        (plane.dot(y), plane, self.change.dot(y))
    }
}

/// Where a point was lost: the last parameter reached, and the point there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lost {
    pub(super) t: f64,
    pub(super) y: Plane,
}

/// The curve in the chart `chart.y = 1`, cut by conditions.
pub(super) struct Slicer<'a> {
    equations: &'a LegEquations,
    /// Six combinations of the seven equations, which have rank six on the curve.
    mix: SMatrix<Z, 6, EQUATIONS>,
    pub(super) chart: Plane,
}

impl<'a> Slicer<'a> {
    pub(super) fn new(equations: &'a LegEquations, rng: &mut Rng) -> Self {
        let mut normal = || Z::new(rng.normal(), rng.normal());
        let mix = SMatrix::from_fn(|_, _| normal());
        Self { equations, mix, chart: Plane::from_fn(|_, _| normal()) }
    }

    /// The six combinations of the derivatives: linear in `y`.
    pub(super) fn derivatives(&self, y: &Plane) -> SMatrix<Z, 6, 8> {
        self.mix * self.equations.jacobian(y)
    }

    fn jacobian(&self, y: &Plane, gradient: &Plane) -> System {
        let mut j = System::zeros();
        j.fixed_view_mut::<6, 8>(0, 0).copy_from(&self.derivatives(y));
        j.set_row(6, &self.chart.transpose());
        j.set_row(7, &gradient.transpose());
        j
    }

    /// Newton's method; `None` unless it settles in a few steps.
    pub(super) fn newton(&self, start: Plane, condition: &impl Condition, t: f64) -> Option<Plane> {
        let mut y = start;
        let mut last = f64::INFINITY;
        for _ in 0..6 {
            let (value, gradient, _) = condition.at(t, &y);
            let f = self.mix * self.equations.values(&y);
            let values = Plane::from_fn(|i, _| match i {
                6 => self.chart.dot(&y) - 1.0,
                7 => value,
                _ => f[i],
            });
            let step = self.jacobian(&y, &gradient).lu().solve(&values)?;
            y -= step;
            let size = step.norm() / y.norm();
            // near a singular end rounding stops the improvement early
            if size < 1e-13 || size < 1e-9 && size > 0.3 * last {
                return Some(y);
            }
            if !(size < 0.5 * last) && last < 1e-2 {
                return None;
            }
            last = size;
        }
        None
    }

    /// The point for the parameter 1 that belongs to `start` for the parameter 0.
    pub(super) fn carry(&self, start: Plane, condition: &impl Condition) -> Result<Plane, Box<Lost>> {
        let (mut y, mut t, mut step) = (start, 0.0, 0.02);
        while t < 1.0 {
            let lost = Lost { t, y };
            if step < SMALLEST {
                return Err(Box::new(lost));
            }
            let dt = f64::min(step, 1.0 - t);
            let (_, gradient, rate) = condition.at(t, &y);
            let mut right = Plane::zeros();
            right[7] = -rate;
            let slope = self.jacobian(&y, &gradient).lu().solve(&right).ok_or_else(|| Box::new(lost))?;
            let guess = y + slope * Z::from(dt);
            let next = self.newton(guess, condition, t + dt);
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
        Ok(y)
    }

    /// Second difference of the sum of the points over parallel hyperplanes, relative to the first.
    pub(super) fn trace_defect(&self, points: &[Plane], home: &Plane) -> Option<f64> {
        let shift = self.chart * Z::from(0.1 * home.norm() / self.chart.norm());
        let mut sums = [Plane::zeros(); 3];
        let mut moved = 0.0;
        for y in points {
            let up = self.carry(*y, &Sweep::new(home, &(home + shift))).ok()?;
            let down = self.carry(*y, &Sweep::new(home, &(home - shift))).ok()?;
            sums[0] += up;
            sums[1] += y;
            sums[2] += down;
            moved += (up - down).norm();
        }
        Some((sums[0] - sums[1] * Z::from(2.0) + sums[2]).norm() / moved)
    }
}
