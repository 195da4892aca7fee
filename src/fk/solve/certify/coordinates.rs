//! From poses and dual quaternions to Study coordinates, and from a point or ball of these back to `R` and `p`.
//!
//! `R = X(e) / (e.e)` loses `log10(|e|^2 / |e.e|)` digits in double, and `p e = g` as many on the way back. Far out,
//! where `e.e` is small, a pose is therefore made from a point in double-double.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;

use super::certificate::{PoseEnclosure, WhyUncertified};
use super::krawczyk::largest;
use super::system::Study;
use num::ball::WideDisc;
use num::ball::{Disc, UP};
use num::double_double::{ComplexDoubleDouble, DoubleDouble};
use num::octuple::{ComplexOctuple, Octuple};
use num::vector::RingNumber;
use platform::geom::ComplexPose;

/// Below this `|e.e| / |e|^2` a pose is computed in double-double.
const FAR: f64 = 1.0 / 16.0;

/// `4 e e^T / N` of a rotation matrix, column `k` (Shepperd 1978).
fn quaternion_column(r: &nalgebra::Matrix3<Complex64>, k: usize) -> [Complex64; 4] {
    let one = Complex64::new(1.0, 0.0);
    let (w, x) = (one + r[(0, 0)], one - r[(0, 0)]);
    let (sum, gap) = (r[(1, 1)] + r[(2, 2)], r[(1, 1)] - r[(2, 2)]);
    let (wx, wy, wz) = (r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let (xy, xz, yz) = (r[(0, 1)] + r[(1, 0)], r[(0, 2)] + r[(2, 0)], r[(1, 2)] + r[(2, 1)]);
    match k {
        0 => [w + sum, wx, wy, wz],
        1 => [wx, w - sum, xy, xz],
        2 => [wy, xy, x + gap, yz],
        _ => [wz, xz, yz, x - gap],
    }
}

/// Study coordinates of a pose on the patch of its largest `|e_k|` (the first of equals), lengths divided by `unit`.
///
/// Real poses have real coordinates. Nothing here needs error bounds: the result is the point the proof is about.
pub(super) fn study_of(pose: &ComplexPose, unit: f64) -> Result<Study<f64>, WhyUncertified> {
    let (r, p) = (&pose.rotation, pose.position / Complex64::new(unit, 0.0));
    if !r.iter().chain(p.iter()).all(|z| z.is_finite()) {
        return Err(WhyUncertified::NotFinite);
    }
    let diagonal: [f64; 4] = std::array::from_fn(|k| quaternion_column(r, k)[k].norm_sqr());
    let patch = (1..4).fold(0, |best, k| if diagonal[k] > diagonal[best] { k } else { best });
    let column = quaternion_column(r, patch);
    let mut e: [Complex64; 4] = column.map(|z| z / column[patch]);
    e[patch] = Complex64::new(1.0, 0.0);
    let g = [
        -(p.x * e[1] + p.y * e[2] + p.z * e[3]),
        p.x * e[0] + p.y * e[3] - p.z * e[2],
        p.y * e[0] + p.z * e[1] - p.x * e[3],
        p.z * e[0] + p.x * e[2] - p.y * e[1],
    ];
    if !e.iter().all(|z| z.norm_sqr() < 2f64.powi(60)) {
        return Err(WhyUncertified::NotARotation { distance: f64::INFINITY });
    }
    // moduli below 2^30 keep every product of the evaluation far below 2^100
    if !g.iter().all(|z| z.norm_sqr() < 2f64.powi(60)) {
        return Err(WhyUncertified::OutOfRange);
    }
    let z: [Complex64; 8] = std::array::from_fn(|j| if j < 4 { e[j] } else { g[j - 4] });
    Ok(Study { re: z.map(|z| z.re), im: z.map(|z| z.im), patch })
}

/// `(e, g)` of a pose, any scale; `None` for numbers out of range.
pub fn dual_quaternion(pose: &ComplexPose) -> Option<[Complex64; 8]> {
    let x = study_of(pose, 1.0).ok()?;
    Some(std::array::from_fn(|k| Complex64::new(x.re[k], x.im[k])))
}

/// `x = (e, g)` on the patch of its largest `|e_k|`, lengths divided by `unit`.
pub(super) fn study_at(x: &[Complex64; 8], unit: f64) -> Result<Study<f64>, WhyUncertified> {
    let size = |k: &usize| x[*k].norm_sqr();
    let patch = (1..4).fold(0, |best, k| if size(&k) > size(&best) { k } else { best });
    let inverse = x[patch].inv();
    let mut z: [Complex64; 8] = std::array::from_fn(|j| x[j] * if j < 4 { inverse } else { inverse / unit });
    z[patch] = Complex64::ONE;
    if !z.iter().all(|z| z.is_finite()) {
        return Err(WhyUncertified::NotFinite);
    }
    // as for poses: moduli below 2^30 keep every product of the evaluation far below 2^100
    if !z.iter().all(|z| z.norm_sqr() < 2f64.powi(60)) {
        return Err(WhyUncertified::OutOfRange);
    }
    Ok(Study { re: z.map(|z| z.re), im: z.map(|z| z.im), patch })
}

/// Numerators of `R` (row by row) and `p` over `N = e.e`, and `N`, for anything with ring operations.
#[inline(always)]
pub(super) fn pose_numerators<T: RingNumber>(x: &[T; 8]) -> ([T; 9], [T; 3], T) {
    let [w, x1, x2, x3, g0, g1, g2, g3] = *x;
    let (ww, xx, yy, zz) = (w * w, x1 * x1, x2 * x2, x3 * x3);
    let twice = |a: T| a + a;
    let (wx, wy, wz) = (w * x1, w * x2, w * x3);
    let (xy, xz, yz) = (x1 * x2, x1 * x3, x2 * x3);
    let r = [
        (ww + xx) - (yy + zz),
        twice(xy - wz),
        twice(xz + wy),
        twice(xy + wz),
        (ww - xx) + (yy - zz),
        twice(yz - wx),
        twice(xz - wy),
        twice(yz + wx),
        (ww - xx) - (yy - zz),
    ];
    let p = [
        (w * g1 - g0 * x1) + (x2 * g3 - x3 * g2),
        (w * g2 - g0 * x2) + (x3 * g1 - x1 * g3),
        (w * g3 - g0 * x3) + (x1 * g2 - x2 * g1),
    ];
    (r, p, (ww + xx) + (yy + zz))
}

/// Encloses `R` and `p` (times `unit`) over the ball of `radius` about `centre`; `None` when `e.e` may vanish.
pub(super) fn enclose_pose(
    centre: &[Complex64; 8],
    patch: usize,
    radius: f64,
    unit: f64,
) -> Option<PoseEnclosure> {
    let x: [Disc; 8] =
        std::array::from_fn(|j| Disc { centre: centre[j], radius: if j == patch { 0.0 } else { radius } });
    let (r, p, n) = pose_numerators(&x);
    let inverse = n.reciprocal()?;
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| r[3 * i + j] * inverse));
    Some(PoseEnclosure { rotation, position: p.map(|z| (z * inverse).scaled(unit)) })
}

/// [`enclose_pose`] over the ball about `centre + low`, in double-double: where `e.e` is small or `g` large, rounding
/// in double would cost all digits.
pub(super) fn enclose_pose_widely(
    centre: &[Complex64; 8],
    low: &[Complex64; 8],
    patch: usize,
    radius: f64,
    unit: f64,
) -> Option<PoseEnclosure> {
    let x: [WideDisc; 8] =
        std::array::from_fn(|j| WideDisc::about(centre[j], low[j], if j == patch { 0.0 } else { radius }));
    let (r, p, n) = pose_numerators(&x);
    let inverse = n.reciprocal()?;
    let entry = |z: WideDisc| (z * inverse).rounded();
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| entry(r[3 * i + j])));
    Some(PoseEnclosure { rotation, position: p.map(|z| entry(z).scaled(unit)) })
}

/// `R` and `p` in double-double.
pub(super) fn pose_of(
    x: &Study<DoubleDouble>,
    unit: f64,
) -> ([[ComplexDoubleDouble; 3]; 3], [ComplexDoubleDouble; 3]) {
    let z: [ComplexDoubleDouble; 8] =
        std::array::from_fn(|j| ComplexDoubleDouble { re: x.re[j], im: x.im[j] });
    let (r, p, n) = pose_numerators(&z);
    (std::array::from_fn(|i| std::array::from_fn(|j| r[3 * i + j] / n)), p.map(|z| (z / n).scaled(unit)))
}

/// The pose of a point in doubles, `None` where `e.e` is too small for them.
pub(super) fn pose_in_double(x: &[Complex64; 8], unit: f64) -> Option<ComplexPose> {
    let (r, p, n) = pose_numerators(x);
    let size: f64 = x[..4].iter().map(Complex64::norm_sqr).sum();
    let inverse = n.inv();
    (n.norm_sqr() > FAR * FAR * size * size).then(|| ComplexPose {
        rotation: nalgebra::Matrix3::from_fn(|i, j| r[3 * i + j] * inverse),
        position: nalgebra::Vector3::from_fn(|i, _| p[i] * inverse * unit),
    })
}

/// The pose of a point in double-double, rounded.
pub(super) fn rounded_pose(x: &Study<DoubleDouble>, unit: f64) -> ComplexPose {
    let (rotation, position) = pose_of(x, unit);
    ComplexPose {
        rotation: nalgebra::Matrix3::from_fn(|i, j| rotation[i][j].hi()),
        position: nalgebra::Vector3::from_fn(|i, _| position[i].hi()),
    }
}

/// The point of many digits on the patch of its largest `|e_k|`, with `g` divided by a power of two.
pub(super) struct PrecisePoint {
    x: [ComplexOctuple; 8],
    patch: usize,
}

impl PrecisePoint {
    pub(super) fn of(x: &[ComplexOctuple; 8]) -> Self {
        let size = |k: usize| x[k].norm_sqr().rounded();
        let patch = (1..4).fold(0, |best, k| if size(k) > size(best) { k } else { best });
        let inverse = x[patch].recip();
        Self { x: x.map(|z| z * inverse), patch }
    }

    /// The binary exponent of the largest `|g_k|`.
    pub(super) fn exponent(&self) -> i32 {
        self.x[4..].iter().map(ComplexOctuple::exponent).max().unwrap_or(0)
    }

    /// Study coordinates with `g` divided by `2^exponent`; digits beyond double-double are dropped.
    pub(super) fn study(&self, exponent: i32) -> Study<DoubleDouble> {
        let both =
            |z: Octuple| DoubleDouble::from_sum(z.rounded(), (z - Octuple::from(z.rounded())).rounded());
        let in_unit = |k: usize| if k < 4 { self.x[k] } else { self.x[k].scaled(-exponent) };
        let mut study = Study {
            re: std::array::from_fn(|k| both(in_unit(k).re)),
            im: std::array::from_fn(|k| both(in_unit(k).im)),
            patch: self.patch,
        };
        (study.re[self.patch], study.im[self.patch]) = (DoubleDouble::ONE, DoubleDouble::ZERO);
        study
    }
}

/// Largest distance of a rotation entry of the pose from the enclosure's centre, relative to the larger of 1 and
/// the largest entry.
pub(super) fn rotation_distance(pose: &ComplexPose, enclosure: &PoseEnclosure) -> f64 {
    let discs = enclosure.rotation.as_flattened();
    let gap = |k: usize| (discs[k].centre - pose.rotation[(k / 3, k % 3)]).norm();
    (0..9).map(gap).fold(0.0, f64::max) / discs.iter().map(|d| d.centre.norm()).fold(1.0, f64::max)
}

/// Bound of the distance of the pose from the root. It is the largest distance of an entry from a point of its disc, or
/// with `middles` from the middle of it. For `R` it is relative to the larger of 1 and the largest entry. For `p` it is
/// relative to the larger of `unit` and the largest entry. NaN when nothing is known.
pub(super) fn deviation(pose: &ComplexPose, enclosure: &PoseEnclosure, unit: f64, middles: bool) -> f64 {
    let part = |entries: &[Complex64], discs: &[Disc], least: f64| {
        let (mut gap, mut scale) = (0.0, least);
        for (z, d) in entries.iter().zip(discs) {
            let radius = if middles { 0.0 } else { d.radius };
            gap = largest(gap, ((d.centre - z).norm() + radius) * UP);
            scale = largest(scale, z.norm());
        }
        gap / (scale * (2.0 - UP))
    };
    let rows: [Complex64; 9] = std::array::from_fn(|k| pose.rotation[(k / 3, k % 3)]);
    let rotation = part(&rows, enclosure.rotation.as_flattened(), 1.0);
    largest(rotation, part(pose.position.as_slice(), &enclosure.position, unit)) * UP
}
