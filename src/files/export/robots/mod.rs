//! Models of robots for Gazebo (SDF) and ROS (URDF): six legs of universal joint, slide and ball joint. SDF closes the
//! loops, URDF cannot.
//!
//! Each link has one frame. The frame of a cylinder has its origin in the base joint and its third axis along the leg.
//! The frame of a rod has its origin in the platform joint and the same axes. Base and platform have the frames of the
//! design.

pub(super) mod sdf;
pub(super) mod urdf;

use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use super::masses::{ModelMasses, Solid};
use super::model::{frame_along, seen_from};
use super::text::xml_comment;
use super::{Export, ExportBody, ExportLeg, Unsupported};
use platform::geom::Pose;

/// Colours of base, platform, cylinders and rods.
const BASE_COLOUR: &str = "0.45 0.45 0.48 1";
const PLATFORM_COLOUR: &str = "0.16 0.42 0.66 1";
const CYLINDER_COLOUR: &str = "0.25 0.25 0.28 1";
const ROD_COLOUR: &str = "0.75 0.75 0.78 1";

/// Range of a slide in each direction, as a share of the length at home, if the design does not limit the lengths.
const REACH: f64 = 0.5;

/// A visible shape, metres, in the frame of its link.
struct Shape {
    kind: ShapeKind,
    at: Pose,
    colour: &'static str,
}

enum ShapeKind {
    Sphere {
        radius: f64,
    },
    /// A cylinder along the third axis with the origin in its middle.
    Cylinder {
        radius: f64,
        length: f64,
    },
}

/// A link with its frame at home in the base frame, metres.
struct RobotLink {
    name: String,
    at: Pose,
    mass: Solid,
    shapes: Vec<Shape>,
}

/// A leg of the robot.
struct RobotLeg {
    number: usize,
    cylinder: RobotLink,
    rod: RobotLink,
    /// Least and greatest displacement of the slide from home, metres.
    range: [f64; 2],
}

/// The machine at home, metres and kilograms.
struct Robot {
    base: RobotLink,
    platform: RobotLink,
    legs: Vec<RobotLeg>,
    /// Greatest force of a drive, newtons; `None` if the design does not limit it.
    effort: Option<f64>,
    /// Whether gravity acts on the links.
    weighs: bool,
    /// Mass and inertia, close to zero, of links without material.
    nothing: Solid,
    heading: String,
}

impl Robot {
    fn of(export: &Export, text: &str) -> Result<Self, Unsupported> {
        let (metres, masses) = (export.unit.metres, ModelMasses::of(export));
        let [base, platform] = &export.bodies;
        let legs =
            export.legs.iter().map(|leg| RobotLeg::of(export, &masses, leg)).collect::<Result<_, _>>()?;
        let origin = Pose::identity();
        let home = Pose { rotation: export.home.rotation, position: export.home.position * metres };
        let mut heading = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!--\n");
        for line in export.heading("m") {
            let _ = writeln!(heading, "  {}", xml_comment(&line));
        }
        let _ = writeln!(
            heading,
            "  Kilograms, newtons, seconds, radians. All joints are zero at home.\n  Masses: {}.\n  {text}\n-->",
            xml_comment(&masses.words(export))
        );
        Ok(Self {
            // the base does not move: its mass is that of the platform
            base: RobotLink {
                name: "base".into(),
                at: origin,
                mass: masses.platform(),
                shapes: plate(base, metres, BASE_COLOUR),
            },
            platform: RobotLink {
                name: "platform".into(),
                at: home,
                mass: masses.platform(),
                shapes: plate(platform, metres, PLATFORM_COLOUR),
            },
            legs,
            effort: export.greatest_force,
            weighs: !export.gravity_compensation,
            nothing: masses.nothing(),
            heading,
        })
    }
}

impl RobotLeg {
    fn of(export: &Export, masses: &ModelMasses, leg: &ExportLeg) -> Result<Self, Unsupported> {
        let (metres, direction, length) = (export.unit.metres, leg.direction()?, leg.length());
        let (thick, thin) = leg.diameters;
        let foot = frame_along(&direction, leg.foot.coords * metres);
        let head = Pose { rotation: foot.rotation, position: leg.head.coords * metres };
        // from `from` to `to` along the leg, measured from the origin of the link
        let tube = |from: f64, to: f64, diameter: f64, colour: &'static str| Shape {
            kind: ShapeKind::Cylinder { radius: 0.5 * diameter * metres, length: (to - from) * metres },
            at: Pose::shifted(Vector3::new(0.0, 0.0, 0.5 * (from + to) * metres)),
            colour,
        };
        let cylinder = leg.cylinder.min(length);
        let shown = (0.5 * length).min(length - cylinder).max(0.1 * length);
        let range = export.leg_range.map_or([-REACH * length, REACH * length], |(least, greatest)| {
            [least - length, greatest - length]
        });
        let number = leg.number;
        Ok(Self {
            number,
            cylinder: RobotLink {
                name: format!("cylinder{number}"),
                at: foot,
                mass: masses.cylinder(),
                shapes: vec![tube(0.0, cylinder, thick, CYLINDER_COLOUR)],
            },
            rod: RobotLink {
                name: format!("rod{number}"),
                at: head,
                mass: masses.rod(0.0),
                shapes: vec![tube(-shown, 0.0, thin, ROD_COLOUR)],
            },
            range: range.map(|x| x * metres),
        })
    }
}

/// Balls for the joints of a body, and bars along their hull.
fn plate(body: &ExportBody, metres: f64, colour: &'static str) -> Vec<Shape> {
    let radius = 0.5 * body.ball_diameter * metres;
    let mut shapes: Vec<Shape> = body
        .joints
        .iter()
        .map(|joint| Shape {
            kind: ShapeKind::Sphere { radius },
            at: Pose::shifted(joint.at.coords * metres),
            colour,
        })
        .collect();
    let Ok(plate) = body.plate() else { return shapes };
    let corners: Vec<Vector3<f64>> = plate
        .outline
        .hull
        .iter()
        .map(|p| plate.to_body(&Point3::new(p.x, p.y, 0.5 * plate.thickness)).coords * metres)
        .collect();
    for (i, p) in corners.iter().enumerate() {
        let q = &corners[(i + 1) % corners.len()];
        if let Some(direction) = (q - p).try_normalize(0.0) {
            let kind = ShapeKind::Cylinder { radius: 0.5 * radius, length: (q - p).norm() };
            shapes.push(Shape { kind, at: frame_along(&direction, 0.5 * (p + q)), colour });
        }
    }
    shapes
}

/// Roll, pitch and yaw about the fixed axes x, y, z, radians.
fn angles(pose: &Pose) -> [f64; 3] {
    pose.angles().radians()
}

/// The six different moments of inertia with their names.
fn moments(solid: &Solid) -> [(&'static str, f64); 6] {
    let i = &solid.inertia;
    [
        ("ixx", i[(0, 0)]),
        ("ixy", i[(0, 1)]),
        ("ixz", i[(0, 2)]),
        ("iyy", i[(1, 1)]),
        ("iyz", i[(1, 2)]),
        ("izz", i[(2, 2)]),
    ]
}
