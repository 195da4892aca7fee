//! The homotopy `C(t) = C_0 + t (C_1 - C_0)` of six linear sections, its derivatives and Taylor series.
//!
//! The unknown is `x = (e, g)` in `C^8`, the equations are `row_i(t) . forms(x) = 0` (six, quadratic in `x`,
//! linear in `t`), `e.g = 0` and a linear patch `v.x = 1`. Target at `t = 0`, start at `t = 1`.

use num_complex::Complex64;

use pulp::Simd;

use super::lanes::{Lanes, Matrix8, Vec8};
use crate::solve::sections::{FORMS, Sections};

/// Order of the Taylor predictor.
pub(super) const ORDER: usize = 5;

/// A coefficient of a section: real where start and target are real, which halves the work, or complex.
pub(super) trait Coefficient: Copy {
    /// `sum + k x`.
    fn add_times<S: Simd>(self, sum: Lanes<S>, x: Lanes<S>) -> Lanes<S>;
}

impl Coefficient for f64 {
    #[inline(always)]
    fn add_times<S: Simd>(self, sum: Lanes<S>, x: Lanes<S>) -> Lanes<S> {
        let s = sum.simd;
        let k = s.splat_f64s(self);
        Lanes { re: s.mul_add_e_f64s(k, x.re, sum.re), im: s.mul_add_e_f64s(k, x.im, sum.im), simd: s }
    }
}

impl Coefficient for Complex64 {
    #[inline(always)]
    fn add_times<S: Simd>(self, sum: Lanes<S>, x: Lanes<S>) -> Lanes<S> {
        sum.mul_add(Lanes::splat(sum.simd, self), x)
    }
}

/// A straight line of linear sections, `target + t slope`.
#[derive(Debug, Clone)]
pub(crate) struct SectionHomotopy<K = Complex64> {
    target: [[K; FORMS]; 6],
    slope: [[K; FORMS]; 6],
}

/// The rows at one parameter value per lane.
pub(super) type Rows<S> = [[Lanes<S>; FORMS]; 6];

impl SectionHomotopy {
    /// From `start` (times the number `gamma`, against accidental degeneracy of the line) at `t = 1` to
    /// `target` at `t = 0`.
    pub(crate) fn new(start: &Sections, gamma: Complex64, target: &Sections) -> Self {
        let slope =
            std::array::from_fn(|i| std::array::from_fn(|k| gamma * start.rows[i][k] - target.rows[i][k]));
        Self { target: target.rows, slope }
    }

    /// The line of the real homotopy seen from `t = corner`: `t` of this one is `corner` times `t` of the new.
    pub(super) fn through(real: &SectionHomotopy<f64>, corner: Complex64) -> Self {
        let lift = |rows: &[[f64; FORMS]; 6], k: Complex64| rows.map(|row| row.map(|x| k * x));
        Self { target: lift(&real.target, Complex64::ONE), slope: lift(&real.slope, corner) }
    }

    /// The part of the line from `t = 1` to `end`, which becomes `t = 0`.
    pub(super) fn shortened(&self, end: Complex64) -> Self {
        let (mut target, mut slope) = (self.target, self.slope);
        for (z, d) in target.iter_mut().flatten().zip(slope.iter_mut().flatten()) {
            *z += *d * end;
            *d *= Complex64::ONE - end;
        }
        Self { target, slope }
    }
}

impl SectionHomotopy<f64> {
    /// From `start` at `t = 1` to `target` at `t = 0`, both real; to be followed along complex `t`. `None`
    /// when a coefficient is not real.
    pub(super) fn real(start: &Sections, target: &Sections) -> Option<Self> {
        let real = start.rows.iter().chain(&target.rows).flatten().all(|z| z.im == 0.0);
        let slope = |i: usize, k: usize| start.rows[i][k].re - target.rows[i][k].re;
        let slope = std::array::from_fn(|i| std::array::from_fn(|k| slope(i, k)));
        real.then(|| Self { target: target.rows.map(|row| row.map(|z| z.re)), slope })
    }
}

impl<K: Coefficient> SectionHomotopy<K> {
    #[inline(always)]
    pub(super) fn rows_at<S: Simd>(&self, t: Lanes<S>) -> Rows<S> {
        let one = Lanes::splat(t.simd, Complex64::ONE);
        let zero = Lanes::zero(t.simd);
        let mut rows = [[zero; FORMS]; 6];
        for i in 0..6 {
            for k in 0..FORMS {
                rows[i][k] = self.slope[i][k].add_times(self.target[i][k].add_times(zero, one), t);
            }
        }
        rows
    }

    /// `target forms + slope moved`, one value a row.
    #[inline(always)]
    fn combine<S: Simd>(
        &self,
        forms: Option<&[Lanes<S>; FORMS]>,
        moved: &[Lanes<S>; FORMS],
    ) -> [Lanes<S>; 6] {
        let mut out = [Lanes::zero(moved[0].simd); 6];
        for i in 0..6 {
            for k in 0..FORMS {
                out[i] = self.slope[i][k].add_times(out[i], moved[k]);
            }
            if let Some(forms) = forms {
                for k in 0..FORMS {
                    out[i] = self.target[i][k].add_times(out[i], forms[k]);
                }
            }
        }
        out
    }
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
pub(super) fn values<S: Simd>(j: &Matrix8<S>, x: &Vec8<S>) -> Vec8<S> {
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

/// Taylor coefficients `x_1 .. x_ORDER` of the path through `x` at `t`; `solve` applies the inverse of the
/// derivative matrix there.
///
/// Order `k` of `C(t) forms(x(t)) = 0` reads
/// `J x_k = -(C(t) u_k + C' w_{k-1})`, `u_k = sum_{0<i<=j, i+j=k} F(x_i, x_j)`, `w_k = sum_{i+j=k} F(x_i, x_j)` with the
/// polar forms `F` (halved where `i = j`): one factorisation serves all orders. With `C(t) = C_0 + t C'` the
/// right-hand side is `C_0 u_k + C' (t u_k + w_{k-1})`, products with constant matrices only.
#[inline(always)]
pub(super) fn taylor<S: Simd, K: Coefficient>(
    homotopy: &SectionHomotopy<K>,
    t: Lanes<S>,
    x: &Vec8<S>,
    solve: impl Fn(&mut Vec8<S>),
) -> [Vec8<S>; ORDER] {
    let zero = Lanes::zero(t.simd);
    let mut series = [[zero; 8]; ORDER];
    let (mut full, _) = polar_forms(x, x);
    for z in &mut full {
        *z = z.times(0.5);
    }
    for k in 1..=ORDER {
        let mut inner = [zero; FORMS];
        let mut study = zero;
        for i in 1..=k / 2 {
            let j = k - i;
            let (f, s) = polar_forms(&series[i - 1], &series[j - 1]);
            let weight = if i == j { 0.5 } else { 1.0 };
            for n in 0..FORMS {
                inner[n] += f[n].times(weight);
            }
            study += s.times(weight);
        }
        let sections = if k == 1 {
            homotopy.combine(None, &full)
        } else {
            for n in 0..FORMS {
                full[n] = full[n].mul_add(t, inner[n]);
            }
            homotopy.combine(Some(&inner), &full)
        };
        let rhs = &mut series[k - 1];
        for i in 0..6 {
            rhs[i] = -sections[i];
        }
        rhs[6] = -study;
        solve(rhs);
        if k < ORDER {
            let (f, _) = polar_forms(x, &series[k - 1]);
            for n in 0..FORMS {
                full[n] = inner[n] + f[n];
            }
        }
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;
    use crate::solve::homotopy::lu::Lu;
    use crate::solve::sections::{Row, forms};
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
        let series = taylor(&homotopy, t0, &lanes(x), |b| *b = lu.solve(*b));
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
