//! Uncertainty of poses computed with a calibrated machine.

use nalgebra::DMatrix;

use super::model::{LegModel, Unknowns};
use platform::geom::Pose;

/// Standard deviations of a pose computed from shown lengths, caused by the uncertainty of the calibrated parameters.
/// The noise of the lengths is not included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseDeviation {
    /// Root mean square of the distance by which the platform origin is off, design units.
    pub position: f64,
    /// Root mean square of the angle by which the orientation is off, radians.
    pub rotation: f64,
}

/// The deviations at a pose of a machine with the covariance `F F^T` of its unknowns; `None` at a singular pose.
///
/// With held lengths `l = f(x, X)`, an error `dx` of the unknowns moves the pose by `-J^-1 W dx`. `J` holds the
/// derivatives by the pose and `W` those by the unknowns. The covariance of the pose is that of `J^-1 W F`, with all
/// correlations.
#[must_use]
pub fn pose_deviation(
    model: &LegModel,
    unknowns: &Unknowns,
    root: &DMatrix<f64>,
    pose: &Pose,
) -> Option<PoseDeviation> {
    let inverse = model.pose_sensitivity(pose).try_inverse()?;
    let moved = inverse * (model.sensitivity(unknowns, pose) * root);
    let found = PoseDeviation { position: moved.rows(0, 3).norm(), rotation: moved.rows(3, 3).norm() };
    (found.position.is_finite() && found.rotation.is_finite()).then_some(found)
}
