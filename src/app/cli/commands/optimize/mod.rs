//! `equipod optimize`: the best platform equivalent to a design, or the best under its requirements.

mod history;

use std::path::{Path, PathBuf};

use crate::app::cli::commands::build::drives;
use crate::app::cli::commands::fk::threads;
use crate::app::cli::commands::verify::failure_of;
use crate::app::cli::commands::{GENERAL, NEAREST};
use crate::app::cli::progress::{Interrupt, ProgressLine, TimeLimit};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ask::Design;
use ask::optimizing::{EXTENSION, SearchKind, dimensional_problem, hopeless_home};
use ask::{ConflictFreedom, Error, OptimizeEvidence, OptimizeOptions, OptimizeReport, OptimizeStatus};
use optimize::dimensional::InvalidProblem;
use records::{OptimizeAnswer, OptimizeFiles};
use sheet::Sheet;

/// Arguments of `optimize`.
#[derive(Debug, clap::Args)]
pub(crate) struct OptimizeArgs {
    /// Design (.toml or .json) with poses and limits in `[home]`, `[workspace]`, `[hardware]` and `[optimize]`
    design: PathBuf,
    /// Write the optimised design (.json, else TOML)
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    /// Greatest distance of a joint beyond its side, in side lengths
    #[arg(long, value_name = "X", default_value_t = EXTENSION)]
    extension: f64,
    /// Search every branch for its best platform; takes ten times as long
    #[arg(long)]
    survey: bool,
    /// Greatest relative gap to the proved upper bound for the status `optimal`
    #[arg(long, value_name = "X", default_value_t = 1e-2)]
    gap: f64,
    /// Write the steps of the successful run: .svg a picture, else CSV
    #[arg(long, value_name = "FILE")]
    history: Option<OutputPath>,
    /// Write the answer and other local optima into this folder; without an answer, the platforms found with other
    /// freedoms
    #[arg(long, value_name = "DIR")]
    candidates: Option<OutputPath>,
    /// Table of drives (.csv) as in `build drives`: searches with each drive that could win, by price if all have
    /// prices
    #[arg(long, value_name = "TABLE")]
    drives: Option<PathBuf>,
    /// Worker threads; default: one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Time limit, seconds, with status `interrupted`; the last quarter, at most 10 s, is for the assessment
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(TimeLimit))]
    time_limit: Option<TimeLimit>,
}

/// Optimises, and writes the design if requested.
pub(crate) fn run(args: &OptimizeArgs, context: &mut Context) -> Result<Answer, Failure> {
    check_extension(args.extension)?;
    let design = context.load(&args.design)?;
    refuse_singular_home(&design, args.extension, "optimize::singular_home")?;
    refuse_options(args, &design, context)?;
    let table = drives::asked(args.drives.as_deref(), &args.design, &design, context)?;
    let (mut progress, interrupt) = (ProgressLine::new(context.quiet()), Interrupt::watch());
    let mut options = OptimizeOptions::new()
        .seed(context.seed())
        .threads(threads(args.threads))
        .extension(args.extension)
        .survey(args.survey)
        .gap(args.gap)
        .candidates(args.candidates.is_some())
        .time_limit(args.time_limit.map(|limit| limit.0))
        .on_progress(|p| {
            progress.note(&p.to_string());
            interrupt.flow()
        });
    if let Some(table) = &table {
        options = options.drives(table);
    }
    let found = design.optimize_with(options).map_err(failed)?;
    progress.end();
    let written = write(args, &found)?;
    let record = OptimizeAnswer::new(&found, &written);
    let text = if context.json() { Sheet::new() } else { sheet::answers::optimize(&design.name, &record) };
    Ok(Answer::new(exit_of(record.status), record, text))
}

/// Refuses options without effect on the search for this design.
fn refuse_options(args: &OptimizeArgs, design: &Design, context: &Context) -> Result<(), Failure> {
    // drive lengths are requirements
    let kind = SearchKind::of(design, args.drives.is_some() || design.drive_table.is_some());
    if kind == SearchKind::Offsets {
        context.no_effect(
            "candidates",
            "the search for offsets alone finds only the best of all branches; --survey gives the best of each",
        )?;
        if !(args.gap > 0.0 && args.gap.is_finite()) {
            let message = format!("--gap is {}, not a positive number", args.gap);
            return Err(Failure::refused("optimize::bad_gap", message));
        }
        return Ok(());
    }
    let why = "a bound over all offsets is proved only for designs whose offsets are the only variables";
    context.no_effect("gap", why)?;
    context.no_effect(
        "survey",
        "the branches of the offsets are searched only for designs without further variables or requirements",
    )?;
    refuse_extension(design, context)?;
    if let SearchKind::Front(_) = kind {
        context.no_effect("history", "a front is the result of many runs")?;
        context.no_effect("candidates", "a front is a list of platforms already")?;
        context.no_effect("drives", "a front has many platforms, but a drive is chosen for one")?;
        refuse_drives(design, "a front has many platforms, but a drive is chosen for one")?;
    }
    Ok(())
}

/// The failure for an invalid search or an answer that could not be assessed.
pub(super) fn failed(why: Error) -> Failure {
    let invalid =
        |why: &dyn std::fmt::Display| Failure::refused("optimize::invalid_problem", why.to_string());
    match why {
        Error::DimensionalProblem(why) => refusal(&why),
        // a design that is not octahedral requires more than offsets
        Error::NotOctahedral(why) => refusal(&InvalidProblem::NotOctahedral(why)),
        Error::OffsetProblem(why) => invalid(&why),
        Error::Verify(why) => failure_of(&why),
        other => Failure::internal(other.to_string()),
    }
}

/// The refusal of an invalid problem, with valid alternatives.
fn refusal(why: &InvalidProblem) -> Failure {
    let failed = |code| Failure::refused(code, why.to_string());
    match why {
        InvalidProblem::NotOctahedral(_) => failed("optimize::not_octahedral").with_help(format!(
            "for other designs set variables = [\"components\"] in [optimize] (legs move in their families of replaceable legs), \
             [\"triangle_sizes\"] (sizes of base and platform), or \"home_height\", \"joint_axes\"; {NEAREST} {GENERAL}"
        )),
        InvalidProblem::NoFamily => failed("optimize::invalid_problem").with_help(format!(
            "variables = [\"triangle_sizes\"] (sizes of base and platform), [\"home_height\"] or [\"joint_axes\"] in [optimize] work without a family, \
             but the platforms are not equivalent to the design; {NEAREST} {GENERAL}"
        )),
        _ => failed("optimize::invalid_problem"),
    }
}

/// Writes the requested files.
fn write(args: &OptimizeArgs, found: &OptimizeReport) -> Result<OptimizeFiles, Failure> {
    let mut written = OptimizeFiles::default();
    let keep = |path: &Path, design: &Design| -> Result<String, Failure> {
        files::write_design(path, design)?;
        Ok(path.display().to_string())
    };
    if let Some(path) = &args.history {
        history::write(path, found)?;
    }
    if let Some(path) = args.output.as_deref() {
        if let Some(c) = found.checked().or(found.nearest()) {
            written.platform = Some(keep(path, &c.design)?);
        }
        if let OptimizeEvidence::Front(front) = &found.evidence {
            let all = front.members.iter().enumerate();
            written.front =
                all.map(|(k, c)| keep(&numbered(path, k), &c.design)).collect::<Result<_, Failure>>()?;
        }
    }
    if let Some(folder) = args.candidates.as_deref() {
        files::make_folder(folder)?;
        let path = |k: usize| folder.join(format!("candidate-{k}.toml"));
        if let Some(design) = found.design() {
            keep(&path(1), design)?;
        }
        let others = found.candidates.iter().flatten().enumerate();
        written.candidates =
            others.map(|(k, c)| keep(&path(k + 2), &c.design)).collect::<Result<_, Failure>>()?;
        for (opened, design) in found.freedoms.iter().flatten().filter_map(|f| Some((f, f.design()?))) {
            let path = keep(&folder.join(opened_file(opened.freedom)), design)?;
            written.freedoms.push((opened.freedom, path));
        }
    }
    Ok(written)
}

/// The name of the file for the platform of a freedom.
pub(super) fn opened_file(freedom: ConflictFreedom) -> String {
    format!("with-{}.toml", freedom.name())
}

/// The path with a number: `out.toml` becomes `out-1.toml`, `out-2.toml`, ...
fn numbered(path: &Path, k: usize) -> PathBuf {
    let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    let name = match path.extension() {
        Some(e) => format!("{stem}-{}.{}", k + 1, e.to_string_lossy()),
        None => format!("{stem}-{}", k + 1),
    };
    path.with_file_name(name)
}

/// Refuses a search at a home pose that is singular for every platform it could find: exit 1.
pub(super) fn refuse_singular_home(design: &Design, extension: f64, code: &str) -> Result<(), Failure> {
    let Some(home) = hopeless_home(design, extension) else { return Ok(()) };
    let message = format!("{home}, and no equivalent platform holds it");
    Err(Failure::new(Exit::No, code, message).with_help(
        "state another pose in [home], for example rotated about the vertical axis, or let the search choose the triangles or the height of home",
    ))
}

/// Refuses `--extension` if the search under requirements does not use it.
pub(super) fn refuse_extension(design: &Design, context: &Context) -> Result<(), Failure> {
    if design.search.offset_bounds.is_some() {
        context.no_effect("extension", "the design has `offset_bounds`")?;
    }
    if !dimensional_problem(design, EXTENSION).variables.offsets {
        context.no_effect("extension", "no offsets are chosen")?;
    }
    Ok(())
}

/// Refuses a design that names a table of drives if none is chosen.
pub(super) fn refuse_drives(design: &Design, why: &str) -> Result<(), Failure> {
    let Some(file) = &design.drive_table else { return Ok(()) };
    let message = format!("the design names a table of drives ({file}), and {why}");
    let help = "remove `drives` from [hardware], or give the limits of one drive";
    Err(Failure::refused("drives::not_chosen", message).with_help(help))
}

/// Refuses an `--extension` that is no length.
pub(super) fn check_extension(extension: f64) -> Result<(), Failure> {
    if extension >= 0.0 && extension.is_finite() {
        return Ok(());
    }
    let message = format!("--extension is {extension}, not a length of 0 or more");
    Err(Failure::refused("optimize::bad_extension", message))
}

/// The exit code of the status.
pub(super) fn exit_of(status: OptimizeStatus) -> Exit {
    match status {
        OptimizeStatus::Optimal | OptimizeStatus::BestFound | OptimizeStatus::Front => Exit::Yes,
        OptimizeStatus::Infeasible | OptimizeStatus::Violated => Exit::No,
        OptimizeStatus::Feasible | OptimizeStatus::Undecided | OptimizeStatus::Interrupted => {
            Exit::Inconclusive
        }
    }
}
