//! Sizes of plates, joints and legs: chosen, from `[hardware]`, or by rule.

use nalgebra::{Point3, Vector3};
use thiserror::Error;

use super::model::ExportedJoint;
use super::telescope::fits;
use super::units::{LengthUnit, UnknownUnit};
use crate::design::DesignModel;
use machine::requirements::{Hardware, MovingBodies, PlateDesign, seat_height};
use platform::manipulator::Body;

/// Choices of the user; lengths in design units. Absent sizes come from `[hardware]` or from a rule;
/// [`Export::choices`](super::Export::choices) lists them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct ExportOptions {
    /// The length of a design unit, if the label does not give it.
    pub unit: Option<LengthUnit>,
    /// Thickness of the plates.
    pub thickness: Option<f64>,
    /// Distance of the outline of a plate from the hull of its joints.
    pub margin: Option<f64>,
    /// Diameter of the holes in the plates.
    pub hole: Option<f64>,
    /// Diameter of the tolerance circle for the centre of each hole.
    pub hole_places: Option<f64>,
    /// Diameter of the balls of the joints.
    pub ball: Option<f64>,
    /// Mass of the platform with its payload, kilograms.
    pub mass: Option<f64>,
    /// Whether simulators compensate the weight of all bodies.
    pub gravity_compensation: bool,
}

impl ExportOptions {
    /// The defaults: every size from `[hardware]` or by rule.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    num::setters! {
        /// The length of a design unit.
        fn unit(unit: LengthUnit) = Some(unit);
        /// Thickness of the plates, design units.
        fn thickness(thickness: f64) = Some(thickness);
        /// Distance of the outline of a plate from the hull of its joints, design units.
        fn margin(margin: f64) = Some(margin);
        /// Diameter of the holes in the plates, design units.
        fn hole(hole: f64) = Some(hole);
        /// Diameter of the tolerance circle for the centre of each hole, design units: twice the radius from
        /// `build tolerances` for all joints.
        fn hole_places(diameter: f64) = Some(diameter);
        /// Diameter of the balls of the joints, design units.
        fn ball(ball: f64) = Some(ball);
        /// Mass of the platform with its payload, kilograms.
        fn mass(mass: f64) = Some(mass);
        /// Whether simulators compensate the weight of all bodies.
        fn gravity_compensation(on: bool) = on;
    }
}

/// Sizes of the joints and the plate of a body, design units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sizes {
    pub(super) ball: f64,
    pub(super) hole: f64,
    pub(super) thickness: f64,
    pub(super) margin: f64,
    /// Height of the lowest joint centre above the face.
    pub(super) height: f64,
}

/// Sizes of the bodies of the legs, design units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LegSizes {
    pub(super) cylinder_diameter: f64,
    pub(super) rod_diameter: f64,
    pub(super) cylinder_length: f64,
}

/// A size and its source.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
#[schemars(rename = "SizeRecord", transform = num::nullable)]
pub struct SizeChoice {
    /// Part and dimension.
    pub what: String,
    /// Its value in `unit`.
    pub value: f64,
    /// Design units, or kilograms.
    pub unit: &'static str,
    /// Origin: option, table or rule.
    pub from: &'static str,
}

/// Reasons why there is nothing to export.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoExport {
    /// The unit of the design is not a length unit.
    #[error(transparent)]
    Unit(#[from] UnknownUnit),
    /// The legs are rods on cranks that cannot hold the home pose, or that form no platform.
    #[error("{0}")]
    Cranks(String),
    /// Joints with offsets that cannot hold the home pose.
    #[error("{0}")]
    Joints(String),
    /// A size that allows no valid part.
    #[error("{what} is {value}: {why}")]
    BadSize {
        /// The part with this size.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The fault of the value.
        why: &'static str,
    },
}

/// The table for sizes of plates.
const PLATES: &str = "[plates]";

const RULE_CYLINDER: &str = "rule: half the shortest leg at home";
const RULE_STROKE: &str = "rule: long enough to hold the rod over the stroke, short enough to clear the platform joint at the least length";

const RULE_BALL: &str =
    "rule: minimum of 0.05 of the size, 0.4 of the least distance of joints, 0.1 of the shortest leg at home";

/// Edge of the housing as a ball diameter; with different housings, the ball that fits into each.
fn housing_width(hardware: &Hardware, body: Body) -> Option<f64> {
    hardware.joint_widths(body).map(|[least, _]| least)
}

/// Least distance between the axes of two seats, lines along `normal` through the joints; coincident axes are ignored.
pub(super) fn least_distance(joints: &[ExportedJoint], normal: &Vector3<f64>, size: f64) -> f64 {
    let apart = |a: &Point3<f64>, b: &Point3<f64>| {
        let d = b - a;
        (d - normal * normal.dot(&d)).norm()
    };
    let pairs = joints.iter().enumerate();
    let pairs = pairs.flat_map(|(i, a)| joints[i + 1..].iter().map(move |b| apart(&a.at, &b.at)));
    pairs.filter(|d| *d > 1e-9 * size).fold(f64::INFINITY, f64::min)
}

/// The first available value, with its source, noted in `choices`.
fn choose<const N: usize>(
    choices: &mut Vec<SizeChoice>,
    what: &str,
    candidates: [(Option<f64>, &'static str); N],
    rule: (f64, &'static str),
) -> f64 {
    let given = candidates.into_iter().find_map(|(value, from)| value.map(|v| (v, from)));
    let (value, from) = given.unwrap_or(rule);
    choices.push(SizeChoice { what: what.to_string(), value, unit: "design units", from });
    value
}

pub(super) fn positive(what: &'static str, value: f64) -> Result<(), NoExport> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(NoExport::BadSize { what, value, why: "it has to be positive and finite" })
}

impl Sizes {
    pub(super) fn of(
        body: Body,
        (hardware, plate): (&Hardware, Option<&PlateDesign>),
        options: &ExportOptions,
        rule_ball: f64,
        choices: &mut Vec<SizeChoice>,
    ) -> Result<Self, NoExport> {
        let ball = choose(
            choices,
            &format!("ball diameter, {body}"),
            [(options.ball, "option"), (housing_width(hardware, body), "[hardware]")],
            (rule_ball, RULE_BALL),
        );
        let hole = choose(
            choices,
            &format!("hole diameter, {body}"),
            [(options.hole, "option"), (plate.map(|p| p.hole), PLATES)],
            (0.5 * ball, "rule: half a ball"),
        );
        let thickness = choose(
            choices,
            &format!("plate thickness, {body}"),
            [(options.thickness, "option"), (plate.map(|p| p.thickness), PLATES)],
            (0.5 * ball, "rule: half a ball"),
        );
        let margin = choose(
            choices,
            &format!("plate margin, {body}"),
            [(options.margin, "option"), (plate.map(|p| p.margin), PLATES)],
            (ball, "rule: one ball"),
        );
        for (what, value) in
            [("the ball", ball), ("the hole", hole), ("the thickness", thickness), ("the margin", margin)]
        {
            positive(what, value)?;
        }
        let stated = plate.and_then(|p| p.height);
        if hole >= ball && stated.is_none() {
            let why = "a ball has to be wider than the hole below it";
            return Err(NoExport::BadSize { what: "the hole", value: hole, why });
        }
        if 2.0 * margin <= hole {
            let why = "a hole has to lie inside the outline: the margin has to exceed half its diameter";
            return Err(NoExport::BadSize { what: "the margin", value: margin, why });
        }
        if let Some(height) = stated {
            let _ = choose(
                choices,
                &format!("height of the joints, {body}"),
                [(Some(height), PLATES)],
                (height, PLATES),
            );
        }
        let height = stated.unwrap_or_else(|| seat_height(ball, hole));
        Ok(Self { ball, hole, thickness, margin, height })
    }
}

impl LegSizes {
    pub(super) fn of(
        hardware: &Hardware,
        [base_ball, platform_ball]: [f64; 2],
        shortest: f64,
        choices: &mut Vec<SizeChoice>,
    ) -> Self {
        let body = hardware.leg_body;
        let smaller_ball = base_ball.min(platform_ball);
        let cylinder_diameter = choose(
            choices,
            "cylinder diameter",
            [(body.map(|b| b.diameter), "[hardware]")],
            (0.6 * smaller_ball, "rule: 0.6 of the smaller ball"),
        );
        let rod_diameter = choose(
            choices,
            "rod diameter",
            [(body.and_then(|b| b.rod.map(|r| r.1)), "[hardware]")],
            (0.6 * cylinder_diameter, "rule: 0.6 of the cylinder"),
        );
        let half = 0.5 * shortest;
        let by_rule = hardware.leg_length.map_or(half, |limits| {
            let (least, greatest) = limits.range();
            let (foot, tip) = (0.5 * base_ball, 0.5 * platform_ball);
            // floor, stroke and a guide of two rod diameters; the platform joint must stay outside at the least length
            let deep =
                foot + 0.5 * (cylinder_diameter - rod_diameter) + (greatest - least) + 2.0 * rod_diameter;
            let bounded = half.max(deep).min(least - tip);
            // a machine retracted at home, or with joints nearly as long as its least length, has no space for that
            if fits(foot, bounded, shortest - tip) { bounded } else { half }
        });
        let cylinder_length = choose(
            choices,
            "cylinder length from the base joint",
            [(body.and_then(|b| b.rod.map(|r| r.0)), "[hardware]")],
            (by_rule, if by_rule.total_cmp(&half).is_eq() { RULE_CYLINDER } else { RULE_STROKE }),
        );
        Self { cylinder_diameter, rod_diameter, cylinder_length }
    }
}

/// The moving bodies as in the design. A mass `given` replaces that of the platform, with the same mass distribution if
/// the design has one. Without a mass, Froude scaling applies: with masses as lengths cubed and times as their square
/// roots, platforms of all sizes move alike.
///
/// # Errors
/// [`NoExport::BadSize`].
pub(super) fn moving(
    design: &DesignModel,
    given: Option<f64>,
    metres: f64,
    choices: &mut Vec<SizeChoice>,
) -> Result<MovingBodies, NoExport> {
    let stated = design.moving_bodies(metres);
    let mut moving = stated.unwrap_or_else(|| {
        let mass = 20.0 * (design.manipulator().size() * metres).powi(3);
        design.assumed_bodies(mass, metres)
    });
    let mass = given.unwrap_or(moving.mass);
    positive("the mass", mass)?;
    moving.inertia *= mass / moving.mass;
    moving.mass = mass;
    let from = match (given, stated) {
        (Some(_), _) => "option",
        (None, None) => "rule: 20 kg times the cube of the size in metres",
        (None, Some(_)) if design.payload.is_some() => "[payload]",
        (None, Some(_)) => "[plates.platform]",
    };
    let what = "mass of the platform with payload".to_owned();
    choices.push(SizeChoice { what, value: mass, unit: "kg", from });
    Ok(moving)
}
