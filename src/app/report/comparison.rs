//! Designs side by side, as a table of a page and as a page of its own.

use std::fmt::Write as _;

use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};

use super::facts::digits;
use crate::app::page::strict_policy;
use files::plot::escape;
use records::{CompareAnswer, FigureCell};

const STYLE: &str = concat!(include_str!("style.css"), include_str!("comparison.css"));
const SCRIPT: &str = include_str!("comparison.js");

/// Designs with their pictures, in the order of the answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The figures.
    pub answer: CompareAnswer,
    /// SVG texts.
    pub thumbnails: Vec<String>,
}

/// The table: a row for every design. A click on the title of a column sorts by it where the page has the script.
pub(super) fn table(comparison: &Comparison, sortable: bool) -> String {
    let columns = comparison.answer.columns();
    let title = |k: usize, title: &str, unit: &str| {
        let unit = if unit.is_empty() { String::new() } else { format!(" [{}]", escape(unit)) };
        let text = format!("{}{unit}", escape(title));
        if sortable {
            format!(
                "<th scope=\"col\" aria-sort=\"none\"><button type=\"button\" data-column=\"{k}\">{text}</button></th>"
            )
        } else {
            format!("<th scope=\"col\">{text}</th>")
        }
    };
    let mut out = String::from(
        "<div class=\"wide\"><table class=\"comparison\"><thead><tr><th scope=\"col\">picture</th>",
    );
    out.push_str(&title(0, "design", ""));
    for (k, column) in columns.iter().enumerate() {
        out.push_str(&title(k + 1, &column.title, &column.unit));
    }
    out.push_str("</tr></thead><tbody>\n");
    for (row, design) in comparison.answer.designs.iter().enumerate() {
        let picture = comparison.thumbnails.get(row).map_or_else(String::new, |svg| {
            let name = escape(&design.name);
            let source = utf8_percent_encode(svg, NON_ALPHANUMERIC);
            format!("<img alt=\"{name}\" width=\"140\" height=\"110\" src=\"data:image/svg+xml,{source}\">")
        });
        let _ = write!(
            out,
            "<tr><td>{picture}</td><th scope=\"row\" data-value=\"{0}\">{0}<br><span class=\"note\">{1}</span></th>",
            escape(&design.name),
            escape(&design.path)
        );
        for column in &columns {
            let cell = match &column.cells[row] {
                None => "<td>\u{2013}</td>".to_string(),
                Some(FigureCell::Word(word)) => {
                    let class = match word.as_str() {
                        "violated" => "no",
                        word if word.starts_with("met") => "yes",
                        _ => "open",
                    };
                    format!("<td class=\"{class}\" data-value=\"{0}\">{0}</td>", escape(word))
                }
                Some(FigureCell::Number(x, violated)) => {
                    let text = if x.is_finite() { digits(*x) } else { "\u{221e}".into() };
                    let class = if *violated { " class=\"no\"" } else { "" };
                    format!("<td{class} data-value=\"{x}\">{text}</td>")
                }
            };
            out.push_str(&cell);
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
    out
}

/// What the figures are about, a sentence each.
pub(super) fn notes(answer: &CompareAnswer) -> String {
    let mut out = String::from(
        "<p class=\"note\">Figures are the worst found over the workspace of each design, at home where none is stated. Conditioning is 1 at best and 0 at a singular pose. Margins below 0 are violations.",
    );
    let _ = write!(out, " {}", escape(&answer.yardstick()));
    if !answer.manoeuvres.is_empty() {
        let _ = write!(out, " In motion: {}.", escape(&answer.manoeuvres.join("; ")));
    }
    if let Some(accuracy) = answer.accuracy {
        let _ = write!(
            out,
            " Joint tolerance: how far every joint may be off for the pose to stay within {} {} and {} degrees, to first order.",
            digits(accuracy.position),
            escape(&answer.length_unit),
            digits(accuracy.rotation_deg)
        );
    }
    out.push_str("</p>\n<ul class=\"note\">\n");
    for verdict in answer.verdicts() {
        let _ = writeln!(out, "<li>{}.</li>", escape(&verdict));
    }
    for line in answer.assumptions() {
        let _ = writeln!(out, "<li>{}</li>", escape(&line));
    }
    out.push_str("</ul>\n");
    out
}

/// One self-contained page whose table can be sorted.
#[must_use]
pub fn comparison_page(comparison: &Comparison) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n<meta name=\"color-scheme\" content=\"light dark\">\n<title>Designs side by side</title>\n\
         <style>{STYLE}</style></head>\n<body class=\"broad\"><main>\n<h1>Designs side by side</h1>\n<p class=\"note\">Comparison of equipod {}. The title of a column sorts by it.</p>\n{}{}\
         </main><script>{SCRIPT}</script></body></html>\n",
        strict_policy(SCRIPT, STYLE),
        env!("CARGO_PKG_VERSION"),
        notes(&comparison.answer),
        table(comparison, true)
    )
}
