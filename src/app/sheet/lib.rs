//! An answer as people read it: lines, facts and tables, rendered as terminal text, Markdown and HTML.
//!
//! [`Sheet`] holds the content. [`answers`] makes one sheet of each answer; the command line, the report, the page and
//! notebooks render it. This package knows the records of answers; files, terminals and pages are left to its callers.

/// Adds a formatted line to a sheet.
macro_rules! say {
    ($sheet:expr, $($text:tt)*) => { $sheet.line(format_args!($($text)*)) };
}

pub mod answers;
mod figure;
mod html;
mod markdown;
mod text;

use std::fmt::Display;

use records::PoseQuaternionRecord;

pub use figure::DIGITS;
pub use html::{badge, shown};
pub use markdown::escaped as markdown_escaped;

/// The content of an answer from top to bottom.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Sheet(Vec<Block>);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Block {
    /// A sentence; leading spaces mark that it belongs to the line above.
    Line(String),
    /// A gap before another subject.
    Space,
    Table(Table),
    /// Details under a title.
    Part {
        title: String,
        open: bool,
        sheet: Sheet,
    },
}

impl Sheet {
    /// An empty sheet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a line for each line of the text; an empty line becomes a gap.
    pub fn line(&mut self, text: impl Display) {
        let text = text.to_string();
        self.0
            .extend(text.split('\n').map(|line| {
                if line.trim().is_empty() { Block::Space } else { Block::Line(line.to_owned()) }
            }));
    }

    /// Adds an empty line.
    pub fn space(&mut self) {
        self.0.push(Block::Space);
    }

    /// Adds a table, unless it has no rows.
    pub fn table(&mut self, table: Table) {
        self.0.extend((!table.rows.is_empty()).then_some(Block::Table(table)));
    }

    /// Adds the content of another sheet.
    pub fn add(&mut self, other: Self) {
        self.0.extend(other.0);
    }

    /// Adds details under a title, which a page can fold away.
    pub fn part(&mut self, title: impl Into<String>, open: bool, sheet: Self) {
        self.0.push(Block::Part { title: title.into(), open, sheet });
    }
}

impl Sheet {
    /// The same with its numbers rounded to so many significant digits.
    fn rounded(&self, digits: usize) -> Self {
        let text = |text: &str| figure::rounded_in(text, digits).into_owned();
        let cell = |cell: &Cell| Cell { text: text(&cell.text), ..cell.clone() };
        let block = |block: &Block| match block {
            Block::Line(line) => Block::Line(text(line)),
            Block::Space => Block::Space,
            Block::Table(table) => Block::Table(Table {
                columns: table
                    .columns
                    .iter()
                    .map(|c| Column { title: text(&c.title), ..c.clone() })
                    .collect(),
                rows: table.rows.iter().map(|row| row.iter().map(cell).collect()).collect(),
            }),
            Block::Part { title, open, sheet } => {
                Block::Part { title: text(title), open: *open, sheet: sheet.rounded(digits) }
            }
        };
        Self(self.0.iter().map(block).collect())
    }
}

impl From<Table> for Sheet {
    fn from(table: Table) -> Self {
        let mut sheet = Self::new();
        sheet.table(table);
        sheet
    }
}

/// A table: rows of cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows; the line of titles is left out if no column has a title.
    pub fn new(columns: impl IntoIterator<Item = Column>) -> Self {
        Self { columns: columns.into_iter().collect(), rows: Vec::new() }
    }

    /// A table of names and values.
    pub fn facts(width: usize, facts: impl IntoIterator<Item = (impl Into<Cell>, impl Into<Cell>)>) -> Self {
        let mut table = Self::new([left("", width), left("", 0)]);
        facts.into_iter().for_each(|(name, value)| table.row([name.into(), value.into()]));
        table
    }

    /// Adds a row; missing cells stay empty.
    pub fn row(&mut self, cells: impl IntoIterator<Item = impl Into<Cell>>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Adds rows.
    #[must_use]
    pub fn with_rows(
        mut self,
        rows: impl IntoIterator<Item = impl IntoIterator<Item = impl Into<Cell>>>,
    ) -> Self {
        rows.into_iter().for_each(|row| self.row(row));
        self
    }

    fn has_titles(&self) -> bool {
        self.columns.iter().any(|column| !column.title.is_empty())
    }

    /// The cells of a row with their columns.
    fn cells<'a>(&'a self, row: &'a [Cell]) -> impl Iterator<Item = (&'a Column, &'a Cell)> {
        static EMPTY: Cell = Cell { text: String::new(), tone: Tone::Plain, pose: None };
        self.columns.iter().enumerate().map(|(k, column)| (column, row.get(k).unwrap_or(&EMPTY)))
    }
}

/// A column; width and gap apply to text output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    title: String,
    width: usize,
    right: bool,
    gap: usize,
    minor: bool,
}

/// A column of words with this least width.
pub fn left(title: impl Into<String>, width: usize) -> Column {
    Column { title: title.into(), width, right: false, gap: 1, minor: false }
}

/// A column of numbers with this least width.
pub fn right(title: impl Into<String>, width: usize) -> Column {
    Column { title: title.into(), width, right: true, gap: 1, minor: false }
}

impl Column {
    /// Sets the number of spaces before the column; the default is 1.
    #[must_use]
    pub fn gap(self, gap: usize) -> Self {
        Self { gap, ..self }
    }

    /// Marks a column that a narrow page leaves out.
    #[must_use]
    pub fn minor(self) -> Self {
        Self { minor: true, ..self }
    }
}

/// A text with the tone of a verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    text: String,
    tone: Tone,
    /// The pose that the text is about, in JSON; only a page uses it.
    pose: Option<String>,
}

/// The tone of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// No verdict.
    Plain,
    /// Met.
    Yes,
    /// Met, exactly at the limit.
    AtLimit,
    /// Violated.
    No,
    /// Not decided.
    Open,
}

impl Tone {
    /// The tone of a verdict.
    #[must_use]
    pub fn of(holds: Option<bool>) -> Self {
        match holds {
            Some(true) => Self::Yes,
            Some(false) => Self::No,
            None => Self::Open,
        }
    }
}

impl Cell {
    /// A text with a tone.
    pub fn toned(text: impl Into<String>, tone: Tone) -> Self {
        Self { text: text.into(), tone, pose: None }
    }

    /// The cell with the pose that it is about, which a page can show.
    #[must_use]
    pub fn at(self, pose: Option<&PoseQuaternionRecord>) -> Self {
        Self { pose: pose.and_then(|pose| serde_json::to_string(pose).ok()), ..self }
    }
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self::toned(text, Tone::Plain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        let mut table = Table::new([
            left("name", 6),
            left("status", 8),
            right("margin", 8).gap(2),
            left("of", 0).minor(),
        ]);
        table.row([Cell::from("a"), Cell::toned("violated", Tone::No), "-1.5".into(), "leg 1".into()]);
        table.row([Cell::from("b_c"), Cell::toned("met", Tone::Yes), Cell::toned("0", Tone::AtLimit)]);
        let mut sheet = Sheet::new();
        sheet.line("A <b> is\n  so\n  and so\n");
        sheet.table(table);
        sheet.table(Table::facts(4, [("x", "1")]));
        sheet
    }

    #[test]
    fn one_content_has_three_forms() {
        assert_eq!(
            sheet().to_string(),
            "A <b> is\n  so\n  and so\n\nname   status      margin of\na     !violated      -1.5 leg 1\nb_c    met             =0\nx    1\n"
        );
        assert_eq!(
            sheet().markdown(),
            "A \\<b> is\n\n- so\n- and so\n\n| name | status | margin | of |\n|---|---|--:|---|\n| a | violated | -1.5 | leg 1 |\n| b_c | met | 0 |  |\n\n|  |  |\n|---|---|\n| x | 1 |\n"
        );
        let html = sheet().html().into_string();
        for part in [
            "<p>A &lt;b&gt; is</p><ul><li>so</li><li>and so</li></ul>",
            "<th scope=\"col\" class=\"right\">margin</th><th scope=\"col\" class=\"minor\">of</th>",
            "<th scope=\"row\">a</th><td class=\"no\"><span aria-hidden=\"true\">\u{2717}</span> violated</td>",
            "<table class=\"facts\"><tbody><tr><th scope=\"row\">x</th><td>1</td></tr></tbody></table>",
        ] {
            assert!(html.contains(part), "{part}: {html}");
        }
    }
}
