//! Poses at which a requirement is met least: they are held from then on.

use std::collections::BTreeMap;

use nalgebra::Vector6;

use super::kinematics::{HeldPose, Lines};
use super::merit::Merit;
use super::model::{Group, Model, Task};
use super::problem::Objective;
use super::shape::Ends;
use super::terms::Item;
use crate::num::Rng;

/// Points looked at, and local searches from the worst of them for each quantity: four for an objective, one for what single legs or pairs have.
const POINTS: usize = 150;
const SEARCHES: [usize; 2] = [4, 1];
/// A requirement is searched when twice the spread over the points would bring it from the worst of them to its limit.
const SPREADS: f64 = 2.0;
/// First step of a search in the cube, and the last.
const STEPS: (f64, f64) = (0.25, 1e-5);

/// Requirements of single legs or pairs, and objectives, that depend on the pose. Each leg has worst poses of its own: searches for the
/// worst of all legs end again and again at the one that is held already.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Quantity {
    Constraint(Group, usize, usize),
    Objective(usize),
    /// Length of a leg for the stroke; with `true` the greatest one.
    Length(usize, bool),
}

/// What was seen of a quantity at the points.
#[derive(Debug, Clone)]
struct Seen {
    greatest: f64,
    worst: Vec<(f64, Vector6<f64>)>,
}

struct Look<'a> {
    model: &'a Model<'a>,
    ends: Ends,
    x: &'a [f64],
    task: &'a Task,
}

impl Look<'_> {
    fn lines(&self, cube: &Vector6<f64>) -> Lines {
        let pose = self.model.problem.space.pose(cube);
        Lines::new(&self.ends, &HeldPose { pose, follows: true })
    }

    /// Every quantity at a pose, to be small where it matters.
    fn all(&self, l: &Lines) -> BTreeMap<Quantity, f64> {
        let mut out = BTreeMap::new();
        let mut keep = |q, value: f64| {
            let least = out.entry(q).or_insert(f64::INFINITY);
            *least = f64::min(*least, value);
        };
        self.model.terms.visit(l, &self.ends, self.x, &mut |item: Item<()>| {
            let group = Group::Term(item.id.0);
            if !self.task.dropped.contains(&group) {
                keep(Quantity::Constraint(group, item.id.1, item.id.2), item.value);
            }
        });
        for (m, o) in self.model.objectives.iter().enumerate() {
            if Merit::is_over_poses(*o) && (self.task.weights[m] > 0.0 || self.task.floors[m].is_some()) {
                keep(Quantity::Objective(m), self.model.merit.at_pose(*o, &self.model.terms, l));
            }
        }
        if self.model.wanted(self.task).any(|(_, o)| o == Objective::Stroke) {
            for (leg, longest) in (0..6).flat_map(|leg| [(leg, false), (leg, true)]) {
                keep(Quantity::Length(leg, longest), self.length(l, leg, longest));
            }
        }
        out
    }

    /// To be small: the length, or the least of its opposite, in sizes.
    fn length(&self, l: &Lines, leg: usize, longest: bool) -> f64 {
        let value = l.length[leg] / self.model.terms.size;
        if longest { -value } else { value }
    }

    /// The least of [`Look::length`] of all legs over the held poses.
    fn least_length(&self, held: &[HeldPose], longest: bool) -> f64 {
        let at = |at: &HeldPose| {
            let l = Lines::new(&self.ends, at);
            (0..6).map(|leg| self.length(&l, leg, longest)).fold(f64::INFINITY, f64::min)
        };
        held.iter().map(at).fold(f64::INFINITY, f64::min)
    }

    fn one(&self, q: Quantity, cube: &Vector6<f64>) -> f64 {
        let l = self.lines(cube);
        match q {
            Quantity::Objective(m) => {
                self.model.merit.at_pose(self.model.objectives[m], &self.model.terms, &l)
            }
            Quantity::Length(leg, longest) => self.length(&l, leg, longest),
            Quantity::Constraint(group, first, second) => {
                let mut least = f64::INFINITY;
                self.model.terms.visit(&l, &self.ends, self.x, &mut |item: Item<()>| {
                    if (Group::Term(item.id.0), item.id.1, item.id.2) == (group, first, second) {
                        least = least.min(item.value);
                    }
                });
                least
            }
        }
    }

    /// Search along the axes and, for objectives, along as many random directions (singular values have kinks at which the axes lead nowhere), with
    /// steps that shrink by halves.
    fn descend(
        &self,
        q: Quantity,
        axes: &[usize],
        (mut value, mut cube): (f64, Vector6<f64>),
        rng: &mut Rng,
    ) -> (f64, Vector6<f64>) {
        let mut step = STEPS.0;
        while step > STEPS.1 {
            let mut better = false;
            let mut directions: Vec<Vector6<f64>> = axes.iter().map(|k| Vector6::ith(*k, 1.0)).collect();
            if matches!(q, Quantity::Objective(_)) {
                directions.extend(axes.iter().map(|_| {
                    let mut d = Vector6::zeros();
                    for k in axes {
                        d[*k] = rng.normal();
                    }
                    d.normalize()
                }));
            }
            for d in directions.iter().flat_map(|d| [*d, -d]) {
                let next = (cube + d * step).map(|c| c.clamp(-1.0, 1.0));
                let there = if next == cube { value } else { self.one(q, &next) };
                if there < value {
                    (value, cube, better) = (there, next, true);
                }
            }
            if !better {
                step *= 0.5;
            }
        }
        (value, cube)
    }
}

/// Poses at which a constraint is violated, or an objective is worse than at the held poses, by more than a hundredth of the spare.
pub(crate) fn worse_poses(
    model: &Model<'_>,
    x: &[f64],
    task: &Task,
    held: &[HeldPose],
    sign: f64,
    seed: u64,
) -> Vec<HeldPose> {
    let space = &model.problem.space;
    let axes = space.axes();
    if axes.is_empty() {
        return Vec::new();
    }
    let look = Look { model, ends: model.shape.ends(x), x, task };
    let judged = model.judge(held, x, task, sign);
    let mut seen: BTreeMap<Quantity, Seen> = BTreeMap::new();
    for cube in space.cube_points(POINTS, &mut Rng::stream(seed, 7)) {
        for (q, value) in look.all(&look.lines(&cube)) {
            let of = seen.entry(q).or_insert(Seen { greatest: value, worst: Vec::new() });
            of.greatest = of.greatest.max(value);
            of.worst.push((value, cube));
            of.worst.sort_by(|a, b| a.0.total_cmp(&b.0));
            of.worst.truncate(SEARCHES[usize::from(!matches!(q, Quantity::Objective(_)))]);
        }
    }
    let lengths = [false, true].map(|longest| look.least_length(held, longest));
    let (mut out, mut rng): (Vec<HeldPose>, Rng) = (Vec::new(), Rng::stream(seed, 8));
    for (q, Seen { greatest, worst }) in seen {
        // what the held poses guarantee
        let known = match q {
            Quantity::Constraint(..) => 0.5 * model.backoff,
            Quantity::Objective(m) => judged.gains[m] - model.backoff,
            Quantity::Length(_, longest) => lengths[usize::from(longest)] - model.backoff,
        };
        let far = worst.first().is_some_and(|(least, _)| least - SPREADS * (greatest - least) > known);
        if far && !matches!(q, Quantity::Objective(_)) {
            continue;
        }
        for (value, cube) in worst {
            let (value, cube) = look.descend(q, &axes, (value, cube), &mut rng);
            let pose = HeldPose { pose: space.pose(&cube), follows: true };
            if value < known && !out.contains(&pose) && !held.contains(&pose) {
                out.push(pose);
            }
        }
    }
    out
}
