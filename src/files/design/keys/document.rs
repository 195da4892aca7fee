//! The keys above the first table, and the whole document: one walk over its tables that collects every violation,
//! and the text that is written.

use nalgebra::Point3;
use serde_json::{Map, Value as Json, json};

use super::calibration::{CALIBRATION, CalibrationKeys, calibration, correlations_toml};
use super::constructions::{self, BODY, PARAMETERS};
use super::cranks::{self, CRANKS};
use super::envelope::{ENVELOPES, envelopes};
use super::found::{check_keys, element_span, elements, numbers};
use super::frames::FRAMES;
use super::hardware::{HARDWARE, HardwareKeys, hardware};
use super::holes::{HOLES, HOLES_SHAPE, holes};
use super::joints::{self, Legs, NamedJoints};
use super::kind::{list, list_of, not_negative, own, table, unit, word};
use super::limits::{LIMITS, safety_margins};
use super::loads::{KEEP_OUT, LOAD, SPEED, STIFFNESS, keep_outs, loads, speed, stiffness};
use super::optimize::{OPTIMIZE, OptimizeKeys, optimize};
use super::payload::{PAYLOAD, payload};
use super::plates::{self, PLATES};
use super::poses::{HOME, home};
use super::stored::Word;
use super::workspace::{WORKSPACE, workspace};
use super::{Code, FoundKey, KeyTable, TEXT, axes, joint_models, key};
use crate::design::scale::micrometres;
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use crate::design::{Accepts, DesignModel, Warning};
use machine::requirements::{ForceUnit, MassUnit};
use platform::manipulator::{Body, InvalidManipulator, LegLengths, Manipulator};

/// Smallest size of a design: its square and fourth power still fit a double.
const SMALLEST: f64 = 1e-60;

/// The keys of a design. Tables are read and written in a separate order, since some depend on others.
pub(super) static TOP: KeyTable<DesignModel> = KeyTable {
    keys: &[
        key!("name" { required = "add `name = \"...\"` at the top" }: TEXT, name; "name of the design, not blank"),
        key!("units" { required = "add `units = \"mm\"` (a label; all lengths are in it) at the top" }: TEXT, units;
            "label of the length unit of every length in the file"),
        key!("force_units": word(ForceUnit::words), force_units;
            "unit of all forces, default newtons; torques are in force units times the length unit"),
        key!("mass_units": word(MassUnit::words), mass_units; "unit of all masses, default kilograms"),
        key!("source": TEXT, source; "where the numbers come from"),
        key!("description": TEXT, description; "free text"),
        key!("revision": TEXT, revision; "revision of the design, as drawings and parts name it"),
        key!("drive" { default = r#""prismatic""# }: own(r#"{"enum": ["prismatic", "rotary"]}"#, unit::NONE),
            |_, _| (), |of| of.has_cranks().then(|| json!("rotary"));
            "`prismatic`: legs change their lengths; `rotary`: the legs are rods of constant length on cranks, the base joints are the centres of the cranks, and `[cranks]` is required"),
        key!("lengths": list_of(6, &not_negative(unit::LENGTH)),
            |found, to| to.lengths = lengths(found), |of| Some(json!(of.lengths?.get()));
            "leg lengths in leg order, which `equipod fk` takes without `--lengths`"),
        key!("legs" { required = "add `legs = [[\"A1\", \"B1\"], ...]` with six pairs base-platform above the first [table]" }: list_of(6, &list_of(2, &TEXT)),
            |_, _| (), |of| Some(json!(of.leg_names().map(|(a, b)| [a, b])));
            "`[base joint, platform joint]` in leg order; in TOML above the first table"),
        key!("parameters": table(&PARAMETERS), |_, _| (), parameters;
            "numbers and expressions that expressions of joints and of other parameters name"),
        key!("base" { required = "add [base] with joints such as `A1 = [0.0, 0.0, 0.0]`" }: table(&BODY), |_, _| (), |of| Some(joints_of(of, Body::Base));
            "joints in the base frame, each as `[x, y, z]` or as a construction"),
        key!("platform" { required = "add [platform] with joints such as `B1 = [0.0, 0.0, 0.0]`" }: table(&BODY), |_, _| (), |of| Some(joints_of(of, Body::Platform));
            "joints in the platform frame, each as `[x, y, z]` or as a construction"),
        key!("cranks": table(&CRANKS), |_, _| (), |of| Some(cranks::written(of.constructions.cranks.as_ref()?, of.base_names()));
            "cranks and rods of a rotary design: keys for all, and tables named by base joints for single cranks"),
        key!("home": table(&HOME), |_, _| (), |of| of.home.and_then(|_| HOME.put(of));
            "the pose the platform is built for"),
        key!("frames": table(&FRAMES),
            |found, to| {
                FRAMES.read(found.report, &found.entry.node, "[frames]", &mut to.frames);
            },
            |of| FRAMES.put(&of.frames);
            "convention of the poses that commands read and write"),
        key!("workspace": table(&WORKSPACE), |_, _| (), |of| Some(&of.workspace).filter(|w| w.states_anything()).and_then(|w| WORKSPACE.put(w));
            "the poses to reach"),
        key!("optimize": table(&OPTIMIZE), |_, _| (), |of| OPTIMIZE.put(&OptimizeKeys::of(of));
            "variables and objectives of the optimiser"),
        key!("hardware": table(&HARDWARE), |_, _| (), |of| HARDWARE.put(&HardwareKeys::of(&of.hardware, of.drive_table.as_ref()));
            "sizes and limits of joints, legs and drives"),
        key!("speed": table(&SPEED), |_, _| (), |of| SPEED.put(of.speed.as_ref()?);
            "speed that the platform has to reach in every direction"),
        key!("stiffness": table(&STIFFNESS), |_, _| (), |of| Some(json!(STIFFNESS.write(of.stiffness.as_ref()?)));
            "stiffness that the platform needs on its legs at every pose; needs `leg_stiffness` of `[hardware]`"),
        key!("loads": list(&table(&LOAD)), |_, _| (), |of| all(&of.loads, |load| LOAD.write(load));
            "wrenches the legs have to hold, one at a time"),
        key!("keep_out": list(&table(&KEEP_OUT)), |_, _| (), |of| all(&of.keep_outs, |keep_out| KEEP_OUT.write(&keep_out.into()));
            "bodies the legs must not touch, each a box, a sphere or a capsule"),
        key!("payload": table(&PAYLOAD), |_, _| (), |of| PAYLOAD.put(of.payload.as_ref()?);
            "mass, inertia and size of the payload"),
        key!("envelope": table(&ENVELOPES), |_, _| (), |of| ENVELOPES.put(&of.envelopes);
            "space that plates and machine may occupy"),
        key!("holes": table(&HOLES_SHAPE), |_, _| (), |of| HOLES.put(of.holes.as_ref()?);
            "grids of holes for the joints, in both plates or in one"),
        key!("plates": table(&PLATES), |_, _| (), |of| PLATES.put(&of.plates);
            "the plates that carry the joints: sizes, material, holes and bolts"),
        key!("limits": table(&LIMITS), |_, _| (), |of| LIMITS.put(&of.safety_margins);
            "safety margins to each limit"),
        key!("calibration": table(&CALIBRATION), |_, _| (), |of| CALIBRATION.put(&CalibrationKeys::of(of, of.calibration.as_ref()?));
            "results of `equipod calibrate` beside the joints"),
    ],
    ..KeyTable::EMPTY
};
/// The tables after [hardware], in the order of writing.
const WRITTEN_LAST: [&str; 10] = [
    "limits",
    "envelope",
    "holes",
    "plates",
    "speed",
    "stiffness",
    "payload",
    "loads",
    "keep_out",
    "calibration",
];

/// Two triangles as a placeholder until the joints are read.
fn placeholder() -> Option<Manipulator> {
    let corners = || [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Point3::from).to_vec();
    Manipulator::try_new(corners(), corners(), [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).ok()
}

/// The design, or `None` with the reasons in the report. Later checks use everything that earlier ones accepted, so one
/// run shows all violations. Rods on cranks and joint offsets are refused unless the question `accepts` them.
pub(crate) fn design(root: &Node, report: &mut Findings<'_>, accepts: Accepts) -> Option<DesignModel> {
    let Value::Table(entries) = &root.value else {
        let help = "write { \"name\": ..., \"units\": ..., \"base\": { ... }, \"platform\": { ... }, \"legs\": [ ... ] }";
        return report.refused(
            Code::WrongType,
            &root.span,
            format!("a design is a table, not {}", root.value.kind()),
            help,
        );
    };
    check_keys(report, entries, &TOP.names(), "a design");
    let mut design = DesignModel::new("", "", placeholder()?);
    TOP.fill(report, entries, "a design", &mut design, |_| true);
    for key in ["name", "units"] {
        required(report, root, entries, key);
    }
    let units = Some(design.units.clone()).filter(|units| !units.is_empty());
    report.length_unit = micrometres(&design.units);
    let legs_entry = legs_entry(report, root, entries);
    let parameters = constructions::parameters(report, entries);
    let mut base = required(report, root, entries, "base").and_then(|e| joints::body(report, Body::Base, e));
    let mut platform =
        required(report, root, entries, "platform").and_then(|e| joints::body(report, Body::Platform, e));
    let read_home = find(entries, "home").and_then(|e| home(report, &e.node));
    let (home, written_home) = read_home.unzip();
    design.home = home;
    let takes_cranks = accepts != Accepts::Legs;
    let (cranks, crank_places) = cranks::cranks(report, entries, base.as_ref(), takes_cranks).unzip();
    // no rod has joint offsets
    let takes_offsets = accepts == Accepts::CranksAndOffsets || cranks.is_some();
    let crank_places = crank_places.unwrap_or_default();
    let constructions = match (&mut base, &mut platform) {
        (Some(base), Some(platform)) => {
            let written =
                constructions::BesideJoints { home: written_home.flatten(), cranks: (cranks, &crank_places) };
            constructions::resolve(report, parameters, (base, platform), written)
        }
        _ => None,
    };
    for body in [&mut base, &mut platform].into_iter().flatten() {
        body.find_coincident(constructions.as_ref());
        joints::warn_coincident(report, body);
    }
    let legs = match (legs_entry, &base, &platform) {
        (Some(entry), Some(base), Some(platform)) => joints::legs(report, entry, base, platform),
        _ => None,
    };
    if let (Some(constructions), Some(base), Some(legs)) = (&constructions, &base, &legs) {
        cranks::check_legs(report, constructions, &crank_places, (base, legs));
    }
    let bodies = [base.as_ref(), platform.as_ref()];
    design.workspace = workspace(report, entries);
    design.workspace.frames_pivot = design.frames.pivot_on_platform();
    (design.optimize, design.search) = optimize(report, entries, bodies);
    (design.hardware, design.drive_table) = hardware(report, entries);
    joint_models::refuse_coupled(report, entries, &design.hardware, takes_offsets);
    design.speed = speed(report, entries);
    design.stiffness = stiffness(report, entries, &design.hardware, units.as_deref());
    (design.loads, design.keep_outs) = (loads(report, entries), keep_outs(report, entries));
    design.payload = payload(report, entries);
    (design.envelopes, design.safety_margins) = (envelopes(report, entries), safety_margins(report, entries));
    design.holes = holes(report, entries);
    design.plates = plates::plates(report, entries, &design.hardware, units.as_deref());
    design.calibration = calibration(report, entries, bodies);
    if !report.is_clean() {
        return None;
    }
    let (base, platform) = (base?, platform?);
    design.manipulator = manipulator(report, &root.span, &base, &platform, &legs?)?;
    design = design.with_joint_names(base.names(), platform.names()).ok()?;
    design.set_constructions(constructions?);
    cranks::check_platform(report, &design, &crank_places);
    axes::turn_to_normals(report, entries, &mut design);
    plates::check_masses(report, entries, &design);
    Some(design)
}

pub(super) fn required<'a>(
    report: &mut Findings<'_>,
    root: &Node,
    entries: &'a [Entry],
    key: &str,
) -> Option<&'a Entry> {
    let found = find(entries, key);
    if found.is_none() {
        let help = TOP.keys.iter().find(|k| k.name == key).map_or("", |k| k.required);
        let start = root.span.start..root.span.start;
        report.refuse(Code::MissingKey, &start, format!("`{key}` is missing"), help);
    }
    found
}

/// `legs` belongs at the top level. TOML assigns `legs` below a table header to that table. It cannot be a joint there,
/// since it holds pairs of names, so it is accepted with a warning.
pub(super) fn legs_entry<'a>(
    report: &mut Findings<'_>,
    root: &Node,
    entries: &'a [Entry],
) -> Option<&'a Entry> {
    if find(entries, "legs").is_none() {
        for table in ["base", "platform"] {
            let inner = find(entries, table).and_then(|e| match &e.node.value {
                Value::Table(inner) => find(inner, "legs"),
                _ => None,
            });
            if let Some(legs) = inner.filter(|e| joints::is_list_of_pairs(&e.node)) {
                let line = report.line(legs.key_span.start);
                report.warn(Warning::LegsInsideTable { table, line });
                return Some(legs);
            }
        }
    }
    required(report, root, entries, "legs")
}

fn lengths(found: &mut FoundKey<'_, '_>) -> Option<LegLengths> {
    LegLengths::try_new(numbers_of_legs::<6>(found)?).ok()
}

/// A length for each leg, with a violation for each negative one.
pub(super) fn numbers_of_legs<const N: usize>(found: &mut FoundKey<'_, '_>) -> Option<[f64; N]> {
    let (report, node) = (&mut *found.report, &found.entry.node);
    let l = numbers::<N>(report, node, "`lengths`", Code::LengthCount, "leg lengths, one for each leg");
    for (i, x) in elements(node).enumerate().filter(|(_, x)| *x < 0.0 && x.is_finite()) {
        let message = format!("the length of leg {} is {x}", i + 1);
        let help = "leg lengths are not negative";
        report.refuse(Code::NegativeLength, &element_span(node, i), message, help);
    }
    l
}

fn manipulator(
    report: &mut Findings<'_>,
    root: &Span,
    base: &NamedJoints,
    platform: &NamedJoints,
    legs: &Legs,
) -> Option<Manipulator> {
    let points = |body: &NamedJoints| body.joints.iter().map(|j| Point3::from(j.point)).collect();
    match Manipulator::try_new(points(base), points(platform), legs.pairs) {
        Ok(m) if m.size() < SMALLEST => {
            let message = format!("the design is {:e} long", m.size());
            report.refused(
                Code::OutOfRange,
                root,
                message,
                "use a smaller unit: squares of such lengths underflow",
            )
        }
        Ok(m) => Some(m),
        Err(InvalidManipulator::NoSize) => {
            let message = "all joints in use of the base coincide, and so do those of the platform";
            report.refused(Code::NoSize, root, message, "give the joints different coordinates")
        }
        Err(InvalidManipulator::TooSmall) => {
            let advice = "use a smaller unit";
            report.refused(Code::OutOfRange, root, InvalidManipulator::TooSmall.to_string(), advice)
        }
        // names, coordinates and pairs were checked before, so no other fault is possible
        Err(other) => report.refused(Code::MissingJoint, root, other.to_string(), "check joints and legs"),
    }
}

/// A value in TOML on one line.
pub(super) fn toml_value(value: &Json) -> String {
    let joined = |list: Vec<String>| list.join(", ");
    match value {
        // JSON strings are basic strings of TOML, except for one character
        Json::String(text) => json!(text).to_string().replace('\u{7f}', "\\u007f"),
        Json::Number(x) => x
            .as_f64()
            .filter(|_| x.is_f64())
            .map_or_else(|| x.to_string(), |x| toml::Value::Float(x).to_string()),
        Json::Array(list) => format!("[{}]", joined(list.iter().map(toml_value).collect())),
        Json::Object(keys) => {
            let keys = keys.iter().map(|(key, value)| format!("{key} = {}", toml_value(value)));
            format!("{{ {} }}", joined(keys.collect()))
        }
        Json::Null | Json::Bool(_) => String::new(),
    }
}

/// `key = value`, with the key in quotes if necessary.
fn toml_line(key: &str, value: &Json) -> String {
    let pair = toml::to_string(&std::collections::BTreeMap::from([(key, 0)])).unwrap_or_default();
    format!("{}= {}\n", pair.trim_end().trim_end_matches('0').trim_end_matches("= "), toml_value(value))
}

impl DesignModel {
    /// The design as TOML. Reading it back gives an equal design, bit for bit.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut keys = self.document();
        let calibration = keys.get_mut("calibration").and_then(Json::as_object_mut);
        let correlations = calibration.and_then(|table| table.shift_remove("correlations"));
        // strings, arrays and maps with string keys, which TOML always accepts
        let text = |keys: &Map<String, Json>| toml::to_string(keys).unwrap_or_default();
        let mut parts = Vec::new();
        let (mut plain, mut tables) = (Map::new(), Map::new());
        for (key, value) in keys {
            match (key.as_str(), &value) {
                ("parameters" | "base" | "platform", Json::Object(lines)) => {
                    let lines = lines.iter().map(|(name, value)| toml_line(name, value));
                    parts.push(format!("[{key}]\n{}", lines.collect::<String>()));
                }
                ("cranks", _) => parts.push(text(&Map::from_iter([(key, value)]))),
                _ if parts.is_empty() => {
                    plain.insert(key, value);
                }
                _ => {
                    tables.insert(key, value);
                }
            }
        }
        parts.insert(0, text(&plain));
        parts.push(text(&tables));
        parts.extend(correlations.map(|table| correlations_toml(&table)));
        parts.retain(|part| !part.is_empty());
        parts.join("\n")
    }

    /// The design as indented JSON. Reading it back gives an equal design, bit for bit.
    #[must_use]
    pub fn to_json(&self) -> String {
        format!("{:#}\n", Json::Object(self.document()))
    }

    /// All keys in the order of writing.
    pub(in crate::design) fn document(&self) -> Map<String, Json> {
        let rank = |key: &String| WRITTEN_LAST.iter().position(|last| last == key);
        let mut keys: Vec<_> = TOP.write(self).into_iter().collect();
        keys.sort_by_key(|(key, _)| rank(key));
        keys.into_iter().collect()
    }
}

fn parameters(of: &DesignModel) -> Option<Json> {
    let parameters = of.constructions.parameters.iter().map(|(name, x)| (name.clone(), x.json()));
    Some(parameters.collect::<Map<_, _>>()).filter(|list| !list.is_empty()).map(Json::Object)
}

fn joints_of(of: &DesignModel, body: Body) -> Json {
    let (points, names) = (of.manipulator().joints(body), of.joint_names(body));
    let joint = |(j, p): (usize, &Point3<f64>)| match of.constructions.of(body, j) {
        None => json!(p.coords.as_slice()),
        Some(made) => constructions::written(made, names),
    };
    let joints = names.iter().cloned().zip(points.iter().enumerate().map(joint));
    Json::Object(joints.collect())
}

/// A list of tables; nothing for an empty list.
fn all<T>(list: &[T], write: impl Fn(&T) -> Map<String, Json>) -> Option<Json> {
    (!list.is_empty()).then(|| list.iter().map(|item| Json::Object(write(item))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, SCHEMA, parse};

    #[test]
    fn a_text_above_the_first_table_is_read_suggested_written_and_described_by_its_entry() {
        let text = include_str!("../../../../designs/rbt-octahedral.toml");
        let design = parse(&format!("revision = \"B\"\n{text}"), Format::Toml).unwrap().0;
        assert_eq!(design.revision.as_deref(), Some("B"));
        assert_eq!(parse(&design.to_toml(), Format::Toml).unwrap().0, design);
        assert_eq!(parse(&design.to_json(), Format::Json).unwrap().0, design);
        assert_eq!(design.in_units("in").unwrap().revision, design.revision);
        let slip = parse(&format!("revison = \"B\"\n{text}"), Format::Toml).unwrap_err().remove(0);
        assert_eq!((slip.code, slip.help.as_str()), (Code::UnknownKey, "did you mean `revision`?"));
        assert!(SCHEMA.contains("as drawings and parts name it"));
    }
}
