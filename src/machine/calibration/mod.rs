//! Joint centres and leg offsets of a machine from measured poses and lengths.
//!
//! The length that leg `i` shows at pose `k` is
//!
//! ```text
//! l_ik = |R_k b_i + p_k - a_i| + d_i + noise,
//! ```
//!
//! with the unknown joints `a_i`, `b_i` and offsets `d_i`: seven unknowns a leg, fewer where legs share joints. Poses
//! are measured too, so that the six residuals of a pose have the covariance `sigma_l^2 I + J_k Sigma_pose J_k^T` to
//! first order.
//!
//! * [`calibrate`]: the fit, the uncertainty of each unknown, the unobservable changes of the machine, and the
//!   agreement of model and measurements.
//! * [`pose_deviation`]: the uncertainty of poses computed with the calibrated machine.
//! * [`next_poses`]: the best poses to measure next.
//! * [`CarriedFrames`]: from the frames of the measurements to those of a design.
//!
//! Theory: `docs/theory/calibration.md`.

mod accuracy;
mod chi_square;
mod exchanged;
mod fit;
#[cfg(test)]
mod fixtures;
mod frames;
mod model;
mod next_pose;
mod noise;
mod observability;
mod report;
mod robust;
mod spectrum;
mod start;
#[cfg(test)]
mod tests;

pub use accuracy::{PoseDeviation, pose_deviation};
pub use chi_square::{chi_square_exceeds, chi_square_quantile};
pub use frames::{CarriedFrames, FrameMotion, rigid_motion};
pub use model::{HeldParts, LegModel, Measurement, Unknown, Unknowns};
pub use next_pose::{NextPose, next_poses};
pub use noise::{MeasurementNoise, NoiseSource};
pub use observability::{Observability, UnobservableChange};
pub use report::{
    CalibrateOptions, Calibration, CalibrationError, CalibrationStatus, ChiSquare, GreatestResidual, Outlier,
    ResidualSpread, StartChoice, StartName, Starts, calibrate, planning_root,
};
pub use robust::{Loss, LossUnit, PoseWeight};
