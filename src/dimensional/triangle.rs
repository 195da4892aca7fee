//! The triangles of an octahedral design under a stretch of their planes.

use nalgebra::{Point3, Vector3};

use super::problem::Triangles;

/// A triangle that is stretched in its plane about its centroid.
#[derive(Debug, Clone)]
pub(crate) struct Triangle {
    centre: Vector3<f64>,
    /// Coordinates of the vertices in `axes`.
    plane: [[f64; 2]; 3],
    axes: [Vector3<f64>; 2],
    /// Index of the first variable.
    pub(crate) first: Option<usize>,
    kind: Triangles,
}

impl Triangle {
    pub(crate) fn new(vertices: [Point3<f64>; 3], kind: Triangles, first: Option<usize>) -> Self {
        let centre = vertices.iter().map(|v| v.coords).sum::<Vector3<f64>>() / 3.0;
        let edge = (vertices[1] - vertices[0]).normalize();
        let normal = (vertices[1] - vertices[0]).cross(&(vertices[2] - vertices[0])).normalize();
        let axes = [edge, normal.cross(&edge)];
        let plane = vertices.map(|v| axes.map(|e| e.dot(&(v.coords - centre))));
        Self { centre, plane, axes, first, kind }
    }

    /// Entries `xx, xy, yy` of the stretch less the identity.
    fn stretch(&self, x: &[f64]) -> [f64; 3] {
        match (self.first, self.kind) {
            (Some(k), Triangles::Sizes) => [x[k], 0.0, x[k]],
            (Some(k), Triangles::Shapes) => [x[k], x[k + 1], x[k + 2]],
            _ => [0.0; 3],
        }
    }

    fn displaced(&self, v: usize, s: [f64; 3]) -> Vector3<f64> {
        let [p, q] = self.plane[v];
        self.axes[0] * (s[0] * p + s[1] * q) + self.axes[1] * (s[1] * p + s[2] * q)
    }

    pub(crate) fn vertices(&self, x: &[f64]) -> [Vector3<f64>; 3] {
        let [xx, xy, yy] = self.stretch(x);
        [0, 1, 2].map(|v| self.centre + self.displaced(v, [1.0 + xx, xy, 1.0 + yy]))
    }

    /// Variables with the directions in which they move the vertices.
    pub(crate) fn rates(&self) -> Vec<(usize, [Vector3<f64>; 3])> {
        let unit: &[[f64; 3]] = match self.kind {
            Triangles::Fixed => &[],
            Triangles::Sizes => &[[1.0, 0.0, 1.0]],
            Triangles::Shapes => &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        let Some(first) = self.first else { return Vec::new() };
        unit.iter().enumerate().map(|(k, s)| (first + k, [0, 1, 2].map(|v| self.displaced(v, *s)))).collect()
    }
}
