//! The schema knows the keys and names that the reader knows. Whether documents obey it is asked of a validator in `tests/exports`.

use serde_json::Value;

use super::calibration::{CALIBRATION_KEYS, CORRELATIONS_KEYS};
use super::cranks::{COPY_KEYS, CRANK_KEYS, DRIVE_KEYS};
use super::holes::{GRID_KEYS, PLATE_KEYS};
use super::limits::{ENVELOPE_KEYS, PAYLOAD_KEYS};
use super::plates::{BOLT_KEYS, PLATE_TABLE_KEYS, PLATES_KEYS};
use super::search::SEARCH_KEYS;
use super::tables::{HARDWARE_KEYS, LIMIT_KEYS, POSE_KEYS, WORKSPACE_KEYS};
use crate::design::SCHEMA;
use machine::requirements::{HolePattern, Objective, TermKind, VariableKind};

fn sorted<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let mut names: Vec<&str> = names.into_iter().collect();
    names.sort_unstable();
    names
}

#[test]
fn the_schema_has_the_keys_of_the_reader() {
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let keys = |place: &str| {
        let table = schema.pointer(place).unwrap();
        assert_eq!(table["additionalProperties"], false, "{place} refuses what is not known");
        sorted(table["properties"].as_object().unwrap().keys().map(String::as_str))
    };
    assert_eq!(keys(""), sorted(super::TOP_LEVEL));
    assert_eq!(keys("/properties/workspace"), sorted(WORKSPACE_KEYS));
    assert_eq!(keys("/properties/hardware"), sorted(HARDWARE_KEYS));
    assert_eq!(keys("/$defs/joint_model"), sorted(crate::design::validate::joint_models::KEYS));
    assert_eq!(keys("/properties/optimize"), sorted(SEARCH_KEYS.into_iter().chain(LIMIT_KEYS)));
    assert_eq!(keys("/$defs/pose"), sorted(POSE_KEYS));
    assert_eq!(keys("/$defs/home_pose"), sorted(POSE_KEYS));
    assert_eq!(keys("/properties/envelope"), sorted(ENVELOPE_KEYS));
    assert_eq!(keys("/properties/holes"), sorted(PLATE_KEYS.into_iter().chain(GRID_KEYS)));
    assert_eq!(keys("/$defs/hole_grid"), sorted(GRID_KEYS));
    assert_eq!(keys("/properties/plates"), sorted(PLATES_KEYS));
    assert_eq!(keys("/$defs/plate"), sorted(PLATE_TABLE_KEYS));
    assert_eq!(keys("/$defs/bolts"), sorted(BOLT_KEYS));
    assert_eq!(keys("/properties/payload"), sorted(PAYLOAD_KEYS));
    assert_eq!(keys("/properties/calibration"), sorted(CALIBRATION_KEYS));
    assert_eq!(keys("/properties/calibration/properties/correlations"), sorted(CORRELATIONS_KEYS));
    assert_eq!(keys("/$defs/crank"), sorted(CRANK_KEYS.into_iter().chain(COPY_KEYS)));
    let shared = schema.pointer("/properties/cranks/properties").and_then(Value::as_object).unwrap();
    let known = sorted(CRANK_KEYS.into_iter().chain(DRIVE_KEYS));
    assert_eq!(sorted(shared.keys().map(String::as_str)), known, "further keys are tables of single cranks");
    let reserved = TermKind::ALL.map(TermKind::code).into_iter().chain(["all"]);
    assert_eq!(keys("/properties/limits/properties/reserve/oneOf/1"), sorted(reserved));
    let names = |place: &str| {
        let list = schema.pointer(place).unwrap().as_array().unwrap();
        sorted(list.iter().map(|v| v.as_str().unwrap()))
    };
    assert_eq!(names("/$defs/objective/enum"), sorted(Objective::ALL.map(Objective::code)));
    let patterns = names("/$defs/hole_grid/properties/pattern/enum");
    assert_eq!(patterns, sorted(HolePattern::ALL.map(HolePattern::name)));
    let variables = names("/properties/optimize/properties/variables/items/enum");
    assert_eq!(variables, sorted(VariableKind::ALL.map(VariableKind::code)));
}
