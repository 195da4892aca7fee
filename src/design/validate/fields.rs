//! Keys, texts and numbers.

use crate::design::Code;
use crate::design::report::Report;
use crate::design::tree::{Entry, Node, Span, Value, find};

/// Greatest magnitude of a number: its square and fourth power still fit a double.
const LARGEST: f64 = 1e60;
/// Smallest size of a design, for the same reason.
pub(super) const SMALLEST: f64 = 1e-60;

/// Refuses every key that is not in `known`.
pub(super) fn check_keys(report: &mut Report<'_>, entries: &[Entry], known: &[&str], place: &str) {
    for entry in entries.iter().filter(|e| !known.contains(&e.key.as_str())) {
        let message = format!("`{}` is not a key of {place}", shown(&entry.key));
        report.refuse(Code::UnknownKey, &entry.key_span, message, nearest_help(&entry.key, known));
    }
}

/// "did you mean ..." when something is near, else the list.
pub(super) fn nearest_help(given: &str, known: &[&str]) -> String {
    nearest(given, known)
        .map_or_else(|| format!("known keys: {}", known.join(", ")), |key| format!("did you mean `{key}`?"))
}

/// The candidate with the highest Jaro-Winkler similarity to `given`, if it is above 0.7.
pub(super) fn nearest<'a>(given: &str, candidates: &[&'a str]) -> Option<&'a str> {
    if given.len() > 100 {
        return None; // no slip of the pen, and the comparison is quadratic
    }
    let similarity = |c: &str| strsim::jaro_winkler(&given.to_lowercase(), &c.to_lowercase());
    let best = candidates.iter().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    best.copied().filter(|c| similarity(c) > 0.7)
}

/// A name as it is put into messages: control characters escaped, cut after 60 characters.
pub(super) fn shown(name: &str) -> String {
    let mut text: String = name.chars().take(60).flat_map(char::escape_debug).collect();
    if name.chars().nth(60).is_some() {
        text.push_str("...");
    }
    text
}

/// A text that is not blank.
pub(super) fn text(report: &mut Report<'_>, entry: &Entry) -> Option<String> {
    let key = &entry.key;
    match &entry.node.value {
        Value::Text(s) if !s.trim().is_empty() => Some(s.clone()),
        Value::Text(_) => {
            let help = format!("write something between the quotes of `{key}`");
            report.refuse(Code::EmptyName, &entry.node.span, format!("`{key}` is empty"), help);
            None
        }
        other => {
            let message = format!("`{key}` is {}, not a string", other.kind());
            report.refuse(Code::WrongType, &entry.node.span, message, format!("write `{key} = \"...\"`"));
            None
        }
    }
}

pub(super) fn text_or_absent(report: &mut Report<'_>, entries: &[Entry], key: &str) -> Option<String> {
    find(entries, key).and_then(|e| text(report, e))
}

/// A finite number of a magnitude that can be squared.
pub(super) fn number(report: &mut Report<'_>, node: &Node, what: &str) -> Option<f64> {
    match &node.value {
        Value::Number(x) if !x.is_finite() => {
            let message = format!("{what} is {x}, not a finite number");
            report.refuse(Code::NonFinite, &node.span, message, "write a finite number");
            None
        }
        Value::Number(x) if x.abs() > LARGEST => {
            let message = format!("{what} is {x:e}, which is too large to compute with");
            report.refuse(
                Code::OutOfRange,
                &node.span,
                message,
                format!("stay below {LARGEST:e}; use a larger unit"),
            );
            None
        }
        Value::Number(x) => Some(*x),
        other => {
            let message = format!("{what} is {}, not a number", other.kind());
            report.refuse(Code::WrongType, &node.span, message, "write a number without quotes");
            None
        }
    }
}

/// An array of exactly `N` finite numbers; every bad element is reported.
pub(super) fn numbers<const N: usize>(
    report: &mut Report<'_>,
    node: &Node,
    what: &str,
    count: Code,
    noun: &str,
) -> Option<[f64; N]> {
    let Value::Array(elements) = &node.value else {
        let message = format!("{what} is {}, not an array", node.value.kind());
        report.refuse(Code::WrongType, &node.span, message, format!("write an array of {N} {noun}"));
        return None;
    };
    if elements.len() != N {
        let message = format!("{what} has {} numbers instead of {N}", elements.len());
        report.refuse(count, &node.span, message, format!("give {N} {noun}"));
    }
    let values: Vec<Option<f64>> = elements
        .iter()
        .enumerate()
        .map(|(i, e)| number(report, e, &format!("number {} of {what}", i + 1)))
        .collect();
    let values: Vec<f64> = values.into_iter().collect::<Option<_>>()?;
    values.try_into().ok()
}

/// The elements of an array that are numbers; the others as NaN, so that positions stay.
pub(super) fn elements(node: &Node) -> impl Iterator<Item = f64> {
    let list = if let Value::Array(list) = &node.value { list.as_slice() } else { &[] };
    list.iter().map(|e| if let Value::Number(x) = e.value { x } else { f64::NAN })
}

/// Span of element `i` of an array, the whole node if there is none.
pub(super) fn element_span(node: &Node, i: usize) -> Span {
    match &node.value {
        Value::Array(elements) => elements.get(i).map_or_else(|| node.span.clone(), |e| e.span.clone()),
        _ => node.span.clone(),
    }
}

/// The entries of a table, or a refusal.
pub(super) fn table<'a>(report: &mut Report<'_>, node: &'a Node, what: &str) -> Option<&'a [Entry]> {
    match &node.value {
        Value::Table(entries) => Some(entries),
        other => {
            let message = format!("{what} is {}, not a table", other.kind());
            report.refuse(Code::WrongType, &node.span, message, format!("write {what} as a table"));
            None
        }
    }
}
