//! Tables of fields of answers, records and design files, made from the schemas that programs read.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use serde_json::{Map, Value};

use super::cell;
use files::design::SCHEMA;
use records;

/// The fields of every answer, which the manual describes once.
const IN_ALL: [&str; 3] = ["schema_version", "provenance", "warnings"];
/// The page with the fields of all records.
const RECORDS_PAGE: &str = "answers.md";

const BOOLEAN: &str = "`true` or `false`";

/// A schema with the definitions it names.
pub(super) struct Fields {
    definitions: Map<String, Value>,
    /// The page on which records are described; empty on this page itself.
    page: &'static str,
}

/// A text behind a schema's key.
fn text<'a>(schema: &'a Value, key: &str) -> Option<&'a str> {
    schema.get(key).and_then(Value::as_str)
}

/// The alternatives that a schema lists.
fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    ["anyOf", "oneOf"].into_iter().filter_map(|k| schema.get(k)?.as_array()).flatten()
}

fn is_record(schema: &Value) -> bool {
    schema.get("properties").is_some() || alternatives(schema).any(is_record_or_reference)
}

/// Whether an alternative is a record itself rather than `null` or a word.
fn is_record_or_reference(schema: &Value) -> bool {
    schema.get("$ref").is_some() || is_record(schema)
}

/// A constant or a word, as written in a document.
fn code(value: &Value) -> String {
    format!("`{}`", value.as_str().map_or_else(|| value.to_string(), ToString::to_string))
}

/// A text of the source without links to other items, which a reader of a page cannot follow.
fn without_links(text: &str) -> String {
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
fn words(schema: &Value) -> Vec<(String, Option<&str>)> {
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
    /// The fields of an answer; `None` for a name that has no schema.
    pub(super) fn of_answer(name: &str, page: &'static str) -> Option<Self> {
        let mut schema = records::schema(name)?;
        let definitions = schema.remove("$defs").and_then(|d| d.as_object().cloned()).unwrap_or_default();
        Some(Self { definitions, page })
    }

    fn definition(&self, reference: &str) -> Option<(&str, &Value)> {
        let name = reference.strip_prefix("#/$defs/")?;
        self.definitions.get_key_value(name).map(|(name, schema)| (name.as_str(), schema))
    }

    /// The schema itself, or the definition it refers to.
    fn resolved<'a>(&'a self, schema: &'a Value) -> &'a Value {
        text(schema, "$ref").and_then(|r| self.definition(r)).map_or(schema, |(_, found)| found)
    }

    /// The type of the value of a key, in words.
    fn kind(&self, schema: &Value) -> String {
        if let Some((name, found)) = text(schema, "$ref").and_then(|r| self.definition(r)) {
            return match name {
                "design" => "[design](design-files.md)".to_string(),
                _ if name.starts_with("design_") => "part of a [design](design-files.md)".to_string(),
                _ if self.page == "design" || !is_record(found) => self.kind(found),
                _ => format!("[{name}]({}#{})", self.page, name.to_lowercase()),
            };
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

    /// Rows of a table, for the properties shown.
    fn rows(&self, schema: &Value, shown: impl Fn(&str) -> bool) -> String {
        let properties = schema.get("properties").and_then(Value::as_object).into_iter().flatten();
        let mut out = String::new();
        for (name, property) in properties.filter(|(name, _)| shown(name)) {
            let _ = writeln!(
                out,
                "| `{name}` | {} | {} |",
                cell(&self.kind(property)),
                self.meaning(property, false)
            );
        }
        out
    }

    /// The tables of a record: its own fields, then the fields of each alternative.
    fn record(&self, schema: &Value) -> String {
        let rows = self.rows(schema, |name| !IN_ALL.contains(&name));
        let mut out = String::new();
        if !rows.is_empty() {
            let _ = writeln!(out, "| field | value | meaning |\n|---|---|---|\n{rows}");
        }
        for alternative in alternatives(schema).filter(|a| is_record_or_reference(a)) {
            let found = self.resolved(alternative);
            if !is_record(found) {
                continue;
            }
            let fields = self.record(found);
            if !fields.is_empty() {
                let said = text(alternative, "description").or_else(|| text(found, "description"));
                let _ = write!(out, "*{}*\n\n{fields}", cell(&without_links(said.unwrap_or("Or:"))));
            }
        }
        out
    }

    /// The tables of one definition; `None` when there is none.
    pub(super) fn table(&self, definition: &str) -> Option<String> {
        self.definitions.get(definition).map(|found| self.record(found))
    }

    /// Records with a section of their own: those that a field refers to. Alternatives are listed at their place.
    fn named_records(&self, from: &str) -> Vec<String> {
        let mut order = Vec::new();
        if let Some(schema) = self.definitions.get(from) {
            self.collect(schema, &mut order);
        }
        order
    }

    fn collect(&self, schema: &Value, order: &mut Vec<String>) {
        for alternative in alternatives(schema).filter(|a| is_record_or_reference(a)) {
            self.collect(self.resolved(alternative), order);
        }
        let properties = schema.get("properties").and_then(Value::as_object).into_iter().flatten();
        for (_, property) in properties.filter(|(name, _)| !IN_ALL.contains(&name.as_str())) {
            self.collect_named(property, order);
        }
    }

    /// The same for the value of a key, including lists and tables.
    fn collect_named(&self, property: &Value, order: &mut Vec<String>) {
        if let Some((name, found)) = text(property, "$ref").and_then(|r| self.definition(r)) {
            if name.starts_with("design") || order.iter().any(|n| n == name) {
                return;
            }
            if is_record(found) {
                order.push(name.to_string());
                self.collect(found, order);
            } else {
                self.collect_named(found, order);
            }
            return;
        }
        let parts = ["items", "additionalProperties"].into_iter().filter_map(|k| property.get(k));
        let places = property.get("prefixItems").and_then(Value::as_array).into_iter().flatten();
        for part in parts.chain(places).chain(alternatives(property)) {
            self.collect_named(part, order);
        }
        if property.get("properties").is_some() {
            self.collect(property, order);
        }
    }
}

/// A text with one sentence a line.
fn sentences(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((sentence, after)) = rest.split_once(". ") {
        let end = if after.starts_with(char::is_uppercase) { ".\n" } else { ". " };
        let _ = write!(out, "{sentence}{end}");
        rest = after;
    }
    out + rest
}

/// All records of all answers: records of one answer below it, records of several at the end.
pub(super) fn all_records() -> String {
    let answers: Vec<(&str, Fields)> =
        records::schema_names().filter_map(|n| Some((n, Fields::of_answer(n, "")?))).collect();
    let mut used: BTreeMap<String, usize> = BTreeMap::new();
    for (name, fields) in &answers {
        for record in fields.named_records(name) {
            *used.entry(record).or_default() += 1;
        }
    }
    let section = |fields: &Fields, name: &str| {
        let said = fields.definitions.get(name).and_then(|d| text(d, "description")).unwrap_or_default();
        let lines = sentences(&cell(&without_links(said)));
        format!("### {name}\n\n{lines}\n\n{}", fields.table(name).unwrap_or_default())
    };
    let mut out = String::from("\n");
    let mut several = BTreeMap::new();
    for (name, fields) in &answers {
        let title = match *name {
            "error" => "Refusals and failures".to_string(),
            "help" => "`equipod --help`".to_string(),
            _ => format!("`equipod {}`", name.replace('-', " ")),
        };
        let _ = writeln!(out, "## {title}\n\n{}", fields.table(name).unwrap_or_default().trim_end());
        out.push('\n');
        for record in fields.named_records(name) {
            let text = section(fields, &record);
            if used.get(&record).is_some_and(|n| *n > 1) {
                several.insert(record, text);
            } else {
                out.push_str(&text);
            }
        }
    }
    out.push_str("## Records of several answers\n\n");
    // the manual describes fields of every answer; their records are here
    let mut rest = String::new();
    if let Some((_, fields)) = answers.first() {
        for record in ["ProvenanceRecord", "DesignSourceRecord", "FileSourceRecord", "WarningRecord"] {
            rest.push_str(&section(fields, record));
        }
    }
    out.push_str(&several.into_values().collect::<String>());
    out.push_str(&rest);
    out
}

/// The table for the mark `<!-- fields of NAME [RECORD] -->`; `None` if there is no such answer or record.
pub(super) fn of_mark(mark: &str) -> Option<String> {
    let (answer, record) = mark.split_once(' ').unwrap_or((mark, mark));
    let fields = Fields::of_answer(answer, RECORDS_PAGE)?;
    Some(format!("\n{}", fields.table(record)?))
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
    let fields = Fields { definitions, page: "design" };
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
