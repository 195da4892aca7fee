//! Decides whether the legs hold the platform at a pose and along a path of poses; all commands share this test.
//!
//! Intervals prove the sign of `det J`. If they contain zero, exact arithmetic decides for exact joints. A pose that
//! remains is singular within rounding: `det J` is not above the rounding errors of its own computation.

use nalgebra::{Matrix6, Quaternion, UnitQuaternion, Vector3};

use super::path::{ControlPoint, PathPiece, Sign, SignsAlong, signs_along, signs_on_curve};
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
    if let Some(sign) = signs_along(m, pose, pose).kept().or_else(|| sign_in_scale(m, pose)) {
        return PoseHold::Held(sign);
    }
    match exact_rank(m, pose) {
        Some(..6) => PoseHold::Singular(SingularEvidence::Zero),
        Some(_) | None => PoseHold::Singular(SingularEvidence::Rounding),
    }
}

/// The sign of `det J` with moments about the mean of the platform ends and lengths over the size of the platform. A
/// small platform over a large base is thus compared with its own size. `None` if the determinant may be zero within
/// rounding.
///
/// Rows `[u_i, (r_i x u_i) / rho]` have norms of at most `sqrt(7)` and errors of at most `err`. The determinant error
/// is then at most `6 err 7^(5/2) < 800 err` (Hadamard); elimination adds at most as much again.
fn sign_in_scale(m: &Manipulator, pose: &Pose) -> Option<Sign> {
    let legs = m.legs();
    let centre = legs.iter().map(|leg| leg.platform.coords).sum::<Vector3<f64>>() / 6.0;
    let size = legs.iter().map(|leg| (leg.platform.coords - centre).norm()).fold(0.0, f64::max);
    let mut rows = Matrix6::zeros();
    let mut off: f64 = 0.0;
    for (i, leg) in legs.iter().enumerate() {
        let [a, b] = [leg.base.coords, leg.platform.coords];
        let line = pose.rotation * b + pose.position - a;
        let length = line.norm();
        let u = line / length;
        let moment = (pose.rotation * (b - centre)).cross(&u) / size;
        rows.fixed_view_mut::<1, 3>(i, 0).copy_from(&u.transpose());
        rows.fixed_view_mut::<1, 3>(i, 3).copy_from(&moment.transpose());
        let reach = a.norm() + b.norm() + pose.position.norm();
        off = off.max(32.0 * f64::EPSILON * (1.0 + b.norm() / size + reach / length));
    }
    let determinant = rows.determinant();
    // a NaN proves nothing
    if !(determinant.abs() > 1600.0 * off) {
        return None;
    }
    Some(if determinant > 0.0 { Sign::Positive } else { Sign::Negative })
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
    use nalgebra::Point3;

    use super::*;
    use num::Rng;
    use platform::geom::random_rotation;

    /// Platforms of all sizes over a base of size one. The sign is that of the intervals if these decide. A platform of
    /// a ten-millionth is held in the same way as one of a half.
    #[test]
    fn the_size_of_the_platform_decides_nothing() {
        let mut rng = Rng::new(5);
        let (mut both, mut alone) = (0, 0);
        for k in 0..60 {
            let scale = 10f64.powi(-(k % 8));
            let mut point = |r: f64| Point3::new(rng.uniform(-r, r), rng.uniform(-r, r), rng.uniform(-r, r));
            let base: Vec<_> = (0..6).map(|_| point(1.0)).collect();
            let platform: Vec<_> = (0..6).map(|_| point(scale)).collect();
            let m = Manipulator::try_new(base, platform, std::array::from_fn(|i| (i, i))).unwrap();
            let pose = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(0.1, 0.2, 1.5) };
            let (own, intervals) = (sign_in_scale(&m, &pose), signs_along(&m, &pose, &pose).kept());
            if let Some(sign) = intervals {
                assert!(own.is_none_or(|own| own == sign), "{k}");
                both += 1;
            }
            alone += usize::from(own.is_some() && intervals.is_none());
            assert!(matches!(hold_at(&m, &pose), PoseHold::Held(_)), "{k}: a random pose is regular");
        }
        assert!(both > 10 && alone > 10, "{both} {alone}");
    }
}
