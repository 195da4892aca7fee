//! Records of joints that are not ideal: drive lengths, as distinct from the distances of the joints.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Number;
use machine::coupled::{CoupledOutcome, DriveSolutionWord, DriveState};

view! {
    /// The drives at a pose.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct DriveLengthsRecord {
        /// Lengths to command, in leg order, design units.
        pub lengths: [f64; 6] = std::array::from_fn(|i| distances[i] + states[i].correction),
        /// Difference from joint distances by axes that do not meet, design units.
        pub of_offsets: [f64; 6] = states.map(|s| s.of_offsets),
        /// Twist since home, degrees: its platform end against its base end; 0 without a lead.
        pub twists_deg: [f64; 6] = states.map(|s| s.twist.to_degrees()),
    }
    pub(crate) fn new(distances: &[f64; 6], states: &[DriveState; 6]) {}
}

view! {
    /// The iteration for the pose with given drive lengths.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct DriveSolutionRecord {
        /// Status of the solution.
        pub status: DriveSolutionWord = found.status.word(),
        /// Reason for no pose; null: there is one.
        pub reason: Option<String> = found.status.failure(),
        /// The lengths that the drives show, design units.
        pub lengths: [f64; 6] = *lengths,
        /// Joint distances at the pose, design units.
        pub distances: [f64; 6] = found.distances,
        /// Number of fixed-point steps.
        pub steps: u32 = found.steps,
        /// Greatest ratio of successive corrections; 0 if there were none above rounding.
        pub factor: Number = Number(found.factor),
        /// Proved bound on the position error, design units.
        pub position_bound: Option<Number> = bound.map(|b| Number(b.position)),
        /// Proved bound on the angle error, degrees.
        pub angle_bound_deg: Option<Number> = bound.map(|b| Number(b.angle.to_degrees().next_up())),
        /// Contraction of the Newton map at the pose; null: not proved.
        pub contraction: Option<Number> = bound.map(|b| Number(b.contraction)),
    }
    /// The record of drives that are followed.
    pub fn new(lengths: &[f64; 6], found: &CoupledOutcome) {
        let bound = found.status.bound();
    }
}
