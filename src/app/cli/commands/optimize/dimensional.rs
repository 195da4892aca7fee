//! `equipod optimize` for designs that ask for more than the offsets with the best conditioning.

use std::ops::ControlFlow;
use std::path::Path;

use crate::app::Design;
use crate::app::cli::commands::build::drives;
use crate::app::cli::commands::verify::failure_of;
use crate::app::cli::commands::{GENERAL, NEAREST};
use crate::app::cli::context::Context;
use crate::app::cli::failure::Failure;
use crate::app::cli::files;
use crate::app::cli::progress::{Interrupt, ProgressLine};
use crate::app::entrance::Error;
use crate::app::entrance::drive_search::{DriveSearch, search_drives};
use crate::app::entrance::freedoms::{ConflictFreedom, FreedomOutcome, FreedomSearch, OpenedFreedom};
use crate::app::entrance::optimizing::{Checked, checked, dimensional_status};
use crate::app::entrance::platform_search::{FoundPlatform, find_platform};
use crate::app::records::{
    DriveSearchRecord, FreedomRecord, OptimizeAnswer, OptimizeWord, OptimumRecord, SymmetryRecord,
};
use ::files::design::{Drive, DriveTable};
use machine::requirements::StartSymmetry;
use optimize::dimensional::{
    DimensionalProblem, DimensionalReport, DimensionalSolution, InvalidProblem, Progress, ShapeSearchOptions,
};

/// What was asked and what came out.
#[derive(Debug)]
pub(in crate::app::cli::commands) struct Done {
    pub(in crate::app::cli::commands) problem: DimensionalProblem,
    pub(in crate::app::cli::commands) report: DimensionalReport,
    pub(in crate::app::cli::commands) checked: Option<Checked>,
    /// The platform that misses the requirements least, where none that meets them was found.
    pub(in crate::app::cli::commands) nearest: Option<Checked>,
    /// What became of the symmetry of a design that names none.
    pub(in crate::app::cli::commands) symmetry: Option<StartSymmetry>,
    /// Where a table of drives was given.
    pub(in crate::app::cli::commands) drives: Option<DriveChoice>,
    /// The other local optima, where they were asked for.
    candidates: Option<Vec<Checked>>,
    /// Their files.
    candidate_paths: Vec<String>,
    /// What other freedoms came to, where nothing that meets the requirements was found, with the files of the platforms.
    freedoms: Option<Vec<(OpenedFreedom, Option<String>)>>,
}

/// The search over a table of drives.
#[derive(Debug)]
pub(in crate::app::cli::commands) struct DriveChoice {
    search: DriveSearch,
    currency: Option<String>,
    /// The design with the drive that the answer is about.
    driven: Design,
}

impl Done {
    fn of(found: FoundPlatform, drives: Option<DriveChoice>) -> Self {
        let FoundPlatform { problem, report, checked, nearest, symmetry } = found;
        let (candidates, candidate_paths, freedoms) = (None, Vec::new(), None);
        Self { problem, report, checked, nearest, symmetry, drives, candidates, candidate_paths, freedoms }
    }

    /// The design of the answer: that which was asked about, or the same with the drive of the answer.
    pub(in crate::app::cli::commands) fn asked<'d>(&'d self, design: &'d Design) -> &'d Design {
        self.drives.as_ref().map_or(design, |d| &d.driven)
    }

    /// What other freedoms came to, where they were tried.
    pub(in crate::app::cli::commands) fn freedoms(&self, design: &Design) -> Option<Vec<FreedomRecord>> {
        let design = self.asked(design);
        let one =
            |(f, path): &(OpenedFreedom, Option<String>)| FreedomRecord::new(design, f, path.as_deref());
        self.freedoms.as_ref().map(|list| list.iter().map(one).collect())
    }

    /// The drives of the table, where there is one.
    pub(in crate::app::cli::commands) fn drive_search(&self) -> Option<DriveSearchRecord> {
        self.drives.as_ref().map(|d| DriveSearchRecord::new(&d.search, d.currency.as_deref()))
    }

    /// What became of the search, over all drives where there are some.
    pub(in crate::app::cli::commands) fn status(&self) -> OptimizeWord {
        if self.drives.as_ref().is_some_and(|d| d.search.interrupted) {
            return OptimizeWord::Interrupted;
        }
        dimensional_status(&self.report, self.checked.as_ref()).into()
    }

    /// The answer about it.
    pub(in crate::app::cli::commands) fn record(
        &self,
        design: &Design,
        written: Option<&str>,
    ) -> OptimizeAnswer {
        let design = self.asked(design);
        let found = self.checked.as_ref().or(self.nearest.as_ref());
        let of = |((s, c), path): ((&DimensionalSolution, &Checked), &String)| {
            OptimumRecord::new(design, s, c, Some(path))
        };
        let all = |list: &Vec<Checked>| {
            self.report.others.iter().zip(list).zip(&self.candidate_paths).map(of).collect()
        };
        let candidates = self.candidates.as_ref().map(all);
        let found = OptimizeAnswer::of_platform(design, &self.problem, &self.report, found, written);
        let status = self.status();
        let optimality = found.optimality.filter(|_| status == OptimizeWord::BestFound);
        OptimizeAnswer {
            status,
            optimality,
            freedoms: self.freedoms(design),
            symmetry: self.symmetry.map(SymmetryRecord::from),
            drive_search: self.drive_search(),
            candidates,
            ..found
        }
    }

    /// The platform to write: the one found, or the one that comes nearest.
    pub(super) fn platform(&self) -> Option<&Design> {
        self.checked.as_ref().or(self.nearest.as_ref()).map(|c| &c.design)
    }
}

/// A problem that cannot be asked, with what could be asked instead.
pub(super) fn refusal(why: &InvalidProblem) -> Failure {
    let failed = |code| Failure::refused(code, why.to_string());
    match why {
        InvalidProblem::NotOctahedral(_) => failed("optimize::not_octahedral").with_help(format!(
            "for other designs set variables = [\"components\"] in [optimize] (legs move in their families of replaceable legs), \
             [\"triangle_sizes\"] (sizes of base and platform), or \"home_height\", \"joint_axes\"; {NEAREST} {GENERAL}"
        )),
        InvalidProblem::NoFamily => failed("optimize::invalid_problem").with_help(format!(
            "variables = [\"triangle_sizes\"] (sizes of base and platform), [\"home_height\"] or [\"joint_axes\"] in [optimize] need no family, \
             and make other platforms than equivalent ones; {NEAREST} {GENERAL}"
        )),
        _ => failed("optimize::invalid_problem"),
    }
}

/// Threads, seed and limit of time of the command line.
pub(super) fn options(args: &super::Args, context: &Context, interrupt: &Interrupt) -> ShapeSearchOptions {
    ShapeSearchOptions {
        seed: context.seed(),
        threads: super::workers(args.threads),
        until: interrupt.until(),
        ..ShapeSearchOptions::default()
    }
}

/// Why a search could not be asked or its answer not be judged.
pub(super) fn failed(why: Error) -> Failure {
    match why {
        Error::DimensionalProblem(why) => refusal(&why),
        Error::Verify(why) => failure_of(&why),
        other => Failure::internal(other.to_string()),
    }
}

/// Optimises and checks, with the drives of a table where there is one; `progress` is told how far the search is. `explains`: as in [`find_platform`].
pub(in crate::app::cli::commands) fn search(
    design: &Design,
    table: Option<&DriveTable>,
    extension: f64,
    (options, explains): (&ShapeSearchOptions, bool),
    progress: &mut dyn FnMut(Option<&Drive>, Progress) -> ControlFlow<()>,
) -> Result<Done, Failure> {
    let Some(table) = table else {
        let found = find_platform(design, extension, options, explains, &mut |p| progress(None, p));
        return Ok(Done::of(found.map_err(failed)?, None));
    };
    let search =
        search_drives(design, &table.drives, extension, options, &mut |drive, p| progress(Some(drive), p))
            .map_err(failed)?;
    // a table has a drive, and the first to be tried is searched
    let Some(answer) = search.answer().cloned() else {
        return Err(Failure::internal("no drive was searched"));
    };
    let choice = DriveChoice { search, currency: table.currency.clone(), driven: answer.design };
    Ok(Done::of(answer.found, Some(choice)))
}

/// Where nothing was found: the searches with one more freedom each, their platforms written into a folder where one is given.
pub(in crate::app::cli::commands) fn open_freedoms(
    done: &mut Done,
    design: &Design,
    extension: f64,
    options: ShapeSearchOptions,
    keep: KeepOpened<'_>,
    progress: &mut dyn FnMut(ConflictFreedom, Progress) -> ControlFlow<()>,
) -> Result<(), Failure> {
    if done.checked.is_some() || done.status() == OptimizeWord::Interrupted {
        return Ok(());
    }
    let design = done.asked(design);
    let search = FreedomSearch { design, extension, report: &done.report, options, progress };
    let opened = search.run().map_err(|e| failure_of(&e))?;
    done.freedoms = Some(keep_opened(opened, keep)?);
    Ok(())
}

/// Judges the other local optima as the answer was judged, and writes all of them, the answer first, into a folder; the paths of the others.
fn write_candidates(
    done: &mut Done,
    design: &Design,
    options: &ShapeSearchOptions,
    folder: &Path,
) -> Result<Vec<String>, Failure> {
    let design = done.asked(design);
    let of = |s: &DimensionalSolution| {
        checked(design, &done.problem, s, options.into()).map_err(|e| failure_of(&e))
    };
    let mut others = done.report.others.iter().map(of).collect::<Result<Vec<Checked>, Failure>>()?;
    files::make_folder(folder)?;
    let path = |k: usize| folder.join(format!("candidate-{k}.toml"));
    if let Some(found) = &done.checked {
        files::write_design(&path(1), &found.design)?;
    }
    let mut paths = Vec::with_capacity(others.len());
    for (k, other) in others.iter_mut().enumerate() {
        other.design.name = format!("{}, candidate {}", other.design.name, k + 2);
        files::write_design(&path(k + 2), &other.design)?;
        paths.push(path(k + 2).display().to_string());
    }
    done.candidates = Some(others);
    Ok(paths)
}

/// The file of the platform that a freedom led to.
pub(in crate::app::cli::commands) fn opened_file(freedom: ConflictFreedom) -> String {
    format!("with-{}.toml", freedom.name())
}

/// Keeps a design under the name of a file, and gives its path where it does.
pub(in crate::app::cli::commands) type KeepOpened<'a> =
    &'a mut dyn FnMut(&str, &Design) -> Result<Option<String>, Failure>;

/// Keeps the platforms that other freedoms led to, each with its path.
fn keep_opened(
    opened: Vec<OpenedFreedom>,
    keep: KeepOpened<'_>,
) -> Result<Vec<(OpenedFreedom, Option<String>)>, Failure> {
    let kept = |f: OpenedFreedom| -> Result<(OpenedFreedom, Option<String>), Failure> {
        let found = match &f.outcome {
            FreedomOutcome::Resolved(c) | FreedomOutcome::Undecided(c) => Some(&c.design),
            FreedomOutcome::Unresolved | FreedomOutcome::NotTried => None,
        };
        let path = found.map(|design| keep(&opened_file(f.freedom), design)).transpose()?.flatten();
        Ok((f, path))
    };
    opened.into_iter().map(kept).collect()
}

/// The search with the options of the command.
pub(super) fn run(design: &Design, args: &super::Args, context: &Context) -> Result<Done, Failure> {
    let (mut progress, interrupt) =
        (ProgressLine::new(context.quiet()), Interrupt::watch_for(args.time_limit));
    let table = drives::asked(args.drives.as_deref(), &args.design, design, context)?;
    let options = options(args, context, &interrupt);
    let mut done = search(design, table.as_ref(), args.extension, (&options, true), &mut |drive, p| {
        let with = drive.map_or_else(String::new, |d| format!("{}: ", d.name));
        progress.note(&format!("{with}{p}"));
        interrupt.flow()
    })?;
    let mut write = |name: &str, design: &Design| -> Result<Option<String>, Failure> {
        let Some(folder) = args.candidates.as_deref() else { return Ok(None) };
        files::make_folder(folder)?;
        let path = folder.join(name);
        files::write_design(&path, design)?;
        Ok(Some(path.display().to_string()))
    };
    open_freedoms(&mut done, design, args.extension, options, &mut write, &mut |freedom, p| {
        progress.note(&format!("with {} open: {p}", freedom.name()));
        interrupt.flow()
    })?;
    if let Some(folder) = &args.candidates {
        progress.note("other local optima are judged");
        done.candidate_paths = write_candidates(&mut done, design, &options, folder)?;
    }
    progress.end();
    Ok(done)
}
