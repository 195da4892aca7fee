//! Roots that come in pairs by symmetry.
//!
//! Let base and platform be planar, and reflect the scene in the base plane and the platform in its own plane. All leg
//! lengths stay, and `x -> S R S' x + ...` is a pose again. Both bodies must be planar, since the mirror image of a
//! spatial body is another body.

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use platform::geom::ComplexPose;
use platform::manipulator::Manipulator;

/// Reflection `x -> x - 2 n (n.x - d)` in a plane that holds six leg ends.
#[derive(Debug, Clone, Copy)]
struct Reflection {
    linear: Matrix3<f64>,
    shift: Vector3<f64>,
}

/// The two reflections of a doubly planar platform.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlanarReflections {
    base: Reflection,
    platform: Reflection,
}

/// The plane through the points; `None` if they are off it by more than `1e-12` of their spread.
fn reflection(points: [Vector3<f64>; 6]) -> Option<Reflection> {
    let mut normal = Vector3::zeros();
    for i in 0..6 {
        for j in 0..i {
            let n = (points[i] - points[5]).cross(&(points[j] - points[5]));
            if n.norm() > normal.norm() {
                normal = n;
            }
        }
    }
    let spread = points.iter().map(|p| (p - points[5]).norm()).fold(0.0, f64::max);
    let n = normal.try_normalize(1e-12 * spread * spread)?;
    let flat = points.iter().all(|p| (p - points[5]).dot(&n).abs() <= 1e-12 * spread);
    flat.then(|| Reflection {
        linear: Matrix3::identity() - n * n.transpose() * 2.0,
        shift: n * (2.0 * n.dot(&points[5])),
    })
}

impl PlanarReflections {
    /// The mirror symmetry of a platform with two planar bodies.
    pub(super) fn of(m: &Manipulator) -> Option<Self> {
        let legs = m.legs();
        let base = reflection(legs.map(|l| l.base.coords))?;
        Some(Self { base, platform: reflection(legs.map(|l| l.platform.coords))? })
    }

    /// The mirror pose: a solution as accurate as the given one, up to rounding.
    pub(super) fn image(&self, pose: &ComplexPose) -> ComplexPose {
        let lift = |m: &Matrix3<f64>| m.map(Complex64::from);
        let (s, t) = (lift(&self.base.linear), lift(&self.platform.linear));
        let turned = pose.rotation * self.platform.shift.map(Complex64::from) + pose.position;
        ComplexPose {
            rotation: s * pose.rotation * t,
            position: s * turned + self.base.shift.map(Complex64::from),
        }
    }
}
