//! Differential evolution: populations that find the basins in which the convex steps start.
//!
//! The method is that of Storn, Price (1997), with steps towards one of the best (Zhang, Sanderson 2009) for half of
//! the trials. Requirements follow the rule of Deb (2000): points that meet them are ranked by their gain, before all
//! others by their violation. A trial competes with the nearest member (crowding, Thomsen 2004): competing with its
//! parent would soon move all members into the largest feasible region. It ends at the first pose at which it is no
//! better than this member.

use super::leg_lines::{HeldPose, LegLines};
use super::model::Model;
use super::worst_pose::PointJudging;
use crate::climb::{PENALTY, PointValues, Task};
use crate::offsets::Branch;
use num::Rng;

/// The merit of a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointMerit {
    /// Sum of the violations, 0 within the margin.
    violation: f64,
    gain: f64,
}

impl PointMerit {
    fn is_better(&self, other: &Self) -> bool {
        if self.violation.total_cmp(&other.violation).is_eq() {
            self.gain > other.gain
        } else {
            self.violation < other.violation
        }
    }

    pub(super) fn merit(&self, penalty: f64) -> f64 {
        self.gain - penalty * self.violation
    }

    /// Whether values and violations agree within a relative tolerance.
    pub(super) fn is_close(&self, other: &Self, within: f64) -> bool {
        is_close(self.gain, other.gain, within) && is_close(self.violation, other.violation, within)
    }

    pub(super) fn order(&self, other: &Self) -> std::cmp::Ordering {
        self.violation.total_cmp(&other.violation).then(other.gain.total_cmp(&self.gain))
    }
}

/// Whether two numbers agree within a relative tolerance.
pub(super) fn is_close(a: f64, b: f64, within: f64) -> bool {
    (a - b).abs() <= within * a.abs().max(b.abs())
}

/// A member of a population.
#[derive(Debug, Clone)]
pub(crate) struct Member {
    pub x: Vec<f64>,
    pub worth: PointMerit,
}

/// Number of members per variable, and the least and greatest total.
const MEMBERS: (usize, usize, usize) = (6, 24, 60);
/// A population with a smaller spread has converged, and climbs replace further trials.
const SETTLED: f64 = 1e-3;
/// The best members are one in this many.
const BEST: usize = 8;
/// Distance from the nearest better member beyond which a member leads a niche, in means of these distances.
const FAR: f64 = 2.0;

/// Judges points, beginning with the pose that refused the last one.
pub(crate) struct Judge<'m, 'a> {
    model: &'m Model<'a>,
    task: &'m Task,
    poses: Vec<HeldPose>,
}

/// Number of poses that judge the trials of most generations.
const FEW: usize = 24;
/// Number of generations between evaluations at all poses.
const REVIEW: usize = 10;

impl<'m, 'a> Judge<'m, 'a> {
    pub(super) fn new(model: &'m Model<'a>, task: &'m Task) -> Self {
        Self::over(model, task, model.first_poses())
    }

    pub(super) fn over(model: &'m Model<'a>, task: &'m Task, poses: Vec<HeldPose>) -> Self {
        Self { model, task, poses }
    }

    /// The poses, beginning with those that refused points last.
    pub(super) fn poses(&self) -> &[HeldPose] {
        &self.poses
    }

    /// Indices of the active poses at a point; the worst for some requirement or objective is last.
    fn binding(&self, x: &[f64]) -> Vec<usize> {
        let mut worst = PointJudging::new(self.model, x, self.task, self.model.sign(x));
        let mut binding: Vec<usize> = Vec::new();
        for (k, pose) in self.poses.iter().enumerate() {
            let before = worst.so_far.clone();
            worst.pose(pose);
            if before != worst.so_far {
                binding.push(k);
            }
        }
        binding
    }

    /// Up to `count` active poses at a point, the worst ones first.
    pub(super) fn worst(&self, x: &[f64], count: usize) -> Vec<HeldPose> {
        self.binding(x).into_iter().rev().take(count).map(|k| self.poses[k]).collect()
    }

    /// Moves the active poses at a point to the front.
    fn review(&mut self, x: &[f64]) {
        // moving a pose to the front keeps the order of those behind its place
        for k in self.binding(x) {
            self.poses[..=k].rotate_right(1);
        }
    }

    /// The merit of a point over the first `count` poses; `None` as soon as it is no better than `bar`.
    pub(super) fn worth(&mut self, x: &[f64], count: usize, bar: Option<&PointMerit>) -> Option<PointMerit> {
        let worth = |judged: &PointValues| {
            let within = judged.violation() <= 0.5 * self.model.backoff;
            let violation = if within { 0.0 } else { judged.total_violation(self.task) };
            PointMerit { violation, gain: judged.gain(self.task) }
        };
        let mut judging = PointJudging::new(self.model, x, self.task, self.model.sign(x));
        let refused = |w: PointMerit| bar.is_some_and(|bar| !w.is_better(bar));
        if refused(worth(&judging.so_far)) {
            return None;
        }
        for k in 0..self.poses.len().min(count) {
            judging.pose(&self.poses[k]);
            if refused(worth(&judging.so_far)) {
                self.poses[..=k].rotate_right(1);
                return None;
            }
        }
        let last = worth(&judging.finish());
        (!refused(last)).then_some(last)
    }
}

/// One population after its generations, best first.
pub(crate) fn evolve(
    judge: &mut Judge<'_, '_>,
    given: &[Vec<f64>],
    generations: usize,
    rng: &mut Rng,
) -> Vec<Member> {
    let model = judge.model;
    let free = model.shape.free();
    let size = (MEMBERS.0 * free.len()).clamp(MEMBERS.1, MEMBERS.2);
    let mut all: Vec<Member> = Vec::with_capacity(size);
    for k in 0..size {
        let x = given.get(k).cloned().unwrap_or_else(|| model.random_point(rng));
        all.extend(judge.worth(&x, usize::MAX, None).map(|worth| Member { x, worth }));
    }
    let by_worth = |a: &Member, b: &Member| a.worth.order(&b.worth);
    all.sort_by(by_worth);
    for generation in 0..generations {
        if model.is_stopped() || all.len() < 4 || free.is_empty() || spread(&all, &free) < SETTLED {
            break;
        }
        for i in 0..all.len() {
            let x = trial(model, &all, i, &free, rng);
            let k = nearest(model, &all, &x);
            all[k] = match judge.worth(&x, FEW, Some(&all[k].worth)) {
                Some(worth) => Member { x, worth },
                None => continue,
            };
        }
        all.sort_by(by_worth);
        if generation % REVIEW == REVIEW - 1 || generation + 1 == generations {
            judge.review(&all[0].x);
            for m in &mut all {
                m.worth = judge.worth(&m.x, usize::MAX, None).unwrap_or(m.worth);
            }
            all.sort_by(by_worth);
        }
    }
    all
}

/// Distance of two points: their variables in widths of the ranges, and 1 for each offset in another zone of its side.
///
/// Joints have to stay away from the corners, which separates the zones: each has its own optima, however small it is.
fn apart(model: &Model<'_>, a: &[f64], b: &[f64]) -> f64 {
    let shape = &model.shape;
    let bounds = shape.bounds.iter().enumerate().filter(|(_, (low, high))| high > low);
    let square: f64 = bounds.map(|(k, (low, high))| ((a[k] - b[k]) / (high - low)).powi(2)).sum();
    let branches = shape.offsets(a).zip(shape.offsets(b)).map(|(s, t)| (Branch::of(&s), Branch::of(&t)));
    let zones = branches.map_or(0, |(s, t)| s.0.iter().zip(&t.0).filter(|(s, t)| s != t).count());
    square.sqrt() + zones as f64
}

/// The member nearest to a point.
fn nearest(model: &Model<'_>, all: &[Member], x: &[f64]) -> usize {
    let distances = all.iter().map(|m| apart(model, &m.x, x)).enumerate();
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(k, _)| k)
}

/// The members in another order: the best of every niche first, then the others, both best first as before.
///
/// A member leads a niche if the nearest better one is more than twice as far away as such members are on average
/// (nearest-better clustering, Preuss 2010).
pub(super) fn leaders_first(model: &Model<'_>, members: Vec<Member>) -> impl Iterator<Item = Member> {
    let to_better = |i: usize| {
        members[..i].iter().map(|m| apart(model, &m.x, &members[i].x)).fold(f64::INFINITY, f64::min)
    };
    let distances: Vec<f64> = (0..members.len()).map(to_better).collect();
    let finite = distances.iter().filter(|d| d.is_finite());
    let far = FAR * finite.sum::<f64>() / members.len().saturating_sub(1).max(1) as f64;
    let (leaders, others): (Vec<_>, Vec<_>) = members.into_iter().zip(distances).partition(|(_, d)| *d > far);
    leaders.into_iter().chain(others).map(|(m, _)| m)
}

/// Largest difference of two members in a variable.
fn spread(all: &[Member], free: &[usize]) -> f64 {
    let range = |j: &usize| {
        let of = |m: &Member| m.x[*j];
        all.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
            - all.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    free.iter().map(range).fold(0.0, f64::max)
}

/// Mixtures of the ends of climbs, which are good places: `count` trials from the best of them.
pub(crate) fn offspring(
    judge: &mut Judge<'_, '_>,
    ends: &[&[f64]],
    count: usize,
    rng: &mut Rng,
) -> Vec<Vec<f64>> {
    let free = judge.model.shape.free();
    let mut all: Vec<Member> = Vec::with_capacity(ends.len());
    for x in ends {
        all.extend(judge.worth(x, usize::MAX, None).map(|worth| Member { x: x.to_vec(), worth }));
    }
    if all.is_empty() || free.is_empty() {
        return Vec::new();
    }
    all.sort_by(|a, b| b.worth.merit(PENALTY).total_cmp(&a.worth.merit(PENALTY)));
    (0..count).map(|i| trial(judge.model, &all, i % all.len(), &free, rng)).collect()
}

/// A mixture of a member with the difference of two others.
fn trial(model: &Model<'_>, all: &[Member], i: usize, free: &[usize], rng: &mut Rng) -> Vec<f64> {
    let pick = |n: usize, rng: &mut Rng| (rng.next_u64() % n as u64) as usize;
    let (a, b) = (pick(all.len(), rng), pick(all.len(), rng));
    let factor = rng.uniform(0.3, 0.9);
    let share = if rng.unit() < 0.5 { 0.9 } else { 0.3 };
    let towards_best = rng.unit() < 0.5;
    let from = if towards_best { pick(all.len().div_ceil(BEST), rng) } else { pick(all.len(), rng) };
    let always = free[pick(free.len(), rng)];
    let mut x = all[i].x.clone();
    for &j in free {
        if j != always && rng.unit() >= share {
            continue;
        }
        let own = all[i].x[j];
        let start = if towards_best { own + factor * (all[from].x[j] - own) } else { all[from].x[j] };
        let (low, high) = model.shape.bounds[j];
        let value = start + factor * (all[a].x[j] - all[b].x[j]);
        // half way to the violated bound
        x[j] = if value < low {
            f64::midpoint(own, low)
        } else if value > high {
            f64::midpoint(own, high)
        } else {
            value
        };
    }
    x
}

impl Model<'_> {
    /// Uniform within the bounds, axes along the legs at home.
    pub(super) fn random_point(&self, rng: &mut Rng) -> Vec<f64> {
        let mut x: Vec<f64> = self.shape.bounds.iter().map(|b| rng.uniform(b.0, b.1)).collect();
        self.aim(&mut x);
        x
    }

    /// Sets the joint axes along the legs at home.
    pub(super) fn aim(&self, x: &mut [f64]) {
        if self.shape.axes == [None; 2] {
            return;
        }
        let ends = self.shape.ends(x);
        let home = HeldPose { pose: self.terms.home, follows: true };
        let l = LegLines::new(&ends, &home);
        for (body, first) in self.shape.axes.iter().enumerate() {
            let Some(first) = first else { continue };
            for leg in 0..6 {
                let u = if body == 0 { l.direction[leg] } else { l.rotation.inverse() * l.direction[leg] };
                x[first + 3 * leg..first + 3 * leg + 3].copy_from_slice(u.as_slice());
            }
        }
    }
}
