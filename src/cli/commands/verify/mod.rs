//! `equipod verify`: are two designs kinematically equivalent?

mod plan;
mod render;

use std::path::PathBuf;

use crate::cli::alignment::FrameArgs;
use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::Answer;
use crate::equivalence::{Verdict, VerifyError, verify};
use crate::fk::FkOptions;
use crate::synthesis::{LegMapTolerances, Relation, leg_map};

pub(crate) use plan::sample_plan;
pub(crate) use render::record;

/// Sample poses when `--samples` is not given.
pub(crate) const SAMPLES: usize = 10;

/// Arguments of `verify`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design A (.toml or .json); its home pose and workspace give the sample poses
    a: PathBuf,
    /// Design B, in the same units and, without --align, the same two frames
    b: PathBuf,
    /// Sets of leg lengths at which both are solved and compared
    #[arg(long, default_value_t = SAMPLES, value_name = "N", value_parser = at_least_one)]
    samples: usize,
    #[command(flatten)]
    frames: FrameArgs,
}

pub(super) fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if (1..=100_000).contains(&n) => Ok(n),
        _ => Err("a whole number from 1 to 100000".to_owned()),
    }
}

/// The leg map, forward kinematics of both at the samples, and the verdict.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let (a, b) = (context.load(&args.a)?, context.load(&args.b)?);
    if a.units != b.units {
        let message = format!("{} is in {}, {} is in {}", a.name, a.units, b.name, b.units);
        return Err(Failure::refused("verify::different_units", message)
            .with_help("write both designs in the same unit"));
    }
    let second = args.frames.apply(&a, &b, context.seed())?;
    if let Some(none) = second.refuted() {
        let map = leg_map(a.manipulator(), &second.manipulator, LegMapTolerances::default())
            .map_err(|e| failure_of(&e.into()))?;
        if map.relation == Relation::Unrelated {
            let exit = if none { Exit::No } else { Exit::Inconclusive };
            let mut json = render::unaligned(&map, none, &second.explanation().unwrap_or_default());
            second.put(&mut json);
            let verdict = render::unaligned_verdict(none);
            let text = format!("{} ~ {}: {verdict}\n{}", a.name, b.name, second.text());
            return Ok(Answer { exit, json, text });
        }
    }
    let plan = sample_plan(&a, args.samples, context.seed());
    let options = FkOptions { seed: context.seed(), ..FkOptions::default() };
    let found = verify(a.manipulator(), &second.manipulator, &plan, &options).map_err(|e| failure_of(&e))?;
    let mut json = record(&found, &plan);
    second.put(&mut json);
    let text = second.text() + &render::text(&found, &a.name, &b.name);
    Ok(Answer { exit: exit_of(&found.verdict), json, text })
}

/// What the verdict means for the exit code.
pub(crate) fn exit_of(verdict: &Verdict) -> Exit {
    match verdict {
        Verdict::Equivalent => Exit::Yes,
        Verdict::NotEquivalent(_) | Verdict::Singular => Exit::No,
        Verdict::Inconclusive(_) => Exit::Inconclusive,
    }
}

/// A verification that could not be carried out.
pub(crate) fn failure_of(error: &VerifyError) -> Failure {
    match error {
        VerifyError::Lengths { .. } => Failure::refused("verify::lengths", error.to_string())
            .with_help("give design A a [home] pose and a [workspace] that the platform can reach"),
        VerifyError::LegMap(_) | VerifyError::ForwardKinematics { .. } => {
            Failure::new(Exit::Inconclusive, "verify::breakdown", error.to_string())
                .with_help("try another --seed")
        }
    }
}
