//! Answers of inverse kinematics where the legs are rods of constant length on cranks: angles in place of lengths.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseRecord};
use crate::design::Design;
use crate::geom::Pose;
use crate::manipulator::{inverse_condition, jacobian};
use crate::requirements::Quantity;
use crate::rotary::{CrankAngles, Elbow, RotaryPlatform};

/// The angles of cranks at several poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RotaryIkRowsAnswer {
    /// In the order given.
    pub rows: Vec<RotaryIkRecord>,
}

/// The angles of cranks at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RotaryIkRecord {
    /// The line of the table, from 1; null: no table.
    pub line: Option<usize>,
    /// The time of the row, where the table has a column of times.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The pose.
    pub pose: PoseRecord,
    /// The six angles in leg order, each on the side that the design keeps; null: a rod does not reach.
    pub angles_deg: Option<[f64; 6]>,
    /// The first rod that does not reach; null: all do.
    pub out_of_reach: Option<OutOfReachRecord>,
    /// Whether all angles are within their limits, the ends included; null: a rod does not reach, or the design limits no angle.
    pub within_limits: Option<bool>,
    /// The legs whose cranks are beyond their limits, from 1.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<usize>,
    /// The cranks in leg order; none where a rod does not reach.
    pub cranks: Vec<CrankRecord>,
    /// Rows in leg order: speeds of the cranks, radians per second, from the velocity of the platform origin and the angular velocity in radians, base frame; null where a crank is singular, or a rod does not reach.
    #[serde(rename = "J")]
    pub jacobian: Option<[[Number; 6]; 6]>,
    /// Smallest over largest singular value of the Jacobian of the rods on the tips, with moments over the characteristic length of the design: 1 at best, 0 at a singular pose; null: a rod does not reach.
    pub inverse_condition: Option<Number>,
    /// The torques of the cranks that hold each load at rest, where the design has loads.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub torques: Vec<CrankTorquesRecord>,
    /// The least margin of each limit at this pose.
    pub margins: Vec<CrankMarginRecord>,
}

/// A rod that does not reach from the circle of its crank to the platform joint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OutOfReachRecord {
    /// The leg, from 1.
    pub leg: usize,
    /// By how much the rod is too short, design units; negative where it is too long.
    pub too_short_by: f64,
}

/// A side of a crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ElbowWord {
    /// The greater of the two angles.
    Plus,
    /// The smaller one.
    Minus,
}

impl From<Elbow> for ElbowWord {
    fn from(elbow: Elbow) -> Self {
        match elbow {
            Elbow::Plus => Self::Plus,
            Elbow::Minus => Self::Minus,
        }
    }
}

/// How a crank stands at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CrankRecord {
    /// The side that the design keeps.
    pub elbow: ElbowWord,
    /// The angle on this side.
    pub angle_deg: f64,
    /// The angle on the other side.
    pub other_angle_deg: f64,
    /// What remains of the limits of the angle, negative beyond them; null: none.
    pub limit_margin_deg: Option<f64>,
    /// `u . (n x t)` of the unit vectors u along the rod, n along the axis and t along the crank, from -1 to 1: how directly the crank moves its rod. At 0 crank and rod are in one plane with the axis and the crank is singular.
    pub transmission: f64,
    /// How far the crank is from the angle at which both sides are one, which is singular: half the difference of both angles.
    pub to_singular_deg: f64,
    /// The tip of the crank, base frame.
    pub tip: [f64; 3],
}

/// Torques that hold a load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CrankTorquesRecord {
    /// The load.
    pub load: String,
    /// Of the cranks about their axes, force units times design units; null at a singular pose.
    pub torques: Option<[f64; 6]>,
}

/// A limit of cranks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CrankLimitWord {
    /// What remains of the limits of an angle.
    CrankAngle,
    /// The greatest torque less the torque that holds a load.
    CrankTorque,
    /// The greatest speed less the speed in the worst direction of motion.
    CrankSpeed,
}

impl CrankLimitWord {
    /// The word.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::CrankAngle => "crank_angle",
            Self::CrankTorque => "crank_torque",
            Self::CrankSpeed => "crank_speed",
        }
    }
}

/// By how much a limit of the cranks is kept at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CrankMarginRecord {
    /// The limit.
    pub name: CrankLimitWord,
    /// The least at this pose; a violation below 0; null: minus infinity, at a singular pose.
    pub margin: Number,
    /// Of the margin.
    pub unit: String,
    /// The leg for which it is least, from 1; null where that is not known, at a singular pose.
    pub leg: Option<usize>,
    /// The load for which it is least.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<String>,
}

impl RotaryIkRecord {
    /// What is known at a pose of a design with these cranks.
    #[must_use]
    pub fn new(design: &Design, platform: &RotaryPlatform, pose: &Pose) -> Self {
        let mut out = Self {
            line: None,
            time: None,
            pose: pose.into(),
            angles_deg: None,
            out_of_reach: None,
            within_limits: None,
            outside: Vec::new(),
            cranks: Vec::new(),
            jacobian: None,
            inverse_condition: None,
            torques: Vec::new(),
            margins: Vec::new(),
        };
        match platform.both_angles(pose) {
            Ok(both) => out.add(design, platform, pose, &both),
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
            elbow: legs[i].elbow.into(),
            angle_deg: kept[i].to_degrees(),
            other_angle_deg: other[i].to_degrees(),
            limit_margin_deg: legs[i].limits.map(|_| left[i].to_degrees()),
            transmission: transmissions[i],
            to_singular_deg: both[i].half.min(std::f64::consts::PI - both[i].half).to_degrees(),
            tip: platform.tip(i, kept[i]).coords.into(),
        };
        self.cranks = (0..6).map(crank).collect();
        self.angles_deg = Some(kept.map(f64::to_degrees));
        self.outside = (1..=6).filter(|leg| left[leg - 1] < 0.0).collect();
        if legs.iter().any(|leg| leg.limits.is_some()) {
            self.within_limits = Some(self.outside.is_empty());
            let least = least(&left.map(f64::to_degrees));
            self.margins.push(CrankMarginRecord::new(CrankLimitWord::CrankAngle, "deg".into(), least, None));
        }
        self.jacobian = platform
            .crank_jacobian(pose, &kept)
            .map(|rows| std::array::from_fn(|i| std::array::from_fn(|j| Number(rows[(i, j)]))));
        // tips and joints that make no platform hold no pose
        let scaled = platform.at(&kept).map(|m| jacobian(&m, pose, design.characteristic_length()));
        self.inverse_condition = Some(Number(scaled.map_or(0.0, |rows| inverse_condition(&rows))));
        let drives = design.crank_limits();
        let torque_unit = format!("{} {}", design.unit_of(Quantity::Force), design.units);
        for load in design.all_loads() {
            let torques = platform.torques(pose, &kept, &load.wrench(pose));
            if let Some(most) = drives.max_torque {
                let left = torques.map_or((None, f64::NEG_INFINITY), |t| least(&t.map(|t| most - t.abs())));
                let name = CrankLimitWord::CrankTorque;
                let own = CrankMarginRecord::new(name, torque_unit.clone(), left, Some(load.name.clone()));
                self.keep_least(own);
            }
            self.torques.push(CrankTorquesRecord { load: load.name, torques });
        }
        if let (Some(most), Some(speed)) = (drives.max_speed_deg, design.speed) {
            let angular = speed.angular_deg.to_radians();
            let speeds = platform.greatest_speeds(pose, &kept, speed.linear, angular);
            let left = speeds.map_or((None, f64::NEG_INFINITY), |s| least(&s.map(|s| most - s.to_degrees())));
            self.margins.push(CrankMarginRecord::new(CrankLimitWord::CrankSpeed, "deg/s".into(), left, None));
        }
    }

    /// One margin of each name.
    fn keep_least(&mut self, new: CrankMarginRecord) {
        match self.margins.iter_mut().find(|m| m.name == new.name) {
            Some(known) if known.margin.0 <= new.margin.0 => {}
            Some(known) => *known = new,
            None => self.margins.push(new),
        }
    }
}

/// The leg with the least margin, from 1, and the margin.
fn least(margins: &[f64; 6]) -> (Option<usize>, f64) {
    let mut found = (Some(1), margins[0]);
    for (i, margin) in margins.iter().enumerate() {
        if *margin < found.1 {
            found = (Some(i + 1), *margin);
        }
    }
    found
}

impl CrankMarginRecord {
    fn new(
        name: CrankLimitWord,
        unit: String,
        (leg, margin): (Option<usize>, f64),
        load: Option<String>,
    ) -> Self {
        Self { name, margin: Number(margin), unit, leg, load }
    }
}
