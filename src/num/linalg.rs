//! Decompositions of matrices given by rows, a few dozen rows at most, in a bounded number of steps.

use nalgebra::{DMatrix, DVector, Schur};
use num_complex::Complex64;
use thiserror::Error;

use super::small::{STEPS, complete, decompose};

/// Entries below the diagonal smaller than this, relative to their neighbours, count as zero, as in `nalgebra`.
const SETTLED: f64 = 5.0 * f64::EPSILON;

/// A decomposition that did not converge.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LinalgError {
    /// The iteration for singular values or eigenvalues did not converge.
    #[error("the {decomposition} of a {rows} x {columns} matrix did not converge")]
    NoConvergence {
        /// The decomposition.
        decomposition: &'static str,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
}

/// Singular value decomposition `M = U diag(s) V^T` of a real matrix.
#[derive(Debug, Clone)]
pub struct Svd {
    /// Left singular vectors, one per column: `u[i][k]` is entry `i` of vector `k` (rows x rank bound).
    pub u: Vec<Vec<f64>>,
    /// Singular values, largest first.
    pub s: Vec<f64>,
    /// Right singular vectors: `v[i][k]` is entry `i` of vector `k` (columns x columns, full basis).
    pub v: Vec<Vec<f64>>,
}

fn rows_of(m: &DMatrix<f64>) -> Vec<Vec<f64>> {
    m.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// SVD of the matrix with the given rows (all of one length), with full orthogonal `U` and `V`.
///
/// # Errors
/// When the iteration does not converge (non-finite entries).
pub fn svd(rows: &[Vec<f64>]) -> Result<Svd, LinalgError> {
    let (m, n) = (rows.len(), rows.first().map_or(0, Vec::len));
    let failed = LinalgError::NoConvergence { decomposition: "SVD", rows: m, columns: n };
    let (long, short) = (m.max(n), m.min(n));
    let entry = |i: usize, j: usize| if m < n { rows[j][i] } else { rows[i][j] };
    let mut left = DMatrix::from_fn(long, long, |i, j| if j < short { entry(i, j) } else { 0.0 });
    let mut right = DMatrix::identity(short, short);
    let mut s = vec![0.0; short];
    let columns = &mut left.as_mut_slice()[..long * short];
    decompose(columns, right.as_mut_slice(), &mut s).ok_or(failed)?;
    for k in short..long {
        let (before, from) = left.as_mut_slice().split_at_mut(k * long);
        complete(before, &mut from[..long]);
    }
    let (u, v) = if m < n { (right, left) } else { (left, right) };
    Ok(Svd { u: rows_of(&u), s, v: rows_of(&v) })
}

/// Eigenvalues of a real square matrix given by rows.
///
/// # Errors
/// When the iteration does not converge.
pub fn eigenvalues(rows: &[Vec<f64>]) -> Result<Vec<Complex64>, LinalgError> {
    let n = rows.len();
    let failed = LinalgError::NoConvergence { decomposition: "eigendecomposition", rows: n, columns: n };
    if rows.iter().flatten().any(|x| !x.is_finite()) {
        return Err(failed);
    }
    let matrix = DMatrix::from_fn(n, n, |i, j| rows[i][j]);
    // the shifts of `nalgebra` leave a cyclic permutation unchanged; a reflection makes it no permutation
    let of = |m: DMatrix<f64>| Schur::try_new(m, SETTLED, STEPS).map(|d| d.complex_eigenvalues());
    let values = of(matrix.clone()).or_else(|| of(reflected(&matrix))).ok_or(failed)?;
    Ok(values.iter().copied().collect())
}

/// `H m H` with the reflection `H` that reverses `(1, 2, .., n)`: the same eigenvalues.
fn reflected(m: &DMatrix<f64>) -> DMatrix<f64> {
    let n = m.nrows();
    let axis = DVector::from_fn(n, |i, _| (i + 1) as f64).normalize();
    let h = DMatrix::identity(n, n) - &axis * axis.transpose() * 2.0;
    &h * m * &h
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn svd_rebuilds_the_matrix_and_eigenvalues_of_a_companion() {
        let rows = vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
        let d = svd(&rows).unwrap();
        assert_eq!((d.u.len(), d.s.len(), d.v.len(), d.v[0].len()), (2, 2, 3, 3));
        for i in 0..2 {
            for j in 0..3 {
                let x: f64 = (0..2).map(|k| d.u[i][k] * d.s[k] * d.v[j][k]).sum();
                assert!((x - rows[i][j]).abs() < 1e-13);
            }
        }
        // x^2 - 2x + 5: roots 1 +- 2i
        let mut z = eigenvalues(&[vec![2.0, -5.0], vec![1.0, 0.0]]).unwrap();
        z.sort_by(|a, b| a.im.total_cmp(&b.im));
        assert!((z[1] - Complex64::new(1.0, 2.0)).norm() < 1e-13);
    }

    #[test]
    fn svd_has_full_orthogonal_bases_whatever_the_shape_and_rank() {
        let mut rng = Rng::new(3);
        for k in 0..300 {
            let (m, n) = (1 + k % 9, 1 + k / 9 % 17);
            let rank = 1 + k % m.min(n);
            let mut factor = |a: usize, b: usize| DMatrix::from_fn(a, b, |_, _| rng.normal());
            let matrix = factor(m, rank) * factor(rank, n);
            let d = svd(&rows_of(&matrix)).unwrap();
            assert_eq!((d.u.len(), d.u[0].len(), d.v.len(), d.v[0].len()), (m, m, n, n));
            assert_eq!(d.s.len(), m.min(n));
            assert!(d.s.windows(2).all(|s| s[0] >= s[1]) && d.s.iter().all(|s| *s >= 0.0));
            let top = d.s[0];
            assert!(d.s[rank..].iter().all(|s| *s < 1e-14 * top), "{:?}", d.s);
            let u = DMatrix::from_fn(m, m, |i, j| d.u[i][j]);
            let v = DMatrix::from_fn(n, n, |i, j| d.v[i][j]);
            assert!((u.tr_mul(&u) - DMatrix::identity(m, m)).amax() < 1e-13);
            assert!((v.tr_mul(&v) - DMatrix::identity(n, n)).amax() < 1e-13);
            let middle = DMatrix::from_fn(m, n, |i, j| if i == j { d.s[i] } else { 0.0 });
            let off = (u * middle * v.transpose() - matrix).amax();
            assert!(off < 1e-13 * top, "{m} x {n} of rank {rank}: {off:e} of {top}");
        }
        let none = svd(&[vec![0.0; 3], vec![0.0; 3]]).unwrap();
        assert_eq!((none.s, none.u.len(), none.v.len()), (vec![0.0; 2], 2, 3));
        // entries from the least to the largest
        assert!(svd(&[vec![5e-324, 0.0], vec![5e-324, 0.0]]).unwrap().s[0] > 0.0);
        for scale in [1e-300, 1.0, 1e300] {
            let d = svd(&[vec![scale, 0.0], vec![scale, 1e-200 * scale]]).unwrap();
            assert!((d.s[0] / scale - 2.0f64.sqrt()).abs() < 1e-15 && d.s[1] <= 1e-16 * d.s[0]);
        }
        assert!(svd(&[vec![f64::NAN, 1.0], vec![0.0, 1.0]]).is_err());
    }

    #[test]
    fn eigenvalues_make_the_shifted_matrix_singular_also_where_they_are_multiple() {
        let mut rng = Rng::new(8);
        for k in 0..200 {
            let n = 1 + k % 12;
            let mut m = DMatrix::from_fn(n, n, |_, _| rng.normal());
            match k % 4 {
                1 => m = &m * m.transpose(),
                2 => m.row_mut(n - 1).fill(0.0),
                3 => {
                    let unit = |is: bool| f64::from(u8::from(is));
                    m = DMatrix::from_fn(n, n, |i, j| unit(j == i + 1) + unit(j == i));
                }
                _ => {}
            }
            let values = eigenvalues(&rows_of(&m)).unwrap();
            assert_eq!(values.len(), n);
            let trace: Complex64 = values.iter().sum();
            assert!((trace - m.trace()).norm() < 1e-12 * (1.0 + m.norm()));
            for z in values {
                // a complex matrix as a real one of twice the size
                let entry = |i: usize, j: usize| {
                    let unit = f64::from(u8::from(i % n == j % n));
                    match (i < n, j < n) {
                        (true, false) => unit * z.im,
                        (false, true) => -unit * z.im,
                        _ => m[(i % n, j % n)] - unit * z.re,
                    }
                };
                let shifted = DMatrix::from_fn(2 * n, 2 * n, entry);
                let least = svd(&rows_of(&shifted)).unwrap().s[2 * n - 1];
                assert!(least < 1e-13 * (1.0 + m.norm()), "{n}: {least:e}");
            }
        }
    }

    #[test]
    fn eigenvalues_of_cyclic_permutations_are_roots_of_one() {
        for n in 2..9 {
            let rows: Vec<Vec<f64>> =
                (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(j == (i + 1) % n))).collect()).collect();
            let values = eigenvalues(&rows).unwrap();
            assert_eq!(values.len(), n);
            for k in 0..n {
                let root = Complex64::from_polar(1.0, std::f64::consts::TAU * k as f64 / n as f64);
                assert!(values.iter().any(|z| (z - root).norm() < 1e-12), "{n}: {values:?}");
            }
        }
        assert!(eigenvalues(&[vec![f64::NAN]]).is_err());
    }
}
