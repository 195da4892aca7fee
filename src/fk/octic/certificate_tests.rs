//! The certificates of octahedral platforms for the poses of the solver.

use super::{OcticPoses, OcticSolver};
use crate::solve::certify::octahedral::{OctahedralCertificates, OctahedralCertifier, PairCertificate};
use crate::solve::certify::{Certifier, ProvedReality};
use nalgebra::{Point3, Vector3};
use num::Rng;
use num::interval::Interval;
use num_complex::Complex64;
use platform::geom::{Pose, random_rotation};
use platform::manipulator::{Manipulator, Octahedral, SquaredLegLengths};

const LEGS: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];

struct OcticCase {
    m: Manipulator,
    s: SquaredLegLengths,
    certifier: OctahedralCertifier,
    found: OcticPoses,
}

/// Random design in another leg order, with the lengths of a random pose; `None` where the fast solver gives up.
fn case(k: u64) -> Option<OcticCase> {
    let mut rng = Rng::stream(77, k);
    let mut triangle =
        || (0..3).map(|_| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)))).collect();
    let m = Manipulator::try_new(triangle(), triangle(), LEGS).unwrap();
    let m = m.reordered([3, 5, 0, 1, 4, 2]).unwrap();
    let pose = Pose { rotation: random_rotation(&mut rng), position: Vector3::from_fn(|_, _| rng.normal()) };
    let s = pose.squared_lengths(&m).unwrap();
    let certifier = OctahedralCertifier::new(&Octahedral::recognise(&m).unwrap()).unwrap();
    let found = OcticSolver::new(&m).unwrap().solve(&s)?;
    Some(OcticCase { m, s, certifier, found })
}

fn certify(c: &OcticCase) -> OctahedralCertificates {
    c.certifier.certify(&c.s, &c.found.poses)
}

#[test]
fn agrees_with_the_general_certificates() {
    let (mut complete, mut pairs, mut both) = (0, 0, 0);
    for k in 0..300 {
        let Some(c) = case(k) else { continue };
        let found = certify(&c);
        complete += usize::from(found.complete);
        let general = Certifier::new(&c.m, &c.s).unwrap();
        for (pair, poses) in found.pairs.iter().zip(c.found.poses.chunks(2)) {
            let Some(pair) = pair else { continue };
            pairs += 1;
            for pose in poses {
                let outcome = general.certify(pose);
                let Some(other) = outcome.certificate() else { continue };
                both += 1;
                let (a, b) = (pair.reality, other.reality());
                assert!(a == b || a == ProvedReality::Undecided || b == ProvedReality::Undecided, "{k}");
                // both proofs are about the same root
                let scale = pose.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
                for (i, disc) in other.enclosure().discs().take(9).enumerate() {
                    let gap = (disc.centre - pose.rotation[(i / 3, i % 3)]).norm();
                    assert!(gap <= disc.radius + 1.5 * pair.deviation * scale.max(1.0) * 10.0, "{k}: {gap}");
                }
            }
        }
    }
    assert!(complete >= 235 && pairs >= 2250 && both >= 4500, "{complete} {pairs} {both}");
}

#[test]
fn corrupted_roots_lose_their_certificate() {
    let mut tried = 0;
    for k in 0..20 {
        let Some(mut c) = case(k) else { continue };
        if !certify(&c).complete {
            continue;
        }
        tried += 1;
        let whole = c.found.clone();
        // a pose wrong in the seventh digit
        c.found.poses[5].rotation[(1, 2)] *= Complex64::from(1.0 + 1e-6);
        let scale = c.found.poses[5].rotation[(1, 2)].norm() * 1e-6;
        if scale > 1e-7 {
            assert!(certify(&c).pairs[2].is_none() && !certify(&c).complete, "{k}");
        }
        c.found = whole.clone();
        c.found.poses[8].position.y += Complex64::new(0.0, 1e-6 * c.m.size());
        let loose = whole.poses[8].position.norm() > 5.0 * c.m.size();
        assert!(loose || certify(&c).pairs[4].is_none(), "{k}");
        // mirror images exchanged for another pair's
        c.found = whole.clone();
        c.found.poses.swap(0, 2);
        let swapped = certify(&c);
        assert!(swapped.pairs[0].is_none() && swapped.pairs[1].is_none(), "{k}");
        // one pair twice: every pair is certified, the set is not
        c.found = whole.clone();
        (c.found.poses[2], c.found.poses[3]) = (whole.poses[0], whole.poses[1]);
        let twice = certify(&c);
        assert!(twice.pairs.iter().all(Option::is_some) && !twice.complete, "{k}");
    }
    assert!(tried >= 15);
}

#[test]
fn a_wrong_length_loses_the_certificates_and_an_uncertain_one_widens_them() {
    let c = (0..).find_map(case).unwrap();
    let mut s = c.s.intervals();
    s[2] = Interval::from(c.s.get()[2] * (1.0 + 1e-6));
    let wrong = c.certifier.certify(&s, &c.found.poses);
    assert!(wrong.pairs.iter().all(Option::is_none));
    let exact = certify(&c);
    let middle = c.s.get()[2];
    s[2] = Interval::new(middle * (1.0 - 1e-12), middle * (1.0 + 1e-12)).unwrap();
    let wide = c.certifier.certify(&s, &c.found.poses);
    let radius = |c: &OctahedralCertificates| c.pairs[0].map(|p| p.radius);
    assert!(radius(&wide).unwrap() > radius(&exact).unwrap());
}

#[test]
fn what_is_not_finite_or_out_of_range_has_no_certificate() {
    let mut c = (0..).find_map(case).unwrap();
    c.found.poses[7].position.x = Complex64::new(f64::NAN, 0.0);
    assert!(certify(&c).pairs[3].is_none());
    c.found.poses[0].position.x = Complex64::new(1e200, 0.0);
    assert!(certify(&c).pairs[0].is_none());
    let s = [Interval::WHOLE; 6];
    assert!(c.certifier.certify(&s, &c.found.poses).pairs.iter().all(Option::is_none));
}

/// The root that the lengths were made from, known exactly, lies in its discs.
#[test]
fn the_discs_hold_the_pair_of_the_generating_pose() {
    for k in 0..100 {
        let mut rng = Rng::stream(78, k);
        // dyadic data: squared distances of a translated platform are exact
        let mut grid = || (rng.uniform(-1.0, 1.0) * 256.0).round() / 256.0;
        let mut triangle =
            || -> Vec<Point3<f64>> { (0..3).map(|_| Point3::new(grid(), grid(), grid())).collect() };
        let (base, platform) = (triangle(), triangle());
        let shift = Vector3::new(grid(), grid(), 2.0 + grid());
        let Ok(m) = Manipulator::try_new(base.clone(), platform.clone(), LEGS) else { continue };
        let Ok(design) = Octahedral::recognise(&m) else { continue };
        let pose = Pose { rotation: nalgebra::Rotation3::identity(), position: shift };
        let s = pose.squared_lengths(&m).unwrap();
        let Some(found) = OcticSolver::new(&m).unwrap().solve(&s) else { continue };
        let certifier = OctahedralCertifier::new(&design).unwrap();
        let certificates = certifier.certify(&s, &found.poses);
        if !certificates.complete {
            continue;
        }
        // across the sides of the base and above it, up to rounding
        let corners = design.base();
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).normalize();
        let holds = |p: &PairCertificate| {
            [1.0, -1.0].into_iter().any(|sign| {
                (0..3).all(|i| {
                    let along = (corners[(i + 1) % 3] - corners[i]).normalize();
                    let arm = design.platform()[i].coords + shift - corners[i].coords;
                    let truth = [arm.dot(&normal.cross(&along)), sign * arm.dot(&normal)];
                    let rounding = 64.0 * f64::EPSILON * arm.norm();
                    (p.across[i] - truth[0]).norm() <= p.blur[i] + rounding
                        && (p.centre[i] - Complex64::new(truth[0], truth[1])).norm()
                            <= 2.0 * p.radius * p.centre[i].norm() + rounding
                })
            })
        };
        let holding = certificates.pairs.iter().flatten().filter(|p| holds(p)).count();
        assert_eq!(holding, 1, "case {k}");
    }
}

/// The stated accuracy of the poses holds for the roots, `R` and `p` each by its own size. With frames far from the
/// joints the two sizes have little to do with each other.
#[test]
fn poses_called_proved_are_the_roots_to_the_accuracy_stated() {
    let (mut checked, mut worst) = (0, 0.0_f64);
    for k in 0..120 {
        let mut rng = Rng::stream(79, k);
        let far = [0.0, 30.0, 1000.0][(k % 3) as usize];
        let mut triangle = || -> Vec<Point3<f64>> {
            let shift = Vector3::from_fn(|_, _| far * rng.normal());
            (0..3).map(|_| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)) + shift)).collect()
        };
        let m = Manipulator::try_new(triangle(), triangle(), LEGS).unwrap();
        let lengths = std::array::from_fn(|_| rng.uniform(2.0, 4.0));
        let s = platform::manipulator::LegLengths::try_new(lengths).unwrap().squared();
        let solver = OcticSolver::new(&m).unwrap();
        let Some(found) = solver.solve(&s) else { continue };
        let certificates = solver.certify(&s, &found);
        let general = Certifier::new(&m, &s).unwrap();
        for (i, pose) in found.poses.iter().enumerate() {
            let Some(pair) = &certificates.pairs[i / 2] else { continue };
            let own = solver.certificate(pair, pose, i % 2 == 1).unwrap();
            let Ok(root) = general.refine(pose).map(|r| r.pose()) else { continue };
            checked += 1;
            let rows: Vec<Complex64> = (0..9).map(|k| root.rotation[(k / 3, k % 3)]).collect();
            let entries = rows.iter().chain(root.position.iter());
            for (disc, z) in own.enclosure().discs().zip(entries) {
                // the root is rounded to doubles
                assert!((disc.centre - z).norm() <= disc.radius + 4.0 * f64::EPSILON * z.norm(), "{k} {i}");
            }
            let largest = |z: &[Complex64], least: f64| z.iter().map(|z| z.norm()).fold(least, f64::max);
            let gap = |a: &[Complex64], b: &[Complex64]| {
                a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
            };
            let given: Vec<Complex64> = (0..9).map(|k| pose.rotation[(k / 3, k % 3)]).collect();
            let turn = gap(&rows, &given) / largest(&given, 1.0);
            // the larger triangle has sides of two at least
            let shift = gap(root.position.as_slice(), pose.position.as_slice())
                / largest(pose.position.as_slice(), 4.0);
            assert!(
                turn <= pair.deviation * 1.001 + 1e-15 && shift <= pair.deviation * 1.001 + 1e-15,
                "{k} {i}: {turn:e} {shift:e}"
            );
            assert!(pair.deviation <= crate::solve::certify::NEAR);
            worst = worst.max(turn.max(shift));
        }
    }
    assert!(checked > 1000, "{checked}");
    // and the poses are not perfect, so that the test can fail
    assert!(worst > 1e-13, "{worst:e}");
}

/// For joints known within a radius the discs hold the pairs and the poses of every choice of joints. They do not hold
/// all pairs and poses of joints farther away.
#[test]
fn certificates_of_joints_within_radii_hold_for_every_choice() {
    let radius = 1e-13;
    let (mut held, mut closest, mut lost) = (0, 0.0_f64, 0);
    for k in 0..40 {
        let Some(c) = case(k) else { continue };
        let enclosed = c.m.clone().enclosed_within(radius);
        let certifier = OctahedralCertifier::new(&Octahedral::recognise(&enclosed).unwrap()).unwrap();
        let wide = certifier.certify(&c.s, &c.found.poses);
        // the solver's certificates are these
        assert_eq!(OcticSolver::new(&enclosed).unwrap().certify(&c.s, &c.found), wide, "{k}");
        let mut rng = Rng::stream(79, k);
        for far in [1.0, 1.0, 1.0, 1000.0] {
            let mut moved = |joints: &[Point3<f64>]| -> Vec<Point3<f64>> {
                let mut side = || if rng.next_u64().is_multiple_of(2) { 1.0 } else { -1.0 };
                joints.iter().map(|p| p.map(|x| x + 0.999 * far * radius * side())).collect()
            };
            let (base, platform) = (moved(c.m.base_joints()), moved(c.m.platform_joints()));
            let m = Manipulator::try_new(base, platform, c.m.pairs()).unwrap();
            let Some(found) = OcticSolver::new(&m).unwrap().solve(&c.s) else { continue };
            let own = OctahedralCertifier::new(&Octahedral::recognise(&m).unwrap()).unwrap();
            let own = own.certify(&c.s, &found.poses);
            for (i, pair) in wide.pairs.iter().enumerate() {
                let Some(pair) = pair else { continue };
                let inside = |p: &PairCertificate| {
                    let ratio = |j: usize| {
                        let gap = (pair.across[j] - p.across[j]).norm();
                        (gap + p.blur[j]) / pair.blur[j]
                    };
                    ratio(0).max(ratio(1)).max(ratio(2))
                };
                let certified = || own.pairs.iter().enumerate().filter_map(|(l, p)| Some((l, p.as_ref()?)));
                let nearest = certified().min_by(|a, b| inside(a.1).total_cmp(&inside(b.1)));
                let Some((l, other)) = nearest.filter(|_| own.complete) else { continue };
                let ratio = inside(other);
                if far > 1.0 {
                    lost += usize::from(ratio > 1.0);
                    continue;
                }
                assert!(ratio <= 1.0, "{k} {i}: {ratio}");
                (held, closest) = (held + 1, closest.max(ratio));
                // one of the two poses of the one is the pose of the other
                let given = &c.found.poses[2 * i];
                let near = |pose: &platform::geom::ComplexPose| {
                    let turn = (pose.rotation - given.rotation).iter().map(|z| z.norm()).fold(0.0, f64::max);
                    let shift = (pose.position - given.position).iter().map(|z| z.norm()).fold(0.0, f64::max);
                    turn <= pair.distances[0] + other.distances[0]
                        && shift <= pair.distances[1] + other.distances[1]
                };
                assert!(found.poses[2 * l..2 * l + 2].iter().any(near), "{k} {i}");
                let sure = [pair.reality, other.reality].map(|r| r != ProvedReality::Undecided);
                assert!(sure != [true, true] || pair.reality == other.reality);
            }
        }
        // joints without any knowledge are refused
        let unknown = c.m.clone().enclosed_within(f64::INFINITY);
        assert!(OctahedralCertifier::new(&Octahedral::recognise(&unknown).unwrap()).is_err());
        assert!(Certifier::new(&unknown, &c.s).is_err());
    }
    assert!(held > 300 && closest > 0.01 && lost > 100, "{held} {closest} {lost}");
}

/// Two joints next to the same double are two joints: merged they would be another platform, with its own sixteen
/// poses.
#[test]
fn joints_are_merged_by_what_they_are() {
    use num::surd::Surd;
    let c = (0..).find_map(case).unwrap();
    let mut ends = c.m.exact_ends().unwrap();
    assert!(OcticSolver::new(&Manipulator::from_exact_ends(&ends).unwrap()).is_ok());
    // a difference that doubles next to each other cannot show
    let trace = Surd::rational(&num::exact::rational(1e-40).unwrap()).unwrap();
    let x = &mut ends[0][0][0];
    *x = x.plus(&trace).unwrap();
    let split = Manipulator::from_exact_ends(&ends).unwrap();
    assert_eq!(split.legs(), c.m.legs());
    assert!(OcticSolver::new(&split).is_err());
    // and a joint known between bounds only is one joint when it is named as one
    assert!(OcticSolver::new(&c.m.clone().enclosed_within(1e-14)).is_ok());
    let apart = Manipulator::try_new(
        c.m.legs().map(|l| l.base).to_vec(),
        c.m.legs().map(|l| l.platform).to_vec(),
        std::array::from_fn(|i| (i, i)),
    );
    let apart = apart.unwrap();
    assert!(OcticSolver::new(&apart).is_ok() && OcticSolver::new(&apart.enclosed_within(1e-14)).is_err());
}
