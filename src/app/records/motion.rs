//! Answers about the legs along a motion.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{MarginRecord, Number, PoseConventionRecord, PoseQuaternionRecord};
use ask::Design;
use ask::{MotionReport, StiffnessReport, TimedMargin};
use machine::dynamics::{DriveExtremes, Extreme, LeastStiffness, LegExtremes, Vibration};
use synthesis::singularity::SingularEvidence;

/// The answer of `motion`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionAnswer {
    /// The name of the design.
    pub name: String,
    /// Convention in which poses were read, and of the table of instants; a table of poses may say more in the names of
    /// its columns.
    pub frames: PoseConventionRecord,
    /// Whether every requirement is met at the sampled instants, and every pose of the motions is regular.
    pub met: bool,
    /// The unit of lengths; speeds are in this unit per second, accelerations per second squared.
    pub length_unit: String,
    /// The unit of forces.
    pub force_unit: String,
    /// Values assumed, one sentence each.
    pub assumptions: Vec<String>,
    /// The motions: the trajectory first, then sines and accelerations.
    pub motions: Vec<MotionRunRecord>,
    /// Stiffness at the pose of `--about`; null: not requested.
    pub stiffness: Option<StiffnessRecord>,
    /// Table written; null: none.
    pub csv: Option<String>,
}

view! {
    /// Stiffness and natural motions at a pose.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct StiffnessRecord {
        /// The pose.
        pub pose: PoseQuaternionRecord = (&found.pose).into(),
        /// Stiffness matrix `J^T diag(k) J` at the platform origin, base frame; force units, design units and radians.
        /// It maps a shift and a small rotation to force and torque.
        #[serde(rename = "K")]
        pub matrix: [[Number; 6]; 6] =
            std::array::from_fn(|i| std::array::from_fn(|j| Number(found.matrix[(i, j)]))),
        /// Least stiffness against forces through the platform origin, force units per design unit; 0 at a singular
        /// pose.
        pub linear: Number = of(|s| s.linear),
        /// Least stiffness against a torque, force units times design units per radian; 0 at a singular pose.
        pub angular: Number = of(|s| s.angular),
        /// The natural motions, the slowest first; null: masses are unknown, or no inertia resists some rotation.
        pub natural: Option<Vec<NaturalMotionRecord>> = natural,
    }
    /// The record of the stiffness at a pose.
    pub fn new(found: &StiffnessReport) {
        let natural = found.natural.as_ref().map(|all| {
            let record = |v: &Vibration| NaturalMotionRecord {
                frequency_hz: Number(v.frequency),
                shape: std::array::from_fn(|k| Number(v.shape[k])),
            };
            all.iter().map(record).collect()
        });
        let of = |value: fn(&LeastStiffness) -> f64| Number(found.least.as_ref().map_or(0.0, value));
    }
}

/// A natural motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NaturalMotionRecord {
    /// The frequency, hertz.
    pub frequency_hz: Number,
    /// The mode shape, base frame: shift of the platform origin in design units and rotation vector in radians. It is
    /// normalised to `v^T M v = 1` in kilograms and design units.
    pub shape: [Number; 6],
}

view! {
    /// The legs along one motion.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MotionRunRecord {
        /// Trajectory or manoeuvre, as requested.
        pub motion: String = motion,
        /// Number of sampled instants.
        pub instants: usize = found.instants.len(),
        /// Duration of the motion, seconds.
        pub duration_s: f64 = ends.map_or(0.0, |(first, last)| last.time - first.time),
        /// Whether every requirement is met at the sampled instants, and every pose is regular.
        pub met: bool = found.singular.is_none()
            && found.unreached.is_none()
            && found.margins.iter().all(|m| m.margin.standing.is_met()),
        /// The legs in order; empty: a leg has no length at some instant, or the legs are rods on cranks.
        pub legs: Vec<LegMotionRecord> =
            if found.cranks { Vec::new() } else { each(found, LegMotionRecord::new) },
        /// The cranks in leg order, for legs that are rods on cranks; empty: a rod does not reach at some instant.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub cranks: Option<Vec<CrankMotionRecord>> =
            found.cranks.then(|| each(found, CrankMotionRecord::new)),
        /// Least margin by kind of requirement, with the forces and speeds of this motion.
        pub requirements: Vec<TimedMarginRecord> = requirements,
        /// Whether all its poses are regular.
        pub regularity: MotionRegularity = match (&found.singular, found.cranks) {
            (Some(_), _) => MotionRegularity::Singular,
            (None, true) => MotionRegularity::Sampled,
            (None, false) => MotionRegularity::Proved,
        },
        /// Time of the first singular pose, seconds; null: none was found.
        pub singular_at_s: Option<f64> = found.singular.map(|at| at.time),
        /// The first singular pose; null: none was found.
        pub singular_pose: Option<PoseQuaternionRecord> =
            found.singular.map(|at| PoseQuaternionRecord::from(&at.pose)),
        /// Evidence that it is singular.
        pub singular_evidence: Option<SingularEvidence> = found.singular.map(|at| at.evidence),
        /// First time at which a rod does not reach, seconds.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub unreached_at_s: Option<f64> = found.unreached,
    }
    /// The record of a motion.
    pub fn new(design: &Design, motion: String, found: &MotionReport) {
        let requirements: Vec<_> =
            found.margins.iter().map(|margin| TimedMarginRecord::new(design, margin)).collect();
        let ends = found.instants.first().zip(found.instants.last());
    }
}

/// Whether every pose of a motion is regular.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionRegularity {
    /// Proved: det J keeps its sign on the whole motion, between the instants too.
    Proved,
    /// Sampled: no instant is singular, and det J of the rods has one sign at all instants.
    Sampled,
    /// The motion passes a singular pose.
    Singular,
}

/// A record of each leg, from 1.
fn each<T>(found: &MotionReport, record: fn(usize, &LegExtremes) -> T) -> Vec<T> {
    found.legs.iter().enumerate().map(|(i, leg)| record(i + 1, leg)).collect()
}

/// A least margin with its time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TimedMarginRecord {
    /// Time of the least margin, seconds.
    pub time_s: f64,
    /// The margin.
    pub margin: MarginRecord,
}

impl TimedMarginRecord {
    fn new(design: &Design, found: &TimedMargin) -> Self {
        Self { time_s: found.time, margin: MarginRecord::found(design, &found.margin) }
    }
}

view! {
    /// A leg along a motion.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct LegMotionRecord {
        /// The leg, from 1.
        pub leg: usize = leg,
        /// The least length, design units.
        pub shortest: Extreme = found.shortest,
        /// The greatest length, design units.
        pub longest: Extreme = found.longest,
        /// Greatest speed, design units per second; positive: the leg becomes longer.
        pub speed: Extreme = found.speed,
        /// Greatest acceleration, design units per second squared.
        pub acceleration: Extreme = found.acceleration,
        /// Greatest push, force units; 0: it only pulls. Null: no masses are known, or forces are not determined.
        pub push: Option<Extreme> = found.drive.map(|d| d.push),
        /// Greatest pull, a negative force; 0: it only pushes.
        pub pull: Option<Extreme> = found.drive.map(|d| d.pull),
        /// RMS force over time, force units.
        pub rms_force: Option<Number> = found.drive.map(|d| Number(d.rms_force)),
        /// Greatest power, watts; negative: the drive brakes.
        pub power_w: Option<Extreme> = found.drive.map(|d| d.power),
    }
    fn new(leg: usize, found: &LegExtremes) {}
}

view! {
    /// A crank along a motion.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CrankMotionRecord {
        /// Leg, from 1.
        pub leg: usize = leg,
        /// The least angle, degrees.
        pub least_deg: Extreme = found.shortest,
        /// The greatest angle, degrees.
        pub greatest_deg: Extreme = found.longest,
        /// Greatest speed, degrees per second.
        pub speed_deg: Extreme = found.speed,
        /// Greatest acceleration, degrees per second squared.
        pub acceleration_deg: Extreme = found.acceleration,
        /// Greatest torque about the axis, force units times design units. Null: no masses are known, or torques are
        /// not determined. Cranks and rods count as massless.
        pub torque: Option<Extreme> = found.drive.map(torque),
        /// RMS torque over time, force units times design units.
        pub rms_torque: Option<Number> = found.drive.map(|d| Number(d.rms_force)),
        /// Greatest power, watts; negative: the drive brakes.
        pub power_w: Option<Extreme> = found.drive.map(|d| d.power),
    }
    fn new(leg: usize, found: &LegExtremes) {
        let torque =
            |d: DriveExtremes| if d.push.value.abs() >= d.pull.value.abs() { d.push } else { d.pull };
    }
}
