//! `[hardware]`, `[speed]`, `[[loads]]` and `[[keep_out]]`.

use nalgebra::{Point3, Unit, Vector3};

use super::fields::{check_keys, element_span, number, numbers, shown, table, text};
use crate::design::Code;
use crate::design::report::Report;
use crate::design::tree::{Entry, Node, Value, find};
use crate::requirements::{
    FixedTo, Hardware, Housing, JointAxes, KeepOut, LegBody, LengthLimits, Load, PlatformSpeed, Shape, Swing,
};

pub(super) const HARDWARE_KEYS: [&str; 17] = [
    "joint_diameter",
    "base_housing",
    "platform_housing",
    "leg_diameter",
    "rod_diameter",
    "cylinder_length",
    "leg_clearance",
    "leg_length",
    "dead_length",
    "stroke",
    "base_swing_deg",
    "platform_swing_deg",
    "base_axes",
    "platform_axes",
    "max_leg_force",
    "max_leg_speed",
    "leg_stiffness",
];

/// A positive number of a table.
pub(super) fn positive(report: &mut Report<'_>, entries: &[Entry], key: &str) -> Option<f64> {
    let node = &find(entries, key)?.node;
    let x = number(report, node, &format!("`{key}`"))?;
    if x <= 0.0 {
        report.refuse(Code::NotPositive, &node.span, format!("`{key}` is {x}"), "give a positive number");
    }
    Some(x)
}

/// A number of a table that is not negative.
fn not_negative(report: &mut Report<'_>, entries: &[Entry], key: &str) -> Option<f64> {
    let node = &find(entries, key)?.node;
    let x = number(report, node, &format!("`{key}`"))?;
    if x < 0.0 {
        report.refuse(Code::NotPositive, &node.span, format!("`{key}` is {x}"), "give 0 or more");
    }
    Some(x)
}

/// Three numbers of a table.
fn vector(report: &mut Report<'_>, entries: &[Entry], key: &str) -> Option<Vector3<f64>> {
    let node = &find(entries, key)?.node;
    numbers::<3>(report, node, &format!("`{key}`"), Code::CoordinateCount, "coordinates x, y, z")
        .map(Vector3::from)
}

/// Three positive numbers of a node.
fn edges(report: &mut Report<'_>, node: &Node, key: &str) -> Option<Vector3<f64>> {
    let e = numbers::<3>(report, node, &format!("`{key}`"), Code::CoordinateCount, "edge lengths")?;
    for (i, x) in e.iter().enumerate().filter(|(_, x)| **x <= 0.0) {
        let message = format!("an edge length of {x}");
        report.refuse(Code::NotPositive, &element_span(node, i), message, "give positive edge lengths");
    }
    Some(Vector3::from(e))
}

/// A key that asks for another one.
fn needs(report: &mut Report<'_>, entries: &[Entry], key: &str, other: &str) {
    if let (Some(e), None) = (find(entries, key), find(entries, other)) {
        let message = format!("`{key}` without `{other}`");
        report.refuse(Code::MissingKey, &e.key_span, message, format!("add `{other}`, or remove `{key}`"));
    }
}

/// `[hardware]`.
pub(super) fn hardware(report: &mut Report<'_>, top: &[Entry]) -> Hardware {
    let place = "[hardware]";
    let entries = find(top, "hardware").and_then(|e| table(report, &e.node, place)).unwrap_or_default();
    check_keys(report, entries, &HARDWARE_KEYS, place);
    let rod = positive(report, entries, "rod_diameter");
    let cylinder = positive(report, entries, "cylinder_length");
    for (key, other) in [
        ("rod_diameter", "cylinder_length"),
        ("cylinder_length", "rod_diameter"),
        ("rod_diameter", "leg_diameter"),
        ("leg_clearance", "leg_diameter"),
        ("dead_length", "stroke"),
        ("stroke", "dead_length"),
        ("base_axes", "base_swing_deg"),
        ("platform_axes", "platform_swing_deg"),
    ] {
        needs(report, entries, key, other);
    }
    let body = positive(report, entries, "leg_diameter");
    Hardware {
        base_housing: housing(report, entries, "base_housing"),
        platform_housing: housing(report, entries, "platform_housing"),
        joint_diameter: positive(report, entries, "joint_diameter"),
        leg_body: body.map(|diameter| LegBody { diameter, rod: cylinder.zip(rod) }),
        leg_clearance: not_negative(report, entries, "leg_clearance"),
        leg_length: length_limits(report, entries),
        base_swing: swing(report, entries, "base_swing_deg", "base_axes"),
        platform_swing: swing(report, entries, "platform_swing_deg", "platform_axes"),
        max_leg_force: positive(report, entries, "max_leg_force"),
        max_leg_speed: positive(report, entries, "max_leg_speed"),
        leg_stiffness: positive(report, entries, "leg_stiffness"),
    }
}

fn housing(report: &mut Report<'_>, entries: &[Entry], key: &str) -> Option<Housing> {
    let node = &find(entries, key)?.node;
    if matches!(node.value, Value::Array(_)) {
        return edges(report, node, key).map(Housing::Box);
    }
    positive(report, entries, key).map(Housing::Sphere)
}

fn length_limits(report: &mut Report<'_>, entries: &[Entry]) -> Option<LengthLimits> {
    let dead = not_negative(report, entries, "dead_length");
    let stroke = positive(report, entries, "stroke");
    let Some(entry) = find(entries, "leg_length") else {
        return dead.zip(stroke).map(|(dead, stroke)| LengthLimits::Stroke { dead, stroke });
    };
    if stroke.is_some() {
        let help = "keep `leg_length`, or `dead_length` with `stroke`";
        report.refuse(Code::ConflictingKeys, &entry.key_span, "leg lengths are limited twice", help);
    }
    let what = "lengths, least and greatest";
    let [least, greatest] = numbers::<2>(report, &entry.node, "`leg_length`", Code::CoordinateCount, what)?;
    if !(least >= 0.0 && greatest > least) {
        let message = format!("leg lengths from {least} to {greatest}");
        report.refuse(
            Code::OutOfRange,
            &entry.node.span,
            message,
            "give [least, greatest], the least not negative",
        );
    }
    Some(LengthLimits::Range(least, greatest))
}

fn swing(report: &mut Report<'_>, entries: &[Entry], limit: &str, axes: &str) -> Option<Swing> {
    let axes = find(entries, axes).and_then(|e| joint_axes(report, e));
    let limit_deg = positive(report, entries, limit)?;
    if limit_deg > 180.0 {
        let span = find(entries, limit).map_or(0..0, |e| e.node.span.clone());
        report.refuse(
            Code::OutOfRange,
            &span,
            format!("`{limit}` is {limit_deg}"),
            "stay within 180 degrees",
        );
    }
    Some(Swing { limit_deg, axes: axes.unwrap_or_default() })
}

fn joint_axes(report: &mut Report<'_>, entry: &Entry) -> Option<JointAxes> {
    let help = "write \"home\", \"optimize\" or six vectors in leg order";
    match &entry.node.value {
        Value::Text(t) if t == "home" => Some(JointAxes::Home),
        Value::Text(t) if t == "optimize" => Some(JointAxes::Optimize),
        Value::Array(list) if list.len() == 6 => {
            let axes: Vec<_> = list.iter().map(|node| axis(report, node, &entry.key)).collect();
            let axes: Vec<_> = axes.into_iter().collect::<Option<_>>()?;
            axes.try_into().ok().map(JointAxes::Given)
        }
        _ => {
            let message = format!("`{}` is not a choice of axes", entry.key);
            report.refuse(Code::WrongType, &entry.node.span, message, help);
            None
        }
    }
}

fn axis(report: &mut Report<'_>, node: &Node, key: &str) -> Option<Unit<Vector3<f64>>> {
    let what = format!("an axis of `{key}`");
    let v = numbers::<3>(report, node, &what, Code::CoordinateCount, "components").map(Vector3::from)?;
    // a vector that is a unit vector already is kept to the bit, so that a saved design reads back equal
    let unit = if (v.norm_squared() - 1.0).abs() < 1e-15 {
        Some(Unit::new_unchecked(v))
    } else {
        Unit::try_new(v, 0.0)
    };
    if unit.is_none() {
        report.refuse(Code::NotPositive, &node.span, format!("{what} is zero"), "give a direction");
    }
    unit
}

/// `[speed]`.
pub(super) fn speed(report: &mut Report<'_>, top: &[Entry]) -> Option<PlatformSpeed> {
    let entries = table(report, &find(top, "speed")?.node, "[speed]")?;
    check_keys(report, entries, &["linear", "angular_deg"], "[speed]");
    Some(PlatformSpeed {
        linear: not_negative(report, entries, "linear").unwrap_or_default(),
        angular_deg: not_negative(report, entries, "angular_deg").unwrap_or_default(),
    })
}

/// The tables of an array of tables.
fn tables<'a>(report: &mut Report<'_>, top: &'a [Entry], key: &str) -> Vec<&'a [Entry]> {
    let Some(entry) = find(top, key) else { return Vec::new() };
    let Value::Array(list) = &entry.node.value else {
        let message = format!("`{key}` is {}, not a list of tables", entry.node.value.kind());
        report.refuse(Code::WrongType, &entry.node.span, message, format!("write [[{key}]] above each"));
        return Vec::new();
    };
    list.iter().filter_map(|node| table(report, node, &format!("[[{key}]]"))).collect()
}

fn fixed_to(report: &mut Report<'_>, entries: &[Entry]) -> Option<FixedTo> {
    let entry = find(entries, "fixed_to")?;
    match text(report, entry)?.as_str() {
        "base" => Some(FixedTo::Base),
        "platform" => Some(FixedTo::Platform),
        other => {
            let message = format!("`fixed_to` is \"{}\"", shown(other));
            report.refuse(Code::WrongType, &entry.node.span, message, "write \"base\" or \"platform\"");
            None
        }
    }
}

fn name(report: &mut Report<'_>, entries: &[Entry], default: String) -> String {
    find(entries, "name").and_then(|e| text(report, e)).unwrap_or(default)
}

/// `[[loads]]`.
pub(super) fn loads(report: &mut Report<'_>, top: &[Entry]) -> Vec<Load> {
    let list = tables(report, top, "loads");
    let read = |(i, entries): (usize, &&[Entry])| {
        check_keys(report, entries, &["name", "force", "torque", "at", "fixed_to"], "[[loads]]");
        Load {
            name: name(report, entries, format!("load {}", i + 1)),
            force: vector(report, entries, "force").unwrap_or_default(),
            torque: vector(report, entries, "torque").unwrap_or_default(),
            at: Point3::from(vector(report, entries, "at").unwrap_or_default()),
            fixed_to: fixed_to(report, entries).unwrap_or(FixedTo::Base),
        }
    };
    list.iter().enumerate().map(read).collect()
}

/// `[[keep_out]]`.
pub(super) fn keep_outs(report: &mut Report<'_>, top: &[Entry]) -> Vec<KeepOut> {
    let list = tables(report, top, "keep_out");
    let mut out = Vec::new();
    for (i, entries) in list.into_iter().enumerate() {
        check_keys(report, entries, &["name", "fixed_to", "box", "sphere", "capsule"], "[[keep_out]]");
        let name = name(report, entries, format!("keep-out {}", i + 1));
        let fixed_to = fixed_to(report, entries).unwrap_or(FixedTo::Base);
        let shapes: Vec<&Entry> =
            entries.iter().filter(|e| ["box", "sphere", "capsule"].contains(&e.key.as_str())).collect();
        let [entry] = shapes[..] else {
            let span = find(top, "keep_out").map_or(0..0, |e| e.key_span.clone());
            let message = format!("{} has {} shapes", shown(&name), shapes.len());
            let help = "give one of box = { center, size }, sphere = { center, diameter }, capsule = { from, to, diameter }";
            report.refuse(Code::MissingKey, &span, message, help);
            continue;
        };
        if let Some(shape) = shape(report, entry) {
            out.push(KeepOut { name, fixed_to, shape });
        }
    }
    out
}

fn shape(report: &mut Report<'_>, entry: &Entry) -> Option<Shape> {
    let place = format!("`{}`", entry.key);
    let entries = table(report, &entry.node, &place)?;
    let keys: &[&str] = match entry.key.as_str() {
        "box" => &["center", "size"],
        "sphere" => &["center", "diameter"],
        _ => &["from", "to", "diameter"],
    };
    check_keys(report, entries, keys, &place);
    for key in keys.iter().filter(|k| find(entries, k).is_none()) {
        let message = format!("`{key}` of {place} is missing");
        report.refuse(
            Code::MissingKey,
            &entry.node.span,
            message,
            format!("{place} takes {}", keys.join(", ")),
        );
    }
    let mut point = |key| vector(report, entries, key).map(Point3::from);
    Some(match entry.key.as_str() {
        "box" => {
            let center = point("center")?;
            Shape::Box { center, size: find(entries, "size").and_then(|e| edges(report, &e.node, "size"))? }
        }
        "sphere" => {
            Shape::Sphere { center: point("center")?, diameter: positive(report, entries, "diameter")? }
        }
        _ => {
            let (from, to) = (point("from")?, point("to")?);
            Shape::Capsule { from, to, diameter: positive(report, entries, "diameter")? }
        }
    })
}
