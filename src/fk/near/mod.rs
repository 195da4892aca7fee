//! Follows one real pose from a known one, for control loops.
//!
//! The known pose `P0` is an exact solution for its own squared lengths `s(P0)`. The solver moves the squared lengths
//! along the straight line from `s(P0)` to those asked for and follows the pose. Its segments are so short that a
//! Kantorovich test, with bounds of every rounding, proves each of them free of singularities. So the answer is the
//! continuous continuation of `P0`, never another assembly mode, for every choice of joints and lengths within their
//! radii. Theory: `docs/theory/near-pose.md`.

mod local;
mod outcome;

pub use outcome::{NearEvidence, NearOutcome, NearWord, WhyLost};

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::{FkError, FkOptions, FkSolutions, ForwardKinematics, Method};
use local::{Blur, LegDefects, Newton, SegmentStart};
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, SquaredLegLengths};

/// `4 (beta + eta) eta` aimed at for every segment; the theorem needs 1.
const KANTOROVICH: f64 = 0.88;
/// The largest accepted value of that number; below 1, so that the last roundings of the test itself do not matter.
const PROVED: f64 = 1.0 - 1.0 / (1u64 << 30) as f64;
/// Newton corrections within a segment; in a Kantorovich ball five reach rounding.
const CORRECTIONS: u32 = 12;

/// Limits of a [`NearSolver`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearOptions {
    /// Below this [`NearEvidence::frobenius_ratio`] the pose counts as singular.
    pub singular: f64,
    /// Most segments the path to the new lengths is divided into. With 1 only starts in the Kantorovich ball of the new
    /// lengths are accepted.
    pub segments: u32,
}

impl Default for NearOptions {
    fn default() -> Self {
        Self { singular: 1e-6, segments: 1000 }
    }
}

/// Follows one real pose of a manipulator. Made once a design; a solve allocates nothing.
///
/// ```
/// # mod equipod {
/// #     pub use equipod_fk::*;
/// #     pub mod methods {
/// #         pub use equipod_fk as fk; pub use equipod_fk::solve;
/// #         pub use platform::{geom, manipulator};
/// #     }
/// # }
/// use equipod::methods::fk::{NearOutcome, NearSolver};
/// use equipod::methods::manipulator::{Leg, Manipulator, default_home};
/// use nalgebra::Point3;
/// let legs = std::array::from_fn(|i| {
///     let t = f64::from(i as u8);
///     let base = Point3::new(2.0 * t.cos(), 2.0 * t.sin(), 0.0);
///     Leg { base, platform: Point3::new((2.0 * t).cos(), (1.3 * t).sin(), 0.1 * t) }
/// });
/// let m = Manipulator::from_legs(legs)?;
/// let home = default_home(&m);
/// let mut moved = home;
/// moved.position.x += 0.01;
/// let s = moved.squared_lengths(&m).ok_or("overflow")?;
/// let outcome = NearSolver::new(&m).solve(&s, &home);
/// let NearOutcome::Tracked { pose, evidence } = outcome else { return Err("lost".into()) };
/// assert!((pose.position - moved.position).norm() < 1e-12);
/// assert!(evidence.residual < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct NearSolver {
    /// Base joints relative to `origin` and platform joints relative to `centre`, in units of `unit`.
    base: [[f64; 3]; 6],
    platform: [[f64; 3]; 6],
    /// Largest distances of the ends of the legs from their doubles, Euclidean norms in units of `unit`: on the base
    /// and on the platform.
    loose: [[f64; 6]; 2],
    origin: Vector3<f64>,
    centre: Vector3<f64>,
    /// Twice the RMS radius of the platform, design units.
    unit: f64,
    /// Squared unit over squared size.
    residual_scale: f64,
    options: NearOptions,
}

/// A pose in the solver's units: rotation, and position of the platform centroid relative to the base centroid.
#[derive(Debug, Clone, Copy)]
struct ScaledPose {
    rotation: [[f64; 3]; 3],
    position: [f64; 3],
}

/// The numbers of a solver, for programs that compute the same elsewhere: those of [`NearSolver`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearNumbers {
    /// Base joints relative to `origin`, in units of `unit`.
    pub base: [[f64; 3]; 6],
    /// Platform joints relative to `centre`, in units of `unit`.
    pub platform: [[f64; 3]; 6],
    /// Greatest distance of each joint of base and platform from its numbers, in units of `unit`.
    pub loose: [[f64; 6]; 2],
    /// Centroid of the base joints.
    pub origin: [f64; 3],
    /// Centroid of the platform joints.
    pub centre: [f64; 3],
    /// The unit of length.
    pub unit: f64,
    /// Divisor of residuals.
    pub residual_scale: f64,
}

/// The result of one segment.
enum Segment {
    /// The end of the path.
    Arrived(ScaledPose),
    /// A pose on the path, and the fraction of the remaining path up to it.
    Advanced(ScaledPose, f64),
    Singular,
    Stuck,
}

impl NearSolver {
    /// Prepares a design with default options.
    #[must_use]
    pub fn new(m: &Manipulator) -> Self {
        Self::with_options(m, NearOptions::default())
    }

    /// Prepares a design.
    #[must_use]
    pub fn with_options(m: &Manipulator, options: NearOptions) -> Self {
        let legs = m.legs();
        let unit = 2.0 * m.platform_rms_radius();
        let [origin, centre] = m.mean_leg_ends();
        // a coordinate is within the radius, three of them within sqrt 3 times it
        let loose = |body: Body| -> [f64; 6] { std::array::from_fn(|i| 1.75 * m.end_radius(i, body) / unit) };
        Self {
            base: legs.map(|l| ((l.base.coords - origin) / unit).into()),
            platform: legs.map(|l| ((l.platform.coords - centre) / unit).into()),
            loose: [loose(Body::Base), loose(Body::Platform)],
            origin,
            centre,
            unit,
            residual_scale: (unit / m.size()).powi(2),
            options,
        }
    }

    /// The numbers worked out for the design.
    pub fn numbers(&self) -> NearNumbers {
        NearNumbers {
            base: self.base,
            platform: self.platform,
            loose: self.loose,
            origin: self.origin.into(),
            centre: self.centre.into(),
            unit: self.unit,
            residual_scale: self.residual_scale,
        }
    }

    /// Continues the pose `start` to the squared leg lengths `s`.
    #[must_use]
    pub fn solve(&self, s: &SquaredLegLengths, start: &Pose) -> NearOutcome {
        let (target, target_error) = self.target(s);
        let from = self.place_of(start);
        let mut evidence = NearEvidence::default();
        let Some(mut place) = local::orthonormal(&from) else {
            return NearOutcome::Lost {
                pose: *start,
                reason: WhyLost::StartIsNoPose,
                fraction: 0.0,
                evidence,
            };
        };
        let mut left = 1.0;
        let (fraction, reason) = loop {
            if evidence.segments >= self.options.segments {
                break (1.0 - left, Some(WhyLost::SegmentsExhausted));
            }
            match self.segment(&target, &target_error, &place, &mut evidence) {
                Segment::Arrived(end) => {
                    place = end;
                    break (1.0, None);
                }
                Segment::Advanced(next, part) => {
                    left *= 1.0 - part;
                    place = next;
                }
                Segment::Singular => break (1.0 - left, None),
                Segment::Stuck => break (1.0 - left, Some(WhyLost::NoConvergence)),
            }
        };
        self.measure(&target, &from, &place, &mut evidence);
        let pose = self.pose_of(&place);
        let singular = !(evidence.frobenius_ratio >= self.options.singular);
        match reason {
            Some(reason) if !singular => NearOutcome::Lost { pose, reason, fraction, evidence },
            // bounds without end, of squares that nothing is known of, stop a segment where the pose itself is regular
            None if !singular && fraction >= 1.0 => NearOutcome::Tracked { pose, evidence },
            _ => NearOutcome::NearSingularity { pose, fraction, evidence },
        }
    }

    /// Squared lengths in the solver's units, and bounds of their distances from those asked for. The bounds cover
    /// three roundings and the part of two doubles beyond one.
    fn target(&self, s: &SquaredLegLengths) -> ([f64; 6], [f64; 6]) {
        let scale = (self.unit * self.unit).recip();
        let target = s.get().map(|s| s * scale);
        let error = std::array::from_fn(|i| {
            (4.0 * f64::EPSILON * target[i] + s.radius()[i] * scale) * (1.0 + 1e-9) + f64::MIN_POSITIVE
        });
        (target, error)
    }

    /// Makes `steps` plain Newton steps on the leg equations from `start`, without a check for convergence. The start
    /// has to be so near to the pose that each step squares its error. `None` when `start` is not a pose or singular.
    #[must_use]
    pub fn newton_steps(&self, s: &SquaredLegLengths, start: &Pose, steps: u32) -> Option<Pose> {
        let (target, _) = self.target(s);
        let mut place = local::orthonormal(&self.place_of(start))?;
        for _ in 0..steps {
            place = LegDefects::at(self, &place, &target).newton()?.applied_to(&place);
        }
        Some(self.pose_of(&place))
    }

    /// One segment from `place` towards `target`, as far as the Kantorovich test proves it free of singularities.
    fn segment(
        &self,
        target: &[f64; 6],
        target_error: &[f64; 6],
        place: &ScaledPose,
        evidence: &mut NearEvidence,
    ) -> Segment {
        let here = LegDefects::at(self, place, target);
        let blur = Blur::of(self, place, &here, target_error);
        let Some(start) = SegmentStart::of(&here, &blur) else { return Segment::Singular };
        if !(start.frobenius_ratio >= self.options.singular) {
            return Segment::Singular;
        }
        let number = 4.0 * (start.beta + start.eta) * start.eta;
        if number <= KANTOROVICH {
            evidence.accept(number);
            return self
                .correct(target, place, &start, 1.0, evidence)
                .map_or(Segment::Stuck, Segment::Arrived);
        }
        // eta scales with the part taken; 4 (beta + x) x <= 0.88 for x = 0.22 / (beta + 0.22), as beta >= 1
        let part = 0.22 / ((start.beta + 0.22) * start.eta);
        if !(part > 0.0) {
            return Segment::Stuck;
        }
        let part = part.min(1.0);
        let between = here.squares_after(part);
        // of the path itself, whose beginning and end are known to rounding
        let eta = part * start.eta + start.slack;
        let number = 4.0 * (start.beta + eta) * eta;
        if !(number <= PROVED) {
            return Segment::Stuck;
        }
        evidence.accept(number);
        self.correct(&between, place, &start, part, evidence)
            .map_or(Segment::Stuck, |next| Segment::Advanced(next, part))
    }

    /// Newton's method to the root for `target` in the Kantorovich ball about `from`; `None` when it ends elsewhere.
    fn correct(
        &self,
        target: &[f64; 6],
        from: &ScaledPose,
        start: &SegmentStart,
        part: f64,
        evidence: &mut NearEvidence,
    ) -> Option<ScaledPose> {
        let beta = start.beta + part * start.eta + start.slack;
        let mut newton = Newton { step: start.step.map(|x| part * x) };
        let mut place = *from;
        for _ in 0..CORRECTIONS {
            let size = newton.size();
            if !(size > 0.0) {
                break;
            }
            place = newton.applied_to(&place);
            evidence.newton_steps += 1;
            // the error left is at most 2 beta size^2 (with the Jacobian of the start: of this order)
            if 4.0 * beta * size * size < 1e-18 {
                break;
            }
            newton = LegDefects::at(self, &place, target).newton()?;
        }
        let radius = local::distance(from, &place, start.epsilon);
        // rounding of the distance is some twenty units in the last place of its terms, over epsilon at most
        let rounding =
            1e-14 * (1.0 + from.position.iter().chain(&place.position).fold(0.0, |m: f64, x| m.max(x.abs())));
        (2.0 * beta * (radius + rounding / start.epsilon) <= PROVED).then_some(place)
    }

    /// Residual, condition and distance at the end.
    fn measure(&self, target: &[f64; 6], from: &ScaledPose, place: &ScaledPose, evidence: &mut NearEvidence) {
        let here = LegDefects::at(self, place, target);
        evidence.residual = here.largest_defect() * self.residual_scale;
        let blur = Blur::of(self, place, &here, &[0.0; 6]);
        evidence.frobenius_ratio = SegmentStart::of(&here, &blur).map_or(0.0, |s| s.frobenius_ratio);
        let (angle, shift) = local::motion(from, place);
        evidence.angle = angle;
        evidence.distance = shift * self.unit;
    }

    fn place_of(&self, pose: &Pose) -> ScaledPose {
        let r = pose.rotation.matrix();
        let rotation = [0, 1, 2].map(|i| [r[(i, 0)], r[(i, 1)], r[(i, 2)]]);
        let position = (r * self.centre + pose.position - self.origin) / self.unit;
        ScaledPose { rotation, position: position.into() }
    }

    fn pose_of(&self, place: &ScaledPose) -> Pose {
        let r = &place.rotation;
        let matrix = Matrix3::from_fn(|i, j| r[i][j]);
        let position = Vector3::from(place.position) * self.unit + self.origin - matrix * self.centre;
        Pose { rotation: Rotation3::from_matrix_unchecked(matrix), position }
    }
}

/// [`Method::Near`] as a solver of the general kind: it cannot be one, since it needs a pose to start from.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NeedsStart;

impl ForwardKinematics for NeedsStart {
    fn method(&self) -> Method {
        Method::Near
    }

    fn solve(&self, _: &Manipulator, _: &SquaredLegLengths, _: &FkOptions) -> Result<FkSolutions, FkError> {
        let reason = "it follows one pose from a known one; see NearSolver".to_owned();
        Err(FkError::NotApplicable { method: Method::Near, reason })
    }
}

#[cfg(test)]
mod tests;
