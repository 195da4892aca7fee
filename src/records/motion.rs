//! Answers about the legs along a motion.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{MarginRecord, Number};
use crate::design::Design;
use crate::dynamics::{Extreme, LegExtremes};
use crate::entrance::{MotionReport, TimedMargin};

/// The answer of `motion`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionAnswer {
    /// The name of the design.
    pub name: String,
    /// No requirement is violated and no force is undetermined at the instants looked at.
    pub met: bool,
    /// Of lengths; speeds are in it per second, accelerations per second squared.
    pub length_unit: String,
    /// Of forces.
    pub force_unit: String,
    /// What the file does not say and was taken instead, a sentence each.
    pub assumptions: Vec<String>,
    /// In the order asked for: the trajectory, sines, accelerations.
    pub motions: Vec<MotionRunRecord>,
    /// The table of instants that was written; null: none.
    pub csv: Option<String>,
}

/// The legs along a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionRunRecord {
    /// The file of the trajectory, or the manoeuvre as it was asked for.
    pub motion: String,
    /// Instants looked at.
    pub instants: usize,
    /// From the first to the last of them.
    pub duration_s: f64,
    /// As in the answer, of this motion.
    pub met: bool,
    /// By leg; empty where a leg has no length at some instant.
    pub legs: Vec<LegMotionRecord>,
    /// The least margin of each kind of requirement, force and speed by this motion.
    pub requirements: Vec<TimedMarginRecord>,
    /// When forces are not determined, since the pose is singular; null: at no instant.
    pub singular_at_s: Option<f64>,
}

impl MotionRunRecord {
    /// What was found along a motion.
    #[must_use]
    pub(crate) fn new(design: &Design, motion: String, found: &MotionReport) -> Self {
        let requirements: Vec<_> =
            found.margins.iter().map(|margin| TimedMarginRecord::new(design, margin)).collect();
        let ends = found.instants.first().zip(found.instants.last());
        Self {
            motion,
            instants: found.instants.len(),
            duration_s: ends.map_or(0.0, |(first, last)| last.time - first.time),
            met: found.singular.is_none() && found.margins.iter().all(|m| m.margin.standing.is_met()),
            legs: found.legs.iter().enumerate().map(|(i, leg)| LegMotionRecord::new(i + 1, leg)).collect(),
            requirements,
            singular_at_s: found.singular,
        }
    }
}

/// A margin with its time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TimedMarginRecord {
    /// When the margin is least.
    pub time_s: f64,
    /// The margin.
    pub margin: MarginRecord,
}

impl TimedMarginRecord {
    fn new(design: &Design, found: &TimedMargin) -> Self {
        Self { time_s: found.time, margin: MarginRecord::found(design, &found.margin) }
    }
}

/// A value with its time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ExtremeRecord {
    /// With its sign.
    pub value: Number,
    /// When.
    pub time_s: f64,
}

impl From<Extreme> for ExtremeRecord {
    fn from(found: Extreme) -> Self {
        Self { value: Number(found.value), time_s: found.time }
    }
}

/// A leg along a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LegMotionRecord {
    /// From 1.
    pub leg: usize,
    /// Least length.
    pub shortest: ExtremeRecord,
    /// Greatest length.
    pub longest: ExtremeRecord,
    /// Speed of the greatest size, positive where the leg becomes longer.
    pub speed: ExtremeRecord,
    /// Acceleration of the greatest size.
    pub acceleration: ExtremeRecord,
    /// Greatest force of the drive: its hardest push where it is positive; null: no masses are known, or forces are not determined.
    pub push: Option<ExtremeRecord>,
    /// Least force: its hardest pull where it is negative.
    pub pull: Option<ExtremeRecord>,
    /// Root of the mean square of the force over time, force units.
    pub rms_force: Option<Number>,
    /// Power of the greatest size, watts; negative where the drive brakes.
    pub power_w: Option<ExtremeRecord>,
}

impl LegMotionRecord {
    fn new(leg: usize, found: &LegExtremes) -> Self {
        Self {
            leg,
            shortest: found.shortest.into(),
            longest: found.longest.into(),
            speed: found.speed.into(),
            acceleration: found.acceleration.into(),
            push: found.drive.map(|d| d.push.into()),
            pull: found.drive.map(|d| d.pull.into()),
            rms_force: found.drive.map(|d| Number(d.rms_force)),
            power_w: found.drive.map(|d| d.power.into()),
        }
    }
}
