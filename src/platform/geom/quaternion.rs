//! Rotations from quaternions `e = (e0, e1, e2, e3)`, scalar part first.

use num_complex::Complex64;

/// `R(e)` with `R x = e x e^{-1}`: quadratic in `e`, divided by `N = e.e`. Defined for complex `e` with `N != 0`.
#[must_use]
pub fn rotation_from_quaternion(e: [Complex64; 4]) -> nalgebra::Matrix3<Complex64> {
    let [w, x, y, z] = e;
    let n = w * w + x * x + y * y + z * z;
    let two = Complex64::new(2.0, 0.0);
    nalgebra::Matrix3::new(
        w * w + x * x - y * y - z * z,
        two * (x * y - w * z),
        two * (x * z + w * y),
        two * (x * y + w * z),
        w * w - x * x + y * y - z * z,
        two * (y * z - w * x),
        two * (x * z - w * y),
        two * (y * z + w * x),
        w * w - x * x - y * y + z * z,
    ) / n
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::UnitQuaternion;

    #[test]
    fn agrees_with_the_rotation_of_nalgebra() {
        let q = UnitQuaternion::from_euler_angles(0.3, -1.1, 2.0);
        let e = [q.w, q.i, q.j, q.k].map(|x| Complex64::new(3.0 * x, 0.0));
        let r = rotation_from_quaternion(e).map(|z| z.re);
        assert!((r - q.to_rotation_matrix().matrix()).norm() < 1e-14);
    }
}
