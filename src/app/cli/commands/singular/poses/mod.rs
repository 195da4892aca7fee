//! `equipod singular poses`: det J at poses and over a slice, and a box of poses proved regular.

mod paths;
mod render;
pub(in crate::app::cli::commands) mod slice;

use std::path::PathBuf;

use crate::app::cli::frames::{FrameArgs, note_frames};
use crate::app::cli::freedoms::Freedoms;
use crate::app::cli::numbers;
use crate::app::cli::poses;
use crate::app::cli::{Answer, Context, Failure, OutputPath, files};
use ::files::plot::singular_slice;
use ask::{BOX_CELLS, NoSingularPoses, SignPath, SignsBetween, SingularPosesOptions, SingularPosesReport};
use platform::manipulator::LegLengths;
use synthesis::singularity::JoinOptions;

/// Arguments of `singular poses`.
#[derive(Debug, clap::Args)]
pub(crate) struct SingularPosesArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Pose in the centre: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Six lengths for the assembly modes, design units; default: from the pose
    #[arg(long, value_name = "L1,..,L6")]
    lengths: Option<String>,
    /// Shape of the box: half widths of positions (design units) and of the rotation vector (degrees); default: the
    /// workspace, or half the size and 30 degrees
    #[arg(long = "box", value_name = "X,Y,Z,RX,RY,RZ")]
    shape: Option<String>,
    /// Greatest number of cells for the proof
    #[arg(long, value_name = "N", default_value_t = BOX_CELLS)]
    cells: usize,
    /// Write a picture of the singular poses over two freedoms
    #[arg(long, value_name = "FILE")]
    svg: Option<OutputPath>,
    /// Two freedoms of that picture: x, y, z, or rx, ry, rz (rotation vector, base frame)
    #[arg(long, value_name = "A,B", default_value = "rx,rz", value_parser = Freedoms::parse, requires = "svg")]
    slice: Freedoms,
    /// Compute det J along the straight path between two assembly modes, by number; 0: the pose
    #[arg(long, value_name = "I,J")]
    path: Option<String>,
    /// Pose that the path passes through; repeat for several, in order
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, requires = "path")]
    via: Vec<String>,
    /// Write a table of det J along this path
    #[arg(long, value_name = "FILE", requires = "path")]
    csv: Option<OutputPath>,
    /// Write a picture of det J along this path
    #[arg(long, value_name = "FILE", requires = "path")]
    path_svg: Option<OutputPath>,
    /// Compute det J along straight paths between all assembly modes, and find modes joined by other regular paths
    #[arg(long)]
    between: bool,
    /// Number of random poses for such paths, for each sign of det J
    #[arg(long, value_name = "N", default_value_t = 1000, requires = "between")]
    samples: usize,
    #[command(flatten)]
    frames: FrameArgs,
}

/// The results, for [`render`].
struct SingularPoses {
    report: SingularPosesReport,
    /// Whether the region is the workspace of the design.
    of_the_design: bool,
    path: Option<SignPath>,
    between: Option<SignsBetween>,
}

/// Evaluates the poses, proves the box, draws the slice.
pub(crate) fn run(args: &SingularPosesArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let frames = args.frames.of(&design);
    let pose = poses::parse(&args.pose, &frames, ("--pose", "poses::bad_pose"), context)?;
    note_frames(&frames, context);
    let lengths = match &args.lengths {
        Some(text) => {
            let lengths = numbers::lengths(text, "six", &design.units)
                .map_err(|why| Failure::refused("poses::bad_numbers", format!("--lengths: {why}")))?;
            let lengths = LegLengths::try_new(lengths);
            Some(lengths.map_err(|e| Failure::refused("poses::bad_lengths", e.to_string()))?)
        }
        None => None,
    };
    let half_widths = args.shape.as_deref().map(half_widths).transpose()?;
    let seed = context.seed();
    let asked = SingularPosesOptions::about(pose)
        .lengths(lengths)
        .half_widths(half_widths)
        .cells(args.cells)
        .seed(seed);
    let report = design.singular_poses(&asked).map_err(|why| match why {
        NoSingularPoses::NoLengths => Failure::refused("poses::bad_pose", why.to_string()),
        _ => Failure::internal(why.to_string()),
    })?;
    if let Some(path) = &args.svg {
        let figure = slice::figure(&design, args.slice, &pose, &report.options);
        files::write_text(path, &singular_slice(&figure))?;
    }
    let path = paths::path(args, &design, &report, context)?;
    let joins = JoinOptions { samples: args.samples, seed };
    let between = args.between.then(|| report.between(&design, &joins));
    let found = SingularPoses { report, of_the_design: args.shape.is_none(), path, between };
    Ok(render::answer(&design, &found, &frames))
}

/// The help for `--box`.
const HALF_WIDTHS: &str =
    "give six half widths: three lengths, then three angles in degrees, for instance 50,50,50,10,10,10";

/// The half widths of `--box`.
fn half_widths(text: &str) -> Result<[[f64; 3]; 2], Failure> {
    let v: [f64; 6] = numbers::parse(text).ok_or_else(|| {
        Failure::refused("poses::bad_numbers", numbers::fault("--box", text, 6)).with_help(HALF_WIDTHS)
    })?;
    if v.iter().any(|x| *x < 0.0) || v.iter().all(|x| *x == 0.0) {
        let message = "--box has a negative half width, or all are zero";
        return Err(Failure::refused("poses::bad_numbers", message).with_help(HALF_WIDTHS));
    }
    Ok([[v[0], v[1], v[2]], [v[3], v[4], v[5]]])
}
