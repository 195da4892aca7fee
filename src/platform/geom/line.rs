//! The line of best fit of nearly collinear points.

use nalgebra::{Matrix3, Point3, Unit, Vector3};
use num::small::symmetric_eigen3;

/// A line, with the distances of the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BestLine {
    /// The centroid of the points, which is on the line.
    pub point: Point3<f64>,
    /// The direction of the line.
    pub direction: Unit<Vector3<f64>>,
    /// The greatest distance of a point from the line.
    pub distance: f64,
    /// The greatest distance of a point from the centroid along the line.
    pub reach: f64,
}

impl BestLine {
    /// The line with the least sum of squared distances from the points (Pearson 1901, "On lines and planes of closest
    /// fit"). It passes through the centroid along the principal axis. `None` for coincident points. Lengths are in the
    /// unit of the points.
    #[must_use]
    pub fn of(points: &[Point3<f64>]) -> Option<Self> {
        let centroid = points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / points.len() as f64;
        let size = points.iter().map(|p| (p.coords - centroid).norm()).fold(0.0, f64::max);
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        // divided by the size, so that squares neither overflow nor vanish
        let spread: Matrix3<f64> =
            points.iter().map(|p| (p.coords - centroid) / size).map(|v| v * v.transpose()).sum();
        let (values, vectors) = symmetric_eigen3(&spread);
        let direction = Unit::new_normalize(vectors.column(values.imax()).into_owned());
        let along = |p: &Point3<f64>| (p.coords - centroid).dot(&direction);
        let off = |p: &Point3<f64>| (p.coords - centroid - direction.into_inner() * along(p)).norm();
        Some(Self {
            point: centroid.into(),
            direction,
            distance: points.iter().map(off).fold(0.0, f64::max),
            reach: points.iter().map(|p| along(p).abs()).fold(0.0, f64::max),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a line and one beside it, at sizes from 1e-150 to 1e150: the line is found, with a distance in
    /// proportion.
    #[test]
    fn the_line_of_points_that_lie_nearly_on_one() {
        for scale in [1e-150, 1.0, 1e150] {
            let on = |t: f64, off: f64| Point3::new(1.0 + t, 2.0 + t, 3.0 + off) * scale;
            let exact = BestLine::of(&[on(-3.0, 0.0), on(0.0, 0.0), on(1.0, 0.0), on(2.0, 0.0)]).unwrap();
            assert!(exact.distance <= 1e-14 * scale, "{exact:?}");
            assert!((exact.direction.x.abs() - 0.5_f64.sqrt()).abs() < 1e-14);
            let near = BestLine::of(&[on(-3.0, 0.0), on(0.0, 0.02), on(1.0, 0.0), on(2.0, -0.02)]).unwrap();
            assert!((0.01..0.025).contains(&(near.distance / scale)) && near.reach > 4.0 * scale, "{near:?}");
        }
        assert_eq!(BestLine::of(&[Point3::new(1.0, 2.0, 3.0); 3]), None);
        assert_eq!(BestLine::of(&[]), None);
    }
}
