//! `equipod design presets`: designs of real hardware that come with the program.

use std::fmt::Write as _;

use crate::app::cli::{Answer, Exit, Failure, OutputPath, files};
use crate::app::presets::PRESETS;
use ::files::design::Format;
use ask::Design;
use ask::design::parse_with_cranks;
use ask::presets::Preset;
use records::{PresetAnswer, PresetFile, PresetRecord, PresetsAnswer};

/// Arguments of `design presets`.
#[derive(Debug, clap::Args)]
pub(crate) struct DesignPresetsArgs {
    /// Name of a preset; without it all are listed
    name: Option<String>,
    /// Write the design file in TOML, with the sources in its comments
    #[arg(short, long, value_name = "FILE", requires = "name")]
    output: Option<OutputPath>,
}

/// Lists the presets, or gives one.
pub(crate) fn run(args: &DesignPresetsArgs) -> Result<Answer, Failure> {
    let Some(name) = &args.name else { return list() };
    let names = PRESETS.map(|p| p.name).join(", ");
    let preset = PRESETS.iter().find(|p| p.name == name).ok_or_else(|| {
        Failure::refused("presets::unknown", format!("there is no preset `{name}`"))
            .with_help(format!("one of: {names}"))
    })?;
    let record = record(preset)?;
    let (file, text) = if let Some(path) = &args.output {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        if !extension.eq_ignore_ascii_case("toml") && !files::is_standard(path) {
            let message = format!("{}: presets are written as TOML, with their comments", path.display());
            return Err(Failure::refused("presets::unknown_format", message)
                .with_help("end the name in .toml; `equipod design convert` makes JSON of it"));
        }
        files::write_text(path, preset.text)?;
        let output = path.display().to_string();
        let text = format!("wrote {output}\n");
        (PresetFile::Written { output }, text)
    } else {
        (PresetFile::Given { text: preset.text.into() }, preset.text.into())
    };
    Ok(Answer::new(Exit::Yes, PresetsAnswer::One(PresetAnswer { preset: record, file }), text))
}

fn list() -> Result<Answer, Failure> {
    let mut text = String::new();
    let presets = PRESETS.iter().map(record).collect::<Result<Vec<_>, _>>()?;
    for p in &presets {
        let _ = writeln!(text, "{:<24} {:<22} {}", p.preset, p.class.name(), p.name);
        let _ = writeln!(text, "{:<24} {}", "", p.source.as_deref().unwrap_or_default());
    }
    text.push_str("\n`equipod design presets NAME -o FILE.toml` writes one, with the source of every figure in its comments.\n");
    Ok(Answer::new(Exit::Yes, PresetsAnswer::List { presets }, text))
}

fn record(preset: &Preset) -> Result<PresetRecord, Failure> {
    Ok(PresetRecord::new(preset, &design(preset)?))
}

fn design(preset: &Preset) -> Result<Design, Failure> {
    let unread = |_| Failure::internal(format!("the preset {} is not a design", preset.name));
    parse_with_cranks(preset.text, Format::Toml).map(|(design, _)| design).map_err(unread)
}
