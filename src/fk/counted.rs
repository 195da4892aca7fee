//! Whether the poses found are all there are, by their number: the design and lengths as written have so many finite
//! poses, modulo random primes.
//!
//! The count shares nothing with the solvers that find the poses. Certified roots are distinct zeros of the same
//! equations. As many as the count are all poses, each simple and isolated; fewer are not all; more contradict the
//! count. For lengths known within radii only, the poses of generic lengths are counted, which are as many or more. As
//! many certified roots are then all isolated poses; fewer may be all.

use super::bounded::Surroundings;
use super::dependent::related;
use super::evidence::{all_distinct, cluster_certificates, reject_others};
use super::{Completeness, FkError, FkOptions, FkRoot, FkSolutions, PoseCounting, Reason, SolutionSet};
use crate::solve::certify::{Certificate, Distinctness, PoseEnclosure, RootCertificate, overlapping_pairs};
use crate::solve::dependence;
use crate::solve::pose_count::{
    CountOptions, CountedLengths, PoseCount, PoseSet, count_generic_poses, count_poses, exact_squares,
};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// The verdict of the count on the roots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CountVerdict {
    /// Proved before, or as many as there are.
    Complete,
    /// Poses are missing.
    Short,
    /// Curves, surfaces or more.
    PositiveDimensional {
        /// Dimension of the components of highest dimension.
        dimension: usize,
    },
    /// Nothing: it was not asked or does not know.
    Silent,
}

/// The count, if it is requested.
pub(super) fn counted(m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Option<PoseCount> {
    if o.pose_count == PoseCounting::Never {
        return None;
    }
    let options = CountOptions { seed: o.seed, ..CountOptions::default() };
    Some(match exact_squares(s) {
        Some(squares) => count_poses(m, &squares, &options),
        // no lengths within the radii have more isolated poses than generic ones
        None => count_generic_poses(m, &options),
    })
}

/// Whether the certified roots are proved to be different ones.
pub(super) fn are_distinct(found: &FkSolutions) -> bool {
    let enclosures: Vec<&PoseEnclosure> = found
        .roots
        .iter()
        .filter_map(|r| match &r.certificate {
            Some(RootCertificate::Study(c)) => Some(c.enclosure()),
            _ => None,
        })
        .collect();
    if enclosures.len() == found.roots.len() && overlapping_pairs(enclosures.into_iter()).is_empty() {
        return true;
    }
    let study = |r: &FkRoot| match &r.certificate {
        Some(RootCertificate::Study(c)) => Some(*c),
        _ => None,
    };
    let certificates: Vec<Certificate> = found.roots.iter().filter_map(study).collect();
    let clusters = cluster_certificates(found);
    // those of octahedral platforms are not compared
    certificates.len() + clusters.len() == found.roots.iter().filter(|r| r.certified()).count()
        && all_distinct(&certificates, &clusters) == Distinctness::AllDistinct
}

/// Compares the certified roots with the count and files both.
pub(super) fn compare(found: &mut FkSolutions, count: &PoseCount) -> Result<CountVerdict, FkError> {
    found.pose_count = Some(count.clone());
    let distinct = are_distinct(found);
    let certified = found.certified_count();
    let error_probability = count.error_probability;
    let given = count.lengths == CountedLengths::Given;
    let counted = match &count.set {
        PoseSet::Undecided { .. } => return Ok(CountVerdict::Silent),
        // nothing follows for the lengths at hand, but that isolated poses are not more
        PoseSet::PositiveDimensional { .. } | PoseSet::Finite { count: 0, .. } if !given => {
            return Ok(CountVerdict::Silent);
        }
        PoseSet::PositiveDimensional { dimension, .. } => {
            found.completeness.learn(set_counted(count, false));
            return Ok(CountVerdict::PositiveDimensional { dimension: *dimension });
        }
        PoseSet::Finite { count, .. } if distinct && certified > *count => {
            let what =
                format!("{certified} distinct poses are certified, but the count modulo a prime is {count}");
            return Err(FkError::Contradiction { what });
        }
        PoseSet::Finite { count, .. } => *count,
    };
    if !distinct || certified != counted {
        found.completeness.doubt(if given {
            Reason::PosesMissing { counted, certified, error_probability }
        } else {
            Reason::FewerThanGeneric { counted, certified, error_probability }
        });
        return Ok(CountVerdict::Short);
    }
    found.completeness.learn(Completeness::Modular {
        poses: certified,
        lengths: count.lengths,
        error_probability,
    });
    if counted == 0 {
        found.solution_set = SolutionSet::Empty;
    }
    reject_others(found);
    Ok(CountVerdict::Complete)
}

/// The completeness that follows from the count when poses form a set of positive dimension, or seem to within
/// rounding. It is empty when the count is undecided.
pub(super) fn set_counted(count: &PoseCount, established: bool) -> Completeness {
    let error_probability = count.error_probability;
    // of lengths known within radii nothing is counted
    if count.lengths == CountedLengths::Generic {
        return Completeness::unproved([]);
    }
    let reason = match count.set {
        PoseSet::PositiveDimensional { dimension, degree } => {
            Some(Reason::SetCounted { dimension, degree, error_probability, established })
        }
        PoseSet::Finite { count, .. } => Some(Reason::NoMotionAsWritten { poses: count, error_probability }),
        PoseSet::Undecided { .. } => None,
    };
    Completeness::unproved(reason)
}

/// The answer of a method that does not search for more when poses are missing.
pub(super) fn compared_with_count(
    mut found: FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
) -> Result<FkSolutions, FkError> {
    let mut surroundings = Surroundings::new(m, o.seed);
    if found.completeness.is_proved() || surroundings.conclude(&mut found, s, o.pose_count)? {
        return Ok(found);
    }
    // rounded lengths contradict a relation between the legs, so that the count would find no pose
    if let Some(dependent) = related(dependence(m, s), m, s, o) {
        return dependent;
    }
    if let Some(count) = counted(m, s, o)
        && let CountVerdict::PositiveDimensional { dimension } = compare(&mut found, &count)?
    {
        reject_others(&mut found);
        found.solution_set = SolutionSet::seen(dimension, Vec::new());
    }
    surroundings.conclude_last(&mut found, s);
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ForwardKinematics, Homotopy, SolutionSet};
    use nalgebra::Point3;
    use num::double_double::DoubleDouble;
    use platform::manipulator::LegLengths;

    /// Rounded lengths contradict the relation of three legs in a plane pencil. Trilateration has no triangle there.
    #[test]
    fn rounded_lengths_of_dependent_legs_have_a_motion() {
        let p = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
        let star = p(8., -9., -7.);
        let base = vec![star, star, star, p(1., 2., 0.), p(-9., 5., 3.), p(4., 8., -2.)];
        let platform = vec![
            p(1., 0., 0.),
            p(4., 6., -3.),
            p(-2., -6., 3.),
            p(2., -6., 1.),
            p(6., 3., -4.),
            p(-1., 4., 5.),
        ];
        let m = Manipulator::try_new(base, platform, [0, 1, 2, 3, 4, 5].map(|k| (k, k))).unwrap();
        let rotation = nalgebra::Rotation3::from_euler_angles(0.2, -0.4, 0.7);
        let pose = platform::geom::Pose { rotation, position: nalgebra::Vector3::new(3.0, -2.0, 17.0) };
        let lengths = pose.squared_lengths(&m).unwrap().lengths().get();
        let s = LegLengths::try_new(lengths).unwrap().squared();
        let answer = |method| crate::solver(method).solve(&m, &s, &FkOptions::new());
        let refused = answer(Some(crate::Method::Trilateration));
        assert!(matches!(refused, Err(FkError::NotApplicable { .. })), "{refused:?}");
        for method in [None, Some(crate::Method::Homotopy)] {
            let found = answer(method).unwrap();
            let SolutionSet::PositiveDimensional { dimension: 1, witnesses, .. } = &found.solution_set else {
                panic!("{method:?}: {:?}", found.completeness)
            };
            assert!(found.roots.is_empty() && !witnesses.is_empty(), "{method:?}");
        }
    }

    /// Sixteen certified poses of lengths known within radii, of which nothing is known yet.
    fn sixteen() -> (Manipulator, SquaredLegLengths, FkSolutions) {
        let triangle = |r: f64| {
            vec![[r, 0.0, 0.0], [-r, r, 0.0], [-r, -r, 0.25]].into_iter().map(Point3::from).collect()
        };
        let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        let m = Manipulator::try_new(triangle(2.0), triangle(1.0), hexagon).unwrap();
        let l = LegLengths::try_new([3.0, 3.25, 2.875, 3.125, 3.0625, 2.9375]).unwrap();
        let s = SquaredLegLengths::try_within(l.squared().get().map(DoubleDouble::from), [1e-14; 6]).unwrap();
        let mut found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        assert_eq!((found.certified_count(), found.completeness.is_proved()), (16, true));
        found.completeness = Completeness::unproved([]);
        (m, s, found)
    }

    #[test]
    fn generic_lengths_bound_the_isolated_poses_of_lengths_within_radii() {
        let (m, s, found) = sixteen();
        let count = counted(&m, &s, &FkOptions::default()).unwrap();
        assert_eq!((count.finite(), count.lengths), (Some(16), CountedLengths::Generic));
        let compared = |n: usize| {
            let (mut found, mut count) = (found.clone(), count.clone());
            count.set = PoseSet::Finite { count: n, by_degree: vec![n] };
            compare(&mut found, &count).map(|j| (j, found))
        };
        let (verdict, complete) = compared(16).unwrap();
        assert_eq!(verdict, CountVerdict::Complete);
        let generic =
            matches!(complete.completeness, Completeness::Modular { lengths: CountedLengths::Generic, .. });
        assert!(generic && complete.is_complete() && complete.missing().is_none());
        // more for generic lengths: nothing is said to be missing
        let (verdict, fewer) = compared(20).unwrap();
        assert_eq!(verdict, CountVerdict::Short);
        assert!(!fewer.is_complete() && !fewer.all_accounted() && fewer.missing().is_none());
        assert!(fewer.completeness.to_string().contains("may be missing"), "{}", fewer.completeness);
        assert!(compared(15).is_err());
        // no pose for generic lengths does not say that there is none for these
        let (mut none, mut count) = (found.clone(), count.clone());
        none.roots.clear();
        count.set = PoseSet::Finite { count: 0, by_degree: Vec::new() };
        assert_eq!(compare(&mut none, &count).unwrap(), CountVerdict::Silent);
        assert!(!none.is_complete() && none.solution_set != SolutionSet::Empty);
    }
}
