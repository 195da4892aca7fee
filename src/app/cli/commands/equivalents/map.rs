//! `equipod equivalents map`: the affine map between the squared leg lengths of two designs.

use std::path::PathBuf;

use crate::app::cli::alignment::{AlignmentArgs, same_units};
use crate::app::cli::commands::fk::lengths::six;
use crate::app::cli::{Answer, Context, Exit, Failure};
use ask::Design;
use num::Number;
use records::{MapAnswer, MappedLengthsRecord};
use synthesis::{LegCorrespondence, LegMapOutcome, Relation};

/// Arguments of `equivalents map`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsMapArgs {
    /// Design file (.toml or .json) with the given lengths
    from: PathBuf,
    /// Design file with the unknown lengths, in the same units and, without --align, the same frames
    to: PathBuf,
    /// Six lengths of FROM, design units, for those of TO at the same poses
    #[arg(long, value_name = "L1,..,L6")]
    lengths: Option<String>,
    #[command(flatten)]
    frames: AlignmentArgs,
}

/// Decides whether s(TO) = A s(FROM) + c holds at every pose.
pub(crate) fn run(args: &EquivalentsMapArgs, context: &mut Context) -> Result<Answer, Failure> {
    let (from, to) = (context.load(&args.from)?, context.load(&args.to)?);
    same_units(&from, &to, "map::different_units")?;
    let second = args.frames.apply(&from, &to, context)?;
    let outcome = second
        .compared(from.manipulator())
        .map_err(|e| Failure::new(Exit::Inconclusive, "map::breakdown", e.to_string()))?;
    let exit = match (outcome.relation, second.refuted()) {
        (Relation::Equivalent, _) => Exit::Yes,
        (Relation::Unrelated, Some(false)) | (Relation::Undecided, _) => Exit::Inconclusive,
        _ => Exit::No,
    };
    let legs = LegCorrespondence::between(from.manipulator(), &second.manipulator);
    let lengths = args.lengths.as_deref().map(|text| mapped(text, [&from, &to], &outcome)).transpose()?;
    let (map, correspondence) = ((&outcome).into(), (&legs).into());
    let record = MapAnswer { map, correspondence, lengths, frames: second.record() };
    let sheet = sheet::answers::map(&record, &from.name, &to.name);
    Ok(Answer::new(exit, record, sheet))
}

/// The shown lengths of the second design for these shown lengths of the first.
fn mapped(text: &str, designs: [&Design; 2], map: &LegMapOutcome) -> Result<MappedLengthsRecord, Failure> {
    let [shown, offsets] = designs.map(|d| d.leg_offsets());
    let given = six(text, &shown, &designs[0].units)
        .map_err(|message| Failure::refused("map::bad_lengths", format!("--lengths: {message}")))?;
    let taken = if map.is_regular_within_rounding() {
        let squares = map.closest.apply(&given.distances.squared()).map_err(|why| why.to_string());
        squares.and_then(|s| s.lengths().shown_with(&offsets).map_err(|why| why.to_string()))
    } else {
        Err("the designs have no regular map".to_owned())
    };
    let (to, reason) = match taken {
        Ok(lengths) => (Some(lengths.get().map(Number)), None),
        Err(why) => (None, Some(why)),
    };
    Ok(MappedLengthsRecord { from: given.shown.map(Number), to, reason })
}
