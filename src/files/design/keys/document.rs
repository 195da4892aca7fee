//! The keys above the first table, and the whole document: one walk over its tables that collects every violation, and the text that is written.

use nalgebra::Point3;
use serde_json::{Map, Value as Json, json};

use super::calibration::{CALIBRATION, CalibrationKeys, calibration, correlations_toml};
use super::constructions::{self, BODY, PARAMETERS};
use super::cranks::{self, CRANKS};
use super::envelope::{ENVELOPES, envelopes};
use super::found::{check_keys, element_span, elements, numbers, text};
use super::hardware::{HARDWARE, HardwareKeys, hardware};
use super::holes::{HOLES, HOLES_SHAPE, holes};
use super::joints::{self, Legs, NamedJoints};
use super::kind::{list, own, table, unit, word};
use super::limits::{LIMITS, reserves};
use super::loads::{KEEP_OUT, KeepOutKeys, LOAD, SPEED, STIFFNESS, keep_outs, loads, speed, stiffness};
use super::optimize::{OPTIMIZE, OptimizeKeys, optimize};
use super::payload::{PAYLOAD, payload};
use super::plates::{self, PLATES};
use super::poses::{HOME, home};
use super::stored::{Stored, Word};
use super::workspace::{WORKSPACE, workspace};
use super::{Code, Found, TEXT, Table, axes, joint_models, key};
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use crate::design::{DesignModel, Warning, Workspace};
use machine::requirements::{ForceUnit, MassUnit};
use platform::manipulator::{Body, InvalidManipulator, LegLengths, Manipulator};

/// Smallest size of a design: its square and fourth power still fit a double.
const SMALLEST: f64 = 1e-60;

/// The keys of a design. Those of tables are read and written in an order of their own, since some need others.
pub(super) static TOP: Table<DesignModel> = Table {
    keys: &[
        key!("name", TEXT, "of the design, not blank"; required = "add `name = \"...\"` at the top"),
        key!(
            "units",
            TEXT,
            "label of the length unit; every length of the file is in it";
            required = "add `units = \"mm\"` (a label; all lengths are in it) at the top"
        ),
        key!(
            "force_units",
            word(ForceUnit::words),
            "unit of all forces; torques are in it times the length unit; where none is named a payload and the simulator take newtons"
        ),
        key!("mass_units", word(MassUnit::words), "unit of all masses; kilograms where none is named"),
        key!("source", TEXT, "where the numbers come from"),
        key!("description", TEXT, "free text"),
        key!(
            "drive",
            own(r#"{"enum": ["prismatic", "rotary"]}"#, unit::NONE),
            "`prismatic`: legs change their lengths; `rotary`: the legs are rods of constant length on cranks, the base joints are the centres of the cranks, and `[cranks]` is required";
            default = r#""prismatic""#
        ),
        key!(
            "lengths",
            own(
                r##"{"type": "array", "minItems": 6, "maxItems": 6, "items": {"$ref": "#/$defs/not_negative"}}"##,
                unit::LENGTH
            ),
            "leg lengths in leg order, which `equipod fk` takes without `--lengths`"
        ),
        key!(
            "legs",
            own(
                r#"{"type": "array", "minItems": 6, "maxItems": 6, "items": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "string"}}}"#,
                unit::NONE
            ),
            "`[base joint, platform joint]` in leg order; in TOML above the first table";
            required = "add `legs = [[\"A1\", \"B1\"], ...]` with six pairs base-platform above the first [table]"
        ),
        key!(
            "parameters",
            table(&PARAMETERS),
            "numbers and expressions that expressions of joints and of other parameters name"
        ),
        key!(
            "base",
            table(&BODY),
            "joints in the base frame, each as `[x, y, z]` or as a construction";
            required = "add [base] with joints such as `A1 = [0.0, 0.0, 0.0]`"
        ),
        key!(
            "platform",
            table(&BODY),
            "joints in the platform frame, each as `[x, y, z]` or as a construction";
            required = "add [platform] with joints such as `B1 = [0.0, 0.0, 0.0]`"
        ),
        key!(
            "cranks",
            table(&CRANKS),
            "cranks and rods of a design whose drive is rotary: what holds for all, and tables named by base joints for what is different at one"
        ),
        key!("home", table(&HOME), "the pose the platform is built for"),
        key!("workspace", table(&WORKSPACE), "the poses to reach"),
        key!("optimize", table(&OPTIMIZE), "what the optimiser chooses, and by what"),
        key!("hardware", table(&HARDWARE), "sizes and limits of joints, legs and drives"),
        key!("speed", table(&SPEED), "the platform has to move so fast in every direction"),
        key!(
            "stiffness",
            table(&STIFFNESS),
            "the platform has to be so stiff on its legs at every pose; needs `leg_stiffness` of `[hardware]`"
        ),
        key!("loads", list(&LOAD_KIND), "wrenches the legs have to hold, one at a time"),
        key!(
            "keep_out",
            list(&KEEP_OUT_KIND),
            "bodies the legs must not touch, each a box, a sphere or a capsule"
        ),
        key!("payload", table(&PAYLOAD), "what the platform carries"),
        key!("envelope", table(&ENVELOPES), "room that plates and machine may take up"),
        key!(
            "holes",
            table(&HOLES_SHAPE),
            "grids of holes that the joints have to be put on, of both plates or of one"
        ),
        key!("plates", table(&PLATES), "the plates that carry the joints: sizes, material, holes and bolts"),
        key!("limits", table(&LIMITS), "what has to remain of each limit"),
        key!("calibration", table(&CALIBRATION), "what `equipod calibrate` found beside the joints"),
    ],
    ..Table::EMPTY
};
static LOAD_KIND: super::Kind = table(&LOAD);
static KEEP_OUT_KIND: super::Kind = table(&KEEP_OUT);

/// The design, or `None` with the reasons in the report. Later checks run on whatever earlier ones left
/// intact, so that one run shows all violations. Rods on cranks, and joints that are not ideal, are refused unless `takes_cranks`.
pub(crate) fn design(root: &Node, report: &mut Findings<'_>, takes_cranks: bool) -> Option<DesignModel> {
    let Value::Table(entries) = &root.value else {
        let help = "write { \"name\": ..., \"units\": ..., \"base\": { ... }, \"platform\": { ... }, \"legs\": [ ... ] }";
        report.refuse(
            Code::WrongType,
            &root.span,
            format!("a design is a table, not {}", root.value.kind()),
            help,
        );
        return None;
    };
    check_keys(report, entries, &TOP.names(), "a design");
    let name = required(report, root, entries, "name").and_then(|e| text(report, e));
    let units = required(report, root, entries, "units").and_then(|e| text(report, e));
    let source = text_or_absent(report, entries, "source");
    let description = text_or_absent(report, entries, "description");
    let legs_entry = legs_entry(report, root, entries);
    let parameters = constructions::parameters(report, entries);
    let mut base = required(report, root, entries, "base").and_then(|e| joints::body(report, Body::Base, e));
    let mut platform =
        required(report, root, entries, "platform").and_then(|e| joints::body(report, Body::Platform, e));
    let read_home = find(entries, "home").and_then(|e| home(report, &e.node));
    let (home, written_home) = read_home.unzip();
    let (cranks, crank_places) = cranks::cranks(report, entries, base.as_ref(), takes_cranks).unzip();
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
    let lengths = lengths(report, entries);
    let workspace = workspace(report, entries);
    let (optimize, search) = optimize(report, entries, [base.as_ref(), platform.as_ref()]);
    let (hardware, drive_table) = hardware(report, entries);
    joint_models::refuse_coupled(report, entries, &hardware, takes_cranks);
    let speed = speed(report, entries);
    let stiffness = stiffness(report, entries, &hardware, units.as_deref());
    let (loads, keep_outs) = (loads(report, entries), keep_outs(report, entries));
    let force_units = word_or_absent(report, entries, "force_units");
    let mass_units = word_or_absent(report, entries, "mass_units");
    let payload = payload(report, entries);
    let (envelopes, reserves) = (envelopes(report, entries), reserves(report, entries));
    let holes = holes(report, entries);
    let plates = plates::plates(report, entries, &hardware, units.as_deref());
    let calibration = calibration(report, entries, [base.as_ref(), platform.as_ref()]);
    if !report.is_clean() {
        return None;
    }
    let (base, platform) = (base?, platform?);
    let manipulator = manipulator(report, &root.span, &base, &platform, &legs?)?;
    let mut design =
        DesignModel::new(name?, units?, manipulator).with_joint_names(base.names(), platform.names()).ok()?;
    design.home = home;
    design.set_constructions(constructions?);
    cranks::check_platform(report, &design, &crank_places);
    design.source = source;
    design.description = description;
    design.lengths = lengths;
    design.workspace = workspace;
    design.optimize = optimize;
    design.search = search;
    design.hardware = hardware;
    design.speed = speed;
    design.stiffness = stiffness;
    design.loads = loads;
    design.keep_outs = keep_outs;
    (design.payload, design.envelopes, design.reserves) = (payload, envelopes, reserves);
    (design.force_units, design.mass_units) = (force_units, mass_units);
    design.holes = holes;
    design.plates = plates;
    design.drive_table = drive_table;
    axes::turn_to_normals(report, entries, &mut design);
    design.calibration = calibration;
    plates::check_masses(report, entries, &design);
    Some(design)
}

fn required<'a>(
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

fn text_or_absent(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<String> {
    find(entries, key).and_then(|e| text(report, e))
}

fn word_or_absent<W: Word>(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<W> {
    let (entry, kind) = (find(entries, key)?, word(W::words));
    Found { report, entry, place: "", kind }.word()
}

/// `legs` belongs at the top level. Written below a table header TOML counts it to that table; there it
/// cannot be a joint (it holds pairs of names), so that the meaning is clear: it is taken with a warning.
fn legs_entry<'a>(report: &mut Findings<'_>, root: &Node, entries: &'a [Entry]) -> Option<&'a Entry> {
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

fn lengths(report: &mut Findings<'_>, entries: &[Entry]) -> Option<LegLengths> {
    let node = &find(entries, "lengths")?.node;
    let l = numbers::<6>(report, node, "`lengths`", Code::LengthCount, "leg lengths, one for each leg");
    for (i, x) in elements(node).enumerate().filter(|(_, x)| *x < 0.0 && x.is_finite()) {
        let span = element_span(node, i);
        let message = format!("the length of leg {} is {x}", i + 1);
        report.refuse(Code::NegativeLength, &span, message, "leg lengths are not negative");
    }
    LegLengths::try_new(l?).ok()
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
            report.refuse(
                Code::OutOfRange,
                root,
                message,
                "use a smaller unit: squares of such lengths underflow",
            );
            None
        }
        Ok(m) => Some(m),
        Err(InvalidManipulator::NoSize) => {
            let message = "all joints in use of the base coincide, and so do those of the platform";
            report.refuse(Code::NoSize, root, message, "give the joints different coordinates");
            None
        }
        Err(InvalidManipulator::TooSmall) => {
            let advice = "use a smaller unit";
            report.refuse(Code::OutOfRange, root, InvalidManipulator::TooSmall.to_string(), advice);
            None
        }
        // names were looked up, coordinates and pairs checked: nothing else is left to go wrong
        Err(other) => {
            report.refuse(Code::MissingJoint, root, other.to_string(), "check joints and legs");
            None
        }
    }
}

/// A value in TOML on one line.
pub(super) fn toml_value(value: &Json) -> String {
    let joined = |list: Vec<String>| list.join(", ");
    match value {
        // what JSON writes is a basic string of TOML, but for one character
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

/// `key = value`, the key in quotes where it has to be.
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
        // strings, arrays and maps with string keys: nothing TOML could refuse
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

    /// All keys in the order in which they are written.
    pub(in crate::design) fn document(&self) -> Map<String, Json> {
        let joints = |body: Body| {
            let (points, names) = (self.manipulator().joints(body), self.joint_names(body));
            let joint = |(j, p): (usize, &Point3<f64>)| match self.constructions.of(body, j) {
                None => json!(p.coords.as_slice()),
                Some(made) => constructions::written(made, names),
            };
            let joints = names.iter().cloned().zip(points.iter().enumerate().map(joint));
            Some(Json::Object(joints.collect()))
        };
        let parameters = self.constructions.parameters.iter().map(|(name, x)| (name.clone(), x.json()));
        let all = |list: Vec<Json>| Some(Json::Array(list)).filter(|list| *list != json!([]));
        let workspace = Some(&self.workspace).filter(|w| **w != Workspace::default());
        let optimize =
            OptimizeKeys::of(&self.optimize, &self.search, [self.base_names(), self.platform_names()]);
        let [force, mass] = [self.force_units.written(), self.mass_units.written()];
        let written = [
            ("name", self.name.written()),
            ("units", self.units.written()),
            ("force_units", force),
            ("mass_units", mass),
            ("source", self.source.written()),
            ("description", self.description.written()),
            ("drive", self.has_cranks().then(|| json!("rotary"))),
            ("lengths", self.lengths.map(|l| json!(l.get()))),
            ("legs", Some(json!(self.leg_names().map(|(a, b)| [a, b])))),
            (
                "parameters",
                Some(parameters.collect::<Map<_, _>>()).filter(|p| !p.is_empty()).map(Json::Object),
            ),
            ("base", joints(Body::Base)),
            ("platform", joints(Body::Platform)),
            ("cranks", self.constructions.cranks.as_ref().map(|c| cranks::written(c, self.base_names()))),
            ("home", self.home.and_then(|_| HOME.put(self))),
            ("workspace", workspace.and_then(|w| WORKSPACE.put(w))),
            ("optimize", OPTIMIZE.put(&optimize)),
            ("hardware", HARDWARE.put(&HardwareKeys::of(&self.hardware, self.drive_table.as_ref()))),
            ("limits", LIMITS.put(&self.reserves)),
            ("envelope", ENVELOPES.put(&self.envelopes)),
            ("holes", self.holes.as_ref().and_then(|holes| HOLES.put(holes))),
            ("plates", PLATES.put(&self.plates)),
            ("speed", self.speed.as_ref().and_then(|speed| SPEED.put(speed))),
            ("stiffness", self.stiffness.as_ref().map(|wanted| json!(STIFFNESS.write(wanted)))),
            ("payload", self.payload.as_ref().and_then(|payload| PAYLOAD.put(payload))),
            ("loads", all(self.loads.iter().map(|load| json!(LOAD.write(load))).collect())),
            (
                "keep_out",
                all(self.keep_outs.iter().map(|k| json!(KEEP_OUT.write(&KeepOutKeys::from(k)))).collect()),
            ),
            (
                "calibration",
                self.calibration.as_ref().and_then(|t| CALIBRATION.put(&CalibrationKeys::of(self, t))),
            ),
        ];
        written.into_iter().filter_map(|(key, value)| Some((key.to_owned(), value?))).collect()
    }
}
