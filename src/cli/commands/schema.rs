//! `equipod schema`: JSON Schemas of design files and of answers.

use clap::builder::PossibleValuesParser;
use serde_json::{Map, Value, json};

use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::Answer;
use crate::design::SCHEMA;

/// Answers of all commands, as definitions by name of the command.
const ANSWERS: &str = include_str!("../answers.schema.json");

/// What has a schema: design files, and the answers of the commands that give results.
const NAMES: [&str; 25] = [
    "design",
    "assess",
    "bench",
    "check",
    "components",
    "convert",
    "error",
    "explore",
    "export",
    "family",
    "fk",
    "locus",
    "map",
    "move",
    "optimize",
    "plot",
    "presets",
    "report",
    "round",
    "selfmotion",
    "singularities",
    "tolerances",
    "topologies",
    "verify",
    "view",
];

/// Arguments of `schema`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// `design` for design files, `error` for refusals, a command for its answer with --json
    #[arg(default_value = "design", value_parser = PossibleValuesParser::new(NAMES))]
    of: String,
}

fn parsed(text: &str) -> Result<Value, Failure> {
    serde_json::from_str(text).map_err(|e| Failure::internal(format!("a schema is no JSON: {e}")))
}

/// The schema of one answer: all definitions, and which one counts.
fn answer(command: &str) -> Result<Value, Failure> {
    let mut schema = parsed(ANSWERS)?;
    schema["title"] = json!(format!("Answer of equipod {command} --json"));
    schema["$ref"] = json!(format!("#/$defs/{command}"));
    Ok(schema)
}

/// The schema on standard output.
pub(crate) fn run(args: &Args) -> Result<Answer, Failure> {
    let schema = if args.of == "design" { parsed(SCHEMA)? } else { answer(&args.of)? };
    let text = format!("{schema:#}\n");
    let mut json = Map::new();
    json.insert("of".into(), json!(args.of));
    json.insert("schema".into(), schema);
    Ok(Answer { exit: Exit::Yes, json, text })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_a_schema_and_every_reference_a_definition() {
        let all = parsed(ANSWERS).unwrap();
        let defined = all["$defs"].as_object().unwrap();
        for name in NAMES.iter().filter(|n| **n != "design") {
            assert!(defined.contains_key(*name), "{name}");
        }
        for reference in ANSWERS.split("\"#/$defs/").skip(1) {
            let name = reference.split('"').next().unwrap();
            assert!(defined.contains_key(name), "{name}");
        }
    }
}
