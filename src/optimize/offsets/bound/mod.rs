//! A proved upper bound of the worst-case inverse condition number over all offsets: branch and bound.
//!
//! A box is excluded by a proof that no offsets in it reach the given value.

mod corners;
mod multipliers;
mod rows;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use nalgebra::Matrix6;

use self::corners::{AtCorners, Vectors, at_corners, combination};
use self::multipliers::{SAMPLES, Sampled, multipliers};
use self::rows::{LegRow, QuadraticQuotient, greatest};
use super::conditioning::{PoseLegs, worst_case_above};
use super::limits::{OffsetLimits, OffsetRanges, point};
use super::problem::{OffsetModel, OffsetProblem};
use num::ball::Real;
use num::parallel::parallel;
use num::small::bounded_svd;
use synthesis::sides;

/// The proved upper bound over all offsets.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "GlobalBoundRecord", transform = num::nullable))]
pub struct GlobalBound {
    /// Greatest value that offsets within limits could reach.
    // of the worst-case inverse condition number, proved in interval arithmetic
    pub upper: f64,
    /// Relative gap of the bound above the solution.
    // `upper / value - 1`
    pub gap: f64,
    /// Number of searched boxes.
    pub boxes: usize,
}

impl GlobalBound {
    /// The bound with the gap to the final value.
    pub fn above(self, value: Option<f64>) -> Self {
        Self { gap: value.map_or(self.gap, |v| self.upper / v - 1.0), ..self }
    }
}

/// Effort of the bound.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundOptions {
    /// Relative gap to prove.
    pub gap: f64,
    /// Number of boxes after which the gap is widened.
    pub boxes: usize,
    pub threads: usize,
}

/// A box of offsets that may still contain a better solution.
#[derive(Debug, Clone)]
struct BoundNode {
    bounds: OffsetRanges,
    /// Poses to evaluate, the worst of the parent first.
    poses: Vec<usize>,
    /// Number of halvings.
    depth: usize,
}

/// Number of boxes per batch; their results are taken in order, so threads have no influence.
const BATCH: usize = 32;
/// Number of poses that a part of a box inherits.
const INHERITED: usize = 80;
/// Number of halvings between evaluations at all poses.
const REVIEW: usize = 8;
/// Share of the requested gap that the proof aims at.
const AIM: f64 = 0.999;
/// Widening of the gap when the boxes are used up, and the share of boxes for each wider gap.
const WIDER: f64 = 2.0;
const MORE: usize = 8;
/// A proof with at most this share of the boxes is repeated with a tenth of the gap and as many further boxes.
const EASY: usize = 10;
/// Greatest claimed gap.
const WIDEST: f64 = 64.0;

/// Number of boxes with all poses evaluated at their middles.
const LOOKS: usize = 24;

fn middle(bounds: &OffsetRanges) -> [f64; 6] {
    bounds.map(|(low, high)| f64::midpoint(low, high))
}

/// The search tree with its data of the problem.
pub(super) struct Bounding<'a> {
    model: &'a OffsetModel,
    limits: &'a OffsetLimits,
    poses: Vec<EnclosedPose>,
}

impl<'a> Bounding<'a> {
    /// `None` if the data give no intervals.
    pub(super) fn new(
        problem: &OffsetProblem,
        model: &'a OffsetModel,
        limits: &'a OffsetLimits,
    ) -> Option<Self> {
        let plain = sides(&problem.octahedral, 1.0);
        let rows = |pose: &platform::geom::Pose| -> Option<EnclosedPose> {
            let rows: Option<Vec<LegRow>> =
                plain.iter().map(|s| LegRow::new(s, pose, problem.characteristic_length)).collect();
            Some(EnclosedPose { rows: rows?.try_into().ok()? })
        };
        let poses: Option<Vec<EnclosedPose>> = problem.poses.iter().map(rows).collect();
        Some(Self { model, limits, poses: poses? })
    }

    /// The bound for the requested gap, and for a tenth of it if that was easy; see [`Self::prove_once`].
    pub(super) fn prove(
        &self,
        boxes: Vec<OffsetRanges>,
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
            // a wider gap than the first is useless
            if boxes > easy { ControlFlow::Break(()) } else { tick(done + boxes, open, best) }
        });
        Some(
            second
                .filter(|s| s.upper < first.upper)
                .map_or(first, |s| GlobalBound { boxes: done + s.boxes, ..s }),
        )
    }

    /// Lowers the bound to `value (1 + gap)` over the given boxes. `improve` gets the middle of every kept box and
    /// returns the best known value from then on. `None` if `tick` stops, or if nothing could be proved.
    fn prove_once(
        &self,
        boxes: Vec<OffsetRanges>,
        mut value: f64,
        o: BoundOptions,
        improve: &mut dyn FnMut(&[[f64; 6]]) -> f64,
        tick: &mut dyn FnMut(usize, usize, f64) -> ControlFlow<()>,
    ) -> Option<GlobalBound> {
        let first = self.telling_poses(&boxes);
        let mut open: Vec<BoundNode> =
            boxes.into_iter().map(|bounds| BoundNode { bounds, poses: first.clone(), depth: 0 }).collect();
        // slightly below, so that rounding cannot carry the last step across the requested gap
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

    /// The poses to continue with; `None` if the box is excluded.
    fn look(&self, node: &BoundNode, limit: f64) -> Option<Vec<usize>> {
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
        // a pose that refutes the middle belongs in the proofs of the parts
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

    /// Poses that are worst in the middles of some boxes, most frequent first: a start for the proofs.
    fn telling_poses(&self, boxes: &[OffsetRanges]) -> Vec<usize> {
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
    fn halves(&self, node: &BoundNode, poses: &[usize]) -> [BoundNode; 2] {
        let reach = |i: usize| (node.bounds[i].1 - node.bounds[i].0) * self.model.sides[i].edge_length();
        let longest = (1..6).fold(0, |best, i| if reach(i) > reach(best) { i } else { best });
        let (low, high) = node.bounds[longest];
        let cut = f64::midpoint(low, high);
        let poses = &poses[..poses.len().min(INHERITED)];
        [(low, cut), (cut, high)].map(|range| {
            let mut bounds = node.bounds;
            bounds[longest] = range;
            BoundNode { bounds, poses: poses.to_vec(), depth: node.depth + 1 }
        })
    }
}

/// Attempts at a proof, by numbers of poses: those evaluated, those in the combination, those with mixed vectors, and
/// those with determinants. Most boxes need only the first, cheap attempt.
const ATTEMPTS: [(usize, usize, usize, usize); 2] = [(10, 6, 3, 8), (usize::MAX, 30, 20, 14)];

/// The poses of the problem as rows in intervals and the singular vectors that bound the singular values.
#[derive(Debug)]
struct EnclosedPose {
    rows: [LegRow; 6],
}

/// Vectors that bound the smallest and the largest singular value, and the quotient of these.
///
/// The first of each is the right singular vector. If another singular value is near, the eigenvectors rotate quickly
/// with the offsets, and one vector bounds to first order only. The other vector and the two half-way directions are
/// then added, so that the multipliers can mix them.
struct Direction {
    ratio: f64,
    low: Vec<[f64; 6]>,
    high: Vec<[f64; 6]>,
    /// Left and right singular vectors for determinants.
    vectors: Option<Vectors>,
}

/// Singular values within this factor count as near.
const NEAR: f64 = 1.6;

impl Direction {
    /// `None` if the decomposition fails.
    fn of(j: &Matrix6<f64>) -> Option<Self> {
        let svd = bounded_svd(j)?;
        let vectors = Vectors::of(&svd);
        let v = svd.v_t?;
        let sigma = svd.singular_values;
        let mut order = [0, 1, 2, 3, 4, 5];
        order.sort_by(|&a, &b| sigma[a].total_cmp(&sigma[b]));
        let row = |k: usize| -> [f64; 6] { std::array::from_fn(|c| v[(k, c)]) };
        let ratio = sigma[order[0]] / sigma[order[5]];
        let mixed = |first: usize, second: usize| -> Vec<[f64; 6]> {
            let (x, y) = (row(first), row(second));
            let near = sigma[first].max(sigma[second]) < NEAR * sigma[first].min(sigma[second]);
            if !near {
                return vec![x];
            }
            let halfway = |sign: f64| std::array::from_fn(|c| x[c] + sign * y[c]);
            vec![x, y, halfway(1.0), halfway(-1.0)]
        };
        ratio.is_finite().then(|| Self {
            ratio,
            low: mixed(order[0], order[1]),
            high: mixed(order[5], order[4]),
            vectors,
        })
    }
}

/// The result for a box.
#[derive(Debug)]
enum Test {
    /// No offsets of the box reach the limit at all poses: proved.
    Excluded,
    /// Not proved; the poses that are worst in the middle come first, for the parts of the box.
    Kept(Vec<usize>),
}

/// A function that is non-negative at offsets that reach the limit: pose and the two vectors.
struct Function<'a> {
    pose: usize,
    low: &'a [f64; 6],
    high: &'a [f64; 6],
}

/// Tries to prove that no offsets in `bounds` have an inverse condition number of at least `limit` at all poses.
///
/// For every pose `k` and all vectors, `sigma_6 <= |J v| / |v|` and `sigma_1 >= |J w| / |w|`. If offsets `t` reached
/// the limit, then `|J_k v_k|^2 / |v_k|^2 - limit^2 |J_k w_k|^2 / |w_k|^2 >= 0` for all `k`. Row `i` of `J_k` depends
/// only on `t_i`. For any multipliers `mu_k >= 0` the sum over `k` is then a sum of six functions of one offset each.
/// The box is excluded if their greatest values sum to less than 0. `v_k`, `w_k` are the singular vectors in the middle
/// of the box, and the multipliers come from a linear program over samples. Both only determine the sharpness of the
/// proof.
fn test(
    poses: &[EnclosedPose],
    plain: &[PoseLegs],
    candidates: &[usize],
    bounds: &OffsetRanges,
    limit: f64,
) -> Test {
    let middle = bounds.map(|(low, high)| f64::midpoint(low, high));
    let mut found: Vec<(usize, Direction)> = Vec::new();
    let mut estimates: BTreeMap<usize, Option<AtCorners>> = BTreeMap::new();
    let mut seen = 0;
    for (looked_at, taking_part, mixed, at_all_corners) in ATTEMPTS {
        let more = &candidates[seen..candidates.len().min(looked_at)];
        seen += more.len();
        found.extend(more.iter().filter_map(|&k| Some((k, Direction::of(&plain[k].jacobian(&middle))?))));
        found.sort_by(|a, b| a.1.ratio.total_cmp(&b.1.ratio).then(a.0.cmp(&b.0)));
        if excluded(poses, &found[..found.len().min(taking_part)], mixed, bounds, limit) {
            return Test::Excluded;
        }
        let worst = &found[..found.len().min(at_all_corners)];
        let in_doubles = |(k, d): &(usize, Direction)| {
            *estimates
                .entry(*k)
                .or_insert_with(|| at_corners::<f64>(&poses[*k].rows, d.vectors.as_ref()?, bounds, limit))
        };
        let likely: Vec<AtCorners> = worst.iter().filter_map(in_doubles).collect();
        let in_balls = |(k, d): &(usize, Direction)| {
            at_corners::<Real>(&poses[*k].rows, d.vectors.as_ref()?, bounds, limit)
        };
        // balls take several times as long, and most boxes have no combination
        if combination(&likely).is_some()
            && corners::excluded(&worst.iter().filter_map(in_balls).collect::<Vec<_>>())
        {
            return Test::Excluded;
        }
    }
    Test::Kept(found.into_iter().map(|f| f.0).collect())
}

/// One attempt with these poses, worst first.
fn excluded(
    poses: &[EnclosedPose],
    found: &[(usize, Direction)],
    mixed: usize,
    bounds: &OffsetRanges,
    limit: f64,
) -> bool {
    let mut functions: Vec<Function<'_>> = Vec::new();
    for (place, (pose, d)) in found.iter().enumerate() {
        // the first vectors with each of the others, for the worst poses only
        let more = |list: &[[f64; 6]]| if place < mixed { list.len() } else { 1 };
        let pairs = (0..more(&d.low)).map(|i| (i, 0)).chain((1..more(&d.high)).map(|j| (0, j)));
        functions.extend(pairs.map(|(i, j)| Function { pose: *pose, low: &d.low[i], high: &d.high[j] }));
    }
    let samples = sampled(poses, &functions, bounds, limit * limit);
    // one function alone often suffices
    let alone = |s: &Sampled| -> f64 { s.iter().map(|v| v.iter().copied().fold(f64::MIN, f64::max)).sum() };
    let single = samples.iter().map(alone).zip(0..).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((value, k)) = single
        && value < 0.0
        && proved(poses, &[(1.0, &functions[k])], bounds, limit)
    {
        return true;
    }
    multipliers(&samples).is_some_and(|mu| {
        let terms: Vec<(f64, &Function<'_>)> =
            mu.into_iter().zip(&functions).filter(|(m, _)| *m > 0.0).collect();
        proved(poses, &terms, bounds, limit)
    })
}

/// Whether the greatest values of the weighted sum of the functions sum to less than 0, in intervals.
fn proved(poses: &[EnclosedPose], terms: &[(f64, &Function<'_>)], bounds: &OffsetRanges, limit: f64) -> bool {
    let limit = point(limit).square();
    let greatest_of = |i: usize| -> f64 {
        let quotient = |(mu, f): &(f64, &Function<'_>)| -> Option<(f64, QuadraticQuotient)> {
            Some((*mu, poses[f.pose].rows[i].excess(f.low, f.high, limit)?))
        };
        let all: Option<Vec<(f64, QuadraticQuotient)>> = terms.iter().map(quotient).collect();
        all.map_or(f64::INFINITY, |all| greatest(&all, bounds[i]))
    };
    // each partial sum is rounded upwards
    (0..6).map(greatest_of).fold(0.0, |s, x| (s + x.next_up()).next_up()) < 0.0
}

/// Values of every function at the samples of its offsets, in plain arithmetic.
fn sampled(
    poses: &[EnclosedPose],
    functions: &[Function<'_>],
    bounds: &OffsetRanges,
    limit: f64,
) -> Vec<Sampled> {
    let norm = |v: &[f64; 6]| v.iter().map(|x| x * x).sum::<f64>();
    let last = (SAMPLES - 1) as f64;
    let values = |f: &Function<'_>| -> Sampled {
        let (low, high) = (1.0 / norm(f.low), limit / norm(f.high));
        std::array::from_fn(|i| {
            let row = poses[f.pose].rows[i].plain();
            let ((a, b), (c, d)) = (row.along(f.low), row.along(f.high));
            let range = bounds[i];
            std::array::from_fn(|k| {
                let t = range.0 + (range.1 - range.0) * (k as f64 / last);
                let (v, w) = (a + t * b, c + t * d);
                (low * v * v - high * w * w) / row.square_at(t)
            })
        })
    };
    functions.iter().map(values).collect()
}
