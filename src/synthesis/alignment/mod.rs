//! Finds the rigid motions of the base frame and of the platform frame under which one design is equivalent to another.
//!
//! Equivalence depends only on the span `L` of the leg vectors. From `L` the module computes origins of the bodies, by
//! least-squares problems invariant under rotations. Their axes are principal axes of matrices formed from the
//! projector on `L`. These leave finitely many possible pairs of motions, or families of them. See
//! `docs/theory/alignment.md`.

mod leg_space;
mod outcome;
mod rotations;
#[cfg(test)]
mod tests;

pub use outcome::{
    Alignment, AlignmentUndecided, AlignmentWord, Difference, Invariant, Motion, NearestMotion,
};

use nalgebra::{Point3, Rotation3, Vector3};

use self::leg_space::{Canonical, ShiftSensitivity};
use self::rotations::{MotionPair, refine};
use super::leg_map::{LegMapTolerances, Relation, leg_map};
use super::leg_vector::Normalisation;
use num::linalg::LinalgError;
use platform::geom::Pose;
use platform::manipulator::{InvalidManipulator, Manipulator};

/// Singular values of unit vectors below this count as zero.
const TOLERANCE: f64 = 1e-9;
/// Differences of invariants must exceed first-order error bounds by this factor.
const SAFETY: f64 = 1e3;
/// Decisions on dimensions are clear if the singular values have this distance from the tolerance.
const CLEAR: (f64, f64) = (1e-7, 1e-11);
/// Two motions closer than this count as one.
const SAME: f64 = 1e-6;

/// All pairs of rigid motions (of the base frame, of the platform frame) that make `b` equivalent to `a`.
///
/// A pair takes a joint `x` of the base of `b` to `R x + p`, and likewise on the platform. Units must be the same; no
/// body is reflected. The legs may be in any order. A continuous family of such pairs is represented by one of its
/// members.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub fn align(a: &Manipulator, b: &Manipulator, seed: u64) -> Result<Alignment, LinalgError> {
    let units = Normalisation::of(a);
    let (of_a, of_b) = (Canonical::of(a, &units)?, Canonical::of(b, &units)?);
    if of_a.span.dimensions != of_b.span.dimensions {
        return Ok(outcome::dimensions_differ(&of_a, &of_b));
    }
    let given = leg_map(a, b, LegMapTolerances::default())?;
    let here = Pose { rotation: Rotation3::identity(), position: Vector3::zeros() };
    let (distance, candidates) = of_a.nearest(&of_b, seed);
    let mut motions: Vec<Motion> = Vec::new();
    let mut nearest: Option<NearestMotion> = None;
    let mut freedom = 0;
    for turns in &candidates.turns {
        let fit = refine(&of_a.span.space, &of_b.centred_legs(), turns)?;
        let (base, platform) = in_frames(&fit, &of_a, &of_b);
        let at_home = Motion { base, platform, map: given.clone() };
        // the given b is compared exactly; moved joints are known only up to rounding
        let (base, platform, map) =
            if at_home.extent(a.size()) < SAME && given.relation != Relation::Unrelated {
                (here, here, given.clone())
            } else {
                let Ok(moved) = transformed(b, &base, &platform) else {
                    continue; // coordinates beyond the range of doubles
                };
                let found = leg_map(a, &moved, LegMapTolerances::default())?;
                (base, platform, found.of_moved(given.relation == Relation::Singular))
            };
        let motion = NearestMotion { base, platform, residual: map.residual };
        if nearest.as_ref().is_none_or(|n| motion.residual < n.residual) {
            nearest = Some(motion);
        }
        let related = map.holds_within_rounding;
        if related && !motions.iter().any(|m| m.is_near(&base, &platform)) {
            freedom = freedom.max(fit.freedom);
            motions.push(Motion { base, platform, map });
        }
    }
    if !motions.is_empty() {
        motions.sort_by(|x, y| x.extent(a.size()).total_cmp(&y.extent(a.size())));
        if !candidates.complete && freedom > 0 {
            motions.truncate(1); // the search finds the same family repeatedly
        }
        return Ok(Alignment::Found { motions, all: candidates.complete, freedom });
    }
    let bounds = RoundingBounds::of(&of_a, &of_b, [a, b], seed)?;
    Ok(outcome::none_found(&of_a, &of_b, candidates.complete.then_some(distance), &bounds, nearest))
}

/// First-order bounds, with a factor for safety, of the errors of invariants that come from the rounding of the joints.
struct RoundingBounds {
    values: [f64; 6],
    distance: f64,
}

impl RoundingBounds {
    fn of(a: &Canonical, b: &Canonical, designs: [&Manipulator; 2], seed: u64) -> Result<Self, LinalgError> {
        let one = |c: &Canonical, m: &Manipulator| -> Result<(ShiftSensitivity, f64, f64), LinalgError> {
            let far = |points: &[Point3<f64>], unit: f64| {
                points.iter().map(|p| p.coords.amax()).fold(0.0, f64::max) / unit
            };
            let n = c.normalisation;
            let reach = far(m.base_joints(), n.base_unit).max(far(m.platform_joints(), n.platform_unit));
            // about distant origins the entries of a leg vector grow with the square of the distance
            let origins = 1.0 + c.span.shift.0.norm() + c.span.shift.1.norm();
            let rounding = SAFETY * f64::EPSILON;
            Ok((c.sensitivity(seed)?, rounding * (8.0 + reach), rounding * origins * origins))
        };
        let ((x, dx, ox), (y, dy, oy)) = (one(a, designs[0])?, one(b, designs[1])?);
        let bound = |x: f64, y: f64| (1.0 + x) * dx + (1.0 + y) * dy + ox + oy;
        let values = std::array::from_fn(|k| bound(x.values[k], y.values[k]));
        Ok(Self { values, distance: bound(x.distance, y.distance) })
    }
}

/// The motions of a fit in the frames and units of the designs.
fn in_frames(fit: &MotionPair, a: &Canonical, b: &Canonical) -> (Pose, Pose) {
    let pose = |fit: &Pose, unit: f64, from: (Point3<f64>, Vector3<f64>), to: (Point3<f64>, Vector3<f64>)| {
        let r = fit.rotation;
        let position = to.0.coords + (r * from.1 + fit.position - to.1) * unit - r * from.0.coords;
        Pose { rotation: r, position }
    };
    let (na, nb) = (a.normalisation, b.normalisation);
    let (sa, sb) = (a.span.shift, b.span.shift);
    let base = pose(&fit.base, na.base_unit, (nb.base_centre, sb.0), (na.base_centre, sa.0));
    let platform =
        pose(&fit.platform, na.platform_unit, (nb.platform_centre, sb.1), (na.platform_centre, sa.1));
    (base, platform)
}

/// The design with every base joint moved by `base` and every platform joint by `platform`.
///
/// # Errors
/// When a coordinate overflows.
pub fn transformed(m: &Manipulator, base: &Pose, platform: &Pose) -> Result<Manipulator, InvalidManipulator> {
    let along = |points: &[Point3<f64>], motion: &Pose| points.iter().map(|p| motion.transform(p)).collect();
    Manipulator::try_new(along(m.base_joints(), base), along(m.platform_joints(), platform), m.pairs())
}

/// The same legs with base and platform exchanged: its poses are the inverse poses.
#[must_use]
pub fn exchanged(m: &Manipulator) -> Manipulator {
    m.exchanged()
}

/// Both bodies mirrored in the plane `z = 0` of their frames.
#[must_use]
pub fn mirrored(m: &Manipulator) -> Manipulator {
    let image = |points: &[Point3<f64>]| points.iter().map(|p| Point3::new(p.x, p.y, -p.z)).collect();
    Manipulator::try_new(image(m.base_joints()), image(m.platform_joints()), m.pairs())
        .unwrap_or_else(|_| unreachable!("a reflection keeps joints finite and the size"))
}
