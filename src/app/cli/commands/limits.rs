//! `equipod limits`: how far the platform may move from a pose, and the nearest allowed pose to one asked for.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::numbers::significant as short;
use crate::app::cli::output::Answer;
use crate::app::cli::poses;
use ask::RAYS;
use machine::reach::NearestPoseOptions;
use records::{
    FreeRangeRecord, FreeSizeRecord, LimitRecord, LimitsAnswer, NearestAllowedRecord, PoseQuaternionRecord,
    StraightWayRecord, WorkspaceSizeRecord,
};

/// Arguments of `limits`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json) with the table hardware or cranks, or `-` for standard input
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
    /// How large the workspace is around home: volume, largest ball and box of positions, turns, the required region
    #[arg(long)]
    workspace: bool,
    /// Number of directions in which the workspace is followed for its volume and its largest box
    #[arg(long, value_name = "N", default_value_t = RAYS as u32, value_parser = clap::value_parser!(u32).range(50..=1_000_000))]
    rays: u32,
}

const BAD_POSE: &str = "limits::bad_pose";

/// Exit 1 where the pose, or the one asked for with `--to`, is not allowed.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_ideal(&args.design)?;
    let at = poses::parse(&args.at, &design, "--at", BAD_POSE)?;
    let to = args.to.as_ref().map(|text| poses::parse(text, &design, "--to", BAD_POSE)).transpose()?;
    if !args.workspace {
        context.no_effect("rays", "the size of the workspace is not asked for (--workspace)")?;
    }
    // every pose has to have the sign of det J at home
    if let Some(home) = design.singular_at(&poses::home(&design)) {
        let help =
            "state a regular pose in [home]; `equipod singular poses` shows where the sign of det J changes";
        return Err(Failure::new(Exit::No, "limits::singular_home", home.to_string()).with_help(help));
    }
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
        workspace: args
            .workspace
            .then(|| design.workspace_size(args.rays as usize, context.seed()))
            .flatten()
            .map(|found| WorkspaceSizeRecord::new(&design, &found)),
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
    if let Some(found) = &answer.workspace {
        workspace(&mut out, found, &answer.length_unit);
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
    if answer.allowed && !found.straight_from_home {
        out.push_str("The straight way from home to it violates a limit.\n");
    }
}

fn size(found: &FreeSizeRecord, unit: &str) -> String {
    let proved = if found.proved > 0.0 {
        format!("{} {unit} proved", short(found.proved))
    } else {
        "nothing proved".to_owned()
    };
    let beyond = bound(found.binds.as_ref());
    format!("{proved}, {} {unit} without a violation found; beyond it {beyond} binds", short(found.searched))
}

fn workspace(out: &mut String, found: &WorkspaceSizeRecord, unit: &str) {
    let ends = found.ends.iter().map(|e| format!("{} {:.0} %", e.end, 100.0 * e.share));
    let ends = ends.collect::<Vec<_>>().join(", ");
    let half = |h: &[f64; 3]| h.iter().map(|x| format!("+-{}", short(*x))).collect::<Vec<_>>().join(" x ");
    let mut line = |name: &str, text: &str| {
        let _ = writeln!(out, "{name:<22} {text}");
    };
    line("\nAround home:", "");
    line(
        "volume of positions",
        &format!(
            "{} {unit}^3 on straight ways at the orientation of home (halves of {} ways differ by {:.1} %)",
            short(found.volume),
            found.rays,
            100.0 * found.volume_doubt
        ),
    );
    line("", &format!("they end at: {ends}"));
    line("largest ball, radius", &size(&found.ball_radius, unit));
    line(
        "largest box found",
        &format!(
            "{} {unit} proved, {} without a violation found; beyond it {} binds",
            half(&found.box_proved),
            half(&found.box_searched),
            bound(found.box_binds.as_ref())
        ),
    );
    for turn in &found.turns {
        line(
            &format!("turn about {}", turn.axis),
            &format!(
                "-{} deg ({}) to {} deg ({})",
                short(turn.back_deg),
                bound(turn.back_binds.as_ref()),
                short(turn.forth_deg),
                bound(turn.forth_binds.as_ref())
            ),
        );
    }
    line("tilt, any level axis", &size(&found.tilt_deg, "deg"));
    line("turn, any axis", &size(&found.turn_deg, "deg"));
    if let Some(required) = &found.required {
        let share = format!("its translations are {:.1} % of the volume above", 100.0 * required.share.0);
        line("required region", &format!("times {}", size(&required.factor, "").replace("  ", " ")));
        line("", &share);
    }
}
