//! Gaps between the bodies of legs, and between a leg and a keep-out, with gradients.

use nalgebra::Vector3;

use super::leg_lines::LegLines;
use super::pull::Gradient;
use machine::requirements;
use machine::requirements::{KeepOut, LegBody, LegSegment};
use platform::geom::LinePair;
use platform::manipulator::Body;

/// A gap with its gradient; `part` tells apart the gaps of a pair of legs.
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

    /// Gaps between the parts of a leg and a keep-out; negative inside, also in boxes.
    pub(super) fn keep_out_gaps<P: Gradient>(
        &self,
        body: &LegBody,
        i: usize,
        keep_out: &KeepOut,
        see: &mut impl FnMut(Gap<P>),
    ) {
        let moving = keep_out.fixed_to == Body::Platform;
        let local = |v: Vector3<f64>| if moving { self.rotation.inverse() * (v - self.position) } else { v };
        for (part, p) in body.parts(self.length[i]).enumerate() {
            let (a, b) = (local(self.at(i, p.from)), local(self.at(i, p.to)));
            let (x, value, normal) = nearest(&keep_out.shape, &a, &(b - a));
            let s = p.from + x * (p.to - p.from);
            let sliding = p.joint.is_some_and(|j| (s - j).abs() < 1e-12);
            let mut pull = P::none();
            let n = if moving { self.rotation * normal } else { normal };
            self.pull_point(&mut pull, i, (s, sliding), &n);
            if moving {
                pull.at_position(&-n);
            }
            see(Gap { value: value - p.radius, pull, part });
        }
    }
}

/// Share of the segment `a + x e` closest to a shape, signed distance there, and the direction away from it.
fn nearest(
    shape: &requirements::KeepOutShape,
    a: &Vector3<f64>,
    e: &Vector3<f64>,
) -> (f64, f64, Vector3<f64>) {
    let round = |from: Vector3<f64>, f: Vector3<f64>, radius: f64| {
        let (x, y) = LinePair::new(a - from, e, &f).closest((0.0, 1.0), (0.0, 1.0));
        let apart = a + e * x - from - f * y;
        (x, apart.norm() - radius, apart.try_normalize(0.0).unwrap_or_else(Vector3::z))
    };
    match shape {
        requirements::KeepOutShape::Sphere { center, diameter } => {
            round(center.coords, Vector3::zeros(), diameter / 2.0)
        }
        requirements::KeepOutShape::Capsule { from, to, diameter } => {
            round(from.coords, to - from, diameter / 2.0)
        }
        requirements::KeepOutShape::Box { center, size } => {
            nearest_box(&(a - center.coords), e, &(size / 2.0))
        }
    }
}

/// As [`nearest`] for a box around the origin: the distance is convex along the segment, and so is the depth inside.
fn nearest_box(a: &Vector3<f64>, e: &Vector3<f64>, half: &Vector3<f64>) -> (f64, f64, Vector3<f64>) {
    let outside = |x: f64| {
        let q = a + e * x;
        Vector3::from_fn(|k, _| q[k] - q[k].clamp(-half[k], half[k]))
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let x = f64::midpoint(low, high);
        if outside(x).dot(e) > 0.0 { high = x } else { low = x }
    }
    let x = f64::midpoint(low, high);
    let o = outside(x);
    if o.norm() > 1e-12 * half.norm() {
        return (x, o.norm(), o.normalize());
    }
    let depth = |x: f64| {
        let q = a + e * x;
        let k =
            (0..3).max_by(|&i, &j| (q[i].abs() - half[i]).total_cmp(&(q[j].abs() - half[j]))).unwrap_or(0);
        (q[k].abs() - half[k], Vector3::ith(k, q[k].signum()))
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..80 {
        let (x, y) = (low + (high - low) * 0.4, low + (high - low) * 0.6);
        if depth(x).0 < depth(y).0 { high = y } else { low = x }
    }
    let x = f64::midpoint(low, high);
    // the least depth is where two faces are as far, one before and one behind: their mean that does not change along
    // the segment
    let (before, behind) = (depth((x - 1e-7).max(0.0)).1, depth((x + 1e-7).min(1.0)).1);
    let (falls, rises) = (before.dot(e), behind.dot(e));
    let normal = if falls < 0.0 && rises > 0.0 {
        before * (rises / (rises - falls)) - behind * (falls / (rises - falls))
    } else {
        depth(x).1
    };
    (x, depth(x).0, normal)
}
