//! `equipod presets`: designs of real hardware that come with the program.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files::{self, OutputPath};
use crate::cli::output::Answer;
use crate::design::{Design, Format, PRESETS, Preset, parse};

/// Arguments of `presets`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Name of a preset; without it all are listed
    name: Option<String>,
    /// Write the design file, TOML with the sources in its comments
    #[arg(short, long, value_name = "OUT", requires = "name")]
    output: Option<OutputPath>,
}

/// Lists the presets, or gives one.
pub(crate) fn run(args: &Args, _: &mut Context) -> Result<Answer, Failure> {
    let Some(name) = &args.name else { return list() };
    let names = PRESETS.map(|p| p.name).join(", ");
    let preset = PRESETS.iter().find(|p| p.name == name).ok_or_else(|| {
        Failure::refused("presets::unknown", format!("there is no preset `{name}`"))
            .with_help(format!("one of: {names}"))
    })?;
    let mut json = record(preset)?;
    let mut text = preset.text.to_string();
    if let Some(path) = &args.output {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        if !extension.eq_ignore_ascii_case("toml") {
            let message = format!("{}: presets are written as TOML, with their comments", path.display());
            return Err(Failure::refused("presets::unknown_format", message)
                .with_help("end the name in .toml; `equipod convert` makes JSON of it"));
        }
        files::write_text(path, preset.text)?;
        json.insert("output".into(), json!(path.display().to_string()));
        text = format!("wrote {}\n", path.display());
    } else {
        json.insert("text".into(), json!(preset.text));
    }
    Ok(Answer::new(Exit::Yes, json, text))
}

fn list() -> Result<Answer, Failure> {
    let mut json = Map::new();
    let mut text = String::new();
    let records = PRESETS.iter().map(record).collect::<Result<Vec<_>, _>>()?;
    for record in &records {
        let field = |key: &str| record.get(key).and_then(Value::as_str).unwrap_or_default();
        let _ = writeln!(text, "{:<24} {:<22} {}", field("preset"), field("class"), field("name"));
        let _ = writeln!(text, "{:<24} {}", "", field("source"));
    }
    json.insert("presets".into(), records.into_iter().map(Value::Object).collect());
    text.push_str("\n`equipod presets NAME -o FILE.toml` writes one, with the source of every figure in its comments.\n");
    Ok(Answer::new(Exit::Yes, json, text))
}

fn record(preset: &Preset) -> Result<Map<String, Value>, Failure> {
    let design = design(preset)?;
    let mut json = Map::new();
    json.insert("preset".into(), json!(preset.name));
    json.insert("class".into(), json!(preset.class.as_str()));
    json.insert("name".into(), json!(design.name));
    json.insert("units".into(), json!(design.units));
    json.insert("source".into(), json!(design.source));
    json.insert("description".into(), json!(design.description));
    Ok(json)
}

fn design(preset: &Preset) -> Result<Design, Failure> {
    let unread = |_| Failure::internal(format!("the preset {} is not a design", preset.name));
    parse(preset.text, Format::Toml).map(|(design, _)| design).map_err(unread)
}
