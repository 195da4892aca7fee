//! `equipod equivalents components`: the families of replaceable legs of a design.

use std::path::PathBuf;

use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::plot::component_curves;
use ask::{Design, NoPlanes, NoReplaceableLegs, ReplaceableLegs, ReplaceableOptions};
use records::ComponentsAnswer;
use synthesis::components::{ComponentOptions, ComponentsError};

/// Arguments of `equivalents components`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsComponentsArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Report only this family, counted from 1
    #[arg(long, value_name = "K")]
    family: Option<usize>,
    /// Number of random legs drawn from each family
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=10_000))]
    samples: u64,
    /// Write a picture of the curves in two planes, for all pairs of planes
    #[arg(long, value_name = "FILE")]
    svg: Option<OutputPath>,
    /// Draw only this pair of planes, from 1
    #[arg(long, value_name = "K", requires = "svg")]
    pair: Option<usize>,
    /// Threshold for zero, relative to the size of the body
    #[arg(long, value_name = "X", default_value_t = 1e-9)]
    tolerance: f64,
}

fn search(design: &Design, options: &ReplaceableOptions) -> Result<ReplaceableLegs, Failure> {
    design.replaceable_legs(options).map_err(|why| match why {
        NoReplaceableLegs::Search(ComponentsError::Tolerance(_)) => {
            Failure::refused("components::bad_tolerance", why.to_string())
        }
        NoReplaceableLegs::Family { .. } => Failure::refused("components::no_such_family", why.to_string()),
        _ => Failure::internal(why.to_string()),
    })
}

fn picture(design: &Design, found: &ReplaceableLegs, pair: Option<usize>) -> Result<String, Failure> {
    let curves = found.curves(design, pair.map(|k| k.wrapping_sub(1)));
    let failure = |why: NoPlanes| Failure::refused("components::no_planes", why.to_string());
    curves.map(|figure| component_curves(&figure)).map_err(failure)
}

/// The curves of a design, of all pairs of planes or of one, counted from 1.
pub(in crate::app::cli::commands) fn drawing(
    design: &Design,
    pair: Option<usize>,
    tolerance: f64,
    seed: u64,
) -> Result<String, Failure> {
    picture(design, &search(design, &ReplaceableOptions::all(ComponentOptions { tolerance, seed }))?, pair)
}

/// Lists the families.
pub(crate) fn run(args: &EquivalentsComponentsArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let search_options = ComponentOptions { tolerance: args.tolerance, seed: context.seed() };
    let options = ReplaceableOptions::all(search_options)
        .family(args.family.map(|k| k.wrapping_sub(1)))
        .samples(args.samples);
    let legs = search(&design, &options)?;
    if let Some(path) = &args.svg {
        let failure =
            |f: Failure| f.with_help("leave out --svg: the picture shows two planes with their curves");
        files::write_text(path, &picture(&design, &legs, args.pair).map_err(failure)?)?;
    }
    let answer = ComponentsAnswer::new(&design.name, &legs);
    let exit = if legs.found.doubts.is_empty() { Exit::Yes } else { Exit::Inconclusive };
    let sheet = sheet::answers::components(&answer);
    Ok(Answer::new(exit, answer, sheet))
}
