//! Linear models of the problem near a point.

use nalgebra::{Rotation3, Vector3};

use super::leg_lines::{HeldPose, LegLines};
use super::merit::{Cluster, MeritPiece};
use super::model::{ConstraintGroup, Model, Task};
use super::pull::{Gradient, Pull, Rate};
use super::shape::JointEnds;
use super::skeleton::Room;
use super::terms::{ConvexForm, Item, TermId};
use machine::requirements::Objective;
use machine::requirements::TermKind;
use platform::manipulator::Body;

/// Stands for the pose of what has none.
const NO_POSE: usize = usize::MAX;

/// A constraint near a point.
#[derive(Debug, Clone)]
pub(crate) struct LinearItem {
    pub group: ConstraintGroup,
    /// Pose and requirement.
    pub id: (usize, TermId),
    pub value: f64,
    pub gradient: Vec<f64>,
    /// Head and tail of a second-order cone, divided by the size.
    pub cone: Option<AffineCone>,
}

/// `head >= |tail|`, affine in the step.
#[derive(Debug, Clone)]
pub(crate) struct AffineCone {
    pub head: (f64, Vec<f64>),
    pub tail: [(f64, Vec<f64>); 3],
    /// Factor of the slack in the head.
    pub slack: f64,
}

/// A cluster of singular values with gradients instead of pulls.
#[derive(Debug, Clone)]
pub(crate) struct LinearCluster {
    pub sigma: f64,
    pub own: Vec<f64>,
    pub others: Vec<(f64, Vec<f64>, Vec<f64>)>,
}

/// A bound of an objective near a point.
#[derive(Debug, Clone)]
pub(crate) enum LinearBound {
    Plain,
    Spectral { f: f64, h: f64, low: LinearCluster, high: LinearCluster },
    Length(Option<AffineCone>),
}

/// A piece of an objective near a point.
#[derive(Debug, Clone)]
pub(crate) struct LinearPiece {
    pub objective: usize,
    /// Pose and number within the pose.
    pub id: (usize, usize),
    pub value: f64,
    pub gradient: Vec<f64>,
    pub bound: LinearBound,
}

fn affine(at: f64, gradient: &[f64], d: &[f64]) -> f64 {
    at + gradient.iter().zip(d).map(|(g, d)| g * d).sum::<f64>()
}

impl AffineCone {
    fn norm(&self, d: &[f64]) -> f64 {
        self.tail.iter().map(|(v, g)| affine(*v, g, d).powi(2)).sum::<f64>().sqrt()
    }
}

impl LinearItem {
    /// How far the model is from being violated after a step, with slack.
    pub(super) fn room(&self, d: &[f64], slack: f64, spare: f64) -> f64 {
        match &self.cone {
            Some(cone) => affine(cone.head.0, &cone.head.1, d) + cone.slack * slack - cone.norm(d),
            None => affine(self.value - spare + slack, &self.gradient, d),
        }
    }
}

impl LinearCluster {
    /// Change of the extreme singular value (`sign` 1: the least, -1: the greatest) after a step, pair by pair.
    fn change(&self, d: &[f64], sign: f64) -> f64 {
        let own = affine(0.0, &self.own, d);
        let pairs = self.others.iter().map(|(sigma, across, other)| {
            let (there, off) = (affine(sigma - self.sigma, other, d), affine(0.0, across, d));
            0.5 * (own + there - sign * (own - there).hypot(2.0 * off))
        });
        pairs.fold(own, |worst, v| if sign * v < sign * worst { v } else { worst })
    }
}

impl LinearPiece {
    /// What the piece allows the objective after a step.
    pub(super) fn upper(&self, d: &[f64]) -> f64 {
        match &self.bound {
            LinearBound::Spectral { f, h, low, high } => {
                self.value + f * low.change(d, 1.0) - h * high.change(d, -1.0)
            }
            _ => affine(self.value, &self.gradient, d),
        }
    }

    /// Lower and upper model of a length after a step.
    pub(super) fn lengths(&self, d: &[f64]) -> (f64, f64) {
        let plain = affine(self.value, &self.gradient, d);
        match &self.bound {
            LinearBound::Length(Some(cone)) => (plain, cone.norm(d)),
            _ => (plain, plain),
        }
    }
}

/// Everything the next step has to know.
#[derive(Debug, Clone, Default)]
pub(crate) struct Linearised {
    pub items: Vec<LinearItem>,
    pub pieces: Vec<LinearPiece>,
}

/// Legs at a held pose with the motions of the variables.
struct Near<'a> {
    l: LegLines,
    at: &'a HeldPose,
    rates: &'a [Rate],
    home: Rotation3<f64>,
}

impl Near<'_> {
    fn gradient(&self, pull: &Pull) -> Vec<f64> {
        pull.gradient(self.rates, &self.l.rotation, self.at.follows, &self.home)
    }
}

impl Model<'_> {
    /// Linear models at a point of what can matter within `radius`.
    pub(crate) fn linearise(
        &self,
        poses: &[HeldPose],
        x: &[f64],
        task: &Task,
        sign: f64,
        radius: f64,
    ) -> Option<Linearised> {
        let (ends, rates) = (self.shape.ends(x), self.shape.rates(x));
        let home = self.terms.home.rotation;
        let identity = Rotation3::identity();
        let mut out = Linearised::default();
        let near = 4.0 * radius + 0.01;
        for (k, at) in poses.iter().enumerate() {
            let n = Near { l: LegLines::new(&ends, at), at, rates: &rates, home };
            self.terms.visit(&n.l, &ends, x, &mut |item: Item<Pull>| {
                let group = ConstraintGroup::Term(item.id.0);
                let kind = item.id.0;
                let steep = matches!(kind, TermKind::LegForce | TermKind::LegSpeed) || kind.is_of_platform();
                if (steep || item.value < near) && !task.dropped.contains(&group) {
                    let gradient = n.gradient(&item.pull);
                    let cone = item.exact.filter(|_| self.affine).map(|e| self.cone(e, &n));
                    if let Some(item) = screened(k, &item, group, gradient, cone, radius) {
                        out.items.push(item);
                    }
                }
            });
            for (m, o) in self.wanted(task) {
                let mut number = 0;
                self.merit.pieces_at(o, &self.terms, &n.l, &mut |piece| {
                    out.pieces.push(self.piece(m, (k, number), piece, &n));
                    number += 1;
                });
            }
        }
        self.terms.fixed(&ends, &mut |item: Item<Pull>| {
            let group = ConstraintGroup::Term(item.id.0);
            if !task.dropped.contains(&group) {
                let gradient = item.pull.gradient(&rates, &identity, false, &home);
                out.items.extend(screened(NO_POSE, &item, group, gradient, None, radius));
            }
        });
        if let (Some((value, gradient)), false) =
            (self.determinant(x, sign), task.dropped.contains(&ConstraintGroup::Determinant))
        {
            let id = (NO_POSE, (TermKind::BaseSpacing, NO_POSE, NO_POSE, NO_POSE));
            out.items.push(LinearItem {
                group: ConstraintGroup::Determinant,
                id,
                value,
                gradient,
                cone: None,
            });
        }
        for Room { leg, body, value, gradient } in self.shape.rooms(&ends) {
            let mut pull = Pull::none();
            match body {
                Body::Base => pull.base[leg] = gradient,
                Body::Platform => pull.arm[leg] = gradient,
            }
            let id = (NO_POSE, (TermKind::PlatformSpacing, leg, NO_POSE, body.index()));
            let gradient = pull.gradient(&rates, &identity, false, &home);
            out.items.push(LinearItem { group: ConstraintGroup::Reach, id, value, gradient, cone: None });
        }
        for (m, o) in self.wanted(task) {
            let mut number = 0;
            if o == Objective::MeanConditioning {
                let (value, gradient) = self.mean(&ends, &rates)?;
                let bound = LinearBound::Plain;
                out.pieces.push(LinearPiece { objective: m, id: (NO_POSE, 0), value, gradient, bound });
            }
            self.merit.pieces_fixed(o, &self.terms, &ends, &mut |piece| {
                if let MeritPiece::Linear(value, pull) = piece {
                    let gradient = pull.gradient(&rates, &identity, false, &home);
                    let bound = LinearBound::Plain;
                    out.pieces.push(LinearPiece {
                        objective: m,
                        id: (NO_POSE, number),
                        value,
                        gradient,
                        bound,
                    });
                    number += 1;
                }
            });
        }
        let finite = |v: &Vec<f64>| v.iter().all(|x| x.is_finite());
        let good = out.items.iter().all(|i| i.value.is_finite() && finite(&i.gradient))
            && out.pieces.iter().all(|p| p.value.is_finite() && finite(&p.gradient));
        good.then_some(out)
    }

    fn mean(&self, ends: &JointEnds, rates: &[Rate]) -> Option<(f64, Vec<f64>)> {
        let count = self.merit.sample.len() as f64;
        let (mut value, mut gradient) = (0.0, vec![0.0; rates.len()]);
        for at in &self.merit.sample {
            let l = LegLines::new(ends, at);
            let (g, pull) = self.merit.conditioning(&l)?;
            value += g / count;
            let own = pull.gradient(rates, &l.rotation, at.follows, &self.terms.home.rotation);
            gradient.iter_mut().zip(own).for_each(|(s, x)| *s += x / count);
        }
        Some((value, gradient))
    }

    fn piece(&self, objective: usize, id: (usize, usize), piece: MeritPiece, n: &Near<'_>) -> LinearPiece {
        match piece {
            MeritPiece::Linear(value, pull) => {
                LinearPiece { objective, id, value, gradient: n.gradient(&pull), bound: LinearBound::Plain }
            }
            MeritPiece::Length(leg, value, pull) => {
                let exact = ConvexForm::Length { leg, greatest: 0.0 };
                let cone = self.affine.then(|| self.cone(exact, n));
                LinearPiece {
                    objective,
                    id,
                    value,
                    gradient: n.gradient(&pull),
                    bound: LinearBound::Length(cone),
                }
            }
            MeritPiece::Spectral(s) => {
                let cluster = |c: &Cluster| LinearCluster {
                    sigma: c.sigma,
                    own: n.gradient(&c.own),
                    others: c.others.iter().map(|(v, ko, oo)| (*v, n.gradient(ko), n.gradient(oo))).collect(),
                };
                let bound =
                    LinearBound::Spectral { f: s.f, h: s.h, low: cluster(&s.low), high: cluster(&s.high) };
                LinearPiece { objective, id, value: s.value, gradient: n.gradient(&s.pull()), bound }
            }
        }
    }

    /// The cone of a convex requirement, the line affine in the step.
    fn cone(&self, exact: ConvexForm, n: &Near<'_>) -> AffineCone {
        let (l, at, rates) = (&n.l, n.at, n.rates);
        let (ConvexForm::Length { leg, .. } | ConvexForm::Swing { leg, .. }) = exact;
        let velocity = |rate: &Rate| {
            let lift = if at.follows { rate.lift } else { Vector3::zeros() };
            let own = rate.ends.iter().filter(|e| e.0 == leg);
            own.fold(lift, |sum, (_, a, b)| sum + l.rotation * b - a) / self.terms.size
        };
        let velocities: Vec<Vector3<f64>> = rates.iter().map(velocity).collect();
        let line = l.line[leg] / self.terms.size;
        let along = |c: Vector3<f64>| velocities.iter().map(|v| v.dot(&c)).collect::<Vec<f64>>();
        let tail = [0, 1, 2].map(|k| (line[k], velocities.iter().map(|v| v[k]).collect()));
        match exact {
            ConvexForm::Length { greatest, .. } => {
                let head = (greatest / self.terms.size - self.backoff, vec![0.0; rates.len()]);
                AffineCone { head, tail, slack: 1.0 }
            }
            ConvexForm::Swing { axis, cos, .. } => {
                let head = ((line.dot(&axis) - self.backoff) / cos, along(axis / cos));
                AffineCone { head, tail, slack: 1.0 / cos }
            }
        }
    }
}

/// The constraint, unless its linear model is met everywhere within the radius.
fn screened(
    pose: usize,
    item: &Item<Pull>,
    group: ConstraintGroup,
    gradient: Vec<f64>,
    cone: Option<AffineCone>,
    radius: f64,
) -> Option<LinearItem> {
    let reach: f64 = match &cone {
        // the norm grows at most as fast as the line moves
        Some(c) => {
            let tails = c.tail.iter().map(|t| t.1.iter().map(|v| v.abs()).sum::<f64>());
            tails.sum::<f64>() + c.head.1.iter().map(|v| v.abs()).sum::<f64>()
        }
        None => gradient.iter().map(|g| g.abs()).sum(),
    };
    let kept = !(item.value > reach * radius + 1e-4);
    kept.then_some(LinearItem { group, id: (pose, item.id), value: item.value, gradient, cone })
}
