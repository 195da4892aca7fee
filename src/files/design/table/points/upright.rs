//! Tables whose columns are joints or legs and whose rows are coordinates, turned so that rows are joints or legs.

use super::LEAST_NUMBERS;
use super::words::{axis_of, only_number};
use crate::design::table::header::plain;
use crate::design::table::sheet::{CellTable, SheetRow};

/// Counts of columns: one for each leg, or one for each joint.
const COLUMNS: [usize; 2] = [6, 12];

/// Turns a table whose rows are coordinates, as the words at their left say or as the heights show.
pub(super) fn turn(sheet: &mut CellTable, guesses: &mut Vec<String>) {
    let named = sheet.header.as_ref().is_some_and(|header| {
        header.iter().filter(|name| axis_of(&plain(name)).is_some()).count() >= LEAST_NUMBERS
    });
    if named {
        return;
    }
    let found = labelled(sheet).or_else(|| titled(sheet)).or_else(|| by_heights(sheet));
    let Some((labels, columns)) = found else { return };
    let data: Vec<&SheetRow> = data(sheet);
    // the names of the columns are those of the legs or joints
    let heads: Option<Vec<String>> = sheet
        .header
        .as_ref()
        .and_then(|header| columns.iter().map(|c| header.get(*c).cloned()).collect::<Option<_>>());
    let numbers: Option<Vec<u64>> =
        heads.as_ref().and_then(|heads| heads.iter().map(|head| only_number(head)).collect());
    let mut header = Vec::new();
    if heads.is_some() {
        header.push(if columns.len() == 6 && numbers.is_some() { "leg" } else { "name" }.to_owned());
    }
    header.extend(labels.iter().cloned());
    let rows = columns.iter().enumerate().map(|(k, c)| {
        let head = match (&heads, &numbers) {
            (Some(_), Some(numbers)) if columns.len() == 6 => Some(numbers[k].to_string()),
            (Some(heads), _) => Some(heads[k].clone()),
            _ => None,
        };
        let values = data.iter().map(|row| row.cells.get(*c).cloned().unwrap_or_default());
        SheetRow {
            line: data.first().map_or(1, |row| row.line),
            cells: head.into_iter().chain(values).collect(),
        }
    });
    let rows: Vec<SheetRow> = rows.collect();
    guesses.push(format!(
        "The columns are {}, and the rows {} their coordinates.",
        if columns.len() == 6 { "legs" } else { "joints" },
        labels.iter().map(|label| format!("`{label}`")).collect::<Vec<_>>().join(", ")
    ));
    (sheet.header, sheet.rows) = (Some(header), rows);
}

/// The rows with numbers.
fn data(sheet: &CellTable) -> Vec<&SheetRow> {
    let numbers = |row: &&SheetRow| row.cells.iter().filter(|c| sheet.number(c).is_some()).count();
    sheet.rows.iter().filter(|row| numbers(row) >= LEAST_NUMBERS).collect()
}

/// The columns with numbers in all rows, if there are six or twelve.
fn columns_of(sheet: &CellTable, data: &[&SheetRow]) -> Option<Vec<usize>> {
    let width = data.iter().map(|row| row.cells.len()).max()?;
    let is_number = |row: &SheetRow, c: usize| row.cells.get(c).is_some_and(|x| sheet.number(x).is_some());
    let columns: Vec<usize> = (0..width).filter(|c| data.iter().all(|row| is_number(row, *c))).collect();
    COLUMNS.contains(&columns.len()).then_some(columns)
}

/// The names of the coordinates at the left of the rows; a title above them is a part of the name.
fn labelled(sheet: &CellTable) -> Option<(Vec<String>, Vec<usize>)> {
    let data = data(sheet);
    let columns = columns_of(sheet, &data)?;
    let mut labels = Vec::new();
    let mut title = String::new();
    for row in &sheet.rows {
        if data.iter().any(|found| found.line == row.line) {
            let label = row.cells.first().filter(|cell| sheet.number(cell).is_none())?;
            axis_of(&plain(label))?;
            labels.push(format!("{title} {label}").trim().to_owned());
        } else {
            title = row.cells.join(" ");
        }
    }
    Some((labels, columns))
}

/// Two matrices of two or three rows, as the titles `B =` and `P =` above them show.
fn titled(sheet: &CellTable) -> Option<(Vec<String>, Vec<usize>)> {
    let data = data(sheet);
    let columns = columns_of(sheet, &data).filter(|columns| columns.len() == 6)?;
    let mut groups: Vec<(String, usize)> = Vec::new();
    for row in &sheet.rows {
        if data.iter().any(|found| found.line == row.line) {
            groups.last_mut()?.1 += 1;
        } else if sheet.factor(row).is_none() {
            let title = row.cells.join(" ");
            groups.push((title.trim_end_matches(|c: char| " =:".contains(c)).to_owned(), 0));
        }
    }
    groups.retain(|(_, count)| *count > 0);
    let [(first, count), (second, other)] = &groups[..] else { return None };
    if count != other || !(2..=3).contains(count) {
        return None;
    }
    let axes = ["x", "y", "z"];
    let labels = [first, second]
        .into_iter()
        .flat_map(|title| axes[..*count].iter().map(move |axis| format!("{title} {axis}")));
    Some((labels.collect(), columns))
}

/// Six rows of six numbers without names: rows are coordinates if only so both bodies are flat.
fn by_heights(sheet: &CellTable) -> Option<(Vec<String>, Vec<usize>)> {
    let data = data(sheet);
    let columns = columns_of(sheet, &data)?;
    if (data.len(), columns.len()) != (6, 6) {
        return None;
    }
    let value =
        |row: usize, column: usize| data[row].cells.get(columns[column]).and_then(|c| sheet.number(c));
    let constant = |at: &dyn Fn(usize) -> Option<f64>| (1..6).all(|k| at(k) == at(0));
    let upright = [2, 5].iter().all(|c| constant(&|k| value(k, *c)));
    let lying = [2, 5].iter().all(|r| constant(&|k| value(*r, k)));
    let names = ["base x", "base y", "base z", "platform x", "platform y", "platform z"];
    (lying && !upright).then(|| (names.map(String::from).to_vec(), columns))
}
