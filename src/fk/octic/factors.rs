//! The closures in factored form, which keeps more digits than their expanded coefficients.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use nalgebra::Vector3;

use super::Biquadratic;
use num::batch::ComplexBatch;

/// Products of the sides `b = B - A`, `c = C - A` of a triangle, and `|b x c|^2`.
#[derive(Debug, Clone)]
pub(super) struct Gram {
    bb: f64,
    bc: f64,
    pub(super) cc: f64,
    opposite: f64,
    area: f64,
}

impl Gram {
    pub(super) fn of(p: [&Vector3<f64>; 3]) -> Self {
        let (b, c) = (p[1] - p[0], p[2] - p[0]);
        Self {
            bb: b.norm_squared(),
            bc: b.dot(&c),
            cc: c.norm_squared(),
            opposite: (b - c).norm_squared(),
            area: b.cross(&c).norm_squared(),
        }
    }
}

/// `w^2 - hu hv` over a triangle `A, B, C`, with apex `U` at squared distances `x, u_B, u_C`, apex `V` at `v_A, v_B, y`
/// and `d` between them. With `D = |b x c|^2` and heights `U_h`, `V_h`: `w = D U_h V_h` is bilinear, `hu = D U_h^2` is
/// quadratic in `x`, and `hv = D V_h^2` in `y`.
pub(super) struct Factors {
    w: [[f64; 2]; 2],
    hu: [f64; 3],
    hv: [f64; 3],
}

impl Factors {
    /// From `U.b = (x + beta)/2`, `U.c = (x + gamma)/2`, `V.b = m`, `V.c = (kappa - y)/2`.
    #[inline(always)]
    pub(super) fn new(t: &Gram, u: [f64; 2], v: [f64; 2], d: f64) -> Self {
        let Gram { bb, bc, cc, opposite, area } = *t;
        let (beta, gamma, kappa) = (bb - u[0], cc - u[1], v[0] + cc);
        let m = 0.5 * (v[0] + bb - v[1]);
        let (along, across) = (cc * beta - bc * gamma, bb * gamma - bc * beta);
        Self {
            w: [
                [0.5 * (area * (v[0] - d) - m * along) - 0.25 * kappa * across, 0.25 * across],
                [0.5 * (area - m * (cc - bc)) - 0.25 * kappa * (bb - bc), 0.25 * (bb - bc)],
            ],
            hu: [-0.25 * (along * beta + across * gamma), area - 0.5 * (along + across), -0.25 * opposite],
            hv: [
                area * v[0] - cc * m * m + bc * m * kappa - 0.25 * bb * kappa * kappa,
                0.5 * bb * kappa - bc * m,
                -0.25 * bb,
            ],
        }
    }

    /// Coefficients of `x^i y^j`.
    #[inline(always)]
    pub(super) fn expanded(&self) -> Biquadratic {
        let (w, mut out) = (&self.w, [[0.0; 3]; 3]);
        for i in 0..3 {
            for j in 0..3 {
                out[i][j] = -self.hu[i] * self.hv[j];
            }
        }
        for (i, j, k, l) in (0..16).map(|n| (n & 1, n >> 1 & 1, n >> 2 & 1, n >> 3 & 1)) {
            out[i + k][j + l] += w[i][j] * w[k][l];
        }
        out
    }

    /// Value and derivatives by `x` and `y` in all lanes.
    #[inline(always)]
    pub(super) fn values(&self, x: ComplexBatch, y: ComplexBatch) -> [ComplexBatch; 3] {
        let [[w00, w01], [w10, w11]] = self.w;
        let wx = y.times(w11).plus(w10);
        let w = wx * x + y.times(w01).plus(w00);
        let wy = x.times(w11).plus(w01);
        let slope_u = x.times(self.hu[2]).plus(self.hu[1]);
        let slope_v = y.times(self.hv[2]).plus(self.hv[1]);
        let hu = (slope_u * x).plus(self.hu[0]);
        let hv = (slope_v * y).plus(self.hv[0]);
        let du = slope_u + x.times(self.hu[2]);
        let dv = slope_v + y.times(self.hv[2]);
        let twice = w.times(2.0);
        [w * w - hu * hv, twice * wx - du * hv, twice * wy - hu * dv]
    }
}
