//! `equipod verify`: decides whether two designs are kinematically equivalent.

use std::path::PathBuf;

use crate::app::cli::alignment::{AlignmentArgs, same_units};
use crate::app::cli::proof::ProofArgs;
use crate::app::cli::{Answer, Context, Exit, Failure};
use ask::{SAMPLES, sample_plan};
use fk::FkOptions;
use records::{ProofFile, VerifyAnswer};
use synthesis::Relation;
use verify::{Verdict, VerifyError, verify_mapped};

/// Arguments of `verify`.
#[derive(Debug, clap::Args)]
pub(crate) struct VerifyArgs {
    /// Design file (.toml or .json); home and workspace give the sample poses
    a: PathBuf,
    /// Design file to compare with, in the same units and, without --align, the same frames
    b: PathBuf,
    /// Number of length sets at which both designs are solved
    #[arg(long, default_value_t = SAMPLES, value_name = "N", value_parser = at_least_one)]
    samples: usize,
    #[command(flatten)]
    frames: AlignmentArgs,
    #[command(flatten)]
    proof: ProofArgs,
}

pub(super) fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if (1..=100_000).contains(&n) => Ok(n),
        _ => Err("a whole number from 1 to 100000".to_owned()),
    }
}

/// The leg map, forward kinematics of both at the samples, and the verdict.
pub(crate) fn run(args: &VerifyArgs, context: &mut Context) -> Result<Answer, Failure> {
    let (a, b) = (context.load(&args.a)?, context.load(&args.b)?);
    same_units(&a, &b, "verify::different_units")?;
    let second = args.frames.apply(&a, &b, context)?;
    let map = second.compared(a.manipulator()).map_err(|e| failure_of(&e.into()))?;
    args.proof.write(context, || ProofFile::verify(&a, (&b, &second.manipulator), &map))?;
    if let Some(none) = second.refuted()
        && map.relation == Relation::Unrelated
    {
        let exit = if none { Exit::No } else { Exit::Inconclusive };
        let explanation = second.explanation().unwrap_or_default();
        let record = VerifyAnswer::unaligned(&map, none, explanation, second.record());
        let sheet = sheet::answers::verify(&record, &a.name, &b.name);
        return Ok(Answer::new(exit, record, sheet));
    }
    let plan = sample_plan(&a, args.samples, context.seed());
    let options = FkOptions::new().seed(context.seed());
    let found = verify_mapped(a.manipulator(), &second.manipulator, map, &plan, &options)
        .map_err(|e| failure_of(&e))?;
    let record = VerifyAnswer::new(&found, &plan, second.record());
    let sheet = sheet::answers::verify(&record, &a.name, &b.name);
    Ok(Answer::new(exit_of(&found.verdict), record, sheet))
}

/// The exit code of the verdict.
pub(crate) fn exit_of(verdict: &Verdict) -> Exit {
    match verdict {
        Verdict::Equivalent => Exit::Yes,
        Verdict::NotEquivalent(_) | Verdict::Singular => Exit::No,
        Verdict::Inconclusive(_) => Exit::Inconclusive,
    }
}

/// The failure for a verification that could not be computed.
pub(crate) fn failure_of(error: &VerifyError) -> Failure {
    match error {
        VerifyError::Lengths { .. } => Failure::refused("verify::lengths", error.to_string())
            .with_help("give design A a [home] pose and a [workspace] that the platform can reach"),
        VerifyError::Contradiction { .. } => Failure::internal(error.to_string()),
        _ => Failure::new(Exit::Inconclusive, "verify::breakdown", error.to_string())
            .with_help("try another --seed"),
    }
}
