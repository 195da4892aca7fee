//! Poses at which a requirement has the least margin; they are held from then on.
//!
//! The search goes pose by pose, so that it can end once the point is known to be no better than another.

use std::collections::BTreeMap;

use nalgebra::Vector6;

use super::leg_lines::{HeldPose, LegLines};
use super::merit::{Merit, MeritPiece};
use super::model::Model;
use super::shape::JointEnds;
use super::terms::PoseTerm;
use crate::climb::{ConstraintGroup, PointValues, Task};
use machine::requirements::{Objective, PoseSpace, TermKind};
use num::{Purpose, Rng};

/// Number of sampled points.
const POINTS: usize = 150;
/// Number of local searches from the worst of them for each quantity: for an objective, and for single legs or pairs.
const SEARCHES: [usize; 2] = [4, 1];
/// A requirement is searched if twice the spread over the points would bring it from the worst of them to its limit.
const SPREADS: f64 = 2.0;
/// First step of a search in the cube, and the last.
const STEPS: (f64, f64) = (0.25, 1e-5);

/// Requirements of single legs or pairs, and objectives, that depend on the pose. Each leg has its own worst poses:
/// searches for the worst of all legs end repeatedly at the one already held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum PoseQuantity {
    Constraint(TermKind, usize, usize),
    Objective(usize),
    /// Length of a leg for the stroke; `true` for the greatest one.
    Length(usize, bool),
}

/// Statistics of a quantity at the points.
#[derive(Debug, Clone)]
struct Seen {
    greatest: f64,
    worst: Vec<(f64, Vector6<f64>)>,
}

struct PoseScan<'a> {
    model: &'a Model<'a>,
    /// The region, or a range of a single coordinate.
    space: &'a PoseSpace,
    ends: JointEnds,
    x: &'a [f64],
    task: &'a Task,
}

impl PoseScan<'_> {
    fn lines(&self, cube: &Vector6<f64>) -> LegLines {
        let pose = self.space.pose(cube);
        LegLines::new(&self.ends, &HeldPose { pose, follows: true })
    }

    /// Every quantity at a pose; small values are critical.
    fn all(&self, l: &LegLines) -> BTreeMap<PoseQuantity, f64> {
        let mut out = BTreeMap::new();
        let mut keep = |q, value: f64| {
            let least = out.entry(q).or_insert(f64::INFINITY);
            *least = f64::min(*least, value);
        };
        self.model.terms.visit(l, &self.ends, self.x, &mut |item: PoseTerm<()>| {
            if !self.task.dropped.contains(&ConstraintGroup::Term(item.id.0)) {
                keep(PoseQuantity::Constraint(item.id.0, item.id.1, item.id.2), item.value);
            }
        });
        for (m, o) in self.model.objectives.iter().enumerate() {
            if Merit::is_over_poses(*o) && (self.task.weights[m] > 0.0 || self.task.floors[m].is_some()) {
                keep(PoseQuantity::Objective(m), self.model.merit.at_pose(*o, &self.model.terms, l));
            }
        }
        if self.model.wanted(self.task).any(|(_, o)| o == Objective::Stroke) {
            for (leg, longest) in (0..6).flat_map(|leg| [(leg, false), (leg, true)]) {
                keep(PoseQuantity::Length(leg, longest), self.length(l, leg, longest));
            }
        }
        out
    }

    /// The length, or its negative for the longest leg, in sizes; small values are critical.
    fn length(&self, l: &LegLines, leg: usize, longest: bool) -> f64 {
        let value = l.length[leg] / self.model.terms.size;
        if longest { -value } else { value }
    }

    /// The least of [`PoseScan::length`] of all legs over the held poses.
    fn least_length(&self, held: &[HeldPose], longest: bool) -> f64 {
        let at = |at: &HeldPose| {
            let l = LegLines::new(&self.ends, at);
            (0..6).map(|leg| self.length(&l, leg, longest)).fold(f64::INFINITY, f64::min)
        };
        held.iter().map(at).fold(f64::INFINITY, f64::min)
    }

    fn one(&self, q: PoseQuantity, cube: &Vector6<f64>) -> f64 {
        let l = self.lines(cube);
        match q {
            PoseQuantity::Objective(m) => {
                self.model.merit.at_pose(self.model.objectives[m], &self.model.terms, &l)
            }
            PoseQuantity::Length(leg, longest) => self.length(&l, leg, longest),
            PoseQuantity::Constraint(kind, first, second) => {
                let (mut least, ends) = (f64::INFINITY, (&self.ends, self.x));
                self.model.terms.visit_some(&l, ends, (kind, first, second), &mut |item: PoseTerm<()>| {
                    if (item.id.0, item.id.1, item.id.2) == (kind, first, second) {
                        least = least.min(item.value);
                    }
                });
                least
            }
        }
    }

    /// Search along the axes and, for objectives, along as many random directions, with steps halved each time.
    /// Singular values have kinks at which steps along the axes fail.
    fn descend(
        &self,
        q: PoseQuantity,
        axes: &[usize],
        (mut value, mut cube): (f64, Vector6<f64>),
        rng: &mut Rng,
    ) -> (f64, Vector6<f64>) {
        let mut step = STEPS.0;
        while step > STEPS.1 {
            let mut better = false;
            let mut directions: Vec<Vector6<f64>> = axes.iter().map(|k| Vector6::ith(*k, 1.0)).collect();
            if matches!(q, PoseQuantity::Objective(_)) {
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

/// Poses of the region and of the ranges at which a constraint is violated, or an objective is worse than at the held
/// poses, by more than a hundredth of the spare.
pub(crate) fn worse_poses(
    model: &Model<'_>,
    x: &[f64],
    task: &Task,
    held: &[HeldPose],
    sign: f64,
    seed: u64,
) -> Vec<HeldPose> {
    let mut out = worse_poses_of(model, &model.problem.space, (x, task), held, (sign, seed));
    for range in model.problem.space.ranges_alone() {
        out.extend(worse_poses_of(model, &range, (x, task), held, (sign, seed)));
    }
    out
}

/// Such poses of a region.
fn worse_poses_of(
    model: &Model<'_>,
    space: &PoseSpace,
    (x, task): (&[f64], &Task),
    held: &[HeldPose],
    (sign, seed): (f64, u64),
) -> Vec<HeldPose> {
    let axes = space.axes();
    if axes.is_empty() {
        return Vec::new();
    }
    let look = PoseScan { model, space, ends: model.shape.ends(x), x, task };
    let judged = model.judge(held, x, task, sign);
    let mut seen: BTreeMap<PoseQuantity, Seen> = BTreeMap::new();
    for cube in space.cube_points(POINTS, &mut Purpose::WORSE_POSES.rng(seed)) {
        for (q, value) in look.all(&look.lines(&cube)) {
            let of = seen.entry(q).or_insert(Seen { greatest: value, worst: Vec::new() });
            of.greatest = of.greatest.max(value);
            of.worst.push((value, cube));
            of.worst.sort_by(|a, b| a.0.total_cmp(&b.0));
            of.worst.truncate(SEARCHES[usize::from(!matches!(q, PoseQuantity::Objective(_)))]);
        }
    }
    let lengths = [false, true].map(|longest| look.least_length(held, longest));
    let (mut out, mut rng): (Vec<HeldPose>, Rng) = (Vec::new(), Purpose::DESCENT.rng(seed));
    for (q, Seen { greatest, worst }) in seen {
        // the value guaranteed by the held poses
        let known = match q {
            PoseQuantity::Constraint(..) => 0.5 * model.backoff,
            PoseQuantity::Objective(m) => judged.gains[m] - model.backoff,
            PoseQuantity::Length(_, longest) => lengths[usize::from(longest)] - model.backoff,
        };
        let far = worst.first().is_some_and(|(least, _)| least - SPREADS * (greatest - least) > known);
        if far && !matches!(q, PoseQuantity::Objective(_)) {
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

/// A point under judgement: with every pose violations can only grow, and gains only fall.
pub(crate) struct PointJudging<'m, 'a> {
    model: &'m Model<'a>,
    x: &'m [f64],
    task: &'m Task,
    ends: JointEnds,
    lengths: (f64, f64),
    pub(crate) so_far: PointValues,
}

impl<'m, 'a> PointJudging<'m, 'a> {
    /// Begins with the requirements without a pose; `sign` is the kept sign of `det A`.
    pub(super) fn new(model: &'m Model<'a>, x: &'m [f64], task: &'m Task, sign: f64) -> Self {
        let ends = model.shape.ends(x);
        let so_far =
            PointValues { gains: vec![f64::INFINITY; model.objectives.len()], violations: BTreeMap::new() };
        let mut out = Self { model, x, task, ends, lengths: (f64::INFINITY, f64::NEG_INFINITY), so_far };
        model
            .terms
            .fixed(&ends, &mut |item: PoseTerm<()>| out.hold(ConstraintGroup::Term(item.id.0), item.value));
        if let Some((value, _)) = model.determinant(x, sign) {
            out.hold(ConstraintGroup::Determinant, value);
        }
        for room in model.shape.rooms(&ends) {
            out.hold(ConstraintGroup::Reach, room.value);
        }
        out
    }

    fn hold(&mut self, group: ConstraintGroup, value: f64) {
        if !self.task.dropped.contains(&group) {
            self.so_far.hold(group, value, self.model.backoff);
        }
    }

    /// Evaluates one more pose.
    pub(super) fn pose(&mut self, at: &HeldPose) {
        let (model, ends) = (self.model, self.ends);
        let l = LegLines::new(&ends, at);
        for (m, o) in model.wanted(self.task).filter(|(_, o)| Merit::is_over_poses(*o)) {
            self.so_far.gains[m] = self.so_far.gains[m].min(model.merit.at_pose(o, &model.terms, &l));
        }
        // items of a kind are consecutive, so each kind is looked up once
        let mut last: Option<(TermKind, f64)> = None;
        model.terms.visit(&l, &ends, self.x, &mut |item: PoseTerm<()>| match &mut last {
            Some((kind, least)) if *kind == item.id.0 => {
                *least = if least.is_nan() || item.value.is_nan() { f64::NAN } else { least.min(item.value) };
            }
            _ => {
                if let Some((kind, least)) = last.replace((item.id.0, item.value)) {
                    self.hold(ConstraintGroup::Term(kind), least);
                }
            }
        });
        if let Some((kind, least)) = last {
            self.hold(ConstraintGroup::Term(kind), least);
        }
        self.lengths = l.length.iter().fold(self.lengths, |r, x| (r.0.min(*x), r.1.max(*x)));
    }

    /// The values after the last pose.
    pub(super) fn finish(mut self) -> PointValues {
        for (m, o) in self.model.wanted(self.task).filter(|(_, o)| !Merit::is_over_poses(*o)) {
            self.so_far.gains[m] = self.gain_without_pose(o);
        }
        for (m, floor) in self.task.floors.iter().enumerate() {
            if let Some(floor) = floor {
                self.hold(ConstraintGroup::Floor(m), self.so_far.gains[m] - floor + self.model.backoff);
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
                    merit.at_pose(Objective::WorstConditioning, terms, &LegLines::new(&self.ends, p))
                };
                merit.sample.iter().map(at).sum::<f64>() / merit.sample.len() as f64
            }
            _ => {
                let mut least = f64::INFINITY;
                merit.pieces_fixed(o, terms, &self.ends, &mut |p| {
                    if let MeritPiece::Linear(value, _) = p {
                        least = least.min(value);
                    }
                });
                least
            }
        }
    }
}
