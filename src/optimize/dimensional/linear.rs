//! Linear models of the problem near a point.

use nalgebra::{Rotation3, Vector3};

use super::leg_lines::{HeldPose, LegLines};
use super::merit::{Cluster, MeritPiece};
use super::model::Model;
use super::pull::{Gradient, PoseGradient, Rate};
use super::shape::JointEnds;
use super::skeleton::ReachLeft;
use super::terms::{ConvexForm, PoseTerm};
use crate::climb::{
    AffineCone, ConstraintGroup, LinearBound, LinearCluster, LinearItem, LinearPiece, Linearised, NO_POSE,
    Task,
};
use machine::requirements::Objective;
use machine::requirements::TermKind;
use platform::manipulator::Body;

/// Legs at a held pose, with their velocities by the variables.
struct Near<'a> {
    l: LegLines,
    at: &'a HeldPose,
    rates: &'a [Rate],
    home: Rotation3<f64>,
}

impl Near<'_> {
    fn gradient(&self, pull: &PoseGradient) -> Vec<f64> {
        pull.gradient(self.rates, &self.l.rotation, self.at.follows, &self.home)
    }
}

impl Model<'_> {
    /// Linear models at a point of everything relevant within `radius`.
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
            self.terms.visit(&n.l, &ends, x, &mut |item: PoseTerm<PoseGradient>| {
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
        self.terms.fixed(&ends, &mut |item: PoseTerm<PoseGradient>| {
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
        for ReachLeft { leg, body, value, gradient } in self.shape.rooms(&ends) {
            let mut pull = PoseGradient::none();
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
        let (ConvexForm::Length { leg, .. } | ConvexForm::ConeAngle { leg, .. }) = exact;
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
            ConvexForm::ConeAngle { axis, cos, .. } => {
                let head = ((line.dot(&axis) - self.backoff) / cos, along(axis / cos));
                AffineCone { head, tail, slack: 1.0 / cos }
            }
        }
    }
}

/// The constraint, unless its linear model is met everywhere within the radius.
fn screened(
    pose: usize,
    item: &PoseTerm<PoseGradient>,
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
