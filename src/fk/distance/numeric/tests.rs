//! All configurations of random designs.

use nalgebra::{Point3, Vector3};

use super::*;
use crate::distance::plans;
use num::Rng;
use platform::geom::{Pose, random_rotation};
use platform::topology::{NamedTopology, catalogue};

/// A design of a topology and the squared leg lengths of a random pose.
fn problem(legs: [(usize, usize); 6], seed: u64) -> (Manipulator, Vec<Complex64>) {
    let rng = &mut Rng::new(seed);
    let mut joints = |n: usize| -> Vec<Point3<f64>> {
        (0..n).map(|_| Point3::from([(); 3].map(|()| rng.uniform(-1.0, 1.0)))).collect()
    };
    let count = |end: fn(&(usize, usize)) -> usize| 1 + legs.iter().map(end).max().unwrap();
    let m = Manipulator::try_new(joints(count(|l| l.0)), joints(count(|l| l.1)), legs).unwrap();
    let position = Vector3::from_fn(|_, _| rng.uniform(-1.0, 1.0));
    let pose = Pose { rotation: random_rotation(rng), position };
    let squares = m.legs().map(|leg| Complex64::from(pose.squared_length(&leg)));
    (m, squares.to_vec())
}

fn residual(m: &Manipulator, s: &[Complex64], pose: &ComplexPose) -> f64 {
    let legs =
        m.legs().iter().zip(s).map(|(leg, s)| (pose.squared_length(leg) - s).norm()).fold(0.0, f64::max);
    let gram = pose.rotation.transpose() * pose.rotation - nalgebra::Matrix3::identity();
    let error = gram.iter().map(|z| z.norm()).fold(legs, f64::max);
    // rounding grows with the square of the pose's own numbers
    let scale = pose.rotation.iter().chain(&pose.position).map(Complex64::norm_sqr).fold(1.0, f64::max);
    error / scale
}

/// Distinct poses with small residuals.
fn distinct(m: &Manipulator, s: &[Complex64], found: &[Configuration]) -> Vec<ComplexPose> {
    let mut out: Vec<ComplexPose> = Vec::new();
    for c in found.iter().filter(|c| residual(m, s, &c.pose) < 1e-7) {
        if out.iter().all(|p| p.distance(&c.pose, m.size()) > 1e-5) {
            out.push(c.pose);
        }
    }
    out
}

/// Numbers of poses proved in `docs/theory/completeness.md`.
fn poses(n: NamedTopology) -> usize {
    match n.number() {
        4 | 10 => 32,
        11 | 22 => 24,
        3 | 8 | 9 | 13 | 16 | 19 | 21 | 23 | 24 | 26 | 31 | 34 => 16,
        _ => 8,
    }
}

#[test]
fn every_sequence_with_at_most_one_virtual_leg_gives_all_poses() {
    let mut solved = 0;
    for n in catalogue() {
        for (k, t) in [n.topology(), n.topology().exchanged()].into_iter().enumerate() {
            let legs = [5, 0, 2, 4, 1, 3].map(|i| t.legs()[i]);
            let (m, squares) = problem(legs, 10 * n.number() as u64 + k as u64);
            let Ok(list) = plans(&m, 1) else { continue };
            let s = &list[0];
            let e = Evaluator::new(&m, s, &[], s.closures.first().copied()).unwrap();
            assert_eq!(e.shape().expected(), poses(n), "{}", n.id());
            let c = e.configurations(&squares, 1.0);
            assert_eq!((c.found.len(), c.lost, c.expected), (poses(n), 0, poses(n)), "{}", n.id());
            // zeros far from one circle are near another
            let more = [16.0, 1.0 / 16.0].map(|r| e.configurations(&squares, r).found).concat();
            let found = distinct(&m, &squares, &[c.found, more].concat()).len();
            assert_eq!(found, poses(n), "{} {s:?}", n.id());
            solved += 1;
        }
    }
    assert_eq!(solved, 60);
}

#[test]
fn the_circle_may_be_sampled_elsewhere_and_lengths_may_be_complex() {
    let t = catalogue()[15].topology();
    let (m, mut squares) = problem(t.legs(), 3);
    let s = &plans(&m, 1).unwrap()[0];
    let e = Evaluator::new(&m, s, &[], Some(s.closures[0])).unwrap();
    for bend in [0.0, 0.3] {
        squares[2] += Complex64::new(0.0, bend);
        let one = distinct(&m, &squares, &e.configurations(&squares, 1.0).found);
        let other = distinct(&m, &squares, &e.configurations(&squares, 1.5).found);
        assert_eq!((one.len(), other.len()), (16, 16));
        for p in &one {
            assert!(other.iter().any(|q| q.distance(p, m.size()) < 1e-6));
        }
    }
}

/// With two of three virtual legs given, and one closure left out, the configurations satisfy all other distances.
#[test]
fn given_virtual_legs_are_lengths_like_others() {
    let general = catalogue()[1].topology();
    let (m, squares) = problem(general.legs(), 8);
    let s = &plans(&m, 3).unwrap()[0];
    let given = [s.virtual_legs[0]];
    let rng = &mut Rng::new(2);
    let mut all = squares.clone();
    all.push(Complex64::new(rng.uniform(0.5, 2.0), 0.4));
    for closure in &s.closures {
        let Some(e) = Evaluator::new(&m, s, &given, Some(*closure)) else { continue };
        let left_out = s.closures.iter().find(|c| *c != closure).unwrap();
        let c = e.configurations(&all, 1.0);
        assert!(!c.found.is_empty());
        for f in &c.found {
            for (leg, square) in m.pairs().iter().zip(&all) {
                if left_out[0].across(left_out[1]) != Some(*leg) {
                    let ends = platform::manipulator::Leg {
                        base: m.base_joints()[leg.0],
                        platform: m.platform_joints()[leg.1],
                    };
                    assert!((f.pose.squared_length(&ends) - square).norm() < 1e-6, "{closure:?} {f:?}");
                }
            }
        }
    }
}

#[test]
fn a_wrong_distance_is_not_met() {
    let t = catalogue()[7].topology();
    let (m, squares) = problem(t.legs(), 4);
    let s = &plans(&m, 1).unwrap()[0];
    let e = Evaluator::new(&m, s, &[], Some(s.closures[0])).unwrap();
    let mut spoilt = squares.clone();
    spoilt[1] += 0.01;
    let found = e.configurations(&spoilt, 1.0).found;
    assert!(distinct(&m, &squares, &found).is_empty() && !distinct(&m, &spoilt, &found).is_empty());
}
