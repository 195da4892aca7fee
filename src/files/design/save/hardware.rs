//! `[hardware]`.

use serde::Serialize;

use machine::requirements::{Hardware, Housing, JointAxes, JointType, LegPart, LengthLimits};
use platform::manipulator::Body;

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
    base_joint: Option<JointTables>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform_joint: Option<JointTables>,
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
    housing: Option<HousingValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    swing_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bending_stiffness: Option<f64>,
}

/// One table for all joints of a body, or six in leg order.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum JointTables {
    One(Box<JointTable>),
    Six(Box<[JointTable; 6]>),
}

/// One direction for all joints, or six.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum FirstAxisValue {
    One([f64; 3]),
    Six([[f64; 3]; 6]),
}

/// The joints of a body; nothing where all are balls with one limit and the housing of the body.
pub(super) fn joints(h: &Hardware, body: Body) -> Option<JointTables> {
    let (universal, bending) = (h.universal(body), body.of((h.base_bending, h.platform_bending)));
    let swing = body.of((h.base_swing, h.platform_swing));
    let housings = body.of((h.base_joint_housing, h.platform_joint_housing));
    let kinds: [JointType; 6] = std::array::from_fn(|leg| h.joint_kind(body, leg));
    let limits =
        universal.map_or([None; 6], |joint| joint.limits_deg.map(|l| l.map(|l| l.map(f64::to_bits))));
    let is_alike = kinds.iter().all(|k| *k == kinds[0])
        && bending.iter().all(|k| k.map(f64::to_bits) == bending[0].map(f64::to_bits))
        && limits.iter().all(|l| *l == limits[0])
        && housings.iter().all(|h| *h == housings[0])
        && swing.is_none_or(|s| s.common_deg().is_some());
    // the limit of all legs stands beside the table
    let own_swing = |leg: usize| swing.filter(|s| s.common_deg().is_none()).map(|s| s.limits_deg[leg]);
    let table = |leg: usize, first_axis: Option<FirstAxisValue>| {
        let joint = universal.filter(|_| kinds[leg] == JointType::Universal);
        JointTable {
            model: kinds[leg].name(),
            first_axis,
            angle_deg: joint.and_then(|j| j.limits_deg[leg]),
            offset: joint.map(|j| j.offset).filter(|x| *x != 0.0),
            housing: housings[leg].map(housing),
            swing_deg: own_swing(leg).filter(|deg| *deg < 180.0),
            bending_stiffness: bending[leg],
        }
    };
    let first = |leg: usize| universal?.first_axes[leg].map(|a| <[f64; 3]>::from(a.into_inner()));
    if !is_alike {
        let six = |leg: usize| table(leg, first(leg).map(FirstAxisValue::One));
        return Some(JointTables::Six(Box::new(std::array::from_fn(six))));
    }
    if kinds[0] == JointType::Ball && housings[0].is_none() {
        return None;
    }
    let all: [Option<[f64; 3]>; 6] = std::array::from_fn(first);
    let bits = |a: &Option<[f64; 3]>| a.map(|a| a.map(f64::to_bits));
    let value = if all.iter().all(|a| bits(a) == bits(&all[0])) {
        all[0].map(FirstAxisValue::One)
    } else {
        all.iter()
            .copied()
            .collect::<Option<Vec<_>>>()
            .and_then(|six| six.try_into().ok())
            .map(FirstAxisValue::Six)
    };
    Some(JointTables::One(Box::new(table(0, value))))
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
            base_swing_deg: h.base_swing.and_then(|s| s.common_deg()),
            platform_swing_deg: h.platform_swing.and_then(|s| s.common_deg()),
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
            base_joint: joints(h, Body::Base),
            platform_joint: joints(h, Body::Platform),
        })
    }
}
