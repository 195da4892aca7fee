//! Designs side by side, as a table of a page and as a page of its own.

use maud::{Markup, PreEscaped, html};

use super::page::{STYLE, data, document};
use crate::app::page::strict_policy;
use num::shown::significant;
use records::{CompareAnswer, FigureCell, FigureColumn};

const SCRIPT: &str = include_str!("comparison.js");

/// Designs with their pictures, in the order of the answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The figures.
    pub answer: CompareAnswer,
    /// SVG texts.
    pub thumbnails: Vec<String>,
}

/// The comparison as a section: notes on the figures, and a row for every design. With the script of the page, a click
/// on the title of a column sorts by it.
pub(super) fn section(comparison: &Comparison, sortable: bool) -> Markup {
    let columns = comparison.answer.columns();
    let titles = ["design".to_owned()].into_iter().chain(columns.iter().map(FigureColumn::heading));
    html! {
        (notes(&comparison.answer))
        div.wide { table.comparison {
            thead { tr {
                th scope="col" { "picture" }
                @for (k, title) in titles.enumerate() {
                    @if sortable {
                        th scope="col" aria-sort="none" { button type="button" data-column=(k) { (title) } }
                    } @else {
                        th scope="col" { (title) }
                    }
                }
            } }
            tbody { @for (row, design) in comparison.answer.designs.iter().enumerate() { tr {
                td { @if let Some(svg) = comparison.thumbnails.get(row) {
                    img alt=(design.name) width="140" height="110" src=(data(svg));
                } }
                th scope="row" data-value=(design.name) { (design.name) br; span.note { (design.path) } }
                @for column in &columns { (cell(column.cells[row].as_ref())) }
            } } }
        } }
    }
}

fn cell(cell: Option<&FigureCell>) -> Markup {
    match cell {
        None => html! { td { "\u{2013}" } },
        Some(FigureCell::Word(word)) => {
            let class = match word.as_str() {
                "violated" => "no",
                word if word.starts_with("met") => "yes",
                _ => "open",
            };
            html! { td class=(class) data-value=(word) { (word) } }
        }
        Some(FigureCell::Number(x, violated)) => {
            let text = if x.is_finite() { significant(*x) } else { "\u{221e}".into() };
            html! { td class=[violated.then_some("no")] data-value=(x) { (text) } }
        }
    }
}

/// Notes on the figures, one sentence each.
fn notes(answer: &CompareAnswer) -> Markup {
    html! {
        p.note {
            "Figures are the worst found over the workspace of each design, at home where none is stated. "
            "Conditioning is 1 at best and 0 at a singular pose. Margins below 0 are violations. " (answer.yardstick())
            @if !answer.manoeuvres.is_empty() { " In motion: " (answer.manoeuvres.join("; ")) "." }
            @if let Some(accuracy) = answer.accuracy {
                " Joint tolerance: how far every joint may be off for the pose to stay within "
                (significant(accuracy.position)) " " (answer.length_unit) " and " (significant(accuracy.rotation_deg))
                " degrees, to first order."
            }
        }
        ul.note {
            @for verdict in answer.verdicts() { li { (verdict) "." } }
            @for line in answer.assumptions() { li { (line) } }
        }
    }
}

/// One self-contained page whose table can be sorted.
#[must_use]
pub fn comparison_page(comparison: &Comparison) -> String {
    let title = "Designs side by side";
    let body = html! {
        body.broad {
            main {
                h1 { (title) }
                p.note { "Comparison of equipod " (env!("CARGO_PKG_VERSION")) ". The title of a column sorts by it." }
                (section(comparison, true))
            }
            script { (PreEscaped(SCRIPT)) }
        }
    };
    document(title, &strict_policy(SCRIPT, STYLE), &body)
}
