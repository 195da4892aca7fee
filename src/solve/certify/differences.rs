//! `F_0`, `F_i - F_0`, `F_6` with derivatives and error bounds; see the `apart` module for the formulas and the bounds.

use super::system::{LegSystem, N, Scalar, Study, leg_vector, row_sums};
use crate::num::disc::{TINY, UP};
use crate::num::double_double::DoubleDouble;

const UNIT: f64 = DoubleDouble::UNIT;

/// `d` and `c` of a leg, or differences of those of two.
type Turn<S> = ([S; 3], [S; 3]);

/// `T y`.
fn apply<S: Scalar>(turn: &Turn<S>, y: &[S; 4]) -> [S; 4] {
    let zero = S::from(0.0);
    leg_vector(&turn.0, &turn.1, &[y[0], y[1], y[2], y[3], zero, zero, zero, zero])
}

fn quarter<S: Scalar>(x: &[S; 8], first: usize) -> [S; 4] {
    std::array::from_fn(|k| x[first + k])
}

fn plus<S: Scalar>(x: &[S; 4], y: &[S; 4]) -> [S; 4] {
    std::array::from_fn(|k| x[k] + y[k])
}

/// Real and imaginary part of `x.y`.
fn dot<S: Scalar>(x: &[[S; 4]; 2], y: &[[S; 4]; 2]) -> [S; 2] {
    let part = |a: &[S; 4], b: &[S; 4]| (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
    [part(&x[0], &y[0]) + -part(&x[1], &y[1]), part(&x[0], &y[1]) + part(&x[1], &y[0])]
}

impl LegSystem {
    fn turn<S: Scalar>(&self, i: usize) -> Turn<S> {
        (
            std::array::from_fn(|k| S::sum(self.b[i][k], -self.a[i][k])),
            std::array::from_fn(|k| S::sum(self.b[i][k], self.a[i][k])),
        )
    }

    /// The middle of the squared length, rounded in double.
    fn square<S: Scalar>(&self, i: usize) -> S {
        S::sum(self.s[i], self.s_low[i])
    }

    /// `T_i - T_0`.
    fn gap<S: Scalar>(&self, i: usize) -> Turn<S> {
        let (leg, first) = (self.turn::<S>(i), self.turn::<S>(0));
        let minus = |x: &[S; 3], y: &[S; 3]| std::array::from_fn(|k| x[k] + -y[k]);
        (minus(&leg.0, &first.0), minus(&leg.1, &first.1))
    }

    /// `tau_i`.
    fn gap_size(&self, i: usize) -> f64 {
        let (d, c) = self.gap::<f64>(i);
        // the computed differences are off by roundings of their terms
        let terms: f64 = [0, i].iter().map(|k| self.t[*k]).sum();
        (row_sums(&d, &c).into_iter().fold(0.0, f64::max) + 8.0 * f64::EPSILON * terms) * UP
    }

    /// Values at `x`, real and imaginary parts.
    pub(super) fn values_apart(&self, x: &Study<DoubleDouble>) -> ([DoubleDouble; N], [DoubleDouble; N]) {
        let parts = [&x.re, &x.im];
        let e = parts.map(|x| quarter(x, 0));
        let g = parts.map(|x| quarter(x, 4));
        let first = self.turn::<DoubleDouble>(0);
        let v = [plus(&g[0], &apply(&first, &e[0])), plus(&g[1], &apply(&first, &e[1]))];
        let norm = dot(&e, &e);
        let half = DoubleDouble::from(0.5);
        let mut out = [[DoubleDouble::ZERO; N]; 2];
        for i in 0..6 {
            let (square, s) = if i == 0 {
                (dot(&v, &v), self.square(0))
            } else {
                let gap = self.gap(i);
                let u = [apply(&gap, &e[0]), apply(&gap, &e[1])];
                let w = [0, 1].map(|k| plus(&plus(&v[k], &v[k]), &u[k]));
                (dot(&u, &w), self.square::<DoubleDouble>(i) - self.square(0))
            };
            for k in 0..2 {
                out[k][i] = half * (square[k] - s * norm[k]);
            }
        }
        let study = dot(&e, &g);
        (out[0][6], out[1][6]) = (study[0], study[1]);
        (out[0], out[1])
    }

    /// Bounds of the rounding of [`values_apart`](Self::values_apart), and of the change over the intervals for `s`.
    pub(super) fn value_bounds_apart(&self, x: &Study<f64>) -> ([f64; N], [f64; N]) {
        let (e, g, p) = x.magnitudes();
        let (mut rounding, mut width) = ([0.0; N], [0.0; N]);
        let v = 2.0 * (g + self.t[0] * e); // Euclidean norm of v_0, at most
        let omega = 5.0 * UNIT * (g + self.t[0] * e);
        for i in 0..6 {
            let (u, alpha) = if i == 0 {
                (v, omega)
            } else {
                let tau = self.gap_size(i);
                (2.0 * tau * e, 5.0 * UNIT * tau * e)
            };
            let (w, beta) = if i == 0 { (v, omega) } else { (2.0 * v + u, 3.0 * omega + 2.0 * alpha) };
            let s = if i == 0 { self.s[0].abs() } else { self.s[i].abs() + self.s[0].abs() };
            let own = 5.0 * UNIT * (u * w + s * p);
            rounding[i] = (2.0 * (u * beta + w * alpha + 2.0 * alpha * beta + own) + TINY) * UP;
            let radius = self.s_radius[0] + if i == 0 { 0.0 } else { self.s_radius[i] };
            width[i] = 0.5 * radius * p * UP;
        }
        rounding[6] = (32.0 * UNIT * e * g + TINY) * UP;
        (rounding, width)
    }

    /// The Jacobian, in real and imaginary part; column `patch` holds the gradient by `g_3`, lane 7 is zero.
    pub(super) fn jacobian_apart<S: Scalar>(&self, x: &Study<S>) -> [[[S; 8]; N]; 2] {
        let zero = S::from(0.0);
        let mut parts = [[[zero; 8]; N]; 2];
        for (rows, x) in parts.iter_mut().zip([&x.re, &x.im]) {
            let (e, g) = (quarter(x, 0), quarter(x, 4));
            let first = self.turn::<S>(0);
            let turned = apply(&first, &e);
            let v = plus(&g, &turned);
            let by_e = apply(&first, &v);
            let s = self.square::<S>(0);
            for k in 0..4 {
                rows[0][k] = -by_e[k] - s * e[k];
                rows[0][4 + k] = v[k];
            }
            for i in 1..6 {
                let gap = self.gap::<S>(i);
                let u = apply(&gap, &e);
                let by_e = plus(&plus(&apply(&gap, &g), &apply(&self.turn(i), &u)), &apply(&gap, &turned));
                let s = self.square::<S>(i) - self.square(0);
                for k in 0..4 {
                    rows[i][k] = -by_e[k] - s * e[k];
                    rows[i][4 + k] = u[k];
                }
            }
            rows[6][..4].copy_from_slice(&g);
            rows[6][4..].copy_from_slice(&e);
        }
        for row in parts.iter_mut().flatten() {
            row[x.patch] = row[7];
            row[7] = zero;
        }
        parts
    }

    /// Bounds of the rounding of a row of the Jacobian in double-double, width of the `s` included, in `|.|_1`.
    pub(super) fn jacobian_bounds_apart(&self, x: &Study<f64>) -> [f64; N] {
        let (e, g, _) = x.magnitudes();
        let mut out = [0.0; N];
        for i in 0..6 {
            let t = self.t[i];
            let (by_g, by_e, s, radius) = if i == 0 {
                let v = g + t * e;
                (v, t * v, self.s[0].abs(), self.s_radius[0])
            } else {
                let tau = self.gap_size(i);
                let s = self.s[i].abs() + self.s[0].abs();
                (tau * e, tau * (g + (t + self.t[0]) * e), s, self.s_radius[i] + self.s_radius[0])
            };
            out[i] = (128.0 * UNIT * (by_g + by_e + s * e) + 8.0 * radius * e + TINY) * UP;
        }
        out
    }
}
