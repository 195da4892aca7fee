//! Slices of a curve of poses: points of the leg equations that satisfy an additional condition, followed while the
//! condition changes.
//!
//! They give the degree of the curve among the dual quaternions `(e : g)` of projective 7-space.
//!
//! A general hyperplane meets the curve in as many points as its degree. From one point, moving the hyperplane around
//! random triangles (monodromy) reaches the others. The trace test shows that they are all points of an irreducible
//! curve. For parallel hyperplanes `h(y) = tau` in an affine chart, their sum must be linear in `tau` (Sommese,
//! Verschelde, Wampler 2002). It is numerical, not a proof.

use nalgebra::{ComplexField, SMatrix, SVector, Vector3};
use num_complex::Complex64;

use super::point;
use num::Rng;
use num::small::singular_values;
use platform::geom::Pose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// `(e, g)`, `g = p e` with `p` in units of the size.
pub(super) type Point<T> = SVector<T, 8>;

/// Six leg equations and `e.g = 0`.
pub(super) const EQUATIONS: usize = 7;

/// One leg, lengths in units of the size.
#[derive(Debug, Clone, Copy)]
struct LegForm {
    /// `b - a`.
    difference: Vector3<f64>,
    /// `a + b`.
    sum: Vector3<f64>,
    squared_length: f64,
}

/// `F_i = (|g + e b - a e|^2 - s e.e) / 2`, `F_7 = e.g`.
#[derive(Debug, Clone)]
pub(super) struct SliceEquations {
    legs: [LegForm; 6],
}

impl SliceEquations {
    pub(super) fn new(m: &Manipulator, s: &SquaredLegLengths) -> Self {
        let unit = m.size();
        let (legs, squares) = (m.legs(), s.get());
        let form = |i: usize| {
            let (a, b) = (legs[i].base.coords / unit, legs[i].platform.coords / unit);
            LegForm { difference: b - a, sum: a + b, squared_length: squares[i] / (unit * unit) }
        };
        Self { legs: std::array::from_fn(form) }
    }

    /// `F(y)`.
    pub(super) fn values<T: ComplexField<RealField = f64> + Copy>(
        &self,
        y: &Point<T>,
    ) -> SVector<T, EQUATIONS> {
        let half = T::from_real(0.5);
        SVector::from_fn(|i, _| {
            if i == 6 {
                return (0..4).fold(T::zero(), |sum, k| sum + y[k] * y[k + 4]);
            }
            let v = self.legs[i].displacement(y);
            let s = T::from_real(self.legs[i].squared_length);
            (0..4).fold(T::zero(), |sum, k| sum + half * (v[k] * v[k] - s * y[k] * y[k]))
        })
    }

    /// `dF / dy`; it is linear in `y`, and `F(y) = F'(y) y / 2`.
    pub(super) fn jacobian<T: ComplexField<RealField = f64> + Copy>(
        &self,
        y: &Point<T>,
    ) -> SMatrix<T, EQUATIONS, 8> {
        let mut j = SMatrix::zeros();
        for (i, leg) in self.legs.iter().enumerate() {
            let v = leg.displacement(y);
            let turned = leg.skew(&v);
            let s = T::from_real(leg.squared_length);
            for k in 0..4 {
                j[(i, k)] = -turned[k] - s * y[k];
                j[(i, k + 4)] = v[k];
            }
        }
        for k in 0..4 {
            j[(6, k)] = y[k + 4];
            j[(6, k + 4)] = y[k];
        }
        j
    }
}

impl LegForm {
    /// `T x` with `T x = x b - a x`.
    fn skew<T: ComplexField<RealField = f64> + Copy>(&self, x: &[T; 4]) -> [T; 4] {
        let d = self.difference.map(T::from_real);
        let c = self.sum.map(T::from_real);
        let [w, u, v, z] = *x;
        [
            -(d.x * u + d.y * v + d.z * z),
            d.x * w - (c.y * z - c.z * v),
            d.y * w - (c.z * u - c.x * z),
            d.z * w - (c.x * v - c.y * u),
        ]
    }

    /// `g + T e`, whose norm squared is `s e.e`.
    fn displacement<T: ComplexField<RealField = f64> + Copy>(&self, y: &Point<T>) -> [T; 4] {
        let turned = self.skew(&[y[0], y[1], y[2], y[3]]);
        std::array::from_fn(|k| y[k + 4] + turned[k])
    }
}

pub(super) type Z = Complex64;
pub(super) type Plane = SVector<Z, 8>;
pub(super) type System = SMatrix<Z, 8, 8>;

/// The smallest step.
const SMALLEST: f64 = 1e-9;

/// A condition on points of the curve that depends on a parameter from 0 to 1.
pub(super) trait SliceCondition {
    /// Value, gradient, and derivative by the parameter.
    fn at(&self, t: f64, y: &Plane) -> (Z, Plane, Z);
}

/// A hyperplane that moves from one place to another.
pub(super) struct SliceSweep {
    from: Plane,
    change: Plane,
}

impl SliceSweep {
    pub(super) fn new(from: &Plane, to: &Plane) -> Self {
        Self { from: *from, change: to - from }
    }
}

impl SliceCondition for SliceSweep {
    fn at(&self, t: f64, y: &Plane) -> (Z, Plane, Z) {
        let plane = self.from + self.change * Z::from(t);
        (plane.dot(y), plane, self.change.dot(y))
    }
}

/// A lost point: the last parameter reached, and the point there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lost {
    pub(super) t: f64,
    pub(super) y: Plane,
}

/// The curve in the chart `chart.y = 1`, cut by conditions.
pub(super) struct Slicer<'a> {
    equations: &'a SliceEquations,
    /// Six combinations of the seven equations, which have rank six on the curve.
    mix: SMatrix<Z, 6, EQUATIONS>,
    pub(super) chart: Plane,
}

impl<'a> Slicer<'a> {
    pub(super) fn new(equations: &'a SliceEquations, rng: &mut Rng) -> Self {
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

    /// Newton's method; `None` unless it converges in a few steps.
    pub(super) fn newton(&self, start: Plane, condition: &impl SliceCondition, t: f64) -> Option<Plane> {
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

    /// The point at the parameter 1 on the path from `start` at the parameter 0.
    pub(super) fn carry(&self, start: Plane, condition: &impl SliceCondition) -> Result<Plane, Box<Lost>> {
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
            // a large correction may have left the path
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
    fn trace_defect(&self, points: &[Plane], home: &Plane) -> Option<f64> {
        let shift = self.chart * Z::from(0.1 * home.norm() / self.chart.norm());
        let mut sums = [Plane::zeros(); 3];
        let mut moved = 0.0;
        for y in points {
            let up = self.carry(*y, &SliceSweep::new(home, &(home + shift))).ok()?;
            let down = self.carry(*y, &SliceSweep::new(home, &(home - shift))).ok()?;
            sums[0] += up;
            sums[1] += y;
            sums[2] += down;
            moved += (up - down).norm();
        }
        Some((sums[0] - sums[1] * Z::from(2.0) + sums[2]).norm() / moved)
    }
}

/// Number of loops without a new point and with a linear trace after which the points are complete.
const PATIENCE: usize = 3;
/// Greatest number of loops.
const LOOPS: usize = 120;
/// Largest defect of the trace over the sum of the points' sizes.
const LINEAR: f64 = 1e-7;

/// Largest seventh singular value of the equations on a curve, over the first.
const ON_CURVE: f64 = 1e-9;
/// Least sixth singular value of the equations away from crossings, over the first.
const OFF_CROSSING: f64 = 1e-6;

/// The degree of a curve of poses.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "CurveDegreeRecord", transform = num::nullable))]
pub struct CurveDegree {
    /// The degree; a lower bound if incomplete.
    // number of intersections of a general hyperplane with the irreducible curve through the pose
    pub degree: usize,
    /// Whether the trace test holds.
    pub complete: bool,
    /// The residual of the trace test.
    // relative
    #[cfg_attr(feature = "serde", serde(rename = "trace_defect"))]
    pub defect: f64,
}

/// Degree in the projective space of `(e, g)`, over the complex numbers, of the irreducible curve of poses through a
/// regular pose of a self-motion.
///
/// `None` if the pose is on no curve or too near a crossing to be followed.
#[must_use]
pub fn curve_degree(m: &Manipulator, s: &SquaredLegLengths, pose: &Pose, seed: u64) -> Option<CurveDegree> {
    let mut rng = Rng::new(seed);
    let equations = SliceEquations::new(m, s);
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

/// Whether the point is on exactly one curve of poses: rank six.
pub(super) fn is_regular(equations: &SliceEquations, y: &Plane) -> bool {
    let jacobian = equations.jacobian(&(y / Z::from(y.norm())));
    singular_values(&jacobian)
        .is_some_and(|values| values[6] < ON_CURVE * values[0] && values[5] >= OFF_CROSSING * values[0])
}

pub(super) fn draw(rng: &mut Rng) -> Plane {
    Plane::from_fn(|_, _| Z::new(rng.normal(), rng.normal()))
}

pub(super) fn same(x: &Plane, y: &Plane) -> bool {
    (x - y).norm() < 1e-7 * y.norm()
}

/// The intersections of the hyperplane `home` with the irreducible curve through its point `start`.
pub(super) fn gather(
    slicer: &Slicer<'_>,
    start: Plane,
    home: &Plane,
    rng: &mut Rng,
) -> Option<(Vec<Plane>, CurveDegree)> {
    let mut points = vec![slicer.newton(start, &SliceSweep::new(home, home), 0.0)?];
    let mut quiet = 0;
    let mut defect = f64::INFINITY;
    for _ in 0..LOOPS {
        let (one, two) = (draw(rng), draw(rng));
        let mut fresh: Vec<Plane> = Vec::new();
        for y in &points {
            let around = slicer
                .carry(*y, &SliceSweep::new(home, &one))
                .and_then(|y| slicer.carry(y, &SliceSweep::new(&one, &two)))
                .and_then(|y| slicer.carry(y, &SliceSweep::new(&two, home)));
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
