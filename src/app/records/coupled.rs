//! Records of joints that are not ideal: drive lengths, as distinct from the distances of the joints.

use schemars::JsonSchema;
use serde::Serialize;

use super::Number;
use machine::coupled::{CoupledOutcome, DriveSolutionWord, DriveState};

/// The drives at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DriveLengthsRecord {
    /// Lengths to command, in leg order, design units.
    pub lengths: [f64; 6],
    /// Difference from joint distances by axes that do not meet, design units.
    pub of_offsets: [f64; 6],
    /// Twist since home, degrees: its platform end against its base end; 0 without a lead.
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
    /// Status of the solution.
    pub status: DriveSolutionWord,
    /// Reason for no pose; null: there is one.
    pub reason: Option<String>,
    /// The lengths that the drives show, design units.
    pub lengths: [f64; 6],
    /// Joint distances at the pose, design units.
    pub distances: [f64; 6],
    /// Number of fixed-point steps.
    pub steps: u32,
    /// Greatest ratio of successive corrections; 0 if there were none above rounding.
    pub factor: Number,
    /// Proved bound on the position error, design units.
    pub position_bound: Option<Number>,
    /// Proved bound on the angle error, degrees.
    pub angle_bound_deg: Option<Number>,
    /// Contraction of the Newton map at the pose; null: not proved.
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
