//! The tracking of one pose from a known one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseRecord, PoseUncertaintyRecord};
use fk::{NearOutcome, NearWord};
use platform::geom::Pose;

view! {
    /// The path from the start to the pose reached, with the numbers that prove that it holds no singular pose.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NearRecord {
        /// The outcome of the tracking.
        pub outcome: NearWord = outcome.word(),
        /// Reason for losing it; null: it was not lost.
        pub reason: Option<String> = reason,
        /// Start pose.
        pub start: PoseRecord = start.into(),
        /// End pose.
        pub reached: PoseRecord = outcome.pose().into(),
        /// Share of the straight line of squared lengths; 1: all.
        pub fraction: f64 = fraction,
        /// Largest leg equation error over squared size.
        pub residual: Number = Number(e.residual),
        /// Inverse condition number at the pose reached, as in `assess`: 1 at best, 0 at a singular pose.
        pub inverse_condition: Number = Number(inverse_condition),
        /// Number of segments of the line.
        pub segments: u32 = e.segments,
        /// Number of Newton steps in all.
        pub newton_steps: u32 = e.newton_steps,
        /// The largest Kantorovich number; below 1, no segment holds a singular pose.
        pub kantorovich: Number = Number(e.kantorovich),
        /// Displacement of the platform centroid since start, design units.
        pub distance: Number = Number(e.distance),
        /// Rotation since start, degrees.
        pub angle_deg: Number = Number(e.angle.to_degrees()),
        /// Uncertainty of that pose. Present for ideal joints and a design with standard deviations of a calibration.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub uncertainty: Option<PoseUncertaintyRecord> = None,
    }
    /// The record of an outcome that began at `start` and reached a pose with this inverse condition number of the
    /// Jacobian.
    pub fn new(start: &Pose, outcome: &NearOutcome, inverse_condition: f64) {
        let e = outcome.evidence();
        let (fraction, reason) = match outcome {
            NearOutcome::Tracked { .. } => (1.0, None),
            NearOutcome::NearSingularity { fraction, .. } => (*fraction, None),
            NearOutcome::Lost { fraction, reason, .. } => (*fraction, Some(reason.to_string())),
        };
    }
}
