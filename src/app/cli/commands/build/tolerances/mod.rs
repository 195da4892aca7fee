//! `equipod build tolerances`: the joint errors allowed.

mod render;

use std::path::PathBuf;

use nalgebra::Point3;

use crate::app::cli::numbers::{lengths, one};
use crate::app::cli::poses;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ask::Design;
use machine::manufacture::{
    Budget, ErrorAtPose, ErrorBound, JointErrors, MachineErrors, MachineUncertainty, PoseSearch,
    ToleranceError, Trials, budget, error_map, solved_error, trials,
};
use machine::requirements::PoseSpace;
use platform::geom::Pose;
use platform::manipulator::Manipulator;
use records::PoseDeviations;

/// Arguments of `build tolerances`.
#[derive(Debug, clap::Args)]
pub(crate) struct BuildTolerancesArgs {
    /// Design file (.toml or .json); its home pose and workspace give the poses
    design: PathBuf,
    /// Allowed error: tool point, design units, and orientation, degrees
    #[arg(long, value_name = "LENGTH,DEG", allow_hyphen_values = true)]
    bound: String,
    /// Tool point, design units, platform frame
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    tool: String,
    /// Number of Halton points in the region of poses, and of random ones
    #[arg(long, value_name = "N", default_value_t = 300, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    points: u32,
    /// Number of local searches for every worst pose
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=1000))]
    searches: u32,
    /// Number of random joint errors and poses to solve
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = clap::value_parser!(u32).range(0..=10_000_000))]
    trials: u32,
    /// Add the uncertainty of computed poses from `[calibration]`, and random errors with its covariance
    #[arg(long)]
    calibrated: bool,
    /// Greatest joint error for the error map, design units; default: the radius that keeps the bound
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    joint_error: Option<f64>,
    /// Greatest error of a shown leg length, design units: homing, backlash, pitch of the screw
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    length_error: Option<f64>,
    /// Relative thermal expansion of base, platform and legs
    #[arg(long, value_name = "BASE,PLATFORM,LEGS", allow_hyphen_values = true)]
    growth: Option<String>,
    /// Write a table of the greatest errors at all poses
    #[arg(long, value_name = "FILE")]
    map: Option<OutputPath>,
}

/// The complete result.
#[derive(Debug)]
pub(super) struct ToleranceReports {
    pub(super) bound: ErrorBound,
    pub(super) tool: Point3<f64>,
    pub(super) budget: Budget,
    /// Random errors within the radius that all joints may have.
    pub(super) trials: Trials,
    /// Random errors with the deviations of a calibration, if requested.
    pub(super) calibrated: Option<Trials>,
    /// The uncertainty of computed poses by the calibration, at each pose evaluated.
    pub(super) computed: Option<Vec<PoseDeviations>>,
    /// The greatest errors by all causes, if requested.
    pub(super) map: Option<(MachineErrors, Vec<ErrorAtPose>)>,
    /// Solved errors (length, degrees) for the worst joint errors of the radius, and of 1.5 times the radius.
    pub(super) worst: [Option<(f64, f64)>; 2],
    /// The exact check of the first-order radius.
    pub(super) solved: Solved,
    pub(super) workspace_given: bool,
}

/// The comparison of first order with solved poses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solved {
    /// The largest share of a bound that was reached: by worst errors of either sign at their pose, or by random errors
    /// in the budget. It is `None` if a pose was lost.
    pub(super) share: Option<f64>,
    /// A radius, at most that of the budget, for which the worst errors of either sign at their pose keep the bound
    /// when solved.
    pub(super) radius: Option<f64>,
}

impl Solved {
    /// Whether no sampled error exceeded its bound by more than a tolerance.
    pub(super) fn within(&self) -> bool {
        self.share.is_some_and(|share| share <= 1.0)
    }
}

fn solved(
    m: &Manipulator,
    budget: &Budget,
    trials: &Trials,
    tool: &Point3<f64>,
    bound: &ErrorBound,
) -> Solved {
    let random = (trials.formula.position.max / bound.position)
        .max(trials.formula.rotation_deg.max / bound.rotation_deg);
    let worst = budget.solved_share(m, tool, bound, budget.radius.value).filter(|_| trials.lost == 0);
    Solved { share: worst.map(|share| share.max(random)), radius: budget.solved_radius(m, tool, bound) }
}

/// Numbers separated by commas.
pub(crate) fn numbers<const N: usize>(text: &str, option: &str, code: &str) -> Result<[f64; N], Failure> {
    crate::app::cli::numbers::parse(text).ok_or_else(|| {
        let message = crate::app::cli::numbers::fault(option, text, N);
        Failure::refused(code, message).with_help(format!("give {N} numbers separated by commas"))
    })
}

fn failure_of(error: &ToleranceError) -> Failure {
    match error {
        ToleranceError::BadBound { .. } => Failure::refused("tolerances::bad_bound", error.to_string()),
        _ => Failure::new(Exit::No, "tolerances::singular_workspace", error.to_string()).with_help(
            "give a smaller [workspace]; `equipod singular poses` finds a box without singular poses",
        ),
    }
}

/// `--bound` and `--tool`, lengths in the unit of the design.
fn asked(bound: &str, tool: &str, units: &str) -> Result<(ErrorBound, Point3<f64>), Failure> {
    let bad = |why: String| {
        Failure::refused("tolerances::bad_bound", format!("--bound: {why}"))
            .with_help("write a length and an angle in degrees, for instance 0.1,0.05")
    };
    let (length, angle) =
        bound.split_once(',').ok_or_else(|| bad(format!("`{bound}` is not a length and an angle")))?;
    let [position] = lengths::<1>(length, "one", units).map_err(bad)?;
    let rotation_deg = one(angle).ok_or_else(|| bad(format!("the angle `{angle}` is no number")))?;
    Ok((ErrorBound { position, rotation_deg }, tool_point(tool, units, "tolerances::bad_tool")?))
}

/// `--tool`: a point in the platform frame.
///
/// # Errors
/// Exit 2: no three lengths.
pub(crate) fn tool_point(text: &str, units: &str, code: &'static str) -> Result<Point3<f64>, Failure> {
    lengths::<3>(text, "three", units)
        .map(Point3::from)
        .map_err(|why| Failure::refused(code, format!("--tool: {why}")))
}

/// The greatest error that every joint may have in any direction, design units, for a bound and a tool point.
///
/// # Errors
/// Exit 1: singular poses in the workspace, or no radius that keeps the bound when solved. Exit 2: numbers that cannot
/// be read.
pub(in crate::app::cli::commands) fn joint_radius(
    design: &Design,
    (bound, tool): (&str, &str),
    seed: u64,
) -> Result<f64, Failure> {
    let (bound, tool) = asked(bound, tool, &design.units)?;
    let m = design.manipulator();
    let search = PoseSearch { seed, ..PoseSearch::default() };
    let budget = budget(m, &poses::space(design).0, tool, bound, &search).map_err(|e| failure_of(&e))?;
    budget.solved_radius(m, &tool, &bound).ok_or_else(|| {
        Failure::new(
            Exit::No,
            "tolerances::lost",
            "no joint error was found that keeps the bound without linearisation",
        )
        .with_help("give a smaller [workspace] or a wider bound")
    })
}

fn find(design: &Design, args: &BuildTolerancesArgs, seed: u64) -> Result<ToleranceReports, Failure> {
    let (bound, tool) = asked(&args.bound, &args.tool, &design.units)?;
    let (space, workspace_given) = poses::space(design);
    let search = PoseSearch {
        points: args.points as usize,
        searches: args.searches as usize,
        seed,
        ..PoseSearch::default()
    };
    let m = design.manipulator();
    let budget = budget(m, &space, tool, bound, &search).map_err(|e| failure_of(&e))?;
    let errors = JointErrors::Balls(budget.radius.value);
    let trials = trials(m, &space, &tool, &bound, &errors, (args.trials as usize, seed));
    let (mut calibrated, mut computed) = (None, None);
    if args.calibrated {
        let known = uncertainty(design)?;
        computed = Some(computed_poses(design, &known, &space, &tool, &search));
        let errors = JointErrors::Calibrated(known);
        calibrated = Some(self::trials(m, &space, &tool, &bound, &errors, (args.trials as usize, seed)));
    }
    let map = machine_errors(args, &budget)?
        .map(|errors| Ok((errors, error_map(m, &space, &tool, &errors, &search)?)))
        .transpose()
        .map_err(|e: ToleranceError| failure_of(&e))?;
    let worst = [1.0, 1.5].map(|scale| {
        let errors: Vec<_> = budget.worst_errors.iter().map(|e| e * scale).collect();
        let (p, w) = solved_error(m, &errors, &budget.radius.pose, &tool)?;
        Some((p.norm(), w.norm().to_degrees()))
    });
    let solved = solved(m, &budget, &trials, &tool, &bound);
    Ok(ToleranceReports {
        bound,
        tool,
        budget,
        trials,
        calibrated,
        computed,
        map,
        worst,
        solved,
        workspace_given,
    })
}

/// The errors of the machine for the error map; `None` if it is not requested.
fn machine_errors(args: &BuildTolerancesArgs, budget: &Budget) -> Result<Option<MachineErrors>, Failure> {
    if args.joint_error.is_none()
        && args.length_error.is_none()
        && args.growth.is_none()
        && args.map.is_none()
    {
        return Ok(None);
    }
    for (option, value) in [("--joint-error", args.joint_error), ("--length-error", args.length_error)] {
        if value.is_some_and(|x| !(x >= 0.0 && x.is_finite())) {
            let message = format!("{option} is not a length of 0 or more");
            return Err(
                Failure::refused("tolerances::bad_error", message).with_help("give a length in design units")
            );
        }
    }
    let growth = args.growth.as_deref().map(|text| numbers(text, "--growth", "tolerances::bad_error"));
    Ok(Some(MachineErrors {
        joints: args.joint_error.unwrap_or(budget.radius.value),
        lengths: args.length_error.unwrap_or(0.0),
        growth: growth.transpose()?.unwrap_or_default(),
    }))
}

/// The uncertainty of the design's calibration.
fn uncertainty(design: &Design) -> Result<MachineUncertainty, Failure> {
    design.machine_uncertainty().ok_or_else(|| {
        let message = "the design has no standard deviations in a table [calibration]";
        Failure::refused("tolerances::not_calibrated", message)
            .with_help("`equipod calibrate DESIGN MEASUREMENTS -o FILE` writes a design with them")
    })
}

/// The covariances of the poses of the workspace: the corners and a sample of the region, and the listed poses.
fn computed_poses(
    design: &Design,
    known: &MachineUncertainty,
    space: &PoseSpace,
    tool: &Point3<f64>,
    search: &PoseSearch,
) -> Vec<PoseDeviations> {
    let m = design.manipulator();
    let independent = known.independent();
    let of = |pose: Pose| {
        let [kept, independent] = [known, &independent].map(|u| u.pose_covariance(m, &pose, tool));
        Some(PoseDeviations { pose, kept: kept?, independent: independent? })
    };
    search.poses(space).into_iter().filter_map(of).collect()
}

/// Computes the budget and checks it.
pub(crate) fn run(args: &BuildTolerancesArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let found = find(&design, args, context.seed())?;
    if let (Some(path), Some((_, map))) = (&args.map, &found.map) {
        files::write_text(path, &render::map(&design, map))?;
    }
    let path = args.map.as_ref().map(|path| path.display().to_string());
    let record = render::record(&design, &found, context.seed(), path);
    let margins = format!("equipod assess {}", args.design.display());
    let text = sheet::answers::tolerances(&design.name, &record, &margins);
    Ok(Answer::new(Exit::Yes, record, text))
}
