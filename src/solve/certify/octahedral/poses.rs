//! From enclosed `(x, y)` to the poses, and how far given poses are from these.
//!
//! **Corners.** The platform triangle in the frame of the base triangle, and its axes. Every step is a formula for the root itself, evaluated on discs, so that the results hold the pose of the root. They stay finite only
//! where `P4` and `P5` are proved to lie off the base plane and `P1 P3 P4 P5` to be no flat tetrahedron, which the theorem asks for.
//!
//! **Poses.** `R = E^T F G`: rows of `E`, `G` are the frames of base and platform triangle, `F` is enclosed. Mirrored in the base plane the third
//! coordinates of the corners change sign; the third axis is a cross product, so that `F` becomes `D F D`, `D = diag(1, 1, -1)`. With
//! `F = F_e + F_o`, the part that keeps its signs and the part that changes them, `R = E^T F_e G +- E^T F_o G`. And `p = P1 + E^T c4 - R b4`.
//!
//! **Bounds.** `E`, `G` are orthogonal and known up to `r_E`, `r_G <= 2^-10` an entry; entries of `F` up to `rho`, their moduli at most `M`.
//! Entries are at most the spectral norm, and that is at most three times the largest entry:
//!
//! * `|E'^T F' G' - E^T F G| <= 3 rho + 9 M (r_E + r_G) (1 + 3 r_G)`;
//! * rounding: each term passes 7 roundings, column sums of `|E|`, `|G|` are at most `sqrt 3 (1 + 2^-8)`, two parts: below `40 u M`;
//! * `p`: `2 rho_4 + 3 r_E M_4 + (bound of R) |b4|_1`, rounding `12 u (|a1| + 2 M_4 + M_R |b4|_1)`, and where the corners `a1`, `b4` are known within radii `r_a`, `r_b` a
//!   coordinate `r_a + 3 r_b (M_R + bound of R)`.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::arithmetic::{Discs, Reals, Triangle, parts, reciprocal, sizes};
use super::{OctahedralCertifier, PAIRS, U};
use crate::geom::ComplexPose;
use crate::num::ball::Real;
use crate::num::batch::{ComplexBatch, LANES};

pub(super) type Points = [Discs; 3];

/// One of the two mirror images.
pub(super) struct Placed {
    /// `P4`, in the frame of the base triangle with `P1` in the origin.
    pub(super) p4: Points,
    /// Columns: axes of the platform triangle's frame in that of the base triangle.
    pub(super) frame: [Points; 3],
    /// Squared height of `P4`; excludes zero where the radii are finite.
    pub(super) squared_height: Discs,
}

#[inline(always)]
fn cross(a: &Points, b: &Points) -> Points {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot(a: &Points, b: &Points) -> Discs {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Design and lengths, in cyclic order `s14 s24 s25 s35 s36 s16`; the platform triangle is `P4 P5 P6`.
pub(super) struct Data<'a> {
    pub(super) base: &'a Triangle,
    pub(super) platform: &'a Triangle,
    pub(super) s: &'a [Real; 6],
}

/// Corners as functions of `x` and `y` over discs: `P4` of `y` and `P5` of `x` alone, by square roots, `P6` of both.
struct Corners {
    p4: Points,
    p5: Points,
    p6: Points,
    squared_height: Discs,
    /// `P5 x P3`, `P3 x P4`, and one over `det(P3, P4, P5)`.
    from5: Points,
    from4: Points,
    inverse: Discs,
}

impl Data<'_> {
    /// The signs of both heights are those for which their product is `w`, proved where the radii stay finite.
    #[inline(always)]
    fn corners(&self, x: Discs, y: Discs) -> Corners {
        let (base, platform, s) = (self.base, self.platform, self.s);
        let half = |z: Real| z.scaled(0.5);
        let (along, up) = (reciprocal(base.len), reciprocal(base.v));
        let p4x = half(s[0] + base.bb - s[1]) * along;
        let p4y = (-y).halved().plus(half(s[0] + base.cc) - base.u * p4x).times(up);
        let p5x = x.plus(base.bb - s[2]).halved().times(along);
        let p5y = (x.plus(base.cc - s[3]).halved() - p5x.times(base.u)).times(up);
        let squared_height = Discs::real(s[0] - p4x * p4x) - p4y * p4y;
        let z4 = squared_height.sqrt();
        let z5 = (x - p5x * p5x - p5y * p5y).sqrt();
        let product = x.plus(s[0] - platform.bb).halved() - p5x.times(p4x) - p4y * p5y;
        let z5 = z5.with_product(z4, product);
        let p4 = [Discs::real(p4x), p4y, z4];
        let p5 = [p5x, p5y, z5];
        // P6 from its products with P3, P4, P5 (origin P1): three linear equations
        let k3 = half(s[5] + base.cc - s[4]);
        let k4 = half(s[5] + s[0] - platform.cc);
        let k5 = x.plus(s[5] - platform.opposite).halved();
        let normal = cross(&p4, &p5);
        let (u, v) = (base.u, base.v);
        // P3 = (u, v, 0)
        let from5 = [-p5[2].times(v), p5[2].times(u), p5[0].times(v) - p5[1].times(u)];
        let from4 = [p4[2].times(v), -p4[2].times(u), p4[1].times(u) - p4[0].times(v)];
        let inverse = (normal[0].times(u) + normal[1].times(v)).reciprocal();
        let mut p6 = [Discs::ZERO; 3];
        for k in 0..3 {
            p6[k] = (normal[k].times(k3) + from5[k].times(k4) + from4[k] * k5) * inverse;
        }
        Corners { p4, p5, p6, squared_height, from5, from4, inverse }
    }

    /// The pose over the discs, by the mean value theorem: corners at the centres, and derivatives over the discs times their radii.
    ///
    /// With `'` for the derivative by the one variable, `P4' = (0, -1/(2 v), p4y / (2 v z4))`, `P5' = (1/(2 len), (1 - u/len) / (2 v), ..)` with
    /// `2 z5 z5' = 1 - 2 p5x p5x' - 2 p5y p5y'`, and from `P6.P3 = k3`, `P6.P4 = k4`, `P6.P5 = k5`, `|P6|^2` not being used,
    /// `P6_x = (P3 x P4) (1/2 - P5'.P6) / det`, `P6_y = -(P5 x P3) (P4'.P6) / det`.
    #[inline(always)]
    pub(super) fn place(&self, x: Discs, y: Discs) -> Placed {
        let (base, t) = (self.base, self.platform);
        let wide = self.corners(x, y);
        let mut tight = self.corners(Discs::point(x.c), Discs::point(y.c));
        let (along, up) = (reciprocal(base.len), reciprocal(base.v));
        let half = Real::point(0.5);
        let by_y = Discs::real(-(half * up));
        let d4 = [by_y, -(wide.p4[1] * by_y) * wide.p4[2].reciprocal()];
        let (ax, ay) = (half * along, half * (Real::point(1.0) - base.u * along) * up);
        let rise = (-(wide.p5[0].times(ax) + wide.p5[1].times(ay))).plus(half);
        let d5 = [Discs::real(ax), Discs::real(ay), rise * wide.p5[2].reciprocal()];
        let along6 = (-dot(&d5, &wide.p6)).plus(half) * wide.inverse;
        let across6 = (d4[0] * wide.p6[1] + d4[1] * wide.p6[2]) * wide.inverse;
        let (rx, ry) = (x.r, y.r);
        for k in 0..2 {
            tight.p4[k + 1].widen(d4[k].magnitude() * ry);
        }
        for k in 0..3 {
            tight.p5[k].widen(d5[k].magnitude() * rx);
            let (sx, sy) = (wide.from4[k] * along6, wide.from5[k] * across6);
            tight.p6[k].widen(sx.magnitude() * rx + sy.magnitude() * ry);
        }
        let Corners { p4, p5, p6, .. } = tight;
        let (side, height) = (reciprocal(t.len), reciprocal(t.v));
        let (mut ax, mut ay) = ([Discs::ZERO; 3], [Discs::ZERO; 3]);
        for k in 0..3 {
            ax[k] = (p5[k] - p4[k]).times(side);
            ay[k] = (p6[k] - p4[k] - ax[k].times(t.u)).times(height);
        }
        let az = cross(&ax, &ay);
        Placed { p4, frame: [ax, ay, az], squared_height: wide.squared_height }
    }
}

/// The larger of both radii and moduli over some discs.
#[inline(always)]
pub(super) fn extremes(points: &[Points]) -> (Reals, Reals) {
    let (mut radius, mut modulus) = (Reals::ZERO, Reals::ZERO);
    for d in points.iter().flatten() {
        radius = radius.largest(d.r);
        modulus = modulus.largest(d.magnitude());
    }
    (radius, modulus)
}

/// Largest radius of a frame's entry for which the bounds hold.
const FRAME: f64 = 1.0 / 1024.0;

/// Bounds for both poses of each lane; NaN or infinite where nothing is known.
pub(super) struct Deviation {
    /// Of the entries of `R`.
    pub(super) rotation: Reals,
    /// Of the entries of `p / unit`.
    pub(super) position: Reals,
    /// The larger of both, each relative to the larger of 1 and the largest entry of its own kind.
    pub(super) relative: Reals,
    /// 1 where pose `2k` is the image with `P4` on the side where it was placed, -1 where it is the other.
    pub(super) first: Reals,
}

/// How far the poses are from the certified ones.
#[inline(always)]
pub(super) fn deviation(
    design: &OctahedralCertifier,
    placed: &Placed,
    poses: &[ComplexPose; 2 * PAIRS],
) -> Deviation {
    let (re, rg) = (design.base.axes_radius(), design.platform.axes_radius());
    let (rho, m) = extremes(&placed.frame);
    let (rho4, m4) = extremes(&[placed.p4]);
    let turn = (rho.times(3.0) + m.times(10.0 * (re + rg) + 40.0 * U)).up();
    let [a1, b4] = design.origins;
    let arm: f64 = b4.iter().map(|b| b.centre.abs()).sum();
    let far = a1.iter().fold(0.0_f64, |m, a| m.max(a.centre.abs()));
    let loose = [a1, b4].map(|corner| corner.iter().fold(0.0_f64, |m, x| m.max(x.radius)));
    let nominal = Nominal::of(design, placed);
    let first = first_image(design, placed, poses);
    let (mut worst, mut scale) = ([Reals::ZERO; 2], [Reals::all(1.0); 2]);
    let mut largest_entry = Reals::ZERO;
    for mirrored in [false, true] {
        let sign = first.times(if mirrored { -1.0 } else { 1.0 });
        for i in 0..3 {
            let mut p = nominal.corner[0][i] + signed(&nominal.corner[1][i], sign);
            for j in 0..3 {
                let r = nominal.even[i][j] + signed(&nominal.odd[i][j], sign);
                let given = gather(poses, mirrored, |pose| pose.rotation[(i, j)]);
                worst[0] = worst[0].largest(sizes(&(given - r)));
                (scale[0], largest_entry) = (scale[0].largest(parts(&r)), largest_entry.largest(sizes(&r)));
                p = p - r.times(b4[j].centre);
            }
            p = p.plus(a1[i].centre);
            let unit = design.unit.recip();
            let given = gather(poses, mirrored, |pose| pose.position[i] * unit);
            worst[1] = worst[1].largest(sizes(&(given - p)));
            scale[1] = scale[1].largest(parts(&p));
        }
    }
    let shift = rho4.times(2.0) + m4.times(3.0 * re) + turn.times(arm);
    let corners = (largest_entry + turn).times(3.0 * loose[1]).plus(loose[0]);
    let rounding = (m4.times(2.0) + largest_entry.times(arm)).plus(far).times(12.0 * U);
    let usable = if re <= FRAME && rg <= FRAME { 1.0 } else { f64::NAN };
    let rotation = (worst[0] + turn).up().times(usable);
    let position = (worst[1] + shift + rounding + corners).up().times(usable);
    let relative = rotation.zip(scale[0], |b, s| b / s).largest(position.zip(scale[1], |b, s| b / s)).up();
    Deviation { rotation, position, relative, first }
}

/// [`Deviation::first`].
#[inline(always)]
fn first_image(design: &OctahedralCertifier, placed: &Placed, poses: &[ComplexPose; 2 * PAIRS]) -> Reals {
    let ([a1, b4], normal) = (design.origins, design.base.axes[2]);
    let mut height = ComplexBatch::ZERO;
    let unit = design.unit.recip();
    for i in 0..3 {
        let mut corner = gather(poses, false, |pose| pose.position[i] * unit).plus(-a1[i].centre);
        for j in 0..3 {
            corner = corner + gather(poses, false, |pose| pose.rotation[(i, j)]).times(b4[j].centre);
        }
        height = height + corner.times(normal[i].centre);
    }
    let z = &placed.p4[2].c;
    let (near, far) = ((height - *z).norm_sqr(), (height + *z).norm_sqr());
    Reals(near).zip(Reals(far), |n, f| if n <= f { 1.0 } else { -1.0 })
}

#[inline(always)]
fn signed(z: &ComplexBatch, sign: Reals) -> ComplexBatch {
    let mut out = *z;
    for k in 0..LANES {
        (out.re[k], out.im[k]) = (sign.0[k] * z.re[k], sign.0[k] * z.im[k]);
    }
    out
}

#[inline(always)]
fn gather(
    poses: &[ComplexPose; 2 * PAIRS],
    mirrored: bool,
    entry: impl Fn(&ComplexPose) -> num_complex::Complex64,
) -> ComplexBatch {
    let mut out = ComplexBatch::ZERO;
    for k in 0..LANES {
        let z = entry(&poses[2 * k + usize::from(mirrored)]);
        (out.re[k], out.im[k]) = (z.re, z.im);
    }
    out
}

/// Midpoints of `E^T F_e G`, `E^T F_o G` and of both parts of `E^T c4`.
struct Nominal {
    even: [[ComplexBatch; 3]; 3],
    odd: [[ComplexBatch; 3]; 3],
    corner: [[ComplexBatch; 3]; 2],
}

impl Nominal {
    #[inline(always)]
    fn of(design: &OctahedralCertifier, placed: &Placed) -> Self {
        let (e, g) = (&design.base.axes, &design.platform.axes);
        let f = &placed.frame;
        let zero = [[ComplexBatch::ZERO; 3]; 3];
        let mut out = Self { even: zero, odd: zero, corner: [[ComplexBatch::ZERO; 3]; 2] };
        for i in 0..3 {
            // row i of E^T F, split: rows 0 and 1 of F, row 2 of F
            let (mut even, mut odd) = ([ComplexBatch::ZERO; 3], [ComplexBatch::ZERO; 3]);
            for j in 0..3 {
                let plane = f[j][0].c.times(e[0][i].centre) + f[j][1].c.times(e[1][i].centre);
                let normal = f[j][2].c.times(e[2][i].centre);
                (even[j], odd[j]) = if j < 2 { (plane, normal) } else { (normal, plane) };
            }
            for j in 0..3 {
                let g = [g[0][j].centre, g[1][j].centre, g[2][j].centre];
                out.even[i][j] = even[0].times(g[0]) + even[1].times(g[1]) + even[2].times(g[2]);
                out.odd[i][j] = odd[0].times(g[0]) + odd[1].times(g[1]) + odd[2].times(g[2]);
            }
            let p4 = &placed.p4;
            out.corner[0][i] = p4[0].c.times(e[0][i].centre) + p4[1].c.times(e[1][i].centre);
            out.corner[1][i] = p4[2].c.times(e[2][i].centre);
        }
        out
    }
}
