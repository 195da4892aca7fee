//! `equipod build round`: joints on a grid of holes.

mod render;

use std::path::PathBuf;

use nalgebra::Point3;

use super::tolerances::numbers;
use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files::{self, OutputPath};
use crate::cli::output::Answer;
use crate::cli::poses;
use crate::cli::requirements;
use crate::design::Design;
use crate::equivalence::{Verdict, Verification};
use crate::manipulator::{Body, Manipulator};
use crate::manufacture::{Grid, NoRounding, Rounding, RoundingProblem, equivalent_octahedral, round_to_grid};
use crate::records::{AssessAnswer, GridsRecord, VariantWord};

/// Arguments of `build round`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json) with planar bodies; its home pose, workspace and requirements judge the roundings
    design: PathBuf,
    /// Distance between neighbouring holes
    #[arg(long, value_name = "PITCH")]
    grid: f64,
    /// Distance between neighbouring holes of the platform; that of the base when absent
    #[arg(long, value_name = "PITCH")]
    grid_platform: Option<f64>,
    /// Position of one hole of the base grid, in the plane of the base joints
    #[arg(long, value_name = "X,Y", default_value = "0,0", allow_hyphen_values = true)]
    origin: String,
    /// Position of one hole of the platform grid
    #[arg(long, value_name = "X,Y", default_value = "0,0", allow_hyphen_values = true)]
    origin_platform: String,
    /// Angle by which the base grid is turned, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_hyphen_values = true)]
    angle: f64,
    /// Angle by which the platform grid is turned, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_hyphen_values = true)]
    angle_platform: f64,
    /// Choose the origins and angles of the grids too; the given ones are candidates
    #[arg(long)]
    free_grid: bool,
    /// Rounding that is written
    #[arg(long, value_enum, default_value_t = Variant::Rule)]
    variant: Variant,
    /// Share of the inverse condition number that the exact rounding has to keep to be chosen
    #[arg(long, value_name = "SHARE", default_value_t = 0.9)]
    keep: f64,
    /// Number of triangles of each body that are combined in the first search
    #[arg(long, value_name = "N", default_value_t = 40, value_parser = clap::value_parser!(u32).range(1..=1000))]
    candidates: u32,
    /// Tool point at which errors of the pose are measured, platform frame
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    tool: String,
    /// Number of random poses for the error of the nearest rounding
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    trials: u32,
    /// Write the rounded design; .json gives JSON, anything else TOML
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// Which rounding is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Variant {
    /// The exact rounding when it meets the requirements and keeps the share of --keep, else the nearest, else the exact one
    Rule,
    /// All joints lie exactly on the sides of two triangles
    Exact,
    /// All joints lie on grid points next to where they are wanted
    Nearest,
}

/// A rounding that may be written.
#[derive(Debug, Clone, Copy)]
struct Choice<'a> {
    variant: VariantWord,
    manipulator: &'a Manipulator,
    grids: &'a [Grid; 2],
}

fn chosen(found: &Rounding, variant: Variant, keep: f64) -> Option<Choice<'_>> {
    let exact = found.exact.as_ref().ok();
    let exact =
        exact.map(|e| Choice { variant: VariantWord::Exact, manipulator: &e.manipulator, grids: &e.grids });
    let nearest = found.nearest.as_ref().ok();
    let nearest = nearest.map(|n| Choice {
        variant: VariantWord::Nearest,
        manipulator: &n.manipulator,
        grids: &n.grids,
    });
    match variant {
        Variant::Exact => exact,
        Variant::Nearest => nearest,
        Variant::Rule => {
            let choice = found.choice(keep)?;
            [exact, nearest].into_iter().flatten().find(|c| std::ptr::eq(c.manipulator, choice))
        }
    }
}

/// A grid in words.
fn rounded_design(design: &Design, choice: &Choice<'_>) -> Design {
    let name = format!("{}, rounded", design.name);
    let plain = Design::new(name, design.units.clone(), choice.manipulator.clone());
    let (base, platform) = (design.base_names().to_vec(), design.platform_names().to_vec());
    let mut out = plain.clone().with_joint_names(base, platform).unwrap_or(plain);
    let grids = GridsRecord::from(choice.grids);
    out.description = Some(format!(
        "Joints of the design \"{}\" on grids by equipod {}, variant {}; base: {}; platform: {}",
        design.name,
        env!("CARGO_PKG_VERSION"),
        choice.variant.as_str(),
        render::in_words(&grids.base),
        render::in_words(&grids.platform)
    ));
    let decimals =
        [0, 1].map(|body| decimals(&choice.grids[body], choice.manipulator.joints(Body::BOTH[body])));
    out.with_tables_of(design).at_decimals(decimals.each_ref().map(Option::as_deref))
}

/// The joints of a body as the decimals that the holes of the grid are, of which doubles are only near: the third hole of pitch 0.1 is at 0.3.
///
/// `None` where doubles are the holes (whole pitches), where the pitch is no short decimal, and where the axes of the grid are not those of the body, so
/// that the coordinates are no decimals.
fn decimals(grid: &Grid, joints: &[Point3<f64>]) -> Option<Vec<[String; 3]>> {
    // without an exponent, with the fewest digits
    let places = |x: f64| x.to_string().split_once('.').map_or(0, |(_, digits)| digits.len());
    let digits = grid.origin.into_iter().chain([grid.pitch]).map(places).max().unwrap_or(0);
    let height = joints.first()?.z;
    let level = joints.iter().all(|p| p.z.total_cmp(&height).is_eq());
    let unturned = grid.angle_deg == 0.0;
    // below this every decimal with so many places has its own double, with room for errors of rounding
    let largest = 10f64.powi(14 - i32::try_from(digits).ok()?);
    let apart = joints.iter().all(|p| p.x.abs().max(p.y.abs()) < largest);
    let shown =
        |p: &Point3<f64>| [format!("{:.digits$}", p.x), format!("{:.digits$}", p.y), height.to_string()];
    (digits > 0 && level && unturned && apart).then(|| joints.iter().map(shown).collect())
}

/// Rounds, judges both roundings and writes the chosen one.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let (origin, origin_platform) = (
        numbers(&args.origin, "--origin", "round::bad_grid")?,
        numbers(&args.origin_platform, "--origin-platform", "round::bad_grid")?,
    );
    let pitch = [args.grid, args.grid_platform.unwrap_or(args.grid)];
    let tool = Point3::from(numbers::<3>(&args.tool, "--tool", "round::bad_tool")?);
    if args.variant != Variant::Rule {
        context.no_effect("keep", "the rounding is chosen by --variant, not by rule")?;
    }
    if !(args.keep >= 0.0 && args.keep.is_finite()) {
        return Err(Failure::refused(
            "round::bad_share",
            format!("--keep is {}, not a share of 0 or more", args.keep),
        ));
    }
    let (space, _) = poses::space(&design);
    let poses = poses::judged(&design);
    let required = design.requirements();
    let m = design.manipulator();
    // that of `optimize`: RMS radius of the platform triangle, of the leg ends where there is none
    let radius = equivalent_octahedral(m).as_ref().unwrap_or(m).platform_rms_radius();
    let problem = RoundingProblem {
        manipulator: m,
        grids: [
            Grid { pitch: pitch[0], origin, angle_deg: args.angle },
            Grid { pitch: pitch[1], origin: origin_platform, angle_deg: args.angle_platform },
        ],
        free: args.free_grid,
        requirements: &required,
        space: &space,
        poses: &poses,
        characteristic_length: design.optimize.characteristic_length.unwrap_or(radius),
        min_abs_det: design.optimize.min_abs_det,
        tool,
        candidates: args.candidates as usize,
        keep: args.keep,
        trials: args.trials as usize,
        seed: context.seed(),
    };
    let found = round_to_grid(&problem).map_err(|why| {
        let code =
            if matches!(why, NoRounding::NotPlanar(_)) { "round::not_planar" } else { "round::bad_grid" };
        Failure::refused(code, why.to_string())
    })?;
    let choice = chosen(&found, args.variant, args.keep);
    let rounded = choice.map(|c| (c.variant, rounded_design(&design, &c)));
    let mut written = None;
    if let (Some(path), Some((_, rounded))) = (&args.output, &rounded) {
        files::write_design(path, rounded)?;
        written = Some(path.display().to_string());
    }
    let assessment = rounded.as_ref().and_then(|(_, d)| AssessAnswer::of(d, context.seed()));
    let met = assessment.as_ref().map_or(Some(true), |a| a.met);
    let rounded = rounded.as_ref().map(|(variant, d)| (*variant, d));
    // an exact rounding that is not equivalent would be a fault of the search
    let contradicted = found.exact.as_ref().is_ok_and(|e| {
        let refuted = |v: &Verification| matches!(v.verdict, Verdict::NotEquivalent(_) | Verdict::Singular);
        !e.proved || e.verification.as_ref().is_ok_and(refuted)
    });
    let exit = match rounded {
        _ if contradicted => Exit::Inconclusive,
        Some(_) => requirements::exit_of(met),
        None => Exit::No,
    };
    let report = render::RoundReport {
        design: &design,
        problem: &problem,
        found: &found,
        rounded,
        assessment,
        written: written.as_deref(),
    };
    let record = report.record();
    let text = render::text(&record);
    Ok(Answer::new(exit, record, text))
}
