//! How uncertain a pose of a calibrated machine is.

use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Number;
use ask::Design;
use machine::manufacture::{MachineUncertainty, PoseCovariance};
use platform::geom::Pose;

/// How the errors of a calibration go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CorrelationsWord {
    /// As the design file says.
    Design,
    /// The design file has no correlations: every coordinate and offset counts as off for itself.
    Independent,
}

impl CorrelationsWord {
    /// Of a design.
    #[must_use]
    pub fn of(design: &Design) -> Self {
        let known = design.calibration.as_ref().is_some_and(|table| table.correlations.is_some());
        if known { Self::Design } else { Self::Independent }
    }
}

/// How uncertain a pose is that is computed from lengths with the calibrated machine, by what the calibration does not
/// know, to first order; the noise of these lengths comes on top.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PoseUncertaintyRecord {
    /// Whether the design file has correlations.
    pub correlations: CorrelationsWord,
    /// Root mean square of the distance by which the platform origin is off, design units.
    pub position: Number,
    /// Root mean square of the angle by which the orientation is off, degrees.
    pub rotation_deg: Number,
    /// Covariance of the shift of the platform origin (design units) and the rotation vector (degrees), base frame.
    pub covariance: [[Number; 6]; 6],
}

impl PoseUncertaintyRecord {
    /// At a pose; `None` at a singular one.
    #[must_use]
    pub fn at(design: &Design, known: &MachineUncertainty, pose: &Pose) -> Option<Self> {
        let found = known.pose_covariance(design.manipulator(), pose, &Point3::origin())?;
        Some(Self {
            correlations: CorrelationsWord::of(design),
            position: Number(found.position),
            rotation_deg: Number(found.rotation.to_degrees()),
            covariance: in_degrees(&found),
        })
    }
}

/// A covariance with rotations in degrees.
pub(super) fn in_degrees(found: &PoseCovariance) -> [[Number; 6]; 6] {
    let unit = |k: usize| if k < 3 { 1.0 } else { 1_f64.to_degrees() };
    std::array::from_fn(|i| std::array::from_fn(|j| Number(found.matrix[(i, j)] * unit(i) * unit(j))))
}
