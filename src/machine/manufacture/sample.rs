//! The sample poses of a workspace with their sensitivities, and the worst of them.

use nalgebra::{Matrix3, Point3, Vector6};
use thiserror::Error;

use super::sensitivity::Sensitivity;
use crate::requirements::PoseSpace;
use num::Purpose;
use platform::geom::Pose;
use platform::manipulator::{Manipulator, jacobian};

/// Bounds of the error of the computed pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorBound {
    /// Error of the tool point, design units, positive.
    pub position: f64,
    /// Angle of rotation, degrees, positive.
    pub rotation_deg: f64,
}

num::answer_words! {
    /// The kind of a pose error.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    pub enum ErrorKind as name {
        /// Error of the tool point.
        Position = "position",
        /// Error of the orientation.
        Rotation = "rotation",
    }
}

/// The sampled poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseSearch {
    /// Points of a Halton sequence in the region of poses, and as many random ones.
    pub points: usize,
    /// Steps between two poses of a trajectory.
    pub steps: usize,
    /// Local searches for the worst pose, from the worst poses found.
    pub searches: usize,
    /// Seed of the random poses.
    pub seed: u64,
}

impl Default for PoseSearch {
    fn default() -> Self {
        Self { points: 300, steps: 10, searches: 3, seed: 1 }
    }
}

impl PoseSearch {
    /// The poses: the corners and a sample of the region, and those that are listed.
    #[must_use]
    pub fn poses(&self, space: &PoseSpace) -> Vec<Pose> {
        let mut rng = Purpose::TOLERANCE_POSES.rng(self.seed);
        let region = space.cube_points(self.points, &mut rng).into_iter().map(|x| space.pose(&x));
        region.chain(space.listed(self.steps)).collect()
    }
}

/// Reasons why no tolerance can be given.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ToleranceError {
    /// At a singular pose no error of the joints is small enough.
    #[error("the workspace contains a singular pose, where the pose error has no bound")]
    SingularPose {
        /// The pose.
        pose: Pose,
    },
    /// The determinant of the Jacobian has both signs: a singular surface divides the workspace.
    #[error("det J has both signs in the workspace: a singular surface runs through it")]
    SingularBetween {
        /// A pose on each side.
        poses: Box<[Pose; 2]>,
    },
    /// A bound is not a positive number.
    #[error("the bound on the {} is {value}; it must be positive and finite", kind.name())]
    BadBound {
        /// The bound.
        kind: ErrorKind,
        /// Its value.
        value: f64,
    },
}

impl ErrorBound {
    pub(super) fn validate(&self) -> Result<(), ToleranceError> {
        for (kind, value) in [(ErrorKind::Position, self.position), (ErrorKind::Rotation, self.rotation_deg)]
        {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ToleranceError::BadBound { kind, value });
            }
        }
        Ok(())
    }
}

/// `G_j` divided by the bound, of position and rotation: an error at the bound has norm 1.
pub(super) type Shares = [Vec<Matrix3<f64>>; 2];

/// A pose with the effects of joint errors there.
#[derive(Debug, Clone)]
pub(super) struct SampleEntry {
    pub(super) pose: Pose,
    cube: Option<Vector6<f64>>,
    pub(super) shares: Shares,
}

/// The poses of a workspace.
#[derive(Debug)]
pub(super) struct PoseSample<'a> {
    m: &'a Manipulator,
    space: &'a PoseSpace,
    tool: Point3<f64>,
    bound: ErrorBound,
    searches: usize,
    pub(super) entries: Vec<SampleEntry>,
}

impl<'a> PoseSample<'a> {
    pub(super) fn new(
        m: &'a Manipulator,
        space: &'a PoseSpace,
        tool: Point3<f64>,
        bound: ErrorBound,
        search: &PoseSearch,
    ) -> Result<Self, ToleranceError> {
        bound.validate()?;
        let mut rng = Purpose::TOLERANCE_POSES.rng(search.seed);
        let cube = space.cube_points(search.points, &mut rng);
        let poses = cube.into_iter().map(|x| (Some(x), space.pose(&x)));
        let poses = poses.chain(space.listed(search.steps).into_iter().map(|p| (None, p)));
        let mut out = Self { m, space, tool, bound, searches: search.searches, entries: Vec::new() };
        let mut first: Option<(f64, Pose)> = None;
        for (cube, pose) in poses {
            let Some(shares) = out.shares(&pose) else { return Err(ToleranceError::SingularPose { pose }) };
            let sign = jacobian(m, &pose, m.size()).determinant().signum();
            let (known, other) = *first.get_or_insert((sign, pose));
            if known * sign < 0.0 {
                return Err(ToleranceError::SingularBetween { poses: Box::new([other, pose]) });
            }
            out.entries.push(SampleEntry { pose, cube, shares });
        }
        Ok(out)
    }

    fn shares(&self, pose: &Pose) -> Option<Shares> {
        let s = Sensitivity::at(self.m, pose, &self.tool)?;
        let over = |g: Vec<Matrix3<f64>>, by: f64| g.into_iter().map(|g| g / by).collect();
        Some([over(s.position, self.bound.position), over(s.rotation, self.bound.rotation_deg.to_radians())])
    }

    /// The pose with the greatest `measure`: the greatest over the sample, improved by coordinate searches with
    /// shrinking steps.
    pub(super) fn worst(
        &self,
        measure: &dyn Fn(&Shares) -> f64,
    ) -> Result<(f64, SampleEntry), ToleranceError> {
        let mut ranked: Vec<(f64, usize)> =
            self.entries.iter().enumerate().map(|(k, e)| (measure(&e.shares), k)).collect();
        ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut best = (ranked[0].0, self.entries[ranked[0].1].clone());
        for (value, k) in ranked.iter().take(self.searches) {
            let found = self.climb(measure, *value, &self.entries[*k])?;
            if found.0 > best.0 {
                best = found;
            }
        }
        Ok(best)
    }

    fn climb(
        &self,
        measure: &dyn Fn(&Shares) -> f64,
        value: f64,
        start: &SampleEntry,
    ) -> Result<(f64, SampleEntry), ToleranceError> {
        let mut best = (value, start.clone());
        let Some(mut x) = start.cube else { return Ok(best) };
        let axes = self.space.axes();
        let mut step = 0.2;
        while step > 1e-5 {
            let mut better = false;
            for &k in &axes {
                for sign in [1.0, -1.0] {
                    let mut y = x;
                    y[k] = f64::clamp(y[k] + sign * step, -1.0, 1.0);
                    let pose = self.space.pose(&y);
                    let shares = self.shares(&pose).ok_or(ToleranceError::SingularPose { pose })?;
                    let there = measure(&shares);
                    if there > best.0 {
                        best = (there, SampleEntry { pose, cube: Some(y), shares });
                        (x, better) = (y, true);
                    }
                }
            }
            if !better {
                step *= 0.4;
            }
        }
        Ok(best)
    }
}
