//! Answers about the free travel of the platform from a pose.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, PoseConventionRecord, PoseInFrames, PoseQuaternionRecord};
use ask::{Design, FreePart, FreeSize, FreeTurn, PoseFrames, StatedRange, WorkspaceSize};
use machine::reach::{NearestPose, Reach, StraightPath, Travel};
use machine::requirements::{Limit, Quantity, TermKind};
use platform::geom::{Pose, RotationOrder};

/// The answer of `limits`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LimitsAnswer {
    /// Convention in which poses were read, of `in_frames` and of `axes`.
    pub frames: PoseConventionRecord,
    /// The pose of `--at`.
    pub pose: PoseQuaternionRecord,
    /// Pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Whether every requirement is met at the pose, and det J has the sign that it has at home.
    pub allowed: bool,
    /// Violated requirements, the worst first.
    pub violated: Vec<LimitRecord>,
    /// Free travel of each pose coordinate alone (x, y, z, roll, pitch, yaw); empty: the pose is not allowed.
    pub axes: Vec<FreeRangeRecord>,
    /// Straight path to `--to`; null: none was requested, or it begins at a pose that is not allowed.
    pub straight_path: Option<StraightPathRecord>,
    /// Allowed pose nearest to `--to`, or nearest to the pose of `--at` if that is not allowed. Null: every requested
    /// pose is allowed, or no allowed pose was found.
    pub nearest_allowed: Option<NearestAllowedRecord>,
    /// Size of the workspace around home; null: `--workspace` was not given, or home is not allowed.
    pub workspace: Option<WorkspaceSizeRecord>,
    /// Surface written; null: none was asked for, or the pose of `--at` is not allowed.
    pub surface: Option<String>,
    /// The unit of lengths.
    pub length_unit: String,
}

/// The size of the workspace around home.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorkspaceSizeRecord {
    /// Volume that straight paths from home reach, design units cubed; an estimate from the paths that were followed.
    pub volume: f64,
    /// Relative difference of the volume by every second path.
    pub volume_uncertainty: f64,
    /// Number of paths followed.
    pub rays: usize,
    /// Limits ending the paths, the most frequent first.
    pub ends: Vec<RayEndRecord>,
    /// Largest free ball of positions around home, at the orientation of home, design units.
    pub ball_radius: FreeSizeRecord,
    /// Half widths of the largest box proved free around home, at its orientation, along the axes of the base frame,
    /// design units.
    pub box_proved: [f64; 3],
    /// Half widths of the largest box without violation found, design units.
    pub box_searched: [f64; 3],
    /// Requirement violated just beyond the box; null: none was found.
    pub box_binds: Option<LimitRecord>,
    /// Rotations about axes of the base frame at the platform origin, at home.
    pub turns: Vec<FreeTurnRecord>,
    /// Largest free tilt in every direction, at the position of home, degrees.
    pub tilt_deg: FreeSizeRecord,
    /// Largest free rotation about every axis, at the position of home, degrees.
    pub turn_deg: FreeSizeRecord,
    /// Required workspace; null: none.
    pub required: Option<RequiredSizeRecord>,
}

/// A limit that ends paths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RayEndRecord {
    /// The kind of requirement; null: a singular pose, or no limit within ten sizes of the design.
    pub name: Option<TermKind>,
    /// Limit in a word.
    pub end: String,
    /// Share of the paths it ends, a share of solid angle.
    pub share: f64,
}

/// The largest free size of a region around home.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FreeSizeRecord {
    /// Largest size with all poses proved regular and allowed; 0: nothing is proved.
    pub proved: f64,
    /// Largest size without violation found.
    pub searched: f64,
    /// Requirement violated just beyond; null: none was found.
    pub binds: Option<LimitRecord>,
}

/// The free rotation of the platform about an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FreeTurnRecord {
    /// Base frame axis: `x`, `y` or `z`.
    pub axis: String,
    /// Free angle, negative sense, degrees, given as a positive number.
    pub back_deg: f64,
    /// Requirement that ends it; null: none within half a turn.
    pub back_binds: Option<LimitRecord>,
    /// Free angle, positive sense, degrees.
    pub forth_deg: f64,
    /// Requirement that ends it; null: none within half a turn.
    pub forth_binds: Option<LimitRecord>,
}

/// The workspace that a design requires.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RequiredSizeRecord {
    /// Volume of its translations, design units cubed.
    pub volume: f64,
    /// Its volume over the volume that straight paths reach.
    pub share: Number,
    /// Factor by which it can grow; 1 or more: the whole region is free.
    pub factor: FreeSizeRecord,
}

impl WorkspaceSizeRecord {
    /// The record of a computed workspace size.
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
        let (volume, volume_uncertainty) = found.volume;
        Self {
            volume,
            volume_uncertainty,
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

/// A requirement that is active or violated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LimitRecord {
    /// The kind; null: a singular pose, where det J vanishes.
    pub name: Option<TermKind>,
    /// The margin, negative for a violation; for a singular pose det J divided by its value at home.
    pub margin: Number,
    /// Unit; null: a pure ratio.
    pub unit: Option<String>,
    /// Parts concerned: legs, joints, keep-out or load.
    pub between: Vec<String>,
    /// Legs, from 1.
    pub legs: Vec<usize>,
}

/// The free travel of one of the six numbers of a pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FreeRangeRecord {
    /// The pose coordinate: `x`, `y`, `z`, and `roll`, `pitch`, `yaw` or the angles of another order.
    pub axis: String,
    /// `deg` or `rad`, or the unit of length.
    pub unit: String,
    /// Value at the pose.
    pub value: f64,
    /// Travel towards smaller values.
    pub back: TravelRecord,
    /// Travel towards greater values.
    pub forth: TravelRecord,
    /// Smaller one of both travels: the number can move by this much either way.
    pub symmetric: f64,
    /// Greatest speed of this number alone at the pose, `unit` per second; null: the drives have no speed limit.
    pub greatest_speed: Option<Number>,
    /// Greatest force along the axis, or torque about it at the pivot, that the drives hold at the pose without
    /// weights. Null: the drives have no force limit.
    pub greatest_effort: Option<Number>,
    /// Unit of `greatest_effort`.
    pub effort_unit: String,
}

/// A range of a single coordinate from home, and the part of it that is free.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RangeRecord {
    /// The coordinate, as in `[workspace]`: `x`, `y`, `z`, `roll_deg`, `pitch_deg` or `yaw_deg`.
    pub coordinate: String,
    /// `deg`, or the unit of length.
    pub unit: String,
    /// Stated lower end, measured from home.
    pub min: f64,
    /// Stated upper end, measured from home.
    pub max: f64,
    /// Free part of the range towards smaller values; computed in doubles, without proof.
    pub back: TravelRecord,
    /// Free part of the range towards greater values; computed in doubles, without proof.
    pub forth: TravelRecord,
}

/// A free travel and its end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TravelRecord {
    /// Length of the travel, not negative.
    pub free: f64,
    /// The value at the end.
    pub value: f64,
    /// Requirement violated beyond the end; null: none within the range, half a turn, or ten sizes of the design.
    pub binds: Option<LimitRecord>,
}

/// The straight path to another pose: the platform origin moves on a line while the platform rotates about one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StraightPathRecord {
    /// Path end.
    pub to: PoseQuaternionRecord,
    /// Free share of the path; 1: the whole path.
    pub free: f64,
    /// Pose at its end.
    pub pose: PoseQuaternionRecord,
    /// Pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Requirement violated beyond this pose; null: none.
    pub binds: Option<LimitRecord>,
}

/// The allowed pose found near a pose that is not allowed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearestAllowedRecord {
    /// The pose.
    pub pose: PoseQuaternionRecord,
    /// The position, base frame, design units.
    pub position: [f64; 3],
    /// Roll, pitch and yaw, degrees.
    pub rpy_deg: [f64; 3],
    /// Pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Distance from the requested pose, design units: `sqrt(|p - p'|^2 + (L angle)^2)`.
    pub distance: f64,
    /// Length `L` of `distance`, design units per radian.
    pub characteristic_length: f64,
    /// Active requirements.
    pub binds: Vec<LimitRecord>,
    /// Whether no small step leads nearer, as far as margins are smooth: the pose is then locally nearest. False: the
    /// search ended early.
    pub stationary: bool,
    /// Whether the straight path from home is allowed.
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

    /// The record of a limit with its margin at a pose.
    fn at(design: &Design, reach: &Reach<'_>, limit: Limit, pose: &Pose) -> Self {
        Self::new(design, limit, reach.margin_of(limit, pose))
    }

    /// The code of the requirement, or `singularity`.
    #[must_use]
    pub fn label(&self) -> &'static str {
        self.name.map_or("singular pose", TermKind::label)
    }
}

impl FreeRangeRecord {
    /// The record of the free travel along an axis from a pose.
    #[must_use]
    pub fn all(design: &Design, reach: &Reach<'_>, pose: &Pose, frames: &PoseFrames) -> Vec<Self> {
        let convention = &frames.convention;
        let unit = convention.angle_unit();
        let written = frames.write(pose);
        let is_vector = convention.order() == RotationOrder::Vector;
        let words = convention.angle_words();
        let capacities = design.axis_capacities(frames, pose);
        let range = |(k, way): (usize, StraightPath)| {
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
            let (back, forth) = (travel(&back, -1.0), travel(&forth, 1.0));
            let effort = if k < 3 { Quantity::Force } else { Quantity::Torque };
            Self {
                axis,
                unit,
                value,
                symmetric: back.free.min(forth.free),
                back,
                forth,
                greatest_speed: capacities[k].speed.map(|speed| Number(of_way(speed))),
                greatest_effort: capacities[k].effort.map(Number),
                effort_unit: design.unit_of(effort),
            }
        };
        frames.ways(pose).into_iter().enumerate().map(range).collect()
    }
}

/// The names of the coordinates of ranges, as in `[workspace]`.
pub(super) const COORDINATES: [&str; 6] = ["x", "y", "z", "roll_deg", "pitch_deg", "yaw_deg"];

impl RangeRecord {
    /// The record of a range.
    #[must_use]
    pub fn new(design: &Design, found: &StatedRange) -> Self {
        let (k, range) = (found.coordinate, found.range);
        let travel = |part: &FreePart, sign: f64| TravelRecord {
            free: part.free,
            value: sign * part.free,
            binds: part.binding.map(|(limit, margin)| LimitRecord::new(design, limit, margin)),
        };
        Self {
            coordinate: COORDINATES[k].to_owned(),
            unit: if k < 3 { design.units.clone() } else { "deg".to_owned() },
            min: range.min,
            max: range.max,
            back: travel(&found.back, -1.0),
            forth: travel(&found.forth, 1.0),
        }
    }
}

impl StraightPathRecord {
    /// The record of the straight path between two poses.
    #[must_use]
    pub fn new(design: &Design, reach: &Reach<'_>, frames: &PoseFrames, [from, to]: [&Pose; 2]) -> Self {
        let found = reach.along(&StraightPath::between(from, to), 1.0);
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
    /// The record of the nearest allowed pose.
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
