use nalgebra::{Point3, Rotation3, Vector3};

use super::*;
use num::Rng;
use platform::geom::{random_rotation, rotation_vector, turn_between};
use platform::manipulator::{Leg, plucker_matrix};

fn design(rng: &mut Rng) -> Manipulator {
    let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
    Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() })).unwrap()
}

fn pose(rng: &mut Rng) -> Pose {
    Pose { rotation: random_rotation(rng), position: Vector3::from_fn(|_, _| 2.0 * rng.normal()) }
}

fn is_positive(m: &Manipulator, pose: &Pose) -> bool {
    plucker_matrix(m, pose, m.size()).determinant() > 0.0
}

#[test]
fn the_form_of_degree_18_is_the_determinant_times_the_sixth_power_of_the_norm() {
    let mut rng = Rng::new(1);
    for _ in 0..5 {
        let (m, x, y) = (design(&mut rng), pose(&mut rng), pose(&mut rng));
        let c = determinant(&m, &Curve::straight(&x, &y));
        assert_eq!(c.len(), 19);
        let (e0, e1) = quaternions(&x, &y);
        let mut factor = None;
        for u in [0.0, 0.3, 0.77, 0.99_f64] {
            let (mut value, mut weight) = (0.0, (1.0 - u).powi(18));
            for (k, c) in c.iter().enumerate() {
                value += c.centre_and_radius().0 * weight;
                weight *= (18 - k) as f64 / (k + 1) as f64 * u / (1.0 - u);
            }
            let norm: f64 = e0.iter().zip(e1).map(|(p, q)| (p * (1.0 - u) + q * u).powi(2)).sum();
            let direct = plucker_matrix(&m, &between(&x, &y, u), m.size()).determinant() * norm.powi(6);
            let own = *factor.get_or_insert(value / direct);
            assert!(
                own > 0.0 && (value - own * direct).abs() < 1e-9 * (1.0 + value.abs()),
                "{value} {direct}"
            );
        }
    }
}

#[test]
fn proved_signs_are_those_of_the_determinant_and_changes_are_where_it_vanishes() {
    let mut rng = Rng::new(2);
    let (mut kept, mut changed) = (0, 0);
    for _ in 0..60 {
        let (m, x, y) = (design(&mut rng), pose(&mut rng), pose(&mut rng));
        let found = signs_along(&m, &x, &y);
        assert!((found.pieces[0].from, found.pieces[found.pieces.len() - 1].to) == (0.0, 1.0));
        assert!(
            found
                .pieces
                .windows(2)
                .all(|w| w[0].to.to_bits() == w[1].from.to_bits() && w[0].sign != w[1].sign)
        );
        for piece in found.pieces.iter().filter(|p| p.to - p.from > 1e-6) {
            let middle = between(&x, &y, 0.5 * (piece.from + piece.to));
            assert_eq!(piece.sign.map(|s| s == Sign::Positive), Some(is_positive(&m, &middle)));
        }
        for change in found.changes() {
            assert!(change.to - change.from < 1e-9);
            changed += 1;
        }
        // a sampled change is never missed
        let signs: Vec<bool> =
            (0..=200).map(|k| is_positive(&m, &between(&x, &y, f64::from(k) / 200.0))).collect();
        let sampled = signs.windows(2).filter(|w| w[0] != w[1]).count();
        let proved = found.changes().count();
        assert!(proved >= sampled && (proved - sampled).is_multiple_of(2));
        kept += usize::from(found.kept().is_some());
    }
    assert!(kept > 3 && changed > 20, "{kept} {changed}");
}

#[test]
fn the_straight_path_turns_about_one_axis_the_short_way() {
    let x = Pose { rotation: Rotation3::identity(), position: Vector3::zeros() };
    let axis = Vector3::new(0.6, 0.0, 0.8);
    let y = Pose { rotation: Rotation3::new(axis * 2.0), position: Vector3::new(2.0, 0.0, 0.0) };
    let middle = between(&x, &y, 0.5);
    assert!((rotation_vector(&middle.rotation) - axis).norm() < 1e-12);
    assert!((middle.position - Vector3::x()).norm() < 1e-15);
    let end = between(&x, &y, 1.0);
    assert!(turn_between(&y.rotation, &end.rotation).norm() < 1e-7);
}

#[test]
fn ways_keep_the_sign_and_opposite_signs_are_never_joined() {
    let mut rng = Rng::new(7);
    let m = design(&mut rng);
    let poses: Vec<Pose> = (0..6).map(|_| pose(&mut rng)).collect();
    let joined = join(&m, &poses, &JoinOptions { samples: 600, seed: 1 });
    assert_eq!(joined.groups.iter().map(Vec::len).sum::<usize>(), 6);
    for g in &joined.groups {
        assert!(g.iter().all(|k| joined.signs[*k] == joined.signs[g[0]]));
    }
    assert_eq!(joined.ways.len(), 6 - joined.groups.len());
    assert!(!joined.ways.is_empty());
    for way in &joined.ways {
        assert_eq!((way.poses[0], way.poses[way.poses.len() - 1]), (poses[way.from], poses[way.to]));
        let sign = joined.signs[way.from].unwrap();
        assert!(way.poses.windows(2).all(|w| signs_along(&m, &w[0], &w[1]).kept() == Some(sign)));
    }
    assert_eq!(joined, join(&m, &poses, &JoinOptions { samples: 600, seed: 1 }));
}

#[test]
fn a_singular_pose_has_no_proved_sign_and_stands_alone() {
    // all legs meet the line x = y = 0, so the rotation about it is free
    let legs = std::array::from_fn(|k| {
        let (s, c) = (k as f64).sin_cos();
        Leg { base: Point3::new(2.0 * c, 2.0 * s, 0.1 * k as f64), platform: Point3::new(c, s, 0.0) }
    });
    let m = Manipulator::from_legs(legs).unwrap();
    let flat = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 3.0) };
    let joined = join(&m, &[flat], &JoinOptions { samples: 10, seed: 1 });
    assert_eq!((joined.signs, joined.groups), (vec![None], vec![vec![0]]));
}

/// A straight path as a cubic curve has the signs of the straight path, and a cubic curve those at its poses.
#[test]
fn signs_on_curves_are_those_at_their_poses() {
    let mut rng = Rng::new(9);
    let mut changed = 0;
    for _ in 0..12 {
        let (m, x, y) = (design(&mut rng), pose(&mut rng), pose(&mut rng));
        let [a, b] = straight(&x, &y);
        let mix = |u: f64| -> ControlPoint { std::array::from_fn(|k| a[k] * (1.0 - u) + b[k] * u) };
        let cubic = signs_on_curve(&m, &[a, mix(1.0 / 3.0), mix(2.0 / 3.0), b]);
        let line = signs_along(&m, &x, &y);
        assert_eq!(cubic.ends(), line.ends());
        let places = |s: &SignsAlong| s.changes().map(|c| (1e6 * c.from).round()).collect::<Vec<_>>();
        assert_eq!(places(&cubic), places(&line));
        let other = straight(&pose(&mut rng), &pose(&mut rng));
        let control = [a, other[0], other[1], b];
        let found = signs_on_curve(&m, &control);
        changed += found.changes().count();
        for piece in found.pieces.iter().filter(|p| p.to - p.from > 1e-6) {
            let u = 0.5 * (piece.from + piece.to);
            let weights =
                [(1.0 - u).powi(3), 3.0 * u * (1.0 - u).powi(2), 3.0 * u * u * (1.0 - u), u.powi(3)];
            let at: [f64; 7] = std::array::from_fn(|k| (0..4).map(|i| weights[i] * control[i][k]).sum());
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(at[3], at[4], at[5], at[6]));
            let there =
                Pose { rotation: turn.to_rotation_matrix(), position: Vector3::new(at[0], at[1], at[2]) };
            assert_eq!(piece.sign.map(|s| s == Sign::Positive), Some(is_positive(&m, &there)));
        }
    }
    assert!(changed > 3);
}
