//! `[home]` and `[workspace]`.

use serde::Serialize;

use crate::design::construction::WrittenHome;
use crate::design::{DesignModel, WrittenNumber};
use platform::geom::Pose;

#[derive(Serialize)]
pub(super) struct PoseTable {
    position: [f64; 3],
    rotation: [[f64; 3]; 3],
}

/// `[home]`: numbers, or what they were written as.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum HomeTable<'a> {
    Numbers(PoseTable),
    Angles { position: &'a [WrittenNumber; 3], rpy_deg: &'a [WrittenNumber; 3] },
    Rows { position: &'a [WrittenNumber; 3], rotation: [[f64; 3]; 3] },
}

impl<'a> HomeTable<'a> {
    pub(super) fn of(design: &'a DesignModel) -> Option<Self> {
        let table = PoseTable::from(design.home.as_ref()?);
        Some(match design.written_home() {
            None => Self::Numbers(table),
            Some(WrittenHome { position, rpy_deg: Some(rpy_deg), .. }) => Self::Angles { position, rpy_deg },
            Some(WrittenHome { position, rpy_deg: None, .. }) => {
                Self::Rows { position, rotation: table.rotation }
            }
        })
    }
}

impl From<&Pose> for PoseTable {
    fn from(pose: &Pose) -> Self {
        let m = pose.rotation.matrix();
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]));
        Self { position: pose.position.into(), rotation }
    }
}

#[derive(Serialize)]
pub(super) struct WorkspaceTable {
    pub(super) translation: [f64; 3],
    pub(super) rotation_deg: [f64; 3],
    pub(super) grid: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) region: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) trajectory: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) relative_to: Option<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) poses: Vec<PoseTable>,
}
