//! `--history FILE`: the steps of the run that found the answer, as a picture or a table.

use std::path::Path;

use crate::app::cli::{Failure, files};
use ::files::plot::{SearchStep, StepsFigure, steps_chart};
use ask::{OptimizeEvidence, OptimizeReport};
use optimize::dimensional::HistoryStep;

/// A step with its trust radius.
type Row = (SearchStep, f64);

/// Writes the steps of the run, if there is one: `.svg` a picture, anything else CSV.
pub(super) fn write(path: &Path, found: &OptimizeReport) -> Result<(), Failure> {
    let Some((quantity, rows)) = steps(found) else { return Ok(()) };
    let is_picture = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg"));
    let text = if is_picture { picture(&found.asked.name, quantity, &rows) } else { table(&rows) };
    files::write_text(path, &text)
}

/// The quantity that was optimised, and the steps of the run.
fn steps(found: &OptimizeReport) -> Option<(&'static str, Vec<Row>)> {
    let of = |h: &HistoryStep| {
        (SearchStep { value: h.gain, violation: h.violation, accepted: h.accepted }, h.radius)
    };
    match &found.evidence {
        OptimizeEvidence::Offsets(f) => {
            let history = &f.report.solution()?.history;
            Some(("worst inverse condition number", history.iter().map(of).collect()))
        }
        OptimizeEvidence::Dimensions(f) => {
            let history = &f.report.solution().or(f.report.nearest.as_deref())?.history;
            Some(("sum of the weighted objectives", history.iter().map(of).collect()))
        }
        OptimizeEvidence::Front(_) => None,
    }
}

fn picture(name: &str, quantity: &str, rows: &[Row]) -> String {
    steps_chart(&StepsFigure {
        title: format!("{name}: the run that found the answer"),
        quantity: quantity.into(),
        note: format!("equipod {}", env!("CARGO_PKG_VERSION")),
        steps: rows.iter().map(|r| r.0).collect(),
    })
}

fn table(rows: &[Row]) -> String {
    let line = |(k, (s, radius)): (usize, &Row)| {
        format!("{},{},{},{radius},{}\n", k + 1, s.value, s.violation, s.accepted)
    };
    let body: String = rows.iter().enumerate().map(line).collect();
    format!("step,objective,violation,radius,accepted\n{body}")
}
