//! Poses as matrices on several lines, or column by column.

use super::InvalidSeries;
use crate::design::table::sheet::{CellTable, SheetRow};
use platform::geom::is_by_columns;

/// Numbers of a row of `(R p)`.
const WIDTH: usize = 4;

/// Joins the lines of matrices to one row for each pose, and turns matrices that stand column by column.
///
/// # Errors
/// Matrices without positions, lines that are no whole matrices, and matrices whose rows and columns cannot be told
/// apart.
pub(super) fn to_rows(sheet: &mut CellTable, guesses: &mut Vec<String>) -> Result<(), InvalidSeries> {
    if let Some(rows) = lines_of_matrices(sheet)? {
        guesses.push(format!(
            "Each pose is a matrix of {} lines, the rotation and the position behind it.",
            if rows[0].cells.len() == WIDTH * WIDTH { "four" } else { "three" }
        ));
        sheet.rows = rows;
        sheet.header = None;
        let turned = by_columns(sheet);
        if turned.contains(&Some(true)) && !turned.contains(&Some(false)) {
            guesses.push("The matrices are transposed: the position is in the last line.".into());
            transpose(sheet);
        }
        return Ok(());
    }
    if sheet.header.is_some() {
        return Ok(());
    }
    let turned = by_columns(sheet);
    if turned.contains(&Some(true)) && !turned.contains(&Some(false)) {
        guesses.push("The matrices of sixteen numbers stand column by column.".into());
        transpose(sheet);
    } else if !turned.is_empty() && turned.iter().all(Option::is_none) && !are_symmetric(sheet) {
        return Err(InvalidSeries::Matrices(
            "the matrices of sixteen numbers have no position, so that rows and columns cannot be told apart"
                .into(),
        ));
    }
    Ok(())
}

/// The matrices of lines with four numbers, each in one row; `None` for other tables.
fn lines_of_matrices(sheet: &CellTable) -> Result<Option<Vec<SheetRow>>, InvalidSeries> {
    let (mut factor, mut alone) = (1.0, None);
    let mut lines: Vec<(usize, Vec<String>)> = Vec::new();
    for row in &sheet.rows {
        let count = row.cells.iter().filter(|cell| sheet.number(cell).is_some()).count();
        if let Some(found) = sheet.factor(row) {
            factor = found;
        } else if count == row.cells.len() && count > 1 {
            lines.push((row.line, row.cells.iter().map(|cell| sheet.scaled(cell, factor)).collect()));
        } else if count > 1 {
            return Ok(None);
        } else if row.cells.len() == count {
            alone = alone.or(Some(row.line));
        }
    }
    let width = lines.first().map_or(0, |(_, cells)| cells.len());
    if lines.len() < 3 || lines.iter().any(|(_, cells)| cells.len() != width) {
        return Ok(None);
    }
    if width == 3 && lines.len().is_multiple_of(3) {
        return Err(InvalidSeries::Matrices(
            "the lines of three numbers are rotation matrices without positions, or positions without rotations".into(),
        ));
    }
    if width != WIDTH {
        return Ok(None);
    }
    if let Some(line) = alone {
        let message = format!("line {line} has one number among matrices with lines of four");
        return Err(InvalidSeries::Matrices(message));
    }
    let is_last =
        |cells: &[String]| cells.iter().map(|cell| sheet.number(cell)).eq([0.0, 0.0, 0.0, 1.0].map(Some));
    let ends_in_one = |block: &[(usize, Vec<String>)]| {
        let last: Vec<Option<f64>> = block.iter().map(|(_, cells)| sheet.number(&cells[3])).collect();
        last.iter().copied().eq([0.0, 0.0, 0.0, 1.0].map(Some))
    };
    let four = lines.len().is_multiple_of(4)
        && lines.chunks(4).all(|block| is_last(&block[3].1) || ends_in_one(block));
    let height = if four { 4 } else { 3 };
    if !four && (!lines.len().is_multiple_of(3) || lines.iter().any(|(_, cells)| is_last(cells))) {
        return Err(InvalidSeries::Matrices(format!(
            "the {} lines of four numbers are neither 4 x 4 matrices, whose last line is 0 0 0 1, nor 3 x 4 matrices",
            lines.len()
        )));
    }
    let joined = lines.chunks(height).map(|block| SheetRow {
        line: block[0].0,
        cells: block.iter().flat_map(|(_, cells)| cells.iter().cloned()).collect(),
    });
    Ok(Some(joined.collect()))
}

/// The sixteen numbers of a row, if it has as many.
fn sixteen(sheet: &CellTable, row: &SheetRow) -> Option<[f64; 16]> {
    row.cells.iter().map(|cell| sheet.number(cell)).collect::<Option<Vec<f64>>>()?.try_into().ok()
}

/// For each row of sixteen numbers whether it is a matrix column by column.
fn by_columns(sheet: &CellTable) -> Vec<Option<bool>> {
    sheet.rows.iter().filter_map(|row| sixteen(sheet, row)).map(|numbers| is_by_columns(&numbers)).collect()
}

fn are_symmetric(sheet: &CellTable) -> bool {
    let same =
        |numbers: [f64; 16]| (0..16).all(|k| numbers[k].to_bits() == numbers[k % 4 * 4 + k / 4].to_bits());
    sheet.rows.iter().filter_map(|row| sixteen(sheet, row)).all(same)
}

fn transpose(sheet: &mut CellTable) {
    for row in &mut sheet.rows {
        if row.cells.len() == WIDTH * WIDTH {
            row.cells =
                (0..WIDTH * WIDTH).map(|k| row.cells[k % WIDTH * WIDTH + k / WIDTH].clone()).collect();
        }
    }
}
