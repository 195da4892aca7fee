//! `equipod singular locus`: the singular poses of a family of poses as the zeros of a polynomial.

use std::path::PathBuf;

use crate::app::cli::exact_pose;
use crate::app::cli::frames::{FrameArgs, note_frames};
use crate::app::cli::numbers;
use crate::app::cli::poses;
use crate::app::cli::{Answer, Context, Exit, Failure};
use num::surd::Surd;
use records::SingularLocusAnswer;
use synthesis::singularity::{PoseFamily, locus_polynomial};

/// Arguments of `singular locus`.
#[derive(Debug, clap::Args)]
pub(crate) struct SingularLocusArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Pose with the orientation: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`, with a quaternion
    /// of any norm; numbers may be expressions such as 1/3
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Direction of a line through the pose; positions on it have the unknown u
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, conflicts_with = "about")]
    along: Option<String>,
    /// Axis through the platform origin, for rotations about it; u is the tangent of half the angle over the axis
    /// length
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    about: Option<String>,
    #[command(flatten)]
    frames: FrameArgs,
}

/// Computes the polynomial. Exit 1: all poses of the family are singular.
pub(crate) fn run(args: &SingularLocusArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let frames = args.frames.of(&design);
    let pose = exact_pose::read(&args.pose, (&design, &frames), "--pose", "locus::bad_pose")?;
    note_frames(&frames, context);
    poses::note_order(&args.pose, &frames, "--pose", context);
    let family = match (&args.along, &args.about) {
        (Some(text), _) => PoseFamily::Line(direction(text, "--along")?),
        (None, Some(text)) => PoseFamily::Rotation(direction(text, "--about")?),
        (None, None) => PoseFamily::Positions,
    };
    let found = locus_polynomial(design.manipulator(), &pose, &family).ok_or_else(|| {
        let message =
            "the numbers of the pose and of the joints have too many different square roots together";
        Failure::refused("locus::too_many_roots", message)
            .with_help("give the orientation as a quaternion of fractions")
    })?;
    let record = SingularLocusAnswer::new([&design.name, &design.units], &pose, &family, &found);
    let exit = if found.degree.is_none() { Exit::No } else { Exit::Yes };
    let sheet = sheet::answers::singular_locus(&record);
    Ok(Answer::new(exit, record, sheet))
}

fn direction(text: &str, option: &str) -> Result<[Surd; 3], Failure> {
    let refuse = |message: String| Failure::refused("locus::bad_direction", format!("{option}: {message}"));
    let found: [Surd; 3] = numbers::exact(text).map_err(refuse)?;
    if found.iter().all(Surd::is_zero) {
        return Err(refuse("the direction is zero".to_owned()));
    }
    Ok(found)
}
