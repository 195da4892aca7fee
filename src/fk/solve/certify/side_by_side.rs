//! Certificates of eight points at once, in doubles. The theorem and the bounds are those of `krawczyk.rs`, with the
//! numbers of eight points side by side in vector units.
//!
//! Sums have the terms given in the `system` and `krawczyk` modules, each with at most the roundings counted there.
//! Their grouping does not matter to those bounds. The approximate inverse is made without exchanges of rows. A small
//! pivot makes it bad, and the bound of `I - Y J` shows it. A lane without a proof says nothing about its point, which
//! then goes to the general method with more digits.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;
use pulp::Simd;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::NEAR;
use super::certificate::{CentrePrecision, Certificate, CertifiedPose, PoseEnclosure};
use super::coordinates::pose_numerators;
use super::krawczyk::{Centre, KrawczykBounds, holds_one_root};
use super::octahedral::arithmetic::{Discs, Reals, parts, sizes};
use super::second_order::{COEFFICIENTS, PAIRS};
use super::system::{LegSystem, N, Study, U};
use num::ball::{Disc, TINY, UP};
use num::batch::{ComplexBatch, LANES};
use platform::geom::ComplexPose;

/// `|e.e| / |e|^2` below which doubles are not enough for `R` and `p`: as for one point.
const FAR: f64 = 1.0 / 16.0;

/// Points of one problem, one a lane, at most [`LANES`]; lanes beyond them repeat the last.
pub(super) struct EightPoints<'a> {
    pub(super) system: &'a LegSystem,
    pub(super) points: &'a [Study<f64>],
    /// Receives the root that is proved near each point, with its pose.
    pub(super) out: &'a mut Vec<Option<CertifiedPose>>,
}

impl pulp::WithSimd for EightPoints<'_> {
    /// The lanes of which one root is proved, but not where its `R` and `p` are.
    type Output = [bool; LANES];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [bool; LANES] {
        certify(simd, self.system, self.points, self.out)
    }
}

/// The bounds of the theorem, eight times.
struct EightBounds {
    eta_centre: Reals,
    eta: Reals,
    kappa: Reals,
    beta: Reals,
    /// Row by row of the approximate inverse.
    step: [ComplexBatch; N],
}

/// Moduli that bounds of products take: at least `|e_j|`, `|g_j|`, the sum of `|e_j|^2`.
struct Magnitudes {
    e: Reals,
    g: Reals,
    p: Reals,
}

type Rows = [[ComplexBatch; N]; N];

#[inline(always)]
fn larger(a: Reals, b: Reals) -> Reals {
    a.zip(b, |x, y| if x >= y { x } else { y })
}

#[inline(always)]
fn square_moduli(z: &[ComplexBatch]) -> Reals {
    let mut sum = Reals::ZERO;
    for z in z {
        sum = sum + Reals(z.norm_sqr());
    }
    sum
}

#[inline(always)]
fn magnitudes(x: &[ComplexBatch; 8]) -> Magnitudes {
    let (mut e, mut g) = (sizes(&x[0]), sizes(&x[4]));
    for j in 1..4 {
        e = larger(e, sizes(&x[j]));
        g = larger(g, sizes(&x[4 + j]));
    }
    Magnitudes { e: e.times(UP), g: g.times(UP), p: square_moduli(&x[..4]).times(UP) }
}

/// `a z_0 + b z_1 + c z_2`, real coefficients.
#[inline(always)]
fn combined(k: [f64; 3], z: [ComplexBatch; 3]) -> ComplexBatch {
    z[0].times(k[0]) + z[1].times(k[1]) + z[2].times(k[2])
}

/// One where the lane's patch is another coordinate than `j`, else zero.
#[inline(always)]
fn off_patch(patch: &[usize; LANES], j: usize) -> Reals {
    let mut out = Reals::ZERO;
    for l in 0..LANES {
        out.0[l] = if patch[l] == j { 0.0 } else { 1.0 };
    }
    out
}

/// Some lanes of complex numbers in registers of the vector unit. With loops over lanes the compiler fills vectors
/// along the rows of a matrix instead. Then numbers are gathered and scattered one by one, which takes several times as
/// long.
#[derive(Clone, Copy)]
struct Register<S: Simd> {
    re: S::f64s,
    im: S::f64s,
}

/// The lanes from `first` on.
#[inline(always)]
fn load<S: Simd>(simd: S, x: &[f64; LANES], first: usize) -> S::f64s {
    let mut v = simd.splat_f64s(0.0);
    let lanes = cast_slice_mut::<S::f64s, f64>(std::slice::from_mut(&mut v));
    lanes.copy_from_slice(&x[first..first + S::F64_LANES]);
    v
}

#[inline(always)]
fn store<S: Simd>(v: S::f64s, x: &mut [f64; LANES], first: usize) {
    let lanes = cast_slice::<S::f64s, f64>(std::slice::from_ref(&v));
    x[first..first + S::F64_LANES].copy_from_slice(lanes);
}

/// The larger of two, or NaN where one is NaN.
#[inline(always)]
fn largest<S: Simd>(simd: S, a: S::f64s, b: S::f64s) -> S::f64s {
    let other = simd.add_f64s(b, simd.mul_f64s(a, simd.splat_f64s(0.0)));
    simd.select_f64s(simd.greater_than_or_equal_f64s(a, b), a, other)
}

impl<S: Simd> Register<S> {
    #[inline(always)]
    fn real(simd: S, x: f64) -> Self {
        Self { re: simd.splat_f64s(x), im: simd.splat_f64s(0.0) }
    }

    #[inline(always)]
    fn load(simd: S, z: &ComplexBatch, first: usize) -> Self {
        Self { re: load(simd, &z.re, first), im: load(simd, &z.im, first) }
    }

    #[inline(always)]
    fn store(self, z: &mut ComplexBatch, first: usize) {
        store::<S>(self.re, &mut z.re, first);
        store::<S>(self.im, &mut z.im, first);
    }

    /// `|re| + |im|`, at least the modulus.
    #[inline(always)]
    fn size(self, simd: S) -> S::f64s {
        // moduli by signs are calls of functions in `pulp`
        let modulus = |x: S::f64s| simd.max_f64s(x, simd.sub_f64s(simd.splat_f64s(0.0), x));
        simd.add_f64s(modulus(self.re), modulus(self.im))
    }

    /// Not a number where it is zero.
    #[inline(always)]
    fn reciprocal(self, simd: S) -> Self {
        let square = simd.mul_add_e_f64s(self.re, self.re, simd.mul_f64s(self.im, self.im));
        let inverse = simd.div_f64s(simd.splat_f64s(1.0), square);
        let im = simd.sub_f64s(simd.splat_f64s(0.0), simd.mul_f64s(self.im, inverse));
        Self { re: simd.mul_f64s(self.re, inverse), im }
    }

    #[inline(always)]
    fn sum(self, simd: S, other: Self) -> Self {
        Self { re: simd.add_f64s(self.re, other.re), im: simd.add_f64s(self.im, other.im) }
    }

    #[inline(always)]
    fn difference(self, simd: S, other: Self) -> Self {
        Self { re: simd.sub_f64s(self.re, other.re), im: simd.sub_f64s(self.im, other.im) }
    }

    /// Three roundings a part at most, as of a product that is not fused.
    #[inline(always)]
    fn product(self, simd: S, other: Self) -> Self {
        Self {
            re: simd.negate_mul_add_e_f64s(self.im, other.im, simd.mul_f64s(self.re, other.re)),
            im: simd.mul_add_e_f64s(self.re, other.im, simd.mul_f64s(self.im, other.re)),
        }
    }

    /// `self - a b` where roundings are not counted.
    #[inline(always)]
    fn less_product(self, simd: S, a: Self, b: Self) -> Self {
        let re = simd.negate_mul_add_e_f64s(a.re, b.re, self.re);
        let im = simd.negate_mul_add_e_f64s(a.re, b.im, self.im);
        Self { re: simd.mul_add_e_f64s(a.im, b.im, re), im: simd.negate_mul_add_e_f64s(a.im, b.re, im) }
    }

    /// `self + k z` for a real `k`.
    #[inline(always)]
    fn plus_times(self, simd: S, k: f64, z: Self) -> Self {
        let k = simd.splat_f64s(k);
        Self { re: simd.mul_add_e_f64s(k, z.re, self.re), im: simd.mul_add_e_f64s(k, z.im, self.im) }
    }
}

/// Row by row, the inverse by Gauss-Jordan elimination in place.
#[inline(always)]
fn approximate_inverse<S: Simd>(simd: S, j: &[[Register<S>; N]; N]) -> [[Register<S>; N]; N] {
    let mut m = *j;
    for p in 0..N {
        let pivot = m[p][p].reciprocal(simd);
        m[p][p] = Register::real(simd, 1.0);
        for k in 0..N {
            m[p][k] = m[p][k].product(simd, pivot);
        }
        let row = m[p];
        for r in 0..N {
            if r != p {
                let factor = m[r][p];
                m[r][p] = Register::real(simd, 0.0);
                for k in 0..N {
                    m[r][k] = m[r][k].less_product(simd, row[k], factor);
                }
            }
        }
    }
    m
}

/// Bounds `|sum_i y_i Q_i(h, k)|` on the unit polydisc, as [`LegSystem::second_order_bound`]. `rest` are the
/// contributions of rounding and radii for a weight of one.
#[inline(always)]
fn second_order<S: Simd>(
    simd: S,
    system: &LegSystem,
    y: &[Register<S>; N],
    weights: &[S::f64s; N],
    rest: &[f64; N],
    off: &[S::f64s; 4],
) -> S::f64s {
    let add = |a: S::f64s, b: S::f64s| simd.add_f64s(a, b);
    let times = |k: f64, a: S::f64s| simd.mul_f64s(simd.splat_f64s(k), a);
    let mut size = [simd.splat_f64s(0.0); COEFFICIENTS];
    for (k, size) in size.iter_mut().enumerate() {
        let mut sum = Register::real(simd, 0.0);
        for i in 0..6 {
            sum = sum.plus_times(simd, system.second_order.coefficient(i, k), y[i]);
        }
        *size = sum.size(simd);
    }
    let [_, d0, d1, d2, c0, c1, c2, ..] = size;
    let columns = [add(add(d0, d1), d2), add(add(d0, c1), c2), add(add(d1, c2), c0), add(add(d2, c0), c1)];
    let mut total = add(times(2.0, size[0]), times(3.0, weights[N - 1]));
    for j in 0..4 {
        total = add(total, simd.mul_f64s(add(columns[j], times(0.5, size[7 + j])), off[j]));
    }
    for (k, (i, j)) in PAIRS.into_iter().enumerate() {
        total = add(total, simd.mul_f64s(simd.mul_f64s(size[11 + k], off[i]), off[j]));
    }
    for i in 0..N {
        total = add(total, times(rest[i], weights[i]));
    }
    times(UP, add(total, simd.splat_f64s(TINY)))
}

/// Values, Jacobian (column `patch` holds the gradient by `g_3`) and bounds of their errors.
struct EvaluatedLanes {
    f: [ComplexBatch; N],
    j: Rows,
    f_error: [Reals; N],
    width: [Reals; N],
    j_error: [Reals; N],
}

#[inline(always)]
fn evaluate(system: &LegSystem, x: &[ComplexBatch; 8], patch: &[usize; LANES]) -> EvaluatedLanes {
    let Magnitudes { e, g, p } = magnitudes(x);
    let zero = ComplexBatch::ZERO;
    let mut out = EvaluatedLanes {
        f: [zero; N],
        j: [[zero; N]; N],
        f_error: [Reals::ZERO; N],
        width: [Reals::ZERO; N],
        j_error: [Reals::ZERO; N],
    };
    let [e0, e1, e2, e3, g0, g1, g2, g3] = *x;
    let norm = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    for i in 0..=6 {
        let mut row = [g0, g1, g2, g3, e0, e1, e2, e3];
        let (rounding, width, error);
        if i < 6 {
            let (d, c, s, t) = (system.d[i], system.c[i], system.s[i], system.t[i]);
            let v = [
                g0 - combined(d, [e1, e2, e3]),
                (g1 + e0.times(d[0])) + (e2.times(c[2]) - e3.times(c[1])),
                (g2 + e0.times(d[1])) + (e3.times(c[0]) - e1.times(c[2])),
                (g3 + e0.times(d[2])) + (e1.times(c[1]) - e2.times(c[0])),
            ];
            let square = (v[0] * v[0] + v[1] * v[1]) + (v[2] * v[2] + v[3] * v[3]);
            out.f[i] = (square - norm.times(s)).times(0.5);
            row = [
                combined(d, [v[1], v[2], v[3]]) - e0.times(s),
                ((v[3].times(c[1]) - v[2].times(c[2])) - v[0].times(d[0])) - e1.times(s),
                ((v[1].times(c[2]) - v[3].times(c[0])) - v[0].times(d[1])) - e2.times(s),
                ((v[2].times(c[0]) - v[1].times(c[1])) - v[0].times(d[2])) - e3.times(s),
                v[0],
                v[1],
                v[2],
                v[3],
            ];
            let (s, tau) = (s.abs(), system.turn_radius[i]);
            let root = square_moduli(&v).times(UP).map(f64::sqrt);
            let delta = (g + e.times(t)).times(5.0 * U).plus(TINY);
            let slack = root + delta.times(6.0);
            let own = (slack * slack + p.times(s)).times(5.0 * U) + p.times(0.5 * system.s_low[i].abs());
            rounding = (delta * slack + delta * delta).times(2.0) + own;
            let omega = e.times(tau);
            width = p.times(0.5 * system.s_radius[i]) + (omega * (slack + omega)).times(2.0);
            let by_e =
                delta.times(t) + (root.times(t) + e.times(s)).times(5.0 * U) + e.times(system.s_blur(i));
            let joints = (omega + slack.times(tau) + omega.times(t + tau)).times(4.0);
            error = delta.times(4.0) + by_e.times(3.0) + joints;
        } else {
            out.f[i] = (e0 * g0 + e1 * g1) + (e2 * g2 + e3 * g3);
            rounding = (e * g).times(32.0 * U);
            (width, error) = (Reals::ZERO, Reals::ZERO);
        }
        out.f_error[i] = (rounding.up() + sizes(&out.f[i]).times(17.0 * U)).up();
        // data that are their doubles have none
        out.width[i] = width.times(UP);
        let mut sum = Reals::ZERO;
        for (k, z) in row.iter().enumerate().take(N) {
            let mut chosen = *z;
            if k < 4 {
                for l in 0..LANES {
                    if patch[l] == k {
                        (chosen.re[l], chosen.im[l]) = (row[7].re[l], row[7].im[l]);
                    }
                }
            }
            out.j[i][k] = chosen;
            sum = sum + sizes(&chosen);
        }
        out.j_error[i] = (error + sum.times(16.0 * U)).up();
    }
    out
}

#[inline(always)]
fn bounds<S: Simd>(
    simd: S,
    system: &LegSystem,
    x: &[ComplexBatch; 8],
    patch: &[usize; LANES],
) -> EightBounds {
    let evaluated = evaluate(system, x, patch);
    let mut rest = [32.0 * U * system.q[N - 1]; N];
    for (i, rest) in rest.iter_mut().enumerate().take(6) {
        let data = 1.5 * system.s_blur(i) + system.joint_width_of_second_order(i);
        *rest = (data + 32.0 * U * system.q[i]) * UP;
    }
    let mut out = EightBounds {
        eta_centre: Reals::ZERO,
        eta: Reals::ZERO,
        kappa: Reals::ZERO,
        beta: Reals::ZERO,
        step: [ComplexBatch::ZERO; N],
    };
    for first in (0..LANES).step_by(S::F64_LANES) {
        bounds_of_lanes(simd, system, &evaluated, patch, &rest, first, &mut out);
    }
    out
}

/// The bounds of the lanes of one register.
#[inline(always)]
fn bounds_of_lanes<S: Simd>(
    simd: S,
    system: &LegSystem,
    evaluated: &EvaluatedLanes,
    patch: &[usize; LANES],
    rest: &[f64; N],
    first: usize,
    out: &mut EightBounds,
) {
    let EvaluatedLanes { f, j, f_error, width, j_error } = evaluated;
    let (zero, none) = (Register::real(simd, 0.0), simd.splat_f64s(0.0));
    let mut matrix = [[zero; N]; N];
    let (mut value, mut off) = ([zero; N], [none; 4]);
    let (mut value_error, mut data_width, mut gradient_error) = ([none; N], [none; N], [none; N]);
    for i in 0..N {
        for k in 0..N {
            matrix[i][k] = Register::load(simd, &j[i][k], first);
        }
        value[i] = Register::load(simd, &f[i], first);
        value_error[i] = load(simd, &f_error[i].0, first);
        data_width[i] = load(simd, &width[i].0, first);
        gradient_error[i] = load(simd, &j_error[i].0, first);
    }
    for (j, off) in off.iter_mut().enumerate() {
        *off = load(simd, &off_patch(patch, j).0, first);
    }
    let inverse = approximate_inverse(simd, &matrix);
    let (mut eta_centre, mut eta, mut kappa, mut beta) = (none, none, none, none);
    for (k, y) in inverse.iter().enumerate() {
        let mut weights = [none; N];
        let (mut step, mut values, mut data, mut gradients) = (zero, none, none, none);
        for i in 0..N {
            weights[i] = y[i].size(simd);
            step = step.sum(simd, y[i].product(simd, value[i]));
            values = simd.mul_add_e_f64s(weights[i], value_error[i], values);
            data = simd.mul_add_e_f64s(weights[i], data_width[i], data);
            gradients = simd.mul_add_e_f64s(weights[i], gradient_error[i], gradients);
        }
        let mut defect = none;
        for l in 0..N {
            let mut rest = Register::real(simd, if l == k { 1.0 } else { 0.0 });
            for i in 0..N {
                rest = rest.difference(simd, y[i].product(simd, matrix[i][l]));
            }
            defect = simd.add_f64s(defect, rest.size(simd));
        }
        step.store(&mut out.step[k], first);
        let centre = simd.add_f64s(step.size(simd), values);
        eta_centre = largest(simd, eta_centre, centre);
        eta = largest(simd, eta, simd.add_f64s(centre, data));
        kappa = largest(simd, kappa, simd.add_f64s(defect, gradients));
        beta = largest(simd, beta, second_order(simd, system, y, &weights, rest, &off));
    }
    store::<S>(eta_centre, &mut out.eta_centre.0, first);
    store::<S>(eta, &mut out.eta.0, first);
    store::<S>(kappa, &mut out.kappa.0, first);
    store::<S>(beta, &mut out.beta.0, first);
}

/// The entries of a pose, `R` row by row, then `p`.
type Entries<T> = [T; 12];

#[inline(always)]
fn entries<T: Copy>(rotation: &[T; 9], position: &[T; 3]) -> Entries<T> {
    let ([a, b, c, d, e, f, g, h, i], [x, y, z]) = (*rotation, *position);
    [a, b, c, d, e, f, g, h, i, x, y, z]
}

/// Poses one Newton step on, and whether `e.e` is large enough for doubles.
#[inline(always)]
fn poses(x: &[ComplexBatch; 8]) -> (Entries<ComplexBatch>, [bool; LANES]) {
    let (r, p, n) = pose_numerators(x);
    let (size, norm) = (square_moduli(&x[..4]), n.norm_sqr());
    let inverse = n.reciprocal();
    let mut out = entries(&r, &p);
    for z in &mut out {
        *z = *z * inverse;
    }
    let mut near = [false; LANES];
    for l in 0..LANES {
        near[l] = norm[l] > FAR * FAR * size.0[l] * size.0[l];
    }
    (out, near)
}

/// Whether every point of the discs has the digits of the pose. Distances are at most [`NEAR`]: entries of `R` relative
/// to the larger of 1 and the largest of them, entries of `p` likewise. Moduli are bounded by their parts.
#[inline(always)]
fn agree(pose: &Entries<ComplexBatch>, discs: &Entries<Discs>) -> [bool; LANES] {
    let mut out = [true; LANES];
    for part in [0..9, 9..12] {
        let (mut gap, mut scale) = (Reals::ZERO, Reals::all(1.0));
        for k in part {
            gap = gap.largest(sizes(&(discs[k].c - pose[k])) + discs[k].r);
            scale = larger(scale, parts(&pose[k]));
        }
        for l in 0..LANES {
            out[l] &= gap.0[l] * UP * UP <= NEAR * scale.0[l];
        }
    }
    out
}

#[inline(always)]
fn certify<S: Simd>(
    simd: S,
    system: &LegSystem,
    points: &[Study<f64>],
    out: &mut Vec<Option<CertifiedPose>>,
) -> [bool; LANES] {
    let mut ball_only = [false; LANES];
    let Some(last) = points.len().checked_sub(1) else { return ball_only };
    let mut x = [ComplexBatch::ZERO; 8];
    let mut patch = [0; LANES];
    for l in 0..LANES {
        let point = &points[l.min(last)];
        patch[l] = point.patch;
        for k in 0..8 {
            (x[k].re[l], x[k].im[l]) = (point.re[k], point.im[k]);
        }
    }
    let bounds = bounds(simd, system, &x, &patch);
    let mut better = x;
    for k in 0..N {
        let step = bounds.step[k];
        for l in 0..LANES {
            let j = if k == patch[l] { 7 } else { k };
            better[j].re[l] -= step.re[l];
            better[j].im[l] -= step.im[l];
        }
    }
    let mut balls = [None; LANES];
    let mut radius = Reals::ZERO;
    for l in 0..=last.min(LANES - 1) {
        let numbers = KrawczykBounds {
            eta_centre: bounds.eta_centre.0[l],
            eta: bounds.eta.0[l],
            kappa: bounds.kappa.0[l],
            beta: bounds.beta.0[l],
            step: [Complex64::ZERO; 8],
        };
        balls[l] = holds_one_root(&numbers.rounded_up(), NEAR).ok();
        if let Some(ball) = &balls[l] {
            radius.0[l] = ball.radius;
        }
    }
    let mut ball_of = [Discs::ZERO; 8];
    for j in 0..8 {
        let at_rest = if j < 4 { off_patch(&patch, j) } else { Reals::all(1.0) };
        ball_of[j] = Discs { c: x[j], r: radius * at_rest };
    }
    let (r, p, n) = pose_numerators(&ball_of);
    let inverse = n.reciprocal();
    let mut discs = entries(&r, &p);
    for z in &mut discs {
        *z = *z * inverse;
    }
    let (pose, near) = poses(&better);
    let agrees = agree(&pose, &discs);
    let unit = system.unit();
    for (l, point) in points.iter().enumerate().take(LANES) {
        let ball = match balls[l] {
            Some(ball) if near[l] && agrees[l] => ball,
            other => {
                ball_only[l] = other.is_some();
                out.push(None);
                continue;
            }
        };
        let disc = |k: usize| {
            let scale = if k < 9 { 1.0 } else { unit };
            Disc { centre: discs[k].c.lane(l) * scale, radius: discs[k].r.0[l] * scale }
        };
        let entry = |k: usize| pose[k].lane(l) * if k < 9 { 1.0 } else { unit };
        let certificate = Certificate {
            centre: std::array::from_fn(|k| x[k].lane(l)),
            low: [Complex64::ZERO; 8],
            patch: point.patch,
            unit,
            radius: ball.radius,
            centre_radius: ball.centre_radius,
            uniqueness_radius: ball.uniqueness_radius,
            contraction: ball.lipschitz,
            reality: super::reality(&Centre { hi: point, full: None }, &ball),
            precision: CentrePrecision::Double,
            enclosure: PoseEnclosure {
                rotation: std::array::from_fn(|i| std::array::from_fn(|j| disc(3 * i + j))),
                position: std::array::from_fn(|i| disc(9 + i)),
            },
        };
        let pose = ComplexPose {
            rotation: nalgebra::Matrix3::from_fn(|i, j| entry(3 * i + j)),
            position: nalgebra::Vector3::from_fn(|i, _| entry(9 + i)),
        };
        out.push(Some(CertifiedPose { pose, certificate }));
    }
    ball_only
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::certify::refine::refine_study;
    use crate::solve::certify::system::RealScalar;
    use crate::solve::certify::{Certifier, NewtonStart, RootRelation, SquareData, relation};
    use nalgebra::{Point3, Vector3};
    use num::Rng;
    use num::double_double::DoubleDouble;
    use platform::geom::random_rotation;
    use platform::manipulator::{Leg, Manipulator};

    /// Real and complex roots of a random problem to the digits of a double-double, and its certifier.
    fn roots(rng: &mut Rng, radius: f64) -> (Certifier, Vec<Study<DoubleDouble>>) {
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        let legs = std::array::from_fn(|_| Leg { base: point(), platform: point() });
        let m = Manipulator::from_legs(legs).unwrap();
        let position = Vector3::new(0.3, -0.4, 1.2);
        let pose = platform::geom::Pose { rotation: random_rotation(rng), position };
        let mut data = SquareData::from(&pose.squared_lengths(&m).unwrap());
        data.radius = [radius; 6];
        let certifier = Certifier::new(&m, data).unwrap();
        let mut out: Vec<Study<DoubleDouble>> = Vec::new();
        for _ in 0..60 {
            let mut start = Study { re: [0.0; 8], im: [0.0; 8], patch: 2 };
            for k in 0..8 {
                (start.re[k], start.im[k]) = (rng.normal(), rng.normal());
            }
            (start.re[2], start.im[2]) = (1.0, 0.0);
            let Ok(found) = refine_study(&certifier.0, &start, f64::INFINITY) else { continue };
            let apart = |x: &Study<DoubleDouble>| {
                (0..8).any(|k| (x.re[k].rounded() - found.x.re[k].rounded()).abs() > 1e-6)
            };
            if out.iter().all(apart) {
                out.push(found.x);
            }
        }
        (certifier, out)
    }

    fn point_of(certifier: &Certifier, x: &Study<DoubleDouble>) -> [Complex64; 8] {
        let phase = Complex64::new(0.6, -1.7);
        std::array::from_fn(|k| {
            let scale = if k < 4 { 1.0 } else { certifier.0.unit() };
            Complex64::new(x.re[k].rounded(), x.im[k].rounded()) * phase * scale
        })
    }

    /// Every lane has the proof that its point has alone, and the ball holds the root.
    #[test]
    fn eight_points_have_the_proofs_that_each_has_alone() {
        let mut rng = Rng::new(0x51de);
        let (mut proved, mut tried) = (0, 0);
        for round in 0..6 {
            let radius = if round % 2 == 0 { 0.0 } else { 1e-10 };
            let (certifier, roots) = roots(&mut rng, radius);
            assert!(roots.len() > 8, "more than one batch: {}", roots.len());
            let points: Vec<[Complex64; 8]> = roots.iter().map(|x| point_of(&certifier, x)).collect();
            let found = certifier.roots_near(&points.iter().collect::<Vec<_>>());
            assert_eq!(found.len(), points.len());
            for ((found, point), x) in found.iter().zip(&points).zip(&roots) {
                let Ok(alone) = certifier.root_near(NewtonStart::Point(point)) else { continue };
                tried += 1;
                let Some(root) = found else { continue };
                proved += 1;
                let (own, other) = (&root.certificate, &alone.certificate);
                assert_eq!(relation(own, other), RootRelation::Same);
                assert!(root.pose.distance(&alone.pose, certifier.0.unit()) < 1e-7);
                assert_eq!(own.reality(), other.reality());
                if own.precision() == other.precision() {
                    let ratio = own.radius() / other.radius();
                    assert!((0.2..5.0).contains(&ratio), "{ratio}");
                }
                // the root, on the patch of the certificate
                let one = Complex64::new(x.re[own.patch()].rounded(), x.im[own.patch()].rounded());
                for k in 0..8 {
                    let z = Complex64::new(x.re[k].rounded(), x.im[k].rounded()) / one;
                    let gap = (z - own.centre()[k] - own.low()[k]).norm();
                    assert!(gap <= own.radius() + 1e-14 * (1.0 + z.norm()), "{gap}");
                }
                if radius > 0.0 {
                    assert!(own.radius() > 0.1 * radius);
                }
            }
        }
        assert!(tried > 60 && 10 * proved > 9 * tried, "{proved} of {tried}");
    }

    /// Points beside the roots, points that are none and no numbers have no proof, and do not disturb their neighbours.
    #[test]
    fn points_that_are_no_roots_have_no_proof() {
        let mut rng = Rng::new(0x51df);
        let (certifier, roots) = roots(&mut rng, 0.0);
        let good = point_of(&certifier, &roots[0]);
        let mut points = vec![good; 8];
        for (k, z) in points[1].iter_mut().enumerate() {
            *z *= 1.0 + 1e-5 * k as f64;
        }
        points[3] = std::array::from_fn(|_| Complex64::new(rng.normal(), rng.normal()));
        points[4] = [Complex64::new(f64::NAN, 0.0); 8];
        points[6] = [Complex64::ZERO; 8];
        let found = certifier.roots_near(&points.iter().collect::<Vec<_>>());
        for (k, root) in found.iter().enumerate() {
            assert_eq!(root.is_some(), ![1, 3, 4, 6].contains(&k), "{k}");
        }
        assert!(certifier.roots_near(&[]).is_empty());
    }
}
