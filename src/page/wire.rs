//! Poses in the JSON of the page. A number that is not finite is `null` there.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::geom::{Pose, nearest_rotation};

/// A pose as the page sends and gets it: rows of `R`, and `p` in design units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct PagePose {
    #[serde(rename = "R")]
    rotation: [[f64; 3]; 3],
    p: [f64; 3],
}

impl From<&PagePose> for Pose {
    fn from(record: &PagePose) -> Self {
        let rows = Matrix3::from_fn(|i, j| record.rotation[i][j]);
        Self { rotation: nearest_rotation(&rows), position: Vector3::from(record.p) }
    }
}

impl From<&Pose> for PagePose {
    fn from(p: &Pose) -> Self {
        Self { rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| p.rotation[(i, j)])), p: p.position.into() }
    }
}
