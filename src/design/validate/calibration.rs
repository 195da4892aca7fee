//! `[calibration]`: leg offsets and standard deviations.

use nalgebra::Vector3;

use super::joints::NamedJoints;
use super::{check_keys, element_span, elements, nearest_help, numbers, shown, table};
use crate::design::tree::{Entry, Node, find};
use crate::design::violation::Findings;
use crate::design::{CalibrationTable, Code};

pub(super) const CALIBRATION_KEYS: [&str; 4] =
    ["offsets", "offset_deviations", "base_deviations", "platform_deviations"];

/// The table, with the deviations of joints in the order of the joints of their body.
pub(super) fn calibration(
    report: &mut Findings<'_>,
    top: &[Entry],
    bodies: [Option<&NamedJoints>; 2],
) -> Option<CalibrationTable> {
    let entry = find(top, "calibration")?;
    let place = "[calibration]";
    let entries = table(report, &entry.node, place)?;
    check_keys(report, entries, &CALIBRATION_KEYS, place);
    let six = |report: &mut Findings<'_>, key: &str, noun: &str| {
        let node = &find(entries, key)?.node;
        numbers::<6>(report, node, &format!("`{key}`"), Code::LengthCount, noun)
    };
    let offsets = six(report, "offsets", "offsets, one for each leg");
    let offset_deviations = six(report, "offset_deviations", "standard deviations, one for each leg");
    if let Some(e) = find(entries, "offset_deviations") {
        not_negative(report, &e.node);
    }
    let [base_deviations, platform_deviations] = [0, 1].map(|body| {
        let key = CALIBRATION_KEYS[2 + body];
        find(entries, key).and_then(|e| Some(deviations(report, e, bodies[body]?))).unwrap_or_default()
    });
    Some(CalibrationTable {
        offsets: offsets.unwrap_or_default(),
        offset_deviations,
        base_deviations,
        platform_deviations,
    })
}

fn not_negative(report: &mut Findings<'_>, node: &Node) {
    for (i, x) in elements(node).enumerate().filter(|(_, x)| *x < 0.0 && x.is_finite()) {
        let message = format!("a standard deviation of {x}");
        let help = "standard deviations are not negative";
        report.refuse(Code::NotPositive, &element_span(node, i), message, help);
    }
}

/// Three numbers for each joint that is named.
fn deviations(report: &mut Findings<'_>, entry: &Entry, body: &NamedJoints) -> Vec<Option<Vector3<f64>>> {
    let place = format!("`{}` of [calibration]", entry.key);
    let names = body.names();
    let mut out = vec![None; names.len()];
    for joint in table(report, &entry.node, &place).unwrap_or_default() {
        let Some(index) = names.iter().position(|name| *name == joint.key) else {
            let message = format!("{place} names `{}`, which is no joint of the body", shown(&joint.key));
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            let help = nearest_help("its joints are", &joint.key, &known);
            report.refuse(Code::MissingJoint, &joint.key_span, message, help);
            continue;
        };
        let what = format!("the deviation of `{}`", shown(&joint.key));
        let found = numbers::<3>(report, &joint.node, &what, Code::CoordinateCount, "standard deviations");
        not_negative(report, &joint.node);
        out[index] = found.map(Vector3::from);
    }
    // a table without joints says nothing, as no table does
    if out.iter().all(Option::is_none) { Vec::new() } else { out }
}
