//! Tables whose rows are legs and whose columns are instants, turned so that rows are instants.

use super::names::{is_time, numbered_columns, numbered_name};
use crate::design::table::header::plain;
use crate::design::table::sheet::{CellTable, SheetRow};

/// Turns a table with one row for each of six legs, and perhaps one of times, which are named at the left.
pub(super) fn turn(sheet: &mut CellTable, words: &[&str], guesses: &mut Vec<String>) {
    let names = |labels: &[&String]| -> Vec<String> {
        labels.iter().map(|label| plain(&numbered_name(label))).collect()
    };
    let labels: Vec<&String> = sheet.rows.iter().filter_map(|row| row.cells.first()).collect();
    let plain_names = names(&labels);
    let others = plain_names.iter().filter(|name| !is_time(name)).count();
    let width = sheet.rows.first().map_or(0, |row| row.cells.len());
    let has_numbers = |row: &SheetRow| {
        row.cells.len() == width && row.cells.iter().skip(1).all(|cell| sheet.number(cell).is_some())
    };
    if others != 6 || numbered_columns(&plain_names, words).is_none() || !sheet.rows.iter().all(has_numbers) {
        return;
    }
    let header: Vec<String> = labels.into_iter().cloned().collect();
    let row = |k: usize| SheetRow {
        line: sheet.rows[0].line,
        cells: sheet.rows.iter().map(|row| row.cells[k].clone()).collect(),
    };
    let rows: Vec<SheetRow> = (1..width).map(row).collect();
    guesses.push("Each row is a leg, and each column an instant.".into());
    (sheet.header, sheet.rows) = (Some(header), rows);
}
