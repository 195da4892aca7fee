//! `equipod optimize` with `mode = "pareto"`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use super::dimensional::{Checked, checked, options, problem, refusal, words};
use super::dimensional_text::{conflict_json, conflict_text, solution_json, unit};
use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::{Answer, number};
use crate::cli::progress::{Interrupt, Progress};
use crate::design::Design;
use crate::dimensional::{DimensionalOutcome, ParetoReport, pareto};

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
    let problem = problem(design, args.extension);
    let options = options(args, context);
    let (mut progress, interrupt) = (Progress::new(context.quiet()), Interrupt::watch());
    let report = pareto(&problem, points, &options, &mut |p| {
        progress.note(&words(&p));
        interrupt.flow()
    })
    .map_err(|why| refusal(&why))?;
    progress.end();
    let mut members = Vec::new();
    let mut written = Vec::new();
    for (k, point) in report.front.iter().enumerate() {
        let member = checked(design, &problem, &point.solution, context.seed())?;
        let path = args.output.as_deref().map(|p| numbered(p, k));
        written.push(super::write(path.as_deref(), Some(&member.design))?);
        members.push(member);
    }
    let met = members.iter().all(|c| c.assessment.all_met());
    let (status, exit) = verdict(&report, met);
    let mut json = Map::new();
    json.insert("status".into(), json!(status));
    json.insert("front".into(), front_json(design, &report, &members, &written));
    json.insert("dominated".into(), json!(report.dominated));
    json.insert("unmet".into(), json!(report.unmet));
    if let Some(DimensionalOutcome::Infeasible(c)) = &report.failure {
        json.insert("conflict".into(), conflict_json(design, c));
    }
    json.insert("seed".into(), json!(context.seed()));
    Ok(Answer::new(exit, json, text(design, status, &report, &members, &written)))
}

/// Status and exit code; `met` when all members meet their requirements.
fn verdict(report: &ParetoReport, met: bool) -> (&'static str, Exit) {
    match &report.failure {
        _ if report.interrupted => ("interrupted", Exit::Inconclusive),
        Some(DimensionalOutcome::Infeasible(_)) => ("infeasible", Exit::No),
        None if met => ("front", Exit::Yes),
        _ => ("undecided", Exit::Inconclusive),
    }
}

fn front_json(design: &Design, r: &ParetoReport, members: &[Checked], written: &[Option<String>]) -> Value {
    let member = |(k, c): (usize, &Checked)| {
        let mut fields = Map::new();
        solution_json(&mut fields, design, &r.front[k].solution, c);
        fields.remove("history");
        let own = serde_json::from_str::<Value>(&c.design.to_json()).unwrap_or(Value::Null);
        fields.insert("design".into(), own);
        fields.insert("output".into(), json!(written[k]));
        fields.insert("non_dominated_at".into(), r.front[k].dense.iter().map(|x| number(*x)).collect());
        Value::Object(fields)
    };
    members.iter().enumerate().map(member).collect()
}

fn text(
    design: &Design,
    status: &str,
    r: &ParetoReport,
    members: &[Checked],
    written: &[Option<String>],
) -> String {
    let mut out = format!("{}: {status}\n", design.name);
    if r.interrupted {
        out.push_str("the front as far as it was found; runs that were not finished may be improved\n");
    }
    // writing to a string cannot fail
    let _ = writeln!(
        out,
        "{} platforms of which none is better in every objective; {} dominated or equal ones left out, {} bounds not met",
        r.front.len(),
        r.dominated,
        r.unmet
    );
    for (k, c) in members.iter().enumerate() {
        let values = c.objectives.iter().map(|(o, x)| format!("{} {x:.6} {}", o.code(), unit(design, *o)));
        let met = if c.assessment.all_met() { "" } else { "  (violates requirements)" };
        let path = written[k].as_ref().map_or_else(String::new, |p| format!("  {p}"));
        let _ = writeln!(out, "  {:>3}  {}{met}{path}", k + 1, values.collect::<Vec<_>>().join("  "));
    }
    if let Some(DimensionalOutcome::Infeasible(c)) = &r.failure {
        conflict_text(&mut out, design, c);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, parse};

    #[test]
    fn an_interrupted_front_is_not_called_complete() {
        let text = std::fs::read_to_string("designs/worked/isolator-octahedral.toml").unwrap();
        let (design, _) = parse(&text, Format::Toml).unwrap();
        let mut report =
            ParetoReport { front: Vec::new(), dominated: 0, unmet: 0, failure: None, interrupted: true };
        let said = verdict(&report, true);
        assert_eq!(said, ("interrupted", Exit::Inconclusive));
        assert!(text_of(&design, said.0, &report).contains("as far as it was found"));
        report.interrupted = false;
        assert_eq!(verdict(&report, true), ("front", Exit::Yes));
        assert_eq!(verdict(&report, false), ("undecided", Exit::Inconclusive));
        assert!(!text_of(&design, "front", &report).contains("as far as it was found"));
    }

    fn text_of(design: &Design, status: &str, report: &ParetoReport) -> String {
        super::text(design, status, report, &[], &[])
    }
}
