//! Writes a design as text. Numbers are written with the fewest digits that read back to the same double.

use nalgebra::{Point3, Vector3};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::{Combination, Design, OptimizeTable, SearchTable};
use crate::geom::Pose;
use crate::requirements::{
    Hardware, Housing, JointAxes, KeepOut, KeepOutShape, LengthLimits, Load, Region, Swing,
};

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
            mode,
            slack,
            points,
            offset_bounds: pair(search.offset_bounds),
            stretch_bounds: pair(search.stretch_bounds),
            height_bounds: pair(search.height_bounds),
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
pub(super) struct HardwareTable {
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
    max_leg_force: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_leg_speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    leg_stiffness: Option<f64>,
}

fn housing(h: Housing) -> HousingValue {
    match h {
        Housing::Sphere(diameter) => HousingValue::Diameter(diameter),
        Housing::Box(edges) => HousingValue::Edges(edges.into()),
    }
}

/// The default is left out.
fn axes(s: Swing) -> Option<AxesValue> {
    match s.axes {
        JointAxes::Home => None,
        JointAxes::Optimize => Some(AxesValue::Word("optimize")),
        JointAxes::Given(axes) => Some(AxesValue::Given(axes.map(|a| a.into_inner().into()))),
    }
}

impl HardwareTable {
    /// `None` when nothing is said.
    pub(super) fn of(h: &Hardware) -> Option<Self> {
        if *h == Hardware::default() {
            return None;
        }
        let (mut leg_length, mut drive) = (None, None);
        match h.leg_length {
            Some(LengthLimits::Range(least, greatest)) => leg_length = Some([least, greatest]),
            Some(LengthLimits::Stroke { dead, stroke }) => drive = Some((dead, stroke)),
            None => (),
        }
        let rod = h.leg_body.and_then(|b| b.rod);
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
            base_axes: h.base_swing.and_then(axes),
            platform_axes: h.platform_swing.and_then(axes),
            max_leg_force: h.max_leg_force,
            max_leg_speed: h.max_leg_speed,
            leg_stiffness: h.leg_stiffness,
        })
    }
}

/// `[speed]`.
#[derive(Serialize)]
pub(super) struct SpeedTable {
    pub(super) linear: f64,
    pub(super) angular_deg: f64,
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
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    block: Option<BoxTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sphere: Option<SphereTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    capsule: Option<CapsuleTable>,
}

impl<'a> From<&'a KeepOut> for KeepOutTable<'a> {
    fn from(k: &'a KeepOut) -> Self {
        let point = |p: Point3<f64>| -> [f64; 3] { p.coords.into() };
        let vector = |v: Vector3<f64>| -> [f64; 3] { v.into() };
        let mut out =
            Self { name: &k.name, fixed_to: k.fixed_to.name(), block: None, sphere: None, capsule: None };
        match k.shape {
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
