//! Two roots in one ball, counted with multiplicity: what can be proved about a double pose, and about two poses too close to be told apart.
//!
//! Where the Jacobian `J` at the centre `c` has one small singular value, with `w` near the direction that its image lacks and `l` near the row that its kernel
//! needs, the bordered equations in `z = (h, mu)`,
//!
//! ```text
//! F(c + h) - mu w = 0,    l.h = t,        B = [ J  -w ; l  0 ],
//! ```
//!
//! are regular although `F` is not (Keller 1977; Griewank and Reddien 1984). Let `Y` be an approximate inverse of `B`, `(v, nu)` its last column, `y` its last row
//! without its last entry, and `z = t (v, nu) + zeta`, `zeta = (k, m)`. The simplified Newton map in `zeta`,
//!
//! ```text
//! T(zeta) = (I - Y B)(zeta + t (v, nu)) - Y (F(c) + Q(t v + k, t v + k), 0),
//! ```
//!
//! has the bounds `eta >= |Y (F(c), 0)|`, `kappa >= |I - Y B|`, `beta >= sup |Y (Q(h, k), 0)|` over unit `h`, `k` (max norm). With `V = |v|`, `Z = |(v, nu)|`:
//!
//! 1. If `kappa (R + rho Z) + eta + beta (rho V + R)^2 <= R` and `kappa + 2 beta (rho V + R) < 1`, then for every complex `t` with `|t| <= rho` there is exactly one fixed point with
//!    `|zeta| <= R`, and it is analytic in `t`: `h(t)`, `mu(t)`. `kappa < 1` makes `Y` regular.
//! 2. The bordered equations with `t` as a further unknown have a regular Jacobian by `(h, mu)` there, hence their zeros near `(h(t), mu(t), t)` are this curve, and the local ring of `F` at `c + h(t_0)`, where
//!    `mu(t_0) = 0`, is that of `mu` at `t_0`: the multiplicity of the root is the order of the zero (Lyapunov-Schmidt reduction).
//! 3. The last row of the fixed-point equation is `mu(t) = -t^2 y.Q(v, v) + E(t)` with
//!    `|E| <= rho |nu| + kappa_8 (R + rho Z) + |y.F(c)| + beta_8 (2 rho V R + R^2)`, the index 8 standing for that row. If `|y.Q(v, v)| rho^2` is larger, `mu` has exactly two zeros with
//!    `|t| < rho` by Rouche's theorem: two simple roots or one double root within `rho V + R` of `c`, for every choice of the data.
//!
//! **Rounding** as in `krawczyk.rs`; a row of `Y B` is a sum of at most 16 products in each part, below `20 u sum |Y|_1 |B|_1`. `Q(v, v)` is `F` at `v`, which is homogeneous, with the bounds of the
//! `system` module there.

use nalgebra::SMatrix;
use num_complex::Complex64;

use super::certificate::{PoseEnclosure, ProvedReality, WhyUncertified};
use super::coordinates::{enclose_pose_widely, rounded_pose, study_of};
use super::krawczyk::largest;
use super::system::{LegSystem, N, RealScalar, Study, U};
use crate::geom::ComplexPose;
use crate::num::ball::{TINY, UP};
use crate::num::double_double::DoubleDouble;
use crate::num::small::bounded_svd;

/// Newton steps towards the point of the curve `h(t)` at which `mu` is flat.
const STEPS: usize = 12;
/// How far these may lead, in coordinates of order one: means of the ends of paths are double poses to about six digits.
const REACH: f64 = 1e-3;
/// The radii `rho` that are tried, from below.
const RADII: [i32; 2] = [-48, -4];
/// `|e.e| / |e|^2` below which nothing is tried: far out the enclosures of `R` and `p` are wide.
const FAR: f64 = 1.0 / 64.0;

type BorderedMatrix = SMatrix<Complex64, 8, 8>;

/// Proof that exactly two roots, counted with multiplicity, lie near a point: two simple ones or a double one.
///
/// Coordinates are those of a [`Certificate`](super::Certificate). For every choice of the data within their radii two roots lie within
/// [`radius`](Self::radius) of the centre [`centre`](Self::centre) `+` [`low`](Self::low), on the curve of the text of the module.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleCertificate {
    centre: [Complex64; 8],
    low: [Complex64; 8],
    patch: usize,
    unit: f64,
    radius: f64,
    reach: f64,
    dominance: f64,
    reality: ProvedReality,
    enclosure: PoseEnclosure,
}

impl DoubleCertificate {
    /// The doubles nearest to the centre, `g` divided by [`unit`](Self::unit).
    #[must_use]
    pub fn centre(&self) -> &[Complex64; 8] {
        &self.centre
    }

    /// What these leave of the centre.
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

    /// Both roots are at most this far from the centre.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Radius of the disc of the parameter `t` in which `mu` has two zeros.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Bound of `|E| / (|y.Q(v, v)| rho^2)`, below 1.
    #[must_use]
    pub fn dominance(&self) -> f64 {
        self.dominance
    }

    /// [`NonReal`](ProvedReality::NonReal) when neither root is real; whether two close roots are real is not decided.
    #[must_use]
    pub fn reality(&self) -> ProvedReality {
        self.reality
    }

    /// Where `R` and `p` of both roots are.
    #[must_use]
    pub fn enclosure(&self) -> &PoseEnclosure {
        &self.enclosure
    }

    /// The nearest doubles of the centre with `g` in design units.
    pub(crate) fn point(&self) -> [Complex64; 8] {
        std::array::from_fn(|k| if k < 4 { self.centre[k] } else { self.centre[k] * self.unit })
    }
}

/// The bordered equations at a centre: their Jacobian, its approximate inverse and what bounds the error of the former.
struct BorderedSystem {
    b: BorderedMatrix,
    y: BorderedMatrix,
    /// Bounds of the error of a row of `J`, width of the data included.
    j_error: [f64; N],
}

fn modulus(z: Complex64) -> f64 {
    z.re.abs() + z.im.abs()
}

/// Where column `k` of the Jacobian stands among the coordinates.
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
        // real data have real singular vectors up to a phase; with the phase the curve of a real centre would not be its own conjugate
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

    /// `v` as a point of the coordinates.
    fn direction(&self, patch: usize) -> Study<f64> {
        let mut v = Study { re: [0.0; 8], im: [0.0; 8], patch };
        for k in 0..N {
            let z = self.y[(k, 7)];
            (v.re[coordinate(patch, k)], v.im[coordinate(patch, k)]) = (z.re, z.im);
        }
        v
    }

    /// `y.f` for a vector of seven.
    fn last_row(&self, f: &[Complex64; N]) -> Complex64 {
        (0..N).map(|i| self.y[(7, i)] * f[i]).sum()
    }
}

fn complex(re: &[f64; N], im: &[f64; N]) -> [Complex64; N] {
    std::array::from_fn(|i| Complex64::new(re[i], im[i]))
}

/// The point of the curve at which `mu` is flat, by Newton's method on both conditions; an approximation, nothing is proved of it.
fn flat_point(system: &LegSystem, start: &Study<f64>) -> Result<Study<DoubleDouble>, WhyUncertified> {
    let mut x = start.lifted();
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let border = BorderedSystem::at(system, &x.rounded()).ok_or(WhyUncertified::SingularJacobian)?;
        let f = system.values(&x);
        let f = complex(&f.f_re.map(RealScalar::rounded), &f.f_im.map(RealScalar::rounded));
        let v = border.direction(x.patch);
        let second = system.values(&v);
        let bend = border.last_row(&complex(&second.f_re, &second.f_im));
        // mu(t) = .. + nu t - bend t^2 is flat at nu / (2 bend)
        let t = border.y[(7, 7)] / (bend * 2.0);
        let mut length = 0.0;
        for k in 0..N {
            let along: Complex64 = (0..N).map(|i| border.y[(k, i)] * f[i]).sum();
            let step = border.y[(k, 7)] * t - along;
            let j = coordinate(x.patch, k);
            x.re[j] = x.re[j] + step.re.into();
            x.im[j] = x.im[j] + step.im.into();
            length = largest(length, step.norm());
        }
        let moved = (0..8)
            .map(|k| (x.re[k].rounded() - start.re[k]).hypot(x.im[k].rounded() - start.im[k]))
            .fold(0.0, largest);
        let size = (0..8).map(|k| x.re[k].rounded().hypot(x.im[k].rounded())).fold(1.0, largest);
        if !(moved <= REACH * size) {
            return Err(WhyUncertified::Inaccurate { step: moved });
        }
        // settled: rounding, or no longer shrinking
        if length <= f64::EPSILON * size || (length < 1e-9 * size && length > 0.5 * last) {
            break;
        }
        last = length;
    }
    Ok(x)
}

/// The bounds of the module's text.
struct TwoRootBounds {
    eta: f64,
    eta_last: f64,
    kappa: f64,
    kappa_last: f64,
    beta: f64,
    beta_last: f64,
    /// `V`, `Z`, `|nu|`.
    v: f64,
    z: f64,
    nu: f64,
    /// Below `|y.Q(v, v)|`.
    bend: f64,
}

fn bounds(system: &LegSystem, x: &Study<DoubleDouble>) -> Option<TwoRootBounds> {
    let hi = x.rounded();
    let border = BorderedSystem::at(system, &hi)?;
    let values = system.values(&hi);
    let precise = system.values(x);
    let f = complex(&precise.f_re.map(RealScalar::rounded), &precise.f_im.map(RealScalar::rounded));
    let (rounding, width) = system.value_bounds(&hi, &values, DoubleDouble::UNIT);
    let f_error: [f64; N] = std::array::from_fn(|i| rounding[i] + width[i] + 17.0 * U * modulus(f[i]));
    let tail = (0..8).map(|k| x.re[k].lo().abs() + x.im[k].lo().abs()).fold(0.0, f64::max) * UP;
    let up = |bound: f64| (bound + TINY) * UP;
    let mut out = TwoRootBounds {
        eta: 0.0,
        eta_last: 0.0,
        kappa: 0.0,
        kappa_last: 0.0,
        beta: 0.0,
        beta_last: 0.0,
        v: 0.0,
        z: 0.0,
        nu: up(modulus(border.y[(7, 7)])),
        bend: 0.0,
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
        out.z = largest(out.z, up(modulus(border.y[(k, 7)])));
        if k == 7 {
            (out.kappa_last, out.beta_last, out.eta_last) = (kappa, beta, eta);
        } else {
            out.v = largest(out.v, up(modulus(border.y[(k, 7)])));
        }
    }
    let v = border.direction(x.patch);
    let second = system.values(&v);
    let (rounding, width) = system.value_bounds(&v, &second, U);
    let second = complex(&second.f_re, &second.f_im);
    let bend = border.last_row(&second);
    let error: f64 = (0..N)
        .map(|i| {
            let weight = modulus(border.y[(7, i)]);
            // the squared lengths of these values are the nearest doubles, which value_bounds counts as rounding
            weight * (rounding[i] + width[i] + 17.0 * U * modulus(second[i]))
        })
        .sum();
    out.bend = bend.norm() * (2.0 - UP) - up(error);
    Some(out)
}

/// The smallest `rho` that proves two roots, with the radius of the ball about the centre that holds them and the dominance.
fn smallest_ball(b: &TwoRootBounds) -> Option<(f64, f64, f64)> {
    let regular = b.kappa < 0.5 && b.beta < 2f64.powi(200) && b.bend > 0.0 && b.bend < 2f64.powi(200);
    if !regular {
        return None;
    }
    (RADII[0]..=RADII[1]).find_map(|exponent| {
        let rho = 2f64.powi(exponent);
        // a little more than what the map needs; the proof is the checks below
        let curve = b.eta + b.kappa * rho * b.z + b.beta * (rho * b.v).powi(2);
        let r = 2.5 * curve;
        let reach = (rho * b.v + r) * UP;
        let inside = (b.kappa * (r + rho * b.z) + b.eta + b.beta * reach * reach) * UP * UP <= r;
        let contracts = (b.kappa + 2.0 * b.beta * reach) * UP < 1.0;
        let rest = rho * b.nu
            + b.kappa_last * (r + rho * b.z)
            + b.eta_last
            + b.beta_last * (2.0 * rho * b.v * r + r * r);
        let dominance = rest * UP * UP / (b.bend * rho * rho) * UP;
        (inside && contracts && dominance < 1.0).then_some((rho, reach, dominance))
    })
}

/// Decides whether exactly two roots, counted with multiplicity, lie near the pose; the pose in the answer is the middle between them.
pub(super) fn two_roots_near(
    system: &LegSystem,
    pose: &ComplexPose,
) -> Result<(ComplexPose, DoubleCertificate), WhyUncertified> {
    let unit = system.unit();
    let start = study_of(pose, unit)?;
    let (mut isotropy, mut size) = (Complex64::ZERO, 0.0);
    for k in 0..4 {
        let e = Complex64::new(start.re[k], start.im[k]);
        isotropy += e * e;
        size += e.norm_sqr();
    }
    if !(isotropy.norm() > FAR * size) {
        return Err(WhyUncertified::RotationUndefined);
    }
    let x = flat_point(system, &start)?;
    let b = bounds(system, &x).ok_or(WhyUncertified::SingularJacobian)?;
    let failure = WhyUncertified::IllConditioned { defect: b.kappa };
    let (reach, radius, dominance) = smallest_ball(&b).ok_or(failure)?;
    let hi = x.rounded();
    let centre: [Complex64; 8] = std::array::from_fn(|j| Complex64::new(hi.re[j], hi.im[j]));
    let low: [Complex64; 8] = std::array::from_fn(|j| Complex64::new(x.re[j].lo(), x.im[j].lo()));
    let enclosure =
        enclose_pose_widely(&centre, &low, x.patch, radius, unit).ok_or(WhyUncertified::RotationUndefined)?;
    let imaginary = hi.im.iter().fold(0.0_f64, |m, y| m.max(y.abs()));
    let reality =
        if imaginary * (2.0 - UP) > radius { ProvedReality::NonReal } else { ProvedReality::Undecided };
    let certificate =
        DoubleCertificate { centre, low, patch: x.patch, unit, radius, reach, dominance, reality, enclosure };
    Ok((rounded_pose(&x, unit), certificate))
}

#[cfg(test)]
mod tests;
