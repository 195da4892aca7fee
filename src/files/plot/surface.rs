//! Surfaces by marching tetrahedra.
//!
//! Each cell of a grid in space is cut into the six tetrahedra about one of its diagonals. All cells use the same
//! diagonal, so that neighbours share their faces. The surface `f = level` crosses a tetrahedron in no piece, a
//! triangle or a quadrangle. Corners of the pieces are interpolated linearly on the edges of the tetrahedra. The edges
//! identify them, so nothing depends on comparing coordinates.
//!
//! Source: B. Payne, A. Toga, Surface mapping brain function on 3D models (1990), who cut cells into tetrahedra for
//! this purpose.

use std::collections::BTreeMap;

/// Values on a grid of `points` in each of three directions; the first one runs fastest.
#[derive(Debug, Clone)]
pub struct ValueBox {
    /// Points in each direction.
    pub points: usize,
    /// The values; the first direction runs fastest.
    pub values: Vec<f64>,
}

/// A surface of triangles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriangleSurface {
    /// Vertices in grid coordinates.
    pub vertices: Vec<[f64; 3]>,
    /// Three vertices each, in no particular orientation.
    pub triangles: Vec<[usize; 3]>,
}

/// The tetrahedra of a cell: the order of the axes on the path from its first corner to its last.
const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

impl ValueBox {
    /// Distance in the list between neighbours along each axis.
    fn strides(&self) -> [usize; 3] {
        [1, self.points, self.points * self.points]
    }

    /// Grid coordinates of a point of the list.
    fn place(&self, point: usize) -> [f64; 3] {
        self.strides().map(|s| (point / s % self.points) as f64)
    }

    /// The tetrahedra of all cells, by their corners.
    fn tetrahedra(&self) -> Vec<[usize; 4]> {
        let strides = self.strides();
        let cells = self.points.saturating_sub(1);
        let mut out = Vec::with_capacity(6 * cells.pow(3));
        for z in 0..cells {
            for y in 0..cells {
                for x in 0..cells {
                    let first = x * strides[0] + y * strides[1] + z * strides[2];
                    for [a, b, c] in PATHS {
                        let (p, q) = (first + strides[a], first + strides[a] + strides[b]);
                        out.push([first, p, q, q + strides[c]]);
                    }
                }
            }
        }
        out
    }

    /// The surface `f = level`. A tetrahedron with a value that is not finite is skipped, which leaves a hole.
    pub fn surface(&self, level: f64) -> TriangleSurface {
        let mut out = TriangleSurface::default();
        let mut known: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for corners in self.tetrahedra() {
            if !corners.iter().all(|k| self.values[*k].is_finite()) {
                continue;
            }
            let (above, below): (Vec<usize>, Vec<usize>) =
                corners.into_iter().partition(|k| self.values[*k] >= level);
            let mut vertex = |a: usize, b: usize| {
                let edge = (a.min(b), a.max(b));
                *known.entry(edge).or_insert_with(|| {
                    out.vertices.push(self.crossing(edge, level));
                    out.vertices.len() - 1
                })
            };
            match (above.as_slice(), below.as_slice()) {
                ([one], [a, b, c]) | ([a, b, c], [one]) => {
                    let triangle = [vertex(*one, *a), vertex(*one, *b), vertex(*one, *c)];
                    out.triangles.push(triangle);
                }
                ([a, b], [c, d]) => {
                    let around = [vertex(*a, *c), vertex(*a, *d), vertex(*b, *d), vertex(*b, *c)];
                    out.triangles.push([around[0], around[1], around[2]]);
                    out.triangles.push([around[0], around[2], around[3]]);
                }
                _ => {}
            }
        }
        out
    }

    /// Crossing of the surface with the edge between two points.
    fn crossing(&self, (a, b): (usize, usize), level: f64) -> [f64; 3] {
        let t = (level - self.values[a]) / (self.values[b] - self.values[a]);
        let (from, to) = (self.place(a), self.place(b));
        [0, 1, 2].map(|k| from[k] + t * (to[k] - from[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: usize = 21;

    fn at(grid: f64) -> f64 {
        grid / 10.0 - 1.0
    }

    fn grid(f: impl Fn([f64; 3]) -> f64) -> ValueBox {
        let empty = ValueBox { points: POINTS, values: Vec::new() };
        let values = (0..POINTS.pow(3)).map(|k| f(empty.place(k).map(at))).collect();
        ValueBox { values, ..empty }
    }

    /// The number of triangles at each edge.
    fn edges(surface: &TriangleSurface) -> BTreeMap<(usize, usize), usize> {
        let mut out = BTreeMap::new();
        for t in &surface.triangles {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                *out.entry((a.min(b), a.max(b))).or_insert(0) += 1;
            }
        }
        out
    }

    #[test]
    fn a_sphere_is_one_closed_surface_on_the_sphere() {
        let surface = grid(|p| p.iter().map(|x| x * x).sum::<f64>() + 1e-3 * p[0]).surface(0.5);
        for v in &surface.vertices {
            let [x, y, z] = v.map(at);
            // linear between points 0.1 apart: the error is below the square of the diagonal of a cell over eight,
            // times the second derivative
            assert!((x * x + y * y + z * z + 1e-3 * x - 0.5).abs() < 0.25 * 0.03, "{v:?}");
        }
        let edges = edges(&surface);
        assert!(edges.values().all(|n| *n == 2), "closed");
        let euler = surface.vertices.len() + surface.triangles.len() - edges.len();
        assert_eq!(euler, 2, "a sphere, and one of them");
    }

    #[test]
    fn a_plane_is_exact_a_missing_level_empty_and_what_is_not_finite_a_hole() {
        let f = |p: [f64; 3]| p[0] + 2.0 * p[1] - 0.7 * p[2];
        let surface = grid(f).surface(0.31);
        assert!(surface.triangles.len() > 100);
        assert!(surface.vertices.iter().all(|v| (f(v.map(at)) - 0.31).abs() < 1e-12));
        assert_eq!(grid(f).surface(9.0), TriangleSurface::default());
        let torn = grid(|p| if p[0] < -0.95 { f64::NAN } else { f(p) }).surface(0.31);
        assert!(torn.triangles.len() < surface.triangles.len() && !torn.triangles.is_empty());
        assert!(torn.vertices.iter().flatten().all(|x| x.is_finite()));
    }
}
