//! A platform as a small picture without words.

use super::oblique::{BaseFrame, Bodies, Extent};
use super::style::Svg;
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// Width and height, pixels.
const SIZE: (f64, f64) = (140.0, 110.0);
const MARGIN: f64 = 8.0;

/// The platform at a pose in oblique projection, as large as the picture allows; the name is for screen readers.
#[must_use]
pub fn thumbnail(m: &Manipulator, pose: &Pose, name: &str) -> String {
    let bodies = Bodies::new(m, pose, &BaseFrame::of(m));
    let extent = Extent::of(bodies.corners());
    let scale = extent.scale((SIZE.0 - 2.0 * MARGIN, SIZE.1 - 2.0 * MARGIN));
    let middle = |(low, high): (f64, f64)| 0.5 * (low + high);
    let (x, y) = (middle(extent.across), middle(extent.up));
    let mut svg = Svg::new(SIZE.0, SIZE.1, name, "The platform at home, seen from the side and above");
    bodies.draw(&mut svg, "leg", |p| (0.5 * SIZE.0 + (p.0 - x) * scale, 0.5 * SIZE.1 - (p.1 - y) * scale));
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::manipulator::{Leg, default_home};

    #[test]
    fn a_thumbnail_has_two_bodies_and_six_legs_within_its_frame() {
        let m = Manipulator::from_legs(std::array::from_fn(|i| {
            let (s, c) = (1.0 + i as f64).sin_cos();
            Leg {
                base: Point3::new(200.0 * c, 200.0 * s, 0.0),
                platform: Point3::new(90.0 * s, 90.0 * c, 3.0),
            }
        }))
        .unwrap();
        let svg = thumbnail(&m, &default_home(&m), "a < b");
        assert_eq!((svg.matches("<line").count(), svg.matches("<polygon").count()), (6, 2));
        assert!(svg.contains("a &lt; b"));
        for part in svg.split("x1=\"").skip(1) {
            let x: f64 = part.split('"').next().unwrap().parse().unwrap();
            assert!((0.0..=SIZE.0).contains(&x), "{x}");
        }
    }
}
