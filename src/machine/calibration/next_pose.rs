//! The poses whose measurement adds most information.

use nalgebra::{DMatrix, Matrix6};

use super::model::{LegModel, Unknowns};
use super::noise::MeasurementNoise;
use super::robust::PoseWeight;
use platform::geom::Pose;

/// A pose to measure next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NextPose {
    /// Its index among the candidates.
    pub candidate: usize,
    /// Factor by which this pose shrinks the geometric mean of the standard deviations along the axes of the error
    /// ellipsoid, below 1.
    pub shrinks: f64,
    /// The greatest standard deviation of a coordinate or offset after this pose and those before it, design units.
    pub greatest_deviation: f64,
}

/// The `count` best candidates in greedy order. Each lowers the determinant of the covariance `F F^T` most, given the
/// measurements and the poses before it. This is D-optimal design, one pose at a time (Fedorov 1972; for calibration
/// Daney, Papegay, Madeline 2005).
///
/// With the whitened rows `W` of a candidate the determinant is divided by `det(I + W F F^T W^T)`. The same pose may be
/// taken more than once.
#[must_use]
pub fn next_poses(
    model: &LegModel,
    unknowns: &Unknowns,
    noise: &MeasurementNoise,
    root: &DMatrix<f64>,
    candidates: &[Pose],
    count: usize,
) -> Vec<NextPose> {
    let rows: Vec<DMatrix<f64>> = candidates
        .iter()
        .map(|pose| {
            let lower = noise.whitening(&model.pose_sensitivity(pose), &PoseWeight::FULL);
            let sensitivity = model.sensitivity(unknowns, pose);
            lower.solve_lower_triangular(&sensitivity).unwrap_or(DMatrix::zeros(6, unknowns.count()))
        })
        .collect();
    let mut covariance = root * root.transpose();
    let mut out = Vec::new();
    for _ in 0..count {
        let inner = |w: &DMatrix<f64>| -> Matrix6<f64> {
            let half = w * &covariance;
            Matrix6::identity() + Matrix6::from_fn(|i, j| half.row(i).dot(&w.row(j)))
        };
        let mut best: Option<(usize, f64, Matrix6<f64>)> = None;
        for (candidate, w) in rows.iter().enumerate() {
            let Some(factor) = inner(w).cholesky() else { continue };
            let gain = factor.l().diagonal().iter().map(|x| x.ln()).sum::<f64>();
            if best.as_ref().is_none_or(|(_, most, _)| gain > *most) {
                best = Some((candidate, gain, factor.inverse()));
            }
        }
        let Some((candidate, gain, inverse)) = best else { break };
        let half = &rows[candidate] * &covariance;
        let inverse = DMatrix::from_fn(6, 6, |i, j| inverse[(i, j)]);
        covariance -= half.transpose() * inverse * &half;
        // the two halves of a symmetric matrix drift apart by rounding
        covariance = (&covariance + covariance.transpose()) * 0.5;
        out.push(NextPose {
            candidate,
            shrinks: (-gain / unknowns.count() as f64).exp(),
            greatest_deviation: covariance.diagonal().max().max(0.0).sqrt(),
        });
    }
    out
}
