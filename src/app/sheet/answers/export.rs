//! The sizes of the parts of exported files.

use super::assess::assumed;
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::ExportAnswer;

/// The sizes in the answer of `export`, with their origin, and what is assumed.
#[must_use]
pub fn export(answer: &ExportAnswer) -> Sheet {
    let mut out = Sheet::new();
    out.space();
    let columns = [left("size", 0), right("value", 0).gap(2), left("unit", 0), left("from", 0).gap(2)];
    let label = |unit: &str| if unit == "design units" { answer.design_unit.label } else { unit }.to_owned();
    let rows = answer.sizes.iter();
    let rows = rows.map(|c| [c.what.clone(), figure(c.value), label(c.unit), c.from.to_owned()]);
    out.table(Table::new(columns).with_rows(rows));
    let assessed = answer.assessment.iter().flat_map(|found| &found.assumptions);
    let all: Vec<String> = answer.assumptions.iter().chain(assessed).cloned().collect();
    out.add(assumed(&all));
    out
}
