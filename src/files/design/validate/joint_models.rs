//! `base_joint`, `platform_joint` and `screw_lead` of `[hardware]`: what kind of joints a body has.

use nalgebra::{Unit, Vector3};

use super::axes::named;
use super::tables::{angle_to_half_turn, axis, housing, joint_axes, not_negative, positive};
use super::{check_keys, element_span, number, numbers, shown, table, text};
use crate::design::Code;
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{Hardware, Housing, JointAxes, UniversalJoint};
use platform::manipulator::Body;

/// What the joints of a body are, leg by leg.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct JointModel {
    pub(super) universal: Option<UniversalJoint>,
    pub(super) bending: [Option<f64>; 6],
    /// Greatest angles of the joints whose tables have one.
    pub(super) swing_deg: [Option<f64>; 6],
    /// Housings of the joints whose tables have one.
    pub(super) housing: [Option<Housing>; 6],
}

/// What a table says of the joint of one leg, or of those of all.
#[derive(Debug, Clone, Copy, Default)]
struct JointTable {
    /// Of universal joints.
    first_axes: Option<[Unit<Vector3<f64>>; 6]>,
    limits_deg: Option<[f64; 2]>,
    offset: f64,
    bending: Option<f64>,
    swing_deg: Option<f64>,
    housing: Option<Housing>,
}

pub(super) const KEYS: [&str; 7] =
    ["model", "first_axis", "angle_deg", "offset", "housing", "swing_deg", "bending_stiffness"];

/// The keys of a model besides its name.
fn keys_of(model: &str) -> Option<&'static [&'static str]> {
    match model {
        "ball" => Some(&KEYS[4..6]),
        "universal" => Some(&KEYS[1..6]),
        "flexure" => Some(&KEYS[4..]),
        _ => None,
    }
}

/// The joints of a body, and its axes, which need joints that are measured from them.
pub(super) fn joint_model(report: &mut Findings<'_>, entries: &[Entry], body: Body) -> JointModel {
    let [table_key, axes_key, swing_key] = body.of((
        ["base_joint", "base_axes", "base_swing_deg"],
        ["platform_joint", "platform_axes", "platform_swing_deg"],
    ));
    let joint = find(entries, table_key);
    let found = joint.and_then(|e| models(report, e, table_key)).unwrap_or_default();
    let axes = find(entries, axes_key);
    let swing = find(entries, swing_key);
    let own_swing = found.swing_deg.iter().any(Option::is_some);
    if let (Some(e), None, None, false) = (axes, swing, found.universal, own_swing) {
        let message = format!("`{axes_key}` without `{swing_key}`");
        let help = format!("add `{swing_key}` or universal joints, or remove `{axes_key}`");
        report.refuse(Code::MissingKey, &e.key_span, message, help);
    }
    if let (Some(e), None) = (joint, swing)
        && found.bending.iter().zip(&found.swing_deg).any(|(k, deg)| k.is_some() && deg.is_none())
    {
        let message = format!("flexures have a greatest angle, and `{swing_key}` is missing");
        let help = format!("add `{swing_key}` to [hardware], or `swing_deg` to the joint");
        report.refuse(Code::MissingKey, &e.key_span, message, help);
    }
    let Some(universal) = found.universal else { return found };
    // faults of the axes are reported where swing reads them
    let axes = match axes {
        Some(e) if swing.is_none() => joint_axes(report, e).map(|axes| (e, axes)),
        Some(e) => quiet_axes(e).map(|axes| (e, axes)),
        None => None,
    };
    // normals are known later
    if let Some((e, axes)) = axes.filter(|(e, _)| !named(&e.node).contains(&true)) {
        check_axes(report, e, axes, &universal);
    }
    let axes = axes.map_or(JointAxes::Home, |(_, axes)| axes);
    JointModel { universal: Some(UniversalJoint { axes, ..universal }), ..found }
}

/// One table for all joints, or six in leg order.
fn models(report: &mut Findings<'_>, entry: &Entry, key: &str) -> Option<JointModel> {
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
            swing_deg: [one.swing_deg; 6],
            housing: [one.housing; 6],
        });
    };
    if list.len() != 6 {
        let message = format!("`{key}` is a list of {}", list.len());
        let help = "write one table for all joints of the body, or a list of six in leg order";
        report.refuse(Code::WrongType, &entry.node.span, message, help);
        return None;
    }
    let mut all = [JointTable::default(); 6];
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
        swing_deg: all.map(|joint| joint.swing_deg),
        housing: all.map(|joint| joint.housing),
    })
}

/// Axes that do not meet are those of all six joints of a body: the lengths of its drives are computed for all legs in one way.
fn one_offset(report: &mut Findings<'_>, list: &[Node], all: &[JointTable; 6]) {
    let Some(offset) = all.iter().map(|joint| joint.offset).find(|x| *x != 0.0) else { return };
    if let Some(i) = all.iter().position(|joint| joint.offset.to_bits() != offset.to_bits()) {
        let message = format!("leg {} has a joint without the `offset` of {offset} of the others", i + 1);
        let help = "give all six joints of the body the model \"universal\" with the same `offset`, or none an offset";
        report.refuse(Code::ConflictingKeys, &list[i].span, message, help);
    }
}

/// Axes that have been read before.
fn quiet_axes(entry: &Entry) -> Option<JointAxes> {
    let mut nobody = Findings::new("");
    joint_axes(&mut nobody, entry)
}

/// Universal joints have axes that are known and that are not their first axes.
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

/// A table of joints; `of_all`: it is about all legs.
fn model(
    report: &mut Findings<'_>,
    node: &Node,
    span: &std::ops::Range<usize>,
    place: &str,
    of_all: bool,
) -> Option<JointTable> {
    let entries = table(report, node, place)?;
    check_keys(report, entries, &KEYS, place);
    let Some(word) = find(entries, "model") else {
        let help = "add model = \"universal\", \"flexure\" or \"ball\"";
        report.refuse(Code::MissingKey, span, format!("`model` of {place} is missing"), help);
        return None;
    };
    let name = text(report, word)?;
    let Some(own) = keys_of(&name) else {
        let message = format!("`model` is \"{}\"", shown(&name));
        report.refuse(
            Code::WrongType,
            &word.node.span,
            message,
            "write \"ball\", \"universal\" or \"flexure\"",
        );
        return None;
    };
    for other in
        entries.iter().filter(|e| KEYS[1..].contains(&e.key.as_str()) && !own.contains(&e.key.as_str()))
    {
        let message = format!("`{}` is no key of joints whose model is \"{name}\"", other.key);
        report.refuse(Code::ConflictingKeys, &other.key_span, message, "remove it, or change the model");
    }
    let swing_deg = angle_to_half_turn(report, entries, "swing_deg");
    let housing = housing(report, entries, "housing");
    let found = JointTable { swing_deg, housing, ..JointTable::default() };
    Some(match name.as_str() {
        "universal" => {
            let Some(first) = find(entries, "first_axis") else {
                let help =
                    "add first_axis = [x, y, z], in the frame of the body, or six vectors in leg order";
                let message = format!("`first_axis` of {place} is missing");
                report.refuse(Code::MissingKey, span, message, help);
                return None;
            };
            let first_axes =
                if of_all { first_axes(report, first)? } else { [axis(report, &first.node, &first.key)?; 6] };
            JointTable {
                first_axes: Some(first_axes),
                limits_deg: find(entries, "angle_deg").and_then(|e| limits(report, e)),
                offset: not_negative(report, entries, "offset").unwrap_or_default(),
                ..found
            }
        }
        "flexure" => {
            if find(entries, "bending_stiffness").is_none() {
                let message = format!("`bending_stiffness` of {place} is missing");
                let help = "add it, in force units times design units per radian";
                report.refuse(Code::MissingKey, span, message, help);
            }
            JointTable { bending: positive(report, entries, "bending_stiffness"), ..found }
        }
        _ => found,
    })
}

/// One direction for all joints, or six in leg order.
fn first_axes(report: &mut Findings<'_>, entry: &Entry) -> Option<[Unit<Vector3<f64>>; 6]> {
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
            report.refuse(Code::WrongType, &entry.node.span, message, help);
            None
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

/// `screw_lead`, which couples the turn of one universal joint against the other to the length.
pub(super) fn screw_lead(
    report: &mut Findings<'_>,
    entries: &[Entry],
    joints: [&JointModel; 2],
) -> Option<f64> {
    let entry = find(entries, "screw_lead")?;
    let lead = number(report, &entry.node, "`screw_lead`")?;
    if joints.iter().any(|joint| !joint.universal.is_some_and(|j| j.is_of_all())) {
        let message = "`screw_lead` is about legs with universal joints at both ends";
        let help = "ball joints leave the turn of a leg about itself free, so that it has no lead: give `base_joint` and `platform_joint` the model \"universal\", or remove `screw_lead`";
        report.refuse(Code::MissingKey, &entry.key_span, message, help);
    }
    Some(lead)
}

/// Refuses joints that are not ideal where what is asked for takes the length of a drive for the distance of its joints.
pub(super) fn refuse_coupled(report: &mut Findings<'_>, top: &[Entry], hardware: &Hardware, takes: bool) {
    if takes || !hardware.is_coupled() {
        return;
    }
    let Some(entry) = find(top, "hardware") else { return };
    let message = "the joints are not ideal (`offset` of universal joints or `screw_lead`), and what is asked for takes the length of a drive for the distance of its joints";
    let help = "`equipod ik`, `fk --near`, `assess`, `export --to c` and `design convert` take such joints; without `offset` and `screw_lead` the file has the machine with ideal joints";
    report.refuse(Code::NotIdeal, &entry.key_span, message, help);
}
