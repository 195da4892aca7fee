use nalgebra::{Point3, Vector3};
use num_complex::Complex64;

use super::general::refined;
use super::legs::{LegRoles, Scratch};
use super::*;
use num::Rng;
use platform::geom::{Pose, random_rotation};

/// Legs of three topologies with two virtual legs (one of them also with the bodies exchanged) and of the 6-6, with the
/// number of poses.
const CLASSES: [([(usize, usize); 6], usize); 4] = [
    ([(0, 0), (1, 0), (2, 1), (3, 2), (4, 3), (5, 4)], 40),
    ([(0, 0), (0, 1), (1, 2), (2, 3), (3, 4), (4, 5)], 40),
    ([(0, 0), (1, 0), (0, 1), (2, 2), (3, 3), (4, 4)], 40),
    ([(0, 0), (1, 0), (2, 1), (2, 2), (3, 3), (4, 4)], 24),
];
const GENERAL: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 5)];

fn problem(legs: [(usize, usize); 6], rng: &mut Rng) -> (Manipulator, SquaredLegLengths) {
    let mut joints = |last: usize, size: f64| -> Vec<Point3<f64>> {
        let mut x = || size * rng.normal();
        (0..=last).map(|_| Point3::new(x(), x(), x())).collect()
    };
    let base = joints(legs.iter().map(|l| l.0).max().unwrap(), 30.0);
    let platform = joints(legs.iter().map(|l| l.1).max().unwrap(), 18.0);
    let m = Manipulator::try_new(base, platform, legs).unwrap();
    let position = Vector3::new(rng.normal(), rng.normal(), rng.normal()) * 30.0;
    let s = Pose { rotation: random_rotation(rng), position }.squared_lengths(&m).unwrap();
    (m, s)
}

/// Solutions that Newton's method reaches from the candidates.
fn solutions(m: &Manipulator, s: &SquaredLegLengths, found: &HiddenPoses) -> Vec<ComplexPose> {
    let legs = scaled(m, s);
    let mut out: Vec<ComplexPose> = Vec::new();
    for pose in found.poses.iter().flatten() {
        let small =
            ComplexPose { rotation: pose.rotation, position: pose.position / Complex64::from(m.size()) };
        let Some(pose) = refined(&legs, small, 0).map(|p| p.pose) else { continue };
        if out.iter().all(|known| known.distance(&pose, 1.0) > 1e-6) {
            out.push(pose);
        }
    }
    out
}

#[test]
fn every_way_finds_all_poses() {
    let mut rng = Rng::new(5);
    for (legs, count) in CLASSES {
        let (m, s) = problem(legs, &mut rng);
        let hidden = HiddenLengths::of(&m).unwrap();
        assert_eq!(hidden.virtual_legs(), 2);
        for way in 0..hidden.ways() {
            let found = hidden.poses(&s, way).unwrap();
            assert_eq!(solutions(&m, &s, &found).len(), count, "{legs:?} {way}");
            assert!(found.settled == count && found.excess < 1e-8, "{found:?}");
        }
        assert!(hidden.poses(&s, hidden.ways()).is_none());
    }
}

#[test]
#[ignore = "evidence"]
fn the_6_6_follows_from_forty_poses_of_a_simpler_platform() {
    let (m, s) = problem(GENERAL, &mut Rng::new(10));
    let hidden = HiddenLengths::of(&m).unwrap();
    assert_eq!(hidden.virtual_legs(), 3);
    let mut all = HiddenPoses { poses: Vec::new(), settled: 0, evaluations: 0, platforms: 0, excess: 0.0 };
    let mut way = 0;
    while solutions(&m, &s, &all).len() < 40 {
        let found = hidden.poses(&s, way).unwrap();
        // with a polynomial of degree 40 and no poles
        assert!(!(found.excess > 1e-6), "{}", found.excess);
        all.poses.extend(found.poses);
        way += 1;
    }
    assert_eq!(solutions(&m, &s, &all).len(), 40);
}

#[test]
fn designs_that_need_fewer_virtual_legs_are_left_to_others() {
    let octahedral = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    assert!(HiddenLengths::of(&problem(octahedral, &mut Rng::new(1)).0).is_none());
}

/// The condition is a polynomial of the degree stated, and without its factors it is none.
#[test]
fn poles_are_where_triangles_degenerate() {
    let mut rng = Rng::new(8);
    for (legs, count) in CLASSES {
        let (m, s) = problem(legs, &mut rng);
        let roles = LegRoles::of(&legs)[0];
        let closure = roles.closure(&scaled(&m, &s)).unwrap();
        let n = 96usize;
        let point = |k: usize| Complex64::from_polar(1.0, 0.1 + std::f64::consts::TAU * k as f64 / n as f64);
        let beyond = |values: &[Complex64]| {
            let coefficient = |power: usize| {
                let terms = values.iter().enumerate().map(|(k, v)| v * point(k).powf(-(power as f64)));
                terms.sum::<Complex64>().norm()
            };
            let largest = (0..=count / 2).map(coefficient).fold(0.0, f64::max);
            (count / 2 + 1..count / 2 + 8).map(coefficient).fold(0.0, f64::max) / largest
        };
        let mut scratch = Scratch::default();
        let values: Vec<Complex64> = (0..n).map(|k| closure.value(point(k), &mut scratch).unwrap()).collect();
        assert!(beyond(&values) < 1e-12, "{legs:?}: {:e}", beyond(&values));
        let gaps = |k: usize| -> Complex64 {
            closure.poses(point(k), &mut Scratch::default()).unwrap().placed.iter().map(|p| p.gap).product()
        };
        let bare: Vec<Complex64> = (0..n).map(gaps).collect();
        assert!(beyond(&bare) > 1e-6, "{legs:?}: the product alone has poles");
    }
}

#[test]
fn the_derivative_is_that_of_the_condition() {
    let mut rng = Rng::new(3);
    for (legs, _) in CLASSES {
        let (m, s) = problem(legs, &mut rng);
        let closure = LegRoles::of(&legs)[0].closure(&scaled(&m, &s)).unwrap();
        let (w, h) = (Complex64::from_polar(1.2, 0.7), 1e-5);
        let mut scratch = Scratch::default();
        let mut at = |turn: f64| closure.value(w * Complex64::from_polar(1.0, turn), &mut scratch).unwrap();
        let expected = (at(h) - at(-h)) / (at(0.0) * (2.0 * h));
        let slope = closure.poses(w, &mut Scratch::default()).unwrap().slope;
        assert!((slope - expected).norm() < 1e-6 * expected.norm().max(1.0), "{slope} {expected}");
    }
}
