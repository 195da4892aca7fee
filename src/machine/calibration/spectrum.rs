//! Solutions of linear equations and the directions that they determine, by an orthogonal decomposition.

use nalgebra::{DMatrix, DVector, Matrix6};

use num::small::bounded_svd;

/// `rows x = right` with equations of variance 1: `rows = U diag(s) V^T` and `U^T right`.
///
/// Orthogonal triangularisation, then the singular values of the triangle: normal equations would square the condition
/// number.
#[derive(Debug, Clone)]
pub(super) struct FitSpectrum {
    /// Singular values, largest first: one over the standard deviation of the unknowns along each direction.
    pub(super) values: DVector<f64>,
    /// Directions, as columns.
    pub(super) directions: DMatrix<f64>,
    /// `U^T right`.
    projected: DVector<f64>,
    /// The number of directions that are known well enough.
    pub(super) rank: usize,
    /// The least singular value of a known direction.
    pub(super) least: f64,
}

impl FitSpectrum {
    /// Directions count as known where their standard deviation is at most `widest` and rounding leaves digits of them.
    /// `None` for entries that are not finite.
    pub(super) fn of(rows: DMatrix<f64>, right: DVector<f64>, widest: f64) -> Option<Self> {
        let (equations, unknowns) = rows.shape();
        let height = equations.max(unknowns);
        let (rows, mut right) = (rows.resize_vertically(height, 0.0), right.resize_vertically(height, 0.0));
        let factors = rows.qr();
        factors.q_tr_mul(&mut right);
        let svd = bounded_svd(&factors.unpack_r())?;
        let (u, v_t) = (svd.u?, svd.v_t?);
        let projected = u.tr_mul(&right.rows(0, unknowns));
        let values = svd.singular_values;
        let greatest = if unknowns > 0 { values.max() } else { 0.0 };
        let least = (1.0 / widest).max(ROUNDING * height as f64 * f64::EPSILON * greatest);
        let rank = values.iter().filter(|s| **s >= least && **s > 0.0).count();
        Some(Self { values, directions: v_t.transpose(), projected, rank, least })
    }

    /// `(rows^T rows + damping I)^-1 rows^T right` along the known directions.
    pub(super) fn step(&self, damping: f64) -> DVector<f64> {
        let mut out = DVector::zeros(self.directions.nrows());
        for k in 0..self.rank {
            let s = self.values[k];
            out.axpy(s / (s * s + damping) * self.projected[k], &self.directions.column(k), 1.0);
        }
        out
    }

    /// The predicted reduction of the sum of squares of the right side by [`step`](Self::step), for exact equations.
    pub(super) fn reduction(&self, damping: f64) -> f64 {
        let gain = |k: usize| {
            let left = damping / (self.values[k] * self.values[k] + damping);
            let left = if left.is_nan() { 0.0 } else { left };
            self.projected[k] * self.projected[k] * (1.0 - left * left)
        };
        (0..self.rank).map(gain).sum()
    }

    /// A root `F` of the covariance `F F^T` of the unknowns: known directions alone.
    pub(super) fn covariance_root(&self) -> DMatrix<f64> {
        let n = self.directions.nrows();
        DMatrix::from_fn(n, self.rank, |i, k| self.directions[(i, k)] / self.values[k])
    }

    /// The same root, with the deviation `widest` along unknown directions.
    pub(super) fn bounded_root(&self, widest: f64) -> DMatrix<f64> {
        let n = self.directions.nrows();
        let scale = |s: f64| 1.0 / s.hypot(1.0 / widest);
        DMatrix::from_fn(n, n, |i, k| self.directions[(i, k)] * scale(self.values[k]))
    }

    /// The unknown directions, each with few coordinates: columns of the projector on them, the largest first, made
    /// orthonormal.
    pub(super) fn unknown_directions(&self) -> Vec<DVector<f64>> {
        let n = self.directions.nrows();
        let null = self.directions.columns(self.rank, n - self.rank);
        let mut projector = null * null.transpose();
        (self.rank..n)
            .map(|_| {
                // the first of those that are equal up to rounding
                let top = projector.diagonal().max() * (1.0 - 1e-9);
                let pivot = (0..n).find(|k| projector[(*k, *k)] >= top).unwrap_or(0);
                let scale = projector[(pivot, pivot)].max(f64::MIN_POSITIVE).sqrt();
                let direction: DVector<f64> = projector.column(pivot) / scale;
                projector -= &direction * direction.transpose();
                direction
            })
            .collect()
    }
}

/// Rounding errors of a decomposition, in units of the number of equations times the spacing of doubles.
const ROUNDING: f64 = 4.0;

/// `(I - H)^-1`, with the block `H = W C W^T` of the hat matrix of an observation; `None` where the unknowns are not
/// determined without it.
pub(super) fn deletion(block: &DMatrix<f64>, root: &DMatrix<f64>) -> Option<Matrix6<f64>> {
    let half = block * root;
    let left = Matrix6::identity() - Matrix6::from_fn(|i, j| half.row(i).dot(&half.row(j)));
    let svd = bounded_svd(&left)?;
    (svd.singular_values.min() > INDISPENSABLE).then(|| left.try_inverse()).flatten()
}

/// An observation is indispensable if the others contribute less than this share of its information.
const INDISPENSABLE: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    #[test]
    fn steps_are_damped_least_squares_and_unknown_directions_are_orthonormal() {
        let mut rng = Rng::new(4);
        let (n, m, rank) = (20, 7, 5);
        let mut draw = |a: usize, b: usize| DMatrix::from_fn(a, b, |_, _| rng.normal());
        let rows = draw(n, rank) * draw(rank, m);
        let right: DVector<f64> = draw(n, 1).column(0).into();
        let found = FitSpectrum::of(rows.clone(), right.clone(), 1e6).unwrap();
        assert_eq!(found.rank, rank);
        for damping in [1e-3, 2.0] {
            let normal = rows.tr_mul(&rows) + DMatrix::identity(m, m) * damping;
            let expected = normal.try_inverse().unwrap() * rows.tr_mul(&right);
            let step = found.step(damping);
            assert!((&step - expected).amax() < 1e-9);
            let after = (&right - &rows * &step).norm_squared();
            assert!((right.norm_squared() - after - found.reduction(damping)).abs() < 1e-9);
        }
        let null = found.unknown_directions();
        assert_eq!(null.len(), m - rank);
        for (i, v) in null.iter().enumerate() {
            assert!((&rows * v).amax() < 1e-12);
            for (j, w) in null.iter().enumerate() {
                assert!((v.dot(w) - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
        // fewer equations than unknowns
        let short = FitSpectrum::of(rows.rows(0, 3).into(), right.rows(0, 3).into(), 1e6).unwrap();
        assert_eq!(short.rank, 3);
        // a coarse tolerance
        let s = found.values[3];
        assert_eq!(FitSpectrum::of(rows, right, 1.0 / (s * 0.999)).unwrap().rank, 4);
    }

    #[test]
    fn the_deletion_formula_is_what_the_others_let_expect() {
        let mut rng = Rng::new(9);
        let mut draw = |a: usize, b: usize| DMatrix::from_fn(a, b, |_, _| rng.normal());
        let (rows, right) = (draw(24, 5), draw(24, 1));
        let right: DVector<f64> = right.column(0).into();
        let all = FitSpectrum::of(rows.clone(), right.clone(), 1e9).unwrap();
        let residual = &right - &rows * all.step(0.0);
        let others = FitSpectrum::of(rows.rows(6, 18).into(), right.rows(6, 18).into(), 1e9).unwrap();
        let expected = (&right - &rows * others.step(0.0)).rows(0, 6).into_owned();
        let found = deletion(&rows.rows(0, 6).into(), &all.covariance_root()).unwrap();
        assert!((found * residual.rows(0, 6) - expected).amax() < 1e-10);
        let alone = FitSpectrum::of(rows.rows(0, 6).into(), right.rows(0, 6).into(), 1e9).unwrap();
        assert!(deletion(&rows.rows(0, 6).into(), &alone.covariance_root()).is_none());
    }
}
