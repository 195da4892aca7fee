//! All eight pairs side by side: the roots of the octic, the corners, the poses and their residuals.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use nalgebra::{Matrix3, Vector3};

use super::factors::Factors;
use super::parallel::Translation;
use super::solver::{FramedTriangle, OcticSolver};
use super::{minor, resultant};
use num::batch::{ComplexBatch, LANES};
use num::poly::octic_roots;
pub(super) use num::vector::{cross, dot};
use platform::geom::ComplexPose;

/// Relative accuracy asked of the octic's roots before both closures take over.
pub(super) const COARSE: f64 = 1e-6;
/// Pairs closer than this, relative to their size, are left to the general treatment.
pub(super) const SEPARATE: f64 = 1e-5;

/// Joints of the base and corners of the platform that the legs in their order join.
pub(super) const LEGS: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];

/// Three complex coordinates in eight lanes.
pub(super) type Points = [ComplexBatch; 3];
const ORIGIN: Points = [ComplexBatch::ZERO; 3];

#[inline(always)]
fn horner(c: &[f64; 5], x: ComplexBatch) -> ComplexBatch {
    let mut out = ComplexBatch::real(c[4]);
    for k in (0..4).rev() {
        out = (out * x).plus(c[k]);
    }
    out
}

/// The eight pairs `(s15, s34)`; at a translation those that are not known from it, in the lanes that it leaves to
/// them.
#[inline(always)]
pub(super) fn pairs(
    first: &Factors,
    second: &Factors,
    translation: Option<&Translation>,
    polishes: usize,
) -> Option<(ComplexBatch, ComplexBatch)> {
    let (a, b) = (first.expanded(), second.expanded());
    let octic = resultant(&a, &b);
    let mut x = match translation {
        Some(known) => known.other_roots(&octic)?,
        None => octic_roots(&octic, COARSE)?,
    };
    // the common root of both quadratics in y: y = -(a2 b0 - a0 b2) / (a2 b1 - a1 b2)
    let denominator = horner(&minor(&a, &b, 2, 1), x);
    let mut y = (horner(&minor(&a, &b, 2, 0), x) * denominator.reciprocal()).times(-1.0);
    for _ in 0..polishes {
        let (f, g) = (first.values(x, y), second.values(x, y));
        let inverse = (f[1] * g[2] - f[2] * g[1]).reciprocal();
        let dx = (f[0] * g[2] - f[2] * g[0]) * inverse;
        let dy = (f[1] * g[0] - f[0] * g[1]) * inverse;
        (x, y) = (x - dx, y - dy);
    }
    Some((x, y))
}

/// Whether every two lanes are apart, relative to their size.
#[inline(always)]
pub(super) fn separate<const N: usize>(numbers: &[ComplexBatch; N]) -> bool {
    let mut nearest = f64::INFINITY;
    for shift in 1..=LANES / 2 {
        for k in 0..LANES {
            let l = (k + shift) % LANES;
            let (mut distance, mut size) = (0.0, 0.0);
            for z in numbers {
                let (re, im) = (z.re[k] - z.re[l], z.im[k] - z.im[l]);
                distance += re * re + im * im;
                size += z.re[k] * z.re[k] + z.im[k] * z.im[k];
            }
            let ratio = distance / size;
            nearest = if ratio < nearest || ratio.is_nan() { ratio } else { nearest };
        }
    }
    nearest > SEPARATE * SEPARATE
}

/// `P4, P5, P6` in the frame of the base triangle, one of the two mirror images, and the pairs `(s15, s34)`.
pub(super) type Corners = ([Points; 3], ComplexBatch, ComplexBatch);

/// Poses in units of the design, with their residuals and scales.
pub(super) struct PoseLanes {
    pub(super) poses: [ComplexPose; 2 * LANES],
    /// As [`ComplexPose::residual`].
    pub(super) residuals: [f64; 2 * LANES],
    /// The largest of 1 and the parts of the entries of `R` and `p` over the size.
    pub(super) scales: [f64; 2 * LANES],
}

impl OcticSolver {
    /// `P4, P5, P6` in the frame of the base triangle, one of the two mirror images.
    #[inline(always)]
    pub(super) fn corners(&self, s: &[f64; 6], x: ComplexBatch, y: ComplexBatch) -> [Points; 3] {
        let FramedTriangle { b, u, v, .. } = self.base;
        let far = u * u + v * v;
        let p4x = 0.5 * (s[0] + b * b - s[1]) / b;
        let p4y = y.times(-0.5 / v).plus((0.5 * (s[0] + far) - u * p4x) / v);
        let p5x = x.times(0.5 / b).plus(0.5 * (b * b - s[2]) / b);
        let p5y = (x.times(0.5).plus(0.5 * (far - s[3])) - p5x.times(u)).times(1.0 / v);
        let (z4, z5) = (ComplexBatch::real(s[0] - p4x * p4x) - p4y * p4y, x - p5x * p5x - p5y * p5y);
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
        let p4 = [ComplexBatch::real(p4x), p4y, root.select(other, first)];
        let p5 = [p5x, p5y, other.select(root, first)];
        // P6 from its distances to P1 (origin), P3, P4, P5: three linear equations
        let (t, d) = (&self.platform, self.platform.u - self.platform.b);
        let k3 = 0.5 * (s[5] + far - s[4]);
        let k4 = 0.5 * (s[5] + s[0] - (t.u * t.u + t.v * t.v));
        let k5 = x.times(0.5).plus(0.5 * (s[5] - (d * d + t.v * t.v)));
        let normal = cross(&p4, &p5);
        let p3 = [ComplexBatch::real(u), ComplexBatch::real(v), ComplexBatch::ZERO];
        let (from5, from4) = (cross(&p5, &p3), cross(&p3, &p4));
        let inverse = (normal[0].times(u) + normal[1].times(v)).reciprocal();
        let mut p6 = ORIGIN;
        for k in 0..3 {
            p6[k] = (normal[k].times(k3) + from5[k].times(k4) + from4[k] * k5) * inverse;
        }
        [p4, p5, p6]
    }

    /// Axes of the platform triangle's frame in that of the base triangle.
    #[inline(always)]
    pub(super) fn frame(&self, p: &[Points; 3]) -> [Points; 3] {
        let (t, mut x, mut y) = (&self.platform, ORIGIN, ORIGIN);
        let (side, height) = (1.0 / t.b, 1.0 / t.v);
        for k in 0..3 {
            x[k] = (p[1][k] - p[0][k]).times(side);
            y[k] = (p[2][k] - p[0][k] - x[k].times(t.u)).times(height);
        }
        [x, y, cross(&x, &y)]
    }

    /// Both mirror images of every lane in the frames of the design.
    ///
    /// `R = E^T F G`; the rows of `E` and `G` are the axes of the triangles, `F` is the frame. The mirror in the plane
    /// of the base changes the sign of the third coordinate of the corners, and so of the first two axes. The third
    /// axis, their cross product, changes the other coordinates. So some entries of `F` keep their signs and the others
    /// change them. This splits `R` into an even and an odd part.
    #[inline(always)]
    pub(super) fn place(&self, s: &[f64; 6], p4: &Points, f: &[Points; 3]) -> PoseLanes {
        let (e, g) = (&self.base.axes, &self.platform.axes);
        let (mut even, mut odd) = ([ORIGIN; 3], [ORIGIN; 3]);
        let (mut flat, mut high) = (ORIGIN, ORIGIN);
        for i in 0..3 {
            let (mut keeps, mut changes) = (ORIGIN, ORIGIN);
            for j in 0..3 {
                let plane = f[j][0].times(e[0][i]) + f[j][1].times(e[1][i]);
                let normal = f[j][2].times(e[2][i]);
                (keeps[j], changes[j]) = if j < 2 { (plane, normal) } else { (normal, plane) };
            }
            for j in 0..3 {
                even[i][j] = keeps[0].times(g[0][j]) + keeps[1].times(g[1][j]) + keeps[2].times(g[2][j]);
                odd[i][j] = changes[0].times(g[0][j]) + changes[1].times(g[1][j]) + changes[2].times(g[2][j]);
            }
            flat[i] = p4[0].times(e[0][i]) + p4[1].times(e[1][i]);
            high[i] = p4[2].times(e[2][i]);
        }
        let zero = ComplexPose { rotation: Matrix3::zeros(), position: Vector3::zeros() };
        let mut out =
            PoseLanes { poses: [zero; 2 * LANES], residuals: [0.0; 2 * LANES], scales: [0.0; 2 * LANES] };
        let (p1, b4) = (self.base_corners[0], self.platform_corners[0]);
        for mirrored in 0..2 {
            let (mut r, mut p) = ([ORIGIN; 3], ORIGIN);
            for i in 0..3 {
                for j in 0..3 {
                    r[i][j] = if mirrored == 0 { even[i][j] + odd[i][j] } else { even[i][j] - odd[i][j] };
                }
                let shift = r[i][0].times(b4.x) + r[i][1].times(b4.y) + r[i][2].times(b4.z);
                let corner = if mirrored == 0 { flat[i] + high[i] } else { flat[i] - high[i] };
                p[i] = corner.plus(p1[i]) - shift;
            }
            let (residuals, scales) = self.residuals(s, &r, &p);
            for k in 0..LANES {
                let n = 2 * k + mirrored;
                let pose = &mut out.poses[n];
                for i in 0..3 {
                    for j in 0..3 {
                        pose.rotation[(i, j)] = r[i][j].lane(k);
                    }
                    pose.position[i] = p[i].lane(k) * self.size;
                }
                (out.residuals[n], out.scales[n]) = (residuals[k], scales[k]);
            }
        }
        out
    }

    /// Largest errors of the leg equations and of `R^T R = I`, and the largest of 1 and the parts of the entries.
    #[inline(always)]
    fn residuals(&self, s: &[f64; 6], r: &[Points; 3], p: &Points) -> ([f64; LANES], [f64; LANES]) {
        let mut worst = [0.0_f64; LANES];
        let mut corners = [ORIGIN; 3];
        for (corner, b) in corners.iter_mut().zip(&self.platform_corners) {
            for i in 0..3 {
                corner[i] = r[i][0].times(b.x) + r[i][1].times(b.y) + r[i][2].times(b.z) + p[i];
            }
        }
        for (leg, (foot, head)) in LEGS.into_iter().enumerate() {
            let (a, c) = (&self.base_corners[foot], &corners[head]);
            let d = [c[0].plus(-a.x), c[1].plus(-a.y), c[2].plus(-a.z)];
            raise(&mut worst, dot(&d, &d).plus(-s[leg]));
        }
        for i in 0..3 {
            for j in i..3 {
                let product = r[0][i] * r[0][j] + r[1][i] * r[1][j] + r[2][i] * r[2][j];
                raise(&mut worst, if i == j { product.plus(-1.0) } else { product });
            }
        }
        let mut scale = [1.0_f64; LANES];
        for z in r.iter().flatten().chain(p) {
            for k in 0..LANES {
                let (re, im) = (z.re[k].abs(), z.im[k].abs());
                let part = if re > im { re } else { im };
                scale[k] = if part > scale[k] { part } else { scale[k] };
            }
        }
        for w in &mut worst {
            *w = w.sqrt();
        }
        (worst, scale)
    }
}

/// The larger of `worst` and the squared modulus of the error, NaN when that is.
#[inline(always)]
fn raise(worst: &mut [f64; LANES], error: ComplexBatch) {
    let e = error.norm_sqr();
    for k in 0..LANES {
        worst[k] = if e[k] <= worst[k] { worst[k] } else { e[k] };
    }
}
