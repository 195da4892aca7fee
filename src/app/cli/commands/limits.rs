//! `equipod limits`: the free travel of the platform from a pose, and the allowed pose nearest to a given one.

use std::path::PathBuf;

use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::output::Answer;
use crate::app::cli::poses;
use ask::RAYS;
use machine::reach::NearestPoseOptions;
use records::{
    FreeRangeRecord, LimitRecord, LimitsAnswer, NearestAllowedRecord, StraightWayRecord, WorkspaceSizeRecord,
};

/// Arguments of `limits`.
#[derive(Debug, clap::Args)]
pub(crate) struct LimitsArgs {
    /// Design file (.toml or .json) with the table hardware or cranks, or `-` for standard input
    design: PathBuf,
    /// Pose to move from: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    at: String,
    /// Add the straight path to this pose, and the allowed pose nearest to it
    #[arg(long, value_name = "POSE", allow_hyphen_values = true)]
    to: Option<String>,
    /// Number of starts beside home in the search for the nearest allowed pose
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=10_000))]
    starts: u32,
    /// Add the size of the workspace around home: volume, largest ball and box of positions, rotations, the required
    /// region
    #[arg(long)]
    workspace: bool,
    /// Number of directions for the volume and the largest box of the workspace
    #[arg(long, value_name = "N", default_value_t = RAYS as u32, value_parser = clap::value_parser!(u32).range(50..=1_000_000))]
    rays: u32,
}

const BAD_POSE: &str = "limits::bad_pose";

/// Exit 1 if the pose of `--at` or `--to` is not allowed.
pub(crate) fn run(args: &LimitsArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_ideal(&args.design)?;
    let at = poses::parse(&args.at, &design, "--at", BAD_POSE)?;
    let to = args.to.as_ref().map(|text| poses::parse(text, &design, "--to", BAD_POSE)).transpose()?;
    if !args.workspace {
        context.no_effect("rays", "the size of the workspace is not asked for (--workspace)")?;
    }
    // every allowed pose has the sign of det J at home
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
    let text = sheet::answers::limits(&design.name, &answer);
    Ok(Answer::new(if all { Exit::Yes } else { Exit::No }, answer, text))
}
