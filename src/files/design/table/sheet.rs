//! Rows and columns of a table: detection of separators, decimal marks and the header.

use std::borrow::Cow;

use thiserror::Error;

use super::header::{CellUnit, length_unit, units_in_title};
use super::printed;
use super::text::{decode, is_workbook};
use platform::geom::AngleUnit;

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
    /// The unit of lengths, from the cells of a table without header or from a title or comment above the numbers.
    pub length_unit: Option<&'static str>,
    /// The unit of angles, from the same places.
    pub angle_unit: Option<AngleUnit>,
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
    /// A column in several units.
    #[error("{0}")]
    Units(String),
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
        let guesses: Vec<String> = decoded.guess.into_iter().collect();
        let packed = is_workbook(bytes);
        let found = Self::read_text(decoded.text.clone(), packed, least, guesses.clone());
        if !matches!(found, Err(InvalidSheet::NoNumbers(_))) || !decoded.text.contains(['(', '=']) {
            return found;
        }
        // `B1 (310, -80, 0)` and `B1: x=310 y=-80 z=0`
        let separated = decoded.text.chars().map(|c| match c {
            c if opens(c) => ',',
            ']' | ')' | '}' | '=' => ' ',
            c => c,
        });
        let again = Self::read_text(separated.collect(), packed, least, guesses);
        again.map_err(|_| InvalidSheet::NoNumbers(least)).map(|mut sheet| {
            sheet.guesses.push("Brackets and equal signs are read as separators.".into());
            sheet
        })
    }

    fn read_text(
        mut text: String,
        packed: bool,
        least: usize,
        mut guesses: Vec<String>,
    ) -> Result<Self, InvalidSheet> {
        if let Some(joined) = printed::joined(&text) {
            guesses.push("Groups of columns that were printed below each other are joined.".into());
            text = joined;
        }
        if let Some(rows) = named_rows(&text, least) {
            guesses.push("The names before `=` are the first cells of their rows.".into());
            text = rows;
        }
        if let Some(lines) = bracketed(&text) {
            guesses.push("Each innermost pair of brackets is read as a row.".into());
            text = lines;
        }
        let present = |c: char| if c == ' ' { true } else { text.contains(c) };
        let mut best: Option<([usize; 3], char, char, Vec<SheetRow>)> = None;
        let mut fault = None;
        for (separator, _) in SEPARATORS.into_iter().filter(|(c, _)| present(*c)) {
            let records = match records(&text, separator, least) {
                Ok(records) => records,
                Err(why) => {
                    fault.get_or_insert(why);
                    continue;
                }
            };
            for decimal in ['.', ','] {
                let numbers =
                    |row: &SheetRow| row.cells.iter().filter(|c| quantity(c, decimal).is_some()).count();
                let counts: Vec<usize> = records
                    .iter()
                    .filter(|row| !is_comment(row))
                    .map(numbers)
                    .filter(|n| *n >= least)
                    .collect();
                // the names `Base 1` have blanks beside tabs; count every number, so that `1,5 2,5` is two numbers
                // with decimal commas and not two beside a cell `5 2`
                let sure = usize::from(!", ".contains(separator));
                let found = [counts.len(), sure, counts.iter().sum()];
                if !counts.is_empty() && best.as_ref().is_none_or(|(known, ..)| found > *known) {
                    best = Some((found, separator, decimal, records.clone()));
                }
            }
        }
        let Some((_, separator, decimal, records)) = best else {
            return Err(fault.unwrap_or(InvalidSheet::NoNumbers(least)));
        };
        if separator != ',' && !packed {
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
        let mut sheet = Self::with_header(records, decimal, least, guesses);
        sheet.take_units_row();
        sheet.take_units_of_cells()?;
        Ok(sheet)
    }

    /// Separates the names of the columns from the rows.
    fn with_header(records: Vec<SheetRow>, decimal: char, least: usize, guesses: Vec<String>) -> Self {
        let is_data = |row: &SheetRow| {
            !is_comment(row) && row.cells.iter().filter(|c| quantity(c, decimal).is_some()).count() >= least
        };
        let mut sheet =
            Self { header: None, rows: Vec::new(), length_unit: None, angle_unit: None, guesses, decimal };
        let first = records.iter().position(is_data).unwrap_or(records.len());
        let columns = records.get(first).map_or(0, |row| row.cells.len());
        for (i, row) in records.into_iter().enumerate() {
            // scripts write the names of the columns after a comment mark
            let named =
                i < first && sheet.header.is_none().then(|| uncommented(&row).len() >= columns) == Some(true);
            if named && uncommented(&row).iter().all(|c| number(c, decimal).is_none()) && columns > 1 {
                sheet.header = Some(uncommented(&row));
                continue;
            }
            if i < first {
                let (length, angle) = units_in_title(&row.cells.join(" "));
                sheet.length_unit = sheet.length_unit.or(length);
                sheet.angle_unit = sheet.angle_unit.or(angle);
            }
            if !is_comment(&row) {
                sheet.rows.push(row);
            }
        }
        sheet
    }

    /// Adds a row of units below the names of the columns to these names.
    fn take_units_row(&mut self) {
        let Some(header) = &mut self.header else { return };
        let times = ["s", "sec", "ms"];
        let Some((at, units)) = self.rows.iter().enumerate().find_map(|(at, row)| {
            let units: Vec<Option<CellUnit>> = row.cells.iter().map(|cell| CellUnit::of(cell)).collect();
            let other = |cell: &String| {
                let plain = cell.trim_matches(|c| "[]()".contains(c));
                times.contains(&plain) || plain.chars().all(|c| "-\u{2013}/1".contains(c))
            };
            let all = row.cells.iter().zip(&units).all(|(cell, unit)| unit.is_some() || other(cell));
            (all && units.iter().any(Option::is_some)).then_some((at, units))
        }) else {
            return;
        };
        if self.rows[..at].iter().any(|row| row.cells.iter().any(|c| number(c, self.decimal).is_some())) {
            return;
        }
        let row = self.rows.remove(at);
        for ((name, cell), unit) in header.iter_mut().zip(&row.cells).zip(units) {
            let word = unit.map_or_else(|| cell.trim_matches(|c| "[]()".contains(c)), |unit| unit.word());
            if unit.is_some() || times.contains(&word) {
                *name = format!("{name} [{word}]");
            }
        }
        self.guesses.push(format!(
            "Line {}, `{}`, has the units of the columns.",
            row.line,
            row.cells.join(" ")
        ));
    }

    /// Removes the units and the marks of thousands from the cells; the names of the columns get the units.
    ///
    /// # Errors
    /// A column with several units, or with a number without one.
    fn take_units_of_cells(&mut self) -> Result<(), InvalidSheet> {
        let width = self.rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        let mut of_columns: Vec<Option<CellUnit>> = vec![None; width];
        let mut marked = None;
        for (column, known) in of_columns.iter_mut().enumerate() {
            let mut bare = None;
            for row in &mut self.rows {
                let Some(cell) = row.cells.get_mut(column) else { continue };
                let Some((plain, unit)) = quantity(cell, self.decimal) else { continue };
                let place = format!("line {}, column {}: `{cell}`", row.line, column + 1);
                match (unit, *known) {
                    (None, _) => {
                        // zero is zero in every unit
                        let is_zero = number(&plain, self.decimal) == Some(0.0);
                        bare = bare.or(Some(place).filter(|_| !is_zero));
                    }
                    (Some(unit), Some(other)) if unit != other => {
                        return Err(InvalidSheet::Units(format!(
                            "{place} is in {}, and other cells of the column are in {}",
                            unit.word(),
                            other.word()
                        )));
                    }
                    (Some(unit), _) => *known = Some(unit),
                }
                if unit.is_none() && *cell != plain && marked.is_none() {
                    marked = Some(format!("Marks between thousands are left out: `{cell}` is {plain}."));
                }
                *cell = plain;
            }
            if let (Some(unit), Some(place)) = (*known, bare) {
                let unit = unit.word();
                return Err(InvalidSheet::Units(format!(
                    "{place} has no unit, and other cells are in {unit}"
                )));
            }
        }
        self.guesses.extend(marked);
        let Some(header) = &mut self.header else {
            let mut units = of_columns.iter().flatten().filter_map(|unit| match unit {
                CellUnit::Length(label) => Some(*label),
                CellUnit::Angle(_) => None,
            });
            let first = units.next();
            if let (Some(first), Some(other)) = (first, units.find(|unit| Some(*unit) != first)) {
                return Err(InvalidSheet::Units(format!("some columns are in {first} and some in {other}")));
            }
            self.length_unit = first.or(self.length_unit);
            return Ok(());
        };
        for (name, unit) in header.iter_mut().zip(of_columns) {
            let Some(unit) = unit else { continue };
            match length_unit(name) {
                Some(said) if said == unit.word() => {}
                Some(said) => {
                    let unit = unit.word();
                    let message = format!("the column `{name}` is in {said}, and its cells are in {unit}");
                    return Err(InvalidSheet::Units(message));
                }
                None => *name = format!("{name} [{}]", unit.word()),
            }
        }
        Ok(())
    }

    /// A table of cells with decimal points, which need no guesses about marks.
    pub(super) fn of_rows(
        header: Option<Vec<String>>,
        rows: Vec<SheetRow>,
        (length_unit, angle_unit): (Option<&'static str>, Option<AngleUnit>),
        guesses: Vec<String>,
    ) -> Self {
        Self { header, rows, length_unit, angle_unit, guesses, decimal: '.' }
    }

    /// The factor in a row such as `1.0e+03 *`, as MATLAB prints it above a matrix.
    pub(super) fn factor(&self, row: &SheetRow) -> Option<f64> {
        let text = row.cells.join(" ");
        self.number(text.strip_suffix('*')?.trim()).filter(|x| *x > 0.0)
    }

    /// A number times a factor, in the notation of this table; a power of ten moves the decimal point without rounding.
    pub(super) fn scaled(&self, cell: &str, factor: f64) -> String {
        let power = factor.log10();
        if factor.to_bits() == 1.0_f64.to_bits() {
            return cell.to_owned();
        }
        if power.fract() == 0.0 && !cell.contains(['e', 'E']) {
            return format!("{cell}e{power}");
        }
        self.number(cell).map_or_else(|| cell.to_owned(), |x| self.shown(x * factor))
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
    // double precision of Fortran: `1.5D+02`
    let cell = match cell.find(['D', 'd']) {
        Some(at) if at > 0 => cell[..at].to_owned() + "e" + &cell[at + 1..],
        _ => cell,
    };
    let cell = match decimal {
        ',' if cell.contains('.') || cell.ends_with(',') => return None,
        ',' => cell.replacen(',', ".", 1),
        _ => cell,
    };
    cell.parse().ok().filter(|x: &f64| x.is_finite())
}

/// A number without marks of thousands, and the unit behind it: `310.0 mm`, `3.100,5`, `12\u{b0}`.
fn quantity(cell: &str, decimal: char) -> Option<(String, Option<CellUnit>)> {
    if number(cell, decimal).is_some() {
        return Some((cell.to_owned(), None));
    }
    let head = cell.trim().trim_end_matches(|c: char| c.is_alphabetic() || c == '\u{b0}');
    let unit = &cell.trim()[head.len()..];
    let unit = if unit.is_empty() { None } else { Some(CellUnit::of(unit)?) };
    let head = head.trim();
    let plain =
        if number(head, decimal).is_some() { head.to_owned() } else { without_thousands(head, decimal)? };
    Some((plain, unit))
}

/// The number without its marks of thousands. `3.100` alone may be a decimal: a mark between digits counts only beside
/// a decimal mark, or twice, or if it is a blank or an apostrophe.
fn without_thousands(cell: &str, decimal: char) -> Option<String> {
    let (whole, rest) = match cell.split_once(decimal) {
        Some((whole, rest)) => (whole, Some(rest)),
        None => (cell, None),
    };
    let digits = whole.trim_start_matches(['+', '-', '\u{2212}']);
    let mark = digits.chars().find(|c| !c.is_ascii_digit())?;
    let sure = mark == '\'' || mark == '\u{2019}' || mark.is_whitespace();
    if !(sure || mark == if decimal == '.' { ',' } else { '.' }) {
        return None;
    }
    let groups: Vec<&str> = digits.split(mark).collect();
    let grouped = (1..=3).contains(&groups[0].len()) && groups[1..].iter().all(|group| group.len() == 3);
    if !(grouped && (sure || rest.is_some() || groups.len() > 2)) {
        return None;
    }
    let plain = cell.replace(mark, "");
    number(&plain, decimal).is_some().then_some(plain)
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

fn opens(c: char) -> bool {
    matches!(c, '[' | '(' | '{')
}

/// Whether a text begins with a list in brackets.
pub(super) fn is_list(text: &str) -> bool {
    let is_comment = |line: &str| COMMENTS.iter().any(|mark| line.trim_start().starts_with(mark));
    let content = text.lines().find(|line| !line.trim().is_empty() && !is_comment(line));
    // units in a header are in brackets too: a list begins with a bracket, or with a name and its value
    content.is_some_and(|content| {
        let begins = |text: &str| {
            let word = |c: char| c.is_alphanumeric() || "_.".contains(c);
            text.trim_start().starts_with(opens)
                || text.trim_start().trim_start_matches(word).starts_with("([")
        };
        // `[base]` is a section of settings
        let inner = content.trim().strip_prefix('[').and_then(|inner| inner.strip_suffix(']'));
        let is_section = inner.is_some_and(|inner| !inner.contains(|c: char| c.is_ascii_digit() || opens(c)));
        !is_section
            && (begins(content) || content.split_once(['=', ':']).is_some_and(|(_, value)| begins(value)))
    })
}

/// The rows of a list in brackets, one per line, for example `base = [[1, 2, 3], ..`. Text before a bracket is a
/// separate line. `None`: the text has no such rows.
fn bracketed(text: &str) -> Option<String> {
    if !is_list(text) {
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

/// Rows `B1 = 310, -80, 0` with their names as cells; `None` if fewer than two lines have this form.
fn named_rows(text: &str, least: usize) -> Option<String> {
    let row = |line: &str| {
        let (name, values) = line.split_once('=')?;
        let is_name = name.trim().chars().all(|c| c.is_alphanumeric() || "_.- ".contains(c));
        let separates = |c: char| c.is_whitespace() || ";,".contains(c);
        let numbers = values.split(separates).filter(|cell| number(cell, '.').is_some()).count();
        let separator = [';', ','].into_iter().find(|c| values.contains(*c)).unwrap_or(' ');
        (is_name && !name.trim().is_empty() && numbers >= least.max(2))
            .then(|| format!("{}{separator}{}", name.trim(), values.trim()))
    };
    text.lines().filter_map(row).nth(1)?;
    let lines: Vec<String> = text.lines().map(|line| row(line).unwrap_or_else(|| line.to_owned())).collect();
    Some(lines.join("\n"))
}

/// The text without comments behind the numbers of a line; lines keep their places.
fn without_comments(text: &str, least: usize) -> Cow<'_, str> {
    if !COMMENTS.iter().any(|mark| text.contains(mark)) {
        return text.into();
    }
    let separates = |c: char| c.is_whitespace() || ";|,".contains(c);
    let short = |line: &'_ str| -> usize {
        let marks = COMMENTS.iter().filter_map(|mark| line.find(mark));
        let Some(at) = marks.min().filter(|at| line[..*at].ends_with(separates)) else { return line.len() };
        let numbers = line[..at].split(separates).filter(|cell| number(cell, '.').is_some()).count();
        if numbers >= least && !line[..at].contains('"') { at } else { line.len() }
    };
    text.split_inclusive('\n')
        .flat_map(|line| {
            let at = short(line);
            [&line[..at], if at < line.len() && line.ends_with('\n') { "\n" } else { "" }]
        })
        .collect::<String>()
        .into()
}

/// Cells of all lines that are not blank. A cell in quotation marks may contain separators and line ends; two marks in
/// it are one.
// The crate `csv` silently accepts an unclosed quotation mark, and it counts each blank of a run as a separator.
fn records(text: &str, separator: char, least: usize) -> Result<Vec<SheetRow>, InvalidSheet> {
    let text: &str = &without_comments(text, least);
    let mut rows = Vec::new();
    let mut row = SheetRow { line: 1, cells: Vec::new() };
    let (mut cell, mut line) = (String::new(), 1);
    // in quotes: the line of the opening mark
    let mut quoted: Option<usize> = None;
    let mut was_quoted = false;
    let mut chars = text.chars().peekable();
    let blank = |c: char| c != '\n' && c != '\r' && c.is_whitespace();
    let ends = |c: char| if separator == ' ' { blank(c) } else { c == separator };
    let finish = |cell: &mut String, row: &mut SheetRow| {
        let whole = std::mem::take(cell);
        let inner = whole.trim();
        let marked = inner.strip_prefix('\'').and_then(|inner| inner.strip_suffix('\''));
        row.cells.push(marked.unwrap_or(inner).to_string());
    };
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
            "'1.5','-2','300.25'\n'4',5.5,0\n",
            "array([[1.5, -2, 300.25],\n       [4. , 5.5, 0. ]])",
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
    fn units_and_thousands_are_read_with_the_numbers() {
        let meant = vec![vec![3100.5, -20.0], vec![12345678.0, 0.0]];
        for text in [
            "x,y\n\"3,100.5\",-20\n\"12,345,678\",0\n",
            "x;y\n3.100,5;-20\n12.345.678;0\n",
            "x;y\n3'100.5;-20\n12'345'678;0\n",
            "x;y\n3\u{202f}100,5;-20\n12\u{a0}345\u{a0}678;0\n",
            "x\ty\n3100.5 mm\t-20mm\n12345678 mm\t0\n",
            "x,y\nmm,-\n3100.5,-20\n12345678,0\n",
        ] {
            assert_eq!(numbers(text), meant, "{text}");
        }
        let names = |text: &str| CellTable::read(text.as_bytes(), 2).unwrap().header.unwrap().join("/");
        assert_eq!(names("t,x,y\ns,mm,deg\n0,1,2\n"), "t [s]/x [mm]/y [deg]");
        assert_eq!(names("x,y\n1 cm,2\n3 cm,4\n"), "x [cm]/y");
        let sheet = |text: &str| CellTable::read(text.as_bytes(), 2).unwrap();
        assert_eq!(sheet("1 cm,2 cm\n3 cm,4 cm\n").length_unit, Some("cm"));
        let titled = sheet("lengths in inch, angles in rad\nx,y,z\n1,2,3\n");
        assert_eq!((titled.length_unit, titled.angle_unit), (Some("in"), Some(AngleUnit::Radians)));
        let why = |text: &str| CellTable::read(text.as_bytes(), 2).unwrap_err().to_string();
        assert!(why("x,y\n1 cm,2\n3 mm,4\n").contains("line 3, column 1: `3 mm` is in mm"));
        assert!(why("x,y\n1 cm,2\n3,4\n").contains("`3` has no unit"));
        assert!(why("x_mm,y\n1 cm,2\n3 cm,4\n").contains("`x_mm` is in mm, and its cells are in cm"));
        let marked = sheet("x;y\n3.100,5;-20\n4;1,5\n").guesses;
        assert!(marked.iter().any(|g| g.ends_with("`3.100,5` is 3100,5.")), "{marked:?}");
        // one group of three digits may be a decimal
        assert_eq!(sheet("x;y;z\n3.100;1,5;2,5\n").number("3.100"), None);
    }

    #[test]
    fn names_with_numbers_do_not_hide_the_tabs() {
        let sheet = CellTable::read(b"Name\tX\tY\tZ\nBase 1\t1\t2\t3\nBase 2\t4\t5\t6\n", 2).unwrap();
        assert_eq!(sheet.rows[1].cells, ["Base 2", "4", "5", "6"]);
    }

    #[test]
    fn lines_are_those_of_the_text() {
        let sheet = CellTable::read("x,y\n\n1,2\n\"3\",4\n\n5,6".as_bytes(), 2).unwrap();
        assert_eq!(sheet.rows.iter().map(|r| r.line).collect::<Vec<_>>(), [3, 4, 6]);
    }
}
