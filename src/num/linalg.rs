//! Dense linear algebra by faer; no other file names it.
//!
//! faer is built without its `rayon` feature, so every call is sequential: equal inputs give equal bytes,
//! and parallelism is over problems, outside.

use faer::{Mat, MatRef};
use num_complex::Complex64;
use thiserror::Error;

/// A decomposition that did not converge.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LinalgError {
    /// The iteration for singular values or eigenvalues did not converge.
    #[error("the {decomposition} of a {rows} x {columns} matrix did not converge")]
    NoConvergence {
        /// Which decomposition.
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
    /// Left singular vectors, one a column: `u[i][k]` is entry `i` of vector `k` (rows x rank bound).
    pub u: Vec<Vec<f64>>,
    /// Singular values, largest first.
    pub s: Vec<f64>,
    /// Right singular vectors: `v[i][k]` is entry `i` of vector `k` (columns x columns, full basis).
    pub v: Vec<Vec<f64>>,
}

fn rows_of(m: MatRef<'_, f64>) -> Vec<Vec<f64>> {
    (0..m.nrows()).map(|i| (0..m.ncols()).map(|j| m[(i, j)]).collect()).collect()
}

/// SVD of the matrix with the given rows (all of one length), with full orthogonal `U` and `V`.
///
/// # Errors
/// When the iteration does not converge (non-finite entries).
pub fn svd(rows: &[Vec<f64>]) -> Result<Svd, LinalgError> {
    let (m, n) = (rows.len(), rows.first().map_or(0, Vec::len));
    let matrix = Mat::from_fn(m, n, |i, j| rows[i][j]);
    let failed = LinalgError::NoConvergence { decomposition: "SVD", rows: m, columns: n };
    let d = matrix.svd().map_err(|_| failed)?;
    let s = (0..m.min(n)).map(|k| d.S()[k]).collect();
    Ok(Svd { u: rows_of(d.U()), s, v: rows_of(d.V()) })
}

/// Eigenvalues of a real square matrix given by rows.
///
/// # Errors
/// When the iteration does not converge.
pub fn eigenvalues(rows: &[Vec<f64>]) -> Result<Vec<Complex64>, LinalgError> {
    let n = rows.len();
    let matrix = Mat::from_fn(n, n, |i, j| rows[i][j]);
    let failed = LinalgError::NoConvergence { decomposition: "eigendecomposition", rows: n, columns: n };
    let values = matrix.eigenvalues().map_err(|_| failed)?;
    Ok(values.iter().map(|z| Complex64::new(z.re, z.im)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
