//! Joins poses by paths without singular poses: the sign of `det J` along paths, and paths of constant sign.
//!
//! The *straight path* between two poses has a linear `p` and a linear, normalised quaternion. It rotates about the
//! fixed axis of the relative rotation, the short way. On it `det J` is a polynomial of degree 18 over a positive
//! function, so interval arithmetic proves its sign piece by piece. Poses of the same sign may be joined by other paths
//! ([`join()`]).
//!
//! Along the path the quaternion is `e(u) = (1 - u) e_0 + u e_1` (unnormalised) and `p(u) = (1 - u) p_0 + u p_1`. With
//! `N = e.e` the vectors `N n_i = N R(e) b_i + N (p - a_i)` are cubic forms in `(1 - u, u)`. `N^6 det J` is a form of
//! degree 18. The form is stored by its coefficients `c_k` of `(1 - u)^{18 - k} u^k`, which multiply like those of
//! ordinary polynomials. `c_k` over the binomial coefficient is the Bernstein coefficient; if all of these have one
//! sign, the form has it on `[0, 1]`.
//!
//! A *curved path* has the control points of a Bezier curve of positions and quaternions. For degree `n` its form has
//! degree `18 n` ([`signs_on_curve`]).
//!
//! [`join()`] searches a random roadmap for a chain of straight paths with proved edges.

#[cfg(test)]
mod tests;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use num::Rng;
use num::interval::Interval;
use num::vector::cross;
use platform::geom::enclosed::IntervalVector;
use platform::geom::{Pose, random_rotation};
use platform::manipulator::{Leg, Manipulator, plucker_matrix};

/// Greatest number of halvings before a piece stays open.
const DEPTH: u32 = 40;

/// A part `[from, to]` of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPiece {
    /// Parameter of its start, in `[0, 1]`.
    pub from: f64,
    /// Parameter of its end.
    pub to: f64,
    /// The proved sign of `det J` on all of it; `None` near or at a zero.
    pub sign: Option<Sign>,
}

/// The signs of `det J` along a straight path, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct SignsAlong {
    /// Successive pieces from 0 to 1; neighbours differ in sign, or one is open.
    pub pieces: Vec<PathPiece>,
}

impl SignsAlong {
    /// The proved sign of the whole path, which then has no singular pose.
    #[must_use]
    pub fn kept(&self) -> Option<Sign> {
        match self.pieces[..] {
            [piece] => piece.sign,
            _ => None,
        }
    }

    /// Proved signs at start and end.
    #[must_use]
    pub fn ends(&self) -> [Option<Sign>; 2] {
        let sign = |piece: Option<&PathPiece>| piece.and_then(|p| p.sign);
        [sign(self.pieces.first()), sign(self.pieces.last())]
    }

    /// Open pieces between opposite signs: each contains a singular pose.
    pub fn changes(&self) -> impl Iterator<Item = PathPiece> + '_ {
        self.open().filter(|w| w.1).map(|w| w.0)
    }

    /// Open pieces that are not between opposite signs: `det J` has a multiple zero there or nearly vanishes.
    pub fn doubtful(&self) -> impl Iterator<Item = PathPiece> + '_ {
        self.open().filter(|w| !w.1).map(|w| w.0)
    }

    fn open(&self) -> impl Iterator<Item = (PathPiece, bool)> + '_ {
        let sign = |k: Option<usize>| k.and_then(|k| self.pieces.get(k)).and_then(|p| p.sign);
        self.pieces.iter().enumerate().filter(|(_, p)| p.sign.is_none()).map(move |(k, p)| {
            let (before, after) = (sign(k.checked_sub(1)), sign(Some(k + 1)));
            (*p, before.is_some() && after.is_some() && before != after)
        })
    }
}

/// The pose at the parameter `u` of the straight path.
#[must_use]
pub fn between(from: &Pose, to: &Pose, u: f64) -> Pose {
    let (e0, e1) = quaternions(from, to);
    let e: [f64; 4] = std::array::from_fn(|k| e0[k] * (1.0 - u) + e1[k] * u);
    let rotation =
        UnitQuaternion::from_quaternion(Quaternion::new(e[0], e[1], e[2], e[3])).to_rotation_matrix();
    Pose { rotation, position: from.position * (1.0 - u) + to.position * u }
}

/// The proved signs of `det J` on the straight path from `from` to `to`.
///
/// Rotations are exactly those of the rounded quaternions of the poses. The poses of the path are exact functions of
/// these and of the positions.
#[must_use]
pub fn signs_along(m: &Manipulator, from: &Pose, to: &Pose) -> SignsAlong {
    signs(determinant(m, &Curve::straight(from, to)))
}

/// The proved sign of `det J` at a pose.
pub(super) fn sign_at(m: &Manipulator, pose: &Pose) -> Option<Sign> {
    signs_on_curve(m, &straight(pose, pose)[..1]).kept()
}

/// Position, then quaternion with the scalar part first, of any norm above zero.
pub type ControlPoint = [f64; 7];

/// The control points of the straight path.
#[must_use]
pub fn straight(from: &Pose, to: &Pose) -> [ControlPoint; 2] {
    let (e0, e1) = quaternions(from, to);
    let point = |pose: &Pose, e: [f64; 4]| {
        let p = pose.position;
        [p.x, p.y, p.z, e[0], e[1], e[2], e[3]]
    };
    [point(from, e0), point(to, e1)]
}

/// The same on the Bezier curve of positions and quaternions with these control points, one or more.
#[must_use]
pub fn signs_on_curve(m: &Manipulator, control: &[ControlPoint]) -> SignsAlong {
    signs(determinant(m, &Curve::of(control)))
}

fn signs(coefficients: Vec<Interval>) -> SignsAlong {
    let mut pieces: Vec<PathPiece> = Vec::new();
    let mut open: Vec<(f64, f64, Vec<Interval>, u32)> = vec![(0.0, 1.0, coefficients, 0)];
    while let Some((from, to, c, depth)) = open.pop() {
        let sign = common_sign(&c);
        if sign.is_none() && depth < DEPTH && !hopeless(&c) {
            let (left, right) = halves(&c);
            let middle = 0.5 * (from + to); // exact: dyadic with few digits
            open.push((middle, to, right, depth + 1));
            open.push((from, middle, left, depth + 1));
            continue;
        }
        match pieces.last_mut().filter(|last| last.sign == sign) {
            Some(last) => last.to = to,
            None => pieces.push(PathPiece { from, to, sign }),
        }
    }
    SignsAlong { pieces }
}

/// Whether no coefficient has a sign: rounding dominates, so halving is useless.
fn hopeless(c: &[Interval]) -> bool {
    c.iter().all(|x| x.lo() <= 0.0 && x.hi() >= 0.0)
}

/// Degree of `N^6 det J` on a straight path.
const DEGREE: usize = 18;

/// Positions and quaternions of a path, forms of one degree.
struct Curve {
    degree: usize,
    position: [Form; 3],
    quaternion: [Form; 4],
}

impl Curve {
    fn straight(from: &Pose, to: &Pose) -> Self {
        Self::of(&straight(from, to))
    }

    fn of(control: &[ControlPoint]) -> Self {
        let degree = control.len().saturating_sub(1);
        let weights = ones(degree);
        let form = |k: usize| -> Form {
            control.iter().zip(&weights).map(|(point, w)| Interval::from(point[k]) * *w).collect()
        };
        Self { degree, position: std::array::from_fn(form), quaternion: std::array::from_fn(|k| form(k + 3)) }
    }
}

/// The constant 1 as a form: the binomial coefficients, which are exact.
fn ones(degree: usize) -> Form {
    let mut binomial = 1.0;
    let coefficient = |k: usize| {
        let here = Interval::from(binomial);
        binomial = binomial * (degree - k) as f64 / (k + 1) as f64;
        here
    };
    (0..=degree).map(coefficient).collect()
}

/// A form in `(1 - u, u)` by its coefficients.
type Form = Vec<Interval>;

fn times(x: &Form, y: &Form) -> Form {
    let mut out = vec![Interval::ZERO; x.len() + y.len() - 1];
    for (i, a) in x.iter().enumerate() {
        for (j, b) in y.iter().enumerate() {
            out[i + j] = out[i + j] + *a * *b;
        }
    }
    out
}

fn plus(x: &Form, y: &Form) -> Form {
    x.iter().zip(y).map(|(a, b)| *a + *b).collect()
}

fn minus(x: &Form, y: &Form) -> Form {
    x.iter().zip(y).map(|(a, b)| *a - *b).collect()
}

fn scaled(x: &Form, factor: Interval) -> Form {
    x.iter().map(|a| *a * factor).collect()
}

/// Bernstein coefficients of `N^6 det J` on a path, up to a positive factor.
fn determinant(m: &Manipulator, curve: &Curve) -> Vec<Interval> {
    let rows = rows(m, curve);
    // each minor of two rows is in four minors of three rows
    let of_two_rows = [1, 4].map(|r| -> Vec<Form> {
        let of_columns = |j: usize, k: usize| {
            minus(&times(&rows[r][j], &rows[r + 1][k]), &times(&rows[r][k], &rows[r + 1][j]))
        };
        (0..36).map(|at| if at / 6 < at % 6 { of_columns(at / 6, at % 6) } else { Form::new() }).collect()
    });
    let minor = |r: usize, c: [usize; 3]| {
        let part = |i: usize, j: usize, k: usize| times(&rows[r][i], &of_two_rows[r / 3][6 * j + k]);
        plus(&minus(&part(c[0], c[1], c[2]), &part(c[1], c[0], c[2])), &part(c[2], c[0], c[1]))
    };
    let degree = DEGREE * curve.degree;
    let mut sum = vec![Interval::ZERO; degree + 1];
    // Laplace expansion by complementary minors of the first three rows
    for i in 0..6 {
        for j in i + 1..6 {
            for k in j + 1..6 {
                let mut others = (0..6).filter(|x| ![i, j, k].contains(x));
                let rest: [usize; 3] = std::array::from_fn(|_| others.next().unwrap_or(0));
                let term = times(&minor(0, [i, j, k]), &minor(3, rest));
                sum = if (i + j + k) % 2 == 1 { plus(&sum, &term) } else { minus(&sum, &term) };
            }
        }
    }
    for (c, binomial) in sum.iter_mut().zip(ones(degree)) {
        *c = c.checked_div(binomial).unwrap_or(Interval::WHOLE);
    }
    sum
}

/// Rows `N [n_i, m_i]` in units of the size. The moments are about the mean joint of the smaller body and in units of
/// its radius, so a small body is compared with itself. With the mean joints `o` and `c`,
///
/// ```text
/// m = (a - o) x n                                    about the base,
/// m = R (b - c) x (p - a) + R ((b - c) x c)          about the platform.
/// ```
fn rows(m: &Manipulator, curve: &Curve) -> Vec<[Form; 6]> {
    let [o, c] = m.mean_leg_ends();
    let radius = |mean: Vector3<f64>, end: fn(&Leg) -> Vector3<f64>| {
        m.legs().iter().map(|leg| (end(leg) - mean).norm()).fold(0.0, f64::max)
    };
    let (base, platform) = (radius(o, |leg| leg.base.coords), radius(c, |leg| leg.platform.coords));
    let (unit, small) = (Interval::from(1.0 / m.size()), Interval::from(1.0 / base.min(platform)));
    let from_mean = |end: IntervalVector, mean: Vector3<f64>| -> IntervalVector {
        std::array::from_fn(|k| (end[k] - Interval::from(mean[k])) * small)
    };
    let (one, turn) = (ones(curve.degree), turn(&curve.quaternion));
    let squares = curve.quaternion.each_ref().map(|x| times(x, x));
    let norm = plus(&plus(&squares[0], &squares[1]), &plus(&squares[2], &squares[3]));
    let row = |leg: usize| {
        let [a, b] = m.enclosed_ends(leg);
        // p - a
        let shift: [Form; 3] =
            std::array::from_fn(|k| scaled(&minus(&curve.position[k], &scaled(&one, a[k])), unit));
        let arm = turned(&turn, &b.map(|x| x * unit));
        let [u, v, w]: [Form; 3] =
            std::array::from_fn(|k| plus(&times(&arm[k], &one), &times(&norm, &shift[k])));
        let [x, y, z] = if platform < base {
            let own = from_mean(b, c);
            let across = turned(&turn, &cross(&own, &[c.x, c.y, c.z].map(|x| Interval::from(x) * unit)));
            let moment = crossed(&turned(&turn, &own), &shift);
            std::array::from_fn(|k| plus(&moment[k], &times(&across[k], &one)))
        } else {
            crossed(&from_mean(a, o).map(|x| vec![x]), &[&u, &v, &w].map(Form::clone))
        };
        [u, v, w, x, y, z]
    };
    (0..6).map(row).collect()
}

/// The rows of `N R(e)`.
fn turn(e: &[Form; 4]) -> [[Form; 3]; 3] {
    let product = |i: usize, j: usize| times(&e[i], &e[j]);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            if i == j {
                let [k, l] = [(i + 1) % 3 + 1, (i + 2) % 3 + 1];
                let own = plus(&product(0, 0), &product(i + 1, i + 1));
                return minus(&own, &plus(&product(k, k), &product(l, l)));
            }
            let sum = if (i + 1) % 3 == j { minus } else { plus };
            scaled(&sum(&product(i + 1, j + 1), &product(0, 4 - i - j)), Interval::from(2.0))
        })
    })
}

/// `N R(e) b`.
fn turned(turn: &[[Form; 3]; 3], b: &IntervalVector) -> [Form; 3] {
    turn.each_ref().map(|[x, y, z]| plus(&plus(&scaled(x, b[0]), &scaled(y, b[1])), &scaled(z, b[2])))
}

/// The cross product.
fn crossed(x: &[Form; 3], y: &[Form; 3]) -> [Form; 3] {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        minus(&times(&x[i], &y[j]), &times(&x[j], &y[i]))
    })
}

/// The quaternions of two poses, the second with the sign of the shorter way.
fn quaternions(from: &Pose, to: &Pose) -> ([f64; 4], [f64; 4]) {
    let q = [from, to].map(|pose| {
        let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
        [q.w, q.i, q.j, q.k]
    });
    let dot: f64 = q[0].iter().zip(q[1]).map(|(x, y)| x * y).sum();
    (q[0], if dot < 0.0 { q[1].map(|x| -x) } else { q[1] })
}

/// The common sign of all numbers, if there is one.
fn common_sign(c: &[Interval]) -> Option<Sign> {
    if c.iter().all(|x| x.lo() > 0.0) {
        Some(Sign::Positive)
    } else if c.iter().all(|x| x.hi() < 0.0) {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// Bernstein coefficients on the two halves (de Casteljau).
fn halves(c: &[Interval]) -> (Vec<Interval>, Vec<Interval>) {
    let half = Interval::from(0.5);
    let (mut row, mut left, mut right) = (c.to_vec(), Vec::new(), Vec::new());
    while let (Some(first), Some(last)) = (row.first(), row.last()) {
        left.push(*first);
        right.push(*last);
        row = row.windows(2).map(|w| (w[0] + w[1]) * half).collect();
    }
    right.reverse();
    (left, right)
}

/// Sign of `det J`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// `det J > 0`.
    Positive,
    /// `det J < 0`.
    Negative,
}

impl Sign {
    /// `+1` or `-1`.
    #[must_use]
    pub fn value(self) -> i8 {
        match self {
            Self::Positive => 1,
            Self::Negative => -1,
        }
    }
}

/// Number of neighbours of a pose of the roadmap.
const NEIGHBOURS: usize = 12;
/// Number of poses tested on an edge before its proof.
const PROBES: usize = 12;

/// Effort of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JoinOptions {
    /// Random poses drawn for each sign.
    pub samples: usize,
    /// Seed of the drawing.
    pub seed: u64,
}

/// A chain of poses.
#[derive(Debug, Clone, PartialEq)]
pub struct Way {
    /// Index of the pose it starts from.
    pub from: usize,
    /// Index of the pose at its end.
    pub to: usize,
    /// All poses of the chain, both ends included. `det J` is proved to keep its sign on every straight path from one
    /// to the next.
    pub poses: Vec<Pose>,
}

/// The poses that are proved to be joined without a singular pose between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Joined {
    /// Sign of `det J` at each pose; `None` if unproved.
    pub signs: Vec<Option<Sign>>,
    /// Poses proved to be joined, each pose in one group. Poses of different groups and opposite signs cannot be
    /// joined; for equal signs the search found no path.
    pub groups: Vec<Vec<usize>>,
    /// Ways inside the groups, from the first pose of a group to every other.
    pub ways: Vec<Way>,
}

/// Joins poses by chains of straight paths without a singular pose.
///
/// Two poses in different regions of `det J != 0` are never joined, with any effort; two in one region may be missed.
#[must_use]
pub fn join(m: &Manipulator, poses: &[Pose], options: &JoinOptions) -> Joined {
    let signs: Vec<Option<Sign>> = poses.iter().map(|p| sign_at(m, p)).collect();
    let mut joined = Joined { signs, groups: Vec::new(), ways: Vec::new() };
    for sign in [Sign::Positive, Sign::Negative] {
        let members: Vec<usize> = (0..poses.len()).filter(|k| joined.signs[*k] == Some(sign)).collect();
        if members.is_empty() {
            continue;
        }
        let mut map = Roadmap::new(m, members.iter().map(|k| poses[*k]).collect(), sign, options);
        let mut left: Vec<usize> = (0..members.len()).collect();
        while let Some(first) = left.first().copied() {
            let mut group = vec![members[first]];
            let reached: Vec<(usize, Vec<Pose>)> =
                left[1..].iter().filter_map(|k| map.way(first, *k).map(|way| (*k, way))).collect();
            for (k, poses) in reached {
                group.push(members[k]);
                joined.ways.push(Way { from: members[first], to: members[k], poses });
            }
            left.retain(|k| !group.contains(&members[*k]));
            joined.groups.push(group);
        }
    }
    let unsigned = (0..poses.len()).filter(|k| joined.signs[*k].is_none());
    joined.groups.extend(unsigned.map(|k| vec![k]));
    joined.groups.sort();
    joined
}

/// Poses of one sign, with edges that apparently keep it.
struct Roadmap<'a> {
    m: &'a Manipulator,
    sign: Sign,
    poses: Vec<Pose>,
    edges: Vec<Vec<usize>>,
    /// Proved edges, smaller index first.
    proved: Vec<(usize, usize)>,
}

impl<'a> Roadmap<'a> {
    fn new(m: &'a Manipulator, mut poses: Vec<Pose>, sign: Sign, options: &JoinOptions) -> Self {
        let mut rng = Rng::stream(options.seed, u64::from(sign == Sign::Positive));
        let low = poses.iter().fold(poses[0].position, |x, p| x.inf(&p.position));
        let high = poses.iter().fold(poses[0].position, |x, p| x.sup(&p.position));
        let margin = Vector3::repeat(0.5 * m.size());
        let (low, high) = (low - margin, high + margin);
        for _ in 0..options.samples {
            let position = Vector3::from_fn(|k, _| rng.uniform(low[k], high[k]));
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            if has_sign(m, &pose, sign) {
                poses.push(pose);
            }
        }
        let edges = neighbours(m, &poses);
        let mut map = Self { m, sign, poses, edges, proved: Vec::new() };
        for k in 0..map.edges.len() {
            let list = std::mem::take(&mut map.edges[k]);
            map.edges[k] = list.into_iter().filter(|l| map.seems_free(k, *l)).collect();
        }
        map
    }

    fn seems_free(&self, k: usize, l: usize) -> bool {
        let probe = |i: usize| between(&self.poses[k], &self.poses[l], (i as f64 + 0.5) / PROBES as f64);
        (0..PROBES).all(|i| has_sign(self.m, &probe(i), self.sign))
    }

    fn is_free(&self, k: usize, l: usize) -> bool {
        signs_along(self.m, &self.poses[k], &self.poses[l]).kept() == Some(self.sign)
    }

    /// A proved way between two poses; edges that fail the proof are removed.
    fn way(&mut self, from: usize, to: usize) -> Option<Vec<Pose>> {
        loop {
            let chain = self.shortest(from, to)?;
            let bad = chain.windows(2).find(|w| !self.prove(w[0], w[1])).map(|w| (w[0], w[1]));
            match bad {
                Some((k, l)) => {
                    self.edges[k].retain(|x| *x != l);
                    self.edges[l].retain(|x| *x != k);
                }
                None => return Some(self.shortened(&chain).iter().map(|k| self.poses[*k]).collect()),
            }
        }
    }

    fn prove(&mut self, k: usize, l: usize) -> bool {
        let edge = (k.min(l), k.max(l));
        if !self.proved.contains(&edge) {
            if !self.is_free(k, l) {
                return false;
            }
            self.proved.push(edge);
        }
        true
    }

    /// The path with the fewest edges, by breadth-first search.
    fn shortest(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let mut before: Vec<Option<usize>> = vec![None; self.poses.len()];
        before[from] = Some(from);
        let mut queue = std::collections::VecDeque::from([from]);
        while let Some(k) = queue.pop_front() {
            if k == to {
                let mut chain = vec![to];
                let mut at = to;
                while at != from {
                    at = before[at]?;
                    chain.push(at);
                }
                chain.reverse();
                return Some(chain);
            }
            for &l in &self.edges[k] {
                if before[l].is_none() {
                    before[l] = Some(k);
                    queue.push_back(l);
                }
            }
        }
        None
    }

    /// Leaves out poses that a proved straight path bypasses.
    fn shortened(&self, chain: &[usize]) -> Vec<usize> {
        let (mut out, mut at) = (vec![chain[0]], 0);
        while at + 1 < chain.len() {
            let far = (at + 2..chain.len()).rev().find(|k| self.is_free(chain[at], chain[*k]));
            at = far.unwrap_or(at + 1);
            out.push(chain[at]);
        }
        out
    }
}

/// The sign of `det J` in rounded numbers.
fn has_sign(m: &Manipulator, pose: &Pose, sign: Sign) -> bool {
    plucker_matrix(m, pose, m.size()).determinant() * f64::from(sign.value()) > 0.0
}

/// For every pose the nearest others, in both directions.
fn neighbours(m: &Manipulator, poses: &[Pose]) -> Vec<Vec<usize>> {
    let places: Vec<(UnitQuaternion<f64>, Vector3<f64>)> = poses
        .iter()
        .map(|p| (UnitQuaternion::from_rotation_matrix(&p.rotation), p.position / m.size()))
        .collect();
    let apart = |k: usize, l: usize| {
        let ((q, x), (r, y)) = (&places[k], &places[l]);
        (x - y).norm_squared() + 8.0 * (1.0 - q.coords.dot(&r.coords).abs())
    };
    let mut edges: Vec<Vec<usize>> = vec![Vec::new(); poses.len()];
    for k in 0..poses.len() {
        let mut others: Vec<(f64, usize)> =
            (0..poses.len()).filter(|l| *l != k).map(|l| (apart(k, l), l)).collect();
        let count = NEIGHBOURS.min(others.len());
        if count > 0 && count < others.len() {
            others.select_nth_unstable_by(count - 1, |x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        }
        for (_, l) in others.into_iter().take(count) {
            if !edges[k].contains(&l) {
                edges[k].push(l);
                edges[l].push(k);
            }
        }
    }
    for list in &mut edges {
        list.sort_unstable();
    }
    edges
}
