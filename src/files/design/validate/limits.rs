//! `[limits]` with the reserve, `[envelope]`, `[payload]` and the units of force and mass.

use nalgebra::{Matrix3, Point3, Vector3};

use super::tables::{not_negative, positive, shape, vector};
use super::{check_keys, number, numbers, shown, table, text};
use crate::design::Code;
use crate::design::scale::micrometres;
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{
    Envelope, Envelopes, ForceUnit, GRAVITY, MassUnit, Payload, PlateMass, Reserve, Reserves, TermKind,
};

pub(super) const ENVELOPE_KEYS: [&str; 3] = ["base", "platform", "machine"];
pub(super) const PAYLOAD_KEYS: [&str; 7] = ["mass", "center", "inertia", "gravity", "plate", "box", "sphere"];
const SHAPE_KEYS: [&str; 4] = ["radius", "center", "min", "max"];
/// The reserve of every limit that has none of its own.
const ALL: &str = "all";

/// One of a list of labels.
fn unit<T: Copy>(
    report: &mut Findings<'_>,
    top: &[Entry],
    key: &str,
    known: &[T],
    label: fn(T) -> &'static str,
) -> Option<T> {
    let entry = find(top, key)?;
    let word = text(report, entry)?;
    let found = known.iter().copied().find(|u| label(*u) == word);
    if found.is_none() {
        let labels: Vec<String> = known.iter().map(|u| format!("\"{}\"", label(*u))).collect();
        let message = format!("`{key}` is \"{}\"", shown(&word));
        report.refuse(
            Code::WrongType,
            &entry.node.span,
            message,
            format!("write one of {}", labels.join(", ")),
        );
    }
    found
}

/// `force_units` and `mass_units`.
pub(super) fn units(report: &mut Findings<'_>, top: &[Entry]) -> (Option<ForceUnit>, Option<MassUnit>) {
    let force = unit(report, top, "force_units", &ForceUnit::ALL, ForceUnit::label);
    (force, unit(report, top, "mass_units", &MassUnit::ALL, MassUnit::label))
}

/// `[payload]`.
pub(super) fn payload(report: &mut Findings<'_>, top: &[Entry]) -> Option<Payload> {
    let entry = find(top, "payload")?;
    let place = "[payload]";
    let entries = table(report, &entry.node, place)?;
    check_keys(report, entries, &PAYLOAD_KEYS, place);
    if find(entries, "mass").is_none() {
        report.refuse(Code::MissingKey, &entry.key_span, "[payload] has no `mass`", "add mass = 100.0");
    }
    let inertia = find(entries, "inertia").and_then(|e| inertia(report, &e.node));
    let (center, gravity) = (vector(report, entries, "center"), vector(report, entries, "gravity"));
    let plate = find(entries, "plate").and_then(|e| {
        let word = text(report, e)?;
        let known = PlateMass::ALL.into_iter().find(|plate| plate.name() == word);
        if known.is_none() {
            let message = format!("`plate` of {place} is \"{}\"", shown(&word));
            report.refuse(Code::WrongType, &e.node.span, message, "write \"included\" or \"added\"");
        }
        known
    });
    let shapes = ["box", "sphere"].map(|key| find(entries, key));
    if let [Some(_), Some(second)] = shapes {
        let message = "[payload] has two shapes";
        report.refuse(Code::ConflictingKeys, &second.key_span, message, "keep `box` or `sphere`");
    }
    let shape = shapes.into_iter().flatten().next().and_then(|e| shape(report, e));
    Some(Payload {
        mass: positive(report, entries, "mass")?,
        center: Point3::from(center.unwrap_or_default()),
        inertia,
        gravity: gravity.unwrap_or_else(|| Vector3::new(0.0, 0.0, -GRAVITY)),
        plate: plate.unwrap_or_default(),
        shape,
    })
}

/// A natural frequency is one of known masses in known units.
pub(super) fn vibrating(report: &mut Findings<'_>, top: &[Entry], units: &str) {
    let Some(Value::Table(entries)) = find(top, "stiffness").map(|e| &e.node.value) else { return };
    let Some(entry) = find(entries, "natural_frequency") else { return };
    let inertia = match find(top, "payload").map(|e| &e.node.value) {
        Some(Value::Table(payload)) => find(payload, "inertia").is_some(),
        _ => false,
    };
    if !inertia {
        let message = "`natural_frequency` of [stiffness] needs the mass and the inertia that vibrate";
        report.refuse(
            Code::MissingKey,
            &entry.key_span,
            message,
            "add [payload] with `mass`, `center` and `inertia`",
        );
    }
    if micrometres(units).is_none() {
        let message = format!(
            "`natural_frequency` of [stiffness] needs a known unit of length, not \"{}\"",
            shown(units)
        );
        report.refuse(
            Code::WrongType,
            &entry.key_span,
            message,
            "write units = \"mm\", \"m\" or \"in\", for instance",
        );
    }
}

/// Three principal moments along the axes, or three rows.
fn inertia(report: &mut Findings<'_>, node: &Node) -> Option<Matrix3<f64>> {
    let what = "`inertia` of [payload]";
    let by_rows = matches!(&node.value, Value::Array(list) if matches!(list.first().map(|n| &n.value), Some(Value::Array(_))));
    let m = if let (true, Value::Array(rows)) = (by_rows, &node.value) {
        let read = |report: &mut Findings<'_>, row: &Node| {
            numbers::<3>(report, row, "a row of `inertia`", Code::CoordinateCount, "moments")
        };
        let rows: Vec<Option<[f64; 3]>> = rows.iter().map(|row| read(report, row)).collect();
        let rows: Vec<[f64; 3]> = rows.into_iter().collect::<Option<_>>()?;
        if rows.len() != 3 {
            let message = format!("{what} has {} rows", rows.len());
            report.refuse(Code::CoordinateCount, &node.span, message, "give three rows of three moments");
            return None;
        }
        Matrix3::from_fn(|i, j| rows[i][j])
    } else {
        let moments = numbers::<3>(report, node, what, Code::CoordinateCount, "principal moments")?;
        Matrix3::from_diagonal(&Vector3::from(moments))
    };
    let size = m.amax();
    let symmetric = (m - m.transpose()).amax() <= 1e-9 * size;
    // of a body: positive, and no principal moment greater than the sum of the others
    let spread = Matrix3::identity() * (0.5 * m.trace()) - m;
    let possible =
        m.symmetric_eigenvalues().min() > 0.0 && spread.symmetric_eigenvalues().min() >= -1e-9 * size;
    if !(symmetric && possible) {
        let message = format!("{what} is that of no body");
        let help = "give a symmetric matrix with positive principal moments, none greater than the sum of the other two";
        report.refuse(Code::OutOfRange, &node.span, message, help);
        return None;
    }
    Some(m)
}

/// `[envelope]`.
pub(super) fn envelopes(report: &mut Findings<'_>, top: &[Entry]) -> Envelopes {
    let place = "[envelope]";
    let entries = find(top, "envelope").and_then(|e| table(report, &e.node, place)).unwrap_or_default();
    check_keys(report, entries, &ENVELOPE_KEYS, place);
    let [base, platform, machine] =
        ENVELOPE_KEYS.map(|key| find(entries, key).and_then(|e| envelope(report, e)));
    Envelopes { base, platform, machine }
}

fn envelope(report: &mut Findings<'_>, entry: &Entry) -> Option<Envelope> {
    let place = format!("`{}` of [envelope]", entry.key);
    let entries = table(report, &entry.node, &place)?;
    check_keys(report, entries, &SHAPE_KEYS, &place);
    let has = |key: &str| find(entries, key).is_some();
    let help = "give `{ radius = R }`, with `center = [x, y]` where it is not the origin, or `{ min = [x, y, z], max = [x, y, z] }`";
    if has("radius") == (has("min") || has("max"))
        || has("min") != has("max")
        || (has("center") && has("min"))
    {
        report.refuse(Code::MissingKey, &entry.key_span, format!("{place} is no shape"), help);
        return None;
    }
    if has("radius") {
        let what = format!("`center` of {place}");
        let center = match find(entries, "center") {
            None => [0.0; 2],
            Some(e) => numbers::<2>(report, &e.node, &what, Code::CoordinateCount, "coordinates x, y")?,
        };
        return Some(Envelope::Cylinder { radius: positive(report, entries, "radius")?, center });
    }
    let (min, max) = (vector(report, entries, "min")?, vector(report, entries, "max")?);
    if (0..3).any(|k| !(min[k] < max[k])) {
        let message = format!("the box of {place} is empty");
        report.refuse(
            Code::OutOfRange,
            &entry.node.span,
            message,
            "give every coordinate of `max` greater than that of `min`",
        );
    }
    Some(Envelope::Box { min: Point3::from(min), max: Point3::from(max) })
}

/// `[limits]`.
pub(super) fn reserves(report: &mut Findings<'_>, top: &[Entry]) -> Reserves {
    let place = "[limits]";
    let entries = find(top, "limits").and_then(|e| table(report, &e.node, place)).unwrap_or_default();
    check_keys(report, entries, &["reserve"], place);
    let mut out = Reserves::default();
    let Some(entry) = find(entries, "reserve") else { return out };
    if !matches!(entry.node.value, Value::Table(_)) {
        out.all = percent(report, entry);
        return out;
    }
    let own = table(report, &entry.node, "`reserve`").unwrap_or_default();
    let known: Vec<&str> = TermKind::ALL.map(TermKind::code).into_iter().chain([ALL]).collect();
    check_keys(report, own, &known, "`reserve`");
    if let Some(all) = find(own, ALL) {
        out.all = percent(report, all);
    }
    for kind in TermKind::ALL {
        let Some(e) = find(own, kind.code()) else { continue };
        let reserve = if matches!(e.node.value, Value::Text(_)) {
            percent(report, e).map(Reserve::Percent)
        } else {
            number(report, &e.node, &format!("`{}`", e.key))
                .and_then(|_| not_negative(report, own, kind.code()))
                .map(Reserve::Amount)
        };
        if let Some(reserve) = reserve {
            out.kinds.insert(kind, reserve);
        }
    }
    out
}

/// `"5%"`.
fn percent(report: &mut Findings<'_>, entry: &Entry) -> Option<f64> {
    let help = "write a percentage in quotes, such as \"5%\"";
    if !matches!(entry.node.value, Value::Text(_)) {
        let message = format!("`{}` is {}, not a percentage", entry.key, entry.node.value.kind());
        report.refuse(Code::WrongType, &entry.node.span, message, help);
        return None;
    }
    let word = text(report, entry)?;
    let value = word.trim().strip_suffix('%').and_then(|x| x.trim().parse::<f64>().ok());
    let found = value.filter(|x| (0.0..100.0).contains(x));
    if found.is_none() {
        let message = format!("`{}` is \"{}\"", entry.key, shown(&word));
        report.refuse(
            Code::OutOfRange,
            &entry.node.span,
            message,
            format!("{help}, from 0% to less than 100%"),
        );
    }
    found
}
