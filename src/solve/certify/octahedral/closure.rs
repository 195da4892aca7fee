//! One closure: a condition on two squared distances, with coefficients enclosed.
//!
//! Over a triangle `A, B, C` two apexes are given by their squared distances from the corners, `U` by `(x, u_B, u_C)` and `V` by
//! `(v_A, v_B, y)`, and shall be at squared distance `d`. With the origin in `A`, `b = B - A`, `c = C - A`, the products
//! `U.b = (x + beta)/2`, `U.c = (x + gamma)/2`, `V.b = m`, `V.c = (kappa - y)/2` are known, and so are, times `D = |b x c|^2`,
//!
//! ```text
//! D U_h^2 = hu(x),   D V_h^2 = hv(y),   D U_h V_h = w(x, y)
//! ```
//!
//! for the heights `U_h`, `V_h` above the plane. `F = w^2 - hu hv` is a constant times the Cayley-Menger determinant of the five points.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::ball::{Ball, Triangle};
use super::lanes::{Discs, Reals};

/// Coefficients of `w[i][j] x^i y^j`, `hu[i] x^i`, `hv[j] y^j`.
#[derive(Debug, Clone)]
pub(super) struct Closure {
    pub(super) w: [[Ball; 2]; 2],
    pub(super) hu: [Ball; 3],
    pub(super) hv: [Ball; 3],
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

impl Closure {
    /// `u = [u_B, u_C]`, `v = [v_A, v_B]`.
    #[inline(always)]
    pub(super) fn new(t: &Triangle, u: [Ball; 2], v: [Ball; 2], d: Ball) -> Self {
        let (bb, bc, cc, area) = (t.bb, t.bc, t.cc, t.area);
        let half = |z: Ball| z.scaled(0.5);
        let quarter = |z: Ball| z.scaled(0.25);
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
        let w = self.w.map(|row| row.map(Ball::magnitude));
        let (u, v) = (self.hu.map(Ball::magnitude), self.hv.map(Ball::magnitude));
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
fn quadratic(c: &[Ball; 3], z: Discs) -> Discs {
    (z.times(c[2]).plus(c[1]) * z).plus(c[0])
}

#[inline(always)]
fn derivative(c: &[Ball; 3], z: Discs) -> Discs {
    z.times(c[2].scaled(2.0)).plus(c[1])
}

#[inline(always)]
fn bound(c: &[f64; 3], z: Reals) -> Reals {
    (z.times(c[2]).plus(c[1]) * z).plus(c[0])
}
