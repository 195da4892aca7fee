//! Angles and quaternions of poses, as the library has them.

use ndarray::{Array2, Array3};
use num::names::named;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;

use super::arrays::{matrices, poses_in, rotations};
use super::failure::{raised, refused};
use platform::geom::{
    AngleUnit, Angles, ListedFrom, Pose, PoseConvention, QuaternionOrder, RotationOrder, UpAxis, WrittenPose,
};

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

/// A convention as Python has it: rotation order, angles, quaternion, pivot, relative to, up; what is not stated is
/// `None`.
pub(super) type ConventionWords =
    (Option<String>, Option<String>, Option<String>, Option<[f64; 3]>, Option<String>, Option<String>);

fn word<T: Copy>(
    py: Python<'_>,
    what: &'static str,
    given: Option<&String>,
    all: &[T],
    name: fn(T) -> &'static str,
) -> PyResult<Option<T>> {
    let Some(given) = given else { return Ok(None) };
    named(what, given, all, name).map(Some).map_err(|why| refused(py, "frames", &why.to_string()))
}

fn convention(py: Python<'_>, words: &ConventionWords) -> PyResult<PoseConvention> {
    let (order, angles, quaternion, pivot, relative_to, up) = words;
    let order = order.as_ref().map(|text| text.parse::<RotationOrder>()).transpose();
    Ok(PoseConvention {
        rotation_order: order.map_err(|why| refused(py, "frames", &why.to_string()))?,
        angles: word(py, "unit of angles", angles.as_ref(), &AngleUnit::ALL, AngleUnit::name)?,
        quaternion: word(
            py,
            "order of quaternions",
            quaternion.as_ref(),
            &QuaternionOrder::ALL,
            QuaternionOrder::name,
        )?,
        pivot: pivot.map(Into::into),
        relative_to: word(
            py,
            "frame",
            relative_to.as_ref(),
            &[ListedFrom::Base, ListedFrom::Home],
            ListedFrom::name,
        )?,
        up: word(py, "axis", up.as_ref(), &UpAxis::ALL, UpAxis::name)?,
    })
}

/// The words of a convention.
pub(super) fn words_of(convention: &PoseConvention) -> ConventionWords {
    (
        convention.rotation_order.map(|order| order.to_string()),
        convention.angles.map(|unit| unit.name().into()),
        convention.quaternion.map(|order| order.name().into()),
        convention.pivot.map(Into::into),
        convention.relative_to.map(|from| from.name().into()),
        convention.up.map(|axis| axis.name().into()),
    )
}

fn home_of(py: Python<'_>, home: &PyReadonlyArray3<'_, f64>) -> PyResult<Pose> {
    poses_in(py, &home.as_array())?.first().copied().ok_or_else(|| refused(py, "shape", "home is one pose"))
}

/// Sentences about a convention.
#[pyfunction]
pub(super) fn frames_sentence(py: Python<'_>, words: ConventionWords) -> PyResult<String> {
    Ok(convention(py, &words)?.sentences())
}

/// Matrices, shape (n, 4, 4), of poses in a convention, shape (n, 6) or (n, 7).
#[pyfunction]
pub(super) fn poses_in_frames<'py>(
    py: Python<'py>,
    words: ConventionWords,
    numbers: PyReadonlyArray2<'py, f64>,
    home: PyReadonlyArray3<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let (convention, home) = (convention(py, &words)?, home_of(py, &home)?);
    let read = |row: ndarray::ArrayView1<'_, f64>| convention.read(&row.to_vec(), &home);
    let all: Result<Vec<Pose>, _> = numbers.as_array().rows().into_iter().map(read).collect();
    Ok(matrices(&all.map_err(|e| raised(py, e.into()))?).into_pyarray(py))
}

/// Positions (n, 3), angles (n, 3), quaternions (n, 4) and whether angles are the only ones (n) of poses (n, 4, 4).
#[pyfunction]
pub(super) fn poses_as_numbers<'py>(
    py: Python<'py>,
    words: ConventionWords,
    poses: PyReadonlyArray3<'py, f64>,
    home: PyReadonlyArray3<'py, f64>,
) -> PyResult<WrittenArrays<'py>> {
    let (convention, home) = (convention(py, &words)?, home_of(py, &home)?);
    let all: Vec<WrittenPose> =
        poses_in(py, &poses.as_array())?.iter().map(|pose| convention.write(pose, &home)).collect();
    let three = |of: fn(&WrittenPose) -> [f64; 3]| {
        Array2::from_shape_fn((all.len(), 3), |(k, i)| of(&all[k])[i]).into_pyarray(py)
    };
    Ok((
        three(|w| w.position),
        three(|w| w.angles),
        Array2::from_shape_fn((all.len(), 4), |(k, i)| all[k].quaternion[i]).into_pyarray(py),
        all.iter().map(|w| w.angles_are_unique).collect::<Vec<bool>>().into_pyarray(py),
    ))
}

/// The arrays that [`poses_as_numbers`] gives.
type WrittenArrays<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<bool>>,
);
