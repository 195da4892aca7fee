//! The equations against derivatives, energies and closed forms.

use nalgebra::{Matrix3, Matrix6, Point3, Rotation3, Vector3, Vector6};

use super::inverse::{MovingLeg, turned_inertia};
use super::*;
use crate::requirements::{
    ForceUnit, Hardware, LegMasses, LegPart, LegsWeight, Load, MassUnit, Payload, PlateMass, Requirements,
    TermKind, Terms, leg_forces,
};
use crate::requirements::{VibratingMasses, lowest_frequency, softest_of};
use num::Rng;
use platform::geom::random_rotation;
use platform::manipulator::{Leg, Manipulator, default_home, jacobian};

fn hexapod(rng: &mut Rng) -> Manipulator {
    let mut at = |deg: f64, r: f64| {
        let (s, c) = deg.to_radians().sin_cos();
        Point3::new(r * c + 0.1 * rng.normal(), r * s + 0.1 * rng.normal(), 0.1 * rng.normal())
    };
    let base = [-15.0, 15.0, 105.0, 135.0, 225.0, 255.0];
    let platform = [-45.0, 45.0, 75.0, 165.0, 195.0, 285.0];
    Manipulator::from_legs(std::array::from_fn(|i| Leg {
        base: at(base[i], 2.0),
        platform: at(platform[i], 1.2),
    }))
    .unwrap()
}

fn bodies() -> MovingBodies {
    let turn = Rotation3::from_euler_angles(0.3, 0.2, -0.5);
    let payload = Payload {
        mass: 3.0,
        center: Point3::new(0.2, -0.1, 0.7),
        inertia: Some(
            turn.matrix() * Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0)) * turn.matrix().transpose(),
        ),
        gravity: Vector3::new(1.0, -2.0, -9.0),
        plate: PlateMass::Included,
        shape: None,
    };
    let leg = LegMasses {
        cylinder: LegPart { mass: 0.5, center: 0.4, inertia: 0.03 },
        rod: LegPart { mass: 0.3, center: 0.5, inertia: 0.02 },
        reflected: 0.7,
    };
    MovingBodies::new(&payload, Some(&leg), MassUnit::Kilogram, 1.0)
}

/// Poses near home at times that are not evenly spread.
fn path(m: &Manipulator, rng: &mut Rng, ends: PathEnds) -> PosePath {
    let home = default_home(m);
    let mut time = 0.0;
    let rows: Vec<(f64, Pose)> = (0..9)
        .map(|_| {
            time += rng.uniform(0.1, 0.3);
            let wander = |rng: &mut Rng, by: f64| Vector3::from_fn(|_, _| by * rng.normal());
            let position = home.position + wander(rng, 0.1);
            let turn = wander(rng, 0.1);
            (time, Pose { rotation: Rotation3::new(turn) * home.rotation, position })
        })
        .collect();
    let (times, poses): (Vec<f64>, Vec<Pose>) = rows.into_iter().unzip();
    PosePath::through(&times, &poses, ends).unwrap()
}

/// Fourth-order central difference.
fn derivative(f: impl Fn(f64) -> f64, t: f64) -> f64 {
    let h = 1e-3;
    (8.0 * (f(t + h) - f(t - h)) - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h)
}

/// Times within the pieces of a path, farther from the knots than the step of the differences.
fn inner_times(path: &PosePath) -> Vec<f64> {
    path.times().windows(2).flat_map(|t| [0.3, 0.6].map(|x| t[0] + x * (t[1] - t[0]))).collect()
}

/// Power of the drives less the change of the energy, over the size of both.
fn imbalance(m: &Manipulator, bodies: &MovingBodies, of_energy: &MovingBodies, path: &PosePath) -> f64 {
    let mut worst = 0.0_f64;
    for t in inner_times(path) {
        let state = path.at(t);
        let forces = drive_forces(m, bodies, &state, &Vector6::zeros()).unwrap();
        let legs = leg_motions(m, &state);
        let power: f64 = (0..6).map(|i| forces[i] * legs[i].speed).sum();
        let scale: f64 = (0..6).map(|i| (forces[i] * legs[i].speed).abs()).sum();
        let energy = |t: f64| {
            let state = path.at(t);
            kinetic_energy(m, of_energy, &state) + potential_energy(m, of_energy, &state)
        };
        worst = worst.max((power - derivative(energy, t)).abs() / scale);
    }
    worst
}

#[test]
fn drives_give_the_energy_that_the_bodies_gain() {
    let mut rng = Rng::new(11);
    for _ in 0..5 {
        let m = hexapod(&mut rng);
        let (bodies, path) = (bodies(), path(&m, &mut rng, PathEnds::Free));
        let found = imbalance(&m, &bodies, &bodies, &path);
        assert!(found < 1e-7, "{found}");
        // each mass counts: an energy that leaves out a part is not balanced
        let without: [fn(&mut MovingBodies); 6] = [
            |b| b.inertia *= 1.01,
            |b| b.center.x += 0.01,
            |b| b.leg.cylinder.inertia += 0.01,
            |b| b.leg.rod.mass += 0.01,
            |b| b.leg.reflected += 0.01,
            |b| b.gravity.z += 0.01,
        ];
        for change in without {
            let mut other = bodies;
            change(&mut other);
            let found = imbalance(&m, &bodies, &other, &path);
            assert!(found > 1e-5, "{found}");
        }
    }
}

#[test]
fn speeds_and_accelerations_are_derivatives_of_lengths() {
    let mut rng = Rng::new(12);
    let m = hexapod(&mut rng);
    for ends in [PathEnds::Free, PathEnds::AtRest] {
        let path = path(&m, &mut rng, ends);
        for t in inner_times(&path) {
            let legs = leg_motions(&m, &path.at(t));
            for (i, leg) in legs.iter().enumerate() {
                let speed = derivative(|t| leg_motions(&m, &path.at(t))[i].length, t);
                let acceleration = derivative(|t| leg_motions(&m, &path.at(t))[i].speed, t);
                assert!((leg.speed - speed).abs() < 1e-7, "{} {speed}", leg.speed);
                assert!(
                    (leg.acceleration - acceleration).abs() < 1e-5,
                    "{} {acceleration}",
                    leg.acceleration
                );
            }
        }
    }
}

#[test]
fn a_path_goes_through_its_poses_with_continuous_accelerations() {
    let mut rng = Rng::new(13);
    let m = hexapod(&mut rng);
    for ends in [PathEnds::Free, PathEnds::AtRest] {
        let path = path(&m, &mut rng, ends);
        for t in &path.times()[1..path.times().len() - 1] {
            let (before, after) = (path.at(t - 1e-9), path.at(t + 1e-9));
            assert!((before.acceleration - after.acceleration).norm() < 1e-5);
            assert!((before.angular_acceleration - after.angular_acceleration).norm() < 1e-5);
        }
        let (first, last) = (path.at(path.times()[0]), path.at(*path.times().last().unwrap()));
        let rests = |s: &MotionState| s.velocity.norm() + s.angular_velocity.norm() < 1e-12;
        assert_eq!(rests(&first) && rests(&last), ends == PathEnds::AtRest);
    }
}

#[test]
fn few_poses_and_polynomials_are_followed_exactly() {
    let pose = |t: f64, degree: i32| Pose {
        rotation: Rotation3::identity(),
        position: Vector3::new(t.powi(degree), 1.0 - t, 2.0),
    };
    for (count, degree) in [(2, 1), (3, 2), (4, 3), (7, 3)] {
        let times: Vec<f64> = (0..count).map(|k| 0.5 * f64::from(k) + 0.05 * f64::from(k * k)).collect();
        let poses: Vec<Pose> = times.iter().map(|t| pose(*t, degree)).collect();
        let path = PosePath::through(&times, &poses, PathEnds::Free).unwrap();
        for t in [0.1, 0.3, 0.52] {
            let (found, d) = (path.at(t), f64::from(degree));
            assert!((found.pose.position - pose(t, degree).position).norm() < 1e-12, "{count}");
            assert!((found.velocity.x - d * t.powi(degree - 1)).abs() < 1e-11);
            assert!((found.acceleration.x - d * (d - 1.0) * t.powi(degree - 2)).abs() < 1e-10);
        }
    }
}

/// The sampled sine comes nearer to the sine with the second order of the step in its acceleration.
#[test]
fn a_sampled_manoeuvre_converges_to_the_manoeuvre() {
    let mut rng = Rng::new(14);
    let about = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(1.0, 2.0, 3.0) };
    let roll = Manoeuvre::sine("roll:20:1").unwrap();
    let error = |steps: i32| {
        let times: Vec<f64> = (0..=steps).map(|k| f64::from(k) / f64::from(steps)).collect();
        let poses: Vec<Pose> = times.iter().map(|t| roll.at(&about, *t).pose).collect();
        let path = PosePath::through(&times, &poses, PathEnds::Free).unwrap();
        (0..500)
            .map(|k| 0.25 + 0.001 * f64::from(k))
            .map(|t| (path.at(t).angular_acceleration - roll.at(&about, t).angular_acceleration).norm())
            .fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(32), error(64));
    assert!((3.0..5.0).contains(&(coarse / fine)), "{coarse} {fine}");
    assert!(fine < 0.05 * 20.0_f64.to_radians() * 39.5);
}

#[test]
fn a_manoeuvre_has_the_derivatives_of_its_poses() {
    let mut rng = Rng::new(15);
    let about = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(1.0, 2.0, 3.0) };
    for freedom in PlatformFreedom::ALL {
        let sine = Manoeuvre::sine(&format!("{}:0.4:2", freedom.name())).unwrap();
        assert!((sine.duration() - 0.5).abs() < 1e-15);
        for t in [0.0, 0.11, 0.3] {
            let found = sine.at(&about, t);
            let point = Vector3::new(0.3, -0.2, 0.4);
            let (velocity, acceleration) = found.of_arm(&(found.pose.rotation * point));
            for k in 0..3 {
                let at = |t: f64| sine.at(&about, t).pose.transform(&Point3::from(point))[k];
                let speed_at = |t: f64| {
                    let state = sine.at(&about, t);
                    state.of_arm(&(state.pose.rotation * point)).0[k]
                };
                assert!((derivative(at, t) - velocity[k]).abs() < 1e-7);
                assert!((derivative(speed_at, t) - acceleration[k]).abs() < 1e-5);
            }
        }
        let start = Manoeuvre::acceleration(&format!("{}:-3", freedom.name())).unwrap().at(&about, 0.0);
        assert_eq!(start.pose, about);
        let turns = freedom.is_turn();
        let size = if turns { 3.0_f64.to_radians() } else { 3.0 };
        assert!((start.acceleration.norm() - if turns { 0.0 } else { size }).abs() < 1e-14);
        assert!((start.angular_acceleration.norm() - if turns { size } else { 0.0 }).abs() < 1e-14);
    }
    for bad in ["x:1", "w:1:1", "x:0:1", "x:1:-1", "x:a:1", "x:1:1:1"] {
        assert!(Manoeuvre::sine(bad).is_err(), "{bad}");
    }
    for bad in ["x", "x:inf", "up:1"] {
        assert!(Manoeuvre::acceleration(bad).is_err(), "{bad}");
    }
}

#[test]
fn at_rest_the_drives_hold_the_weight_as_the_requirements_say() {
    let mut rng = Rng::new(16);
    let m = hexapod(&mut rng);
    let payload = Payload {
        mass: 4.0,
        center: Point3::new(0.1, 0.2, 0.5),
        inertia: None,
        gravity: Vector3::new(0.0, 0.0, -9.8),
        plate: PlateMass::Included,
        shape: None,
    };
    // the same design in millimetres has the same forces in newtons
    let bodies = MovingBodies::new(&payload, None, MassUnit::Kilogram, 1.0);
    let pose = Pose { rotation: Rotation3::from_euler_angles(0.1, 0.2, 0.3), ..default_home(&m) };
    let found = drive_forces(&m, &bodies, &MotionState::at_rest(pose), &Vector6::zeros()).unwrap();
    let weight = payload.weight(MassUnit::Kilogram, ForceUnit::Newton).wrench(&m, &pose);
    let expected = leg_forces(&m, &pose, &weight, 1.0).unwrap();
    assert!((0..6).all(|i| (found[i] - expected[i]).abs() < 1e-10));
    // the same load twice: once as the weight, once beside it
    let doubled = drive_forces(&m, &bodies, &MotionState::at_rest(pose), &weight).unwrap();
    assert!((0..6).all(|i| (doubled[i] - 2.0 * found[i]).abs() < 1e-10));
}

/// Statics of requirements and inverse dynamics agree at rest, for legs that weigh more or less than the payload. The
/// two are derived separately.
#[test]
fn loads_at_rest_are_held_by_the_forces_of_the_inverse_dynamics() {
    let mut rng = Rng::new(31);
    let (newton, kilogram) = (ForceUnit::Newton, MassUnit::Kilogram);
    for k in 0..60 {
        let m = hexapod(&mut rng);
        let mut part = |heavy: bool| LegPart {
            mass: if heavy { rng.uniform(0.1, 8.0) } else { 0.0 },
            center: rng.uniform(0.0, 1.5),
            inertia: 0.1,
        };
        let legs = LegMasses { cylinder: part(k % 4 != 1), rod: part(k % 4 != 2), reflected: 0.4 };
        let payload = Payload {
            mass: if k % 3 == 0 { 0.0 } else { rng.uniform(0.5, 9.0) },
            center: Point3::new(0.2, -0.4, rng.uniform(-0.5, 1.0)),
            inertia: Some(Matrix3::identity()),
            gravity: Vector3::new(3.0 * rng.normal(), 3.0 * rng.normal(), -9.8),
            plate: PlateMass::Included,
            shape: None,
        };
        let bodies = MovingBodies::new(&payload, Some(&legs), kilogram, 1.0);
        let weight = LegsWeight::new(&legs, &payload.gravity, kilogram, newton);
        let load = Load { legs: weight, ..payload.weight(kilogram, newton) };
        let greatest = 1e4;
        let hardware = Hardware { max_leg_force: Some(greatest), ..Hardware::default() };
        let required = Requirements { hardware, loads: vec![load.clone()], ..Requirements::default() };
        let home = default_home(&m);
        let terms = Terms::new(&m, &required, &home);
        for _ in 0..20 {
            let wander = |rng: &mut Rng, by: f64| Vector3::from_fn(|_, _| by * rng.normal());
            let position = home.position + wander(&mut rng, 0.3);
            let pose = Pose { rotation: Rotation3::new(wander(&mut rng, 0.3)) * home.rotation, position };
            let moving = drive_forces(&m, &bodies, &MotionState::at_rest(pose), &Vector6::zeros()).unwrap();
            let moving = Vector6::from(moving);
            let held = leg_forces(&m, &pose, &load.wrench(&m, &pose), m.size()).unwrap();
            assert!((moving - held).amax() <= 1e-9 * moving.amax(), "{k}: {moving} {held}");
            for (term, margin) in terms.at(&pose) {
                assert_eq!(term.kind, TermKind::LegForce);
                let off = greatest - margin - moving[term.first].abs();
                assert!(off.abs() <= 1e-9 * moving.amax(), "{k}: {off} of {moving}");
            }
        }
    }
}

/// A rod alone, its centre at its joint, hangs on the joint as a point mass does.
#[test]
fn rods_with_their_centres_at_the_joints_weigh_as_a_payload_there() {
    let mut rng = Rng::new(37);
    let m = hexapod(&mut rng);
    let gravity = Vector3::new(0.0, 0.0, -9.8);
    let rod = LegPart { mass: 2.0, center: 0.0, inertia: 0.0 };
    let legs = LegMasses { rod, ..LegMasses::default() };
    let (newton, kilogram) = (ForceUnit::Newton, MassUnit::Kilogram);
    let middle = m.legs().iter().map(|leg| leg.platform.coords).sum::<Vector3<f64>>() / 6.0;
    let payload = Payload {
        mass: 12.0,
        center: middle.into(),
        inertia: None,
        gravity,
        plate: PlateMass::Included,
        shape: None,
    };
    let nothing = Payload { mass: 0.0, ..payload };
    let of_rods =
        Load { legs: LegsWeight::new(&legs, &gravity, kilogram, newton), ..nothing.weight(kilogram, newton) };
    let pose = Pose { rotation: Rotation3::from_euler_angles(0.1, 0.2, 0.3), ..default_home(&m) };
    let of_payload = payload.weight(kilogram, newton).wrench(&m, &pose);
    assert!((of_rods.wrench(&m, &pose) - of_payload).amax() < 1e-12 * of_payload.amax());
    assert_eq!(
        LegsWeight::new(&LegMasses { reflected: 3.0, ..LegMasses::default() }, &gravity, kilogram, newton),
        None
    );
}

#[test]
fn newtons_do_not_depend_on_the_unit_of_length() {
    let mut rng = Rng::new(17);
    let m = hexapod(&mut rng);
    let large = Manipulator::from_legs(
        m.legs().map(|l| Leg { base: l.base * 1000.0, platform: l.platform * 1000.0 }),
    )
    .unwrap();
    let path = path(&m, &mut rng, PathEnds::Free);
    let metres = bodies();
    let mut millimetres = metres;
    millimetres.center *= 1000.0;
    millimetres.inertia *= 1e6;
    millimetres.gravity *= 1000.0;
    millimetres.metres = 1e-3;
    for part in [&mut millimetres.leg.cylinder, &mut millimetres.leg.rod] {
        part.center *= 1000.0;
        part.inertia *= 1e6;
    }
    for t in inner_times(&path) {
        let state = path.at(t);
        let mut scaled = state;
        scaled.pose.position *= 1000.0;
        scaled.velocity *= 1000.0;
        scaled.acceleration *= 1000.0;
        let a = drive_forces(&m, &metres, &state, &Vector6::zeros()).unwrap();
        let b = drive_forces(&large, &millimetres, &scaled, &Vector6::zeros()).unwrap();
        assert!((0..6).all(|i| (a[i] - millimetres.newtons(b[i])).abs() < 1e-9 * a[i].abs().max(1.0)));
    }
}

#[test]
fn a_singular_pose_has_no_forces() {
    // all legs parallel
    let m = Manipulator::from_legs(std::array::from_fn(|i| {
        let (s, c) = (1.1 * i as f64).sin_cos();
        Leg { base: Point3::new(c, s, 0.0), platform: Point3::new(c, s, 0.0) }
    }))
    .unwrap();
    let pose = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 2.0) };
    let state = MotionState::at_rest(pose);
    assert_eq!(drive_forces(&m, &bodies(), &state, &Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)), None);
}

#[test]
fn the_mass_matrix_is_that_of_the_kinetic_energy() {
    let mut rng = Rng::new(18);
    let m = hexapod(&mut rng);
    let bodies = bodies();
    let path = path(&m, &mut rng, PathEnds::Free);
    for t in inner_times(&path) {
        let state = path.at(t);
        let (v, w) = (state.velocity, state.angular_velocity);
        let twist = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        let energy = 0.5 * twist.dot(&(mass_matrix(&m, &bodies, &state.pose) * twist));
        let expected = kinetic_energy(&m, &bodies, &state);
        assert!((energy - expected).abs() < 1e-12 * expected);
    }
}

#[test]
fn natural_motions_solve_the_equation_and_springs_give_way_as_they_should() {
    let mut rng = Rng::new(19);
    let m = hexapod(&mut rng);
    let bodies = bodies();
    let pose = default_home(&m);
    let (k, mass) = (2.5e4, mass_matrix(&m, &bodies, &pose));
    let stiffness = stiffness_matrix(&m, &pose, k);
    let found = vibration(&m, &pose, k, &mass).unwrap();
    let omega = |v: &Vibration| std::f64::consts::TAU * v.frequency;
    for v in &found {
        let rest = stiffness * v.shape - mass * v.shape * omega(v).powi(2);
        assert!(rest.norm() < 1e-9 * (stiffness * v.shape).norm(), "{v:?}");
        assert!((v.shape.dot(&(mass * v.shape)) - 1.0).abs() < 1e-9);
    }
    assert!(found.windows(2).all(|w| w[0].frequency <= w[1].frequency));
    let trace = (mass.try_inverse().unwrap() * stiffness).trace();
    let sum: f64 = found.iter().map(|v| omega(v).powi(2)).sum();
    assert!((trace - sum).abs() < 1e-9 * sum);
    // four times the stiffness, twice the frequency
    let stiff = vibration(&m, &pose, 4.0 * k, &mass).unwrap();
    assert!(
        (0..6).all(|i| (stiff[i].frequency - 2.0 * found[i].frequency).abs() < 1e-9 * stiff[i].frequency)
    );
    // the least stiffness is that of the worst direction
    let least = least_stiffness(&stiffness).unwrap();
    let compliance: Matrix6<f64> = stiffness.try_inverse().unwrap();
    let mut softest = [f64::INFINITY; 2];
    for _ in 0..4000 {
        let d = random_rotation(&mut rng) * Vector3::x();
        for (part, soft) in softest.iter_mut().enumerate() {
            let mut push = Vector6::zeros();
            push.fixed_rows_mut::<3>(3 * part).copy_from(&d);
            *soft = soft.min(1.0 / push.dot(&(compliance * push)));
        }
    }
    assert!(least.linear <= softest[0] * (1.0 + 1e-12) && least.linear > 0.99 * softest[0]);
    assert!(least.angular <= softest[1] * (1.0 + 1e-12) && least.angular > 0.99 * softest[1]);
    // a point mass at the origin has no rotational inertia
    let mut point = bodies;
    (point.inertia, point.center, point.leg) = (Matrix3::zeros(), Point3::origin(), LegMasses::default());
    assert_eq!(vibration(&m, &pose, k, &mass_matrix(&m, &point, &pose)), None);
}

#[test]
fn what_is_no_motion_is_refused_with_the_row() {
    let pose = |deg: f64| Pose {
        rotation: Rotation3::from_axis_angle(&Vector3::z_axis(), deg.to_radians()),
        position: Vector3::zeros(),
    };
    let through = |times: &[f64], turns: &[f64]| {
        let poses: Vec<Pose> = turns.iter().map(|t| pose(*t)).collect();
        PosePath::through(times, &poses, PathEnds::Free).map(|_| ())
    };
    assert_eq!(through(&[0.0], &[0.0]), Err(InvalidPath::TooShort));
    assert_eq!(
        through(&[0.0, 1.0, 1.0], &[0.0; 3]),
        Err(InvalidPath::NotLater { row: 2, time: 1.0, before: 1.0 })
    );
    assert!(
        matches!(through(&[0.0, 1.0], &[0.0, 91.0]), Err(InvalidPath::TurnsTooFar { row: 1, degrees }) if (degrees - 91.0).abs() < 1e-9)
    );
    // a whole turn and more, in steps
    let (times, turns): (Vec<f64>, Vec<f64>) = (0..20).map(|k| (f64::from(k), 40.0 * f64::from(k))).unzip();
    let poses: Vec<Pose> = turns.iter().map(|t| pose(*t)).collect();
    let path = PosePath::through(&times, &poses, PathEnds::Free).unwrap();
    assert!((path.at(9.5).angular_velocity.z - 40.0_f64.to_radians()).abs() < 1e-3);
}

/// Two formulas of each: inverses of `K` and of `J`, singular values with and without the inverse of `M`.
#[test]
fn what_a_requirement_looks_at_is_what_the_stiffness_matrix_says() {
    let mut rng = Rng::new(23);
    for _ in 0..20 {
        let m = hexapod(&mut rng);
        let pose = path(&m, &mut rng, PathEnds::Free).at(0.3).pose;
        let leg = 3e4;
        let by_matrix = least_stiffness(&stiffness_matrix(&m, &pose, leg)).unwrap();
        let direct = softest_of(Some(&jacobian(&m, &pose, m.size())), m.size(), leg);
        assert!((direct.linear / by_matrix.linear - 1.0).abs() < 1e-9);
        assert!((direct.angular / by_matrix.angular - 1.0).abs() < 1e-9);
        let all = vibration(&m, &pose, leg, &mass_matrix(&m, &bodies(), &pose)).unwrap();
        let lowest = lowest_frequency(&m, &pose, &VibratingMasses { bodies: bodies(), leg });
        assert!((lowest / all[0].frequency - 1.0).abs() < 1e-9, "{lowest} {all:?}");
        // a point mass has a lowest frequency, though no matrix that can be inverted
        let mut point = bodies();
        (point.inertia, point.leg) = (Matrix3::zeros(), LegMasses::default());
        assert_eq!(vibration(&m, &pose, leg, &mass_matrix(&m, &point, &pose)), None);
        let slow = lowest_frequency(&m, &pose, &VibratingMasses { bodies: point, leg });
        let small = nalgebra::Matrix3::identity() * 1e-9;
        point.inertia = small;
        let near = vibration(&m, &pose, leg, &mass_matrix(&m, &point, &pose)).unwrap()[0].frequency;
        assert!((slow / near - 1.0).abs() < 1e-6, "{slow} {near}");
    }
}

/// Kinetic energy of platform, payload and legs, kilograms times design units squared per second squared.
fn kinetic_energy(m: &Manipulator, bodies: &MovingBodies, state: &MotionState) -> f64 {
    let center = state.pose.rotation * bodies.center.coords;
    let (velocity, _) = state.of_arm(&center);
    let turning = state.angular_velocity;
    let platform =
        bodies.mass * velocity.norm_squared() + turning.dot(&(turned_inertia(bodies, state) * turning));
    let legs = m.legs().map(|leg| {
        let leg = MovingLeg::new(&leg, state);
        leg.inertia(bodies) * leg.turning.norm_squared()
            + (bodies.leg.rod.mass + bodies.leg.reflected) * leg.motion.speed.powi(2)
    });
    0.5 * (platform + legs.iter().sum::<f64>())
}

/// Potential energy of the weights, zero for bodies at the origin of the base frame.
fn potential_energy(m: &Manipulator, bodies: &MovingBodies, state: &MotionState) -> f64 {
    let center = state.pose.transform(&bodies.center).coords;
    let legs = m.legs().map(|leg| {
        let moving = MovingLeg::new(&leg, state);
        let at = |distance: f64| leg.base.coords + moving.along * distance;
        bodies.leg.cylinder.mass * at(bodies.leg.cylinder.center)
            + bodies.leg.rod.mass * at(moving.rod_at(bodies))
    });
    -bodies.gravity.dot(&(bodies.mass * center + legs.iter().sum::<Vector3<f64>>()))
}
