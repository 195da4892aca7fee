//! Self-motions as text, JSON and CSV.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::Found;
use crate::cli::output::{Answer, number};
use crate::cli::poses;
use crate::design::Design;
use crate::singularity::{CurveDegree, MotionCurve};

fn curve_record(curve: &MotionCurve, degree: Option<CurveDegree>) -> Value {
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
        "degree": degree.map(|d| json!({ "degree": d.degree, "complete": d.complete, "trace_defect": number(d.defect) })),
        "points": points.collect::<Value>(),
    })
}

/// The answer.
pub(super) fn answer(design: &Design, found: &Found) -> Answer {
    let motion = &found.motion;
    let mut json = Map::new();
    json.insert("name".into(), json!(design.name));
    json.insert("units".into(), json!(design.units));
    json.insert("dimension".into(), json!(motion.dimension));
    json.insert("start".into(), poses::record(&found.start));
    json.insert("lengths".into(), json!(found.squares.lengths().get()));
    json.insert("singular_values".into(), motion.singular_values.map(number).to_vec().into());
    json.insert("further_starts".into(), json!(found.further));
    json.insert("worst_length_error".into(), number(motion.worst_length_error));
    json.insert("crossings".into(), motion.crossings.iter().map(poses::record).collect());
    let curves = motion.curves.iter().zip(&found.degrees).map(|(c, d)| curve_record(c, *d));
    json.insert("curves".into(), curves.collect());
    Answer { exit: found.exit, json, text: text(design, found) }
}

fn text(design: &Design, found: &Found) -> String {
    let motion = &found.motion;
    let s = motion.singular_values;
    let mut out = format!("{}\n", design.name);
    match motion.dimension {
        0 => {
            let _ = writeln!(
                out,
                "no self-motion at this pose: the smallest singular value of the leg equations is {:.1e} of the largest",
                s[7] / s[0]
            );
        }
        1 => {}
        d => {
            let _ = writeln!(out, "the platform has {d} freedoms at this pose: no curve was followed");
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
            Some(d) if d.complete => writeln!(out, ", degree {} (trace test {:.1e})", d.degree, d.defect),
            Some(d) => writeln!(out, ", degree at least {}", d.degree),
            None => writeln!(out),
        };
    }
    if motion.dimension == 1 {
        let _ = writeln!(
            out,
            "leg lengths constant to {:.1e} of the size; {} crossings; {} further starting poses tried",
            motion.worst_length_error,
            motion.crossings.len(),
            found.further
        );
    }
    out
}

/// One line a pose.
pub(super) fn csv(found: &Found) -> String {
    let mut out = String::from("curve,point,arc,px,py,pz,qw,qx,qy,qz,length_error,gap\n");
    for (k, curve) in found.motion.curves.iter().enumerate() {
        for (i, point) in curve.points.iter().enumerate() {
            let (p, q) = (&point.pose.position, poses::quaternion(&point.pose));
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
