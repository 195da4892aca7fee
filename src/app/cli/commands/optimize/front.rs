//! `equipod optimize` with `mode = "pareto"`.

use std::path::{Path, PathBuf};

use super::dimensional::{failed, options};
use crate::app::Design;
use crate::app::cli::commands::verify::failure_of;
use crate::app::cli::context::Context;
use crate::app::cli::failure::Failure;
use crate::app::cli::output::Answer;
use crate::app::cli::progress::{Interrupt, ProgressLine};
use crate::app::entrance::freedoms::{FreedomSearch, OpenedFreedom};
use crate::app::entrance::optimizing::dimensional_problem;
use crate::app::entrance::platform_search::{FoundFront, find_front};
use crate::app::records::{FreedomRecord, OptimizeAnswer, SymmetryRecord};

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
    let (mut progress, interrupt) =
        (ProgressLine::new(context.quiet()), Interrupt::watch_for(args.time_limit));
    let options = options(args, context, &interrupt);
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
    let problem = dimensional_problem(design, args.extension);
    let record = OptimizeAnswer {
        freedoms: opened.map(|list| list.iter().map(of_freedom).collect()),
        symmetry: symmetry.map(SymmetryRecord::from),
        ..OptimizeAnswer::of_front(design, &problem, &report, &members, &written)
    };
    Ok(super::answered(design, record, context))
}

#[cfg(test)]
mod tests {
    use super::super::exit_of;
    use super::super::render::text;
    use super::*;
    use crate::app::cli::exit::Exit;
    use crate::app::design::parse;
    use crate::app::records::OptimizeWord;
    use files::design::Format;
    use optimize::dimensional::ParetoReport;

    #[test]
    fn an_interrupted_front_is_not_called_complete() {
        let file = std::fs::read_to_string("designs/worked/isolator-octahedral.toml").unwrap();
        let (design, _) = parse(&file, Format::Toml).unwrap();
        let mut report =
            ParetoReport { front: Vec::new(), dominated: 0, unmet: 0, failure: None, interrupted: true };
        let problem = dimensional_problem(&design, 1.0);
        let word = |report: &ParetoReport, met| {
            let word = OptimizeWord::of_front(report, met);
            (word.as_str(), exit_of(word))
        };
        let said = |report: &ParetoReport| {
            let answer = OptimizeAnswer::of_front(&design, &problem, report, &[], &[]);
            (answer.status.as_str(), text(&design.name, &answer).contains("as far as it was found"))
        };
        assert_eq!(word(&report, true), ("interrupted", Exit::Inconclusive));
        assert_eq!(said(&report), ("interrupted", true));
        report.interrupted = false;
        assert_eq!(word(&report, true), ("front", Exit::Yes));
        assert_eq!(word(&report, false), ("undecided", Exit::Inconclusive));
        assert_eq!(said(&report), ("front", false));
    }
}
