//! The exact closure polynomial beside the poses of any method.

use thiserror::Error;

use super::{Completeness, FkSolutions, SolutionSet};
use crate::distance::{
    ClosureDegrees, ClosureError, ClosurePolynomial, NoPlan, closure_degrees, closure_polynomial, plans,
};
use platform::manipulator::{JointKnowledge, Manipulator, SquaredLegLengths};
use platform::topology::{JointIndex, Sequence};

/// Sequences tried until one tells the number of real poses.
const ATTEMPTS: usize = 4;

/// The closure polynomial of one problem and the number of real poses that it gives.
#[derive(Debug, Clone)]
pub struct Closure {
    /// The polynomial with its real roots.
    pub polynomial: ClosurePolynomial,
    /// Degrees before and after removal of the singular factors, the factors.
    pub degrees: ClosureDegrees,
    /// Number of real poses over each real root, proved by the polynomial together with the number of all poses; `None`
    /// where it does not follow.
    pub real_poses: Option<Vec<usize>>,
}

impl Closure {
    /// The number of real poses, proved; see [`real_poses`](Self::real_poses).
    #[must_use]
    pub fn real_count(&self) -> Option<usize> {
        self.real_poses.as_ref().map(|list| list.iter().sum())
    }
}

/// Why there is no closure polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoClosure {
    /// No sequence with one virtual leg.
    #[error(transparent)]
    Plan(#[from] NoPlan),
    /// None of the sequences has a polynomial; this is the error of the first.
    #[error(transparent)]
    Polynomial(#[from] ClosureError),
    /// A leg joins the two joints.
    #[error("a leg joins these joints: their distance is given")]
    Leg,
    /// No sequence of trilaterations uses their distance.
    #[error("with the distance of these joints the others cannot be placed one by one")]
    Between,
}

/// The closure polynomial for the squared lengths `s` that `found` was computed from.
///
/// The first sequence that tells the number of real poses gives it; if none does, the first that has a polynomial.
///
/// The polynomial is a second opinion about how many poses are real. It uses only the number of the poses found, and
/// only when that number is proved.
///
/// # Errors
/// [`NoClosure`].
pub fn closure(m: &Manipulator, s: &SquaredLegLengths, found: &FkSolutions) -> Result<Closure, NoClosure> {
    of_sequences(m, s, found, &plans(m, 1)?)
}

/// The same in the squared distance of a base joint and a platform joint that no leg joins, by their numbers.
///
/// # Errors
/// [`NoClosure`].
pub fn closure_between(
    m: &Manipulator,
    s: &SquaredLegLengths,
    found: &FkSolutions,
    unknown: (usize, usize),
) -> Result<Closure, NoClosure> {
    if m.pairs().contains(&unknown) {
        return Err(NoClosure::Leg);
    }
    let pair = [JointIndex::Base(unknown.0), JointIndex::Platform(unknown.1)];
    let with_it = plans(m, 1)?.into_iter().filter_map(|mut plan| {
        if plan.virtual_legs.is_empty() {
            plan.closures = vec![pair];
        }
        (plan.virtual_legs.is_empty() || plan.virtual_legs == [unknown]).then_some(plan)
    });
    let sequences: Vec<Sequence> = with_it.collect();
    if sequences.is_empty() { Err(NoClosure::Between) } else { of_sequences(m, s, found, &sequences) }
}

fn of_sequences(
    m: &Manipulator,
    s: &SquaredLegLengths,
    found: &FkSolutions,
    sequences: &[Sequence],
) -> Result<Closure, NoClosure> {
    // the polynomial is that of joints that are their doubles, and of squares without error
    let exact = m.joint_knowledge() == JointKnowledge::Doubles && s.is_exact();
    let complete = exact && matches!(found.completeness, Completeness::Proved { .. });
    let isolated = found.solution_set == SolutionSet::Isolated;
    let simple = found.roots.iter().all(|r| r.certified() && r.multiplicity == 1);
    let poses = (complete && isolated && simple).then_some(found.roots.len());
    let mut first_error = None;
    let mut fallback = None;
    for plan in sequences.iter().take(ATTEMPTS) {
        let polynomial = match closure_polynomial(m, s, plan) {
            Ok(polynomial) => polynomial,
            Err(e) => {
                first_error = first_error.or(Some(e));
                continue;
            }
        };
        let real_poses = poses.and_then(|n| polynomial.real_poses(n));
        let decided = real_poses.is_some();
        if decided || fallback.is_none() {
            fallback = Some(Closure { degrees: closure_degrees(m, s, plan)?, polynomial, real_poses });
        }
        if decided {
            break;
        }
    }
    fallback.ok_or_else(|| first_error.unwrap_or(ClosureError::Unsupported).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FkOptions, ForwardKinematics, Homotopy, Reality};
    use nalgebra::{Point3, Vector3};
    use num::Rng;
    use num::poly::complex_roots;
    use platform::geom::Pose;
    use platform::geom::random_rotation;
    use platform::manipulator::Leg;
    use platform::topology::catalogue;

    /// The number of real poses by the polynomial is that of the certificates, which know nothing of each other.
    #[test]
    #[ignore = "evidence"]
    fn real_poses_of_all_thirty_topologies_are_those_the_certificates_found() {
        let mut rng = Rng::new(11);
        for n in catalogue() {
            let t = n.topology();
            if t.trilateration().virtual_legs.len() > 1 {
                continue;
            }
            let mut points = |count: usize| -> Vec<Point3<f64>> {
                (0..count).map(|_| Point3::from([0; 3].map(|_| rng.uniform(-2.0, 2.0)))).collect()
            };
            let (base, platform) = (points(t.base_joints()), points(t.platform_joints()));
            let m = Manipulator::try_new(base, platform, t.legs()).unwrap();
            let rotation = random_rotation(&mut rng);
            let pose = Pose { rotation, position: Vector3::from_fn(|_, _| rng.normal()) };
            let s = pose.squared_lengths(&m).unwrap();
            let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
            assert!(matches!(found.completeness, Completeness::Proved { .. }));
            let real = found.roots.iter().filter(|r| r.reality == Reality::Real).count();
            let closure = closure(&m, &s, &found).unwrap();
            assert_eq!(closure.real_count(), Some(real), "{}", n.id());
            assert_eq!(closure.degrees.after, found.roots.len(), "{}", n.id());
            every_pose_lies_over_a_root(&m, &closure.polynomial, &found, &n.id());
        }
    }

    /// The squared distance at each pose is a root, and at each root there is a pose.
    fn every_pose_lies_over_a_root(m: &Manipulator, c: &ClosurePolynomial, found: &FkSolutions, id: &str) {
        let [x, y] = c.unknown;
        let (a, b) = x.across(y).unwrap();
        let leg = Leg { base: m.base_joints()[a], platform: m.platform_joints()[b] };
        let mut values: Vec<_> = found.roots.iter().map(|r| r.pose.squared_length(&leg)).collect();
        for root in complex_roots(&c.polynomial, 60).unwrap() {
            let z = root.to_complex64();
            let over = values.len();
            // far-out poses are known to fewer digits
            values.retain(|v| (v - z).norm() > 1e-6 * (1.0 + z.norm()));
            assert!(values.len() < over, "{id}: no pose over {z}");
        }
        assert!(values.is_empty(), "{id}: {values:?} are not roots");
    }
}
