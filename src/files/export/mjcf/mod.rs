//! `MuJoCo` model: six legs of universal joint (two hinges) and slide, or of crank and rod, the platform on leg 1,
//! loops closed by `connect`.

mod cranks;
mod swing;

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use super::text::{one_line, real, reals, scaled, xml_comment};
use super::{Export, ExportBody, ExportLeg, ExportedFile, Unsupported, Writer};
use crate::plot::escape;
use machine::requirements::{JointAxes, KeepOutShape};
use platform::geom::Pose;

use self::swing::ConeTendon;
use super::masses::{ModelMasses, Solid};
use super::model::frame_along;

/// The format `mjcf`.
pub(super) static WRITER: Writer = Writer {
    leaves_out: "contacts, friction, limits of speeds and of the angles of universal joints",
    takes_cranks: true,
    ..Writer::new(
        "MuJoCo model in metres and kilograms with six position actuators; Drake and Pinocchio load it too",
        files,
    )
};

fn files(export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
    let text = match &export.cranks {
        Some(made) => cranks::model(export, made)?,
        None => model(export)?,
    };
    Ok(vec![ExportedFile::new("platform.xml", text)])
}

/// Natural frequency of the platform on its actuators times the square root of the size, rad/s. The value is for a
/// platform of 20 kg and 1 m on six legs of 1e5 N/m.
const STIFFNESS: f64 = 173.2;
/// Time step over the square root of the size in metres, seconds.
const STEP: f64 = 1e-3;
/// Colours of base and platform.
const PLATES: [&str; 2] = ["0.45 0.45 0.48 1", "0.16 0.42 0.66 1"];
const CYLINDER: &str = "0.25 0.25 0.28 1";
const ROD: &str = "0.75 0.75 0.78 1";
const GROUND: &str = "0.86 0.87 0.84 1";

/// The basic quantities of all parts, SI units.
#[derive(Debug)]
struct Scale {
    metres: f64,
    size: f64,
    kp: f64,
    kv: f64,
    step: f64,
    gravity: &'static str,
}

impl Scale {
    fn of(export: &Export, masses: &ModelMasses) -> Self {
        let size = export.size * export.unit.metres;
        let omega = STIFFNESS / size.sqrt();
        let kp = export.moving.mass * omega * omega / 6.0;
        Self {
            metres: export.unit.metres,
            size,
            kp,
            // 1.3 of critical damping; twice as much chatters at this time step
            kv: 2.6 * kp / omega,
            step: STEP * size.sqrt() * masses.step,
            gravity: if export.gravity_compensation { " gravcomp=\"1\"" } else { "" },
        }
    }

    fn at(&self, p: &Vector3<f64>) -> String {
        scaled(p, self.metres, " ")
    }
}

/// The frame of a leg at home: third axis along the leg, origin in its base joint.
fn leg_frame(leg: &ExportLeg) -> Result<Pose, Unsupported> {
    Ok(frame_along(&leg.direction()?, leg.foot.coords))
}

/// The mass of a body and how it is spread.
fn inertial(solid: &Solid) -> String {
    let (Solid { mass, center, .. }, i) = (solid, &solid.inertia);
    let moments = if [(0, 1), (0, 2), (1, 2)].iter().all(|at| i[*at] == 0.0) {
        format!("diaginertia=\"{}\"", reals([i[(0, 0)], i[(1, 1)], i[(2, 2)]], " "))
    } else {
        let six = [i[(0, 0)], i[(1, 1)], i[(2, 2)], i[(0, 1)], i[(0, 2)], i[(1, 2)]];
        format!("fullinertia=\"{}\"", reals(six, " "))
    };
    format!("<inertial pos=\"{}\" mass=\"{}\" {moments}/>", reals(center.iter().copied(), " "), real(*mass))
}

fn quat(pose: &Pose) -> String {
    reals(pose.quaternion(), " ")
}

/// Draws the plate of a body as bars along the hull of its joints, and the joints as balls.
fn shape(out: &mut String, scale: &Scale, body: &ExportBody, indent: &str) {
    let (radius, colour) = (real(0.25 * body.ball_diameter * scale.metres), PLATES[body.body.index()]);
    for joint in &body.joints {
        let ball = real(0.5 * body.ball_diameter * scale.metres);
        let _ = writeln!(
            out,
            "{indent}<geom type=\"sphere\" size=\"{ball}\" pos=\"{}\" rgba=\"{colour}\"/>",
            scale.at(&joint.at.coords)
        );
    }
    let Ok(plate) = body.plate() else { return };
    let corners = &plate.outline.hull;
    let middle = 0.5 * plate.thickness;
    for (i, p) in corners.iter().enumerate().take(if corners.len() == 1 { 0 } else { corners.len() }) {
        let q = &corners[(i + 1) % corners.len()];
        let [p, q] = [p, q].map(|p| plate.to_body(&Point3::new(p.x, p.y, middle)).coords);
        let _ = writeln!(
            out,
            "{indent}<geom type=\"capsule\" size=\"{radius}\" fromto=\"{} {}\" rgba=\"{colour}\"/>",
            scale.at(&p),
            scale.at(&q)
        );
    }
}

/// The length range relative to home, metres, if the design limits lengths.
fn range_of(export: &Export, leg: &ExportLeg, name: &str) -> String {
    export.leg_range.map_or_else(String::new, |(least, greatest)| {
        let [from, to] = [least, greatest].map(|l| real((l - leg.length()) * export.unit.metres));
        format!(" {name}=\"{from} {to}\"")
    })
}

/// Range of both hinges of the base joint of a leg, radians, if the design limits its cone angle.
///
/// Rotations `a` about the first hinge and `b` about the second move a leg by the angle `t` from home, with
/// `cos t = cos a cos b`. So neither exceeds `t`. A leg within `s` of its joint axis is within `s` plus the angle
/// between axis and leg at home. The hinges therefore allow every position within the cone angle.
fn swing_of(export: &Export, leg: &ExportLeg) -> Result<Option<f64>, Unsupported> {
    let Some(swing) = export.hardware.base_cone_angle else { return Ok(None) };
    let home = leg.direction()?;
    let off = match swing.axes {
        JointAxes::Given(axes) => home.angle(&axes[leg.number - 1]),
        JointAxes::Home | JointAxes::Optimize => 0.0,
    };
    let most = swing.limits_deg[leg.number - 1].to_radians() + off;
    Ok((most < FRAC_PI_2).then_some(most))
}

fn leg(
    out: &mut String,
    (scale, masses): (&Scale, &ModelMasses),
    export: &Export,
    leg: &ExportLeg,
) -> Result<(), Unsupported> {
    // each hinge has a separate body: Drake takes the axis of the first of several joints of a body in the parent frame
    let frame = leg_frame(leg)?;
    let (i, length) = (leg.number, leg.length());
    let (thick, thin) = leg.diameters;
    let range = range_of(export, leg, "range");
    let swing = swing_of(export, leg)?;
    let swing = swing.map_or_else(String::new, |most| format!(" range=\"{} {}\"", real(-most), real(most)));
    let tip = Vector3::new(0.0, 0.0, length);
    let half = 0.5 * length;
    let capsule = |from: f64, to: f64, diameter: f64, colour: &str| {
        let ends = [Vector3::new(0.0, 0.0, from), Vector3::new(0.0, 0.0, to)].map(|p| scale.at(&p));
        format!(
            "<geom type=\"capsule\" size=\"{}\" fromto=\"{} {}\" rgba=\"{colour}\"/>",
            real(0.5 * diameter * scale.metres),
            ends[0],
            ends[1]
        )
    };
    let _ = writeln!(
        out,
        "      <body name=\"yoke{i}\" pos=\"{}\" quat=\"{}\"{}>\n        \
         <joint name=\"swing{i}x\" type=\"hinge\" axis=\"1 0 0\"{swing}/>\n        {}\n        \
         <body name=\"cylinder{i}\"{}>\n          \
         <joint name=\"swing{i}y\" type=\"hinge\" axis=\"0 1 0\"{swing}/>\n          {}\n          {}\n          \
         <body name=\"rod{i}\" pos=\"{}\"{}>\n            \
         <joint name=\"leg{i}\" type=\"slide\" axis=\"0 0 1\" armature=\"{}\"{range}/>\n            {}\n            {}",
        scale.at(&frame.position),
        quat(&frame),
        scale.gravity,
        inertial(&masses.nothing()),
        scale.gravity,
        inertial(&masses.cylinder()),
        capsule(0.0, leg.cylinder.min(length), thick, CYLINDER),
        scale.at(&tip),
        scale.gravity,
        real(masses.armature()),
        inertial(&masses.rod(0.0)),
        capsule(-half.min(length - leg.cylinder.min(length)).max(0.1 * length), 0.0, thin, ROD),
    );
    if let Some(tendon) = ConeTendon::of(export, leg)? {
        tendon.at_rod(out, scale);
    }
    if i == 1 {
        // the platform frame relative to the tip of the leg
        let joint = export.bodies[1].joints[leg.platform].at.coords;
        let turn = frame.rotation.inverse() * export.home.rotation;
        platform(out, (scale, masses), export, leg, &Pose { rotation: turn, position: -(turn * joint) });
    }
    out.push_str("          </body>\n        </body>\n      </body>\n");
    Ok(())
}

/// The platform on a leg, at a pose in the frame of its parent body.
fn platform(
    out: &mut String,
    (scale, masses): (&Scale, &ModelMasses),
    export: &Export,
    leg: &ExportLeg,
    place: &Pose,
) {
    let body = &export.bodies[1];
    let joint = body.joints[leg.platform].at.coords;
    let _ = writeln!(
        out,
        "            <body name=\"platform\" pos=\"{}\" quat=\"{}\"{}>\n              \
         <joint name=\"ball1\" type=\"ball\" pos=\"{}\"/>\n            {}\n              \
         <site name=\"platform_frame\" size=\"{}\"/>",
        scale.at(&place.position),
        quat(place),
        scale.gravity,
        scale.at(&joint),
        inertial(&masses.platform()),
        real(0.01 * scale.size),
    );
    for leg in &export.legs {
        if let Ok(Some(tendon)) = ConeTendon::of(export, leg) {
            tendon.at_platform(out, scale);
        }
    }
    payload(out, scale, export);
    shape(out, scale, body, "              ");
    out.push_str("            </body>\n");
}

/// The shape of the payload, visible but without contact.
fn payload(out: &mut String, scale: &Scale, export: &Export) {
    let half = |x: f64| real(0.5 * x * scale.metres);
    let geom = match export.payload_shape {
        None => return,
        Some(KeepOutShape::Box { center, size }) => format!(
            "type=\"box\" size=\"{} {} {}\" pos=\"{}\"",
            half(size.x),
            half(size.y),
            half(size.z),
            scale.at(&center.coords)
        ),
        Some(KeepOutShape::Sphere { center, diameter }) => {
            format!("type=\"sphere\" size=\"{}\" pos=\"{}\"", half(diameter), scale.at(&center.coords))
        }
        Some(KeepOutShape::Capsule { from, to, diameter }) => format!(
            "type=\"capsule\" size=\"{}\" fromto=\"{} {}\"",
            half(diameter),
            scale.at(&from.coords),
            scale.at(&to.coords)
        ),
    };
    let _ = writeln!(out, "              <geom name=\"payload\" {geom} rgba=\"0.5 0.5 0.5 0.3\"/>");
}

/// Height of the ground, metres: below the lowest joint at home, its ball and its plate. None if gravity is not along
/// the third axis of the base.
fn ground(export: &Export, scale: &Scale) -> Option<f64> {
    let down = export.gravity.x == 0.0 && export.gravity.y == 0.0 && export.gravity.z < 0.0;
    let place = |k: usize, p: &Point3<f64>| if k == 0 { *p } else { export.home.transform(p) };
    let lowest = export.bodies.iter().enumerate().flat_map(|(k, body)| {
        let below = 0.5 * body.ball_diameter + body.plate().map_or(0.0, |plate| plate.thickness);
        body.joints.iter().map(move |joint| place(k, &joint.at).z - below)
    });
    lowest.reduce(f64::min).filter(|_| down).map(|z| z * scale.metres)
}

/// Sensors: position, speed and force of each drive, and pose of the platform frame. `joint` is the name prefix of the
/// drive joints.
fn sensors(out: &mut String, joint: &str) {
    out.push_str("  <sensor>\n");
    for i in 1..=6 {
        let _ = writeln!(
            out,
            "    <jointpos name=\"{joint}{i}_position\" joint=\"{joint}{i}\"/>\n    \
             <jointvel name=\"{joint}{i}_velocity\" joint=\"{joint}{i}\"/>\n    \
             <actuatorfrc name=\"{joint}{i}_effort\" actuator=\"actuator{i}\"/>"
        );
    }
    out.push_str(
        "    <framepos name=\"platform_position\" objtype=\"site\" objname=\"platform_frame\"/>\n    \
         <framequat name=\"platform_orientation\" objtype=\"site\" objname=\"platform_frame\"/>\n  </sensor>\n",
    );
}

/// Everything before the bodies, with `text` about this kind of model in the comment, lines indented.
fn opening(export: &Export, scale: &Scale, text: &str) -> String {
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!--\n");
    for line in export.heading("m") {
        let _ = writeln!(out, "  {}", xml_comment(&line));
    }
    let _ = writeln!(
        out,
        "  World frame: the base frame, gravity as in the option below. Site platform_frame: the platform frame.\n  \
         Kilograms and seconds; quaternions scalar first. {text}-->"
    );
    let step = real(scale.step);
    let _ = writeln!(
        out,
        "<mujoco model=\"{}\">\n  <compiler angle=\"radian\" autolimits=\"true\"/>\n  \
         <option timestep=\"{step}\" gravity=\"{}\" integrator=\"implicitfast\" solver=\"Newton\" tolerance=\"1e-12\" iterations=\"200\"/>\n  \
         <default>\n    <geom contype=\"0\" conaffinity=\"0\" mass=\"0\"/>\n    \
         <equality solref=\"{} 1\" solimp=\"0.9999 0.99999 0.0001\"/>\n  </default>\n  \
         <worldbody>\n    <light pos=\"0 0 {}\" dir=\"0 0 -1\"/>",
        escape(&one_line(&export.name)),
        reals(export.gravity.iter().copied(), " "),
        real(2.0 * scale.step),
        real(10.0 * scale.size),
    );
    let away = [2.5, -2.5, 1.5].map(|x| x * scale.size);
    let _ = writeln!(
        out,
        "    <camera name=\"side\" mode=\"targetbody\" target=\"platform\" pos=\"{}\"/>",
        reals(away, " ")
    );
    if let Some(z) = ground(export, scale) {
        let _ = writeln!(
            out,
            "    <geom name=\"ground\" type=\"plane\" size=\"0 0 {}\" pos=\"0 0 {}\" rgba=\"{GROUND}\"/>",
            real(0.1 * scale.size),
            real(z)
        );
    }
    out.push_str("    <body name=\"base\">\n");
    out
}

/// Results of a calibration besides the joints, without influence on the simulation. Programs can read these numbers.
/// Each element has one row of correlations, since some versions accept at most 500 numbers in one.
fn calibration(out: &mut String, export: &Export) {
    if export.leg_offsets.is_none() && export.calibration.is_none() {
        return;
    }
    let metres = export.unit.metres;
    out.push_str("  <custom>\n");
    let mut numeric = |name: &str, values: &mut dyn Iterator<Item = f64>| {
        let _ = writeln!(out, "    <numeric name=\"{name}\" data=\"{}\"/>", reals(values, " "));
    };
    if let Some(offsets) = &export.leg_offsets {
        numeric("leg_offsets", &mut offsets.iter().map(|x| x * metres));
    }
    if let Some(found) = &export.calibration {
        numeric("calibration_values", &mut found.values.iter().map(|x| x * metres));
        numeric("calibration_deviations", &mut found.deviations.iter().map(|x| x * metres));
        for (i, row) in found.correlations.row_iter().enumerate() {
            numeric(&format!("calibration_correlations_{}", i + 1), &mut row.iter().copied());
        }
        let names = found.names.iter().map(|name| escape(&one_line(name))).collect::<Vec<_>>().join(" ");
        let _ = writeln!(out, "    <text name=\"calibration_unknowns\" data=\"{names}\"/>");
    }
    out.push_str("  </custom>\n");
}

fn model(export: &Export) -> Result<String, Unsupported> {
    let masses = ModelMasses::of(export);
    let scale = Scale::of(export, &masses);
    let lengths = reals(export.legs.map(|l| l.length() * scale.metres), " ");
    let mut text = format!(
        "Slide leg N and its actuator hold the length minus the home length.\n  \
         Home lengths: {lengths}\n  \
         Masses: {}. Time step and gains follow from mass and size\n  \
         so that models of all sizes behave alike. Leg 1 carries the platform in the tree; legs 2 to 6 are closed by connect.\n",
        masses.words(export)
    );
    if let Some((least, greatest)) = export.leg_range {
        let [least, greatest] = [least, greatest].map(|l| real(l * scale.metres));
        let _ = writeln!(
            text,
            "  Leg lengths from {least} to {greatest}: the range of each slide and of its control."
        );
    }
    if export.hardware.base_cone_angle.is_some() {
        text.push_str("  Ranges of the hinges at the base: boxes around the cones in which the design lets legs swing.\n");
    }
    if swing::is_limited(export) {
        text.push_str(swing::COMMENT);
    }
    if export.leg_offsets.is_some() || export.calibration.is_some() {
        text.push_str("  Custom numbers: leg offsets, values and standard deviations of the calibration in metres, correlations row by row; the simulation does not use them.\n");
    }
    if export.payload_shape.is_some() {
        text.push_str("  Geom payload: the space of the payload. It touches nothing, and its mass belongs to the platform.\n");
    }
    let mut out = opening(export, &scale, &text);
    shape(&mut out, &scale, &export.bodies[0], "      ");
    for l in &export.legs {
        leg(&mut out, (&scale, &masses), export, l)?;
    }
    out.push_str("    </body>\n  </worldbody>\n");
    calibration(&mut out, export);
    out.push_str("  <equality>\n");
    for l in &export.legs[1..] {
        let _ = writeln!(
            out,
            "    <connect name=\"loop{0}\" body1=\"rod{0}\" body2=\"platform\" anchor=\"0 0 0\"/>",
            l.number
        );
    }
    out.push_str("  </equality>\n");
    swing::tendons(&mut out, &scale, export)?;
    out.push_str("  <actuator>\n");
    let force = export
        .greatest_force
        .map_or_else(String::new, |f| format!(" forcerange=\"{0} {1}\"", real(-f), real(f)));
    for l in &export.legs {
        let _ = writeln!(
            out,
            "    <position name=\"actuator{0}\" joint=\"leg{0}\" kp=\"{1}\" kv=\"{2}\"{3}{force}/>",
            l.number,
            real(scale.kp),
            real(scale.kv),
            range_of(export, l, "ctrlrange")
        );
    }
    out.push_str("  </actuator>\n");
    sensors(&mut out, "leg");
    out.push_str("  <keyframe>\n");
    // x angle, y angle, slide of each leg; the ball joint after the slide of leg 1
    let qpos = format!("0 0 0 1 0 0 0{}", " 0 0 0".repeat(5));
    let _ = writeln!(
        out,
        "    <key name=\"home\" qpos=\"{qpos}\" ctrl=\"0 0 0 0 0 0\"/>\n  </keyframe>\n</mujoco>"
    );
    Ok(out)
}
