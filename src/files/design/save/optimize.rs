//! `[optimize]`.

use serde::Serialize;

use crate::design::{Combination, OptimizeTable, SearchTable};
use machine::requirements::KeptSymmetry;

#[derive(Serialize, PartialEq)]
pub(super) struct WeightedObjective {
    name: &'static str,
    weight: f64,
}

/// `[optimize]`.
#[derive(Serialize, Default, PartialEq)]
pub(super) struct OptimizeFile {
    #[serde(skip_serializing_if = "Option::is_none")]
    min_joint_distance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    min_abs_det: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    characteristic_length: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    variables: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    symmetry: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mode: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slack: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    offset_bounds: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stretch_bounds: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height_bounds: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fixed: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    objectives: Vec<WeightedObjective>,
}

impl OptimizeFile {
    pub(super) fn of(limits: &OptimizeTable, search: &SearchTable) -> Self {
        let (mode, slack, points) = match search.mode {
            None => (None, None, None),
            Some(Combination::Weighted) => (Some("weighted"), None, None),
            Some(Combination::Lexicographic { slack }) => (Some("lexicographic"), Some(slack), None),
            Some(Combination::Pareto { points }) => (Some("pareto"), None, Some(points)),
        };
        let pair = |b: Option<(f64, f64)>| b.map(|(low, high)| [low, high]);
        Self {
            min_joint_distance: limits.min_joint_distance,
            min_abs_det: limits.min_abs_det,
            characteristic_length: limits.characteristic_length,
            variables: search.variables.iter().map(|v| v.code()).collect(),
            symmetry: search.symmetry.map(KeptSymmetry::code),
            mode,
            slack,
            points,
            offset_bounds: pair(search.offset_bounds),
            stretch_bounds: pair(search.stretch_bounds),
            height_bounds: pair(search.height_bounds),
            fixed: search.fixed.iter().flatten().cloned().collect(),
            objectives: search
                .objectives
                .iter()
                .map(|(o, weight)| WeightedObjective { name: o.code(), weight: *weight })
                .collect(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
