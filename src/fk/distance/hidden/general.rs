//! The 6-6: a virtual leg in the place of a leg, and the closure condition as a product over the 40 poses of that
//! platform.
//!
//! All zeros of its polynomial are searched for; Newton's method on six legs carries the poses along, which also says
//! how the pose changes with one of the lengths.

use nalgebra::{SMatrix, Vector3};
use num_complex::Complex64;

use super::HiddenPoses;
use super::chebyshev::{Chebyshev, around, nodes};
use super::legs::{HiddenLeg, LegRoles, complex};
use super::roots::closure_zeros;
use crate::newton::solve;
use platform::geom::ComplexPose;

/// Poses of a 6-6.
const DEGREE: usize = 40;
/// Poses closer than this, relative to their numbers in units of the size, are one.
const SAME: f64 = 1e-6;

/// The virtual leg joins the platform joint of leg `joint` to the base joint of leg `foot`; leg `last` closes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct GeneralRoles {
    joint: usize,
    foot: usize,
    last: usize,
}

impl GeneralRoles {
    /// A few of the ways, all legs in all roles.
    pub(super) fn all() -> Vec<Self> {
        (0..6).map(|i| Self { joint: i, foot: (i + 1) % 6, last: (i + 2) % 6 }).collect()
    }

    /// The legs with the virtual one, of squared length `x`, in the place of the last.
    fn inner(&self, legs: &[HiddenLeg; 6], x: Complex64) -> [HiddenLeg; 6] {
        let mut inner = *legs;
        inner[self.last] =
            HiddenLeg { base: legs[self.foot].base, platform: legs[self.joint].platform, s: x };
        inner
    }

    /// The ways to solve that platform.
    fn roles(&self) -> [LegRoles; 4] {
        let pair = [self.joint, self.last];
        let rest: Vec<usize> = (0..6).filter(|k| !pair.contains(k)).collect();
        std::array::from_fn(|k| {
            let others = [1, 2, 3].map(|d| rest[(k + d) % 4]);
            LegRoles { exchanged: false, pair, three: others, last: rest[k] }
        })
    }
}

/// An inner pose: the gap of the last leg, and its derivative by `t`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inner {
    pub(super) pose: ComplexPose,
    pub(super) gap: Complex64,
    pub(super) slope: Complex64,
}

/// The platform with the virtual leg, `x = centre + half t`: real poses have `t` in `[-1, 1]`.
pub(super) struct Platform<'a> {
    pub(super) legs: &'a [HiddenLeg; 6],
    roles: GeneralRoles,
    centre: f64,
    half: f64,
    /// Evaluations of inner conditions.
    pub(super) evaluations: usize,
    /// Platforms asked for.
    pub(super) solved: usize,
}

impl<'a> Platform<'a> {
    pub(super) fn new(legs: &'a [HiddenLeg; 6], roles: GeneralRoles) -> Self {
        let d = (legs[roles.foot].base - legs[roles.joint].base).norm();
        let s = legs[roles.joint].s.re;
        Self { legs, roles, centre: s + d * d, half: 2.0 * s.sqrt() * d, evaluations: 0, solved: 0 }
    }

    /// `t` of a pose.
    pub(super) fn place(&self, pose: &ComplexPose) -> Complex64 {
        let x =
            HiddenLeg { s: Complex64::ZERO, ..self.roles.inner(self.legs, Complex64::ZERO)[self.roles.last] };
        let d = pose.rotation * complex(&x.platform) + pose.position - complex(&x.base);
        (d.dot(&d) - self.centre) / self.half
    }

    /// The poses, with whether they are all 40.
    pub(super) fn poses(&mut self, t: Complex64) -> (Vec<Inner>, bool) {
        self.solved += 1;
        let inner = self.roles.inner(self.legs, t * self.half + self.centre);
        let last = &self.legs[self.roles.last];
        let mut all: Vec<Inner> = Vec::new();
        for roles in self.roles.roles() {
            let Some(found) = roles.closure(&inner).and_then(|c| closure_zeros(&c)) else { continue };
            self.evaluations += found.evaluations;
            for near in found.found.iter().filter_map(|z| z.evidence.as_ref()) {
                let pose = near.best().map(|k| roles.pose(&inner, &near.joint, &near.placed[k]));
                let Some(pose) = pose.and_then(|p| refined(&inner, p, self.roles.last)) else { continue };
                if all.iter().all(|known| !same(&known.pose, &pose.pose)) {
                    let (gap, slope) = pose.gap(last);
                    all.push(Inner { pose: pose.pose, gap, slope: slope * self.half });
                }
            }
            if all.len() >= DEGREE {
                break;
            }
        }
        let complete = all.len() == DEGREE;
        (all, complete)
    }
}

/// One pose found twice, relative to its own numbers.
pub(super) fn same(known: &ComplexPose, pose: &ComplexPose) -> bool {
    let numbers = known.rotation.iter().chain(&known.position);
    let scale = numbers.map(Complex64::norm_sqr).fold(1.0, f64::max).sqrt();
    known.is_within(pose, 1.0, SAME * scale)
}

/// Steps at most.
const STEPS: usize = 8;
/// After a step below this, of the rotation and relative to the position, the next would be rounding.
const SMALL: f64 = 1e-8;

/// Steps below this that do not become smaller are rounding.
const ROUNDED: f64 = 1e-4;

/// Rotation about three axes, shift, by unit changes: the columns are right-hand sides.
type Columns = SMatrix<Complex64, 6, 2>;
type Jacobian = SMatrix<Complex64, 6, 6>;

/// A pose with its derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving {
    pub(super) pose: ComplexPose,
    /// Rotation vector and shift when the squared length of the chosen leg grows by one.
    rate: [Vector3<Complex64>; 2],
}

impl Moving {
    /// Squared length of a leg less its own, and the derivative.
    pub(super) fn gap(&self, leg: &HiddenLeg) -> (Complex64, Complex64) {
        let (arm, d) = arm_and_leg(&self.pose, leg);
        (d.dot(&d) - leg.s, d.dot(&(self.rate[0].cross(&arm) + self.rate[1])) * 2.0)
    }
}

/// The solution near a pose; `None` where the Jacobian is singular or the steps do not become small.
pub(super) fn refined(legs: &[HiddenLeg; 6], pose: ComplexPose, grows: usize) -> Option<Moving> {
    let mut pose = pose;
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let mut jacobian = Jacobian::zeros();
        let mut right = Columns::zeros();
        for (i, leg) in legs.iter().enumerate() {
            let (arm, d) = arm_and_leg(&pose, leg);
            let moment = arm.cross(&d);
            for c in 0..3 {
                jacobian[(i, c)] = moment[c] * 2.0;
                jacobian[(i, 3 + c)] = d[c] * 2.0;
            }
            right[(i, 0)] = d.dot(&d) - leg.s;
        }
        right[(grows, 1)] = Complex64::ONE;
        let x = solve(jacobian, right).filter(|x| x.iter().all(|z| z.is_finite()))?;
        let column = |c: usize| [0, 3].map(|r| Vector3::new(x[(r, c)], x[(r + 1, c)], x[(r + 2, c)]));
        let step = column(0);
        let norm = |v: &Vector3<Complex64>| v.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
        let size = norm(&step[0]).max(norm(&step[1]) / (1.0 + norm(&pose.position)));
        pose = pose.less_step(&step[0], &step[1])?;
        // the numbers of poses far out cancel: their steps end at the rounding of those
        if size < SMALL || (size < ROUNDED && size > 0.3 * before) {
            return Some(Moving { pose, rate: column(1) });
        }
        before = size;
    }
    None
}

fn arm_and_leg(pose: &ComplexPose, leg: &HiddenLeg) -> (Vector3<Complex64>, Vector3<Complex64>) {
    let arm = pose.rotation * complex(&leg.platform);
    (arm, arm + pose.position - complex(&leg.base))
}

/// Sum of the half axes of the first ellipse about the values of real poses.
const ELLIPSE: f64 = 1.8;
/// Ellipses at most.
const ELLIPSES: usize = 3;
/// Evaluations of inner conditions after which a way is given up; it takes 5,000 to 20,000 unless poses are missing.
const BUDGET: usize = 40_000;
/// Rounds over the zeros that have no pose yet.
const SWEEPS: usize = 12;
/// Starts for Newton's method from one platform.
const STARTS: usize = 8;

/// All poses of a 6-6 by one way, as far as they are found.
pub(super) fn general_poses(legs: &[HiddenLeg; 6], roles: &GeneralRoles) -> HiddenPoses {
    let mut platform = Platform::new(legs, *roles);
    let mut search =
        BlockSearch { zeros: vec![Complex64::ZERO; DEGREE], settled: [false; DEGREE], poses: Vec::new() };
    let (zeros, excess) = search.interpolate(&mut platform);
    search.begin(&platform, zeros);
    for _ in 0..SWEEPS {
        for k in 0..DEGREE {
            if !search.settled[k] && search.poses.len() < DEGREE && platform.evaluations < BUDGET {
                search.visit(&mut platform, k);
            }
        }
    }
    HiddenPoses {
        settled: search.poses.len(),
        poses: search.poses.into_iter().map(Some).collect(),
        evaluations: platform.evaluations,
        platforms: platform.solved,
        excess,
    }
}

/// Zeros of the polynomial, from its coefficients at first, and the poses found at them.
struct BlockSearch {
    zeros: Vec<Complex64>,
    settled: [bool; DEGREE],
    poses: Vec<ComplexPose>,
}

impl BlockSearch {
    /// Zeros by interpolation on one ellipse or several, and the excess. It returns points of an ellipse when some
    /// platform cannot be solved or all poses are found on the way.
    fn interpolate(&mut self, platform: &mut Platform<'_>) -> (Vec<Complex64>, f64) {
        let mut best: Option<Chebyshev> = None;
        let mut radius = ELLIPSE;
        for _ in 0..ELLIPSES {
            let Some(next) = self.on_ellipse(platform, radius) else { break };
            let polynomial = best.get_or_insert_with(|| next.clone());
            polynomial.improve(&next);
            let Some(further) = polynomial.doubtful(radius) else { break };
            radius = further;
        }
        best.map_or_else(|| (around(DEGREE), f64::NAN), |p| (p.zeros(), p.excess))
    }

    /// `None` when some platform cannot be solved or all poses are found.
    fn on_ellipse(&mut self, platform: &mut Platform<'_>, radius: f64) -> Option<Chebyshev> {
        let mut values: Vec<Complex64> = Vec::with_capacity(DEGREE + 2);
        for t in nodes(DEGREE, radius) {
            let (poses, complete) = platform.poses(t);
            self.starts(platform, &poses);
            if self.poses.len() >= DEGREE || !complete || platform.evaluations > BUDGET {
                return None;
            }
            values.push(poses.iter().map(|p| p.gap).product());
        }
        Some(Chebyshev::through(&values, DEGREE, radius))
    }

    /// Gives the poses known already the nearest zeros.
    fn begin(&mut self, platform: &Platform<'_>, zeros: Vec<Complex64>) {
        self.zeros = zeros;
        self.settled = [false; DEGREE];
        for pose in std::mem::take(&mut self.poses) {
            self.assign(platform, pose);
        }
    }

    fn assign(&mut self, platform: &Platform<'_>, pose: ComplexPose) {
        self.poses.push(pose);
        let t = platform.place(&pose);
        let open = (0..DEGREE).filter(|j| !self.settled[*j]);
        let off = |j: &usize| (self.zeros[*j] - t).norm();
        if let Some(j) = open.min_by(|i, j| off(i).total_cmp(&off(j))) {
            self.zeros[j] = t;
            self.settled[j] = true;
        }
    }

    /// Starts Newton's method from the poses nearest to closing at a zero. Unless they lead to a solution for it, the
    /// zero takes an Ehrlich-Aberth step on the polynomial itself, `F'/F = sum (ds_m/dt) / (s_m - s)`.
    fn visit(&mut self, platform: &mut Platform<'_>, k: usize) {
        let t = self.zeros[k];
        let size = t.norm().max(1.0);
        let (poses, complete) = platform.poses(t);
        if self.starts(platform, &poses) > 0 && self.settled[k] {
            return;
        }
        if !complete {
            // the polynomial has no value here; a little further it may have
            self.zeros[k] = t + Complex64::new(1e-2, 7e-3) * size;
            return;
        }
        let rate: Complex64 = poses.iter().map(|p| p.slope / p.gap).sum();
        let others = (0..DEGREE).filter(|j| *j != k).map(|j| (t - self.zeros[j]).inv());
        let step = (rate - others.filter(|q| q.is_finite()).sum::<Complex64>()).inv();
        if step.is_finite() && step.norm() < 10.0 * size {
            self.zeros[k] = t - step;
        }
    }

    /// Newton's method on the legs as they are from the poses nearest to closing; the number of new solutions.
    fn starts(&mut self, platform: &Platform<'_>, poses: &[Inner]) -> usize {
        let step = |p: &Inner| (p.gap / p.slope).norm();
        let mut nearest: Vec<&Inner> = poses.iter().collect();
        nearest.sort_by(|a, b| step(a).total_cmp(&step(b)));
        let mut new = 0;
        for start in nearest.into_iter().take(STARTS) {
            if let Some(found) = refined(platform.legs, start.pose, 0)
                && self.is_new(&found.pose)
            {
                self.settle(platform, found.pose);
                new += 1;
            }
        }
        new
    }

    fn is_new(&self, pose: &ComplexPose) -> bool {
        self.poses.iter().all(|known| !same(known, pose))
    }

    /// Takes a pose, and its conjugate, for the nearest zeros that have none.
    fn settle(&mut self, platform: &Platform<'_>, pose: ComplexPose) {
        let conjugate = ComplexPose {
            rotation: pose.rotation.map(|z| z.conj()),
            position: pose.position.map(|z| z.conj()),
        };
        for pose in [pose, conjugate] {
            if self.is_new(&pose) {
                self.assign(platform, pose);
            }
        }
    }
}
