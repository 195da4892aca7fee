//! Tables: joints, parts, leg lengths over the workspace and along the trajectory.

use std::fmt::Write as _;

use super::hal::home_words;
use super::text::{commented, csv_field, real, reals, scaled};
use super::{Export, ExportCalibration, ExportedFile, Unsupported, Writer};
use num::shown::rounded_down;
use platform::geom::Pose;

/// The format `csv`.
pub(super) static WRITER: Writer =
    Writer::new("tables of joints, leg lengths and parts, for spreadsheets and controllers", files);

// all formats have one signature, and others can fail
#[allow(clippy::unnecessary_wraps)]
fn files(export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
    let mut out = vec![
        ExportedFile::new("joints.csv", joints(export)),
        ExportedFile::new("legs.csv", legs(export)),
        ExportedFile::new("parts.csv", export.parts_csv()),
        ExportedFile::new("lengths-workspace.csv", lengths(export, &export.workspace)),
    ];
    if let Some(found) = &export.calibration {
        out.push(ExportedFile::new("calibration.csv", calibration(export, found)));
    }
    if !export.trajectory.is_empty() {
        out.push(ExportedFile::new("lengths-trajectory.csv", lengths(export, &export.trajectory)));
    }
    Ok(out)
}

/// Comment lines, which most readers skip if `#` marks a comment.
fn comments(export: &Export, more: &str) -> String {
    commented("#", export.heading("mm").into_iter().chain([more.to_string()]))
}

fn joints(export: &Export) -> String {
    let places = export.hole_places.map_or_else(String::new, |diameter| {
        let diameter = rounded_down(diameter * export.unit.millimetres);
        format!("; each joint has to be within a ball of diameter {diameter} mm about its place")
    });
    let mut out = comments(export, &format!("x, y, z of each joint centre in the frame of its body{places}"));
    out.push_str("body,joint,x_mm,y_mm,z_mm\n");
    for body in &export.bodies {
        for joint in &body.joints {
            let at = scaled(&joint.at.coords, export.unit.millimetres, ",");
            let _ = writeln!(out, "{},{},{at}", body.body, csv_field(&joint.name));
        }
    }
    out
}

/// Both ends of each leg, in a table from which `new --points` recreates the design with its shared joints and home.
fn legs(export: &Export) -> String {
    let mm = export.unit.millimetres;
    let mut out = comments(
        export,
        "joint centres in the frames of their bodies; lengths between them at the home pose",
    );
    out.push_str(&commented("#", [home_words(export)]));
    out.push_str(
        "leg,base_joint,platform_joint,home_length_mm,base_x_mm,base_y_mm,base_z_mm,platform_x_mm,platform_y_mm,platform_z_mm\n",
    );
    for leg in &export.legs {
        let (a, b) = export.ends_of(leg);
        let length = real(leg.length() * mm);
        let ends = [leg.foot, export.bodies[1].joints[leg.platform].at];
        let [foot, tip] = ends.map(|p| scaled(&p.coords, mm, ","));
        let _ = writeln!(out, "{},{},{},{length},{foot},{tip}", leg.number, csv_field(a), csv_field(b));
    }
    out
}

fn calibration(export: &Export, found: &ExportCalibration) -> String {
    let mut out = comments(
        export,
        "calibrated coordinates of joints in the frames of their bodies and leg offsets (length shown less distance of the joints), their standard deviations, and correlations in columns in the order of the rows",
    );
    let names: Vec<_> = found.names.iter().map(|name| csv_field(name)).collect();
    let _ = writeln!(out, "unknown,value_mm,deviation_mm,{}", names.join(","));
    let mm = export.unit.millimetres;
    for (i, name) in names.iter().enumerate() {
        let row = reals(found.correlations.row(i).iter().copied(), ",");
        let _ =
            writeln!(out, "{name},{},{},{row}", real(found.values[i] * mm), real(found.deviations[i] * mm));
    }
    out
}

fn lengths(export: &Export, poses: &[Pose]) -> String {
    let text = "quaternion scalar first: the rotation R; position p: platform origin in the base frame";
    let shown = if export.leg_offsets.is_some() {
        "; lengths as the legs show them: distances of the joints with the offsets of the calibration"
    } else {
        ""
    };
    let mut out = comments(export, &format!("{text}{shown}"));
    out.push_str("pose,x_mm,y_mm,z_mm,qw,qx,qy,qz,l1_mm,l2_mm,l3_mm,l4_mm,l5_mm,l6_mm\n");
    for (k, pose) in poses.iter().enumerate() {
        let mm = export.unit.millimetres;
        let lengths = reals(export.shown_at(pose).map(|l| l * mm), ",");
        let (p, q) = (scaled(&pose.position, mm, ","), reals(pose.quaternion(), ","));
        let _ = writeln!(out, "{},{p},{q},{lengths}", k + 1);
    }
    out
}
