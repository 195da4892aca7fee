//! The homotopy `C(t) = C_0 + t (C_1 - C_0)` of six linear sections, its derivatives and Taylor series.
//!
//! The unknown is `x = (e, g)` in `C^8`, the equations are `row_i(t) . forms(x) = 0` (six, quadratic in `x`,
//! linear in `t`), `e.g = 0` and a linear patch `v.x = 1`. Target at `t = 0`, start at `t = 1`.

use num_complex::Complex64;

use pulp::Simd;

use super::lanes::{Lanes, Vec8};
use super::lu::Lu;
use crate::solve::sections::{FORMS, Row, Sections};

/// Order of the Taylor predictor.
pub(super) const ORDER: usize = 5;

/// A straight line of linear sections.
#[derive(Debug, Clone)]
pub(crate) struct SectionHomotopy {
    target: [Row; 6],
    slope: [Row; 6],
}

/// The rows at one parameter value per lane.
pub(super) type Rows<S> = [[Lanes<S>; FORMS]; 6];

impl SectionHomotopy {
    /// From `start` (times the unit number `gamma`, against accidental degeneracy of the line) at `t = 1`
    /// to `target` at `t = 0`.
    pub(crate) fn new(start: &Sections, gamma: Complex64, target: &Sections) -> Self {
        let slope =
            std::array::from_fn(|i| std::array::from_fn(|k| gamma * start.rows[i][k] - target.rows[i][k]));
        Self { target: target.rows, slope }
    }

    #[inline(always)]
    pub(super) fn rows_at<S: Simd>(&self, t: Lanes<S>) -> Rows<S> {
        let mut rows = [[t; FORMS]; 6];
        for i in 0..6 {
            for k in 0..FORMS {
                rows[i][k] = Lanes::splat(t.simd, self.target[i][k]).mul_add_scalar(self.slope[i][k], t);
            }
        }
        rows
    }

    /// `(C_1 - C_0) forms`, one value a row.
    #[inline(always)]
    pub(super) fn slope_times<S: Simd>(&self, forms: &[Lanes<S>; FORMS]) -> [Lanes<S>; 6] {
        let mut out = [Lanes::zero(forms[0].simd); 6];
        for i in 0..6 {
            for k in 0..FORMS {
                out[i] = out[i].mul_add_scalar(self.slope[i][k], forms[k]);
            }
        }
        out
    }
}

/// `rows . forms`, one value a row.
#[inline(always)]
pub(super) fn rows_times<S: Simd>(rows: &Rows<S>, forms: &[Lanes<S>; FORMS]) -> [Lanes<S>; 6] {
    let mut out = [Lanes::zero(forms[0].simd); 6];
    for i in 0..6 {
        for k in 0..FORMS {
            out[i] = out[i].mul_add(rows[i][k], forms[k]);
        }
    }
    out
}

/// Symmetrised forms of two vectors: `forms(x + y) - forms(x) - forms(y)`, and last `e.g' + e'.g`.
#[inline(always)]
pub(super) fn polar_forms<S: Simd>(x: &Vec8<S>, y: &Vec8<S>) -> ([Lanes<S>; FORMS], Lanes<S>) {
    let zero = Lanes::zero(x[0].simd);
    let mut f = [zero; FORMS];
    let mut k = 0;
    for i in 0..4 {
        f[k] = (x[i] * y[i]).times(2.0);
        k += 1;
        for j in i + 1..4 {
            // an off-diagonal coefficient stands for both entries of the symmetric matrix
            f[k] = (x[i] * y[j]).mul_add(x[j], y[i]).times(2.0);
            k += 1;
        }
    }
    for i in 1..4 {
        f[9 + i] = (x[0] * y[4 + i]).mul_add(y[0], x[4 + i]).mul_sub(x[4], y[i]).mul_sub(y[4], x[i]);
    }
    for i in 1..4 {
        let (p, q) = (i % 3 + 1, (i + 1) % 3 + 1);
        f[12 + i] = (x[p] * y[4 + q]).mul_sub(x[q], y[4 + p]).mul_add(y[p], x[4 + q]).mul_sub(y[q], x[4 + p]);
    }
    let mut gg = zero;
    let mut eg = zero;
    for i in 0..4 {
        gg = gg.mul_add(x[4 + i], y[4 + i]);
        eg = eg.mul_add(x[i], y[4 + i]).mul_add(y[i], x[4 + i]);
    }
    f[16] = gg.times(2.0);
    (f, eg)
}

/// The 8 x 8 matrix of derivatives: six sections, `e.g`, patch `v`.
#[inline(always)]
pub(super) fn derivative_matrix<S: Simd>(rows: &Rows<S>, x: &Vec8<S>, patch: &Vec8<S>) -> [[Lanes<S>; 8]; 8] {
    let zero = Lanes::zero(x[0].simd);
    let mut j = [[zero; 8]; 8];
    for i in 0..6 {
        let r = &rows[i];
        let sym = [
            [r[0], r[1], r[2], r[3]],
            [r[1], r[4], r[5], r[6]],
            [r[2], r[5], r[7], r[8]],
            [r[3], r[6], r[8], r[9]],
        ];
        let (m, n, c) = ([r[10], r[11], r[12]], [r[13], r[14], r[15]], r[16]);
        let te = skew_times(m, n, [x[0], x[1], x[2], x[3]]);
        let tg = skew_times(m, n, [x[4], x[5], x[6], x[7]]);
        for p in 0..4 {
            let mut ee = zero;
            for q in 0..4 {
                ee = ee.mul_add(sym[p][q], x[q]);
            }
            j[i][p] = ee.times(2.0) - tg[p];
            j[i][4 + p] = te[p] + (c * x[4 + p]).times(2.0);
        }
    }
    j[6][..4].copy_from_slice(&x[4..]);
    j[6][4..].copy_from_slice(&x[..4]);
    j[7] = *patch;
    j
}

/// `T y = (-m.yv, m y0 + n x yv)`.
#[inline(always)]
fn skew_times<S: Simd>(m: [Lanes<S>; 3], n: [Lanes<S>; 3], y: [Lanes<S>; 4]) -> [Lanes<S>; 4] {
    let scalar = (m[0] * y[1]).mul_add(m[1], y[2]).mul_add(m[2], y[3]);
    [
        -scalar,
        (m[0] * y[0]).mul_add(n[1], y[3]).mul_sub(n[2], y[2]),
        (m[1] * y[0]).mul_add(n[2], y[1]).mul_sub(n[0], y[3]),
        (m[2] * y[0]).mul_add(n[0], y[2]).mul_sub(n[1], y[1]),
    ]
}

/// Values of the eight equations from the derivative matrix at `x`: `q = 1/2 x . grad q` for quadrics.
#[inline(always)]
pub(super) fn values<S: Simd>(j: &[[Lanes<S>; 8]; 8], x: &Vec8<S>) -> Vec8<S> {
    let simd = x[0].simd;
    let mut f = [Lanes::zero(simd); 8];
    for i in 0..8 {
        for p in 0..8 {
            f[i] = f[i].mul_add(j[i][p], x[p]);
        }
    }
    for i in 0..7 {
        f[i] = f[i].times(0.5);
    }
    f[7] -= Lanes::splat(simd, Complex64::ONE);
    f
}

/// Taylor coefficients `x_1 .. x_ORDER` of the path through `x` at `t`, given the factorised derivative.
///
/// Order `k` of `C(t) forms(x(t)) = 0` reads
/// `J x_k = -(C sum_{0<i<=j, i+j=k} F(x_i, x_j) + C' sum_{i+j=k-1} F(x_i, x_j))` with the polar forms
/// `F` (halved where `i = j`): one LU factorisation serves all orders.
#[inline(always)]
pub(super) fn taylor<S: Simd>(
    homotopy: &SectionHomotopy,
    rows: &Rows<S>,
    lu: &Lu<S>,
    x: &Vec8<S>,
) -> [Vec8<S>; ORDER] {
    let zero = Lanes::zero(x[0].simd);
    let mut series = [[zero; 8]; ORDER];
    // full convolution of order k - 1, needed with C'
    let (mut full, _) = polar_forms(x, x);
    full = full.map(|z| z.times(0.5));
    for k in 1..=ORDER {
        let mut inner = [zero; FORMS];
        let mut study = zero;
        for i in 1..=k / 2 {
            let j = k - i;
            let (f, s) = polar_forms(&series[i - 1], &series[j - 1]);
            let weight = if i == j { 0.5 } else { 1.0 };
            for (sum, z) in inner.iter_mut().zip(f) {
                *sum += z.times(weight);
            }
            study += s.times(weight);
        }
        let sections = if k == 1 { [zero; 6] } else { rows_times(rows, &inner) };
        let moved = homotopy.slope_times(&full);
        let mut rhs = [zero; 8];
        for i in 0..6 {
            rhs[i] = -(sections[i] + moved[i]);
        }
        rhs[6] = -study;
        series[k - 1] = lu.solve(rhs);
        if k < ORDER {
            let (f, _) = polar_forms(x, &series[k - 1]);
            for i in 0..FORMS {
                full[i] = inner[i] + f[i];
            }
        }
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;
    use crate::solve::sections::forms;
    use pulp::Scalar;

    fn random_vector(rng: &mut Rng) -> [Complex64; 8] {
        std::array::from_fn(|_| Complex64::new(rng.normal(), rng.normal()))
    }

    fn lanes(x: [Complex64; 8]) -> Vec8<Scalar> {
        x.map(|z| Lanes::splat(Scalar::new(), z))
    }

    #[test]
    fn derivative_values_and_polar_forms_agree_with_the_forms() {
        let mut rng = Rng::new(11);
        let mut section = || Sections {
            rows: std::array::from_fn(|_| {
                std::array::from_fn(|_| Complex64::new(rng.normal(), rng.normal()))
            }),
        };
        let homotopy = SectionHomotopy::new(&section(), Complex64::new(0.6, 0.8), &section());
        let (x, y) = (random_vector(&mut rng), random_vector(&mut rng));
        let rows = homotopy.rows_at(Lanes::splat(Scalar::new(), Complex64::new(0.3, 0.2)));
        let v = lanes(random_vector(&mut rng));
        let j = derivative_matrix(&rows, &lanes(x), &v);
        let f = values(&j, &lanes(x));
        let direct = |z: [Complex64; 8]| -> [Complex64; 6] {
            std::array::from_fn(|i| rows[i].iter().zip(forms(z)).map(|(c, f)| c.lane(0) * f).sum())
        };
        for i in 0..6 {
            assert!((direct(x)[i] - f[i].lane(0)).norm() < 1e-12);
        }
        let sum: [Complex64; 8] = std::array::from_fn(|k| x[k] + y[k]);
        let (polar, study) = polar_forms(&lanes(x), &lanes(y));
        for k in 0..FORMS {
            let expected = forms(sum)[k] - forms(x)[k] - forms(y)[k];
            assert!((polar[k].lane(0) - expected).norm() < 1e-12, "form {k}");
        }
        let eg: Complex64 = (0..4).map(|k| x[k] * y[4 + k] + y[k] * x[4 + k]).sum();
        assert!((study.lane(0) - eg).norm() < 1e-12);
        // J y is the polar value
        for i in 0..6 {
            let jy: Complex64 = (0..8).map(|p| j[i][p].lane(0) * y[p]).sum();
            let expected = direct(sum)[i] - direct(x)[i] - direct(y)[i];
            assert!((jy - expected).norm() < 1e-11);
        }
    }

    #[test]
    fn the_series_satisfies_the_homotopy_to_its_order() {
        let mut rng = Rng::new(12);
        let mut x = random_vector(&mut rng);
        let eg: Complex64 = (0..3).map(|k| x[k] * x[4 + k]).sum();
        x[7] = -eg / x[3];
        // sections through x at t = 1/2 only: the target row is the start row less twice what sticks out
        let f = forms(x);
        let ff: Complex64 = f.iter().map(|z| z * z).sum();
        let start: [Row; 6] =
            std::array::from_fn(|_| std::array::from_fn(|_| Complex64::new(rng.normal(), rng.normal())));
        let target = start.map(|row| {
            let overlap: Complex64 = row.iter().zip(&f).map(|(c, z)| c * z).sum();
            std::array::from_fn(|k| 2.0 * overlap / ff * f[k] - row[k])
        });
        let homotopy = SectionHomotopy::new(
            &Sections { rows: start },
            Complex64::new(-1.0, 0.0),
            &Sections { rows: target },
        );
        let t0 = Lanes::splat(Scalar::new(), Complex64::new(0.5, 0.0));
        let rows = homotopy.rows_at(t0);
        let norm: f64 = x.iter().map(num_complex::Complex::norm_sqr).sum();
        let patch: Vec8<Scalar> = x.map(|z| Lanes::splat(Scalar::new(), z.conj() / norm));
        let lu = Lu::factorise(derivative_matrix(&rows, &lanes(x), &patch));
        let series = taylor(&homotopy, &rows, &lu, &lanes(x));
        let defect = |h: f64| {
            let mut y = lanes(x);
            for (k, c) in series.iter().enumerate() {
                for p in 0..8 {
                    y[p] += c[p].times(h.powf(k as f64 + 1.0));
                }
            }
            let rows = homotopy.rows_at(Lanes::splat(Scalar::new(), Complex64::new(0.5 + h, 0.0)));
            let j = derivative_matrix(&rows, &y, &patch);
            values(&j, &y).iter().map(|z| z.lane(0).norm()).fold(0.0, f64::max)
        };
        // choose h in the range where the error term dominates rounding
        let (a, b) = (defect(2e-2), defect(1e-2));
        let order = (a / b).log2();
        assert!((order - (ORDER as f64 + 1.0)).abs() < 0.5, "{a} {b} {order}");
    }
}
