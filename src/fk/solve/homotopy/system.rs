//! The homotopy `C(t) = C_0 + t (C_1 - C_0)` of six linear sections, its derivatives and Taylor series.
//!
//! The unknown is `x = (e, g)` in `C^8`, the equations are `row_i(t) . forms(x) = 0` (six, quadratic in `x`,
//! linear in `t`), `e.g = 0` and a linear patch `v.x = 1`. Target at `t = 0`, start at `t = 1`.

use num_complex::Complex64;

use pulp::Simd;

use super::lanes::{Lanes, Matrix8, Vec8};
use super::quadrics::{QuadraticForms, Quadrics};
use crate::solve::planar::{PLANAR_FORMS, planar_row};
use crate::solve::sections::{FORMS, Sections};

/// Order of the Taylor predictor.
pub(super) const ORDER: usize = 5;

/// A coefficient of a section: real where start and target are real, which halves the work, or complex.
pub(super) trait Coefficient: Copy {
    /// `sum + k x`.
    fn add_times<S: Simd>(self, sum: Lanes<S>, x: Lanes<S>) -> Lanes<S>;

    /// The same number in every lane.
    fn lanes<S: Simd>(self, simd: S) -> Lanes<S>;
}

impl Coefficient for f64 {
    #[inline(always)]
    fn add_times<S: Simd>(self, sum: Lanes<S>, x: Lanes<S>) -> Lanes<S> {
        let s = sum.simd;
        let k = s.splat_f64s(self);
        Lanes { re: s.mul_add_e_f64s(k, x.re, sum.re), im: s.mul_add_e_f64s(k, x.im, sum.im), simd: s }
    }

    #[inline(always)]
    fn lanes<S: Simd>(self, simd: S) -> Lanes<S> {
        Lanes::splat(simd, self.into())
    }
}

impl Coefficient for Complex64 {
    #[inline(always)]
    fn add_times<S: Simd>(self, sum: Lanes<S>, x: Lanes<S>) -> Lanes<S> {
        sum.mul_add(Lanes::splat(sum.simd, self), x)
    }

    #[inline(always)]
    fn lanes<S: Simd>(self, simd: S) -> Lanes<S> {
        Lanes::splat(simd, self)
    }
}

/// A path of six linear sections that is straight in a complex parameter, as the trackers need it.
pub(super) trait SectionPath<const F: usize> {
    /// Values of those forms whose coefficients change.
    type Moved<S: Simd>: Copy;

    /// The 8 x 8 matrix of derivatives at one parameter value per lane: six sections, `e.g`, patch. It has up to 8 kB,
    /// so that it is made where it stays.
    fn derivative_at<S: Simd>(&self, t: Lanes<S>, x: &Vec8<S>, patch: &Vec8<S>, j: &mut Matrix8<S>);

    /// The forms whose coefficients change, out of all forms.
    fn moved<S: Simd>(forms: &[Lanes<S>; F]) -> Self::Moved<S>;

    /// Polar forms of those.
    fn moved_polar<S: Simd>(x: &Vec8<S>, y: &Vec8<S>) -> Self::Moved<S>;

    /// `a + t b`.
    fn moved_sum<S: Simd>(a: &Self::Moved<S>, t: Lanes<S>, b: &Self::Moved<S>) -> Self::Moved<S>;

    /// `target forms + slope moved`, one value a row.
    fn combine<S: Simd>(&self, forms: Option<&[Lanes<S>; F]>, moved: &Self::Moved<S>) -> [Lanes<S>; 6];
}

/// A straight line of linear sections, `target + t slope`, in the `F` forms of [`Quadrics`].
#[derive(Debug, Clone)]
pub(crate) struct SectionHomotopy<K = Complex64, const F: usize = FORMS> {
    target: [[K; F]; 6],
    slope: [[K; F]; 6],
}

/// The rows at one parameter value per lane.
pub(super) type Rows<S, const F: usize = FORMS> = [[Lanes<S>; F]; 6];

impl SectionHomotopy {
    /// From `start` (times the number `gamma`, against accidental degeneracy of the line) at `t = 1` to
    /// `target` at `t = 0`.
    pub(super) fn new(start: &Sections, gamma: Complex64, target: &Sections) -> Self {
        let slope =
            std::array::from_fn(|i| std::array::from_fn(|k| gamma * start.rows[i][k] - target.rows[i][k]));
        Self { target: target.rows, slope }
    }

    /// `target + t slope`.
    pub(super) fn line(target: &[[Complex64; FORMS]; 6], slope: &[[Complex64; FORMS]; 6]) -> Self {
        Self { target: *target, slope: *slope }
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
    /// The homotopy from `start` at `t = 1` to `target` at `t = 0`, both real, to be followed along complex `t`. `None`
    /// when a coefficient is not real.
    pub(super) fn real(start: &Sections, target: &Sections) -> Option<Self> {
        let real = start.rows.iter().chain(&target.rows).flatten().all(|z| z.im == 0.0);
        let slope = |i: usize, k: usize| start.rows[i][k].re - target.rows[i][k].re;
        let slope = std::array::from_fn(|i| std::array::from_fn(|k| slope(i, k)));
        real.then(|| Self { target: target.rows.map(|row| row.map(|z| z.re)), slope })
    }

    /// The same line in the ten forms of planar sections, which its rows must be.
    pub(super) fn planar(&self) -> SectionHomotopy<f64, PLANAR_FORMS> {
        SectionHomotopy { target: self.target.map(planar_row), slope: self.slope.map(planar_row) }
    }
}

impl<K: Coefficient, const F: usize> SectionHomotopy<K, F> {
    #[inline(always)]
    pub(super) fn rows_at<S: Simd>(&self, t: Lanes<S>) -> Rows<S, F> {
        let mut rows = [[t; F]; 6];
        for i in 0..6 {
            rows[i] = self.row_at(i, t);
        }
        rows
    }

    #[inline(always)]
    fn row_at<S: Simd>(&self, i: usize, t: Lanes<S>) -> [Lanes<S>; F] {
        let mut row = [t; F];
        for k in 0..F {
            row[k] = self.slope[i][k].add_times(self.target[i][k].lanes(t.simd), t);
        }
        row
    }
}

impl<K: Coefficient, const F: usize> SectionPath<F> for SectionHomotopy<K, F>
where
    QuadraticForms<F>: Quadrics<F>,
{
    type Moved<S: Simd> = [Lanes<S>; F];

    /// [`derivative_matrix`] at one parameter value per lane; the rows, 13 kB of them in the widest unit, are not kept.
    #[inline(always)]
    fn derivative_at<S: Simd>(&self, t: Lanes<S>, x: &Vec8<S>, patch: &Vec8<S>, j: &mut Matrix8<S>) {
        border(x, patch, j);
        for i in 0..6 {
            j[i] = QuadraticForms::gradient(&self.row_at(i, t), x);
        }
    }

    #[inline(always)]
    fn moved<S: Simd>(forms: &[Lanes<S>; F]) -> [Lanes<S>; F] {
        *forms
    }

    #[inline(always)]
    fn moved_polar<S: Simd>(x: &Vec8<S>, y: &Vec8<S>) -> [Lanes<S>; F] {
        QuadraticForms::polar(x, y).0
    }

    #[inline(always)]
    fn moved_sum<S: Simd>(a: &[Lanes<S>; F], t: Lanes<S>, b: &[Lanes<S>; F]) -> [Lanes<S>; F] {
        let mut out = *a;
        for n in 0..F {
            out[n] = out[n].mul_add(t, b[n]);
        }
        out
    }

    #[inline(always)]
    fn combine<S: Simd>(&self, forms: Option<&[Lanes<S>; F]>, moved: &[Lanes<S>; F]) -> [Lanes<S>; 6] {
        let mut out = [Lanes::zero(moved[0].simd); 6];
        // six independent sums side by side
        for k in 0..F {
            for i in 0..6 {
                out[i] = self.slope[i][k].add_times(out[i], moved[k]);
            }
        }
        if let Some(forms) = forms {
            for k in 0..F {
                for i in 0..6 {
                    out[i] = self.target[i][k].add_times(out[i], forms[k]);
                }
            }
        }
        out
    }
}

/// The 8 x 8 matrix of derivatives: six sections, `e.g`, patch `v`.
#[inline(always)]
pub(super) fn derivative_matrix<S: Simd, const F: usize>(
    rows: &Rows<S, F>,
    x: &Vec8<S>,
    patch: &Vec8<S>,
) -> Matrix8<S>
where
    QuadraticForms<F>: Quadrics<F>,
{
    let mut j = [*patch; 8];
    border(x, patch, &mut j);
    for i in 0..6 {
        j[i] = QuadraticForms::gradient(&rows[i], x);
    }
    j
}

/// The last two rows, of `e.g` and the patch.
#[inline(always)]
pub(super) fn border<S: Simd>(x: &Vec8<S>, patch: &Vec8<S>, j: &mut Matrix8<S>) {
    j[6][..4].copy_from_slice(&x[4..]);
    j[6][4..].copy_from_slice(&x[..4]);
    j[7] = *patch;
}

/// Values of the eight equations from the derivative matrix at `x`: `q = 1/2 x . grad q` for quadrics.
#[inline(always)]
pub(super) fn values<S: Simd>(j: &Matrix8<S>, x: &Vec8<S>) -> Vec8<S> {
    let simd = x[0].simd;
    let mut f = [Lanes::zero(simd); 8];
    for p in 0..8 {
        for i in 0..8 {
            f[i] = f[i].mul_add(j[i][p], x[p]);
        }
    }
    for i in 0..7 {
        f[i] = f[i].times(0.5);
    }
    f[7] -= Lanes::splat(simd, Complex64::ONE);
    f
}

/// Taylor coefficients `x_1 .. x_ORDER` of a path.
pub(super) type Series<S> = [Vec8<S>; ORDER];

/// The place for a [`taylor`] series.
#[inline(always)]
pub(super) fn blank_series<S: Simd>(simd: S) -> Series<S> {
    [[Lanes::zero(simd); 8]; ORDER]
}

/// The series of the path through `x` at `t`, written to a place that is kept for the next one; `solve` applies the
/// inverse of the derivative matrix there.
///
/// Order `k` of `C(t) forms(x(t)) = 0` reads `J x_k = -(C(t) u_k + C' w_{k-1})`,
/// `u_k = sum_{0<i<=j, i+j=k} F(x_i, x_j)`, `w_k = sum_{i+j=k} F(x_i, x_j)` with the polar forms `F` (halved where
/// `i = j`): one factorisation serves all orders. With `C(t) = C_0 + t C'` the right-hand side is
/// `C_0 u_k + C' (t u_k + w_{k-1})`, products with constant matrices only.
#[inline(always)]
pub(super) fn taylor<S: Simd, L: SectionPath<F>, const F: usize>(
    homotopy: &L,
    t: Lanes<S>,
    x: &Vec8<S>,
    series: &mut Series<S>,
    solve: impl Fn(&mut Vec8<S>),
) where
    QuadraticForms<F>: Quadrics<F>,
{
    let zero = Lanes::zero(t.simd);
    let half = Lanes::splat(t.simd, Complex64::new(-0.5, 0.0));
    // F(x, x) is halved
    let twice = L::moved_polar(x, x);
    let mut full = L::moved_sum(&twice, half, &twice);
    let (mut inner, mut study) = ([zero; F], zero);
    for k in 1..=ORDER {
        for i in 1..=k / 2 {
            let j = k - i;
            let (f, s) = QuadraticForms::polar(&series[i - 1], &series[j - 1]);
            let part = |z: Lanes<S>| if i == j { z.times(0.5) } else { z };
            // the first of an order takes the place of the order before
            for n in 0..F {
                inner[n] = if i == 1 { part(f[n]) } else { inner[n] + part(f[n]) };
            }
            study = if i == 1 { part(s) } else { study + part(s) };
        }
        let sections = if k == 1 {
            homotopy.combine(None, &full)
        } else {
            full = L::moved_sum(&full, t, &L::moved(&inner));
            homotopy.combine(Some(&inner), &full)
        };
        let rhs = &mut series[k - 1];
        for i in 0..6 {
            rhs[i] = -sections[i];
        }
        rhs[6] = -study;
        rhs[7] = zero;
        solve(rhs);
        if k < ORDER {
            let one = Lanes::splat(t.simd, Complex64::ONE);
            full = L::moved_sum(&L::moved(&inner), one, &L::moved_polar(x, &series[k - 1]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::homotopy::lu::Lu;
    use crate::solve::sections::{FormRow, forms};
    use num::Rng;
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
        let (polar, study) = QuadraticForms::<FORMS>::polar(&lanes(x), &lanes(y));
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
        // sections through x at t = 1/2 only: the target row is the start row mirrored in the line of the forms at x
        let f = forms(x);
        let ff: Complex64 = f.iter().map(|z| z * z).sum();
        let start: [FormRow; 6] =
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
        let mut series = blank_series(Scalar::new());
        taylor(&homotopy, t0, &lanes(x), &mut series, |b| *b = lu.solve(*b));
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
