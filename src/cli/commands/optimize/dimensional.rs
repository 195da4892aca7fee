//! `equipod optimize` for designs that ask for more than the offsets with the best conditioning.

use std::ops::ControlFlow;
use std::path::Path;

use crate::cli::commands::verify::failure_of;
use crate::cli::commands::{GENERAL, NEAREST};
use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::cli::progress::{Interrupt, ProgressLine};
use crate::design::Design;
use crate::dimensional::{
    DimensionalProblem, DimensionalReport, DimensionalSolution, InvalidProblem, Progress, ShapeSearchOptions,
    optimize,
};
use crate::entrance::freedoms::{FreedomOutcome, FreedomSearch, OpenedFreedom};
use crate::entrance::optimizing::{Checked, checked, dimensional_problem};
use crate::records::{DimensionalAnswer, DimensionalStatus, FreedomRecord, OptimumRecord};

/// What was asked and what came out.
#[derive(Debug)]
pub(in crate::cli::commands) struct Done {
    pub(in crate::cli::commands) problem: DimensionalProblem,
    pub(in crate::cli::commands) report: DimensionalReport,
    pub(in crate::cli::commands) checked: Option<Checked>,
    /// The platform that misses the requirements least, where none that meets them was found.
    pub(in crate::cli::commands) nearest: Option<Checked>,
    /// The other local optima, where they were asked for.
    candidates: Option<Vec<Checked>>,
    /// Their files.
    candidate_paths: Vec<String>,
    /// What other freedoms came to, where nothing that meets the requirements was found, with the files of the platforms.
    freedoms: Option<Vec<(OpenedFreedom, Option<String>)>>,
}

impl Done {
    /// The answer about it.
    pub(in crate::cli::commands) fn record(
        &self,
        design: &Design,
        written: Option<&str>,
    ) -> DimensionalAnswer {
        let found = self.checked.as_ref().or(self.nearest.as_ref());
        let of = |((s, c), path): ((&DimensionalSolution, &Checked), &String)| {
            OptimumRecord::new(design, s, c, Some(path))
        };
        let all = |list: &Vec<Checked>| {
            self.report.others.iter().zip(list).zip(&self.candidate_paths).map(of).collect()
        };
        let candidates = self.candidates.as_ref().map(all);
        let opened = |list: &Vec<(OpenedFreedom, Option<String>)>| {
            list.iter().map(|(f, path)| FreedomRecord::new(design, f, path.as_deref())).collect()
        };
        let freedoms = self.freedoms.as_ref().map(opened);
        DimensionalAnswer {
            freedoms,
            candidates,
            ..DimensionalAnswer::new(design, &self.report, found, written)
        }
    }

    /// The platform to write: the one found, or the one that comes nearest.
    pub(super) fn platform(&self) -> Option<&Design> {
        self.checked.as_ref().or(self.nearest.as_ref()).map(|c| &c.design)
    }
}

/// What the status means for the exit code.
pub(in crate::cli::commands) fn exit_of(status: DimensionalStatus) -> Exit {
    match status {
        DimensionalStatus::Optimal => Exit::Yes,
        DimensionalStatus::Infeasible | DimensionalStatus::Violated => Exit::No,
        DimensionalStatus::Feasible | DimensionalStatus::Undecided | DimensionalStatus::Interrupted => {
            Exit::Inconclusive
        }
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

/// Threads and seed of the command line.
pub(super) fn options(args: &super::Args, context: &Context) -> ShapeSearchOptions {
    ShapeSearchOptions {
        seed: context.seed(),
        threads: super::workers(args.threads),
        ..ShapeSearchOptions::default()
    }
}

/// Optimises and checks; `progress` is told how far the search is.
pub(in crate::cli::commands) fn search(
    design: &Design,
    extension: f64,
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Done, Failure> {
    let problem = dimensional_problem(design, extension);
    let report = optimize(&problem, &[], options, progress).map_err(|why| refusal(&why))?;
    let of = |s: &DimensionalSolution| checked(design, &problem, s, options.seed).map_err(|e| failure_of(&e));
    let found = report.solution().map(of).transpose()?;
    let nearest = report.nearest.as_deref().map(of).transpose()?;
    let (candidates, candidate_paths, freedoms) = (None, Vec::new(), None);
    Ok(Done { checked: found, nearest, problem, report, candidates, candidate_paths, freedoms })
}

/// Judges the other local optima as the answer was judged, and writes all of them, the answer first, into a folder; the paths of the others.
fn write_candidates(
    done: &mut Done,
    design: &Design,
    seed: u64,
    folder: &Path,
) -> Result<Vec<String>, Failure> {
    let of = |s: &DimensionalSolution| checked(design, &done.problem, s, seed).map_err(|e| failure_of(&e));
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

/// Writes the platforms that other freedoms led to into a folder, where one is given; each with its path.
fn write_opened(
    opened: Vec<OpenedFreedom>,
    folder: Option<&Path>,
) -> Result<Vec<(OpenedFreedom, Option<String>)>, Failure> {
    let write = |f: OpenedFreedom| -> Result<(OpenedFreedom, Option<String>), Failure> {
        let found = match &f.outcome {
            FreedomOutcome::Resolved(c) | FreedomOutcome::Undecided(c) => Some(&c.design),
            FreedomOutcome::Unresolved | FreedomOutcome::NotTried => None,
        };
        let (Some(folder), Some(design)) = (folder, found) else { return Ok((f, None)) };
        files::make_folder(folder)?;
        let path = folder.join(format!("with-{}.toml", f.freedom.name()));
        files::write_design(&path, design)?;
        let shown = path.display().to_string();
        Ok((f, Some(shown)))
    };
    opened.into_iter().map(write).collect()
}

/// The search with the options of the command.
pub(super) fn run(design: &Design, args: &super::Args, context: &Context) -> Result<Done, Failure> {
    let (mut progress, interrupt) =
        (ProgressLine::new(context.quiet()), Interrupt::watch_for(args.time_limit));
    let mut done = search(design, args.extension, &options(args, context), &mut |p| {
        progress.note(&p.to_string());
        interrupt.flow()
    })?;
    // nothing was found, and what there is of it misses requirements
    if done.checked.is_none() && !done.report.interrupted {
        let search = FreedomSearch {
            design,
            extension: args.extension,
            report: &done.report,
            options: options(args, context),
            progress: &mut |freedom, p| {
                progress.note(&format!("with {} open: {p}", freedom.name()));
                interrupt.flow()
            },
        };
        let opened = search.run().map_err(|e| failure_of(&e))?;
        done.freedoms = Some(write_opened(opened, args.candidates.as_deref())?);
    }
    if let Some(folder) = &args.candidates {
        progress.note("other local optima are judged");
        done.candidate_paths = write_candidates(&mut done, design, context.seed(), folder)?;
    }
    progress.end();
    Ok(done)
}
