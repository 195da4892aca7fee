//! The page of answers: every field of every record once, from the schemas by which programs read them.
//!
//! The page has the main clause of each description; the schemas have the descriptions in full.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use serde_json::{Map, Value};

use super::fields::{alternatives, code, reference, text, without_links, words};

/// Fields of every answer, which the manual describes once.
const IN_ALL: [&str; 3] = ["schema_version", "provenance", "warnings"];
/// The records behind these fields.
const RECORDS_OF_ALL: [&str; 4] =
    ["ProvenanceRecord", "DesignSourceRecord", "FileSourceRecord", "WarningRecord"];
/// A field that so many records have with the same meaning is described once, at the top of the page.
const COMMON: usize = 2;
/// A meaning with fewer words is repeated instead.
const LEAST_COMMON: usize = 2;
/// A longer list of words has a section of its own.
const MOST_WORDS: usize = 12;
/// Records with fewer fields are written out again where another record contains them.
const LEAST_PART: usize = 4;

/// A description with more words is cut at the end of its main clause.
const LONGEST: usize = 5;
/// A main clause has so many words at least.
const SHORTEST: usize = 3;
/// Units and frames, which stay behind the main clause.
const UNITS: [&str; 8] = [
    "design units",
    "degrees",
    "radians",
    "seconds",
    "microseconds",
    "base frame",
    "platform frame",
    "decimal logarithm",
];

/// Ends of names that tell a unit.
const NAMED_UNITS: [(&str, &str); 5] =
    [("_deg", "degrees"), ("_s", "seconds"), ("_us", "microseconds"), ("_rad", "radians"), ("_hz", "hertz")];
/// Definitions of complex numbers, whose names end with the arrangement of the numbers.
const COMPLEX: &str = "ComplexRecord";

/// A field as one line shows it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Field {
    name: String,
    kind: String,
    meaning: String,
}

impl Field {
    /// The field whether it may be null or not, and for integers as for other numbers.
    fn loose(&self) -> Self {
        let kind = self.kind.replace("integer", "number").trim_end_matches('?').to_string();
        Self { kind, ..self.clone() }
    }

    /// The marks of lists and of null behind the name, if they say all of the kind: numbers and records are the usual
    /// kinds, and a meaning tells a boolean.
    fn marks(&self) -> Option<&str> {
        let usual = ["number", "integer", "record"].into_iter().find_map(|k| self.kind.strip_prefix(k));
        let told = self.kind.strip_prefix("boolean").filter(|_| self.meaning.starts_with("Whether"));
        let marks = usual.or(told)?;
        let of_list = marks.strip_suffix('?').unwrap_or(marks);
        let is_number = ["number?", "integer?"].contains(&self.kind.as_str());
        let is_plain = of_list.chars().all(|c| c.is_ascii_digit() || c == '[' || c == ']');
        is_plain.then_some(if is_number { "" } else { marks })
    }

    fn line(&self) -> String {
        let (marks, kind) = match self.marks() {
            Some(marks) => (marks, String::new()),
            None => ("", format!(" ({})", self.kind)),
        };
        let meaning = if self.meaning.is_empty() { String::new() } else { format!(": {}.", self.meaning) };
        format!("`{}{marks}`{kind}{meaning}", self.name)
    }

    /// The name of a field that is described elsewhere.
    fn reminder(&self) -> String {
        let is_number = ["number?", "integer?"].contains(&self.kind.as_str());
        let mark = if self.kind.ends_with('?') && !is_number { "?" } else { "" };
        format!("`{}{mark}`", self.name)
    }
}

/// All answers with all records they name.
struct Answers {
    /// In the order of the page.
    names: Vec<&'static str>,
    definitions: BTreeMap<String, Value>,
    /// Records with a section of their own; all others stand below the one field that has them.
    sections: BTreeSet<String>,
    /// Fields described at the top.
    common: BTreeSet<Field>,
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|c| c.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

fn count(text: &str) -> usize {
    text.split_whitespace().count()
}

/// The parts of a text between these marks, of which none within brackets or code counts.
fn parts<'a>(text: &'a str, marks: &[&str]) -> Vec<&'a str> {
    let (mut depth, mut from, mut code) = (0_i32, 0, false);
    let mut out = Vec::new();
    for (at, c) in text.char_indices() {
        depth += i32::from(c == '(' || c == '[') - i32::from(c == ')' || c == ']');
        code ^= c == '`';
        let mark = marks.iter().find(|mark| text[at..].starts_with(**mark));
        if let (Some(mark), 0, false) = (mark, depth, code) {
            out.push(text[from..at].trim());
            from = at + mark.len();
        }
    }
    out.push(text[from..].trim());
    out
}

/// A text without what stands in brackets.
fn without_brackets(text: &str) -> String {
    let (mut depth, mut code) = (0_i32, false);
    let mut out = String::new();
    for c in text.chars() {
        code ^= c == '`' && depth == 0;
        depth += i32::from(c == '(' && !code);
        if depth == 0 {
            out.push(c);
        }
        depth -= i32::from(c == ')' && !code);
    }
    super::one_line(&out).replace(" ,", ",")
}

/// The main clause of the first sentence of a description, with units and what truth values mean.
fn brief(description: &str) -> String {
    let line = super::one_line(&without_links(description));
    let sentence = line
        .match_indices(". ")
        .find(|(at, _)| line[at + 2..].starts_with(|c: char| c.is_uppercase() || c == '`'))
        .map_or(line.as_str(), |(at, _)| &line[..at])
        .trim_end_matches('.');
    let clauses = parts(sentence, &["; "]);
    let mut main = clauses[0].to_string();
    if count(&main) > LONGEST {
        main = without_brackets(&main);
    }
    if count(&main) > LONGEST {
        let pieces = parts(&main, &[", ", ": "]);
        let mut short = pieces[0].to_string();
        for piece in &pieces[1..] {
            if count(&short) < SHORTEST {
                short = main.find(piece).map_or(&*main, |at| &main[..at + piece.len()]).to_string();
            } else if UNITS.iter().any(|unit| piece.starts_with(unit)) {
                let _ = write!(short, ", {piece}");
            }
        }
        main = short;
    }
    for article in ["The ", "A ", "An "] {
        if let Some(rest) = main.strip_prefix(article).filter(|rest| !rest.starts_with("same")) {
            main = capitalised(rest);
        }
    }
    // both values of a truth value
    let others =
        clauses[1..].iter().copied().filter(|part| part.starts_with("true") || part.starts_with("false"));
    std::iter::once(main.as_str()).chain(others).collect::<Vec<_>>().join("; ")
}

/// A meaning without a unit that the page or the name tells, and without `Number of` for an integer.
fn without_usual(name: &str, kind: &str, meaning: &str) -> String {
    let mut main = meaning.strip_suffix(", design units").unwrap_or(meaning);
    for (end, unit) in NAMED_UNITS {
        let rest = main.strip_suffix(unit).and_then(|rest| rest.strip_suffix(", "));
        main = rest.filter(|_| name.ends_with(end)).unwrap_or(main);
    }
    let counted = main.strip_prefix("Number of ").filter(|_| ["integer", "integer?"].contains(&kind));
    let things = counted.filter(|rest| {
        let first = rest.split(' ').next().unwrap_or_default();
        !first.starts_with('`') && !["the", "its", "a", "an", "this", "these", "that"].contains(&first)
    });
    things.map_or_else(|| main.to_string(), capitalised)
}

/// Whether a text says no more than the name of its field.
fn repeats(name: &str, meaning: &str) -> bool {
    let of_name = meaning.strip_prefix("Name of the ").filter(|_| name == "name");
    if of_name.is_some_and(|rest| rest.chars().all(char::is_alphanumeric)) {
        return true;
    }
    let names: Vec<String> = name.to_lowercase().split('_').map(|n| n.chars().take(5).collect()).collect();
    let small = ["the", "a", "an", "of", "its", "it", "in", "to", "and", "is", "as", "for", "this", "are"];
    let mut said = meaning.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty());
    said.all(|word| {
        let word = word.to_lowercase();
        small.contains(&word.as_str()) || names.iter().any(|n| word.starts_with(n.as_str()))
    })
}

/// The sizes of nested lists, such as `[3][3]`, or the record that a schema names.
fn arrangement(schema: &Value) -> String {
    match (schema.get("items"), schema.get("minItems")) {
        (Some(each), Some(size)) => format!("{}[{size}]", arrangement(each)),
        _ => reference(schema).unwrap_or_default().to_string(),
    }
}

/// Definitions under new names.
fn renamed(found: &Map<String, Value>, names: &BTreeMap<String, String>) -> Map<String, Value> {
    let mut text = Value::Object(found.clone()).to_string();
    for (name, new) in names {
        text = text.replace(&format!("#/$defs/{name}\""), &format!("#/$defs/{new}\""));
    }
    let found: Map<String, Value> = serde_json::from_str(&text).unwrap_or_default();
    found.into_iter().map(|(name, schema)| (names.get(&name).cloned().unwrap_or(name), schema)).collect()
}

/// Adds the definitions of an answer. A type that holds several shapes of numbers has numbered definitions, and each
/// answer counts from 1: complex numbers are named by their arrangement here, and other such names get another number.
fn add(all: &mut BTreeMap<String, Value>, found: &Map<String, Value>) {
    let complex = found.iter().filter_map(|(name, schema)| {
        let number = name.strip_prefix(COMPLEX)?;
        let part = schema.get("properties")?.get("re")?;
        let is_numbered = number.chars().all(|c| c.is_ascii_digit());
        is_numbered.then(|| (name.clone(), format!("{COMPLEX}{}", arrangement(part))))
    });
    let found = renamed(found, &complex.collect());
    let clashes = |name: &str, schema: &Value| all.get(name).is_some_and(|known| known != schema);
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    for (name, schema) in found.iter().filter(|(name, schema)| clashes(name, schema)) {
        let is_free = |new: &String| !found.contains_key(new) && !clashes(new, schema);
        if let Some(new) = (2..=found.len() + all.len() + 2).map(|k| format!("{name}{k}")).find(is_free) {
            names.insert(name.clone(), new);
        }
    }
    all.extend(renamed(&found, &names));
}

/// The arrangement of complex numbers, for the definitions that hold nothing else.
fn complex_list(name: &str) -> Option<&str> {
    name.strip_prefix(COMPLEX).filter(|list| list.starts_with('['))
}

/// A design file or a part of it, which has a page of its own.
fn is_of_design(name: &str) -> bool {
    name == "design" || name.starts_with("design_")
}

fn own_properties(schema: &Value) -> impl Iterator<Item = (&String, &Value)> {
    let properties = schema.get("properties").and_then(Value::as_object).into_iter().flatten();
    properties.filter(|(name, _)| !IN_ALL.contains(&name.as_str()))
}

/// A line with names, if there are some.
fn write_names(out: &mut String, pad: &str, before: &str, names: &mut Vec<String>) {
    if !names.is_empty() {
        let _ = writeln!(out, "{pad}- {before}{}.", names.join(", "));
        names.clear();
    }
}

impl Answers {
    fn new() -> Self {
        let mut definitions = BTreeMap::new();
        let answers: Vec<&'static str> = records::schema_names().collect();
        for name in &answers {
            let schema = records::schema(name).unwrap_or_default();
            let found = schema.get("$defs").and_then(Value::as_object).cloned().unwrap_or_default();
            add(&mut definitions, &found);
        }
        let mut all =
            Self { names: answers, definitions, sections: BTreeSet::new(), common: BTreeSet::new() };
        all.find_sections();
        all.find_common();
        all
    }

    fn definition(&self, schema: &Value) -> Option<(&str, &Value)> {
        let name = reference(schema)?;
        self.definitions.get_key_value(name).map(|(name, found)| (name.as_str(), found))
    }

    fn resolved<'a>(&'a self, schema: &'a Value) -> &'a Value {
        self.definition(schema).map_or(schema, |(_, found)| found)
    }

    /// Whether a schema has fields, or an alternative that has some; words and their unions have none.
    fn is_record(&self, schema: &Value) -> bool {
        schema.get("properties").is_some() || alternatives(schema).any(|a| self.is_record(self.resolved(a)))
    }

    /// The records that a field names, in lists, tables and alternatives too.
    fn named<'a>(&'a self, schema: &'a Value, out: &mut Vec<&'a str>) {
        if let Some((name, found)) = self.definition(schema) {
            match (is_of_design(name) || complex_list(name).is_some(), self.is_record(found)) {
                (true, _) => {}
                (_, true) => out.push(name),
                _ => self.named(found, out),
            }
            return;
        }
        let parts = ["items", "additionalProperties"].into_iter().filter_map(|k| schema.get(k));
        let places = schema.get("prefixItems").and_then(Value::as_array).into_iter().flatten();
        for part in parts.chain(places).chain(alternatives(schema)) {
            self.named(part, out);
        }
        own_properties(schema).for_each(|(_, property)| self.named(property, out));
    }

    /// The cases of a record: those of its alternatives that are records.
    fn cases<'a>(&'a self, schema: &'a Value) -> impl Iterator<Item = &'a Value> {
        alternatives(schema).filter(|a| self.is_record(self.resolved(a)))
    }

    /// All definitions and the cases that are written out within them, each with its name, empty for a case.
    fn homes(&self) -> Vec<(&str, &Value)> {
        let mut out = Vec::new();
        for (name, schema) in &self.definitions {
            if self.is_record(schema) && !is_of_design(name) {
                out.push((name.as_str(), schema));
                out.extend(self.cases(schema).filter(|c| reference(c).is_none()).map(|c| ("", c)));
            }
        }
        out
    }

    fn find_sections(&mut self) {
        let mut uses: BTreeMap<String, usize> = BTreeMap::new();
        for (name, schema) in self.homes() {
            let mut found = Vec::new();
            self.shown(name, schema).for_each(|(_, property)| self.named(property, &mut found));
            found.extend(self.cases(schema).filter_map(|case| self.definition(case)).map(|(name, _)| name));
            found.extend(self.part_of(name, schema));
            for name in found {
                *uses.entry(name.to_string()).or_default() += 1;
            }
        }
        self.sections = uses.into_iter().filter(|(_, n)| *n > 1).map(|(name, _)| name).collect();
        self.sections.extend(RECORDS_OF_ALL.map(String::from));
    }

    /// The fields of a record, of its cases and of the records below it.
    fn collect_fields(&self, name: &str, schema: &Value, out: &mut BTreeSet<Field>) {
        for (field, property) in self.shown(name, schema) {
            if self.has_list_below(property) {
                self.below(property)
                    .for_each(|record| self.collect_fields(record, &self.definitions[record], out));
            } else {
                out.insert(self.field(field, property));
            }
        }
        for case in self.cases(schema) {
            let name = reference(case).unwrap_or_default();
            if !self.sections.contains(name) {
                self.collect_fields(name, self.resolved(case), out);
            }
        }
    }

    fn find_common(&mut self) {
        let mut seen: BTreeMap<Field, usize> = BTreeMap::new();
        for root in self.names.iter().copied().chain(self.sections.iter().map(String::as_str)) {
            let mut fields = BTreeSet::new();
            self.collect_fields(root, &self.definitions[root], &mut fields);
            for field in fields {
                *seen.entry(field.loose()).or_default() += 1;
            }
        }
        let mut best: BTreeMap<String, (usize, Field)> = BTreeMap::new();
        let is_common = |(field, n): &(Field, usize)| *n >= COMMON && count(&field.meaning) >= LEAST_COMMON;
        for (field, n) in seen.into_iter().filter(is_common) {
            let entry = best.entry(field.name.clone()).or_insert((0, field.clone()));
            if n > entry.0 {
                *entry = (n, field);
            }
        }
        self.common = best.into_values().map(|(_, field)| field).collect();
    }

    /// The records without a section that a field names: their fields stand below it.
    fn below<'a>(&'a self, property: &'a Value) -> impl Iterator<Item = &'a str> {
        let mut found = Vec::new();
        self.named(property, &mut found);
        found.into_iter().filter(|name| !self.sections.contains(*name))
    }

    fn has_list_below(&self, property: &Value) -> bool {
        self.below(property).next().is_some()
    }

    /// The largest other record whose fields are all among those of this one.
    fn part_of<'a>(&'a self, name: &str, schema: &Value) -> Option<&'a str> {
        let own: BTreeMap<&String, &Value> = own_properties(schema).collect();
        let is_part = |other: &Value| {
            let mut fields = own_properties(other);
            let count = own_properties(other).count();
            let equal = |(field, property): (&String, &Value)| own.get(field) == Some(&property);
            count >= LEAST_PART
                && other.get("oneOf").is_none()
                && other.get("anyOf").is_none()
                && fields.all(equal)
        };
        let others = self.definitions.iter().filter(|(other, found)| {
            let smaller =
                own_properties(found).count() < own.len() || name.is_empty() || other.as_str() < name;
            let smaller = smaller || alternatives(schema).next().is_some();
            other.as_str() != name && !self.names.contains(&other.as_str()) && smaller && is_part(found)
        });
        others.max_by_key(|(_, found)| own_properties(found).count()).map(|(other, _)| other.as_str())
    }

    /// The fields of a record without those of the record it contains.
    fn shown<'a>(&'a self, name: &str, schema: &'a Value) -> impl Iterator<Item = (&'a String, &'a Value)> {
        let part = self.part_of(name, schema).map(|part| &self.definitions[part]);
        let in_part =
            move |field: &str| part.is_some_and(|p| own_properties(p).any(|(other, _)| other == field));
        own_properties(schema).filter(move |(field, _)| !in_part(field))
    }

    /// The type behind a key, with `?` for a value that may be null and `[]` for a list.
    fn kind(&self, schema: &Value) -> String {
        if let Some((name, found)) = self.definition(schema) {
            return match name {
                "design" => "[design](design-files.md)".to_string(),
                _ if is_of_design(name) => "[part of a design](design-files.md)".to_string(),
                _ if complex_list(name).is_some() => {
                    format!("complex{}", complex_list(name).unwrap_or_default())
                }
                _ if words(found).len() > MOST_WORDS => format!("[{name}](#{})", name.to_lowercase()),
                _ if !self.is_record(found) => self.kind(found),
                _ if self.sections.contains(name) => format!("[{name}](#{})", name.to_lowercase()),
                _ => "record".to_string(),
            };
        }
        if let Some(word) = schema.get("const") {
            return code(word);
        }
        let listed: Vec<String> =
            words(schema).into_iter().map(|(word, _)| word.trim_matches('`').to_string()).collect();
        let is_null = |w: &String| w == "null";
        let mut optional = listed.iter().any(is_null);
        let choice = listed.into_iter().filter(|w| !is_null(w)).collect::<Vec<_>>().join("|");
        let mut kinds: Vec<String> =
            (!choice.is_empty()).then(|| format!("`{choice}`")).into_iter().collect();
        for other in alternatives(schema).filter(|a| a.get("const").is_none() && a.get("enum").is_none()) {
            match text(other, "type") {
                Some("null") => optional = true,
                _ => kinds.push(self.kind(other)),
            }
        }
        if schema.get("properties").is_some() {
            kinds = vec!["record".to_string()];
        }
        if kinds.is_empty() {
            kinds = match schema.get("type") {
                Some(Value::Array(types)) => types.iter().map(|t| self.plain(t, schema)).collect(),
                Some(name) => vec![self.plain(name, schema)],
                None => Vec::new(),
            };
        }
        kinds.retain(|kind| {
            optional |= kind == "null";
            kind != "null"
        });
        kinds.dedup();
        let kind = kinds.join(" or ");
        match (optional, kind.contains(' ') && !kind.contains("](")) {
            (true, true) => format!("({kind})?"),
            (true, false) => format!("{kind}?"),
            _ => kind,
        }
    }

    /// The kind whose type has this name.
    fn plain(&self, name: &Value, schema: &Value) -> String {
        match name.as_str().unwrap_or_default() {
            "string" => "text".to_string(),
            "array" => {
                let size = schema.get("minItems").filter(|a| schema.get("maxItems") == Some(a));
                let places = schema.get("prefixItems").and_then(Value::as_array);
                let mut each: Vec<String> = places
                    .map_or_else(
                        || schema.get("items").into_iter().collect(),
                        |p| p.iter().collect::<Vec<_>>(),
                    )
                    .into_iter()
                    .map(|item| self.kind(item))
                    .collect();
                each.dedup();
                let kind = each.join("; ");
                // a number in a list is null where it is not finite, which the page says at its top
                let kind = if kind == "number?" { "number".to_string() } else { kind };
                let kind = if kind.contains([' ', ';']) { format!("({kind})") } else { kind };
                format!("{kind}[{}]", size.map(ToString::to_string).unwrap_or_default())
            }
            "object" => {
                let each = schema.get("additionalProperties").filter(|s| s.is_object());
                each.map_or_else(|| "table".to_string(), |s| format!("table of {}", self.kind(s)))
            }
            other => other.to_string(),
        }
    }

    fn field(&self, name: &str, property: &Value) -> Field {
        let said = text(property, "description").or_else(|| text(self.resolved(property), "description"));
        let kind = self.kind(property);
        let meaning = said.map(|said| without_usual(name, &kind, &brief(said)));
        let meaning = meaning.filter(|said| !repeats(name, said)).unwrap_or_default();
        Field { name: name.to_string(), kind, meaning }
    }

    /// The fields of a record and of its cases as a list. Fields described at the top, in the records around it or in
    /// an earlier case are only named.
    fn list(
        &self,
        (name, schema): (&str, &Value),
        indent: usize,
        around: &BTreeSet<Field>,
        shown: &mut BTreeSet<Field>,
    ) -> String {
        let pad = " ".repeat(indent);
        let mut out = String::new();
        if let Some(part) = self.part_of(name, schema) {
            let _ = writeln!(out, "{pad}- Fields of [{part}](#{}).", part.to_lowercase());
        }
        let own: Vec<(&String, &Value)> = self.shown(name, schema).collect();
        let plain = own.iter().filter(|(_, property)| !self.has_list_below(property));
        let inside: BTreeSet<Field> = plain
            .map(|(field, property)| self.field(field, property))
            .chain(around.iter().cloned())
            .collect();
        // neighbours without a meaning share a line
        let (mut bare, mut before) = (Vec::new(), Vec::new());
        for (name, property) in own {
            let field = self.field(name, property);
            let has_list = self.has_list_below(property);
            // a reminder is of the nearest field with this name, so all of them have to be the same
            let mut namesakes = around.iter().chain(shown.iter()).filter(|known| known.name == *name);
            let agree = namesakes.all(|known| known.loose() == field.loose());
            let is_described =
                self.common.contains(&field.loose()) || around.contains(&field) || shown.contains(&field);
            let is_described = agree && is_described;
            if is_described && !has_list {
                before.push(field.reminder());
                continue;
            }
            if field.meaning.is_empty() && !has_list {
                bare.push(field.line());
                shown.insert(field);
                continue;
            }
            write_names(&mut out, &pad, "", &mut bare);
            let _ = writeln!(out, "{pad}- {}", field.line());
            for record in self.below(property) {
                let found = (record, &self.definitions[record]);
                out.push_str(&self.list(found, indent + 2, &inside, &mut BTreeSet::new()));
            }
            shown.insert(field);
        }
        write_names(&mut out, &pad, "", &mut bare);
        write_names(&mut out, &pad, "Also ", &mut before);
        for case in self.cases(schema) {
            let found = self.resolved(case);
            let said = text(case, "description").or_else(|| text(found, "description")).unwrap_or("Or");
            let case_name = reference(case).unwrap_or_default();
            let said = format!("*{}*", brief(said));
            if self.sections.contains(case_name) {
                let link = format!("[{case_name}](#{})", case_name.to_lowercase());
                let _ = writeln!(out, "{pad}- {said}: {link}.");
                continue;
            }
            let fields = self.list((case_name, found), indent + 2, &inside, shown);
            if !fields.is_empty() {
                let _ = write!(out, "{pad}- {said}:\n{fields}");
            }
        }
        out
    }

    /// The list of a record or an answer by itself.
    fn whole_list(&self, name: &str) -> String {
        self.list((name, &self.definitions[name]), 0, &BTreeSet::new(), &mut BTreeSet::new())
    }

    /// Sections that an answer needs, in the order in which its fields name them.
    fn sections_of<'a>(&'a self, schema: &'a Value, out: &mut Vec<&'a str>) {
        let mut found = Vec::new();
        own_properties(schema).for_each(|(_, property)| self.named(property, &mut found));
        found.extend(self.cases(schema).filter_map(|case| self.definition(case)).map(|(name, _)| name));
        for name in found {
            if !out.contains(&name) {
                out.push(name);
                self.sections_of(&self.definitions[name], out);
            }
        }
        self.cases(schema).filter(|c| reference(c).is_none()).for_each(|c| self.sections_of(c, out));
    }

    /// A record by itself; the fields that have it say what it is.
    fn section(&self, name: &str) -> String {
        format!("### {name}\n\n{}\n", self.whole_list(name))
    }

    /// The long lists of words, each with its meanings.
    fn lists_of_words(&self) -> String {
        let mut out = String::from("## Lists of words\n\n");
        for (name, found) in self.definitions.iter().filter(|(name, _)| !is_of_design(name)) {
            let words = words(found);
            if words.len() > MOST_WORDS {
                let said = brief(text(found, "description").unwrap_or_default());
                let _ = writeln!(out, "### {name}\n\n{said}.\n");
                for (word, meaning) in words {
                    let meaning = meaning.map(brief).filter(|m| !repeats(word.trim_matches('`'), m));
                    let _ =
                        writeln!(out, "- {word}{}", meaning.map(|m| format!(": {m}.")).unwrap_or_default());
                }
                out.push('\n');
            }
        }
        out
    }

    fn page(&self) -> String {
        let mut out = String::from("\n## Common fields\n\n");
        for field in &self.common {
            let _ = writeln!(out, "- {}", field.line());
        }
        out.push('\n');
        let mut users: BTreeMap<&str, usize> = BTreeMap::new();
        let needed: Vec<Vec<&str>> = self
            .names
            .iter()
            .map(|name| {
                let mut found = Vec::new();
                self.sections_of(&self.definitions[*name], &mut found);
                found.retain(|record| self.sections.contains(*record));
                found
            })
            .collect();
        needed.iter().flatten().for_each(|record| *users.entry(record).or_default() += 1);
        for (name, records) in self.names.iter().zip(&needed) {
            let title = match *name {
                "error" => "Refusals and failures".to_string(),
                "help" => "`equipod --help`".to_string(),
                _ => format!("`equipod {}`", name.replace('-', " ")),
            };
            let _ = writeln!(out, "## {title}\n\n{}", self.whole_list(name));
            for record in records.iter().filter(|record| users[**record] == 1) {
                out.push_str(&self.section(record));
            }
        }
        out.push_str("## Records of several answers\n\n");
        let several = users.iter().filter(|(_, n)| **n > 1).map(|(name, _)| *name);
        let several: BTreeSet<&str> = several.chain(RECORDS_OF_ALL).collect();
        for name in several {
            out.push_str(&self.section(name));
        }
        out + &self.lists_of_words()
    }
}

/// The fields of all answers, and of all records behind them.
pub(super) fn all() -> String {
    Answers::new().page()
}
