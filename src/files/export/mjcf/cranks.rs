//! Six cranks on hinges with rods. Each rod is joined to the platform. It hangs on its crank by a universal joint: two
//! hinges, the first along the axis of the crank.

use std::fmt::Write as _;

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::swing::{self, ConeTendon};
use super::{Export, ModelMasses, Scale, Unsupported, inertial, opening, platform, quat, shape};
use crate::export::model::{ExportCranks, seen_from};
use crate::export::text::{real, reals};
use platform::geom::Pose;

/// Actuator gains relative to those of legs of variable length, times the square of the crank length.
fn gains(scale: &Scale, length: f64) -> (f64, f64) {
    let arm = (length * scale.metres).powi(2);
    (scale.kp * arm, scale.kv * arm)
}

/// Home frames, base frame: of a crank (first axis along it, third along its axis) and of its rod (third axis along
/// it).
fn frames(cranks: &ExportCranks, leg: usize, end: &Vector3<f64>) -> Result<[Pose; 2], Unsupported> {
    let crank = &cranks.platform.legs()[leg].crank;
    let tip = cranks.platform.tip(leg, cranks.home_angles[leg]).coords;
    let (n, arm) = (crank.axis.into_inner(), (tip - crank.centre.coords) / crank.length);
    let axes = Matrix3::from_columns(&[arm, n.cross(&arm), n]);
    let turned = Pose { rotation: Rotation3::from_matrix_unchecked(axes), position: crank.centre.coords };
    let number = leg + 1;
    let along = (end - tip).try_normalize(0.0).ok_or(Unsupported::NoDirection { leg: number })?;
    // across the axis of the crank and the rod: the axis of the second hinge of the rod
    let across = along.cross(&n).try_normalize(1e-6).ok_or(Unsupported::RodAlongAxis { leg: number })?;
    let axes = Matrix3::from_columns(&[across.cross(&along), across, along]);
    Ok([turned, Pose { rotation: Rotation3::from_matrix_unchecked(axes), position: tip }])
}

/// Range of the second hinge of a rod, if the design limits the lean of the rod out of the plane of its crank.
///
/// The first hinge rotates about the axis of the crank and keeps that angle. The second is across both; its rotation
/// `b` increases the angle by `b` relative to home.
fn lean_range(cranks: &ExportCranks, at_home: f64) -> String {
    cranks.tip_angle.map_or_else(String::new, |most| {
        format!(" range=\"{} {}\"", real(-most - at_home), real(most - at_home))
    })
}

fn leg(
    out: &mut String,
    (scale, masses): (&Scale, &ModelMasses),
    export: &Export,
    cranks: &ExportCranks,
    i: usize,
) -> Result<(), Unsupported> {
    let leg = &cranks.platform.legs()[i];
    let end = export.home.transform(&leg.platform).coords;
    let [turned, rod] = frames(cranks, i, &end)?;
    let hung = seen_from(&turned, &rod);
    let number = i + 1;
    let capsule = |from: &Vector3<f64>, to: &Vector3<f64>, diameter: f64| {
        let size = real(0.5 * diameter * scale.metres);
        format!("<geom type=\"capsule\" size=\"{size}\" fromto=\"{} {}\"/>", scale.at(from), scale.at(to))
    };
    let [x, z] = [Vector3::x(), Vector3::z()];
    let (thick, thin) = export.legs[i].diameters;
    let range = leg
        .limits
        .map_or_else(String::new, |(least, most)| format!(" range=\"{} {}\"", real(least), real(most)));
    let first = rod.rotation.inverse() * leg.crank.axis.into_inner();
    // the third axis of the rod is its line
    let lean = lean_range(cranks, first.z.clamp(-1.0, 1.0).asin());
    let (_, damping) = gains(scale, leg.crank.length);
    let _ = writeln!(
        out,
        "      <body name=\"crank{number}\" pos=\"{}\" quat=\"{}\"{}>\n        \
         <joint name=\"angle{number}\" type=\"hinge\" axis=\"0 0 1\" ref=\"{}\"{range}/>\n        {}\n        {}\n        \
         <body name=\"rod{number}\" pos=\"{}\" quat=\"{}\"{}>\n          \
         <joint name=\"swing{number}x\" type=\"hinge\" axis=\"{}\" damping=\"{damp}\"/>\n          \
         <joint name=\"swing{number}y\" type=\"hinge\" axis=\"0 1 0\" damping=\"{damp}\"{lean}/>\n          {}\n          {}",
        scale.at(&turned.position),
        quat(&turned),
        scale.gravity,
        real(cranks.home_angles[i]),
        inertial(&masses.nothing()),
        capsule(&Vector3::zeros(), &(x * leg.crank.length), thick),
        scale.at(&hung.position),
        quat(&hung),
        scale.gravity,
        reals(first.iter().copied(), " "),
        inertial(&masses.rod(leg.rod * scale.metres)),
        capsule(&Vector3::zeros(), &(z * leg.rod), thin),
        damp = real(1e-4 * damping),
    );
    if let Some(tendon) = ConeTendon::of(export, &export.legs[i])? {
        tendon.at_rod(out, scale);
    }
    if i == 0 {
        platform(out, (scale, masses), export, &export.legs[0], &seen_from(&rod, &export.home));
    }
    out.push_str("        </body>\n      </body>\n");
    Ok(())
}

/// The whole model.
pub(super) fn model(export: &Export, cranks: &ExportCranks) -> Result<String, Unsupported> {
    let masses = ModelMasses::of(export);
    let scale = Scale::of(export, &masses);
    let angles = reals(cranks.home_angles, " ");
    let rods = reals(cranks.platform.rods().get().map(|l| l * scale.metres), " ");
    let mut text = format!(
        "Hinge angleN and its actuator hold the angle of crank N in radians, counted as in the design.\n  \
         Home angles: {angles}\n  Lengths of the rods: {rods}\n  \
         Masses: {}. Time step and gains follow from mass and size\n  \
         so that models of all sizes behave alike. Rod 1 carries the platform in the tree; rods 2 to 6 are closed by connect.\n",
        masses.words(export),
    );
    if cranks.tip_angle.is_some() {
        text.push_str("  Range of hinge swingNy: greatest angle of rod N out of the plane of crank N, minus this angle at home.\n");
    }
    if swing::is_limited(export) {
        text.push_str(swing::COMMENT);
    }
    let mut out = opening(export, &scale, &text);
    shape(&mut out, &scale, &export.bodies[0], "      ");
    for i in 0..6 {
        leg(&mut out, (&scale, &masses), export, cranks, i)?;
    }
    out.push_str("    </body>\n  </worldbody>\n  <equality>\n");
    for (i, leg) in cranks.platform.legs().iter().enumerate().skip(1) {
        let anchor = scale.at(&(Vector3::z() * leg.rod));
        let _ = writeln!(
            out,
            "    <connect name=\"loop{0}\" body1=\"rod{0}\" body2=\"platform\" anchor=\"{anchor}\"/>",
            i + 1
        );
    }
    out.push_str("  </equality>\n");
    swing::tendons(&mut out, &scale, export)?;
    out.push_str("  <actuator>\n");
    let force = cranks
        .greatest_torque
        .map_or_else(String::new, |t| format!(" forcerange=\"{0} {1}\"", real(-t), real(t)));
    for (i, leg) in cranks.platform.legs().iter().enumerate() {
        let (kp, kv) = gains(&scale, leg.crank.length);
        let range = leg.limits.map_or_else(String::new, |(least, most)| {
            format!(" ctrlrange=\"{} {}\"", real(least), real(most))
        });
        let _ = writeln!(
            out,
            "    <position name=\"actuator{0}\" joint=\"angle{0}\" kp=\"{1}\" kv=\"{2}\"{range}{force}/>",
            i + 1,
            real(kp),
            real(kv)
        );
    }
    out.push_str("  </actuator>\n");
    super::sensors(&mut out, "angle");
    out.push_str("  <keyframe>\n");
    // the crank angle and both rod angles of each leg; the ball joint after those of leg 1
    let legs = cranks.home_angles.map(|q| format!("{} 0 0", real(q)));
    let qpos = format!("{} 1 0 0 0 {}", legs[0], legs[1..].join(" "));
    let _ =
        writeln!(out, "    <key name=\"home\" qpos=\"{qpos}\" ctrl=\"{angles}\"/>\n  </keyframe>\n</mujoco>");
    Ok(out)
}
