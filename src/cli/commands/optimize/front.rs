//! `equipod optimize` with `mode = "pareto"`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use super::dimensional::{failed, options};
use super::dimensional_text::conflict_text;
use crate::cli::commands::verify::failure_of;
use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::Answer;
use crate::cli::progress::{Interrupt, ProgressLine};
use crate::cli::requirements;
use crate::design::Design;
use crate::entrance::freedoms::{FreedomSearch, OpenedFreedom};
use crate::entrance::platform_search::{FoundFront, find_front};
use crate::records::{DesignRecord, FreedomRecord, FrontAnswer, FrontStatus, OptimizeAnswer, SymmetryRecord};

/// `out.toml` as `out-1.toml`, `out-2.toml`, ...
fn numbered(path: &Path, k: usize) -> PathBuf {
    let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    let name = match path.extension() {
        Some(e) => format!("{stem}-{}.{}", k + 1, e.to_string_lossy()),
        None => format!("{stem}-{}", k + 1),
    };
    path.with_file_name(name)
}

/// The front of a design, every member checked and, with `-o`, written.
pub(super) fn run(
    design: &Design,
    points: usize,
    args: &super::Args,
    context: &Context,
) -> Result<Answer, Failure> {
    let options = options(args, context);
    let (mut progress, interrupt) =
        (ProgressLine::new(context.quiet()), Interrupt::watch_for(args.time_limit));
    let found = find_front(design, points, args.extension, &options, &mut |p| {
        progress.note(&p.to_string());
        interrupt.flow()
    })
    .map_err(failed)?;
    let FoundFront { report, members, symmetry } = found;
    // nothing was found: which freedom resolves it is tried, as for a single platform
    let none = report.failure.as_deref().filter(|_| !report.interrupted);
    let opened = none.map(|report| {
        let search = FreedomSearch {
            design,
            extension: args.extension,
            report,
            options,
            progress: &mut |freedom, p| {
                progress.note(&format!("with {} open: {p}", freedom.name()));
                interrupt.flow()
            },
        };
        search.run().map_err(|e| failure_of(&e))
    });
    let opened = opened.transpose()?;
    progress.end();
    let mut written = Vec::new();
    for (k, member) in members.iter().enumerate() {
        let path = args.output.as_deref().map(|p| numbered(p, k));
        written.push(super::write(path.as_deref(), Some(&member.design))?);
    }
    let of_freedom = |f: &OpenedFreedom| FreedomRecord::new(design, f, None);
    let record = FrontAnswer {
        freedoms: opened.map(|list| list.iter().map(of_freedom).collect()),
        symmetry: symmetry.map(SymmetryRecord::from),
        ..FrontAnswer::new(design, &report, &members, &written)
    };
    let text = text(&design.name, &record);
    Ok(Answer::new(exit_of(record.status), OptimizeAnswer::Front(record), text))
}

/// What the status means for the exit code.
fn exit_of(status: FrontStatus) -> Exit {
    match status {
        FrontStatus::Front => Exit::Yes,
        FrontStatus::Infeasible => Exit::No,
        FrontStatus::Undecided | FrontStatus::Interrupted => Exit::Inconclusive,
    }
}

fn text(name: &str, a: &FrontAnswer) -> String {
    let mut out = format!("{name}: {}\n", a.status.as_str());
    if a.status == FrontStatus::Interrupted {
        out.push_str("the front as far as it was found; runs that were not finished may be improved\n");
    }
    // writing to a string cannot fail
    if let Some(s) = &a.symmetry {
        let _ = writeln!(out, "{}", s.message);
    }
    let _ = writeln!(
        out,
        "{} platforms of which none is better in every objective; {} dominated or equal ones left out, {} bounds not met",
        a.front.len(),
        a.dominated,
        a.unmet
    );
    for (k, member) in a.front.iter().enumerate() {
        let s = &member.solution;
        let values = s.objectives.iter().map(|o| format!("{} {:.6} {}", o.name.code(), o.value.0, o.unit));
        let met = match s.requirements_met {
            Some(true) => "",
            Some(false) => "  (violates requirements)",
            None => "  (not all requirements proved)",
        };
        let path = member.output.as_ref().map_or_else(String::new, |p| format!("  {p}"));
        let _ = writeln!(out, "  {:>3}  {}{met}{path}", k + 1, values.collect::<Vec<_>>().join("  "));
    }
    for (k, member) in a.front.iter().enumerate() {
        let found = member.design.as_ref().map_or(name, DesignRecord::name);
        let lead = requirements::lead(found, member.solution.assessment.as_ref());
        let _ = writeln!(out, "\n{}. {lead}", k + 1);
    }
    if let Some(c) = &a.conflict {
        conflict_text(&mut out, c);
    }
    for f in a.freedoms.iter().flatten() {
        let _ = writeln!(out, "{}", f.message);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, parse};
    use crate::dimensional::ParetoReport;

    #[test]
    fn an_interrupted_front_is_not_called_complete() {
        let file = std::fs::read_to_string("designs/worked/isolator-octahedral.toml").unwrap();
        let (design, _) = parse(&file, Format::Toml).unwrap();
        let mut report =
            ParetoReport { front: Vec::new(), dominated: 0, unmet: 0, failure: None, interrupted: true };
        let said = FrontStatus::of(&report, true);
        assert_eq!((said.as_str(), exit_of(said)), ("interrupted", Exit::Inconclusive));
        let answer = |report: &ParetoReport| FrontAnswer::new(&design, report, &[], &[]);
        assert_eq!(answer(&report).status, said);
        assert!(text(&design.name, &answer(&report)).contains("as far as it was found"));
        report.interrupted = false;
        let verdict = |met| FrontStatus::of(&report, met);
        assert_eq!((verdict(true).as_str(), exit_of(verdict(true))), ("front", Exit::Yes));
        assert_eq!((verdict(false).as_str(), exit_of(verdict(false))), ("undecided", Exit::Inconclusive));
        assert!(!text(&design.name, &answer(&report)).contains("as far as it was found"));
    }
}
