//! Krawczyk's test for the two closures in `(x, y)`, eight centres at once.
//!
//! In the norm `|h| = max(|h_x| / sigma_x, |h_y| / sigma_y)`, with `q_i` half a bound of the second derivative of `F_i` in that norm over
//! the ball of radius [`REACH`],
//!
//! ```text
//! |Y F(c)| <= eta,   |I - Y J(c)| <= kappa,   beta = max_k sum_i |Y_ki| q_i / sigma_k
//! ```
//!
//! take the places of the numbers of the same names in the theorem of `docs/theory/certificates.md`: the remainder `R(h)` of `F(c) + J h` has
//! `|R_i(h)| <= q_i |h|^2` and `|R_i(h) - R_i(k)| <= q_i (|h| + |k|) |h - k|`, by the mean of the derivative along the way.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::closure::{Closure, Curvature};
use super::lanes::{Discs, Reals, sizes};
use crate::num::batch::{Batch, LANES};
use crate::num::disc::UP;

/// Radius, in the weighted norm, of the ball over which second derivatives are bounded.
const REACH: f64 = 1.0 / 256.0;

/// The proof's numbers, lane by lane; radii that prove nothing are NaN.
pub(super) struct Contraction {
    /// `sigma_x`, `sigma_y`.
    pub(super) weights: [Reals; 2],
    /// The root is at most this far from the centre.
    pub(super) radius: Reals,
    /// There is no other root at most this far from the centre.
    pub(super) uniqueness: Reals,
    /// `|Y F(c)|`.
    pub(super) step: Reals,
    /// Lipschitz constant of the map on the ball of the radius.
    pub(super) lipschitz: Reals,
    /// `|J| |Y|` in the weighted norm, with equations scaled to gradients of size one: no bound, an estimate.
    pub(super) condition: Reals,
}

#[inline(always)]
fn weight(z: &Batch) -> Reals {
    sizes(z).map(|x| if x > 1.0 { x } else { 1.0 })
}

/// `1 / x` up to one rounding, which [`UP`] takes up.
#[inline(always)]
fn inverse(x: Reals) -> Reals {
    x.map(f64::recip)
}

#[inline(always)]
pub(super) fn contract(closures: &[Closure; 2], x: &Batch, y: &Batch) -> Contraction {
    let weights = [weight(x), weight(y)];
    let (px, py) = (Discs::point(*x), Discs::point(*y));
    let [a, b] = [closures[0].values(px, py), closures[1].values(px, py)];
    let (j, f) = ([[a.fx, a.fy], [b.fx, b.fy]], [a.f, b.f]);
    // approximate inverse of the centre's Jacobian
    let det = (j[0][0].c * j[1][1].c - j[0][1].c * j[1][0].c).reciprocal();
    let y_matrix =
        [[j[1][1].c * det, (j[0][1].c * det).times(-1.0)], [(j[1][0].c * det).times(-1.0), j[0][0].c * det]];
    let [sx, sy] = weights;
    let (big_x, big_y) = ((sizes(x) + sx.times(REACH)).up(), (sizes(y) + sy.times(REACH)).up());
    let mut q = [Reals::ZERO; 2];
    for (q, closure) in q.iter_mut().zip(closures) {
        let Curvature { xx, xy, yy } = closure.curvature(big_x, big_y);
        *q = ((xx * sx * sx + yy * sy * sy).times(0.5) + xy * sx * sy).up();
    }
    let mut bounds = [Reals::ZERO; 3];
    let mut norms = [[Reals::ZERO; 2]; 2];
    for k in 0..2 {
        let row = [Discs::point(y_matrix[k][0]), Discs::point(y_matrix[k][1])];
        let unweighted = inverse(weights[k]);
        let eta = (row[0] * f[0] + row[1] * f[1]).magnitude() * unweighted;
        let mut kappa = Reals::ZERO;
        for l in 0..2 {
            let product = row[0] * j[0][l] + row[1] * j[1][l];
            let identity = if k == l { 1.0 } else { 0.0 };
            let defect = product.plus(super::ball::Ball::exact(-identity)).magnitude();
            kappa = kappa + defect * weights[l] * unweighted;
        }
        norms[k] = [sizes(&y_matrix[k][0]) * unweighted, sizes(&y_matrix[k][1]) * unweighted];
        let beta = norms[k][0] * q[0] + norms[k][1] * q[1];
        for (bound, new) in bounds.iter_mut().zip([eta, kappa, beta]) {
            *bound = bound.largest(new);
        }
    }
    let mut gradient = [Reals::ZERO; 2];
    for i in 0..2 {
        gradient[i] = sizes(&j[i][0].c) * sx + sizes(&j[i][1].c) * sy;
    }
    let condition = (norms[0][0] * gradient[0] + norms[0][1] * gradient[1])
        .largest(norms[1][0] * gradient[0] + norms[1][1] * gradient[1]);
    let [eta, kappa, beta] = bounds;
    let (eta, kappa, beta) = (eta.up(), kappa.up(), beta.up());
    let (radius, uniqueness) = radii(eta, kappa, beta);
    let lipschitz = (kappa + (beta * radius).times(2.0)).up();
    Contraction { weights, radius, uniqueness, step: eta, lipschitz, condition }
}

/// Radii of the ball that holds the root and of that in which it is alone, NaN where there is no proof.
#[inline(always)]
fn radii(eta: Reals, kappa: Reals, beta: Reals) -> (Reals, Reals) {
    let (mut radius, mut uniqueness) = (Reals::ZERO, Reals::ZERO);
    for k in 0..LANES {
        let (eta, kappa, beta) = (eta.0[k], kappa.0[k], beta.0[k]);
        let room = 1.0 - kappa;
        let root = (room * room - 4.0 * beta * eta).sqrt();
        // the smaller root of beta r^2 - room r + eta, a little enlarged; the proof is the check below
        let r = 2.0 * eta / (room + root) * (1.0 + 1e-3);
        let inside = (eta + kappa * r + beta * r * r) * UP <= r;
        let contracts = (kappa + 2.0 * beta * r) * UP < 1.0;
        // both balls lie where the second derivatives are bounded
        let wide = room / beta * (1.0 - 1e-9) - r;
        let wide = if wide < REACH { wide } else { REACH };
        let alone = wide > r * (1.0 + 1e-9) && (kappa + beta * (r + wide)) * UP < 1.0;
        let proved = inside && contracts && alone && kappa < 1.0 && r < REACH;
        radius.0[k] = if proved { r } else { f64::NAN };
        uniqueness.0[k] = if proved { wide } else { f64::NAN };
    }
    (radius, uniqueness)
}
