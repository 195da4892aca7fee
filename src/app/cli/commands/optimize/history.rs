//! `--history FILE`: the steps of the run that found the answer, as a picture or a table.

use std::path::Path;

use crate::app::Design;
use crate::app::cli::failure::Failure;
use crate::app::cli::files;
use ::files::plot::{SearchStep, StepsFigure, steps_chart};

/// A step with its trust radius.
pub(super) type Row = (SearchStep, f64);

/// Writes the steps: `.svg` a picture, anything else CSV.
pub(super) fn write(path: &Path, design: &Design, quantity: &str, rows: &[Row]) -> Result<(), Failure> {
    let is_picture = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg"));
    let text = if is_picture { picture(design, quantity, rows) } else { table(rows) };
    files::write_text(path, &text)
}

fn picture(design: &Design, quantity: &str, rows: &[Row]) -> String {
    steps_chart(&StepsFigure {
        title: format!("{}: the run that found the answer", design.name),
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
