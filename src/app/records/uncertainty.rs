//! The uncertainty of a pose of a calibrated machine.

use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Number;
use ask::Design;
use machine::manufacture::{MachineUncertainty, PoseCovariance};
use platform::geom::Pose;

/// The correlation of the errors of a calibration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CorrelationsWord {
    /// The correlations of the design file.
    Design,
    /// Independent errors: the design file has no correlations.
    Independent,
}

impl CorrelationsWord {
    /// The correlations of a design.
    #[must_use]
    pub fn of(design: &Design) -> Self {
        let known = design.calibration.as_ref().is_some_and(|table| table.correlations.is_some());
        if known { Self::Design } else { Self::Independent }
    }
}

view! {
    /// The uncertainty of a pose computed from lengths with the calibrated machine, to first order. It covers the
    /// errors of the calibration; the noise of the lengths adds to it.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PoseUncertaintyRecord {
        /// Source of correlations.
        pub correlations: CorrelationsWord = CorrelationsWord::of(design),
        /// RMS error of the platform origin, design units.
        pub position: Number = Number(found.position),
        /// RMS error of the orientation, degrees.
        pub rotation_deg: Number = Number(found.rotation.to_degrees()),
        /// Covariance of platform origin (design units) and rotation vector (degrees), base frame.
        pub covariance: [[Number; 6]; 6] = in_degrees(&found),
    }
    /// The uncertainty at a pose; `None`: a singular pose.
    pub fn at(design: &Design, known: &MachineUncertainty, pose: &Pose) -> Option<Self> {
        let found = known.pose_covariance(design.manipulator(), pose, &Point3::origin())?;
    }
}

/// A covariance, with rotations converted to degrees.
pub(super) fn in_degrees(found: &PoseCovariance) -> [[Number; 6]; 6] {
    let unit = |k: usize| if k < 3 { 1.0 } else { 1_f64.to_degrees() };
    std::array::from_fn(|i| std::array::from_fn(|j| Number(found.matrix[(i, j)] * unit(i) * unit(j))))
}
