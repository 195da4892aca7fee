//! `base_joint`, `platform_joint` and `screw_lead` of `[hardware]`: the kinds of joints of a body.

use nalgebra::{Unit, Vector3};
use serde_json::Value as Json;

use super::axes::named;
use super::found::{check_keys, element_span, numbers, table};
use super::hardware::{HOUSING, axis};
use super::kind::{
    KeyKind, KeyShape, Range, angle, either, list_of, not_negative, own, positive, table as table_of, unit,
    vector, word,
};
use super::stored::{Stored, StoredValue, Word};
use super::{Code, FoundKey, KeyTable, key};
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{Hardware, Housing, JointAxes, JointType, UniversalJoint};
use platform::manipulator::Body;

/// The kinds of the joints of a body, leg by leg.
#[derive(Clone, Copy, Default)]
pub(super) struct JointModel {
    pub(super) universal: Option<UniversalJoint>,
    pub(super) bending: [Option<f64>; 6],
    /// Greatest angles of the joints whose tables state one.
    pub(super) cone_angle_deg: [Option<f64>; 6],
    /// Housings of the joints whose tables state one.
    pub(super) housing: [Option<Housing>; 6],
}

/// The table of the joint of one leg, or of all legs.
#[derive(Default, Clone, Copy)]
struct JointKeys {
    model: Option<JointType>,
    /// Whether the table is about all legs.
    is_of_all: bool,
    /// First axes of universal joints.
    first_axes: Option<[Unit<Vector3<f64>>; 6]>,
    limits_deg: Option<[f64; 2]>,
    offset: f64,
    bending: Option<f64>,
    cone_angle_deg: Option<f64>,
    housing: Option<Housing>,
}

/// One table for all joints of a body, or six in leg order.
pub(super) const JOINT_MODELS: KeyKind = either(&JOINT_KINDS);
static JOINT_KINDS: [KeyKind; 2] = [ONE_JOINT, list_of(6, &ONE_JOINT_KIND)];
static ONE_JOINT_KIND: KeyKind = ONE_JOINT;
const ONE_JOINT: KeyKind = table_of(&JOINT);

const TWO_ANGLES: KeyKind = own(
    r#"{
        "type": "array",
        "minItems": 2,
        "maxItems": 2,
        "prefixItems": [
            {"type": "number", "exclusiveMinimum": 0, "maximum": 180},
            {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 90}
        ],
        "items": false
    }"#,
    unit::DEGREES,
);

static JOINT: KeyTable<JointKeys> = KeyTable {
    definition: "joint_model",
    keys: &[
        key!("model" { required = "add model = \"universal\", \"flexure\" or \"ball\"" }: word(JointType::words), model;
            "`ball`: rotates freely in a cone; `universal`: two axes, the first fixed in the body, the second at a right angle to it and to the leg; `flexure`: bends about its centre, within the cone angle"),
        key!("first_axis": either(&[vector(unit::NONE), list_of(6, &vector(unit::NONE))]),
            |found, to| to.first_axes = first_axes(found, to.is_of_all),
            |of| Some(first_axes_json(&of.first_axes?));
            "universal: direction of the first axis in the frame of the body, one for all joints or six in leg order, and one in each table of a list; required"),
        key!("angle_deg": TWO_ANGLES,
            |found, to| to.limits_deg = limits(found.report, found.entry), |of| of.limits_deg.written();
            "universal: greatest angles about the first and about the second axis, in both directions, degrees; no limit when absent"),
        key!("offset" { default = "0" }: not_negative(unit::LENGTH),
            |found, to| found.fill(&mut to.offset), |of| Some(of.offset).filter(|x| *x != 0.0).written();
            "universal: distance of the two axes, which meet when it is 0"),
        key!("housing": HOUSING, housing;
            "space that the joint occupies, in place of the housing of the body: a diameter, or edge lengths of a box along the axes of the body"),
        key!("cone_angle_deg" { old = "swing_deg" }: angle(Range::HalfTurn), cone_angle_deg;
            "greatest angle between the leg and the axis of the joint, in place of the angle of the body (`base_cone_angle_deg`, `platform_cone_angle_deg`)"),
        key!("bending_stiffness": positive(unit::TORQUE), bending;
            "flexure: torque over angle, force units times design units per radian; required"),
    ],
    ..KeyTable::EMPTY
};

/// Whether joints of a model have a key.
fn has_key(model: JointType, key: &str) -> bool {
    match key {
        "model" | "housing" | "cone_angle_deg" => true,
        "bending_stiffness" => model == JointType::Flexure,
        _ => model == JointType::Universal,
    }
}

/// The joints of a body with their axes; universal joints need them.
pub(super) fn with_axes(
    report: &mut Findings<'_>,
    entries: &[Entry],
    body: Body,
    (found, given): (JointModel, Option<JointAxes>),
) -> JointModel {
    let [table_key, axes_key, cone_angle_key] = body.of((
        ["base_joint", "base_axes", "base_cone_angle_deg"],
        ["platform_joint", "platform_axes", "platform_cone_angle_deg"],
    ));
    let joint = find(entries, table_key);
    let axes = find(entries, axes_key);
    let cone_angle = find(entries, cone_angle_key);
    let own_cone_angle = found.cone_angle_deg.iter().any(Option::is_some);
    if let (Some(e), None, None, false) = (axes, cone_angle, found.universal, own_cone_angle) {
        let message = format!("`{axes_key}` without `{cone_angle_key}`");
        let help = format!("add `{cone_angle_key}` or universal joints, or remove `{axes_key}`");
        report.refuse(Code::MissingKey, &e.key_span, message, help);
    }
    if let (Some(e), None) = (joint, cone_angle)
        && found.bending.iter().zip(&found.cone_angle_deg).any(|(k, deg)| k.is_some() && deg.is_none())
    {
        let message = format!("flexures have a greatest angle, and `{cone_angle_key}` is missing");
        let help = format!("add `{cone_angle_key}` to [hardware], or `cone_angle_deg` to the joint");
        report.refuse(Code::MissingKey, &e.key_span, message, help);
    }
    let Some(universal) = found.universal else { return found };
    // normals are filled in later
    if let (Some(e), Some(given)) = (axes.filter(|e| !named(&e.node).contains(&true)), given) {
        check_axes(report, e, given, &universal);
    }
    let axes = given.unwrap_or(JointAxes::Home);
    JointModel { universal: Some(UniversalJoint { axes, ..universal }), ..found }
}

/// One table for all joints, or six in leg order.
pub(super) fn models(found: &mut FoundKey<'_, '_>) -> Option<JointModel> {
    let (report, entry, key) = (&mut *found.report, found.entry, &found.entry.key);
    let Value::Array(list) = &entry.node.value else {
        let place = format!("`{key}` of [hardware]");
        let one = model(report, &entry.node, &entry.key_span, &place, true)?;
        return Some(JointModel {
            universal: one.first_axes.map(|axes| UniversalJoint {
                first_axes: axes.map(Some),
                limits_deg: [one.limits_deg; 6],
                axes: JointAxes::Home,
                offset: one.offset,
            }),
            bending: [one.bending; 6],
            cone_angle_deg: [one.cone_angle_deg; 6],
            housing: [one.housing; 6],
        });
    };
    if list.len() != 6 {
        let message = format!("`{key}` is a list of {}", list.len());
        let help = "write one table for all joints of the body, or a list of six in leg order";
        return report.refused(Code::WrongType, &entry.node.span, message, help);
    }
    let mut all = [JointKeys::default(); 6];
    let mut are_read = true;
    for (i, node) in list.iter().enumerate() {
        let place = format!("`{key}` of leg {} in [hardware]", i + 1);
        match model(report, node, &node.span, &place, false) {
            Some(found) => all[i] = found,
            None => are_read = false,
        }
    }
    if !are_read {
        return None;
    }
    one_offset(report, list, &all);
    let first_axes: [Option<Unit<Vector3<f64>>>; 6] =
        std::array::from_fn(|i| all[i].first_axes.map(|axes| axes[i]));
    let has_universal = first_axes.iter().any(Option::is_some);
    Some(JointModel {
        universal: has_universal.then(|| UniversalJoint {
            first_axes,
            limits_deg: all.map(|joint| joint.limits_deg),
            axes: JointAxes::Home,
            offset: all.iter().map(|joint| joint.offset).fold(0.0, f64::max),
        }),
        bending: all.map(|joint| joint.bending),
        cone_angle_deg: all.map(|joint| joint.cone_angle_deg),
        housing: all.map(|joint| joint.housing),
    })
}

/// An offset between axes applies to all six joints of a body, since the drive lengths of all legs are computed in one
/// way.
fn one_offset(report: &mut Findings<'_>, list: &[Node], all: &[JointKeys; 6]) {
    let Some(offset) = all.iter().map(|joint| joint.offset).find(|x| *x != 0.0) else { return };
    if let Some(i) = all.iter().position(|joint| joint.offset.to_bits() != offset.to_bits()) {
        let message = format!("leg {} has a joint without the `offset` of {offset} of the others", i + 1);
        let help = "give all six joints of the body the model \"universal\" with the same `offset`, or none an offset";
        report.refuse(Code::ConflictingKeys, &list[i].span, message, help);
    }
}

/// The axes of universal joints must be known and differ from their first axes.
pub(super) fn check_axes(report: &mut Findings<'_>, entry: &Entry, axes: JointAxes, joint: &UniversalJoint) {
    match axes {
        JointAxes::Home => {}
        JointAxes::Optimize => {
            let message = "axes of universal joints are not chosen by the optimiser";
            let help = "write \"home\", \"normal\", a vector, or six in leg order";
            report.refuse(Code::ConflictingKeys, &entry.node.span, message, help);
        }
        JointAxes::Given(axes) => {
            for (i, (axis, first)) in axes.iter().zip(&joint.first_axes).enumerate() {
                if first.is_some_and(|first| axis.cross(&first).norm() == 0.0) {
                    let message =
                        format!("the axis of leg {} is the first axis of its universal joint", i + 1);
                    let help =
                        "the axis points along the leg at rest, which is across the first axis or near it";
                    report.refuse(Code::OutOfRange, &element_span(&entry.node, i), message, help);
                }
            }
        }
    }
}

/// A table of joints.
fn model(
    report: &mut Findings<'_>,
    node: &Node,
    span: &Span,
    place: &str,
    is_of_all: bool,
) -> Option<JointKeys> {
    let entries = table(report, node, place)?;
    check_keys(report, entries, &JOINT.names(), place);
    let mut keys = JointKeys { is_of_all, ..JointKeys::default() };
    let missing = |report: &mut Findings<'_>, key: &str, help: &str| {
        let is_missing = find(entries, key).is_none();
        if is_missing {
            report.refuse(Code::MissingKey, span, format!("`{key}` of {place} is missing"), help);
        }
        is_missing
    };
    if missing(report, "model", JOINT.keys[0].required) {
        return None;
    }
    JOINT.fill(report, entries, place, &mut keys, |key| key == "model");
    let model = keys.model?;
    for other in entries.iter().filter(|e| JOINT.kind(&e.key).is_some() && !has_key(model, &e.key)) {
        let message = format!("`{}` is no key of joints whose model is \"{}\"", other.key, model.name());
        report.refuse(Code::ConflictingKeys, &other.key_span, message, "remove it, or change the model");
    }
    JOINT.fill(report, entries, place, &mut keys, |key| key != "model" && has_key(model, key));
    match model {
        JointType::Universal => {
            let help = "add first_axis = [x, y, z], in the frame of the body, or six vectors in leg order";
            missing(report, "first_axis", help);
            keys.first_axes?;
        }
        JointType::Flexure => {
            let help = "add it, in force units times design units per radian";
            missing(report, "bending_stiffness", help);
        }
        JointType::Ball => {}
    }
    Some(keys)
}

/// One direction for all joints, or six in leg order.
fn first_axes(found: &mut FoundKey<'_, '_>, is_of_all: bool) -> Option<[Unit<Vector3<f64>>; 6]> {
    let (report, entry) = (&mut *found.report, found.entry);
    if !is_of_all {
        return axis(report, &entry.node, &entry.key).map(|one| [one; 6]);
    }
    let is_list = |node: &Node| matches!(node.value, Value::Array(_));
    match &entry.node.value {
        Value::Array(list) if list.len() == 6 && list.iter().all(is_list) => {
            let all: Vec<_> = list.iter().map(|node| axis(report, node, &entry.key)).collect();
            all.into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()
        }
        Value::Array(list) if list.len() == 3 && !list.iter().any(is_list) => {
            axis(report, &entry.node, &entry.key).map(|one| [one; 6])
        }
        _ => {
            let message = "`first_axis` is neither a direction nor six of them";
            let help = "write [x, y, z], or six of them in leg order";
            report.refused(Code::WrongType, &entry.node.span, message, help)
        }
    }
}

/// Greatest angles about both axes.
fn limits(report: &mut Findings<'_>, entry: &Entry) -> Option<[f64; 2]> {
    let what = "angles, about the first and about the second axis";
    let limits = numbers::<2>(report, &entry.node, "`angle_deg`", Code::CoordinateCount, what)?;
    let help =
        "give [first, second]: the first above 0 and at most 180, the second above 0 and below 90 degrees";
    for (k, (x, fits)) in limits.iter().zip([(limits[0] <= 180.0), (limits[1] < 90.0)]).enumerate() {
        if !(*x > 0.0 && fits) {
            let span = element_span(&entry.node, k);
            report.refuse(Code::OutOfRange, &span, format!("a greatest angle of {x} degrees"), help);
        }
    }
    Some(limits)
}

/// `screw_lead` couples the relative rotation of two universal joints to the length.
pub(super) fn check_screw_lead(report: &mut Findings<'_>, entries: &[Entry], joints: [&JointModel; 2]) {
    let Some(entry) = find(entries, "screw_lead") else { return };
    if joints.iter().any(|joint| !joint.universal.is_some_and(|j| j.is_of_all())) {
        let message = "`screw_lead` is about legs with universal joints at both ends";
        let help = "ball joints leave the turn of a leg about itself free, so that it has no lead: give `base_joint` and `platform_joint` the model \"universal\", or remove `screw_lead`";
        report.refuse(Code::MissingKey, &entry.key_span, message, help);
    }
}

/// Refuses joint offsets if the command takes the length of a drive for the distance of its joints.
pub(super) fn refuse_coupled(report: &mut Findings<'_>, top: &[Entry], hardware: &Hardware, takes: bool) {
    if takes || !hardware.is_coupled() {
        return;
    }
    let Some(entry) = find(top, "hardware") else { return };
    let message = "the joints are not ideal (`offset` of universal joints or `screw_lead`), but this question needs drive lengths equal to joint distances";
    let help = "`equipod ik`, `fk --near`, `assess`, `export --to c` and `design convert` take such joints; without `offset` and `screw_lead` the file has the machine with ideal joints";
    report.refuse(Code::NotIdeal, &entry.key_span, message, help);
}

/// The joints of a body; nothing if all are balls with one limit and the housing of the body.
pub(super) fn written(h: &Hardware, body: Body) -> Option<Json> {
    let universal = h.universal(body);
    let cone_angle = body.of((h.base_cone_angle, h.platform_cone_angle));
    let (bending, housings) =
        body.of(((h.base_bending, h.base_joint_housing), (h.platform_bending, h.platform_joint_housing)));
    let joint = |leg: usize, first_axes: Option<[Unit<Vector3<f64>>; 6]>| {
        let model = h.joint_kind(body, leg);
        let own = universal.filter(|_| model == JointType::Universal);
        JointKeys {
            model: Some(model),
            is_of_all: false,
            first_axes,
            limits_deg: own.and_then(|joint| joint.limits_deg[leg]),
            offset: own.map_or(0.0, |joint| joint.offset),
            bending: bending[leg],
            // the limit of all legs is a separate key
            cone_angle_deg: cone_angle
                .filter(|s| s.common_deg().is_none())
                .map(|s| s.limits_deg[leg])
                .filter(|deg| *deg < 180.0),
            housing: housings[leg],
        }
    };
    let first = |leg: usize| universal?.first_axes[leg];
    let six: [Json; 6] =
        std::array::from_fn(|leg| Json::Object(JOINT.write(&joint(leg, first(leg).map(|axis| [axis; 6])))));
    let mut alike = six.clone();
    alike.iter_mut().filter_map(Json::as_object_mut).for_each(|keys| {
        keys.shift_remove("first_axis");
    });
    if alike.iter().any(|joint| *joint != alike[0]) || cone_angle.is_some_and(|s| s.common_deg().is_none()) {
        return Some(six.to_vec().into());
    }
    if h.joint_kind(body, 0) == JointType::Ball && housings[0].is_none() {
        return None;
    }
    let all: Option<Vec<_>> = (0..6).map(first).collect();
    JOINT.put(&joint(0, all.and_then(|all| all.try_into().ok())))
}

/// A single direction if all are equal.
fn first_axes_json(axes: &[Unit<Vector3<f64>>; 6]) -> Json {
    let list = axes.map(|axis| axis.into_inner().json());
    if list.iter().all(|axis| *axis == list[0]) { list[0].clone() } else { list.to_vec().into() }
}
