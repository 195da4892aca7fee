//! The 6-6: a virtual leg in the place of a leg, and the closure condition as a product over the 40 poses of that platform.

use num_complex::Complex64;

use super::circle::complex;
use super::legs::{HiddenLeg, Roles};
use super::newton::refined;
use super::roots::closure_zeros;
use crate::geom::ComplexPose;

/// Poses of a 6-6.
pub(super) const DEGREE: usize = 40;
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
    fn roles(&self) -> [Roles; 4] {
        let pair = [self.joint, self.last];
        let rest: Vec<usize> = (0..6).filter(|k| !pair.contains(k)).collect();
        std::array::from_fn(|k| {
            let others = [1, 2, 3].map(|d| rest[(k + d) % 4]);
            Roles { exchanged: false, pair, three: others, last: rest[k] }
        })
    }
}

/// An inner pose: what the last leg lacks, and how that changes with `t`.
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
