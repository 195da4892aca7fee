//! Follows self-motions: curves of poses with the same leg lengths.
//!
//! Poses are dual quaternions `y = (e, g)`, `g = p e`, `|e| = 1`, lengths in units of the size; `y` and `-y` are one
//! pose. On a curve of poses the equations (six legs, `e.g = 0`, `|e| = 1`) have rank 7 of 8. The curve is followed
//! along its tangent, the null vector, with Gauss-Newton corrections ([`trace`]). At a crossing with itself or another
//! curve the rank is 6, and the tangents are the real zeros of a quadratic form. Every branch is followed. Leg lengths
//! bound the position, so every real curve is a closed loop.
//!
//! [`motion_at`] first decides whether the platform moves at a pose at all.
//!
//! Tracing does not find real components that are disjoint from the curves of the given poses. For these,
//! [`critical_poses`] gives poses on all real components of the complex curves through given poses, real or complex.

mod at_pose;
mod critical;
mod slices;
mod trace;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use self::slices::{Point, SliceEquations};
use num::Rng;
use platform::geom::Pose;
use platform::manipulator::{Manipulator, SquaredLegLengths};
use trace::Tracer;

pub use self::at_pose::{AtPose, MotionEvidence, PoseVerdict, motion_at};
pub use self::slices::{CurveDegree, curve_degree};
pub use critical::{CriticalPoses, critical_poses};

/// Accuracy of the curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionOptions {
    /// Largest rotation of the tangent from point to point, radians.
    pub turn: f64,
    /// Greatest number of points of all curves together.
    pub points: usize,
    /// Seed of the random combinations of equations that detect crossings.
    pub seed: u64,
}

impl Default for MotionOptions {
    fn default() -> Self {
        Self { turn: 0.05, points: 20_000, seed: 1 }
    }
}

num::words! {
    /// The end of a curve.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum CurveEnd as name {
        /// It is a loop: the last point is followed by the first.
        Closed = "closed",
        /// It joins an earlier curve, at the crossing where it began or at another.
        Joined = "joined",
        /// The number of points allowed is used up.
        Unfinished = "unfinished",
        /// Steps became too small: a singular point that is not a simple crossing, or the limit of the numerical
        /// accuracy.
        Stuck = "stuck",
    }
}

/// A pose on a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "MotionPointRecord", transform = num::nullable))]
pub struct MotionPoint {
    /// The pose.
    #[cfg_attr(feature = "serde", serde(flatten, with = "platform::geom::ByQuaternion"))]
    pub pose: Pose,
    /// Length of the curve up to here, in (e, g / size).
    pub arc: f64,
    /// Largest error of a leg length over the size.
    pub length_error: f64,
    /// Smallest nonzero over largest singular value.
    // small near crossings
    pub gap: f64,
}

/// A crossing of a curve with others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "CurveCrossingRecord")
)]
pub struct CurveCrossing {
    /// Last point before the crossing, from 0.
    pub after_point: usize,
    /// Index into `crossings` of the answer, from 0.
    pub crossing: usize,
}

/// A curve of poses.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionCurve {
    /// Poses in order.
    pub points: Vec<MotionPoint>,
    /// Its end.
    pub end: CurveEnd,
    /// Its crossings.
    pub crossings: Vec<CurveCrossing>,
    /// Index of the given pose from which it was reached, directly or through crossings.
    pub start: usize,
}

/// All curves reached from the given poses.
#[derive(Debug, Clone, PartialEq)]
pub struct SelfMotion {
    /// The decision at the first pose; `None` without a pose.
    pub at_pose: Option<AtPose>,
    /// Singular values of the equations at the first pose, largest first.
    pub singular_values: [f64; 8],
    /// The curves; none if the dimension is not 1.
    pub curves: Vec<MotionCurve>,
    /// Poses at which curves cross.
    pub crossings: Vec<Pose>,
    /// Largest leg-length error of all points over the size.
    pub worst_length_error: f64,
}

impl SelfMotion {
    /// Dimension of the self-motion through the first pose; `None` if undecided, or without a pose.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        self.at_pose.as_ref().and_then(|at| at.verdict.dimension())
    }
}

/// Follows the curves of poses with squared lengths `s` from the given poses.
///
/// Curves are followed if the first pose is on one. A pose on a known curve adds nothing. Poses are improved to
/// rounding first. If the curve through the first pose consists of multiple zeros, no other pose is followed.
#[must_use]
pub fn self_motion(
    m: &Manipulator,
    s: &SquaredLegLengths,
    poses: &[Pose],
    options: &MotionOptions,
) -> SelfMotion {
    let equations = SliceEquations::new(m, s);
    let tracer = || Tracer::new(&equations, options, &mut Rng::new(options.seed));
    let regular = tracer();
    let starts: Vec<Point<f64>> = poses.iter().map(|p| point(p, m.size())).collect();
    let (at_pose, branches) = poses.first().map(|p| at_pose::leaving(m, p, options.seed)).unzip();
    let ways: Vec<[Point<f64>; 2]> = branches.unwrap_or_default().iter().map(|b| way(b, m.size())).collect();
    let moves = at_pose.as_ref().is_some_and(|at| at.verdict.dimension() == Some(1));
    // beside a crossing a simple curve has one null vector
    let multiple = moves && ways.iter().any(|w| regular.corank(&w[0]) > 1);
    let tracer = if multiple { tracer().of_multiple_curve() } else { regular };
    let mut state = trace::Web::new(&tracer, options.points);
    let mut origins = Vec::new();
    let meeting = starts.first().filter(|y| tracer.corank(y) > 1);
    if moves && let Some(pose) = meeting {
        if ways.len() > 2 {
            state.note_crossing(*pose);
        }
        for [at, direction] in &ways {
            state.follow_towards(at, direction);
        }
        origins.resize(state.count(), 0);
    }
    if moves && !multiple {
        for (k, start) in starts.iter().enumerate().skip(usize::from(meeting.is_some())) {
            state.follow(start);
            origins.resize(state.count(), k);
        }
    }
    let (paths, crossings) = state.finish();
    let curves: Vec<MotionCurve> = paths.iter().zip(origins).map(|(path, k)| curve(path, k, m, s)).collect();
    let errors = curves.iter().flat_map(|c| c.points.iter().map(|p| p.length_error));
    SelfMotion {
        at_pose,
        singular_values: starts.first().map_or([0.0; 8], |y| tracer.singular_values(y)),
        worst_length_error: errors.fold(0.0, f64::max),
        curves,
        crossings: crossings.iter().map(|y| pose(y, m.size())).collect(),
    }
}

/// A point of a branch, and its direction away from the pose.
fn way(branch: &at_pose::Departure, size: f64) -> [Point<f64>; 2] {
    let [from, to] = [branch.from, branch.to].map(|p| point(&p, size));
    let to = if from.dot(&to) < 0.0 { -to } else { to };
    [from, (to - from).normalize()]
}

/// A point with `|e| = 1`.
fn point(p: &Pose, size: f64) -> Point<f64> {
    let q = UnitQuaternion::from_rotation_matrix(&p.rotation);
    let place = p.position / size;
    let g = Quaternion::new(0.0, place.x, place.y, place.z) * q.quaternion();
    Point::from([q.w, q.i, q.j, q.k, g.w, g.i, g.j, g.k])
}

/// `p = g e~`.
fn pose(y: &Point<f64>, size: f64) -> Pose {
    let e = Quaternion::new(y[0], y[1], y[2], y[3]);
    let g = Quaternion::new(y[4], y[5], y[6], y[7]);
    let p = g * e.conjugate() / e.norm_squared();
    let rotation = UnitQuaternion::new_normalize(e).to_rotation_matrix();
    Pose { rotation, position: Vector3::new(p.i, p.j, p.k) * size }
}

fn curve(path: &trace::TracedCurve, start: usize, m: &Manipulator, s: &SquaredLegLengths) -> MotionCurve {
    let given = s.lengths().get();
    let mut arc = 0.0;
    let mut last: Option<Point<f64>> = None;
    let points = path.points.iter().map(|on| {
        // the sign of y is constant along a path
        arc += last.map_or(0.0, |l| (on.y - l).norm());
        last = Some(on.y);
        let pose = pose(&on.y, m.size());
        let error = |(leg, given): (&platform::manipulator::Leg, f64)| {
            ((pose.transform(&leg.platform) - leg.base).norm() - given).abs() / m.size()
        };
        let length_error = m.legs().iter().zip(given).map(error).fold(0.0, f64::max);
        MotionPoint { pose, arc, length_error, gap: on.gap }
    });
    MotionCurve { points: points.collect(), end: path.end, crossings: path.crossings.clone(), start }
}

#[cfg(test)]
mod tests;
