//! `[calibration]`: leg offsets and standard deviations.

use nalgebra::Vector3;

use super::joints::NamedJoints;
use super::{check_keys, element_span, elements, nearest_help, number, numbers, shown, table};
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use crate::design::{CalibratedNumber, CalibrationTable, Code, Correlations};
use platform::manipulator::Body;

pub(super) const CALIBRATION_KEYS: [&str; 5] =
    ["offsets", "offset_deviations", "base_deviations", "platform_deviations", "correlations"];
pub(super) const CORRELATIONS_KEYS: [&str; 2] = ["unknowns", "matrix"];
/// Correlations may be rounded to six decimals.
const ROUNDED: f64 = 0.5e-6;

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
    let mut out = CalibrationTable {
        offsets: offsets.unwrap_or_default(),
        offset_deviations,
        base_deviations,
        platform_deviations,
        correlations: None,
    };
    if let (Some(entry), [Some(base), Some(platform)]) = (find(entries, "correlations"), bodies) {
        out.correlations = correlations(report, entry, [base, platform], &out);
    }
    Some(out)
}

/// What is correlated, and the lower triangle of a matrix that is one of correlations up to rounding.
fn correlations(
    report: &mut Findings<'_>,
    entry: &Entry,
    bodies: [&NamedJoints; 2],
    deviations: &CalibrationTable,
) -> Option<Correlations> {
    let place = "[calibration.correlations]";
    let entries = table(report, &entry.node, place)?;
    check_keys(report, entries, &CORRELATIONS_KEYS, place);
    let [unknowns, matrix] = CORRELATIONS_KEYS.map(|key| {
        let found = find(entries, key);
        if found.is_none() {
            let help =
                "give `unknowns`, a list of names, and `matrix`, the lower triangle of their correlations";
            report.refuse(Code::MissingKey, &entry.key_span, format!("{place} has no `{key}`"), help);
        }
        found
    });
    let (names, matrix) = (list(report, &unknowns?.node, "`unknowns`")?, matrix?);
    let unknowns = unknowns_of(report, names, bodies, deviations)?;
    let rows = list(report, &matrix.node, "`matrix`")?;
    if rows.len() != unknowns.len() {
        let message = format!("`matrix` has {} rows for {} unknowns", rows.len(), unknowns.len());
        report.refuse(Code::OutOfRange, &matrix.node.span, message, "give a row for each of `unknowns`");
        return None;
    }
    let triangle: Vec<Option<Vec<f64>>> =
        rows.iter().enumerate().map(|(i, row)| triangle_row(report, row, i)).collect();
    let out = Correlations { unknowns, triangle: triangle.into_iter().collect::<Option<_>>()? };
    // an error of half a unit of the last decimal in each entry moves no eigenvalue by more than that times the rows
    let least = if rows.is_empty() { 0.0 } else { out.matrix().symmetric_eigenvalues().min() };
    if least < -ROUNDED * rows.len() as f64 {
        let message = format!("no quantities have these correlations: the least eigenvalue is {least:.3e}");
        let help = "a matrix of correlations is positive semidefinite; give six decimals or more";
        report.refuse(Code::OutOfRange, &matrix.node.span, message, help);
        return None;
    }
    Some(out)
}

fn list<'a>(report: &mut Findings<'_>, node: &'a Node, what: &str) -> Option<&'a [Node]> {
    if let Value::Array(list) = &node.value {
        return Some(list);
    }
    let message = format!("{what} is {}, not an array", node.value.kind());
    report.refuse(Code::WrongType, &node.span, message, format!("write {what} as an array"));
    None
}

/// The unknowns behind names like `base.A1.x` and `offset.3`.
fn unknowns_of(
    report: &mut Findings<'_>,
    names: &[Node],
    bodies: [&NamedJoints; 2],
    deviations: &CalibrationTable,
) -> Option<Vec<CalibratedNumber>> {
    let joints = bodies.map(NamedJoints::names);
    let mut out: Vec<Option<CalibratedNumber>> = Vec::new();
    for node in names {
        let found = match &node.value {
            Value::Text(name) => unknown_of(name, &joints),
            _ => None,
        };
        let refusal = match found {
            None => Some((
                Code::UnknownName,
                "is no unknown of a calibration",
                "write `base.JOINT.x`, `platform.JOINT.z` or `offset.3`",
            )),
            Some(number) if deviations.deviation_of(number).is_none() => {
                Some((Code::MissingKey, "has no standard deviation", "give its deviation in [calibration]"))
            }
            Some(number) if out.contains(&Some(number)) => {
                Some((Code::ConflictingKeys, "stands in `unknowns` twice", "name each unknown once"))
            }
            Some(_) => None,
        };
        if let Some((code, what, help)) = refusal {
            let name =
                if let Value::Text(name) = &node.value { shown(name) } else { node.value.kind().to_owned() };
            report.refuse(code, &node.span, format!("`{name}` {what}"), help);
        }
        out.push(found.filter(|_| refusal.is_none()));
    }
    out.into_iter().collect()
}

fn unknown_of(name: &str, joints: &[Vec<String>; 2]) -> Option<CalibratedNumber> {
    if let Some(leg) = name.strip_prefix("offset.") {
        let leg = (1..=6).find(|n: &usize| n.to_string() == leg)?;
        return Some(CalibratedNumber::Offset(leg - 1));
    }
    let (body, rest) = name.split_once('.')?;
    // names of joints may have points
    let (joint, axis) = rest.rsplit_once('.')?;
    let body = Body::BOTH.into_iter().find(|b| b.to_string() == body)?;
    let joint = body.of((&joints[0], &joints[1])).iter().position(|name| name == joint)?;
    let axis = ["x", "y", "z"].iter().position(|name| *name == axis)?;
    Some(CalibratedNumber::Coordinate { body, joint, axis })
}

/// Row `i` of the lower triangle: `i + 1` correlations, the last one 1.
fn triangle_row(report: &mut Findings<'_>, row: &Node, i: usize) -> Option<Vec<f64>> {
    let what = format!("row {} of `matrix`", i + 1);
    let entries = list(report, row, &what)?;
    if entries.len() != i + 1 {
        let message = format!("{what} has {} numbers instead of {}", entries.len(), i + 1);
        let help =
            "the matrix is symmetric: give its lower triangle with the diagonal, one number more in each row";
        report.refuse(Code::OutOfRange, &row.span, message, help);
        return None;
    }
    let mut out = Vec::with_capacity(i + 1);
    for (j, node) in entries.iter().enumerate() {
        let x = number(report, node, &format!("number {} of {what}", j + 1))?;
        if x.abs() > 1.0 {
            let help = "correlations are from -1 to 1";
            report.refuse(Code::OutOfRange, &node.span, format!("a correlation of {x}"), help);
            return None;
        }
        out.push(x);
    }
    if (out[i] - 1.0).abs() > 0.0 {
        let message = format!("{what} ends with {}, not with 1", out[i]);
        let help = "the diagonal is 1: every quantity is wholly correlated with itself";
        report.refuse(Code::OutOfRange, &element_span(row, i), message, help);
        return None;
    }
    Some(out)
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
