//! Answers about how far the platform may move from a pose.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseConventionRecord, PoseInFrames, PoseQuaternionRecord};
use ask::{Design, FreeSize, FreeTurn, PoseFrames, WorkspaceSize};
use machine::reach::{NearestPose, Reach, StraightWay, Travel};
use machine::requirements::{Limit, TermKind};
use platform::geom::{Pose, RotationOrder};

/// The answer of `limits`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LimitsAnswer {
    /// The convention in which poses were read, of `in_frames` and of `axes`.
    pub frames: PoseConventionRecord,
    /// The pose of `--at`.
    pub pose: PoseQuaternionRecord,
    /// The same in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Every requirement is met there, and det J has the sign that it has at home.
    pub allowed: bool,
    /// What is violated there, the worst first.
    pub violated: Vec<LimitRecord>,
    /// x, y, z and the three angles of `frames`, or turns about x, y and z for rotation vectors: how far each may move while the others stay; nothing where the pose is not allowed.
    pub axes: Vec<FreeRangeRecord>,
    /// The straight way to the pose of `--to`; null: none was asked for, or it begins at a pose that is not allowed.
    pub way: Option<StraightWayRecord>,
    /// The allowed pose nearest to that of `--to`, or to that of `--at` where it is not allowed; null: all that was
    /// asked for is allowed, or no allowed pose was found.
    pub nearest_allowed: Option<NearestAllowedRecord>,
    /// How large the workspace is around home; null: `--workspace` was not given, or home is not allowed.
    pub workspace: Option<WorkspaceSizeRecord>,
    /// The surface that was written; null: none was asked for, or the pose of `--at` is not allowed.
    pub surface: Option<String>,
    /// Of lengths.
    pub length_unit: String,
}

/// How large the workspace is around home.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorkspaceSizeRecord {
    /// Volume of the positions that straight ways from home at its orientation reach, design units cubed; an estimate
    /// from the ways that were followed.
    pub volume: f64,
    /// The share by which the estimates from every second way and from the others differ.
    pub volume_doubt: f64,
    /// Ways that were followed.
    pub rays: usize,
    /// What ends them, the most frequent first.
    pub ends: Vec<RayEndRecord>,
    /// Radius of the largest ball of positions around home, at the orientation of home, design units.
    pub ball_radius: FreeSizeRecord,
    /// Half widths of the largest box of positions found around home, at the orientation of home, along the axes of the
    /// base frame, design units: those proved to be free.
    pub box_proved: [f64; 3],
    /// The same: those in which no violation was found.
    pub box_searched: [f64; 3],
    /// What is violated in a box that is larger by a little; null: nothing that was looked at.
    pub box_binds: Option<LimitRecord>,
    /// Turns about x, y and z of the base frame through the platform origin, at home.
    pub turns: Vec<FreeTurnRecord>,
    /// Largest angle up to which the platform may turn about every axis of the xy plane of the base at the position of
    /// home, degrees.
    pub tilt_deg: FreeSizeRecord,
    /// Largest angle up to which it may turn about every axis there, degrees.
    pub turn_deg: FreeSizeRecord,
    /// The region that the design asks for; null: none.
    pub required: Option<RequiredSizeRecord>,
}

/// What ends ways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RayEndRecord {
    /// The kind of requirement; null: a singular pose, or nothing within ten sizes.
    pub name: Option<TermKind>,
    /// The same in a word.
    pub end: String,
    /// The share of the ways, which is one of solid angle.
    pub share: f64,
}

/// Up to which size a region around home is free.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FreeSizeRecord {
    /// Proved: all poses of the region of this size meet all requirements that depend on the pose, and none is
    /// singular; 0: nothing is proved.
    pub proved: f64,
    /// No violation was found in regions up to this size.
    pub searched: f64,
    /// What is violated in a region that is larger by a little; null: nothing that was looked at.
    pub binds: Option<LimitRecord>,
}

/// How far the platform may turn about an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FreeTurnRecord {
    /// `x`, `y` or `z` of the base frame.
    pub axis: String,
    /// Against the axis, degrees, positive.
    pub back_deg: f64,
    /// What binds there; null: nothing within half a turn.
    pub back_binds: Option<LimitRecord>,
    /// About the axis, degrees.
    pub forth_deg: f64,
    /// What binds there; null: nothing within half a turn.
    pub forth_binds: Option<LimitRecord>,
}

/// The region that a design asks for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RequiredSizeRecord {
    /// Of its translations, design units cubed.
    pub volume: f64,
    /// The same over the volume that straight ways reach at the orientation of home.
    pub share: Number,
    /// The factor by which its translations and rotations together may be multiplied; 1 and more: the region is free.
    pub factor: FreeSizeRecord,
}

impl WorkspaceSizeRecord {
    /// The record of what was found.
    #[must_use]
    pub fn new(design: &Design, found: &WorkspaceSize) -> Self {
        let limit = |l: &(Limit, f64)| LimitRecord::new(design, l.0, l.1);
        let size = |s: &FreeSize| FreeSizeRecord {
            proved: s.proved,
            searched: s.searched,
            binds: s.binding.as_ref().map(limit),
        };
        let turn = |(axis, t): (&str, &FreeTurn)| FreeTurnRecord {
            axis: axis.to_owned(),
            back_deg: t.back.free.to_degrees(),
            back_binds: t.back.binding.map(|l| limit(&(l, 0.0))),
            forth_deg: t.forth.free.to_degrees(),
            forth_binds: t.forth.binding.map(|l| limit(&(l, 0.0))),
        };
        let times = |factor: f64| found.box_half.map(|h| h * factor);
        let mut ends: Vec<RayEndRecord> = Vec::new();
        for ray in &found.rays {
            let (name, end) = match ray.binding {
                Some(Limit::Term(term)) => (Some(term.kind), term.kind.code()),
                Some(Limit::Singular) => (None, "singularity"),
                None => (None, "nothing"),
            };
            match ends.iter_mut().find(|e| e.end == end) {
                Some(known) => known.share += 1.0,
                None => ends.push(RayEndRecord { name, end: end.to_owned(), share: 1.0 }),
            }
        }
        let all = found.rays.len().max(1) as f64;
        for end in &mut ends {
            end.share /= all;
        }
        ends.sort_by(|a, b| b.share.total_cmp(&a.share));
        let (volume, volume_doubt) = found.volume;
        Self {
            volume,
            volume_doubt,
            rays: found.rays.len(),
            ends,
            ball_radius: size(&found.ball),
            box_proved: times(found.box_factor.proved),
            box_searched: times(found.box_factor.searched),
            box_binds: found.box_factor.binding.as_ref().map(limit),
            turns: ["x", "y", "z"].into_iter().zip(&found.turns).map(turn).collect(),
            tilt_deg: size(&found.tilt),
            turn_deg: size(&found.turn),
            required: found.required.as_ref().map(|r| RequiredSizeRecord {
                volume: r.volume,
                share: Number(r.volume / volume),
                factor: size(&r.factor),
            }),
        }
    }
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
    /// Which number: `x`, `y`, `z`, and `roll`, `pitch`, `yaw` or the angles of another order.
    pub axis: String,
    /// `deg` or `rad`, or the unit of length.
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
    /// The same in the convention of `frames`.
    pub in_frames: PoseInFrames,
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
    /// The pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Distance from the pose asked for, design units: `sqrt(|p - p'|^2 + (L angle)^2)`.
    pub distance: f64,
    /// The `L` of the distance, design units a radian.
    pub characteristic_length: f64,
    /// What keeps it from being nearer.
    pub binds: Vec<LimitRecord>,
    /// Whether no small step leads nearer, as far as margins are smooth: then it is locally nearest. False: the search
    /// ended before that was so.
    pub stationary: bool,
    /// Whether the straight way from home to it violates nothing.
    pub straight_from_home: bool,
}

impl LimitRecord {
    /// A limit with its margin.
    #[must_use]
    pub fn new(design: &Design, limit: Limit, margin: f64) -> Self {
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
    /// How far each of the six numbers of an allowed pose may move.
    #[must_use]
    pub fn all(design: &Design, reach: &Reach<'_>, pose: &Pose, frames: &PoseFrames) -> Vec<Self> {
        let convention = &frames.convention;
        let unit = convention.angle_unit();
        let written = frames.write(pose);
        let is_vector = convention.order() == RotationOrder::Vector;
        let words = convention.angle_words();
        let range = |(k, way): (usize, StraightWay)| {
            let (axis, value, unit, of_way): (_, _, _, &dyn Fn(f64) -> f64) = match k.checked_sub(3) {
                None => (["x", "y", "z"][k].to_owned(), written.position[k], design.units.clone(), &|x| x),
                // a turn counts from the pose, whose rotation vector does not grow along it
                Some(k) if is_vector => {
                    (format!("about {}", ["x", "y", "z"][k]), 0.0, unit.name().to_owned(), &|x| {
                        unit.of_radians(x)
                    })
                }
                Some(k) => {
                    (words[k].to_owned(), written.angles[k], unit.name().to_owned(), &|x| unit.of_radians(x))
                }
            };
            let travel = |t: &Travel, sign: f64| {
                let free = of_way(t.amount);
                let binds = t.binding.map(|limit| LimitRecord::at(design, reach, limit, &t.pose));
                TravelRecord { free, value: value + sign * free, binds }
            };
            let [back, forth] = reach.both_ways(&way);
            Self { axis, unit, value, back: travel(&back, -1.0), forth: travel(&forth, 1.0) }
        };
        frames.ways(pose).into_iter().enumerate().map(range).collect()
    }
}

impl StraightWayRecord {
    /// What was found of the straight way between two poses.
    #[must_use]
    pub fn new(design: &Design, reach: &Reach<'_>, frames: &PoseFrames, [from, to]: [&Pose; 2]) -> Self {
        let found = reach.along(&StraightWay::between(from, to), 1.0);
        Self {
            to: to.into(),
            free: found.amount,
            pose: (&found.pose).into(),
            in_frames: (&frames.write(&found.pose)).into(),
            binds: found.binding.map(|limit| LimitRecord::at(design, reach, limit, &found.pose)),
        }
    }
}

impl NearestAllowedRecord {
    /// What was found near a pose.
    #[must_use]
    pub fn new(design: &Design, reach: &Reach<'_>, frames: &PoseFrames, found: &NearestPose) -> Self {
        let limit = |l: &Limit| LimitRecord::at(design, reach, *l, &found.pose);
        Self {
            pose: (&found.pose).into(),
            position: found.pose.position.into(),
            rpy_deg: found.pose.angles().degrees(),
            in_frames: (&frames.write(&found.pose)).into(),
            distance: found.distance,
            characteristic_length: design.characteristic_length(),
            binds: found.binding.iter().map(limit).collect(),
            stationary: found.stationary,
            straight_from_home: found.straight_from_home,
        }
    }
}
