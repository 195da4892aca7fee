//! How one pose was followed from a known one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseRecord, PoseUncertaintyRecord};
use fk::NearOutcome;
use platform::geom::Pose;

/// The way from the start to the pose reached, with the numbers that prove it free of singularities.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearRecord {
    /// What came of it.
    pub outcome: NearWord,
    /// Why it was lost.
    pub reason: Option<String>,
    /// The pose at the beginning.
    pub start: PoseRecord,
    /// The pose at the end.
    pub reached: PoseRecord,
    /// How far on the straight line of squared lengths; 1 at its end.
    pub fraction: f64,
    /// Largest error of the leg equations over the squared size.
    pub residual: Number,
    /// Of the Jacobian at the pose reached, as in `assess`: 1 at best, 0 at a singularity.
    pub inverse_condition: Number,
    /// Segments the line was divided into.
    pub segments: u32,
    /// Newton steps in all.
    pub newton_steps: u32,
    /// The largest Kantorovich number; below 1 every segment is free of singularities.
    pub kantorovich: Number,
    /// How far the centroid of the platform moved, design units.
    pub distance: Number,
    /// The angle the platform turned by.
    pub angle_deg: Number,
    /// How uncertain the pose reached is, where the design has standard deviations of a calibration and joints are
    /// ideal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<PoseUncertaintyRecord>,
}

/// What came of following a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NearWord {
    /// The pose for the lengths asked for.
    Tracked,
    /// A singularity lies on the way or at its end.
    NearSingularity,
    /// Given up.
    Lost,
}

impl NearWord {
    /// The word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tracked => "tracked",
            Self::NearSingularity => "near_singularity",
            Self::Lost => "lost",
        }
    }
}

impl NearRecord {
    /// The record of an outcome that began at `start` and reached a pose with this inverse condition number of the
    /// Jacobian.
    #[must_use]
    pub fn new(start: &Pose, outcome: &NearOutcome, inverse_condition: f64) -> Self {
        let e = outcome.evidence();
        let (word, fraction, reason) = match outcome {
            NearOutcome::Tracked { .. } => (NearWord::Tracked, 1.0, None),
            NearOutcome::NearSingularity { fraction, .. } => (NearWord::NearSingularity, *fraction, None),
            NearOutcome::Lost { fraction, reason, .. } => {
                (NearWord::Lost, *fraction, Some(reason.to_string()))
            }
        };
        Self {
            outcome: word,
            reason,
            start: start.into(),
            reached: outcome.pose().into(),
            fraction,
            residual: Number(e.residual),
            inverse_condition: Number(inverse_condition),
            segments: e.segments,
            newton_steps: e.newton_steps,
            kantorovich: Number(e.kantorovich),
            distance: Number(e.distance),
            angle_deg: Number(e.angle.to_degrees()),
            uncertainty: None,
        }
    }
}
