//! Certificates of eight points at once, in doubles: the theorem and the bounds of `krawczyk.rs` with the numbers of eight points side by side in vector units.
//!
//! Sums have the terms of the text of the `system` and `krawczyk` modules, each with no more roundings than is counted there; how they are grouped does not matter to those bounds. Rows are not
//! exchanged when the approximate inverse is made: where a pivot is small the inverse is bad, which the bound of `I - Y J` sees. A lane without a proof says nothing about its point: it is for
//! the general way to look at, with more digits.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;

use super::NEAR;
use super::certificate::{CentrePrecision, Certificate, CertifiedPose, PoseEnclosure};
use super::coordinates::pose_numerators;
use super::krawczyk::{Centre, KrawczykBounds, holds_one_root};
use super::octahedral::arithmetic::{Discs, Reals, parts, sizes};
use super::second_order::{COEFFICIENTS, PAIRS};
use super::system::{LegSystem, N, Study, U};
use crate::geom::ComplexPose;
use crate::num::ball::{Disc, TINY, UP};
use crate::num::batch::{ComplexBatch, LANES};

/// `|e.e| / |e|^2` below which doubles are not enough for `R` and `p`: as for one point.
const FAR: f64 = 1.0 / 16.0;

/// Points of one problem, one a lane, at most [`LANES`]; lanes beyond them repeat the last.
pub(super) struct EightPoints<'a> {
    pub(super) system: &'a LegSystem,
    pub(super) points: &'a [Study<f64>],
    /// Receives what is proved of each point.
    pub(super) out: &'a mut Vec<FoundInDoubles>,
}

/// What doubles prove of a point.
#[derive(Debug, Clone, Copy)]
#[allow(clippy::large_enum_variant)] // most are roots
pub(super) enum FoundInDoubles {
    /// The root with its pose.
    Root(CertifiedPose),
    /// One root, but not where its `R` and `p` are.
    BallOnly,
    /// Nothing.
    Nothing,
}

impl pulp::WithSimd for EightPoints<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        certify(self.system, self.points, self.out);
    }
}

/// What the theorem needs, eight times.
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

/// Row by row, the inverse by Gauss-Jordan elimination in place.
#[inline(always)]
fn approximate_inverse(j: &Rows) -> Rows {
    let mut m = *j;
    for p in 0..N {
        let pivot = m[p][p].reciprocal();
        m[p][p] = ComplexBatch::real(1.0);
        for k in 0..N {
            m[p][k] = m[p][k] * pivot;
        }
        let row = m[p];
        for r in 0..N {
            if r != p {
                let factor = m[r][p];
                m[r][p] = ComplexBatch::ZERO;
                for k in 0..N {
                    m[r][k] = m[r][k] - row[k] * factor;
                }
            }
        }
    }
    m
}

/// Bounds `|sum_i y_i Q_i(h, k)|` on the unit polydisc, as [`LegSystem::second_order_bound`]; `rest` are what rounding and radii add for a weight of one.
#[inline(always)]
fn second_order(
    system: &LegSystem,
    y: &[ComplexBatch; N],
    weights: &[Reals; N],
    rest: &[f64; N],
    off: &[Reals; 4],
) -> Reals {
    let mut size = [Reals::ZERO; COEFFICIENTS];
    for (k, size) in size.iter_mut().enumerate() {
        let mut sum = ComplexBatch::ZERO;
        for i in 0..6 {
            sum = sum + y[i].times(system.second_order.coefficient(i, k));
        }
        *size = sizes(&sum);
    }
    let [_, d0, d1, d2, c0, c1, c2, ..] = size;
    let columns = [d0 + d1 + d2, d0 + c1 + c2, d1 + c2 + c0, d2 + c0 + c1];
    let mut total = size[0].times(2.0) + weights[N - 1].times(3.0);
    for j in 0..4 {
        total = total + (columns[j] + size[7 + j].times(0.5)) * off[j];
    }
    for (k, (i, j)) in PAIRS.into_iter().enumerate() {
        total = total + size[11 + k] * off[i] * off[j];
    }
    for i in 0..N {
        total = total + weights[i].times(rest[i]);
    }
    total.up()
}

/// Values, Jacobian (column `patch` holds the gradient by `g_3`) and bounds of their errors.
struct Evaluated {
    f: [ComplexBatch; N],
    j: Rows,
    f_error: [Reals; N],
    width: [Reals; N],
    j_error: [Reals; N],
}

#[inline(always)]
fn evaluate(system: &LegSystem, x: &[ComplexBatch; 8], patch: &[usize; LANES]) -> Evaluated {
    let Magnitudes { e, g, p } = magnitudes(x);
    let zero = ComplexBatch::ZERO;
    let mut out = Evaluated {
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
fn bounds(system: &LegSystem, x: &[ComplexBatch; 8], patch: &[usize; LANES]) -> EightBounds {
    let Evaluated { f, j, f_error, width, j_error } = evaluate(system, x, patch);
    let inverse = approximate_inverse(&j);
    let mut rest = [32.0 * U * system.q[N - 1]; N];
    for (i, rest) in rest.iter_mut().enumerate().take(6) {
        let data = 1.5 * system.s_blur(i) + system.joint_width_of_second_order(i);
        *rest = (data + 32.0 * U * system.q[i]) * UP;
    }
    let off = [0, 1, 2, 3].map(|j| off_patch(patch, j));
    let zero = ComplexBatch::ZERO;
    let mut out = EightBounds {
        eta_centre: Reals::ZERO,
        eta: Reals::ZERO,
        kappa: Reals::ZERO,
        beta: Reals::ZERO,
        step: [zero; N],
    };
    for k in 0..N {
        let y = &inverse[k];
        let mut weights = [Reals::ZERO; N];
        let (mut step, mut values, mut data, mut gradients) = (zero, Reals::ZERO, Reals::ZERO, Reals::ZERO);
        for i in 0..N {
            weights[i] = sizes(&y[i]);
            step = step + y[i] * f[i];
            values = values + weights[i] * f_error[i];
            data = data + weights[i] * width[i];
            gradients = gradients + weights[i] * j_error[i];
        }
        let mut defect = Reals::ZERO;
        for l in 0..N {
            let mut rest = if l == k { ComplexBatch::real(1.0) } else { zero };
            for i in 0..N {
                rest = rest - y[i] * j[i][l];
            }
            defect = defect + sizes(&rest);
        }
        out.step[k] = step;
        let centre = sizes(&step) + values;
        out.eta_centre = out.eta_centre.largest(centre);
        out.eta = out.eta.largest(centre + data);
        out.kappa = out.kappa.largest(defect + gradients);
        out.beta = out.beta.largest(second_order(system, y, &weights, &rest, &off));
    }
    out
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

/// Whether every point of the discs has the digits of the pose: distances at most [`NEAR`], of entries of `R` relative to the larger of 1 and the largest of them, of
/// entries of `p` likewise. Moduli are bounded by their parts.
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
fn certify(system: &LegSystem, points: &[Study<f64>], out: &mut Vec<FoundInDoubles>) {
    let Some(last) = points.len().checked_sub(1) else { return };
    let mut x = [ComplexBatch::ZERO; 8];
    let mut patch = [0; LANES];
    for l in 0..LANES {
        let point = &points[l.min(last)];
        patch[l] = point.patch;
        for k in 0..8 {
            (x[k].re[l], x[k].im[l]) = (point.re[k], point.im[k]);
        }
    }
    let bounds = bounds(system, &x, &patch);
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
        let Some(ball) = balls[l] else {
            out.push(FoundInDoubles::Nothing);
            continue;
        };
        if !(near[l] && agrees[l]) {
            out.push(FoundInDoubles::BallOnly);
            continue;
        }
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
        out.push(FoundInDoubles::Root(CertifiedPose { pose, certificate }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random_rotation;
    use crate::manipulator::{Leg, Manipulator};
    use crate::num::Rng;
    use crate::num::double_double::DoubleDouble;
    use crate::solve::certify::refine::refine_study;
    use crate::solve::certify::system::RealScalar;
    use crate::solve::certify::{Certifier, NewtonStart, RootRelation, SquareData, relation};
    use nalgebra::{Point3, Vector3};

    /// Real and complex roots of a random problem to the digits of a double-double, and its certifier.
    fn roots(rng: &mut Rng, radius: f64) -> (Certifier, Vec<Study<DoubleDouble>>) {
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        let legs = std::array::from_fn(|_| Leg { base: point(), platform: point() });
        let m = Manipulator::from_legs(legs).unwrap();
        let position = Vector3::new(0.3, -0.4, 1.2);
        let pose = crate::geom::Pose { rotation: random_rotation(rng), position };
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
