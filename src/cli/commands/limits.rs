//! `equipod limits`: how far the platform may move from a pose, and the nearest allowed pose to one asked for.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::numbers::significant as short;
use crate::cli::output::Answer;
use crate::cli::poses;
use crate::reach::NearestPoseOptions;
use crate::records::{
    FreeRangeRecord, LimitRecord, LimitsAnswer, NearestAllowedRecord, PoseQuaternionRecord, StraightWayRecord,
};

/// Arguments of `limits`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json) with the table hardware, or `-` for standard input
    design: PathBuf,
    /// The pose to move from: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    at: String,
    /// Also the straight way to this pose, and the allowed pose nearest to it
    #[arg(long, value_name = "POSE", allow_hyphen_values = true)]
    to: Option<String>,
    /// Number of further starts of the search for the nearest allowed pose, besides home
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=10_000))]
    starts: u32,
}

const BAD_POSE: &str = "limits::bad_pose";

/// Exit 1 where the pose, or the one asked for with `--to`, is not allowed.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let at = poses::parse(&args.at, &design, "--at", BAD_POSE)?;
    let to = args.to.as_ref().map(|text| poses::parse(text, &design, "--to", BAD_POSE)).transpose()?;
    let required = design.requirements();
    let reach = design.reach(&required);
    let violated = reach.violated(&at);
    let allowed = violated.is_empty();
    let asked = to.unwrap_or(at);
    let all = allowed && reach.allows(&asked);
    if all {
        context.no_effect("starts", "all poses asked for are allowed")?;
    }
    let options = NearestPoseOptions {
        starts: args.starts as usize,
        seed: context.seed(),
        ..NearestPoseOptions::default()
    };
    let nearest = if all { None } else { reach.nearest(&asked, &options) };
    let ranges = reach.free_ranges(&at);
    let answer = LimitsAnswer {
        pose: (&at).into(),
        allowed,
        violated: violated.iter().map(|(limit, margin)| LimitRecord::new(&design, *limit, *margin)).collect(),
        axes: ranges
            .iter()
            .flatten()
            .map(|range| FreeRangeRecord::new(&design, &reach, &at, range))
            .collect(),
        way: to.filter(|_| allowed).map(|to| StraightWayRecord::new(&design, &reach, &at, &to)),
        nearest_allowed: nearest.as_ref().map(|found| NearestAllowedRecord::new(&design, &reach, found)),
        length_unit: design.units.clone(),
    };
    let text = text(&design.name, &answer);
    Ok(Answer::new(if all { Exit::Yes } else { Exit::No }, answer, text))
}

fn text(name: &str, answer: &LimitsAnswer) -> String {
    let mut out = String::new();
    let at = answer.pose.short();
    // writing to a string cannot fail
    if answer.allowed {
        let _ = writeln!(out, "{name} may be at {at} and move from there, one number at a time:\n");
        let _ = writeln!(
            out,
            "{:<6} {:>12} {:>12} {:<32} {:>12} {:<32} unit",
            "axis", "value", "down to", "where binds", "up to", "where binds"
        );
        for row in &answer.axes {
            axis(&mut out, row);
        }
    } else {
        let _ = writeln!(out, "{name} may not be at {at}:");
        for limit in &answer.violated {
            let unit = limit.unit.as_deref().unwrap_or("of det J at home");
            let _ = writeln!(out, "  {} is missed by {} {unit}", named(limit), short(-limit.margin.0));
        }
    }
    if let Some(found) = &answer.way {
        way(&mut out, found);
    }
    if let Some(found) = &answer.nearest_allowed {
        nearest(&mut out, answer, found);
    } else if !answer.allowed {
        out.push_str("No allowed pose was found, home among those tried.\n");
    }
    out
}

/// The requirement and what it is about.
fn named(limit: &LimitRecord) -> String {
    if limit.between.is_empty() {
        limit.code().to_owned()
    } else {
        format!("{} ({})", limit.code(), limit.between.join(", "))
    }
}

fn bound(limit: Option<&LimitRecord>) -> String {
    limit.map_or_else(|| "nothing".to_owned(), named)
}

fn axis(out: &mut String, row: &FreeRangeRecord) {
    let _ = writeln!(
        out,
        "{:<6} {:>12} {:>12} {:<32} {:>12} {:<32} {}",
        row.axis.name(),
        short(row.value),
        short(row.back.value),
        bound(row.back.binds.as_ref()),
        short(row.forth.value),
        bound(row.forth.binds.as_ref()),
        row.unit
    );
}

fn way(out: &mut String, found: &StraightWayRecord) {
    let to = found.to.short();
    let _ = match &found.binds {
        None => writeln!(out, "\nThe straight way to {to} is free."),
        Some(limit) => writeln!(
            out,
            "\nThe straight way to {to} is free up to {} of it, at {}; there {} binds.",
            short(found.free),
            found.pose.short(),
            named(limit)
        ),
    };
}

fn nearest(out: &mut String, answer: &LimitsAnswer, found: &NearestAllowedRecord) {
    let binds = found.binds.iter().map(named).collect::<Vec<_>>().join(", ");
    let _ = writeln!(
        out,
        "\n{} is at {}, {} {} away (a radian counts as {} {}).\nThere bind: {binds}.",
        if found.stationary {
            "The nearest allowed pose, locally,"
        } else {
            "The nearest allowed pose found"
        },
        PoseQuaternionRecord::short(&found.pose),
        short(found.distance),
        answer.length_unit,
        short(found.characteristic_length),
        answer.length_unit
    );
    if !found.straight_from_home {
        out.push_str("The straight way from home to it violates a limit.\n");
    }
}
