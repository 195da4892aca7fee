//! The size of the workspace around home: positions, orientations, and the required region.

use nalgebra::Vector3;

use super::assessing::regular_region;
use crate::Design;
use machine::reach::{FreeRay, largest_box_within, volume_of_rays};
use machine::requirements::{AssessOptions, Limit, Requirements, assess, prove};
use platform::geom::{Pose, PoseSpace, Region};

/// Default number of directions for paths and rotations.
pub const RAYS: usize = 1000;
/// Number of bisections between a proved and a violated size.
const ROUNDS: usize = 8;
/// The bisection ends when the proved and the violated size differ by less than this share.
const CLOSE: f64 = 5e-3;
/// The first size lies below the end of a ray by this share.
const INSIDE: f64 = 5e-4;
/// Number of cells for bounding each kind of requirement at one size.
const CELLS: usize = 250;
/// Number of Halton points sampled at one size; as many random points are added.
const POINTS: usize = 100;
/// The required region is enlarged up to this factor.
const LARGEST: f64 = 8.0;
/// Rotations are followed up to half a turn.
const HALF_TURN: f64 = 180.0;

/// The largest known free size of a region around home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeSize {
    /// The largest size for which every pose is proved to meet all requirements and to be regular; 0: nothing is
    /// proved.
    pub proved: f64,
    /// The largest size without a violation at sampled poses; at least the proved size.
    pub searched: f64,
    /// The requirement violated in a slightly larger region, with its margin there; `None` if none was found.
    pub binding: Option<(Limit, f64)>,
}

/// The free rotation about an axis of the base frame, degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeTurn {
    /// The rotation to negative angles.
    pub back: FreeRay,
    /// The rotation to positive angles.
    pub forth: FreeRay,
}

/// The required region compared with the workspace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RequiredSize {
    /// Volume of its translations, design units cubed.
    pub volume: f64,
    /// The factor by which its translations and rotations can grow.
    pub factor: FreeSize,
}

/// The size of the workspace around home.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct WorkspaceSize {
    /// Straight paths at the orientation of home.
    pub rays: Vec<FreeRay>,
    /// The volume that they reach, and the relative difference between the estimates from every second path and from
    /// the others.
    pub volume: (f64, f64),
    /// Radius of the largest ball of positions around home.
    pub ball: FreeSize,
    /// Half widths of the largest box of positions around home that the rays leave free, without the factor.
    pub box_half: [f64; 3],
    /// The factor on this box up to which it is free.
    pub box_factor: FreeSize,
    /// Rotations about x, y, z of the base frame at the position of home.
    pub turns: [FreeTurn; 3],
    /// Largest free angle of rotation about every axis in the xy plane, degrees.
    pub tilt: FreeSize,
    /// Largest free angle of rotation about every axis, degrees.
    pub turn: FreeSize,
    /// The required region, if the design has one.
    pub required: Option<RequiredSize>,
}

impl Design {
    /// The size of the workspace around home; `None` if home is not allowed.
    pub fn workspace_size(&self, rays: usize, seed: u64) -> Option<WorkspaceSize> {
        let (home, required) = (self.home_or_default(), self.requirements());
        let reach = self.reach(&required);
        if !reach.allows(&home) {
            return None;
        }
        let around = Around { design: self, required: &required, home, seed };
        let shifts = reach.shifts(&home, rays);
        let turned = reach.turns(&home, rays);
        let level: Vec<FreeRay> = (0..rays.div_ceil(8).max(8))
            .map(|k| {
                let (s, c) = (std::f64::consts::TAU * k as f64 / rays.div_ceil(8).max(8) as f64).sin_cos();
                reach.ray(&home, &Vector3::new(c, s, 0.0), true)
            })
            .collect();
        let axis = |k: usize| {
            let d = Vector3::ith(k, 1.0);
            FreeTurn { back: reach.ray(&home, &-d, true), forth: reach.ray(&home, &d, true) }
        };
        let box_half = largest_box_within(&shifts);
        let (ball, tilt, turn) = (
            around.largest(&shortest(&shifts), &|r| around.shifted(Region::Ellipsoid, [r; 3])),
            around.largest(&in_degrees(shortest(&level)), &|a| around.turned([a, a, 0.0])),
            around.largest(&in_degrees(shortest(&turned)), &|a| around.turned([a; 3])),
        );
        let to_box = |t: f64| around.shifted(Region::Box, box_half.map(|h| h * t));
        // the rays leave some space between them
        let all = FreeRay { free: 1.1, ..shortest(&shifts) };
        Some(WorkspaceSize {
            volume: volume_of_rays(&shifts),
            ball,
            box_half,
            box_factor: around.largest(&all, &to_box),
            turns: [axis(0), axis(1), axis(2)],
            tilt,
            turn,
            required: around.of_required_region(),
            rays: shifts,
        })
    }
}

fn shortest(rays: &[FreeRay]) -> FreeRay {
    let none = FreeRay { direction: Vector3::z(), free: f64::INFINITY, binding: None };
    rays.iter().fold(none, |least, ray| if ray.free < least.free { *ray } else { least })
}

fn in_degrees(ray: FreeRay) -> FreeRay {
    FreeRay { free: ray.free.to_degrees(), ..ray }
}

/// A design with the data for assessing regions around its home.
struct Around<'a> {
    design: &'a Design,
    required: &'a Requirements,
    home: Pose,
    seed: u64,
}

/// The verdict on a region.
enum RegionVerdict {
    Free,
    Violated(Limit, f64),
    Undecided,
}

impl Around<'_> {
    fn shifted(&self, region: Region, half: [f64; 3]) -> PoseSpace {
        PoseSpace { region, translation: half.into(), ..PoseSpace::at(self.home) }
    }

    fn turned(&self, half_deg: [f64; 3]) -> PoseSpace {
        let rotation_deg = Vector3::from(half_deg).map(|x| x.min(HALF_TURN));
        PoseSpace { region: Region::Ellipsoid, rotation_deg, ..PoseSpace::at(self.home) }
    }

    fn options(&self) -> AssessOptions {
        AssessOptions::new().points(POINTS).searches(1).seed(self.seed).close(false)
    }

    /// A violation shown by poses of a region, or by searches from the worst of them.
    fn shown(&self, space: &PoseSpace) -> Option<(Limit, f64)> {
        let found = assess(self.design.manipulator(), self.required, space, &self.options());
        let violated = found.margins.iter().filter(|m| !m.term.kind.is_fixed());
        violated.filter(|m| !m.standing.is_met()).map(|m| (Limit::Term(m.term), m.value)).next()
    }

    /// Assesses a region: all requirements that depend on the pose, and the sign of `det J`.
    fn assess(&self, space: &PoseSpace) -> RegionVerdict {
        if let Some((limit, margin)) = self.shown(space) {
            return RegionVerdict::Violated(limit, margin);
        }
        let (m, options) = (self.design.manipulator(), self.options());
        let proof = prove(m, self.required, space, &options, CELLS);
        let bounds = || proof.bounds.iter().filter(|b| !b.found.term.kind.is_fixed());
        let violated = |b: &&machine::requirements::MarginBound| b.verdict.is_met() == Some(false);
        if let Some(b) = bounds().find(violated) {
            return RegionVerdict::Violated(Limit::Term(b.found.term), b.found.value);
        }
        let regularity = regular_region(m, self.required, space, CELLS, self.seed);
        match regularity.is_regular() {
            Some(false) => RegionVerdict::Violated(Limit::Singular, 0.0),
            Some(true) if bounds().all(|b| b.verdict.is_met() == Some(true)) => RegionVerdict::Free,
            _ => RegionVerdict::Undecided,
        }
    }

    /// Bisects between the largest proved and the smallest violated size, starting from a ray that ended at a
    /// violation.
    fn largest(&self, ray: &FreeRay, space: &dyn Fn(f64) -> PoseSpace) -> FreeSize {
        let mut found = FreeSize { proved: 0.0, searched: ray.free, binding: ray.binding.map(|l| (l, 0.0)) };
        if !(ray.free > 0.0 && ray.free.is_finite()) {
            return FreeSize { searched: 0.0, ..found };
        }
        // from this size on nothing is proved
        let (mut doubtful, mut size) = (ray.free, ray.free * (1.0 - INSIDE));
        for _ in 0..ROUNDS {
            match self.assess(&space(size)) {
                RegionVerdict::Free => found.proved = size,
                RegionVerdict::Violated(limit, margin) => {
                    (found.searched, found.binding) = (size, Some((limit, margin)));
                    doubtful = size;
                }
                RegionVerdict::Undecided => doubtful = size,
            }
            if found.proved >= doubtful * (1.0 - CLOSE) {
                break;
            }
            size = if found.proved > 0.0 { 0.5 * (found.proved + doubtful) } else { 0.8 * doubtful };
        }
        found
    }

    /// The region of the design, scaled by the largest free factor.
    fn of_required_region(&self) -> Option<RequiredSize> {
        let w = &self.design.workspace;
        if !w.has_box() {
            return None;
        }
        let own = w.space(&self.home);
        let space = |t: f64| own.scaled_region(t);
        let most = (HALF_TURN / space(1.0).reach().1.max()).min(LARGEST);
        // the first violated factor
        let mut first = FreeRay { direction: Vector3::z(), free: most, binding: None };
        let mut factor = 0.5;
        while factor < most {
            if let Some((limit, _)) = self.shown(&space(factor)) {
                (first.free, first.binding) = (factor, Some(limit));
                break;
            }
            factor *= 1.2;
        }
        let factor = self.largest(&first, &space);
        let parts = own.translation;
        let whole = match own.region {
            Region::Box => 8.0,
            Region::Ellipsoid => 4.0 / 3.0 * std::f64::consts::PI,
        };
        Some(RequiredSize { volume: whole * parts.x * parts.y * parts.z, factor })
    }
}
