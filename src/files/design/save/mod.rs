//! Writes a design as text. Numbers are written with the fewest digits that read back to the same double.

mod calibration;
mod hardware;
mod joints;
mod limits;
mod loads;
mod optimize;
mod plates;
mod poses;

use nalgebra::Point3;
use serde::Serialize;
use serde::ser::Serializer;

use self::calibration::CalibrationFile;
use self::hardware::HardwareTable;
use self::joints::{CranksFile, JointFile, toml_line, toml_quantity};
use self::limits::{EnvelopesTable, LimitsFile};
use self::loads::{KeepOutTable, LoadTable, PayloadTable, SpeedTable, StiffnessTable};
use self::optimize::OptimizeFile;
use self::plates::{HolesTable, PlatesTable};
use self::poses::{HomeTable, PoseTable, WorkspaceTable};
use super::{DesignModel, SearchTable, WrittenNumber};
use machine::requirements::{ForceUnit, ListedFrom, MassUnit, Region};
use platform::manipulator::Body;

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

impl DesignModel {
    /// The design as TOML. Reading it back gives an equal design, bit for bit.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut file = self.file();
        let correlations = file.tail.calibration.as_mut().and_then(CalibrationFile::take_correlations);
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
        tables.extend(correlations.map(|table| table.to_toml()));
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
