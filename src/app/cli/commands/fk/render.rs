//! Poses as text.

use std::fmt::Write as _;

use crate::app::cli::numbers::listed;
use fk::{CompletenessWord, Method};
use platform::geom::{ComplexPose, Pose};
use records::{ClosureRecord, FkRowOutcome, FkRowRecord, SolutionRecord, SolutionSetRecord, SolvedRecord};

/// What people read.
pub(super) fn text(name: &str, s: &SolvedRecord) -> String {
    let mut out = String::new();
    if let SolutionSetRecord::PositiveDimensional { dimension_at_least, witness_points, .. } = &s.solution_set
    {
        let what = if *dimension_at_least == 1 { "curve" } else { "set" };
        let _ = writeln!(
            out,
            "{name}: self-motion, a {what} of poses of dimension {dimension_at_least} at least, {} points on it and {} isolated poses (method {})",
            witness_points.len(),
            s.finite_count,
            s.method
        );
    } else {
        count_line(&mut out, name, s);
    }
    let _ = writeln!(out, "{}, {}", completeness(s), s.completeness_reason);
    let points = s.solution_set.witness_points().iter().chain(&s.solutions).enumerate();
    for (i, r) in points.filter(|(_, r)| r.real != Some(false)) {
        real_pose(&mut out, i + 1, r);
    }
    let complex = s.solutions.iter().filter(|r| r.real == Some(false)).count();
    if complex > 0 {
        let _ = writeln!(out, "{complex} complex poses: see --json");
    }
    if !s.unproved.is_empty() {
        let _ = writeln!(
            out,
            "{} ends of paths without a proof (multiple poses, several close ones, or none), under `unproved` with --json; those that may be real:",
            s.unproved.len()
        );
        for (i, r) in s.unproved.iter().enumerate().filter(|(_, r)| r.real != Some(false)) {
            unproved_pose(&mut out, i + 1, r);
        }
    }
    out
}

/// Which real poses have all cranks on the sides that the design keeps, by the numbers of [`text`].
pub(super) fn elbows(s: &SolvedRecord) -> String {
    let points = s.solution_set.witness_points().iter().chain(&s.solutions).enumerate();
    let kept = points.filter(|(_, r)| r.real_pose.and_then(|p| p.elbow_kept).is_some_and(|k| k == [true; 6]));
    let kept: Vec<String> = kept.map(|(i, _)| (i + 1).to_string()).collect();
    match kept.len() {
        0 => "no real pose has all cranks on the sides that the design keeps\n".into(),
        1 => format!("all cranks are on the sides that the design keeps in pose {}\n", kept[0]),
        _ => format!("all cranks are on the sides that the design keeps in poses {}\n", kept.join(", ")),
    }
}

fn count_line(out: &mut String, name: &str, s: &SolvedRecord) {
    let _ = write!(out, "{name}: {} finite poses, {} of them real", s.finite_count, s.real_count);
    if s.undecided_count > 0 {
        let _ = write!(out, ", {} undecided", s.undecided_count);
    }
    let _ = writeln!(out, " (method {})", s.method);
}

/// What stands before the reason.
fn completeness(s: &SolvedRecord) -> &'static str {
    let moves = matches!(s.solution_set, SolutionSetRecord::PositiveDimensional { .. });
    let as_written =
        matches!(s.solution_set, SolutionSetRecord::PositiveDimensional { dimension_established: true, .. });
    match (s.completeness, moves, s.all_paths_accounted) {
        (CompletenessWord::Proved, ..) => "complete: proved",
        (CompletenessWord::Modular, ..) => "complete: modulo random primes",
        (CompletenessWord::Unproved, true, true) if as_written => "self-motion: established",
        (CompletenessWord::Unproved, true, true) => "self-motion within the rounding of the lengths",
        (CompletenessWord::Unproved, true, false) => "UNDECIDED: self-motion",
        (CompletenessWord::Unproved, false, true) => "complete: not proved",
        (CompletenessWord::Unproved, false, false) => "INCOMPLETE: roots may be missing",
    }
}

/// The real part of a pose, with roll, pitch and yaw in degrees.
fn shown(r: &SolutionRecord) -> (Pose, [f64; 3]) {
    let pose = ComplexPose::from(&r.pose).real_part();
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    (pose, [roll, pitch, yaw].map(f64::to_degrees))
}

fn real_pose(out: &mut String, number: usize, r: &SolutionRecord) {
    let (pose, angles) = shown(r);
    let undecided = if r.real.is_none() { "  reality undecided" } else { "" };
    let certified = if r.certified { "  certified" } else { "" };
    let _ = writeln!(
        out,
        "{number:>3}  p = {}  rpy_deg = {}  residual {:.1e}{certified}{undecided}",
        listed(pose.position.iter().copied(), 6),
        listed(angles, 4),
        r.residual.0,
    );
}

/// Where a multiple pose may be, with the number of paths that end there.
fn unproved_pose(out: &mut String, number: usize, r: &SolutionRecord) {
    let (pose, angles) = shown(r);
    let _ = writeln!(
        out,
        "{number:>3}  near p = {}  rpy_deg = {}  paths {}",
        listed(pose.position.iter().copied(), 4),
        listed(angles, 2),
        r.multiplicity,
    );
}

/// One line of the table for many rows.
pub(super) fn table_row(row: &FkRowRecord) -> String {
    let s = match &row.outcome {
        FkRowOutcome::Solved(answer) => &answer.solved,
        FkRowOutcome::Failed(why) => return format!("{:>4}  {}\n", row.line, why.error.message),
    };
    let complete = match s.completeness {
        _ if !s.solution_set.witness_points().is_empty() => "SELF-MOTION",
        CompletenessWord::Proved => "proved",
        CompletenessWord::Modular => "modular",
        CompletenessWord::Unproved if s.all_paths_accounted => "all paths accounted",
        CompletenessWord::Unproved => "ROOTS MAY BE MISSING",
    };
    format!(
        "{:>4}  {:<13}  {:>6}  {:>4}  {complete}\n",
        row.line,
        Method::name(s.method),
        s.finite_count,
        s.real_count
    )
}

/// The closure polynomial in two or three lines.
pub(super) fn closure(closure: &ClosureRecord) -> String {
    let p = match closure {
        ClosureRecord::Polynomial(p) => p,
        ClosureRecord::None { error } => return format!("no closure polynomial: {error}\n"),
    };
    let [x, y] = &p.unknown;
    let mut out = String::new();
    let _ = writeln!(
        out,
        "closure polynomial in the squared distance of {x} and {y}: degree {} before, {} after removal of singular factors, {} distinct roots, {} real",
        p.degree_before,
        p.degree.unwrap_or(0),
        p.distinct_roots,
        p.real_roots.len()
    );
    let roots: Vec<String> =
        p.real_roots.iter().map(|[low, high]| format!("{:.9}", 0.5 * (low.0 + high.0))).collect();
    if !roots.is_empty() {
        let _ = writeln!(out, "its real roots: {}", roots.join(", "));
    }
    let _ = match p.poses_real_proved {
        Some(n) => writeln!(out, "real poses: {n}, proved by its real roots"),
        None => writeln!(out, "real poses: not decided by its real roots alone"),
    };
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use fk::{
        Completeness, FkRoot, FkSolutions, Method, PathEnd, PathReport, Reality, Reason, Rejected,
        RejectionReason, SolutionSet,
    };
    use nalgebra::{Rotation3, Vector3};
    use platform::geom::{ComplexPose, Pose};
    use serde_json::{Value, json};

    fn solutions(condition: f64) -> FkSolutions {
        let pose = Pose { rotation: Rotation3::identity(), position: Vector3::new(1.0, 2.0, 0.1 + 0.2) };
        let root = |reality| FkRoot {
            pose: ComplexPose::from(pose),
            reality,
            certificate: None,
            multiplicity: 2,
            residual: 1e-15,
            condition,
            dual_quaternion: None,
        };
        FkSolutions {
            method: Method::Homotopy,
            roots: [Reality::Real, Reality::Undecided, Reality::NonReal].map(root).to_vec(),
            solution_set: SolutionSet::Isolated,
            completeness: Completeness::unproved([Reason::LegsNearlyDependent]),
            paths: vec![PathReport {
                start: 3,
                end: PathEnd::AtInfinity,
                root: None,
                mirror_root: None,
                steps: 9,
                rejections: 1,
                winding: 0,
                isotropy: 0.5,
                retracked: 0,
            }],
            rejected: vec![Rejected { reason: RejectionReason::Duplicate, residual: 0.0 }],
            pose_count: None,
            unproved: Vec::new(),
            seed: 7,
        }
    }

    #[test]
    fn the_document_has_the_fields_of_the_contract() {
        let fields = serde_json::to_value(SolvedRecord::from(&solutions(10.0))).unwrap();
        assert_eq!(fields["completeness"], "unproved");
        assert_eq!((&fields["finite_count"], &fields["real_count"]), (&json!(3), &json!(1)));
        assert_eq!(fields["finite_count_with_multiplicity"], 6);
        let real: Vec<&Value> = fields["solutions"].as_array().unwrap().iter().map(|s| &s["real"]).collect();
        assert_eq!(real, [&json!(true), &Value::Null, &json!(false)]);
        let first = &fields["solutions"][0];
        assert_eq!(first["R"]["re"], json!([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]));
        assert_eq!(first["p"], json!({ "re": [1.0, 2.0, 0.1 + 0.2], "im": [0.0, 0.0, 0.0] }));
        assert!(fields.to_string().contains("0.30000000000000004"), "all digits");
        assert_eq!(fields["paths"][0]["end"], "at_infinity");
        assert_eq!(fields["rejected"][0]["reason"], "duplicate");
        assert!(fields.get("notes").is_none());
    }

    #[test]
    fn what_is_not_finite_is_null_with_a_word_of_explanation() {
        let fields = serde_json::to_value(SolvedRecord::from(&solutions(f64::INFINITY))).unwrap();
        assert!(fields["solutions"][0]["condition"].is_null());
        assert!(fields["notes"][0].as_str().unwrap().contains("null stands for"));
    }

    #[test]
    fn people_are_told_when_roots_may_be_missing() {
        let shown = text("x", &SolvedRecord::from(&solutions(10.0)));
        assert!(
            shown.starts_with("x: 3 finite poses, 1 of them real, 1 undecided (method homotopy)\nINCOMPLETE")
        );
    }
}
