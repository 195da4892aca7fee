//! The page.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::kind::{ResultVerdict, verdict};
use super::{Report, ReportFile, comparison, parts};
use crate::app::page::policy;
use ask::Design;
use ask::design::parse;
use files::design::Format;
use records::{AssessAnswer, DesignRoleWord, sha256};
use sheet::{Cell, Sheet, Tone, answers, badge, shown};

pub(super) const STYLE: &str = concat!(include_str!("style.css"), include_str!("comparison.css"));

/// The kind of a file.
enum Content {
    Design(Box<Design>, String),
    Result(Map<String, Value>),
    Picture(String),
    Table(String),
    Other,
}

fn content(file: &ReportFile) -> Content {
    let Ok(text) = std::str::from_utf8(&file.bytes) else { return Content::Other };
    let ending = file.name.rsplit('.').next().map(str::to_ascii_lowercase).unwrap_or_default();
    let design = |format| parse(text, format).ok().map(|d| Content::Design(Box::new(d.0), text.to_owned()));
    match ending.as_str() {
        "toml" => design(Format::Toml).unwrap_or(Content::Other),
        "json" => match serde_json::from_str(text) {
            Ok(Value::Object(fields))
                if fields.contains_key("schema_version") && !fields.contains_key("legs") =>
            {
                Content::Result(fields)
            }
            _ => design(Format::Json).unwrap_or(Content::Other),
        },
        "svg" => Content::Picture(text.to_owned()),
        "csv" => Content::Table(text.to_owned()),
        _ => Content::Other,
    }
}

/// One self-contained page; files that are neither designs, results nor pictures are listed with their hash.
#[must_use]
pub fn html(report: &Report) -> String {
    let contents: Vec<(&ReportFile, Content)> = report.files.iter().map(|f| (f, content(f))).collect();
    let parts = |part: &dyn Fn(&str, &Content) -> Option<Markup>| -> Vec<Markup> {
        contents.iter().filter_map(|(file, content)| part(&file.name, content)).collect()
    };
    let verdicts = parts(&|name, content| match content {
        Content::Result(fields) => verdict_line(name, fields),
        _ => None,
    });
    let requirements = parts(&|name, content| match content {
        Content::Result(fields) => requirements(name, fields),
        _ => None,
    });
    let bills = parts(&|name, content| match content {
        Content::Table(text) => parts::section(&link(name), text),
        _ => None,
    });
    let side_by_side: Vec<Markup> = report.comparison.iter().map(|c| comparison::section(c, false)).collect();
    let pictures = parts(&|name, content| match content {
        Content::Picture(svg) => Some(picture(name, svg)),
        _ => None,
    });
    let designs = parts(&|name, content| match content {
        Content::Design(design, text) => Some(input(name, text, design)),
        _ => None,
    });
    let results = parts(&|name, content| match content {
        Content::Result(fields) => Some(result(name, fields)),
        _ => None,
    });
    let body = html! {
        main {
            h1 { (report.title) }
            p.note {
                "Report of equipod " (env!("CARGO_PKG_VERSION")) ". Every number stands in one of the files listed at the end, "
                "or in the comparison, which was computed from the designs among them."
            }
            @if !verdicts.is_empty() {
                section id="verdicts" { h2 { "Verdicts" } ul.verdicts { @for line in verdicts { (line) } } }
            }
            (section("requirements", "Requirements", &requirements))
            (section("parts", "Bill of materials", &bills))
            (section("comparison", "Designs side by side", &side_by_side))
            (section("pictures", "Pictures", &pictures))
            @if let Some(view) = &report.view {
                section id="view" {
                    h2 { "Live view" }
                    iframe title="Live view of the design" sandbox="allow-scripts allow-downloads" srcdoc=(view) {}
                }
            }
            (section("inputs", "Designs", &designs))
            (section("results", "Results", &results))
            (provenance(&contents))
        }
    };
    document(&report.title, &policy(&[STYLE]), &html! { body { (body) } })
}

/// A page with its title and its content security policy.
pub(super) fn document(title: &str, policy: &str, body: &Markup) -> String {
    shown(&html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(policy);
                meta name="color-scheme" content="light dark";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            (body)
        }
    })
}

fn section(id: &str, title: &str, parts: &[Markup]) -> Markup {
    html! { @if !parts.is_empty() { section id=(id) { h2 { (title) } @for part in parts { (part) } } } }
}

/// A verdict as a cell with a badge.
fn verdict_cell(v: &ResultVerdict) -> Cell {
    Cell::toned(v.word.as_str(), Tone::of(v.holds))
}

/// A verdict at the top of the page.
fn verdict_line(name: &str, fields: &Map<String, Value>) -> Option<Markup> {
    let v = verdict(fields)?;
    Some(html! {
        li {
            a href={ "#" (anchor(name)) } { (title(fields)) } " " (badge(&verdict_cell(&v)))
            @if let Some(sentence) = &v.explanation { ": " (sentence) }
        }
    })
}

/// The requirements of a result of `assess`, or of one that carries such an assessment.
fn requirements(name: &str, fields: &Map<String, Value>) -> Option<Markup> {
    let own = || Value::Object(fields.clone());
    let found = AssessAnswer::deserialize(fields.get("assessment").cloned().unwrap_or_else(own)).ok()?;
    Some(html! {
        h3 { (found.role.heading()) ": " (found.name) }
        (answers::requirements(&found.name, Some(&found)).html())
        p { (found.regular_explanation) "." }
        p.note { "A margin below 0 is a violation. From " (link(name)) }
    })
}

fn anchor(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    format!("file-{}", name.chars().map(plain).collect::<String>())
}

/// A link to the file beside the page or in a folder there. Empty path segments are dropped, since a path that begins
/// with `//` leads to another host.
fn link(name: &str) -> Markup {
    let parts = name.split('/').filter(|part| !part.is_empty());
    let encoded: Vec<String> =
        parts.map(|part| utf8_percent_encode(part, NON_ALPHANUMERIC).to_string()).collect();
    html! { a href=(encoded.join("/")) { (name) } }
}

/// The heading of a result, with the role of the design that it assesses.
fn title(fields: &Map<String, Value>) -> String {
    let role = fields.get("role").and_then(Value::as_str).and_then(DesignRoleWord::heading_of);
    role.map_or_else(
        || answers::heading(fields).to_owned(),
        |role| format!("{}: {role}", answers::heading(fields)),
    )
}

/// A result, folded: the verdicts tell its answer, and a reader unfolds it for the numbers.
fn result(name: &str, fields: &Map<String, Value>) -> Markup {
    html! {
        details.card id=(anchor(name)) {
            summary { h3 {
                (title(fields))
                @if let Some(v) = verdict(fields) { " " (badge(&verdict_cell(&v))) }
            } }
            (answers::document(fields).html())
            p.note { "From " (link(name)) }
        }
    }
}

/// A design with its legs, and the text of the file.
fn input(name: &str, text: &str, design: &Design) -> Markup {
    html! {
        section.card {
            h3 { (design.name) }
            @if let Some(text) = &design.description { p { (text) } }
            @if let Some(text) = &design.source { p.note { "Source: " (text) } }
            p.note {
                "Joint centres in " (design.units)
                ", base joints in the base frame, platform joints in the platform frame"
            }
            (Sheet::from(answers::legs(design)).html())
            details { summary { (name) } pre { (text) } }
        }
    }
}

/// The text of a node without markup, with the five entities of XML replaced by their characters.
fn unescape(text: &str) -> String {
    let known = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    known.iter().fold(text.to_owned(), |text, (entity, character)| text.replace(entity, character))
}

/// A picture as an image element, so that its scripts and styles reach neither the page nor other pictures.
fn picture(name: &str, svg: &str) -> Markup {
    // the file is untrusted: its escaped text is unescaped here and escaped again
    let inner = |from: &str, to: &str| {
        unescape(svg.split(from).nth(1).and_then(|rest| rest.split(to).next()).unwrap_or_default().trim())
    };
    let (title, description) =
        (inner("<title id=\"title\">", "</title>"), inner("<desc id=\"desc\">", "</desc>"));
    let title = if title.is_empty() { name } else { &title };
    html! {
        figure.card {
            img alt=(if description.is_empty() { title } else { &description }) src=(data(svg));
            figcaption { (title) " (" (link(name)) ")" }
        }
    }
}

/// The picture as a data address.
pub(super) fn data(svg: &str) -> String {
    format!("data:image/svg+xml,{}", utf8_percent_encode(svg, NON_ALPHANUMERIC))
}

/// Every file with its size, hash, version and seed.
fn provenance(contents: &[(&ReportFile, Content)]) -> Markup {
    let field = |content: &Content, key: &str| match content {
        Content::Result(fields) => fields
            .get("provenance")
            .and_then(|made_from| made_from.get(key))
            .filter(|v| !v.is_null())
            .map(|v| v.as_str().map_or_else(|| v.to_string(), str::to_owned)),
        _ => None,
    };
    let tolerances = |content: &Content| match content {
        Content::Result(fields) => tolerances(fields),
        _ => None,
    };
    let cell = |x: Option<String>| x.unwrap_or_else(|| "\u{2013}".into());
    html! {
        section id="files" {
            h2 { "Files" }
            details.card {
                summary { "Names, sizes and hashes of all files" }
                div.wide { table {
                    thead { tr { @for title in ["file", "bytes", "SHA-256", "equipod", "seed", "tolerances"] {
                        th scope="col" { (title) }
                    } } }
                    tbody { @for (file, content) in contents { tr {
                        th scope="row" { (link(&file.name)) }
                        td { (file.bytes.len()) }
                        td.hash { (sha256(&file.bytes)) }
                        td { (cell(field(content, "version"))) }
                        td { (cell(field(content, "seed"))) }
                        td { (cell(tolerances(content))) }
                    } } }
                } }
            }
        }
    }
}

/// The tolerances of the result, from its top level or one level below.
fn tolerances(fields: &Map<String, Value>) -> Option<String> {
    let below = fields.values().filter_map(Value::as_object).filter_map(|o| o.get("tolerances"));
    let tables = fields.get("tolerances").into_iter().chain(below).filter_map(Value::as_object);
    let single = fields.get("tolerance").map(|v| format!("tolerance {v}"));
    let each = tables.flatten().map(|(key, v)| format!("{} {v}", key.replace('_', " ")));
    let all: Vec<String> = single.into_iter().chain(each).collect();
    (!all.is_empty()).then(|| all.join(", "))
}
