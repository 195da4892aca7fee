//! The allowed pose nearest to a given pose.

use nalgebra::{Rotation3, Vector6};

use super::projection::{HalfSpace, project};
use super::{Reach, StraightPath};
use crate::requirements::Limit;
use num::{Purpose, Rng};
use platform::geom::Pose;

/// Least ratio of `det J` to its value at home: the open set of regular poses has no nearest point.
const REGULAR: f64 = 1e-3;
/// Step of the differences for slopes of margins, over the size.
const DIFFERENCE: f64 = 1e-6;
/// A search ends when its next step is shorter than this, over the size.
const STATIONARY: f64 = 1e-7;
/// A search ends when only steps below this make progress, over the size.
const TRUSTED: f64 = 1e-9;
/// Corrections that bring a step back to the limits.
const CORRECTIONS: usize = 6;
/// Poses tried for each further start.
const TRIES: usize = 50;
/// Greatest number of poses led back to the limits if none of the tried poses is allowed.
const LED_BACK: usize = 8;
/// Greatest number of steps that lead a violated pose back to the limits.
const RESTORING: usize = 60;
/// Greatest length of the first of these steps, over the size.
const RESTORED: f64 = 0.25;

/// Effort of the search for the nearest pose.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct NearestPoseOptions {
    /// Starts besides home.
    pub starts: usize,
    /// Steps from each start at most.
    pub steps: usize,
    /// Seed of the further starts.
    pub seed: u64,
}

impl Default for NearestPoseOptions {
    fn default() -> Self {
        Self { starts: 4, steps: 100, seed: 0 }
    }
}

impl NearestPoseOptions {
    num::setters! {
        /// Starts besides home.
        fn starts(starts: usize) = starts;
        /// Steps from each start at most.
        fn steps(steps: usize) = steps;
        /// Seed of the further starts.
        fn seed(seed: u64) = seed;
    }
}

/// An allowed pose near the one asked for.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct NearestPose {
    /// The pose. Every requirement is met within rounding, and `det J` is at least a thousandth of its value at home.
    pub pose: Pose,
    /// [`Reach::distance`] from the pose asked for.
    pub distance: f64,
    /// The requirements that prevent a nearer pose, with margins of zero within rounding; empty if the requested pose
    /// is allowed.
    pub binding: Vec<Limit>,
    /// Whether the first-order conditions of a nearest pose hold: no step along the linearised margins leads nearer.
    /// They hold at every nearest pose with smooth margins, and do not exclude nearer poses farther away.
    pub stationary: bool,
    /// Whether the straight path from home to the pose violates nothing, as tested by [`Reach::along`].
    pub straight_from_home: bool,
}

impl Reach<'_> {
    /// An allowed pose locally nearest to `asked`; `asked` itself if it is allowed. `None` if no allowed pose was found
    /// as a start.
    ///
    /// The starts are home, the allowed poses to which `asked` and a violated home are led back, and `starts` allowed
    /// poses between home and `asked`. From each, the straight path towards `asked` is followed to its first limit.
    /// Then each step goes to the nearest pose within the linearised margins and is corrected until all are met, nearer
    /// than the last. The best result is the answer: not farther than the first limit of the straight path from home,
    /// and locally nearest if it is [`stationary`](NearestPose::stationary). Deterministic for a seed.
    #[must_use]
    pub fn nearest(&self, asked: &Pose, o: &NearestPoseOptions) -> Option<NearestPose> {
        if self.allows(asked) {
            return Some(self.found(asked, asked, true));
        }
        let starts = self.starts(asked, o);
        let ends = starts.iter().map(|start| {
            let first = self.along(&StraightPath::between(start, asked), 1.0).pose;
            self.approach(&first, asked, o.steps)
        });
        let best = ends.min_by(|a, b| self.distance(&a.0, asked).total_cmp(&self.distance(&b.0, asked)))?;
        Some(self.found(&best.0, asked, best.1))
    }

    fn found(&self, pose: &Pose, asked: &Pose, stationary: bool) -> NearestPose {
        let distance = self.distance(pose, asked);
        let near = |(limit, margin): &(Limit, f64)| {
            let floor = if *limit == Limit::Singular { REGULAR } else { 0.0 };
            (margin - floor) / self.scale(*limit) < 10.0 * STATIONARY
        };
        let binding = if distance > 0.0 {
            self.margins(pose).iter().filter(|m| near(m)).map(|(limit, _)| *limit).collect()
        } else {
            Vec::new()
        };
        let path = self.along(&StraightPath::between(&self.home, pose), 1.0);
        let straight_from_home = path.amount > 1.0 - 10.0 * STATIONARY;
        NearestPose { pose: *pose, distance, binding, stationary, straight_from_home }
    }

    /// Whether a pose is allowed and regular enough as a result.
    pub(super) fn ends_at(&self, pose: &Pose) -> bool {
        self.margins(pose).iter().all(|(limit, margin)| match limit {
            Limit::Singular => *margin >= REGULAR * (1.0 - 1e-9),
            Limit::Term(_) => self.is_met(*limit, *margin, pose),
        })
    }

    /// The starts: home, or the allowed pose to which it is led back; the same for the requested pose; and allowed
    /// poses between the two.
    fn starts(&self, asked: &Pose, o: &NearestPoseOptions) -> Vec<Pose> {
        let mut rng = Purpose::NEAREST_POSES.rng(o.seed);
        let mut starts: Vec<Pose> =
            [&self.home, asked].into_iter().filter_map(|p| self.restored(p)).collect();
        let path = StraightPath::between(&self.home, asked);
        let mut far = self.distance(&self.home, asked);
        if starts.is_empty() {
            far = far.max(self.size);
        }
        let needed = starts.len() + o.starts;
        let mut led_back = 0;
        for _ in 0..TRIES * o.starts.max(1) {
            if starts.len() >= needed.max(1) {
                break;
            }
            let pose = self.drawn(&path.at(rng.unit()), 0.5 * far, &mut rng);
            if self.ends_at(&pose) {
                starts.push(pose);
            } else if starts.is_empty() && led_back < LED_BACK {
                led_back += 1;
                starts.extend(self.restored(&pose));
            }
        }
        starts
    }

    /// The greatest share by which a margin is below its limit; 0 or less if none is.
    fn missing(&self, pose: &Pose) -> f64 {
        let short = |m: &(Limit, f64)| if m.0 == Limit::Singular { REGULAR - m.1 } else { -self.share(m) };
        self.margins(pose)
            .iter()
            .map(short)
            .fold(f64::NEG_INFINITY, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
    }

    /// An allowed pose near a possibly violated one. The steps are the shortest that meet all linearised margins; they
    /// continue while the worst margin improves.
    fn restored(&self, from: &Pose) -> Option<Pose> {
        let (mut pose, mut radius) = (*from, RESTORED * self.size);
        let mut worst = self.missing(&pose);
        for _ in 0..RESTORING {
            if self.ends_at(&pose) {
                return Some(pose);
            }
            let step = project(&Vector6::zeros(), &self.half_spaces(&pose, f64::INFINITY), 1e-15 * self.size);
            let next = self.stepped(&pose, &(step * (radius / step.norm().max(radius))));
            let left = self.missing(&next);
            if left < worst || self.ends_at(&next) {
                (pose, worst, radius) = (next, left, (1.5 * radius).min(self.size));
            } else {
                radius = 0.25 * radius.min(step.norm());
            }
            if !(radius > TRUSTED * self.size) {
                return None;
            }
        }
        None
    }

    /// A random pose about another one, up to a distance along each direction.
    fn drawn(&self, about: &Pose, far: f64, rng: &mut Rng) -> Pose {
        self.stepped(about, &Vector6::from_fn(|_, _| rng.uniform(-far, far)))
    }

    /// The pose after a step `(v, L w)`.
    pub(super) fn stepped(&self, pose: &Pose, step: &Vector6<f64>) -> Pose {
        Pose {
            rotation: Rotation3::new(step.fixed_rows::<3>(3) / self.length) * pose.rotation,
            position: pose.position + step.fixed_rows::<3>(0),
        }
    }

    /// The half spaces that the linearised margins at a pose leave to steps. Margins out of reach of steps up to
    /// `radius` are left out.
    fn half_spaces(&self, pose: &Pose, radius: f64) -> Vec<HalfSpace> {
        let here = self.margins(pose);
        let h = DIFFERENCE * self.size;
        let sides: [[Vec<(Limit, f64)>; 2]; 6] = std::array::from_fn(|k| {
            [h, -h].map(|step| self.margins(&self.stepped(pose, &Vector6::ith(k, step))))
        });
        let linear = here.iter().enumerate().map(|(n, (limit, margin))| {
            let floor = if *limit == Limit::Singular { REGULAR } else { 0.0 };
            let row = Vector6::from_fn(|k, _| (sides[k][0][n].1 - sides[k][1][n].1) / (2.0 * h));
            HalfSpace { row, bound: floor - margin }
        });
        linear
            .filter(|s| s.bound.is_finite() && s.row.iter().all(|x| x.is_finite()))
            .filter(|s| s.row.lp_norm(1) * radius > -s.bound)
            .collect()
    }

    /// Steps from an allowed pose towards the requested one; returns the last pose and whether it is stationary.
    fn approach(&self, start: &Pose, asked: &Pose, steps: usize) -> (Pose, bool) {
        let mut pose = *start;
        if !self.ends_at(&pose) {
            return (pose, false);
        }
        let mut distance = self.distance(&pose, asked);
        let mut radius = distance.min(self.size);
        for _ in 0..steps {
            let path = StraightPath::between(&pose, asked);
            let wish =
                Vector6::from_fn(
                    |k, _| if k < 3 { path.velocity[k] } else { self.length * path.turn[k - 3] },
                );
            let mut spaces = self.half_spaces(&pose, radius);
            // the trust region of the steps, a box
            for k in 0..6 {
                spaces
                    .extend([1.0, -1.0].map(|sign| HalfSpace { row: Vector6::ith(k, sign), bound: -radius }));
            }
            let step = project(&wish, &spaces, 1e-13 * self.size);
            if step.norm() < STATIONARY * self.size && radius > 10.0 * STATIONARY * self.size {
                return (pose, true);
            }
            let next = self.corrected(&self.stepped(&pose, &step), radius);
            let nearer = next.map(|next| (next, self.distance(&next, asked))).filter(|n| n.1 < distance);
            match nearer {
                Some((next, d)) => {
                    (pose, distance) = (next, d);
                    radius = (1.5 * radius).min(self.size);
                }
                None => radius *= 0.25,
            }
            if radius < TRUSTED * self.size {
                break;
            }
        }
        (pose, false)
    }

    /// A pose brought back to its limits by the shortest steps for the linearised margins; `None` if some remain
    /// violated.
    fn corrected(&self, pose: &Pose, radius: f64) -> Option<Pose> {
        let mut pose = *pose;
        for _ in 0..CORRECTIONS {
            if self.ends_at(&pose) {
                return Some(pose);
            }
            let step = project(&Vector6::zeros(), &self.half_spaces(&pose, radius), 1e-15 * self.size);
            if !(step.norm() <= radius) {
                return None;
            }
            pose = self.stepped(&pose, &step);
        }
        self.ends_at(&pose).then_some(pose)
    }
}
