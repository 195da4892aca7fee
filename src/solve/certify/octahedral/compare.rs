//! How far given poses are from the certified ones.
//!
//! `R = E^T F G`: rows of `E`, `G` are the frames of base and platform triangle, `F` is enclosed. Mirrored in the base plane the third
//! coordinates of the corners change sign; the third axis is a cross product, so that `F` becomes `D F D`, `D = diag(1, 1, -1)`. With
//! `F = F_e + F_o`, the part that keeps its signs and the part that changes them, `R = E^T F_e G +- E^T F_o G`. And `p = P1 + E^T c4 - R b4`.
//!
//! **Bounds.** `E`, `G` are orthogonal and known up to `r_E`, `r_G <= 2^-10` an entry; entries of `F` up to `rho`, their moduli at most `M`.
//! Entries are at most the spectral norm, and that is at most three times the largest entry:
//!
//! * `|E'^T F' G' - E^T F G| <= 3 rho + 9 M (r_E + r_G) (1 + 3 r_G)`;
//! * rounding: each term passes 7 roundings, column sums of `|E|`, `|G|` are at most `sqrt 3 (1 + 2^-8)`, two parts: below `40 u M`;
//! * `p`: `2 rho_4 + 3 r_E M_4 + (bound of R) |b4|_1`, rounding `12 u (|a1| + 2 M_4 + M_R |b4|_1)`.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::corners::{Placed, extremes};
use super::lanes::{Reals, parts, sizes};
use super::{OctahedralCertifier, PAIRS, U};
use crate::geom::ComplexPose;
use crate::num::batch::{Batch, LANES};

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
    let arm: f64 = b4.iter().map(|b| b.abs()).sum();
    let far = a1.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
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
                p = p - r.times(b4[j]);
            }
            p = p.plus(a1[i]);
            let unit = design.unit.recip();
            let given = gather(poses, mirrored, |pose| pose.position[i] * unit);
            worst[1] = worst[1].largest(sizes(&(given - p)));
            scale[1] = scale[1].largest(parts(&p));
        }
    }
    let shift = rho4.times(2.0) + m4.times(3.0 * re) + turn.times(arm);
    let rounding = (m4.times(2.0) + largest_entry.times(arm)).plus(far).times(12.0 * U);
    let usable = if re <= FRAME && rg <= FRAME { 1.0 } else { f64::NAN };
    let rotation = (worst[0] + turn).up().times(usable);
    let position = (worst[1] + shift + rounding).up().times(usable);
    let relative = rotation.zip(scale[0], |b, s| b / s).largest(position.zip(scale[1], |b, s| b / s)).up();
    Deviation { rotation, position, relative, first }
}

/// [`Deviation::first`].
#[inline(always)]
fn first_image(design: &OctahedralCertifier, placed: &Placed, poses: &[ComplexPose; 2 * PAIRS]) -> Reals {
    let ([a1, b4], normal) = (design.origins, design.base.axes[2]);
    let mut height = Batch::ZERO;
    let unit = design.unit.recip();
    for i in 0..3 {
        let mut corner = gather(poses, false, |pose| pose.position[i] * unit).plus(-a1[i]);
        for j in 0..3 {
            corner = corner + gather(poses, false, |pose| pose.rotation[(i, j)]).times(b4[j]);
        }
        height = height + corner.times(normal[i].c);
    }
    let z = &placed.p4[2].c;
    let (near, far) = ((height - *z).norm_sqr(), (height + *z).norm_sqr());
    Reals(near).zip(Reals(far), |n, f| if n <= f { 1.0 } else { -1.0 })
}

#[inline(always)]
fn signed(z: &Batch, sign: Reals) -> Batch {
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
) -> Batch {
    let mut out = Batch::ZERO;
    for k in 0..LANES {
        let z = entry(&poses[2 * k + usize::from(mirrored)]);
        (out.re[k], out.im[k]) = (z.re, z.im);
    }
    out
}

/// Midpoints of `E^T F_e G`, `E^T F_o G` and of both parts of `E^T c4`.
struct Nominal {
    even: [[Batch; 3]; 3],
    odd: [[Batch; 3]; 3],
    corner: [[Batch; 3]; 2],
}

impl Nominal {
    #[inline(always)]
    fn of(design: &OctahedralCertifier, placed: &Placed) -> Self {
        let (e, g) = (&design.base.axes, &design.platform.axes);
        let f = &placed.frame;
        let zero = [[Batch::ZERO; 3]; 3];
        let mut out = Self { even: zero, odd: zero, corner: [[Batch::ZERO; 3]; 2] };
        for i in 0..3 {
            // row i of E^T F, split: rows 0 and 1 of F, row 2 of F
            let (mut even, mut odd) = ([Batch::ZERO; 3], [Batch::ZERO; 3]);
            for j in 0..3 {
                let plane = f[j][0].c.times(e[0][i].c) + f[j][1].c.times(e[1][i].c);
                let normal = f[j][2].c.times(e[2][i].c);
                (even[j], odd[j]) = if j < 2 { (plane, normal) } else { (normal, plane) };
            }
            for j in 0..3 {
                let g = [g[0][j].c, g[1][j].c, g[2][j].c];
                out.even[i][j] = even[0].times(g[0]) + even[1].times(g[1]) + even[2].times(g[2]);
                out.odd[i][j] = odd[0].times(g[0]) + odd[1].times(g[1]) + odd[2].times(g[2]);
            }
            let p4 = &placed.p4;
            out.corner[0][i] = p4[0].c.times(e[0][i].c) + p4[1].c.times(e[1][i].c);
            out.corner[1][i] = p4[2].c.times(e[2][i].c);
        }
        out
    }
}
