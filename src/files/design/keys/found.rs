//! Reading of keys, texts and numbers, with the violations for invalid ones.

use super::kind::{KeyForm, KeyKind, Range};
use super::stored::{Stored, Word};
use super::{Code, KeyTable};
use crate::design::nearest_word;
use crate::design::tree::{Entry, Node, Span, Value};
use crate::design::violation::Findings;

/// Least similarity for a suggestion.
const NEAR: f64 = 0.7;

/// Greatest magnitude of a number: its square and fourth power still fit a double.
pub(in crate::design) const LARGEST: f64 = 1e60;

/// Refuses every key that is not in `known`.
pub fn check_keys(report: &mut Findings<'_>, entries: &[Entry], known: &[&str], place: &str) {
    for entry in entries.iter().filter(|e| !known.contains(&e.key.as_str())) {
        let message = format!("`{}` is not a key of {place}", shown(&entry.key));
        let help =
            if report.is_full() { String::new() } else { nearest_help("known keys", &entry.key, known) };
        report.refuse(Code::UnknownKey, &entry.key_span, message, help);
    }
}

/// "did you mean ..." for a similar name, otherwise the list of names after `what`.
pub fn nearest_help(what: &str, given: &str, known: &[&str]) -> String {
    let near = nearest(given, known).map(|near| format!("did you mean `{}`?", shown(near)));
    near.unwrap_or_else(|| {
        let more = if known.len() > 20 { ", and more" } else { "" };
        let names: Vec<String> = known.iter().take(20).map(|k| shown(k)).collect();
        format!("{what}: {}{more}", names.join(", "))
    })
}

/// The similar known word, if there is one.
pub(super) fn nearest<'a>(given: &str, known: &[&'a str]) -> Option<&'a str> {
    nearest_word(given, known, NEAR)
}

/// A name as it is put into messages: control characters escaped, cut after 60 characters.
pub fn shown(name: &str) -> String {
    let mut text: String = name.chars().take(60).flat_map(char::escape_debug).collect();
    if name.chars().nth(60).is_some() {
        text.push_str("...");
    }
    text
}

/// A text that is not blank.
pub fn text(report: &mut Findings<'_>, entry: &Entry) -> Option<String> {
    let key = &entry.key;
    match &entry.node.value {
        Value::Text(s) if !s.trim().is_empty() => Some(s.clone()),
        Value::Text(_) => {
            let help = format!("write something between the quotes of `{key}`");
            report.refused(Code::EmptyName, &entry.node.span, format!("`{key}` is empty"), help)
        }
        _ => report.not_a(&entry.node, &format!("`{key}`"), "a string", format!("write `{key} = \"...\"`")),
    }
}

/// A finite number of a magnitude that can be squared.
pub fn number(report: &mut Findings<'_>, node: &Node, what: &str) -> Option<f64> {
    match &node.value {
        Value::Number(x) if !x.is_finite() => {
            let message = format!("{what} is {x}, not a finite number");
            report.refused(Code::NonFinite, &node.span, message, "write a finite number")
        }
        Value::Number(x) if x.abs() > LARGEST => {
            let message = format!("{what} is {x:e}, which is too large to compute with");
            report.refused(
                Code::OutOfRange,
                &node.span,
                message,
                format!("stay below {LARGEST:e}; use a larger unit"),
            )
        }
        Value::Number(x) => Some(*x),
        _ => report.not_a(node, what, "a number", "write a number without quotes"),
    }
}

/// An array of exactly `N` finite numbers; every bad element is reported.
pub(super) fn numbers<const N: usize>(
    report: &mut Findings<'_>,
    node: &Node,
    what: &str,
    count: Code,
    noun: &str,
) -> Option<[f64; N]> {
    let Value::Array(elements) = &node.value else {
        return report.not_a(node, what, "an array", format!("write an array of {N} {noun}"));
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
pub fn table<'a>(report: &mut Findings<'_>, node: &'a Node, what: &str) -> Option<&'a [Entry]> {
    match &node.value {
        Value::Table(entries) => Some(entries),
        _ => report.not_a(node, what, "a table", format!("write {what} as a table")),
    }
}

/// The entry of a key of a table.
pub(super) struct FoundKey<'a, 't> {
    pub(super) report: &'a mut Findings<'t>,
    pub(super) entry: &'a Entry,
    /// The table, for messages.
    pub(super) place: &'a str,
    pub(super) kind: KeyKind,
}

impl<'a> FoundKey<'a, '_> {
    /// The key, for messages.
    pub(super) fn what(&self) -> String {
        let key = &self.entry.key;
        if self.kind.is_placed { format!("`{key}` of {}", self.place) } else { format!("`{key}`") }
    }

    /// Puts the value into a field.
    pub(super) fn fill(&mut self, field: &mut impl Stored) {
        field.fill(self);
    }

    /// Refuses the value; what can be read of it may be used for later checks.
    pub(super) fn refuse(&mut self, code: Code, message: impl Into<String>, help: impl Into<String>) {
        self.report.refuse(code, &self.entry.node.span, message, help);
    }

    /// Refuses the value, of which nothing can be used.
    pub(super) fn refused<T>(
        &mut self,
        code: Code,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.report.refused(code, &self.entry.node.span, message, help)
    }

    /// A number in the range of the key. Numbers out of range are returned too, for later checks.
    pub(super) fn number(&mut self) -> Option<f64> {
        let (what, key) = (self.what(), &self.entry.key);
        let x = number(self.report, &self.entry.node, &what)?;
        let KeyForm::Number(range) = self.kind.form else { return Some(x) };
        let message = format!("`{key}` is {x}");
        match range {
            Range::NotNegative if x < 0.0 => self.refuse(Code::NotPositive, message, "give 0 or more"),
            Range::Any | Range::NotNegative => {}
            _ if x <= 0.0 => self.refuse(Code::NotPositive, message, "give a positive number"),
            Range::HalfTurn if x > 180.0 => {
                self.refuse(Code::OutOfRange, message, "stay within 180 degrees");
            }
            Range::Below(most) if x >= f64::from(most) => {
                let help = format!("give an angle below {most} degrees");
                self.refuse(Code::OutOfRange, format!("{message} degrees"), help);
            }
            Range::Positive | Range::HalfTurn | Range::Below(_) => {}
        }
        Some(x)
    }

    /// A list of numbers in the range of the key.
    pub(super) fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let what = self.what();
        self.numbers_called(&what)
    }

    fn numbers_called<const N: usize>(&mut self, what: &str) -> Option<[f64; N]> {
        let KeyForm::Numbers(n) = self.kind.form else { return None };
        let node = &self.entry.node;
        let list = numbers::<N>(self.report, node, what, n.code, n.noun)?;
        let is_out = |x: f64| match n.range {
            Range::Positive => x <= 0.0,
            Range::NotNegative => x < 0.0,
            _ => false,
        };
        for (i, x) in list.iter().enumerate().filter(|(_, x)| is_out(**x)) {
            let message = format!("{} {x}", n.one[0]);
            self.report.refuse(Code::NotPositive, &element_span(node, i), message, n.one[1]);
        }
        Some(list)
    }

    /// A text that is not blank.
    pub(super) fn text(&mut self) -> Option<String> {
        text(self.report, self.entry)
    }

    /// One of the words of a type.
    pub(super) fn word<W: Word>(&mut self) -> Option<W> {
        let word = self.text()?;
        let found = W::of(&word);
        if found.is_none() {
            let quoted: Vec<String> = W::words().iter().map(|w| format!("\"{w}\"")).collect();
            let help = match quoted.as_slice() {
                [a, b] => format!("write {a} or {b}"),
                [a, b, c] => format!("write {a}, {b} or {c}"),
                _ => format!("write one of {}", quoted.join(", ")),
            };
            let message = format!("{} is \"{}\"", self.what(), shown(&word));
            self.refuse(Code::WrongType, message, help);
        }
        found
    }

    /// The table behind the key.
    pub(super) fn table<M>(&mut self, keys: &KeyTable<M>, place: &str, to: &mut M) -> Option<&'a [Entry]> {
        keys.read(self.report, &self.entry.node, place, to)
    }

    /// Whether the value is a list.
    pub(super) fn is_list(&self) -> bool {
        matches!(self.entry.node.value, Value::Array(_))
    }
}
