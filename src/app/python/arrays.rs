//! Conversions between numpy arrays and poses or lengths. Poses are 4 x 4 matrices `(R p; 0 1)`, lengths are rows of
//! six; the first axis counts.

use nalgebra::{Matrix3, Matrix4, Vector3};
use ndarray::{Array, Array3, ArrayView2, ArrayView3, Dimension, StrideShape};
use num_complex::Complex64;
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use super::failure::{raised, refused};
use ask::Error;
use platform::geom::{ComplexPose, InvalidPose, Pose};
use synthesis::AffineLegMap;

/// The reason why a computation at many poses ended: an invalid matrix, or an error of the computation.
pub(super) enum PoseFault {
    Pose(usize, InvalidPose),
    Failed(Error),
}

impl From<Error> for PoseFault {
    fn from(error: Error) -> Self {
        Self::Failed(error)
    }
}

/// An argument that already is an array of doubles, row by row; `None`: numpy has to convert it. A check here costs
/// less than one in Python.
pub(super) fn as_it_stands<'py>(given: &Bound<'py, PyAny>) -> Option<PyReadonlyArrayDyn<'py, f64>> {
    let array = given.cast::<PyArrayDyn<f64>>().ok()?.try_readonly().ok()?;
    // a slice would also accept arrays stored column by column
    array.is_c_contiguous().then_some(array)
}

/// The entries of an array of shape `(.., 4, 4)`, and the axes before the last two; `None`: another shape.
pub(super) fn pose_entries<'a>(array: &'a PyReadonlyArrayDyn<'_, f64>) -> Option<(&'a [f64], &'a [usize])> {
    let (before, last) = array.shape().split_last_chunk::<2>()?;
    if *last == [4, 4] { Some((array.as_slice().ok()?, before)) } else { None }
}

/// Calls `each` with every pose of the 4 x 4 matrices, in order and without the interpreter.
pub(super) fn at_poses(
    py: Python<'_>,
    entries: &[f64],
    mut each: impl FnMut(Pose) -> Result<(), PoseFault> + Send,
) -> PyResult<()> {
    let one = entries.len() == 16;
    let done = py.detach(|| {
        entries.chunks_exact(16).enumerate().try_for_each(|(k, matrix)| {
            each(Pose::try_from(Matrix4::from_row_slice(matrix)).map_err(|e| PoseFault::Pose(k, e))?)
        })
    });
    done.map_err(|fault| match fault {
        PoseFault::Pose(_, e) if one => raised(py, Error::Pose(e)),
        PoseFault::Pose(k, e) => refused(py, "pose", &format!("pose {k}: {e}")),
        PoseFault::Failed(error) => raised(py, error),
    })
}

/// All poses of an array of shape `(n, 4, 4)`.
pub(super) fn poses_in(py: Python<'_>, poses: &ArrayView3<'_, f64>) -> PyResult<Vec<Pose>> {
    let shape = poses.shape();
    if shape[1..] != [4, 4] {
        return Err(refused(py, "shape", &format!("poses are (n, 4, 4), not {shape:?}")));
    }
    let mut out = Vec::with_capacity(poses.len() / 16);
    at_poses(py, poses.as_standard_layout().as_slice().unwrap_or_default(), |pose| {
        out.push(pose);
        Ok(())
    })?;
    Ok(out)
}

/// An array of this shape with these entries, row by row.
pub(super) fn shaped<T, D: Dimension>(
    shape: impl Into<StrideShape<D>>,
    entries: Vec<T>,
) -> PyResult<Array<T, D>> {
    Array::from_shape_vec(shape, entries).map_err(|e| PyRuntimeError::new_err(e.to_string()))
}

/// The rows of an array of shape `(n, 6)`.
pub(super) fn lengths_in(py: Python<'_>, lengths: &ArrayView2<'_, f64>) -> PyResult<Vec<[f64; 6]>> {
    let shape = lengths.shape();
    if shape[1] != 6 {
        return Err(refused(py, "shape", &format!("lengths are (n, 6), not {shape:?}")));
    }
    Ok(lengths.rows().into_iter().map(|row| std::array::from_fn(|i| row[i])).collect())
}

/// An entry of the 4 x 4 matrix of a pose.
pub(super) fn entry<T: From<f64> + Copy>(r: &Matrix3<T>, p: &Vector3<T>, (i, j): (usize, usize)) -> T {
    match (i, j) {
        (3, 3) => 1.0.into(),
        (3, _) => 0.0.into(),
        (_, 3) => p[i],
        _ => r[(i, j)],
    }
}

/// The matrices of real poses.
pub(super) fn matrices(poses: &[Pose]) -> Array3<f64> {
    let of = |(k, i, j): (usize, usize, usize)| entry(poses[k].rotation.matrix(), &poses[k].position, (i, j));
    Array3::from_shape_fn((poses.len(), 4, 4), of)
}

/// The rotation matrices of poses, shape (n, 3, 3).
pub(super) fn rotations(poses: &[Pose]) -> Array3<f64> {
    Array3::from_shape_fn((poses.len(), 3, 3), |(k, i, j)| poses[k].rotation.matrix()[(i, j)])
}

/// The matrices of complex poses.
pub(super) fn complex_matrices(poses: &[&ComplexPose]) -> Array3<Complex64> {
    let of = |(k, i, j): (usize, usize, usize)| entry(&poses[k].rotation, &poses[k].position, (i, j));
    Array3::from_shape_fn((poses.len(), 4, 4), of)
}

/// The matrix and the constants of a leg map.
pub(super) type LegMapArrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);

pub(super) fn leg_map_arrays<'py>(py: Python<'py>, map: &AffineLegMap) -> LegMapArrays<'py> {
    let a = Array::from_shape_fn((6, 6), |(i, j)| map.a[(i, j)]);
    let c = Array::from_iter(map.c.iter().copied());
    (a.into_pyarray(py), c.into_pyarray(py))
}
