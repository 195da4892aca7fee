//! When a ball about a centre holds exactly one root: the theorem, and the verb that applies it.
//!
//! `F(c + h) = F(c) + J h + Q(h, h)` exactly, so `G(h) = h - Y F(c + h)` satisfies, with
//! `eta >= |Y F(c)|`, `kappa >= |I - Y J|`, `beta >= sup |Y Q(h, k)|` over unit `h`, `k` (max norm),
//!
//! ```text
//! |G(h)| <= eta + kappa r + beta r^2              for |h| <= r,
//! |G(h) - G(k)| <= (kappa + beta |h + k|) |h - k|  because Q(h,h) - Q(k,k) = Q(h + k, h - k).
//! ```
//!
//! 1. If `eta + kappa r + beta r^2 <= r` and `kappa + 2 beta r < 1`, `G` maps the ball of radius `r` into itself and
//!    contracts it: one fixed point `h*`. `kappa < 1` makes `Y` regular, so fixed points are the zeros of `F`.
//! 2. A zero with `|h| <= rho` satisfies `|h - h*| <= (kappa + beta (rho + r)) |h - h*|`, hence equals `h*` as soon
//!    as `kappa + beta (rho + r) < 1`.
//! 3. The Jacobian at `h*` is regular: `|I - Y (J + 2 Q(h*, .))| <= kappa + 2 beta r < 1`.
//!
//! **Rounding.** Moduli are bounded by `|z|_1 = |re| + |im|`. A row of `Y J` or `Y F` is in each part a sum of 14
//! products. With the subtraction from the identity the `|.|_1` of its error is at most
//! `gamma_15 sum |Y|_1 |J|_1 < 16 u sum`. `J` and `F` themselves carry the bounds of the `system` module.

use num_complex::Complex64;

use super::NEAR;
use super::certificate::WhyUncertified;
use super::differences;
use super::inverse::{approximate_inverse, subtract};
use super::octuple;
use super::system::{LegSystem, N, RealScalar, Study, U};
use num::ball::{TINY, UP};
use num::double_double::DoubleDouble;

/// A ball about a centre that holds exactly one root, with the proof's numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct RootBall {
    /// The root is at most this far from the centre.
    pub(super) radius: f64,
    /// The root for the middles of the data is at most this far from the centre.
    pub(super) centre_radius: f64,
    /// There is no other root at most this far from the centre.
    pub(super) uniqueness_radius: f64,
    /// Lipschitz constant of the Newton map on the ball of `radius`.
    pub(super) lipschitz: f64,
    /// `Y F(c)`, computed: the centre less this is a better approximation (zero for the patch).
    pub(super) step: [Complex64; 8],
}

/// The three bounds of the theorem; `eta` is split into the part of the centre and the whole with the width of the
/// data.
#[derive(Debug, Clone, Copy)]
pub(super) struct KrawczykBounds {
    pub(super) eta_centre: f64,
    pub(super) eta: f64,
    pub(super) kappa: f64,
    pub(super) beta: f64,
    pub(super) step: [Complex64; 8],
}

impl KrawczykBounds {
    /// Takes up the rounding of the bounds themselves.
    pub(super) fn rounded_up(self) -> Self {
        let up = |bound: f64| (bound + TINY) * UP;
        Self {
            eta_centre: up(self.eta_centre),
            eta: up(self.eta),
            kappa: up(self.kappa),
            beta: up(self.beta),
            ..self
        }
    }
}

/// Bounds of a row of `Y` times the parts of the data.
fn row_sum(weights: &[f64; N], terms: &[f64; N]) -> f64 {
    weights.iter().zip(terms).map(|(w, t)| w * t).sum()
}

/// The centre: its nearest doubles, and itself when it has digits beyond these.
#[derive(Debug, Clone, Copy)]
pub(super) struct Centre<'a> {
    pub(super) hi: &'a Study<f64>,
    pub(super) full: Option<&'a Study<DoubleDouble>>,
}

impl Centre<'_> {
    /// Largest modulus of the digits beyond the nearest doubles.
    pub(super) fn tail(&self) -> f64 {
        self.full
            .map_or(0.0, |x| (0..8).map(|k| x.re[k].lo().abs() + x.im[k].lo().abs()).fold(0.0, f64::max) * UP)
    }
}

/// Digits with which the equations may be evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Digits {
    /// The digits of the centre: doubles, or values in double-double with an inverse in double. If these do not
    /// suffice, differences of the equations in double-double.
    OfTheCentre,
    /// 256 bits, the inverse of the Jacobian included; for centres in double-double.
    Octuple,
}

/// The bounds on the equations themselves. Values have the digits of the centre, inverse and Jacobian those of doubles.
fn bounds(system: &LegSystem, x: &Centre<'_>) -> Result<KrawczykBounds, WhyUncertified> {
    let values = system.values(x.hi);
    let j = system.jacobian(x.hi, &values);
    let y = approximate_inverse(&j.re, &j.im).ok_or(WhyUncertified::SingularJacobian)?;
    let (f_re, f_im, unit) = match x.full {
        None => (values.f_re, values.f_im, U),
        Some(full) => {
            let f = system.values(full);
            (f.f_re.map(RealScalar::rounded), f.f_im.map(RealScalar::rounded), DoubleDouble::UNIT)
        }
    };
    let (rounding, width) = system.value_bounds(x.hi, &values, unit);
    let tail = x.tail(); // J was evaluated that far from the centre
    let f_error: [f64; N] = std::array::from_fn(|i| rounding[i] + 17.0 * U * (f_re[i].abs() + f_im[i].abs()));
    let j_error: [f64; N] = std::array::from_fn(|i| {
        let row: f64 = (0..8).map(|k| j.re[i][k].abs() + j.im[i][k].abs()).sum();
        j.error[i] + 16.0 * U * row
    });
    let zero = Complex64::ZERO;
    let mut out = KrawczykBounds { eta_centre: 0.0, eta: 0.0, kappa: 0.0, beta: 0.0, step: [zero; 8] };
    for k in 0..N {
        let (y_re, y_im) = (&y.re[k], &y.im[k]);
        let weights: [f64; N] = std::array::from_fn(|i| y_re[i].abs() + y_im[i].abs());
        let (mut d_re, mut d_im) = ([0.0; 8], [0.0; 8]);
        d_re[k] = 1.0;
        let (mut step_re, mut step_im) = (0.0, 0.0);
        for i in 0..N {
            subtract(&mut d_re, &mut d_im, &j.re[i], &j.im[i], y_re[i], y_im[i]);
            step_re += y_re[i] * f_re[i] - y_im[i] * f_im[i];
            step_im += y_re[i] * f_im[i] + y_im[i] * f_re[i];
        }
        out.step[if k == x.hi.patch { 7 } else { k }] = Complex64::new(step_re, step_im);
        let defect: f64 = (0..8).map(|l| d_re[l].abs() + d_im[l].abs()).sum();
        let centre = step_re.abs() + step_im.abs() + row_sum(&weights, &f_error);
        let beta = system.second_order_bound(y_re, y_im, &weights, x.hi.patch);
        out.eta_centre = largest(out.eta_centre, centre);
        out.eta = largest(out.eta, centre + row_sum(&weights, &width));
        out.kappa = largest(out.kappa, defect + row_sum(&weights, &j_error) + 2.0 * beta * tail);
        out.beta = largest(out.beta, beta);
    }
    Ok(out.rounded_up())
}

/// `Y F(c)`, computed with the digits of the centre; a Newton step subtracts it (zero for the patch).
pub(super) fn newton_step(
    system: &LegSystem,
    x: &Study<DoubleDouble>,
) -> Result<[Complex64; 8], WhyUncertified> {
    let hi = x.rounded();
    let j = system.jacobian(&hi, &system.values(&hi));
    let y = approximate_inverse(&j.re, &j.im).ok_or(WhyUncertified::SingularJacobian)?;
    let f = system.values(x);
    let mut step = [Complex64::ZERO; 8];
    for k in 0..N {
        let (mut re, mut im) = (0.0, 0.0);
        for i in 0..N {
            let (y_re, y_im, f_re, f_im) = (y.re[k][i], y.im[k][i], f.f_re[i].rounded(), f.f_im[i].rounded());
            re += y_re * f_re - y_im * f_im;
            im += y_re * f_im + y_im * f_re;
        }
        step[if k == hi.patch { 7 } else { k }] = Complex64::new(re, im);
    }
    Ok(step)
}

/// The larger, or NaN when one is NaN.
pub(super) fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

fn radii(b: &KrawczykBounds) -> Result<RootBall, WhyUncertified> {
    let gap = 1.0 - b.kappa;
    let admissible = gap * gap / (4.0 * b.beta);
    let failure = WhyUncertified::NoContraction { step: b.eta, admissible };
    // the smaller root of beta r^2 - gap r + eta, a little enlarged; the proof is the check below
    let smallest = |eta: f64| {
        let root = (gap * gap - 4.0 * b.beta * eta).sqrt();
        2.0 * eta / (gap + root) * (1.0 + 1e-3)
    };
    let inside = |eta: f64, r: f64| (eta + b.kappa * r + b.beta * r * r) * UP <= r;
    let radius = smallest(b.eta);
    let lipschitz = (b.kappa + 2.0 * b.beta * radius) * UP;
    let contracts = inside(b.eta, radius) && lipschitz < 1.0;
    if !contracts {
        return Err(failure);
    }
    // any radius below gap / beta - radius will do; it exceeds the radius because lipschitz < 1
    let uniqueness_radius = gap / b.beta * (1.0 - 1e-9) - radius;
    let unique = uniqueness_radius > radius * (1.0 + 1e-9)
        && (b.kappa + b.beta * (radius + uniqueness_radius)) * UP < 1.0;
    // the same theorem for one member of the data
    let closer = smallest(b.eta_centre);
    let centre_radius = if closer < radius && inside(b.eta_centre, closer) { closer } else { radius };
    let proof = RootBall { radius, centre_radius, uniqueness_radius, lipschitz, step: b.step };
    if unique { Ok(proof) } else { Err(failure) }
}

/// The theorem: a ball that holds exactly one root, when the bounds prove one and the Newton step at the centre is at
/// most `near`.
pub(super) fn holds_one_root(b: &KrawczykBounds, near: f64) -> Result<RootBall, WhyUncertified> {
    // a NaN fails every one of these; 2^200 keeps products of bounds in range
    let regular = b.kappa < 1.0 && b.beta < 2f64.powi(200);
    let accurate = b.eta_centre <= near;
    match (regular, accurate) {
        (true, true) => radii(b),
        (true, false) => Err(WhyUncertified::Inaccurate { step: b.eta_centre }),
        (false, _) => Err(WhyUncertified::IllConditioned { defect: b.kappa }),
    }
}

/// Decides whether some ball about `x` holds exactly one root, which is at most a Newton step of [`NEAR`] away.
pub(super) fn one_root_about(
    system: &LegSystem,
    x: &Centre<'_>,
    digits: Digits,
) -> Result<RootBall, WhyUncertified> {
    let decide = |bounds: Result<KrawczykBounds, WhyUncertified>| holds_one_root(&bounds?, NEAR);
    match (digits, x.full) {
        (Digits::Octuple, Some(full)) => decide(octuple::bounds(system, full)),
        (Digits::OfTheCentre, Some(full)) => {
            let direct = decide(bounds(system, x));
            direct.or_else(|why| decide(differences::bounds(system, full)).map_err(|_| why))
        }
        (_, None) => decide(bounds(system, x)),
    }
}

#[cfg(test)]
mod tests;
