//! `equipod check`: whether a design is architecturally singular, and why.

use std::path::PathBuf;

use super::pentapod;
use crate::app::cli::proof::ProofArgs;
use crate::app::cli::{Answer, Context, Exit, Failure};
use ::files::design::{Accepts, SixOrFive};
use records::{CheckAnswer, ProofFile};

/// Arguments of `check`.
#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Print the algebra too: ranks, dependencies, fields, counts
    #[arg(long)]
    details: bool,
    #[command(flatten)]
    proof: ProofArgs,
}

/// Decides and explains.
pub(crate) fn run(args: &CheckArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = match context.load_six_or_five(&args.design, Accepts::Legs)? {
        SixOrFive::Six(design) => design,
        SixOrFive::Five(five) => {
            context.no_effect("details", "the answer about five legs has no details")?;
            context.no_effect("proof", "it is for designs of six legs")?;
            return Ok(pentapod::check(&five, context));
        }
    };
    let found = design.check_with(context.seed()).map_err(|e| Failure::internal(e.to_string()))?;
    args.proof.write(context, || ProofFile::check(&found))?;
    let answer = CheckAnswer::from(&found);
    let exit = match answer.architecturally_singular {
        Some(false) if answer.singular_home.is_none() => Exit::Yes,
        Some(_) => Exit::No,
        None => Exit::Inconclusive,
    };
    if exit == Exit::Inconclusive || answer.pose_count.finite.is_none() {
        context.offer_symmetry(design.snapped_to_decide(context.seed()), &design.units);
    }
    let sheet = sheet::answers::check(&answer, args.details);
    Ok(Answer::new(exit, answer, sheet))
}
