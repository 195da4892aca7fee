//! One walk over the tree that collects every violation, and the reading of keys, texts and numbers.

mod axes;
mod calibration;
mod constructions;
mod cranks;
mod holes;
mod joint_models;
mod joints;
mod limits;
mod plates;
#[cfg(test)]
mod schema_tests;
mod search;
mod tables;

use nalgebra::Point3;

use self::joints::{Legs, NamedJoints};
use super::tree::{Entry, Node, Span, Value, find};
use super::violation::Findings;
use super::{Code, DesignModel, Warning, nearest_word};
use platform::manipulator::{Body, InvalidManipulator, LegLengths, Manipulator};

/// Words less similar than this are no help.
const NEAR: f64 = 0.7;

const TOP_LEVEL: [&str; 27] = [
    "name",
    "units",
    "force_units",
    "mass_units",
    "source",
    "description",
    "drive",
    "lengths",
    "legs",
    "parameters",
    "base",
    "platform",
    "cranks",
    "home",
    "workspace",
    "optimize",
    "hardware",
    "speed",
    "stiffness",
    "loads",
    "keep_out",
    "payload",
    "envelope",
    "holes",
    "plates",
    "limits",
    "calibration",
];

/// The design, or `None` with the reasons in the report. Later checks run on whatever earlier ones left
/// intact, so that one run shows all violations. Rods on cranks, and joints that are not ideal, are refused unless `takes_cranks`.
pub(super) fn design(root: &Node, report: &mut Findings<'_>, takes_cranks: bool) -> Option<DesignModel> {
    let Value::Table(entries) = &root.value else {
        let help = "write { \"name\": ..., \"units\": ..., \"base\": { ... }, \"platform\": { ... }, \"legs\": [ ... ] }";
        report.refuse(
            Code::WrongType,
            &root.span,
            format!("a design is a table, not {}", root.value.kind()),
            help,
        );
        return None;
    };
    check_keys(report, entries, &TOP_LEVEL, "a design");
    let name = required(report, root, entries, "name").and_then(|e| text(report, e));
    let units = required(report, root, entries, "units").and_then(|e| text(report, e));
    let source = text_or_absent(report, entries, "source");
    let description = text_or_absent(report, entries, "description");
    let legs_entry = legs_entry(report, root, entries);
    let parameters = constructions::parameters(report, entries);
    let mut base = required(report, root, entries, "base").and_then(|e| joints::body(report, Body::Base, e));
    let mut platform =
        required(report, root, entries, "platform").and_then(|e| joints::body(report, Body::Platform, e));
    let home = find(entries, "home").and_then(|e| tables::home(report, &e.node));
    let (home, written_home) = home.unzip();
    let (cranks, crank_places) = cranks::cranks(report, entries, base.as_ref(), takes_cranks).unzip();
    let crank_places = crank_places.unwrap_or_default();
    let constructions = match (&mut base, &mut platform) {
        (Some(base), Some(platform)) => {
            let written =
                constructions::BesideJoints { home: written_home.flatten(), cranks: (cranks, &crank_places) };
            constructions::resolve(report, parameters, (base, platform), written)
        }
        _ => None,
    };
    for body in [&mut base, &mut platform].into_iter().flatten() {
        body.find_coincident(constructions.as_ref());
        joints::warn_coincident(report, body);
    }
    let legs = match (legs_entry, &base, &platform) {
        (Some(entry), Some(base), Some(platform)) => joints::legs(report, entry, base, platform),
        _ => None,
    };
    if let (Some(constructions), Some(base), Some(legs)) = (&constructions, &base, &legs) {
        cranks::check_legs(report, constructions, &crank_places, (base, legs));
    }
    let lengths = lengths(report, entries);
    let workspace = tables::workspace(report, entries);
    let (optimize, search) = tables::optimize(report, entries, [base.as_ref(), platform.as_ref()]);
    let hardware = tables::hardware(report, entries);
    let drive_table = tables::drive_table(report, entries);
    joint_models::refuse_coupled(report, entries, &hardware, takes_cranks);
    let speed = tables::speed(report, entries);
    let stiffness = tables::stiffness(report, entries, &hardware);
    let loads = tables::loads(report, entries);
    let keep_outs = tables::keep_outs(report, entries);
    let (force_units, mass_units) = limits::units(report, entries);
    let payload = limits::payload(report, entries);
    let envelopes = limits::envelopes(report, entries);
    let reserves = limits::reserves(report, entries);
    if let Some(units) = &units {
        limits::vibrating(report, entries, units);
    }
    let holes = holes::holes(report, entries);
    let plates = plates::plates(report, entries, &hardware, units.as_deref());
    let calibration = calibration::calibration(report, entries, [base.as_ref(), platform.as_ref()]);
    if !report.is_clean() {
        return None;
    }
    let (base, platform) = (base?, platform?);
    let manipulator = manipulator(report, &root.span, &base, &platform, &legs?)?;
    let mut design =
        DesignModel::new(name?, units?, manipulator).with_joint_names(base.names(), platform.names()).ok()?;
    design.home = home;
    design.set_constructions(constructions?);
    cranks::check_platform(report, &design, &crank_places);
    design.source = source;
    design.description = description;
    design.lengths = lengths;
    design.workspace = workspace;
    design.optimize = optimize;
    design.search = search;
    design.hardware = hardware;
    design.speed = speed;
    design.stiffness = stiffness;
    design.loads = loads;
    design.keep_outs = keep_outs;
    (design.payload, design.envelopes, design.reserves) = (payload, envelopes, reserves);
    (design.force_units, design.mass_units) = (force_units, mass_units);
    design.holes = holes;
    design.plates = plates;
    design.drive_table = drive_table;
    axes::turn_to_normals(report, entries, &mut design);
    design.calibration = calibration;
    plates::check_masses(report, entries, &design);
    Some(design)
}

fn required<'a>(
    report: &mut Findings<'_>,
    root: &Node,
    entries: &'a [Entry],
    key: &str,
) -> Option<&'a Entry> {
    let found = find(entries, key);
    if found.is_none() {
        let help = match key {
            "name" => "add `name = \"...\"` at the top",
            "units" => "add `units = \"mm\"` (a label; all lengths are in it) at the top",
            "legs" => {
                "add `legs = [[\"A1\", \"B1\"], ...]` with six pairs base-platform above the first [table]"
            }
            "base" => "add [base] with joints such as `A1 = [0.0, 0.0, 0.0]`",
            _ => "add [platform] with joints such as `B1 = [0.0, 0.0, 0.0]`",
        };
        report.refuse(
            Code::MissingKey,
            &(root.span.start..root.span.start),
            format!("`{key}` is missing"),
            help,
        );
    }
    found
}

/// `legs` belongs at the top level. Written below a table header TOML counts it to that table; there it
/// cannot be a joint (it holds pairs of names), so that the meaning is clear: it is taken with a warning.
fn legs_entry<'a>(report: &mut Findings<'_>, root: &Node, entries: &'a [Entry]) -> Option<&'a Entry> {
    if find(entries, "legs").is_none() {
        for table in ["base", "platform"] {
            let inner = find(entries, table).and_then(|e| match &e.node.value {
                Value::Table(inner) => find(inner, "legs"),
                _ => None,
            });
            if let Some(legs) = inner.filter(|e| joints::is_list_of_pairs(&e.node)) {
                let line = report.line(legs.key_span.start);
                report.warn(Warning::LegsInsideTable { table, line });
                return Some(legs);
            }
        }
    }
    required(report, root, entries, "legs")
}

fn lengths(report: &mut Findings<'_>, entries: &[Entry]) -> Option<LegLengths> {
    let node = &find(entries, "lengths")?.node;
    let l = numbers::<6>(report, node, "`lengths`", Code::LengthCount, "leg lengths, one for each leg");
    for (i, x) in elements(node).enumerate().filter(|(_, x)| *x < 0.0 && x.is_finite()) {
        let span = element_span(node, i);
        let message = format!("the length of leg {} is {x}", i + 1);
        report.refuse(Code::NegativeLength, &span, message, "leg lengths are not negative");
    }
    LegLengths::try_new(l?).ok()
}

fn manipulator(
    report: &mut Findings<'_>,
    root: &Span,
    base: &NamedJoints,
    platform: &NamedJoints,
    legs: &Legs,
) -> Option<Manipulator> {
    let points = |body: &NamedJoints| body.joints.iter().map(|j| Point3::from(j.point)).collect();
    match Manipulator::try_new(points(base), points(platform), legs.pairs) {
        Ok(m) if m.size() < SMALLEST => {
            let message = format!("the design is {:e} long", m.size());
            report.refuse(
                Code::OutOfRange,
                root,
                message,
                "use a smaller unit: squares of such lengths underflow",
            );
            None
        }
        Ok(m) => Some(m),
        Err(InvalidManipulator::NoSize) => {
            let message = "all joints in use of the base coincide, and so do those of the platform";
            report.refuse(Code::NoSize, root, message, "give the joints different coordinates");
            None
        }
        Err(InvalidManipulator::TooSmall) => {
            let advice = "use a smaller unit";
            report.refuse(Code::OutOfRange, root, InvalidManipulator::TooSmall.to_string(), advice);
            None
        }
        // names were looked up, coordinates and pairs checked: nothing else is left to go wrong
        Err(other) => {
            report.refuse(Code::MissingJoint, root, other.to_string(), "check joints and legs");
            None
        }
    }
}

/// Greatest magnitude of a number: its square and fourth power still fit a double.
const LARGEST: f64 = 1e60;
/// Smallest size of a design, for the same reason.
const SMALLEST: f64 = 1e-60;

/// Refuses every key that is not in `known`.
pub fn check_keys(report: &mut Findings<'_>, entries: &[Entry], known: &[&str], place: &str) {
    for entry in entries.iter().filter(|e| !known.contains(&e.key.as_str())) {
        let message = format!("`{}` is not a key of {place}", shown(&entry.key));
        let help =
            if report.is_full() { String::new() } else { nearest_help("known keys", &entry.key, known) };
        report.refuse(Code::UnknownKey, &entry.key_span, message, help);
    }
}

/// "did you mean ..." when something is near, else the list, `what` said before.
pub fn nearest_help(what: &str, given: &str, known: &[&str]) -> String {
    let near = nearest(given, known).map(|near| format!("did you mean `{}`?", shown(near)));
    near.unwrap_or_else(|| {
        let more = if known.len() > 20 { ", and more" } else { "" };
        let names: Vec<String> = known.iter().take(20).map(|k| shown(k)).collect();
        format!("{what}: {}{more}", names.join(", "))
    })
}

/// The word that was meant, where one is near.
fn nearest<'a>(given: &str, known: &[&'a str]) -> Option<&'a str> {
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

fn text_or_absent(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<String> {
    find(entries, key).and_then(|e| text(report, e))
}

/// A finite number of a magnitude that can be squared.
pub fn number(report: &mut Findings<'_>, node: &Node, what: &str) -> Option<f64> {
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
fn numbers<const N: usize>(
    report: &mut Findings<'_>,
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
fn elements(node: &Node) -> impl Iterator<Item = f64> {
    let list = if let Value::Array(list) = &node.value { list.as_slice() } else { &[] };
    list.iter().map(|e| if let Value::Number(x) = e.value { x } else { f64::NAN })
}

/// Span of element `i` of an array, the whole node if there is none.
fn element_span(node: &Node, i: usize) -> Span {
    match &node.value {
        Value::Array(elements) => elements.get(i).map_or_else(|| node.span.clone(), |e| e.span.clone()),
        _ => node.span.clone(),
    }
}

/// The entries of a table, or a refusal.
pub fn table<'a>(report: &mut Findings<'_>, node: &'a Node, what: &str) -> Option<&'a [Entry]> {
    match &node.value {
        Value::Table(entries) => Some(entries),
        other => {
            let message = format!("{what} is {}, not a table", other.kind());
            report.refuse(Code::WrongType, &node.span, message, format!("write {what} as a table"));
            None
        }
    }
}
