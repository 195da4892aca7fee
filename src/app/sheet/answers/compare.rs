//! Designs side by side.

use super::assess::assumed;
use crate::figure::figure;
use crate::{Cell, Sheet, Table, Tone, left, right};
use records::{CompareAnswer, FigureCell};

/// The answer of `compare`: a line for every figure, a column for every design.
#[must_use]
pub fn compare(answer: &CompareAnswer) -> Sheet {
    let mut out = Sheet::new();
    for (k, (design, verdict)) in answer.designs.iter().zip(answer.verdicts()).enumerate() {
        say!(out, "{}: {verdict} ({})", k + 1, design.path);
    }
    let designs = (1..=answer.designs.len()).map(|k| right(k.to_string(), 12));
    let mut table = Table::new([left("figure", 34)].into_iter().chain(designs));
    for column in answer.columns() {
        let cells = column.cells.iter().map(|cell| match cell {
            None => "-".into(),
            Some(FigureCell::Word(word)) => word.as_str().into(),
            Some(FigureCell::Number(x, true)) => Cell::toned(figure(*x), Tone::No),
            Some(FigureCell::Number(x, false)) => figure(*x).into(),
        });
        table.row([column.heading().into()].into_iter().chain(cells));
    }
    out.space();
    out.table(table);
    out.space();
    say!(out, "{}", answer.yardstick());
    for design in &answer.designs {
        if let Some(why) = &design.no_tolerance {
            say!(out, "{} has no joint tolerance: {why}", design.name);
        }
    }
    for path in &answer.paths {
        say!(out, "wrote {path}");
    }
    out.add(assumed(&answer.assumptions()));
    out
}
