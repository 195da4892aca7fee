//! `equipod singular motion`: the curves of poses with constant leg lengths, from a pose or from the lengths.

mod render;

use std::path::PathBuf;

use crate::app::cli::commands::fk::lengths::six;
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::output::Answer;
use crate::app::cli::poses;
use ::files::plot::{MotionFigure, motion};
use ask::Design;
use fk::{FkOptions, FkRoot, ForwardKinematics, Homotopy, Reality, SolutionSet};
use platform::geom::{ComplexPose, Pose};
use platform::manipulator::{Manipulator, SquaredLegLengths};
use records::OriginWord;
use synthesis::singularity::{
    CriticalPoses, CurveDegree, CurveEnd, MotionOptions, SelfMotion, critical_poses, curve_degree,
    rounds_to_singular, self_motion,
};

/// Arguments of `singular motion`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    question: CurveQuestion,
    /// Write the poses as a table
    #[arg(long, value_name = "FILE")]
    csv: Option<OutputPath>,
    /// Write an animated picture of the longest curve
    #[arg(long, value_name = "FILE")]
    svg: Option<OutputPath>,
}

/// Which curves.
#[derive(Debug, clap::Args)]
pub(crate) struct CurveQuestion {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Pose to start from: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Six lengths instead of a pose: find all real components of the poses with these lengths
    #[arg(long, value_name = "L1,..,L6", conflicts_with = "pose")]
    lengths: Option<String>,
    /// Number of random sections by which all curves over the complex numbers are cut; 0 follows only what hangs together with the pose
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(0..=100))]
    sections: u64,
    /// Largest turn of the tangent from point to point, radians
    #[arg(long, value_name = "RAD", default_value_t = 0.05, value_parser = turn)]
    turn: f64,
}

fn turn(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
    if (1e-3..=0.2).contains(&value) { Ok(value) } else { Err("give 0.001 to 0.2".to_string()) }
}

/// What was found, for [`render`].
struct Found {
    /// The pose given.
    start: Option<Pose>,
    squares: SquaredLegLengths,
    /// Of the motion through the pose, or of the poses with the lengths, also where no real pose is on them; `None`
    /// undecided.
    dimension: Option<usize>,
    motion: SelfMotion,
    /// Of each curve.
    degrees: Vec<Option<CurveDegree>>,
    /// Of every starting pose.
    origins: Vec<OriginWord>,
    /// Real poses on surfaces and sets of higher dimension, which are not followed.
    real_poses: Vec<Pose>,
    critical: Option<CriticalPoses>,
    /// Whether, numerically, no real component is missing; `None` when no search was made.
    accounted: Option<bool>,
    exit: Exit,
}

/// Follows the motion.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let (design, found) = trace(&args.question, context)?;
    if let Some(path) = &args.csv {
        files::write_text(path, &render::csv(&found))?;
    }
    if let Some(path) = &args.svg {
        files::write_text(path, &picture(&design, &found)?)?;
    }
    Ok(render::answer(&design, &found))
}

/// The picture alone.
pub(in crate::app::cli::commands) fn drawing(
    question: &CurveQuestion,
    context: &mut Context,
) -> Result<String, Failure> {
    let (design, found) = trace(question, context)?;
    picture(&design, &found)
}

fn trace(args: &CurveQuestion, context: &mut Context) -> Result<(Design, Found), Failure> {
    let design = context.load(&args.design)?;
    let m = design.manipulator();
    if rounds_to_singular(m) {
        let message = format!(
            "{} is regular, proved about the exact joints, but their doubles are singular: curves are followed in doubles, and would be those of another design",
            design.name
        );
        return Err(Failure::new(Exit::Inconclusive, "motion::beyond_doubles", message));
    }
    let (start, squares) = beginning(args, &design)?;
    let options = MotionOptions { turn: args.turn, seed: context.seed(), ..MotionOptions::default() };
    let given: Vec<Pose> = start.into_iter().collect();
    let mut motion = self_motion(m, &squares, &given, &options);
    let mut starts: Vec<(Pose, OriginWord)> = given.iter().map(|p| (*p, OriginWord::Pose)).collect();
    let mut dimension = motion.dimension();
    let (mut critical, mut accounted) = (None, None);
    if start.is_none() && args.sections == 0 {
        let message =
            "--sections 0 leaves no pose to start from: with --lengths the curves are found by sections";
        return Err(
            Failure::refused("motion::no_start", message).with_help("give --pose, or --sections 1 or more")
        );
    }
    let searches = args.sections;
    if searches > 0 && (start.is_none() || dimension == Some(1)) {
        let sections = sections(m, &squares, searches, context.seed())?;
        dimension = if start.is_none() { Some(sections.dimension) } else { dimension };
        if sections.dimension == 1 {
            let real = sections.points.iter().filter(|r| r.reality == Reality::Real);
            starts.extend(real.map(|r| (r.pose.real_part(), OriginWord::Section)));
            let mut on: Vec<ComplexPose> = given.iter().map(|p| (*p).into()).collect();
            on.extend(sections.points.iter().map(|r| r.pose));
            let found = critical_poses(m, &squares, &on, context.seed());
            starts.extend(found.poses.iter().map(|p| (*p, OriginWord::CriticalPoint)));
            accounted = Some(found.is_accounted() && sections.established);
            critical = Some(found);
        } else {
            // surfaces are not followed: a real pose on each real component that was met has to do
            let real = sections.points.iter().filter(|r| r.reality == Reality::Real);
            starts.extend(real.map(|r| (r.pose.real_part(), OriginWord::Search)));
            // no search counts the components of a surface
            let counted = sections.dimension == 0 || start.is_some();
            accounted = counted.then_some(start.is_none() && sections.established);
        }
        let all: Vec<Pose> = starts.iter().map(|s| s.0).collect();
        motion = self_motion(m, &squares, &all, &options);
    }
    let degrees = motion.curves.iter().map(|c| {
        let best = c.points.iter().max_by(|x, y| x.gap.total_cmp(&y.gap))?;
        curve_degree(m, &squares, &best.pose, context.seed())
    });
    let degrees = degrees.collect();
    let whole = motion.curves.iter().all(|c| matches!(c.end, CurveEnd::Closed | CurveEnd::Joined));
    let followed = dimension != Some(1) || starts.is_empty() || motion.dimension() == Some(1);
    accounted = accounted.map(|a| a && whole && followed);
    let exit = match dimension {
        Some(0) if start.is_some() || accounted == Some(true) => Exit::No,
        Some(1) if whole && !motion.curves.is_empty() && accounted != Some(false) => Exit::Yes,
        Some(1) if start.is_none() && accounted == Some(true) => Exit::No,
        // it moves, over a surface or more
        Some(d) if d > 1 && !starts.is_empty() => Exit::Yes,
        _ => Exit::Inconclusive,
    };
    let origins = starts.iter().map(|s| s.1).collect();
    let real_poses = starts.iter().filter(|s| s.1 == OriginWord::Search).map(|s| s.0).collect();
    let found =
        Found { start, squares, dimension, motion, degrees, origins, real_poses, critical, accounted, exit };
    Ok((design, found))
}

/// The pose, if it is one, and the leg lengths.
fn beginning(args: &CurveQuestion, design: &Design) -> Result<(Option<Pose>, SquaredLegLengths), Failure> {
    if let Some(text) = &args.lengths {
        let bad = |message: String| Failure::refused("motion::bad_lengths", format!("--lengths: {message}"));
        let lengths = six(text, &design.leg_offsets()).map_err(bad)?;
        return Ok((None, lengths.distances.squared()));
    }
    let start = poses::parse(&args.pose, design, "--pose", "motion::bad_pose")?;
    let squares = start.squared_lengths(design.manipulator()).ok_or_else(|| {
        Failure::refused("motion::bad_pose", "the leg lengths at this pose are not finite positive numbers")
    })?;
    Ok((Some(start), squares))
}

/// Points on random sections of the poses with these lengths, over the complex numbers.
struct PoseSections {
    /// Of the set: 0 when it is empty or isolated poses only.
    dimension: usize,
    points: Vec<FkRoot>,
    /// The relation between the legs is proved, and all points of every section were found.
    established: bool,
}

fn sections(
    m: &Manipulator,
    s: &SquaredLegLengths,
    searches: u64,
    seed: u64,
) -> Result<PoseSections, Failure> {
    let mut out = PoseSections { dimension: 0, points: Vec::new(), established: true };
    for k in 0..searches {
        let options = FkOptions::new().seed(seed.wrapping_add(k));
        let found = Homotopy.solve(m, s, &options);
        let found = found.map_err(|e| Failure::internal(format!("looking for further poses: {e}")))?;
        if let SolutionSet::PositiveDimensional { witnesses, dimension, established } = &found.solution_set {
            out.dimension = out.dimension.max(*dimension);
            out.established &= established;
            out.points.extend(witnesses.iter().cloned());
        } else {
            out.established &= found.all_accounted();
        }
    }
    Ok(out)
}

/// The longest curve, animated.
fn picture(design: &Design, found: &Found) -> Result<String, Failure> {
    let length = |k: &usize| found.motion.curves[*k].points.last().map_or(0.0, |p| p.arc);
    let longest = (0..found.motion.curves.len()).max_by(|x, y| length(x).total_cmp(&length(y)));
    let Some(longest) = longest else {
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
