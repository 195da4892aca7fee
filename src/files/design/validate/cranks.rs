//! `drive` and `[cranks]`: rods on cranks in place of legs that change their lengths.

use super::constructions::{Places, quantity, three_quantities};
use super::joints::{Legs, NamedJoints};
use super::tables::positive;
use super::{check_keys, nearest_help, shown, table, text};
use crate::design::construction::{
    Constructions, CoordinatePlane, CrankCopy, CrankLimits, PARTS, WrittenCrank, WrittenCranks, WrittenNumber,
};
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use crate::design::{Code, DesignModel};
use machine::rotary::Elbow;

/// Keys of all cranks and of single ones.
pub(super) const CRANK_KEYS: [&str; 6] = ["length", "rod_length", "axis", "zero", "elbow", "angle_deg"];
/// Keys of single cranks that are copies.
pub(super) const COPY_KEYS: [&str; 4] = ["turn", "deg", "mirror", "plane"];
/// Keys of all cranks together.
pub(super) const DRIVE_KEYS: [&str; 5] =
    ["max_torque", "max_speed_deg", "least_transmission_deg", "tip_swing_deg", "platform_swing_deg"];
/// What is about legs that change their lengths.
const OF_LENGTHS: [&str; 7] =
    ["lengths", "hardware", "envelope", "plates", "keep_out", "optimize", "calibration"];

/// Where all cranks and single ones are written.
#[derive(Debug, Default)]
pub(super) struct CrankPlaces {
    key: Span,
    shared: Places,
    own: Vec<Option<Places>>,
    /// Something in [cranks] could not be read, so that what is missing may be that.
    unread: bool,
}

impl CrankPlaces {
    /// The place of what is said of all cranks, or of the one at a base joint.
    pub(super) fn of(&self, joint: Option<usize>) -> &Places {
        joint.and_then(|j| self.own.get(j)?.as_ref()).unwrap_or(&self.shared)
    }
}

/// `drive`, and `[cranks]` where it is `"rotary"`.
pub(super) fn cranks(
    report: &mut Findings<'_>,
    top: &[Entry],
    base: Option<&NamedJoints>,
    takes_cranks: bool,
) -> Option<(WrittenCranks, CrankPlaces)> {
    let drive = find(top, "drive");
    let word = drive.and_then(|e| text(report, e));
    let table_entry = find(top, "cranks");
    match word.as_deref() {
        Some("rotary") => {}
        Some("prismatic") | None => {
            if let (Some(e), true) = (table_entry, drive.is_none() || word.is_some()) {
                let help = "write `drive = \"rotary\"` above the first table, or remove [cranks]";
                let message = "[cranks] is of a design whose drive is \"rotary\"";
                report.refuse(Code::ConflictingKeys, &e.key_span, message, help);
            }
            return None;
        }
        Some(other) => {
            if let Some(e) = drive {
                let message = format!("`drive` is \"{}\"", shown(other));
                report.refuse(Code::WrongType, &e.node.span, message, "write \"prismatic\" or \"rotary\"");
            }
            return None;
        }
    }
    if let (Some(e), false) = (drive, takes_cranks) {
        let message =
            "the legs are rods on cranks, and what is asked for is about legs that change their lengths";
        let help = "`equipod ik`, `fk`, `assess`, `limits`, `motion`, `compare`, `view`, `export` and `design convert` take cranks; `assess` proves that no pose of the workspace is singular; leg maps hold between squared lengths of rods, and nothing follows from them for the angles of cranks";
        report.refuse(Code::Rotary, &e.node.span, message, help);
        return None;
    }
    for e in OF_LENGTHS.iter().filter_map(|key| find(top, key)) {
        let message =
            format!("`{}` is about legs that change their lengths, and the drive is \"rotary\"", e.key);
        let help = "remove it; [cranks] has the lengths of cranks and rods and the limits of angles, torques and speeds";
        report.refuse(Code::ConflictingKeys, &e.key_span, message, help);
    }
    let Some(e) = table_entry else {
        let span = drive.map_or(0..0, |e| e.key_span.clone());
        let help = "add [cranks] with length, rod_length, axis, zero and elbow, and [cranks.NAME] for what is different at the base joint NAME";
        report.refuse(Code::MissingKey, &span, "`drive` is \"rotary\", and [cranks] is missing", help);
        return None;
    };
    let before = report.count();
    let entries = table(report, &e.node, "[cranks]")?;
    let base = base?;
    let names: Vec<&str> = base.joints.iter().map(|j| j.name.as_str()).collect();
    let joint = |key: &str| names.iter().position(|name| *name == key);
    let mut places =
        CrankPlaces { key: e.key_span.clone(), own: vec![None; names.len()], ..CrankPlaces::default() };
    let mut own = vec![None; names.len()];
    let all_keys = || CRANK_KEYS.into_iter().chain(DRIVE_KEYS);
    for entry in entries.iter().filter(|e| !all_keys().any(|key| key == e.key)) {
        if let Some(j) = joint(&entry.key) {
            (own[j], places.own[j]) = single(report, entry, &names).unzip();
        } else {
            let known: Vec<&str> = all_keys().chain(names.iter().copied()).collect();
            let message =
                format!("`{}` is neither a key of [cranks] nor a joint of the base", shown(&entry.key));
            let help = nearest_help("known keys and joints", &entry.key, &known);
            report.refuse(Code::UnknownKey, &entry.key_span, message, help);
        }
    }
    let shared;
    (shared, places.shared) = numbers(report, &e.node, entries, "all cranks");
    places.shared.whole = e.key_span.clone();
    let drives = CrankLimits {
        max_torque: positive(report, entries, DRIVE_KEYS[0]),
        max_speed_deg: positive(report, entries, DRIVE_KEYS[1]),
        least_transmission_deg: angle_below(report, entries, DRIVE_KEYS[2], 90.0),
        tip_swing_deg: angle_below(report, entries, DRIVE_KEYS[3], 90.0),
        platform_swing_deg: angle_below(report, entries, DRIVE_KEYS[4], 180.0),
    };
    places.unread = report.count() > before;
    Some((WrittenCranks { shared, own, drives, values: Vec::new() }, places))
}

/// A positive angle of less than so many degrees.
fn angle_below(report: &mut Findings<'_>, entries: &[Entry], key: &str, most: f64) -> Option<f64> {
    let angle = positive(report, entries, key)?;
    if angle < most {
        return Some(angle);
    }
    if let Some(e) = find(entries, key) {
        let message = format!("`{key}` is {angle} degrees");
        report.refuse(Code::OutOfRange, &e.node.span, message, format!("give an angle below {most} degrees"));
    }
    None
}

/// A table of one crank.
fn single(report: &mut Findings<'_>, entry: &Entry, names: &[&str]) -> Option<(WrittenCrank, Places)> {
    let what = format!("the crank {}", shown(&entry.key));
    let entries = table(report, &entry.node, &what)?;
    let known: Vec<&str> = CRANK_KEYS.into_iter().chain(COPY_KEYS).collect();
    check_keys(report, entries, &known, &what);
    let (mut written, mut places) = numbers(report, &entry.node, entries, &what);
    places.whole = entry.key_span.clone();
    written.copy = copy(report, entry, entries, &what, names, &mut places);
    Some((written, places))
}

/// What is said of one crank or of all.
fn numbers(report: &mut Findings<'_>, node: &Node, entries: &[Entry], what: &str) -> (WrittenCrank, Places) {
    let mut places = Places { whole: node.span.clone(), parts: vec![node.span.clone(); PARTS] };
    let mut one = |report: &mut Findings<'_>, key: &str, part: usize| {
        let e = find(entries, key)?;
        places.parts[part] = e.node.span.clone();
        quantity(report, &e.node, &format!("`{key}` of {what}"))
    };
    let (length, rod_length) = (one(report, CRANK_KEYS[0], 0), one(report, CRANK_KEYS[1], 1));
    let mut three = |report: &mut Findings<'_>, key: &str, first: usize| {
        let e = find(entries, key)?;
        let label = format!("`{key}` of {what}");
        let (list, parts) = three_quantities(report, &e.node, &label, ("component", "components"))?;
        places.parts.splice(first..first + 3, parts);
        Some(list)
    };
    let (axis, zero) = (three(report, CRANK_KEYS[2], 2), three(report, CRANK_KEYS[3], 5));
    let angle_deg = find(entries, CRANK_KEYS[5]).and_then(|e| {
        let (range, parts) = range(report, &e.node, what)?;
        places.parts.splice(8..10, parts);
        Some(range)
    });
    let elbow = find(entries, CRANK_KEYS[4]).and_then(|e| {
        let word = text(report, e)?;
        let known = Elbow::BOTH.into_iter().find(|elbow| elbow.name() == word);
        if known.is_none() {
            let message = format!("`elbow` of {what} is \"{}\"", shown(&word));
            let help = "write \"plus\" for the greater of the two angles that hold a pose, \"minus\" for the smaller one";
            report.refuse(Code::WrongType, &e.node.span, message, help);
        }
        known
    });
    (WrittenCrank { length, rod_length, axis, zero, angle_deg, elbow, copy: None }, places)
}

fn range(report: &mut Findings<'_>, node: &Node, what: &str) -> Option<([WrittenNumber; 2], [Span; 2])> {
    let help = "write angle_deg = [least, greatest]";
    let Value::Array(list) = &node.value else {
        let message = format!("`angle_deg` of {what} is {}, not a pair of angles", node.value.kind());
        report.refuse(Code::WrongType, &node.span, message, help);
        return None;
    };
    let [least, most] = list.as_slice() else {
        let message = format!("`angle_deg` of {what} has {} angles instead of two", list.len());
        report.refuse(Code::CoordinateCount, &node.span, message, help);
        return None;
    };
    let read = [least, most].map(|e| quantity(report, e, &format!("an angle of {what}")));
    let [a, b] = read;
    Some(([a?, b?], [least.span.clone(), most.span.clone()]))
}

/// `turn` with `deg`, or `mirror` with `plane`.
fn copy(
    report: &mut Findings<'_>,
    entry: &Entry,
    entries: &[Entry],
    what: &str,
    names: &[&str],
    places: &mut Places,
) -> Option<CrankCopy> {
    let span = |e: &Entry| e.key_span.clone();
    let (turn, mirror) = (find(entries, "turn"), find(entries, "mirror"));
    if let (Some(_), Some(second)) = (turn, mirror) {
        let message = format!("{what} is both turned and mirrored");
        report.refuse(Code::ConflictingKeys, &span(second), message, "keep one of `turn` and `mirror`");
        return None;
    }
    for (key, of) in [("deg", "turn"), ("plane", "mirror")] {
        let (own, first) = (find(entries, key), find(entries, of));
        match (own, first) {
            (Some(e), None) => {
                let help = format!("add `{of}` with the name of a base joint, or remove `{key}`");
                report.refuse(Code::MissingKey, &span(e), format!("`{key}` of {what} without `{of}`"), help);
            }
            (None, Some(e)) => {
                let help = if key == "deg" { "add deg = 120" } else { "add plane = \"xz\"" };
                report.refuse(Code::MissingKey, &span(e), format!("`{of}` of {what} without `{key}`"), help);
            }
            _ => {}
        }
    }
    let from = turn.or(mirror)?;
    for e in ["axis", "zero"].iter().filter_map(|key| find(entries, key)) {
        let message = format!("{what} takes axis and zero from another crank and has its own `{}`", e.key);
        let help = format!("keep `{}`, or `axis` with `zero`", from.key);
        report.refuse(Code::ConflictingKeys, &span(e), message, help);
    }
    let name = text(report, from)?;
    let Some(crank) = names.iter().position(|known| **known == name) else {
        let message = format!("{what} starts from `{}`, which is not a joint of the base", shown(&name));
        report.refuse(Code::UnknownName, &from.node.span, message, nearest_help("known names", &name, names));
        return None;
    };
    if turn.is_some() {
        let e = find(entries, "deg")?;
        places.parts[PARTS - 1] = e.node.span.clone();
        let deg = quantity(report, &e.node, &format!("`deg` of {what}"))?;
        return Some(CrankCopy::Turned { crank, deg });
    }
    let e = find(entries, "plane")?;
    let plane = match &e.node.value {
        Value::Text(text) => CoordinatePlane::ALL.into_iter().find(|p| p.name() == text),
        _ => None,
    };
    if plane.is_none() {
        let message = format!("`plane` of the crank {} is no plane of two axes", shown(&entry.key));
        let help = "write plane = \"xy\", \"xz\" or \"yz\"";
        report.refuse(Code::WrongType, &e.node.span, message, help);
    }
    Some(CrankCopy::Mirrored { crank, plane: plane? })
}

/// Each leg has a crank of its own, about which everything needed is said.
pub(super) fn check_legs(
    report: &mut Findings<'_>,
    constructions: &Constructions,
    places: &CrankPlaces,
    (base, legs): (&NamedJoints, &Legs),
) {
    let Some(cranks) = &constructions.cranks else { return };
    for (i, (joint, _)) in legs.pairs.iter().enumerate() {
        let name = shown(&base.joints[*joint].name);
        if let Some(first) = legs.pairs[..i].iter().position(|(other, _)| other == joint) {
            let message = format!("legs {} and {} have the same crank {name}", first + 1, i + 1);
            let help = "a base joint is the centre of one crank: name six of them";
            report.refuse(Code::IdenticalLegs, &places.key, message, help);
            continue;
        }
        let Some(Err(missing)) = cranks.values.get(*joint).filter(|_| !places.unread) else { continue };
        let place = places.own[*joint].as_ref().map_or(&places.key, |own| &own.whole);
        let help = match *missing {
            "zero" => format!(
                "add zero = [x, y, z], the direction of the tip at the angle zero, to [cranks] or [cranks.{name}]"
            ),
            "elbow" => format!(
                "add elbow = \"plus\" or \"minus\", the side that the crank stays on, to [cranks] or [cranks.{name}]"
            ),
            key => format!("add `{key}` to [cranks] or [cranks.{name}]"),
        };
        report.refuse(Code::MissingKey, place, format!("the crank {name} has no `{missing}`"), help);
    }
}

/// Tips and joints make a platform at the angles zero.
pub(super) fn check_platform(report: &mut Findings<'_>, design: &DesignModel, places: &CrankPlaces) {
    if let Err(why) = design.rotary() {
        report.refuse(
            Code::OutOfRange,
            &places.key,
            why.to_string(),
            "check centres, axes, `zero` and lengths",
        );
    }
}
