//! `[hardware]`.

use serde::Serialize;

use crate::manipulator::Body;
use crate::requirements::{Hardware, Housing, JointAxes, LegPart, LengthLimits, UniversalJoint};

/// A diameter, or three edge lengths.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum HousingValue {
    Diameter(f64),
    Edges([f64; 3]),
}

/// A word, or six vectors.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum AxesValue {
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

pub(super) fn housing(h: Housing) -> HousingValue {
    match h {
        Housing::Sphere(diameter) => HousingValue::Diameter(diameter),
        Housing::Box(edges) => HousingValue::Edges(edges.into()),
    }
}

/// The default is left out.
/// `base_joint` and `platform_joint`.
#[derive(Serialize)]
pub(super) struct JointTable {
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
pub(super) enum FirstAxisValue {
    One([f64; 3]),
    Six([[f64; 3]; 6]),
}

/// Balls are left out.
pub(super) fn joint(universal: Option<&UniversalJoint>, bending: Option<f64>) -> Option<JointTable> {
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

pub(super) fn axes(axes: JointAxes) -> Option<AxesValue> {
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
