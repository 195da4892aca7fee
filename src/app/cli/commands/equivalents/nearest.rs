//! `equipod equivalents nearest`: the octahedral platform nearest to a design.

use std::path::PathBuf;

use crate::app::cli::commands::optimize::check_extension;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ask::equivalents::NearestDesigns;
use ask::exploring::{NEAREST_EXTENSION, nearest_options};
use records::NearestAnswer;

/// Arguments of `equivalents nearest`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsNearestArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Greatest distance of a joint beyond its side, in side lengths
    #[arg(long, value_name = "X", default_value_t = NEAREST_EXTENSION)]
    extension: f64,
    /// Write the octahedral platform as a design
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    /// Write the platform equivalent to it near the design
    #[arg(long, value_name = "FILE")]
    beside: Option<OutputPath>,
}

/// Finds the platform, and writes the requested designs.
pub(crate) fn run(args: &EquivalentsNearestArgs, context: &mut Context) -> Result<Answer, Failure> {
    check_extension(args.extension)?;
    let design = context.load(&args.design)?;
    let options = nearest_options(&design, args.extension);
    let near = NearestDesigns::of(&design, &options);
    let mut answer = NearestAnswer::new(&design, &options, near.as_ref());
    if let Some(near) = &near {
        for (path, design) in [(&args.output, &near.octahedral), (&args.beside, &near.beside)] {
            if let Some(path) = path {
                files::write_design(path, design)?;
                answer.paths.push(path.display().to_string());
            }
        }
    }
    // a search without success proves nothing
    let exit = if answer.nearest.is_some() { Exit::Yes } else { Exit::Inconclusive };
    let sheet = sheet::answers::nearest(&answer);
    Ok(Answer::new(exit, answer, sheet))
}
