//! Records of joints that are not ideal: drive lengths, as distinct from the distances of the joints.

use schemars::JsonSchema;
use serde::Serialize;

use super::Number;
use machine::coupled::{CoupledOutcome, DriveSolutionWord, DriveState};

/// The drives at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DriveLengthsRecord {
    /// The lengths for the controller to command, in leg order, design units.
    pub lengths: [f64; 6],
    /// The part of the difference from the joint distances caused by axes that do not meet, design units.
    pub of_offsets: [f64; 6],
    /// The twist of each leg since home, degrees: its platform end against its base end; 0 without a lead.
    pub twists_deg: [f64; 6],
}

impl DriveLengthsRecord {
    pub(crate) fn new(distances: &[f64; 6], states: &[DriveState; 6]) -> Self {
        Self {
            lengths: std::array::from_fn(|i| distances[i] + states[i].correction),
            of_offsets: states.map(|s| s.of_offsets),
            twists_deg: states.map(|s| s.twist.to_degrees()),
        }
    }
}

/// The iteration for the pose with given drive lengths.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DriveSolutionRecord {
    /// The status of the solution.
    pub status: DriveSolutionWord,
    /// The reason if there is no pose; null: there is one.
    pub reason: Option<String>,
    /// The lengths that the drives show, design units.
    pub lengths: [f64; 6],
    /// The distances of the joints at the pose found, design units.
    pub distances: [f64; 6],
    /// Number of fixed-point steps.
    pub steps: u32,
    /// The greatest ratio of two successive changes of the corrections; 0 if there were none above rounding.
    pub factor: Number,
    /// Proved bound on the distance from this platform origin to the one with exactly these lengths, design units.
    pub position_bound: Option<Number>,
    /// Proved bound on the angle to the rotation with exactly these lengths, degrees.
    pub angle_bound_deg: Option<Number>,
    /// The contraction factor of the Newton map around the pose; null: not proved.
    pub contraction: Option<Number>,
}

impl DriveSolutionRecord {
    /// The record of drives that are followed.
    pub fn new(lengths: &[f64; 6], found: &CoupledOutcome) -> Self {
        let bound = found.status.bound();
        Self {
            status: found.status.word(),
            reason: found.status.failure(),
            lengths: *lengths,
            distances: found.distances,
            steps: found.steps,
            factor: Number(found.factor),
            position_bound: bound.map(|b| Number(b.position)),
            angle_bound_deg: bound.map(|b| Number(b.angle.to_degrees().next_up())),
            contraction: bound.map(|b| Number(b.contraction)),
        }
    }
}
