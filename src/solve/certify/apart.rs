//! The contraction test far out, in double-double and on differences of the leg equations.
//!
//! Where `g` is large the six gradients `v_i = g + T_i e` are nearly parallel and the equations nearly alike: rounding in
//! `|v_i|^2` drowns what tells them apart. The test holds for any regular combination of equations. Here it is made on `F_0`, `F_i - F_0`, `F_6` with
//!
//! ```text
//! F_i - F_0 = ( u_i.(2 v_0 + u_i) - (s_i - s_0) e.e ) / 2,   u_i = v_i - v_0 = (T_i - T_0) e,     i = 1..5,
//! ```
//!
//! no difference of large numbers in it, everything in double-double except the approximate inverse.
//!
//! **Error bounds**, notation of the `system` module, `U` the unit of double-double, `tau_i` >= absolute row sums of `T_i - T_0`:
//!
//! * `u_i`: `alpha = 5U tau_i E` a component; `w_i = 2 v_0 + u_i`: from `v_0` and `u_i`, two more roundings, less than
//!   `beta = 3 . 5U (G + t_0 E) + 2 alpha`.
//! * `F_i - F_0`: `(1/2) sum (|u| beta + |w| alpha + alpha beta) <= |u| beta + |w| alpha + 2 alpha beta`, own roundings
//!   `5U (|u| |w| + |s_i - s_0| P)` as for `F_i`; doubled below.
//! * Rows of the Jacobian: an entry by `g` `5U tau E`; one by `e` at most `13U` times the sum `M` of its terms' bounds
//!   `tau G + t_i tau E + tau t_0 E + |s_i - s_0| E`; a row of eight less than `128U (tau E + M)` in `|.|_1`. Row 0 alike with `G + t_0 E` for `tau E`.

use num_complex::Complex64;

use super::certificate::WhyUncertified;
use super::inverse::{Matrix, apart, equilibrated_inverse};
use super::krawczyk::{Bounds, Contraction, decide, largest};
use super::system::{LegSystem, N, Scalar, Study, U};
use crate::num::double_double::DoubleDouble;

const UNIT: f64 = DoubleDouble::UNIT;

/// Tries to prove one root in a ball about `x`; `near` limits the Newton step at `x`.
pub(super) fn contract_apart(
    system: &LegSystem,
    x: &Study<DoubleDouble>,
    near: f64,
) -> Result<Contraction, WhyUncertified> {
    let hi = x.rounded();
    let [re, im] = system.jacobian_apart(&hi);
    let y = equilibrated_inverse(&re, &im).ok_or(WhyUncertified::SingularJacobian)?;
    let b = bounds(system, x, &hi, &y);
    decide(&b, near)
}

fn bounds(system: &LegSystem, x: &Study<DoubleDouble>, hi: &Study<f64>, y: &Matrix) -> Bounds {
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
    let mut out = Bounds { eta_centre: 0.0, eta: 0.0, kappa: 0.0, beta: 0.0, step: [Complex64::ZERO; 8] };
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
    out.rounded_up()
}

/// `|.|_1` of row `k` of `I - Y J`, computed in double-double.
fn row_defect(k: usize, y: &Matrix, j_re: &[[DoubleDouble; 8]; N], j_im: &[[DoubleDouble; 8]; N]) -> f64 {
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
