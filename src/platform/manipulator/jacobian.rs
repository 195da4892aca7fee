//! The length-normalised Jacobian and its condition number.

use nalgebra::Matrix6;

use super::{Leg, Manipulator};
use crate::geom::Pose;
use num::small::singular_values;

/// The matrix of normalised leg lines at a pose: row `i` is `[u_i, ((R b_i) x u_i) / L]`.
///
/// `u_i` is the unit vector from base joint to platform joint (base frame). The moment is about the platform origin,
/// and `L` is a characteristic length in design units. Rows thus map the twist `(v, L omega)` to leg speeds. A leg of
/// length zero has no direction: its row is NaN. Source: Merlet, *Parallel Robots* (2006), sec. 5.3, with the moment
/// column scaled by `L`.
#[must_use]
pub fn jacobian(m: &Manipulator, pose: &Pose, characteristic_length: f64) -> Matrix6<f64> {
    jacobian_of_legs(&m.legs(), pose, characteristic_length)
}

/// [`jacobian()`] for separate legs.
#[inline]
pub fn jacobian_of_legs(legs: &[Leg; 6], pose: &Pose, characteristic_length: f64) -> Matrix6<f64> {
    let mut j = Matrix6::zeros();
    for (i, leg) in legs.iter().enumerate() {
        let arm = pose.rotation * leg.platform.coords;
        let line = arm + pose.position - leg.base.coords;
        let u = line / line.norm();
        let moment = arm.cross(&u) / characteristic_length;
        j.fixed_view_mut::<1, 3>(i, 0).copy_from(&u.transpose());
        j.fixed_view_mut::<1, 3>(i, 3).copy_from(&moment.transpose());
    }
    j
}

/// The same rows without division by the leg lengths: `[d_i, ((R b_i) x d_i) / L]`, `d_i = R b_i + p - a_i`.
///
/// They are polynomial in the pose; `1/2 ds_i/dt = row_i . (v, L omega)`, so that `J' = A J` for leg maps.
#[must_use]
pub fn plucker_matrix(m: &Manipulator, pose: &Pose, characteristic_length: f64) -> Matrix6<f64> {
    let mut j = Matrix6::zeros();
    for (i, leg) in m.legs().iter().enumerate() {
        let arm = pose.rotation * leg.platform.coords;
        let line = arm + pose.position - leg.base.coords;
        let moment = arm.cross(&line) / characteristic_length;
        j.fixed_view_mut::<1, 3>(i, 0).copy_from(&line.transpose());
        j.fixed_view_mut::<1, 3>(i, 3).copy_from(&moment.transpose());
    }
    j
}

/// `det J` of the leg lines with all lengths over the size, without unit: its zeros are the singular poses.
pub fn leg_determinant(m: &Manipulator, pose: &Pose) -> f64 {
    let unit = m.size();
    plucker_matrix(m, pose, unit).determinant() / unit.powi(6)
}

/// `sigma_min / sigma_max` of a 6 x 6 matrix, in `[0, 1]`; 0 for a matrix with entries that are not finite.
#[must_use]
pub fn inverse_condition(j: &Matrix6<f64>) -> f64 {
    let Some(s) = singular_values(j) else { return 0.0 };
    let (max, min) = (s.max(), s.min());
    if max > 0.0 { min / max } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manipulator::Leg;
    use nalgebra::{Point3, Rotation3, Vector3};

    #[test]
    fn rows_are_derivatives_of_squared_lengths() {
        let m = Manipulator::from_legs(std::array::from_fn(|i| {
            let t = i as f64;
            Leg {
                base: Point3::new(2.0 * t.cos(), 2.0 * t.sin(), 0.1 * t),
                platform: Point3::new((1.3 * t).sin(), (0.7 * t).cos(), 0.2),
            }
        }))
        .unwrap();
        let pose = Pose {
            rotation: Rotation3::from_euler_angles(0.2, -0.1, 0.4),
            position: Vector3::new(0.1, 0.2, 3.0),
        };
        let (length, h) = (1.7, 1e-6);
        let j = plucker_matrix(&m, &pose, length);
        let normalised = jacobian(&m, &pose, length);
        for k in 0..6 {
            let unit = Vector3::ith(k % 3, h);
            let moved = if k < 3 {
                Pose { position: pose.position + unit, ..pose }
            } else {
                // L omega = unit, hence omega = unit / L
                Pose { rotation: Rotation3::new(unit / length) * pose.rotation, ..pose }
            };
            for (i, leg) in m.legs().iter().enumerate() {
                let ds = (moved.squared_length(leg) - pose.squared_length(leg)) / (2.0 * h);
                assert!((ds - j[(i, k)]).abs() < 1e-4, "leg {i}, direction {k}");
                let l = pose.squared_length(leg).sqrt();
                assert!((normalised[(i, k)] * l - j[(i, k)]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn inverse_condition_of_a_scaled_identity_is_one_and_of_nan_zero() {
        assert!((inverse_condition(&(Matrix6::identity() * 7.0)) - 1.0).abs() < 1e-14);
        assert!(inverse_condition(&(Matrix6::identity() * f64::NAN)).abs() < 1e-14);
    }
}
