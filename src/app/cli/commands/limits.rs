//! `equipod limits`: the free travel of the platform from a pose, and the allowed pose nearest to a given one.

use std::path::{Path, PathBuf};

use crate::app::cli::frames::FrameArgs;
use crate::app::cli::poses;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::export::{SurfaceFile, SurfaceFormat};
use ask::{Design, PoseFrames, RAYS};
use machine::reach::{NearestPoseOptions, ReachedSurface};
use machine::requirements::Limit;
use platform::geom::Pose;
use records::{
    FreeRangeRecord, LimitRecord, LimitsAnswer, NearestAllowedRecord, StraightPathRecord, WorkspaceSizeRecord,
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
    /// Add the size of the workspace around home
    #[arg(long)]
    workspace: bool,
    /// Number of directions for the volume and the box
    #[arg(long, value_name = "N", default_value_t = RAYS as u32, value_parser = clap::value_parser!(u32).range(50..=1_000_000))]
    rays: u32,
    /// Write the surface of the positions reached at this orientation: a mesh (.stl, .ply), or its corners with the
    /// limits that end the paths (.csv)
    #[arg(long, value_name = "FILE")]
    surface: Option<OutputPath>,
    /// Fineness of this surface: 10 4^N + 2 paths
    #[arg(long, value_name = "N", default_value_t = 4, requires = "surface", value_parser = clap::value_parser!(u32).range(0..=8))]
    level: u32,
    /// Print the table of a data sheet as Markdown: travel, speed, and force or torque of each coordinate
    #[arg(long, conflicts_with_all = ["to", "workspace", "surface"])]
    table: bool,
    #[command(flatten)]
    frames: FrameArgs,
}

const BAD_POSE: &str = "limits::bad_pose";

/// Exit 1 if the pose of `--at` or `--to` is not allowed.
pub(crate) fn run(args: &LimitsArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_ideal(&args.design)?;
    let frames = args.frames.of(&design);
    let at = poses::parse(&args.at, &frames, ("--at", BAD_POSE), context)?;
    let to =
        args.to.as_ref().map(|text| poses::parse(text, &frames, ("--to", BAD_POSE), context)).transpose()?;
    let surface = args.surface.as_ref().map(|path| surface_format(path)).transpose()?;
    if !args.workspace {
        context.no_effect("rays", "--workspace is not given")?;
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
        context.no_effect("starts", "all given poses are allowed")?;
    }
    let options = NearestPoseOptions::default().starts(args.starts as usize).seed(context.seed());
    let nearest = if all { None } else { reach.nearest(&asked, &options) };
    let answer = LimitsAnswer {
        frames: (&frames.convention).into(),
        pose: (&at).into(),
        in_frames: (&frames.write(&at)).into(),
        allowed,
        violated: violated.iter().map(|(limit, margin)| LimitRecord::new(&design, *limit, *margin)).collect(),
        axes: if allowed { FreeRangeRecord::all(&design, &reach, &at, &frames) } else { Vec::new() },
        straight_path: to
            .filter(|_| allowed)
            .map(|to| StraightPathRecord::new(&design, &reach, &frames, [&at, &to])),
        nearest_allowed: nearest
            .as_ref()
            .map(|found| NearestAllowedRecord::new(&design, &reach, &frames, found)),
        workspace: args
            .workspace
            .then(|| design.workspace_size(args.rays as usize, context.seed()))
            .flatten()
            .map(|found| WorkspaceSizeRecord::new(&design, &found)),
        surface: args.surface.as_ref().filter(|_| allowed).map(|path| path.display().to_string()),
        length_unit: design.units.clone(),
    };
    if let (Some(path), Some(format), true) = (&args.surface, surface, allowed) {
        let found = triangles((&design, &frames), &reach.surface(&at, args.level));
        files::write_text(path, &found.text(format))?;
    }
    let exit = if all { Exit::Yes } else { Exit::No };
    if args.table && allowed {
        let table = sheet::answers::data_sheet(&design.name, &answer).markdown_with(context.digits());
        return Ok(Answer::new(exit, answer, table));
    }
    let text = sheet::answers::limits(&design.name, &answer);
    Ok(Answer::new(exit, answer, text))
}

fn surface_format(path: &Path) -> Result<SurfaceFormat, Failure> {
    SurfaceFormat::of_path(path).map_err(|why| {
        Failure::refused("limits::bad_surface", format!("--surface: {why}"))
            .with_help("name the file .stl, .ply or .csv")
    })
}

/// The positions in the convention, with the requirement that ends the path to each.
fn triangles((design, frames): (&Design, &PoseFrames), found: &ReachedSurface) -> SurfaceFile {
    let rotation = found.from.rotation;
    let points = found.positions().map(|position| frames.write(&Pose { rotation, position }).position);
    let words = found.rays.iter().map(|ray| match ray.binding {
        Some(Limit::Term(term)) => term.kind.code(),
        Some(Limit::Singular) => "singularity",
        None => "nothing",
    });
    SurfaceFile {
        title: format!("positions that {} reaches ({})", design.name, design.units),
        units: design.units.clone(),
        points: points.collect(),
        words: words.map(str::to_owned).collect(),
        triangles: found.triangles.clone(),
    }
}
