//! Answers about how far the platform may move from a pose.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseQuaternionRecord};
use crate::design::Design;
use crate::geom::Pose;
use crate::reach::{FreeRange, NearestPose, PoseAxis, Reach, StraightWay, Travel};
use crate::requirements::{Limit, TermKind};

/// The answer of `limits`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LimitsAnswer {
    /// The pose of `--at`.
    pub pose: PoseQuaternionRecord,
    /// Every requirement is met there, and det J has the sign that it has at home.
    pub allowed: bool,
    /// What is violated there, the worst first.
    pub violated: Vec<LimitRecord>,
    /// x, y, z, roll, pitch, yaw: how far each may move while the others stay; nothing where the pose is not allowed.
    pub axes: Vec<FreeRangeRecord>,
    /// The straight way to the pose of `--to`; null: none was asked for, or it begins at a pose that is not allowed.
    pub way: Option<StraightWayRecord>,
    /// The allowed pose nearest to that of `--to`, or to that of `--at` where it is not allowed; null: all that was asked for is allowed, or no allowed pose was found.
    pub nearest_allowed: Option<NearestAllowedRecord>,
    /// Of lengths.
    pub length_unit: String,
}

/// A requirement that binds or is violated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LimitRecord {
    /// The kind; null: a singular pose, where det J vanishes.
    pub name: Option<TermKind>,
    /// By how much it is met, a violation below 0; of a singular pose det J over that at home.
    pub margin: Number,
    /// Of the margin; null: a share.
    pub unit: Option<String>,
    /// Legs, joints, keep-out or load.
    pub between: Vec<String>,
    /// The legs among them, from 1.
    pub legs: Vec<usize>,
}

/// How far one of the six numbers of a pose may move.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FreeRangeRecord {
    /// Which number, with `R = Rz(yaw) Ry(pitch) Rx(roll)`.
    pub axis: PoseAxis,
    /// `deg`, or the unit of length.
    pub unit: String,
    /// At the pose.
    pub value: f64,
    /// Towards smaller values.
    pub back: TravelRecord,
    /// Towards greater ones.
    pub forth: TravelRecord,
}

/// A free way and its end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TravelRecord {
    /// How far, not negative.
    pub free: f64,
    /// The value at the end.
    pub value: f64,
    /// What is violated beyond; null: nothing within half a turn, or ten sizes of the design.
    pub binds: Option<LimitRecord>,
}

/// The straight way to another pose: the platform origin moves on a line while the platform turns about one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StraightWayRecord {
    /// Where it ends.
    pub to: PoseQuaternionRecord,
    /// The share of it that is free from its beginning, 1: all.
    pub free: f64,
    /// Where that share ends.
    pub pose: PoseQuaternionRecord,
    /// What is violated beyond; null: nothing.
    pub binds: Option<LimitRecord>,
}

/// An allowed pose near one that is not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearestAllowedRecord {
    /// The pose.
    pub pose: PoseQuaternionRecord,
    /// Its position, design units.
    pub position: [f64; 3],
    /// Its roll, pitch and yaw.
    pub rpy_deg: [f64; 3],
    /// Distance from the pose asked for, design units: `sqrt(|p - p'|^2 + (L angle)^2)`.
    pub distance: f64,
    /// The `L` of the distance, design units a radian.
    pub characteristic_length: f64,
    /// What keeps it from being nearer.
    pub binds: Vec<LimitRecord>,
    /// Whether no small step leads nearer, as far as margins are smooth: then it is locally nearest. False: the search ended before that was so.
    pub stationary: bool,
    /// Whether the straight way from home to it violates nothing.
    pub straight_from_home: bool,
}

impl LimitRecord {
    /// A limit with its margin.
    #[must_use]
    pub(crate) fn new(design: &Design, limit: Limit, margin: f64) -> Self {
        match limit {
            Limit::Term(term) => Self {
                name: Some(term.kind),
                margin: Number(margin),
                unit: Some(design.unit_of(term.kind.quantity())),
                between: design.names_of(term),
                legs: design.legs_of(term),
            },
            Limit::Singular => {
                Self { name: None, margin: Number(margin), unit: None, between: Vec::new(), legs: Vec::new() }
            }
        }
    }

    /// With the margin it has at a pose.
    fn at(design: &Design, reach: &Reach<'_>, limit: Limit, pose: &Pose) -> Self {
        let margins = reach.margins(pose);
        let margin = margins.iter().find(|(l, _)| *l == limit).map_or(f64::NAN, |(_, margin)| *margin);
        Self::new(design, limit, margin)
    }

    /// Its code: that of the requirement, or `singularity`.
    #[must_use]
    pub fn code(&self) -> &'static str {
        self.name.map_or("singularity", TermKind::code)
    }
}

impl FreeRangeRecord {
    /// What was found of an axis from a pose.
    #[must_use]
    pub(crate) fn new(design: &Design, reach: &Reach<'_>, pose: &Pose, found: &FreeRange) -> Self {
        let angles = pose.angles().degrees();
        let p = &pose.position;
        let value = match found.axis {
            PoseAxis::X => p.x,
            PoseAxis::Y => p.y,
            PoseAxis::Z => p.z,
            PoseAxis::Roll => angles[0],
            PoseAxis::Pitch => angles[1],
            PoseAxis::Yaw => angles[2],
        };
        let travel = |t: &Travel, sign: f64| {
            let free = if found.axis.is_turn() { t.amount.to_degrees() } else { t.amount };
            let binds = t.binding.map(|limit| LimitRecord::at(design, reach, limit, &t.pose));
            TravelRecord { free, value: value + sign * free, binds }
        };
        Self {
            axis: found.axis,
            unit: if found.axis.is_turn() { "deg".into() } else { design.units.clone() },
            value,
            back: travel(&found.back, -1.0),
            forth: travel(&found.forth, 1.0),
        }
    }
}

impl StraightWayRecord {
    /// What was found of the straight way between two poses.
    #[must_use]
    pub(crate) fn new(design: &Design, reach: &Reach<'_>, from: &Pose, to: &Pose) -> Self {
        let found = reach.along(&StraightWay::between(from, to), 1.0);
        Self {
            to: to.into(),
            free: found.amount,
            pose: (&found.pose).into(),
            binds: found.binding.map(|limit| LimitRecord::at(design, reach, limit, &found.pose)),
        }
    }
}

impl NearestAllowedRecord {
    /// What was found near a pose.
    #[must_use]
    pub(crate) fn new(design: &Design, reach: &Reach<'_>, found: &NearestPose) -> Self {
        let limit = |l: &Limit| LimitRecord::at(design, reach, *l, &found.pose);
        Self {
            pose: (&found.pose).into(),
            position: found.pose.position.into(),
            rpy_deg: found.pose.angles().degrees(),
            distance: found.distance,
            characteristic_length: design.characteristic_length(),
            binds: found.binding.iter().map(limit).collect(),
            stationary: found.stationary,
            straight_from_home: found.straight_from_home,
        }
    }
}
