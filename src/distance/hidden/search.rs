//! All zeros of the polynomial of a 6-6, and its poses.

use num_complex::Complex64;

use super::HiddenPoses;
use super::chebyshev::{Chebyshev, around, nodes};
use super::general::{DEGREE, GeneralRoles, Inner, Platform, same};
use super::legs::HiddenLeg;
use super::newton::refined;
use crate::geom::ComplexPose;

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
        Search { zeros: vec![Complex64::ZERO; DEGREE], settled: [false; DEGREE], poses: Vec::new() };
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
struct Search {
    zeros: Vec<Complex64>,
    settled: [bool; DEGREE],
    poses: Vec<ComplexPose>,
}

impl Search {
    /// Zeros by interpolation on one ellipse or several, and the excess; points of an ellipse when some platform cannot be solved or all poses are
    /// found on the way.
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

    /// The poses nearest to closing at a zero are starts for Newton's method; unless they lead to a solution for it, the zero takes an Ehrlich-Aberth
    /// step on the polynomial itself, `F'/F = sum (ds_m/dt) / (s_m - s)`.
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
