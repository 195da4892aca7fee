//! The limits on offsets in intervals: what is excluded here is excluded whatever rounding did.
//!
//! All data are the doubles of the problem, in design units; every comparison is between ends of intervals that are
//! rounded outwards (Moore 1966). Equality never excludes.

use super::enclosure::{Vector, minus, norm_squared, plus, point, times, vector};
use super::hexagon::{Side, sides};
use super::problem::OffsetProblem;
use crate::num::interval::Interval;

/// Six ranges of offsets.
pub(crate) type Bounds = [(f64, f64); 6];

/// What the limits of a problem leave of ranges and boxes of offsets.
#[derive(Debug, Clone)]
pub(crate) struct Limits {
    sides: [Slide; 6],
    /// Square of the required distance.
    required: Interval,
    min_abs_det: f64,
    bounds: Bounds,
}

/// A joint `start + t edge` and its distances from the vertices: `|from_vertex + t edge|`.
#[derive(Debug, Clone, Copy)]
struct Slide {
    start: Vector,
    edge: Vector,
    from_vertices: [Vector; 3],
}

impl Slide {
    fn new(side: &Side) -> Self {
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

    /// Offsets `a < b` between which, both included, the joint is closer to the vertex than required.
    ///
    /// The squared distance is a convex function of the offset, so it is enough that it is below the required one at both ends: these are the
    /// roots in plain arithmetic, moved inwards until the intervals agree.
    fn too_close(&self, vertex: usize, required: Interval) -> Option<(f64, f64)> {
        let centre = |v: &Vector| v.map(|x| x.centre_and_radius().0);
        let (w, e) = (centre(&self.from_vertices[vertex]), centre(&self.edge));
        let dot = |x: &[f64; 3], y: &[f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        let squared_length = dot(&e, &e);
        let foot = -dot(&w, &e) / squared_length;
        let nearest: [f64; 3] = std::array::from_fn(|k| w[k] + foot * e[k]);
        let half = ((required.centre_and_radius().0 - dot(&nearest, &nearest)) / squared_length).sqrt();
        // a negative radicand makes a half width that is no number
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

impl Limits {
    pub(crate) fn new(p: &OffsetProblem) -> Self {
        Self {
            sides: sides(&p.octahedral, 1.0).map(|s| Slide::new(&s)),
            required: point(p.min_joint_distance).square(),
            min_abs_det: p.min_abs_det,
            bounds: p.bounds,
        }
    }

    pub(crate) fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// A side whose vertices are closer than required, with an upper bound of their distance.
    pub(crate) fn vertices_too_close(&self) -> Option<(usize, f64)> {
        let squared = |i: usize| norm_squared(&self.sides[i].edge);
        let side = (0..6).find(|&i| squared(i).hi() < self.required.lo())?;
        Some((side, root_above(squared(side).hi())))
    }

    /// Parts of a range of one offset outside of which some vertex is closer than required.
    pub(crate) fn room(&self, side: usize, range: (f64, f64)) -> Vec<(f64, f64)> {
        let mut left = vec![range];
        for vertex in 0..3 {
            if let Some((a, b)) = self.sides[side].too_close(vertex, self.required) {
                let pieces = left.iter().flat_map(|&(low, high)| [(low, high.min(a)), (low.max(b), high)]);
                left = pieces.filter(|(low, high)| low <= high).collect();
            }
        }
        left
    }

    /// Two sliding joints of one body that are closer than required all over the box, with an upper bound of their distance.
    pub(crate) fn pair_too_close(&self, bounds: &Bounds) -> Option<((usize, usize), f64)> {
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

    /// Upper bounds of `det A` and of `-det A` on a box: the greatest values are at corners because it is affine in every offset.
    pub(crate) fn determinant_reach(bounds: &Bounds) -> [f64; 2] {
        // products over three offsets at the eight corners of their ranges, of `1 - t` and of `t`
        let half = |first: usize| -> [(Interval, Interval); 8] {
            std::array::from_fn(|corner| {
                (0..3).fold((point(1.0), point(1.0)), |(free, own), i| {
                    let (low, high) = bounds[first + i];
                    let t = point(if corner >> i & 1 == 0 { low } else { high });
                    (free * (point(1.0) - t), own * t)
                })
            })
        };
        let mut reach = [f64::NEG_INFINITY; 2];
        for (free_a, own_a) in half(0) {
            for (free_b, own_b) in half(3) {
                let det = free_a * free_b - own_a * own_b;
                reach = [reach[0].max(det.hi()), reach[1].max(-det.lo())];
            }
        }
        reach
    }

    /// `true` when `det A` cannot have this sign and the required size, given its greatest value with the sign.
    pub(crate) fn determinant_too_small(&self, greatest: f64) -> bool {
        greatest < self.min_abs_det
    }

    /// `true` when no offsets of the box meet the limits on `det A` and on the distances of sliding joints.
    pub(crate) fn is_empty(&self, bounds: &Bounds) -> bool {
        Self::determinant_reach(bounds).into_iter().all(|x| self.determinant_too_small(x))
            || self.pair_too_close(bounds).is_some()
    }

    /// Coefficients `[constant, by x, by y]` of affine functions that are nowhere on the box below `q(x, y) - required`, `q` the squared distance of the
    /// sliding joints of sides `first` and `first + 2`: chords for the squares, `McCormick`'s two envelopes for the product.
    pub(crate) fn overestimates(&self, first: usize, bounds: &Bounds) -> [[Interval; 3]; 2] {
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
        // mixed x y <= mixed (p y + q x - p q) for the corners (p, q) of the side that its sign names; where the sign is not known both of its parts are
        // bounded on their own
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

/// The numbers of an interval cut to a range that holds zero.
fn part(x: Interval, low: f64, high: f64) -> Interval {
    let cut = |end: f64| end.clamp(low, high);
    Interval::new(cut(x.lo()), cut(x.hi())).unwrap_or(Interval::WHOLE)
}

/// An upper bound of the square root.
fn root_above(x: f64) -> f64 {
    if x > 0.0 { x.sqrt().next_up() } else { 0.0 }
}
