//! Spreadsheets of Excel and `LibreOffice` as text: the cells of one sheet, separated by tabs.

use std::fmt::Write as _;
use std::io::Cursor;

use calamine::{Data, Range, Reader, open_workbook_auto_from_rs};

use super::text::Decoded;

/// Greatest number of cells of an accepted sheet: a design has some hundreds.
const MOST_CELLS: usize = 5_000_000;

/// The first sheet that has numbers.
///
/// # Errors
/// A sentence: an invalid file, another kind of archive, no sheet with numbers, too many cells.
pub(super) fn decode(bytes: &[u8]) -> Result<Decoded, String> {
    let mut workbook = open_workbook_auto_from_rs(Cursor::new(bytes))
        .map_err(|why| format!("this is a packed file, and no spreadsheet that can be read: {why}"))?;
    let mut found: Option<(String, Range<Data>)> = None;
    let mut others = Vec::new();
    for name in workbook.sheet_names() {
        let sheet =
            workbook.worksheet_range(&name).map_err(|why| format!("the sheet `{name}` is broken: {why}"))?;
        if !sheet.used_cells().any(|(_, _, cell)| matches!(cell, Data::Float(_) | Data::Int(_))) {
            continue;
        }
        if found.is_some() {
            others.push(format!("`{name}`"));
        } else {
            found = Some((name, sheet));
        }
    }
    let Some((name, sheet)) = found else { return Err("no sheet of this spreadsheet has numbers".into()) };
    if sheet.get_size().0.saturating_mul(sheet.get_size().1) > MOST_CELLS {
        return Err(format!("the sheet `{name}` has more than {MOST_CELLS} cells"));
    }
    let mut guess = format!("The sheet `{name}` of the spreadsheet is read.");
    if !others.is_empty() {
        let _ = write!(
            guess,
            " Save another sheet as CSV to read that one: {} have numbers too.",
            others.join(", ")
        );
    }
    // empty rows above the first cell keep their place, so that line numbers are those of the spreadsheet
    let above = sheet.start().map_or(0, |(row, _)| row);
    let mut text = "\n".repeat(above.try_into().unwrap_or(0));
    for row in sheet.rows() {
        let cells: Vec<String> = row.iter().map(cell).collect();
        text.push_str(&cells.join("\t"));
        text.push('\n');
    }
    Ok(Decoded { text, guess: Some(guess) })
}

/// A number keeps all its digits; a text loses the characters that separate cells and rows.
fn cell(value: &Data) -> String {
    match value {
        Data::Empty => String::new(),
        Data::Int(n) => n.to_string(),
        Data::Float(x) => x.to_string(),
        other => other.to_string().replace(['\t', '\n', '\r', '"'], " "),
    }
}
