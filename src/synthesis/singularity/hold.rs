//! Decides whether the legs hold the platform at a pose and along a path of poses; all commands share this test.
//!
//! Intervals prove the sign of `det J`. If they contain zero, exact arithmetic decides for exact joints. A pose that
//! remains is singular within rounding: `det J` is not above the rounding errors of its own computation.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::path::{ControlPoint, PathPiece, Sign, SignsAlong, sign_at, signs_on_curve};
use num::elimination::{SurdArithmetic, eliminate};
use num::exact::{ExactVector, rank, rational};
use num::surd::{Surd, combination};
use platform::geom::Pose;
use platform::manipulator::{ExactEnds, Manipulator};

num::words! {
    /// The evidence that a pose is singular.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[cfg_attr(
        feature = "serde",
        derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
        serde(rename_all = "snake_case"),
        schemars(rename = "SingularEvidenceWord")
    )]
    pub enum SingularEvidence as words, Display {
        /// Proved: det J is zero in exact arithmetic on the joints and the rotation as written.
        Zero = "det J = 0, proved in exact arithmetic",
        /// det J has opposite signs before and after: proved for legs, by instants for rods on cranks.
        SignChange = "det J changes its sign there",
        /// det J is not above its rounding errors.
        Rounding = "det J = 0 to rounding",
    }
}

/// Whether the legs hold the platform at a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PoseHold {
    /// Proved: `det J` has this sign.
    Held(Sign),
    /// The pose is singular.
    Singular(SingularEvidence),
}

impl PoseHold {
    /// The evidence for a singular pose.
    #[must_use]
    pub fn singular(self) -> Option<SingularEvidence> {
        match self {
            Self::Held(_) => None,
            Self::Singular(evidence) => Some(evidence),
        }
    }
}

/// Whether the legs hold the platform at a pose. The rotation is exactly that of the rounded quaternion of the pose.
#[must_use]
pub fn hold_at(m: &Manipulator, pose: &Pose) -> PoseHold {
    if let Some(sign) = sign_at(m, pose) {
        return PoseHold::Held(sign);
    }
    match exact_rank(m, pose) {
        Some(..6) => PoseHold::Singular(SingularEvidence::Zero),
        Some(_) | None => PoseHold::Singular(SingularEvidence::Rounding),
    }
}

/// A singular pose of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularOnPath {
    /// Index of the curve.
    pub curve: usize,
    /// Parameter on the curve, from 0 to 1.
    pub at: f64,
    /// The pose there.
    pub pose: Pose,
    /// The evidence.
    pub evidence: SingularEvidence,
}

/// The first singular pose of a path of Bezier curves, each beginning at the end of the one before. `None` if every
/// pose is proved to be regular.
#[must_use]
pub fn singular_along<'a>(
    m: &Manipulator,
    curves: impl IntoIterator<Item = &'a [ControlPoint]>,
) -> Option<SingularOnPath> {
    // the sign before the open pieces, which may extend over the ends of curves, and the first of these
    let mut before = None;
    let mut open: Option<SingularOnPath> = None;
    for (curve, control) in curves.into_iter().enumerate() {
        let SignsAlong { pieces } = signs_on_curve(m, control);
        for PathPiece { from, to, sign } in pieces {
            match (sign, open) {
                (None, None) => {
                    let at = 0.5 * (from + to);
                    let pose = on_curve(control, at);
                    open = Some(SingularOnPath { curve, at, pose, evidence: SingularEvidence::Rounding });
                }
                (None, Some(_)) => {}
                (Some(after), Some(found)) => return Some(passage(m, found, before, Some(after))),
                (Some(sign), None) => before = Some(sign),
            }
        }
    }
    open.map(|found| passage(m, found, before, None))
}

fn passage(
    m: &Manipulator,
    found: SingularOnPath,
    before: Option<Sign>,
    after: Option<Sign>,
) -> SingularOnPath {
    let evidence = match (before, after) {
        (Some(x), Some(y)) if x != y => SingularEvidence::SignChange,
        _ => hold_at(m, &found.pose).singular().unwrap_or(SingularEvidence::Rounding),
    };
    SingularOnPath { evidence, ..found }
}

/// The pose of a Bezier curve at a parameter.
fn on_curve(control: &[ControlPoint], u: f64) -> Pose {
    let mut row = control.to_vec();
    while row.len() > 1 {
        row = row.windows(2).map(|w| std::array::from_fn(|k| w[0][k] * (1.0 - u) + w[1][k] * u)).collect();
    }
    let [x, y, z, w, i, j, k] = row[0];
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
    Pose { rotation: turn.to_rotation_matrix(), position: Vector3::new(x, y, z) }
}

/// The rank of the leg lines in exact arithmetic; `None` if joints are not known exactly, or numbers become too long.
pub(super) fn exact_rank(m: &Manipulator, pose: &Pose) -> Option<usize> {
    let ends = m.exact_ends()?;
    let number = |x: f64| Surd::rational(&rational(x)?);
    let position: Vec<Surd> = pose.position.iter().map(|x| number(*x)).collect::<Option<_>>()?;
    let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
    let e: Vec<Surd> = [q.w, q.i, q.j, q.k].into_iter().map(number).collect::<Option<_>>()?;
    let norm = combination(&e, &e)?;
    let cross = |x: &[Surd], y: &[Surd]| -> Option<Vec<Surd>> {
        let part = |i: usize, j: usize| x[i].times(&y[j])?.minus(&x[j].times(&y[i])?);
        Some(vec![part(1, 2)?, part(2, 0)?, part(0, 1)?])
    };
    let two = Surd::integer(2);
    let row = |[a, b]: &ExactEnds| -> Option<Vec<Surd>> {
        let once = cross(&e[1..], b)?;
        let twice = cross(&e[1..], &once)?;
        let mut line = Vec::new();
        for k in 0..3 {
            // N (p + b - a) + 2 (w (v x b) + v x (v x b))
            let turned = two.times(&e[0].times(&once[k])?.plus(&twice[k])?)?;
            line.push(norm.times(&position[k].plus(&b[k])?.minus(&a[k])?)?.plus(&turned)?);
        }
        let moment = cross(a, &line)?;
        line.extend(moment);
        Some(line)
    };
    let mut rows: Vec<Vec<Surd>> = ends.iter().map(row).collect::<Option<_>>()?;
    let fractions: Option<Vec<ExactVector>> =
        rows.iter().map(|row| row.iter().map(Surd::as_rational).collect()).collect();
    match fractions {
        Some(rows) => Some(rank(&rows)),
        None => Some(eliminate(&SurdArithmetic, &mut rows)?.len()),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix6, Point3, RowVector6};

    use super::super::path::straight;
    use super::*;
    use num::Rng;
    use platform::geom::random_rotation;
    use platform::manipulator::Leg;

    /// Bodies of all sizes over one of size one: a body of a ten-millionth is held in the same way as one of a half, also
    /// along a path.
    #[test]
    fn the_size_of_a_body_decides_nothing() {
        let mut rng = Rng::new(5);
        for k in 0..60 {
            let scale = 10f64.powi(-(k % 8));
            let mut point = |r: f64| Point3::new(rng.uniform(-r, r), rng.uniform(-r, r), rng.uniform(-r, r));
            let (base, platform) = if k % 16 < 8 { (1.0, scale) } else { (scale, 1.0) };
            let legs = std::array::from_fn(|_| Leg { base: point(base), platform: point(platform) });
            let m = Manipulator::from_legs(legs).unwrap();
            let pose = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(0.1, 0.2, 1.5) };
            // in rounded numbers, about the origin of the small body
            let rows = legs.map(|leg| {
                let arm = pose.rotation * leg.platform.coords;
                let line = arm + pose.position - leg.base.coords;
                let moment = if platform < base { arm } else { leg.base.coords }.cross(&line) / scale;
                RowVector6::new(line.x, line.y, line.z, moment.x, moment.y, moment.z)
            });
            let sign =
                if Matrix6::from_rows(&rows).determinant() > 0.0 { Sign::Positive } else { Sign::Negative };
            assert_eq!(hold_at(&m, &pose), PoseHold::Held(sign), "{k}");
            let near = Pose { position: pose.position * 1.0001, ..pose };
            assert_eq!(singular_along(&m, [&straight(&pose, &near)[..]]), None, "{k}");
            // joints that may be anywhere within such a radius may also make the pose singular
            let vague = m.enclosed_within(base.min(platform));
            assert_eq!(hold_at(&vague, &pose), PoseHold::Singular(SingularEvidence::Rounding), "{k}");
        }
    }
}
