//! How uncertain measurements are, and what that makes of residuals.

use nalgebra::{Cholesky, Matrix6, Vector6};

use super::robust::PoseWeight;

/// Standard deviations of what was measured, independent of each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasurementNoise {
    /// Of each leg length, design units, positive.
    pub length: f64,
    /// Of each coordinate of the position of the platform origin, design units.
    pub position: f64,
    /// Of each component of the rotation vector by which the orientation is off, radians.
    pub rotation: f64,
}

/// The noise of lengths taken before anything is known about it, as a share of the size of the machine.
const ASSUMED: f64 = 1e-4;

impl MeasurementNoise {
    /// What is taken where nothing is known: exact poses, and lengths as uncertain as a ten-thousandth of the size of
    /// the machine.
    #[must_use]
    pub fn assumed(size: f64) -> Self {
        Self { length: ASSUMED * size, position: 0.0, rotation: 0.0 }
    }

    /// `sigma_l^2 I + J Sigma_pose J^T`, the covariance of the residuals at a pose to first order; the variance of the
    /// length of a leg of weight `w` is `sigma_l^2 / w`, and that of everything at a pose of weight `w` is divided by
    /// it.
    pub(super) fn covariance(&self, sensitivity: &Matrix6<f64>, weight: &PoseWeight) -> Matrix6<f64> {
        let (p, w) = (self.position * self.position, self.rotation * self.rotation);
        let pose = Matrix6::from_diagonal(&Vector6::new(p, p, p, w, w, w));
        let legs = Vector6::from_fn(|leg, _| self.length * self.length / weight.legs[leg]);
        (Matrix6::from_diagonal(&legs) + sensitivity * pose * sensitivity.transpose()) / weight.pose
    }

    /// The lower factor of the covariance: its inverse makes residuals independent with variance 1.
    pub(super) fn whitening(&self, sensitivity: &Matrix6<f64>, weight: &PoseWeight) -> Matrix6<f64> {
        let covariance = self.covariance(sensitivity, weight);
        let exact = covariance.cholesky().map(Cholesky::unpack);
        // lengths a million times as exact as poses: what rounding leaves of them is made up for
        exact.unwrap_or_else(|| {
            let floor = covariance.diagonal().amax() * 1e-14;
            let lifted = covariance + Matrix6::identity() * floor;
            lifted.cholesky().map_or_else(Matrix6::identity, Cholesky::unpack)
        })
    }

    /// All deviations multiplied.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self {
            length: self.length * factor,
            position: self.position * factor,
            rotation: self.rotation * factor,
        }
    }
}

/// Where the noise comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum NoiseSource {
    /// The caller knows it.
    Given,
    /// All lengths are equally uncertain and poses exact; how much the residuals say.
    Estimated,
    /// The residuals cannot say: there are no more numbers than unknowns.
    Assumed,
}
