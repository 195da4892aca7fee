//! The poses from enclosed corners, and the distances of given poses from these.
//!
//! **Poses.** `R = E^T F G`: rows of `E`, `G` are the frames of base and platform triangle, `F` is enclosed. The mirror
//! in the base plane changes the sign of the third coordinates of the corners. The third axis is a cross product, so
//! that `F` becomes `D F D`, `D = diag(1, 1, -1)`. Let `F = F_e + F_o`, the part that keeps its signs and the part that
//! changes them. Then `R = E^T F_e G +- E^T F_o G`, and `p = P1 + E^T c4 - R b4`.
//!
//! **Bounds.** `E`, `G` are orthogonal and known up to `r_E`, `r_G <= 2^-10` an entry; entries of `F` up to `rho`,
//! their moduli at most `M`. Entries are at most the spectral norm, and that is at most three times the largest entry:
//!
//! * `|E'^T F' G' - E^T F G| <= 3 rho + 9 M (r_E + r_G) (1 + 3 r_G)`;
//! * rounding: each term passes 7 roundings, column sums of `|E|`, `|G|` are at most `sqrt 3 (1 + 2^-8)`, two parts:
//!   below `40 u M`;
//! * `p`: `2 rho_4 + 3 r_E M_4 + (bound of R) |b4|_1`, rounding `12 u (|a1| + 2 M_4 + M_R |b4|_1)`, and where the
//!   corners `a1`, `b4` are known within radii `r_a`, `r_b` a coordinate `r_a + 3 r_b (M_R + bound of R)`.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::arithmetic::{Discs, Reals, parts, reciprocal, sizes};
use super::circles::{CornerCircle, OnCircle, ZeroDiscs};
use super::{OctahedralCertifier, PAIRS, U};
use num::ball::Real;
use num::batch::{ComplexBatch, LANES};
use platform::geom::ComplexPose;

pub(super) type Points = [Discs; 3];

/// One of the two mirror images.
pub(super) struct MirrorPose {
    /// `P4`, in the frame of the base triangle with `P1` in the origin.
    pub(super) p4: Points,
    /// Columns: axes of the platform triangle's frame in that of the base triangle.
    pub(super) frame: [Points; 3],
}

#[inline(always)]
fn cross(a: &Points, b: &Points) -> Points {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The pose of the zero. It is the pose of the corners at the centre, with derivatives by the three `t` times the
/// radius, and a bound of the rest.
///
/// The axes of the platform triangle are `x = (P5 - P4) / L`, `y = (P6 - P4 - U x) / H` and `x cross y`. Far out the
/// corners are nearly isotropic vectors, nearly parallel to each other. Cross products are then much smaller than their
/// factors, and a disc for each factor would be too wide.
///
/// With `|exp(t) - 1 - t| <= |t|^2` for `|t| <= 1` a coordinate of a corner is within `(|u| + |v|) r^2` of its linear
/// part. Let `x = x0 + dx + ex`, and `y` likewise. The product is then `x0 cross y0 + (dx cross y0 + x0 cross dy)`,
/// coordinate by coordinate, up to twice `(|dx| + |ex|) (|dy| + |ey|) + |x0| |ey| + |ex| |y0|`.
#[inline(always)]
pub(super) fn place(
    design: &OctahedralCertifier,
    circles: &[CornerCircle; 3],
    zeros: &ZeroDiscs,
) -> MirrorPose {
    let t = &design.platform;
    let (mut corners, mut moves) = ([[Discs::ZERO; 3]; 3], [[ComplexBatch::ZERO; 3]; 3]);
    for k in 0..3 {
        let ([h, z], [dh, dz]) = (zeros.corners[k], zeros.directions[k]);
        let (m, a) = (&circles[k].middle, &design.sides.across[k]);
        corners[k] = [h.times(a[0]).plus(m[0]), h.times(a[1]).plus(m[1]), z];
        moves[k] = [dh.times(a[0].centre), dh.times(a[1].centre), dz];
    }
    let [mut p4, p5, p6] = corners;
    let (side, height) = (reciprocal(t.len), reciprocal(t.v));
    let (mut ax, mut ay) = ([Discs::ZERO; 3], [Discs::ZERO; 3]);
    for k in 0..3 {
        ax[k] = (p5[k] - p4[k]).times(side);
        ay[k] = (p6[k] - p4[k] - ax[k].times(t.u)).times(height);
    }
    let mut az = cross(&ax, &ay);
    // derivatives of x and y by the t of each corner are these times its own
    let (l, h, part) = (side.centre, height.centre, t.u.centre * side.centre);
    let by_x = [-l, l, 0.0];
    let by_y = [(part - 1.0) * h, -part * h, h];
    let r = zeros.radius;
    let (mut dx, mut dy, mut dz) = ([Reals::ZERO; 3], [Reals::ZERO; 3], [Reals::ZERO; 3]);
    let (mut rest_x, mut rest_y) = (Reals::ZERO, Reals::ZERO);
    for k in 0..3 {
        // d (x cross y) = m cross (by_x y - by_y x) for a move m of the corner
        let mut other = [ComplexBatch::ZERO; 3];
        for i in 0..3 {
            other[i] = ay[i].c.times(by_x[k]) - ax[i].c.times(by_y[k]);
        }
        let m = &moves[k];
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            let size = sizes(&m[i]);
            dx[i] = dx[i] + size.times(by_x[k].abs());
            dy[i] = dy[i] + size.times(by_y[k].abs());
            dz[i] = dz[i] + sizes(&(m[j] * other[l] - m[l] * other[j]));
        }
        let square = zeros.sizes[k] * r * r;
        rest_x = rest_x + square.times(by_x[k].abs());
        rest_y = rest_y + square.times(by_y[k].abs());
    }
    let largest = |d: &[Reals; 3]| (d[0].largest(d[1]).largest(d[2]) * r).up();
    let (move_x, move_y) = (largest(&dx), largest(&dy));
    let ((blur_x, size_x), (blur_y, size_y)) = (extremes(&[ax]), extremes(&[ay]));
    // of the derivatives: rounding, and the uncertainty of the coefficients
    let loose = |x: Real| x.radius / x.centre.abs();
    let across = design.sides.across.iter().flatten().fold(0.0, |m: f64, x| m.max(x.radius));
    let unknown = 64.0 * U + 4.0 * (loose(side) + loose(height) + t.u.radius * side.centre + across);
    let first = (move_x * size_y + size_x * move_y).times(4.0 * unknown);
    let second = ((move_x + rest_x) * (move_y + rest_y) + size_x * rest_y + rest_x * size_y)
        .times(2.0 * (1.0 + unknown));
    let mixed = (move_x * blur_y + blur_x * move_y).times(2.0);
    let rest_z = (first + second + mixed).up();
    let grow = |r: Reals| (r + r.times(4.0 * unknown)).up();
    for k in 0..3 {
        ax[k].widen(grow(dx[k] * r + rest_x) + move_x.times(4.0 * unknown));
        ay[k].widen(grow(dy[k] * r + rest_y) + move_y.times(4.0 * unknown));
        az[k].widen(grow(dz[k] * r) + rest_z);
        p4[k].widen(
            grow(sizes(&moves[0][k]) * r + zeros.sizes[0] * r * r) + (zeros.sizes[0] * r).times(unknown),
        );
    }
    MirrorPose { p4, frame: [ax, ay, az] }
}

/// `(h, z)` of the corners of poses `2k`.
#[inline(always)]
pub(super) fn corners_of(
    design: &OctahedralCertifier,
    circles: &[CornerCircle; 3],
    given: &GivenPoses,
) -> [OnCircle; 3] {
    let axes = &design.base.axes;
    let r = &given.rotation[0];
    let mut out = [[ComplexBatch::ZERO; 2]; 3];
    for k in 0..3 {
        let b = &design.corners[k];
        let mut d = [ComplexBatch::ZERO; 3];
        for i in 0..3 {
            let p = given.position[0][i].plus(-design.origins[0][i].centre);
            d[i] = p + r[i][0].times(b[0].centre) + r[i][1].times(b[1].centre) + r[i][2].times(b[2].centre);
        }
        let mut along = [ComplexBatch::ZERO; 3];
        for j in 0..3 {
            let e = &axes[j];
            along[j] = d[0].times(e[0].centre) + d[1].times(e[1].centre) + d[2].times(e[2].centre);
        }
        let (m, a) = (&circles[k].middle, &design.sides.across[k]);
        let (x, y) = (along[0].plus(-m[0].centre), along[1].plus(-m[1].centre));
        out[k] = [x.times(a[0].centre) + y.times(a[1].centre), along[2]];
    }
    out
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
    /// Bound for the entries of `R`.
    pub(super) rotation: Reals,
    /// Bound for the entries of `p / unit`.
    pub(super) position: Reals,
    /// The larger of both, each relative to the larger of 1 and the largest entry of its own kind.
    pub(super) relative: Reals,
}

/// Bounds of the distances of the poses from the certified ones.
#[inline(always)]
pub(super) fn deviation(design: &OctahedralCertifier, placed: &MirrorPose, given: &GivenPoses) -> Deviation {
    let (re, rg) = (design.base.axes_radius(), design.platform.axes_radius());
    let (rho, m) = extremes(&placed.frame);
    let (rho4, m4) = extremes(&[placed.p4]);
    let turn = (rho.times(3.0) + m.times(10.0 * (re + rg) + 40.0 * U)).up();
    let [a1, b4] = design.origins;
    let arm: f64 = b4.iter().map(|b| b.centre.abs()).sum();
    let far = a1.iter().fold(0.0_f64, |m, a| m.max(a.centre.abs()));
    let loose = [a1, b4].map(|corner| corner.iter().fold(0.0_f64, |m, x| m.max(x.radius)));
    let nominal = Nominal::of(design, placed);
    let (mut worst, mut scale) = ([Reals::ZERO; 2], [Reals::all(1.0); 2]);
    let mut largest_entry = Reals::ZERO;
    for (image, sign) in [1.0, -1.0].into_iter().enumerate() {
        for i in 0..3 {
            let mut p = nominal.corner[0][i] + nominal.corner[1][i].times(sign);
            for j in 0..3 {
                let r = nominal.even[i][j] + nominal.odd[i][j].times(sign);
                worst[0] = worst[0].largest(sizes(&(given.rotation[image][i][j] - r)));
                (scale[0], largest_entry) = (scale[0].largest(parts(&r)), largest_entry.largest(sizes(&r)));
                p = p - r.times(b4[j].centre);
            }
            p = p.plus(a1[i].centre);
            worst[1] = worst[1].largest(sizes(&(given.position[image][i] - p)));
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
    Deviation { rotation, position, relative }
}

/// Given poses side by side, `2k` and `2k + 1`.
pub(super) struct GivenPoses {
    rotation: [[[ComplexBatch; 3]; 3]; 2],
    /// Over the unit.
    position: [[ComplexBatch; 3]; 2],
}

impl GivenPoses {
    #[inline(always)]
    pub(super) fn of(poses: &[ComplexPose; 2 * PAIRS], unit: f64) -> Self {
        let mut out =
            Self { rotation: [[[ComplexBatch::ZERO; 3]; 3]; 2], position: [[ComplexBatch::ZERO; 3]; 2] };
        let over = unit.recip();
        for k in 0..LANES {
            for image in 0..2 {
                let pose = &poses[2 * k + image];
                for i in 0..3 {
                    for j in 0..3 {
                        let (z, to) = (pose.rotation[(i, j)], &mut out.rotation[image][i][j]);
                        (to.re[k], to.im[k]) = (z.re, z.im);
                    }
                    let (z, to) = (pose.position[i], &mut out.position[image][i]);
                    (to.re[k], to.im[k]) = (z.re * over, z.im * over);
                }
            }
        }
        out
    }
}

/// Midpoints of `E^T F_e G`, `E^T F_o G` and of both parts of `E^T c4`.
struct Nominal {
    even: [[ComplexBatch; 3]; 3],
    odd: [[ComplexBatch; 3]; 3],
    corner: [[ComplexBatch; 3]; 2],
}

impl Nominal {
    #[inline(always)]
    fn of(design: &OctahedralCertifier, placed: &MirrorPose) -> Self {
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
