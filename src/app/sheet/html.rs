//! HTML, for reports and notebooks. Every text is escaped during writing.

use maud::{Markup, html};

use super::{Block, Cell, Column, DIGITS, Sheet, Table, Tone};
use files::plot::visible;

impl Sheet {
    /// The sheet as HTML: paragraphs, lists of indented lines, tables, and details that can be unfolded.
    #[must_use]
    pub fn html(&self) -> Markup {
        self.rounded(DIGITS.into()).markup()
    }

    fn markup(&self) -> Markup {
        let indented = |block: &Block| matches!(block, Block::Line(line) if line.starts_with("  "));
        html! {
            @for run in self.0.chunk_by(|a, b| indented(a) && indented(b)) {
                @if indented(&run[0]) {
                    ul { @for block in run { @if let Block::Line(line) = block { li { (line.trim()) } } } }
                } @else {
                    @match &run[0] {
                        Block::Space => {},
                        Block::Line(line) => p { (line) },
                        Block::Table(table) => (rows(table)),
                        Block::Part { title, open, sheet } => details open[*open] { summary { (title) } (sheet.markup()) },
                    }
                }
            }
        }
    }
}

fn rows(table: &Table) -> Markup {
    if !table.has_titles() {
        return html! { table.facts { (body(table)) } };
    }
    html! {
        div.wide { table {
            thead { tr { @for column in &table.columns {
                th scope="col" class=[classes(column, None)] { (column.title) }
            } } }
            (body(table))
        } }
    }
}

fn body(table: &Table) -> Markup {
    html! {
        tbody { @for row in &table.rows { tr { @for (k, (column, cell)) in table.cells(row).enumerate() {
            @if k == 0 { th scope="row" { (marked(cell)) } }
            @else { td class=[classes(column, class(cell.tone))] data-pose=[&cell.pose] { (marked(cell)) } }
        } } } }
    }
}

/// The classes of a cell: the tone or else the side of the column, and whether a narrow page leaves it out.
fn classes(column: &Column, tone: Option<&'static str>) -> Option<String> {
    let main = tone.or(column.right.then_some("right"));
    let all: Vec<_> = main.into_iter().chain(column.minor.then_some("minor")).collect();
    (!all.is_empty()).then(|| all.join(" "))
}

/// The text with the sign of its tone, so that colour is not the only cue.
fn marked(cell: &Cell) -> Markup {
    html! { @if let Some(sign) = sign(cell.tone) { span aria-hidden="true" { (sign) } " " } (cell.text) }
}

fn class(tone: Tone) -> Option<&'static str> {
    match tone {
        Tone::Plain => None,
        Tone::Yes | Tone::AtLimit => Some("yes"),
        Tone::No => Some("no"),
        Tone::Open => Some("open"),
    }
}

fn sign(tone: Tone) -> Option<&'static str> {
    match tone {
        Tone::Plain => None,
        Tone::Yes | Tone::AtLimit => Some("\u{2713}"),
        Tone::No => Some("\u{2717}"),
        Tone::Open => Some("?"),
    }
}

/// A verdict with its sign and colour.
pub fn badge(cell: &Cell) -> Markup {
    html! { strong class=[class(cell.tone)] { (marked(cell)) } }
}

/// Markup with all characters visible: terminal control and text direction characters are replaced.
pub fn shown(markup: &Markup) -> String {
    visible(&markup.0)
}
