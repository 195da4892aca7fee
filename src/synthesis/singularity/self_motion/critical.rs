//! A pose on every real component of the curves of poses: critical points of a linear function.
//!
//! Leg lengths bound the position, so the real poses `(e, g)`, `|e| = 1`, form closed loops (and single points). On
//! each loop a linear function `c.(e, g)` has a maximum and a minimum. There the derivatives of the equations, `(e, 0)`
//! and `c` are dependent:
//!
//! ```text
//! D(y) = det (six combinations of the rows of J(y); (e, 0); c) = 0,   of degree 7 in y.
//! ```
//!
//! On a curve of degree `d` in projective 7-space, the zeros of `D` are limits under the homotopy
//! `(1 - t) gamma L_1 .. L_7 + t D`. They start at the `7 d` zeros of a product of seven linear forms (Sommese, Wampler
//! 2005). The points of the degree computation are the zeros of a linear form.

use nalgebra::{Matrix4, Vector4};

use super::pose as real_pose;
use super::slices::{
    CurveDegree, Plane, SliceCondition, SliceEquations, SliceSweep, Slicer, System, Z, draw, gather,
    is_regular, same,
};
use num::{Purpose, Rng};
use platform::geom::{ComplexPose, Pose};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Degree of `D`.
const FORMS: usize = 7;
/// Greatest number of homotopies with new random numbers while paths are lost.
const ATTEMPTS: usize = 4;
/// Relative imaginary parts below this belong to a real point within rounding.
const REAL: f64 = 1e-7;
/// The same for a point where curves intersect, to which convergence is slow.
const NEARLY_REAL: f64 = 1e-2;
/// `|e.e| / |y|^2` below which an end is not a pose; multiple ends converge slowly.
const NO_POSE: f64 = 1e-2;
/// Parameter beyond which a lost path counts as ending at a singular point.
const NEAR_THE_END: f64 = 0.999;

/// Real poses from the critical points, and the counts of all paths.
#[derive(Debug, Clone, PartialEq)]
pub struct CriticalPoses {
    /// Irreducible curves over the complex numbers through the given poses, one for each distinct curve.
    pub components: Vec<CurveDegree>,
    /// Real critical points, and ends that are nearly real where curves intersect.
    pub poses: Vec<Pose>,
    /// Paths followed in the last homotopy: seven times the sum of the degrees. Lost paths lead to another homotopy, at
    /// most four in total.
    pub paths: usize,
    /// Ends that are regular critical points, real or not.
    pub regular: usize,
    /// Ends at intersections of curves or coincident critical points, of lower accuracy.
    pub singular: usize,
    /// Ends with `e.e = 0`: no poses.
    pub no_pose: usize,
    /// Lost paths.
    pub lost: usize,
    /// Given poses that lie on no curve, or at a crossing of curves.
    pub unused: usize,
}

impl CriticalPoses {
    /// Whether the curves of the given poses are numerically complete: all trace tests hold and no path was lost.
    #[must_use]
    pub fn is_accounted(&self) -> bool {
        !self.components.is_empty()
            && self.lost == 0
            && self.unused == 0
            && self.components.iter().all(|c| c.complete)
    }
}

/// Real poses on all real components of the irreducible complex curves of poses that pass through given ones, which may
/// be complex.
#[must_use]
pub fn critical_poses(
    m: &Manipulator,
    s: &SquaredLegLengths,
    on: &[ComplexPose],
    seed: u64,
) -> CriticalPoses {
    let mut rng = Purpose::CRITICAL_POINTS.rng(seed);
    let equations = SliceEquations::new(m, s);
    let slicer = Slicer::new(&equations, &mut rng);
    let forms: [Plane; FORMS] = std::array::from_fn(|_| draw(&mut rng));
    let mut out = CriticalPoses {
        components: Vec::new(),
        poses: Vec::new(),
        paths: 0,
        regular: 0,
        singular: 0,
        no_pose: 0,
        lost: 0,
        unused: 0,
    };
    let mut points: Vec<Plane> = Vec::new();
    for pose in on {
        let y = dual_quaternion(pose, m.size());
        let y = y / slicer.chart.dot(&y);
        // a hyperplane through the point, moved to the first form
        let mut own = draw(&mut rng);
        own -= slicer.chart * own.dot(&y);
        let start =
            is_regular(&equations, &y).then(|| slicer.newton(y, &SliceSweep::new(&own, &own), 0.0)).flatten();
        let start = start.and_then(|y| slicer.carry(y, &SliceSweep::new(&own, &forms[0])).ok());
        let Some(start) = start else {
            out.unused += 1;
            continue;
        };
        if points.iter().any(|z| same(z, &start)) {
            continue;
        }
        if let Some((all, degree)) = gather(&slicer, start, &forms[0], &mut rng) {
            points.extend(all);
            out.components.push(degree);
        }
    }
    for _ in 0..ATTEMPTS {
        // another linear function and another gamma: real points of all attempts are kept
        let critical = Critical::new(&slicer, &forms, &points, &mut rng);
        (out.paths, out.regular, out.singular, out.no_pose, out.lost) = (0, 0, 0, 0, 0);
        for y in &points {
            for form in &forms {
                out.paths += 1;
                match slicer.carry(*y, &SliceSweep::new(&forms[0], form)) {
                    Ok(start) => out.end(&slicer, &critical, start, m.size()),
                    Err(_) => out.lost += 1,
                }
            }
        }
        if out.lost == 0 {
            break;
        }
    }
    out.poses.sort_by(|x, y| x.position.norm().total_cmp(&y.position.norm()));
    out
}

impl CriticalPoses {
    /// Follows one path and classifies its end.
    fn end(&mut self, slicer: &Slicer<'_>, critical: &Critical, start: Plane, size: f64) {
        let (y, limit) = match slicer.carry(start, critical) {
            Ok(y) => (y, REAL),
            // the end is near, and singular
            Err(lost) if lost.t > NEAR_THE_END => (lost.y, NEARLY_REAL),
            Err(_) => {
                self.lost += 1;
                return;
            }
        };
        // the multiple with a real largest entry
        let turned = y / y[y.icamax()];
        let real = turned.map(|z| z.re);
        let length = real.fixed_rows::<4>(0).norm();
        let is_real = turned.map(|z| z.im).norm() <= limit * real.norm() && length > REAL * real.norm();
        if is_real {
            self.poses.push(real_pose(&(real / length), size));
        }
        let e = y.fixed_rows::<4>(0);
        if !is_real && e.dot(&e).norm() < NO_POSE * y.norm_squared() {
            self.no_pose += 1;
        } else if limit < NEARLY_REAL {
            self.regular += 1;
        } else {
            self.singular += 1;
        }
    }
}

/// `(1 - t) gamma L_1 .. L_7 + t scale D`.
struct Critical {
    forms: [Plane; FORMS],
    gamma: Z,
    scale: f64,
    /// The matrix of `D` at the unit vectors, without the constant row.
    linear: [System; 8],
    constant: System,
}

impl Critical {
    fn new(slicer: &Slicer<'_>, forms: &[Plane; FORMS], points: &[Plane], rng: &mut Rng) -> Self {
        let linear = std::array::from_fn(|k| {
            let unit = Plane::from_fn(|i, _| Z::from(if i == k { 1.0 } else { 0.0 }));
            let mut n = System::zeros();
            n.fixed_view_mut::<6, 8>(0, 0).copy_from(&slicer.derivatives(&unit));
            if k < 4 {
                n[(6, k)] = Z::from(1.0);
            }
            n
        });
        let mut constant = System::zeros();
        for k in 0..8 {
            constant[(7, k)] = Z::from(rng.normal());
        }
        let mut out = Self {
            forms: *forms,
            gamma: Z::from_polar(1.0, rng.uniform(0.0, 6.0)),
            scale: 1.0,
            linear,
            constant,
        };
        // both parts of equal size at the starts of the paths
        let ratio = |y: &Plane| {
            let product: f64 = forms[1..].iter().map(|l| l.dot(y).norm()).product();
            product * forms[0].norm() * y.norm() / out.matrix(y).determinant().norm()
        };
        let mut ratios: Vec<f64> = points.iter().map(ratio).filter(|r| r.is_finite()).collect();
        ratios.sort_by(f64::total_cmp);
        out.scale = ratios.get(ratios.len() / 2).copied().unwrap_or(1.0);
        out
    }

    fn matrix(&self, y: &Plane) -> System {
        self.linear.iter().zip(y.iter()).fold(self.constant, |sum, (n, y)| sum + n * *y)
    }
}

impl SliceCondition for Critical {
    fn at(&self, t: f64, y: &Plane) -> (Z, Plane, Z) {
        let values = self.forms.map(|l| l.dot(y));
        let product: Z = values.iter().product();
        let without =
            |k: usize| -> Z { values.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, v)| v).product() };
        let mut slope = Plane::zeros();
        for (k, l) in self.forms.iter().enumerate() {
            slope += l * without(k);
        }
        let n = self.matrix(y);
        let lu = n.lu();
        let d = lu.determinant() * self.scale;
        // d det N = det N tr (N^-1 dN)
        let inverse = lu.try_inverse().unwrap_or_else(System::zeros);
        let gradient = Plane::from_fn(|k, _| d * inverse.component_mul(&self.linear[k].transpose()).sum());
        let (start, end) = (self.gamma * (1.0 - t), Z::from(t));
        (start * product + end * d, slope * start + gradient * end, d - self.gamma * product)
    }
}

/// `(e, g)`, a multiple of it: a row of `4 e e^T`, which is linear in `R`, with the largest diagonal entry.
pub(super) fn dual_quaternion(pose: &ComplexPose, size: f64) -> Plane {
    let r = &pose.rotation;
    let trace = r.trace();
    let one = Z::from(1.0);
    let mut m = Matrix4::<Z>::zeros();
    m[(0, 0)] = one + trace;
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        m[(0, i + 1)] = r[(k, j)] - r[(j, k)];
        m[(i + 1, 0)] = m[(0, i + 1)];
        m[(i + 1, i + 1)] = one + r[(i, i)] * 2.0 - trace;
        m[(i + 1, j + 1)] = r[(i, j)] + r[(j, i)];
        m[(j + 1, i + 1)] = m[(i + 1, j + 1)];
    }
    let best = (0..4).fold(0, |b, k| if m[(k, k)].norm() > m[(b, b)].norm() { k } else { b });
    let e: Vector4<Z> = m.column(best).into_owned() / m[(best, best)];
    let p = pose.position.map(|x| x / size);
    let v = e.fixed_rows::<3>(1).into_owned();
    let scalar = -p.dot(&v);
    let vector = p * e[0] + p.cross(&v);
    Plane::from([e[0], e[1], e[2], e[3], scalar, vector[0], vector[1], vector[2]])
}
