//! Lower bounds of the distance of legs from each other and from bodies.
//!
//! For every unit vector `u`, the distance of two convex hulls is at least `min u . (x - y)` over their points `x` and
//! `y`. The best `u` depends on the pose. If two segments are nearest inside both, it is normal to both. For an end and
//! the inside of a segment it is perpendicular to that segment; for two ends it joins them. As functions of the pose
//! these directions make the bound exact to second order; a constant one serves where they are not defined.
//!
//! A direction is a vector `n` with polynomial coordinates. It stays unnormalised, since the second derivatives of its
//! length have poor enclosures ([`along_direction`]).

use nalgebra::{Matrix3, Point3, Vector3};

use super::frame::{CellFrame, enclosed};
use super::local::{self, Bounded};
use crate::requirements::hardware::LegBody;
use crate::requirements::keep_out::{KeepOut, KeepOutShape};
use crate::requirements::plate::PlateSolid;
use num::interval::Interval;
use num::jet::{JetVector, cross, dot, norm_squared};
use platform::geom::enclosed::IntervalVector;
use platform::geom::{Chart, ChartCell};
use platform::manipulator::{Body, Manipulator};

/// The convex hull of some points, and a radius around it.
#[derive(Clone)]
pub(super) struct Hull {
    points: Vec<JetVector>,
    radius: Interval,
    /// For a part of a leg: base joint and line of the leg that contains the part.
    axis: Option<(JetVector, JetVector)>,
}

impl Hull {
    /// A point of the line through its first two points, and a vector along it.
    fn line(&self) -> (JetVector, JetVector) {
        self.axis.unwrap_or_else(|| (self.points[0], less(&self.points[1], &self.points[0])))
    }
}

fn halved(x: f64) -> Interval {
    Interval::from(x) * Interval::from(0.5)
}

/// Cylinder and rod of a leg over a frame.
///
/// If the leg may be shorter than the cylinder, or its length is not enclosed, it is one part with the larger radius.
pub(super) fn leg_parts(frame: &CellFrame<'_>, m: &Manipulator, i: usize, body: &LegBody) -> Vec<Hull> {
    let leg = frame.leg(m, i);
    let end: JetVector = std::array::from_fn(|k| leg.base[k] + leg.line[k]);
    let part = |from: JetVector, to: JetVector, diameter: f64| Hull {
        points: vec![from, to],
        radius: halved(diameter),
        axis: Some((leg.base, leg.line)),
    };
    let whole = |diameter: f64| vec![part(leg.base, end, diameter)];
    let Some((cylinder, rod)) = body.rod else { return whole(body.diameter) };
    let square = Interval::from(cylinder).square();
    if leg.square.value.hi() <= square.lo() {
        return whole(body.diameter);
    }
    match leg.square.inverse_root() {
        Some(inverse) if leg.square.value.lo() > square.hi() => {
            let share = inverse.times(Interval::from(cylinder));
            let top: JetVector = std::array::from_fn(|k| leg.base[k] + leg.line[k] * share);
            vec![part(leg.base, top, body.diameter), part(top, end, rod)]
        }
        _ => whole(body.diameter.max(rod)),
    }
}

/// The parts of a leg without the points nearer than `cut` to the joint at an end, and whether the cut is exact. A leg
/// or part that may be shorter than the cut stays whole, which encloses it.
pub(super) fn without_end(
    frame: &CellFrame<'_>,
    m: &Manipulator,
    i: usize,
    body: &LegBody,
    mut parts: Vec<Hull>,
    (end, cut): (Body, f64),
) -> (Vec<Hull>, bool) {
    if cut == 0.0 {
        return (parts, true);
    }
    let leg = frame.leg(m, i);
    // the part at the end is longer than the cut: the cylinder always, rod and whole leg according to the leg length
    let (cylinder, two) = (body.rod.map_or(0.0, |r| r.0), parts.len() == 2);
    let longer = match (end, two) {
        (Body::Base, true) => cylinder > cut,
        (Body::Base, false) => leg.square.value.lo() > Interval::from(cut).square().hi(),
        (Body::Platform, _) => {
            let least = Interval::from(cut) + Interval::from(if two { cylinder } else { 0.0 });
            leg.square.value.lo() > least.square().hi()
        }
    };
    let Some(inverse) = leg.square.inverse_root().filter(|_| longer) else { return (parts, false) };
    let share = inverse.times(Interval::from(cut));
    match end {
        Body::Base => {
            if let Some(first) = parts.first_mut() {
                first.points[0] = std::array::from_fn(|k| leg.base[k] + leg.line[k] * share);
            }
        }
        Body::Platform => {
            if let Some(last) = parts.last_mut() {
                last.points[1] = std::array::from_fn(|k| leg.base[k] + leg.line[k] - leg.line[k] * share);
            }
        }
    }
    (parts, true)
}

/// Rounding of a point of a plate computed in doubles, as a share of the lengths it is computed from.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// Bounds of the gap between a part of a leg and a plate: a lower one over a cell, an upper one at the point `z`.
///
/// The lower bound is `min u . x - h(u)` over the ends `x` of the part. `u` is the direction from the nearest point of
/// the plate at `z`, and rotates with the plate. The support function `h` is `max c . u + m |u_across| + max(w u_n)`
/// over the corners `c` of its hull and its faces `w`, with the margin `m`. It is at least minus the radius of the
/// part.
pub(super) fn plate_gap(
    chart: &Chart,
    cell: &ChartCell,
    z: &[f64; 6],
    frames: (&CellFrame<'_>, &CellFrame<'_>),
    (at, over): (&Hull, &Hull),
    (plate, body): (&PlateSolid, Body),
) -> (Bounded, f64) {
    let ends = [0, 1].map(|k: usize| Point3::from(middle(&at.points[k])));
    let (turn, origin) = pose_of(frames.0, body);
    let local = ends.map(|p| Point3::from(turn.transpose() * (p - origin)));
    let (share, near) = plate.nearest_to_segment([&local[0], &local[1]]);
    // the pose at z and the point of the plate are known up to rounding
    let place = |frame: &CellFrame<'_>, p: &Point3<f64>| match body {
        Body::Base => frame.fixed(&enclosed(p)),
        Body::Platform => frame.moved(p),
    };
    let weights = (vec![1.0 - share, share], vec![1.0]);
    let there = [place(frames.0, &near)];
    let slack = ROUNDED * (plate.extent() + near.coords.norm());
    let apart = distance_between((&at.points, &weights.0), (&there, &weights.1));
    let upper = (apart + Interval::from(slack) - at.radius).hi();
    let bare = Bounded { below: (-over.radius).lo(), ..Bounded::nothing(cell) };
    let away = local[0] + (local[1] - local[0]) * share - near;
    let u: IntervalVector = std::array::from_fn(|k| Interval::from(away[k]));
    let norm = (u[0].square() + u[1].square() + u[2].square()).sqrt().unwrap_or(Interval::WHOLE);
    if !(norm.lo() > 0.0) {
        return (bare, upper);
    }
    let support = support(plate, &u);
    let along = |frame: &CellFrame<'_>, x: &JetVector| match body {
        Body::Base => dot(&frame.fixed(&u), x),
        Body::Platform => frame.along(&u, x),
    };
    let bound = |k: usize| {
        local::below(chart, cell, z, &along(frames.0, &at.points[k]), &along(frames.1, &over.points[k]))
    };
    let mut least = bound(0).min(bound(1));
    let gap = (Interval::from(least.below) - support).checked_div(norm);
    least.below = gap.map_or(f64::NEG_INFINITY, |gap| (gap - over.radius - Interval::from(slack)).lo());
    if !(least.below >= bare.below) {
        least.below = bare.below;
    }
    (least, upper)
}

/// Rotation and position of the frame of a body at a point, in doubles.
fn pose_of(frame: &CellFrame<'_>, body: Body) -> (Matrix3<f64>, Point3<f64>) {
    if body == Body::Base {
        return (Matrix3::identity(), Point3::origin());
    }
    let column = |k: usize| {
        let unit: IntervalVector =
            std::array::from_fn(|r| if r == k { Interval::from(1.0) } else { Interval::ZERO });
        middle(&frame.turned(&unit))
    };
    (Matrix3::from_columns(&[column(0), column(1), column(2)]), Point3::from(middle(&frame.origin())))
}

/// The greatest `u . x` over the points of a plate, enclosed.
fn support(plate: &PlateSolid, u: &IntervalVector) -> Interval {
    let own: IntervalVector = std::array::from_fn(|k| {
        (0..3).fold(Interval::ZERO, |s, r| s + Interval::from(plate.axes[(r, k)]) * u[r])
    });
    let greatest = |all: &mut dyn Iterator<Item = Interval>| {
        let ends =
            all.fold((f64::NEG_INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.max(x.lo()), hi.max(x.hi())));
        Interval::new(ends.0, ends.1).unwrap_or(Interval::WHOLE)
    };
    let hull = &plate.outline.hull;
    let corner =
        greatest(&mut hull.iter().map(|c| own[0] * Interval::from(c.x) + own[1] * Interval::from(c.y)));
    let across = (own[0].square() + own[1].square()).sqrt().unwrap_or(Interval::WHOLE);
    let lower = Interval::from(plate.lower());
    let faces = greatest(&mut [lower, lower + Interval::from(plate.thickness)].iter().map(|w| own[2] * *w));
    corner + across * Interval::from(plate.outline.margin) + faces
}

/// A keep-out over a frame.
pub(super) fn body_part(frame: &CellFrame<'_>, body: &KeepOut) -> Hull {
    shape_part(frame, &body.shape, body.fixed_to)
}

/// A shape that moves with a body over a frame.
pub(super) fn shape_part(frame: &CellFrame<'_>, shape: &KeepOutShape, fixed_to: Body) -> Hull {
    let (points, diameter) = match shape {
        KeepOutShape::Sphere { center, diameter } => (vec![*center], *diameter),
        KeepOutShape::Capsule { from, to, diameter } => (vec![*from, *to], *diameter),
        KeepOutShape::Box { center, size } => {
            let corner = |c: usize| {
                let sign = |k: usize| if c >> k & 1 == 0 { -0.5 } else { 0.5 };
                // half an edge beyond the centre, rounded away below
                center + Vector3::from_fn(|k, _| sign(k) * size[k])
            };
            ((0..8).map(corner).collect(), 0.0)
        }
    };
    let place = |p: &Point3<f64>| match fixed_to {
        Body::Base => frame.fixed(&enclosed(p)),
        Body::Platform => frame.moved(p),
    };
    // corners of boxes are rounded by less than this
    let rounding = match shape {
        KeepOutShape::Box { center, size } => 4.0 * f64::EPSILON * (center.coords.amax() + size.amax()),
        _ => 0.0,
    };
    let radius = halved(diameter) + Interval::from(rounding);
    Hull { points: points.iter().map(place).collect(), radius, axis: None }
}

fn middle(v: &JetVector) -> Vector3<f64> {
    Vector3::from_fn(|k, _| v[k].value.centre_and_radius().0)
}

/// Weights of the nearest points of two hulls, found by alternating steps, in doubles.
fn nearest(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> (Vec<f64>, Vec<f64>) {
    let unit = |n: usize| -> Vec<f64> { (0..n).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect() };
    let (mut x, mut y) = (unit(a.len()), unit(b.len()));
    let at = |w: &[f64], p: &[Vector3<f64>]| p.iter().zip(w).fold(Vector3::zeros(), |s, (p, w)| s + p * *w);
    for _ in 0..60 {
        for side in 0..2 {
            let (points, mut weights, other) =
                if side == 0 { (a, x.clone(), at(&y, b)) } else { (b, y.clone(), at(&x, a)) };
            // an exact line search along every pair of points moves weight from one to the other
            for i in 0..points.len() {
                for j in 0..points.len() {
                    if i == j || weights[i] == 0.0 {
                        continue;
                    }
                    let here = at(&weights, points) - other;
                    let step = points[j] - points[i];
                    let square = step.norm_squared();
                    if square > 0.0 {
                        let t = (-here.dot(&step) / square).clamp(0.0, weights[i]);
                        weights[i] -= t;
                        weights[j] += t;
                    }
                }
            }
            if side == 0 {
                x = weights;
            } else {
                y = weights;
            }
        }
    }
    (x, y)
}

/// The position of a nearest point on a segment.
#[derive(Clone, Copy, PartialEq)]
enum On {
    End(usize),
    Inside,
}

fn on(weights: &[f64]) -> On {
    weights.iter().position(|w| *w > 1.0 - 1e-9).map_or(On::Inside, On::End)
}

fn less(a: &JetVector, b: &JetVector) -> JetVector {
    std::array::from_fn(|k| a[k] - b[k])
}

/// A direction for two segments up to sign and length, and the differences of points whose least part along it bounds
/// the gap from below.
fn direction(a: &Hull, b: &Hull, on: (On, On)) -> (JetVector, Vec<JetVector>) {
    // v minus its part along f, times f . f
    let across = |v: JetVector, f: JetVector| -> JetVector {
        let (square, along) = (norm_squared(&f), dot(&v, &f));
        std::array::from_fn(|k| v[k] * square - f[k] * along)
    };
    match on {
        (On::Inside, On::Inside) => {
            let ((p, f), (q, g)) = (a.line(), b.line());
            (cross(&f, &g), vec![less(&p, &q)])
        }
        (On::End(i), On::Inside) => {
            let (q, g) = b.line();
            (across(less(&a.points[i], &q), g), a.points.iter().map(|x| less(x, &q)).collect())
        }
        (On::Inside, On::End(j)) => {
            let (p, f) = a.line();
            (across(less(&p, &b.points[j]), f), b.points.iter().map(|y| less(&p, y)).collect())
        }
        (On::End(i), On::End(j)) => {
            let every = a.points.iter().flat_map(|x| b.points.iter().map(move |y| less(x, y)));
            (less(&a.points[i], &b.points[j]), every.collect())
        }
    }
}

/// A lower bound of `n . d / |n|` over a cell, from `n` and `d` at its point `z` and over it. `None` where `n` may
/// become perpendicular to its value at `z`.
///
/// With `e` the direction of `n` at `z`, `r` the value there, `c > 0` a lower bound of `n . e` over the cell, and
/// `m = n - e (n . e)`,
///
/// ```text
/// |n| <= n . e + |m|^2 / (2 n . e) <= n . e + |m|^2 / (2 c),
/// n . d / |n| = r + (n . d - r |n|) / |n| >= r + min(K, 0) / c,   K = n . (d - r e) - |m|^2 r / (2 c),
/// ```
///
/// where the last term of `K` is left out for a negative `r`, since then `-r |n| >= -r n . e`. `K` vanishes at `z` and
/// is polynomial if `n` and `d` are. Its second derivatives have tighter enclosures than those of the quotient, in
/// which large parts cancel.
fn along_direction(
    chart: &Chart,
    cell: &ChartCell,
    z: &[f64; 6],
    at: (&JetVector, &JetVector),
    over: (&JetVector, &JetVector),
) -> Option<Bounded> {
    let (towards, length) = (middle(at.0), middle(at.0).norm());
    let r = towards.dot(&middle(at.1)) / length;
    if !(length > 0.0 && r.is_finite()) {
        return None;
    }
    let one = Interval::from(1.0);
    let e: IntervalVector = std::array::from_fn(|k| Interval::from(towards[k]));
    let square = e[0].square() + e[1].square() + e[2].square();
    let (by_length, by_square) = (one.checked_div(square.sqrt()?)?, one.checked_div(square)?);
    // n . e with e as long as it is
    let along = |n: &JetVector| n[0].times(e[0]) + n[1].times(e[1]) + n[2].times(e[2]);
    let least = (along(over.0).value * by_length).lo();
    if !(least > 0.0) {
        return None;
    }
    let share = Interval::from(r.max(0.0)).checked_div(Interval::from(2.0) * Interval::from(least))?;
    let surplus = |(n, d): (&JetVector, &JetVector)| {
        let left: JetVector =
            std::array::from_fn(|k| d[k] - d[k].alike(Interval::from(r) * e[k] * by_length));
        let part = along(n).times(by_square);
        let across: JetVector = std::array::from_fn(|k| n[k] - part.times(e[k]));
        dot(n, &left) - norm_squared(&across).times(share)
    };
    let bounded = local::below(chart, cell, z, &surplus(at), &surplus(over));
    if !bounded.below.is_finite() {
        return None;
    }
    let lost = Interval::from(bounded.below.min(0.0)).checked_div(Interval::from(least))?;
    Some(Bounded { below: (Interval::from(r) + lost).lo(), ..bounded })
}

/// The positions of the nearest points, with lines in place of segments where that is better (`second`: the second body
/// is a segment).
///
/// The line through a segment is no farther than the segment. If a nearest point reaches an end of its segment within
/// the cell, the direction of the end rotates with the pose. That rotation is multiplied by the whole segment length,
/// so the bound is exact to first order only. The direction of the line is exact to second order: the line is nearer
/// than its segment by the square of the overshoot.
fn lines_instead((a, b): (On, On), second: bool) -> Vec<(On, On)> {
    let mut out = vec![(a, b)];
    let mut also = |kind: (On, On)| {
        if !out.contains(&kind) {
            out.push(kind);
        }
    };
    also((On::Inside, b));
    if second {
        also((a, On::Inside));
        also((On::Inside, On::Inside));
    }
    out
}

/// A lower bound of the gap of two hulls over a cell, and an upper bound of the gap at the point `z`.
pub(super) fn gap(
    chart: &Chart,
    cell: &ChartCell,
    z: &[f64; 6],
    at: (&Hull, &Hull),
    over: (&Hull, &Hull),
) -> (Bounded, f64) {
    // the parts of a point may be thinner than those that contain the leg at all poses of the cell
    let (radii, radii_over) = (at.0.radius + at.1.radius, over.0.radius + over.1.radius);
    let plain = [at.0, at.1].map(|h| h.points.iter().map(middle).collect::<Vec<_>>());
    let weights = nearest(&plain[0], &plain[1]);
    let joined = |points: &[Vector3<f64>], w: &[f64]| {
        points.iter().zip(w).fold(Vector3::zeros(), |s, (p, w)| s + p * *w)
    };
    let apart = joined(&plain[0], &weights.0) - joined(&plain[1], &weights.1);
    let upper = (distance_between((&at.0.points, &weights.0), (&at.1.points, &weights.1)) - radii).hi();
    let least = |bound: &dyn Fn((usize, usize)) -> Option<Bounded>, pairs: &[(usize, usize)]| {
        let all = pairs.iter().map(|p| bound(*p).unwrap_or_else(|| Bounded::nothing(cell)));
        all.reduce(Bounded::min).unwrap_or_else(|| Bounded::nothing(cell))
    };
    let (ours, theirs) = (&over.0.points, &over.1.points);
    let every: Vec<(usize, usize)> =
        (0..ours.len()).flat_map(|i| (0..theirs.len()).map(move |j| (i, j))).collect();
    // a constant direction
    let length = apart.norm();
    let mut best = Bounded::nothing(cell);
    if length > 0.0 {
        let u: [Interval; 3] = std::array::from_fn(|k| Interval::from(apart[k]));
        let norm = (u[0].square() + u[1].square() + u[2].square()).sqrt().unwrap_or(Interval::WHOLE);
        let along = |a: &JetVector, b: &JetVector| {
            let d = less(a, b);
            let sum = d[0].times(u[0]) + d[1].times(u[1]) + d[2].times(u[2]);
            Interval::from(1.0).checked_div(norm).map(|over| sum.times(over))
        };
        let bound = |(i, j): (usize, usize)| {
            let here = along(&at.0.points[i], &at.1.points[j])?;
            Some(local::below(chart, cell, z, &here, &along(&ours[i], &theirs[j])?))
        };
        best = best.max(least(&bound, &every));
    }
    if ours.len() == 2 && theirs.len() <= 2 {
        let nearest_on = (on(&weights.0), if theirs.len() == 1 { On::End(0) } else { on(&weights.1) });
        for kind in lines_instead(nearest_on, theirs.len() == 2) {
            let (mut n_at, d_at) = direction(at.0, at.1, kind);
            let (mut n_over, d_over) = direction(over.0, over.1, kind);
            if middle(&n_at).dot(&apart) < 0.0 {
                (n_at, n_over) = (n_at.map(|x| -x), n_over.map(|x| -x));
            }
            // no lower bound may exceed the least value at z
            let towards = middle(&n_at);
            let there = d_at.iter().map(|d| towards.dot(&middle(d)) / towards.norm());
            if there.fold(f64::INFINITY, f64::min) <= best.below {
                continue;
            }
            let each = d_at.iter().zip(&d_over).map(|(d_at, d_over)| {
                along_direction(chart, cell, z, (&n_at, d_at), (&n_over, d_over))
                    .unwrap_or_else(|| Bounded::nothing(cell))
            });
            best = best.max(each.reduce(Bounded::min).unwrap_or_else(|| Bounded::nothing(cell)));
        }
    }
    best.below = (Interval::from(best.below) - radii_over).lo();
    if best.below.is_nan() {
        best.below = f64::NEG_INFINITY;
    }
    (best, upper)
}

/// The distance of two points of the hulls. It is an upper bound of the distance of the hulls for any weights of sum
/// one.
fn distance_between(a: (&[JetVector], &[f64]), b: (&[JetVector], &[f64])) -> Interval {
    // weights that sum to one exactly: the last one is the remainder
    let at = |points: &[JetVector], weights: &[f64]| -> [Interval; 3] {
        let first: Vec<Interval> = weights[1..].iter().map(|w| Interval::from(w.clamp(0.0, 1.0))).collect();
        let rest = first.iter().fold(Interval::from(1.0), |s, w| s - *w);
        let rest = Interval::new(rest.lo().max(0.0), rest.hi().max(0.0)).unwrap_or(Interval::WHOLE);
        std::array::from_fn(|k| {
            let start = rest * points[0][k].value;
            points[1..].iter().zip(&first).fold(start, |s, (p, w)| s + *w * p[k].value)
        })
    };
    let (x, y) = (at(a.0, a.1), at(b.0, b.1));
    let square = (0..3).fold(Interval::ZERO, |s, k| s + (x[k] - y[k]).square());
    square.sqrt().unwrap_or(Interval::WHOLE)
}
