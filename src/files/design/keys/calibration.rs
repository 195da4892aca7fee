//! `[calibration]`: leg offsets and standard deviations.

use nalgebra::Vector3;
use serde_json::{Map, Value as Json, json};

use super::document::toml_value;
use super::found::{check_keys, element_span, elements, nearest_help, number, numbers, shown, table};
use super::joints::NamedJoints;
use super::kind::{
    HALF_WIDTHS, KeyKind, Numbers, list_of, not_negative, numbers as numbers_of, own, table as table_of, unit,
};
use super::stored::{Stored, StoredValue};
use super::{FoundKey, KeyTable, key};
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use crate::design::{CalibratedNumber, CalibrationTable, Code, Correlations, DesignModel};
use platform::manipulator::Body;

/// Correlations may be rounded to six decimals.
const ROUNDED: f64 = 0.5e-6;

static OFFSETS: Numbers =
    Numbers { code: Code::LengthCount, ..Numbers::coordinates(6, "offsets, one for each leg") };
/// The range is also checked in incomplete lists.
static DEVIATIONS: Numbers =
    Numbers { code: Code::LengthCount, ..Numbers::coordinates(6, "standard deviations, one for each leg") };
static OF_JOINT: KeyKind = numbers_of(&HALF_WIDTHS, unit::LENGTH);
static OF_JOINTS: KeyTable<()> = KeyTable { named: Some(&OF_JOINT), ..KeyTable::EMPTY };

/// The table, with the names of the joints of both bodies; `None` if they could not be read.
pub(super) struct CalibrationKeys {
    table: CalibrationTable,
    joints: [Option<Vec<String>>; 2],
}

pub(super) static CALIBRATION: KeyTable<CalibrationKeys> = KeyTable {
    keys: &[
        key!("offsets" { default = "[0, 0, 0, 0, 0, 0]" }: numbers_of(&OFFSETS, unit::LENGTH), table.offsets;
            "length that each leg shows, minus the distance of its joints"),
        key!("offset_deviations": list_of(6, &not_negative(unit::LENGTH)),
            |found, to| {
                found.kind = numbers_of(&DEVIATIONS, unit::LENGTH);
                found.fill(&mut to.table.offset_deviations);
                refuse_negative(found.report, &found.entry.node);
            },
            |of| of.table.offset_deviations.written();
            "standard deviations of the offsets"),
        key!("base_deviations": table_of(&OF_JOINTS),
            |found, to| to.table.base_deviations = deviations(found, to.joints[0].as_deref()),
            |of| of.deviations(Body::Base);
            "standard deviations of the coordinates of base joints, by name"),
        key!("platform_deviations": table_of(&OF_JOINTS),
            |found, to| to.table.platform_deviations = deviations(found, to.joints[1].as_deref()),
            |of| of.deviations(Body::Platform);
            "standard deviations of the coordinates of platform joints, by name"),
        key!("correlations": table_of(&CORRELATIONS),
            |found, to| {
                if let [Some(base), Some(platform)] = &to.joints {
                    to.table.correlations = correlations(found, [base, platform], &to.table);
                }
            },
            |of| CORRELATIONS.put(of);
            "correlations of the errors of coordinates and offsets; independent when absent"),
    ],
    ..KeyTable::EMPTY
};

const TRIANGLE: KeyKind = own(
    r#"{
        "type": "array",
        "items": {"type": "array", "minItems": 1, "items": {"type": "number", "minimum": -1, "maximum": 1}}
    }"#,
    unit::NONE,
);

static CORRELATIONS: KeyTable<CalibrationKeys> = KeyTable {
    keys: &[
        key!("unknowns" { required = BOTH }: own(r#"{"type": "array", "uniqueItems": true, "items": {"type": "string"}}"#, unit::NONE),
            |_, _| (),
            |of| {
                let joints = of.joints.each_ref().map(|names| names.as_deref().unwrap_or_default());
                let unknowns = &of.table.correlations.as_ref()?.unknowns;
                Some(unknowns.iter().map(|number| json!(number.name_among(joints))).collect())
            };
            "what rows and columns of `matrix` are about: `base.JOINT.x`, `platform.JOINT.z`, `offset.3`"),
        key!("matrix" { required = BOTH }: TRIANGLE,
            |_, _| (), |of| Some(json!(of.table.correlations.as_ref()?.triangle));
            "the lower triangle of the correlations with the diagonal, which is 1: row i has i numbers"),
    ],
    ..KeyTable::EMPTY
};
const BOTH: &str = "give `unknowns`, a list of names, and `matrix`, the lower triangle of their correlations";

impl CalibrationKeys {
    pub(super) fn of(design: &DesignModel, table: &CalibrationTable) -> Self {
        Self { table: table.clone(), joints: Body::BOTH.map(|body| Some(design.joint_names(body).to_vec())) }
    }

    fn deviations(&self, body: Body) -> Option<Json> {
        let names = self.joints[body.index()].iter().flatten().enumerate();
        let of =
            |(joint, name): (usize, &String)| Some((name.clone(), self.table.deviation(body, joint)?.json()));
        let found: Map<String, Json> = names.filter_map(of).collect();
        (!found.is_empty()).then_some(Json::Object(found))
    }
}

/// `[calibration.correlations]` with one row of the triangle per line; the TOML writer would use one line of ten
/// thousand characters.
pub(super) fn correlations_toml(table: &Json) -> String {
    let items = |list: &Json| list.as_array().cloned().unwrap_or_default();
    let lines =
        |lines: Vec<String>| lines.iter().fold(String::new(), |out, line| out + "    " + line + ",\n");
    let unknowns = lines(items(&table["unknowns"]).iter().map(toml_value).collect());
    let row = |row: &Json| {
        // whole numbers without a point
        let row: Vec<_> = items(row).iter().filter_map(Json::as_f64).map(|x| x.to_string()).collect();
        format!("[{}]", row.join(", "))
    };
    let matrix = lines(items(&table["matrix"]).iter().map(row).collect());
    format!("[calibration.correlations]\nunknowns = [\n{unknowns}]\nmatrix = [\n{matrix}]\n")
}

/// The table, with the deviations of joints in the order of the joints of their body.
pub(super) fn calibration(
    report: &mut Findings<'_>,
    top: &[Entry],
    bodies: [Option<&NamedJoints>; 2],
) -> Option<CalibrationTable> {
    let joints = bodies.map(|body| body.map(NamedJoints::names));
    let mut keys = CalibrationKeys { table: CalibrationTable::default(), joints };
    CALIBRATION.read(report, &find(top, "calibration")?.node, "[calibration]", &mut keys)?;
    Some(keys.table)
}

/// The correlated numbers, and the lower triangle of their matrix, checked up to rounding.
fn correlations(
    found: &mut FoundKey<'_, '_>,
    joints: [&Vec<String>; 2],
    deviations: &CalibrationTable,
) -> Option<Correlations> {
    let (report, entry) = (&mut *found.report, found.entry);
    let place = "[calibration.correlations]";
    let entries = table(report, &entry.node, place)?;
    check_keys(report, entries, &CORRELATIONS.names(), place);
    CORRELATIONS.require(report, entries, (&entry.key_span, place), |_| true);
    let (unknowns, matrix) = (find(entries, "unknowns")?, find(entries, "matrix")?);
    let names = list(report, &unknowns.node, "`unknowns`")?;
    let unknowns = unknowns_of(report, names, joints, deviations)?;
    let rows = list(report, &matrix.node, "`matrix`")?;
    if rows.len() != unknowns.len() {
        let message = format!("`matrix` has {} rows for {} unknowns", rows.len(), unknowns.len());
        return report.refused(
            Code::OutOfRange,
            &matrix.node.span,
            message,
            "give a row for each of `unknowns`",
        );
    }
    let triangle: Vec<Option<Vec<f64>>> =
        rows.iter().enumerate().map(|(i, row)| triangle_row(report, row, i)).collect();
    let out = Correlations { unknowns, triangle: triangle.into_iter().collect::<Option<_>>()? };
    // an error of half a unit of the last decimal in each entry moves no eigenvalue by more than that times the number
    // of rows
    let least = if rows.is_empty() { 0.0 } else { out.matrix().symmetric_eigenvalues().min() };
    if least < -ROUNDED * rows.len() as f64 {
        let message = format!("no quantities have these correlations: the least eigenvalue is {least:.3e}");
        let help = "a matrix of correlations is positive semidefinite; give six decimals or more";
        return report.refused(Code::OutOfRange, &matrix.node.span, message, help);
    }
    Some(out)
}

fn list<'a>(report: &mut Findings<'_>, node: &'a Node, what: &str) -> Option<&'a [Node]> {
    if let Value::Array(list) = &node.value {
        return Some(list);
    }
    report.not_a(node, what, "an array", format!("write {what} as an array"))
}

/// The unknowns behind names like `base.A1.x` and `offset.3`.
fn unknowns_of(
    report: &mut Findings<'_>,
    names: &[Node],
    joints: [&Vec<String>; 2],
    deviations: &CalibrationTable,
) -> Option<Vec<CalibratedNumber>> {
    let mut out: Vec<Option<CalibratedNumber>> = Vec::new();
    for node in names {
        let found = match &node.value {
            Value::Text(name) => unknown_of(name, joints),
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

fn unknown_of(name: &str, joints: [&Vec<String>; 2]) -> Option<CalibratedNumber> {
    if let Some(leg) = name.strip_prefix("offset.") {
        let leg = (1..=6).find(|n: &usize| n.to_string() == leg)?;
        return Some(CalibratedNumber::Offset(leg - 1));
    }
    let (body, rest) = name.split_once('.')?;
    // names of joints may have points
    let (joint, axis) = rest.rsplit_once('.')?;
    let body = Body::BOTH.into_iter().find(|b| b.to_string() == body)?;
    let joint = joints[body.index()].iter().position(|name| name == joint)?;
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
        return report.refused(Code::OutOfRange, &row.span, message, help);
    }
    let mut out = Vec::with_capacity(i + 1);
    for (j, node) in entries.iter().enumerate() {
        let x = number(report, node, &format!("number {} of {what}", j + 1))?;
        if x.abs() > 1.0 {
            let help = "correlations are from -1 to 1";
            return report.refused(Code::OutOfRange, &node.span, format!("a correlation of {x}"), help);
        }
        out.push(x);
    }
    if (out[i] - 1.0).abs() > 0.0 {
        let message = format!("{what} ends with {}, not with 1", out[i]);
        let help = "the diagonal is 1: every quantity is wholly correlated with itself";
        return report.refused(Code::OutOfRange, &element_span(row, i), message, help);
    }
    Some(out)
}

fn refuse_negative(report: &mut Findings<'_>, node: &Node) {
    for (i, x) in elements(node).enumerate().filter(|(_, x)| *x < 0.0 && x.is_finite()) {
        let message = format!("a standard deviation of {x}");
        let help = "standard deviations are not negative";
        report.refuse(Code::NotPositive, &element_span(node, i), message, help);
    }
}

/// Three numbers for each named joint.
fn deviations(found: &mut FoundKey<'_, '_>, names: Option<&[String]>) -> Vec<Option<Vector3<f64>>> {
    let (report, place) = (&mut *found.report, format!("`{}` of [calibration]", found.entry.key));
    let Some(names) = names else { return Vec::new() };
    let mut out = vec![None; names.len()];
    for joint in table(report, &found.entry.node, &place).unwrap_or_default() {
        let Some(index) = names.iter().position(|name| *name == joint.key) else {
            let message = format!("{place} names `{}`, which is no joint of the body", shown(&joint.key));
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            let help = nearest_help("its joints are", &joint.key, &known);
            report.refuse(Code::MissingJoint, &joint.key_span, message, help);
            continue;
        };
        let what = format!("the deviation of `{}`", shown(&joint.key));
        let three = numbers::<3>(report, &joint.node, &what, Code::CoordinateCount, "standard deviations");
        refuse_negative(report, &joint.node);
        out[index] = three.map(Vector3::from);
    }
    // a table without joints means the same as a missing table
    if out.iter().all(Option::is_none) { Vec::new() } else { out }
}
