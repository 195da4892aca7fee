//! Platforms for the tests of `synthesis` and `machine`, which include this file.

use nalgebra::Point3;

use platform::manipulator::{Leg, Manipulator};

/// A hexapod with joints in pairs 20 degrees apart on two circles, at the corners of triangles rotated against each
/// other.
pub(crate) fn symmetric_hexapod(base_radius: f64, platform_radius: f64) -> Manipulator {
    const BASE: [f64; 6] = [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0];
    const PLATFORM: [f64; 6] = [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0];
    let at = |deg: f64, radius: f64| {
        let (s, c) = deg.to_radians().sin_cos();
        Point3::new(radius * c, radius * s, 0.0)
    };
    let leg = |i: usize| Leg { base: at(BASE[i], base_radius), platform: at(PLATFORM[i], platform_radius) };
    Manipulator::from_legs(std::array::from_fn(leg)).unwrap()
}
