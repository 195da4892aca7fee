//! `equipod equivalents components`: the families of replaceable legs of a design.

mod figure;

use std::path::PathBuf;

use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::output::Answer;
use ask::Design;
use num::Purpose;
use records::{ComponentRecord, ComponentsAnswer};
use synthesis::components::{
    Component, ComponentOptions, Components, ComponentsError, SampledLeg, components,
};

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
    /// Draw only this pair of planes: its number in the answer, counted from 1
    #[arg(long, value_name = "K", requires = "svg")]
    pair: Option<usize>,
    /// What counts as zero, relative to the size of the body
    #[arg(long, value_name = "X", default_value_t = 1e-9)]
    tolerance: f64,
}

fn search(design: &Design, options: ComponentOptions) -> Result<Components, Failure> {
    components(design.manipulator(), options).map_err(|e| match e {
        ComponentsError::Tolerance(_) => Failure::refused("components::bad_tolerance", e.to_string()),
        _ => Failure::internal(e.to_string()),
    })
}

fn picture(design: &Design, found: &Components, pair: Option<usize>, seed: u64) -> Result<String, Failure> {
    figure::picture(design, found, pair.map(|k| k.wrapping_sub(1)), seed)
        .ok_or_else(|| Failure::refused("components::no_planes", figure::refusal(found)))
}

/// The curves of a design, of all pairs of planes or of one, counted from 1.
pub(in crate::app::cli::commands) fn drawing(
    design: &Design,
    pair: Option<usize>,
    tolerance: f64,
    seed: u64,
) -> Result<String, Failure> {
    picture(design, &search(design, ComponentOptions { tolerance, seed })?, pair, seed)
}

/// Lists the families.
pub(crate) fn run(args: &EquivalentsComponentsArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let options = ComponentOptions { tolerance: args.tolerance, seed: context.seed() };
    let found = search(&design, options)?;
    let count = found.components.len();
    if let Some(k) = args.family.filter(|k| *k == 0 || *k > count) {
        let message = format!("{} has {count} families, there is no number {k}", design.name);
        return Err(Failure::refused("components::no_such_family", message));
    }
    if let Some(path) = &args.svg {
        let failure =
            |f: Failure| f.with_help("leave out --svg: the picture shows two planes with their curves");
        files::write_text(path, &picture(&design, &found, args.pair, context.seed()).map_err(failure)?)?;
    }
    let wanted: Vec<usize> =
        (0..count).filter(|k| args.family.is_none_or(|wanted| wanted == k + 1)).collect();
    let mut samples = Vec::new();
    for k in &wanted {
        samples.push(draw(&found, &found.components[*k], args.samples, context.seed(), *k)?);
    }
    let list = wanted.iter().zip(&samples);
    let list = list.map(|(k, s)| ComponentRecord::new(*k, &found.components[*k], s)).collect();
    let answer = ComponentsAnswer::new(&design.name, options.tolerance, &found, list);
    let exit = if found.doubts.is_empty() { Exit::Yes } else { Exit::Inconclusive };
    let sheet = sheet::answers::components(&answer);
    Ok(Answer::new(exit, answer, sheet))
}

/// Family `k` draws from a stream of its own: `--family` does not change what is drawn.
fn draw(
    found: &Components,
    component: &Component,
    count: u64,
    seed: u64,
    k: usize,
) -> Result<Vec<SampledLeg>, Failure> {
    let mut rng = Purpose::SAMPLED_LEGS.item(seed, k as u64);
    let mut out = Vec::new();
    for _ in 0..count {
        let leg = component.sample(&found.span, &mut rng);
        out.extend(leg.map_err(|e| Failure::internal(e.to_string()))?);
    }
    Ok(out)
}
