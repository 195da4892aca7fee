//! Curves that cross: every branch is followed once.

use nalgebra::{Matrix2, SymmetricEigen};

use super::CurveEnd;
use super::equations::Point;
use super::trace::{OnCurve, Path, Tracer, passes};

/// Distance from a crossing at which a branch is taken up.
const AWAY: f64 = 1e-2;

/// Curves so far.
#[derive(Debug)]
pub(super) struct Web<'a> {
    tracer: &'a Tracer<'a>,
    left: usize,
    paths: Vec<Path>,
    crossings: Vec<Point<f64>>,
}

impl<'a> Web<'a> {
    pub(super) fn new(tracer: &'a Tracer<'a>, points: usize) -> Self {
        Self { tracer, left: points, paths: Vec::new(), crossings: Vec::new() }
    }

    /// Number of curves so far.
    pub(super) fn count(&self) -> usize {
        self.paths.len()
    }

    /// Curves and crossings.
    pub(super) fn finish(self) -> (Vec<Path>, Vec<Point<f64>>) {
        (self.paths, self.crossings)
    }

    /// Follows all that is reached from a pose.
    pub(super) fn follow(&mut self, start: &Point<f64>) {
        let Some(here) = self.tracer.settle(start, &Point::repeat(1.0)) else { return };
        if here.gap < 1e-6 {
            // the pose is a crossing itself
            self.crossings.push(here.y);
            self.follow_from(self.crossings.len() - 1);
            return;
        }
        if !self.is_known(&here) {
            self.trace(here);
        }
    }

    /// Follows one curve and then those that cross it.
    fn trace(&mut self, start: OnCurve) {
        let marks: Vec<OnCurve> = self.paths.iter().flat_map(|p| p.points.iter().copied()).collect();
        let joined = |here: &OnCurve, next: &OnCurve| {
            let met = marks.iter().any(|m| near(m, next) && passes(here, next, m));
            met.then_some(CurveEnd::Joined)
        };
        let mut path = self.tracer.follow(start, self.left, joined);
        self.left = self.left.saturating_sub(path.points.len());
        if path.end == CurveEnd::Stuck {
            // the other way too, so that the curve is whole between its ends
            let back = start.reversed();
            let mut other = self.tracer.follow(back, self.left, joined);
            self.left = self.left.saturating_sub(other.points.len());
            other.points.reverse();
            for p in &mut other.points {
                *p = p.reversed();
            }
            let shift = other.points.len() - 1;
            let turned = other.crossings.iter().map(|c| (shift - 1 - c.0, c.1)).rev();
            let mut crossings: Vec<(usize, usize)> = turned.collect();
            crossings.extend(path.crossings.iter().map(|c| (c.0 + shift, c.1)));
            other.points.extend_from_slice(&path.points[1..]);
            path = Path { points: other.points, end: other.end, crossings };
        }
        let mut reached = Vec::new();
        for k in 0..path.crossings.len() {
            let before = path.points[path.crossings[k].0];
            let after = path.points.get(path.crossings[k].0 + 1).or(path.points.first()).copied();
            let found = after.and_then(|a| self.tracer.crossing(&before, &aligned(&before, a)));
            if let Some(y) = found {
                path.crossings[k].1 = self.crossing_at(y);
                reached.push(path.crossings[k].1);
            }
        }
        path.crossings.retain(|c| c.1 != usize::MAX);
        self.paths.push(path);
        for crossing in reached {
            self.follow_from(crossing);
        }
    }

    /// Follows the branches at a crossing that are not known.
    fn follow_from(&mut self, crossing: usize) {
        let y = self.crossings[crossing];
        for tangent in self.tangents(&y) {
            for direction in [tangent, -tangent] {
                if self.left == 0 {
                    return;
                }
                let away = self.tracer.settle(&(y + direction * AWAY), &direction);
                if let Some(start) = away.filter(|s| !self.is_known(s) && s.tangent.dot(&direction) > 0.9) {
                    self.trace(start);
                }
            }
        }
    }

    /// The index of a crossing, a new one when it is at no other.
    fn crossing_at(&mut self, y: Point<f64>) -> usize {
        let same = |z: &Point<f64>| (z - y).norm().min((z + y).norm()) < 1e-4;
        self.crossings.iter().position(same).unwrap_or_else(|| {
            self.crossings.push(y);
            self.crossings.len() - 1
        })
    }

    /// Whether some path passes there in the same or the opposite direction.
    fn is_known(&self, on: &OnCurve) -> bool {
        self.paths.iter().any(|path| {
            let points = &path.points;
            let next = |k: usize| points.get(k + 1).or((path.end == CurveEnd::Closed).then_some(&points[0]));
            (0..points.len()).any(|k| {
                near(&points[k], on)
                    && next(k).is_some_and(|n| passes(&points[k], &aligned(&points[k], *n), on))
            })
        })
    }

    /// Directions of the branches at a crossing: with null vectors `v_1, v_2` and the left null vectors `w` the curves' tangents
    /// `v = alpha v_1 + beta v_2` have `w.F(v) = 0`.
    ///
    /// One of the two left null vectors belongs to the dependency of the legs, which holds to all orders; its form vanishes.
    fn tangents(&self, y: &Point<f64>) -> Vec<Point<f64>> {
        let (right, left) = self.tracer.null_planes(y);
        let form = |w: &Point<f64>| {
            let q = |v: Point<f64>| w.dot(&self.tracer.second_order(&v));
            let (a, b) = (q(right[0]), q(right[1]));
            let mixed = 0.5 * (q(right[0] + right[1]) - a - b);
            Matrix2::new(a, mixed, mixed, b)
        };
        let (one, two) = (form(&left[0]), form(&left[1]));
        let q = if one.norm() > two.norm() { one } else { two };
        let e = SymmetricEigen::new(q);
        let (l, m) = (e.eigenvalues[0], e.eigenvalues[1]);
        if !(l * m < 0.0) {
            return Vec::new();
        }
        // l x^2 + m y^2 = 0
        let ratio = (-l / m).sqrt();
        let along = [1.0, -1.0].map(|sign| {
            let c = e.eigenvectors.column(0) + e.eigenvectors.column(1) * (sign * ratio);
            (right[0] * c[0] + right[1] * c[1]).normalize()
        });
        along.to_vec()
    }
}

/// `after` with the sign for which it is near `before`.
fn aligned(before: &OnCurve, after: OnCurve) -> OnCurve {
    if (before.y - after.y).norm() <= (before.y + after.y).norm() { after } else { after.negated() }
}

/// Close enough to be looked at.
fn near(x: &OnCurve, y: &OnCurve) -> bool {
    (x.y - y.y).norm().min((x.y + y.y).norm()) < 0.3
}
