use super::*;
use crate::geom::Pose;
use crate::manipulator::{Leg, Manipulator, SquaredLegLengths};
use crate::num::Rng;
use crate::solve::certify::Certifier;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// Joints and position in whole numbers, the identity as rotation, every leg perpendicular to the velocity of its platform joint in one twist: the pose is singular
/// exactly, and the squared lengths are whole numbers.
fn singular_problem(rng: &mut Rng) -> (Manipulator, Pose, SquaredLegLengths) {
    let mut whole = |most: f64| (rng.uniform(-most, most)).round();
    loop {
        let mut vector = |most: f64| Vector3::new(whole(most), whole(most), whole(most));
        let (velocity, turn, position) = (vector(4.0), vector(4.0), vector(4.0) + Vector3::z() * 9.0);
        let legs: [Leg; 6] = std::array::from_fn(|_| {
            let platform = vector(6.0);
            let leg = (velocity + turn.cross(&platform)).cross(&vector(3.0));
            Leg { base: Point3::from(platform + position - leg), platform: Point3::from(platform) }
        });
        let Ok(m) = Manipulator::from_legs(legs) else { continue };
        let pose = Pose { rotation: Rotation3::identity(), position };
        let Some(s) = pose.squared_lengths(&m) else { continue };
        let svd = m.legs().map(|l| l.platform.coords + position - l.base.coords);
        let ranks = nalgebra::SMatrix::<f64, 6, 6>::from_fn(|i, k| {
            let b = m.legs()[i].platform.coords;
            if k < 3 { svd[i][k] } else { b.cross(&svd[i])[k - 3] }
        });
        let values = ranks.singular_values();
        if values[4] > 1e-2 * values[0] {
            return (m, pose, s);
        }
    }
}

fn near(pose: &Pose, rng: &mut Rng, distance: f64) -> ComplexPose {
    let turn = Vector3::new(rng.normal(), rng.normal(), rng.normal()) * distance;
    let shift = Vector3::new(rng.normal(), rng.normal(), rng.normal()) * distance;
    Pose { rotation: pose.rotation * Rotation3::new(turn), position: pose.position + shift }.into()
}

fn holds(
    enclosure: &PoseEnclosure,
    rotation: &Matrix3<Complex64>,
    position: &nalgebra::Vector3<Complex64>,
) -> bool {
    let entries = rotation.transpose().iter().copied().chain(position.iter().copied()).collect::<Vec<_>>();
    enclosure.discs().zip(entries).all(|(d, z)| (d.centre - z).norm() <= d.radius * UP)
}

#[test]
fn an_exact_double_pose_is_proved_to_half_of_the_digits_and_more() {
    let mut rng = Rng::new(0xd0);
    let (mut proved, mut widest) = (0, 0.0_f64);
    for k in 0..60 {
        let (m, pose, s) = singular_problem(&mut rng);
        let certifier = Certifier::new(&m, &s).unwrap();
        assert!(certifier.certify(&pose.into()).certificate().is_none(), "{k}: the pose is no simple root");
        let start = near(&pose, &mut rng, 1e-7);
        let Ok((middle, double)) = certifier.two_roots_near(&start) else { continue };
        proved += 1;
        widest = widest.max(double.radius());
        assert!(
            holds(
                double.enclosure(),
                &pose.rotation.matrix().map(Complex64::from),
                &pose.position.map(Complex64::from)
            ),
            "{k}"
        );
        assert!(middle.distance(&pose.into(), m.size()) < 1e-9, "{k}");
        assert_eq!(double.reality(), ProvedReality::Undecided);
    }
    // the others are of higher multiplicity or too flat
    assert!(proved >= 50, "{proved}");
    assert!(widest < 1e-6, "{widest:e}");
}

#[test]
fn two_poses_apart_by_a_little_lie_in_the_ball_and_data_within_radii_are_covered() {
    let mut rng = Rng::new(0xd1);
    let mut compared = 0;
    for k in 0..40_usize {
        let (m, pose, s) = singular_problem(&mut rng);
        let middle: [DoubleDouble; 6] = s.middle();
        let mut shifted = middle;
        let off = 2f64.powi(-30 - [0, 4, 8][k % 3]) * s.get()[k % 6];
        shifted[k % 6] = shifted[k % 6] + off.into();
        let moved = SquaredLegLengths::try_within(shifted, [0.0; 6]).unwrap();
        let certifier = Certifier::new(&m, &moved).unwrap();
        let Ok((_, double)) = certifier.two_roots_near(&pose.into()) else { continue };
        // the two of them one by one, from both sides of the middle along the kernel
        let centre = double.point();
        let mut found = Vec::new();
        for _ in 0..60 {
            let start = near(&pose, &mut rng, double.radius() * 4.0);
            let Ok(end) = certifier.refine(&start) else { continue };
            let c = certifier.certify(&end.pose());
            if let Some(c) = c.certificate() {
                let distance = |x: &[Complex64; 8], y: &[Complex64; 8]| {
                    (0..8).map(|j| (x[j] - y[j]).norm()).fold(0.0, f64::max)
                };
                if distance(&c.point(), &centre) < 1e-2
                    && found.iter().all(|f: &crate::solve::certify::Certificate| {
                        crate::solve::certify::relation(f, c) == crate::solve::certify::RootRelation::Distinct
                    })
                {
                    found.push(*c);
                }
            }
        }
        for c in &found {
            assert!(!double.enclosure().is_disjoint(c.enclosure()), "{k}: a root of the pair is outside");
        }
        compared += usize::from(found.len() == 2);
        // any data within radii: the same middles with all of the shift as a radius
        let wide = SquaredLegLengths::try_within(middle, [off.abs(); 6]).unwrap();
        let wide = Certifier::new(&m, &wide).unwrap().two_roots_near(&pose.into());
        if let Ok((_, wide)) = wide {
            for c in &found {
                assert!(!wide.enclosure().is_disjoint(c.enclosure()), "{k}");
            }
        }
    }
    // elsewhere the search from random starts finds one of the two only
    assert!(compared >= 12, "{compared}");
}

#[test]
fn one_root_none_and_motions_are_not_taken_for_two() {
    let mut rng = Rng::new(0xd2);
    for k in 0..60 {
        let (m, pose, s) = singular_problem(&mut rng);
        // a regular pose of the same design
        let turned = Pose { rotation: Rotation3::from_euler_angles(0.3, -0.4, 0.5), position: pose.position };
        let regular = turned.squared_lengths(&m).unwrap();
        let certifier = Certifier::new(&m, &regular).unwrap();
        if certifier.certify(&turned.into()).certificate().is_some_and(|c| c.uniqueness_radius() > 1e-2) {
            assert!(certifier.two_roots_near(&turned.into()).is_err(), "{k}: one root");
        }
        // lengths far from those of the pose
        let other = SquaredLegLengths::try_new(s.get().map(|s| s * 1.01 + 0.1)).unwrap();
        if let Ok((_, c)) = Certifier::new(&m, &other).unwrap().two_roots_near(&pose.into()) {
            // two roots after all: then they must satisfy the equations of these lengths
            let middle = c.enclosure().middle();
            assert!(middle.residual(&m, &other) < 1e-3, "{k}");
        }
    }
    // legs that are all parallel: three directions are singular, and the pose is a point of a motion
    let square = [[3.0, 0.0], [1.0, 2.0], [-2.0, 2.0], [-3.0, 0.0], [-1.0, -3.0], [2.0, -2.0]];
    let legs = square.map(|[x, y]| Leg { base: Point3::new(x, y, 0.0), platform: Point3::new(x, y, 0.0) });
    let m = Manipulator::from_legs(legs).unwrap();
    let pose = Pose { rotation: Rotation3::identity(), position: Vector3::z() * 4.0 };
    let s = pose.squared_lengths(&m).unwrap();
    assert!(Certifier::new(&m, &s).unwrap().two_roots_near(&pose.into()).is_err());
}
