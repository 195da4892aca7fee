//! Free travel of the platform from a pose until a requirement binds, and the allowed pose nearest to a given one.
//!
//! On a [`StraightPath`] every joint of the platform moves with a speed and an acceleration that are known beforehand.
//! So the rate of each margin is bounded, and [`Reach::along`] takes steps over which no margin can reach zero.
//! `docs/theory/reach.md` has the bounds.

mod nearest;
mod path;
mod projection;
mod rays;
mod step;
mod surface;
#[cfg(test)]
mod tests;

use crate::requirements::{Limit, Requirements, Terms};
use platform::geom::Pose;
use platform::manipulator::{Leg, Manipulator};

pub use nearest::{NearestPose, NearestPoseOptions};
pub use path::{PoseAxis, StraightPath};
pub use rays::{FreeRay, largest_box_within, volume_of_rays};
pub use surface::ReachedSurface;

/// `|det J|` with lengths over the size below which home counts as singular.
const SINGULAR: f64 = 1e-12;
/// Greatest step of a path, as a share of the size, at the fastest joint. Forces and the sign of `det J` are sampled at
/// this distance.
const LONGEST: f64 = 0.02;
/// Shortest step of a path, as a share of the size. Near a margin of zero, steps have this length and double each time.
const SHORTEST: f64 = 1e-5;
/// The end of the path is found to this share of the size.
const RESOLUTION: f64 = 1e-12;
/// The search along an axis ends at this many sizes, or at half a turn.
const FARTHEST: f64 = 10.0;

/// The limits of the poses of a manipulator: its requirements, and the sign of `det J` at home.
#[derive(Debug)]
pub struct Reach<'a> {
    required: &'a Requirements,
    terms: Terms<'a>,
    legs: [Leg; 6],
    home: Pose,
    size: f64,
    /// Length that makes rotations comparable with translations, design units.
    length: f64,
    /// `det J` at home; `None` where it vanishes.
    at_home: Option<f64>,
}

/// Free travel along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// Length of the free part in the unit of the path; at its end every requirement is met within rounding.
    pub amount: f64,
    /// The pose there.
    pub pose: Pose,
    /// The requirement violated beyond the end; `None` if the path ends before anything binds.
    pub binding: Option<Limit>,
    /// Number of evaluated poses.
    pub poses: usize,
}

/// Free travel of one of the six numbers of a pose, with the others fixed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeRange {
    /// The moving coordinate.
    pub axis: PoseAxis,
    /// Towards smaller values; its amount is positive, design units or radians.
    pub back: Travel,
    /// Towards greater ones.
    pub forth: Travel,
}

impl<'a> Reach<'a> {
    /// Prepares the requirements. `length` makes rotations comparable with translations in distances of poses: a radian
    /// counts as this many design units.
    #[must_use]
    pub fn new(m: &'a Manipulator, required: &'a Requirements, home: &Pose, length: f64) -> Self {
        let terms = Terms::new(m, required, home);
        let at_home = terms.determinant(home).filter(|det| det.abs() > SINGULAR);
        Self { required, terms, legs: m.legs(), home: *home, size: m.size(), length, at_home }
    }

    /// The margins of all requirements at a pose, and the ratio of `det J` to its value at home if home is regular.
    #[must_use]
    pub fn margins(&self, pose: &Pose) -> Vec<(Limit, f64)> {
        let terms = self.terms.at(pose).into_iter().map(|(term, margin)| (Limit::Term(term), margin));
        // where a rod does not close, that is the violation
        let ratio =
            self.at_home.and_then(|home| Some((Limit::Singular, self.terms.determinant(pose)? / home)));
        terms.chain(ratio).collect()
    }

    /// The margin of one limit at a pose; NaN if the pose has no such margin.
    #[must_use]
    pub fn margin_of(&self, limit: Limit, pose: &Pose) -> f64 {
        let margins = self.margins(pose);
        margins.iter().find(|(other, _)| *other == limit).map_or(f64::NAN, |(_, margin)| *margin)
    }

    /// Whether a margin is met at its pose; a margin equal to its limit within rounding is met.
    #[must_use]
    pub fn is_met(&self, limit: Limit, margin: f64, pose: &Pose) -> bool {
        match limit {
            _ if margin > 0.0 => true,
            Limit::Term(term) => self.terms.standing(term.kind, margin, Some(pose)).is_met(),
            Limit::Singular => false,
        }
    }

    /// The violated requirements at a pose, the worst first; empty for an allowed pose.
    #[must_use]
    pub fn violated(&self, pose: &Pose) -> Vec<(Limit, f64)> {
        self.violated_of(self.margins(pose), pose)
    }

    fn violated_of(&self, mut margins: Vec<(Limit, f64)>, pose: &Pose) -> Vec<(Limit, f64)> {
        margins.retain(|(limit, margin)| !self.is_met(*limit, *margin, pose));
        margins.sort_by(|a, b| self.share(a).total_cmp(&self.share(b)));
        margins
    }

    /// Whether every requirement is met at a pose and `det J` has the sign that it has at home. An equal sign does not
    /// prove that a path without singular poses leads there.
    #[must_use]
    pub fn allows(&self, pose: &Pose) -> bool {
        self.margins(pose).iter().all(|(limit, margin)| self.is_met(*limit, *margin, pose))
    }

    /// A margin as a share: over the size (lengths), 90 degrees (angles), the limit (forces, speeds, stiffness,
    /// frequency), or `det J` at home.
    fn share(&self, (limit, margin): &(Limit, f64)) -> f64 {
        margin / self.scale(*limit)
    }

    fn scale(&self, limit: Limit) -> f64 {
        match limit {
            Limit::Singular => 1.0,
            Limit::Term(term) => self.required.scale_of(term.kind, self.size),
        }
    }

    /// Free travel of the path from its start, up to `most`; 0 where the start is not allowed.
    ///
    /// Margins with bounded rates cannot be violated between two steps: lengths, joint angles, clearances, keep-outs,
    /// leg speeds, the envelope, and rods and angles of cranks. The exception is a margin near zero: steps are then a
    /// hundred-thousandth of the size, and double while it stays there. Forces, torques and speeds of cranks,
    /// stiffness, natural frequency and the sign of `det J` are sampled at every step. Steps are at most a fiftieth of
    /// the size.
    #[must_use]
    pub fn along(&self, path: &StraightPath, most: f64) -> Travel {
        let fastest = step::fastest(path, &self.legs).max(f64::MIN_POSITIVE);
        let [longest, shortest, resolution] =
            [LONGEST, SHORTEST, RESOLUTION].map(|x| x * self.size / fastest);
        let (mut t, mut pose) = (0.0, path.start);
        let mut margins = self.margins(&pose);
        let mut poses = 1;
        if let Some((limit, _)) = self.violated_of(margins.clone(), &pose).first() {
            return Travel { amount: 0.0, pose, binding: Some(*limit), poses };
        }
        let mut least = shortest;
        while t < most {
            let safe = self.safe_step(path, &pose, &margins);
            let step = safe.clamp(least, longest.max(least)).min(most - t);
            least = if safe < least { (2.0 * least).min(longest) } else { shortest };
            let next = if step < most - t { t + step } else { most };
            let there = path.at(next);
            margins = self.margins(&there);
            poses += 1;
            if margins.iter().any(|(limit, margin)| !self.is_met(*limit, *margin, &there)) {
                return self.between(path, t, next, resolution, poses);
            }
            (t, pose) = (next, there);
        }
        Travel { amount: t, pose, binding: None, poses }
    }

    /// The end of the path between an allowed and a forbidden place.
    fn between(
        &self,
        path: &StraightPath,
        mut met: f64,
        mut violated: f64,
        resolution: f64,
        mut poses: usize,
    ) -> Travel {
        while violated - met > resolution {
            let middle = 0.5 * (met + violated);
            if middle <= met || middle >= violated {
                break;
            }
            if self.allows(&path.at(middle)) {
                met = middle;
            } else {
                violated = middle;
            }
            poses += 1;
        }
        let binding = self.violated(&path.at(violated)).first().map(|(limit, _)| *limit);
        Travel { amount: met, pose: path.at(met), binding, poses }
    }

    /// Free travel of each of the six numbers of a pose until a requirement binds, with the others fixed. `None` where
    /// the pose itself is not allowed.
    ///
    /// Positions are searched over ten sizes, angles over half a turn.
    #[must_use]
    pub fn free_ranges(&self, pose: &Pose) -> Option<[FreeRange; 6]> {
        self.allows(pose).then(|| {
            PoseAxis::ALL.map(|axis| {
                let [back, forth] = self.both_ways(&StraightPath::axis(pose, axis));
                FreeRange { axis, back, forth }
            })
        })
    }

    /// The free travel of a path backwards and forwards: over half a turn if the platform turns, else over ten sizes.
    #[must_use]
    pub fn both_ways(&self, path: &StraightPath) -> [Travel; 2] {
        let most = if path.turn.norm() > 0.0 { std::f64::consts::PI } else { FARTHEST * self.size };
        [self.along(&path.reversed(), most), self.along(path, most)]
    }

    /// Distance of two poses: `sqrt(|p - p'|^2 + (L angle)^2)` with the length `L` of [`Reach::new`].
    #[must_use]
    pub fn distance(&self, from: &Pose, to: &Pose) -> f64 {
        let path = StraightPath::between(from, to);
        path.velocity.norm().hypot(self.length * path.turn.norm())
    }
}
