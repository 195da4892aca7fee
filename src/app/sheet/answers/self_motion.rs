//! Curves of poses with constant leg lengths.

use super::poses::{POSE, pose as at};
use crate::Sheet;
use crate::figure::figure;
use ask::MotionOrigin;
use records::{MotionEvidenceWord, SelfmotionAnswer};

/// The answer of `singular motion`.
#[must_use]
pub fn self_motion(r: &SelfmotionAnswer) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{}: {}", r.name, verdict(r));
    if let (Some(d), None) = (r.dimension.filter(|d| *d > 1), &r.start) {
        let count = r.real_poses.len();
        say!(out, "real poses found on the set of dimension {d}: {count}; it was not followed");
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
            "leg lengths constant to {} of the size; {} crossings; {} further starting poses tried",
            figure(r.worst_length_error.0),
            r.crossings.len(),
            r.further_starts
        );
    }
    if let (Some(c), Some(components)) = (&r.critical_points, &r.complex_components) {
        let degrees: Vec<String> = components.iter().map(|d| d.degree.to_string()).collect();
        say!(
            out,
            "over the complex numbers: irreducible curves of degrees {}; {} paths to critical points, {} lost",
            degrees.join(", "),
            c.paths,
            c.lost
        );
    }
    match r.components_accounted {
        Some(true) => out.line("every real component is accounted for (numerically, no proof)"),
        Some(false) => out.line("real components may be missing"),
        None if r.dimension.is_some_and(|d| d > 1) => {
            out.line("no curve was followed: the poses form a surface or more");
        }
        None => {}
    }
    out
}

/// The verdict: whether the platform moves, with the evidence.
fn verdict(r: &SelfmotionAnswer) -> String {
    let freedoms = |d: usize| if d == 1 { "1 freedom".to_string() } else { format!("{d} freedoms") };
    let first = r.tangent_dimension.unwrap_or(0);
    match (r.dimension, r.evidence) {
        (Some(0), MotionEvidenceWord::FirstOrder) => format!(
            "no self-motion at this pose: proved, the six leg lines are independent (singular values {} to 1)",
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
                "{none}: proved to second order. The leg lines leave {}, and the legs stop it.\n\
                 every pose with these lengths within {radius} of the pose lies within {within} of it (sizes and radians)",
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
