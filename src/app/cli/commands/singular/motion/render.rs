//! Self-motions as text, JSON and CSV.

use std::fmt::Write as _;

use crate::app::cli::numbers::listed;
use crate::app::cli::output::Answer;
use crate::app::cli::poses;
use ask::{Design, MotionOrigin, SelfMotionReport};
use fk::CompletenessWord;
use records::{
    CriticalPointsRecord, IsolatedRecord, MotionCurveRecord, MotionEvidenceWord, Number,
    PoseQuaternionRecord, SelfmotionAnswer,
};
use synthesis::singularity::CurveDegree;

/// The answer.
pub(super) fn answer(design: &Design, found: &SelfMotionReport, degrees: &[Option<CurveDegree>]) -> Answer {
    let motion = &found.motion;
    let critical = found.critical.as_ref();
    let curves = motion.curves.iter().zip(degrees);
    // with lengths alone the first pose is one of several found
    let at = motion.at_pose.as_ref().filter(|_| found.start.is_some());
    let record = SelfmotionAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        dimension: found.dimension,
        evidence: at.map_or(MotionEvidenceWord::Sections, |at| at.verdict.into()),
        tangent_dimension: at.map(|at| at.tangent_dimension),
        isolated: at.and_then(|at| IsolatedRecord::of(at.verdict)),
        start: found.start.as_ref().map(PoseQuaternionRecord::from),
        lengths: found.squares.lengths().get().map(Number),
        singular_values: motion.singular_values.map(Number),
        further_starts: further(found),
        real_poses: found.real_poses.iter().map(PoseQuaternionRecord::from).collect(),
        completeness: CompletenessWord::Unproved,
        components_accounted: found.accounted,
        complex_components: critical.map(|c| c.components.clone()),
        critical_points: critical.map(CriticalPointsRecord::from),
        worst_length_error: Number(motion.worst_length_error),
        crossings: motion.crossings.iter().map(PoseQuaternionRecord::from).collect(),
        curves: curves
            .map(|(c, d)| MotionCurveRecord::new(c, d.as_ref(), found.origins.get(c.start).copied()))
            .collect(),
    };
    let text = text(&record);
    Answer::new(found.moves().into(), record, text)
}

fn text(r: &SelfmotionAnswer) -> String {
    let mut out = format!("{}\n", r.name);
    let _ = writeln!(out, "{}", verdict(r));
    if let (Some(d), None) = (r.dimension.filter(|d| *d > 1), &r.start) {
        let count = r.real_poses.len();
        let _ = writeln!(out, "real poses found on the set of dimension {d}: {count}; it was not followed");
        for pose in &r.real_poses {
            let (p, q) = (pose.position.map(|x| x.0), pose.quaternion.map(|x| x.0));
            let _ = writeln!(out, "  p = {}  q = {}", listed(p, 6), listed(q, 6));
        }
    }
    for (k, curve) in r.curves.iter().enumerate() {
        let arc = curve.points.last().map_or(0.0, |p| p.arc);
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
                write!(out, ", degree {} (trace test {:.1e})", d.degree, d.defect)
            }
            Some(d) => write!(out, ", degree at least {}", d.degree),
            None => Ok(()),
        };
        let origin = curve.found_by.map_or("", MotionOrigin::name);
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
        None if r.dimension.is_some_and(|d| d > 1) => {
            out.push_str("no curve was followed: the poses form a surface or more\n");
        }
        None => {}
    }
    out
}

/// Whether the platform moves, and what shows it.
fn verdict(r: &SelfmotionAnswer) -> String {
    let freedoms = |d: usize| if d == 1 { "1 freedom".to_string() } else { format!("{d} freedoms") };
    let first = r.tangent_dimension.unwrap_or(0);
    match (r.dimension, r.evidence) {
        (Some(0), MotionEvidenceWord::FirstOrder) => format!(
            "no self-motion at this pose: proved, the six leg lines are independent (singular values {:.1e} to 1)",
            r.singular_values[7].0 / r.singular_values[0].0
        ),
        (Some(0), MotionEvidenceWord::SecondOrder) => {
            let [radius, within] = r.isolated.map_or([0.0; 2], |i| [i.radius.0, i.within.0]);
            format!(
                "no self-motion at this pose: proved to second order. The leg lines leave {}, and the legs stop it.\n\
                 every pose with these lengths within {radius:.1e} of the pose lies within {within:.1e} of it (sizes and radians)",
                freedoms(first)
            )
        }
        (Some(0), _) => "no curve of poses with these lengths was found".to_string(),
        (Some(d), MotionEvidenceWord::ConstantRank) => format!(
            "the platform moves at this pose with {}: proved, the leg lines have rank {} at all poses around it",
            freedoms(d),
            6 - d
        ),
        (Some(d), MotionEvidenceWord::Traced) => {
            let stretch = "found by tracing, no proof";
            format!(
                "the platform moves at this pose with {}: {stretch}; the leg lines leave {first}",
                freedoms(d)
            )
        }
        (Some(1), _) if r.curves.is_empty() => {
            "the complex poses with these lengths form curves; no real pose on them was found".to_string()
        }
        (Some(1), _) => "poses with these lengths form curves".to_string(),
        (Some(d), _) => format!("poses with these lengths form a set of dimension {d}"),
        (None, _) => format!(
            "undecided: the leg lines leave {} at this pose. Tracing found no motion, and no argument of second order excludes one",
            freedoms(first)
        ),
    }
}

/// Starting poses beside the one given.
fn further(found: &SelfMotionReport) -> usize {
    found.origins.iter().filter(|o| **o != MotionOrigin::Pose).count()
}

/// One line a pose.
pub(super) fn csv(found: &SelfMotionReport) -> String {
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
