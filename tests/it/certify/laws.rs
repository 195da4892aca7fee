use equipod::methods::geom::{ComplexPose, random_rotation};
use equipod::methods::manipulator::{Leg, Manipulator};
use equipod::methods::num::Rng;
use equipod::methods::num::interval::Interval;
use equipod::methods::solve::certify::{CertificateOutcome, Certifier, WhyUncertified};
use nalgebra::{Rotation3, Vector3};
use num_complex::Complex64;

use super::support::{Problem, pose, problems};

fn complex(r: &Rotation3<f64>) -> nalgebra::Matrix3<Complex64> {
    r.matrix().map(|x| Complex64::new(x, 0.0))
}

fn assert_all_certified(p: &Problem, certifier: &Certifier, map: impl Fn(&ComplexPose) -> ComplexPose) {
    for (i, (root, real)) in p.roots.iter().zip(&p.real).enumerate() {
        let outcome = certifier.certify(&map(&pose(root)));
        let c = outcome.certificate().unwrap_or_else(|| panic!("{} root {i}: {outcome:?}", p.name));
        assert_eq!(
            c.reality() == equipod::methods::solve::certify::ProvedReality::Real,
            *real,
            "{} {i}",
            p.name
        );
    }
}

/// Widths of relative `1e-14`, enough for the rounding of moved frames.
fn widened(s: &[Interval; 6]) -> [Interval; 6] {
    s.map(|s| Interval::new(s.lo() * (1.0 - 1e-14), s.hi() * (1.0 + 1e-14)).unwrap())
}

#[test]
fn a_power_of_two_changes_nothing_at_all() {
    for p in problems() {
        let factor = 2f64.powi(40);
        let legs = p.manipulator.legs().map(|l| Leg { base: l.base * factor, platform: l.platform * factor });
        let s = p.s.map(|s| Interval::new(s.lo() * factor * factor, s.hi() * factor * factor).unwrap());
        let scaled = Certifier::new(&Manipulator::from_legs(legs).unwrap(), &s).unwrap();
        let original = p.certifier();
        for root in &p.roots {
            let mut moved = pose(root);
            moved.position *= Complex64::new(factor, 0.0);
            let (a, b) = (original.certify(&pose(root)), scaled.certify(&moved));
            let (a, b) = (a.certificate().unwrap(), b.certificate().unwrap());
            assert_eq!(
                (a.centre(), a.radius(), a.uniqueness_radius()),
                (b.centre(), b.radius(), b.uniqueness_radius())
            );
            assert_eq!(a.enclosure().rotation, b.enclosure().rotation);
        }
    }
}

#[test]
fn other_units_keep_every_certificate() {
    for p in problems() {
        for factor in [1e-6, 1e6] {
            let legs =
                p.manipulator.legs().map(|l| Leg { base: l.base * factor, platform: l.platform * factor });
            let scale = Interval::from(factor).square();
            let s = widened(&p.s.map(|s| s * scale));
            let certifier = Certifier::new(&Manipulator::from_legs(legs).unwrap(), &s).unwrap();
            assert_all_certified(&p, &certifier, |pose| ComplexPose {
                rotation: pose.rotation,
                position: pose.position * Complex64::new(factor, 0.0),
            });
        }
    }
}

#[test]
fn rotated_and_shifted_frames_keep_every_certificate() {
    let mut rng = Rng::new(51);
    for p in problems() {
        let (u, v) = (random_rotation(&mut rng), random_rotation(&mut rng));
        let t = Vector3::from_fn(|_, _| rng.normal());
        let w = Vector3::from_fn(|_, _| rng.normal());
        let legs = p.manipulator.legs().map(|l| Leg { base: u * l.base + t, platform: v * l.platform + w });
        let certifier = Certifier::new(&Manipulator::from_legs(legs).unwrap(), &widened(&p.s)).unwrap();
        let lift = |x: &Vector3<f64>| x.map(|x| Complex64::new(x, 0.0));
        assert_all_certified(&p, &certifier, |pose| {
            // x' = U (R V^T (y' - w) + p) + t
            let rotation = complex(&u) * pose.rotation * complex(&v.inverse());
            let position = complex(&u) * pose.position + lift(&t) - rotation * lift(&w);
            ComplexPose { rotation, position }
        });
    }
}

#[test]
fn the_order_of_the_legs_does_not_matter() {
    for p in problems() {
        let order = [4, 2, 0, 5, 1, 3];
        let m = p.manipulator.reordered(order).unwrap();
        let certifier = Certifier::new(&m, &order.map(|i| p.s[i])).unwrap();
        assert_all_certified(&p, &certifier, |pose| *pose);
    }
}

#[test]
fn uncertain_lengths_are_certified_while_they_are_narrow() {
    for p in problems().into_iter().filter(|p| p.name == "general66_00" || p.name == "dietmaier40") {
        let widen = |relative: f64| {
            p.s.map(|s| Interval::new(s.lo() * (1.0 - relative), s.hi() * (1.0 + relative)).unwrap())
        };
        let (narrow, wide) = (widen(1e-12), widen(0.5));
        let narrow = Certifier::new(&p.manipulator, &narrow).unwrap();
        let wide = Certifier::new(&p.manipulator, &wide).unwrap();
        let exact = p.certifier();
        for root in &p.roots {
            let (a, b) = (exact.certify(&pose(root)), narrow.certify(&pose(root)));
            let (a, b) = (a.certificate().unwrap(), b.certificate().unwrap());
            assert!(b.radius() > 2.0 * a.radius(), "the width enters the radius");
            let refused = wide.certify(&pose(root));
            assert!(matches!(
                refused,
                CertificateOutcome::Absent(
                    WhyUncertified::NoContraction { .. } | WhyUncertified::IllConditioned { .. }
                )
            ));
        }
    }
}

#[test]
fn the_narrow_certificate_covers_every_choice_of_lengths() {
    // the root for s at the upper ends lies in the enclosure certified for the whole interval
    let p = problems().remove(0);
    let wide = p.s.map(|s| Interval::new(s.lo() * (1.0 - 1e-9), s.hi() * (1.0 + 1e-9)).unwrap());
    let whole = Certifier::new(&p.manipulator, &wide).unwrap();
    let end = Certifier::new(&p.manipulator, &wide.map(|s| Interval::from(s.hi()))).unwrap();
    let mut outside_exact = 0;
    for root in &p.roots {
        let outcome = whole.certify(&pose(root));
        let refined = end.refine(&pose(root)).unwrap().pose();
        let holds = |c: &equipod::methods::solve::certify::Certificate| {
            let mut entries =
                (0..9).map(|k| refined.rotation[(k / 3, k % 3)]).chain(refined.position.iter().copied());
            c.enclosure().discs().all(|d| entries.next().is_some_and(|z| d.contains(z)))
        };
        assert!(holds(outcome.certificate().unwrap()));
        outside_exact += usize::from(!holds(p.certifier().certify(&pose(root)).certificate().unwrap()));
    }
    assert_eq!(outside_exact, p.roots.len(), "the test can fail");
}
