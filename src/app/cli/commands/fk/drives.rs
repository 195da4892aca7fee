//! `fk --near` for joints that are not ideal: the pose for drive lengths.

use super::PoseTable;
use super::lengths::{GivenLengths, ShownLengths};
use super::near::{self, Proof, TrackedMachine, TrackedRow};
use crate::app::cli::{Answer, Exit, Failure};
use ask::Design;
use fk::{NearWord, Reality};
use machine::coupled::{CoupledLegs, CoupledStatus, CoupledTracker};
use platform::geom::Pose;
use platform::manipulator::LegLengths;
use records::DriveSolutionRecord;

/// Refuses methods that would take drive lengths for distances of joints.
pub(super) fn refuse_without_start(design: &Design) -> Result<(), Failure> {
    if !design.hardware.is_coupled() {
        return Ok(());
    }
    let message = "the joints are not ideal; all poses are found only for ideal joints";
    let help = "give --near POSE to follow one pose, or remove `offset` and `screw_lead` from the file for the machine with ideal joints";
    Err(Failure::refused("design::not_ideal", message.to_string()).with_help(help))
}

/// Tracks one pose from `start`. After a row without a pose, the next starts from the last pose.
pub(super) fn run(
    design: &Design,
    legs: CoupledLegs,
    given: &GivenLengths,
    start: Pose,
    seed: u64,
    table: &PoseTable,
) -> Answer {
    let machine = TrackedMachine::of(design, &table.frames);
    let mut tracker = CoupledTracker::new(legs, start);
    near::followed(design, given, table, |drives| one(&machine, &mut tracker, drives, seed))
}

fn one(
    machine: &TrackedMachine<'_>,
    tracker: &mut CoupledTracker,
    given: &ShownLengths,
    seed: u64,
) -> TrackedRow {
    let from = tracker.pose();
    let drives = given.distances;
    let found = tracker.step(&drives.get());
    let distances = LegLengths::try_new(found.distances).unwrap_or(drives);
    // certificates concern distances; the proof for drive lengths is in the record of the drives
    let proof = match found.status {
        CoupledStatus::Proved(_) => Proof::Of(Some(Reality::Real)),
        CoupledStatus::Unproved => Proof::Of(Some(Reality::Undecided)),
        _ => Proof::Of(None),
    };
    let mut record = near::record_with(machine, &distances, (&from, &found.near), proof, seed);
    let solution = DriveSolutionRecord::new(&given.shown, &found);
    if let (Some(near), Some(why)) = (&mut record.near, &solution.reason)
        && near.outcome == NearWord::Tracked
    {
        (near.outcome, near.reason) = (NearWord::Lost, Some(why.clone()));
    }
    record.drives = Some(solution);
    let exit = if matches!(found.status, CoupledStatus::Proved(_)) { Exit::Yes } else { Exit::Inconclusive };
    TrackedRow { exit, record }
}
