//! What joints that are not ideal add to answers: the lengths that drives have in place of distances of joints.

use schemars::JsonSchema;
use serde::Serialize;

use super::Number;
use machine::coupled::{CoupledOutcome, DriveSolutionWord, DriveState};

/// The drives at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DriveLengthsRecord {
    /// The lengths that a controller has to command, in leg order, design units.
    pub lengths: [f64; 6],
    /// What of the difference from the distances of the joints is due to axes that do not meet.
    pub of_offsets: [f64; 6],
    /// The turns of the platform ends of the legs about them against the base ends, from home; 0 without a lead.
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

/// How the pose for lengths of drives was found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DriveSolutionRecord {
    /// What is known of it.
    pub status: DriveSolutionWord,
    /// Why there is no pose.
    pub reason: Option<String>,
    /// The lengths that the drives show.
    pub lengths: [f64; 6],
    /// The distances of the joints at the pose, to which it was followed.
    pub distances: [f64; 6],
    /// Steps of the fixed point.
    pub steps: u32,
    /// The greatest ratio of two changes of the corrections, one after the other; 0 where there were none above
    /// rounding.
    pub factor: Number,
    /// Proved: the platform origin of the pose with exactly these lengths is no farther away, design units.
    pub position_bound: Option<Number>,
    /// Proved: its rotation is no farther away.
    pub angle_bound_deg: Option<Number>,
    /// The factor by which the Newton map contracts around the pose; null: not proved.
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
