//! A proved upper bound of the worst-case inverse condition number over all offsets: branch and bound.

mod ball;
mod corners;
mod exclude;
mod multipliers;
mod rows;
#[cfg(test)]
mod tests;

use std::ops::ControlFlow;

use exclude::{Pose, Test, test};
use rows::LegRow;

use super::conditioning::worst_case_above;
use super::hexagon::sides;
use super::limits::{Bounds, Limits};
use super::problem::{Model, OffsetProblem};
use crate::num::parallel::parallel;

/// No offsets within the limits of the problem reach more than `upper`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlobalBound {
    /// Upper bound of the worst-case inverse condition number, proved in interval arithmetic.
    pub upper: f64,
    /// `upper / value - 1` for the value of the solution.
    pub gap: f64,
    /// Boxes of offsets that were looked at.
    pub boxes: usize,
}

impl GlobalBound {
    /// The same with the gap to the value that was reached in the end.
    pub(crate) fn above(self, value: Option<f64>) -> Self {
        Self { gap: value.map_or(self.gap, |v| self.upper / v - 1.0), ..self }
    }
}

/// How far the bound is to be driven.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundOptions {
    /// Relative gap to prove.
    pub(crate) gap: f64,
    /// Boxes after which the gap is widened.
    pub(crate) boxes: usize,
    pub(crate) threads: usize,
}

/// A box of offsets that may still hold something better.
#[derive(Debug, Clone)]
struct Node {
    bounds: Bounds,
    /// Poses to look at, the worst of the parent first.
    poses: Vec<usize>,
    /// Halvings it took.
    depth: usize,
}

/// Boxes looked at side by side; their results are taken over in order, so that threads change nothing.
const BATCH: usize = 32;
/// Poses a part of a box inherits.
const INHERITED: usize = 80;
/// Boxes so many halvings down look at all poses once more.
const REVIEW: usize = 8;
/// Share of the gap asked for that the proof aims at.
const AIM: f64 = 0.999;
/// Widening of the gap when the boxes are used up, and the share of them that each wider gap gets.
const WIDER: f64 = 2.0;
const MORE: usize = 8;
/// A proof that took at most this share of the boxes is tried again with a tenth of the gap and as many boxes more.
const EASY: usize = 10;
/// No bound is claimed beyond this gap.
const WIDEST: f64 = 64.0;

/// Boxes in whose middles all poses are looked at.
const LOOKS: usize = 24;

fn middle(bounds: &Bounds) -> [f64; 6] {
    bounds.map(|(low, high)| f64::midpoint(low, high))
}

/// The search tree with what it needs of the problem.
pub(crate) struct Bounding<'a> {
    model: &'a Model,
    limits: &'a Limits,
    poses: Vec<Pose>,
}

impl<'a> Bounding<'a> {
    /// `None` when the data do not make intervals.
    pub(crate) fn new(problem: &OffsetProblem, model: &'a Model, limits: &'a Limits) -> Option<Self> {
        let plain = sides(&problem.octahedral, 1.0);
        let rows = |pose: &crate::geom::Pose| -> Option<Pose> {
            let rows: Option<Vec<LegRow>> =
                plain.iter().map(|s| LegRow::new(s, pose, problem.characteristic_length)).collect();
            Some(Pose { rows: rows?.try_into().ok()? })
        };
        let poses: Option<Vec<Pose>> = problem.poses.iter().map(rows).collect();
        Some(Self { model, limits, poses: poses? })
    }

    /// The bound for the gap asked for, and for a tenth of it where that was easy; see [`Self::prove_once`].
    pub(crate) fn prove(
        &self,
        boxes: Vec<Bounds>,
        value: f64,
        o: BoundOptions,
        improve: &mut dyn FnMut(&[[f64; 6]]) -> f64,
        tick: &mut dyn FnMut(usize, usize, f64) -> ControlFlow<()>,
    ) -> Option<GlobalBound> {
        let first = self.prove_once(boxes.clone(), value, o, improve, tick)?;
        let easy = o.boxes / EASY;
        if first.boxes > easy || first.gap > o.gap {
            return Some(first);
        }
        let finer = BoundOptions { gap: 0.1 * o.gap, boxes: easy, ..o };
        let value = improve(&[]).max(value);
        let done = first.boxes;
        let second = self.prove_once(boxes, value, finer, improve, &mut |boxes, open, best| {
            // a wider gap than the first is no use
            if boxes > easy { ControlFlow::Break(()) } else { tick(done + boxes, open, best) }
        });
        Some(
            second
                .filter(|s| s.upper < first.upper)
                .map_or(first, |s| GlobalBound { boxes: done + s.boxes, ..s }),
        )
    }

    /// Drives the bound down to `value (1 + gap)` over the boxes given. `improve` is asked with the middle of every box that is kept and
    /// answers with the best value known from then on. `None` when `tick` breaks off, or when nothing could be proved.
    fn prove_once(
        &self,
        boxes: Vec<Bounds>,
        mut value: f64,
        o: BoundOptions,
        improve: &mut dyn FnMut(&[[f64; 6]]) -> f64,
        tick: &mut dyn FnMut(usize, usize, f64) -> ControlFlow<()>,
    ) -> Option<GlobalBound> {
        let first = self.telling_poses(&boxes);
        let mut open: Vec<Node> =
            boxes.into_iter().map(|bounds| Node { bounds, poses: first.clone(), depth: 0 }).collect();
        // a little below, so that rounding does not carry the last step across the gap asked for
        let (mut gap, mut done, mut budget) = (o.gap * AIM, 0, o.boxes);
        while !open.is_empty() {
            if done >= budget {
                (gap, budget) = (gap * WIDER, budget + o.boxes / MORE);
                if gap > WIDEST {
                    return None;
                }
            }
            let batch = open.split_off(open.len().saturating_sub(BATCH));
            let limit = value * (1.0 + gap);
            let look = |k: usize| self.look(&batch[k], limit);
            let results = parallel(batch.len(), o.threads, look, &mut |_, _| ());
            done += batch.len();
            let mut middles = Vec::new();
            for (node, kept) in batch.iter().zip(results) {
                let Some(poses) = kept else { continue };
                middles.push(middle(&node.bounds));
                open.extend(self.halves(node, &poses));
            }
            value = value.max(improve(&middles));
            if tick(done, open.len(), value).is_break() {
                return None;
            }
        }
        let upper = (value * (1.0 + gap)).next_up();
        Some(GlobalBound { upper, gap: upper / value - 1.0, boxes: done })
    }

    /// The poses to go on with, `None` when the box is excluded.
    fn look(&self, node: &Node, limit: f64) -> Option<Vec<usize>> {
        if self.limits.is_empty(&node.bounds) {
            return None;
        }
        let Test::Kept(mut order) = test(&self.poses, &self.model.poses, &node.poses, &node.bounds, limit)
        else {
            return None;
        };
        if self.poses.len() > INHERITED && (node.depth + 1).is_multiple_of(REVIEW) {
            return Some(self.worst_at(&middle(&node.bounds)));
        }
        // a pose that refutes the middle belongs into the proofs for the parts
        let hint = order.first().copied().unwrap_or(0);
        if let Err((_, pose)) = worst_case_above(&self.model.poses, &middle(&node.bounds), limit, hint)
            && !order.contains(&pose)
        {
            order.insert(0, pose);
        }
        Some(order)
    }

    /// All poses, the worst at these offsets first.
    fn worst_at(&self, t: &[f64; 6]) -> Vec<usize> {
        let mut order: Vec<(f64, usize)> =
            self.model.poses.iter().map(|p| p.inverse_condition(t)).zip(0..).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        order.into_iter().map(|x| x.1).collect()
    }

    /// Poses that are worst in the middles of some of the boxes, most frequent first: a start for the proofs.
    fn telling_poses(&self, boxes: &[Bounds]) -> Vec<usize> {
        let count = self.model.poses.len();
        let mut hits: Vec<(usize, usize)> = (0..count).map(|k| (0, k)).collect();
        if count > INHERITED {
            for bounds in boxes.iter().step_by(boxes.len().div_ceil(LOOKS).max(1)) {
                self.worst_at(&middle(bounds)).into_iter().take(3).for_each(|k| hits[k].0 += 1);
            }
            hits.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
            hits.truncate(INHERITED);
        }
        hits.into_iter().map(|h| h.1).collect()
    }

    /// The box cut in the middle of the longest range, as measured along the edge.
    fn halves(&self, node: &Node, poses: &[usize]) -> [Node; 2] {
        let reach = |i: usize| (node.bounds[i].1 - node.bounds[i].0) * self.model.sides[i].edge_length();
        let longest = (1..6).fold(0, |best, i| if reach(i) > reach(best) { i } else { best });
        let (low, high) = node.bounds[longest];
        let cut = f64::midpoint(low, high);
        let poses = &poses[..poses.len().min(INHERITED)];
        [(low, cut), (cut, high)].map(|range| {
            let mut bounds = node.bounds;
            bounds[longest] = range;
            Node { bounds, poses: poses.to_vec(), depth: node.depth + 1 }
        })
    }
}
