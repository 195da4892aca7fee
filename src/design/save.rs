//! Writes a design as text. Numbers are written with the fewest digits that read back to the same double.

use nalgebra::{Point3, Vector3};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::construction::{CrankCopy, Spelling, WrittenCrank, WrittenCranks, WrittenHome};
use super::{
    CalibrationTable, Combination, Construction, Design, LinePlace, OptimizeTable, SearchTable, WrittenNumber,
};
use crate::geom::Pose;
use crate::manipulator::Body;
use crate::requirements::{
    Envelope, Envelopes, ForceUnit, Grid, Hardware, HolePattern, Housing, JointAxes, KeepOut, KeepOutShape,
    KeptSymmetry, LegPart, LengthLimits, ListedFrom, Load, MassUnit, Payload, PlateDesign, PlateMass, Plates,
    Region, Reserve, Reserves, TermKind, UniversalJoint,
};
use crate::rotary::Elbow;

/// The structure of a file, in the order it is written.
#[derive(Serialize)]
struct DesignFile<'a> {
    #[serde(flatten)]
    head: Head<'a>,
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "as_map")]
    parameters: Vec<(&'a str, &'a WrittenNumber)>,
    #[serde(serialize_with = "as_map")]
    base: Vec<(&'a str, JointFile<'a>)>,
    #[serde(serialize_with = "as_map")]
    platform: Vec<(&'a str, JointFile<'a>)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cranks: Option<CranksFile<'a>>,
    #[serde(flatten)]
    tail: Tail<'a>,
}

/// What stands above the first table.
#[derive(Serialize)]
struct Head<'a> {
    name: &'a str,
    units: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    force_units: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mass_units: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    description: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drive: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lengths: Option<[f64; 6]>,
    legs: [[&'a str; 2]; 6],
}

/// The tables after those of the joints.
#[derive(Serialize)]
struct Tail<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    home: Option<HomeTable<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    workspace: Option<WorkspaceTable>,
    #[serde(skip_serializing_if = "OptimizeFile::is_empty")]
    optimize: OptimizeFile,
    #[serde(skip_serializing_if = "Option::is_none")]
    hardware: Option<HardwareTable<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    limits: Option<LimitsFile>,
    #[serde(skip_serializing_if = "Option::is_none")]
    envelope: Option<EnvelopesTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    holes: Option<HolesTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plates: Option<PlatesTable<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<SpeedTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness: Option<StiffnessTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    payload: Option<PayloadTable>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    loads: Vec<LoadTable<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    keep_out: Vec<KeepOutTable<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    calibration: Option<CalibrationFile<'a>>,
}

fn as_map<S: Serializer>(list: &[(&str, impl Serialize)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(list.iter().map(|(name, value)| (name, value)))
}

/// `[cranks]`: what is said of all cranks, and of single ones by name.
#[derive(Serialize)]
struct CranksFile<'a> {
    #[serde(flatten)]
    shared: CrankFile<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_torque: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_speed_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    least_transmission_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tip_swing_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform_swing_deg: Option<f64>,
    #[serde(flatten, serialize_with = "as_map")]
    own: Vec<(&'a str, CrankFile<'a>)>,
}

/// A crank, as it is written.
#[derive(Serialize)]
struct CrankFile<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<&'a WrittenNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rod_length: Option<&'a WrittenNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    axis: Option<&'a [WrittenNumber; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    zero: Option<&'a [WrittenNumber; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    elbow: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<&'a [WrittenNumber; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turn: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    deg: Option<&'a WrittenNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mirror: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plane: Option<&'static str>,
}

impl<'a> CrankFile<'a> {
    fn of(crank: &'a WrittenCrank, names: &'a [String]) -> Self {
        let (mut turn, mut deg, mut mirror, mut plane) = (None, None, None, None);
        match &crank.copy {
            Some(CrankCopy::Turned { crank, deg: by }) => {
                (turn, deg) = (Some(names[*crank].as_str()), Some(by));
            }
            Some(CrankCopy::Mirrored { crank, plane: p }) => {
                (mirror, plane) = (Some(names[*crank].as_str()), Some(p.name()));
            }
            None => {}
        }
        Self {
            length: crank.length.as_ref(),
            rod_length: crank.rod_length.as_ref(),
            axis: crank.axis.as_ref(),
            zero: crank.zero.as_ref(),
            elbow: crank.elbow.map(Elbow::name),
            angle_deg: crank.angle_deg.as_ref(),
            turn,
            deg,
            mirror,
            plane,
        }
    }
}

impl<'a> CranksFile<'a> {
    fn of(cranks: &'a WrittenCranks, names: &'a [String]) -> Self {
        let own = names.iter().zip(&cranks.own);
        let own = own.filter_map(|(name, own)| Some((name.as_str(), CrankFile::of(own.as_ref()?, names))));
        Self {
            shared: CrankFile::of(&cranks.shared, names),
            max_torque: cranks.drives.max_torque,
            max_speed_deg: cranks.drives.max_speed_deg,
            least_transmission_deg: cranks.drives.least_transmission_deg,
            tip_swing_deg: cranks.drives.tip_swing_deg,
            platform_swing_deg: cranks.drives.platform_swing_deg,
            own: own.collect(),
        }
    }
}

/// A joint, as it is written.
enum JointFile<'a> {
    Numbers([f64; 3]),
    Coordinates(&'a [WrittenNumber; 3]),
    /// A table of keys.
    Form(Vec<(&'static str, FormValue<'a>)>),
}

/// A value in the table of a joint.
enum FormValue<'a> {
    WrittenNumber(&'a WrittenNumber),
    Text(&'a str),
    Pair([&'a str; 2]),
}

impl<'a> JointFile<'a> {
    fn of(made: &'a Construction, names: &'a [String]) -> Self {
        let name = |j: usize| names[j].as_str();
        let form = match made {
            Construction::Coordinates(list) => return Self::Coordinates(list),
            Construction::OnLine { through, at } => {
                let (key, value) = match at {
                    LinePlace::Share(value) => ("t", value),
                    LinePlace::Offset(value) => ("offset", value),
                };
                vec![("on", FormValue::Pair(through.map(name))), (key, FormValue::WrittenNumber(value))]
            }
            Construction::Polar { radius, angle_deg, z } => {
                let mut form = vec![
                    ("radius", FormValue::WrittenNumber(radius)),
                    ("angle_deg", FormValue::WrittenNumber(angle_deg)),
                ];
                form.extend(z.as_ref().map(|z| ("z", FormValue::WrittenNumber(z))));
                form
            }
            Construction::Turned { joint, deg } => {
                vec![("turn", FormValue::Text(name(*joint))), ("deg", FormValue::WrittenNumber(deg))]
            }
            Construction::Mirrored { joint, plane } => {
                vec![("mirror", FormValue::Text(name(*joint))), ("plane", FormValue::Text(plane.name()))]
            }
        };
        Self::Form(form)
    }

    fn to_toml(&self) -> String {
        match self {
            Self::Numbers(p) => format!("[{}]", p.map(toml_number).join(", ")),
            Self::Coordinates(list) => format!("[{}]", list.each_ref().map(toml_quantity).join(", ")),
            Self::Form(fields) => {
                let field = |(key, value): &(&str, FormValue<'_>)| {
                    let value = match value {
                        FormValue::WrittenNumber(q) => toml_quantity(q),
                        FormValue::Text(text) => toml_text(text),
                        FormValue::Pair(pair) => format!("[{}]", pair.map(toml_text).join(", ")),
                    };
                    format!("{key} = {value}")
                };
                format!("{{ {} }}", fields.iter().map(field).collect::<Vec<_>>().join(", "))
            }
        }
    }
}

impl Serialize for JointFile<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Numbers(p) => p.serialize(serializer),
            Self::Coordinates(list) => list.serialize(serializer),
            Self::Form(fields) => {
                let mut map = serializer.serialize_map(Some(fields.len()))?;
                for (key, value) in fields {
                    match value {
                        FormValue::WrittenNumber(q) => map.serialize_entry(key, q)?,
                        FormValue::Text(text) => map.serialize_entry(key, text)?,
                        FormValue::Pair(pair) => map.serialize_entry(key, pair)?,
                    }
                }
                map.end()
            }
        }
    }
}

impl Serialize for WrittenNumber {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.written() {
            Spelling::Number(x) => serializer.serialize_f64(*x),
            Spelling::Text(text) => serializer.serialize_str(text),
        }
    }
}

fn toml_number(x: f64) -> String {
    toml::Value::Float(x).to_string()
}

/// In quotes, on one line.
fn toml_text(text: &str) -> String {
    // what JSON writes is a basic string of TOML, but for one character
    serde_json::to_string(text).unwrap_or_default().replace('\u{7f}', "\\u007f")
}

fn toml_quantity(q: &WrittenNumber) -> String {
    match q.written() {
        Spelling::Number(x) => toml_number(*x),
        Spelling::Text(text) => toml_text(text),
    }
}

/// `key = value`, the key in quotes where it has to be.
fn toml_line(key: &str, value: &str) -> String {
    let pair = toml::to_string(&std::collections::BTreeMap::from([(key, 0)])).unwrap_or_default();
    format!("{}= {value}\n", pair.trim_end().trim_end_matches('0').trim_end_matches("= "))
}

#[derive(Serialize)]
struct PoseTable {
    position: [f64; 3],
    rotation: [[f64; 3]; 3],
}

/// `[home]`: numbers, or what they were written as.
#[derive(Serialize)]
#[serde(untagged)]
enum HomeTable<'a> {
    Numbers(PoseTable),
    Angles { position: &'a [WrittenNumber; 3], rpy_deg: &'a [WrittenNumber; 3] },
    Rows { position: &'a [WrittenNumber; 3], rotation: [[f64; 3]; 3] },
}

impl<'a> HomeTable<'a> {
    fn of(design: &'a Design) -> Option<Self> {
        let table = PoseTable::from(design.home.as_ref()?);
        Some(match design.written_home() {
            None => Self::Numbers(table),
            Some(WrittenHome { position, rpy_deg: Some(rpy_deg), .. }) => Self::Angles { position, rpy_deg },
            Some(WrittenHome { position, rpy_deg: None, .. }) => {
                Self::Rows { position, rotation: table.rotation }
            }
        })
    }
}

impl From<&Pose> for PoseTable {
    fn from(pose: &Pose) -> Self {
        let m = pose.rotation.matrix();
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]));
        Self { position: pose.position.into(), rotation }
    }
}

#[derive(Serialize)]
struct WorkspaceTable {
    translation: [f64; 3],
    rotation_deg: [f64; 3],
    grid: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    trajectory: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    relative_to: Option<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    poses: Vec<PoseTable>,
}

impl Design {
    /// The design as TOML. Reading it back gives an equal design, bit for bit.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let file = self.file();
        // strings, arrays and maps with string keys: nothing TOML could refuse
        let text = |part: Result<String, _>| part.unwrap_or_default();
        let mut tables = Vec::new();
        tables.push(text(toml::to_string(&file.head)));
        if !file.parameters.is_empty() {
            let lines = file.parameters.iter().map(|(name, q)| toml_line(name, &toml_quantity(q)));
            tables.push(format!("[parameters]\n{}", lines.collect::<String>()));
        }
        for (body, joints) in [("base", &file.base), ("platform", &file.platform)] {
            let lines = joints.iter().map(|(name, joint)| toml_line(name, &joint.to_toml()));
            tables.push(format!("[{body}]\n{}", lines.collect::<String>()));
        }
        let cranks =
            file.cranks.as_ref().map(|cranks| std::collections::BTreeMap::from([("cranks", cranks)]));
        tables.push(text(cranks.map_or(Ok(String::new()), |table| toml::to_string(&table))));
        tables.push(text(toml::to_string(&file.tail)));
        tables.retain(|table| !table.is_empty());
        tables.join("\n")
    }

    /// The design as indented JSON. Reading it back gives an equal design, bit for bit.
    #[must_use]
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(&self.file()).unwrap_or_default();
        text.push('\n');
        text
    }

    fn file(&self) -> DesignFile<'_> {
        let head = Head {
            name: &self.name,
            units: &self.units,
            force_units: self.force_units.map(ForceUnit::label),
            mass_units: self.mass_units.map(MassUnit::label),
            source: self.source.as_deref(),
            description: self.description.as_deref(),
            drive: self.has_cranks().then_some("rotary"),
            lengths: self.lengths.map(|l| l.get()),
            legs: self.leg_names().map(|(a, b)| [a, b]),
        };
        let tail = Tail {
            home: HomeTable::of(self),
            workspace: self.workspace_table(),
            optimize: OptimizeFile::of(&self.optimize, &self.with_known_joints()),
            hardware: HardwareTable::of(&self.hardware, self.drive_table.as_deref()),
            limits: LimitsFile::of(&self.reserves),
            envelope: EnvelopesTable::of(&self.envelopes),
            holes: self.holes.as_ref().map(HolesTable::from),
            plates: PlatesTable::of(&self.plates),
            payload: self.payload.as_ref().map(PayloadTable::from),
            speed: self.speed.map(|s| SpeedTable { linear: s.linear, angular_deg: s.angular_deg }),
            stiffness: self.stiffness.map(|s| StiffnessTable {
                linear: s.linear,
                angular: s.angular,
                natural_frequency: s.natural_frequency,
            }),
            loads: self.loads.iter().map(LoadTable::from).collect(),
            keep_out: self.keep_outs.iter().map(KeepOutTable::from).collect(),
            calibration: self.calibration.as_ref().map(|table| CalibrationFile::of(self, table)),
        };
        DesignFile {
            head,
            parameters: self.constructions.parameters.iter().map(|(n, q)| (n.as_str(), q)).collect(),
            base: self.joint_files(Body::Base),
            platform: self.joint_files(Body::Platform),
            cranks: self.constructions.cranks.as_ref().map(|c| CranksFile::of(c, self.base_names())),
            tail,
        }
    }

    /// The search with the fixed joints that the design still has.
    fn with_known_joints(&self) -> SearchTable {
        let mut out = self.search.clone();
        for body in Body::BOTH {
            out.fixed[body.index()].retain(|name| self.joint_names(body).contains(name));
        }
        out
    }

    fn joint_files(&self, body: Body) -> Vec<(&str, JointFile<'_>)> {
        let (m, names) = (self.manipulator(), self.joint_names(body));
        let points = body.of((m.base_joints(), m.platform_joints()));
        let file = |j: usize, p: &Point3<f64>| match self.constructions.of(body, j) {
            None => JointFile::Numbers(p.coords.into()),
            Some(made) => JointFile::of(made, names),
        };
        names.iter().zip(points).enumerate().map(|(j, (name, p))| (name.as_str(), file(j, p))).collect()
    }

    fn workspace_table(&self) -> Option<WorkspaceTable> {
        let w = &self.workspace;
        (*w != super::Workspace::default()).then(|| WorkspaceTable {
            translation: w.translation.into(),
            rotation_deg: w.rotation_deg.into(),
            grid: w.grid,
            region: (w.region == Region::Ellipsoid).then_some("ellipsoid"),
            trajectory: w.trajectory.as_ref().map(|t| t.file.clone()),
            relative_to: (w.listed_from == ListedFrom::Home).then_some(ListedFrom::Home.name()),
            poses: w.poses.iter().map(PoseTable::from).collect(),
        })
    }
}

/// `[calibration]`.
#[derive(Serialize)]
struct CalibrationFile<'a> {
    offsets: [f64; 6],
    #[serde(skip_serializing_if = "Option::is_none")]
    offset_deviations: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "as_map")]
    base_deviations: Vec<(&'a str, [f64; 3])>,
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "as_map")]
    platform_deviations: Vec<(&'a str, [f64; 3])>,
}

impl<'a> CalibrationFile<'a> {
    fn of(design: &'a Design, table: &CalibrationTable) -> Self {
        let named = |body: Body| {
            let of = |(joint, name): (usize, &'a String)| {
                Some((name.as_str(), table.deviation(body, joint)?.into()))
            };
            design.joint_names(body).iter().enumerate().filter_map(of).collect()
        };
        Self {
            offsets: table.offsets,
            offset_deviations: table.offset_deviations,
            base_deviations: named(Body::Base),
            platform_deviations: named(Body::Platform),
        }
    }
}

/// A percentage, or an amount.
#[derive(Serialize)]
#[serde(untagged)]
enum ReserveValue {
    Percent(String),
    Amount(f64),
}

impl ReserveValue {
    fn percent(x: f64) -> Self {
        Self::Percent(format!("{x}%"))
    }
}

/// `[limits]`.
#[derive(Serialize)]
struct LimitsFile {
    reserve: ReservesTable,
}

/// One for every limit, or a table.
#[derive(Serialize)]
#[serde(untagged)]
enum ReservesTable {
    All(ReserveValue),
    Kinds(std::collections::BTreeMap<&'static str, ReserveValue>),
}

impl LimitsFile {
    fn of(reserves: &Reserves) -> Option<Self> {
        if reserves.is_empty() {
            return None;
        }
        if let (Some(all), true) = (reserves.all, reserves.kinds.is_empty()) {
            return Some(Self { reserve: ReservesTable::All(ReserveValue::percent(all)) });
        }
        let own = reserves.kinds.iter().map(|(kind, r)| {
            let value = match r {
                Reserve::Percent(x) => ReserveValue::percent(*x),
                Reserve::Amount(x) => ReserveValue::Amount(*x),
            };
            (TermKind::code(*kind), value)
        });
        let all = reserves.all.map(|x| ("all", ReserveValue::percent(x)));
        Some(Self { reserve: ReservesTable::Kinds(own.chain(all).collect()) })
    }
}

/// A shape of `[envelope]`.
#[derive(Serialize)]
#[serde(untagged)]
enum EnvelopeValue {
    Cylinder { radius: f64, center: [f64; 2] },
    Box { min: [f64; 3], max: [f64; 3] },
}

/// `[envelope]`.
#[derive(Serialize)]
struct EnvelopesTable {
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<EnvelopeValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<EnvelopeValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    machine: Option<EnvelopeValue>,
}

impl EnvelopesTable {
    fn of(e: &Envelopes) -> Option<Self> {
        let value = |e: Envelope| match e {
            Envelope::Cylinder { radius, center } => EnvelopeValue::Cylinder { radius, center },
            Envelope::Box { min, max } => {
                EnvelopeValue::Box { min: min.coords.into(), max: max.coords.into() }
            }
        };
        (*e != Envelopes::default()).then(|| Self {
            base: e.base.map(value),
            platform: e.platform.map(value),
            machine: e.machine.map(value),
        })
    }
}

/// A grid of `[holes]`.
#[derive(Serialize)]
struct GridTable {
    pattern: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pitch: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_radius: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radii: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<CountFile>,
    origin: [f64; 2],
    angle_deg: f64,
}

/// Numbers of holes.
#[derive(Serialize)]
#[serde(untagged)]
enum CountFile {
    Ring(u32),
    Circles(Vec<u32>),
}

impl From<&Grid> for GridTable {
    fn from(g: &Grid) -> Self {
        let circles = g.circles.as_slice();
        let first = circles.first().filter(|_| g.pattern == HolePattern::Polar);
        let bolts = g.pattern == HolePattern::BoltCircle;
        let counts = || CountFile::Circles(circles.iter().map(|c| c.holes).collect());
        Self {
            pattern: g.pattern.name(),
            pitch: (!bolts).then_some(g.pitch),
            first_radius: first.map(|c| c.radius),
            radii: bolts.then(|| circles.iter().map(|c| c.radius).collect()),
            count: first.map(|c| CountFile::Ring(c.holes)).or_else(|| bolts.then(counts)),
            origin: g.origin,
            angle_deg: g.angle_deg,
        }
    }
}

/// `[holes]`.
#[derive(Serialize)]
struct HolesTable {
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<GridTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<GridTable>,
}

impl From<&[Option<Grid>; 2]> for HolesTable {
    fn from([base, platform]: &[Option<Grid>; 2]) -> Self {
        Self { base: base.as_ref().map(GridTable::from), platform: platform.as_ref().map(GridTable::from) }
    }
}

/// `[plates]`.
#[derive(Serialize)]
struct PlatesTable<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<PlateTable<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<PlateTable<'a>>,
}

/// `[plates.base]` and `[plates.platform]`.
#[derive(Serialize)]
struct PlateTable<'a> {
    thickness: f64,
    margin: f64,
    hole: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    height: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    material: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    density: Option<f64>,
    edge_distance: f64,
    hole_distance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    foot: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bolts: Option<BoltsTable>,
}

/// `bolts` of a plate.
#[derive(Serialize)]
struct BoltsTable {
    count: u32,
    circle: f64,
    hole: f64,
    first_deg: f64,
    from: &'static str,
}

impl<'a> PlatesTable<'a> {
    fn of(plates: &'a Plates) -> Option<Self> {
        let [base, platform] = Body::BOTH.map(|body| plates.of(body).map(PlateTable::from));
        (base.is_some() || platform.is_some()).then_some(Self { base, platform })
    }
}

impl<'a> From<&'a PlateDesign> for PlateTable<'a> {
    fn from(p: &'a PlateDesign) -> Self {
        Self {
            thickness: p.thickness,
            margin: p.margin,
            hole: p.hole,
            height: p.height,
            material: p.material.as_deref(),
            density: p.density,
            edge_distance: p.edge_distance,
            hole_distance: p.hole_distance,
            foot: p.foot,
            bolts: p.bolts.map(|b| BoltsTable {
                count: b.count,
                circle: b.circle,
                hole: b.hole,
                first_deg: b.first_deg,
                from: b.from.name(),
            }),
        }
    }
}

/// `[payload]`.
#[derive(Serialize)]
struct PayloadTable {
    mass: f64,
    center: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    inertia: Option<[[f64; 3]; 3]>,
    gravity: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    plate: Option<&'static str>,
    #[serde(flatten)]
    shape: ShapeTable,
}

impl From<&Payload> for PayloadTable {
    fn from(p: &Payload) -> Self {
        Self {
            mass: p.mass,
            center: p.center.coords.into(),
            inertia: p.inertia.map(|m| std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]))),
            gravity: p.gravity.into(),
            plate: Some(p.plate.name()).filter(|_| p.plate != PlateMass::Included),
            shape: p.shape.as_ref().map_or_else(ShapeTable::default, ShapeTable::from),
        }
    }
}

#[derive(Serialize, PartialEq)]
struct WeightedObjective {
    name: &'static str,
    weight: f64,
}

/// `[optimize]`.
#[derive(Serialize, Default, PartialEq)]
pub(super) struct OptimizeFile {
    #[serde(skip_serializing_if = "Option::is_none")]
    min_joint_distance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    min_abs_det: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    characteristic_length: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    variables: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    symmetry: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mode: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slack: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    offset_bounds: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stretch_bounds: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height_bounds: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fixed: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    objectives: Vec<WeightedObjective>,
}

impl OptimizeFile {
    pub(super) fn of(limits: &OptimizeTable, search: &SearchTable) -> Self {
        let (mode, slack, points) = match search.mode {
            None => (None, None, None),
            Some(Combination::Weighted) => (Some("weighted"), None, None),
            Some(Combination::Lexicographic { slack }) => (Some("lexicographic"), Some(slack), None),
            Some(Combination::Pareto { points }) => (Some("pareto"), None, Some(points)),
        };
        let pair = |b: Option<(f64, f64)>| b.map(|(low, high)| [low, high]);
        Self {
            min_joint_distance: limits.min_joint_distance,
            min_abs_det: limits.min_abs_det,
            characteristic_length: limits.characteristic_length,
            variables: search.variables.iter().map(|v| v.code()).collect(),
            symmetry: search.symmetry.map(KeptSymmetry::code),
            mode,
            slack,
            points,
            offset_bounds: pair(search.offset_bounds),
            stretch_bounds: pair(search.stretch_bounds),
            height_bounds: pair(search.height_bounds),
            fixed: search.fixed.iter().flatten().cloned().collect(),
            objectives: search
                .objectives
                .iter()
                .map(|(o, weight)| WeightedObjective { name: o.code(), weight: *weight })
                .collect(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A diameter, or three edge lengths.
#[derive(Serialize)]
#[serde(untagged)]
enum HousingValue {
    Diameter(f64),
    Edges([f64; 3]),
}

/// A word, or six vectors.
#[derive(Serialize)]
#[serde(untagged)]
enum AxesValue {
    Word(&'static str),
    Given([[f64; 3]; 6]),
}

/// `[hardware]`.
#[derive(Serialize)]
pub(super) struct HardwareTable<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    joint_diameter: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_housing: Option<HousingValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform_housing: Option<HousingValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    leg_diameter: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rod_diameter: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cylinder_length: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    leg_clearance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    leg_length: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    dead_length: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stroke: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_swing_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform_swing_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_axes: Option<AxesValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform_axes: Option<AxesValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    screw_lead: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_leg_force: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_leg_speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    leg_stiffness: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cylinder_mass: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cylinder_center: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cylinder_inertia: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rod_mass: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rod_center: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rod_inertia: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reflected_mass: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drives: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_joint: Option<JointTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform_joint: Option<JointTable>,
}

fn housing(h: Housing) -> HousingValue {
    match h {
        Housing::Sphere(diameter) => HousingValue::Diameter(diameter),
        Housing::Box(edges) => HousingValue::Edges(edges.into()),
    }
}

/// The default is left out.
/// `base_joint` and `platform_joint`.
#[derive(Serialize)]
struct JointTable {
    model: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_axis: Option<FirstAxisValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bending_stiffness: Option<f64>,
}

/// One direction for all joints, or six.
#[derive(Serialize)]
#[serde(untagged)]
enum FirstAxisValue {
    One([f64; 3]),
    Six([[f64; 3]; 6]),
}

/// Balls are left out.
fn joint(universal: Option<&UniversalJoint>, bending: Option<f64>) -> Option<JointTable> {
    if let Some(joint) = universal {
        let all: [[f64; 3]; 6] = joint.first_axes.map(|a| a.into_inner().into());
        let bits = |a: &[f64; 3]| a.map(f64::to_bits);
        let same = all.iter().all(|a| bits(a) == bits(&all[0]));
        return Some(JointTable {
            model: "universal",
            first_axis: Some(if same { FirstAxisValue::One(all[0]) } else { FirstAxisValue::Six(all) }),
            angle_deg: joint.limits_deg,
            offset: (joint.offset != 0.0).then_some(joint.offset),
            bending_stiffness: None,
        });
    }
    bending.map(|stiffness| JointTable {
        model: "flexure",
        first_axis: None,
        angle_deg: None,
        offset: None,
        bending_stiffness: Some(stiffness),
    })
}

fn axes(axes: JointAxes) -> Option<AxesValue> {
    match axes {
        JointAxes::Home => None,
        JointAxes::Optimize => Some(AxesValue::Word("optimize")),
        JointAxes::Given(axes) => Some(AxesValue::Given(axes.map(|a| a.into_inner().into()))),
    }
}

impl<'a> HardwareTable<'a> {
    /// `None` when nothing is said.
    pub(super) fn of(h: &Hardware, drives: Option<&'a str>) -> Option<Self> {
        if *h == Hardware::default() && drives.is_none() {
            return None;
        }
        let (mut leg_length, mut drive) = (None, None);
        match h.leg_length {
            Some(LengthLimits::Range(least, greatest)) => leg_length = Some([least, greatest]),
            Some(LengthLimits::Stroke { dead, stroke }) => drive = Some((dead, stroke)),
            None => (),
        }
        let rod = h.leg_body.and_then(|b| b.rod);
        let heavy = |part: LegPart| (part.mass > 0.0).then_some(part);
        let cylinder_body = h.leg_masses.and_then(|m| heavy(m.cylinder));
        let rod_body = h.leg_masses.and_then(|m| heavy(m.rod));
        Some(Self {
            joint_diameter: h.joint_diameter,
            base_housing: h.base_housing.map(housing),
            platform_housing: h.platform_housing.map(housing),
            leg_diameter: h.leg_body.map(|b| b.diameter),
            rod_diameter: rod.map(|r| r.1),
            cylinder_length: rod.map(|r| r.0),
            leg_clearance: h.leg_clearance,
            leg_length,
            dead_length: drive.map(|d| d.0),
            stroke: drive.map(|d| d.1),
            base_swing_deg: h.base_swing.map(|s| s.limit_deg),
            platform_swing_deg: h.platform_swing.map(|s| s.limit_deg),
            base_axes: h.axes(Body::Base).and_then(axes),
            platform_axes: h.axes(Body::Platform).and_then(axes),
            screw_lead: h.screw_lead,
            max_leg_force: h.max_leg_force,
            max_leg_speed: h.max_leg_speed,
            leg_stiffness: h.leg_stiffness,
            cylinder_mass: cylinder_body.map(|p| p.mass),
            cylinder_center: cylinder_body.map(|p| p.center),
            cylinder_inertia: cylinder_body.map(|p| p.inertia),
            rod_mass: rod_body.map(|p| p.mass),
            rod_center: rod_body.map(|p| p.center),
            rod_inertia: rod_body.map(|p| p.inertia),
            reflected_mass: h.leg_masses.map(|m| m.reflected).filter(|x| *x > 0.0),
            drives,
            base_joint: joint(h.base_universal.as_ref(), h.base_bending),
            platform_joint: joint(h.platform_universal.as_ref(), h.platform_bending),
        })
    }
}

/// `[speed]`.
#[derive(Serialize)]
pub(super) struct SpeedTable {
    pub(super) linear: f64,
    pub(super) angular_deg: f64,
}

/// `[stiffness]`.
#[derive(Serialize)]
pub(super) struct StiffnessTable {
    #[serde(skip_serializing_if = "Option::is_none")]
    linear: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angular: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    natural_frequency: Option<f64>,
}

/// One of `[[loads]]`.
#[derive(Serialize)]
pub(super) struct LoadTable<'a> {
    name: &'a str,
    force: [f64; 3],
    torque: [f64; 3],
    at: [f64; 3],
    fixed_to: &'static str,
}

impl<'a> From<&'a Load> for LoadTable<'a> {
    fn from(l: &'a Load) -> Self {
        Self {
            name: &l.name,
            force: l.force.into(),
            torque: l.torque.into(),
            at: l.at.coords.into(),
            fixed_to: l.fixed_to.name(),
        }
    }
}

#[derive(Serialize)]
struct BoxTable {
    center: [f64; 3],
    size: [f64; 3],
}

#[derive(Serialize)]
struct SphereTable {
    center: [f64; 3],
    diameter: f64,
}

#[derive(Serialize)]
struct CapsuleTable {
    from: [f64; 3],
    to: [f64; 3],
    diameter: f64,
}

/// One of `[[keep_out]]`: one of the three shapes.
#[derive(Serialize)]
pub(super) struct KeepOutTable<'a> {
    name: &'a str,
    fixed_to: &'static str,
    #[serde(flatten)]
    shape: ShapeTable,
}

/// At most one of the three shapes.
#[derive(Serialize, Default)]
struct ShapeTable {
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    block: Option<BoxTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sphere: Option<SphereTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    capsule: Option<CapsuleTable>,
}

impl<'a> From<&'a KeepOut> for KeepOutTable<'a> {
    fn from(k: &'a KeepOut) -> Self {
        Self { name: &k.name, fixed_to: k.fixed_to.name(), shape: ShapeTable::from(&k.shape) }
    }
}

impl From<&KeepOutShape> for ShapeTable {
    fn from(shape: &KeepOutShape) -> Self {
        let point = |p: Point3<f64>| -> [f64; 3] { p.coords.into() };
        let vector = |v: Vector3<f64>| -> [f64; 3] { v.into() };
        let mut out = Self::default();
        match *shape {
            KeepOutShape::Box { center, size } => {
                out.block = Some(BoxTable { center: point(center), size: vector(size) });
            }
            KeepOutShape::Sphere { center, diameter } => {
                out.sphere = Some(SphereTable { center: point(center), diameter });
            }
            KeepOutShape::Capsule { from, to, diameter } => {
                out.capsule = Some(CapsuleTable { from: point(from), to: point(to), diameter });
            }
        }
        out
    }
}
