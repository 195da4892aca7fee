//! A grid of holes in the plane of a body.

use crate::num::small::symmetric_eigen3;
use nalgebra::{Matrix3, Point3, Vector3};

/// Joints count as lying in a plane within this times the size of the design.
const FLAT: f64 = 1e-9;
/// Cells farther out than this are not counted exactly.
const FARTHEST: f64 = 1e6;

/// A square grid of holes.
///
/// Its axes are the x and y axes of the body frame, projected on the plane of the joints and turned by the angle; its origin is the projection of the
/// origin of the frame, shifted along these axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Distance of neighbouring holes, design units, positive.
    pub pitch: f64,
    /// A hole, in the axes of the grid before it is turned, design units.
    pub origin: [f64; 2],
    /// Turn about the normal of the plane, degrees.
    pub angle_deg: f64,
}

/// A hole, counted from the origin along both axes.
pub(super) type Cell = [i64; 2];

/// A grid laid into the plane of the joints of a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyGrid {
    origin: Point3<f64>,
    axes: [Vector3<f64>; 2],
    pitch: f64,
}

/// Normal of the plane through the points, to positive z (then y, then x); `None` when they do not lie in one.
fn normal(points: &[Point3<f64>], size: f64) -> Option<Vector3<f64>> {
    let first = points.first()?;
    if points.iter().all(|p| (p.z - first.z).abs() <= FLAT * size) {
        return Some(Vector3::z());
    }
    let centre = points.iter().map(|p| p - first).sum::<Vector3<f64>>() / points.len() as f64;
    let moments: Matrix3<f64> = points.iter().map(|p| p - first - centre).map(|d| d * d.transpose()).sum();
    let (values, vectors) = symmetric_eigen3(&moments);
    let n: Vector3<f64> = vectors.column(values.imin()).normalize();
    let leading = [n.z, n.y, n.x].into_iter().find(|x| x.abs() > FLAT);
    let n = if leading.is_some_and(|x| x < 0.0) { -n } else { n };
    points.iter().all(|p| (p - first - centre).dot(&n).abs() <= FLAT * size).then_some(n)
}

impl BodyGrid {
    /// `None` when the joints do not lie in a plane.
    pub(super) fn new(points: &[Point3<f64>], grid: &Grid, size: f64) -> Option<Self> {
        let n = normal(points, size)?;
        let along = if n.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        let x = (along - n * n.dot(&along)).normalize();
        let y = n.cross(&x);
        let foot = n * points[0].coords.dot(&n);
        let origin = Point3::from(foot + x * grid.origin[0] + y * grid.origin[1]);
        let (s, c) = grid.angle_deg.to_radians().sin_cos();
        Some(Self { origin, axes: [x * c + y * s, y * c - x * s], pitch: grid.pitch })
    }

    /// A point of the plane in pitches.
    pub(super) fn coordinates(&self, p: &Point3<f64>) -> [f64; 2] {
        self.axes.map(|axis| (p - self.origin).dot(&axis) / self.pitch)
    }

    /// The hole.
    pub(super) fn point(&self, cell: Cell) -> Point3<f64> {
        let along = |k: usize| self.axes[k] * (cell[k] as f64 * self.pitch);
        self.origin + (along(0) + along(1))
    }

    pub(super) fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Whether all points are near enough for cells to be counted.
    pub(super) fn reaches(&self, points: &[Point3<f64>]) -> bool {
        points.iter().all(|p| self.coordinates(p).iter().all(|x| x.abs() < FARTHEST))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { pitch: 0.5, origin: [0.0, 0.0], angle_deg: 0.0 };

    #[test]
    fn cells_of_a_level_plane_are_multiples_of_the_pitch() {
        let points = [Point3::new(1.0, 2.0, 3.0), Point3::new(-1.0, 7.0, 3.0), Point3::new(5.0, 0.0, 3.0)];
        let g = BodyGrid::new(&points, &GRID, 5.0).unwrap();
        assert_eq!(g.point([3, -7]), Point3::new(1.5, -3.5, 3.0));
        let [x, y] = g.coordinates(&Point3::new(1.5, -3.5, 3.0));
        assert!((x - 3.0).abs() < 1e-15 && (y + 7.0).abs() < 1e-15);
    }

    #[test]
    fn a_tilted_plane_keeps_its_points_and_a_body_in_space_is_refused() {
        let (u, v) = (Vector3::new(1.0, 0.2, 0.3), Vector3::new(-0.1, 1.0, 2.0));
        let at = |x: f64, y: f64| Point3::new(0.3, 0.1, -2.0) + u * x + v * y;
        let points = [at(0.0, 1.0), at(1.0, 0.0), at(3.0, 2.0), at(-1.0, 4.0)];
        let grid = Grid { pitch: 0.25, origin: [0.1, 0.2], angle_deg: 17.0 };
        let g = BodyGrid::new(&points, &grid, 5.0).unwrap();
        for p in points {
            let [x, y] = g.coordinates(&p);
            let back = g.origin + (g.axes[0] * x + g.axes[1] * y) * g.pitch;
            assert!((back - p).norm() < 1e-12);
        }
        let mut bent = points;
        bent[0].x += 1e-6;
        assert!(BodyGrid::new(&bent, &grid, 5.0).is_none());
    }
}
