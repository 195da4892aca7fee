//! `equipod assess`: the margins of a design's requirements.

use std::path::PathBuf;

use super::build::drives;
use crate::app::cli::frames::FrameArgs;
use crate::app::cli::progress::ProgressLine;
use crate::app::cli::proof::ProofArgs;
use crate::app::cli::{Answer, Context, Failure};
use ask::Error;
use machine::requirements::AssessOptions;
use records::{AssessAnswer, ProofFile};

/// Arguments of `assess`.
#[derive(Debug, clap::Args)]
pub(crate) struct AssessArgs {
    /// Design file (.toml or .json) with `[home]`, `[workspace]` and `[hardware]`
    design: PathBuf,
    /// Number of Halton points in the region of poses, and of random ones
    #[arg(long, value_name = "N", default_value_t = 5000, value_parser = clap::value_parser!(u32).range(0..=10_000_000))]
    points: u32,
    /// Number of steps between two poses of a trajectory, and from home to each end of a range
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    steps: u32,
    /// Number of local searches for each worst pose
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=1000))]
    searches: u32,
    /// Greatest number of workspace cells for each proof; default: 6000, and 60000 for undecided requirements
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=100_000_000))]
    cells: Option<u32>,
    #[command(flatten)]
    proof: ProofArgs,
}

/// Evaluates the requirements.
pub(crate) fn run(args: &AssessArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_with_cranks(&args.design)?;
    if Context::coupled_of(&design)?.is_some() && design.requirements().leaves_out_moving_legs() {
        let message = format!(
            "{}: `natural_frequency_hz` includes the masses of the legs, whose motion about joints that are not ideal (`offset`, `screw_lead`) is unknown",
            design.name
        );
        let help =
            "without `offset` and `screw_lead`, or without masses of the legs, the frequency is assessed";
        return Err(Failure::refused("design::not_ideal", message).with_help(help));
    }
    if design.workspace.trajectory.is_none() && design.workspace.ranged_coordinates() == 0 {
        context.no_effect("steps", "the workspace of the design has neither trajectory nor ranges")?;
    }
    let options = AssessOptions::new()
        .points(args.points as usize)
        .steps(args.steps as usize)
        .searches(args.searches as usize)
        .seed(context.seed());
    let mut progress = ProgressLine::new(context.quiet());
    let cells = args.cells.map(|n| n as usize);
    let found = design.assess_by(&options, cells, &mut |stage| progress.note(&stage.to_string()));
    progress.end();
    let found = found.map_err(|e| match e {
        Error::NothingRequired => {
            let help =
                "add [hardware] with leg lengths, joint angles, diameters or greatest forces; see docs/design-files.md";
            Failure::refused("assess::nothing_required", "the design has no requirements").with_help(help)
        }
        other => Failure::internal(other.to_string()),
    })?;
    if !FrameArgs::default().of(&design).convention.is_usual() {
        context.note("Worst poses are x,y,z of the platform origin with roll, pitch, yaw: write `base:` before them in other commands.");
    }
    args.proof.write(context, || ProofFile::assess(&design, &found))?;
    let lightest_drive = drives::lightest(&args.design, &design, context)?;
    let record = AssessAnswer { lightest_drive, ..AssessAnswer::new(&design, &found) };
    let text = sheet::answers::assess(&record);
    Ok(Answer::new(record.met.into(), record, text))
}
