//! Clusters: `m` roots in one ball, counted with multiplicity. They prove facts about a multiple pose, and about poses
//! too close to be told apart.
//!
//! Let the Jacobian `J` at the centre `c` have one small singular value. Let `w` be near the direction that its image
//! lacks, and `l` near the row that its kernel needs. The bordered equations in `z = (h, mu)`,
//!
//! ```text
//! F(c + h) - mu w = 0,    l.h = t,        B = [ J  -w ; l  0 ],
//! ```
//!
//! are regular although `F` is not (Keller 1977; Griewank and Reddien 1984). Let `Y` be an approximate inverse of `B`
//! and expand their solution to an order `K`,
//!
//! ```text
//! z_1 = last column of Y,
//! c_n = -Y (sum over i + j = n, i, j <= K of Q(h_i, h_j), 0),
//! z_n = c_n as computed, within e_n,
//! z = z_1 t + .. + z_K t^K + zeta,    zeta = (k, nu).
//! ```
//!
//! With `p(t) = (h_p, mu_p)` for the polynomial, the simplified Newton map in `zeta` is
//!
//! ```text
//! T(zeta) = (I - Y B)(p + zeta) - Y (F(c), 0)
//!     + sum over 2 <= n <= 2K of c_n t^n, less z_n t^n for n <= K
//!     - Y (2 Q(h_p, k) + Q(k, k), 0),
//! ```
//!
//! and has the bounds `eta >= |Y (F(c), 0)|`, `kappa >= |I - Y B|`, `beta >= sup |Y (Q(h, k), 0)|` over unit `h`, `k`
//! (max norm). On `|t| <= rho` let `H = sum |h_n| rho^n` and `Z = sum |z_n| rho^n` over `n <= K`, and
//!
//! ```text
//! C = eta + kappa Z + sum over n of e_n rho^n + sum over n > K of |z_n| rho^n.
//! ```
//!
//! 1. If `C + kappa R + beta (2 H R + R^2) <= R` and `kappa + 2 beta (H + R) < 1`, then every complex `t` with
//!    `|t| <= rho` has exactly one fixed point with `|zeta| <= R`. It is analytic in `t`: `h(t)`, `mu(t)`. It is the
//!    only one with `|zeta| <= S` for every `S` with `kappa + 2 beta (H + S) < 1`. `kappa < 1` makes `Y` regular.
//! 2. The bordered equations with `t` as a further unknown have a regular Jacobian by `(h, mu)` there. Hence their
//!    zeros near `(h(t), mu(t), t)` are this curve. The local ring of `F` at `c + h(t_0)`, where `mu(t_0) = 0`, is that
//!    of `mu` at `t_0`. So the multiplicity of the root is the order of the zero (Lyapunov-Schmidt reduction).
//! 3. The last row of the fixed-point equation is `mu(t) = mu_1 t + .. + mu_2K t^2K + E(t)`, `mu_n` the last entry of
//!    `z_n`. There `|E| <= eta_8 + kappa_8 (Z + R) + sum e_n,8 rho^n + beta_8 (2 H R + R^2)`, and the index 8 stands
//!    for that row. Let `|mu_m| rho^m` be larger than this and `|mu_n| rho^n` of all other `n` together. Then `mu` has
//!    exactly `m` zeros with `|t| < rho` by Rouche's theorem. They are `m` roots, counted with multiplicity, within
//!    `H + R` of `c`, for every choice of the data.
//! 4. A root at `h` with `|h| <= r`, `|l|_1 r <= rho`, `r + H <= S` and `|mu_1| rho + .. + |mu_K| rho^K <= S` is the
//!    fixed point for `t = l.h`, with `mu = 0`. So within `r` of `c` there are no roots but those `m`.
//!
//! Statements 1 and 3 may hold for a small `rho`, which bounds the distances of the roots. They may also hold for a
//! large one, which bounds the distance of all others. The `m` roots are the same.
//!
//! For `m = 2` and `K = 1` the expansion has the term in `t^2` only. More terms count where the next root is so close
//! that the bound of the remainder would reach it.
//!
//! **Rounding** as in `krawczyk.rs`. A row of `Y B` is a sum of at most 16 products in each part, below
//! `20 u sum |Y|_1 |B|_1`. `Q(h_i, h_j)` has the bounds of the `system` module. The sum over `i` has at most `K` terms,
//! and a row of `Y` times it at most 14 products in each part.

use nalgebra::SMatrix;
use num_complex::Complex64;

use super::certificate::{PoseEnclosure, ProvedReality, WhyUncertified};
use super::coordinates::{enclose_pose_widely, rounded_pose, study_of};
use super::krawczyk::largest;
use super::system::{LegSystem, N, RealScalar, Study, U};
use num::ball::{TINY, UP};
use num::double_double::DoubleDouble;
use num::small::bounded_svd;
use platform::geom::ComplexPose;

/// Newton steps towards the middle of a cluster.
const STEPS: usize = 12;
/// The distance that these may lead, in coordinates of order one. Means of the ends of paths are multiple poses to
/// about six digits.
const REACH: f64 = 1e-3;
/// The radii `rho` that are tried.
const RADII: [i32; 2] = [-48, -4];
/// The largest multiplicity that is tried.
pub(super) const MOST: usize = 6;
/// `|e.e| / |e|^2` below which nothing is tried: far out the enclosures of `R` and `p` are wide.
const FAR: f64 = 1.0 / 64.0;

type BorderedMatrix = SMatrix<Complex64, 8, 8>;

/// Proof that exactly so many roots, counted with multiplicity, lie near a point: one multiple root, or several that
/// are close.
///
/// Coordinates are those of a [`Certificate`](super::Certificate). For every choice of the data within their radii
/// there are [`multiplicity`](Self::multiplicity) roots within [`radius`](Self::radius) of the centre. The centre is
/// [`centre`](Self::centre) `+` [`low`](Self::low), and the roots are on the curve of the module's text. No others lie
/// within [`uniqueness_radius`](Self::uniqueness_radius).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClusterCertificate {
    centre: [Complex64; 8],
    low: [Complex64; 8],
    patch: usize,
    unit: f64,
    multiplicity: usize,
    radius: f64,
    uniqueness_radius: f64,
    reach: f64,
    dominance: f64,
    reality: ProvedReality,
    enclosure: PoseEnclosure,
}

impl ClusterCertificate {
    /// The doubles nearest to the centre, `g` divided by [`unit`](Self::unit).
    #[must_use]
    pub fn centre(&self) -> &[Complex64; 8] {
        &self.centre
    }

    /// The digits of the centre beyond [`centre`](Self::centre).
    #[must_use]
    pub fn low(&self) -> &[Complex64; 8] {
        &self.low
    }

    /// Index of the coordinate that is 1.
    #[must_use]
    pub fn patch(&self) -> usize {
        self.patch
    }

    /// The power of two, in design units, that lengths are divided by.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The number of roots, each with its multiplicity: two or more.
    #[must_use]
    pub fn multiplicity(&self) -> usize {
        self.multiplicity
    }

    /// All roots of the cluster are at most this far from the centre.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// All roots at most this far from the centre are of the cluster. It may be smaller than the radius.
    #[must_use]
    pub fn uniqueness_radius(&self) -> f64 {
        self.uniqueness_radius
    }

    /// Radius of the disc of the parameter `t` in which `mu` has the zeros.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Bound of all else on the circle of that radius over the modulus of the term in `t^m`, below 1.
    #[must_use]
    pub fn dominance(&self) -> f64 {
        self.dominance
    }

    /// [`NonReal`](ProvedReality::NonReal) when no root of the cluster is real; whether close roots are real is not
    /// decided.
    #[must_use]
    pub fn reality(&self) -> ProvedReality {
        self.reality
    }

    /// The enclosure of `R` and `p` of all its roots.
    #[must_use]
    pub fn enclosure(&self) -> &PoseEnclosure {
        &self.enclosure
    }

    /// The nearest doubles of the centre with `g` in design units.
    pub fn point(&self) -> [Complex64; 8] {
        std::array::from_fn(|k| if k < 4 { self.centre[k] } else { self.centre[k] * self.unit })
    }
}

/// The bordered equations at a centre: their Jacobian, its approximate inverse and the bounds of the Jacobian's error.
struct BorderedSystem {
    b: BorderedMatrix,
    y: BorderedMatrix,
    /// Bounds of the error of a row of `J`, width of the data included.
    j_error: [f64; N],
}

/// `x^n`, exact for a power of two.
fn power(x: f64, n: usize) -> f64 {
    std::iter::repeat_n(x, n).product()
}

fn modulus(z: Complex64) -> f64 {
    z.re.abs() + z.im.abs()
}

/// The index of column `k` of the Jacobian among the coordinates.
fn coordinate(patch: usize, k: usize) -> usize {
    if k == patch { 7 } else { k }
}

impl BorderedSystem {
    /// `None` where more than one direction is singular, or none is defined.
    fn at(system: &LegSystem, x: &Study<f64>) -> Option<Self> {
        let values = system.values(x);
        let j = system.jacobian(x, &values);
        let jacobian = SMatrix::<Complex64, 7, 7>::from_fn(|i, k| Complex64::new(j.re[i][k], j.im[i][k]));
        if !jacobian.iter().all(|z| z.is_finite()) {
            return None;
        }
        let svd = bounded_svd(&jacobian)?;
        let (u, v_t) = (svd.u?, svd.v_t?);
        let mut b = BorderedMatrix::zeros();
        b.fixed_view_mut::<7, 7>(0, 0).copy_from(&jacobian);
        // real data have real singular vectors up to a phase; with the phase the curve of a real centre would not be
        // its own conjugate
        let phase = |entries: &[Complex64]| {
            let top =
                entries.iter().fold(Complex64::ONE * 0.0, |m, z| if z.norm() > m.norm() { *z } else { m });
            top.conj() / top.norm()
        };
        let left: Vec<Complex64> = u.column(6).iter().copied().collect();
        let right: Vec<Complex64> = v_t.row(6).iter().copied().collect();
        let (p, q) = (phase(&left), phase(&right));
        for k in 0..N {
            b[(k, 7)] = -left[k] * p;
            b[(7, k)] = right[k] * q;
        }
        let y = b.try_inverse()?;
        let j_error = std::array::from_fn(|i| j.error[i]);
        y.iter().all(|z| z.is_finite()).then_some(Self { b, y, j_error })
    }
}

fn complex(re: &[f64; N], im: &[f64; N]) -> [Complex64; N] {
    std::array::from_fn(|i| Complex64::new(re[i], im[i]))
}

/// `F` at a centre in double-double, rounded.
fn values_at(system: &LegSystem, x: &Study<DoubleDouble>) -> [Complex64; N] {
    let f = system.values(x);
    complex(&f.f_re.map(RealScalar::rounded), &f.f_im.map(RealScalar::rounded))
}

/// The numbers `z_n` of the module's text, from `n = 1` to twice the order, with bounds of `e_n` in all rows and in the
/// last.
struct CurveExpansion {
    order: usize,
    terms: Vec<[Complex64; 8]>,
    error: Vec<f64>,
    last_error: Vec<f64>,
}

impl CurveExpansion {
    fn of(system: &LegSystem, border: &BorderedSystem, patch: usize, order: usize) -> Self {
        let first: [Complex64; 8] = std::array::from_fn(|k| border.y[(k, 7)]);
        let increment = |z: &[Complex64; 8]| system.increment(&std::array::from_fn(|k| z[k]), patch);
        let mut increments = vec![increment(&first)];
        let mut out = Self { order, terms: vec![first], error: vec![0.0], last_error: vec![0.0] };
        for n in 2..=2 * order {
            let (mut q, mut q_error) = ([Complex64::ZERO; N], [0.0; N]);
            for i in n.saturating_sub(order).max(1)..=n / 2 {
                let twice = if 2 * i == n { 1.0 } else { 2.0 };
                let (part, error) = system.second_order_part(&increments[i - 1], &increments[n - i - 1]);
                for k in 0..N {
                    q[k] += part[k] * twice;
                    q_error[k] += twice * (error[k] + (order + 1) as f64 * U * modulus(part[k]));
                }
            }
            let (mut worst, mut last) = (0.0, 0.0);
            let z: [Complex64; 8] = std::array::from_fn(|r| {
                let row = |i: usize| border.y[(r, i)];
                let error: f64 =
                    (0..N).map(|i| modulus(row(i)) * (q_error[i] + 17.0 * U * modulus(q[i]))).sum();
                last = (error + TINY) * UP;
                worst = largest(worst, last);
                -(0..N).map(|i| row(i) * q[i]).sum::<Complex64>()
            });
            out.terms.push(z);
            out.error.push(worst);
            out.last_error.push(last);
            if n <= order {
                increments.push(increment(&z));
            }
        }
        out
    }

    /// `mu_n`.
    fn mu(&self, n: usize) -> Complex64 {
        self.terms[n - 1][7]
    }

    /// The polynomial at `t`, without `mu`.
    fn at(&self, t: Complex64) -> [Complex64; N] {
        let horner =
            |k: usize| self.terms[..self.order].iter().rev().fold(Complex64::ZERO, |p, z| (p + z[k]) * t);
        std::array::from_fn(horner)
    }

    /// Above `sum |.|_n rho^n` over some `n`.
    fn size(
        &self,
        which: std::ops::RangeInclusive<usize>,
        rho: f64,
        of: impl Fn(&[Complex64; 8]) -> f64,
    ) -> f64 {
        which.map(|n| of(&self.terms[n - 1]) * power(rho, n)).sum::<f64>() * UP
    }
}

/// The point about which a cluster is sought, with the equations and the expansion there.
struct Middle {
    x: Study<DoubleDouble>,
    border: BorderedSystem,
    expansion: CurveExpansion,
}

impl Middle {
    /// A point with the terms that `m` roots need.
    fn at(system: &LegSystem, x: &Study<DoubleDouble>, m: usize) -> Result<Self, WhyUncertified> {
        let border = BorderedSystem::at(system, &x.rounded()).ok_or(WhyUncertified::SingularJacobian)?;
        let expansion = CurveExpansion::of(system, &border, x.patch, m - 1);
        Ok(Self { x: *x, border, expansion })
    }

    fn moved(x: &mut Study<DoubleDouble>, step: &[Complex64; N]) {
        for (k, step) in step.iter().enumerate() {
            let j = coordinate(x.patch, k);
            x.re[j] = x.re[j] + step.re.into();
            x.im[j] = x.im[j] + step.im.into();
        }
    }

    /// The point of the curve at which the term of order `m - 1` vanishes, by Newton's method on this and on the
    /// equations. It is an approximation without a proof.
    fn of(system: &LegSystem, start: &Study<DoubleDouble>, m: usize) -> Result<Self, WhyUncertified> {
        let mut x = *start;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let Self { border, expansion, .. } = Self::at(system, &x, m)?;
            let f = values_at(system, &x);
            // mu(t) = .. + mu_(m-1) t^(m-1) + mu_m t^m is without the first about -mu_(m-1) / (m mu_m)
            let t = -expansion.mu(m - 1) / (expansion.mu(m) * m as f64);
            let along = expansion.at(t);
            let step: [Complex64; N] = std::array::from_fn(|k| {
                along[k] - (0..N).map(|i| border.y[(k, i)] * f[i]).sum::<Complex64>()
            });
            let length = step.iter().map(|z| z.norm()).fold(0.0, largest);
            if !(length <= REACH) {
                return Err(WhyUncertified::Inaccurate { step: length });
            }
            Self::moved(&mut x, &step);
            let (to, from) = (x.rounded(), start.rounded());
            let moved =
                (0..8).map(|k| (to.re[k] - from.re[k]).hypot(to.im[k] - from.im[k])).fold(0.0, largest);
            let size = (0..8).map(|k| to.re[k].hypot(to.im[k])).fold(1.0, largest);
            if !(moved <= REACH * size) {
                return Err(WhyUncertified::Inaccurate { step: moved });
            }
            // settled: rounding, or no longer shrinking
            if length <= f64::EPSILON * size || (length < 1e-9 * size && length > 0.5 * last) {
                break;
            }
            last = length;
        }
        Self::at(system, &x, m)
    }
}

/// The bounds of the Newton map, for all rows and for the last.
struct MapBounds {
    eta: f64,
    eta_last: f64,
    kappa: f64,
    kappa_last: f64,
    beta: f64,
    beta_last: f64,
    /// An upper bound of `|l|_1`.
    row: f64,
}

fn bounds(system: &LegSystem, x: &Study<DoubleDouble>, border: &BorderedSystem) -> MapBounds {
    let hi = x.rounded();
    let values = system.values(&hi);
    let f = values_at(system, x);
    let (rounding, width) = system.value_bounds(&hi, &values, DoubleDouble::UNIT);
    let f_error: [f64; N] = std::array::from_fn(|i| rounding[i] + width[i] + 17.0 * U * modulus(f[i]));
    let tail = (0..8).map(|k| x.re[k].lo().abs() + x.im[k].lo().abs()).fold(0.0, f64::max) * UP;
    let up = |bound: f64| (bound + TINY) * UP;
    let mut out = MapBounds {
        eta: 0.0,
        eta_last: 0.0,
        kappa: 0.0,
        kappa_last: 0.0,
        beta: 0.0,
        beta_last: 0.0,
        row: up((0..N).map(|k| modulus(border.b[(7, k)])).sum()),
    };
    let row_size: [f64; 8] = std::array::from_fn(|i| (0..8).map(|l| modulus(border.b[(i, l)])).sum());
    for k in 0..8 {
        let row: [Complex64; 8] = std::array::from_fn(|i| border.y[(k, i)]);
        let weights: [f64; N] = std::array::from_fn(|i| modulus(row[i]));
        let (mut y_re, mut y_im) = ([0.0; 8], [0.0; 8]);
        for i in 0..N {
            (y_re[i], y_im[i]) = (row[i].re, row[i].im);
        }
        let mut defect = 0.0;
        for l in 0..8 {
            let product: Complex64 = (0..8).map(|i| row[i] * border.b[(i, l)]).sum();
            defect += modulus(product - if k == l { Complex64::ONE } else { Complex64::ZERO });
        }
        let rounded: f64 = (0..8).map(|i| modulus(row[i]) * row_size[i]).sum();
        let data: f64 = (0..N).map(|i| weights[i] * border.j_error[i]).sum();
        let beta = up(system.second_order_bound(&y_re, &y_im, &weights, x.patch));
        // J was evaluated a tail away from the centre
        let kappa = up(defect + 20.0 * U * (rounded + 1.0) + data + 2.0 * beta * tail);
        let step: Complex64 = (0..N).map(|i| row[i] * f[i]).sum();
        let eta = up(modulus(step) + (0..N).map(|i| weights[i] * f_error[i]).sum::<f64>());
        out.kappa = largest(out.kappa, kappa);
        out.beta = largest(out.beta, beta);
        out.eta = largest(out.eta, eta);
        if k == 7 {
            (out.kappa_last, out.beta_last, out.eta_last) = (kappa, beta, eta);
        }
    }
    out
}

/// A `rho` that proves the roots.
struct ProvedDisc {
    rho: f64,
    /// Radius of the ball about the centre that holds them.
    radius: f64,
    /// Radius of a ball that holds no others.
    uniqueness_radius: f64,
    dominance: f64,
}

/// The conditions of the module's text for `m` roots and one `rho`.
fn disc(b: &MapBounds, e: &CurveExpansion, m: usize, rho: f64) -> Option<ProvedDisc> {
    let (order, all) = (e.order, 2 * e.order);
    let whole = |z: &[Complex64; 8]| z.iter().map(|z| modulus(*z)).fold(0.0, largest);
    let own = |z: &[Complex64; 8]| z[..N].iter().map(|z| modulus(*z)).fold(0.0, largest);
    let last = |z: &[Complex64; 8]| modulus(z[7]);
    let noise =
        |errors: &[f64]| errors.iter().zip(1..).map(|(e, n): (&f64, i32)| e * rho.powi(n)).sum::<f64>() * UP;
    let (h, z) = (e.size(1..=order, rho, own), e.size(1..=order, rho, whole));
    let curve = b.eta + b.kappa * z + noise(&e.error) + e.size(order + 1..=all, rho, whole);
    // a little more than the map needs; the proof is the checks below
    let r = 2.5 * curve;
    let inside = (curve + b.kappa * r + b.beta * (2.0 * h * r + r * r)) * UP * UP <= r;
    let contracts = (b.kappa + 2.0 * b.beta * (h + r)) * UP < 1.0;
    let others = e.size(1..=m - 1, rho, last) + e.size(m + 1..=all, rho, last);
    let rest =
        b.eta_last + b.kappa_last * (z + r) + noise(&e.last_error) + b.beta_last * (2.0 * h * r + r * r);
    let main = e.mu(m).norm() * (2.0 - UP) * power(rho, m);
    let dominance = (others + rest) * UP * UP / main * UP;
    if !(inside && contracts && main > TINY && dominance < 1.0) {
        return None;
    }
    // the widest ball about the polynomial in which there is one fixed point
    let wide = ((1.0 - b.kappa) / (2.0 * b.beta) - h) * 0.99;
    let free = if e.size(1..=order, rho, last) <= wide { (rho / b.row).min(wide - h) } else { 0.0 };
    let radius = (h + r) * UP;
    Some(ProvedDisc { rho, radius, uniqueness_radius: (free * (2.0 - UP)).max(0.0), dominance })
}

/// The smallest `rho` that proves `m` roots, with the largest ball that the larger ones prove free of others.
fn smallest_disc(b: &MapBounds, e: &CurveExpansion, m: usize) -> Option<ProvedDisc> {
    let tame = |x: f64| x < 2f64.powi(100);
    let regular = b.kappa < 0.5 && tame(b.beta) && e.terms.iter().flatten().all(|z| tame(modulus(*z)));
    if !regular {
        return None;
    }
    let at = |exponent: i32| disc(b, e, m, 2f64.powi(exponent));
    let smallest = (RADII[0]..=RADII[1]).find_map(at)?;
    let largest = (RADII[0]..=RADII[1]).rev().find_map(at)?;
    Some(ProvedDisc {
        uniqueness_radius: largest.uniqueness_radius.max(smallest.uniqueness_radius),
        ..smallest
    })
}

/// Decides whether exactly `m` roots lie about the middle.
fn prove(
    system: &LegSystem,
    middle: &Middle,
    m: usize,
) -> Result<(ComplexPose, ClusterCertificate), WhyUncertified> {
    let (x, unit) = (&middle.x, system.unit());
    let b = bounds(system, x, &middle.border);
    let more = || {
        let wider = CurveExpansion::of(system, &middle.border, x.patch, m + 1);
        smallest_disc(&b, &wider, m)
    };
    let failure = WhyUncertified::IllConditioned { defect: b.kappa };
    let disc = smallest_disc(&b, &middle.expansion, m).or_else(more).ok_or(failure)?;
    let hi = x.rounded();
    let centre: [Complex64; 8] = std::array::from_fn(|j| Complex64::new(hi.re[j], hi.im[j]));
    let low: [Complex64; 8] = std::array::from_fn(|j| Complex64::new(x.re[j].lo(), x.im[j].lo()));
    let enclosure = enclose_pose_widely(&centre, &low, x.patch, disc.radius, unit)
        .ok_or(WhyUncertified::RotationUndefined)?;
    let imaginary = hi.im.iter().fold(0.0_f64, |m, y| m.max(y.abs()));
    let reality =
        if imaginary * (2.0 - UP) > disc.radius { ProvedReality::NonReal } else { ProvedReality::Undecided };
    let certificate = ClusterCertificate {
        centre,
        low,
        patch: x.patch,
        unit,
        multiplicity: m,
        radius: disc.radius,
        uniqueness_radius: disc.uniqueness_radius,
        reach: disc.rho,
        dominance: disc.dominance,
        reality,
        enclosure,
    };
    Ok((rounded_pose(x, unit), certificate))
}

/// The points about which two roots may lie beside a third: where the slope of `mu` vanishes about its point of
/// inflection.
fn flat_points(system: &LegSystem, inflection: &Middle) -> Vec<Middle> {
    let e = &inflection.expansion;
    let t = (-e.mu(1) / (e.mu(3) * 3.0)).sqrt();
    let beside = |t: Complex64| {
        let mut x = inflection.x;
        Middle::moved(&mut x, &e.at(t));
        Middle::of(system, &x, 2).ok()
    };
    [t, -t].into_iter().filter(|t| t.norm() <= REACH).filter_map(beside).collect()
}

/// The middle of a cluster, rounded, with its proof.
pub(crate) type ProvedCluster = (ComplexPose, ClusterCertificate);

/// Clusters of at most `most` roots that are proved to lie near the pose, in ascending order. An error says why there
/// is none of a size.
pub(super) fn clusters_near<'a>(
    system: &'a LegSystem,
    pose: &ComplexPose,
    most: usize,
) -> Result<impl Iterator<Item = Result<ProvedCluster, WhyUncertified>> + use<'a>, WhyUncertified> {
    let start = study_of(pose, system.unit())?;
    let (mut isotropy, mut size) = (Complex64::ZERO, 0.0);
    for k in 0..4 {
        let e = Complex64::new(start.re[k], start.im[k]);
        isotropy += e * e;
        size += e.norm_sqr();
    }
    if !(isotropy.norm() > FAR * size) {
        return Err(WhyUncertified::RotationUndefined);
    }
    let start = start.lifted();
    let plain = (2..=MOST).map(move |m| (m, m));
    // of three roots that are close two may be closer
    let attempts = std::iter::once((2, 2)).chain(std::iter::once((3, 2))).chain(plain.skip(1));
    Ok(attempts.take_while(move |(m, _)| *m <= most).map(move |(m, expected)| {
        let middle = Middle::of(system, &start, m)?;
        if m == expected {
            return prove(system, &middle, m);
        }
        let pair = flat_points(system, &middle).iter().find_map(|flat| prove(system, flat, expected).ok());
        pair.ok_or(WhyUncertified::SingularJacobian)
    }))
}

#[cfg(test)]
mod tests;
