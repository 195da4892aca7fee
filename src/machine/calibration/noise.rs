//! Noise of the measurements and the resulting covariance of the residuals.

use nalgebra::{Cholesky, Matrix6, Vector6};

use super::robust::PoseWeight;

/// Standard deviations of the measured quantities, whose errors are independent of each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasurementNoise {
    /// Standard deviation of each leg length, design units, positive.
    pub length: f64,
    /// Standard deviation of each coordinate of the measured platform origin, design units.
    pub position: f64,
    /// Standard deviation of each component of the rotation vector of the orientation error, radians.
    pub rotation: f64,
}

/// Assumed noise of lengths before any estimate, as a share of the size of the machine.
const ASSUMED: f64 = 1e-4;

impl MeasurementNoise {
    /// Noise assumed without other knowledge: exact poses, and lengths with an uncertainty of a ten-thousandth of the
    /// size of the machine.
    #[must_use]
    pub fn assumed(size: f64) -> Self {
        Self { length: ASSUMED * size, position: 0.0, rotation: 0.0 }
    }

    /// `sigma_l^2 I + J Sigma_pose J^T`, the covariance of the residuals at a pose to first order. A leg of weight `w`
    /// has the length variance `sigma_l^2 / w`; a pose weight divides the whole covariance.
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
        // if lengths are a million times as exact as poses, rounding can spoil the factor; a larger diagonal repairs it
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

/// Source of the noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum NoiseSource {
    /// The caller knows it.
    Given,
    /// All lengths are equally uncertain and poses exact; the residuals give the amount.
    Estimated,
    /// The default is assumed, since there are no more numbers than unknowns.
    Assumed,
}
