//! `[speed]`, `[stiffness]`, `[[loads]]` and `[[keep_out]]`: required speed and stiffness of the platform, its loads,
//! and obstacles to the legs.

use nalgebra::{Point3, Vector3};

use super::found::shown;
use super::kind::{KeyKind, not_negative, positive, table as table_of, unit, vector, word};
use super::shapes::{BOX, CAPSULE, SPHERE, shape, written};
use super::stored::Word;
use super::{Code, KeyTable, TEXT, key};
use crate::design::scale::micrometres;
use crate::design::tree::{Entry, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{Hardware, KeepOut, KeepOutShape, Load, PlatformSpeed, PlatformStiffness};
use platform::manipulator::Body;

pub(super) static SPEED: KeyTable<PlatformSpeed> = KeyTable {
    keys: &[
        key!("linear": not_negative(unit::SPEED), linear; "speed of the platform origin, design units per second"),
        key!("angular_deg": not_negative(unit::DEGREES), angular_deg; "angular speed of the platform, degrees per second"),
    ],
    ..KeyTable::EMPTY
};

/// `[speed]`.
pub(super) fn speed(report: &mut Findings<'_>, top: &[Entry]) -> Option<PlatformSpeed> {
    let mut speed = PlatformSpeed::default();
    SPEED.read(report, &find(top, "speed")?.node, "[speed]", &mut speed)?;
    Some(speed)
}

pub(super) static STIFFNESS: KeyTable<PlatformStiffness> = KeyTable {
    keys: &[
        key!("linear": positive(unit::STIFFNESS), linear;
            "least stiffness against a force through the platform origin in the softest direction, the platform free to rotate, force units per design unit"),
        key!("angular": positive(unit::TORQUE), angular;
            "least stiffness against a torque about the softest axis, the platform origin free to move, force units times design units per radian"),
        key!("natural_frequency": positive(unit::NONE), natural_frequency;
            "least natural frequency of `[payload]` and legs, hertz; needs a known unit of length"),
    ],
    ..KeyTable::EMPTY
};

/// `[stiffness]`, which needs the stiffness of the legs, and for a natural frequency also masses and units.
pub(super) fn stiffness(
    report: &mut Findings<'_>,
    top: &[Entry],
    hardware: &Hardware,
    units: Option<&str>,
) -> Option<PlatformStiffness> {
    let (entry, mut required) = (find(top, "stiffness")?, PlatformStiffness::default());
    let entries = STIFFNESS.read(report, &entry.node, "[stiffness]", &mut required)?;
    if hardware.leg_stiffness.is_none() {
        let message = "[stiffness] needs the stiffness of a leg";
        let help = "add `leg_stiffness` to [hardware], force units per design unit";
        report.refuse(Code::MissingKey, &entry.key_span, message, help);
    }
    if let (Some(entry), Some(units)) = (find(entries, "natural_frequency"), units) {
        let place = "`natural_frequency` of [stiffness]";
        let payload = find(top, "payload").map(|e| &e.node.value);
        if !matches!(payload, Some(Value::Table(payload)) if find(payload, "inertia").is_some()) {
            let message = format!("{place} needs the mass and the inertia that vibrate");
            let help = "add [payload] with `mass`, `center` and `inertia`";
            report.refuse(Code::MissingKey, &entry.key_span, message, help);
        }
        if micrometres(units).is_none() {
            let message = format!("{place} needs a known unit of length, not \"{}\"", shown(units));
            let help = "write units = \"mm\", \"m\" or \"in\", for instance";
            report.refuse(Code::WrongType, &entry.key_span, message, help);
        }
    }
    Some(required)
}

const FIXED_TO: KeyKind = word(Body::words);

pub(super) static LOAD: KeyTable<Load> = KeyTable {
    keys: &[
        key!("name": TEXT, name; "name of the load in answers"),
        key!("force" { default = "[0, 0, 0]" }: vector(unit::FORCE), force; "force, force units"),
        key!("torque" { default = "[0, 0, 0]" }: vector(unit::TORQUE), torque;
            "torque, force units times design units"),
        key!("at" { default = "[0, 0, 0]" }: vector(unit::LENGTH), at;
            "point of application of the force, platform frame"),
        key!("fixed_to" { default = r#""base""# }: FIXED_TO, fixed_to;
            "body whose axes force and torque follow; a weight follows the base"),
    ],
    ..KeyTable::EMPTY
};

/// Reads each table of a list of tables; `begin` gives the initial value for each place.
fn read_all<'e, M>(
    report: &mut Findings<'_>,
    top: &'e [Entry],
    (key, keys): (&str, &KeyTable<M>),
    begin: impl Fn(usize) -> M,
) -> Vec<(M, &'e [Entry])> {
    let Some(entry) = find(top, key) else { return Vec::new() };
    let Value::Array(list) = &entry.node.value else {
        let (what, help) = (format!("`{key}`"), format!("write [[{key}]] above each"));
        return report.not_a(&entry.node, &what, "a list of tables", help).unwrap_or_default();
    };
    let place = format!("[[{key}]]");
    let mut out = Vec::new();
    for node in list {
        let mut item = begin(out.len() + 1);
        let entries = keys.read(report, node, &place, &mut item);
        out.extend(entries.map(|entries| (item, entries)));
    }
    out
}

/// `[[loads]]`.
pub(super) fn loads(report: &mut Findings<'_>, top: &[Entry]) -> Vec<Load> {
    let begin = |i: usize| Load {
        name: format!("load {i}"),
        force: Vector3::zeros(),
        torque: Vector3::zeros(),
        at: Point3::origin(),
        fixed_to: Body::Base,
        legs: None,
    };
    read_all(report, top, ("loads", &LOAD), begin).into_iter().map(|(load, _)| load).collect()
}

/// A table of `[[keep_out]]`.
pub(super) struct KeepOutKeys {
    name: String,
    fixed_to: Body,
    shape: Option<KeepOutShape>,
}

pub(super) static KEEP_OUT: KeyTable<KeepOutKeys> = KeyTable {
    keys: &[
        key!("name": TEXT, name; "name of the body in answers"),
        key!("fixed_to" { default = r#""base""# }: FIXED_TO, fixed_to;
            "body whose frame it is in and that it moves with"),
        key!("box": table_of(&BOX),
            |found, to| to.shape = shape(found), |of| written(of.shape.as_ref(), "box");
            "edges along the axes of the frame"),
        key!("sphere": table_of(&SPHERE),
            |found, to| to.shape = shape(found),
            |of| written(
            of.shape.as_ref(),
            "sphere"
        );
            "a ball"),
        key!("capsule": table_of(&CAPSULE),
            |found, to| to.shape = shape(found), |of| written(of.shape.as_ref(), "capsule");
            "all points within half the diameter of a line"),
    ],
    rules: r#"{"oneOf": [{"required": ["box"]}, {"required": ["sphere"]}, {"required": ["capsule"]}]}"#,
    ..KeyTable::EMPTY
};

impl From<&KeepOut> for KeepOutKeys {
    fn from(k: &KeepOut) -> Self {
        Self { name: k.name.clone(), fixed_to: k.fixed_to, shape: Some(k.shape) }
    }
}

/// `[[keep_out]]`.
pub(super) fn keep_outs(report: &mut Findings<'_>, top: &[Entry]) -> Vec<KeepOut> {
    let begin = |i: usize| KeepOutKeys { name: format!("keep-out {i}"), fixed_to: Body::Base, shape: None };
    let mut out = Vec::new();
    for (KeepOutKeys { name, fixed_to, shape }, entries) in
        read_all(report, top, ("keep_out", &KEEP_OUT), begin)
    {
        let shapes =
            entries.iter().filter(|e| ["box", "sphere", "capsule"].contains(&e.key.as_str())).count();
        if shapes != 1 {
            let span = find(top, "keep_out").map_or(0..0, |e| e.key_span.clone());
            let message = format!("{} has {shapes} shapes", shown(&name));
            let help = "give one of box = { center, size }, sphere = { center, diameter }, capsule = { from, to, diameter }";
            report.refuse(Code::MissingKey, &span, message, help);
        } else if let Some(shape) = shape {
            out.push(KeepOut { name, fixed_to, shape });
        }
    }
    out
}
