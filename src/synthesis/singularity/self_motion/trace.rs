//! One curve, followed by its tangent; at crossings every branch is followed once.

use nalgebra::{Matrix2, SMatrix, SVector, SymmetricEigen};

use super::slices::{EQUATIONS, Point, SliceEquations};
use super::{CurveCrossing, CurveEnd, MotionOptions};
use num::Rng;
use num::small::bounded_svd;

type Square = SMatrix<f64, 8, 8>;

/// A singular value below this times the largest counts as zero on a curve.
const ZERO: f64 = 1e-9;

/// Largest residual of a point on a curve, numbers of order one.
const RESIDUAL: f64 = 4e-15;

/// The same on a curve of multiple zeros.
const MULTIPLE_RESIDUAL: f64 = 4e-14;
/// Half the distance of the two points whose difference is the tangent of such a curve.
const ASIDE: f64 = 1e-3;
/// A singular value below this times the largest counts as zero at a multiple zero, which is accurate to half the
/// digits.
const DROPPED: f64 = 1e-6;

/// Smallest step before a curve counts as stuck.
const SMALLEST: f64 = 1e-7;

/// A point of a curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnCurve {
    pub(super) y: Point<f64>,
    /// Unit tangent, in the direction of travel.
    pub(super) tangent: Point<f64>,
    /// Seventh singular value over the first.
    pub(super) gap: f64,
    /// Determinant of seven combinations of the equations and the tangent: changes sign at simple crossings.
    orientation: f64,
}

impl OnCurve {
    /// The same point with the opposite direction of travel.
    fn reversed(self) -> Self {
        Self { tangent: -self.tangent, orientation: -self.orientation, ..self }
    }

    /// The other sign of the same pose: eight rows change sign, the orientation keeps its sign.
    fn negated(self) -> Self {
        Self { y: -self.y, tangent: -self.tangent, ..self }
    }
}

/// The traced part of a curve.
#[derive(Debug, Clone)]
pub(super) struct TracedCurve {
    pub(super) points: Vec<OnCurve>,
    pub(super) end: CurveEnd,
    pub(super) crossings: Vec<CurveCrossing>,
}

/// A crossing without a located pose.
fn open(after_point: usize) -> CurveCrossing {
    CurveCrossing { after_point, crossing: usize::MAX }
}

/// Equations and data for tracing.
#[derive(Debug)]
pub(super) struct Tracer<'a> {
    equations: &'a SliceEquations,
    /// Seven random combinations of the eight equations.
    mix: SMatrix<f64, 7, 8>,
    turn: f64,
    /// Whether the curve consists of multiple zeros, whose tangent is not a null vector: it is then followed by its
    /// points.
    multiple: bool,
}

impl<'a> Tracer<'a> {
    pub(super) fn new(equations: &'a SliceEquations, options: &MotionOptions, rng: &mut Rng) -> Self {
        let mix = SMatrix::from_fn(|_, _| rng.normal());
        Self { equations, mix, turn: options.turn, multiple: false }
    }

    /// The tracer for curves of multiple zeros.
    pub(super) fn of_multiple_curve(self) -> Self {
        Self { multiple: true, ..self }
    }

    /// Number of zero singular values at a point.
    pub(super) fn corank(&self, y: &Point<f64>) -> usize {
        let s = decomposed(&self.jacobian(y)).s;
        s.iter().filter(|x| **x <= DROPPED * s[0]).count()
    }

    /// Singular values of the equations at a point, largest first.
    pub(super) fn singular_values(&self, y: &Point<f64>) -> [f64; 8] {
        decomposed(&self.jacobian(y)).s
    }

    /// Legs, `e.g`, `(e.e - 1) / 2`.
    fn values(&self, y: &Point<f64>) -> SVector<f64, 8> {
        let f = self.equations.values(y);
        let norm = 0.5 * (y.fixed_rows::<4>(0).norm_squared() - 1.0);
        SVector::from_fn(|i, _| if i < EQUATIONS { f[i] } else { norm })
    }

    fn jacobian(&self, y: &Point<f64>) -> Square {
        let mut j = Square::zeros();
        j.fixed_view_mut::<EQUATIONS, 8>(0, 0).copy_from(&self.equations.jacobian(y));
        for k in 0..4 {
            j[(7, k)] = y[k];
        }
        j
    }

    /// The quadratic part `F(v)` of the equations: `F(y + v) = F(y) + F'(y) v + F(v)`.
    fn second_order(&self, v: &Point<f64>) -> SVector<f64, 8> {
        let f = self.equations.values(v);
        let norm = 0.5 * v.fixed_rows::<4>(0).norm_squared();
        SVector::from_fn(|i, _| if i < EQUATIONS { f[i] } else { norm })
    }

    /// Right singular vectors of the two smallest singular values (largest of the two first), and the left ones.
    fn null_planes(&self, y: &Point<f64>) -> ([Point<f64>; 2], [Point<f64>; 2]) {
        let d = decomposed(&self.jacobian(y));
        ([d.right(6), d.right(7)], [d.left(6), d.left(7)])
    }

    /// Gauss-Newton corrections by the first `rank` singular values; `None` without convergence.
    fn improved(&self, start: &Point<f64>, rank: usize) -> Option<Point<f64>> {
        let mut y = *start;
        let mut last = f64::INFINITY;
        for _ in 0..12 {
            let f = self.values(&y);
            let residual = f.norm();
            if residual <= RESIDUAL && residual >= 0.5 * last || residual <= 0.1 * RESIDUAL {
                return Some(y);
            }
            last = residual;
            let d = decomposed(&self.jacobian(&y));
            let usable = d.s.iter().take(rank).filter(|s| **s > ZERO * d.s[0]).count();
            for k in 0..usable {
                y -= d.right(k) * (d.left(k).dot(&f) / d.s[k]);
            }
        }
        (self.values(&y).norm() <= RESIDUAL).then_some(y)
    }

    /// The point of the curve near `start`, with its tangent along `direction`.
    pub(super) fn settle(&self, start: &Point<f64>, direction: &Point<f64>) -> Option<OnCurve> {
        if self.multiple {
            return self.settle_multiple(start, direction);
        }
        let y = self.improved(start, 7)?;
        let d = decomposed(&self.jacobian(&y));
        let mut tangent = d.right(7);
        if tangent.dot(direction) < 0.0 {
            tangent = -tangent;
        }
        let mut square = Square::zeros();
        square.fixed_view_mut::<7, 8>(0, 0).copy_from(&(self.mix * self.jacobian(&y)));
        square.set_row(7, &tangent.transpose());
        Some(OnCurve { y, tangent, gap: d.s[6] / d.s[0], orientation: square.determinant() })
    }

    /// The same on a curve of multiple zeros: the tangent is the difference of two points of the curve.
    fn settle_multiple(&self, start: &Point<f64>, direction: &Point<f64>) -> Option<OnCurve> {
        let y = self.in_plane(start, direction)?;
        let ahead = self.in_plane(&(y + direction * ASIDE), direction)?;
        let behind = self.in_plane(&(y - direction * ASIDE), direction)?;
        let tangent = (ahead - behind).normalize();
        let s = self.singular_values(&y);
        let gap = s.iter().rev().find(|x| **x > DROPPED * s[0]).map_or(0.0, |x| x / s[0]);
        Some(OnCurve { y, tangent, gap, orientation: 1.0 })
    }

    /// The zero of the equations near `start` in the plane through it orthogonal to `normal`. Every step halves the
    /// error at multiple zeros.
    fn in_plane(&self, start: &Point<f64>, normal: &Point<f64>) -> Option<Point<f64>> {
        let mut y = *start;
        let mut best = (f64::INFINITY, y);
        let mut waited = 0;
        for _ in 0..60 {
            let mut rows = SMatrix::<f64, 9, 8>::zeros();
            let mut values = SVector::<f64, 9>::zeros();
            rows.fixed_view_mut::<8, 8>(0, 0).copy_from(&self.jacobian(&y));
            rows.set_row(8, &normal.transpose());
            values.fixed_rows_mut::<8>(0).copy_from(&self.values(&y));
            values[8] = normal.dot(&(y - start));
            let residual = values.norm();
            if residual < 0.7 * best.0 {
                (best, waited) = ((residual, y), 0);
            } else {
                waited += 1;
            }
            if residual <= 0.1 * RESIDUAL || waited > 3 {
                break;
            }
            let d = bounded_svd(&rows)?;
            let (u, v_t) = (d.u?, d.v_t?);
            for k in 0..8 {
                let s = d.singular_values[k];
                if s > ZERO * d.singular_values[0] {
                    y -= v_t.row(k).transpose() * (u.column(k).dot(&values) / s);
                }
            }
        }
        (best.0 <= MULTIPLE_RESIDUAL).then_some(best.1)
    }

    /// Follows the curve until `stop` returns its end, or until it is closed, stuck, or `most` points long.
    pub(super) fn follow(
        &self,
        start: OnCurve,
        most: usize,
        mut stop: impl FnMut(&OnCurve, &OnCurve) -> Option<CurveEnd>,
    ) -> TracedCurve {
        let mut path = TracedCurve { points: vec![start], end: CurveEnd::Unfinished, crossings: Vec::new() };
        let mut here = start;
        let mut step = 0.5 * self.turn;
        while path.points.len() < most {
            let Some(next) = self.step(&here, &mut step) else {
                path.end = CurveEnd::Stuck;
                return path;
            };
            let crossed = next.orientation * here.orientation < 0.0;
            if path.points.len() > 2 && passes(&here, &next, &start) {
                if crossed {
                    path.crossings.push(open(path.points.len() - 1));
                }
                path.end = CurveEnd::Closed;
                return path;
            }
            if crossed {
                path.crossings.push(open(path.points.len() - 1));
            }
            if let Some(end) = stop(&here, &next) {
                path.points.push(next);
                path.end = end;
                return path;
            }
            path.points.push(next);
            here = next;
        }
        path
    }

    /// The next point; the step is shortened until the tangent rotates little.
    fn step(&self, here: &OnCurve, step: &mut f64) -> Option<OnCurve> {
        while *step > SMALLEST {
            let next = self.settle(&(here.y + here.tangent * *step), &here.tangent);
            let next = next.filter(|n| {
                let turn = n.tangent.dot(&here.tangent).clamp(-1.0, 1.0).acos();
                let aside = (n.y - here.y - here.tangent * *step).norm();
                turn <= self.turn && aside <= 0.5 * *step
            });
            if let Some(next) = next {
                let turn = next.tangent.dot(&here.tangent).clamp(-1.0, 1.0).acos();
                *step *= (0.7 * self.turn / turn.max(1e-12)).clamp(0.5, 1.5);
                *step = step.min(2.0 * self.turn);
                return Some(next);
            }
            *step *= 0.5;
        }
        None
    }

    /// The crossing between two points, by bisection on the sign of the orientation.
    pub(super) fn crossing(&self, before: &OnCurve, after: &OnCurve) -> Option<Point<f64>> {
        let (mut lo, mut hi) = (0.0, 1.0);
        let chord = after.y - before.y;
        for _ in 0..40 {
            let t = 0.5 * (lo + hi);
            let Some(on) = self.settle(&(before.y + chord * t), &before.tangent) else { break };
            if on.orientation * before.orientation < 0.0 { hi = t } else { lo = t }
        }
        // at the crossing itself the rank is 6
        self.improved(&(before.y + chord * (0.5 * (lo + hi))), 6)
    }
}

/// Whether the step from `here` to `next` passes the point `mark` of the same curve, as `y` or as `-y`.
fn passes(here: &OnCurve, next: &OnCurve, mark: &OnCurve) -> bool {
    [1.0, -1.0].into_iter().any(|sign| {
        let (y, t) = (mark.y * sign, mark.tangent * sign);
        let chord = next.y - here.y;
        let along = (y - here.y).dot(&chord) / chord.norm_squared();
        let aside = (y - here.y - chord * along).norm();
        along > 0.0 && along <= 1.0 && aside < 0.05 * chord.norm() && t.dot(&next.tangent).abs() > 0.99
    })
}

/// `J = U diag(s) V^T`, singular values in descending order.
struct Decomposed {
    s: [f64; 8],
    u: Square,
    v_t: Square,
}

impl Decomposed {
    fn left(&self, k: usize) -> Point<f64> {
        self.u.column(k).into()
    }
    fn right(&self, k: usize) -> Point<f64> {
        self.v_t.row(k).transpose()
    }
}

fn decomposed(j: &Square) -> Decomposed {
    let Some(d) = bounded_svd(j) else {
        return Decomposed { s: [0.0; 8], u: Square::identity(), v_t: Square::identity() };
    };
    let s = d.singular_values;
    Decomposed {
        s: std::array::from_fn(|k| s[k]),
        u: d.u.unwrap_or_else(Square::identity),
        v_t: d.v_t.unwrap_or_else(Square::identity),
    }
}

/// Distance from a crossing at which a branch begins.
const AWAY: f64 = 1e-2;

/// The curves found so far.
#[derive(Debug)]
pub(super) struct Web<'a> {
    tracer: &'a Tracer<'a>,
    left: usize,
    paths: Vec<TracedCurve>,
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
    pub(super) fn finish(self) -> (Vec<TracedCurve>, Vec<Point<f64>>) {
        (self.paths, self.crossings)
    }

    /// Follows all curves reached from a pose.
    pub(super) fn follow(&mut self, start: &Point<f64>) {
        let Some(here) = self.tracer.settle(start, &Point::repeat(1.0)) else { return };
        if here.gap < 1e-6 {
            // the pose itself is a crossing
            self.crossings.push(here.y);
            self.follow_from(self.crossings.len() - 1);
            return;
        }
        if !self.is_known(&here) {
            self.trace(here);
        }
    }

    /// Follows the curve through a pose in a direction, unless it is known.
    pub(super) fn follow_towards(&mut self, start: &Point<f64>, direction: &Point<f64>) {
        let here = self.tracer.settle(start, &direction.normalize());
        if let Some(here) = here.filter(|here| !self.is_known(here)) {
            self.trace(here);
        }
    }

    /// Records a pose at which curves intersect.
    pub(super) fn note_crossing(&mut self, y: Point<f64>) {
        self.crossing_at(y);
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
            // the other way too, so that the curve is complete between its ends
            let back = start.reversed();
            let mut other = self.tracer.follow(back, self.left, joined);
            self.left = self.left.saturating_sub(other.points.len());
            other.points.reverse();
            for p in &mut other.points {
                *p = p.reversed();
            }
            let shift = other.points.len() - 1;
            let turned = other
                .crossings
                .iter()
                .map(|c| CurveCrossing { after_point: shift - 1 - c.after_point, ..*c })
                .rev();
            let mut crossings: Vec<CurveCrossing> = turned.collect();
            crossings.extend(
                path.crossings.iter().map(|c| CurveCrossing { after_point: c.after_point + shift, ..*c }),
            );
            other.points.extend_from_slice(&path.points[1..]);
            path = TracedCurve { points: other.points, end: other.end, crossings };
        }
        let mut reached = Vec::new();
        for k in 0..path.crossings.len() {
            let before = path.points[path.crossings[k].after_point];
            let after = path.points.get(path.crossings[k].after_point + 1).or(path.points.first()).copied();
            let found = after.and_then(|a| self.tracer.crossing(&before, &aligned(&before, a)));
            if let Some(y) = found {
                path.crossings[k].crossing = self.crossing_at(y);
                reached.push(path.crossings[k].crossing);
            }
        }
        path.crossings.retain(|c| c.crossing != usize::MAX);
        self.paths.push(path);
        for crossing in reached {
            self.follow_from(crossing);
        }
    }

    /// Follows the unknown branches at a crossing.
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

    /// The index of a crossing; a new one if it is at no known crossing.
    fn crossing_at(&mut self, y: Point<f64>) -> usize {
        let same = |z: &Point<f64>| (z - y).norm().min((z + y).norm()) < 1e-4;
        self.crossings.iter().position(same).unwrap_or_else(|| {
            self.crossings.push(y);
            self.crossings.len() - 1
        })
    }

    /// Whether a known path passes there in the same or the opposite direction.
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

    /// Directions of the branches at a crossing: with null vectors `v_1, v_2` and the left null vectors `w` the curves'
    /// tangents `v = alpha v_1 + beta v_2` have `w.F(v) = 0`.
    ///
    /// One of the two left null vectors belongs to the dependency of the legs, which holds to all orders, so its form
    /// vanishes.
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

/// `after` with the sign that is near `before`.
fn aligned(before: &OnCurve, after: OnCurve) -> OnCurve {
    if (before.y - after.y).norm() <= (before.y + after.y).norm() { after } else { after.negated() }
}

/// Whether two points are close enough for the comparison.
fn near(x: &OnCurve, y: &OnCurve) -> bool {
    (x.y - y.y).norm().min((x.y + y.y).norm()) < 0.3
}
