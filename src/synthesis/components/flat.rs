//! Points, lines, planes and space in normalised coordinates of one body, with coordinates of their own.

use nalgebra::Vector3;

use super::spectrum::Spectrum;
use crate::num::linalg::LinalgError;

/// Below this ratio of the spreads of the joints the axes follow the joints, with a unit for each.
const NARROW: f64 = 1e-2;

/// A flat `origin + sum_k xi_k axes_k` with orthogonal axes, as long as the joints reach: local coordinates are of order one,
/// also for joints nearly on a line or nearly in a plane.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Flat {
    pub(super) origin: Vector3<f64>,
    pub(super) axes: Vec<Vector3<f64>>,
}

fn rows(points: &[Vector3<f64>]) -> (Vector3<f64>, Vec<Vec<f64>>) {
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    (mean, points.iter().map(|p| (p - mean).iter().copied().collect()).collect())
}

/// Singular values of the centred points: as many as their flat has dimensions are different from zero.
pub(super) fn spread(points: &[Vector3<f64>]) -> Result<[f64; 3], LinalgError> {
    let s = Spectrum::of(&rows(points).1, 3)?;
    Ok(std::array::from_fn(|k| s.values[k]))
}

impl Flat {
    /// The flat of dimension `dimension` nearest to the points (least squares, total).
    pub(super) fn nearest(points: &[Vector3<f64>], dimension: usize) -> Result<Self, LinalgError> {
        let (origin, centred) = rows(points);
        let s = Spectrum::of(&centred, 3)?;
        let axis = |v: &Vec<f64>| Vector3::new(v[0], v[1], v[2]);
        let narrow = dimension > 0 && s.values[dimension - 1] < NARROW * s.values[0];
        let mut axes = match dimension {
            2 if !narrow => plane_axes(forward(axis(&s.vectors[2]))),
            3 if !narrow => vec![Vector3::x(), Vector3::y(), Vector3::z()],
            _ => s.vectors[..dimension].iter().map(|v| forward(axis(v))).collect(),
        };
        let reach = points.iter().map(|p| (p - origin).norm()).fold(0.0, f64::max);
        for e in &mut axes {
            let along = points.iter().map(|p| e.dot(&(p - origin)).abs()).fold(0.0, f64::max);
            let length = if narrow { along } else { reach };
            if length > 0.0 {
                *e *= length;
            }
        }
        Ok(Self { origin, axes })
    }

    /// A point and directions, made orthonormal.
    pub(super) fn spanned(origin: Vector3<f64>, directions: &[Vector3<f64>]) -> Self {
        let mut axes: Vec<Vector3<f64>> = Vec::new();
        for d in directions {
            let mut rest = d.normalize();
            for _ in 0..2 {
                for e in &axes {
                    rest -= e * e.dot(&rest);
                }
            }
            axes.push(rest.normalize());
        }
        Self { origin, axes }
    }

    pub(super) fn dimension(&self) -> usize {
        self.axes.len()
    }

    /// Homogeneous local coordinates `(1, xi)` of a point's nearest point in the flat.
    pub(super) fn local(&self, p: &Vector3<f64>) -> Vec<f64> {
        let d = p - self.origin;
        std::iter::once(1.0).chain(self.axes.iter().map(|e| e.dot(&d) / e.norm_squared())).collect()
    }

    /// Distance of a point from the flat.
    pub(super) fn distance(&self, p: &Vector3<f64>) -> f64 {
        let mut d = p - self.origin;
        for e in &self.axes {
            d -= e * (e.dot(&d) / e.norm_squared());
        }
        d.norm()
    }

    /// Homogeneous coordinates `(w, w x)` in the body of homogeneous local ones.
    pub(super) fn place(&self, local: &[f64]) -> [f64; 4] {
        let mut x = self.origin * local[0];
        for (e, c) in self.axes.iter().zip(&local[1..]) {
            x += e * *c;
        }
        [local[0], x.x, x.y, x.z]
    }
}

/// The direction with its largest component positive: the same for both signs of a singular vector.
fn forward(v: Vector3<f64>) -> Vector3<f64> {
    if v[v.iamax()] < 0.0 { -v } else { v }
}

/// Two axes of the plane with the given normal: the first as near to the `x` axis of the body as possible.
fn plane_axes(normal: Vector3<f64>) -> Vec<Vector3<f64>> {
    let start = if normal.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = (start - normal * normal.dot(&start)).normalize();
    vec![first, normal.cross(&first)]
}
