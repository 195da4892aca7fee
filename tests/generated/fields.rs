//! Tables of fields of answers, records and design files, made from the schemas that programs read.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use serde_json::{Map, Value};

use super::cell;
use files::design::SCHEMA;

const BOOLEAN: &str = "`true` or `false`";

/// A schema with the definitions it names.
pub(super) struct Fields {
    definitions: Map<String, Value>,
}

/// A text behind a schema's key.
pub(super) fn text<'a>(schema: &'a Value, key: &str) -> Option<&'a str> {
    schema.get(key).and_then(Value::as_str)
}

/// The alternatives that a schema lists.
pub(super) fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    ["anyOf", "oneOf"].into_iter().filter_map(|k| schema.get(k)?.as_array()).flatten()
}

/// The name of the definition that a schema refers to.
pub(super) fn reference(schema: &Value) -> Option<&str> {
    text(schema, "$ref")?.strip_prefix("#/$defs/")
}

/// A constant or a word, as written in a document.
pub(super) fn code(value: &Value) -> String {
    format!("`{}`", value.as_str().map_or_else(|| value.to_string(), ToString::to_string))
}

/// A text of the source without links to other items, which a reader of a page cannot follow.
pub(super) fn without_links(text: &str) -> String {
    let mut parts = text.split("[`");
    let mut out = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let Some((name, rest)) = part.split_once("`]") else {
            let _ = write!(out, "[`{part}");
            continue;
        };
        let target = rest.strip_prefix('(').and_then(|r| r.split_once(')'));
        let _ = write!(out, "`{name}`{}", target.map_or(rest, |(_, after)| after));
    }
    out
}

/// Texts with commas, and `or` before the last.
fn choice(list: Vec<String>) -> String {
    let mut seen = BTreeSet::new();
    let each = |x: String| if x == BOOLEAN { vec!["`true`".into(), "`false`".into()] } else { vec![x] };
    let mut list: Vec<String> = list.into_iter().flat_map(each).collect();
    list.retain(|x| seen.insert(x.clone()));
    match list.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => list.concat(),
    }
}

/// The words of an enumeration, each with its description; empty for other schemas.
pub(super) fn words(schema: &Value) -> Vec<(String, Option<&str>)> {
    let plain = schema.get("enum").and_then(Value::as_array).into_iter().flatten().map(|w| (code(w), None));
    let told = alternatives(schema).flat_map(|a| match a.get("const") {
        Some(word) => vec![(code(word), text(a, "description"))],
        None => words(a),
    });
    plain.chain(told).collect()
}

fn number(schema: &Value, name: &str) -> String {
    let limit = |key: &str| schema.get(key).and_then(Value::as_f64);
    let positive = limit("exclusiveMinimum").is_some_and(|x| x >= 0.0);
    let least = limit("minimum").filter(|_| schema.get("format").is_none());
    match (least, limit("maximum")) {
        (Some(low), Some(high)) => format!("{name} from {low} to {high}"),
        (Some(_), None) => format!("{name}, not negative"),
        (None, Some(high)) if positive => format!("positive {name}, at most {high}"),
        _ if positive => format!("positive {name}"),
        _ => name.to_string(),
    }
}

impl Fields {
    /// The schema itself, or the definition it refers to.
    fn resolved<'a>(&'a self, schema: &'a Value) -> &'a Value {
        reference(schema).and_then(|name| self.definitions.get(name)).unwrap_or(schema)
    }

    /// The type of the value of a key, in words.
    fn kind(&self, schema: &Value) -> String {
        if reference(schema).is_some() {
            return self.kind(self.resolved(schema));
        }
        if let Some(word) = schema.get("const") {
            return code(word);
        }
        let listed = words(schema);
        let others = alternatives(schema).filter(|a| a.get("const").is_none() && a.get("enum").is_none());
        let kinds: Vec<String> =
            listed.into_iter().map(|w| w.0).chain(others.map(|a| self.kind(a))).collect();
        if !kinds.is_empty() && schema.get("properties").is_none() {
            return choice(kinds);
        }
        match schema.get("type") {
            Some(Value::Array(types)) => {
                let one = |t: &Value| {
                    let mut single = schema.clone();
                    single["type"] = t.clone();
                    self.kind(&single)
                };
                choice(types.iter().map(one).collect())
            }
            Some(Value::String(name)) => self.plain(name, schema),
            _ => "anything".to_string(),
        }
    }

    /// The type of the value of a key, by the name of its type.
    fn plain(&self, name: &str, schema: &Value) -> String {
        match name {
            "null" => "`null`".into(),
            "boolean" => BOOLEAN.into(),
            "integer" => number(schema, "whole number"),
            "number" => number(schema, "number"),
            "string" => "text".into(),
            "array" => self.list(schema),
            _ => schema
                .get("additionalProperties")
                .filter(|s| s.is_object())
                .map_or_else(|| "table".to_string(), |s| format!("table, by name: {}", self.kind(s))),
        }
    }

    fn list(&self, schema: &Value) -> String {
        let count = |key: &str| schema.get(key).and_then(Value::as_u64);
        let size = match (count("minItems"), count("maxItems")) {
            (Some(a), Some(b)) if a == b => format!(" of {a}"),
            (Some(a), Some(b)) => format!(" of {a} to {b}"),
            (Some(a), None) if a > 0 => format!(" of {a} or more"),
            _ => String::new(),
        };
        let places = schema.get("prefixItems").and_then(Value::as_array);
        let mut each: Vec<String> = places
            .map_or_else(|| schema.get("items").into_iter().collect(), |p| p.iter().collect::<Vec<_>>())
            .into_iter()
            .map(|item| self.kind(item))
            .map(|kind| if kind.contains(" or ") { format!("({kind})") } else { kind })
            .collect();
        each.dedup();
        format!("list{size}: {}", each.join("; "))
    }

    /// The description of a field, with its words and its default, if it has some.
    fn meaning(&self, schema: &Value, required: bool) -> String {
        let said = text(schema, "description").or_else(|| text(self.resolved(schema), "description"));
        let own = said.or_else(|| schema.get("const").map(|_| "Tells which of these it is."));
        let mut out = own.unwrap_or_default().trim().to_string();
        for (word, meaning) in words(self.resolved(schema)) {
            if let Some(meaning) = meaning {
                let _ = write!(out, " {word}: {meaning}");
            }
        }
        if let Some(default) = schema.get("default") {
            let _ = write!(out, "; default `{default}`");
        } else if required {
            out.push_str("; required");
        }
        cell(&without_links(out.trim_start_matches("; ")))
    }
}

/// The table for the mark `<!-- keys of design [TABLES] -->`: the top-level keys of a design file, or the keys of some
/// of its tables. `None` if one is not a table.
pub(super) fn of_design(mark: &str) -> Option<String> {
    let mut names = mark.split(' ');
    let mut schema: Value = serde_json::from_str(&SCHEMA).ok()?;
    if names.next() != Some("design") {
        return None;
    }
    let definitions = schema.get_mut("$defs").and_then(Value::as_object_mut).map(std::mem::take)?;
    let fields = Fields { definitions };
    let mut out = String::from("\n| key | value | meaning |\n|---|---|---|\n");
    let tables: Vec<&str> = names.collect();
    if tables.is_empty() {
        fields.keys(&mut out, "", &schema);
    }
    for table in tables {
        let found = schema.get("properties")?.get(table)?;
        let found = fields.resolved(found.get("items").unwrap_or(found));
        found.get("properties")?;
        fields.keys(&mut out, &format!("{table}."), fields.resolved(found));
    }
    out.push('\n');
    Some(out)
}

impl Fields {
    /// Rows for the keys of a table of a design file.
    fn keys(&self, out: &mut String, prefix: &str, table: &Value) {
        let required: BTreeSet<&str> = table
            .get("required")
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
            .filter_map(Value::as_str)
            .collect();
        for (name, property) in table.get("properties").and_then(Value::as_object).into_iter().flatten() {
            let found = self.resolved(property);
            let several = found.get("items").is_some_and(|i| self.resolved(i).get("properties").is_some());
            let is_table = found.get("properties").is_some() || found.get("type") == Some(&"object".into());
            let (key, value) = match (prefix.is_empty(), is_table, several) {
                (true, true, _) => (format!("[{name}]"), "table".to_string()),
                (true, _, true) => (format!("[[{name}]]"), "list of tables".to_string()),
                _ => (format!("{prefix}{name}"), self.kind(property)),
            };
            let meaning = self.meaning(property, required.contains(name.as_str()));
            let _ = writeln!(out, "| `{key}` | {} | {meaning} |", cell(&value));
        }
    }
}
