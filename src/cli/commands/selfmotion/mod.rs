//! `equipod selfmotion`: the curves of poses with constant leg lengths through a pose.

mod render;

use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::cli::output::Answer;
use crate::cli::poses;
use crate::design::Design;
use crate::fk::{FkOptions, FkRoot, ForwardKinematics, Homotopy, Reality, SolutionSet};
use crate::geom::Pose;
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::plot::{MotionFigure, motion};
use crate::singularity::{CurveDegree, CurveEnd, MotionOptions, SelfMotion, curve_degree, self_motion};

/// Arguments of `selfmotion`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The design (.toml or .json)
    design: PathBuf,
    /// The pose to start from: `home`, six numbers (position, then roll, pitch, yaw in degrees) or seven (position,
    /// then quaternion, scalar first)
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Times to look for poses on further curves: forward kinematics with random sections, real ends only
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u64).range(0..=100))]
    searches: u64,
    /// Largest turn of the tangent from point to point, radians
    #[arg(long, value_name = "RAD", default_value_t = 0.05, value_parser = turn)]
    turn: f64,
    /// Write the poses as a table
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write an animated picture of the longest curve
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

fn turn(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
    if (1e-3..=0.2).contains(&value) { Ok(value) } else { Err("give 0.001 to 0.2".to_string()) }
}

/// What was found, for [`render`].
struct Found {
    start: Pose,
    squares: SquaredLegLengths,
    motion: SelfMotion,
    /// Of each curve.
    degrees: Vec<Option<CurveDegree>>,
    /// Real poses found by the searches.
    further: usize,
    exit: Exit,
}

/// Follows the motion.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let m = design.manipulator();
    let start = poses::parse(&args.pose, &design, "--pose", "selfmotion::bad_pose")?;
    let squares = start.squared_lengths(m).ok_or_else(|| {
        Failure::refused(
            "selfmotion::bad_pose",
            "the leg lengths at this pose are no finite positive numbers",
        )
    })?;
    let options = MotionOptions { turn: args.turn, seed: context.seed(), ..MotionOptions::default() };
    let mut motion = self_motion(m, &squares, &[start], &options);
    let mut further = 0;
    if motion.dimension == 1 && args.searches > 0 {
        let mut starts = vec![start];
        starts.extend(searched(m, &squares, args.searches, context.seed())?);
        further = starts.len() - 1;
        motion = self_motion(m, &squares, &starts, &options);
    }
    let degrees = motion.curves.iter().map(|c| {
        let best = c.points.iter().max_by(|x, y| x.gap.total_cmp(&y.gap))?;
        curve_degree(m, &squares, &best.pose, context.seed())
    });
    let degrees = degrees.collect();
    let whole = |end: CurveEnd| matches!(end, CurveEnd::Closed | CurveEnd::Joined);
    let exit = match motion.dimension {
        0 => Exit::No,
        1 if motion.curves.iter().all(|c| whole(c.end)) && !motion.curves.is_empty() => Exit::Yes,
        _ => Exit::Inconclusive,
    };
    let found = Found { start, squares, motion, degrees, further, exit };
    write_files(args, &design, &found)?;
    Ok(render::answer(&design, &found))
}

/// Real poses with these lengths on curves, from random sections.
fn searched(m: &Manipulator, s: &SquaredLegLengths, searches: u64, seed: u64) -> Result<Vec<Pose>, Failure> {
    let mut out = Vec::new();
    for k in 0..searches {
        let options = FkOptions { seed: seed.wrapping_add(k), ..FkOptions::default() };
        let found = Homotopy.solve(m, s, &options);
        let found = found.map_err(|e| Failure::internal(format!("looking for further poses: {e}")))?;
        if let SolutionSet::PositiveDimensional { witnesses, .. } = &found.solution_set {
            let real = |r: &&FkRoot| r.reality == Reality::Real;
            out.extend(witnesses.iter().filter(real).map(|r| r.pose.real_part()));
        }
    }
    Ok(out)
}

fn write_files(args: &Args, design: &Design, found: &Found) -> Result<(), Failure> {
    if let Some(path) = &args.csv {
        files::write_text(path, &render::csv(found))?;
    }
    let Some(path) = &args.svg else { return Ok(()) };
    let length = |k: &usize| found.motion.curves[*k].points.last().map_or(0.0, |p| p.arc);
    let longest = (0..found.motion.curves.len()).max_by(|x, y| length(x).total_cmp(&length(y)));
    let Some(longest) = longest else {
        return Err(Failure::new(Exit::No, "selfmotion::no_curve", "there is no curve of poses to draw"));
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
    files::write_text(path, &motion(design.manipulator(), &figure))
}
