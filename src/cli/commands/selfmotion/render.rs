//! Self-motions as text, JSON and CSV.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::{Found, Origin};
use crate::cli::output::{Answer, number};
use crate::cli::poses;
use crate::design::Design;
use crate::singularity::{CriticalPoses, CurveDegree, MotionCurve};

fn degree_record(d: &CurveDegree) -> Value {
    json!({ "degree": d.degree, "complete": d.complete, "trace_defect": number(d.defect) })
}

fn critical_record(c: &CriticalPoses) -> Value {
    json!({
        "paths": c.paths, "real": c.poses.len(), "regular": c.regular, "singular": c.singular, "no_pose": c.no_pose,
        "lost": c.lost, "unused_starts": c.unused,
    })
}

fn curve_record(curve: &MotionCurve, degree: Option<CurveDegree>, origin: Option<&Origin>) -> Value {
    let points = curve.points.iter().map(|p| {
        let mut record = poses::record(&p.pose);
        record["arc"] = number(p.arc);
        record["length_error"] = number(p.length_error);
        record["gap"] = number(p.gap);
        record
    });
    json!({
        "end": curve.end.name(),
        "crossings": curve.crossings.iter().map(|(after, k)| json!({ "after_point": after, "crossing": k })).collect::<Value>(),
        "degree": degree.as_ref().map(degree_record), "found_by": origin.map(|o| o.name()),
        "points": points.collect::<Value>(),
    })
}

/// The answer.
pub(super) fn answer(design: &Design, found: &Found) -> Answer {
    let motion = &found.motion;
    let mut json = Map::new();
    json.insert("name".into(), json!(design.name));
    json.insert("units".into(), json!(design.units));
    json.insert("dimension".into(), json!(found.dimension));
    json.insert("start".into(), found.start.as_ref().map_or(Value::Null, poses::record));
    json.insert("lengths".into(), json!(found.squares.lengths().get()));
    json.insert("singular_values".into(), motion.singular_values.map(number).to_vec().into());
    json.insert("further_starts".into(), json!(further(found)));
    json.insert("real_poses".into(), found.real_poses.iter().map(poses::record).collect());
    json.insert("completeness".into(), json!("unproved"));
    json.insert("components_accounted".into(), json!(found.accounted));
    let critical = found.critical.as_ref();
    let components = critical.map(|c| c.components.iter().map(degree_record).collect::<Value>());
    json.insert("complex_components".into(), components.unwrap_or(Value::Null));
    json.insert("critical_points".into(), critical.map_or(Value::Null, critical_record));
    json.insert("worst_length_error".into(), number(motion.worst_length_error));
    json.insert("crossings".into(), motion.crossings.iter().map(poses::record).collect());
    let curves = motion
        .curves
        .iter()
        .zip(&found.degrees)
        .map(|(c, d)| curve_record(c, *d, found.origins.get(c.start)));
    json.insert("curves".into(), curves.collect());
    Answer::new(found.exit, json, text(design, found))
}

fn text(design: &Design, found: &Found) -> String {
    let motion = &found.motion;
    let s = motion.singular_values;
    let mut out = format!("{}\n", design.name);
    match found.dimension {
        0 if found.start.is_none() => {
            let _ = writeln!(out, "no curve of poses with these lengths was found");
        }
        0 => {
            let _ = writeln!(
                out,
                "no self-motion at this pose: the smallest singular value of the leg equations is {:.1e} of the largest",
                s[7] / s[0]
            );
        }
        1 if motion.curves.is_empty() => {
            let _ = writeln!(
                out,
                "the complex poses with these lengths form curves; no real pose on them was found"
            );
        }
        1 => {}
        d => {
            let _ = writeln!(out, "the platform has {d} freedoms: no curve was followed");
        }
    }
    if found.dimension > 1 && found.start.is_none() {
        let count = found.real_poses.len();
        let _ = writeln!(
            out,
            "real poses found on the set of dimension {}: {count}; it was not followed",
            found.dimension
        );
        for pose in &found.real_poses {
            let (p, q) = (&pose.position, pose.quaternion());
            let _ = writeln!(
                out,
                "  p = [{:.6}, {:.6}, {:.6}]  q = [{:.6}, {:.6}, {:.6}, {:.6}]",
                p.x, p.y, p.z, q[0], q[1], q[2], q[3]
            );
        }
    }
    for (k, (curve, degree)) in motion.curves.iter().zip(&found.degrees).enumerate() {
        let arc = curve.points.last().map_or(0.0, |p| p.arc);
        let _ = write!(
            out,
            "curve {}: {} poses, length {arc:.6} in (e, g / size), {}, {} crossings",
            k + 1,
            curve.points.len(),
            curve.end.name(),
            curve.crossings.len()
        );
        let _ = match degree {
            Some(d) if d.complete => write!(out, ", degree {} (trace test {:.1e})", d.degree, d.defect),
            Some(d) => write!(out, ", degree at least {}", d.degree),
            None => Ok(()),
        };
        let origin = found.origins.get(curve.start).map_or("", |o| o.name());
        let _ = writeln!(out, ", found from a {}", origin.replace('_', " "));
    }
    if !motion.curves.is_empty() {
        let _ = writeln!(
            out,
            "leg lengths constant to {:.1e} of the size; {} crossings; {} further starting poses tried",
            motion.worst_length_error,
            motion.crossings.len(),
            further(found)
        );
    }
    if let Some(c) = &found.critical {
        let degrees: Vec<String> = c.components.iter().map(|d| d.degree.to_string()).collect();
        let _ = writeln!(
            out,
            "over the complex numbers: irreducible curves of degrees {}; {} paths to critical points, {} lost",
            degrees.join(", "),
            c.paths,
            c.lost
        );
    }
    match found.accounted {
        Some(true) => out.push_str("every real component is accounted for (numerically, no proof)\n"),
        Some(false) => out.push_str("real components may be missing\n"),
        None => {}
    }
    out
}

/// Starting poses beside the one given.
fn further(found: &Found) -> usize {
    found.origins.iter().filter(|o| **o != Origin::Pose).count()
}

/// One line a pose.
pub(super) fn csv(found: &Found) -> String {
    let mut out = String::from("curve,point,arc,px,py,pz,qw,qx,qy,qz,length_error,gap\n");
    for (k, curve) in found.motion.curves.iter().enumerate() {
        for (i, point) in curve.points.iter().enumerate() {
            let (p, q) = (&point.pose.position, point.pose.quaternion());
            let _ = writeln!(
                out,
                "{},{},{},{},{},{},{},{},{},{},{},{}",
                k + 1,
                i + 1,
                point.arc,
                p.x,
                p.y,
                p.z,
                q[0],
                q[1],
                q[2],
                q[3],
                point.length_error,
                point.gap
            );
        }
    }
    out
}
