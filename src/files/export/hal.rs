//! `LinuxCNC`: the pins of genhexkins.

use std::fmt::Write as _;

use super::text::{ascii, commented, one_line, real};
use super::{Export, ExportedFile, Writer};
use platform::manipulator::Body;

/// The format `hal`.
pub(super) static WRITER: Writer = Writer {
    leaves_out: "joint axes and lead of the screws (genhexkins corrects for both): base-n, platform-n and screw-lead stay as they are; correlations of a calibration, which the formats csv, json and c have",
    ..Writer::new("LinuxCNC: settings of the hexapod kinematics genhexkins, millimetres", |export| {
        Ok(vec![ExportedFile::new("genhexkins.hal", settings(export))])
    })
};

/// The home pose in the form of the table reader: position in millimetres, angles of `R = Rz(C) Ry(B) Rx(A)` in
/// degrees.
pub(super) fn home_words(export: &Export) -> String {
    let (roll, pitch, yaw) = export.home.rotation.euler_angles();
    let p = export.home.position * export.unit.millimetres;
    let pose = [p.x, p.y, p.z, roll.to_degrees(), pitch.to_degrees(), yaw.to_degrees()].map(real);
    format!("Home pose X Y Z A B C: {}", pose.join(" "))
}

fn settings(export: &Export) -> String {
    let mm = export.unit.millimetres;
    let heading = export.heading("mm").into_iter();
    let mut out = commented("#", heading.map(|l| ascii(&l, |_| "?".to_string())));
    out.push_str(
        "# For a machine with LINEAR_UNITS = mm, after `loadrt genhexkins`. Strut N is leg N+1.\n\
         # The machine position X Y Z A B C is the pose: p = (X, Y, Z), R = Rz(C) Ry(B) Rx(A), degrees.\n\
         # genhexkins finds it from the struts only where the platform is turned little: B up to 75 with C = 0, C up to 45 with B = 0.\n",
    );
    let lengths: Vec<String> = export.legs.iter().map(|l| real(l.length() * mm)).collect();
    let _ = writeln!(out, "# {}", home_words(export));
    let _ = writeln!(out, "# Strut lengths there: {}", lengths.join(" "));
    if let Some(offsets) = export.leg_offsets {
        let offsets = offsets.map(|d| real(d * mm));
        let _ = writeln!(
            out,
            "# Leg offsets of the calibration: {}\n\
             # A strut shows its length plus its offset; genhexkins has no pin for that: add offset N to HOME_OFFSET of joint N.",
            offsets.join(" ")
        );
    }
    if let Some(found) = &export.calibration {
        out.push_str("# Standard deviations of the calibration, which no pin takes; their correlations are not written here.\n");
        for (name, deviation) in found.names.iter().zip(&found.deviations) {
            let name = ascii(&one_line(name), |_| "?".to_string());
            let _ = writeln!(out, "#   {name} {}", real(deviation * mm));
        }
    }
    for leg in &export.legs {
        let b = export.bodies[1].joints[leg.platform].at;
        for (body, point) in [(Body::Base, leg.foot), (Body::Platform, b)] {
            for (axis, value) in ["x", "y", "z"].iter().zip(point.iter()) {
                let _ =
                    writeln!(out, "setp genhexkins.{body}.{}.{axis} {}", leg.number - 1, real(value * mm));
            }
        }
    }
    out
}
