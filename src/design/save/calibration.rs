//! `[calibration]`.

use serde::Serialize;

use super::as_map;
use crate::design::{CalibrationTable, Design};
use crate::manipulator::Body;

/// `[calibration]`.
#[derive(Serialize)]
pub(super) struct CalibrationFile<'a> {
    offsets: [f64; 6],
    #[serde(skip_serializing_if = "Option::is_none")]
    offset_deviations: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "as_map")]
    base_deviations: Vec<(&'a str, [f64; 3])>,
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "as_map")]
    platform_deviations: Vec<(&'a str, [f64; 3])>,
}

impl<'a> CalibrationFile<'a> {
    pub(super) fn of(design: &'a Design, table: &CalibrationTable) -> Self {
        let named = |body: Body| {
            let of = |(joint, name): (usize, &'a String)| {
                Some((name.as_str(), table.deviation(body, joint)?.into()))
            };
            design.joint_names(body).iter().enumerate().filter_map(of).collect()
        };
        Self {
            offsets: table.offsets,
            offset_deviations: table.offset_deviations,
            base_deviations: named(Body::Base),
            platform_deviations: named(Body::Platform),
        }
    }
}
