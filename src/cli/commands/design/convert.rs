//! `equipod design convert`: a design in the other notation.

use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files::{self, OutputPath};
use crate::cli::output::Answer;
use crate::design::Format;
use crate::records::ConvertAnswer;

/// Arguments of `design convert`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// File to write; .json gives JSON, .toml gives TOML
    #[arg(short, long, value_name = "FILE")]
    output: OutputPath,
}

/// Reads, checks and writes the design. Comments of the input are not kept.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let extension = args.output.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let Some(format) = extension.and_then(|e| match e.as_str() {
        "toml" => Some(Format::Toml),
        "json" => Some(Format::Json),
        _ => None,
    }) else {
        let message = format!("{}: the extension does not tell the format", args.output.display());
        return Err(
            Failure::refused("convert::unknown_format", message).with_help("end the name in .toml or .json")
        );
    };
    let design = context.load(&args.design)?;
    files::write_design(&args.output, &design)?;
    let output = args.output.display().to_string();
    let text = format!("wrote {output}\n");
    Ok(Answer::new(Exit::Yes, ConvertAnswer { name: design.name, output, format }, text))
}
