//! `equipod schema`: JSON Schemas of design files and of answers.

use clap::builder::PossibleValuesParser;
use serde_json::{Map, Value, json};

use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::Answer;
use crate::design::SCHEMA;
use crate::records;

/// Files of definitions with their names: that of `fk` defines the answer `fk` and its parts.
macro_rules! definitions {
    ($($name:literal),*) => { [$(($name, include_str!(concat!("../answers/", $name, ".json")))),*] };
}

/// Definitions that answers of several commands use.
const SHARED: [(&str, &str); 1] = definitions!["shared"];

/// What has a schema besides design files: the answer of every command, refusals, and help.
const ANSWERS: [(&str, &str); 13] = definitions![
    "assess",
    "bench",
    "completions",
    "convert",
    "explore",
    "export",
    "man",
    "optimize",
    "plot",
    "presets",
    "report",
    "schema",
    "view"
];

const REFERENCE: &str = "#/$defs/";

/// Arguments of `schema`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// `design` for design files, `error` for refusals, `help` for --help, a command for its answer with --json
    #[arg(default_value = "design", value_parser = PossibleValuesParser::new(names()))]
    of: String,
}

fn names() -> Vec<&'static str> {
    let mut answers: Vec<&str> = ANSWERS.iter().map(|a| a.0).chain(records::schema_names()).collect();
    answers.sort_unstable();
    answers.dedup();
    std::iter::once("design").chain(answers).collect()
}

fn parsed(text: &str) -> Result<Map<String, Value>, Failure> {
    serde_json::from_str(text).map_err(|e| Failure::internal(format!("a schema is not JSON: {e}")))
}

/// Answers may have more keys in later versions, also where a design file may not.
fn open(schema: &mut Value) {
    match schema {
        Value::Object(fields) => {
            fields.retain(|key, value| key != "additionalProperties" || *value != json!(false));
            fields.values_mut().for_each(open);
        }
        Value::Array(list) => list.iter_mut().for_each(open),
        _ => {}
    }
}

/// The schema of design files as definitions `design` and `design_..`, for answers that hold a design.
fn design() -> Result<Map<String, Value>, Failure> {
    let mut schema = parsed(&SCHEMA.replace(REFERENCE, "#/$defs/design_"))?;
    let mut out = Map::new();
    if let Some(Value::Object(parts)) = schema.get("$defs") {
        out.extend(parts.iter().map(|(name, part)| (format!("design_{name}"), part.clone())));
    }
    schema.retain(|key, _| !["$schema", "title", "$defs"].contains(&key.as_str()));
    out.insert("design".into(), Value::Object(schema));
    out.values_mut().for_each(open);
    Ok(out)
}

/// All definitions there are.
fn definitions() -> Result<Map<String, Value>, Failure> {
    let mut all = design()?;
    for (_, text) in SHARED.iter().chain(&ANSWERS) {
        all.extend(parsed(text)?);
    }
    Ok(all)
}

/// The definitions a schema refers to, as often as it does.
fn references(schema: &Value) -> Vec<&str> {
    match schema {
        Value::Object(fields) => {
            let own = fields.get("$ref").and_then(Value::as_str).and_then(|r| r.strip_prefix(REFERENCE));
            own.into_iter().chain(fields.values().flat_map(references)).collect()
        }
        Value::Array(list) => list.iter().flat_map(references).collect(),
        _ => Vec::new(),
    }
}

/// A definition and all it needs, in the order of first use.
fn collect(name: &str, all: &Map<String, Value>, out: &mut Map<String, Value>) {
    let Some(definition) = all.get(name).filter(|_| !out.contains_key(name)) else { return };
    out.insert(name.into(), definition.clone());
    for other in references(definition) {
        collect(other, all, out);
    }
}

/// The schema of one answer with the definitions it needs.
fn answer(of: &str) -> Result<Map<String, Value>, Failure> {
    if let Some(schema) = records::schema(of) {
        return Ok(schema);
    }
    let mut needed = Map::new();
    collect(of, &definitions()?, &mut needed);
    let mut schema = Map::new();
    schema.insert("$schema".into(), json!("https://json-schema.org/draft/2020-12/schema"));
    schema.insert("title".into(), json!(format!("Answer of equipod {of} --json")));
    let open = "Later versions with the same schema_version may add keys to every object, and words to lists of words: pass over what is not known. \
                docs/cli.md says what the fields mean.";
    schema.insert("description".into(), json!(open));
    schema.insert("$ref".into(), json!(format!("{REFERENCE}{of}")));
    schema.insert("$defs".into(), Value::Object(needed));
    Ok(schema)
}

/// The schema on standard output.
pub(crate) fn run(args: &Args) -> Result<Answer, Failure> {
    let schema = Value::Object(if args.of == "design" { parsed(SCHEMA)? } else { answer(&args.of)? });
    let text = format!("{schema:#}\n");
    let mut json = Map::new();
    json.insert("of".into(), json!(args.of));
    json.insert("schema".into(), schema);
    Ok(Answer::new(Exit::Yes, json, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_carries_the_definitions_it_needs_and_no_others() {
        let of = |name| answer(name).unwrap()["$defs"].as_object().unwrap().clone();
        assert_eq!(of("man").keys().collect::<Vec<_>>(), ["man", "document", "warning"]);
        let round = of("round");
        assert!(round.contains_key("design") && round.contains_key("design_pose"));
        assert!(round["design"].get("additionalProperties").is_none(), "open");
        assert!(parsed(SCHEMA).unwrap()["additionalProperties"] == false, "the file itself is closed");
    }
}
