//! `equipod build round`: joints on a grid of holes.

pub(in crate::app::cli::commands) mod render;

use std::path::PathBuf;

use super::tolerances::tool_point;
use crate::app::cli::numbers::{Length, length, lengths, number};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ask::Design;
use ask::rounding::{CANDIDATES, KEEP, RoundingChoices, RoundingWay, TRIALS};
use machine::manufacture::{NoRounding, Rounding};
use machine::requirements::{Grid, HoleCircles, HolePattern};
use platform::manipulator::{Body, Manipulator};
use records::{AssessAnswer, DesignRoleWord};
use verify::{Verdict, Verification};

/// Arguments of `build round`.
#[derive(Debug, clap::Args)]
pub(crate) struct BuildRoundArgs {
    /// Design file (.toml or .json) with planar bodies
    design: PathBuf,
    /// Distance of neighbouring base holes, design units; replaces `[holes]`
    #[arg(long, value_name = "PITCH", value_parser = length)]
    grid: Option<Length>,
    /// Distance of neighbouring platform holes, design units; default: as --grid
    #[arg(long, value_name = "PITCH", value_parser = length)]
    grid_platform: Option<Length>,
    /// Pattern of the holes; default: from the design, or square
    #[arg(long, value_enum, value_name = "PATTERN")]
    pattern: Option<PatternWord>,
    /// Pattern of the platform holes; default: as --pattern
    #[arg(long, value_enum, value_name = "PATTERN")]
    pattern_platform: Option<PatternWord>,
    /// Position of a base hole in the plane of the joints, design units; default: from the design, or 0,0
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    origin: Option<String>,
    /// Position of a platform hole, design units
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    origin_platform: Option<String>,
    /// Angle of the base grid, degrees; default: from the design, or 0
    #[arg(long, value_name = "DEG", value_parser = number, allow_hyphen_values = true)]
    angle: Option<f64>,
    /// Angle of the platform grid, degrees
    #[arg(long, value_name = "DEG", value_parser = number, allow_hyphen_values = true)]
    angle_platform: Option<f64>,
    /// Choose origins and angles of the grids too
    #[arg(long)]
    free_grid: bool,
    /// Rounding to write
    #[arg(long, value_enum, default_value_t = Variant::Rule)]
    variant: Variant,
    /// Share of the conditioning that the exact rounding must keep
    #[arg(long, value_name = "SHARE", default_value_t = KEEP)]
    keep: f64,
    /// Number of triangles of each body in the first search
    #[arg(long, value_name = "N", default_value_t = CANDIDATES, value_parser = clap::value_parser!(u32).range(1..=1000))]
    candidates: u32,
    /// Tool point, design units, platform frame
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    tool: String,
    /// Number of random poses for the nearest rounding's error
    #[arg(long, value_name = "N", default_value_t = TRIALS, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    trials: u32,
    /// Write the rounded design (.json, else TOML)
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// The patterns of holes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum PatternWord {
    /// Square grid
    Square,
    /// Grid of equilateral triangles
    Triangular,
}

impl From<PatternWord> for HolePattern {
    fn from(word: PatternWord) -> Self {
        match word {
            PatternWord::Square => Self::Square,
            PatternWord::Triangular => Self::Triangular,
        }
    }
}

/// The rounding to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Variant {
    /// Exact if it meets the requirements and keeps the share of --keep, else nearest if that meets them, else exact.
    /// If neither meets them, the one with the least violation
    Rule,
    /// All joints lie exactly on the sides of two triangles
    Exact,
    /// All joints lie on grid points near their given positions
    Nearest,
}

/// A rounding that can be written.
#[derive(Debug, Clone, Copy)]
struct RoundingChoice<'a> {
    way: RoundingWay,
    manipulator: &'a Manipulator,
    grids: &'a [Option<Grid>; 2],
}

/// The roundings found, the exact one first.
fn choices(found: &Rounding) -> [Option<RoundingChoice<'_>>; 2] {
    let exact = found.exact.as_ref().ok();
    let exact = exact.map(|e| RoundingChoice {
        way: RoundingWay::Exact,
        manipulator: &e.manipulator,
        grids: &e.grids,
    });
    let nearest = found.nearest.as_ref().ok();
    let nearest = nearest.map(|n| RoundingChoice {
        way: RoundingWay::Nearest,
        manipulator: &n.manipulator,
        grids: &n.grids,
    });
    [exact, nearest]
}

fn chosen(found: &Rounding, variant: Variant, keep: f64) -> Option<RoundingChoice<'_>> {
    let [exact, nearest] = choices(found);
    match variant {
        Variant::Exact => exact,
        Variant::Nearest => nearest,
        Variant::Rule => with(found, found.choice(keep)?),
    }
}

/// The choice of one of the two manipulators.
fn with<'a>(found: &'a Rounding, m: &Manipulator) -> Option<RoundingChoice<'a>> {
    choices(found).into_iter().flatten().find(|c| std::ptr::eq(c.manipulator, m))
}

/// The grids of the design or of `--grid`, changed by further options.
fn grids(args: &BuildRoundArgs, design: &Design) -> Result<[Option<Grid>; 2], Failure> {
    let [grid, grid_platform] =
        [&args.grid, &args.grid_platform].map(|pitch| Length::of_option(pitch.as_ref(), &design.units));
    let (grid, grid_platform) = (grid?, grid_platform?);
    let pitches = grid.map(|base| [base, grid_platform.unwrap_or(base)]);
    let mut grids = match (design.holes, pitches) {
        (Some(grids), None) => grids,
        (_, Some(pitches)) => pitches.map(|pitch| Some(Grid::square(pitch))),
        (None, None) => {
            return Err(Failure::refused("round::no_grid", "the design states no [holes], and --grid is absent")
                .with_help("name the distance of neighbouring holes, --grid 25, or state the grids of both plates in [holes]"));
        }
    };
    if let (Some(pitch), None) = (grid_platform, grid) {
        // circles have dimensions other than a pitch
        let lattice = grids[1].filter(|grid| grid.pattern.skew().is_some());
        grids[1] = Some(Grid { pitch, ..lattice.unwrap_or(Grid::square(pitch)) });
    }
    let pattern = [args.pattern, args.pattern_platform.or(args.pattern)];
    let origin = [(&args.origin, "--origin"), (&args.origin_platform, "--origin-platform")];
    let angle = [args.angle, args.angle_platform];
    for (k, grid) in grids.iter_mut().enumerate() {
        let Some(grid) = grid else {
            if origin[k].0.is_some() || angle[k].is_some() || pattern[k].is_some() {
                return Err(no_grid_to_change(Body::BOTH[k]));
            }
            continue;
        };
        if let Some(pattern) = pattern[k] {
            if grid.pattern == HolePattern::BoltCircle {
                let message =
                    format!("[holes] gives the {} bolt circles, which have no pitch", Body::BOTH[k]);
                return Err(Failure::refused("round::bad_grid", message)
                    .with_help("name the pitch of the other pattern too, --grid 25"));
            }
            *grid = Grid { pattern: pattern.into(), circles: HoleCircles::NONE, ..*grid };
        }
        if let (Some(text), option) = origin[k] {
            grid.origin = lengths::<2>(text, "two", &design.units)
                .map_err(|why| Failure::refused("round::bad_grid", format!("{option}: {why}")))?;
        }
        grid.angle_deg = angle[k].unwrap_or(grid.angle_deg);
    }
    Ok(grids)
}

fn no_grid_to_change(body: Body) -> Failure {
    Failure::refused(
        "round::no_grid",
        format!("[holes] has no grid for the {body}, whose joints stay where they are"),
    )
    .with_help("name the distance of neighbouring holes, --grid 25, or state the grid in [holes]")
}

/// Rounds, assesses both roundings and writes the chosen one.
pub(crate) fn run(args: &BuildRoundArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let grids = grids(args, &design)?;
    let tool = tool_point(&args.tool, &design.units, "round::bad_tool")?;
    if args.variant != Variant::Rule {
        context.no_effect("keep", "--variant chooses the rounding")?;
    }
    if !(args.keep >= 0.0 && args.keep.is_finite()) {
        return Err(Failure::refused(
            "round::bad_share",
            format!("--keep is {}, not a share of 0 or more", args.keep),
        ));
    }
    let choices = RoundingChoices::on(&grids, context.seed())
        .free(args.free_grid)
        .keep(args.keep)
        .candidates(args.candidates as usize)
        .tool(tool)
        .trials(args.trials as usize);
    let found = design.rounded(&choices).map_err(|why| {
        let message = why.to_string();
        if matches!(why, NoRounding::NotPlanar(_)) {
            return Failure::refused("round::not_planar", message);
        }
        Failure::refused("round::bad_grid", message)
            .with_help("give the distance of neighbouring holes, --grid 25, or state the grid in [holes]")
    })?;
    let taken = chosen(&found, args.variant, args.keep);
    let missing = || found.least_missed(&design.requirements(), design.manipulator().size());
    let choice = match args.variant {
        Variant::Rule => taken.or_else(|| with(&found, missing()?)),
        _ => taken,
    };
    let rounded = choice.map(|c| (c.way, design.on_holes(c.way, c.manipulator, c.grids)));
    let mut written = None;
    if let (Some(path), Some((_, rounded))) = (&args.output, &rounded) {
        files::write_design(path, rounded)?;
        written = Some(path.display().to_string());
    }
    let assessment = rounded
        .as_ref()
        .and_then(|(_, d)| Some(AssessAnswer::of(d, context.seed())?.with_role(DesignRoleWord::OnHoles)));
    let met = assessment.as_ref().map_or(Some(true), AssessAnswer::met_at_assessed_poses);
    let rounded = rounded.as_ref().map(|(variant, d)| (*variant, d));
    // an exact rounding that is not equivalent is an error of the search
    let contradicted = found.exact.as_ref().is_ok_and(|e| {
        let refuted = |v: &Verification| matches!(v.verdict, Verdict::NotEquivalent(_) | Verdict::Singular);
        !e.proved || e.verification.as_ref().is_ok_and(refuted)
    });
    let exit = match rounded {
        _ if contradicted => Exit::Inconclusive,
        Some(_) if taken.is_some() => Exit::from(met),
        _ => Exit::No,
    };
    let report = render::RoundReport {
        design: &design,
        choices: &choices,
        found: &found,
        rounded,
        is_taken: taken.is_some(),
        assessment,
        written: written.as_deref(),
    };
    let record = report.record();
    let text = sheet::answers::round(&record);
    Ok(Answer::new(exit, record, text))
}
