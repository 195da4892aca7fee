//! Decides whether a platform with locked legs can leave a pose: proved isolated, moving by a traced path, or
//! undecided.
//!
//! Displacements of the pose are `x = (t, c)`: the quaternion `(1, c)` and the dual part `(-c.t, t)`, lengths in units
//! of the size. With the
//! joints `a` and `w` of a leg at the pose, `d = w - a` and `o = a + w`, the leg keeps its length where
//!
//! ```text
//! f = d.r + (r.r + k^2 - d.d c.c) / 2 + m k + m^2 / 2 = 0,   r = t - o x c,  k = d.c,  m = c.t.
//! ```
//!
//! So `f = L x + Q(x) + ..` with exact `f(0) = 0`. `docs/theory/self-motions.md` has the theorem of second order that
//! [`cleared`] proves.

use nalgebra::{DMatrix, Matrix6, Quaternion, Rotation3, SMatrix, SVector, UnitQuaternion, Vector3, Vector6};

use crate::singularity::Architecture;
use crate::singularity::hold::exact_rank;
use num::Rng;
use num::interval::Interval;
use num::small::bounded_svd;
use num::vector::cross;
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, dimension_of_ends};

/// Singular values of the leg lines below this times the largest count as zero.
const ZERO: f64 = 1e-9;
/// Largest residual of a pose of a motion, relative to the squared distances of the joints.
const RESIDUAL: f64 = 2e-14;
/// The first distance from the pose in the search for a motion, and the factor between successive distances.
const FIRST: f64 = 1e-3;
/// Number of distances in the search for a motion, each twice the last.
const RUNGS: usize = 9;
/// Number of distances that a motion must reach: 32 times the first one.
const REQUIRED: usize = 6;
/// Greatest number of motions in the search: on surfaces every direction has one.
const ARCS: usize = 12;
/// Distance of the poses that sample the dimension of a motion.
const NEARBY: f64 = 3e-5;
/// Share of the sampled differences above which a direction belongs to the motion.
const SPANNED: f64 = 0.1;
/// Greatest number of boxes of directions in a proof of second order.
const BOXES: usize = 100_000;
/// Greatest ratio of the ball that a proof leaves around the pose to the one that it clears.
const CLEAR: f64 = 1e-3;

/// The mobility of the platform at a pose with locked legs.
#[derive(Debug, Clone, PartialEq)]
pub struct AtPose {
    /// Freedoms of first order: six minus the rank of the leg lines, by singular values.
    pub tangent_dimension: usize,
    /// Singular values of the leg lines, largest first.
    pub singular_values: [f64; 6],
    /// Isolated, moving, or undecided.
    pub verdict: PoseVerdict,
}

/// Whether the platform can leave a pose with locked legs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PoseVerdict {
    /// Proved: the pose is isolated, and every pose with these lengths within `radius` is within `within`, in
    /// `(t / size, c)` of the displacement.
    Isolated {
        /// 1: the leg lines are independent; 2: no freedom of first order can be continued.
        order: u8,
        /// Radius of the cleared ball.
        radius: f64,
        /// Radius left by rounding; 0 for the order 1.
        within: f64,
    },
    /// Proved: every pose with these lengths within `radius` is within `within`. A motion smaller than that is not
    /// excluded: the rank of the leg lines at the pose is not known, or neither that of the singular values nor six.
    Confined {
        /// Radius of the cleared ball.
        radius: f64,
        /// Radius left by rounding.
        within: f64,
    },
    /// The pose is not isolated.
    Moves {
        /// Dimension of the set of poses with these lengths near the pose.
        dimension: usize,
        /// Length of the stretch of poses found from the pose, in `(t / size, c)`.
        reach: f64,
        /// The evidence.
        evidence: MotionEvidence,
    },
    /// Neither.
    Undecided,
}

/// The evidence that a platform moves with locked legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionEvidence {
    /// Proved: the leg lines have the same rank at all nearby poses, so the poses with these lengths are a manifold.
    ConstantRank,
    /// Proved: all joints of one body are on a line, and the platform turns about it at every pose. The dimension is
    /// sampled.
    CommonLine,
    /// Found by tracing: poses with equal lengths, to rounding, along a stretch; the dimension is sampled.
    Traced,
}

impl PoseVerdict {
    /// Whether the platform can leave the pose, if that is proved either way; a motion found by tracing is not.
    #[must_use]
    pub fn moves(&self) -> Option<bool> {
        match self {
            Self::Isolated { .. } => Some(false),
            Self::Moves { evidence: MotionEvidence::ConstantRank | MotionEvidence::CommonLine, .. } => {
                Some(true)
            }
            Self::Moves { evidence: MotionEvidence::Traced, .. }
            | Self::Confined { .. }
            | Self::Undecided => None,
        }
    }

    /// Dimension of the self-motion through the pose, if known.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        match self {
            Self::Isolated { .. } => Some(0),
            Self::Moves { dimension, .. } => Some(*dimension),
            Self::Confined { .. } | Self::Undecided => None,
        }
    }
}

/// A motion that leaves the pose: one of its poses, and the pose slightly further on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Departure {
    pub(super) from: Pose,
    pub(super) to: Pose,
}

/// Whether the platform can leave the pose with its leg lengths there.
#[must_use]
pub fn motion_at(m: &Manipulator, pose: &Pose, seed: u64) -> AtPose {
    leaving(m, pose, seed).0
}

/// The result with the motions found.
pub(super) fn leaving(m: &Manipulator, pose: &Pose, seed: u64) -> (AtPose, Vec<Departure>) {
    let local = LegsAtPose::new(m, pose);
    let undecided = |values: [f64; 6], tangent_dimension: usize| AtPose {
        tangent_dimension,
        singular_values: values,
        verdict: PoseVerdict::Undecided,
    };
    let Some(split) = LineVectors::of(&local.lines()) else { return (undecided([0.0; 6], 6), Vec::new()) };
    let k = split.corank();
    let mut at = undecided(split.values, k);
    let rank = if k == 0 { None } else { exact_rank(m, pose) };
    let constant = if k == 0 { None } else { constant_rank(m, &local, &split, rank) };
    if constant.is_none()
        && let Some(cleared) = cleared(&local, &split, k)
    {
        at.verdict = cleared.verdict(k, rank);
        return (at, Vec::new());
    }
    let search = MotionSearch::new(&local);
    let arcs = search.arcs(&split, k.max(1), &mut Rng::new(seed));
    let sampled = arcs.iter().map(|arc| search.dimension(arc, &mut Rng::new(seed))).max().unwrap_or(0);
    // no motion has more freedoms than the first order at the pose
    let sampled = sampled.min(k);
    let reach = arcs.iter().map(Arc::reach).fold(0.0, f64::max);
    if let Some(rank) = constant {
        at.verdict =
            PoseVerdict::Moves { dimension: 6 - rank, reach, evidence: MotionEvidence::ConstantRank };
    } else if joints_on_a_line(m) {
        at.verdict =
            PoseVerdict::Moves { dimension: sampled.max(1), reach, evidence: MotionEvidence::CommonLine };
    } else if sampled > 0 {
        at.verdict = PoseVerdict::Moves { dimension: sampled, reach, evidence: MotionEvidence::Traced };
    }
    let departure = |arc: &Arc| {
        let [from, to] = arc.last_two().map(|x| local.displaced(&x));
        Departure { from, to }
    };
    (at, arcs.iter().map(departure).collect())
}

/// The rank of the leg lines, below six, if it is proved to be the same at the pose and at all poses around it.
///
/// The generic rank is the greatest, and the rank does not fall near a pose. The rank at the pose is the `exact` one,
/// or is proved to be at least that of the singular values, for all joints between their bounds. The generic rank is
/// that of the exact joints.
fn constant_rank(
    m: &Manipulator,
    local: &LegsAtPose,
    split: &LineVectors,
    exact: Option<usize>,
) -> Option<usize> {
    let k = split.corank();
    let rank = exact.or_else(|| Inverted::of(&local.rows(), split, k).map(|_| 6 - k)).filter(|r| *r < 6)?;
    let architecture = Architecture::of(m);
    (architecture.level.is_some() && architecture.jacobian.rank == rank).then_some(rank)
}

/// Whether all joints of a body are on one line, exactly.
fn joints_on_a_line(m: &Manipulator) -> bool {
    let on_a_line = |ends: &_, body| dimension_of_ends(ends, body).is_some_and(|dimension| dimension <= 1);
    m.exact_ends().is_some_and(|ends| Body::BOTH.into_iter().any(|body| on_a_line(&ends, body)))
}

type Vector = [Interval; 3];

/// A leg at the pose, its joints in the base frame about the mean base joint in units of the size.
struct LocalLeg {
    /// `d`.
    along: Vector,
    /// `o`.
    sum: Vector,
}

/// The legs at a pose.
struct LegsAtPose {
    legs: [LocalLeg; 6],
    pose: Pose,
    origin: Vector3<f64>,
    unit: f64,
}

fn dot(x: &[Interval], y: &[Interval]) -> Interval {
    x.iter().zip(y).fold(Interval::ZERO, |sum, (x, y)| sum + *x * *y)
}

fn middle(x: Interval) -> f64 {
    x.centre_and_radius().0
}

type Rows = [[Interval; 6]; 6];

impl LegsAtPose {
    fn new(m: &Manipulator, pose: &Pose) -> Self {
        let origin = m.mean_leg_ends()[0];
        let unit = m.size();
        let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
        let (w, v) = (Interval::from(q.w), [q.i, q.j, q.k].map(Interval::from));
        let two = Interval::from(2.0);
        let norm = w.square() + v[0].square() + v[1].square() + v[2].square();
        let over = |x: Interval, y: Interval| x.checked_div(y).unwrap_or(Interval::WHOLE);
        let leg = |i: usize| {
            let [a, b] = m.enclosed_ends(i);
            // R b = b + 2 (w (v x b) + v x (v x b)) / N, which holds for quaternions of any norm
            let once = cross(&v, &b);
            let twice = cross(&v, &once);
            let base: Vector =
                std::array::from_fn(|k| over(a[k] - Interval::from(origin[k]), Interval::from(unit)));
            let end: Vector = std::array::from_fn(|k| {
                let turned = b[k] + over(two * (w * once[k] + twice[k]), norm);
                let place = Interval::from(pose.position[k]) - Interval::from(origin[k]);
                over(turned + place, Interval::from(unit))
            });
            LocalLeg {
                along: std::array::from_fn(|k| end[k] - base[k]),
                sum: std::array::from_fn(|k| end[k] + base[k]),
            }
        };
        Self { legs: std::array::from_fn(leg), pose: *pose, origin, unit }
    }

    /// The linear part `L`: `(d, o x d)`.
    fn rows(&self) -> Rows {
        self.legs.each_ref().map(|leg| {
            let moment = cross(&leg.sum, &leg.along);
            std::array::from_fn(|k| if k < 3 { leg.along[k] } else { moment[k - 3] })
        })
    }

    fn lines(&self) -> Matrix6<f64> {
        let rows = self.rows();
        Matrix6::from_fn(|i, j| middle(rows[i][j]))
    }

    /// Symmetric matrices of the quadratic parts.
    fn forms(&self) -> [Rows; 6] {
        let half = Interval::from(0.5);
        self.legs.each_ref().map(|leg| {
            let o = &leg.sum;
            let zero = Interval::ZERO;
            // r = t + s c
            let s = [[zero, o[2], -o[1]], [-o[2], zero, o[0]], [o[1], -o[0], zero]];
            let squared = dot(&leg.along, &leg.along);
            std::array::from_fn(|i| {
                std::array::from_fn(|j| match (i < 3, j < 3) {
                    (true, true) if i == j => half,
                    (true, true) => zero,
                    (true, false) => half * s[i][j - 3],
                    (false, true) => half * s[j][i - 3],
                    (false, false) => {
                        let (i, j) = (i - 3, j - 3);
                        let columns = (0..3).fold(zero, |sum, k| sum + s[k][i] * s[k][j]);
                        let diagonal = if i == j { squared } else { zero };
                        half * (columns + leg.along[i] * leg.along[j] - diagonal)
                    }
                })
            })
        })
    }

    /// The pose displaced by `x`.
    fn displaced(&self, x: &Vector6<f64>) -> Pose {
        let (t, c) = (Vector3::new(x[0], x[1], x[2]), Vector3::new(x[3], x[4], x[5]));
        let e = Quaternion::new(1.0, c.x, c.y, c.z);
        let g = Quaternion::new(-c.dot(&t), t.x, t.y, t.z);
        let p = (g * e.conjugate() / e.norm_squared()).imag();
        let turn: Rotation3<f64> = UnitQuaternion::new_normalize(e).to_rotation_matrix();
        Pose {
            rotation: turn * self.pose.rotation,
            position: self.origin + turn * (self.pose.position - self.origin) + p * self.unit,
        }
    }
}

/// Singular vectors of the leg lines.
struct LineVectors {
    values: [f64; 6],
    left: Matrix6<f64>,
    right: Matrix6<f64>,
}

impl LineVectors {
    fn of(lines: &Matrix6<f64>) -> Option<Self> {
        let d = bounded_svd(lines)?;
        let (left, right) = (d.u?, d.v_t?.transpose());
        Some(Self { values: d.singular_values.into(), left, right })
    }

    fn corank(&self) -> usize {
        self.values.iter().filter(|s| **s <= ZERO * self.values[0]).count()
    }
}

/// A ball around the pose in which poses with its lengths are near it only.
struct Cleared {
    radius: f64,
    within: f64,
}

impl Cleared {
    /// The verdict for a pose with `k` singular values taken as zeros and the `exact` rank of the leg lines.
    ///
    /// With rank six the inverse function theorem isolates the pose. With rank `6 - k` the left vectors `W` can be
    /// taken as exact zeros, so that the error of the theorem, and with it `within`, is zero.
    fn verdict(self, k: usize, exact: Option<usize>) -> PoseVerdict {
        let Self { radius, within } = self;
        match exact {
            _ if k == 0 => PoseVerdict::Isolated { order: 1, radius, within },
            Some(rank) if rank == 6 || rank == 6 - k => PoseVerdict::Isolated { order: 2, radius, within },
            _ => PoseVerdict::Confined { radius, within },
        }
    }
}

/// The proof that poses with these lengths are near the pose only, with the last `k` singular values taken as zeros.
///
/// Let `a` be the part of a displacement in the ball along the `k` right vectors `K`, and `b` the part along the
/// others, `N`. The rows along the left vectors of `N` give `|b| <= tau |a|`. The rows along the others, `W`, give
/// `c |a|^2 <= rest |a|^2 + error |a|`, with the least norm `c` of the forms `W Q(K a)` for `|a| = 1`.
fn cleared(local: &LegsAtPose, split: &LineVectors, k: usize) -> Option<Cleared> {
    let rank = 6 - k;
    let (u, w) = (columns(&split.left, 0, rank), columns(&split.left, rank, 6));
    let (n, kernel) = (columns(&split.right, 0, rank), columns(&split.right, rank, 6));
    let rows = local.rows();
    let forms = local.forms();
    // norms of the two orthogonal matrices up to rounding
    let off = |m: &Matrix6<f64>| {
        let at = |i: usize, j: usize| {
            let sum =
                (0..6).fold(Interval::ZERO, |s, r| s + Interval::from(m[(r, i)]) * Interval::from(m[(r, j)]));
            sum - Interval::from(f64::from(u8::from(i == j)))
        };
        norm((0..6).flat_map(|i| (0..6).map(move |j| at(i, j))))
    };
    let (mu, nu) = (1.0 + off(&split.left), 1.0 + off(&split.right));
    if !(mu < 1.1 && nu < 1.1) {
        return None;
    }
    let inverse = Inverted::of(&rows, split, k)?.norm;
    let part = |left: &[Vec<f64>], right: &[Vec<f64>]| -> Vec<Interval> {
        left.iter().flat_map(|l| right.iter().map(|r| bilinear(&rows, l, r))).collect()
    };
    let first = norm(part(&u, &kernel));
    let second = norm([part(&w, &n), part(&w, &kernel)].concat());
    let quadratic = norm(forms.iter().flatten().flatten().copied());
    let reach = norm(local.legs.iter().flat_map(|leg| leg.along));
    let c = if k == 0 { 0.0 } else { SecondOrderForms::new(&forms, &w, &kernel).least()? };
    let mut radius = 0.25;
    for _ in 0..40 {
        // |m k + m^2 / 2| <= (|d| / 2 + r / 8) r |x|^2 for |x| <= r
        let cubic = 0.5 * reach + 0.125 * radius * 6.0_f64.sqrt();
        let rho = mu * nu * (quadratic + cubic * radius) * radius;
        if inverse * rho < 0.5 {
            let tau = inverse * (first + rho) / (1.0 - inverse * rho);
            let rest = mu
                * nu
                * nu
                * (quadratic * tau * (2.0 + tau) + cubic * nu * (1.0 + tau).powi(3) * radius * nu);
            if k == 0 {
                return Some(Cleared { radius, within: 0.0 });
            }
            // factors of one part in a million cover the rounding of these bounds
            if rest * (1.0 + 1e-6) < c {
                let within =
                    nu * (1.0 + tau) * (1.0 + tau) * second / (c - rest * (1.0 + 1e-6)) * (1.0 + 1e-6);
                return (within < CLEAR * radius).then_some(Cleared { radius, within });
            }
        }
        radius *= 0.5;
    }
    None
}

fn columns(m: &Matrix6<f64>, from: usize, to: usize) -> Vec<Vec<f64>> {
    (from..to).map(|c| m.column(c).iter().copied().collect()).collect()
}

/// The part of the leg lines without the last `k` singular values, proved to be invertible.
struct Inverted {
    /// An upper bound of the norm of its inverse.
    norm: f64,
}

impl Inverted {
    fn of(rows: &Rows, split: &LineVectors, k: usize) -> Option<Self> {
        let rank = 6 - k;
        if rank == 0 {
            return Some(Self { norm: 0.0 });
        }
        let (u, n) = (columns(&split.left, 0, rank), columns(&split.right, 0, rank));
        // the diagonal matrix of singular values, up to rounding
        let entry = |i: usize, j: usize| {
            let diagonal = if i == j { split.values[i] } else { 0.0 };
            bilinear(rows, &u[i], &n[j]) - Interval::from(diagonal)
        };
        let deviation =
            norm((0..rank).flat_map(|i| (0..rank).map(move |j| (i, j))).map(|(i, j)| entry(i, j)));
        let least = split.values[rank - 1];
        // the subtraction and the division round by less than the last factor
        (deviation < 0.5 * least).then(|| Self { norm: 1.0 / (least - deviation) * (1.0 + 1e-12) })
    }
}

/// An upper bound of the root of the sum of squares.
fn norm(entries: impl IntoIterator<Item = Interval>) -> f64 {
    let sum = entries.into_iter().fold(Interval::ZERO, |sum, x| sum + x.square());
    sum.sqrt().map_or(f64::INFINITY, Interval::hi)
}

fn bilinear(m: &Rows, left: &[f64], right: &[f64]) -> Interval {
    m.iter().zip(left).fold(Interval::ZERO, |sum, (row, l)| {
        let along = row.iter().zip(right).fold(Interval::ZERO, |s, (x, r)| s + *x * Interval::from(*r));
        sum + along * Interval::from(*l)
    })
}

/// The quadratic forms `W Q(K a)` in `k` unknowns, by symmetric matrices.
struct SecondOrderForms {
    k: usize,
    matrices: Vec<Vec<Interval>>,
}

impl SecondOrderForms {
    fn new(forms: &[Rows; 6], w: &[Vec<f64>], kernel: &[Vec<f64>]) -> Self {
        let k = kernel.len();
        let mut restricted: Vec<Vec<Interval>> = Vec::new();
        for form in forms {
            let entries = (0..k * k).map(|e| bilinear(form, &kernel[e / k], &kernel[e % k]));
            restricted.push(entries.collect());
        }
        let combined = |l: &Vec<f64>| {
            let entry = |e: usize| {
                restricted.iter().zip(l).fold(Interval::ZERO, |s, (f, x)| s + f[e] * Interval::from(*x))
            };
            (0..k * k).map(entry).collect()
        };
        Self { k, matrices: w.iter().map(combined).collect() }
    }

    /// The values in doubles.
    fn at(&self, a: &[f64]) -> Vec<f64> {
        let k = self.k;
        let value = |m: &Vec<Interval>| (0..k * k).map(|e| middle(m[e]) * a[e / k] * a[e % k]).sum();
        self.matrices.iter().map(value).collect()
    }

    /// A lower bound of their norm on the unit sphere; `None` unless a positive one is proved.
    ///
    /// The faces of a cube cover the sphere; their boxes are halved. On each box the bound is that of the combination
    /// with the greatest value at its middle.
    fn least(&self) -> Option<f64> {
        let k = self.k;
        let size = norm(self.matrices.iter().flatten().copied());
        let mut boxes: Vec<Vec<[f64; 2]>> = (0..k)
            .map(|face| (0..k).map(|j| if j == face { [1.0, 1.0] } else { [-1.0, 1.0] }).collect())
            .collect();
        let mut least = f64::INFINITY;
        let mut examined = 0;
        while let Some(cell) = boxes.pop() {
            examined += 1;
            if examined > BOXES {
                return None;
            }
            let middle: Vec<f64> = cell.iter().map(|x| 0.5 * (x[0] + x[1])).collect();
            let values = self.at(&middle);
            let length = values.iter().map(|x| x * x).sum::<f64>().sqrt();
            // a zero of the forms within the accuracy of doubles: nothing can be proved
            if !(length > 1e-7 * size) {
                return None;
            }
            let weights: Vec<f64> = values.iter().map(|x| x / length).collect();
            let scale = norm(weights.iter().map(|x| Interval::from(*x)));
            let norm_squared =
                norm(cell.iter().map(|x| Interval::new(x[0], x[1]).unwrap_or(Interval::WHOLE))).powi(2);
            let bound = self.bound(&cell, &middle, &weights).lo() / (scale * norm_squared) * (1.0 - 1e-12);
            if bound > 0.25 * length / norm_squared {
                least = least.min(bound);
                continue;
            }
            let widest =
                (0..k).max_by(|i, j| (cell[*i][1] - cell[*i][0]).total_cmp(&(cell[*j][1] - cell[*j][0])))?;
            for half in [[cell[widest][0], middle[widest]], [middle[widest], cell[widest][1]]] {
                let mut next = cell.clone();
                next[widest] = half;
                boxes.push(next);
            }
        }
        (least > 0.0 && least.is_finite()).then_some(least)
    }

    /// Encloses a combination of the forms on a box: `G(m, m) + (2 G m + G (x - m)).(x - m)`.
    fn bound(&self, cell: &[[f64; 2]], middle: &[f64], weights: &[f64]) -> Interval {
        let k = self.k;
        let entry = |e: usize| {
            self.matrices.iter().zip(weights).fold(Interval::ZERO, |s, (m, w)| s + m[e] * Interval::from(*w))
        };
        let g: Vec<Interval> = (0..k * k).map(entry).collect();
        let m: Vec<Interval> = middle.iter().map(|x| Interval::from(*x)).collect();
        let delta: Vec<Interval> = cell
            .iter()
            .zip(&m)
            .map(|(x, m)| Interval::new(x[0], x[1]).unwrap_or(Interval::WHOLE) - *m)
            .collect();
        let row = |i: usize, x: &[Interval]| dot(&g[i * k..(i + 1) * k], x);
        let value = (0..k).fold(Interval::ZERO, |s, i| s + row(i, &m) * m[i]);
        (0..k).fold(value, |s, i| s + (row(i, &m) + row(i, &m) + row(i, &delta)) * delta[i])
    }
}

/// Poses found along a motion, by their displacement, each about twice as far as the last.
struct Arc {
    points: Vec<Vector6<f64>>,
}

impl Arc {
    fn reach(&self) -> f64 {
        self.points.last().map_or(0.0, Vector6::norm)
    }

    fn last_two(&self) -> [Vector6<f64>; 2] {
        let n = self.points.len();
        [self.points[n.saturating_sub(2)], self.points[n - 1]]
    }
}

/// Search for motions in doubles.
struct MotionSearch<'a> {
    local: &'a LegsAtPose,
    along: [Vector3<f64>; 6],
    sum: [Vector3<f64>; 6],
    tolerance: f64,
}

impl<'a> MotionSearch<'a> {
    fn new(local: &'a LegsAtPose) -> Self {
        let vector = |x: &Vector| Vector3::from(x.map(middle));
        let along = local.legs.each_ref().map(|leg| vector(&leg.along));
        let sum = local.legs.each_ref().map(|leg| vector(&leg.sum));
        let far = along.iter().chain(&sum).map(Vector3::norm).fold(1.0, f64::max);
        Self { local, along, sum, tolerance: RESIDUAL * far * far }
    }

    /// `f` and its derivatives.
    fn equations(&self, x: &Vector6<f64>) -> (Vector6<f64>, Matrix6<f64>) {
        let (t, c) = (Vector3::new(x[0], x[1], x[2]), Vector3::new(x[3], x[4], x[5]));
        let (mut f, mut j) = (Vector6::zeros(), Matrix6::zeros());
        let m = c.dot(&t);
        for i in 0..6 {
            let (d, o) = (self.along[i], self.sum[i]);
            let r = t - o.cross(&c);
            let k = d.dot(&c);
            f[i] = d.dot(&r)
                + 0.5 * (r.norm_squared() + k * k - d.norm_squared() * c.norm_squared())
                + m * k
                + 0.5 * m * m;
            let by_t = d + r + c * (k + m);
            let by_c = o.cross(&(d + r)) + (d + t) * (k + m) - c * d.norm_squared();
            for e in 0..3 {
                j[(i, e)] = by_t[e];
                j[(i, e + 3)] = by_c[e];
            }
        }
        (f, j)
    }

    /// The nearest zero by Gauss-Newton steps, at the distance `h` along `n` if given.
    ///
    /// On sets of poses that are zeros of higher multiplicity every step halves the error.
    fn corrected(&self, start: &Vector6<f64>, plane: Option<(&Vector6<f64>, f64)>) -> Option<Vector6<f64>> {
        let mut x = *start;
        let most = 0.3 * start.norm().max(NEARBY);
        let mut best: Option<(f64, Vector6<f64>)> = None;
        let mut waited = 0;
        for _ in 0..80 {
            let (f, j) = self.equations(&x);
            let mut values = SVector::<f64, 7>::zeros();
            let mut rows = SMatrix::<f64, 7, 6>::zeros();
            values.fixed_rows_mut::<6>(0).copy_from(&f);
            rows.fixed_view_mut::<6, 6>(0, 0).copy_from(&j);
            if let Some((n, h)) = plane {
                values[6] = n.dot(&x) - h;
                rows.set_row(6, &n.transpose());
            }
            let residual = values.norm();
            if best.is_none_or(|b| residual < 0.7 * b.0) {
                (best, waited) = (Some((residual, x)), 0);
            } else {
                waited += 1;
            }
            if residual == 0.0 || waited > 6 {
                break;
            }
            let d = bounded_svd(&rows)?;
            let (u, v_t) = (d.u?, d.v_t?);
            let mut step = Vector6::zeros();
            for k in 0..6 {
                let s = d.singular_values[k];
                if s > ZERO * d.singular_values[0] {
                    step += v_t.row(k).transpose() * (u.column(k).dot(&values) / s);
                }
            }
            let length = step.norm();
            x -= step * (most / length.max(most));
        }
        best.filter(|b| b.0 <= self.tolerance).map(|b| b.1)
    }

    /// Motions that leave the pose, one for each direction found.
    fn arcs(&self, split: &LineVectors, k: usize, rng: &mut Rng) -> Vec<Arc> {
        let mut arcs: Vec<Arc> = Vec::new();
        for direction in self.directions(split, k, rng) {
            let Some(first) = self.corrected(&(direction * FIRST), Some((&direction, FIRST))) else {
                continue;
            };
            let heading = first.normalize();
            let known = |arc: &Arc| arc.points[0].normalize().dot(&heading) > 0.99;
            if arcs.iter().any(known) || heading.dot(&direction) < 0.3 {
                continue;
            }
            let mut points = vec![first];
            while points.len() < RUNGS {
                let Some(last) = points.last().copied() else { break };
                let (n, h) = (last.normalize(), 2.0 * last.norm());
                match self.corrected(&(n * h), Some((&n, h))) {
                    Some(next) if next.normalize().dot(&n) > 0.8 => points.push(next),
                    _ => break,
                }
            }
            if points.len() >= REQUIRED {
                arcs.push(Arc { points });
            }
            if arcs.len() >= ARCS {
                break;
            }
        }
        arcs
    }

    /// First-order directions for the search: zeros of the forms of second order, and random ones.
    fn directions(&self, split: &LineVectors, k: usize, rng: &mut Rng) -> Vec<Vector6<f64>> {
        let kernel = columns(&split.right, 6 - k, 6);
        let in_space = |a: &[f64]| -> Vector6<f64> {
            kernel
                .iter()
                .zip(a)
                .fold(Vector6::zeros(), |s, (v, a)| s + Vector6::from_column_slice(v) * *a)
                .normalize()
        };
        if k == 1 {
            return vec![in_space(&[1.0]), in_space(&[-1.0])];
        }
        let forms = SecondOrderForms::new(&self.local.forms(), &columns(&split.left, 6 - k, 6), &kernel);
        let mut out = Vec::new();
        for _ in 0..12 * k {
            let mut a: Vec<f64> = (0..k).map(|_| rng.normal()).collect();
            if rng.unit() < 0.8 {
                forms.towards_zero(&mut a);
            }
            let direction = in_space(&a);
            if direction.iter().all(|x| x.is_finite()) {
                out.push(direction);
                out.push(-direction);
            }
        }
        out
    }

    /// Dimension of the set of poses at the end of an arc: the span of its poses nearest to random nearby poses.
    fn dimension(&self, arc: &Arc, rng: &mut Rng) -> usize {
        const SAMPLES: usize = 18;
        let [_, at] = arc.last_two();
        let mut rows: Vec<f64> = Vec::new();
        for _ in 0..SAMPLES {
            let aside = Vector6::from_fn(|_, _| rng.normal()).normalize() * NEARBY;
            // a large correction gives no information about this place
            let near = |on: &Vector6<f64>| (on - at).norm() < 5.0 * NEARBY;
            if let Some(on) = self.corrected(&(at + aside), None).filter(near) {
                rows.extend((on - at).iter().map(|x| x / NEARBY));
            }
        }
        let count = rows.len() / 6;
        let matrix = DMatrix::from_row_slice(count, 6, &rows) / (count.max(1) as f64 / 6.0).sqrt();
        let Some(d) = bounded_svd(&matrix).filter(|_| count > 6) else { return 0 };
        d.singular_values.iter().filter(|s| **s > SPANNED).count()
    }
}

impl SecondOrderForms {
    /// Moves from `a` to a zero of the forms on the unit sphere by Gauss-Newton steps, or to a small value if there is
    /// none.
    fn towards_zero(&self, a: &mut [f64]) {
        let k = self.k;
        for _ in 0..40 {
            let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
            for x in a.iter_mut() {
                *x /= length;
            }
            let values = self.at(a);
            let rows = DMatrix::from_fn(k + 1, k, |i, j| {
                if i == k {
                    return a[j];
                }
                2.0 * (0..k).map(|e| middle(self.matrices[i][j * k + e]) * a[e]).sum::<f64>()
            });
            let Some(d) = bounded_svd(&rows) else { return };
            let (Some(u), Some(v_t)) = (&d.u, &d.v_t) else { return };
            for (c, s) in d.singular_values.iter().enumerate() {
                if *s > 1e-7 * d.singular_values[0] {
                    let along: f64 = (0..k).map(|i| u[(i, c)] * values[i]).sum::<f64>() / s;
                    for (j, x) in a.iter_mut().enumerate() {
                        *x -= v_t[(c, j)] * along.clamp(-0.5, 0.5);
                    }
                }
            }
        }
    }
}
