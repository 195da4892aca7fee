//! Answers about one pose: forces, small motions, stiffness, a leg that is stuck, the nearest singular pose.

use nalgebra::{Matrix6, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    LimitRecord, Number, OutOfReachRecord, PoseConventionRecord, PoseInFrames, PoseQuaternionRecord,
};
use ask::{AtPoseOptions, AtPoseReport, Design, DrivesAt, HeldWrench, PoseFrames, StuckLeg};
use machine::requirements::LeastStiffness;
use platform::geom::Pose;
use synthesis::singularity::{NearestSingularPose, SingularEvidence};

view! {
    /// The answer of `at`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct AtPoseAnswer {
        /// The name of the design.
        pub name: String = design.name.clone(),
        /// The unit of lengths.
        pub length_unit: String = design.units.clone(),
        /// The unit of forces; torques are in this unit times the unit of length.
        pub force_unit: String = design.force_unit().label().into(),
        /// Convention in which poses were read, and of `in_frames`.
        pub frames: PoseConventionRecord = (&frames.convention).into(),
        /// The pose.
        pub pose: PoseQuaternionRecord = (&asked.pose).into(),
        /// Pose in the convention of `frames`.
        pub in_frames: PoseInFrames = (&frames.write(&asked.pose)).into(),
        /// Reference point, platform frame of `frames`: wrenches, shifts and stiffness are about it.
        pub point: [Number; 3] = three(&point),
        /// Body whose axes vectors have: `base` or `platform`.
        pub axes: String = asked.axes.name().into(),
        /// Lengths shown; null: the legs are rods on cranks.
        pub lengths: Option<[f64; 6]> = match found.drives {
            DrivesAt::Lengths(lengths) => Some(lengths),
            _ => None,
        },
        /// Crank angles, where a design has some and all rods reach.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub angles_deg: Option<[f64; 6]> = match found.drives {
            DrivesAt::Angles(angles) => Some(angles.map(f64::to_degrees)),
            _ => None,
        },
        /// First rod that does not reach; nothing else is then known.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub out_of_reach: Option<OutOfReachRecord> = match &found.drives {
            DrivesAt::OutOfReach(missing) => {
                Some(OutOfReachRecord { leg: missing.leg + 1, too_short_by: missing.by })
            }
            _ => None,
        },
        /// Whether every requirement is met, and det J has the sign that it has at home.
        pub allowed: bool = violated.is_empty(),
        /// Violated requirements, the worst first.
        pub violated: Vec<LimitRecord> = violated
            .iter()
            .map(|(limit, margin)| LimitRecord::new(design, *limit, *margin))
            .collect(),
        /// The evidence of a singular pose; null: the pose is regular.
        pub singular: Option<SingularEvidence> = found.singular,
        /// Inverse condition number of the Jacobian: 1 at best.
        pub inverse_condition: Option<Number> = found.inverse_condition.map(Number),
        /// Forces that hold each load and `--wrench`, at rest.
        pub held: Vec<HeldWrenchRecord> = found.held.iter().map(HeldWrenchRecord::of).collect(),
        /// Wrench that `--forces` hold; null: none were given.
        pub wrench: Option<WrenchRecord> = found.wrench.as_ref().map(WrenchRecord::new),
        /// Matrix from leg forces to the wrench they hold, force before torque, as in a six-axis load cell; null where
        /// a rod does not reach or a crank is singular.
        pub wrench_matrix: Option<[[Number; 6]; 6]> = found.wrenches.as_ref().map(six_by_six),
        /// Stiffness at the point; null: the design states neither `leg_stiffness` nor, for cranks, `stiffness`.
        pub stiffness: Option<PointStiffnessRecord> = found
            .stiffness
            .as_ref()
            .map(|(matrix, least)| PointStiffnessRecord::new(matrix, *least)),
        /// Motion of the point by drive steps; null at a singular pose.
        pub resolution: Option<ResolutionRecord> = found.motions.as_ref().map(|motions| {
            let (by, unit) = if turns { (step.to_radians(), "deg") } else { (step, &*design.units) };
            ResolutionRecord::new(motions, by, step, unit)
        }),
        /// Remaining motion with the leg of `--leg` stuck, or free; null: no leg was named.
        pub stuck: Option<StuckLegRecord> =
            found.stuck.as_ref().map(|stuck| StuckLegRecord::new(frames, stuck, turns)),
        /// The nearest singular pose found; null: it was not asked for, or no way met one.
        pub nearest_singular: Option<NearestSingularPoseRecord> = found
            .nearest_singular
            .as_ref()
            .map(|near| NearestSingularPoseRecord::new(design, frames, near)),
    }
    /// The answer for a pose.
    pub fn new(
        design: &Design,
        frames: &PoseFrames,
        (asked, step): (&AtPoseOptions, f64),
        found: &AtPoseReport,
    ) {
        let required = design.requirements();
        let reach = design.reach(&required);
        let violated = reach.violated(&asked.pose);
        let point = frames.convention.axes().transpose() * asked.point;
        let turns = matches!(found.drives, DrivesAt::Angles(_));
    }
}

/// A force and a torque.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WrenchRecord {
    /// Force units.
    pub force: [Number; 3],
    /// About the point, force units times design units.
    pub torque: [Number; 3],
}

view! {
    /// A wrench on the platform and what holds it.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct HeldWrenchRecord {
        /// Load; null: the wrench of `--wrench`.
        pub load: Option<String> = held.load.clone(),
        /// The wrench on the platform.
        pub wrench: WrenchRecord = WrenchRecord::new(&held.wrench),
        /// Leg forces, positive where they push the platform, or torques of the cranks about their axes; null at a
        /// singular pose.
        pub forces: Option<[Number; 6]> = held.efforts.map(|efforts| efforts.map(Number)),
    }
    fn of(held: &HeldWrench) {}
}

view! {
    /// Stiffness at a point of the platform.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PointStiffnessRecord {
        /// Force and torque for a shift of the point and a small rotation: force units, design units and radians.
        #[serde(rename = "K")]
        pub matrix: [[Number; 6]; 6] = six_by_six(matrix),
        /// Its inverse; null at a singular pose.
        pub compliance: Option<[[Number; 6]; 6]> =
            least.and_then(|_| matrix.try_inverse()).as_ref().map(six_by_six),
        /// Least stiffness against forces through the point, force units per design unit; 0 at a singular pose.
        pub linear: Number = of(|s| s.linear),
        /// Least stiffness against a torque, force units times design units per radian; 0 at a singular pose.
        pub angular: Number = of(|s| s.angular),
    }
    fn new(matrix: &Matrix6<f64>, least: Option<LeastStiffness>) {
        let of = |value: fn(&LeastStiffness) -> f64| Number(least.as_ref().map_or(0.0, value));
    }
}

view! {
    /// The motion of the point for a step of the drives.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct ResolutionRecord {
        /// Step: design units of legs, degrees of cranks.
        pub step: f64 = step,
        /// The unit of the step.
        pub step_unit: String = unit.into(),
        /// Motion by a step of one drive, in leg order.
        pub drives: Vec<SmallMotionRecord> =
            (0..6).map(|drive| SmallMotionRecord::new(twist(drive), by)).collect(),
        /// Greatest change when every drive is off by a step: sums of the sizes.
        pub all: SmallMotionRecord = SmallMotionRecord::new(sum, by),
    }
    fn new(motions: &Matrix6<f64>, by: f64, step: f64, unit: &str) {
        let twist = |drive: usize| std::array::from_fn(|k| motions[(k, drive)]);
        let sum = std::array::from_fn(|k| motions.row(k).iter().map(|x| x.abs()).sum());
    }
}

/// A small motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SmallMotionRecord {
    /// The shift of the point, design units.
    pub shift: [Number; 3],
    /// Rotation vector, degrees.
    pub turn_deg: [Number; 3],
}

view! {
    /// The remaining motion with a leg stuck, or free.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct StuckLegRecord {
        /// The leg, from 1.
        pub leg: usize = stuck.leg + 1,
        /// Travel of its drive per coordinate of the pose: design units of legs, degrees of cranks, per design unit and
        /// per `deg` or `rad` of `frames`. With the drive stuck only a number with 0 can still be changed alone; five
        /// independent changes are left.
        pub rates: [Number; 6] =
            std::array::from_fn(|k| Number(of_drive(stuck.rates[k]) / if k < 3 { 1.0 } else { unit })),
        /// Motion that is lost, and the only one left when the leg is free and the others hold; null at a singular
        /// pose.
        pub screw: Option<ScrewRecord> = stuck.screw.map(|screw| ScrewRecord {
            direction: three(&screw.direction),
            point: three(&screw.point),
            pitch: screw.pitch.map(Number),
        }),
        /// Poses with a shorter leg, up to its limit, a tenth of its length, or the first singular pose; none for
        /// cranks.
        pub shorter: Vec<LegPathPoseRecord> = shorter,
        /// Poses with a longer leg.
        pub longer: Vec<LegPathPoseRecord> = longer,
    }
    fn new(frames: &PoseFrames, stuck: &StuckLeg, turns: bool) {
        // of an angle a unit is a degree or a radian
        let unit = frames.convention.angle_unit().of_radians(1.0);
        let of_drive = |x: f64| if turns { x.to_degrees() } else { x };
        let way = |(length, pose): &(f64, Pose)| LegPathPoseRecord {
            length: *length,
            in_frames: (&frames.write(pose)).into(),
        };
        let [shorter, longer] = stuck.ways.each_ref().map(|way_of| way_of.iter().map(way).collect());
    }
}

/// A turn about an axis with a shift along it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ScrewRecord {
    /// Unit vector; of the shift where nothing turns.
    pub direction: [Number; 3],
    /// Point of the axis nearest to the point asked about, from there, design units.
    pub point: [Number; 3],
    /// Shift along the axis, design units per radian; null: a shift without a turn.
    pub pitch: Option<Number>,
}

/// A pose with all lengths but one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LegPathPoseRecord {
    /// Joint distance of the leg.
    pub length: f64,
    /// Pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
}

view! {
    /// A singular pose near the one asked about.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NearestSingularPoseRecord {
        /// The pose.
        pub pose: PoseQuaternionRecord = (&found.pose).into(),
        /// Pose in the convention of `frames`.
        pub in_frames: PoseInFrames = (&frames.write(&found.pose)).into(),
        /// `sqrt(|p - p'|^2 + (L angle)^2)`, design units.
        pub distance: f64 = found.distance,
        /// Length `L` of `distance`, design units per radian.
        pub characteristic_length: f64 = design.characteristic_length(),
        /// Whether no small step on singular poses leads nearer: then it is locally nearest.
        pub stationary: bool = found.is_stationary,
        /// Distance within which a singular pose is proved; null: not proved.
        pub proved_within: Option<f64> = found.proved_within,
    }
    fn new(design: &Design, frames: &PoseFrames, found: &NearestSingularPose) {}
}

fn three(v: &Vector3<f64>) -> [Number; 3] {
    [v.x, v.y, v.z].map(Number)
}

fn six_by_six(m: &Matrix6<f64>) -> [[Number; 6]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| Number(m[(i, j)])))
}

impl WrenchRecord {
    fn new(six: &[f64; 6]) -> Self {
        let [a, b, c, d, e, f] = six.map(Number);
        Self { force: [a, b, c], torque: [d, e, f] }
    }
}

impl SmallMotionRecord {
    fn new(twist: [f64; 6], step: f64) -> Self {
        let [a, b, c, d, e, f] = twist.map(|x| x * step);
        Self { shift: [a, b, c].map(Number), turn_deg: [d, e, f].map(|x| Number(x.to_degrees())) }
    }
}

impl AtPoseAnswer {
    /// Whether the drives hold the platform at the pose.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.singular.is_none() && self.out_of_reach.is_none() && self.resolution.is_some()
    }
}
