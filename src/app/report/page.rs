//! The page.

use std::fmt::Write as _;

use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use serde_json::{Map, Value};

use super::kind::{ResultVerdict, heading, verdict};
use super::{Report, ReportFile, comparison, facts, inputs, parts, requirements};
use crate::app::page::policy;
use ask::Design;
use ask::design::parse;
use files::design::Format;
use files::plot::escape;
use records::{DesignRoleWord, sha256};

const STYLE: &str = concat!(include_str!("style.css"), include_str!("comparison.css"));

/// What a file is.
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
    let mut out = String::new();
    let title = escape(&report.title);
    let policy = policy(&[STYLE]);
    let _ = writeln!(
        out,
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n<style>{STYLE}</style></head>\n<body><main>\n<h1>{title}</h1>\n\
         <p class=\"note\">Report of equipod {}. Every number stands in one of the files listed at the end, or in the comparison, which was computed from the designs among them.</p>",
        env!("CARGO_PKG_VERSION")
    );
    verdicts(&mut out, &contents);
    section(
        &mut out,
        "requirements",
        "Requirements",
        contents.iter().filter_map(|(file, content)| match content {
            Content::Result(fields) => requirements::section(&link(&file.name), fields),
            _ => None,
        }),
    );
    section(
        &mut out,
        "parts",
        "Bill of materials",
        contents.iter().filter_map(|(file, content)| match content {
            Content::Table(text) => parts::section(&link(&file.name), text),
            _ => None,
        }),
    );
    let side_by_side =
        report.comparison.iter().map(|c| comparison::notes(&c.answer) + &comparison::table(c, false));
    section(&mut out, "comparison", "Designs side by side", side_by_side);
    section(
        &mut out,
        "pictures",
        "Pictures",
        contents.iter().filter_map(|(file, content)| match content {
            Content::Picture(svg) => Some(picture(&file.name, svg)),
            _ => None,
        }),
    );
    if let Some(view) = &report.view {
        let _ = writeln!(
            out,
            "<section id=\"view\"><h2>Live view</h2>\n<iframe title=\"Live view of the design\" sandbox=\"allow-scripts allow-downloads\" srcdoc=\"{}\"></iframe></section>",
            escape(view)
        );
    }
    section(
        &mut out,
        "inputs",
        "Designs",
        contents.iter().filter_map(|(file, content)| match content {
            Content::Design(design, text) => Some(inputs::section(&file.name, text, design)),
            _ => None,
        }),
    );
    section(
        &mut out,
        "results",
        "Results",
        contents.iter().filter_map(|(file, content)| match content {
            Content::Result(fields) => Some(result(&file.name, fields)),
            _ => None,
        }),
    );
    provenance(&mut out, &contents);
    out.push_str("</main></body></html>\n");
    out
}

fn section(out: &mut String, id: &str, title: &str, parts: impl Iterator<Item = String>) {
    let body: String = parts.collect();
    if !body.is_empty() {
        let _ = writeln!(out, "<section id=\"{id}\"><h2>{title}</h2>\n{body}</section>");
    }
}

/// The class and the sign that stand for a verdict, in colour and without.
pub(super) fn badge(v: &ResultVerdict) -> String {
    let (class, sign) = match v.holds {
        Some(true) => ("yes", "\u{2713}"),
        Some(false) => ("no", "\u{2717}"),
        None => ("open", "?"),
    };
    format!("<strong class=\"{class}\"><span aria-hidden=\"true\">{sign}</span> {}</strong>", escape(&v.word))
}

/// All answers at the top.
fn verdicts(out: &mut String, contents: &[(&ReportFile, Content)]) {
    let lines = contents.iter().filter_map(|(file, content)| {
        let Content::Result(fields) = content else { return None };
        let v = verdict(fields)?;
        let sentence = v.explanation.as_deref().map_or_else(String::new, |e| format!(": {}", escape(e)));
        let (anchor, name) = (anchor(&file.name), title(fields));
        Some(format!("<li><a href=\"#{anchor}\">{name}</a> {}{sentence}</li>\n", badge(&v)))
    });
    let lines: String = lines.collect();
    if !lines.is_empty() {
        let _ = writeln!(
            out,
            "<section id=\"verdicts\"><h2>Verdicts</h2>\n<ul class=\"verdicts\">\n{lines}</ul></section>"
        );
    }
}

fn anchor(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    format!("file-{}", name.chars().map(plain).collect::<String>())
}

/// A link to the file beside the page or in a folder there. Nothing is empty between two slashes: a path that begins with two of them leads to another host.
fn link(name: &str) -> String {
    let parts = name.split('/').filter(|part| !part.is_empty());
    let encoded: Vec<String> =
        parts.map(|part| utf8_percent_encode(part, NON_ALPHANUMERIC).to_string()).collect();
    format!("<a href=\"{}\">{}</a>", encoded.join("/"), escape(name))
}

/// The heading of a result, with the role of the design that it judges.
fn title(fields: &Map<String, Value>) -> String {
    let role = fields.get("role").and_then(Value::as_str).and_then(DesignRoleWord::heading_of);
    role.map_or_else(|| heading(fields).to_owned(), |role| format!("{}: {role}", heading(fields)))
}

/// A result folded away: its answer is among the verdicts, and whoever doubts it unfolds the numbers.
fn result(name: &str, fields: &Map<String, Value>) -> String {
    let verdict = verdict(fields).map_or_else(String::new, |v| format!(" {}", badge(&v)));
    let sentence = fields.get("explanation").and_then(Value::as_str);
    let sentence = sentence.map_or_else(String::new, |s| format!("<p>{}</p>\n", escape(s)));
    format!(
        "<details class=\"card\" id=\"{}\"><summary><h3>{}{verdict}</h3></summary>\n{sentence}{}<p class=\"note\">From {}</p></details>\n",
        anchor(name),
        title(fields),
        facts::tables(fields),
        link(name)
    )
}

/// The text of a node without markup: the five entities of XML as the characters they stand for.
fn unescape(text: &str) -> String {
    let known = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    known.iter().fold(text.to_owned(), |text, (entity, character)| text.replace(entity, character))
}

/// As an image: scripts and styles of one picture reach neither the page nor other pictures.
fn picture(name: &str, svg: &str) -> String {
    let inner = |from: &str, to: &str| {
        let text = svg.split(from).nth(1).and_then(|rest| rest.split(to).next()).unwrap_or_default();
        // the file may be anybody's: what it calls escaped is read, and escaped here
        escape(&unescape(text.trim()))
    };
    let (title, description) =
        (inner("<title id=\"title\">", "</title>"), inner("<desc id=\"desc\">", "</desc>"));
    let title = if title.is_empty() { escape(name) } else { title };
    format!(
        "<figure class=\"card\"><img alt=\"{}\" src=\"data:image/svg+xml,{}\"><figcaption>{title} ({})</figcaption></figure>\n",
        if description.is_empty() { &title } else { &description },
        utf8_percent_encode(svg, NON_ALPHANUMERIC),
        link(name)
    )
}

/// Every file with its size, hash, version and seed.
fn provenance(out: &mut String, contents: &[(&ReportFile, Content)]) {
    out.push_str(
        "<section id=\"files\"><h2>Files</h2>\n<details class=\"card\"><summary>Names, sizes and hashes of all files</summary>\n<div class=\"wide\"><table><thead><tr><th scope=\"col\">file</th><th scope=\"col\">bytes</th>\
         <th scope=\"col\">SHA-256</th><th scope=\"col\">equipod</th><th scope=\"col\">seed</th><th scope=\"col\">tolerances</th></tr></thead><tbody>\n",
    );
    for (file, content) in contents {
        let field = |key: &str| match content {
            Content::Result(fields) => fields
                .get("provenance")
                .and_then(|made_from| made_from.get(key))
                .filter(|v| !v.is_null())
                .map(|v| v.as_str().map_or_else(|| v.to_string(), str::to_owned)),
            _ => None,
        };
        let tolerances = match content {
            Content::Result(fields) => tolerances(fields),
            _ => String::new(),
        };
        let cell = |x: Option<String>| x.map_or_else(|| "\u{2013}".into(), |t| escape(&t));
        let _ = writeln!(
            out,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"hash\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            link(&file.name),
            file.bytes.len(),
            sha256(&file.bytes),
            cell(field("version")),
            cell(field("seed")),
            if tolerances.is_empty() { "\u{2013}".into() } else { tolerances },
        );
    }
    out.push_str("</tbody></table></div></details></section>\n");
}

/// What the result calls tolerances, at the top or one level below.
fn tolerances(fields: &Map<String, Value>) -> String {
    let below = fields.values().filter_map(Value::as_object).filter_map(|o| o.get("tolerances"));
    let tables = fields.get("tolerances").into_iter().chain(below).filter_map(Value::as_object);
    let single = fields.get("tolerance").map(|v| format!("tolerance {v}"));
    let each = tables.flatten().map(|(key, v)| format!("{} {v}", key.replace('_', " ")));
    escape(&single.into_iter().chain(each).collect::<Vec<_>>().join(", "))
}
