//! `equipod at`: forces, small motions and stiffness at one pose.

use std::path::PathBuf;

use nalgebra::Vector3;

use crate::app::cli::frames::FrameArgs;
use crate::app::cli::{Answer, Context, Exit, Failure};
use crate::app::cli::{numbers, poses};
use ask::AtPoseOptions;
use platform::manipulator::Body;
use records::AtPoseAnswer;

/// Arguments of `at`.
#[derive(Debug, clap::Args)]
pub(crate) struct AtArgs {
    /// Design file (.toml or .json), or `-` for standard input
    design: PathBuf,
    /// The pose
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Point that wrenches, shifts and stiffness are about, platform frame; default: the pivot
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    point: Option<String>,
    /// Body whose axes vectors have: `base` or `platform`
    #[arg(long, value_name = "BODY", default_value = "base", value_parser = body)]
    axes: Body,
    /// Force and torque on the platform about the point, to be held by the legs
    #[arg(long, value_name = "FX,FY,FZ,TX,TY,TZ", allow_hyphen_values = true)]
    wrench: Option<String>,
    /// Forces of the legs (positive: push), or torques of the cranks: compute the wrench that they hold
    #[arg(long, value_name = "F1,..,F6", allow_hyphen_values = true)]
    forces: Option<String>,
    /// Step of the drives for the resolution: design units of legs, degrees of cranks
    #[arg(long, value_name = "STEP", default_value_t = 1.0, allow_hyphen_values = true)]
    step: f64,
    /// Leg that is stuck, or alone free, from 1
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=6))]
    leg: Option<u8>,
    /// Find the nearest singular pose
    #[arg(long)]
    nearest_singular: bool,
    /// Number of random directions of this search, beside the axes
    #[arg(long, value_name = "N", default_value_t = 200, requires = "nearest_singular", value_parser = clap::value_parser!(u32).range(0..=100_000))]
    directions: u32,
    #[command(flatten)]
    frames: FrameArgs,
}

fn body(word: &str) -> Result<Body, String> {
    let found = Body::BOTH.into_iter().find(|body| body.name() == word);
    found.ok_or_else(|| "write `base` or `platform`".to_owned())
}

/// Exit 1 where the drives do not hold the platform at the pose.
pub(crate) fn run(args: &AtArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_ideal(&args.design)?;
    let frames = args.frames.of(&design);
    let pose = poses::parse(&args.pose, &frames, ("--pose", "at::bad_pose"), context)?;
    let point = match &args.point {
        None => frames.convention.pivot_on_platform(),
        Some(text) => frames.convention.axes() * Vector3::from(given::<3>(text, "--point", "X,Y,Z")?),
    };
    if !(args.step > 0.0 && args.step.is_finite()) {
        return Err(Failure::refused("at::bad_numbers", "--step is not a positive number"));
    }
    let six = |text: &Option<String>, option: &str, form: &str| -> Result<Option<[f64; 6]>, Failure> {
        text.as_deref().map(|text| given(text, option, form)).transpose()
    };
    let asked = AtPoseOptions::at(pose)
        .point(point)
        .axes(args.axes)
        .wrench(six(&args.wrench, "--wrench", "FX,FY,FZ,TX,TY,TZ")?)
        .efforts(six(&args.forces, "--forces", "F1,..,F6")?)
        .leg(args.leg.map(|leg| usize::from(leg) - 1))
        .directions(args.nearest_singular.then_some(args.directions as usize))
        .seed(if args.nearest_singular { context.seed() } else { 0 });
    let found = design
        .at_pose(&frames, &asked)
        .map_err(|why| Failure::refused("at::not_computed", why.to_string()))?;
    let answer = AtPoseAnswer::new(&design, &frames, (&asked, args.step), &found);
    let exit = if answer.is_held() { Exit::Yes } else { Exit::No };
    let text = sheet::answers::at_pose(&answer);
    Ok(Answer::new(exit, answer, text))
}

/// The numbers of an option of this form.
fn given<const N: usize>(text: &str, option: &str, form: &str) -> Result<[f64; N], Failure> {
    numbers::parse(text).ok_or_else(|| {
        Failure::refused("at::bad_numbers", numbers::fault(option, text, N))
            .with_help(format!("give {N} numbers separated by commas: {form}"))
    })
}
