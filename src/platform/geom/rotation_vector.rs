//! The rotation vector of a rotation: its axis times its angle in radians, at most half a turn.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

/// `w` with `exp([w]x) = R`, `|w| <= pi`, with all its digits near zero and near half a turn.
///
/// It uses the quaternion (Shepperd 1978). The arc cosine of the trace loses half of the digits near zero, and is NaN
/// if rounding makes the trace larger than 3. The skew part of the matrix does not contain the axis of a half turn.
pub fn rotation_vector(r: &Rotation3<f64>) -> Vector3<f64> {
    UnitQuaternion::from_rotation_matrix(r).scaled_axis()
}

/// Rotation vector, base frame, of the rotation from `from` to `to`.
pub fn turn_between(from: &Rotation3<f64>, to: &Rotation3<f64>) -> Vector3<f64> {
    rotation_vector(&(to * from.inverse()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random_rotation;
    use num::Rng;

    #[test]
    fn a_rotation_is_that_of_its_vector_at_all_angles() {
        let rng = &mut Rng::new(7);
        for angle in [0.0, 1e-300, 1e-17, 1e-12, 1e-8, 1e-4, 1.0, 3.0, 3.1, std::f64::consts::PI - 1e-9] {
            for _ in 0..20 {
                let axis = random_rotation(rng) * Vector3::x();
                let w = axis * angle;
                let found = rotation_vector(&Rotation3::new(w));
                assert!((found - w).norm() <= 4e-15 * angle + 1e-300, "{w:?} {found:?}");
            }
        }
    }

    #[test]
    fn rounded_rotations_are_no_turn_apart() {
        let rng = &mut Rng::new(8);
        let mut beyond = 0;
        for _ in 0..200 {
            let r = random_rotation(rng);
            let again = r * Rotation3::new(Vector3::new(1e-17, 0.0, 0.0));
            let product = again * r.inverse();
            beyond += usize::from(product.matrix().trace() > 3.0);
            assert!(turn_between(&r, &again).norm() < 2e-15);
        }
        // the arc cosine of the trace is undefined at these
        assert!(beyond > 0);
    }

    #[test]
    fn half_turns_have_their_axis() {
        for axis in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(0.6, 0.0, 0.8)] {
            let half = 2.0 * axis * axis.transpose() - nalgebra::Matrix3::identity();
            let w = rotation_vector(&Rotation3::from_matrix_unchecked(half));
            assert!((w.norm() - std::f64::consts::PI).abs() < 1e-15 && w.cross(&axis).norm() < 1e-15);
        }
    }
}
