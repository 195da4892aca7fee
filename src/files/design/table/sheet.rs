//! Rows and columns of a table: detection of separators, decimal marks and the header.

use thiserror::Error;

use super::text::{decode, is_workbook};

/// A row of a table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SheetRow {
    /// Line of the text where it begins, from 1.
    pub line: usize,
    /// The cells, without surrounding blanks and quotes.
    pub cells: Vec<String>,
}

/// A table of cells, some of which are numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CellTable {
    /// The names of the columns, if the table has any.
    pub header: Option<Vec<String>>,
    /// All rows below the header, those without numbers included.
    pub rows: Vec<SheetRow>,
    /// The guesses, one sentence each.
    pub guesses: Vec<String>,
    decimal: char,
}

/// Reasons why a text is no table.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InvalidSheet {
    /// It is not readable as text.
    #[error("{0}")]
    Encoding(String),
    /// A quoted cell has no end.
    #[error("line {line}: the quotation mark that opens a cell is not closed")]
    OpenQuote {
        /// The line, from 1.
        line: usize,
    },
    /// No row has enough numbers.
    #[error("no line has {0} numbers or more")]
    NoNumbers(usize),
}

/// Separators of cells, the surest first: a comma or a blank may also be part of a number or of a name.
const SEPARATORS: [(char, &str); 5] =
    [('\t', "tabs"), (';', "semicolons"), ('|', "vertical bars"), (',', "commas"), (' ', "blanks")];

/// Marks at the start of a comment line.
const COMMENTS: [&str; 3] = ["#", "%", "//"];

impl CellTable {
    /// Reads a table whose rows have at least `least` numbers; rows without any number are kept, since they may be
    /// titles.
    ///
    /// # Errors
    /// [`InvalidSheet`].
    pub(super) fn read(bytes: &[u8], least: usize) -> Result<Self, InvalidSheet> {
        let decoded = decode(bytes).map_err(InvalidSheet::Encoding)?;
        let mut guesses: Vec<String> = decoded.guess.into_iter().collect();
        let mut text = decoded.text;
        if let Some(lines) = bracketed(&text) {
            guesses.push("Each innermost pair of brackets is read as a row.".into());
            text = lines;
        }
        let present = |c: char| if c == ' ' { true } else { text.contains(c) };
        let mut best: Option<(usize, char, char, Vec<SheetRow>)> = None;
        let mut fault = None;
        for (separator, _) in SEPARATORS.into_iter().filter(|(c, _)| present(*c)) {
            let records = match records(&text, separator) {
                Ok(records) => records,
                Err(why) => {
                    fault.get_or_insert(why);
                    continue;
                }
            };
            for decimal in ['.', ','] {
                let numbers =
                    |row: &SheetRow| row.cells.iter().filter(|c| number(c, decimal).is_some()).count();
                let rows = records.iter().filter(|row| !is_comment(row));
                // count every number, so that `1,5 2,5` is two numbers with decimal commas and not two beside a cell
                // `5 2`
                let found: usize = rows.map(numbers).filter(|n| *n >= least).sum();
                if found > best.as_ref().map_or(0, |(n, ..)| *n) {
                    best = Some((found, separator, decimal, records.clone()));
                }
            }
        }
        let Some((_, separator, decimal, records)) = best else {
            return Err(fault.unwrap_or(InvalidSheet::NoNumbers(least)));
        };
        if separator != ',' && !is_workbook(bytes) {
            let name = SEPARATORS.iter().find(|(c, _)| *c == separator).map_or("", |(_, name)| name);
            guesses.push(format!("The columns are separated by {name}."));
        }
        if decimal == ',' {
            let example =
                records.iter().flat_map(|r| &r.cells).find(|c| c.contains(',') && number(c, ',').is_some());
            guesses.extend(example.map(|cell| {
                format!("The comma marks the decimals: `{cell}` is {}.", cell.replacen(',', ".", 1))
            }));
        }
        Ok(Self::with_header(records, decimal, least, guesses))
    }

    /// Separates the names of the columns from the rows.
    fn with_header(records: Vec<SheetRow>, decimal: char, least: usize, guesses: Vec<String>) -> Self {
        let is_data = |row: &SheetRow| {
            !is_comment(row) && row.cells.iter().filter(|c| number(c, decimal).is_some()).count() >= least
        };
        let mut sheet = Self { header: None, rows: Vec::new(), guesses, decimal };
        let first = records.iter().position(is_data).unwrap_or(records.len());
        let columns = records.get(first).map_or(0, |row| row.cells.len());
        for (i, row) in records.into_iter().enumerate() {
            // scripts write the names of the columns after a comment mark
            let named =
                i < first && sheet.header.is_none().then(|| uncommented(&row).len() >= columns) == Some(true);
            if named && uncommented(&row).iter().all(|c| number(c, decimal).is_none()) && columns > 1 {
                sheet.header = Some(uncommented(&row));
            } else if !is_comment(&row) {
                sheet.rows.push(row);
            }
        }
        sheet
    }

    /// The number in a cell; `None` if it is invalid or not finite.
    pub(super) fn number(&self, cell: &str) -> Option<f64> {
        number(cell, self.decimal)
    }

    /// A number in the notation of this table.
    pub(super) fn shown(&self, x: f64) -> String {
        format!("{x:?}").replace('.', &self.decimal.to_string())
    }

    /// The cell with a decimal point, if it is a number.
    pub(super) fn with_point(&self, cell: &str) -> String {
        match number(cell, self.decimal) {
            Some(_) => cell.replace(',', ".").replace('\u{2212}', "-"),
            None => cell.replace(',', " "),
        }
    }
}

/// Digits with at most one decimal mark and an optional sign.
fn number(cell: &str, decimal: char) -> Option<f64> {
    let cell = cell.trim().replace('\u{2212}', "-");
    let body = cell.trim_start_matches(['+', '-']);
    if cell.len() - body.len() > 1 || !body.starts_with(|c: char| c.is_ascii_digit() || c == decimal) {
        return None;
    }
    let cell = match decimal {
        ',' if cell.contains('.') || cell.ends_with(',') => return None,
        ',' => cell.replacen(',', ".", 1),
        _ => cell,
    };
    cell.parse().ok().filter(|x: &f64| x.is_finite())
}

fn is_comment(row: &SheetRow) -> bool {
    row.cells.first().is_some_and(|c| COMMENTS.iter().any(|mark| c.starts_with(mark)))
}

/// The cells without the comment mark before the first.
fn uncommented(row: &SheetRow) -> Vec<String> {
    let mut cells = row.cells.clone();
    if is_comment(row)
        && let Some(first) = cells.first_mut()
    {
        *first = first.trim_start_matches(['#', '%', '/']).trim().to_string();
        if first.is_empty() {
            cells.remove(0);
        }
    }
    cells
}

/// The rows of a list in brackets, one per line, for example `base = [[1, 2, 3], ..`. Text before a bracket is a
/// separate line. `None`: the text has no such rows.
fn bracketed(text: &str) -> Option<String> {
    let opens = |c: char| matches!(c, '[' | '(' | '{');
    let content = text
        .lines()
        .find(|l| !l.trim().is_empty() && !COMMENTS.iter().any(|m| l.trim_start().starts_with(m)))?;
    // units in a header are in brackets too: a list begins with a bracket, or with a name and its value
    let lists = content.trim_start().starts_with(opens)
        || content.split_once(['=', ':']).is_some_and(|(_, value)| value.trim_start().starts_with(opens));
    if !lists {
        return None;
    }
    let mut out = String::new();
    let mut since = String::new();
    for c in text.chars() {
        match c {
            c if opens(c) => {
                let label = since.trim_matches(|c: char| c.is_whitespace() || ",;=:".contains(c));
                if !label.is_empty() {
                    out.push_str(label);
                    out.push('\n');
                }
                since.clear();
            }
            ']' | ')' | '}' => {
                // the rows of a matrix are separated by semicolons
                for row in since
                    .split([';', '\n'])
                    .map(str::trim)
                    .filter(|row| row.contains(|c: char| c.is_ascii_digit()))
                {
                    out.push_str(row.trim_end_matches(','));
                    out.push('\n');
                }
                since.clear();
            }
            c => since.push(c),
        }
    }
    Some(out)
}

/// Cells of all lines that are not blank. A cell in quotation marks may contain separators and line ends; two marks in
/// it are one.
// The crate `csv` silently accepts an unclosed quotation mark, and it counts each blank of a run as a separator.
fn records(text: &str, separator: char) -> Result<Vec<SheetRow>, InvalidSheet> {
    let mut rows = Vec::new();
    let mut row = SheetRow { line: 1, cells: Vec::new() };
    let (mut cell, mut line) = (String::new(), 1);
    // in quotes: the line of the opening mark
    let mut quoted: Option<usize> = None;
    let mut was_quoted = false;
    let mut chars = text.chars().peekable();
    let blank = |c: char| c != '\n' && c != '\r' && c.is_whitespace();
    let ends = |c: char| if separator == ' ' { blank(c) } else { c == separator };
    let finish =
        |cell: &mut String, row: &mut SheetRow| row.cells.push(std::mem::take(cell).trim().to_string());
    while let Some(c) = chars.next() {
        match c {
            '"' if quoted.is_some() && chars.peek() == Some(&'"') => {
                chars.next();
                cell.push('"');
            }
            '"' if quoted.is_some() => quoted = None,
            '"' if cell.trim().is_empty() && !was_quoted => {
                cell.clear();
                (quoted, was_quoted) = (Some(line), true);
            }
            '\n' | '\r' if quoted.is_some() => {
                line += usize::from(c == '\n');
                cell.push(' ');
            }
            '\n' | '\r' => {
                if c == '\r' && chars.peek() == Some(&'\n') {
                    chars.next();
                }
                if separator != ' ' || !cell.is_empty() || was_quoted {
                    finish(&mut cell, &mut row);
                }
                line += 1;
                rows.push(std::mem::replace(&mut row, SheetRow { line, cells: Vec::new() }));
                was_quoted = false;
            }
            c if quoted.is_none() && ends(c) => {
                // a run of blanks is one separator
                if separator != ' ' || !cell.is_empty() || was_quoted {
                    finish(&mut cell, &mut row);
                }
                was_quoted = false;
            }
            c => cell.push(c),
        }
    }
    if let Some(line) = quoted {
        return Err(InvalidSheet::OpenQuote { line });
    }
    if !cell.is_empty() || was_quoted || (separator != ' ' && !row.cells.is_empty()) {
        finish(&mut cell, &mut row);
    }
    rows.push(row);
    if separator == '|' {
        // a table may have bars at its sides too
        for row in &mut rows {
            if row.cells.first().is_some_and(String::is_empty)
                && row.cells.last().is_some_and(String::is_empty)
            {
                row.cells = row.cells[1..row.cells.len().max(2) - 1].to_vec();
            }
            if row.cells.iter().all(|c| !c.is_empty() && c.chars().all(|c| "-:".contains(c))) {
                row.cells.clear();
            }
        }
    }
    // sheets are padded with empty cells on the right
    for row in &mut rows {
        while row.cells.last().is_some_and(String::is_empty) {
            row.cells.pop();
        }
    }
    rows.retain(|row| !row.cells.is_empty());
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(text: &str) -> Vec<Vec<f64>> {
        let sheet = CellTable::read(text.as_bytes(), 2).unwrap();
        let row = |r: &SheetRow| r.cells.iter().filter_map(|c| sheet.number(c)).collect();
        sheet.rows.iter().map(row).filter(|r: &Vec<f64>| !r.is_empty()).collect()
    }

    #[test]
    fn the_same_numbers_however_the_table_is_written() {
        let meant = vec![vec![1.5, -2.0, 300.25], vec![4.0, 5.5, 0.0]];
        for text in [
            "1.5,-2,300.25\n4,5.5,0\n",
            "1.5, -2, 300.25\r\n4, 5.5, 0\r\n",
            "1.5;-2;300.25\r4;5.5;0",
            "1,5;-2;300,25\n4;5,5;0\n",
            "1,5\t-2\t300,25\n4\t5,5\t0",
            "  1.5   -2 300.25\n4 5.5 0\n\n",
            "1,5 -2,0 300,25\n4,0 5,5 0,0\n",
            "\"1.5\",\"-2\",\"300.25\"\n4,\"5.5\",0\n",
            "\"1,5\",\"-2\",\"300,25\"\n4,\"5,5\",0\n",
            "1.5,\u{2212}2,+300.25,,\n,,,,\n4,5.5,0,,\n",
            "1.5e0,-2.0,3.0025E2\n# between\n4,5.5,0 \n% after\n",
            "| 1.5 | -2 | 300.25 |\n|---|---|---|\n| 4 | 5.5 | 0 |\n",
            "[[1.5, -2, 300.25], [4, 5.5, 0]]",
            "A = [1.5 -2 300.25; 4 5.5 0];",
            "{1.5, -2, 300.25},\n{4, 5.5, 0}\n",
        ] {
            assert_eq!(numbers(text), meant, "{text}");
        }
    }

    #[test]
    fn a_header_is_known_by_its_place_and_its_words() {
        let header = |text: &str| CellTable::read(text.as_bytes(), 2).unwrap().header.map(|h| h.join("/"));
        assert_eq!(header("x,y\n1,2\n").as_deref(), Some("x/y"));
        assert_eq!(header("Hexapod of May\n\nx;y\n1;2\n").as_deref(), Some("x/y"));
        assert_eq!(header("# x y\n1 2\n").as_deref(), Some("x/y"));
        assert_eq!(header("\"x\n[mm]\",\"y, up\"\n1,2\n").as_deref(), Some("x [mm]/y, up"));
        assert_eq!(header("1,2\n3,4\n"), None);
        assert_eq!(header("a title\n1,2\n"), None);
    }

    #[test]
    fn what_is_guessed_is_said_and_what_is_no_table_is_refused() {
        let sheet = CellTable::read("a;b\n1,5;2\n".as_bytes(), 2).unwrap();
        assert_eq!(
            sheet.guesses,
            ["The columns are separated by semicolons.", "The comma marks the decimals: `1,5` is 1.5."]
        );
        let why = |text: &str| CellTable::read(text.as_bytes(), 2).unwrap_err();
        assert_eq!(
            why("1,\"2\n3,4\n5,6\n").to_string(),
            "line 1: the quotation mark that opens a cell is not closed"
        );
        assert_eq!(why("a,b\nc,d\n"), InvalidSheet::NoNumbers(2));
        assert_eq!(why(""), InvalidSheet::NoNumbers(2));
        assert_eq!(why("1,inf\n2,nan\n"), InvalidSheet::NoNumbers(2));
    }

    #[test]
    fn lines_are_those_of_the_text() {
        let sheet = CellTable::read("x,y\n\n1,2\n\"3\",4\n\n5,6".as_bytes(), 2).unwrap();
        assert_eq!(sheet.rows.iter().map(|r| r.line).collect::<Vec<_>>(), [3, 4, 6]);
    }
}
