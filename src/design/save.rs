//! A design back to text. Numbers are written with the fewest digits that read back to the same double.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::Design;
use super::save_optimize::OptimizeFile;
use super::save_requirements::{HardwareTable, KeepOutTable, LoadTable, SpeedTable};
use crate::geom::Pose;
use crate::requirements::Region;

/// The structure of a file, in the order it is written.
#[derive(Serialize)]
struct DesignFile<'a> {
    name: &'a str,
    units: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    description: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lengths: Option<[f64; 6]>,
    legs: [[&'a str; 2]; 6],
    base: Joints<'a>,
    platform: Joints<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    home: Option<PoseTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    workspace: Option<WorkspaceTable>,
    #[serde(skip_serializing_if = "OptimizeFile::is_empty")]
    optimize: OptimizeFile,
    #[serde(skip_serializing_if = "Option::is_none")]
    hardware: Option<HardwareTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<SpeedTable>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    loads: Vec<LoadTable<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    keep_out: Vec<KeepOutTable<'a>>,
}

struct Joints<'a>(Vec<(&'a str, [f64; 3])>);

impl Serialize for Joints<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, point) in &self.0 {
            map.serialize_entry(name, point)?;
        }
        map.end()
    }
}

#[derive(Serialize)]
struct PoseTable {
    position: [f64; 3],
    rotation: [[f64; 3]; 3],
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
    #[serde(skip_serializing_if = "Vec::is_empty")]
    poses: Vec<PoseTable>,
}

impl Design {
    /// The design as TOML. Reading it back gives an equal design, bit for bit.
    #[must_use]
    pub fn to_toml(&self) -> String {
        // strings, arrays and maps with string keys: nothing TOML could refuse
        toml::to_string(&self.file()).unwrap_or_default()
    }

    /// The design as indented JSON. Reading it back gives an equal design, bit for bit.
    #[must_use]
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(&self.file()).unwrap_or_default();
        text.push('\n');
        text
    }

    fn file(&self) -> DesignFile<'_> {
        let m = self.manipulator();
        let coordinates = |points: &[nalgebra::Point3<f64>]| -> Vec<[f64; 3]> {
            points.iter().map(|p| p.coords.into()).collect()
        };
        let base = coordinates(m.base_joints());
        let platform = coordinates(m.platform_joints());
        DesignFile {
            name: &self.name,
            units: &self.units,
            source: self.source.as_deref(),
            description: self.description.as_deref(),
            lengths: self.lengths.map(|l| l.get()),
            legs: self.leg_names().map(|(a, b)| [a, b]),
            base: Joints(self.base_names().iter().map(String::as_str).zip(base).collect()),
            platform: Joints(self.platform_names().iter().map(String::as_str).zip(platform).collect()),
            home: self.home.as_ref().map(PoseTable::from),
            workspace: self.workspace_table(),
            optimize: OptimizeFile::of(&self.optimize, &self.search),
            hardware: HardwareTable::of(&self.hardware),
            speed: self.speed.map(|s| SpeedTable { linear: s.linear, angular_deg: s.angular_deg }),
            loads: self.loads.iter().map(LoadTable::from).collect(),
            keep_out: self.keep_outs.iter().map(KeepOutTable::from).collect(),
        }
    }

    fn workspace_table(&self) -> Option<WorkspaceTable> {
        let w = &self.workspace;
        (*w != super::Workspace::default()).then(|| WorkspaceTable {
            translation: w.translation.into(),
            rotation_deg: w.rotation_deg.into(),
            grid: w.grid,
            region: (w.region == Region::Ellipsoid).then_some("ellipsoid"),
            trajectory: w.trajectory.as_ref().map(|t| t.file.clone()),
            poses: w.poses.iter().map(PoseTable::from).collect(),
        })
    }
}
