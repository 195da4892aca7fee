//! Two closures in two squared distances, and Krawczyk's test for them, eight centres at once.
//!
//! **A closure** is a condition on two squared distances, with coefficients enclosed. Over a triangle `A, B, C` two apexes are given by their squared distances from the corners, `U` by `(x, u_B, u_C)` and `V` by
//! `(v_A, v_B, y)`, and shall be at squared distance `d`. With the origin in `A`, `b = B - A`, `c = C - A`, the products
//! `U.b = (x + beta)/2`, `U.c = (x + gamma)/2`, `V.b = m`, `V.c = (kappa - y)/2` are known, and so are, times `D = |b x c|^2`,
//!
//! ```text
//! D U_h^2 = hu(x),   D V_h^2 = hv(y),   D U_h V_h = w(x, y)
//! ```
//!
//! for the heights `U_h`, `V_h` above the plane. `F = w^2 - hu hv` is a constant times the Cayley-Menger determinant of the five points.
//!
//! **The test.** In the norm `|h| = max(|h_x| / sigma_x, |h_y| / sigma_y)`, with `q_i` half a bound of the second derivative of `F_i` in that norm over
//! the ball of radius [`REACH`],
//!
//! ```text
//! |Y F(c)| <= eta,   |I - Y J(c)| <= kappa,   beta = max_k sum_i |Y_ki| q_i / sigma_k
//! ```
//!
//! take the places of the numbers of the same names in the theorem of `docs/theory/certificates.md`: the remainder `R(h)` of `F(c) + J h` has
//! `|R_i(h)| <= q_i |h|^2` and `|R_i(h) - R_i(k)| <= q_i (|h| + |k|) |h - k|`, by the mean of the derivative along the way.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::arithmetic::{Discs, Reals, Triangle, sizes};
use crate::num::ball::{Real, UP};
use crate::num::batch::{ComplexBatch, LANES};

/// Coefficients of `w[i][j] x^i y^j`, `hu[i] x^i`, `hv[j] y^j`.
#[derive(Debug, Clone)]
pub(super) struct ClosureCoefficients {
    pub(super) w: [[Real; 2]; 2],
    pub(super) hu: [Real; 3],
    pub(super) hv: [Real; 3],
}

/// `F` and its derivatives at the points of the discs, and bounds of its second derivatives.
pub(super) struct Values {
    pub(super) f: Discs,
    pub(super) fx: Discs,
    pub(super) fy: Discs,
}

/// Bounds of `|F_xx|`, `|F_xy|`, `|F_yy|`.
pub(super) struct Curvature {
    pub(super) xx: Reals,
    pub(super) xy: Reals,
    pub(super) yy: Reals,
}

impl ClosureCoefficients {
    /// `u = [u_B, u_C]`, `v = [v_A, v_B]`.
    #[inline(always)]
    pub(super) fn new(t: &Triangle, u: [Real; 2], v: [Real; 2], d: Real) -> Self {
        let (bb, bc, cc, area) = (t.bb, t.bc, t.cc, t.area);
        let half = |z: Real| z.scaled(0.5);
        let quarter = |z: Real| z.scaled(0.25);
        let (beta, gamma, kappa) = (bb - u[0], cc - u[1], v[0] + cc);
        let m = half(v[0] + bb - v[1]);
        let along = cc * beta - bc * gamma;
        let across = bb * gamma - bc * beta;
        let hu = [-quarter(along * beta + across * gamma), area - half(along + across), -quarter(t.opposite)];
        let hv = [
            area * v[0] - cc * m * m + bc * m * kappa - quarter(bb * kappa * kappa),
            half(bb * kappa) - bc * m,
            -quarter(bb),
        ];
        let w = [
            [half(area * (v[0] - d) - m * along) - quarter(kappa * across), quarter(across)],
            [half(area - m * (cc - bc)) - quarter(kappa * (bb - bc)), quarter(bb - bc)],
        ];
        Self { w, hu, hv }
    }

    #[inline(always)]
    pub(super) fn values(&self, x: Discs, y: Discs) -> Values {
        let [[w00, w01], [w10, w11]] = self.w;
        let wx = y.times(w11).plus(w10);
        let w = wx * x + y.times(w01).plus(w00);
        let wy = x.times(w11).plus(w01);
        let (hu, hv) = (quadratic(&self.hu, x), quadratic(&self.hv, y));
        let twice = w + w;
        Values {
            f: w * w - hu * hv,
            fx: twice * wx - derivative(&self.hu, x) * hv,
            fy: twice * wy - hu * derivative(&self.hv, y),
        }
    }

    /// Over all `|x| <= big_x`, `|y| <= big_y`.
    #[inline(always)]
    pub(super) fn curvature(&self, x: Reals, y: Reals) -> Curvature {
        let w = self.w.map(|row| row.map(|z| z.magnitude()));
        let (u, v) = (self.hu.map(|z| z.magnitude()), self.hv.map(|z| z.magnitude()));
        let wx = y.times(w[1][1]).plus(w[1][0]);
        let wy = x.times(w[1][1]).plus(w[0][1]);
        let value = wx * x + y.times(w[0][1]).plus(w[0][0]);
        let (hu, hv) = (bound(&u, x), bound(&v, y));
        let (du, dv) = (x.times(2.0 * u[2]).plus(u[1]), y.times(2.0 * v[2]).plus(v[1]));
        Curvature {
            xx: ((wx * wx).times(2.0) + hv.times(2.0 * u[2])).up(),
            xy: ((wx * wy + value.times(w[1][1])).times(2.0) + du * dv).up(),
            yy: ((wy * wy).times(2.0) + hu.times(2.0 * v[2])).up(),
        }
    }
}

#[inline(always)]
fn quadratic(c: &[Real; 3], z: Discs) -> Discs {
    (z.times(c[2]).plus(c[1]) * z).plus(c[0])
}

#[inline(always)]
fn derivative(c: &[Real; 3], z: Discs) -> Discs {
    z.times(c[2].scaled(2.0)).plus(c[1])
}

#[inline(always)]
fn bound(c: &[f64; 3], z: Reals) -> Reals {
    (z.times(c[2]).plus(c[1]) * z).plus(c[0])
}

/// Radius, in the weighted norm, of the ball over which second derivatives are bounded.
const REACH: f64 = 1.0 / 256.0;

/// Discs that hold exactly one root each, with the proof's numbers lane by lane; radii that prove nothing are NaN.
pub(super) struct RootDiscs {
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
fn weight(z: &ComplexBatch) -> Reals {
    sizes(z).map(|x| if x > 1.0 { x } else { 1.0 })
}

/// `1 / x` up to one rounding, which [`UP`] takes up.
#[inline(always)]
fn inverse(x: Reals) -> Reals {
    x.map(f64::recip)
}

/// Decides for each lane whether some disc about its centre holds exactly one zero of both closures.
#[inline(always)]
pub(super) fn one_root_about(
    closures: &[ClosureCoefficients; 2],
    x: &ComplexBatch,
    y: &ComplexBatch,
) -> RootDiscs {
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
            let defect = product.plus(Real::point(-identity)).magnitude();
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
    RootDiscs { weights, radius, uniqueness, step: eta, lipschitz, condition }
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
