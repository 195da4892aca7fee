//! `equipod assess`: by how much a design meets its requirements.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::Answer;
use crate::entrance::Error;
use crate::records::{AssessAnswer, PoseQuaternionRecord, RegularityWord};
use crate::requirements::{AssessOptions, MarginVerdict};

/// Arguments of `assess`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json) with the tables home, workspace and hardware
    design: PathBuf,
    /// Number of poses of a Halton sequence in the region of poses, and as many random ones
    #[arg(long, value_name = "N", default_value_t = 5000, value_parser = clap::value_parser!(u32).range(0..=10_000_000))]
    points: u32,
    /// Number of steps between two poses of a trajectory
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    steps: u32,
    /// Number of local searches for the worst pose of each requirement
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=1000))]
    searches: u32,
    /// Greatest number of cells of the workspace over which the margins of one kind of requirement, and det J, are bounded for a proof
    #[arg(long, value_name = "N", default_value_t = 6000, value_parser = clap::value_parser!(u32).range(0..=100_000_000))]
    cells: u32,
}

/// Evaluates the requirements.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    if design.workspace.trajectory.is_none() {
        context.no_effect("steps", "the workspace of the design has no trajectory")?;
    }
    let options = AssessOptions::new()
        .points(args.points as usize)
        .steps(args.steps as usize)
        .searches(args.searches as usize)
        .seed(context.seed());
    let found = design.assess_with(&options, args.cells as usize).map_err(|e| match e {
        Error::NothingRequired => {
            let help =
                "add [hardware] with lengths, swing, diameters or greatest forces; see docs/design-files.md";
            Failure::refused("assess::nothing_required", "the design has no requirements").with_help(help)
        }
        other => Failure::internal(other.to_string()),
    })?;
    let record = AssessAnswer::new(&design, &found);
    let exit = match record.met {
        Some(true) => Exit::Yes,
        Some(false) => Exit::No,
        None => Exit::Inconclusive,
    };
    let text = text(&design.name, &record);
    Ok(Answer::new(exit, record, text))
}

fn text(name: &str, found: &AssessAnswer) -> String {
    let word = match found.met {
        Some(true) => "meets all its requirements, proved for every pose of its workspace",
        Some(false) => "violates requirements",
        None => "violates no requirement at the poses looked at; not all is proved",
    };
    let mut out = format!("{name} {word} ({} poses looked at)\n\n", found.poses);
    let _ = writeln!(
        out,
        "{:<17} {:<9} {:>14} {:>14} {:<8} {:<24} worst pose x,y,z,qw,qx,qy,qz",
        "requirement", "status", "least margin", "proved margin", "unit", "of"
    );
    for m in &found.requirements {
        let pose = m.pose.as_ref().map_or_else(|| "any".to_string(), PoseQuaternionRecord::short);
        let (mark, value) = match () {
            () if m.at_limit => ('=', 0.0),
            () if m.violates() => ('!', m.margin.0),
            () => (' ', m.margin.0),
        };
        let below = match m.proved_margin.0 {
            x if m.status == MarginVerdict::AtLimit || x == 0.0 => format!("{:.6}", 0.0),
            x if x.is_finite() => format!("{x:.6}"),
            _ => "none".into(),
        };
        let _ = writeln!(
            out,
            "{:<17}{mark}{:<9} {value:>14.6} {below:>14} {:<8} {:<24} {pose}",
            m.name.code(),
            m.status.name(),
            m.unit,
            m.between.join(", ")
        );
    }
    // rows without a margin: the sign of det J, and a number that has no limit
    let mut row = |name: &str, mark: char, status: &str, [value, unit, of]: [&str; 3], pose: &str| {
        let _ =
            writeln!(out, "{name:<17}{mark}{status:<9} {value:>14} {:>14} {unit:<8} {of:<24} {pose}", "-");
    };
    let at = found.regular.pose.as_ref().map_or_else(|| "any".to_owned(), PoseQuaternionRecord::short);
    let (mark, status) = match found.regular.status {
        RegularityWord::Proved => (' ', "met"),
        RegularityWord::ChangesSign => ('!', "violated"),
        RegularityWord::Undecided => (' ', "undecided"),
    };
    row("singularity", mark, status, ["-", "", "sign of det J"], &at);
    let c = &found.conditioning;
    let value = format!("{:.6}", c.inverse_condition.0);
    row("conditioning", ' ', "no limit", [&value, "", "least found, 1 at best"], &c.pose.short());
    let _ = match found.regular.status {
        RegularityWord::Proved => writeln!(out, "\nNo singular pose in the workspace: proved."),
        RegularityWord::ChangesSign => {
            writeln!(out, "\nThe workspace holds a singular pose: det J changes its sign on the way to {at}.")
        }
        RegularityWord::Undecided => {
            writeln!(out, "\nNot proved to be free of singular poses; undecided near {at}.")
        }
    };
    out.push_str("A margin below 0 is a violation (!); = at the limit, as far as rounding can tell, which is none. The proved margin is one that no pose of the workspace falls below.\n");
    if found.met.is_none() {
        out.push_str(
            "What is only searched may be violated between the poses looked at; more --cells may prove it.\n",
        );
    }
    out
}
