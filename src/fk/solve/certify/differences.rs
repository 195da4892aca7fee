//! The bounds of the theorem far out, in double-double and on differences of the leg equations.
//!
//! When `g` is large the six gradients `v_i = g + T_i e` are nearly parallel and the equations nearly alike. Rounding
//! in `|v_i|^2` then drowns their differences. The test holds for any regular combination of equations. Here it is made
//! on `F_0`, `F_i - F_0`, `F_6` with
//!
//! ```text
//! F_i - F_0 = ( u_i.(2 v_0 + u_i) - (s_i - s_0) e.e ) / 2,   u_i = v_i - v_0 = (T_i - T_0) e,     i = 1..5,
//! ```
//!
//! no difference of large numbers in it, everything in double-double except the approximate inverse.
//!
//! **Error bounds**, notation of the `system` module, `U` the unit of double-double, `tau_i` >= absolute row sums of
//! `T_i - T_0`:
//!
//! * `u_i`: `alpha = 5U tau_i E` a component; `w_i = 2 v_0 + u_i`: from `v_0` and `u_i`, two more roundings, less than
//!   `beta = 3 . 5U (G + t_0 E) + 2 alpha`.
//! * `F_i - F_0`: `(1/2) sum (|u| beta + |w| alpha + alpha beta) <= |u| beta + |w| alpha + 2 alpha beta`, own roundings
//!   `5U (|u| |w| + |s_i - s_0| P)` as for `F_i`; doubled below.
//! * Rows of the Jacobian: an entry by `g` has `5U tau E`. An entry by `e` has at most `13U` times the sum `M` of its
//!   terms' bounds `tau G + t_i tau E + tau t_0 E + |s_i - s_0| E`. A row of eight has less than `128U (tau E + M)` in
//!   `|.|_1`. For row 0 `G + t_0 E` replaces `tau E`.
//!
//! Radii of joints change `F_i - F_0` and its gradient by at most the sum of the changes of `F_i` and `F_0`.

use num_complex::Complex64;

use super::certificate::WhyUncertified;
use super::inverse::{PaddedMatrix, apart, equilibrated_inverse};
use super::krawczyk::{KrawczykBounds, largest};
use super::system::{LegSystem, N, RealScalar, Study, U, leg_vector, row_sums};
use num::ball::{TINY, UP};
use num::double_double::DoubleDouble;

const UNIT: f64 = DoubleDouble::UNIT;

/// `d` and `c` of a leg, or differences of those of two.
type Turn<S> = ([S; 3], [S; 3]);

/// `T y`.
fn apply<S: RealScalar>(turn: &Turn<S>, y: &[S; 4]) -> [S; 4] {
    let zero = S::from(0.0);
    leg_vector(&turn.0, &turn.1, &[y[0], y[1], y[2], y[3], zero, zero, zero, zero])
}

fn quarter<S: RealScalar>(x: &[S; 8], first: usize) -> [S; 4] {
    std::array::from_fn(|k| x[first + k])
}

fn plus<S: RealScalar>(x: &[S; 4], y: &[S; 4]) -> [S; 4] {
    std::array::from_fn(|k| x[k] + y[k])
}

/// Real and imaginary part of `x.y`.
fn dot<S: RealScalar>(x: &[[S; 4]; 2], y: &[[S; 4]; 2]) -> [S; 2] {
    let part = |a: &[S; 4], b: &[S; 4]| (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
    [part(&x[0], &y[0]) + -part(&x[1], &y[1]), part(&x[0], &y[1]) + part(&x[1], &y[0])]
}

/// The contribution of a leg to `F_i - F_0`, or to `F_0` itself.
fn with_first(i: usize, of_leg: impl Fn(usize) -> f64) -> f64 {
    of_leg(0) + if i == 0 { 0.0 } else { of_leg(i) }
}

impl LegSystem {
    /// The middle of the squared length, rounded in double.
    fn square<S: RealScalar>(&self, i: usize) -> S {
        S::sum(self.s[i], self.s_low[i])
    }

    /// `T_i - T_0`.
    fn gap<S: RealScalar>(&self, i: usize) -> Turn<S> {
        let (leg, first) = (self.turn::<S>(i), self.turn::<S>(0));
        let minus = |x: &[S; 3], y: &[S; 3]| std::array::from_fn(|k| x[k] + -y[k]);
        (minus(&leg.0, &first.0), minus(&leg.1, &first.1))
    }

    /// `tau_i`.
    fn gap_size(&self, i: usize) -> f64 {
        let (d, c) = self.gap::<f64>(i);
        // the computed differences are off by roundings of their terms
        let terms: f64 = [0, i].iter().map(|k| self.t[*k]).sum();
        let low: f64 = [0, i].iter().map(|k| self.turn_radius[*k]).sum();
        (row_sums(&d, &c).into_iter().fold(0.0, f64::max) + 8.0 * f64::EPSILON * terms + low) * UP
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

    /// Bounds of the rounding of [`values_apart`](Self::values_apart), and of the change over the radii of the data.
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
            let joints = |k: usize| self.low_joint_width_of_value(k, e, 2.0 * (g + self.t[k] * e));
            width[i] = (0.5 * radius * p + with_first(i, joints)) * UP;
        }
        rounding[6] = (32.0 * UNIT * e * g + TINY) * UP;
        (rounding, width)
    }

    /// The Jacobian, in real and imaginary part; column `patch` holds the gradient by `g_3`, lane 7 is zero.
    pub(super) fn jacobian_apart<S: RealScalar>(&self, x: &Study<S>) -> [[[S; 8]; N]; 2] {
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

    /// Bounds of the rounding of a row of the Jacobian in double-double, width of the data included, in `|.|_1`.
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
            let joints = |k: usize| self.joint_width_of_gradient(k, e, 2.0 * (g + self.t[k] * e));
            let width = 8.0 * radius * e + with_first(i, joints);
            out[i] = (128.0 * UNIT * (by_g + by_e + s * e) + width + TINY) * UP;
        }
        out
    }
}

/// The bounds about `x` on differences of the equations.
pub(super) fn bounds(system: &LegSystem, x: &Study<DoubleDouble>) -> Result<KrawczykBounds, WhyUncertified> {
    let hi = &x.rounded();
    let [re, im] = system.jacobian_apart(hi);
    let y = &equilibrated_inverse(&re, &im).ok_or(WhyUncertified::SingularJacobian)?;
    let (f_re, f_im) = system.values_apart(x);
    let (rounding, width) = system.value_bounds_apart(hi);
    let [j_re, j_im] = system.jacobian_apart(x);
    let j_error = system.jacobian_bounds_apart(hi);
    let f_error: [f64; N] =
        std::array::from_fn(|i| rounding[i] + 17.0 * U * (f_re[i].rounded().abs() + f_im[i].rounded().abs()));
    let j_size: [f64; N] = std::array::from_fn(|i| {
        (0..8).map(|k| j_re[i][k].rounded().abs() + j_im[i][k].rounded().abs()).sum()
    });
    let whole = apart(y);
    let mut out =
        KrawczykBounds { eta_centre: 0.0, eta: 0.0, kappa: 0.0, beta: 0.0, step: [Complex64::ZERO; 8] };
    for k in 0..N {
        let weights: [f64; N] = std::array::from_fn(|i| y.re[k][i].abs() + y.im[k][i].abs());
        let along = |terms: &[f64; N]| weights.iter().zip(terms).map(|(w, t)| w * t).sum::<f64>();
        let step: Complex64 = (0..N)
            .map(|i| {
                Complex64::new(y.re[k][i], y.im[k][i]) * Complex64::new(f_re[i].rounded(), f_im[i].rounded())
            })
            .sum();
        out.step[if k == hi.patch { 7 } else { k }] = step;
        let centre = step.re.abs() + step.im.abs() + along(&f_error);
        let defect = row_defect(k, y, &j_re, &j_im) + along(&j_error) + 16.0 * UNIT * along(&j_size);
        // the column of F_0 is a sum of up to six numbers: its weight takes up their rounding
        let mut coarse = weights;
        coarse[0] = weights[..6].iter().sum();
        let beta = system.second_order_bound(&whole.re[k], &whole.im[k], &coarse, hi.patch);
        out.eta_centre = largest(out.eta_centre, centre);
        out.eta = largest(out.eta, centre + along(&width));
        out.kappa = largest(out.kappa, defect);
        out.beta = largest(out.beta, beta);
    }
    Ok(out.rounded_up())
}

/// `|.|_1` of row `k` of `I - Y J`, computed in double-double.
fn row_defect(
    k: usize,
    y: &PaddedMatrix,
    j_re: &[[DoubleDouble; 8]; N],
    j_im: &[[DoubleDouble; 8]; N],
) -> f64 {
    let mut total = 0.0;
    for l in 0..N {
        let mut re = DoubleDouble::from(if l == k { 1.0 } else { 0.0 });
        let mut im = DoubleDouble::ZERO;
        for i in 0..N {
            let (a, b) = (DoubleDouble::from(y.re[k][i]), DoubleDouble::from(y.im[k][i]));
            re = re - (a * j_re[i][l] - b * j_im[i][l]);
            im = im - (a * j_im[i][l] + b * j_re[i][l]);
        }
        total += re.rounded().abs() + im.rounded().abs();
    }
    total
}
