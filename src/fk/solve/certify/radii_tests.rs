//! Certificates of joints known within radii, against the problems of joints drawn within them.

use super::*;
use nalgebra::{Point3, Vector3};
use num::Rng;
use platform::geom::{Pose, random_rotation};
use platform::manipulator::Leg;

fn problem(rng: &mut Rng, planar: bool) -> (Manipulator, Pose) {
    let mut point = || {
        let z = if planar { 0.0 } else { rng.normal() };
        Point3::new(rng.normal(), rng.normal(), z)
    };
    let m =
        Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() })).unwrap();
    (m, Pose { rotation: random_rotation(rng), position: Vector3::new(0.3, -0.4, 1.2) })
}

/// Each leg with ends of its own, `far` radii away.
fn drawn(m: &Manipulator, radius: f64, far: f64, rng: &mut Rng) -> Manipulator {
    let mut side =
        || if rng.next_u64().is_multiple_of(2) { 0.999 * far * radius } else { -0.999 * far * radius };
    let legs =
        m.legs().map(|l| Leg { base: l.base.map(|x| x + side()), platform: l.platform.map(|x| x + side()) });
    Manipulator::from_legs(legs).unwrap()
}

#[test]
fn the_ball_holds_the_root_of_every_choice_of_joints() {
    let mut rng = Rng::new(0xc1);
    let (mut proved, mut closest, mut lost, mut drawings) = (0, 0.0_f64, 0, 0);
    for k in 0..60 {
        let (m, pose) = problem(&mut rng, k % 3 == 0);
        let s = pose.squared_lengths(&m).unwrap();
        let radius = 10f64.powi(-15 + (k % 5) * 2);
        let certifier = Certifier::new(&m.clone().enclosed_within(radius), &s).unwrap();
        let outcome = certifier.certify(&pose.into());
        let Some(wide) = outcome.certificate() else { continue };
        proved += 1;
        assert_eq!(wide.reality(), ProvedReality::Real, "{k}");
        assert!(wide.radius() > 0.1 * radius, "{k}");
        for far in [1.0, 1.0, 1.0, 1.0, 200.0] {
            let other = drawn(&m, radius, far, &mut rng);
            let refined = refine(&other, &s, &pose.into()).unwrap();
            let own = certify(&other, &s, &refined.pose());
            let Some(own) = own.certificate() else { continue };
            let pairs = wide.enclosure().discs().zip(own.enclosure().discs());
            let ratio =
                pairs.map(|(w, o)| ((w.centre - o.centre).norm() - o.radius) / w.radius).fold(0.0, f64::max);
            if far > 1.0 {
                lost += usize::from(ratio > 1.0);
                drawings += 1;
                continue;
            }
            assert!(ratio <= 1.0, "{k}: {ratio}");
            assert_eq!(relation(wide, own), RootRelation::Same, "{k}");
            closest = closest.max(ratio);
        }
    }
    assert!(proved > 50 && closest > 0.02, "{proved} {closest}");
    assert!(4 * lost > 3 * drawings, "roots of joints further away are elsewhere: {lost} of {drawings}");
}

/// Nothing is certified that some choice of joints does not have.
#[test]
fn radii_that_reach_a_singular_platform_leave_no_certificate() {
    let mut rng = Rng::new(0xc2);
    for _ in 0..10 {
        let (m, pose) = problem(&mut rng, false);
        let s = pose.squared_lengths(&m).unwrap();
        assert!(certify(&m, &s, &pose.into()).certificate().is_some());
        for radius in [1.0, f64::INFINITY, f64::NAN] {
            let unknown = m.clone().enclosed_within(radius);
            assert!(certify(&unknown, &s, &pose.into()).certificate().is_none(), "{radius}");
        }
    }
}
