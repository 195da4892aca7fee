//! Gaps between the bodies of legs, and between a leg and a shape, with gradients.

use nalgebra::Vector3;

use super::leg_lines::LegLines;
use super::pull::Gradient;
use machine::requirements::{KeepOutShape, LegBody, LegSegment};
use platform::geom::LinePair;
use platform::manipulator::Body;

/// A gap with its gradient; `part` distinguishes the gaps of a pair of legs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap<P> {
    pub value: f64,
    pub pull: P,
    pub part: usize,
}

impl LegLines {
    pub(super) fn at(&self, leg: usize, share: f64) -> Vector3<f64> {
        self.base[leg] + self.line[leg] * share
    }

    /// Adds the gradient of `g . (a + s d)`, where `s` is constant, or `s |d|` is.
    pub(super) fn pull_point<P: Gradient>(
        &self,
        pull: &mut P,
        leg: usize,
        (share, sliding): (f64, bool),
        g: &Vector3<f64>,
    ) {
        if !P::KEPT {
            return;
        }
        pull.at_base(leg, g);
        let u = &self.direction[leg];
        let along = if sliding { g - u * u.dot(g) } else { *g };
        pull.line(leg, along * share);
    }

    /// Gaps between the parts of two legs.
    pub(crate) fn leg_gaps<P: Gradient>(
        &self,
        body: &LegBody,
        i: usize,
        j: usize,
        see: &mut impl FnMut(Gap<P>),
    ) {
        let second = body.parts(self.length[j]);
        let (e, f) = (&self.line[i], &self.line[j]);
        let pair = LinePair::new(self.base[i] - self.base[j], e, f);
        for (k, p) in body.parts(self.length[i]).enumerate() {
            for (l, q) in second.clone().enumerate() {
                let (s, t) = pair.closest((p.from, p.to), (q.from, q.to));
                let apart = pair.apart + e * s - f * t;
                let distance = apart.norm();
                // segments that meet are pushed apart along their common normal
                let n = if distance > 0.0 {
                    apart / distance
                } else {
                    e.cross(f).try_normalize(0.0).unwrap_or_else(Vector3::z)
                };
                let mut pull = P::none();
                let at_joint = |part: &LegSegment, s: f64| part.joint.is_some_and(|j| (s - j).abs() < 1e-12);
                self.pull_point(&mut pull, i, (s, at_joint(&p, s)), &n);
                self.pull_point(&mut pull, j, (t, at_joint(&q, t)), &-n);
                see(Gap { value: distance - p.radius - q.radius, pull, part: 2 * k + l });
            }
        }
    }

    /// Gaps between the parts of a leg and a shape; negative inside, also in boxes.
    pub(super) fn keep_out_gaps<P: Gradient>(
        &self,
        body: &LegBody,
        i: usize,
        (shape, fixed_to): (&KeepOutShape, Body),
        see: &mut impl FnMut(Gap<P>),
    ) {
        let moving = fixed_to == Body::Platform;
        let local = |v: Vector3<f64>| if moving { self.rotation.inverse() * (v - self.position) } else { v };
        for (part, p) in body.parts(self.length[i]).enumerate() {
            let [a, b] = [p.from, p.to].map(|s| local(self.at(i, s)).into());
            let near = shape.nearest(&a, &b);
            let s = p.from + near.share * (p.to - p.from);
            let sliding = p.joint.is_some_and(|j| (s - j).abs() < 1e-12);
            let mut pull = P::none();
            let n = if moving { self.rotation * near.away } else { near.away };
            self.pull_point(&mut pull, i, (s, sliding), &n);
            if moving {
                pull.at_position(&-n);
            }
            see(Gap { value: near.distance - p.radius, pull, part });
        }
    }
}
