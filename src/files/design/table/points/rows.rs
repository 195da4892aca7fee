//! The rows with numbers, and what the titles above them say.

use nalgebra::Point3;

use super::columns::{CoordinateColumns, unit_of};
use super::words::{axis_of, bodies_of_words, body_of_word, told_apart};
use super::{InvalidPointTable, LEAST_NUMBERS};
use crate::design::keys::LARGEST;
use crate::design::table::header::{length_unit, plain, units_in_title};
use crate::design::table::sheet::{CellTable, SheetRow};
use platform::manipulator::Body;

/// A row with numbers, and what the titles above it say.
pub(super) struct PointRow<'a> {
    pub(super) row: &'a SheetRow,
    pub(super) body: Option<Body>,
    /// Factor of its numbers, as MATLAB prints it above a matrix.
    pub(super) scale: f64,
}

/// The rows with numbers; rows of words are titles of a body, or a repeated header.
pub(super) fn data_rows<'a>(
    sheet: &'a CellTable,
    guesses: &mut Vec<String>,
) -> Result<Vec<PointRow<'a>>, InvalidPointTable> {
    let mut body = None;
    let mut scale = 1.0;
    let mut rows = Vec::new();
    // titles that name a matrix, such as `B =`, and the number of rows above them
    let mut matrices: Vec<(String, usize)> = Vec::new();
    for row in &sheet.rows {
        let numbers = row.cells.iter().filter(|c| sheet.number(c).is_some()).count();
        if numbers >= LEAST_NUMBERS {
            rows.push(PointRow { row, body, scale });
            continue;
        }
        let title = row.cells.join(" ");
        if let Some(factor) = sheet.factor(row) {
            guesses.push(format!("Line {}, `{title}`, is a factor of the numbers below it.", row.line));
            scale = factor;
            continue;
        }
        if numbers == 0 && !rows.is_empty() {
            same_unit(sheet, row)?;
        }
        // `[base]` is a section of settings
        let bare = |cell: &String| plain(cell.trim_matches(|c| "[]".contains(c)));
        let named = row.cells.iter().find_map(|c| body_of_word(&bare(c)));
        let coordinates = row.cells.iter().filter(|c| axis_of(&plain(c)).is_some()).count();
        let matrix = title.strip_suffix('=').or(title.strip_suffix(':')).map(str::trim);
        match (named, matrix) {
            // the names of the columns again
            _ if numbers == 0 && coordinates >= LEAST_NUMBERS => {}
            (Some(said), _) if numbers == 0 => {
                (body, scale) = (Some(said), 1.0);
                guesses.push(format!(
                    "Line {}, `{title}`, says that the rows below it are of the {said}.",
                    row.line
                ));
            }
            (_, Some(name)) if numbers == 0 => {
                scale = 1.0;
                matrices.push((name.to_owned(), rows.len()));
            }
            _ if numbers == 0 && (rows.is_empty() || row.cells.len() == 1) => {
                guesses.push(format!("Line {}, `{title}`, has no numbers and is passed over.", row.line));
            }
            _ => {
                let message = format!("line {}, `{title}`, has fewer than two numbers", row.line);
                return Err(InvalidPointTable::Form(message));
            }
        }
    }
    if let [(first, 0), (second, 6)] = &matrices[..]
        && rows.iter().all(|row| row.body.is_none())
        && rows.len() == 12
    {
        let order = bodies_of_words(&plain(first), &plain(second), &mut Vec::new());
        guesses.push(told_apart([first, second], order));
        for (k, row) in rows.iter_mut().enumerate() {
            row.body = Some(order[k / 6]);
        }
    }
    Ok(rows)
}

/// Refuses a title below numbers that states another unit than theirs.
fn same_unit(sheet: &CellTable, title: &SheetRow) -> Result<(), InvalidPointTable> {
    let names = title.cells.iter().filter(|cell| axis_of(&plain(cell)).is_some());
    let text = title.cells.join(" ");
    let Some(stated) =
        units_in_title(&text).0.or_else(|| names.into_iter().find_map(|name| length_unit(name)))
    else {
        return Ok(());
    };
    let above = sheet.header.as_ref().map_or(Ok(None), |header| unit_of(header))?.or(sheet.length_unit);
    if above == Some(stated) {
        return Ok(());
    }
    let above = above.map_or_else(|| "have no unit".into(), |unit| format!("are in {unit}"));
    Err(InvalidPointTable::Form(format!(
        "line {}, `{text}`, says {stated}, and the numbers above it {above}: write all lengths in one unit",
        title.line
    )))
}

/// The point in three columns of a row.
pub(super) fn point(
    sheet: &CellTable,
    PointRow { row, scale, .. }: &PointRow<'_>,
    (x, y, z): CoordinateColumns,
) -> Result<Point3<f64>, InvalidPointTable> {
    let value = |column: usize| {
        let cell = row.cells.get(column).map_or("", String::as_str);
        let x = sheet.number(&sheet.scaled(cell, *scale)).ok_or_else(|| not_a_number(row, column))?;
        if x.abs() < LARGEST {
            Ok(x)
        } else {
            Err(InvalidPointTable::Form(format!(
                "line {}, column {}: `{cell}` is too far out, stay below {LARGEST:e}",
                row.line,
                column + 1
            )))
        }
    };
    Ok(Point3::new(value(x)?, value(y)?, z.map_or(Ok(0.0), value)?))
}

pub(super) fn not_a_number(row: &SheetRow, column: usize) -> InvalidPointTable {
    let cell = row.cells.get(column).map_or("", String::as_str);
    InvalidPointTable::Form(format!("line {}, column {}: `{cell}` is not a number", row.line, column + 1))
}
