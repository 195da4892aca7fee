//! The JSON Schema of design files.

use std::sync::LazyLock;

use serde_json::{Map, Value as Json, json};

use super::document::TOP;
use super::kind::{EDGES, HALF_WIDTHS, KeyShape, VECTOR, numbers, parsed, unit, word};
use super::stored::Word;
use machine::requirements::Objective;

/// JSON Schema (draft 2020-12) of a design as JSON; a TOML file has the same structure.
///
/// Checks beyond a schema are left to [`parse`](crate::design::parse): the joints of the legs exist, bodies have a
/// size, rotations are rotations. It accepts a TOML file with `legs` below `[base]` with a warning; the schema refuses
/// it.
pub static SCHEMA: LazyLock<String> = LazyLock::new(|| format!("{:#}\n", Json::Object(schema())));

/// Values that several keys have.
const DEFINITIONS: &str = r##"{
    "number": {"type": "number", "exclusiveMinimum": -1e60, "exclusiveMaximum": 1e60},
    "positive": {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1e60},
    "not_negative": {"type": "number", "minimum": 0, "exclusiveMaximum": 1e60},
    "quaternion": {"type": "array", "minItems": 4, "maxItems": 4, "items": {"$ref": "#/$defs/number"}},
    "rows": {"type": "array", "minItems": 3, "maxItems": 3, "items": {"$ref": "#/$defs/vector"}},
    "range": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"$ref": "#/$defs/number"}},
    "around_home": {
        "type": "array", "minItems": 2, "maxItems": 2,
        "prefixItems": [
            {"type": "number", "maximum": 0, "exclusiveMinimum": -1e60},
            {"type": "number", "minimum": 0, "exclusiveMaximum": 1e60}
        ]
    },
    "degrees_around_home": {
        "type": "array", "minItems": 2, "maxItems": 2,
        "prefixItems": [
            {"type": "number", "maximum": 0, "minimum": -180}, {"type": "number", "minimum": 0, "maximum": 180}
        ]
    },
    "quantity": {
        "oneOf": [{"$ref": "#/$defs/number"}, {"type": "string", "pattern": "\\S", "maxLength": 2000}],
        "description": "a decimal, or an expression such as \"6*sqrt(3)\": numbers, names of parameters, + - * / ^, parentheses, sqrt(), sin_deg(), cos_deg(); a length may have a unit behind it, \"12/5 mm\""
    },
    "percent": {"type": "string", "pattern": "^ *[0-9.]+ *% *$"},
    "safety_margin": {"oneOf": [{"$ref": "#/$defs/not_negative"}, {"$ref": "#/$defs/percent"}]},
    "housing": {"oneOf": [{"$ref": "#/$defs/positive"}, {"$ref": "#/$defs/edges"}]},
    "axes": {
        "oneOf": [
            {"enum": ["home", "normal", "optimize"]},
            {"$ref": "#/$defs/vector"},
            {"type": "array", "minItems": 6, "maxItems": 6, "items": {"anyOf": [{"$ref": "#/$defs/vector"}, {"const": "normal"}]}}
        ]
    }
}"##;

fn schema() -> Map<String, Json> {
    let Json::Object(mut definitions) = parsed(DEFINITIONS) else { return Map::new() };
    for list in [&VECTOR, &EDGES, &HALF_WIDTHS] {
        numbers(list, unit::NONE).schema(&mut definitions);
    }
    definitions.insert("objective".to_owned(), word(Objective::words).schema(&mut Map::new()));
    let Json::Object(keys) = TOP.schema(&mut definitions) else { return Map::new() };
    let mut out = Map::from_iter([
        ("$schema".to_owned(), json!("https://json-schema.org/draft/2020-12/schema")),
        ("title".to_owned(), json!("Design of a Gough-Stewart platform")),
        (
            "description".to_owned(),
            json!(
                "A design file of equipod, as JSON; a TOML file has the same structure. What no schema can say (joints of legs exist, axes are not zero, rotations are rotations) is checked by the program."
            ),
        ),
    ]);
    out.extend(keys);
    out.insert("$defs".to_owned(), Json::Object(definitions));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every table of the schema, with its place.
    fn tables<'a>(schema: &'a Json, place: &str, out: &mut Vec<(String, &'a Map<String, Json>)>) {
        match schema {
            Json::Object(keys) => {
                out.extend(keys.contains_key("properties").then(|| (place.to_owned(), keys)));
                keys.iter().for_each(|(key, part)| tables(part, &format!("{place}/{key}"), out));
            }
            Json::Array(list) => list.iter().for_each(|part| tables(part, place, out)),
            _ => {}
        }
    }

    #[test]
    fn rules_name_keys_of_their_tables_and_references_definitions() {
        let schema: Json = serde_json::from_str(&SCHEMA).unwrap();
        let mut all = Vec::new();
        tables(&schema, "", &mut all);
        for (place, table) in all.into_iter().filter(|(place, _)| !place.contains("dependentSchemas")) {
            assert_ne!(table.get("additionalProperties"), None, "{place} takes names or no other keys");
            let names = |list: &Json| -> Vec<String> {
                list.as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
            };
            let mut named: Vec<String> = table.get("required").map(names).unwrap_or_default();
            for (key, needs) in table.get("dependentRequired").and_then(Json::as_object).into_iter().flatten()
            {
                named.extend(names(needs));
                named.push(key.clone());
            }
            for key in named {
                assert!(table["properties"].get(&key).is_some(), "{place}: {key}");
            }
        }
        let text = SCHEMA.as_str();
        for reference in text.split("\"#/").skip(1).filter_map(|rest| rest.split('"').next()) {
            assert!(schema.pointer(&format!("/{reference}")).is_some(), "{reference}");
        }
    }
}
