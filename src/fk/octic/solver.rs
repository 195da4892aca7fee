//! The octic for control loops: all sixteen poses side by side, without allocation.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use super::{Biquadratic, Problem, closure, minor, resultant};
use crate::fk::newton::refine;
use crate::fk::{FkError, Method};
use crate::geom::ComplexPose;
use crate::manipulator::{Manipulator, Octahedral, SquaredLegLengths};
use crate::poly::{Batch, LANES, octic_roots};
use crate::solve::certify::exact_squares;
use crate::solve::certify::octahedral::{OctahedralCertificates, OctahedralCertifier};

/// Relative accuracy asked of the octic's roots before both closures take over.
const COARSE: f64 = 1e-6;
/// Newton steps on both closures; from `COARSE` two reach rounding.
const POLISHES: usize = 3;
/// Pairs closer than this, relative to their size, are left to the general treatment.
const SEPARATE: f64 = 1e-5;
/// Largest residual of a pose that is returned.
const RESIDUAL: f64 = 1e-12;

/// Forward kinematics of one octahedral design; made once, a solve allocates nothing.
///
/// ```
/// use equipod::fk::OcticSolver;
/// use equipod::manipulator::{LegLengths, Manipulator};
/// use nalgebra::Point3;
/// let triangle = |r: f64| {
///     let h = 0.75f64.sqrt() * r;
///     vec![Point3::new(0.0, 0.0, 0.0), Point3::new(r / 2.0, h, 0.0), Point3::new(r, 0.0, 0.0)]
/// };
/// let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
/// let m = Manipulator::try_new(triangle(12.0), triangle(6.0), legs)?;
/// let s = LegLengths::try_new([19.8, 18.0, 18.0, 17.0, 14.9, 17.8])?.squared();
/// let found = OcticSolver::new(&m)?.solve(&s).ok_or("degenerate lengths")?;
/// let real = found.poses.iter().filter(|p| p.imaginary_size(m.size()) < 1e-9).count();
/// assert_eq!((found.poses.len(), real), (16, 12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct OcticSolver {
    manipulator: Manipulator,
    size: f64,
    /// Leg of the design at each place of the cycle.
    order: [usize; 6],
    base: Triangle,
    platform: Triangle,
    /// Corners in the design's frames over its size.
    base_corners: [Vector3<f64>; 3],
    platform_corners: [Vector3<f64>; 3],
    /// Absent where the joints cannot be scaled exactly.
    certifier: Option<OctahedralCertifier>,
}

/// A triangle in a frame of its own: corners `(0, 0)`, `(b, 0)`, `(u, v)`; rows of `axes` are the frame.
#[derive(Debug, Clone)]
struct Triangle {
    b: f64,
    u: f64,
    v: f64,
    axes: [[f64; 3]; 3],
}

impl Triangle {
    fn of(p: &[Vector3<f64>; 3]) -> Self {
        let (side, other) = (p[1] - p[0], p[2] - p[0]);
        let b = side.norm();
        let x = side / b;
        let u = other.dot(&x);
        let rest = other - x * u;
        let v = rest.norm();
        let y = rest / v;
        Self { b, u, v, axes: [x.into(), y.into(), x.cross(&y).into()] }
    }
}

/// All sixteen poses: entry `2 k + 1` is the mirror image of entry `2 k` in the planes of both triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct OcticPoses {
    /// The poses.
    pub poses: [ComplexPose; 2 * LANES],
    /// Squared distances `(s15, s34)` of the pairs, design units squared.
    pub pairs: [[Complex64; 2]; LANES],
    /// Largest error of the leg equations over the squared size, and of `R^T R = I`, over the square of the pose's own
    /// numbers where these exceed 1; mostly of entries `2 k`, before they are turned into the design's frames.
    pub residual: f64,
}

/// Three complex coordinates in eight lanes.
type Points = [Batch; 3];

#[inline(always)]
fn dot(a: &Points, b: &Points) -> Batch {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: &Points, b: &Points) -> Points {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn minus(a: &Points, b: &Points) -> Points {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Value and derivatives by `x` and `y` in all lanes.
#[inline(always)]
fn evaluate(p: &Biquadratic, x: Batch, y: Batch) -> [Batch; 3] {
    // columns: polynomials in x, and their derivatives
    let column = |j: usize| (Batch::real(p[2][j]) * x).plus(p[1][j]) * x;
    let value = |j: usize| column(j).plus(p[0][j]);
    let slope = |j: usize| x.times(2.0 * p[2][j]).plus(p[1][j]);
    let (c0, c1, c2) = (value(0), value(1), value(2));
    let (d0, d1, d2) = (slope(0), slope(1), slope(2));
    [(c2 * y + c1) * y + c0, (d2 * y + d1) * y + d0, c2.times(2.0) * y + c1]
}

#[inline(always)]
fn horner(c: &[f64; 5], x: Batch) -> Batch {
    let mut out = Batch::real(c[4]);
    for k in (0..4).rev() {
        out = (out * x).plus(c[k]);
    }
    out
}

#[inline(always)]
fn every(values: &[f64; LANES], test: impl Fn(f64) -> bool) -> bool {
    values.iter().all(|v| test(*v))
}

impl OcticSolver {
    /// Prepares an octahedral design; only coordinates count, not whether joints are named as shared.
    ///
    /// # Errors
    /// [`FkError::NotApplicable`] when it is not octahedral.
    pub fn new(m: &Manipulator) -> Result<Self, FkError> {
        let refuse = |reason: String| FkError::NotApplicable { method: Method::Octic, reason };
        let merged = Manipulator::from_legs(m.legs()).map_err(|e| refuse(e.to_string()))?;
        let octahedral = Octahedral::recognise(&merged).map_err(|e| refuse(e.to_string()))?;
        let size = m.size();
        let base_corners = octahedral.base().map(|p| p.coords / size);
        let platform_corners = octahedral.platform().map(|p| p.coords / size);
        Ok(Self {
            manipulator: m.clone(),
            size,
            order: octahedral.order().map(crate::manipulator::LegIndex::get),
            base: Triangle::of(&base_corners),
            platform: Triangle::of(&platform_corners),
            base_corners,
            platform_corners,
            certifier: OctahedralCertifier::new(&octahedral).ok(),
        })
    }

    /// Proofs for the poses that [`solve`](Self::solve) gave for the same lengths: existence, uniqueness, reality of each pair, and
    /// that all sixteen are distinct. Allocates nothing. Squared lengths are taken as exact.
    #[must_use]
    pub fn certify(&self, s: &SquaredLegLengths, found: &OcticPoses) -> OctahedralCertificates {
        let none = OctahedralCertificates { pairs: [None; LANES], complete: false };
        let Some(certifier) = &self.certifier else { return none };
        certifier.certify(&exact_squares(s), &found.pairs, &found.poses)
    }

    /// All sixteen finite complex poses, or `None` where these lengths need the general treatment of
    /// [`Octic`](super::Octic): coinciding or nearly coinciding roots, roots at infinity, poses whose corners lie in one
    /// plane, or a residual above `1e-12`.
    #[must_use]
    pub fn solve(&self, s: &SquaredLegLengths) -> Option<OcticPoses> {
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || self.solve_lanes(s),
        )
    }

    #[inline(always)]
    fn solve_lanes(&self, s: &SquaredLegLengths) -> Option<OcticPoses> {
        let scale = (self.size * self.size).recip();
        let given = s.get();
        let scaled = self.order.map(|i| given[i] * scale);
        let (a, b) = self.closures(&scaled);
        let (x, y) = pairs(&a, &b)?;
        let corners = self.corners(&scaled, x, y);
        let frame = self.frame(&corners);
        let mut residuals = self.residuals(&scaled, &corners[0], &frame);
        let mut poses = self.poses(&corners[0], &frame);
        for (k, residual) in residuals.iter_mut().enumerate() {
            if !(*residual <= RESIDUAL) {
                *residual = self.improve(s, &mut poses[2 * k..2 * k + 2])?;
            }
        }
        let unit = self.size * self.size;
        let pairs = std::array::from_fn(|k| [x.lane(k) * unit, y.lane(k) * unit]);
        Some(OcticPoses { poses, pairs, residual: residuals.into_iter().fold(0.0, f64::max) })
    }

    /// Newton's method on the leg equations for both mirror images; their residual, or `None` when it stays too large or
    /// a pose was not near its root.
    #[cold]
    fn improve(&self, s: &SquaredLegLengths, poses: &mut [ComplexPose]) -> Option<f64> {
        let mut worst = 0.0_f64;
        for pose in poses {
            let scale = pose_scale(pose, self.size);
            // Newton's method keeps R^T R as it is, so that is put right first
            let rotation = orthogonalised(&pose.rotation);
            let next = refine(&self.manipulator, s, &ComplexPose { rotation, ..*pose });
            let residual = next.residual(&self.manipulator, s) / (scale * scale);
            let near = next.distance(pose, self.size) <= SEPARATE * scale;
            if !(near && residual <= RESIDUAL) {
                return None;
            }
            worst = worst.max(residual);
            *pose = next;
        }
        Some(worst)
    }

    pub(super) fn manipulator(&self) -> &Manipulator {
        &self.manipulator
    }

    /// The same numbers for the general treatment.
    pub(super) fn problem(&self, s: &SquaredLegLengths) -> Problem {
        let (base, platform, given) = (self.base_corners, self.platform_corners, s.get());
        let scale = (self.size * self.size).recip();
        Problem { base, platform, s: self.order.map(|i| given[i] * scale), size: self.size }
    }

    #[inline(always)]
    fn closures(&self, squares: &[f64; 6]) -> (Biquadratic, Biquadratic) {
        let s = squares.map(|k| [k, 0.0]);
        let unknown = [0.0, 1.0];
        let plane =
            |t: &Triangle| [Vector3::zeros(), Vector3::new(t.b, 0.0, 0.0), Vector3::new(t.u, t.v, 0.0)];
        let (base, platform) = (plane(&self.base), plane(&self.platform));
        let [p1, p2, p3] = &base;
        let [p4, p5, p6] = &platform;
        // legs: s14 s24 s25 s35 s36 s16
        let (short, long) = (self.platform.b * self.platform.b, (p3 - p1).norm_squared());
        let first = closure([p1, p2, p3], [unknown, s[2], s[3]], [s[0], s[1], unknown], short);
        let second = closure([p4, p5, p6], [s[0], unknown, s[5]], [unknown, s[3], s[4]], long);
        (first, second)
    }

    /// `P4, P5, P6` in the frame of the base triangle, one of the two mirror images.
    #[inline(always)]
    fn corners(&self, s: &[f64; 6], x: Batch, y: Batch) -> [Points; 3] {
        let Triangle { b, u, v, .. } = self.base;
        let far = u * u + v * v;
        let p4x = 0.5 * (s[0] + b * b - s[1]) / b;
        let p4y = y.times(-0.5 / v).plus((0.5 * (s[0] + far) - u * p4x) / v);
        let p5x = x.times(0.5 / b).plus(0.5 * (b * b - s[2]) / b);
        let p5y = (x.times(0.5).plus(0.5 * (far - s[3])) - p5x.times(u)).times(1.0 / v);
        let (z4, z5) = (Batch::real(s[0] - p4x * p4x) - p4y * p4y, x - p5x * p5x - p5y * p5y);
        // the closure: product of both heights
        let side = self.platform.b * self.platform.b;
        let product = x.times(0.5).plus(0.5 * (s[0] - side)) - p5x.times(p4x) - p4y * p5y;
        let (n4, n5) = (z4.norm_sqr(), z5.norm_sqr());
        let mut first = [false; LANES];
        for k in 0..LANES {
            first[k] = n4[k] >= n5[k];
        }
        let root = z4.select(z5, first).sqrt();
        let other = product * root.reciprocal();
        let p4 = [Batch::real(p4x), p4y, root.select(other, first)];
        let p5 = [p5x, p5y, other.select(root, first)];
        // P6 from its distances to P1 (origin), P3, P4, P5: three linear equations
        let (t, d) = (&self.platform, self.platform.u - self.platform.b);
        let k3 = 0.5 * (s[5] + far - s[4]);
        let k4 = 0.5 * (s[5] + s[0] - (t.u * t.u + t.v * t.v));
        let k5 = x.times(0.5).plus(0.5 * (s[5] - (d * d + t.v * t.v)));
        let normal = cross(&p4, &p5);
        let p3 = [Batch::real(u), Batch::real(v), Batch::ZERO];
        let (from5, from4) = (cross(&p5, &p3), cross(&p3, &p4));
        let inverse = (normal[0].times(u) + normal[1].times(v)).reciprocal();
        let p6 = [0, 1, 2].map(|k| (normal[k].times(k3) + from5[k].times(k4) + from4[k] * k5) * inverse);
        [p4, p5, p6]
    }

    /// Axes of the platform triangle's frame in that of the base triangle.
    #[inline(always)]
    fn frame(&self, p: &[Points; 3]) -> [Points; 3] {
        let t = &self.platform;
        let x = minus(&p[1], &p[0]).map(|z| z.times(1.0 / t.b));
        let w = minus(&p[2], &p[0]);
        let y = [0, 1, 2].map(|k| (w[k] - x[k].times(t.u)).times(1.0 / t.v));
        let z = cross(&x, &y);
        [x, y, z]
    }

    /// Of the pose that the frame and `P4` stand for, not of the corners that made it.
    #[inline(always)]
    fn residuals(&self, s: &[f64; 6], p4: &Points, frame: &[Points; 3]) -> [f64; LANES] {
        let [x, y, z] = frame;
        let t = &self.platform;
        let at = |u: f64, v: f64| -> Points { [0, 1, 2].map(|k| p4[k] + x[k].times(u) + y[k].times(v)) };
        let corners = [*p4, at(t.b, 0.0), at(t.u, t.v)];
        let base = [[0.0, 0.0], [self.base.b, 0.0], [self.base.u, self.base.v]];
        let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        let mut worst = [0.0_f64; LANES];
        let mut raise = |error: Batch| {
            for (worst, e) in worst.iter_mut().zip(error.norm_sqr()) {
                *worst = if e > *worst || e.is_nan() { e } else { *worst };
            }
        };
        for (i, (foot, head)) in legs.into_iter().enumerate() {
            let c = &corners[head];
            let d = [c[0].plus(-base[foot][0]), c[1].plus(-base[foot][1]), c[2]];
            raise(dot(&d, &d).plus(-s[i]));
        }
        let mut scale = [1.0_f64; LANES];
        for axis in [x, y, z] {
            raise(dot(axis, axis).plus(-1.0));
            for n in axis.map(Batch::norm_sqr).iter().chain(&p4.map(Batch::norm_sqr)) {
                for k in 0..LANES {
                    scale[k] = scale[k].max(n[k]);
                }
            }
        }
        raise(dot(x, y));
        std::array::from_fn(|k| worst[k].sqrt() / scale[k])
    }

    /// Both mirror images of every lane in the frames of the design.
    ///
    /// `R = E^T F G` with the rows of `E` and `G` the axes of the triangles, `F` the frame. Mirrored in the plane of the base the
    /// corners change the sign of their third coordinate, so that the first two axes do and the third, their cross product, changes its
    /// others.
    #[inline(always)]
    fn poses(&self, p4: &Points, frame: &[Points; 3]) -> [ComplexPose; 2 * LANES] {
        let (e, g) = (&self.base.axes, &self.platform.axes);
        let (p1, b4) = (self.base_corners[0], self.platform_corners[0]);
        let zero = ComplexPose { rotation: Matrix3::zeros(), position: Vector3::zeros() };
        let mut out = [zero; 2 * LANES];
        for mirrored in [false, true] {
            let sign = if mirrored { -1.0 } else { 1.0 };
            // columns of E^T F
            let turned = |v: &Points, sign: f64, sense: f64| -> Points {
                [0, 1, 2].map(|i| {
                    v[0].times(sense * e[0][i]) + v[1].times(sense * e[1][i]) + v[2].times(sign * e[2][i])
                })
            };
            let axes =
                [turned(&frame[0], sign, 1.0), turned(&frame[1], sign, 1.0), turned(&frame[2], 1.0, sign)];
            let corner = turned(p4, sign, 1.0);
            for i in 0..3 {
                let row: Points = [0, 1, 2].map(|j| {
                    axes[0][i].times(g[0][j]) + axes[1][i].times(g[1][j]) + axes[2][i].times(g[2][j])
                });
                let shift = row[0].times(b4.x) + row[1].times(b4.y) + row[2].times(b4.z);
                let position = (corner[i].plus(p1[i]) - shift).times(self.size);
                for k in 0..LANES {
                    let pose = &mut out[2 * k + usize::from(mirrored)];
                    for j in 0..3 {
                        pose.rotation[(i, j)] = row[j].lane(k);
                    }
                    pose.position[i] = position.lane(k);
                }
            }
        }
        out
    }
}

/// `R (3 I - R^T R) / 2`, which squares the defect of `R^T R = I`.
fn orthogonalised(r: &Matrix3<Complex64>) -> Matrix3<Complex64> {
    let three = Matrix3::identity() * Complex64::from(3.0);
    r * (three - r.transpose() * r) * Complex64::from(0.5)
}

/// The largest of 1 and the moduli of `R` and of `p` over the size.
fn pose_scale(p: &ComplexPose, size: f64) -> f64 {
    let r = p.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
    p.position.iter().map(|z| z.norm() / size).fold(r, f64::max)
}

/// The eight pairs `(s15, s34)`, `None` when they are not eight well separated ones.
#[inline(always)]
fn pairs(a: &Biquadratic, b: &Biquadratic) -> Option<(Batch, Batch)> {
    let mut x = octic_roots(&resultant(a, b), COARSE)?;
    // the common root of both quadratics in y: y = -(a2 b0 - a0 b2) / (a2 b1 - a1 b2)
    let denominator = horner(&minor(a, b, 2, 1), x);
    let mut y = (horner(&minor(a, b, 2, 0), x) * denominator.reciprocal()).times(-1.0);
    let mut moved = [0.0; LANES];
    for _ in 0..POLISHES {
        let (f, g) = (evaluate(a, x, y), evaluate(b, x, y));
        let inverse = (f[1] * g[2] - f[2] * g[1]).reciprocal();
        let dx = (f[0] * g[2] - f[2] * g[0]) * inverse;
        let dy = (f[1] * g[0] - f[0] * g[1]) * inverse;
        (x, y) = (x - dx, y - dy);
        let (mx, my) = (dx.norm_sqr(), dy.norm_sqr());
        for k in 0..LANES {
            moved[k] = mx[k] + my[k];
        }
    }
    let (nx, ny) = (x.norm_sqr(), y.norm_sqr());
    let mut ratio = [0.0; LANES];
    for k in 0..LANES {
        ratio[k] = moved[k] / (nx[k] + ny[k]);
    }
    (every(&ratio, |r| r <= 1e-20) && separate(&x, &y)).then_some((x, y))
}

#[inline(always)]
fn separate(x: &Batch, y: &Batch) -> bool {
    let mut nearest = f64::INFINITY;
    for shift in 1..=LANES / 2 {
        for k in 0..LANES {
            let l = (k + shift) % LANES;
            let gap = |z: &Batch| (z.re[k] - z.re[l]).powi(2) + (z.im[k] - z.im[l]).powi(2);
            let size = x.re[k].powi(2) + x.im[k].powi(2) + y.re[k].powi(2) + y.im[k].powi(2);
            let ratio = (gap(x) + gap(y)) / size;
            nearest = if ratio < nearest || ratio.is_nan() { ratio } else { nearest };
        }
    }
    nearest > SEPARATE * SEPARATE
}
