//! `equipod assess`: by how much a design meets its requirements.

use std::fmt::Write as _;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::{Answer, number};
use crate::cli::poses;
use crate::design::Design;
use crate::requirements::{AssessOptions, Assessment, Margin, Standing, assess};

/// Arguments of `assess`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json) with home, workspace and hardware
    design: PathBuf,
    /// Points of a Halton sequence in the region of poses, and as many random ones
    #[arg(long, value_name = "N", default_value_t = 5000, value_parser = clap::value_parser!(u32).range(0..=10_000_000))]
    points: u32,
    /// Steps between two poses of a trajectory
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    steps: u32,
    /// Local searches for the worst pose of each requirement
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=1000))]
    searches: u32,
}

/// Evaluates the requirements.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let home = poses::home(&design);
    let options = AssessOptions {
        points: args.points as usize,
        steps: args.steps as usize,
        searches: args.searches as usize,
        seed: context.seed(),
    };
    let found =
        assess(design.manipulator(), &design.requirements(), &design.workspace.space(&home), &options);
    if found.margins.is_empty() {
        let help =
            "add [hardware] with lengths, swing, diameters or greatest forces; see docs/design-files.md";
        return Err(
            Failure::refused("assess::nothing_required", "the design requires nothing").with_help(help)
        );
    }
    let exit = if found.all_met() { Exit::Yes } else { Exit::No };
    Ok(Answer { exit, json: record(&design, &found), text: text(&design, &found) })
}

/// The margins as JSON.
pub(super) fn margins(design: &Design, found: &Assessment) -> Value {
    let margin = |m: &Margin| {
        json!({
            "requirement": m.term.kind.code(), "margin": number(m.value), "met": m.standing.is_met(), "at_limit": m.standing == Standing::AtLimit,
            "unit": design.unit_of(m.term.kind.quantity()), "between": design.names_of(m.term), "pose": m.pose.as_ref().map(poses::record),
        })
    };
    found.margins.iter().map(margin).collect()
}

fn record(design: &Design, found: &Assessment) -> Map<String, Value> {
    let mut json = Map::new();
    json.insert("met".into(), json!(found.all_met()));
    json.insert("margins".into(), margins(design, found));
    json.insert("poses".into(), json!(found.poses));
    json
}

fn text(design: &Design, found: &Assessment) -> String {
    let word = if found.all_met() { "meets all its requirements" } else { "violates requirements" };
    let mut out = format!("{} {word} ({} poses looked at)\n\n", design.name, found.poses);
    let _ = writeln!(
        out,
        "{:<17} {:>14} {:<8} {:<24} worst pose x,y,z,qw,qx,qy,qz",
        "requirement", "least margin", "unit", "of"
    );
    for m in &found.margins {
        let pose = m.pose.as_ref().map_or_else(
            || "any".to_string(),
            |p| {
                let values = p.position.iter().copied().chain(p.quaternion());
                values.map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(",")
            },
        );
        let (mark, shown) = match m.standing {
            Standing::Met => (' ', m.value),
            Standing::AtLimit => ('=', 0.0),
            Standing::Violated => ('!', m.value),
        };
        let of = design.names_of(m.term).join(", ");
        let _ = writeln!(
            out,
            "{:<17}{mark}{:>14.6} {:<8} {of:<24} {pose}",
            m.term.kind.code(),
            shown,
            design.unit_of(m.term.kind.quantity())
        );
    }
    out.push_str("\nA margin below 0 is a violation (!); = at the limit, as far as rounding can tell, which is none. No violation found is no proof that there is none between the poses looked at.\n");
    out
}
