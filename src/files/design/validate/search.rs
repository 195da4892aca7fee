//! The keys of `[optimize]` that say what may be chosen and what is best.

use super::holes::PLATE_KEYS;
use super::joints::NamedJoints;
use super::tables::positive;
use super::{check_keys, nearest_help, number, numbers, shown, table};
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use crate::design::{Code, Combination, SearchTable};
use machine::requirements::{KeptSymmetry, Objective, VariableKind};

/// The keys read here.
pub(super) const SEARCH_KEYS: [&str; 11] = [
    "variables",
    "symmetry",
    "objective",
    "objectives",
    "mode",
    "slack",
    "points",
    "offset_bounds",
    "stretch_bounds",
    "height_bounds",
    "fixed",
];
/// Share of the earlier levels that later ones may take.
const SLACK: f64 = 0.01;
/// Steps of a Pareto front, and the most.
const POINTS: (usize, usize) = (10, 100);

/// The search part of `[optimize]`.
pub(super) fn search(
    report: &mut Findings<'_>,
    entries: &[Entry],
    bodies: [Option<&NamedJoints>; 2],
) -> SearchTable {
    SearchTable {
        variables: variables(report, entries),
        symmetry: symmetry(report, entries),
        objectives: objectives(report, entries),
        mode: mode(report, entries),
        offset_bounds: bounds(report, entries, "offset_bounds"),
        stretch_bounds: bounds(report, entries, "stretch_bounds"),
        height_bounds: bounds(report, entries, "height_bounds"),
        fixed: fixed(report, entries, bodies),
    }
}

/// `fixed`: names of joints, or of a body for all its joints; a name that both bodies have means both joints.
fn fixed(
    report: &mut Findings<'_>,
    entries: &[Entry],
    bodies: [Option<&NamedJoints>; 2],
) -> [Vec<String>; 2] {
    let mut out = [Vec::new(), Vec::new()];
    let Some(entry) = find(entries, "fixed") else { return out };
    let names = bodies.map(|body| body.map(NamedJoints::names).unwrap_or_default());
    for node in list(report, entry) {
        let Value::Text(word) = &node.value else {
            let message = format!("a name of `fixed` is {}, not a string", node.value.kind());
            report.refuse(
                Code::WrongType,
                &node.span,
                message,
                "write names of joints, \"base\" or \"platform\"",
            );
            continue;
        };
        let mut known = false;
        for (k, body) in PLATE_KEYS.into_iter().enumerate() {
            let own = names[k].iter().filter(|name| word == body || *name == word);
            let new: Vec<String> = own.cloned().collect();
            known |= !new.is_empty();
            out[k].extend(new);
        }
        if !known && bodies.iter().all(Option::is_some) {
            let all: Vec<&str> =
                PLATE_KEYS.into_iter().chain(names.iter().flatten().map(String::as_str)).collect();
            let message = format!("`{}` is no joint of the design", shown(word));
            report.refuse(Code::UnknownName, &node.span, message, nearest_help("known names", word, &all));
        }
    }
    for list in &mut out {
        list.sort();
        list.dedup();
    }
    out
}

/// One of the names; a name that is not known is refused.
fn named<T: Copy>(
    report: &mut Findings<'_>,
    node: &Node,
    what: &str,
    all: &[(&'static str, T)],
) -> Option<T> {
    let names: Vec<&str> = all.iter().map(|a| a.0).collect();
    let Value::Text(text) = &node.value else {
        let message = format!("{what} is {}, not a string", node.value.kind());
        report.refuse(Code::WrongType, &node.span, message, format!("write one of {}", names.join(", ")));
        return None;
    };
    let found = all.iter().find(|a| a.0 == text).map(|a| a.1);
    if found.is_none() {
        let message = format!("`{}` is not {what}", shown(text));
        report.refuse(Code::UnknownKey, &node.span, message, nearest_help("known keys", text, &names));
    }
    found
}

fn list<'a>(report: &mut Findings<'_>, entry: &'a Entry) -> &'a [Node] {
    if let Value::Array(list) = &entry.node.value {
        return list;
    }
    let message = format!("`{}` is {}, not an array", entry.key, entry.node.value.kind());
    report.refuse(Code::WrongType, &entry.node.span, message, "write an array");
    &[]
}

fn variables(report: &mut Findings<'_>, entries: &[Entry]) -> Vec<VariableKind> {
    let Some(entry) = find(entries, "variables") else { return Vec::new() };
    let all = VariableKind::ALL.map(|v| (v.code(), v));
    let names = list(report, entry);
    names.iter().filter_map(|node| named(report, node, "a variable", &all)).collect()
}

fn symmetry(report: &mut Findings<'_>, entries: &[Entry]) -> Option<KeptSymmetry> {
    let all = KeptSymmetry::ALL.map(|s| (s.code(), s));
    find(entries, "symmetry").and_then(|entry| named(report, &entry.node, "a symmetry", &all))
}

fn objectives(report: &mut Findings<'_>, entries: &[Entry]) -> Vec<(Objective, f64)> {
    let all = Objective::ALL.map(|o| (o.code(), o));
    match (find(entries, "objective"), find(entries, "objectives")) {
        (Some(entry), Some(_)) => {
            let help = "keep one of `objective` and `objectives`";
            report.refuse(Code::ConflictingKeys, &entry.key_span, "objectives are given twice", help);
            Vec::new()
        }
        (Some(entry), None) => {
            named(report, &entry.node, "an objective", &all).map(|o| (o, 1.0)).into_iter().collect()
        }
        (None, Some(entry)) => {
            let nodes = list(report, entry);
            nodes.iter().filter_map(|node| weighted(report, node, &all)).collect()
        }
        (None, None) => Vec::new(),
    }
}

/// A name, or `{ name, weight }`.
fn weighted(
    report: &mut Findings<'_>,
    node: &Node,
    all: &[(&'static str, Objective)],
) -> Option<(Objective, f64)> {
    if matches!(node.value, Value::Text(_)) {
        return named(report, node, "an objective", all).map(|o| (o, 1.0));
    }
    let entries = table(report, node, "an objective")?;
    check_keys(report, entries, &["name", "weight"], "an objective");
    let weight = if find(entries, "weight").is_some() { positive(report, entries, "weight")? } else { 1.0 };
    let Some(entry) = find(entries, "name") else {
        let message = "an objective without a name".to_string();
        report.refuse(Code::MissingKey, &node.span, message, "write { name = \"...\", weight = 1.0 }");
        return None;
    };
    named(report, &entry.node, "an objective", all).map(|o| (o, weight))
}

fn mode(report: &mut Findings<'_>, entries: &[Entry]) -> Option<Combination> {
    let slack = positive(report, entries, "slack");
    let points = find(entries, "points").and_then(|e| points(report, &e.node));
    let all = [("weighted", 0), ("lexicographic", 1), ("pareto", 2)];
    let chosen = find(entries, "mode").and_then(|e| named(report, &e.node, "a mode", &all));
    for (key, needs, mode) in [("slack", 1, "lexicographic"), ("points", 2, "pareto")] {
        if let (Some(e), true) = (find(entries, key), chosen != Some(needs)) {
            let message = format!("`{key}` without `mode = \"{mode}\"`");
            report.refuse(Code::MissingKey, &e.key_span, message, format!("remove `{key}`, or add the mode"));
        }
    }
    Some(match chosen? {
        0 => Combination::Weighted,
        1 => Combination::Lexicographic { slack: slack.unwrap_or(SLACK) },
        _ => Combination::Pareto { points: points.unwrap_or(POINTS.0) },
    })
}

fn points(report: &mut Findings<'_>, node: &Node) -> Option<usize> {
    let x = number(report, node, "`points`")?;
    let whole = (2..=POINTS.1).find(|n| (*n as f64 - x).abs() < 1e-9);
    if whole.is_some() {
        return whole;
    }
    let help = format!("give a whole number from 2 to {}", POINTS.1);
    report.refuse(Code::OutOfRange, &node.span, format!("`points` is {x}"), help);
    None
}

fn bounds(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<(f64, f64)> {
    let node = &find(entries, key)?.node;
    let [low, high] =
        numbers::<2>(report, node, &format!("`{key}`"), Code::CoordinateCount, "bounds, least and greatest")?;
    if low > high {
        let message = format!("`{key}` from {low} to {high}");
        report.refuse(Code::OutOfRange, &node.span, message, "give [least, greatest]");
    }
    Some((low, high))
}
