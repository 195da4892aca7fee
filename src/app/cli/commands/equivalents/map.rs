//! `equipod equivalents map`: the affine map between the squared leg lengths of two designs.

use std::path::PathBuf;

use crate::app::cli::alignment::{FrameArgs, same_units};
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::output::Answer;
use records::MapAnswer;
use synthesis::{LegCorrespondence, Relation};

/// Arguments of `equivalents map`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsMapArgs {
    /// Design file (.toml or .json) whose squared lengths are given
    from: PathBuf,
    /// Design file whose squared lengths are wanted, in the same units and, without --align, in the same two frames
    to: PathBuf,
    #[command(flatten)]
    frames: FrameArgs,
}

/// Decides whether s(TO) = A s(FROM) + c holds at every pose.
pub(crate) fn run(args: &EquivalentsMapArgs, context: &mut Context) -> Result<Answer, Failure> {
    let (from, to) = (context.load(&args.from)?, context.load(&args.to)?);
    same_units(&from, &to, "map::different_units")?;
    let second = args.frames.apply(&from, &to, context)?;
    let outcome = second
        .judged(from.manipulator())
        .map_err(|e| Failure::new(Exit::Inconclusive, "map::breakdown", e.to_string()))?;
    let exit = match (outcome.relation, second.refuted()) {
        (Relation::Equivalent, _) => Exit::Yes,
        (Relation::Unrelated, Some(false)) | (Relation::Undecided, _) => Exit::Inconclusive,
        _ => Exit::No,
    };
    let legs = LegCorrespondence::between(from.manipulator(), &second.manipulator);
    let record =
        MapAnswer { map: (&outcome).into(), correspondence: (&legs).into(), frames: second.record() };
    let sheet = sheet::answers::map(&record, &from.name, &to.name);
    Ok(Answer::new(exit, record, sheet))
}
