//! The allowed pose nearest to one that may not be.

use nalgebra::{Rotation3, Vector6};

use super::projection::{HalfSpace, project};
use super::{Reach, StraightWay};
use crate::requirements::Limit;
use num::{Purpose, Rng};
use platform::geom::Pose;

/// `det J` over that at home that a pose found keeps: the set of regular poses has no nearest point of its own.
const REGULAR: f64 = 1e-3;
/// Step of the differences from which slopes of margins are made, over the size.
const DIFFERENCE: f64 = 1e-6;
/// A search ends when its next step would be shorter, over the size.
const STATIONARY: f64 = 1e-7;
/// A search ends when steps have to be shorter to make progress, over the size.
const TRUSTED: f64 = 1e-9;
/// Corrections that bring a step back to the limits.
const CORRECTIONS: usize = 6;
/// Poses tried for each further start.
const TRIES: usize = 50;
/// Poses that are led back to the limits where none of those tried is allowed, at most.
const LED_BACK: usize = 8;
/// Steps that lead a violated pose back to the limits, at most.
const RESTORING: usize = 60;
/// The first of them may go this far, over the size.
const RESTORED: f64 = 0.25;

/// How hard to look.
#[derive(Debug, Clone, Copy, PartialEq)]
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

/// An allowed pose near the one asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct NearestPose {
    /// The pose. Every requirement is met there, rounding kept in mind, and `det J` is at least a thousandth of that at
    /// home.
    pub pose: Pose,
    /// [`Reach::distance`] from the pose asked for.
    pub distance: f64,
    /// What keeps it from going nearer, with margins that are zero but for rounding; nothing where the pose asked for
    /// is allowed.
    pub binding: Vec<Limit>,
    /// Whether the conditions of first order of a nearest pose hold: no step along the margins made linear leads
    /// nearer. They hold at every nearest pose at which margins are smooth, and say nothing of poses farther away.
    pub stationary: bool,
    /// Whether the straight way from home leads there without violating anything on it, as [`Reach::along`] looks at
    /// it.
    pub straight_from_home: bool,
}

impl Reach<'_> {
    /// A pose locally nearest to `asked` among those allowed; `asked` itself where it is. `None` where no allowed pose
    /// was found to start from.
    ///
    /// From home, from the allowed poses to which `asked` and a violated home are led back, and from `starts` allowed
    /// poses drawn between home and `asked`, the straight way towards `asked` is followed to its first limit. From
    /// there a sequence of steps goes to the nearest pose that the margins made linear allow, corrected until all are
    /// met, each nearer than the last. The best end is the answer: not farther than where the straight way from home is
    /// first left, and nearest in its neighbourhood where it is [`stationary`](NearestPose::stationary). Deterministic
    /// for a seed.
    #[must_use]
    pub fn nearest(&self, asked: &Pose, o: &NearestPoseOptions) -> Option<NearestPose> {
        if self.allows(asked) {
            return Some(self.found(asked, asked, true));
        }
        let starts = self.starts(asked, o);
        let ends = starts.iter().map(|start| {
            let first = self.along(&StraightWay::between(start, asked), 1.0).pose;
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
        let way = self.along(&StraightWay::between(&self.home, pose), 1.0);
        let straight_from_home = way.amount > 1.0 - 10.0 * STATIONARY;
        NearestPose { pose: *pose, distance, binding, stationary, straight_from_home }
    }

    /// Whether a pose is allowed and regular enough to end at.
    pub(super) fn ends_at(&self, pose: &Pose) -> bool {
        self.margins(pose).iter().all(|(limit, margin)| match limit {
            Limit::Singular => *margin >= REGULAR * (1.0 - 1e-9),
            Limit::Term(_) => self.is_met(*limit, *margin, pose),
        })
    }

    /// Home, or the allowed pose to which it is led back, that of the pose asked for, and allowed poses drawn between
    /// home and the pose asked for.
    fn starts(&self, asked: &Pose, o: &NearestPoseOptions) -> Vec<Pose> {
        let mut rng = Purpose::NEAREST_POSES.rng(o.seed);
        let mut starts: Vec<Pose> =
            [&self.home, asked].into_iter().filter_map(|p| self.restored(p)).collect();
        let way = StraightWay::between(&self.home, asked);
        let mut far = self.distance(&self.home, asked);
        if starts.is_empty() {
            far = far.max(self.size);
        }
        let wanted = starts.len() + o.starts;
        let mut led_back = 0;
        for _ in 0..TRIES * o.starts.max(1) {
            if starts.len() >= wanted.max(1) {
                break;
            }
            let pose = self.drawn(&way.at(rng.unit()), 0.5 * far, &mut rng);
            if self.ends_at(&pose) {
                starts.push(pose);
            } else if starts.is_empty() && led_back < LED_BACK {
                led_back += 1;
                starts.extend(self.restored(&pose));
            }
        }
        starts
    }

    /// The greatest share by which a margin is below what it has to be; 0 or less where none is.
    fn missing(&self, pose: &Pose) -> f64 {
        let short = |m: &(Limit, f64)| if m.0 == Limit::Singular { REGULAR - m.1 } else { -self.share(m) };
        self.margins(pose)
            .iter()
            .map(short)
            .fold(f64::NEG_INFINITY, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
    }

    /// An allowed pose near one that may not be: the shortest steps to where all margins, made linear, are met, as long
    /// as they make the worst one better.
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

    /// A pose drawn about another one, up to a distance along each direction.
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

    /// The half spaces that the margins, made linear at a pose, leave to steps; those out of reach of steps up to
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

    /// From an allowed pose nearer to the one asked for, step by step, and whether the end is stationary.
    fn approach(&self, start: &Pose, asked: &Pose, steps: usize) -> (Pose, bool) {
        let mut pose = *start;
        if !self.ends_at(&pose) {
            return (pose, false);
        }
        let mut distance = self.distance(&pose, asked);
        let mut radius = distance.min(self.size);
        for _ in 0..steps {
            let way = StraightWay::between(&pose, asked);
            let wish =
                Vector6::from_fn(|k, _| if k < 3 { way.velocity[k] } else { self.length * way.turn[k - 3] });
            let mut spaces = self.half_spaces(&pose, radius);
            // a box of the steps that are trusted
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

    /// A pose brought back to its limits by the shortest steps that the margins made linear ask for; `None` where some
    /// are still violated.
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
