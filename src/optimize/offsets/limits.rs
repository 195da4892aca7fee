//! The limits on offsets in intervals: exclusions hold despite rounding.
//!
//! All data are the doubles of the problem, in design units; every comparison is between ends of intervals that are
//! rounded outwards (Moore 1966). Equality never excludes.
//!
//! The distance of two sliding joints of one body is a convex quadratic of two offsets, bounded from below. A linear
//! relaxation with a Farkas certificate, judged in intervals, proves a cell empty.

use nalgebra::Vector3;

use super::branch::BranchCell;
use super::problem::OffsetProblem;
use super::verdict::Conflict;
use num::conic::{Cone, ConicAnswer, ConicProgram, ConicTally};
use num::farkas::{EnclosedRow, refuted};
use num::interval::Interval;
use synthesis::{HexagonSide, offset_products, sides};

/// An enclosure of one double. Data are finite here, since the problem was validated.
pub(super) fn point(x: f64) -> Interval {
    Interval::from(x)
}

pub(super) type Vector = [Interval; 3];

pub(super) fn vector(v: &Vector3<f64>) -> Vector {
    [0, 1, 2].map(|k| point(v[k]))
}

pub(super) fn plus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] + b[k])
}

pub(super) fn minus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

pub(super) fn times(a: &Vector, x: Interval) -> Vector {
    a.map(|c| c * x)
}

pub(super) fn dot(a: &Vector, b: &Vector) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The sum of the squares, each enclosed as non-negative.
pub(super) fn norm_squared(a: &Vector) -> Interval {
    a[0].square() + a[1].square() + a[2].square()
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Six ranges of offsets.
pub(crate) type OffsetRanges = [(f64, f64); 6];

/// The parts of ranges and boxes of offsets within the limits of a problem.
#[derive(Debug, Clone)]
pub(crate) struct OffsetLimits {
    sides: [SlidingJoint; 6],
    /// Square of the required distance.
    required: Interval,
    min_abs_det: f64,
    bounds: OffsetRanges,
}

/// A joint `start + t edge` and its distances from the vertices: `|from_vertex + t edge|`.
#[derive(Debug, Clone, Copy)]
struct SlidingJoint {
    start: Vector,
    edge: Vector,
    from_vertices: [Vector; 3],
}

impl SlidingJoint {
    fn new(side: &HexagonSide) -> Self {
        let [start, end, opposite] = [side.start, side.end, side.opposite].map(|p| vector(&p.coords));
        let from_vertices = [start, end, opposite].map(|v| minus(&start, &v));
        Self { start, edge: minus(&end, &start), from_vertices }
    }

    fn joint(&self, t: f64) -> Vector {
        plus(&self.start, &times(&self.edge, point(t)))
    }

    /// Squared distance of the joint from a vertex.
    fn squared(&self, vertex: usize, t: f64) -> Interval {
        norm_squared(&plus(&self.from_vertices[vertex], &times(&self.edge, point(t))))
    }

    /// Offsets `a < b` such that on the closed interval the joint is closer to the vertex than required.
    ///
    /// The squared distance is a convex function of the offset, so it suffices that it is below the required one at
    /// both ends. The ends are the roots in plain arithmetic, moved inwards until the intervals confirm them.
    fn too_close(&self, vertex: usize, required: Interval) -> Option<(f64, f64)> {
        let centre = |v: &Vector| v.map(|x| x.centre_and_radius().0);
        let (w, e) = (centre(&self.from_vertices[vertex]), centre(&self.edge));
        let dot = |x: &[f64; 3], y: &[f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        let squared_length = dot(&e, &e);
        let foot = -dot(&w, &e) / squared_length;
        let nearest: [f64; 3] = std::array::from_fn(|k| w[k] + foot * e[k]);
        let half = ((required.centre_and_radius().0 - dot(&nearest, &nearest)) / squared_length).sqrt();
        // a negative radicand gives a NaN half width
        if !(half > 0.0 && half.is_finite() && foot.is_finite()) {
            return None;
        }
        let inwards = |direction: f64| {
            let mut step = f64::EPSILON * (foot.abs() + half);
            let mut end = foot - direction * half;
            while (end - foot) * direction < 0.0 {
                if self.squared(vertex, end).hi() < required.lo() {
                    return Some(end);
                }
                end += direction * step;
                step *= 2.0;
            }
            None
        };
        let (low, high) = (inwards(1.0)?, inwards(-1.0)?);
        (low < high).then_some((low, high))
    }
}

impl OffsetLimits {
    pub(super) fn new(p: &OffsetProblem) -> Self {
        Self {
            sides: sides(&p.octahedral, 1.0).map(|s| SlidingJoint::new(&s)),
            required: point(p.min_joint_distance).square(),
            min_abs_det: p.min_abs_det,
            bounds: p.bounds,
        }
    }

    pub(super) fn bounds(&self) -> OffsetRanges {
        self.bounds
    }

    /// A side whose vertices are closer than required, with an upper bound of their distance.
    pub(crate) fn vertices_too_close(&self) -> Option<(usize, f64)> {
        let squared = |i: usize| norm_squared(&self.sides[i].edge);
        let side = (0..6).find(|&i| squared(i).hi() < self.required.lo())?;
        Some((side, root_above(squared(side).hi())))
    }

    /// Parts of a range of one offset; outside of them some vertex is closer than required.
    pub(super) fn room(&self, side: usize, range: (f64, f64)) -> Vec<(f64, f64)> {
        let mut left = vec![range];
        for vertex in 0..3 {
            if let Some((a, b)) = self.sides[side].too_close(vertex, self.required) {
                let pieces = left.iter().flat_map(|&(low, high)| [(low, high.min(a)), (low.max(b), high)]);
                left = pieces.filter(|(low, high)| low <= high).collect();
            }
        }
        left
    }

    /// Two sliding joints of one body that are closer than required on the whole box, with an upper bound of their
    /// distance.
    pub(crate) fn pair_too_close(&self, bounds: &OffsetRanges) -> Option<((usize, usize), f64)> {
        (0..6).find_map(|first| {
            let second = (first + 2) % 6;
            let (a, b) = (&self.sides[first], &self.sides[second]);
            // convex in both offsets: greatest at a corner
            let ends = |(low, high): (f64, f64)| [low, high];
            let mut greatest = 0.0f64;
            for x in ends(bounds[first]) {
                for y in ends(bounds[second]) {
                    greatest = greatest.max(norm_squared(&minus(&a.joint(x), &b.joint(y))).hi());
                }
            }
            (greatest < self.required.lo()).then(|| ((first, second), root_above(greatest)))
        })
    }

    /// Upper bounds of `det A` and of `-det A` on a box; the greatest values are at corners, since it is affine in
    /// every offset.
    pub(crate) fn determinant_reach(bounds: &OffsetRanges) -> [f64; 2] {
        // products over three offsets at the eight corners of their ranges, of `1 - t` and of `t`
        let half = |first: usize| -> [(Interval, Interval); 8] {
            std::array::from_fn(|corner| {
                let at = |i: usize| {
                    let (low, high) = bounds[first + i];
                    point(if corner >> i & 1 == 0 { low } else { high })
                };
                offset_products(&point(1.0), (0..3).map(at))
            })
        };
        let mut reach = [f64::NEG_INFINITY; 2];
        for (rest_a, own_a) in half(0) {
            for (rest_b, own_b) in half(3) {
                let det = rest_a * rest_b - own_a * own_b;
                reach = [reach[0].max(det.hi()), reach[1].max(-det.lo())];
            }
        }
        reach
    }

    /// `true` if `det A` cannot have this sign and the required size, given its greatest value with the sign.
    pub(crate) fn determinant_too_small(&self, greatest: f64) -> bool {
        greatest < self.min_abs_det
    }

    /// `true` if no offsets of the box meet the limits on `det A` and on the distances of sliding joints.
    pub(super) fn is_empty(&self, bounds: &OffsetRanges) -> bool {
        Self::determinant_reach(bounds).into_iter().all(|x| self.determinant_too_small(x))
            || self.pair_too_close(bounds).is_some()
    }

    /// Coefficients `[constant, by x, by y]` of affine upper bounds of `q(x, y) - required` on the box, with the
    /// squared distance `q` of the sliding joints of sides `first` and `first + 2`. The squares have chords, the
    /// product `McCormick`'s two envelopes.
    fn overestimates(&self, first: usize, bounds: &OffsetRanges) -> [[Interval; 3]; 2] {
        let (a, b) = (&self.sides[first], &self.sides[(first + 2) % 6]);
        let (x, y) = (bounds[first], bounds[(first + 2) % 6]);
        // q = |w + x e - y f|^2
        let w = minus(&a.start, &b.start);
        let dot = |u: &Vector, v: &Vector| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let two = point(2.0);
        let (ee, ff) = (norm_squared(&a.edge), norm_squared(&b.edge));
        let mixed = -(two * dot(&a.edge, &b.edge));
        let (by_x, by_y) = (two * dot(&w, &a.edge), -(two * dot(&w, &b.edge)));
        let ends = |(low, high): (f64, f64)| (point(low), point(high));
        let ((x0, x1), (y0, y1)) = (ends(x), ends(y));
        let chords = [
            norm_squared(&w) - ee * x0 * x1 - ff * y0 * y1 - self.required,
            by_x + ee * (x0 + x1),
            by_y + ff * (y0 + y1),
        ];
        // mixed x y <= mixed (p y + q x - p q) for the corners (p, q) of the side given by its sign. For an unknown
        // sign both parts are bounded separately.
        let (rise, fall) = (part(mixed, 0.0, f64::INFINITY), part(mixed, f64::NEG_INFINITY, 0.0));
        let corners = [((x1, y0), (x0, y0)), ((x0, y1), (x1, y1))];
        corners.map(|(up, down)| {
            let mut out = chords;
            for (share, (p, q)) in [(rise, up), (fall, down)] {
                out[0] = out[0] - share * p * q;
                out[1] = out[1] + share * q;
                out[2] = out[2] + share * p;
            }
            out
        })
    }
}

/// The part of an interval within a range that contains zero.
fn part(x: Interval, low: f64, high: f64) -> Interval {
    let cut = |end: f64| end.clamp(low, high);
    Interval::new(cut(x.lo()), cut(x.hi())).unwrap_or(Interval::WHOLE)
}

/// An upper bound of the square root.
fn root_above(x: f64) -> f64 {
    if x > 0.0 { x.sqrt().next_up() } else { 0.0 }
}

/// Two edge joints on edges with a common vertex: sides `first` and `second = first + 2`.
///
/// `q(x, y) = |w + x e - y f|^2` with `x = t_first`, `y = t_second`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlidingPair {
    pub first: usize,
    pub second: usize,
    w: Vector3<f64>,
    e: Vector3<f64>,
    f: Vector3<f64>,
}

pub(crate) type Box2 = [(f64, f64); 2];

impl SlidingPair {
    /// The six pairs, three on each body.
    pub(super) fn all(sides: &[HexagonSide; 6]) -> [Self; 6] {
        std::array::from_fn(|first| {
            let second = (first + 2) % 6;
            let (a, b) = (&sides[first], &sides[second]);
            Self { first, second, w: a.start - b.start, e: a.edge(), f: b.edge() }
        })
    }

    fn gap(&self, x: f64, y: f64) -> Vector3<f64> {
        self.w + self.e * x - self.f * y
    }

    pub(super) fn squared(&self, t: &[f64; 6]) -> f64 {
        self.gap(t[self.first], t[self.second]).norm_squared()
    }

    /// Derivatives by `t_first` and `t_second`.
    pub(super) fn gradient(&self, t: &[f64; 6]) -> [f64; 2] {
        let gap = self.gap(t[self.first], t[self.second]);
        [2.0 * gap.dot(&self.e), -2.0 * gap.dot(&self.f)]
    }

    pub(super) fn edges(&self) -> (f64, f64) {
        (self.e.norm(), self.f.norm())
    }

    pub(crate) fn box_of(&self, bounds: &[(f64, f64); 6]) -> Box2 {
        [bounds[self.first], bounds[self.second]]
    }

    /// Least value on a box: at the common vertex `(1, 0)` if inside, otherwise on one of the four edges.
    pub(super) fn least(&self, [x, y]: Box2) -> f64 {
        if x.0 <= 1.0 && 1.0 <= x.1 && y.0 <= 0.0 && 0.0 <= y.1 {
            return 0.0;
        }
        let (ee, ff) = (self.e.norm_squared(), self.f.norm_squared());
        let along_x = |y: f64| (-self.e.dot(&self.gap(0.0, y)) / ee).clamp(x.0, x.1);
        let along_y = |x: f64| (self.f.dot(&self.gap(x, 0.0)) / ff).clamp(y.0, y.1);
        let candidates = [(along_x(y.0), y.0), (along_x(y.1), y.1), (x.0, along_y(x.0)), (x.1, along_y(x.1))];
        candidates.iter().map(|&(x, y)| self.gap(x, y).norm_squared()).fold(f64::INFINITY, f64::min)
    }
}

/// The linear relaxation of order and spacing on a cell. Affine upper bounds replace every squared distance, so an
/// infeasible relaxation proves the cell empty. `det A` is not part of it; its range on the box is tested earlier.
fn relaxation(cell: &BranchCell, limits: &OffsetLimits) -> Vec<EnclosedRow> {
    let order = cell.order_rows().into_iter().map(|(i, j, [c, x, y])| EnclosedRow {
        coefficients: vec![(i, point(-x)), (j, point(-y))],
        rhs: point(c),
    });
    let spacing = (0..6).flat_map(|first| {
        limits
            .overestimates(first, &cell.outer)
            .map(|[c, x, y]| EnclosedRow { coefficients: vec![(first, -x), ((first + 2) % 6, -y)], rhs: c })
    });
    order.chain(spacing).collect()
}

/// A proved conflict of the cell; `None` if the relaxation is feasible or nothing could be proved.
pub(crate) fn proved_empty(cell: &BranchCell, limits: &OffsetLimits, tally: &ConicTally) -> Option<Conflict> {
    let rows = relaxation(cell, limits);
    let centre = |x: &Interval| x.centre_and_radius().0;
    // the solver scales its rows, but not by the size of the design, so squared distances are scaled to order one
    let largest = rows.iter().map(|r| centre(&r.rhs).abs()).fold(f64::MIN_POSITIVE, f64::max);
    let mut p = ConicProgram { variables: 6, linear: vec![0.0; 6], ..Default::default() };
    for r in &rows {
        let coefficients = r.coefficients.iter().map(|(j, a)| (*j, centre(a) / largest)).collect();
        p.at_least_zero(coefficients, centre(&r.rhs) / largest);
    }
    for (i, (low, high)) in cell.outer.into_iter().enumerate() {
        p.at_least_zero(vec![(i, 1.0)], high);
        p.at_least_zero(vec![(i, -1.0)], -low);
    }
    let ConicAnswer::Infeasible(ray) = p.solve(tally) else { return None };
    // the ranges of the offsets enter unchanged, without multipliers
    let ray = ray.get(..rows.len())?;
    let ranges: Option<Vec<Interval>> = cell.outer.iter().map(|b| Interval::new(b.0, b.1)).collect();
    let strength = refuted(&rows, &[Cone::NonNegative(rows.len())], ray, &ranges?)?;
    Some(Conflict::Combination { strength: strength / largest })
}

#[cfg(test)]
mod tests {
    use super::super::problem::OffsetProblem;
    use super::super::tests::{example, poses};
    use super::*;
    use num::Rng;

    #[test]
    fn the_least_value_on_a_box_is_that_of_samples() {
        let mut rng = Rng::new(11);
        for pair in SlidingPair::all(&sides(&example(), 5.0)) {
            for _ in 0..40 {
                let mut side = || {
                    let (a, b) = (rng.uniform(-1.0, 2.0), rng.uniform(-1.0, 2.0));
                    (a.min(b), a.max(b))
                };
                let b2 = [side(), side()];
                let mut found = f64::INFINITY;
                for k in 0..=20 {
                    for l in 0..=20 {
                        let at = |b: (f64, f64), k: i32| b.0 + (b.1 - b.0) * f64::from(k) / 20.0;
                        let mut t = [0.0; 6];
                        (t[pair.first], t[pair.second]) = (at(b2[0], k), at(b2[1], l));
                        found = found.min(pair.squared(&t));
                    }
                }
                let low = pair.least(b2);
                assert!(low <= found + 1e-12 && found - low < 0.3, "{low} {found}");
            }
        }
    }

    #[test]
    fn joints_at_the_common_vertex_have_distance_zero() {
        for pair in SlidingPair::all(&sides(&example(), 1.0)) {
            let mut t = [0.3; 6];
            (t[pair.first], t[pair.second]) = (1.0, 0.0);
            assert!(pair.squared(&t) < 1e-24);
        }
    }

    /// Two joints on platform edges, both near the common vertex, angle 60 degrees. With arms in `[m, 1.2 m]` the
    /// distance is at most `1.2 m`; for a wider requirement the certificate proves the box empty.
    #[test]
    fn a_cell_without_room_is_proved_empty_and_one_with_room_is_not() {
        let mut p = OffsetProblem::with_defaults(example(), poses());
        p.min_joint_distance = 1.5;
        let mut bounds = [(0.3, 0.7); 6];
        (bounds[1], bounds[3]) = ((0.7, 0.75), (0.25, 0.3)); // arms 1.5 to 1.8 of edge 6
        let cell = BranchCell { branch: 364, bounds, outer: bounds, pairs: Vec::new(), sign: 1.0 };
        assert_eq!(proved_empty(&cell, &OffsetLimits::new(&p), &ConicTally::default()), None);
        p.min_joint_distance *= 1.3;
        let proof = proved_empty(&cell, &OffsetLimits::new(&p), &ConicTally::default());
        assert!(matches!(proof, Some(Conflict::Combination { strength }) if strength > 1e-6), "{proof:?}");
    }
}
