//! Designs inside answers.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use ask::Design;
use files::design::SCHEMA;

/// A design as it stands in a design file in JSON.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct DesignRecord(pub Value);

impl From<&Design> for DesignRecord {
    fn from(design: &Design) -> Self {
        // a design always writes valid JSON
        Self(serde_json::from_str(&design.to_json()).unwrap_or_default())
    }
}

impl DesignRecord {
    /// The name of the design.
    #[must_use]
    pub fn name(&self) -> &str {
        self.text("name")
    }

    /// The unit of its lengths.
    #[must_use]
    pub fn units(&self) -> &str {
        self.text("units")
    }

    fn text(&self, key: &str) -> &str {
        self.0.get(key).and_then(Value::as_str).unwrap_or_default()
    }
}

const DEFINITIONS: &str = "#/$defs/";

impl JsonSchema for DesignRecord {
    fn schema_name() -> Cow<'static, str> {
        "design".into()
    }

    /// The schema of design files, with names of definitions that begin with `design_`.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let text = SCHEMA.replace(DEFINITIONS, &format!("{DEFINITIONS}design_"));
        let mut schema: Map<String, Value> = serde_json::from_str(&text).unwrap_or_default();
        if let Some(Value::Object(parts)) = schema.remove("$defs") {
            for (name, mut part) in parts {
                open(&mut part);
                generator.definitions_mut().insert(format!("design_{name}"), part);
            }
        }
        for key in ["$schema", "title"] {
            schema.remove(key);
        }
        let mut schema = Value::Object(schema);
        open(&mut schema);
        Schema::try_from(schema).unwrap_or_else(|_| json_schema!({"type": "object"}))
    }
}

/// Later versions may add keys to answers, even to objects that a design file keeps closed.
fn open(schema: &mut Value) {
    match schema {
        Value::Object(fields) => {
            fields.retain(|key, value| key != "additionalProperties" || *value != Value::Bool(false));
            fields.values_mut().for_each(open);
        }
        Value::Array(list) => list.iter_mut().for_each(open),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_is_that_of_design_files_and_open() {
        let mut generator = SchemaGenerator::default();
        let own = DesignRecord::json_schema(&mut generator).to_value();
        let file: Value = serde_json::from_str(&SCHEMA).unwrap();
        assert_eq!(file["additionalProperties"], false, "the file itself is closed");
        assert!(own.get("additionalProperties").is_none(), "open");
        assert_eq!(own["required"], file["required"]);
        let parts: Vec<String> =
            file["$defs"].as_object().unwrap().keys().map(|name| format!("design_{name}")).collect();
        assert!(parts.iter().all(|name| generator.definitions().contains_key(name)));
        assert!(own.to_string().contains("#/$defs/design_") && !own.to_string().contains("\"#/$defs/pose\""));
    }
}
