//! The constant second-order part, combined before it is bounded.
//!
//! For a row `y` of the approximate inverse,
//!
//! ```text
//! sum_i y_i Q_i(h, h) = alpha |h_g|^2 / 2 + h_g . (T(D, C) + y_7 I) h_e + h_e . S h_e / 2,
//! alpha = sum y_i,  D = sum y_i d_i,  C = sum y_i c_i,  S = sum y_i (T_i^T T_i - s_i I)      (i = 1..6).
//! ```
//!
//! Differences of legs lack `|h_g|^2`, and near a singular pose `Y` is large in few directions. So bounds of the
//! combined coefficients, instead of `sum |y_i| q_i`, gain a factor between 3 and 20 on the reference problems. On the
//! unit polydisc with `h_patch = 0` the modulus is at most
//!
//! ```text
//! 2 |alpha| + 3 |y_7| + sum over columns j != patch of |T(D, C)|_j + (1/2) sum over i, j != patch of |S_ij|,
//! ```
//!
//! and the polarised form `Q(h, k)` has the same bound, entry by entry.
//!
//! **Rounding.** In each part a coefficient takes at most 9 roundings (entries of `T`, product, three sums, `s`), and
//! the sum over legs 6. The error is below `16 u sum_i |y_i|_1 |coefficient_i|`. The moduli of all coefficients of leg
//! `i` add up to at most `q_i` in the bound. So `32 u sum |y_i|_1 q_i` covers it twice.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::system::N;

/// Coefficients of each leg: `1, d, c`, diagonal of `S`, then `S_01 S_02 S_03 S_12 S_13 S_23`, one lane of padding.
#[derive(Debug, Clone)]
pub(super) struct SecondOrder([[f64; COEFFICIENTS]; 6]);

/// Coefficients of a leg.
pub(super) const COEFFICIENTS: usize = 18;

/// Upper triangle of a symmetric 4 x 4 matrix without its diagonal, in the order of the coefficients.
pub(super) const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

impl SecondOrder {
    pub(super) const ZERO: Self = Self([[0.0; 18]; 6]);

    /// Takes in leg `i`.
    pub(super) fn set_leg(&mut self, i: usize, d: &[f64; 3], c: &[f64; 3], s: f64) {
        let columns = [
            [0.0, d[0], d[1], d[2]],
            [-d[0], 0.0, -c[2], c[1]],
            [-d[1], c[2], 0.0, -c[0]],
            [-d[2], -c[1], c[0], 0.0],
        ];
        let dot = |i: usize, j: usize| (0..4).map(|r| columns[i][r] * columns[j][r]).sum::<f64>();
        let row = &mut self.0[i];
        row[0] = 1.0;
        row[1..4].copy_from_slice(d);
        row[4..7].copy_from_slice(c);
        for j in 0..4 {
            row[7 + j] = dot(j, j) - s;
        }
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            row[11 + k] = dot(i, j);
        }
    }

    /// Coefficient `k` of leg `i`.
    #[inline(always)]
    pub(super) fn coefficient(&self, i: usize, k: usize) -> f64 {
        self.0[i][k]
    }

    /// The bound of the module's text for the row `y`, rounding apart.
    pub(super) fn bound(&self, y_re: &[f64; 8], y_im: &[f64; 8], patch: usize) -> f64 {
        let (mut re, mut im) = ([0.0; 18], [0.0; 18]);
        for (i, leg) in self.0.iter().enumerate() {
            for k in 0..18 {
                re[k] += y_re[i] * leg[k];
                im[k] += y_im[i] * leg[k];
            }
        }
        let size: [f64; 18] = std::array::from_fn(|k| re[k].abs() + im[k].abs());
        let [_, d0, d1, d2, c0, c1, c2, ..] = size;
        let columns = [d0 + d1 + d2, d0 + c1 + c2, d1 + c2 + c0, d2 + c0 + c1];
        let mut total = 2.0 * size[0] + 3.0 * (y_re[N - 1].abs() + y_im[N - 1].abs());
        for j in (0..4).filter(|j| *j != patch) {
            total += columns[j] + 0.5 * size[7 + j];
        }
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            total += if i == patch || j == patch { 0.0 } else { size[11 + k] };
        }
        total
    }
}
