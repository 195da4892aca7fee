//! `equipod singular motion`: the curves of poses with constant leg lengths, from a pose or from the lengths.

mod render;

use std::path::PathBuf;

use crate::app::cli::commands::fk::lengths::six;
use crate::app::cli::frames::FrameArgs;
use crate::app::cli::poses;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::plot::{MotionFigure, motion};
use ask::{Design, MotionStart, NoSelfMotion, SelfMotionOptions, SelfMotionReport};
use synthesis::singularity::{CurveEnd, MotionOptions};

/// Arguments of `singular motion`.
#[derive(Debug, clap::Args)]
pub(crate) struct SingularMotionArgs {
    /// Write the poses as a table
    #[arg(long, value_name = "FILE")]
    csv: Option<OutputPath>,
    /// Write an animated picture of the longest curve
    #[arg(long, value_name = "FILE")]
    svg: Option<OutputPath>,
    // the heading of its last options would hold for all options behind it
    #[command(flatten)]
    question: CurveQuestion,
}

/// The curves to trace.
#[derive(Debug, clap::Args)]
pub(crate) struct CurveQuestion {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Pose to start from: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Six lengths instead of a pose, design units, for all real components of their poses
    #[arg(long, value_name = "L1,..,L6", conflicts_with = "pose")]
    lengths: Option<String>,
    /// Number of random complex sections of all curves; 0: only curves connected to the pose
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(0..=100))]
    sections: u64,
    /// Largest rotation of the tangent between points, radians
    #[arg(long, value_name = "RAD", default_value_t = 0.05, value_parser = turn)]
    turn: f64,
    #[command(flatten)]
    frames: FrameArgs,
}

fn turn(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
    if (1e-3..=0.2).contains(&value) { Ok(value) } else { Err("give 0.001 to 0.2".to_string()) }
}

/// Traces the motion.
pub(crate) fn run(args: &SingularMotionArgs, context: &mut Context) -> Result<Answer, Failure> {
    let (design, found) = trace(&args.question, context)?;
    if let Some(path) = &args.csv {
        files::write_text(path, &render::csv(&found, &args.question.frames.of(&design)))?;
    }
    if let Some(path) = &args.svg {
        files::write_text(path, &picture(&design, &found)?)?;
    }
    Ok(render::answer(&design, &found, &found.degrees(&design, context.seed())))
}

/// Only the picture.
pub(in crate::app::cli::commands) fn drawing(
    question: &CurveQuestion,
    context: &mut Context,
) -> Result<String, Failure> {
    let (design, found) = trace(question, context)?;
    picture(&design, &found)
}

fn trace(args: &CurveQuestion, context: &mut Context) -> Result<(Design, SelfMotionReport), Failure> {
    let design = context.load(&args.design)?;
    let motion = MotionOptions { turn: args.turn, seed: context.seed(), ..MotionOptions::default() };
    let options =
        SelfMotionOptions::new(start(args, &design, context)?).sections(args.sections).motion(motion);
    let found = design.self_motions(&options).map_err(|why| failure(&why))?;
    Ok((design, found))
}

fn failure(why: &NoSelfMotion) -> Failure {
    let message = why.to_string();
    match why {
        NoSelfMotion::BeyondDoubles(_) => Failure::new(Exit::Inconclusive, "motion::beyond_doubles", message),
        NoSelfMotion::NoLengths => Failure::refused("motion::bad_pose", message),
        NoSelfMotion::NoStart => {
            Failure::refused("motion::no_start", message).with_help("give --pose, or --sections 1 or more")
        }
        _ => Failure::internal(message),
    }
}

/// The pose or the leg lengths.
fn start(args: &CurveQuestion, design: &Design, context: &Context) -> Result<MotionStart, Failure> {
    if let Some(text) = &args.lengths {
        let bad = |message: String| Failure::refused("motion::bad_lengths", format!("--lengths: {message}"));
        let lengths = six(text, &design.leg_offsets(), &design.units).map_err(bad)?;
        return Ok(MotionStart::Lengths(lengths.distances.squared()));
    }
    let frames = args.frames.of(design);
    poses::parse(&args.pose, &frames, ("--pose", "motion::bad_pose"), context).map(MotionStart::Pose)
}

/// The longest curve, animated.
fn picture(design: &Design, found: &SelfMotionReport) -> Result<String, Failure> {
    let Some(longest) = found.longest() else {
        return Err(Failure::new(Exit::No, "motion::no_curve", "there is no curve of poses to draw"));
    };
    let curve = &found.motion.curves[longest];
    let figure = MotionFigure {
        title: format!("Self-motion of {}", design.name),
        note: format!(
            "curve {} of {}, {} poses, {}; leg lengths constant to {:.1e} of the size",
            longest + 1,
            found.motion.curves.len(),
            curve.points.len(),
            curve.end.name(),
            found.motion.worst_length_error
        ),
        poses: curve.points.iter().map(|p| (p.arc, p.pose)).collect(),
        closed: curve.end == CurveEnd::Closed,
    };
    Ok(motion(design.manipulator(), &figure))
}
