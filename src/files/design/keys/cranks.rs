//! `drive` and `[cranks]`: rods on cranks in place of legs of variable length.

use serde_json::{Map, Value as Json, json};

use super::constructions::{NumberKind, Places, quantity, three_quantities};
use super::found::{check_keys, nearest_help, shown, table, text};
use super::joints::{Legs, NamedJoints};
use super::kind::{
    CombinedTable, KeyKind, Range, angle, positive, quantities, quantity as quantity_of, table as table_of,
    unit, word,
};
use super::stored::{self, Stored, StoredValue, Word};
use super::{FoundKey, KeyTable, TEXT, key};
use crate::design::construction::{
    Constructions, CoordinatePlane, CrankCopy, CrankLimits, PARTS, WrittenCrank, WrittenCranks, WrittenNumber,
};
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use crate::design::{Code, DesignModel};
use machine::rotary::Elbow;

/// A crank as it is written, with the places of its numbers and the names of all base joints.
#[derive(Default)]
struct CrankKeys {
    written: WrittenCrank,
    places: Places,
    names: Vec<String>,
}

/// Keys of all cranks and of single ones.
static CRANK: KeyTable<CrankKeys> = KeyTable {
    keys: &[
        key!("length": quantity_of(unit::LENGTH),
            |found, to| to.written.length = one(found, &mut to.places, 0),
            |of| of.written.length.as_ref().map(WrittenNumber::json);
            "length of each crank, from its centre to its tip"),
        key!("rod_length": quantity_of(unit::LENGTH),
            |found, to| to.written.rod_length = one(found, &mut to.places, 1),
            |of| of.written.rod_length.as_ref().map(WrittenNumber::json);
            "length of each rod, from the tip to the platform joint"),
        key!("axis": quantities(3, unit::NONE),
            |found, to| to.written.axis = three(found, &mut to.places, 2),
            |of| of.written.axis.as_ref().map(|list| stored::quantities(list));
            "direction of the axis, base frame; angles are positive by the right-hand rule"),
        key!("zero": quantities(3, unit::NONE),
            |found, to| to.written.zero = three(found, &mut to.places, 5),
            |of| of.written.zero.as_ref().map(|list| stored::quantities(list));
            "direction of the tip at the angle 0, base frame; its part along the axis is ignored"),
        key!("elbow": word(Elbow::words),
            |found, to| to.written.elbow = elbow(found), |of| of.written.elbow.written();
            "side of the crank: the greater (`plus`) or the smaller (`minus`) of its two angles for a pose, around the angle at which the tip is nearest to the platform joint"),
        key!("angle_deg": quantities(2, unit::DEGREES),
            |found, to| to.written.angle_deg = range(found, &mut to.places),
            |of| of.written.angle_deg.as_ref().map(|list| stored::quantities(list));
            "`[least, greatest]` angle, degrees; no limit when absent"),
    ],
    ..KeyTable::EMPTY
};

/// Keys of single cranks that are copies.
static COPY: KeyTable<CrankKeys> = KeyTable {
    keys: &[
        key!("turn": TEXT, |_, _| (), |of| of.copy(0);
            "the base joint of another crank: this one has its values, with axis and zero turned about the z axis of the base frame"),
        key!("deg": quantity_of(unit::DEGREES), |_, _| (), |of| of.copy(1); "with `turn`"),
        key!("mirror": TEXT, |_, _| (), |of| of.copy(2);
            "the base joint of another crank: this one has its values, with zero mirrored and axis mirrored and reversed, so that equal angles are mirror images"),
        key!("plane": word(CoordinatePlane::words), |_, _| (), |of| of.copy(3); "with `mirror`"),
    ],
    rules: r#"{"dependentRequired": {"turn": ["deg"], "deg": ["turn"], "mirror": ["plane"], "plane": ["mirror"]}}"#,
    ..KeyTable::EMPTY
};

impl CrankKeys {
    /// The values of `turn`, `deg`, `mirror` and `plane`.
    fn copy(&self, key: usize) -> Option<Json> {
        let values = match self.written.copy.as_ref()? {
            CrankCopy::Turned { crank, deg } => {
                [Some(json!(self.names[*crank])), Some(deg.json()), None, None]
            }
            CrankCopy::Mirrored { crank, plane } => {
                [None, None, Some(json!(self.names[*crank])), Some(plane.json())]
            }
        };
        values.into_iter().nth(key)?
    }
}

/// Keys of all cranks together.
static LIMITS: KeyTable<CrankLimits> = KeyTable {
    keys: &[
        key!("max_torque": positive(unit::TORQUE), max_torque;
            "greatest torque of a crank, force units times design units"),
        key!("max_speed_deg": positive(unit::DEGREES), max_speed_deg;
            "greatest speed of a crank, degrees per second"),
        key!("stiffness": positive(unit::TORQUE), stiffness;
            "stiffness of the drive of a crank about its axis, the rod rigid, force units times design units per radian"),
        key!("min_transmission_angle_deg" { old = "least_transmission_deg" }: angle(Range::Below(90)), min_transmission_angle_deg;
            "least transmission angle of a crank, degrees: its sine is the share of a force along the rod that drives the crank; 0 when absent"),
        key!("tip_angle_deg" { old = "tip_swing_deg" }: angle(Range::Below(90)), tip_angle_deg;
            "greatest angle between a rod and the plane of its crank, degrees"),
        key!("platform_cone_angle_deg" { old = "platform_swing_deg" }: angle(Range::Below(180)), platform_cone_angle_deg;
            "greatest angle between a rod and its direction at home, degrees"),
    ],
    ..KeyTable::EMPTY
};

static ONE_CRANK: CombinedTable =
    CombinedTable { definition: "crank", shapes: &[&CRANK, &COPY], named: None };
static ONE_CRANK_KIND: KeyKind = table_of(&ONE_CRANK);
/// `[cranks]`: the data of all cranks, and of single ones by the names of their base joints.
pub(super) static CRANKS: CombinedTable =
    CombinedTable { definition: "", shapes: &[&CRANK, &LIMITS], named: Some(&ONE_CRANK_KIND) };

/// The table as it is written.
pub(super) fn written(cranks: &WrittenCranks, names: &[String]) -> Json {
    let keys = |crank: &WrittenCrank| {
        let (written, names) = (crank.clone(), names.to_vec());
        CrankKeys { written, places: Places::default(), names }
    };
    let mut out = CRANK.write(&keys(&cranks.shared));
    out.extend(LIMITS.write(&cranks.drives));
    for (name, own) in names.iter().zip(&cranks.own) {
        let Some(own) = own else { continue };
        let own: Map<_, _> = CRANK.write(&keys(own)).into_iter().chain(COPY.write(&keys(own))).collect();
        out.insert(name.clone(), Json::Object(own));
    }
    Json::Object(out)
}

/// Keys about legs of variable length.
const OF_LENGTHS: [&str; 7] =
    ["lengths", "hardware", "envelope", "plates", "keep_out", "optimize", "calibration"];

/// The places of all cranks and of single ones in the text.
#[derive(Debug, Default)]
pub(super) struct CrankPlaces {
    key: Span,
    shared: Places,
    own: Vec<Option<Places>>,
    /// Something in [cranks] could not be read, so a missing key may be there.
    unread: bool,
}

impl CrankPlaces {
    /// The place of the data of all cranks, or of the one at a base joint.
    pub(super) fn of(&self, joint: Option<usize>) -> &Places {
        joint.and_then(|j| self.own.get(j)?.as_ref()).unwrap_or(&self.shared)
    }
}

/// `drive`, and `[cranks]` if the drive is `"rotary"`.
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
        let message = "the design has rods on cranks, but this question needs legs of variable length";
        let help = "`equipod assess` finds singular poses of designs with cranks; `ik`, `fk`, `limits`, `motion`, `compare`, `view`, `export` and `design convert` take cranks too; leg maps do not apply to crank angles";
        return report.refused(Code::Rotary, &e.node.span, message, help);
    }
    for e in OF_LENGTHS.iter().filter_map(|key| find(top, key)) {
        let message = format!("`{}` is about legs of variable length, and the drive is \"rotary\"", e.key);
        let help = "remove it; [cranks] has the lengths of cranks and rods and the limits of angles, torques and speeds";
        report.refuse(Code::ConflictingKeys, &e.key_span, message, help);
    }
    let Some(e) = table_entry else {
        let span = drive.map_or(0..0, |e| e.key_span.clone());
        let help = "add [cranks] with length, rod_length, axis, zero and elbow, and [cranks.NAME] for what is different at the base joint NAME";
        return report.refused(
            Code::MissingKey,
            &span,
            "`drive` is \"rotary\", and [cranks] is missing",
            help,
        );
    };
    let before = report.count();
    let entries = table(report, &e.node, "[cranks]")?;
    let base = base?;
    let names: Vec<&str> = base.joints.iter().map(|j| j.name.as_str()).collect();
    let joint = |key: &str| names.iter().position(|name| *name == key);
    let mut places =
        CrankPlaces { key: e.key_span.clone(), own: vec![None; names.len()], ..CrankPlaces::default() };
    let mut own = vec![None; names.len()];
    let all_keys = || CRANK.names().into_iter().chain(LIMITS.names());
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
    let mut drives = CrankLimits::default();
    LIMITS.fill(report, entries, "[cranks]", &mut drives, |_| true);
    places.unread = report.count() > before;
    Some((WrittenCranks { shared, own, drives, values: Vec::new() }, places))
}

/// A table of one crank.
fn single(report: &mut Findings<'_>, entry: &Entry, names: &[&str]) -> Option<(WrittenCrank, Places)> {
    let what = format!("the crank {}", shown(&entry.key));
    let entries = table(report, &entry.node, &what)?;
    let known: Vec<&str> = CRANK.names().into_iter().chain(COPY.names()).collect();
    check_keys(report, entries, &known, &what);
    let (mut written, mut places) = numbers(report, &entry.node, entries, &what);
    places.whole = entry.key_span.clone();
    written.copy = copy(report, entry, entries, &what, names, &mut places);
    Some((written, places))
}

/// Numbers and the side of one crank, or of all cranks.
fn numbers(report: &mut Findings<'_>, node: &Node, entries: &[Entry], what: &str) -> (WrittenCrank, Places) {
    let places = Places { whole: node.span.clone(), parts: vec![node.span.clone(); PARTS] };
    let mut keys = CrankKeys { places, ..CrankKeys::default() };
    CRANK.fill(report, entries, what, &mut keys, |_| true);
    (keys.written, keys.places)
}

fn label(found: &FoundKey<'_, '_>) -> String {
    format!("`{}` of {}", found.entry.key, found.place)
}

fn one(found: &mut FoundKey<'_, '_>, places: &mut Places, part: usize) -> Option<WrittenNumber> {
    places.parts[part] = found.entry.node.span.clone();
    let what = label(found);
    quantity(found.report, &found.entry.node, NumberKind::Length, &what)
}

fn three(found: &mut FoundKey<'_, '_>, places: &mut Places, first: usize) -> Option<[WrittenNumber; 3]> {
    let what = label(found);
    let nouns = ("component", "components");
    let (list, parts) = three_quantities(found.report, &found.entry.node, (NumberKind::Plain, &what), nouns)?;
    places.parts.splice(first..first + 3, parts);
    Some(list)
}

fn elbow(found: &mut FoundKey<'_, '_>) -> Option<Elbow> {
    let word = found.text()?;
    let elbow = Elbow::of(&word);
    if elbow.is_none() {
        let message = format!("{} is \"{}\"", label(found), shown(&word));
        let help = "write \"plus\" for the greater of the two angles that hold a pose, \"minus\" for the smaller one";
        found.refuse(Code::WrongType, message, help);
    }
    elbow
}

fn range(found: &mut FoundKey<'_, '_>, places: &mut Places) -> Option<[WrittenNumber; 2]> {
    let help = "write angle_deg = [least, greatest]";
    let (node, what) = (&found.entry.node, found.place);
    let Value::Array(list) = &node.value else {
        return found.report.not_a(node, &format!("`angle_deg` of {what}"), "a pair of angles", help);
    };
    let [least, most] = list.as_slice() else {
        let message = format!("`angle_deg` of {what} has {} angles instead of two", list.len());
        return found.refused(Code::CoordinateCount, message, help);
    };
    let [a, b] =
        [least, most].map(|e| quantity(found.report, e, NumberKind::Plain, &format!("an angle of {what}")));
    places.parts.splice(8..10, [least.span.clone(), most.span.clone()]);
    Some([a?, b?])
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
        return report.refused(
            Code::ConflictingKeys,
            &span(second),
            message,
            "keep one of `turn` and `mirror`",
        );
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
        return report.refused(
            Code::UnknownName,
            &from.node.span,
            message,
            nearest_help("known names", &name, names),
        );
    };
    if turn.is_some() {
        let e = find(entries, "deg")?;
        places.parts[PARTS - 1] = e.node.span.clone();
        let deg = quantity(report, &e.node, NumberKind::Plain, &format!("`deg` of {what}"))?;
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

/// Each leg needs its own crank with complete data.
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

/// Tips and joints must form a platform at the angles zero.
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
