//! The surface of the positions that straight paths from a pose reach, as triangles.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::{FreeRay, Reach};
use platform::geom::Pose;

/// The boundary of the positions that straight paths reach at one orientation. Every path from the middle ends on it,
/// so it has no folds.
#[derive(Debug, Clone, PartialEq)]
pub struct ReachedSurface {
    /// The pose in the middle.
    pub from: Pose,
    /// The paths to its corners.
    pub rays: Vec<FreeRay>,
    /// Corners of the triangles, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
}

impl ReachedSurface {
    /// Positions of the platform origin at the corners.
    pub fn positions(&self) -> impl Iterator<Item = Vector3<f64>> + '_ {
        self.rays.iter().map(|ray| self.from.position + ray.direction * ray.free)
    }

    /// The volume inside.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let at = |k: usize| self.rays[k].direction * self.rays[k].free;
        self.triangles.iter().map(|[a, b, c]| at(*a).dot(&at(*b).cross(&at(*c))) / 6.0).sum()
    }
}

impl Reach<'_> {
    /// The surface of the positions that straight paths from an allowed pose reach, with `10 * 4^level + 2` corners.
    #[must_use]
    pub fn surface(&self, from: &Pose, level: u32) -> ReachedSurface {
        let (directions, triangles) = sphere(level);
        let rays = directions.iter().map(|direction| self.ray(from, direction, false)).collect();
        ReachedSurface { from: *from, rays, triangles }
    }
}

/// An icosahedron whose triangles are divided into four `level` times, on the unit sphere.
fn sphere(level: u32) -> (Vec<Vector3<f64>>, Vec<[usize; 3]>) {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut corners = Vec::new();
    for k in 0..3 {
        for (one, other) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
            let mut corner = Vector3::zeros();
            (corner[k], corner[(k + 1) % 3]) = (one, other);
            corners.push(corner.normalize());
        }
    }
    let edge = (corners[0] - corners[1]).norm();
    let near = |i: usize, j: usize| (corners[i] - corners[j]).norm() < 1.1 * edge;
    let mut triangles = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if near(i, j) && near(j, k) && near(k, i) {
                    let outside = corners[i].dot(&corners[j].cross(&corners[k])) > 0.0;
                    triangles.push(if outside { [i, j, k] } else { [i, k, j] });
                }
            }
        }
    }
    for _ in 0..level {
        let mut middles: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        let mut middle = |corners: &mut Vec<Vector3<f64>>, i: usize, j: usize| {
            *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                corners.push((corners[i] + corners[j]).normalize());
                corners.len() - 1
            })
        };
        let mut finer = Vec::with_capacity(4 * triangles.len());
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(i, j)| middle(&mut corners, i, j));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    (corners, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn spheres_are_closed_and_their_volume_grows_to_that_of_the_ball() {
        let mut before = 0.0;
        for level in 0..5 {
            let (corners, triangles) = sphere(level);
            assert_eq!(
                (corners.len(), triangles.len()),
                (10 * 4_usize.pow(level) + 2, 20 * 4_usize.pow(level))
            );
            // every edge belongs to two triangles that pass it in opposite directions
            let mut edges: BTreeMap<(usize, usize), i32> = BTreeMap::new();
            for t in &triangles {
                for (i, j) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                    *edges.entry((i.min(j), i.max(j))).or_default() += if i < j { 1 } else { -1 };
                }
            }
            assert!(edges.values().all(|sum| *sum == 0) && edges.len() * 2 == triangles.len() * 3);
            let rays = corners.iter().map(|d| FreeRay { direction: *d, free: 2.0, binding: None }).collect();
            let from = Pose { rotation: Rotation3::identity(), position: Vector3::new(1.0, 2.0, 3.0) };
            let surface = ReachedSurface { from, rays, triangles };
            let share = surface.volume() / (32.0 / 3.0 * std::f64::consts::PI);
            assert!(share > before && share < 1.0, "{share}");
            before = share;
        }
        assert!(before > 0.997, "{before}");
    }
}
