//! Answers of inverse kinematics for rods of constant length on cranks: angles in place of lengths.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseConventionRecord, PoseInFrames, PoseMarginRecord, PoseRecord};
use ask::{Design, PoseFrames, meets_all};
use machine::requirements::Terms;
use machine::rotary::{CrankAngles, Elbow, RotaryPlatform};
use platform::geom::Pose;
use platform::manipulator::{inverse_condition, jacobian};

/// The angles of cranks at several poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RotaryIkRowsAnswer {
    /// Convention in which poses were read, and of `in_frames`.
    pub frames: PoseConventionRecord,
    /// The poses in the order given.
    pub rows: Vec<RotaryIkRecord>,
}

/// The angles of cranks at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RotaryIkRecord {
    /// The line of the table, from 1; null: no table.
    pub line: Option<usize>,
    /// The time of the row, if the table has a column of times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Convention in which poses were read, and of `in_frames`; of several poses that of the whole answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<PoseConventionRecord>,
    /// The pose.
    pub pose: PoseRecord,
    /// Pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Crank angles, degrees, each on the side (elbow) that the design keeps; null: a rod does not reach.
    pub angles_deg: Option<[f64; 6]>,
    /// First rod that does not reach; null: all rods reach.
    pub out_of_reach: Option<OutOfReachRecord>,
    /// Whether the pose meets all requirements of the design, the angle limits included; null: a rod does not reach.
    pub within_limits: Option<bool>,
    /// Legs with cranks beyond their limits, from 1.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<usize>,
    /// The cranks in leg order; empty: a rod does not reach.
    pub cranks: Vec<CrankRecord>,
    /// Jacobian, rows in leg order, base frame. It gives crank speeds in radians per second from the velocity of the
    /// platform origin and the angular velocity in radians. Null: a crank is singular, or a rod does not reach.
    #[serde(rename = "J")]
    pub jacobian: Option<[[Number; 6]; 6]>,
    /// Inverse condition number of the rods' Jacobian: 1 at best, 0 at a singular pose. Moments are divided by the
    /// characteristic length of the design. Null: a rod does not reach.
    pub inverse_condition: Option<Number>,
    /// Crank torques for each load at rest, if the design has loads.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub torques: Vec<CrankTorquesRecord>,
    /// Least margin by kind of requirement.
    pub margins: Vec<PoseMarginRecord>,
}

/// A rod that does not reach from the circle of its crank to the platform joint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OutOfReachRecord {
    /// The leg, from 1.
    pub leg: usize,
    /// Missing length, design units; negative: the rod is too long.
    pub too_short_by: f64,
}

/// The state of a crank at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CrankRecord {
    /// Side of the design.
    pub elbow: Elbow,
    /// The crank angle on this side, degrees.
    pub angle_deg: f64,
    /// Crank angle on the other side, degrees.
    pub other_angle_deg: f64,
    /// Margin to the angle limits, degrees, negative beyond them; null: no limits.
    pub limit_margin_deg: Option<f64>,
    /// Transmission `u . (n x t)` to the rod, from -1 to 1. The unit vectors are u along the rod, n along the axis and
    /// t along the crank. At 0 the crank is singular: crank, rod and axis are in one plane.
    pub transmission: f64,
    /// Angle to the singular crank position, degrees: half the difference of its two angles.
    pub to_singular_deg: f64,
    /// Crank tip, base frame.
    pub tip: [f64; 3],
}

/// The torques that hold a load.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CrankTorquesRecord {
    /// The load.
    pub load: String,
    /// Torques about the crank axes, force units times design units; null: a singular pose.
    pub torques: Option<[f64; 6]>,
}

impl RotaryIkRecord {
    /// The record of a pose of a design with these cranks.
    #[must_use]
    pub fn new(design: &Design, platform: &RotaryPlatform, pose: &Pose, frames: &PoseFrames) -> Self {
        let required = design.requirements();
        let terms = Terms::new(design.manipulator(), &required, &design.home_or_default());
        let mut out = Self {
            line: None,
            time: None,
            frames: None,
            pose: pose.into(),
            in_frames: (&frames.write(pose)).into(),
            angles_deg: None,
            out_of_reach: None,
            within_limits: None,
            outside: Vec::new(),
            cranks: Vec::new(),
            jacobian: None,
            inverse_condition: None,
            torques: Vec::new(),
            margins: PoseMarginRecord::all(design, &terms, pose),
        };
        match platform.both_angles(pose) {
            Ok(both) => {
                out.add(design, platform, pose, &both);
                out.within_limits = Some(out.outside.is_empty() && meets_all(&terms, &terms.at(pose), pose));
            }
            Err(missing) => {
                out.out_of_reach = Some(OutOfReachRecord { leg: missing.leg + 1, too_short_by: missing.by });
            }
        }
        out
    }

    fn add(&mut self, design: &Design, platform: &RotaryPlatform, pose: &Pose, both: &[CrankAngles; 6]) {
        let legs = platform.legs();
        let kept: [f64; 6] = std::array::from_fn(|i| platform.counted(i, both[i].of(legs[i].elbow)));
        let other: [f64; 6] = std::array::from_fn(|i| platform.counted(i, both[i].of(legs[i].elbow.other())));
        let (left, transmissions) = (platform.limit_margins(&kept), platform.transmissions(pose, &kept));
        let crank = |i: usize| CrankRecord {
            elbow: legs[i].elbow,
            angle_deg: kept[i].to_degrees(),
            other_angle_deg: other[i].to_degrees(),
            limit_margin_deg: legs[i].limits.map(|_| left[i].to_degrees()),
            transmission: transmissions[i],
            to_singular_deg: both[i].half.min(std::f64::consts::PI - both[i].half).to_degrees(),
            tip: platform.tip(i, kept[i]).coords.into(),
        };
        self.cranks = (0..6).map(crank).collect();
        self.angles_deg = Some(kept.map(f64::to_degrees));
        self.outside = platform.beyond_limits(&kept);
        self.jacobian = platform
            .crank_jacobian(pose, &kept)
            .map(|rows| std::array::from_fn(|i| std::array::from_fn(|j| Number(rows[(i, j)]))));
        // tips and joints that make no platform hold no pose
        let scaled = platform.at(&kept).map(|m| jacobian(&m, pose, design.characteristic_length()));
        self.inverse_condition = Some(Number(scaled.map_or(0.0, |rows| inverse_condition(&rows))));
        for load in design.all_loads() {
            let torques = platform.torques(pose, &kept, &load.wrench(design.manipulator(), pose));
            self.torques.push(CrankTorquesRecord { load: load.name, torques });
        }
    }
}
