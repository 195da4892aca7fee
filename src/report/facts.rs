//! A JSON result as tables.

use std::fmt::Write as _;

use serde_json::{Map, Value};

use crate::plot::escape;

/// Rows of a list that are shown.
const ROWS: usize = 24;
/// Objects inside objects that are shown; deeper ones are in the file.
const DEPTH: usize = 3;

/// Fields that the page tells elsewhere.
const ELSEWHERE: [&str; 4] = ["schema_version", "provenance", "explanation", "warnings"];

/// Nine significant digits; the file has all of them.
fn number(n: &serde_json::Number) -> String {
    let Some(x) = n.as_f64().filter(|_| n.is_f64()) else { return n.to_string() };
    let text = format!("{x:.8e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trimmed = |t: &str| match t.split_once('.') {
        Some(_) => t.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => t.to_owned(),
    };
    if (-4..9).contains(&exponent) {
        // not negative in this range
        let decimals = usize::try_from(8 - exponent).unwrap_or(0);
        trimmed(&format!("{x:.decimals$}"))
    } else {
        format!("{}e{exponent}", trimmed(digits))
    }
}

fn scalar(v: &Value) -> Option<String> {
    match v {
        Value::Null => Some("\u{2013}".into()),
        Value::Bool(b) => Some(if *b { "yes".into() } else { "no".into() }),
        Value::Number(n) => Some(number(n)),
        Value::String(s) => Some(escape(s)),
        _ => None,
    }
}

/// Numbers side by side, where all entries are scalars.
fn row(list: &[Value]) -> Option<String> {
    if list.is_empty() {
        return Some("none".into());
    }
    let cells: Option<Vec<String>> = list.iter().map(scalar).collect();
    cells.map(|c| c.join(", "))
}

fn words(key: &str) -> String {
    escape(&key.replace('_', " "))
}

/// All fields of an object.
pub(super) fn tables(fields: &Map<String, Value>) -> String {
    let mut out = String::new();
    facts(&mut out, fields.iter().filter(|(key, _)| !ELSEWHERE.contains(&key.as_str())), 0);
    out
}

/// Scalars and short lists as one table, then everything else under its name.
fn facts<'a>(out: &mut String, fields: impl Iterator<Item = (&'a String, &'a Value)> + Clone, depth: usize) {
    let plain = |v: &Value| scalar(v).or_else(|| row(v.as_array()?.as_slice()).filter(|_| short(v)));
    let mut open = false;
    for (key, value) in fields.clone() {
        if let Some(text) = plain(value) {
            if !open {
                out.push_str("<table class=\"facts\"><tbody>\n");
                open = true;
            }
            let _ = writeln!(out, "<tr><th scope=\"row\">{}</th><td>{text}</td></tr>", words(key));
        }
    }
    if open {
        out.push_str("</tbody></table>\n");
    }
    for (key, value) in fields.filter(|(_, v)| plain(v).is_none()) {
        nested(out, key, value, depth);
    }
}

fn short(v: &Value) -> bool {
    v.as_array().is_none_or(|list| list.len() <= 12)
}

fn nested(out: &mut String, key: &str, value: &Value, depth: usize) {
    let name = words(key);
    match value {
        Value::Object(_) if depth >= DEPTH => {
            let _ = writeln!(out, "<p class=\"note\">{name}: in the file</p>");
        }
        Value::Object(fields) => {
            let _ =
                writeln!(out, "<details{}><summary>{name}</summary>", if depth == 0 { " open" } else { "" });
            facts(out, fields.iter(), depth + 1);
            out.push_str("</details>\n");
        }
        Value::Array(list) => {
            let plural = if list.len() == 1 { "entry" } else { "entries" };
            // a matrix is worth seeing at once
            let open = if list.len() <= 6 && list.iter().all(Value::is_array) { " open" } else { "" };
            let _ = writeln!(out, "<details{open}><summary>{name} ({} {plural})</summary>", list.len());
            table(out, list);
            out.push_str("</details>\n");
        }
        _ => {}
    }
}

/// A list as rows: objects by their plain fields, lists by their entries.
fn table(out: &mut String, list: &[Value]) {
    let cell = |v: &Value| scalar(v).or_else(|| row(v.as_array()?.as_slice()));
    let heads: Vec<&String> = list.first().and_then(Value::as_object).map_or(Vec::new(), |first| {
        first.iter().filter(|(_, v)| cell(v).is_some_and(|_| short(v))).map(|(key, _)| key).collect()
    });
    out.push_str("<div class=\"wide\"><table>\n");
    if !heads.is_empty() {
        let titles: Vec<String> =
            heads.iter().map(|h| format!("<th scope=\"col\">{}</th>", words(h))).collect();
        let titles = titles.concat();
        let _ = writeln!(out, "<thead><tr><th scope=\"col\">#</th>{titles}</tr></thead>");
    }
    out.push_str("<tbody>\n");
    for (k, entry) in list.iter().take(ROWS).enumerate() {
        let cells: Vec<String> = match entry {
            Value::Object(fields) => heads
                .iter()
                .map(|h| fields.get(*h).and_then(cell).unwrap_or_else(|| "\u{2013}".into()))
                .collect(),
            Value::Array(row) => row.iter().map(|v| cell(v).unwrap_or_else(|| "\u{2026}".into())).collect(),
            other => scalar(other).into_iter().collect(),
        };
        let cells: Vec<String> = cells.iter().map(|c| format!("<td>{c}</td>")).collect();
        let cells = cells.concat();
        let _ = writeln!(out, "<tr><th scope=\"row\">{}</th>{cells}</tr>", k + 1);
    }
    out.push_str("</tbody></table></div>\n");
    if list.len() > ROWS {
        let _ = writeln!(out, "<p class=\"note\">{} more in the file</p>", list.len() - ROWS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_nine_digits() {
        let show = |text: &str| scalar(&serde_json::from_str(text).unwrap()).unwrap();
        assert_eq!(show("22.105444020912273"), "22.105444");
        assert_eq!(show("0.24787573762799997"), "0.247875738");
        assert_eq!(show("1.924349568582784e-12"), "1.92434957e-12");
        assert_eq!((show("-0.5"), show("120"), show("1e300")), ("-0.5".into(), "120".into(), "1e300".into()));
        assert_eq!((show("null"), show("true")), ("\u{2013}".into(), "yes".into()));
    }
}
