//! Curves of poses with constant leg lengths.

use super::poses::{POSE, pose as at};
use crate::Sheet;
use crate::figure::figure;
use ask::MotionOrigin;
use fk::CompletenessWord;
use records::{MotionEvidenceWord, SelfmotionAnswer};

/// The answer of `singular motion`.
#[must_use]
pub fn self_motion(r: &SelfmotionAnswer) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{}: {}", r.name, verdict(r));
    if let (Some(d), None) = (r.dimension.filter(|d| *d > 1), &r.start) {
        let count = r.real_poses.len();
        say!(out, "Real poses found on the set of dimension {d}: {count}. The set was not traced.");
        for pose in &r.real_poses {
            say!(out, "  {POSE} = {}", at(pose));
        }
    }
    for (k, curve) in r.curves.iter().enumerate() {
        let arc = curve.points.last().map_or(0.0, |p| p.arc);
        let degree = match &curve.degree {
            Some(d) if d.complete => format!(", degree {} (trace test {})", d.degree, figure(d.defect)),
            Some(d) => format!(", degree at least {}", d.degree),
            None => String::new(),
        };
        let origin = curve.found_by.map_or("", MotionOrigin::name);
        say!(
            out,
            "curve {}: {} poses, length {} in dual quaternions (e, g / size), {}, {} crossings{degree}, found from a {}",
            k + 1,
            curve.points.len(),
            figure(arc),
            curve.end,
            curve.crossings.len(),
            origin.replace('_', " ")
        );
    }
    if !r.curves.is_empty() {
        say!(
            out,
            "Leg lengths are constant to {} of the size; {} crossings; {} more start poses were tried",
            figure(r.worst_length_error.0),
            r.crossings.len(),
            r.further_starts
        );
    }
    if let (Some(c), Some(components)) = (&r.critical_points, &r.complex_components)
        && !components.is_empty()
    {
        let degrees: Vec<String> = components.iter().map(|d| d.degree.to_string()).collect();
        say!(
            out,
            "Over the complex numbers: irreducible curves of degrees {}; {} paths to critical points, {} lost",
            degrees.join(", "),
            c.paths,
            c.lost
        );
    }
    match r.components_accounted {
        Some(true) => out.line("All real components were found (numerically, not proved)."),
        Some(false) => out.line("Real components may be missing."),
        None if r.dimension.is_some_and(|d| d > 1) => {
            out.line("No curve was traced: the poses form a set of dimension 2 or more.");
        }
        None => {}
    }
    out
}

/// The verdict: whether the platform moves, with the evidence.
fn verdict(r: &SelfmotionAnswer) -> String {
    let freedoms = |d: usize| if d == 1 { "1 freedom".to_string() } else { format!("{d} freedoms") };
    let first = r.tangent_dimension.unwrap_or(0);
    let at = if r.start.is_some() { "at this pose" } else { "at a pose with these lengths" };
    match (r.dimension, r.evidence) {
        (Some(0), MotionEvidenceWord::FirstOrder) => format!(
            "no self-motion at this pose, proved: the six leg lines are independent (ratio of singular values {})",
            figure(r.singular_values[7].0 / r.singular_values[0].0)
        ),
        (Some(0) | None, MotionEvidenceWord::SecondOrder) => {
            let [radius, within] = r.isolated.map_or([0.0; 2], |i| [i.radius.0, i.within.0]).map(figure);
            let none = if r.dimension.is_some() {
                "no self-motion at this pose".to_string()
            } else {
                format!("no self-motion larger than {within} at this pose")
            };
            format!(
                "{none}, proved to second order: the leg lines allow {} to first order, and the legs block it.\n\
                 Every pose with these lengths within {radius} of the pose lies within {within} of it (relative to the size; radians).",
                freedoms(first)
            )
        }
        (Some(0), _) if r.completeness == CompletenessWord::Proved => {
            "no self-motion with these lengths, proved: every real pose is isolated".to_string()
        }
        (Some(0), _) => "no curve of poses with these lengths was found".to_string(),
        (Some(d), MotionEvidenceWord::ConstantRank) => format!(
            "the platform moves {at} with {}, proved: the leg lines have rank {} at all poses around it",
            freedoms(d),
            6 - d
        ),
        (Some(d), MotionEvidenceWord::CommonLine) => format!(
            "the platform moves {at}, proved: all joints of one body are on a line, and the platform turns about it; {} found{}",
            freedoms(d),
            r.tangent_dimension.map_or_else(String::new, |first| format!(", the leg lines allow {first}"))
        ),
        (Some(d), MotionEvidenceWord::Traced) => {
            format!(
                "the platform moves at this pose with {}, found by tracing, not proved; the leg lines allow {first}",
                freedoms(d)
            )
        }
        (Some(1), _) if r.curves.is_empty() => {
            "the complex poses with these lengths form curves; no real pose on them was found".to_string()
        }
        (Some(1), _) => "poses with these lengths form curves".to_string(),
        (Some(d), _) => format!("poses with these lengths form a set of dimension {d}"),
        (None, _) => format!(
            "undecided: the leg lines allow {} at this pose to first order. Tracing found no motion, and the second order excludes none",
            freedoms(first)
        ),
    }
}
