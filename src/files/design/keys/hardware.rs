//! `[hardware]`: sizes and limits of joints, legs and drives.

use nalgebra::{Unit, Vector3};
use serde_json::{Value as Json, json};

use super::found::numbers;
use super::joint_models::{self, JOINT_MODELS, JointModel};
use super::kind::{EDGES, KeyForm, KeyKind, Range, angle, any, list_of, not_negative, own, positive, unit};
use super::stored::{Stored, StoredValue};
use super::{Code, FoundKey, KeyTable, TEXT, key};
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{
    ConeLimits, Hardware, Housing, JointAxes, LegBody, LegMasses, LegPart, LengthLimits,
};
use platform::manipulator::Body;

/// The table, as it is written.
#[derive(Default)]
pub(super) struct HardwareKeys {
    hardware: Hardware,
    leg_length: Option<[f64; 2]>,
    dead_length: Option<f64>,
    stroke: Option<f64>,
    base_cone_angle_deg: Option<f64>,
    platform_cone_angle_deg: Option<f64>,
    base_axes: Option<JointAxes>,
    platform_axes: Option<JointAxes>,
    base_joint: JointModel,
    platform_joint: JointModel,
    cylinder: PartKeys,
    rod: PartKeys,
    reflected_mass: Option<f64>,
    drives: Option<String>,
}

/// Mass, centre and inertia of a part of a leg.
#[derive(Default)]
struct PartKeys {
    mass: Option<f64>,
    center: Option<f64>,
    inertia: Option<f64>,
}

/// A diameter, or the edges of a box.
pub(super) const HOUSING: KeyKind = own(r##"{"$ref": "#/$defs/housing"}"##, unit::LENGTH);
const AXES: KeyKind = own(r##"{"$ref": "#/$defs/axes"}"##, unit::NONE);

pub(super) static HARDWARE: KeyTable<HardwareKeys> = KeyTable {
    keys: &[
        key!("joint_diameter": positive(unit::LENGTH), hardware.joint_diameter;
            "diameter of the sphere that a joint occupies, both bodies"),
        key!("base_housing": HOUSING, hardware.base_housing;
            "space of a base joint: a diameter, or edge lengths of a box along the axes of the body"),
        key!("platform_housing": HOUSING, hardware.platform_housing; "space of a platform joint, as `base_housing`"),
        key!("leg_diameter": positive(unit::LENGTH),
            |found, to| to.hardware.leg_body = found.number().map(|diameter| LegBody { diameter, rod: None }),
            |of| of.hardware.leg_body?.diameter.written();
            "diameter of the leg; with `cylinder_length` and `rod_diameter`, diameter of its cylinder, which starts at the base joint"),
        key!("rod_diameter" { needs = &["cylinder_length", "leg_diameter"] }: positive(unit::LENGTH),
            |found, to| {
                let diameter = found.number();
                if let Some(body) = &mut to.hardware.leg_body {
                    body.rod = diameter.map(|diameter| (0.0, diameter));
                }
            },
            |of| of.hardware.leg_body?.rod?.1.written();
            "diameter of the rod"),
        key!("cylinder_length" { needs = &["rod_diameter"] }: positive(unit::LENGTH),
            |found, to| {
                let length = found.number().unwrap_or_default();
                if let Some(rod) = to.hardware.leg_body.as_mut().and_then(|body| body.rod.as_mut()) {
                    rod.0 = length;
                }
            },
            |of| of.hardware.leg_body?.rod?.0.written();
            "length of the cylinder"),
        key!("leg_clearance" { default = "0", needs = &["leg_diameter"] }: not_negative(unit::LENGTH), hardware.leg_clearance;
            "least gap between legs, and between legs and keep-outs"),
        key!("leg_length": list_of(2, &not_negative(unit::LENGTH)),
            |found, to| to.leg_length = leg_length(found), |of| of.leg_length.written();
            "`[least, greatest]` length of a leg"),
        key!("dead_length" { needs = &["stroke"] }: not_negative(unit::LENGTH), dead_length;
            "with `stroke` instead of `leg_length`: lengths from `dead_length` + `stroke` to `dead_length` + 2 `stroke`"),
        key!("stroke" { needs = &["dead_length"] }: positive(unit::LENGTH), stroke;
            "travel of a leg, with `dead_length`"),
        key!("base_cone_angle_deg" { old = "base_swing_deg" }: angle(Range::HalfTurn), base_cone_angle_deg;
            "greatest angle between a leg and the axis of its base joint"),
        key!("platform_cone_angle_deg" { old = "platform_swing_deg" }: angle(Range::HalfTurn), platform_cone_angle_deg;
            "greatest angle between a leg and the axis of its platform joint"),
        key!("base_axes" { default = r#""home""# }: AXES,
            |found, to| to.base_axes = joint_axes(found), |of| axes_json(of.base_axes?);
            "directions of the joint axes: along the legs at home, along the normal of the plane of the joints, chosen by the optimiser, or vectors in the frame of the base that point from base to platform: one for all joints, or six in leg order, each a vector or `normal`"),
        key!("platform_axes" { default = r#""home""# }: AXES,
            |found, to| to.platform_axes = joint_axes(found), |of| axes_json(of.platform_axes?);
            "directions of the joint axes of the platform, as `base_axes`, platform frame"),
        key!("base_joint": JOINT_MODELS,
            |found, to| to.base_joint = joint_models::models(found).unwrap_or_default(),
            |of| joint_models::written(&of.hardware, Body::Base);
            "kinds of the base joints: one table for all, or six in leg order; ball joints when absent"),
        key!("platform_joint": JOINT_MODELS,
            |found, to| to.platform_joint = joint_models::models(found).unwrap_or_default(),
            |of| joint_models::written(&of.hardware, Body::Platform);
            "kinds of the platform joints, as `base_joint`"),
        key!("screw_lead" { default = "0" }: any(unit::LENGTH), hardware.screw_lead;
            "growth of a leg when its platform end makes one turn against its base end, right-handed about the direction from base to platform; needs universal joints at both ends"),
        key!("max_leg_force": positive(unit::FORCE), hardware.max_leg_force;
            "greatest push or pull of a leg under each of the loads, force units"),
        key!("max_leg_speed": positive(unit::SPEED), hardware.max_leg_speed;
            "greatest speed of a leg under `[speed]`, design units per second"),
        key!("leg_stiffness": positive(unit::STIFFNESS), hardware.leg_stiffness;
            "stiffness of a leg along its line, force units per design unit"),
        key!("cylinder_mass" { needs = &["cylinder_center"] }: positive(unit::MASS), cylinder.mass;
            "mass of the part that rotates about the base joint, mass units"),
        key!("cylinder_center" { needs = &["cylinder_mass"] }: not_negative(unit::LENGTH), cylinder.center;
            "distance of the cylinder's centre of mass from the base joint"),
        key!("cylinder_inertia" { needs = &["cylinder_mass"] }: not_negative(unit::INERTIA), cylinder.inertia;
            "moment of inertia of the cylinder about an axis across the leg through its centre of mass, mass units times length units squared; default: a thin rod from the joint with this centre, `m c^2 / 3`"),
        key!("rod_mass" { needs = &["rod_center"] }: positive(unit::MASS), rod.mass;
            "mass of the part that slides in the cylinder, mass units"),
        key!("rod_center" { needs = &["rod_mass"] }: not_negative(unit::LENGTH), rod.center;
            "distance of the rod's centre of mass from the platform joint"),
        key!("rod_inertia" { needs = &["rod_mass"] }: not_negative(unit::INERTIA), rod.inertia;
            "moment of inertia of the rod, as `cylinder_inertia`"),
        key!("reflected_mass": positive(unit::MASS), reflected_mass;
            "inertia of the rotating parts of the drive, as a mass that moves along the leg"),
        key!("drives": TEXT, drives;
            "table of drives (CSV), a path relative to the folder of the design, from which one is chosen: `optimize` and `explore` do so as with `--drives`, `assess` and `compare` name the lightest that suffices"),
    ],
    rules: r#"{
        "dependentSchemas": {
            "screw_lead": {"required": ["base_joint", "platform_joint"]},
            "base_axes": {"anyOf": [{"required": ["base_cone_angle_deg"]}, {"required": ["base_joint"]}]},
            "platform_axes": {"anyOf": [{"required": ["platform_cone_angle_deg"]}, {"required": ["platform_joint"]}]}
        },
        "not": {"required": ["leg_length", "stroke"]}
    }"#,
    ..KeyTable::EMPTY
};

/// `[hardware]`, and the name of the table of drives, which is read when a drive is chosen.
pub(super) fn hardware(report: &mut Findings<'_>, top: &[Entry]) -> (Hardware, Option<String>) {
    let mut keys = HardwareKeys::default();
    let entries = find(top, "hardware").and_then(|e| HARDWARE.read(report, &e.node, "[hardware]", &mut keys));
    let entries = entries.unwrap_or_default();
    let axes = [keys.base_axes, keys.platform_axes];
    let joints = [keys.base_joint, keys.platform_joint];
    let [base, platform] = Body::BOTH.map(|body| {
        joint_models::with_axes(report, entries, body, (joints[body.index()], axes[body.index()]))
    });
    if keys.hardware.screw_lead.is_some() {
        joint_models::check_screw_lead(report, entries, [&base, &platform]);
    }
    if let (Some(entry), Some(_)) = (find(entries, "leg_length"), keys.stroke) {
        let help = "keep `leg_length`, or `dead_length` with `stroke`";
        report.refuse(Code::ConflictingKeys, &entry.key_span, "leg lengths are limited twice", help);
    }
    let travel = || Some(LengthLimits::Stroke { dead: keys.dead_length?, stroke: keys.stroke? });
    let cone_angle = |of_body: Option<f64>, axes: Option<JointAxes>, own: [Option<f64>; 6]| {
        let is_limited = of_body.is_some() || own.iter().any(Option::is_some);
        let limits_deg = own.map(|deg| deg.or(of_body).unwrap_or(180.0));
        is_limited.then(|| ConeLimits { limits_deg, axes: axes.unwrap_or_default() })
    };
    let hardware = Hardware {
        leg_length: keys.leg_length.map(|[least, most]| LengthLimits::Range(least, most)).or_else(travel),
        base_cone_angle: cone_angle(keys.base_cone_angle_deg, keys.base_axes, base.cone_angle_deg),
        platform_cone_angle: cone_angle(
            keys.platform_cone_angle_deg,
            keys.platform_axes,
            platform.cone_angle_deg,
        ),
        base_joint_housing: base.housing,
        platform_joint_housing: platform.housing,
        base_universal: base.universal,
        platform_universal: platform.universal,
        base_bending: base.bending,
        platform_bending: platform.bending,
        leg_masses: keys.leg_masses(),
        ..keys.hardware
    };
    (hardware, keys.drives)
}

impl HardwareKeys {
    /// The table as written, without entries that the file leaves out.
    pub(super) fn of(h: &Hardware, drives: Option<&String>) -> Self {
        let (mut leg_length, mut dead_length, mut stroke_length) = (None, None, None);
        match h.leg_length {
            Some(LengthLimits::Range(least, greatest)) => leg_length = Some([least, greatest]),
            Some(LengthLimits::Stroke { dead, stroke }) => {
                (dead_length, stroke_length) = (Some(dead), Some(stroke));
            }
            None => {}
        }
        let part = |part: fn(&LegMasses) -> LegPart| {
            let part = h.leg_masses.as_ref().map(part).filter(|part| part.mass > 0.0);
            PartKeys {
                mass: part.map(|p| p.mass),
                center: part.map(|p| p.center),
                inertia: part.map(|p| p.inertia),
            }
        };
        Self {
            hardware: *h,
            leg_length,
            dead_length,
            stroke: stroke_length,
            base_cone_angle_deg: h.base_cone_angle.and_then(|s| s.common_deg()),
            platform_cone_angle_deg: h.platform_cone_angle.and_then(|s| s.common_deg()),
            base_axes: h.axes(Body::Base),
            platform_axes: h.axes(Body::Platform),
            base_joint: JointModel::default(),
            platform_joint: JointModel::default(),
            cylinder: part(|m| m.cylinder),
            rod: part(|m| m.rod),
            reflected_mass: h.leg_masses.map(|m| m.reflected).filter(|x| *x > 0.0),
            drives: drives.cloned(),
        }
    }

    fn leg_masses(&self) -> Option<LegMasses> {
        let part = |part: &PartKeys| {
            let (mass, center) = (part.mass?, part.center.unwrap_or_default());
            let inertia = part.inertia.unwrap_or_else(|| LegPart::uniform_inertia(mass, center));
            Some(LegPart { mass, center, inertia })
        };
        let (cylinder, rod, reflected) = (part(&self.cylinder), part(&self.rod), self.reflected_mass);
        (cylinder.is_some() || rod.is_some() || reflected.is_some()).then(|| LegMasses {
            cylinder: cylinder.unwrap_or_default(),
            rod: rod.unwrap_or_default(),
            reflected: reflected.unwrap_or_default(),
        })
    }
}

impl StoredValue for Housing {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        if found.is_list() {
            found.kind.form = KeyForm::Numbers(&EDGES);
            return Vector3::take(found).map(Self::Box);
        }
        found.kind.form = KeyForm::Number(Range::Positive);
        found.number().map(Self::Sphere)
    }

    fn json(&self) -> Json {
        match self {
            Self::Sphere(diameter) => diameter.json(),
            Self::Box(edges) => edges.json(),
        }
    }
}

fn leg_length(found: &mut FoundKey<'_, '_>) -> Option<[f64; 2]> {
    let (node, noun) = (&found.entry.node, "lengths, least and greatest");
    let [least, greatest] = numbers::<2>(found.report, node, "`leg_length`", Code::CoordinateCount, noun)?;
    if !(least >= 0.0 && greatest > least) {
        let help = "give [least, greatest] with 0 <= least < greatest";
        found.refuse(Code::OutOfRange, format!("`leg_length` is [{least}, {greatest}]"), help);
    }
    Some([least, greatest])
}

/// The word for the normal of the plane of the joints.
const NORMAL: &str = "normal";
/// Placeholder for a normal until the joints are known.
const NOT_YET: Unit<Vector3<f64>> = Unit::new_unchecked(Vector3::new(0.0, 0.0, 1.0));

/// Whether an axis is the normal of the plane of the joints.
pub(super) fn is_normal(node: &Node) -> bool {
    matches!(&node.value, Value::Text(t) if t == NORMAL)
}

/// The axes of a key. Normals are filled in once the joints are known ([`super::axes::turn_to_normals`]).
fn joint_axes(found: &mut FoundKey<'_, '_>) -> Option<JointAxes> {
    let (report, entry) = (&mut *found.report, found.entry);
    match &entry.node.value {
        Value::Text(t) if t == "home" => Some(JointAxes::Home),
        Value::Text(t) if t == "optimize" => Some(JointAxes::Optimize),
        Value::Text(t) if t == NORMAL => Some(JointAxes::Given([NOT_YET; 6])),
        Value::Array(list) if list.iter().all(|node| matches!(node.value, Value::Number(_))) => {
            axis(report, &entry.node, &entry.key).map(|axis| JointAxes::Given([axis; 6]))
        }
        Value::Array(list) if list.len() == 6 => {
            let one =
                |node: &Node| if is_normal(node) { Some(NOT_YET) } else { axis(report, node, &entry.key) };
            let axes: Vec<_> = list.iter().map(one).collect();
            let axes: Vec<_> = axes.into_iter().collect::<Option<_>>()?;
            axes.try_into().ok().map(JointAxes::Given)
        }
        _ => {
            let help = "write \"home\", \"normal\", \"optimize\", one vector for all joints, or six in leg order, each a vector or \"normal\"";
            found.refused(Code::WrongType, format!("`{}` is not a choice of axes", entry.key), help)
        }
    }
}

/// The default is omitted.
fn axes_json(axes: JointAxes) -> Option<Json> {
    match axes {
        JointAxes::Home => None,
        JointAxes::Optimize => Some(json!("optimize")),
        JointAxes::Given(axes) => Some(axes.iter().map(|axis| axis.into_inner().json()).collect()),
    }
}

/// A direction.
pub(super) fn axis(report: &mut Findings<'_>, node: &Node, key: &str) -> Option<Unit<Vector3<f64>>> {
    let what = format!("an axis of `{key}`");
    let v = numbers::<3>(report, node, &what, Code::CoordinateCount, "components").map(Vector3::from)?;
    // unit vectors keep their bits, so that a saved design reads back equal
    let unit = if (v.norm_squared() - 1.0).abs() < 1e-15 {
        Some(Unit::new_unchecked(v))
    } else {
        Unit::try_new(v, 0.0)
    };
    if unit.is_none() {
        report.refuse(Code::NotPositive, &node.span, format!("{what} is zero"), "give a direction");
    }
    unit
}
