//! `equipod fk --near POSE`: one pose followed, or a trajectory row by row.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::lengths::{Given, Row};
use super::render;
use crate::cli::exit::Exit;
use crate::cli::output::{Answer, number};
use crate::design::Design;
use crate::fk::{Completeness, FkRoot, FkSolutions, Method, NearOutcome, NearSolver, Reality, SolutionSet};
use crate::geom::{ComplexPose, Pose};
use crate::manipulator::{LegLengths, Manipulator};
use crate::solve::certify::{Certifier, ProvedReality, RootCertificate};

/// Follows one pose. A row that is not tracked leaves the next to start from the last tracked pose.
pub(super) fn run(design: &Design, given: &Given, start: Pose, seed: u64) -> Answer {
    let m = design.manipulator();
    let solver = NearSolver::new(m);
    match given {
        Given::One(l) => {
            let outcome = solver.solve(&l.squared(), &start);
            let (record, solutions) = record(m, l, &start, &outcome, seed);
            let text = format!("{}{}", sentence(&outcome), render::text(&design.name, &solutions));
            Answer { exit: exit_of(&outcome), json: record, text }
        }
        Given::Rows(rows) => trajectory(m, &solver, rows, start, seed),
    }
}

fn trajectory(m: &Manipulator, solver: &NearSolver, rows: &[Row], start: Pose, seed: u64) -> Answer {
    let (mut exit, mut from) = (Exit::Yes, start);
    let mut text = String::from("line  outcome           segments  inverse condition  position\n");
    let mut records = Vec::with_capacity(rows.len());
    for row in rows {
        let outcome = solver.solve(&row.lengths.squared(), &from);
        exit = exit.max(exit_of(&outcome));
        let mut fields = Map::new();
        fields.insert("line".into(), json!(row.line));
        fields.insert("lengths".into(), json!(row.lengths.get()));
        fields.extend(record(m, &row.lengths, &from, &outcome, seed).0);
        records.push(Value::Object(fields));
        let (e, p) = (outcome.evidence(), outcome.pose().position);
        let _ = writeln!(
            text,
            "{:>4}  {:<16}  {:>8}  {:>17.3e}  [{:.6}, {:.6}, {:.6}]",
            row.line,
            outcome.name(),
            e.segments,
            e.inverse_condition,
            p.x,
            p.y,
            p.z
        );
        from = outcome.tracked().copied().unwrap_or(from);
    }
    let mut json = Map::new();
    json.insert("rows".into(), Value::Array(records));
    Answer { exit, json, text }
}

fn exit_of(outcome: &NearOutcome) -> Exit {
    if outcome.tracked().is_some() { Exit::Yes } else { Exit::Inconclusive }
}

/// The record of `fk` with at most one solution, and `near` with the evidence.
fn record(
    m: &Manipulator,
    lengths: &LegLengths,
    start: &Pose,
    outcome: &NearOutcome,
    seed: u64,
) -> (Map<String, Value>, FkSolutions) {
    let s = lengths.squared();
    let proved = |pose: &ComplexPose| {
        let certifier = Certifier::new(m, &s).ok()?;
        certifier.certify(pose).certificate().copied()
    };
    let root = outcome.tracked().map(|pose| {
        let pose = ComplexPose::from(*pose);
        let condition = 1.0 / outcome.evidence().inverse_condition;
        let certificate = proved(&pose);
        // only the certificate knows whether the root near the pose is real
        let reality = match certificate.map(|c| c.reality()) {
            Some(ProvedReality::Real) => Reality::Real,
            Some(ProvedReality::NonReal) => Reality::NonReal,
            Some(ProvedReality::Undecided) | None => Reality::Undecided,
        };
        FkRoot {
            pose,
            reality,
            certificate: certificate.map(RootCertificate::Study),
            multiplicity: 1,
            residual: pose.residual(m, &s),
            condition,
            dual_quaternion: None,
        }
    });
    let tracked = root.is_some();
    let solutions = FkSolutions {
        method: Method::Near,
        roots: root.into_iter().collect(),
        solution_set: SolutionSet::Isolated,
        completeness: Completeness::Unproved {
            reason: "one pose was followed from the pose given; others were not looked for".to_owned(),
            all_paths_accounted: tracked,
        },
        paths: Vec::new(),
        rejected: Vec::new(),
        pose_count: None,
        unproved: Vec::new(),
        seed,
    };
    let mut fields = render::json(&solutions);
    fields.insert("near".into(), evidence(start, outcome));
    (fields, solutions)
}

fn evidence(start: &Pose, outcome: &NearOutcome) -> Value {
    let e = outcome.evidence();
    let (fraction, reason) = match outcome {
        NearOutcome::Tracked { .. } => (1.0, Value::Null),
        NearOutcome::NearSingularity { fraction, .. } => (*fraction, Value::Null),
        NearOutcome::Lost { fraction, reason, .. } => (*fraction, json!(reason.to_string())),
    };
    json!({
        "outcome": outcome.name(),
        "reason": reason,
        "start": pose(start),
        "reached": pose(outcome.pose()),
        "fraction": number(fraction),
        "residual": number(e.residual),
        "inverse_condition": number(e.inverse_condition),
        "segments": e.segments,
        "newton_steps": e.newton_steps,
        "kantorovich": number(e.kantorovich),
        "distance": number(e.distance),
        "angle_deg": number(e.angle.to_degrees()),
    })
}

fn pose(p: &Pose) -> Value {
    let r = p.rotation.matrix();
    let rows: Value = (0..3).map(|i| (0..3).map(|j| number(r[(i, j)])).collect::<Value>()).collect();
    json!({ "R": rows, "p": p.position.iter().map(|x| number(*x)).collect::<Value>() })
}

/// One line for people, before the list of poses.
fn sentence(outcome: &NearOutcome) -> String {
    let e = outcome.evidence();
    match outcome {
        NearOutcome::Tracked { .. } => format!(
            "tracked in {} segment(s), {} Newton steps; moved by {:.6} and {:.4} degrees; inverse condition {:.2e}\n",
            e.segments,
            e.newton_steps,
            e.distance,
            e.angle.to_degrees(),
            e.inverse_condition
        ),
        NearOutcome::NearSingularity { fraction, .. } => format!(
            "NEAR A SINGULARITY: stopped after {:.4} % of the way, inverse condition {:.2e}\n",
            100.0 * fraction,
            e.inverse_condition
        ),
        NearOutcome::Lost { fraction, reason, .. } => {
            format!("LOST after {:.4} % of the way: {reason}\n", 100.0 * fraction)
        }
    }
}
