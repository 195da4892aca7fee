//! `equipod design schema`: JSON Schemas of design files and of answers.

use clap::builder::PossibleValuesParser;
use serde_json::Value;

use crate::app::cli::{Answer, Exit, Failure};
use files::design::SCHEMA;
use records::{self, SchemaAnswer};

/// Arguments of `design schema`.
#[derive(Debug, clap::Args)]
pub(crate) struct DesignSchemaArgs {
    /// `design`, `error` for refusals, `help` for --help, or a command such as `equivalents-map`
    #[arg(value_name = "ANSWER", default_value = "design", value_parser = PossibleValuesParser::new(names()))]
    of: String,
}

fn names() -> Vec<&'static str> {
    std::iter::once("design").chain(records::schema_names()).collect()
}

/// The schema on standard output.
pub(crate) fn run(args: &DesignSchemaArgs) -> Result<Answer, Failure> {
    let schema = match records::schema(&args.of) {
        Some(schema) => schema,
        None => serde_json::from_str(&SCHEMA)
            .map_err(|e| Failure::internal(format!("the schema of designs is not JSON: {e}")))?,
    };
    let text = format!("{:#}\n", Value::Object(schema.clone()));
    Ok(Answer::new(Exit::Yes, SchemaAnswer { of: args.of.clone(), schema }, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_carries_the_definitions_it_needs_and_no_others() {
        let of = |name| records::schema(name).unwrap()["$defs"].as_object().unwrap().clone();
        assert_eq!(
            of("shell-man").keys().collect::<Vec<_>>(),
            ["shell-man", "ProvenanceRecord", "DesignSourceRecord", "FileSourceRecord", "WarningRecord"]
        );
        let round = of("build-round");
        assert!(round.contains_key("design") && round.contains_key("design_pose"));
        assert!(round["design"].get("additionalProperties").is_none(), "open");
    }
}
