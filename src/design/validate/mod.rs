//! One walk over the tree that collects every violation.

mod fields;
mod joints;
mod requirements;
#[cfg(test)]
mod schema_tests;
mod search;
mod tables;

use nalgebra::Point3;

use self::fields::{check_keys, numbers, text, text_or_absent};
use self::joints::{Body, Legs};
use super::report::Report;
use super::tree::{Entry, Node, Span, Value, find};
use super::{Code, Design, Warning};
use crate::manipulator::{InvalidManipulator, LegLengths, Manipulator};

const TOP_LEVEL: [&str; 15] = [
    "name",
    "units",
    "source",
    "description",
    "lengths",
    "legs",
    "base",
    "platform",
    "home",
    "workspace",
    "optimize",
    "hardware",
    "speed",
    "loads",
    "keep_out",
];

/// The design, or `None` with the reasons in the report. Later checks run on whatever earlier ones left
/// intact, so that one run shows all violations.
pub(super) fn design(root: &Node, report: &mut Report<'_>) -> Option<Design> {
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
    let base = required(report, root, entries, "base").and_then(|e| joints::body(report, "base", e));
    let platform =
        required(report, root, entries, "platform").and_then(|e| joints::body(report, "platform", e));
    let legs = match (legs_entry, &base, &platform) {
        (Some(entry), Some(base), Some(platform)) => joints::legs(report, entry, base, platform),
        _ => None,
    };
    let lengths = lengths(report, entries);
    let home = find(entries, "home").and_then(|e| tables::home(report, &e.node));
    let workspace = tables::workspace(report, entries);
    let (optimize, search) = tables::optimize(report, entries);
    let hardware = requirements::hardware(report, entries);
    let speed = requirements::speed(report, entries);
    let loads = requirements::loads(report, entries);
    let keep_outs = requirements::keep_outs(report, entries);
    if !report.is_clean() {
        return None;
    }
    let (base, platform) = (base?, platform?);
    let manipulator = manipulator(report, &root.span, &base, &platform, &legs?)?;
    let mut design =
        Design::new(name?, units?, manipulator).with_joint_names(base.names(), platform.names()).ok()?;
    design.source = source;
    design.description = description;
    design.lengths = lengths;
    design.home = home;
    design.workspace = workspace;
    design.optimize = optimize;
    design.search = search;
    design.hardware = hardware;
    design.speed = speed;
    design.loads = loads;
    design.keep_outs = keep_outs;
    Some(design)
}

fn required<'a>(report: &mut Report<'_>, root: &Node, entries: &'a [Entry], key: &str) -> Option<&'a Entry> {
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
fn legs_entry<'a>(report: &mut Report<'_>, root: &Node, entries: &'a [Entry]) -> Option<&'a Entry> {
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

fn lengths(report: &mut Report<'_>, entries: &[Entry]) -> Option<LegLengths> {
    let node = &find(entries, "lengths")?.node;
    let l = numbers::<6>(report, node, "`lengths`", Code::LengthCount, "leg lengths, one for each leg");
    for (i, x) in fields::elements(node).enumerate().filter(|(_, x)| *x < 0.0 && x.is_finite()) {
        let span = fields::element_span(node, i);
        let message = format!("the length of leg {} is {x}", i + 1);
        report.refuse(Code::NegativeLength, &span, message, "leg lengths are not negative");
    }
    LegLengths::try_new(l?).ok()
}

fn manipulator(
    report: &mut Report<'_>,
    root: &Span,
    base: &Body,
    platform: &Body,
    legs: &Legs,
) -> Option<Manipulator> {
    let points = |body: &Body| body.joints.iter().map(|j| Point3::from(j.point)).collect();
    match Manipulator::try_new(points(base), points(platform), legs.pairs) {
        Ok(m) if m.size() < fields::SMALLEST => {
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
