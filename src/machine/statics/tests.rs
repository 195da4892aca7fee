use super::*;
use crate::requirements::{leg_forces, stiffness_matrix};
use nalgebra::Rotation3;
use num::Rng;
use platform::geom::Pose;
use platform::manipulator::{Leg, Manipulator, jacobian};

fn machine(rng: &mut Rng) -> (Manipulator, Pose) {
    let mut ring = |radius: f64, i: usize| {
        let angle = std::f64::consts::FRAC_PI_3 * (i as f64 + rng.uniform(-0.4, 0.4));
        nalgebra::Point3::new(radius * angle.cos(), radius * angle.sin(), rng.uniform(-0.1, 0.1))
    };
    let legs =
        std::array::from_fn(|i| Leg { base: ring(2.0, i + i % 2), platform: ring(1.0, i + 1 - i % 2) });
    let m = Manipulator::from_legs(legs).unwrap();
    let rotation = Rotation3::from_euler_angles(0.2, -0.3, 0.5);
    let size = m.size();
    (m, Pose { rotation, position: Vector3::new(0.1, -0.2, 1.7) * size })
}

/// The lengths after a small motion of a point, by the definition of a length.
fn lengths_after(m: &Manipulator, pose: &Pose, point: &Vector3<f64>, twist: &Vector6<f64>) -> Vector6<f64> {
    let (shift, turn): (Vector3<f64>, Vector3<f64>) =
        (twist.fixed_rows::<3>(0).into(), twist.fixed_rows::<3>(3).into());
    let rotation = Rotation3::new(turn) * pose.rotation;
    let position = pose.position + pose.rotation * point - rotation * point + shift;
    Vector6::from(Pose { rotation, position }.lengths(m).unwrap().get())
}

#[test]
fn no_small_motion_of_the_held_platform_does_work() {
    let rng = &mut Rng::new(21);
    for _ in 0..30 {
        let (m, pose) = machine(rng);
        let point = Vector3::from_fn(|_, _| rng.normal()) * m.size();
        let statics = PoseStatics::new(&jacobian(&m, &pose, 1.0), &(pose.rotation * point), m.size());
        let wrench = Vector6::from_fn(|_, _| rng.normal());
        let forces = statics.efforts(&wrench).unwrap();
        for _ in 0..5 {
            let twist = Vector6::from_fn(|_, _| rng.normal());
            let h = 1e-6;
            let change = lengths_after(&m, &pose, &point, &(twist * h))
                - lengths_after(&m, &pose, &point, &(twist * -h));
            let work = forces.dot(&change) / (2.0 * h) + wrench.dot(&twist);
            let scale = forces.amax() * change.amax() / h + wrench.amax();
            assert!(work.abs() < 1e-7 * scale, "{work:e} of {scale:e}");
        }
        assert!((statics.wrench(&forces) - wrench).amax() < 1e-9 * forces.amax() * m.size());
        // the same forces hold the same load about the origin
        let (force, torque): (Vector3<f64>, Vector3<f64>) =
            (wrench.fixed_rows::<3>(0).into(), wrench.fixed_rows::<3>(3).into());
        let torque = torque + (pose.rotation * point).cross(&force);
        let about_origin = Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z);
        let known = leg_forces(&m, &pose, &about_origin, m.size()).unwrap();
        assert!((known - forces).amax() < 1e-8 * known.amax());
    }
}

#[test]
fn a_step_of_one_leg_moves_the_point_as_its_column_says() {
    let rng = &mut Rng::new(22);
    for _ in 0..30 {
        let (m, pose) = machine(rng);
        let point = Vector3::from_fn(|_, _| rng.normal()) * m.size();
        let statics = PoseStatics::new(&jacobian(&m, &pose, 1.0), &(pose.rotation * point), m.size());
        let motions = statics.motions().unwrap();
        let before = Vector6::from(pose.lengths(&m).unwrap().get());
        for leg in 0..6 {
            let column = motions.column(leg).into_owned();
            let step = 1e-6 * m.size() / (column.amax() * m.size()).max(1.0);
            let change = (lengths_after(&m, &pose, &point, &(column * step)) - before) / step;
            let expected = Vector6::ith(leg, 1.0);
            assert!((change - expected).amax() < 1e-3, "{leg}: {change}");
            // the screw is the same motion: points of its axis move along it
            let screw = statics.screw(leg).unwrap();
            let velocity: Vector3<f64> = column.fixed_rows::<3>(0).into();
            let turn: Vector3<f64> = column.fixed_rows::<3>(3).into();
            let on_axis = velocity + turn.cross(&screw.point);
            let along = turn * screw.pitch.unwrap();
            assert!((on_axis - along).amax() < 1e-9 * velocity.amax().max(1e-9));
        }
    }
    let shift = Screw::of(&Vector6::new(0.0, 0.0, 2.0, 0.0, 1e-16, 0.0), 1.0);
    assert_eq!((shift.direction, shift.pitch), (Vector3::z(), None));
}

#[test]
fn stiffness_is_the_change_of_energy_at_every_point_and_in_every_axes() {
    let rng = &mut Rng::new(23);
    for _ in 0..20 {
        let (m, pose) = machine(rng);
        let point = Vector3::from_fn(|_, _| rng.normal()) * m.size();
        let rows = jacobian(&m, &pose, 1.0);
        let statics = PoseStatics::new(&rows, &(pose.rotation * point), m.size());
        let springs: [f64; 6] = std::array::from_fn(|_| rng.uniform(1.0, 3.0));
        let stiffness = statics.stiffness(&springs);
        let twist = Vector6::from_fn(|_, _| rng.normal());
        let h = 1e-4;
        let before = Vector6::from(pose.lengths(&m).unwrap().get());
        let stretched = |s: f64| -> f64 {
            let change = lengths_after(&m, &pose, &point, &(twist * s)) - before;
            (0..6).map(|i| 0.5 * springs[i] * change[i] * change[i]).sum()
        };
        let energy = (stretched(h) + stretched(-h)) / (2.0 * h * h);
        let known = 0.5 * twist.dot(&(stiffness * twist));
        assert!((energy - known).abs() < 1e-5 * known, "{energy} {known}");
        // energy does not depend on axes
        let axes = Rotation3::from_euler_angles(rng.normal(), rng.normal(), rng.normal());
        let turned = in_axes(&stiffness, axes.matrix());
        let own = both_in(axes.matrix()).transpose() * twist;
        assert!((0.5 * own.dot(&(turned * own)) - known).abs() < 1e-9 * known);
        // equal legs about the origin: the matrix of the requirements
        let origin = PoseStatics::new(&rows, &Vector3::zeros(), m.size());
        assert!(
            (origin.stiffness(&[2.0; 6]) - stiffness_matrix(&m, &pose, 2.0)).amax() < 1e-9 * m.size().powi(2)
        );
        // a force through the point gives way as the least stiffness allows
        let least = statics.least_stiffness(&springs).unwrap();
        let compliance = stiffness.try_inverse().unwrap();
        for _ in 0..20 {
            let mut force = Vector6::from_fn(|k, _| if k < 3 { rng.normal() } else { 0.0 });
            force /= force.norm();
            let given = (compliance * force).dot(&force);
            assert!(1.0 / given >= least.linear * (1.0 - 1e-6));
        }
    }
}

#[test]
fn a_singular_pose_has_no_forces_and_no_motions() {
    let rows = Matrix6::from_fn(|i, j| if i == 5 { 1.0 } else { f64::from(u8::from(i == j)) });
    let mut twice = rows;
    twice.set_row(5, &rows.row(0).into_owned());
    let statics = PoseStatics::new(&twice, &Vector3::zeros(), 1.0);
    assert!(statics.motions().is_none() && statics.screw(0).is_none());
    assert!(statics.efforts(&Vector6::repeat(1.0)).is_none() && statics.least_stiffness(&[1.0; 6]).is_none());
}
