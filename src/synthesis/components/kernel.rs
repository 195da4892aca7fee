//! Polynomial kernels of matrices of polynomials: which platform points belong to a moving base point.

use super::form::{exponents, index, power};
use super::spectrum::{Spectrum, norm, unit, without};
use crate::num::linalg::LinalgError;

/// `sum_e t^e vectors[e]`.
pub(super) type Polynomial = Vec<Vec<f64>>;

/// The value of a polynomial at `num / den`, times `den^degree`.
pub(super) fn value(p: &Polynomial, num: f64, den: f64) -> Vec<f64> {
    let degree = p.len() - 1;
    let mut out = vec![0.0; p[0].len()];
    for (e, c) in p.iter().enumerate() {
        let factor = power(num, e) * power(den, degree - e);
        out.iter_mut().zip(c).for_each(|(o, x)| *o += factor * x);
    }
    out
}

/// Coefficients of degree `degree` of `t^s v` for all shifts `s` that fit.
fn shifted(v: &Polynomial, degree: usize) -> Vec<Vec<f64>> {
    let width = v[0].len();
    let at = |s: usize| {
        let mut out = vec![0.0; width * (degree + 1)];
        for (e, c) in v.iter().enumerate() {
            out[(e + s) * width..(e + s + 1) * width].copy_from_slice(c);
        }
        out
    };
    (0..(degree + 2).saturating_sub(v.len())).map(at).collect()
}

/// A minimal polynomial basis, of `dimension` vectors, of the kernel of `M(t) = sum_e t^e matrices[e]`.
///
/// `M(t) b(t) = 0` with `deg b = d` is a linear system for the coefficients of `b`. Going through `d = 0, 1, ..` and
/// leaving out `t^s b_l(t)` of the vectors found already gives a basis of least degrees (Forney 1975).
/// The degrees are bounded by the sum of the row degrees.
pub(super) fn minimal_kernel(
    matrices: &[Vec<Vec<f64>>],
    width: usize,
    dimension: usize,
    tolerance: f64,
) -> Result<Vec<Polynomial>, LinalgError> {
    let (order, height) = (matrices.len() - 1, matrices[0].len());
    let mut found: Vec<Polynomial> = Vec::new();
    let last = (order * height).min(8);
    for degree in 0..=last {
        let rows = stacked(matrices, width, degree);
        let s = Spectrum::of(&rows, width * (degree + 1))?;
        let top = s.values.first().copied().unwrap_or(0.0);
        let null = s.kernel(s.rank(tolerance * top));
        let mut known: Vec<Vec<f64>> = Vec::new();
        for v in found.iter().flat_map(|v| shifted(v, degree)) {
            known.push(unit(&without(&v, &known)));
        }
        let fresh: Vec<Vec<f64>> = null.iter().map(|v| without(v, &known)).collect();
        let fresh = Spectrum::of(&fresh, width * (degree + 1))?;
        let count = null.len().saturating_sub(known.len()).min(dimension - found.len());
        for v in fresh.image(count) {
            found.push(scaled(v).chunks(width).map(<[f64]>::to_vec).collect());
        }
        if found.len() == dimension {
            break;
        }
    }
    Ok(found)
}

/// The linear system for the coefficients of degree `degree`: block `k` of the rows belongs to `t^k`.
fn stacked(matrices: &[Vec<Vec<f64>>], width: usize, degree: usize) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    for power in 0..degree + matrices.len() {
        for i in 0..matrices[0].len() {
            let mut row = vec![0.0; width * (degree + 1)];
            for e in 0..=degree {
                if let Some(m) = power.checked_sub(e).and_then(|k| matrices.get(k)) {
                    row[e * width..(e + 1) * width].copy_from_slice(&m[i]);
                }
            }
            rows.push(row);
        }
    }
    rows
}

/// Divided by the entry of largest modulus: a sign and a size that do not depend on the decomposition.
pub(super) fn scaled(v: &[f64]) -> Vec<f64> {
    let largest = v.iter().fold(0.0f64, |m, x| if x.abs() > 1.000_001 * m.abs() { *x } else { m });
    let tiny = 1e-14 * largest.abs();
    v.iter().map(|x| if x.abs() <= tiny { 0.0 } else { x / largest }).collect()
}

/// A vector of forms of least degree (at most 2) in three variables in the kernel of `M(alpha)`, whose entries are
/// linear forms: the coefficient vectors in the order of [`exponents`].
pub(super) fn planar_kernel(
    equations: &[Vec<f64>],
    width: usize,
    tolerance: f64,
) -> Result<Option<(usize, Polynomial)>, LinalgError> {
    for degree in 0..=2 {
        let count = (degree + 1) * (degree + 2) / 2;
        let mut rows = Vec::new();
        for n in equations {
            let mut block = vec![vec![0.0; width * count]; (degree + 2) * (degree + 3) / 2];
            for e in exponents(degree) {
                for p in 0..3 {
                    let mut up = e;
                    up[p] += 1;
                    let at = index(e) * width;
                    block[index(up)][at..at + width]
                        .iter_mut()
                        .zip(&n[p * width..])
                        .for_each(|(x, y)| *x += y);
                }
            }
            rows.append(&mut block);
        }
        let s = Spectrum::of(&rows, width * count)?;
        let top = s.values.first().copied().unwrap_or(0.0);
        if let Some(v) = s.kernel(s.rank(tolerance * top)).last().filter(|v| norm(v) > 0.0) {
            return Ok(Some((degree, scaled(v).chunks(width).map(<[f64]>::to_vec).collect())));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_of_known_degrees() {
        // rows (1, -t, 0), (0, 1, -t): kernel (t^2, t, 1)
        let m0 = vec![vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0]];
        let m1 = vec![vec![0.0, -1.0, 0.0], vec![0.0, 0.0, -1.0]];
        let k = minimal_kernel(&[m0, m1], 3, 1, 1e-9).unwrap();
        assert_eq!((k.len(), k[0].len()), (1, 3));
        let b = value(&k[0], 2.0, 1.0);
        assert!((b[0] / b[2] - 4.0).abs() < 1e-12 && (b[1] / b[2] - 2.0).abs() < 1e-12);
        // one row (1, -t, 0): kernel (t, 1, 0) and (0, 0, 1)
        let k = minimal_kernel(&[vec![vec![1.0, 0.0, 0.0]], vec![vec![0.0, -1.0, 0.0]]], 3, 2, 1e-9).unwrap();
        assert_eq!(k.iter().map(Vec::len).collect::<Vec<_>>(), [1, 2]);
        let b = value(&k[1], 3.0, 1.0);
        assert!((b[0] / b[1] - 3.0).abs() < 1e-12 && b[2].abs() < 1e-12);
    }

    #[test]
    fn the_kernel_of_a_skew_matrix_is_the_point_itself() {
        // M(alpha) beta = alpha x beta
        let mut equations = vec![vec![0.0; 9]; 3];
        for (r, p, q) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            equations[r][p * 3 + q] = 1.0;
            equations[r][q * 3 + p] = -1.0;
        }
        let (degree, k) = planar_kernel(&equations, 3, 1e-9).unwrap().unwrap();
        assert_eq!(degree, 1);
        for (e, c) in exponents(1).zip(&k) {
            let p = e.iter().position(|x| *x == 1).unwrap();
            assert!(c.iter().enumerate().all(|(q, x)| (x.abs() > 0.5) == (p == q)));
        }
    }
}
