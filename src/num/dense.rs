//! The only interface to faer: eigenvalue problems and triangular factors of larger matrices. The comparison
//! eliminations and the timing units of `bench` use it; all other matrices are small ([`super::linalg`]).
//!
//! faer is built without its `rayon` feature, so every call is sequential and deterministic; problems run in parallel
//! outside.

use faer::{Mat, MatRef};
use num_complex::Complex64;

use super::linalg::LinalgError;

fn rows_of(m: MatRef<'_, f64>) -> Vec<Vec<f64>> {
    (0..m.nrows()).map(|i| (0..m.ncols()).map(|j| m[(i, j)]).collect()).collect()
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

/// One root `alpha / beta` of `det(A beta - B alpha) = 0` with its right eigenvector.
///
/// The ratio is kept as two numbers: `beta` near zero (relative to the pencil's norm) is a root at infinity.
#[derive(Debug, Clone, PartialEq)]
pub struct GeneralizedEigenpair {
    /// Numerator.
    pub alpha: Complex64,
    /// Denominator, nonnegative for a regular pencil.
    pub beta: Complex64,
    /// `x` with `beta A x = alpha B x`.
    pub vector: Vec<Complex64>,
}

/// Eigenvalues and right eigenvectors of the real square pencil `A x = lambda B x`, both given by rows (QZ).
///
/// # Errors
/// When the iteration does not converge.
pub fn generalized_eigenpairs(
    a: &[Vec<f64>],
    b: &[Vec<f64>],
) -> Result<Vec<GeneralizedEigenpair>, LinalgError> {
    let n = a.len();
    let (a, b) = (Mat::from_fn(n, n, |i, j| a[i][j]), Mat::from_fn(n, n, |i, j| b[i][j]));
    let failed = LinalgError::NoConvergence { decomposition: "QZ decomposition", rows: n, columns: n };
    let d = a.generalized_eigen(&b).map_err(|_| failed)?;
    let complex = |z: faer::c64| Complex64::new(z.re, z.im);
    let pair = |k: usize| GeneralizedEigenpair {
        alpha: complex(d.S_a()[k]),
        beta: complex(d.S_b()[k]),
        vector: (0..n).map(|i| complex(d.U()[(i, k)])).collect(),
    };
    Ok((0..n).map(pair).collect())
}

/// Factor `U` of `P M = L U` (partial pivoting) of a matrix with at least as many columns as rows, by rows.
#[must_use]
pub fn upper_factor(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (m, n) = (rows.len(), rows.first().map_or(0, Vec::len));
    rows_of(Mat::from_fn(m, n, |i, j| rows[i][j]).partial_piv_lu().U())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pencil_with_a_root_at_infinity_and_a_conjugate_pair() {
        // blocks: [0 1; -1 0] - lambda I, 3 - 2 lambda, 5 - 0 lambda, mixed by unimodular matrices
        let a = [[0.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 3.0, 0.0], [0.0, 0.0, 0.0, 5.0]];
        let b = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 2.0, 0.0], [0.0, 0.0, 0.0, 0.0]];
        let mix = |m: [[f64; 4]; 4]| -> Vec<Vec<f64>> {
            let mut m = m;
            for i in 1..4 {
                for j in 0..4 {
                    m[i][j] += 0.5 * m[i - 1][j];
                }
            }
            for row in &mut m {
                for j in 0..3 {
                    row[j] -= 2.0 * row[j + 1];
                }
            }
            m.map(Vec::from).to_vec()
        };
        let (a, b) = (mix(a), mix(b));
        let pairs = generalized_eigenpairs(&a, &b).unwrap();
        let infinite = |p: &&GeneralizedEigenpair| p.beta.norm() < 1e-12 * p.alpha.norm();
        assert_eq!(pairs.iter().filter(infinite).count(), 1);
        for expected in [Complex64::I, -Complex64::I, Complex64::new(1.5, 0.0)] {
            assert!(pairs.iter().any(|p| (p.alpha - p.beta * expected).norm() < 1e-12 * p.beta.norm()));
        }
        for p in &pairs {
            let size: f64 = p.vector.iter().map(|z| z.norm()).sum();
            for (ra, rb) in a.iter().zip(&b) {
                let defect: Complex64 =
                    ra.iter().zip(rb).zip(&p.vector).map(|((x, y), v)| v * (p.beta * x - p.alpha * y)).sum();
                assert!(defect.norm() < 1e-12 * size * (p.alpha.norm() + p.beta.norm()));
            }
        }
    }

    #[test]
    fn upper_factor_of_a_wide_matrix_spans_its_rows() {
        let rows = vec![vec![1.0, 2.0, 3.0, 4.0], vec![4.0, 5.0, 6.0, -1.0], vec![7.0, 8.0, 1.0, 2.0]];
        let u = upper_factor(&rows);
        assert_eq!((u.len(), u[0].len()), (3, 4));
        assert!(u[1][0] == 0.0 && u[2][0] == 0.0 && u[2][1] == 0.0);
        // the last row is the only combination of the rows that starts with two zeros, up to scale
        let det = |c: [usize; 3]| {
            let m = nalgebra::Matrix3::from_fn(|i, j| rows[i][c[j]]);
            m.determinant()
        };
        assert!((u[2][3] / u[2][2] - det([0, 1, 3]) / det([0, 1, 2])).abs() < 1e-12);
    }
}
