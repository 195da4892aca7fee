//! Requirements back to the structure of a file.

use nalgebra::{Point3, Vector3};
use serde::Serialize;

use crate::requirements::{FixedTo, Hardware, Housing, JointAxes, KeepOut, LengthLimits, Load, Shape, Swing};

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

fn word(f: FixedTo) -> &'static str {
    match f {
        FixedTo::Base => "base",
        FixedTo::Platform => "platform",
    }
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
            fixed_to: word(l.fixed_to),
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
            Self { name: &k.name, fixed_to: word(k.fixed_to), block: None, sphere: None, capsule: None };
        match k.shape {
            Shape::Box { center, size } => {
                out.block = Some(BoxTable { center: point(center), size: vector(size) });
            }
            Shape::Sphere { center, diameter } => {
                out.sphere = Some(SphereTable { center: point(center), diameter });
            }
            Shape::Capsule { from, to, diameter } => {
                out.capsule = Some(CapsuleTable { from: point(from), to: point(to), diameter });
            }
        }
        out
    }
}
