//! Lower bounds of the distance of legs from each other and from bodies.
//!
//! The distance of two convex hulls of points is at least `min u . (x - y)` over the points `x` of one and `y` of the other, for every unit vector `u`. Which `u` is good depends on the
//! pose: for two segments that are nearest inside both it is normal to both, for an end and the inside of a segment it leaves that segment at a right angle, for two ends it
//! joins them. As functions of the pose these directions make the bound exact to second order; a constant one serves where they are not defined.

use nalgebra::{Matrix3, Point3, Vector3};

use super::frame::{CellFrame, enclosed};
use super::local::{self, Bounded};
use crate::geom::enclosed::IntervalVector;
use crate::geom::{Chart, ChartCell};
use crate::manipulator::{Body, Manipulator};
use crate::num::interval::Interval;
use crate::num::jet::{JetVector, cross, dot, norm_squared};
use crate::requirements::hardware::LegBody;
use crate::requirements::keep_out::{KeepOut, KeepOutShape};
use crate::requirements::plate::PlateSolid;

/// The convex hull of some points, and a radius around it.
#[derive(Clone)]
pub(super) struct Hull {
    points: Vec<JetVector>,
    radius: Interval,
}

fn halved(x: f64) -> Interval {
    Interval::from(x) * Interval::from(0.5)
}

/// Cylinder and rod of a leg over a frame.
///
/// Where the leg may be shorter or longer than the cylinder, or has no sure length, it is one part with the larger radius, which holds both.
pub(super) fn leg_parts(frame: &CellFrame<'_>, m: &Manipulator, i: usize, body: &LegBody) -> Vec<Hull> {
    let leg = frame.leg(m, i);
    let end: JetVector = std::array::from_fn(|k| leg.base[k] + leg.line[k]);
    let whole = |radius: f64| vec![Hull { points: vec![leg.base, end], radius: halved(radius) }];
    let Some((cylinder, rod)) = body.rod else { return whole(body.diameter) };
    let square = Interval::from(cylinder).square();
    if leg.square.value.hi() <= square.lo() {
        return whole(body.diameter);
    }
    match leg.square.inverse_root() {
        Some(inverse) if leg.square.value.lo() > square.hi() => {
            let share = inverse.times(Interval::from(cylinder));
            let top: JetVector = std::array::from_fn(|k| leg.base[k] + leg.line[k] * share);
            vec![
                Hull { points: vec![leg.base, top], radius: halved(body.diameter) },
                Hull { points: vec![top, end], radius: halved(rod) },
            ]
        }
        _ => whole(body.diameter.max(rod)),
    }
}

/// The parts of a leg without what is nearer than `cut` to the joint at an end, and whether that is what they are: a leg that may be shorter, or whose part at
/// the end may be, stays whole, which is more than it.
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
    // the part at the end is longer than the cut: the cylinder by itself, the rod and a whole leg by the length of the leg
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

/// A lower bound of the gap of a part of a leg and a plate over a cell, and an upper bound at the point `z`.
///
/// The lower one is `min u . x - h(u)` over the ends `x` of the part, with `u` the direction from the nearest point of the plate at `z`, which turns with the plate, and `h` the support function of
/// the plate: `max c . u + m |u_across| + max(w u_n)` over the corners `c` of its hull, with the margin `m`, and over its faces `w`. It is no less than minus the radius of the part.
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
    // the pose at z, and with it the point of the plate, are known but for rounding
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
        Body::Platform => dot(&frame.turned(&u), &less(x, &frame.origin())),
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
    Hull { points: points.iter().map(place).collect(), radius: halved(diameter) + Interval::from(rounding) }
}

fn middle(v: &JetVector) -> Vector3<f64> {
    Vector3::from_fn(|k, _| v[k].value.centre_and_radius().0)
}

/// Weights of the points of two hulls whose combinations are nearest, found by alternating steps, in doubles.
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

/// Where a nearest point lies on a segment.
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

/// The direction for two segments, from the second to the first, up to sign and length; and which points have to be compared.
fn direction(a: &[JetVector], b: &[JetVector], on: (On, On)) -> (JetVector, Vec<(usize, usize)>) {
    let every = |a: &[JetVector], b: &[JetVector]| -> Vec<(usize, usize)> {
        (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j))).collect()
    };
    // v less its part along f, times f . f
    let across = |v: JetVector, f: JetVector| -> JetVector {
        let (square, along) = (norm_squared(&f), dot(&v, &f));
        std::array::from_fn(|k| v[k] * square - f[k] * along)
    };
    match on {
        (On::Inside, On::Inside) => (cross(&less(&a[1], &a[0]), &less(&b[1], &b[0])), vec![(0, 0)]),
        (On::End(i), On::Inside) => {
            let u = across(less(&a[i], &b[0]), less(&b[1], &b[0]));
            (u, (0..a.len()).map(|i| (i, 0)).collect())
        }
        (On::Inside, On::End(j)) => {
            let u = across(less(&a[0], &b[j]), less(&a[1], &a[0]));
            (u, (0..b.len()).map(|j| (0, j)).collect())
        }
        (On::End(i), On::End(j)) => (less(&a[i], &b[j]), every(a, b)),
    }
}

/// A lower bound of the gap of two hulls over a cell, and an upper bound of the gap at the point `z`.
pub(super) fn gap(
    chart: &Chart,
    cell: &ChartCell,
    z: &[f64; 6],
    at: (&Hull, &Hull),
    over: (&Hull, &Hull),
) -> (Bounded, f64) {
    // the parts of a point may be thinner than those that hold the leg at all poses of the cell
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
        let kind = (on(&weights.0), if theirs.len() == 1 { On::End(0) } else { on(&weights.1) });
        let (u_at, pairs) = direction(&at.0.points, &at.1.points, kind);
        let (u_over, _) = direction(ours, theirs, kind);
        let flip = if middle(&u_at).dot(&apart) < 0.0 { -1.0 } else { 1.0 };
        let value = |u: &JetVector, a: &JetVector, b: &JetVector| {
            let inverse = norm_squared(u).inverse_root()?;
            Some((dot(u, &less(a, b)) * inverse).times(Interval::from(flip)))
        };
        let bound = |(i, j): (usize, usize)| {
            let here = value(&u_at, &at.0.points[i], &at.1.points[j])?;
            Some(local::below(chart, cell, z, &here, &value(&u_over, &ours[i], &theirs[j])?))
        };
        best = best.max(least(&bound, &pairs));
    }
    best.below = (Interval::from(best.below) - radii_over).lo();
    if best.below.is_nan() {
        best.below = f64::NEG_INFINITY;
    }
    (best, upper)
}

/// The distance of two points of the hulls: an upper bound of the distance of the hulls, when weights are as good as they are rounded.
fn distance_between(a: (&[JetVector], &[f64]), b: (&[JetVector], &[f64])) -> Interval {
    // weights that sum to one exactly: the last one is what the others leave
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
