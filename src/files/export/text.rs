//! Numbers and names in the notations of the formats.

use nalgebra::Vector3;

use num::names::changes_direction;

/// The shortest decimal that reads back to the same double, never `-0.0`.
pub(super) fn real(x: f64) -> String {
    format!("{:?}", x + 0.0)
}

/// A real of ISO 10303-21: the point is compulsory, the exponent is `E`.
pub(super) fn step_real(x: f64) -> String {
    let text = real(x);
    match text.split_once('e') {
        Some((mantissa, exponent)) if mantissa.contains('.') => format!("{mantissa}E{exponent}"),
        Some((mantissa, exponent)) => format!("{mantissa}.0E{exponent}"),
        None => text,
    }
}

/// Reals separated by `between`.
pub(super) fn reals(values: impl IntoIterator<Item = f64>, between: &str) -> String {
    values.into_iter().map(real).collect::<Vec<_>>().join(between)
}

/// Coordinates times `factor`, separated by `between`.
pub(super) fn scaled(v: &Vector3<f64>, factor: f64, between: &str) -> String {
    reals(v.iter().map(|x| x * factor), between)
}

/// Text on one line: control characters become spaces.
pub(super) fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Text on one line in ASCII; `write` replaces other characters.
pub(super) fn ascii(text: &str, write: impl Fn(char) -> String) -> String {
    one_line(text).chars().map(|c| if c.is_ascii() { c.to_string() } else { write(c) }).collect()
}

/// Rounded to a thousandth, the precision of millimetres and kilograms in texts.
pub(super) fn rounded(x: f64) -> String {
    real((x * 1e3).round() / 1e3)
}

/// Lines that each begin with `mark` and a space.
pub(super) fn commented(mark: &str, lines: impl IntoIterator<Item = String>) -> String {
    let mut out = String::new();
    for line in lines {
        out.push_str(mark);
        out.push(' ');
        out.push_str(&line);
        out.push('\n');
    }
    out
}

/// Text of an XML comment, on one line: two hyphens would end it.
pub(super) fn xml_comment(text: &str) -> String {
    let mut out = String::new();
    for c in one_line(text).chars() {
        if c == '-' && out.ends_with('-') {
            out.push(' ');
        }
        out.push(c);
    }
    out
}

/// A field of a CSV table (RFC 4180) on one line. A leading apostrophe keeps a spreadsheet from reading the text as a
/// formula.
pub fn csv_field(text: &str) -> String {
    let mut text: String = one_line(text).chars().filter(|c| !changes_direction(*c)).collect();
    if text.starts_with(['=', '+', '-', '@']) && text.parse::<f64>().is_err() {
        text.insert(0, '\'');
    }
    if text.contains([',', '"', '#']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}
