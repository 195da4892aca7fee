//! Multiple roots have no certificate, separate ones do, however close.

use equipod::methods::design::{Format, parse};
use equipod::methods::fk::{Completeness, FkOptions, ForwardKinematics, Homotopy};
use equipod::methods::geom::{ComplexPose, Pose, random_rotation};
use equipod::methods::manipulator::{LegLengths, Manipulator};
use equipod::methods::num::Rng;
use equipod::methods::num::double_double::DoubleDouble;
use equipod::methods::num::interval::Interval;
use equipod::methods::solve::certify::{
    CentrePrecision, Certificate, CertificateOutcome, Certifier, ProvedReality, RootRelation, relation,
};
use nalgebra::{Rotation3, Vector3};

use super::support::manipulator;

/// Innocenti's 6-4 platform as in Porta and Thomas, example 2 (with `p_l = (-3, 5, -1)`), all squares integers.
fn innocenti() -> Certifier {
    let base = [
        [0.0, 0.0, 0.0],
        [5.0, 0.0, 1.0],
        [-2.0, 4.0, -1.0],
        [3.0, -1.0, 1.0],
        [6.0, -2.0, 2.0],
        [-3.0, 5.0, -1.0],
    ];
    let platform = [
        [4.0, 1.0, 4.0],
        [4.0, 1.0, 4.0],
        [0.0, 3.0, 3.0],
        [0.0, 3.0, 3.0],
        [4.0, 1.0, 5.0],
        [-4.0, 3.0, 3.0],
    ];
    let s = [33.0, 11.0, 21.0, 29.0, 22.0, 21.0].map(Interval::from);
    Certifier::new(&manipulator(&base, &platform), &s).unwrap()
}

/// Six legs that meet the z axis at the pose `R = I`, `p = 0`: a singular pose with integer data.
fn singular_platform() -> (Manipulator, [f64; 6]) {
    let base = [
        [5.0, 1.0, 0.0],
        [3.0, 4.0, 1.0],
        [-4.0, 3.0, 0.0],
        [-5.0, -2.0, -1.0],
        [-1.0, -5.0, 0.0],
        [4.0, -4.0, 2.0],
    ];
    let height = [6.0, 9.0, 4.0, 7.0, 3.0, 8.0];
    // b_i = 2 (0, 0, z_i) - a_i, so that the axis halves every leg
    let platform = std::array::from_fn(|i| [-base[i][0], -base[i][1], 2.0 * height[i] - base[i][2]]);
    let square = |i: usize| {
        let d = height[i] - base[i][2];
        4.0 * (base[i][0] * base[i][0] + base[i][1] * base[i][1] + d * d)
    };
    (manipulator(&base, &platform), std::array::from_fn(square))
}

/// Distinct certified roots among the ends of Newton's method from the starts.
fn distinct_ends(certifier: &Certifier, starts: impl Iterator<Item = ComplexPose>) -> Vec<Certificate> {
    let mut found: Vec<Certificate> = Vec::new();
    for start in starts {
        let Ok(end) = certifier.refine(&start) else { continue };
        let CertificateOutcome::Certified(c) = certifier.certify(&end.pose()) else { continue };
        let known = found.iter().any(|f| match relation(f, &c) {
            RootRelation::Same => true,
            RootRelation::Distinct => false,
            RootRelation::Undecided => panic!("undecided: {f:?} {c:?}"),
        });
        if !known {
            found.push(c);
        }
    }
    found
}

fn random_poses(seed: u64, count: usize, spread: f64) -> impl Iterator<Item = ComplexPose> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| {
        let position = Vector3::from_fn(|_, _| spread * rng.normal());
        ComplexPose::from(Pose { rotation: random_rotation(&mut rng), position })
    })
}

#[test]
fn the_nearly_double_roots_of_innocentis_platform_are_told_apart() {
    let certifier = innocenti();
    let found = distinct_ends(&certifier, random_poses(71, 3000, 3.0));
    assert!(found.iter().all(|c| c.reality() == ProvedReality::Real), "real starts lead to real roots");
    assert_eq!(found.len(), 8);
}

#[test]
fn an_exactly_double_root_has_no_certificate() {
    let (m, s) = singular_platform();
    let identity = ComplexPose::from(Pose { rotation: Rotation3::identity(), position: Vector3::zeros() });
    let certifier = Certifier::new(&m, &s.map(Interval::from)).unwrap();
    assert!(m.legs().iter().zip(s).all(|(leg, s)| (identity.squared_length(leg) - s).norm() < 1e-300));
    assert!(certifier.certify(&identity).certificate().is_none());
    for size in [1e-15, 1e-12, 1e-9, 1e-7] {
        let mut rng = Rng::new(72);
        for _ in 0..200 {
            let axis = Vector3::from_fn(|_, _| size * rng.normal());
            let position = Vector3::from_fn(|_, _| size * rng.normal());
            let near = Pose { rotation: Rotation3::new(axis), position };
            assert!(certifier.certify(&ComplexPose::from(near)).certificate().is_none());
        }
    }
}

/// The two roots into which the double root splits when the last squared length changes; none when they are complex.
fn split_pair(change: f64) -> Vec<Certificate> {
    let (m, mut s) = singular_platform();
    s[5] += change;
    let certifier = Certifier::new(&m, &s.map(Interval::from)).unwrap();
    let mut rng = Rng::new(73);
    let size = change.abs().sqrt();
    let starts = (0..100).map(|_| {
        let rotation = Rotation3::new(Vector3::from_fn(|_, _| size * rng.normal()));
        ComplexPose::from(Pose { rotation, position: Vector3::from_fn(|_, _| size * rng.normal()) })
    });
    let near = |c: &Certificate| c.enclosure().rotation[0][0].centre.re > 1.0 - 1e-3;
    distinct_ends(&certifier, starts).into_iter().filter(near).collect()
}

#[test]
fn a_double_root_split_by_a_small_change_of_one_length_gives_two_certificates() {
    for change in [1e-4, 1e-8, 1e-10, 1e-12] {
        let pairs = [split_pair(change), split_pair(-change)];
        let counts = [pairs[0].len(), pairs[1].len()];
        assert!(
            counts == [2, 0] || counts == [0, 2],
            "one sign gives a real pair, the other a complex one: {counts:?}"
        );
        for c in pairs.iter().flatten() {
            assert_eq!(c.reality(), ProvedReality::Real);
            let expected =
                if change < 1e-9 { CentrePrecision::DoubleDouble } else { CentrePrecision::Double };
            assert_eq!(c.precision(), expected, "{change:e}");
        }
    }
}

#[test]
fn refinement_satisfies_integer_leg_equations_to_27_digits() {
    let certifier = innocenti();
    let (base, platform) = ([5.0, 0.0, 1.0], [4.0, 1.0, 4.0]);
    let mut checked = 0;
    for start in random_poses(74, 200, 3.0) {
        let Ok(end) = certifier.refine(&start) else { continue };
        if end.last_step > 1e-28 {
            continue; // one of the nearly double roots
        }
        let mut total = DoubleDouble::from(-11.0);
        for i in 0..3 {
            let mut x = end.position[i].re + DoubleDouble::from(-base[i]);
            for j in 0..3 {
                x = x + end.rotation[i][j].re * DoubleDouble::from(platform[j]);
            }
            total = total + x * x;
        }
        assert!(total.hi().abs() < 1e-26, "{total:?}");
        checked += 1;
    }
    assert!(checked > 20, "{checked}");
}

#[test]
fn far_poses_that_rounding_makes_are_proved_to_be_far_and_not_listed() {
    // |R| about 8e12
    let text = include_str!("../../../designs/worked/isolator-1.toml");
    let (design, _) = parse(text, Format::Toml).unwrap();
    let lengths = [
        86.68843075813669,
        86.76033025299336,
        85.19895772995153,
        86.7325332351761,
        87.25193376190299,
        86.03835420494654,
    ];
    let s = LegLengths::try_new(lengths).unwrap().squared();
    // its joints as the doubles they are near to: another platform
    let rounded = Manipulator::from_legs(design.manipulator().legs()).unwrap();
    let found = Homotopy.solve(&rounded, &s, &FkOptions::default()).unwrap();
    assert!(found.roots.iter().all(equipod::methods::fk::FkRoot::certified), "{:?}", found.completeness);
    // 16 poses of the platform that is meant; the 24 that the rounding of its joints makes are certified far out
    let Completeness::ProvedBounded { proof } = &found.completeness else { panic!("{}", found.completeness) };
    assert_eq!((found.roots.len(), proof.poses, proof.far), (16, 16, Some(24)));
    assert!(proof.rotation.unwrap() > 1e8, "{proof:?}");
}
