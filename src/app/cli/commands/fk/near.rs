//! `equipod fk --near POSE`: tracks one pose, or a trajectory row by row.

use super::lengths::{GivenLengths, ShownLengths};
use super::{PoseTable, answered};
use crate::app::cli::{Answer, Exit};
use ask::{Design, PoseFrames};
use fk::solve::certify::{Certifier, ProvedReality, RootCertificate};
use fk::{Completeness, FkRoot, FkSolutions, Method, NearOutcome, NearSolver, Reality, Reason};
use platform::geom::{ComplexPose, Pose};
use platform::manipulator::{LegLengths, Manipulator, inverse_condition, jacobian};
use records::{
    FkAnswer, FkOneAnswer, FkRowOutcome, FkRowRecord, NearRecord, PoseUncertaintyRecord, SolvedRecord,
};

/// The tracked machine: joints and legs, the pose from which distances are measured, and the length that converts
/// angles to lengths.
pub(super) struct TrackedMachine<'a> {
    pub(super) m: &'a Manipulator,
    pub(super) frames: PoseFrames,
    pub(super) characteristic_length: f64,
}

impl<'a> TrackedMachine<'a> {
    pub(super) fn of(design: &'a Design, frames: &PoseFrames) -> Self {
        Self {
            m: design.manipulator(),
            frames: *frames,
            characteristic_length: design.characteristic_length(),
        }
    }
}

/// The result for one set of lengths.
pub(super) struct TrackedRow {
    pub(super) exit: Exit,
    pub(super) record: FkOneAnswer,
}

/// The answer for one set of lengths, or for each row of a table in turn.
pub(super) fn followed(
    design: &Design,
    given: &GivenLengths,
    table: &PoseTable,
    mut step: impl FnMut(&ShownLengths) -> TrackedRow,
) -> Answer {
    match given {
        GivenLengths::One(l) => {
            let TrackedRow { exit, record } = step(l);
            answered(exit, FkAnswer::One(Box::new(record)), design, table)
        }
        GivenLengths::Rows(series) => {
            let mut exit = Exit::Yes;
            let mut rows = Vec::with_capacity(series.rows.len());
            for row in &series.rows {
                let found = step(&row.value);
                exit = exit.max(found.exit);
                rows.push(FkRowRecord {
                    line: row.line,
                    time: row.time,
                    lengths: row.value.shown,
                    angles_deg: None,
                    outcome: FkRowOutcome::Solved(Box::new(found.record)),
                });
            }
            let table = PoseTable { time_name: series.time_name.clone(), ..*table };
            answered(exit, FkAnswer::rows(rows), design, &table)
        }
    }
}

/// Tracks one pose. After a failed row, the next row starts from the last tracked pose.
pub(super) fn run(
    design: &Design,
    given: &GivenLengths,
    start: Pose,
    seed: u64,
    table: &PoseTable,
) -> Answer {
    let (solver, machine) =
        (NearSolver::new(design.manipulator()), TrackedMachine::of(design, &table.frames));
    let known = design.machine_uncertainty();
    let mut from = start;
    followed(design, given, table, |given| {
        let lengths = &given.distances;
        let outcome = solver.solve(&lengths.squared(), &from);
        let mut record = record(&machine, lengths, &from, &outcome, seed);
        if let Some(near) = &mut record.near {
            near.uncertainty =
                known.as_ref().and_then(|known| PoseUncertaintyRecord::at(design, known, outcome.pose()));
        }
        from = outcome.tracked().copied().unwrap_or(from);
        TrackedRow { exit: exit_of(&outcome), record }
    })
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

/// The proof for a tracked pose.
#[derive(Debug, Clone, Copy)]
pub(super) enum Proof {
    /// A certificate for these lengths.
    Certificate,
    /// No certificate; `None` if the pose does not belong to the given lengths.
    Of(Option<Reality>),
}

/// The record of a pose tracked from `start`.
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
        // only the certificate tells whether the root near the pose is real
        let reality = match certificate.map(|c| c.reality()) {
            None if let Proof::Of(Some(known)) = proof => known,
            Some(ProvedReality::Real) => Reality::Real,
            Some(ProvedReality::NonReal) => Reality::NonReal,
            Some(ProvedReality::Undecided) | None => Reality::Undecided,
        };
        let mut root = FkRoot::new(pose, reality, pose.residual(m, &s), condition);
        root.certificate = certificate.map(RootCertificate::Study);
        root
    });
    let followed = Completeness::unproved([Reason::OnePoseFollowed { found: root.is_some() }]);
    let solutions = FkSolutions::new(Method::Near, root.into_iter().collect(), followed, seed);
    FkOneAnswer {
        near: Some(NearRecord::new(start, outcome, conditioning(machine, outcome))),
        ..SolvedRecord::from(&solutions).with_real_poses(m, &machine.frames).into()
    }
}

/// The inverse condition number of the Jacobian at the pose reached.
fn conditioning(machine: &TrackedMachine<'_>, outcome: &NearOutcome) -> f64 {
    inverse_condition(&jacobian(machine.m, outcome.pose(), machine.characteristic_length))
}
