//! `equipod fk --near POSE`: one pose followed, or a trajectory row by row.

use std::fmt::Write as _;

use super::lengths::{GivenLengths, ShownLengths};
use super::{PoseTable, render};
use crate::app::cli::exit::Exit;
use crate::app::cli::numbers::listed;
use crate::app::cli::output::Answer;
use crate::app::cli::poses;
use ask::Design;
use fk::solve::certify::{Certifier, ProvedReality, RootCertificate};
use fk::{Completeness, FkRoot, FkSolutions, Method, NearOutcome, NearSolver, Reality, Reason, SolutionSet};
use platform::geom::{ComplexPose, Pose};
use platform::manipulator::{LegLengths, Manipulator, inverse_condition, jacobian};
use records::{
    FkAnswer, FkOneAnswer, FkRowOutcome, FkRowRecord, FkRowsAnswer, NearRecord, PoseUncertaintyRecord,
    SolvedRecord,
};

/// What is followed: joints and legs, from where real poses are measured, and the length that turns angles into
/// lengths.
pub(super) struct TrackedMachine<'a> {
    pub(super) m: &'a Manipulator,
    pub(super) home: Pose,
    pub(super) characteristic_length: f64,
}

impl<'a> TrackedMachine<'a> {
    pub(super) fn of(design: &'a Design) -> Self {
        Self {
            m: design.manipulator(),
            home: poses::home(design),
            characteristic_length: design.characteristic_length(),
        }
    }
}

/// What came of one set of lengths.
pub(super) struct TrackedRow {
    pub(super) exit: Exit,
    pub(super) record: FkOneAnswer,
    /// What people are told of it before the list of poses, with the ends of its lines.
    pub(super) sentence: String,
    /// The same in a table for many rows.
    pub(super) line: String,
}

/// The answer about one set of lengths, or about each row of a table in turn; `step` is given the lengths and the
/// number of their line.
pub(super) fn followed(
    design: &Design,
    given: &GivenLengths,
    table: &PoseTable,
    titles: &str,
    mut step: impl FnMut(&ShownLengths, usize) -> TrackedRow,
) -> Answer {
    match given {
        GivenLengths::One(l) => {
            let TrackedRow { exit, record, sentence, .. } = step(l, 0);
            let text = format!("{sentence}{}", render::text(&design.name, &record.solved));
            let record = FkAnswer::One(Box::new(record));
            let text = table.text(design, &record).unwrap_or(text);
            Answer::new(exit, record, text)
        }
        GivenLengths::Rows(series) => {
            let (mut exit, mut text) = (Exit::Yes, format!("{titles}\n"));
            let mut rows = Vec::with_capacity(series.rows.len());
            for row in &series.rows {
                let found = step(&row.value, row.line);
                exit = exit.max(found.exit);
                let _ = writeln!(text, "{}", found.line);
                rows.push(FkRowRecord {
                    line: row.line,
                    time: row.time,
                    lengths: row.value.shown,
                    angles_deg: None,
                    outcome: FkRowOutcome::Solved(Box::new(found.record)),
                });
            }
            let record = FkAnswer::Rows(FkRowsAnswer { rows });
            let table = PoseTable { time_name: series.time_name.clone(), ..*table };
            let text = table.text(design, &record).unwrap_or(text);
            Answer::new(exit, record, text)
        }
    }
}

/// Follows one pose. A row that is not tracked leaves the next to start from the last tracked pose.
pub(super) fn run(
    design: &Design,
    given: &GivenLengths,
    start: Pose,
    seed: u64,
    table: &PoseTable,
) -> Answer {
    let (solver, machine) = (NearSolver::new(design.manipulator()), TrackedMachine::of(design));
    let known = design.machine_uncertainty();
    let mut from = start;
    followed(
        design,
        given,
        table,
        "line  outcome           segments  inverse condition  position",
        |given, number| {
            let lengths = &given.distances;
            let outcome = solver.solve(&lengths.squared(), &from);
            let mut record = record(&machine, lengths, &from, &outcome, seed);
            let uncertainty =
                known.as_ref().and_then(|known| PoseUncertaintyRecord::at(design, known, outcome.pose()));
            let mut sentence = sentence(&machine, &outcome);
            if let Some(found) = &uncertainty {
                let _ = writeln!(
                    sentence,
                    "standard deviations by what the calibration does not know: {:.3e} {} and {:.3e} degrees",
                    found.position.0, design.units, found.rotation_deg.0
                );
            }
            if let Some(near) = &mut record.near {
                near.uncertainty = uncertainty;
            }
            from = outcome.tracked().copied().unwrap_or(from);
            TrackedRow { exit: exit_of(&outcome), record, sentence, line: line(number, &machine, &outcome) }
        },
    )
}

/// One line of the table for many rows.
pub(super) fn line(number: usize, machine: &TrackedMachine<'_>, outcome: &NearOutcome) -> String {
    let e = outcome.evidence();
    format!(
        "{number:>4}  {:<16}  {:>8}  {:>17.3e}  {}",
        outcome.name(),
        e.segments,
        conditioning(machine, outcome),
        listed(outcome.pose().position.iter().copied(), 6)
    )
}

pub(super) fn exit_of(outcome: &NearOutcome) -> Exit {
    if outcome.tracked().is_some() { Exit::Yes } else { Exit::Inconclusive }
}

/// The record of `fk` with at most one solution, and `near` with the evidence.
pub(super) fn record(
    machine: &TrackedMachine<'_>,
    lengths: &LegLengths,
    start: &Pose,
    outcome: &NearOutcome,
    seed: u64,
) -> FkOneAnswer {
    record_with(machine, lengths, (start, outcome), Proof::Certificate, seed)
}

/// What is known of a pose that was tracked.
#[derive(Debug, Clone, Copy)]
pub(super) enum Proof {
    /// What a certificate for these lengths says.
    Certificate,
    /// No certificate; `None` where the pose is not one for the lengths asked for.
    Of(Option<Reality>),
}

/// The record of a pose followed from `start`.
pub(super) fn record_with(
    machine: &TrackedMachine<'_>,
    lengths: &LegLengths,
    (start, outcome): (&Pose, &NearOutcome),
    proof: Proof,
    seed: u64,
) -> FkOneAnswer {
    let (m, s) = (machine.m, lengths.squared());
    let proved = |pose: &ComplexPose| {
        if let Proof::Of(_) = proof {
            return None;
        }
        let certifier = Certifier::new(m, &s).ok()?;
        certifier.certify(pose).certificate().copied()
    };
    let tracked = outcome.tracked().filter(|_| !matches!(proof, Proof::Of(None)));
    let root = tracked.map(|pose| {
        let pose = ComplexPose::from(*pose);
        let condition = 1.0 / outcome.evidence().frobenius_ratio;
        let certificate = proved(&pose);
        // only the certificate knows whether the root near the pose is real
        let reality = match certificate.map(|c| c.reality()) {
            None if let Proof::Of(Some(known)) = proof => known,
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
        completeness: Completeness::unproved([Reason::OnePoseFollowed { found: tracked }]),
        paths: Vec::new(),
        rejected: Vec::new(),
        pose_count: None,
        unproved: Vec::new(),
        seed,
    };
    FkOneAnswer {
        near: Some(NearRecord::new(start, outcome, conditioning(machine, outcome))),
        ..SolvedRecord::from(&solutions).with_real_poses(m, &machine.home).into()
    }
}

/// The inverse condition number of the Jacobian at the pose reached.
fn conditioning(machine: &TrackedMachine<'_>, outcome: &NearOutcome) -> f64 {
    inverse_condition(&jacobian(machine.m, outcome.pose(), machine.characteristic_length))
}

/// One line for people, before the list of poses.
pub(super) fn sentence(machine: &TrackedMachine<'_>, outcome: &NearOutcome) -> String {
    let e = outcome.evidence();
    match outcome {
        NearOutcome::Tracked { .. } => format!(
            "tracked in {} segment(s), {} Newton steps; moved by {:.6} and {:.4} degrees; inverse condition {:.2e}\n",
            e.segments,
            e.newton_steps,
            e.distance,
            e.angle.to_degrees(),
            conditioning(machine, outcome)
        ),
        NearOutcome::NearSingularity { fraction, .. } => format!(
            "NEAR A SINGULARITY: stopped after {:.4} % of the way, inverse condition {:.2e}\n",
            100.0 * fraction,
            conditioning(machine, outcome)
        ),
        NearOutcome::Lost { fraction, reason, .. } => {
            format!("LOST after {:.4} % of the way: {reason}\n", 100.0 * fraction)
        }
    }
}
