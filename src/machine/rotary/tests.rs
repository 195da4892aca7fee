use nalgebra::{Point3, Rotation3, Unit, Vector3, Vector6};

use super::{Crank, Elbow, InvalidRotary, RotaryLeg, RotaryPlatform, RotaryTracker};
use fk::{FkOptions, NearOutcome, NearSolver, Reality, WhyLost};
use num::Rng;
use platform::geom::{Angles, Pose, rotation_vector, turn_between};

/// Reachy Mini by Pollen Robotics in millimetres, rounded to a micrometre, with its three-fold and mirror symmetry
/// written out. The data are `motor_arm_length`, `rod_length`, `head_z_offset`, the poses of the motors and
/// `branch_position`. They come from `src/reachy_mini/assets/kinematics_data.json` of
/// github.com/pollen-robotics/reachy_mini, commit 70a7c0b (Apache-2.0).
fn reachy_mini() -> RotaryPlatform {
    let turn = |k: usize| Rotation3::from_axis_angle(&Vector3::z_axis(), (120.0 * k as f64).to_radians());
    let legs = std::array::from_fn(|i| {
        // legs 3 and 4 are the pair at the back; 5, 6 and 1, 2 are its rotated images
        let (pair, side) = ([2, 2, 0, 0, 1, 1][i], if i % 2 == 0 { 1.0 } else { -1.0 });
        let place = |x: f64, y: f64, z: f64| Point3::from(turn(pair) * Vector3::new(x, side * y, z));
        RotaryLeg {
            crank: Crank {
                centre: place(-36.661, 10.0, 76.633),
                axis: Unit::new_normalize(turn(pair) * Vector3::x()),
                zero: turn(pair) * Vector3::new(0.0, side, 0.0),
                length: 40.0,
            },
            rod: 85.0,
            platform: place(-29.172, 7.0, 0.0),
            elbow: if side > 0.0 { Elbow::Minus } else { Elbow::Plus },
            limits: None,
        }
    });
    RotaryPlatform::try_new(legs).unwrap()
}

fn home() -> Pose {
    Pose::new([0.0, 0.0, 177.0], Angles::from_degrees([0.0; 3]))
}

/// A pose that the cranks can hold, within 15 mm and 20 degrees of home.
fn drawn(m: &RotaryPlatform, rng: &mut Rng) -> Pose {
    loop {
        let mut vector = |x: f64| Vector3::from_fn(|_, _| rng.uniform(-x, x));
        let (shift, turn) = (vector(15.0), vector(20f64.to_radians()));
        let pose = Pose { rotation: Rotation3::new(turn), position: home().position + shift };
        // away from the edge of reach, where a crank is singular
        let well = |q: [f64; 6]| m.transmissions(&pose, &q).iter().all(|t| t.abs() > 0.2);
        if m.ik(&pose).is_ok_and(well) {
            return pose;
        }
    }
}

#[test]
fn both_angles_hold_the_platform_and_the_side_is_kept() {
    let m = reachy_mini();
    let angles = m.ik(&home()).unwrap();
    // the value from the maker's data: 35.898 degrees, with the sign of the motor
    for (i, angle) in angles.iter().enumerate() {
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        assert!((angle.to_degrees() - sign * 35.898).abs() < 0.01, "{i}: {}", angle.to_degrees());
    }
    let mut rng = Rng::new(5);
    for _ in 0..100 {
        let pose = drawn(&m, &mut rng);
        let both = m.both_angles(&pose).unwrap();
        for (i, leg) in m.legs().iter().enumerate() {
            for elbow in [Elbow::Plus, Elbow::Minus] {
                let tip = m.tip(i, both[i].of(elbow));
                assert!(((pose.transform(&leg.platform) - tip).norm() - 85.0).abs() < 1e-12);
                assert!(((tip - leg.crank.centre).norm() - 40.0).abs() < 1e-12);
            }
        }
        let angles = m.ik(&pose).unwrap();
        let transmissions = m.transmissions(&pose, &angles);
        // the sign of the transmission is the side
        assert!((0..6).all(|i| (transmissions[i] < 0.0) == (i % 2 == 1)), "{transmissions:?}");
    }
}

#[test]
fn a_pose_out_of_reach_names_the_leg_and_what_is_missing() {
    let m = reachy_mini();
    let far = Pose { position: Vector3::new(0.0, 0.0, 300.0), ..home() };
    let missing = m.both_angles(&far).unwrap_err();
    assert!(missing.leg == 0 && missing.by > 0.0);
    // a rod longer by the missing length reaches, with crank and rod in line
    let longer = |by: f64| {
        let mut legs = *m.legs();
        for leg in &mut legs {
            leg.rod += by;
        }
        RotaryPlatform::try_new(legs).unwrap()
    };
    assert!(longer(missing.by + 1e-9).both_angles(&far).is_ok());
    assert!(longer(missing.by - 1e-6).both_angles(&far).is_err());
    let at_edge = longer(missing.by + 1e-9);
    let angles = at_edge.ik(&far).unwrap();
    assert!(at_edge.transmissions(&far, &angles)[0].abs() < 1e-3, "the crank is singular there");
    // and one that is too long
    let near = Pose { position: Vector3::new(0.0, 0.0, 76.633), ..home() };
    let too_long = m.both_angles(&near).unwrap_err();
    assert!(too_long.by < 0.0 && longer(too_long.by - 1e-9).both_angles(&near).is_ok());
}

#[test]
fn speeds_are_derivatives_and_torques_do_the_work_of_the_load() {
    let m = reachy_mini();
    let mut rng = Rng::new(6);
    for _ in 0..20 {
        let pose = drawn(&m, &mut rng);
        let angles = m.ik(&pose).unwrap();
        let rows = m.crank_jacobian(&pose, &angles).unwrap();
        let twist = Vector6::from_fn(|k, _| rng.normal() * if k < 3 { 10.0 } else { 0.1 });
        let moved = |t: f64| {
            let turn: Vector3<f64> = twist.fixed_rows::<3>(3) * t;
            let shift: Vector3<f64> = twist.fixed_rows::<3>(0) * t;
            let moved =
                Pose { rotation: Rotation3::new(turn) * pose.rotation, position: pose.position + shift };
            m.ik(&moved).unwrap()
        };
        let (before, after) = (moved(-1e-5), moved(1e-5));
        let speeds = rows * twist;
        for i in 0..6 {
            let difference = (after[i] - before[i]) / 2e-5;
            assert!((speeds[i] - difference).abs() < 1e-6 * (1.0 + difference.abs()), "{i}");
        }
        let wrench = Vector6::new(0.5, -0.2, -9.0, 20.0, -10.0, 5.0);
        let torques = Vector6::from(m.torques(&pose, &angles, &wrench).unwrap());
        // the power of the drives equals that of the load
        let work = torques.dot(&speeds) + wrench.dot(&twist);
        assert!(work.abs() < 1e-8 * wrench.norm() * twist.norm(), "{work}");
    }
}

#[test]
#[ignore = "evidence"]
fn reachy_mini_has_sixteen_real_poses_at_home_and_the_nearest_wrong_one_is_turned_by_a_hundred_degrees() {
    let m = reachy_mini();
    let angles = m.ik(&home()).unwrap();
    let found = m.fk(&angles, &FkOptions::new()).unwrap();
    assert!(found.roots.iter().all(fk::FkRoot::certified));
    let real: Vec<Pose> = found.real_poses().collect();
    assert_eq!(real.len(), 16);
    assert!(found.roots.iter().filter(|r| r.reality == Reality::Real).all(|r| r.residual < 1e-12));
    let apart = |p: &Pose| (p.position - home().position, rotation_vector(&p.rotation).norm().to_degrees());
    let mut others: Vec<(Vector3<f64>, f64)> = real.iter().map(apart).collect();
    others.sort_by(|a, b| a.0.norm().total_cmp(&b.0.norm()));
    assert!(others[0].0.norm() < 1e-6 && others[0].1 < 1e-6, "home is one of them");
    let (shift, turn) = others[1];
    assert!((-19.0..-17.0).contains(&shift.z) && (95.0..105.0).contains(&turn), "{others:?}");
}

#[test]
fn the_tracker_keeps_the_head_upright_where_newtons_method_flips_it() {
    let m = reachy_mini();
    let start = m.ik(&home()).unwrap();
    let mut rng = Rng::new(7);
    let mut tracker = RotaryTracker::new(m.clone(), home(), start);
    let (mut flips, mut lost) = (0, 0);
    for _ in 0..200 {
        let truth = drawn(&m, &mut rng);
        let angles = m.ik(&truth).unwrap();
        match tracker.step(&angles).unwrap() {
            NearOutcome::Tracked { pose, .. } => {
                assert!((pose.position - truth.position).norm() < 1e-6, "the pose the angles are of");
                assert!((pose.rotation.matrix() - truth.rotation.matrix()).norm() < 1e-8);
            }
            _ => lost += 1,
        }
        // plain Newton steps from a distant pose, as after a restart: some end silently at another assembly mode
        let solver = NearSolver::new(&m.at(&angles).unwrap());
        let tilt = Rotation3::new(Vector3::from_fn(|_, _| rng.uniform(-1.5, 1.5)));
        let guess = Pose { rotation: tilt, ..home() };
        let squares = m.rods().squared();
        if let Some(end) = solver.newton_steps(&squares, &guess, 30) {
            let solved = NearSolver::new(&m.at(&angles).unwrap()).solve(&squares, &end);
            let flipped = turn_between(&truth.rotation, &end.rotation).norm() > 0.5;
            flips += usize::from(flipped && solved.evidence().residual < 1e-10);
        }
    }
    assert_eq!(lost, 0);
    assert!(flips > 0, "Newton's method takes wrong modes from some starts");
}

#[test]
fn a_crank_that_would_turn_too_often_is_lost() {
    let m = reachy_mini();
    let start = m.ik(&home()).unwrap();
    let mut tracker = RotaryTracker::new(m, home(), start);
    let with = |turns: f64| {
        let mut angles = start;
        angles[4] += std::f64::consts::TAU * turns;
        angles
    };
    for turns in [80.0, 1e6, -1e6, 1e300] {
        let outcome = tracker.step(&with(turns)).unwrap();
        let NearOutcome::Lost { reason, fraction, pose, evidence } = outcome else { panic!("{outcome:?}") };
        assert!(reason == WhyLost::AnglesTooFar && pose == home() && fraction.abs() < f64::MIN_POSITIVE);
        assert!(evidence.residual < 1e-12 && evidence.frobenius_ratio > 0.01, "of the pose where it stays");
        let stays = tracker.angles().iter().zip(&start).all(|(x, y)| x.to_bits() == y.to_bits());
        assert!(stays, "the tracker stays at its angles");
    }
    assert!(tracker.step(&with(f64::INFINITY)).is_err() && tracker.step(&with(f64::NAN)).is_err());
    // parts are followed one by one up to the greatest step, and small ones reach their end
    let far = tracker.step(&with(79.0)).unwrap();
    assert!(far.tracked().is_none() && far.evidence().segments > 1, "the crank is not free to turn: {far:?}");
    assert!(tracker.step(&with(1e-3)).unwrap().tracked().is_some());
}

#[test]
fn what_makes_no_platform_is_refused() {
    let m = reachy_mini();
    let with = |change: fn(&mut RotaryLeg)| {
        let mut legs = *m.legs();
        change(&mut legs[2]);
        RotaryPlatform::try_new(legs).unwrap_err()
    };
    assert_eq!(with(|l| l.rod = 0.0), InvalidRotary::BadNumber(2));
    assert_eq!(with(|l| l.crank.length = f64::NAN), InvalidRotary::BadNumber(2));
    assert_eq!(with(|l| l.crank.zero = l.crank.axis.into_inner()), InvalidRotary::ZeroAlongAxis(2));
    let mut legs = *m.legs();
    legs[0].limits = Some((0.0, 1.0));
    let limited = RotaryPlatform::try_new(legs).unwrap();
    assert!(limited.within_limits(&[0.5; 6]) && !limited.within_limits(&[1.5; 6]));
    assert!((limited.limit_margins(&[0.9; 6])[0] - 0.1).abs() < 1e-15);
    assert_eq!(limited.beyond_limits(&[f64::NAN, 2.0, -2.0, 0.0, 0.0, 0.0]), [1]);
}
