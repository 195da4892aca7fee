//! Directions perpendicular to others.

use nalgebra::Vector3;

/// A unit vector perpendicular to `d`: the coordinate axis farthest from `d`, made normal to it.
pub fn any_across(d: &Vector3<f64>) -> Vector3<f64> {
    let axis = d.iamin();
    let mut e = Vector3::zeros();
    e[axis] = 1.0;
    let d = d.try_normalize(0.0).unwrap_or_else(Vector3::z);
    (e - d * d.dot(&e)).normalize()
}
