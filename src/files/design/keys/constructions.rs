//! `[parameters]`, and joints that are not given by three numbers.

use std::collections::BTreeMap;

use serde_json::{Value as Json, json};

use super::cranks::CrankPlaces;
use super::found::{LARGEST, check_keys, nearest_help, number, shown, table};
use super::joints::NamedJoints;
use super::kind::{
    KeyKind, KeyShape, either, list_of, quantities, quantity as quantity_of, table as table_of, unit, word,
};
use super::stored::{self, Word};
use super::{Code, KeyTable, TEXT, key};
use crate::design::construction::expression::{Slip, UnitsBehind, function_names, is_name};
use crate::design::construction::resolve::{Joints, Owner};
use crate::design::construction::{
    Construction, Constructions, CoordinatePlane, LinePlace, MirrorPlane, WrittenCranks, WrittenHome,
    WrittenNumber,
};
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use platform::geom::FrameAxis;

/// A point on the line of two joints.
static ON_LINE: KeyTable<()> = KeyTable {
    keys: &[
        key!("on": list_of(2, &TEXT);
            ""),
        key!("t": quantity_of(unit::NONE); "share of the way from the first joint to the second"),
        key!("offset": quantity_of(unit::LENGTH); "length from the first joint towards the second"),
    ],
    rules: r#"{
        "required": ["on"],
        "oneOf": [{"required": ["t"]}, {"required": ["offset"]}],
        "description": "a point on the line of two joints of the same body"
    }"#,
    ..KeyTable::EMPTY
};

/// A point in polar coordinates.
static POLAR: KeyTable<()> = KeyTable {
    keys: &[
        key!("radius": quantity_of(unit::LENGTH); ""),
        key!("angle_deg": quantity_of(unit::DEGREES); "from the x axis towards the y axis"),
        key!("z": quantity_of(unit::LENGTH); "0 when absent"),
    ],
    rules: r#"{"required": ["radius", "angle_deg"]}"#,
    ..KeyTable::EMPTY
};

static LENGTH: KeyKind = quantity_of(unit::LENGTH);
static NUMBER: KeyKind = quantity_of(unit::NONE);

/// A rotated copy.
static TURNED: KeyTable<()> = KeyTable {
    keys: &[
        key!("turn": TEXT; ""),
        key!("deg": quantity_of(unit::DEGREES); "about an axis of the frame of the body"),
        key!("about": word(FrameAxis::words); "the direction of the axis; default z"),
        key!("through": list_of(3, &LENGTH); "a point of the axis; default the origin"),
    ],
    rules: r#"{"required": ["turn", "deg"], "description": "a joint of the same body, turned"}"#,
    ..KeyTable::EMPTY
};

/// A mirrored copy.
static MIRRORED: KeyTable<()> = KeyTable {
    keys: &[
        key!("mirror": TEXT; ""),
        key!("plane": word(CoordinatePlane::words); "parallel to a plane of two axes"),
        key!("normal": list_of(3, &NUMBER); "perpendicular to this vector of any length"),
        key!("through": list_of(3, &LENGTH); "a point of the plane; default the origin"),
    ],
    rules: r#"{
        "required": ["mirror"],
        "oneOf": [{"required": ["plane"]}, {"required": ["normal"]}],
        "description": "a joint of the same body, mirrored in a plane"
    }"#,
    ..KeyTable::EMPTY
};

/// Tables of joints; the first key of each determines the others.
static FORMS: [&KeyTable<()>; 4] = [&ON_LINE, &POLAR, &TURNED, &MIRRORED];

static JOINT: KeyKind = either(&[
    quantities(3, unit::LENGTH),
    table_of(&ON_LINE),
    table_of(&POLAR),
    table_of(&TURNED),
    table_of(&MIRRORED),
]);

/// The joints of a body by name.
pub(super) static BODY: KeyTable<()> =
    KeyTable { definition: "body", named: Some(&JOINT), rules: r#"{"minProperties": 1}"#, ..KeyTable::EMPTY };

static PARAMETER: KeyKind = quantity_of(unit::NONE);

/// `[parameters]` by name.
pub(super) static PARAMETERS: KeyTable<()> = KeyTable {
    named: Some(&PARAMETER),
    rules: r#"{"propertyNames": {"pattern": "^[A-Za-z_][A-Za-z0-9_]*$"}}"#,
    ..KeyTable::EMPTY
};

/// A joint as it is written.
pub(super) fn written(made: &Construction, names: &[String]) -> Json {
    let name = |j: &usize| &names[*j];
    match made {
        Construction::Coordinates(list) => stored::quantities(list),
        Construction::OnLine { through, at: LinePlace::Share(t) } => {
            json!({"on": through.each_ref().map(name), "t": t.json()})
        }
        Construction::OnLine { through, at: LinePlace::Offset(offset) } => {
            json!({"on": through.each_ref().map(name), "offset": offset.json()})
        }
        Construction::Polar { radius, angle_deg, z } => {
            let mut out = json!({"radius": radius.json(), "angle_deg": angle_deg.json()});
            if let Some(z) = z {
                out["z"] = z.json();
            }
            out
        }
        Construction::Turned { joint, deg, about, through } => {
            let mut out = json!({"turn": name(joint), "deg": deg.json()});
            if *about != FrameAxis::Z {
                out["about"] = json!(about.name());
            }
            with_point(out, through.as_ref())
        }
        Construction::Mirrored { joint, plane, through } => {
            let mut out = json!({"mirror": name(joint)});
            match plane {
                MirrorPlane::Coordinate(plane) => out["plane"] = json!(plane.name()),
                MirrorPlane::Normal(normal) => out["normal"] = stored::quantities(normal),
            }
            with_point(out, through.as_ref())
        }
    }
}

fn with_point(mut written: Json, through: Option<&[WrittenNumber; 3]>) -> Json {
    if let Some(point) = through {
        written["through"] = stored::quantities(point);
    }
    written
}

/// Places of a value in the text, for reports of faults.
#[derive(Debug, Clone, Default)]
pub(super) struct Places {
    pub(super) whole: Span,
    /// Numbers and names in it, by the parts of a construction.
    pub(super) parts: Vec<Span>,
}

/// `[parameters]` with their places; those without a value could not be read.
pub(super) type Parameters = Vec<(String, Option<WrittenNumber>, Places)>;

pub(super) fn parameters(report: &mut Findings<'_>, top: &[Entry]) -> Parameters {
    let Some(entries) = find(top, "parameters").and_then(|e| table(report, &e.node, "[parameters]")) else {
        return Vec::new();
    };
    let mut list = Vec::new();
    for e in entries {
        if !is_name(&e.key) {
            let message = format!("the parameter `{}` has a name that expressions cannot use", shown(&e.key));
            let help = format!(
                "take letters, digits and underscores, a letter first, and not {}",
                function_names().join(", ")
            );
            report.refuse(Code::Expression, &e.key_span, message, help);
        }
        let what = format!("the parameter `{}`", shown(&e.key));
        let value = quantity(report, &e.node, NumberKind::Plain, &what);
        let places = Places { whole: e.key_span.clone(), parts: vec![e.node.span.clone()] };
        list.push((e.key.clone(), value, places));
    }
    list
}

/// The kind of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberKind {
    /// A length, which may have a unit of its own.
    Length,
    /// Any other number.
    Plain,
}

/// A number: a decimal as written, or an expression in quotes.
pub(super) fn quantity(
    report: &mut Findings<'_>,
    node: &Node,
    kind: NumberKind,
    what: &str,
) -> Option<WrittenNumber> {
    let read = match &node.value {
        Value::Text(text) if kind == NumberKind::Length => {
            WrittenNumber::with_units(text, UnitsBehind::Length(report.length_unit)).map(|read| read.0)
        }
        Value::Text(text) => WrittenNumber::text(text),
        Value::Number(_) => {
            let x = number(report, node, what)?;
            let digits = report.source(&node.span).replace('_', "");
            WrittenNumber::decimal(digits.trim_start_matches('+'), x)
        }
        _ => {
            let help = "write a number, or an expression in quotes such as \"6*sqrt(3)\"";
            return report.not_a(node, what, "a number", help);
        }
    };
    match read {
        Ok(quantity) => Some(quantity),
        Err(Slip { place, message, too_complex }) => {
            let code = if too_complex { Code::TooComplex } else { Code::Expression };
            let help = "write numbers, names of [parameters], + - * / ^, parentheses, sqrt(), sin_deg(), cos_deg(); a unit of length may stand behind a length";
            let span = inner(report, &node.span, Some(&place));
            report.refused(code, &span, format!("{what}: {message}"), help)
        }
    }
}

/// The place in the text of a file of a place in an expression.
fn inner(report: &Findings<'_>, span: &Span, place: Option<&Span>) -> Span {
    let source = report.source(span);
    // escapes and triple quotes hide the positions of characters
    let quoted = source.starts_with(['"', '\'']);
    let plain = !source.contains('\\') && !source.starts_with("\"\"\"") && !source.starts_with("'''");
    match place {
        Some(place) if plain => {
            let from = span.start + usize::from(quoted);
            from + place.start..from + place.end
        }
        _ => span.clone(),
    }
}

/// Whether a joint has a construction: a table, or an array with texts.
pub(super) fn is_constructed(node: &Node) -> bool {
    match &node.value {
        Value::Table(_) => true,
        Value::Array(list) => list.iter().any(|e| matches!(e.value, Value::Text(_))),
        _ => false,
    }
}

/// A joint that [is constructed](is_constructed), with its places.
pub(super) fn joint(
    report: &mut Findings<'_>,
    node: &Node,
    what: &str,
    names: &BTreeMap<String, usize>,
) -> Option<(Construction, Places)> {
    let (made, parts) = match &node.value {
        Value::Array(_) => {
            let (list, parts) = three_quantities(report, node, (NumberKind::Length, what), COORDINATES)?;
            (Construction::Coordinates(list), parts)
        }
        Value::Table(entries) => form(report, node, entries, what, names)?,
        _ => return None,
    };
    Some((made, Places { whole: node.span.clone(), parts }))
}

/// One coordinate and all three.
pub(super) const COORDINATES: (&str, &str) = ("coordinate", "coordinates x, y, z");

/// An array of three numbers or expressions, with their places. `number` is one of them, `noun` all three.
pub(super) fn three_quantities(
    report: &mut Findings<'_>,
    node: &Node,
    (kind, what): (NumberKind, &str),
    (number, noun): (&str, &str),
) -> Option<([WrittenNumber; 3], Vec<Span>)> {
    let Value::Array(list) = &node.value else {
        return report.not_a(node, what, "an array", format!("write an array of 3 {noun}"));
    };
    let [x, y, z] = list.as_slice() else {
        let message = format!("{what} has {} {number}s instead of 3", list.len());
        return report.refused(Code::CoordinateCount, &node.span, message, format!("give 3 {noun}"));
    };
    let mut place = 0;
    // evaluate all of them, so that each fault is reported
    let [a, b, c] = [x, y, z].map(|e| {
        place += 1;
        quantity(report, e, kind, &format!("{number} {place} of {what}"))
    });
    Some(([a?, b?, c?], [x, y, z].map(|e| e.span.clone()).to_vec()))
}

fn form(
    report: &mut Findings<'_>,
    node: &Node,
    entries: &[Entry],
    what: &str,
    names: &BTreeMap<String, usize>,
) -> Option<(Construction, Vec<Span>)> {
    let Some(form) = FORMS.into_iter().find(|form| find(entries, form.keys[0].name).is_some()) else {
        let first = entries.iter().find(|e| FORMS.iter().all(|form| form.kind(&e.key).is_none()));
        let kinds = FORMS.map(|form| form.keys[0].name);
        let (span, help) = match first {
            Some(e) if !report.is_full() => (&e.key_span, nearest_help("known keys", &e.key, &kinds)),
            _ => (&node.span, format!("begin with one of {}", kinds.join(", "))),
        };
        return report.refused(
            Code::MissingKey,
            span,
            format!("{what} has none of {}", kinds.join(", ")),
            help,
        );
    };
    let keys = form.names();
    check_keys(report, entries, &keys, what);
    let span = |key: &str| find(entries, key).map_or_else(|| node.span.clone(), |e| e.node.span.clone());
    let mut number_of = |key: &str, optional: bool| match find(entries, key) {
        Some(e) => {
            let is_length = form.kind(key).is_some_and(|kind| kind.unit == unit::LENGTH);
            let kind = if is_length { NumberKind::Length } else { NumberKind::Plain };
            quantity(report, &e.node, kind, &format!("`{key}` of {what}")).map(Some)
        }
        None if optional => Some(None),
        None => {
            let help = format!("a joint with `{}` takes {}", keys[0], keys.join(", "));
            report.refused(Code::MissingKey, &node.span, format!("`{key}` of {what} is missing"), help)
        }
    };
    Some(match keys[0] {
        "radius" => {
            let (radius, angle_deg, z) =
                (number_of("radius", false), number_of("angle_deg", false), number_of("z", true));
            let made = Construction::Polar { radius: radius??, angle_deg: angle_deg??, z: z? };
            (made, keys.iter().map(|k| span(k)).collect())
        }
        "turn" => {
            let deg = number_of("deg", false);
            let joint = reference(report, &find(entries, "turn")?.node, what, names);
            let about = match find(entries, "about") {
                Some(entry) => {
                    known_word(report, entry, what, "no axis", "write about = \"x\", \"y\" or \"z\"")
                }
                None => Some(FrameAxis::Z),
            };
            let through = vector(report, entries, "through", what);
            let mut places = vec![span("turn"), span("deg")];
            let through = through.ok()?.map(|(point, spans)| {
                places.extend(spans);
                point
            });
            (Construction::Turned { joint: joint?, deg: deg??, about: about?, through }, places)
        }
        "mirror" => {
            let joint = reference(report, &find(entries, "mirror")?.node, what, names);
            let normal = vector(report, entries, "normal", what);
            let through = vector(report, entries, "through", what);
            let mut places = vec![span("mirror")];
            let plane = match (normal.ok()?, find(entries, "plane")) {
                (Some(_), Some(_)) => {
                    let message = format!("{what} has both `plane` and `normal`");
                    let help = "give one of them";
                    return report.refused(Code::ConflictingKeys, &node.span, message, help);
                }
                (Some((normal, spans)), None) => {
                    places.extend(spans);
                    MirrorPlane::Normal(normal)
                }
                (None, _) => MirrorPlane::Coordinate(plane(report, node, entries, what)?),
            };
            let through = through.ok()?.map(|(point, spans)| {
                places.extend(spans);
                point
            });
            (Construction::Mirrored { joint: joint?, plane, through }, places)
        }
        _ => {
            let (t, offset) = (number_of("t", true), number_of("offset", true));
            let through = line(report, &find(entries, "on")?.node, what, names);
            let (at, place) = match (t?, offset?) {
                (Some(t), None) => (LinePlace::Share(t), span("t")),
                (None, Some(offset)) => (LinePlace::Offset(offset), span("offset")),
                (both, _) => {
                    let (code, says) = if both.is_some() {
                        (Code::ConflictingKeys, "both `t` and `offset`")
                    } else {
                        (Code::MissingKey, "neither `t` nor `offset`")
                    };
                    let help = "give one: t = \"1/5\" of the way from the first joint to the second, or offset = 2.4 in units of length";
                    return report.refused(code, &node.span, format!("{what} has {says}"), help);
                }
            };
            (Construction::OnLine { through: through?, at }, vec![span("on"), span("on"), place])
        }
    })
}

fn plane(report: &mut Findings<'_>, node: &Node, entries: &[Entry], what: &str) -> Option<CoordinatePlane> {
    let help = "write plane = \"xy\", \"xz\" or \"yz\", or the normal of the plane: normal = [1, 2, 0]";
    let Some(entry) = find(entries, "plane") else {
        return report.refused(Code::MissingKey, &node.span, format!("`plane` of {what} is missing"), help);
    };
    known_word(report, entry, what, "no plane of two axes", help)
}

/// A word of a key.
fn known_word<W: Word>(
    report: &mut Findings<'_>,
    entry: &Entry,
    what: &str,
    fault: &str,
    help: &str,
) -> Option<W> {
    let word = if let Value::Text(text) = &entry.node.value { W::of(text) } else { None };
    if word.is_none() {
        let message = format!("`{}` of {what} is {fault}", entry.key);
        report.refuse(Code::WrongType, &entry.node.span, message, help);
    }
    word
}

/// Three numbers with their places.
type PlacedVector = ([WrittenNumber; 3], Vec<Span>);

/// The vector of a key, if the key is present; an error is in the report.
fn vector(
    report: &mut Findings<'_>,
    entries: &[Entry],
    key: &str,
    what: &str,
) -> Result<Option<PlacedVector>, ()> {
    let Some(entry) = find(entries, key) else { return Ok(None) };
    let kind = if key == "through" { NumberKind::Length } else { NumberKind::Plain };
    let found = three_quantities(report, &entry.node, (kind, &format!("`{key}` of {what}")), COORDINATES);
    found.map(Some).ok_or(())
}

fn line(
    report: &mut Findings<'_>,
    node: &Node,
    what: &str,
    names: &BTreeMap<String, usize>,
) -> Option<[usize; 2]> {
    let Value::Array(list) = &node.value else {
        return report.not_a(
            node,
            &format!("`on` of {what}"),
            "a pair of joints",
            "write on = [\"P1\", \"P2\"]",
        );
    };
    let [a, b] = list.as_slice() else {
        let message = format!("`on` of {what} names {} joints instead of two", list.len());
        return report.refused(Code::CoordinateCount, &node.span, message, "write on = [\"P1\", \"P2\"]");
    };
    let ends = [a, b].map(|e| reference(report, e, what, names));
    Some([ends[0]?, ends[1]?])
}

/// A joint of the same body.
fn reference(
    report: &mut Findings<'_>,
    node: &Node,
    what: &str,
    names: &BTreeMap<String, usize>,
) -> Option<usize> {
    let Value::Text(name) = &node.value else {
        let message = format!("{what} starts from {}, not from a joint", node.value.kind());
        return report.refused(
            Code::WrongType,
            &node.span,
            message,
            "write the name of a joint of the same body in quotes",
        );
    };
    let found = names.get(name).copied();
    if found.is_none() {
        let known: Vec<&str> =
            if report.is_full() { Vec::new() } else { names.keys().take(200).map(String::as_str).collect() };
        let message = format!("{what} starts from `{}`, which is not a joint of the same body", shown(name));
        report.refuse(Code::UnknownName, &node.span, message, nearest_help("known names", name, &known));
    }
    found
}

/// Numbers outside the joints that depend on parameters, with their places.
pub(super) struct BesideJoints<'a> {
    pub(super) home: Option<(WrittenHome, Places)>,
    pub(super) cranks: (Option<WrittenCranks>, &'a CrankPlaces),
}

/// Gives every joint its coordinates; returns the constructions if all of them resolve.
pub(super) fn resolve(
    report: &mut Findings<'_>,
    parameters: Parameters,
    (base, platform): (&mut NamedJoints, &mut NamedJoints),
    BesideJoints { home, cranks: (cranks, crank_places) }: BesideJoints<'_>,
) -> Option<Constructions> {
    let mut constructions = Constructions::default();
    let (home, home_places) = home.unzip();
    let home_places = home_places.unwrap_or_default();
    (constructions.home, constructions.cranks) = (home, cranks);
    let (mut places, mut unread) = (Vec::new(), Vec::new());
    for (name, value, place) in parameters {
        match value {
            Some(value) => {
                constructions.parameters.push((name, value));
                places.push(place);
            }
            None => unread.push(name),
        }
    }
    constructions.joints = [&*base, &*platform].map(NamedJoints::constructions);
    if constructions.is_empty() {
        return Some(constructions);
    }
    let names = [base.names(), platform.names()];
    let points = [base.points(), platform.points()];
    let given = Joints {
        names: names.each_ref().map(Vec::as_slice),
        points: points.each_ref().map(Vec::as_slice),
        unread: &unread,
    };
    match constructions.resolve(given) {
        Ok([on_base, on_platform]) => {
            let mut sound = true;
            for (body, points) in [(base, on_base), (platform, on_platform)] {
                for (joint, point) in body.joints.iter_mut().zip(points) {
                    joint.point = point.into();
                    if joint.constructed && joint.point.iter().any(|x| x.is_nan()) {
                        // the fault was reported at its own place
                        (joint.intact, sound) = (false, false);
                    } else if joint.constructed && joint.point.iter().any(|x| x.abs() > LARGEST) {
                        let message = format!("{} is too far out to compute with", shown(&joint.name));
                        let help = format!("stay below {LARGEST:e}; use a larger unit");
                        report.refuse(Code::OutOfRange, &joint.places.whole, message, help);
                        (joint.intact, sound) = (false, false);
                    }
                }
            }
            let out = |home: &WrittenHome| home.pose.position.iter().any(|x| !(x.abs() <= LARGEST));
            if constructions.home.as_ref().is_some_and(out) {
                let help = format!("stay below {LARGEST:e}; use a larger unit");
                let message = "[home] is too far out to compute with";
                report.refuse(Code::OutOfRange, &home_places.whole, message, help);
                sound = false;
            }
            sound.then_some(constructions)
        }
        Err(faults) => {
            for fault in faults {
                let place = match fault.owner {
                    Owner::Parameter(i) => &places[i],
                    Owner::Joint(body, j) => &body.of((&*base, &*platform)).joints[j].places,
                    Owner::Home => &home_places,
                    Owner::Crank(joint) => crank_places.of(joint),
                };
                let part = match fault.owner {
                    Owner::Parameter(_) => fault.within.as_ref().map(|_| 0),
                    Owner::Joint(..) | Owner::Home | Owner::Crank(_) => fault.part,
                };
                let span = part.and_then(|k| place.parts.get(k)).unwrap_or(&place.whole);
                let span = inner(report, span, fault.within.as_ref());
                report.refuse(fault.code, &span, shown_all(&fault.message), fault.help);
            }
            for body in [base, platform] {
                body.joints.iter_mut().filter(|j| j.constructed).for_each(|j| j.intact = false);
            }
            None
        }
    }
}

/// Names in a message may hold anything.
fn shown_all(message: &str) -> String {
    message.chars().take(400).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
