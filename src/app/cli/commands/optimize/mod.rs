//! `equipod optimize`: the best platform equivalent to a design, or the best under its requirements.

pub(super) mod dimensional;
mod front;
mod history;
mod render;

pub(super) use self::render::drives_text;

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

use crate::app::Design;
use crate::app::cli::commands::verify::failure_of;
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::output::Answer;
use crate::app::cli::progress::{Interrupt, ProgressLine, TimeLimit};
use crate::app::entrance::optimizing::{
    Checked, EXTENSION, Judging, asks_for_more, checked_offsets, dimensional_problem, hopeless_home,
    offset_problem, offset_status, with_sizes_to_choose,
};
use crate::app::records::{OptimizeAnswer, OptimizeWord};
use ::files::design::Combination;
use ::files::plot::SearchStep;
use optimize::dimensional::InvalidProblem;
use optimize::offsets::{self, OffsetProblem, OffsetReport, OffsetSearchOptions, OffsetSolution, optimize};
use platform::manipulator::Octahedral;

/// Arguments of `optimize`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design (.toml or .json); its tables home, workspace, hardware and optimize set poses and limits. Of an octahedral design the shared joints are spread along the sides, of others the legs are moved along their families of replaceable legs, unless the design names other variables
    design: PathBuf,
    /// Write the optimised design; .json gives JSON, anything else TOML
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    /// How far a joint may lie outside its edge, on its extension, in edge lengths
    #[arg(long, value_name = "X", default_value_t = EXTENSION)]
    extension: f64,
    /// Search every branch for its own best platform, which takes ten times as long
    #[arg(long)]
    survey: bool,
    /// Greatest relative gap between the answer and the proved upper bound over all offsets at which the answer is called optimal
    #[arg(long, value_name = "X", default_value_t = 1e-2)]
    gap: f64,
    /// Write the steps of the run that found the answer: .svg a picture, anything else CSV
    #[arg(long, value_name = "FILE")]
    history: Option<OutputPath>,
    /// Write the answer and the other local optima that meet the requirements, which look different, into this folder: `equipod compare` sets them side by side. Where there is no answer, the platforms that other freedoms lead to
    #[arg(long, value_name = "DIR")]
    candidates: Option<OutputPath>,
    /// Table of drives (.csv), as `equipod build drives` reads it, in place of that of the design (`drives` in `[hardware]`): the search is made with each drive that could win, and the answer is the best platform with its drive, the cheapest with which the requirements are met where every drive has a price
    #[arg(long, value_name = "TABLE")]
    drives: Option<PathBuf>,
    /// Worker threads, one for each processor when absent; the answer does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// End after so many seconds: the search is interrupted as by Ctrl-C, the last quarter of the time, at most 10 s, is for the judging of the best until then, and the status is `interrupted`
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(TimeLimit))]
    time_limit: Option<TimeLimit>,
}

/// How the search is to go.
#[derive(Debug, Clone, Copy)]
pub(super) struct Choices {
    pub(super) extension: f64,
    pub(super) survey: bool,
    pub(super) gap: f64,
    pub(super) threads: Option<u16>,
    /// When the judging of what was found ends.
    pub(super) until: Option<Instant>,
}

impl Choices {
    /// Defaults but for the extension and a limit of time.
    pub(super) fn plain(extension: f64, until: Option<Instant>) -> Self {
        Self { extension, survey: false, gap: OffsetSearchOptions::default().gap, threads: None, until }
    }
}

/// How many threads work where so many were asked for.
pub(super) fn workers(asked: Option<u16>) -> usize {
    asked.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), usize::from)
}

/// Why the sizes and the height are chosen.
const SIZES: &str = "no leg of the design can be replaced without another kinematics: the sizes of base and platform and the height of home are chosen";

/// Optimises, and writes the design when asked to.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    check_extension(args.extension)?;
    let design = context.load(&args.design)?;
    refuse_singular_home(&design, args.extension, "optimize::singular_home")?;
    let sized = with_sizes_to_choose(&design);
    let choice = sized.as_ref().map(|_| SIZES.to_owned());
    let design = sized.unwrap_or(design);
    // lengths of drives are requirements
    if asks_for_more(&design) || args.drives.is_some() || design.drive_table.is_some() {
        let why = "no bound over all offsets is proved for a design that asks for more than the best offsets";
        context.no_effect("gap", why)?;
        context.no_effect(
            "survey",
            "the branches of the offsets are not searched for a design that asks for more",
        )?;
        refuse_extension(&design, context)?;
        if let Some(Combination::Pareto { points }) = design.search.mode {
            context.no_effect("history", "a front is the result of many runs")?;
            context.no_effect("candidates", "a front is a list of platforms already")?;
            context.no_effect("drives", "a front is many platforms, and a drive is chosen for one")?;
            refuse_drives(&design, "a front is many platforms, and a drive is chosen for one")?;
            return front::run(&design, points, args, context);
        }
        let done = dimensional::run(&design, args, context)?;
        let shown = done.report.solution().or(done.report.nearest.as_deref());
        if let (Some(path), Some(s)) = (&args.history, shown) {
            let of = |h: &optimize::dimensional::HistoryStep| {
                (SearchStep { value: h.gain, violation: h.violation, accepted: h.accepted }, h.radius)
            };
            let rows: Vec<history::Row> = s.history.iter().map(of).collect();
            history::write(path, &design, "sum of the weighted objectives", &rows)?;
        }
        let written = write(args.output.as_deref(), done.platform())?;
        let record = OptimizeAnswer { choice, ..done.record(&design, written.as_deref()) };
        return Ok(answered(&design, record, context));
    }
    context.no_effect(
        "candidates",
        "the search for offsets alone looks for the best of all; --survey gives the best of every branch",
    )?;
    // a design that is not octahedral asks for more
    let octahedral = Octahedral::recognise(design.manipulator())
        .map_err(|why| dimensional::refusal(&InvalidProblem::NotOctahedral(why)))?;
    if !(args.gap > 0.0 && args.gap.is_finite()) {
        return Err(Failure::refused(
            "optimize::bad_gap",
            format!("--gap is {}, not a positive number", args.gap),
        ));
    }
    let (mut progress, interrupt) =
        (ProgressLine::new(context.quiet()), Interrupt::watch_for(args.time_limit));
    let choices = Choices {
        extension: args.extension,
        survey: args.survey,
        gap: args.gap,
        threads: args.threads,
        until: interrupt.until(),
    };
    let done = search(&design, octahedral, &choices, context.seed(), &mut |p| {
        progress.note(&p.to_string());
        interrupt.flow()
    })?;
    progress.end();
    let written = write(args.output.as_deref(), done.optimised())?;
    if let (Some(path), Some(s)) = (&args.history, done.report.solution()) {
        let of = |h: &offsets::OffsetHistoryStep| {
            (SearchStep { value: h.value, violation: h.violation, accepted: h.accepted }, h.radius)
        };
        let rows: Vec<history::Row> = s.history.iter().map(of).collect();
        history::write(path, &design, "worst inverse condition number", &rows)?;
    }
    let record = done.record(&design, written.as_deref());
    Ok(answered(&design, record, context))
}

/// An answer with its text and its exit code.
fn answered(design: &Design, record: OptimizeAnswer, context: &Context) -> Answer {
    let text = if context.json() { String::new() } else { render::text(&design.name, &record) };
    Answer::new(exit_of(record.status), record, text)
}

/// Ends a search at once whose home pose is singular for every platform that it could find: exit 1.
pub(super) fn refuse_singular_home(design: &Design, extension: f64, code: &str) -> Result<(), Failure> {
    let Some(home) = hopeless_home(design, extension) else { return Ok(()) };
    let message = format!("{home}, and no equivalent platform holds it");
    Err(Failure::new(Exit::No, code, message).with_help(
        "state another pose in [home], for example a turn about the vertical axis, or let the search choose the triangles or the height of home",
    ))
}

/// Refuses `--extension` in a search under requirements that does not ask it.
pub(super) fn refuse_extension(design: &Design, context: &Context) -> Result<(), Failure> {
    if design.search.offset_bounds.is_some() {
        context.no_effect("extension", "the design says how far its offsets may go (offset_bounds)")?;
    }
    if !dimensional_problem(design, EXTENSION).variables.offsets {
        context.no_effect("extension", "no offsets are chosen")?;
    }
    Ok(())
}

/// Refuses a design that names a table of drives where none is chosen.
pub(super) fn refuse_drives(design: &Design, why: &str) -> Result<(), Failure> {
    let Some(file) = &design.drive_table else { return Ok(()) };
    let message = format!("the design names a table of drives ({file}), and {why}");
    let help = "remove `drives` from [hardware], or give the limits of one drive";
    Err(Failure::refused("drives::not_chosen", message).with_help(help))
}

/// Writes the design when a path is given; the path as it is shown.
fn write(path: Option<&std::path::Path>, design: Option<&Design>) -> Result<Option<String>, Failure> {
    let (Some(path), Some(design)) = (path, design) else { return Ok(None) };
    files::write_design(path, design)?;
    Ok(Some(path.display().to_string()))
}

/// Refuses an `--extension` that is not a length.
pub(super) fn check_extension(extension: f64) -> Result<(), Failure> {
    if extension >= 0.0 && extension.is_finite() {
        return Ok(());
    }
    let message = format!("--extension is {extension}, not a length of 0 or more");
    Err(Failure::refused("optimize::bad_extension", message))
}

/// A search with everything it was asked and what came out.
#[derive(Debug)]
pub(super) struct Done {
    pub(super) problem: OffsetProblem,
    pub(super) report: OffsetReport,
    /// The platform found.
    pub(super) checked: Option<Checked>,
}

impl Done {
    /// The answer about it.
    pub(super) fn record(&self, design: &Design, written: Option<&str>) -> OptimizeAnswer {
        OptimizeAnswer::of_offsets(design, &self.problem, &self.report, self.checked.as_ref(), written)
    }

    /// The optimised platform, when there is one.
    pub(super) fn optimised(&self) -> Option<&Design> {
        self.checked.as_ref().map(|c| &c.design)
    }

    pub(super) fn exit(&self) -> Exit {
        exit_of(offset_status(&self.report, self.checked.as_ref()).into())
    }
}

/// What the status means for the exit code.
pub(super) fn exit_of(status: OptimizeWord) -> Exit {
    match status {
        OptimizeWord::Optimal | OptimizeWord::BestFound | OptimizeWord::Front => Exit::Yes,
        OptimizeWord::Infeasible | OptimizeWord::Violated => Exit::No,
        OptimizeWord::Feasible | OptimizeWord::Undecided | OptimizeWord::Interrupted => Exit::Inconclusive,
    }
}

/// Optimises the offsets of a design; `progress` is told how far the search is.
pub(super) fn search(
    design: &Design,
    octahedral: Octahedral,
    choices: &Choices,
    seed: u64,
    progress: &mut dyn FnMut(offsets::OffsetProgress) -> ControlFlow<()>,
) -> Result<Done, Failure> {
    let poses = design.workspace_or_default().sample(&design.home_or_default());
    let problem = offset_problem(design, octahedral, poses, choices.extension);
    let options = OffsetSearchOptions {
        seed,
        threads: workers(choices.threads),
        survey: choices.survey,
        gap: choices.gap,
        ..OffsetSearchOptions::default()
    };
    let report = optimize(&problem, &options, progress)
        .map_err(|why| Failure::refused("optimize::invalid_problem", why.to_string()))?;
    let judging = Judging { seed, until: choices.until };
    let of = |s: &OffsetSolution| checked_offsets(design, &problem, s, judging).map_err(|e| failure_of(&e));
    let checked = report.solution().map(of).transpose()?;
    Ok(Done { problem, report, checked })
}
