//! `[calibration]`.

use std::fmt::Write as _;

use serde::Serialize;

use super::as_map;
use crate::design::{CalibrationTable, Correlations, DesignModel};
use platform::manipulator::Body;

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
    #[serde(skip_serializing_if = "Option::is_none")]
    correlations: Option<CorrelationsFile<'a>>,
}

/// `[calibration.correlations]`.
#[derive(Serialize)]
pub(super) struct CorrelationsFile<'a> {
    unknowns: Vec<String>,
    matrix: &'a [Vec<f64>],
}

impl<'a> CorrelationsFile<'a> {
    fn of(design: &DesignModel, found: &'a Correlations) -> Self {
        Self {
            unknowns: found.unknowns.iter().map(|number| number.name(design)).collect(),
            matrix: &found.triangle,
        }
    }

    /// The table with a row of the triangle a line, which the writer of TOML would put on one line of ten thousand characters.
    pub(super) fn to_toml(&self) -> String {
        let mut out = String::from("[calibration.correlations]\nunknowns = [\n");
        for name in &self.unknowns {
            let _ = writeln!(out, "    {},", toml::Value::from(name.as_str()));
        }
        out.push_str("]\nmatrix = [\n");
        for row in self.matrix {
            let row: Vec<String> = row.iter().map(ToString::to_string).collect();
            let _ = writeln!(out, "    [{}],", row.join(", "));
        }
        out.push_str("]\n");
        out
    }
}

impl<'a> CalibrationFile<'a> {
    pub(super) fn of(design: &'a DesignModel, table: &'a CalibrationTable) -> Self {
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
            correlations: table.correlations.as_ref().map(|found| CorrelationsFile::of(design, found)),
        }
    }

    /// The correlations, taken out for [`CorrelationsFile::to_toml`].
    pub(super) fn take_correlations(&mut self) -> Option<CorrelationsFile<'a>> {
        self.correlations.take()
    }
}
