//! The circle of a joint that two legs carry.

use nalgebra::Vector3;
use num_complex::Complex64;

/// The points with given squared distances to two fixed points, `c + r (cos t e1 + sin t e2)` with `w = exp(i t)`.
///
/// The squared distance of such a point from a third fixed point, a virtual leg, is `x0 + x1 w + x2 / w`: each value of it belongs to two points,
/// one for each sign of the radical of a trilateration, and `w` takes the place of the length and the sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    centre: Vector3<Complex64>,
    across: [Vector3<Complex64>; 2],
}

impl Circle {
    /// `None` when the two fixed points coincide.
    pub(super) fn new(feet: [Vector3<f64>; 2], s: [Complex64; 2]) -> Option<Self> {
        let axis = feet[1] - feet[0];
        let d = axis.norm();
        let axis = axis / d;
        if !axis.iter().all(|x| x.is_finite()) {
            return None;
        }
        let along = (s[0] - s[1] + d * d) / (2.0 * d);
        let radius = (s[0] - along * along).sqrt();
        let e1 = perpendicular(&axis);
        let e2 = axis.cross(&e1);
        let centre = complex(&feet[0]) + complex(&axis) * along;
        Some(Self { centre, across: [complex(&e1) * radius, complex(&e2) * radius] })
    }

    /// The point and its derivative by the angle.
    pub(super) fn at(&self, w: Complex64) -> (Vector3<Complex64>, Vector3<Complex64>) {
        let inverse = w.inv();
        let (cosine, sine) = ((w + inverse) * 0.5, (w - inverse) * Complex64::new(0.0, -0.5));
        let [e1, e2] = &self.across;
        (self.centre + e1 * cosine + e2 * sine, e2 * cosine - e1 * sine)
    }
}

/// A unit vector at right angles to a unit vector.
pub(super) fn perpendicular(axis: &Vector3<f64>) -> Vector3<f64> {
    let least = axis.iamin();
    let mut other = Vector3::zeros();
    other[least] = 1.0;
    axis.cross(&other).normalize()
}

pub(super) fn complex(v: &Vector3<f64>) -> Vector3<Complex64> {
    v.map(Complex64::from)
}
