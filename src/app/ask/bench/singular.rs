//! Problems at and near singular poses.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::generator::{NotDrawn, Problem, body, legs};
use num::Rng;
use platform::geom::{Pose, any_pose};
use platform::manipulator::{Leg, Manipulator, SquaredLegLengths};

/// A close pair of poses. At a random pose the last base joint is moved so that the six leg lines belong to one linear
/// complex. For this the leg's vector `d` is normal to `v + w x R b` for the twist `(v, w)` reciprocal to the other
/// five. Two poses meet there, and squared lengths about `1e-12` off separate them by about `1e-6`.
pub(super) fn close_pair(rng: &mut Rng) -> Result<Problem, NotDrawn> {
    let mut joints = legs(body(rng, false), body(rng, false));
    let pose = any_pose(rng);
    let arm = |leg: &Leg| pose.rotation * leg.platform.coords;
    let mut lines = nalgebra::Matrix6::zeros();
    for (i, leg) in joints.iter().take(5).enumerate() {
        let d = arm(leg) + pose.position - leg.base.coords;
        let moment = arm(leg).cross(&d);
        lines.fixed_view_mut::<1, 3>(i, 0).copy_from(&d.transpose());
        lines.fixed_view_mut::<1, 3>(i, 3).copy_from(&moment.transpose());
    }
    let gram = (lines.transpose() * lines).symmetric_eigen();
    let twist = gram.eigenvectors.column(gram.eigenvalues.imin()).into_owned();
    let (v, w) = (Vector3::new(twist[0], twist[1], twist[2]), Vector3::new(twist[3], twist[4], twist[5]));
    let last = arm(&joints[5]);
    let velocity = (v + w.cross(&last)).normalize();
    let tip = last + pose.position;
    let d = tip - joints[5].base.coords;
    joints[5].base = Point3::from(tip - (d - velocity * d.dot(&velocity)));
    let manipulator = Manipulator::from_legs(joints)?;
    let mut squares = pose.squared_lengths(&manipulator).ok_or(NotDrawn::Lengths)?.get();
    squares[5] += 1e-12 * rng.uniform(0.5, 2.0) * if rng.unit() < 0.5 { -1.0 } else { 1.0 };
    let squares = SquaredLegLengths::try_new(squares).map_err(|_| NotDrawn::Lengths)?;
    Ok(Problem { manipulator, squares, pose: None })
}

/// A random integer in `-limit..=limit`.
fn integer(rng: &mut Rng, limit: u64) -> f64 {
    (rng.next_u64() % (2 * limit + 1)) as f64 - limit as f64
}

fn integers(rng: &mut Rng, limit: u64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| integer(rng, limit))
}

/// One of the 24 rotations of the cube, which doubles represent exactly.
fn cube_rotation(rng: &mut Rng) -> Matrix3<f64> {
    let mut order = [0, 1, 2];
    for i in (1..3).rev() {
        order.swap(i, (rng.next_u64() % (i as u64 + 1)) as usize);
    }
    let mut r = Matrix3::zeros();
    for (i, j) in order.into_iter().enumerate() {
        r[(i, j)] = if rng.unit() < 0.5 { -1.0 } else { 1.0 };
    }
    if r.determinant() < 0.0 { -r } else { r }
}

/// A pose at which all leg lines belong to one linear complex; all its coordinates are integers over 32.
///
/// For a twist `(v, w)` of small integers every leg vector is `d = (v + w x t) x e`, with `t` its tip on the platform.
/// No leg length then changes to first order along the twist. The rotation of the pose is a rotation of the cube.
/// Joints and squared lengths are computed without rounding, so the pose is an exact double root.
pub(super) fn double_root(rng: &mut Rng) -> Result<Problem, NotDrawn> {
    singular_design(rng).map(|(problem, _)| problem)
}

/// A problem with a double root, and the root. The harness does not use the root, since it would take it for a regular
/// one.
fn singular_design(rng: &mut Rng) -> Result<(Problem, Pose), NotDrawn> {
    let (rotation, position) = (cube_rotation(rng), integers(rng, 8) / 8.0);
    let (v, w) = (integers(rng, 16) / 8.0, integers(rng, 2));
    let mut out = [(Leg { base: Point3::origin(), platform: Point3::origin() }, 0.0); 6];
    for (leg, square) in &mut out {
        let tip = integers(rng, 16) / 8.0;
        let velocity = v + w.cross(&tip);
        // zero only for directions along the velocity
        let mut draw = || velocity.cross(&integers(rng, 3)) / 4.0;
        let d = (0..64).map(|_| draw()).find(|d| d.norm() > 0.0).ok_or(NotDrawn::NoLeg)?;
        *leg = Leg { base: (tip - d).into(), platform: (rotation.transpose() * (tip - position)).into() };
        *square = d.norm_squared();
    }
    let manipulator = Manipulator::from_legs(out.map(|l| l.0))?;
    let squares = SquaredLegLengths::try_new(out.map(|l| l.1)).map_err(|_| NotDrawn::Lengths)?;
    let pose = Pose { rotation: Rotation3::from_matrix_unchecked(rotation), position };
    Ok((Problem { manipulator, squares, pose: None }, pose))
}

#[cfg(test)]
mod tests {
    use super::*;
    use platform::manipulator::jacobian;

    #[test]
    fn a_double_root_is_a_singular_pose_with_exactly_the_given_lengths() {
        for k in 0..50 {
            let (problem, pose) = singular_design(&mut Rng::new(k)).unwrap();
            let (m, s) = (&problem.manipulator, problem.squares.get());
            for (leg, s) in m.legs().iter().zip(s) {
                let on_grid = |x: &f64| (32.0 * x).fract() == 0.0 && x.abs() < 1e3;
                assert!(leg.base.iter().chain(leg.platform.iter()).all(on_grid));
                // this grid avoids rounding, so the identity holds between rational numbers
                assert!((pose.squared_length(leg) - s).abs() == 0.0 && s > 0.0);
            }
            let sines = jacobian(m, &pose, m.size()).singular_values();
            assert!(sines[5] < 1e-12 * sines[0] && sines[4] > 1e-4 * sines[0], "{k}: {sines}");
        }
    }
}
