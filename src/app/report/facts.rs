//! A JSON result as tables.

use std::fmt::Write as _;

use serde_json::{Map, Value};

use files::plot::escape;

/// Rows of a list that are shown.
const ROWS: usize = 24;
/// Objects inside objects that are shown; deeper ones are in the file.
const DEPTH: usize = 3;

/// Fields that the page tells elsewhere.
const ELSEWHERE: [&str; 4] = ["schema_version", "provenance", "explanation", "warnings"];

fn number(n: &serde_json::Number) -> String {
    n.as_f64().filter(|_| n.is_f64()).map_or_else(|| n.to_string(), digits)
}

/// Six significant digits, which is more than a machine is made to; the file has all of them.
pub(super) fn digits(x: f64) -> String {
    let text = format!("{x:.5e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trimmed = |t: &str| match t.split_once('.') {
        Some(_) => t.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => t.to_owned(),
    };
    if (-4..9).contains(&exponent) {
        let decimals = usize::try_from(5 - exponent).unwrap_or(0);
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
        Value::String(s) => Some(escape(&if is_name(s) { s.replace('_', " ") } else { s.clone() })),
        _ => None,
    }
}

/// Whether a text is a word of the answers, such as `leg_too_short`, and no sentence, path or name of a user.
fn is_name(text: &str) -> bool {
    text.contains('_') && text.chars().all(|c| c.is_ascii_lowercase() || c == '_')
}

/// Numbers side by side, where all entries are scalars.
fn row(list: &[Value]) -> Option<String> {
    if list.is_empty() {
        return Some("none".into());
    }
    let cells: Option<Vec<String>> = list.iter().map(scalar).collect();
    cells.map(|c| c.join(", "))
}

/// A field as people call it: short names in full, the unit at the end of a name in brackets.
pub(super) fn words(key: &str) -> String {
    const SHORT: [(&str, &str); 10] = [
        ("p", "position"),
        ("q", "quaternion w, x, y, z"),
        ("R", "rotation"),
        ("re", "real part"),
        ("im", "imaginary part"),
        ("A", "A (leg map)"),
        ("c", "c (leg map)"),
        ("det", "det A"),
        ("det_exact", "det A, exact"),
        ("at_limit", "at its limit"),
    ];
    const UNITS: [&str; 6] = ["deg", "rad", "mm", "um", "us", "s"];
    if let Some((_, full)) = SHORT.iter().find(|(short, _)| *short == key) {
        return (*full).to_owned();
    }
    match key.rsplit_once('_').filter(|(_, end)| UNITS.contains(end)) {
        Some((name, unit)) => format!("{} [{unit}]", escape(&name.replace('_', " "))),
        None => escape(&key.replace('_', " ")),
    }
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
    // what does not apply is in the file
    for (key, value) in fields.clone().filter(|(_, v)| !v.is_null()) {
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
    let empty = |key: &String| list.iter().all(|entry| entry.get(key).is_none_or(Value::is_null));
    let heads: Vec<&String> = list.first().and_then(Value::as_object).map_or(Vec::new(), |first| {
        let shown = first.iter().filter(|(_, v)| cell(v).is_some_and(|_| short(v)));
        shown.map(|(key, _)| key).filter(|key| !empty(key)).collect()
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
    fn numbers_keep_the_digits_that_mean_something() {
        let show = |text: &str| scalar(&serde_json::from_str(text).unwrap()).unwrap();
        assert_eq!(show("22.105444020912273"), "22.1054");
        assert_eq!(show("-171.01007176555896"), "-171.01");
        assert_eq!(show("0.24787573762799997"), "0.247876");
        assert_eq!(show("123456789.25"), "123456789");
        assert_eq!(show("1.924349568582784e-12"), "1.92435e-12");
        assert_eq!((show("-0.5"), show("120"), show("1e300")), ("-0.5".into(), "120".into(), "1e300".into()));
        assert_eq!((show("null"), show("true")), ("\u{2013}".into(), "yes".into()));
    }

    #[test]
    fn names_of_fields_and_answers_read_as_words() {
        let show = |text: &str| scalar(&serde_json::from_str(text).unwrap()).unwrap();
        assert_eq!(show("\"leg_too_short\""), "leg too short");
        assert_eq!(show("\"A1_A2\""), "A1_A2", "the name of a joint stays");
        assert_eq!(
            (words("rotation_deg"), words("real_count")),
            ("rotation [deg]".into(), "real count".into())
        );
        assert_eq!(words("worst_s"), "worst [s]");
        assert_eq!(words("p"), "position");
    }

    #[test]
    fn what_does_not_apply_takes_no_room() {
        let list: Vec<Value> = serde_json::from_str(r#"[{"a":1,"b":null},{"a":2,"b":null}]"#).unwrap();
        let mut out = String::new();
        table(&mut out, &list);
        assert!(
            out.contains("<th scope=\"col\">a</th>") && !out.contains("<th scope=\"col\">b</th>"),
            "{out}"
        );
        let some: Vec<Value> = serde_json::from_str(r#"[{"a":1,"b":null},{"a":2,"b":3}]"#).unwrap();
        let mut out = String::new();
        table(&mut out, &some);
        assert!(out.contains("<th scope=\"col\">b</th>"), "{out}");
        let fields: Map<String, Value> = serde_json::from_str(r#"{"a":1,"missing_count":null}"#).unwrap();
        assert!(!tables(&fields).contains("missing"));
    }
}
