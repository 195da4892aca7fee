//! Angles and quaternions of poses, as the library has them.

use ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray2, PyArray3, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;

use super::arrays::{poses_in, rotations};
use super::failure::{raised, refused};
use platform::geom::{Angles, Pose};

/// Roll, pitch and yaw in radians, shape (n, 3), of poses (n, 4, 4).
#[pyfunction]
pub(super) fn angles_of<'py>(
    py: Python<'py>,
    poses: PyReadonlyArray3<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let angles: Vec<[f64; 3]> =
        poses_in(py, &poses.as_array())?.iter().map(|pose| pose.angles().radians()).collect();
    Ok(Array2::from_shape_fn((angles.len(), 3), |(k, i)| angles[k][i]).into_pyarray(py))
}

/// Unit quaternions, scalar first and not negative, shape (n, 4), of poses (n, 4, 4).
#[pyfunction]
pub(super) fn quaternions_of<'py>(
    py: Python<'py>,
    poses: PyReadonlyArray3<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let all: Vec<[f64; 4]> = poses_in(py, &poses.as_array())?.iter().map(Pose::quaternion).collect();
    Ok(Array2::from_shape_fn((all.len(), 4), |(k, i)| all[k][i]).into_pyarray(py))
}

/// Rotation matrices, shape (n, 3, 3), of roll, pitch and yaw in radians (n, 3).
#[pyfunction]
pub(super) fn rotations_of_angles<'py>(
    py: Python<'py>,
    angles: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let rows = rows_of::<3>(py, &angles)?;
    let all: Vec<Pose> = rows.into_iter().map(|a| Pose::new([0.0; 3], Angles::from_radians(a))).collect();
    Ok(rotations(&all).into_pyarray(py))
}

/// Rotation matrices, shape (n, 3, 3), of unit quaternions with the scalar first (n, 4).
#[pyfunction]
pub(super) fn rotations_of_quaternions<'py>(
    py: Python<'py>,
    quaternions: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let rows = rows_of::<4>(py, &quaternions)?;
    let all: Result<Vec<Pose>, _> = rows.into_iter().map(|q| Pose::from_quaternion([0.0; 3], q)).collect();
    let all: Array3<f64> = rotations(&all.map_err(|e| raised(py, e.into()))?);
    Ok(all.into_pyarray(py))
}

fn rows_of<const N: usize>(py: Python<'_>, array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; N]>> {
    let array = array.as_array();
    if array.shape()[1] != N {
        return Err(refused(py, "shape", &format!("rows have {N} numbers, not {}", array.shape()[1])));
    }
    Ok(array.rows().into_iter().map(|row| std::array::from_fn(|i| row[i])).collect())
}
