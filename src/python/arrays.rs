//! Between numpy arrays and poses and lengths. Poses are 4 x 4 matrices `(R p; 0 1)`, lengths rows of six; the first axis counts.

use nalgebra::Matrix4;
use ndarray::{Array2, Array3, ArrayView2, ArrayView3};
use num_complex::Complex64;
use pyo3::prelude::*;

use super::failure::{raised, refused};
use crate::entrance::Error;
use crate::geom::{ComplexPose, Pose};

/// The pose in row `k` of matrices, errors with the row.
pub(super) fn pose_in(py: Python<'_>, poses: &ArrayView3<'_, f64>, k: usize) -> PyResult<Pose> {
    let matrix = Matrix4::from_fn(|i, j| poses[[k, i, j]]);
    Pose::try_from(matrix).map_err(|e| {
        if poses.shape()[0] == 1 {
            raised(py, Error::Pose(e))
        } else {
            refused(py, "pose", &format!("pose {k}: {e}"))
        }
    })
}

/// All poses of an array of shape `(n, 4, 4)`.
pub(super) fn poses_in(py: Python<'_>, poses: &ArrayView3<'_, f64>) -> PyResult<Vec<Pose>> {
    let shape = poses.shape();
    if shape[1..] != [4, 4] {
        return Err(refused(py, "shape", &format!("poses are (n, 4, 4), not {shape:?}")));
    }
    (0..shape[0]).map(|k| pose_in(py, poses, k)).collect()
}

/// The rows of an array of shape `(n, 6)`.
pub(super) fn lengths_in(py: Python<'_>, lengths: &ArrayView2<'_, f64>) -> PyResult<Vec<[f64; 6]>> {
    let shape = lengths.shape();
    if shape[1] != 6 {
        return Err(refused(py, "shape", &format!("lengths are (n, 6), not {shape:?}")));
    }
    Ok(lengths.rows().into_iter().map(|row| std::array::from_fn(|i| row[i])).collect())
}

/// The matrices of real poses.
pub(super) fn matrices(poses: &[Pose]) -> Array3<f64> {
    let mut out = Array3::zeros((poses.len(), 4, 4));
    for (k, pose) in poses.iter().enumerate() {
        for i in 0..3 {
            for j in 0..3 {
                out[[k, i, j]] = pose.rotation.matrix()[(i, j)];
            }
            out[[k, i, 3]] = pose.position[i];
        }
        out[[k, 3, 3]] = 1.0;
    }
    out
}

/// The rotation matrices of poses, shape (n, 3, 3).
pub(super) fn rotations(poses: &[Pose]) -> Array3<f64> {
    Array3::from_shape_fn((poses.len(), 3, 3), |(k, i, j)| poses[k].rotation.matrix()[(i, j)])
}

/// The matrices of complex poses.
pub(super) fn complex_matrices<'a>(
    poses: impl ExactSizeIterator<Item = &'a ComplexPose>,
) -> Array3<Complex64> {
    let mut out = Array3::zeros((poses.len(), 4, 4));
    for (k, pose) in poses.enumerate() {
        for i in 0..3 {
            for j in 0..3 {
                out[[k, i, j]] = pose.rotation[(i, j)];
            }
            out[[k, i, 3]] = pose.position[i];
        }
        out[[k, 3, 3]] = Complex64::ONE;
    }
    out
}

/// Rows of six.
pub(super) fn rows(values: &[[f64; 6]]) -> Array2<f64> {
    Array2::from_shape_fn((values.len(), 6), |(k, i)| values[k][i])
}
