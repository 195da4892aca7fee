//! Records of roots as JSON and as text.

use std::fmt::Write as _;

use num_complex::Complex64;
use serde_json::{Map, Value, json};

use super::certificate;
use crate::cli::output::number;
use crate::fk::{
    Completeness, FkRoot, FkSolutions, PathReport, Reality, Rejected, RejectionReason, SolutionSet,
};
use crate::solve::pose_count::PoseSet;

/// The fields of the document.
pub(in crate::cli::commands) fn json(s: &FkSolutions) -> Map<String, Value> {
    let undecided = s.roots.iter().filter(|r| r.reality == Reality::Undecided).count();
    let mut fields = Map::new();
    let mut put = |key: &str, value: Value| fields.insert(key.into(), value);
    put("method", json!(s.method.name()));
    put("completeness", json!(s.completeness.name()));
    put("completeness_reason", json!(s.completeness_reason()));
    put("all_paths_accounted", json!(s.all_accounted()));
    put("finite_count", json!(s.roots.len()));
    put("finite_count_with_multiplicity", json!(s.count_with_multiplicity()));
    put("real_count", json!(s.assembly_modes().count()));
    put("undecided_count", json!(undecided));
    put("missing_count", json!(s.missing()));
    put("pose_count", pose_count(s));
    put("solutions", s.roots.iter().map(root).collect());
    put("solution_set", json!(s.solution_set.name()));
    if let SolutionSet::PositiveDimensional { dimension, witnesses, established } = &s.solution_set {
        let counted = s.pose_count.as_ref().map(|c| &c.set);
        let exact = match counted {
            Some(PoseSet::PositiveDimensional { dimension, .. }) => Some(dimension),
            _ => None,
        };
        put("dimension", json!(exact));
        put("dimension_at_least", json!(dimension));
        put("dimension_established", json!(established));
        put("degree", if *established { json!(witnesses.len()) } else { Value::Null });
        put("witness_points", witnesses.iter().map(root).collect());
    }
    put("paths", s.paths.iter().map(path).collect());
    put("rejected", s.rejected.iter().map(rejected).collect());
    put("unproved", s.unproved.iter().map(root).collect());
    put("seed", json!(s.seed));
    if !all_finite(s) {
        put("notes", json!(["null stands for a number that is infinite or not a number"]));
    }
    fields
}

/// The number of poses, by theorem or counted without finding them.
fn pose_count(s: &FkSolutions) -> Value {
    let Some(c) = &s.pose_count else {
        return match s.completeness {
            Completeness::Proved { .. } => json!({
                "finite": s.certified_count(), "by_degree": null, "dimension": null, "degree": null, "undecided": null,
                "evidence": "proved", "error_probability": null, "primes": [],
            }),
            _ => Value::Null,
        };
    };
    let (finite, by_degree, dimension, degree, undecided) = match &c.set {
        PoseSet::Finite { count, by_degree } => (Some(count), Some(by_degree), None, None, None),
        PoseSet::PositiveDimensional { dimension, degree } => {
            (None, None, Some(dimension), Some(degree), None)
        }
        PoseSet::Undecided { why } => (None, None, None, None, Some(why.name())),
    };
    json!({
        "finite": finite, "by_degree": by_degree, "dimension": dimension, "degree": degree, "undecided": undecided,
        "evidence": "modular",
        "error_probability": if undecided.is_some() { Value::Null } else { json!(c.error_probability) },
        // more digits than a double has
        "primes": c.primes.iter().map(u64::to_string).collect::<Vec<_>>(),
    })
}

fn root(r: &FkRoot) -> Value {
    let rotation = |part: fn(&Complex64) -> f64| -> Value {
        (0..3).map(|i| (0..3).map(|j| number(part(&r.pose.rotation[(i, j)]))).collect::<Value>()).collect()
    };
    let position =
        |part: fn(&Complex64) -> f64| -> Value { r.pose.position.iter().map(|z| number(part(z))).collect() };
    let real = match r.reality {
        Reality::Real => Value::Bool(true),
        Reality::NonReal => Value::Bool(false),
        Reality::Undecided => Value::Null,
    };
    json!({
        "R": { "re": rotation(|z| z.re), "im": rotation(|z| z.im) },
        "p": { "re": position(|z| z.re), "im": position(|z| z.im) },
        "real": real,
        "certified": r.certified(),
        "certificate": r.certificate.as_ref().map(certificate::json),
        "multiplicity": r.multiplicity,
        "residual": number(r.residual),
        "condition": number(r.condition),
        "dual_quaternion": r.dual_quaternion.map(|x| {
            json!({ "re": x.map(|z| number(z.re)), "im": x.map(|z| number(z.im)) })
        }),
    })
}

fn path(p: &PathReport) -> Value {
    json!({
        "start": p.start, "end": p.end.name(), "root": p.root, "mirror_root": p.mirror_root,
        "steps": p.steps, "rejections": p.rejections, "winding": p.winding, "isotropy": number(p.isotropy),
        "retracked": p.retracked,
    })
}

fn rejected(r: &Rejected) -> Value {
    let reason = match r.reason {
        RejectionReason::ResidualTooLarge => "residual_too_large",
        RejectionReason::Duplicate => "duplicate",
        RejectionReason::NotCertified => "not_certified",
        RejectionReason::NotFinite => "not_finite",
    };
    json!({ "reason": reason, "residual": number(r.residual) })
}

fn all_finite(s: &FkSolutions) -> bool {
    let roots = s.roots.iter().chain(&s.unproved).all(|r| {
        let pose = r.pose.rotation.iter().chain(r.pose.position.iter()).all(|z| z.is_finite());
        pose && r.residual.is_finite() && r.condition.is_finite()
    });
    let paths = s.paths.iter().all(|p| p.isotropy.is_finite());
    roots && paths && s.rejected.iter().all(|r| r.residual.is_finite())
}

/// What people read.
pub(super) fn text(name: &str, s: &FkSolutions) -> String {
    let mut out = String::new();
    if let SolutionSet::PositiveDimensional { dimension, witnesses, .. } = &s.solution_set {
        let what = if *dimension == 1 { "curve" } else { "set" };
        let _ = writeln!(
            out,
            "{name}: self-motion, a {what} of poses of dimension {dimension} at least, {} points on it and {} isolated poses (method {})",
            witnesses.len(),
            s.roots.len(),
            s.method
        );
    } else {
        count_line(&mut out, name, s);
    }
    completeness_line(&mut out, s);
    let points = s.solution_set.witnesses().iter().chain(&s.roots).enumerate();
    for (i, r) in points.filter(|(_, r)| r.reality != Reality::NonReal) {
        real_pose(&mut out, i + 1, r);
    }
    let complex = s.roots.iter().filter(|r| r.reality == Reality::NonReal).count();
    if complex > 0 {
        let _ = writeln!(out, "{complex} complex poses: see --json");
    }
    if !s.unproved.is_empty() {
        let _ = writeln!(
            out,
            "{} ends of paths without a proof (multiple poses, several close ones, or none), under `unproved` with --json; those that may be real:",
            s.unproved.len()
        );
        for (i, r) in s.unproved.iter().enumerate().filter(|(_, r)| r.reality != Reality::NonReal) {
            unproved_pose(&mut out, i + 1, r);
        }
    }
    out
}

fn count_line(out: &mut String, name: &str, s: &FkSolutions) {
    let real = s.assembly_modes().count();
    let undecided = s.roots.iter().filter(|r| r.reality == Reality::Undecided).count();
    let _ = write!(out, "{name}: {} finite poses, {real} of them real", s.roots.len());
    if undecided > 0 {
        let _ = write!(out, ", {undecided} undecided");
    }
    let _ = writeln!(out, " (method {})", s.method);
}

fn completeness_line(out: &mut String, s: &FkSolutions) {
    let reason = s.completeness_reason();
    match &s.completeness {
        Completeness::Proved { .. } => {
            let _ = writeln!(out, "complete: proved, {reason}");
        }
        Completeness::Modular => {
            let _ = writeln!(out, "complete: modulo random primes, {reason}");
        }
        Completeness::Unproved { all_paths_accounted, .. } => {
            let head = if matches!(s.solution_set, SolutionSet::PositiveDimensional { .. }) {
                if *all_paths_accounted { "self-motion: established" } else { "UNDECIDED: self-motion" }
            } else if *all_paths_accounted {
                "complete: not proved"
            } else {
                "INCOMPLETE: roots may be missing"
            };
            let _ = writeln!(out, "{head}, {reason}");
        }
    }
}

fn real_pose(out: &mut String, number: usize, r: &FkRoot) {
    let pose = r.pose.real_part();
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let undecided = if r.reality == Reality::Undecided { "  reality undecided" } else { "" };
    let certified = if r.certified() { "  certified" } else { "" };
    let _ = writeln!(
        out,
        "{number:>3}  p = [{:.6}, {:.6}, {:.6}]  rpy_deg = [{:.4}, {:.4}, {:.4}]  residual {:.1e}{certified}{undecided}",
        pose.position.x,
        pose.position.y,
        pose.position.z,
        roll.to_degrees(),
        pitch.to_degrees(),
        yaw.to_degrees(),
        r.residual,
    );
}

/// Where a multiple pose may be, with the number of paths that end there.
fn unproved_pose(out: &mut String, number: usize, r: &FkRoot) {
    let pose = r.pose.real_part();
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let p = pose.position;
    let _ = writeln!(
        out,
        "{number:>3}  near p = [{:.4}, {:.4}, {:.4}]  rpy_deg = [{:.2}, {:.2}, {:.2}]  paths {}",
        p.x,
        p.y,
        p.z,
        roll.to_degrees(),
        pitch.to_degrees(),
        yaw.to_degrees(),
        r.multiplicity,
    );
}

/// One line of the table for many rows.
pub(super) fn table_row(line: usize, s: &FkSolutions) -> String {
    let complete = match &s.completeness {
        _ if !s.solution_set.witnesses().is_empty() => "SELF-MOTION",
        Completeness::Proved { .. } => "proved",
        Completeness::Modular => "modular",
        Completeness::Unproved { all_paths_accounted: true, .. } => "all paths accounted",
        Completeness::Unproved { .. } => "ROOTS MAY BE MISSING",
    };
    format!(
        "{line:>4}  {:<13}  {:>6}  {:>4}  {complete}\n",
        s.method.name(),
        s.roots.len(),
        s.assembly_modes().count()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fk::{Method, PathEnd};
    use crate::geom::{ComplexPose, Pose};
    use nalgebra::{Rotation3, Vector3};

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
            completeness: Completeness::Unproved { reason: "paths".into(), all_paths_accounted: false },
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
        let fields = Value::Object(json(&solutions(10.0)));
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
        let fields = Value::Object(json(&solutions(f64::INFINITY)));
        assert!(fields["solutions"][0]["condition"].is_null());
        assert!(fields["notes"][0].as_str().unwrap().contains("null stands for"));
    }

    #[test]
    fn people_are_told_when_roots_may_be_missing() {
        let shown = text("x", &solutions(10.0));
        assert!(
            shown.starts_with("x: 3 finite poses, 1 of them real, 1 undecided (method homotopy)\nINCOMPLETE")
        );
    }
}
