//! C99 for drives with joint offsets or leads: corrected lengths of poses, a pose tracked from lengths to lengths, and
//! a proved error bound.
//!
//! `equipod_drives.c` and `equipod_drives.h` next to this file are the same for every design; `equipod.c` tracks the
//! poses of the distances.

use std::fmt::Write as _;

use nalgebra::Vector3;

use super::vectors::{list, moved, pose_numbers, row};
use super::{
    ConeAxes, ExportedFile, OwnLibrary, braces, heading, home, leg_offsets, legs, limits, number, points,
    reals,
};
use crate::export::Export;
use fk::NearOptions;
use machine::coupled::{CoupledLegs, CoupledStatus, CoupledTracker};
use num::Rng;
use platform::geom::Pose;
use platform::manipulator::Body;

/// Seed of the poses.
const SEED: u64 = 29;
/// Greatest rotation (radians) and shift (over the size) of poses about home.
const AWAY: f64 = 0.08;
/// Number of poses.
const POSES: usize = 16;

pub(super) fn files(export: &Export, drives: &CoupledLegs) -> Vec<ExportedFile> {
    let library = OwnLibrary {
        name: "equipod_drives",
        header: include_str!("equipod_drives.h"),
        source: include_str!("equipod_drives.c"),
        selftest: include_str!("equipod_selftest.c"),
    };
    let mut files = library.files(header(export), source(export, drives), vectors(export, drives));
    files.extend(super::kinematics_modules());
    files
}

fn header(export: &Export) -> String {
    let mut out = heading(export);
    let _ = write!(
        out,
        "#ifndef EQUIPOD_DESIGN_H\n#define EQUIPOD_DESIGN_H\n\n#include \"equipod_drives.h\"\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n\
         /* The joints of the design, and what makes its drives longer or shorter than their distances. */\n\
         extern const equipod_legs equipod_nominal;\nextern const equipod_drives equipod_design_drives;\n\
         /* Marks such a design for the kinematics modules. */\n#define EQUIPOD_HAS_DRIVES 1\n\
         /* Limits of lengths, which are those of drives, and of cone angles. */\nextern const equipod_limits equipod_design_limits;\n\
         /* The home pose, from which turns of the legs count. */\nextern const equipod_pose equipod_home;\n\
         /* Millimetres of a unit of length. */\n#define EQUIPOD_UNIT_MILLIMETRES {}\n",
        number(export.unit.millimetres)
    );
    if export.leg_offsets.is_some() {
        out.push_str(
            "\n/* Leg offsets of the calibration: the length of the drive of leg i is the one it shows less equipod_leg_offsets[i]. */\n\
             #define EQUIPOD_HAS_LEG_OFFSETS 1\nextern const real_t equipod_leg_offsets[6];\n",
        );
    }
    out.push_str("\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
    out
}

fn source(export: &Export, drives: &CoupledLegs) -> String {
    let mut out = heading(export);
    out.push_str("#include \"equipod_design.h\"\n\n#include <math.h>\n\n#define R(x) ((real_t)(x))\n\n");
    legs(&mut out, "equipod_nominal", &export.manipulator);
    let axes = Body::BOTH.map(|body| points(&drives.first_axes(body).map(Into::into)));
    let _ = writeln!(
        out,
        "const equipod_drives equipod_design_drives = {{\n    {{{}}},\n    {},\n    R({}),\n    {},\n    R({})\n}};\n",
        axes.join(", "),
        reals(drives.offsets()),
        number(drives.lead_per_radian()),
        reals(drives.turned_at_home()),
        number(export.size),
    );
    limits(&mut out, &export.hardware, &ConeAxes::of(export));
    home(&mut out, &export.home);
    leg_offsets(&mut out, export);
    out
}

/// Numbers of the library for the self-test: poses about home, one with a leg along its first axis, and paths from one
/// to the next.
fn vectors(export: &Export, drives: &CoupledLegs) -> String {
    let mut rng = Rng::new(SEED);
    let about: Vec<Pose> = (0..POSES).map(|_| moved(&export.home, AWAY, export.size, &mut rng)).collect();
    let mut out = heading(export);
    let all = export.workspace.iter().take(9).chain(&about).copied().chain(along_axis(export, drives));
    list(&mut out, "drive_vector", "drive_vectors", all.map(|pose| lengths(drives, &pose)));
    let mut tracker = CoupledTracker::new(drives.clone(), export.home);
    let steps = about.iter().filter_map(|pose| follow(drives, &mut tracker, pose));
    let steps: Vec<String> = steps.collect();
    list(&mut out, "follow_vector", "follow_vectors", steps);
    out
}

/// A pose with the first leg along a first axis.
fn along_axis(export: &Export, drives: &CoupledLegs) -> Option<Pose> {
    let leg = export.manipulator.legs()[0];
    let axis = drives.first_axes(Body::Base)[0];
    let there = leg.base.coords + axis * export.size;
    let pose = Pose { position: there - export.home.rotation * leg.platform.coords, ..export.home };
    (axis != Vector3::zeros()).then_some(pose)
}

fn lengths(drives: &CoupledLegs, pose: &Pose) -> String {
    let zeros = row(&[0.0; 6]);
    let (Ok(states), Ok(lengths)) = (drives.states(pose), drives.drives(pose)) else {
        let missing = (0..6).find(|i| drives.state_of(*i, pose).is_err()).map_or(0, |i| i + 1);
        let nothing = braces(std::iter::repeat_n(row(&[0.0; 3]), 6));
        let no_rates = braces(std::iter::repeat_n(zeros.clone(), 6));
        let entries = [pose_numbers(pose), zeros.clone(), missing.to_string()];
        return braces(entries.into_iter().chain([zeros.clone(), zeros.clone(), zeros, nothing, no_rates]));
    };
    braces([
        pose_numbers(pose),
        row(&lengths),
        "0".to_string(),
        row(&states.map(|s| s.correction)),
        row(&states.map(|s| s.of_offsets)),
        row(&states.map(|s| s.twist)),
        braces(states.iter().map(|s| row(s.line.as_slice()))),
        braces(states.iter().map(|s| row(&s.rates))),
    ])
}

/// The path to the lengths of a pose.
fn follow(drives: &CoupledLegs, tracker: &mut CoupledTracker, pose: &Pose) -> Option<String> {
    let lengths = drives.drives(pose).ok()?;
    let start = tracker.pose();
    let found = tracker.step(&lengths);
    let (status, bound) = match found.status {
        CoupledStatus::Proved(bound) => ("EQUIPOD_DRIVES_REACHED", Some(bound)),
        CoupledStatus::Unproved => ("EQUIPOD_DRIVES_REACHED", None),
        CoupledStatus::NotContracting => ("EQUIPOD_DRIVES_NOT_CONTRACTING", None),
        CoupledStatus::NotTracked => ("EQUIPOD_DRIVES_NOT_TRACKED", None),
        CoupledStatus::NoLength(_) => ("EQUIPOD_DRIVES_NO_LENGTH", None),
    };
    Some(braces([
        pose_numbers(&start),
        row(&lengths),
        NearOptions::default().segments.to_string(),
        status.to_string(),
        pose_numbers(found.near.pose()),
        row(&found.distances),
        number(found.near.evidence().frobenius_ratio),
        number(found.factor),
        found.steps.to_string(),
        u8::from(bound.is_some()).to_string(),
        number(bound.map_or(0.0, |b| b.position)),
        number(bound.map_or(0.0, |b| b.angle)),
        number(bound.map_or(0.0, |b| b.contraction)),
    ]))
}
