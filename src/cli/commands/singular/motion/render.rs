//! Self-motions as text, JSON and CSV.

use std::fmt::Write as _;

use super::Found;
use crate::cli::numbers::listed;
use crate::cli::output::Answer;
use crate::cli::poses;
use crate::design::Design;
use crate::records::{
    CompletenessWord, CriticalPointsRecord, CurveDegreeRecord, MotionCurveRecord, Number, OriginWord,
    PoseQuaternionRecord, SelfmotionAnswer,
};

/// The answer.
pub(super) fn answer(design: &Design, found: &Found) -> Answer {
    let motion = &found.motion;
    let critical = found.critical.as_ref();
    let curves = motion.curves.iter().zip(&found.degrees);
    let record = SelfmotionAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        dimension: found.dimension,
        start: found.start.as_ref().map(PoseQuaternionRecord::from),
        lengths: found.squares.lengths().get().map(Number),
        singular_values: motion.singular_values.map(Number),
        further_starts: further(found),
        real_poses: found.real_poses.iter().map(PoseQuaternionRecord::from).collect(),
        completeness: CompletenessWord::Unproved,
        components_accounted: found.accounted,
        complex_components: critical.map(|c| c.components.iter().map(CurveDegreeRecord::from).collect()),
        critical_points: critical.map(CriticalPointsRecord::from),
        worst_length_error: Number(motion.worst_length_error),
        crossings: motion.crossings.iter().map(PoseQuaternionRecord::from).collect(),
        curves: curves
            .map(|(c, d)| MotionCurveRecord::new(c, d.as_ref(), found.origins.get(c.start).copied()))
            .collect(),
    };
    let text = text(&record);
    Answer::new(found.exit, record, text)
}

fn text(r: &SelfmotionAnswer) -> String {
    let mut out = format!("{}\n", r.name);
    match r.dimension {
        0 if r.start.is_none() => {
            let _ = writeln!(out, "no curve of poses with these lengths was found");
        }
        0 => {
            let _ = writeln!(
                out,
                "no self-motion at this pose: the smallest singular value of the leg equations is {:.1e} of the largest",
                r.singular_values[7].0 / r.singular_values[0].0
            );
        }
        1 if r.curves.is_empty() => {
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
    if r.dimension > 1 && r.start.is_none() {
        let count = r.real_poses.len();
        let _ = writeln!(
            out,
            "real poses found on the set of dimension {}: {count}; it was not followed",
            r.dimension
        );
        for pose in &r.real_poses {
            let (p, q) = (pose.position.map(|x| x.0), pose.quaternion.map(|x| x.0));
            let _ = writeln!(out, "  p = {}  q = {}", listed(p, 6), listed(q, 6));
        }
    }
    for (k, curve) in r.curves.iter().enumerate() {
        let arc = curve.points.last().map_or(0.0, |p| p.arc.0);
        let _ = write!(
            out,
            "curve {}: {} poses, length {arc:.6} in (e, g / size), {}, {} crossings",
            k + 1,
            curve.points.len(),
            curve.end,
            curve.crossings.len()
        );
        let _ = match &curve.degree {
            Some(d) if d.complete => {
                write!(out, ", degree {} (trace test {:.1e})", d.degree, d.trace_defect.0)
            }
            Some(d) => write!(out, ", degree at least {}", d.degree),
            None => Ok(()),
        };
        let origin = curve.found_by.map_or("", OriginWord::as_str);
        let _ = writeln!(out, ", found from a {}", origin.replace('_', " "));
    }
    if !r.curves.is_empty() {
        let _ = writeln!(
            out,
            "leg lengths constant to {:.1e} of the size; {} crossings; {} further starting poses tried",
            r.worst_length_error.0,
            r.crossings.len(),
            r.further_starts
        );
    }
    if let (Some(c), Some(components)) = (&r.critical_points, &r.complex_components) {
        let degrees: Vec<String> = components.iter().map(|d| d.degree.to_string()).collect();
        let _ = writeln!(
            out,
            "over the complex numbers: irreducible curves of degrees {}; {} paths to critical points, {} lost",
            degrees.join(", "),
            c.paths,
            c.lost
        );
    }
    match r.components_accounted {
        Some(true) => out.push_str("every real component is accounted for (numerically, no proof)\n"),
        Some(false) => out.push_str("real components may be missing\n"),
        None => {}
    }
    out
}

/// Starting poses beside the one given.
fn further(found: &Found) -> usize {
    found.origins.iter().filter(|o| **o != OriginWord::Pose).count()
}

/// One line a pose.
pub(super) fn csv(found: &Found) -> String {
    let mut out = String::from("curve,point,arc,px,py,pz,qw,qx,qy,qz,length_error,gap\n");
    for (k, curve) in found.motion.curves.iter().enumerate() {
        for (i, point) in curve.points.iter().enumerate() {
            let pose = poses::csv_fields(&point.pose);
            let (arc, error, gap) = (point.arc, point.length_error, point.gap);
            let _ = writeln!(out, "{},{},{arc},{pose},{error},{gap}", k + 1, i + 1);
        }
    }
    out
}
