//! The outline of a plate: all points of a plane within a margin of the convex hull of the joints.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point2, Vector2};

use platform::geom::convex_hull;

/// A piece of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OutlinePart {
    /// A straight edge.
    Line {
        /// Its start.
        from: Point2<f64>,
        /// Its end.
        to: Point2<f64>,
    },
    /// An arc, counter-clockwise.
    Arc {
        /// Its centre.
        centre: Point2<f64>,
        /// Its radius.
        radius: f64,
        /// Angle of its start from the first axis, radians.
        start: f64,
        /// Its angle, radians, positive.
        turn: f64,
    },
}

/// A closed curve, counter-clockwise: straight edges with arcs at the corners of the hull. One point gives a circle
/// (two half circles), collinear points a slot.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Corners of the convex hull, counter-clockwise.
    pub hull: Vec<Point2<f64>>,
    /// Distance of the outline from the hull.
    pub margin: f64,
}

/// An edge of the hull, or its nearest point, and the depth of a point inside the outline relative to it.
#[derive(Debug, Clone, Copy)]
pub struct OutlineSide {
    /// Corners of the hull by number, with their weights in the side, which sum to 1.
    pub corners: [(usize, f64); 2],
    /// The gradient of the depth by the point; the gradient by a corner is minus its share.
    pub inwards: Vector2<f64>,
    /// The margin plus the depth in the hull, or the margin minus the distance from the hull.
    pub depth: f64,
    /// Whether it is the line of an edge, for a point in the hull.
    pub is_edge: bool,
}

impl Outline {
    /// The outline around `points` at the distance `margin` of their hull; points within `tolerance` of each other are
    /// one.
    #[must_use]
    pub fn around(points: &[Point2<f64>], margin: f64, tolerance: f64) -> Self {
        Self { hull: convex_hull(points, tolerance), margin }
    }

    /// The pieces in order.
    #[must_use]
    pub fn parts(&self) -> Vec<OutlinePart> {
        let Self { hull, margin } = self;
        let n = hull.len();
        let mut parts = Vec::new();
        if let [centre] = hull[..] {
            let half = |start| OutlinePart::Arc { centre, radius: *margin, start, turn: PI };
            parts.extend([half(0.0), half(PI)]);
        } else {
            // to the right of the direction of travel is outside
            let outward = |i: usize| -> Vector2<f64> {
                let d = (hull[(i + 1) % n] - hull[i]).normalize();
                Vector2::new(d.y, -d.x)
            };
            for i in 0..n {
                let (before, after) = (outward((i + n - 1) % n), outward(i));
                let turn = before.perp(&after).atan2(before.dot(&after));
                // the two ends of a slot have half circles, whose sign depends on rounding
                let turn = if n == 2 { PI } else { turn };
                parts.push(OutlinePart::Arc {
                    centre: hull[i],
                    radius: *margin,
                    start: before.y.atan2(before.x),
                    turn,
                });
                parts.push(OutlinePart::Line {
                    from: hull[i] + after * *margin,
                    to: hull[(i + 1) % n] + after * *margin,
                });
            }
        }
        parts
    }

    /// Enclosed area: that of the hull, a strip along it, and a full circle.
    #[must_use]
    pub fn area(&self) -> f64 {
        let n = self.hull.len();
        let corner = |i: usize| &self.hull[i % n];
        let twice: f64 = (0..n).map(|i| corner(i).coords.perp(&corner(i + 1).coords)).sum();
        let around: f64 = (0..n).map(|i| (corner(i + 1) - corner(i)).norm()).sum();
        0.5 * twice + around * self.margin + PI * self.margin * self.margin
    }

    /// The point of the border of the hull nearest to `p`, by corners with their shares.
    #[must_use]
    pub fn nearest_of_border(&self, p: &Point2<f64>) -> (Point2<f64>, [(usize, f64); 2]) {
        let n = self.hull.len();
        let on_edge = |i: usize| {
            let (a, d) = (self.hull[i], self.hull[(i + 1) % n] - self.hull[i]);
            let square = d.norm_squared();
            let t = if square > 0.0 { ((p - a).dot(&d) / square).clamp(0.0, 1.0) } else { 0.0 };
            (a + d * t, [(i, 1.0 - t), ((i + 1) % n, t)])
        };
        let near = (0..n).map(on_edge).min_by(|x, y| (x.0 - p).norm().total_cmp(&(y.0 - p).norm()));
        near.unwrap_or((*p, [(0, 0.0); 2]))
    }

    /// The line of the edge after a corner.
    #[must_use]
    pub fn edge(&self, i: usize, p: &Point2<f64>) -> OutlineSide {
        let n = self.hull.len();
        let (a, d) = (self.hull[i], self.hull[(i + 1) % n] - self.hull[i]);
        let t = (p - a).dot(&d) / d.norm_squared();
        let inwards = Vector2::new(-d.y, d.x) / d.norm();
        let depth = self.margin + inwards.dot(&(p - a));
        OutlineSide { corners: [(i, 1.0 - t), ((i + 1) % n, t)], inwards, depth, is_edge: true }
    }

    /// Whether a point is in the hull, or outside by no more than `tolerance`.
    #[must_use]
    pub fn is_in_hull(&self, p: &Point2<f64>, tolerance: f64) -> bool {
        let n = self.hull.len();
        n > 2 && (0..n).all(|i| self.edge(i, p).depth - self.margin >= -tolerance)
    }

    /// The sides that determine the depth of a point inside the outline. They are all edges for a point in the hull or
    /// outside by at most `tolerance`, otherwise the nearest point of the hull.
    ///
    /// A point at depth `d` of a convex region has the depth `d + m` in all points within `m` of the region.
    pub fn sides(&self, p: &Point2<f64>, tolerance: f64, see: &mut impl FnMut(OutlineSide)) {
        if self.is_in_hull(p, tolerance) {
            (0..self.hull.len()).for_each(|i| see(self.edge(i, p)));
            return;
        }
        let (near, corners) = self.nearest_of_border(p);
        let away = p - near;
        let inwards = -away.try_normalize(1e-3 * tolerance).unwrap_or_default();
        see(OutlineSide { corners, inwards, depth: self.margin - away.norm(), is_edge: false });
    }

    /// Depth of a point inside the outline, negative outside: the least depth over its [`sides`](Self::sides).
    #[must_use]
    pub fn depth(&self, p: &Point2<f64>) -> f64 {
        let mut least = f64::INFINITY;
        self.sides(p, 0.0, &mut |side| least = least.min(side.depth));
        least
    }

    /// The point within the outline nearest to `p`, which is `p` itself inside.
    #[must_use]
    pub fn nearest(&self, p: &Point2<f64>) -> Point2<f64> {
        if self.is_in_hull(p, 0.0) {
            return *p;
        }
        let (hull, _) = self.nearest_of_border(p);
        let away = p - hull;
        let distance = away.norm();
        if distance <= self.margin { *p } else { hull + away * (self.margin / distance) }
    }

    /// Shortest edge of the hull; infinite for a single corner.
    pub(crate) fn shortest_edge(&self) -> f64 {
        let n = self.hull.len();
        let edges = (0..n).filter(|_| n > 1).map(|i| (self.hull[(i + 1) % n] - self.hull[i]).norm());
        edges.fold(f64::INFINITY, f64::min)
    }

    /// The corners of a polygon on the outline, counter-clockwise, with `steps` chords in a full circle.
    #[must_use]
    pub fn polygon(&self, steps: usize) -> Vec<Point2<f64>> {
        let mut out = Vec::new();
        for part in self.parts() {
            if let OutlinePart::Arc { centre, radius, start, turn } = part {
                let needed = |n: &usize| *n as f64 * TAU >= steps as f64 * turn;
                let chords = (1..steps).find(needed).unwrap_or(steps);
                // without lines the end of an arc is the beginning of the next
                let last = if self.hull.len() == 1 { chords - 1 } else { chords };
                out.extend(
                    (0..=last).map(|k| on_circle(&centre, radius, start + turn * k as f64 / chords as f64)),
                );
            }
        }
        out
    }
}

/// A point of a circle.
pub fn on_circle(centre: &Point2<f64>, radius: f64, angle: f64) -> Point2<f64> {
    let (s, c) = angle.sin_cos();
    Point2::new(centre.x + radius * c, centre.y + radius * s)
}
