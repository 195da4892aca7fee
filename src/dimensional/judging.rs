//! Values at a point, pose after pose, so that a look can end as soon as the point is known to be no better than another.

use std::collections::BTreeMap;

use super::kinematics::{HeldPose, Lines};
use super::merit::{Merit, Piece};
use super::model::{Group, Model, Task};
use super::problem::Objective;
use super::shape::Ends;
use super::terms::Item;

/// Values at a point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Judged {
    /// Gain of each objective.
    pub(crate) gains: Vec<f64>,
    /// Largest violation of each group (0 when met).
    pub(crate) violations: BTreeMap<Group, f64>,
}

impl Judged {
    pub(crate) fn violation(&self) -> f64 {
        self.violations.values().fold(0.0, |m, v| m.max(*v))
    }

    /// Sum of the largest violations of the groups; soft ones count a hundredth.
    pub(crate) fn total_violation(&self, task: &Task) -> f64 {
        self.violations.iter().map(|(g, v)| task.cost(*g) * v).sum()
    }

    pub(crate) fn gain(&self, task: &Task) -> f64 {
        task.weights.iter().zip(&self.gains).filter(|(w, _)| **w > 0.0).map(|(w, g)| w * g).sum()
    }
}

/// A point that is being judged: violations only grow with every pose, and gains only fall.
pub(crate) struct Judging<'m, 'a> {
    model: &'m Model<'a>,
    x: &'m [f64],
    task: &'m Task,
    ends: Ends,
    lengths: (f64, f64),
    pub(crate) so_far: Judged,
}

impl<'m, 'a> Judging<'m, 'a> {
    /// Begins with the requirements without a pose; `sign` of `det A` is to be kept.
    pub(crate) fn new(model: &'m Model<'a>, x: &'m [f64], task: &'m Task, sign: f64) -> Self {
        let ends = model.shape.ends(x);
        let so_far =
            Judged { gains: vec![f64::INFINITY; model.objectives.len()], violations: BTreeMap::new() };
        let mut out = Self { model, x, task, ends, lengths: (f64::INFINITY, f64::NEG_INFINITY), so_far };
        model.terms.fixed(&ends, &mut |item: Item<()>| out.hold(Group::Term(item.id.0), item.value));
        if let Some((value, _)) = model.determinant(x, sign) {
            out.hold(Group::Determinant, value);
        }
        for (_, _, value, _) in model.shape.rooms(&ends) {
            out.hold(Group::Reach, value);
        }
        out
    }

    fn hold(&mut self, group: Group, value: f64) {
        if !self.task.dropped.contains(&group) {
            let worst = self.so_far.violations.entry(group).or_insert(0.0);
            let miss = self.model.backoff - value;
            *worst = if miss.is_nan() { f64::INFINITY } else { worst.max(miss) };
        }
    }

    /// Looks at one more pose.
    pub(crate) fn pose(&mut self, at: &HeldPose) {
        let (model, ends) = (self.model, self.ends);
        let l = Lines::new(&ends, at);
        for (m, o) in model.wanted(self.task).filter(|(_, o)| Merit::is_over_poses(*o)) {
            self.so_far.gains[m] = self.so_far.gains[m].min(model.merit.at_pose(o, &model.terms, &l));
        }
        model
            .terms
            .visit(&l, &ends, self.x, &mut |item: Item<()>| self.hold(Group::Term(item.id.0), item.value));
        self.lengths = l.length.iter().fold(self.lengths, |r, x| (r.0.min(*x), r.1.max(*x)));
    }

    /// The values after the last pose.
    pub(crate) fn finish(mut self) -> Judged {
        for (m, o) in self.model.wanted(self.task).filter(|(_, o)| !Merit::is_over_poses(*o)) {
            self.so_far.gains[m] = self.gain_without_pose(o);
        }
        for (m, floor) in self.task.floors.iter().enumerate() {
            if let Some(floor) = floor {
                self.hold(Group::Floor(m), self.so_far.gains[m] - floor + self.model.backoff);
            }
        }
        self.so_far
    }

    fn gain_without_pose(&self, o: Objective) -> f64 {
        let (merit, terms) = (&self.model.merit, &self.model.terms);
        match o {
            Objective::Stroke => (self.lengths.0 - self.lengths.1) / terms.size,
            Objective::MeanConditioning => {
                let at = |p: &HeldPose| {
                    merit.at_pose(Objective::WorstConditioning, terms, &Lines::new(&self.ends, p))
                };
                merit.sample.iter().map(at).sum::<f64>() / merit.sample.len() as f64
            }
            _ => {
                let mut least = f64::INFINITY;
                merit.pieces_fixed(o, terms, &self.ends, &mut |p| {
                    if let Piece::Linear(value, _) = p {
                        least = least.min(value);
                    }
                });
                least
            }
        }
    }
}

impl Model<'_> {
    /// Values at a point over the poses.
    pub(crate) fn judge(&self, poses: &[HeldPose], x: &[f64], task: &Task, sign: f64) -> Judged {
        let mut judging = Judging::new(self, x, task, sign);
        for at in poses {
            judging.pose(at);
        }
        judging.finish()
    }
}
