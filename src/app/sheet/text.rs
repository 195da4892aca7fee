//! Text for terminals.

use std::fmt::{self, Display, Write as _};

use super::{Block, Column, DIGITS, Sheet, Table, Tone};

/// The sheet as text: lines as they are, tables in columns of their widths.
impl Display for Sheet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for block in &self.rounded(f.precision().unwrap_or(DIGITS.into())).0 {
            match block {
                Block::Line(line) => writeln!(f, "{line}")?,
                Block::Space => writeln!(f)?,
                Block::Table(table) => f.write_str(&rows(table))?,
                Block::Part { title, sheet, .. } => write!(f, "{title}\n{sheet}")?,
            }
        }
        Ok(())
    }
}

/// The greatest width of a column, characters; longer cells push their row aside.
const WIDEST: usize = 52;

fn rows(table: &Table) -> String {
    let mut out = String::new();
    let length = |text: &str| text.chars().count();
    let widths = table.columns.iter().enumerate().map(|(k, column)| {
        let cells = table.rows.iter().filter_map(|row| row.get(k)).map(|cell| length(&cell.text));
        cells.chain([length(&column.title)]).max().unwrap_or(0).min(WIDEST).max(column.width)
    });
    let widths: Vec<usize> = widths.collect();
    if table.has_titles() {
        line(
            &mut out,
            table
                .columns
                .iter()
                .zip(&widths)
                .map(|(column, width)| (column, *width, column.title.as_str(), ' ')),
        );
    }
    for row in &table.rows {
        let cells = table.cells(row).zip(&widths);
        line(
            &mut out,
            cells.map(|((column, cell), width)| (column, *width, cell.text.as_str(), mark(cell.tone))),
        );
    }
    out
}

fn mark(tone: Tone) -> char {
    match tone {
        Tone::Plain | Tone::Yes | Tone::Open => ' ',
        Tone::AtLimit => '=',
        Tone::No => '!',
    }
}

/// The mark of a word stands at the end of the gap, and the mark of a number directly before it.
fn line<'a>(out: &mut String, cells: impl Iterator<Item = (&'a Column, usize, &'a str, char)>) {
    let mut row = String::new();
    for (k, (column, width, text, mark)) in cells.enumerate() {
        let gap = if k == 0 { column.gap - 1 } else { column.gap };
        // writing to a string cannot fail
        let _ = match (column.right, mark) {
            (false, ' ') => write!(row, "{:gap$}{text:<width$}", ""),
            (false, mark) => write!(row, "{mark:>gap$}{text:<width$}"),
            (true, ' ') => write!(row, "{:gap$}{text:>width$}", ""),
            (true, mark) => write!(row, "{:>1$}", format!("{mark}{text}"), gap + width),
        };
    }
    out.push_str(row.trim_end());
    out.push('\n');
}
