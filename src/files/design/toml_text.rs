//! TOML text to the spanned tree.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Code;
use super::tree::{Entry, MAX_DEPTH, Node, Value};
use super::violation::Findings;

/// Reads the text; `None` after syntax errors, which go to the report.
///
/// After a fault the parser continues where possible; an open bracket then makes every later line wrong. Therefore only
/// the first of neighbouring faulty lines is reported; a fault after good lines is reported again.
pub(super) fn read(text: &str, report: &mut Findings<'_>) -> Option<Node> {
    let (document, errors) = DeTable::parse_recoverable(text);
    let mut faults = Vec::new();
    for error in &errors {
        let span = error.span().unwrap_or(0..0);
        let message = error.message();
        if message.contains("duplicate key") {
            report.refuse(Code::DuplicateKey, &span, "this key is defined twice", "keep one of the two");
        } else if message.contains("recursion limit") {
            too_deep(report, &span);
        } else {
            faults.push((span, message));
        }
    }
    faults.sort_by_key(|(span, _)| span.start);
    let mut faulty_to = None;
    for (span, message) in faults {
        let line = report.line(span.start);
        if faulty_to.is_none_or(|last| (last + 1..line).any(|k| holds_toml(report.line_text(k)))) {
            let help = "correct the TOML (https://toml.io): strings need quotes, tables [brackets]; `equipod new --points FILE` reads tables of joints";
            report.refuse(Code::Syntax, &span, message, help);
        }
        faulty_to = Some(line);
    }
    if !errors.is_empty() {
        return None;
    }
    let span = document.span();
    let value = table(document.get_ref(), report, 0)?;
    Some(Node { span: span.start..span.start, value })
}

/// Whether a line holds more than blanks or a comment.
fn holds_toml(line: &str) -> bool {
    !line.trim().is_empty() && !line.trim_start().starts_with('#')
}

fn too_deep(report: &mut Findings<'_>, span: &std::ops::Range<usize>) {
    let help = "a design has tables of arrays of numbers, nothing deeper";
    report.refuse(Code::NestingTooDeep, span, format!("nested deeper than {MAX_DEPTH} levels"), help);
}

fn table(table: &DeTable<'_>, report: &mut Findings<'_>, depth: usize) -> Option<Value> {
    let mut entries = Vec::with_capacity(table.len());
    for (key, value) in table {
        let node = node(value, report, depth + 1)?;
        entries.push(Entry { key: key.get_ref().to_string(), key_span: key.span(), node });
    }
    // the parser sorts keys by name; joints keep the order of the file
    entries.sort_by_key(|e: &Entry| e.key_span.start);
    Some(Value::Table(entries))
}

fn node(value: &Spanned<DeValue<'_>>, report: &mut Findings<'_>, depth: usize) -> Option<Node> {
    let span = value.span();
    if depth > MAX_DEPTH {
        too_deep(report, &span);
        return None;
    }
    let value = match value.get_ref() {
        DeValue::String(s) => Value::Text(s.to_string()),
        DeValue::Integer(i) if i.radix() == 10 => number(i.as_str()),
        DeValue::Integer(_) => Value::Other("an integer that is not decimal"),
        DeValue::Float(f) => number(f.as_str()),
        DeValue::Boolean(_) => Value::Other("a boolean"),
        DeValue::Datetime(_) => Value::Other("a date"),
        DeValue::Array(a) => {
            Value::Array(a.iter().map(|v| node(v, report, depth + 1)).collect::<Option<_>>()?)
        }
        DeValue::Table(t) => table(t, report, depth)?,
    };
    Some(Node { span, value })
}

/// Rust rounds decimal text to the nearest double, and reads TOML's `inf` and `nan`.
fn number(text: &str) -> Value {
    text.parse().map_or(Value::Other("a number that cannot be read"), Value::Number)
}
