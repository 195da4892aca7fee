//! C99 for rods on cranks: the crank angles of poses on their sides, and a pose tracked from angles to angles.
//!
//! `equipod_cranks.c` and `equipod_cranks.h` next to this file are the same for every design; `equipod.c` tracks a pose
//! on the tips of the cranks.

use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use super::vectors::{list, moved, pose_numbers, row};
use super::{ExportedFile, OwnLibrary, braces, heading, home, number, points, reals};
use crate::export::{Export, ExportCranks};
use fk::NearOutcome;
use machine::rotary::{Elbow, RotaryTracker};
use num::Rng;
use platform::geom::Pose;

/// Seed of the poses.
const SEED: u64 = 23;
/// Greatest rotation (radians) and shift (over the size) of poses about home.
const AWAY: f64 = 0.15;
/// Number of poses.
const POSES: usize = 40;
/// Greatest number of segments in a part: the value of `EQUIPOD_SEGMENTS`.
const SEGMENTS: u32 = 8;

pub(super) fn files(export: &Export, cranks: &ExportCranks) -> Vec<ExportedFile> {
    let library = OwnLibrary {
        name: "equipod_cranks",
        header: include_str!("equipod_cranks.h"),
        source: include_str!("equipod_cranks.c"),
        selftest: include_str!("equipod_selftest.c"),
    };
    library.files(header(export), source(export, cranks), vectors(export, cranks))
}

fn header(export: &Export) -> String {
    let mut out = heading(export);
    let _ = write!(
        out,
        "#ifndef EQUIPOD_DESIGN_H\n#define EQUIPOD_DESIGN_H\n\n#include \"equipod_cranks.h\"\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n\
         /* The design. */\nextern const equipod_cranks equipod_design_cranks;\n\
         /* The home pose, and the angles that hold it. */\nextern const equipod_pose equipod_home;\nextern const real_t equipod_home_angles[6];\n\
         /* Millimetres of a unit of length. */\n#define EQUIPOD_UNIT_MILLIMETRES {}\n\
         /* The size of the design, its unit of length. */\n#define EQUIPOD_DESIGN_SIZE {}\n\n\
         #ifdef __cplusplus\n}}\n#endif\n\n#endif\n",
        number(export.unit.millimetres),
        number(export.size)
    );
    out
}

fn source(export: &Export, cranks: &ExportCranks) -> String {
    let mut out = heading(export);
    out.push_str("#include \"equipod_design.h\"\n\n#define R(x) ((real_t)(x))\n\n");
    let legs = cranks.platform.legs();
    let vectors = |of: &dyn Fn(usize) -> Vector3<f64>| {
        let list: [Point3<f64>; 6] = std::array::from_fn(|i| Point3::from(of(i)));
        points(&list)
    };
    let words = |of: &dyn Fn(usize) -> bool| braces((0..6).map(|i| u8::from(of(i)).to_string()));
    let limit = |of: &dyn Fn((f64, f64)) -> f64| reals(legs.iter().map(|leg| leg.limits.map_or(0.0, of)));
    let _ = writeln!(
        out,
        "const equipod_cranks equipod_design_cranks = {{\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    {}\n}};\n",
        vectors(&|i| legs[i].crank.centre.coords),
        vectors(&|i| legs[i].crank.axis.into_inner()),
        vectors(&|i| cranks.platform.directions()[i][0]),
        vectors(&|i| cranks.platform.directions()[i][1]),
        reals(legs.iter().map(|leg| leg.crank.length)),
        reals(legs.iter().map(|leg| leg.rod)),
        vectors(&|i| legs[i].platform.coords),
        words(&|i| legs[i].elbow == Elbow::Plus),
        words(&|i| legs[i].limits.is_some()),
        limit(&|(least, _)| least),
        limit(&|(_, most)| most),
    );
    home(&mut out, &export.home);
    out.push('\n');
    let _ = writeln!(out, "const real_t equipod_home_angles[6] = {};", reals(cranks.home_angles));
    out
}

/// Numbers of the library for the self-test: poses about home, some of them out of reach, and paths from one to the
/// next.
fn vectors(export: &Export, cranks: &ExportCranks) -> String {
    let mut rng = Rng::new(SEED);
    let about: Vec<Pose> = (0..POSES).map(|_| moved(&export.home, AWAY, export.size, &mut rng)).collect();
    let far = Pose { position: export.home.position * 3.0 + Vector3::repeat(export.size), ..export.home };
    let all = export.workspace.iter().chain(&about).chain(std::iter::once(&far));
    let mut out = heading(export);
    list(&mut out, "angle_vector", "angle_vectors", all.filter_map(|pose| angles(export, cranks, pose)));
    let mut tracker = RotaryTracker::new(cranks.platform.clone(), export.home, cranks.home_angles);
    let steps = about.iter().filter_map(|pose| step(cranks, &mut tracker, pose));
    let steps: Vec<String> = steps.collect();
    list(&mut out, "step_vector", "step_vectors", steps);
    out
}

/// Angles and Jacobian at a pose; `None` where a crank is nearly singular, so that rounding decides, in `float` too.
fn angles(export: &Export, cranks: &ExportCranks, pose: &Pose) -> Option<String> {
    let platform = &cranks.platform;
    let zeros = row(&[0.0; 6]);
    let both = match platform.both_angles(pose) {
        Ok(both) => both,
        Err(missing) if missing.by.abs() < 1e-4 * export.size => return None,
        Err(missing) => {
            let none = braces(std::iter::repeat_n(zeros.clone(), 6));
            let leg = (missing.leg + 1).to_string();
            return Some(braces([pose_numbers(pose), leg, zeros.clone(), zeros.clone(), zeros, none]));
        }
    };
    let side = |kept: bool| -> [f64; 6] {
        std::array::from_fn(|i| {
            let elbow = platform.legs()[i].elbow;
            platform.counted(i, both[i].of(if kept { elbow } else { elbow.other() }))
        })
    };
    let (kept, other) = (side(true), side(false));
    let transmissions = platform.transmissions(pose, &kept);
    if transmissions.iter().any(|g| g.abs() < 0.05) {
        return None;
    }
    let rows = platform.crank_jacobian(pose, &kept)?;
    let rows = braces((0..6).map(|i| row(&std::array::from_fn::<f64, 6, _>(|k| rows[(i, k)]))));
    Some(braces([pose_numbers(pose), "0".into(), row(&kept), row(&other), row(&transmissions), rows]))
}

/// The path to the angles of a pose, if the library tracks it within the segments of the controller.
fn step(cranks: &ExportCranks, tracker: &mut RotaryTracker, pose: &Pose) -> Option<String> {
    let angles = cranks.platform.ik(pose).ok()?;
    let (start, from) = (tracker.pose(), *tracker.angles());
    let found = tracker.step(&angles).ok()?;
    match &found {
        NearOutcome::Tracked { pose, evidence } if evidence.segments <= SEGMENTS => Some(braces([
            pose_numbers(&start),
            row(&from),
            row(&angles),
            "EQUIPOD_TRACKED".into(),
            pose_numbers(pose),
            number(evidence.frobenius_ratio),
        ])),
        _ => None,
    }
}
