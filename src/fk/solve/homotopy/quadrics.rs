//! The quadratic forms behind the sections: their polar forms and gradients, several paths at a time.

use pulp::Simd;

use super::lanes::{Lanes, Vec8};
use super::system::Coefficient;
use crate::solve::planar::PLANAR_FORMS;
use crate::solve::sections::{FORMS, NORM_FORMS};

/// A set of `F` quadratic forms in `x = (e, g)`; [`Quadrics`] says which.
pub(super) struct QuadraticForms<const F: usize>;

/// The operations of the tracker on a set of forms.
pub(super) trait Quadrics<const F: usize> {
    /// Symmetrised forms of two vectors: `forms(x + y) - forms(x) - forms(y)`, and last `e.g' + e'.g`.
    fn polar<S: Simd>(x: &Vec8<S>, y: &Vec8<S>) -> ([Lanes<S>; F], Lanes<S>);

    /// Gradient of `row . forms` at `x`.
    fn gradient<S: Simd>(row: &[Lanes<S>; F], x: &Vec8<S>) -> Vec8<S>;

    /// [`gradient`](Self::gradient) of a real row.
    fn real_gradient<S: Simd>(row: &[f64; F], x: &Vec8<S>) -> Vec8<S>;

    /// `e.e` from the values of the forms.
    fn norm<S: Simd>(forms: &[Lanes<S>; F]) -> Lanes<S>;
}

/// All 17 forms, in the order of [`FormRow`](crate::solve::sections::FormRow).
impl Quadrics<FORMS> for QuadraticForms<FORMS> {
    #[inline(always)]
    fn polar<S: Simd>(x: &Vec8<S>, y: &Vec8<S>) -> ([Lanes<S>; FORMS], Lanes<S>) {
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
            f[12 + i] =
                (x[p] * y[4 + q]).mul_sub(x[q], y[4 + p]).mul_add(y[p], x[4 + q]).mul_sub(y[q], x[4 + p]);
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

    #[inline(always)]
    fn gradient<S: Simd>(r: &[Lanes<S>; FORMS], x: &Vec8<S>) -> Vec8<S> {
        let zero = Lanes::zero(x[0].simd);
        let sym = [
            [r[0], r[1], r[2], r[3]],
            [r[1], r[4], r[5], r[6]],
            [r[2], r[5], r[7], r[8]],
            [r[3], r[6], r[8], r[9]],
        ];
        let (m, n, c) = ([r[10], r[11], r[12]], [r[13], r[14], r[15]], r[16]);
        let te = skew_times(m, n, [x[0], x[1], x[2], x[3]]);
        let tg = skew_times(m, n, [x[4], x[5], x[6], x[7]]);
        let mut out = [zero; 8];
        for p in 0..4 {
            let mut ee = zero;
            for q in 0..4 {
                ee = ee.mul_add(sym[p][q], x[q]);
            }
            out[p] = ee.times(2.0) - tg[p];
            out[4 + p] = te[p] + (c * x[4 + p]).times(2.0);
        }
        out
    }

    #[inline(always)]
    fn real_gradient<S: Simd>(r: &[f64; FORMS], x: &Vec8<S>) -> Vec8<S> {
        let zero = Lanes::zero(x[0].simd);
        let sym = [
            [r[0], r[1], r[2], r[3]],
            [r[1], r[4], r[5], r[6]],
            [r[2], r[5], r[7], r[8]],
            [r[3], r[6], r[8], r[9]],
        ];
        let (m, n, c) = ([r[10], r[11], r[12]], [r[13], r[14], r[15]], 2.0 * r[16]);
        // the rows of T, skew
        let skew = [
            [0.0, -m[0], -m[1], -m[2]],
            [m[0], 0.0, -n[2], n[1]],
            [m[1], n[2], 0.0, -n[0]],
            [m[2], -n[1], n[0], 0.0],
        ];
        let mut out = [zero; 8];
        for p in 0..4 {
            let (mut top, mut bottom) = (zero, x[4 + p].times(c));
            for q in 0..4 {
                top = (2.0 * sym[p][q]).add_times(top, x[q]);
                if q != p {
                    top = (-skew[p][q]).add_times(top, x[4 + q]);
                    bottom = skew[p][q].add_times(bottom, x[q]);
                }
            }
            (out[p], out[4 + p]) = (top, bottom);
        }
        out
    }

    #[inline(always)]
    fn norm<S: Simd>(forms: &[Lanes<S>; FORMS]) -> Lanes<S> {
        // no closures here: they would be compiled for the baseline and be called
        let [a, b, c, d] = NORM_FORMS;
        (forms[a] + forms[b]) + (forms[c] + forms[d])
    }
}

/// The ten forms of doubly planar platforms, in the order of [`PlanarRow`](crate::solve::planar::PlanarRow).
impl Quadrics<PLANAR_FORMS> for QuadraticForms<PLANAR_FORMS> {
    #[inline(always)]
    fn polar<S: Simd>(x: &Vec8<S>, y: &Vec8<S>) -> ([Lanes<S>; PLANAR_FORMS], Lanes<S>) {
        let [a0, a1, a2, a3, b0, b1, b2, b3] = *x;
        let [c0, c1, c2, c3, d0, d1, d2, d3] = *y;
        let (p0, p1, p2, p3) = (a0 * c0, a1 * c1, a2 * c2, a3 * c3);
        let (outer, inner) = (p0 + p3, p1 + p2);
        let gg = (b0 * d0).mul_add(b1, d1).mul_add(b2, d2).mul_add(b3, d3);
        let forms = [
            (outer + inner).times(2.0),
            (p0 - p3).times(2.0),
            (p1 - p2).times(2.0),
            (a0 * c3).mul_add(a3, c0).times(2.0),
            (a1 * c2).mul_add(a2, c1).times(2.0),
            (a0 * d1).mul_add(c0, b1).mul_sub(b0, c1).mul_sub(d0, a1),
            (a0 * d2).mul_add(c0, b2).mul_sub(b0, c2).mul_sub(d0, a2),
            (a2 * d3).mul_sub(a3, d2).mul_add(c2, b3).mul_sub(c3, b2),
            (a3 * d1).mul_sub(a1, d3).mul_add(c3, b1).mul_sub(c1, b3),
            gg.times(2.0),
        ];
        let study = (a0 * d0).mul_add(a1, d1).mul_add(a2, d2).mul_add(a3, d3);
        let study = study.mul_add(c0, b0).mul_add(c1, b1).mul_add(c2, b2).mul_add(c3, b3);
        (forms, study)
    }

    #[inline(always)]
    fn gradient<S: Simd>(row: &[Lanes<S>; PLANAR_FORMS], x: &Vec8<S>) -> Vec8<S> {
        let [e0, e1, e2, e3, g0, g1, g2, g3] = *x;
        // no closures here: they would be compiled for the baseline and be called
        let (norm, outer, inner) = (row[0] + row[0], row[1] + row[1], row[2] + row[2]);
        let (w03, w12, c) = (row[3] + row[3], row[4] + row[4], row[9] + row[9]);
        let (mx, my, nx, ny) = (row[5], row[6], row[7], row[8]);
        [
            ((norm + outer) * e0).mul_add(w03, e3).mul_add(mx, g1).mul_add(my, g2),
            ((norm + inner) * e1).mul_add(w12, e2).mul_sub(mx, g0).mul_sub(ny, g3),
            ((norm - inner) * e2).mul_add(w12, e1).mul_sub(my, g0).mul_add(nx, g3),
            ((norm - outer) * e3).mul_add(w03, e0).mul_sub(nx, g2).mul_add(ny, g1),
            (c * g0).mul_sub(mx, e1).mul_sub(my, e2),
            (c * g1).mul_add(mx, e0).mul_add(ny, e3),
            (c * g2).mul_add(my, e0).mul_sub(nx, e3),
            (c * g3).mul_add(nx, e2).mul_sub(ny, e1),
        ]
    }

    #[inline(always)]
    fn real_gradient<S: Simd>(row: &[f64; PLANAR_FORMS], x: &Vec8<S>) -> Vec8<S> {
        let [e0, e1, e2, e3, g0, g1, g2, g3] = *x;
        let (norm, outer, inner) = (2.0 * row[0], 2.0 * row[1], 2.0 * row[2]);
        let (w03, w12, c) = (2.0 * row[3], 2.0 * row[4], 2.0 * row[9]);
        let (mx, my, nx, ny) = (row[5], row[6], row[7], row[8]);
        [
            my.add_times(mx.add_times(w03.add_times(e0.times(norm + outer), e3), g1), g2),
            (-ny).add_times((-mx).add_times(w12.add_times(e1.times(norm + inner), e2), g0), g3),
            nx.add_times((-my).add_times(w12.add_times(e2.times(norm - inner), e1), g0), g3),
            ny.add_times((-nx).add_times(w03.add_times(e3.times(norm - outer), e0), g2), g1),
            (-my).add_times((-mx).add_times(g0.times(c), e1), e2),
            ny.add_times(mx.add_times(g1.times(c), e0), e3),
            (-nx).add_times(my.add_times(g2.times(c), e0), e3),
            (-ny).add_times(nx.add_times(g3.times(c), e2), e1),
        ]
    }

    #[inline(always)]
    fn norm<S: Simd>(forms: &[Lanes<S>; PLANAR_FORMS]) -> Lanes<S> {
        forms[0]
    }
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
