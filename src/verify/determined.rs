//! Distant poses that coordinates in double precision do not determine.

use fk::FkRoot;
use platform::geom::ComplexPose;

/// Expected relative error of joints computed and rounded to doubles.
pub(super) const ROUNDED: f64 = 64.0 * f64::EPSILON;
/// Poses with smaller numbers are not distant, however badly conditioned: rounding moves them, but not to infinity.
const FAR: f64 = 100.0;

/// The largest of 1, the moduli of `R` and those of `p` over the size.
pub(super) fn magnitude(p: &ComplexPose, size: f64) -> f64 {
    let r = p.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
    p.position.iter().map(|z| z.norm() / size).fold(r, f64::max)
}

/// Whether joints within rounding of the given ones may lack this pose: to first order they reach `e.e = 0`, where it
/// is at infinity.
///
/// Let `M` be the [`magnitude`] of the pose and `kappa` its condition number in dual quaternions. Relative errors `eps`
/// of the joints change `e.e` by up to `2 eps kappa M` of itself (`docs/theory/leg-maps.md`).
pub(super) fn is_beyond_precision(root: &FkRoot, size: f64) -> bool {
    let magnitude = magnitude(&root.pose, size);
    magnitude > FAR && 2.0 * ROUNDED * root.condition.max(1.0) * magnitude >= 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use fk::Reality;
    use nalgebra::{Matrix3, Vector3};
    use num_complex::Complex64;

    fn root(r: f64, p: f64, condition: f64) -> FkRoot {
        let pose = ComplexPose {
            rotation: Matrix3::repeat(Complex64::new(0.0, r)),
            position: Vector3::repeat(Complex64::new(p, 0.0)),
        };
        FkRoot::new(pose, Reality::NonReal, 1e-15, condition)
    }

    #[test]
    fn far_and_badly_conditioned_poses_are_beyond_precision_and_no_others() {
        let of = |r, p, condition| is_beyond_precision(&root(r, p, condition), 10.0);
        // values of the worked isolator
        assert!(of(1.1e13, 1.0, 2.6e11) && of(6.5e11, 1.0, 1.0e11));
        // near the simple end of a path
        assert!(of(1e15, 1.0, 1.0) && of(1.0, 1e16, 1.0));
        // near an end where two meet: displacements of the square root of rounding
        assert!(of(1e8, 1.0, 1e8));
        // distant, but determined by the joints
        assert!(!of(1e9, 1.0, 100.0) && !of(500.0, 1.0, 1e3) && !of(1.0, 1e10, 100.0));
        // hardly determined, but not distant
        assert!(!of(50.0, 1.0, 1e15));
    }
}
