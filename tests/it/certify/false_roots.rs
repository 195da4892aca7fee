use equipod::methods::geom::{ComplexPose, Pose, random_rotation};
use equipod::methods::num::Rng;
use equipod::methods::num::interval::Interval;
use equipod::methods::solve::certify::{CertificateOutcome, Certifier, WhyUncertified};
use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use super::support::{encloses, pose, problem, problems};

/// The pose with every entry of `R` and `p` moved by up to `size` of the largest entry of its kind.
fn perturbed(pose: &ComplexPose, size: f64, rng: &mut Rng) -> ComplexPose {
    let largest = |m: &[Complex64]| m.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let (r, p) = (largest(pose.rotation.as_slice()), largest(pose.position.as_slice()));
    let mut shift =
        |scale: f64| Complex64::new(rng.uniform(0.5, 1.0), rng.uniform(0.5, 1.0)) * (scale * size);
    ComplexPose {
        rotation: pose.rotation.map(|z| z + shift(r)),
        position: pose.position.map(|z| z + shift(p)),
    }
}

#[test]
fn roots_wrong_in_the_sixth_digit_lose_their_certificate_and_refinement_brings_them_back() {
    let mut rng = Rng::new(61);
    let mut recovered = 0;
    for p in problems() {
        let certifier = p.certifier();
        for (i, root) in p.roots.iter().enumerate() {
            let corrupted = perturbed(&pose(root), 1e-6, &mut rng);
            let outcome = certifier.certify(&corrupted);
            assert!(matches!(outcome, CertificateOutcome::Absent(_)), "{} root {i}: {outcome:?}", p.name);
            let refined = certifier.refine(&corrupted).unwrap();
            assert!(refined.moved > 1e-8);
            let again = certifier.certify(&refined.pose());
            recovered += usize::from(encloses(again.certificate().unwrap(), root));
        }
    }
    let all: usize = problems().iter().map(|p| p.roots.len()).sum();
    assert!(recovered > all - 8, "{recovered} of {all}"); // members of close pairs may change places
}

#[test]
fn a_certificate_for_a_slightly_wrong_pose_still_encloses_the_true_root() {
    let mut rng = Rng::new(63);
    let (mut certified, mut refused) = (0, 0);
    for p in problems() {
        let certifier = p.certifier();
        for (i, root) in p.roots.iter().enumerate() {
            for digits in 7..16 {
                let wrong = perturbed(&pose(root), 10f64.powi(-digits), &mut rng);
                match certifier.certify(&wrong) {
                    CertificateOutcome::Certified(c) => {
                        certified += 1;
                        assert!(encloses(&c, root), "{} root {i}, digit {digits}: {c:?}", p.name);
                    }
                    CertificateOutcome::Absent(_) => refused += 1,
                }
            }
        }
    }
    assert!(certified > 600 && refused > 100, "{certified} {refused}");
}

#[test]
fn random_poses_never_get_a_certificate() {
    let mut rng = Rng::new(62);
    for p in problems() {
        let certifier = p.certifier();
        for k in 0..1500 {
            let position = Vector3::from_fn(|_, _| 3.0 * rng.normal());
            let real = ComplexPose::from(Pose { rotation: random_rotation(&mut rng), position });
            // every third one complex, through a complex rotation about an axis
            let angle = Complex64::new(0.0, rng.normal());
            let (c, s, one, o) = (angle.cos(), angle.sin(), Complex64::new(1.0, 0.0), Complex64::ZERO);
            let turn = Matrix3::new(c, -s, o, s, c, o, o, o, one);
            let tried = if k % 3 == 0 {
                ComplexPose { rotation: real.rotation * turn, position: real.position.map(|z| z + angle) }
            } else {
                real
            };
            let outcome = certifier.certify(&tried);
            assert!(matches!(outcome, CertificateOutcome::Absent(_)), "{}: {tried:?}", p.name);
        }
    }
}

#[test]
fn a_root_of_another_problem_is_refused() {
    let (p, q) = (problem("general66_00"), problem("nearsing_00"));
    for root in &q.roots {
        assert!(p.certifier().certify(&pose(root)).certificate().is_none());
    }
    let mut longer = p.s;
    longer[2] = longer[2] * Interval::from(1.0 + 1e-5);
    let other = Certifier::new(&p.manipulator, &longer).unwrap();
    let swapped = Certifier::new(&p.manipulator, &[p.s[1], p.s[0], p.s[2], p.s[3], p.s[4], p.s[5]]).unwrap();
    for root in &p.roots {
        assert!(other.certify(&pose(root)).certificate().is_none());
        assert!(swapped.certify(&pose(root)).certificate().is_none());
    }
}

#[test]
fn matrices_that_are_no_rotations_and_broken_numbers_are_refused() {
    let p = problem("dietmaier40");
    let good = pose(&p.roots[0]);
    let refused = |pose: ComplexPose| match p.certifier().certify(&pose) {
        CertificateOutcome::Absent(why) => why,
        CertificateOutcome::Certified(c) => panic!("{c:?}"),
    };
    let mut stretched = good;
    stretched.rotation *= Complex64::new(1.001, 0.0);
    let why = refused(stretched);
    assert!(matches!(why, WhyUncertified::Inaccurate { .. } | WhyUncertified::NotARotation { .. }), "{why}");
    let mirrored = ComplexPose { rotation: -good.rotation, position: good.position };
    refused(mirrored);
    refused(ComplexPose { rotation: Matrix3::zeros(), position: good.position });
    let mut nan = good;
    nan.position.x.im = f64::NAN;
    assert_eq!(refused(nan), WhyUncertified::NotFinite);
    let mut far = good;
    far.position *= Complex64::new(1e300, 0.0);
    assert_eq!(refused(far), WhyUncertified::OutOfRange);
    let unbounded = [Interval::WHOLE; 6];
    assert!(matches!(Certifier::new(&p.manipulator, &unbounded), Err(WhyUncertified::OutOfRange)));
}
