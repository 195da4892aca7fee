//! Area, mass, centre and inertia of a plate, in closed form: hull, strips along its edges and sectors at its corners,
//! minus the holes.

use std::f64::consts::PI;

use nalgebra::{Matrix2, Matrix3, Point2, Point3, Vector2, Vector3};

use super::outline::{Outline, OutlinePart};
use super::{PlateDesign, PlateSolid};

/// Integrals over a plane region: of 1, of the coordinates, of their products.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AreaMoments {
    pub area: f64,
    pub first: Vector2<f64>,
    pub second: Matrix2<f64>,
}

impl AreaMoments {
    fn add(&mut self, other: &Self) {
        self.area += other.area;
        self.first += other.first;
        self.second += other.second;
    }

    /// The moments of a region whose moments about `centre` are these.
    fn about(self, centre: &Point2<f64>) -> Self {
        let c = centre.coords;
        let mixed = self.first * c.transpose();
        Self {
            area: self.area,
            first: self.first + c * self.area,
            second: self.second + mixed + mixed.transpose() + c * c.transpose() * self.area,
        }
    }

    /// The moments of a polygon, counter-clockwise: the sum over the triangles of its edges with the origin.
    fn polygon(corners: &[Point2<f64>]) -> Self {
        let mut out = Self::default();
        for (i, p) in corners.iter().enumerate() {
            let (p, q) = (p.coords, corners[(i + 1) % corners.len()].coords);
            let twice = p.perp(&q);
            let (sum, mixed) = (p + q, p * q.transpose());
            out.area += 0.5 * twice;
            out.first += sum * (twice / 6.0);
            let own = p * p.transpose() + q * q.transpose();
            out.second += (own * 2.0 + mixed + mixed.transpose()) * (twice / 24.0);
        }
        out
    }

    /// The moments of a sector of a circle about the origin, from the angle `start` through `turn`.
    fn sector(radius: f64, start: f64, turn: f64) -> Self {
        let end = start + turn;
        let (s0, c0) = start.sin_cos();
        let (s1, c1) = end.sin_cos();
        let (cube, fourth) = (radius.powi(3) / 3.0, radius.powi(4) / 4.0);
        // integrals of cos^2, sin^2 and sin cos over the angle
        let skew = 0.5 * (s1 * c1 - s0 * c0);
        let (xx, yy, xy) = (0.5 * turn + skew, 0.5 * turn - skew, 0.5 * (s1 * s1 - s0 * s0));
        Self {
            area: 0.5 * turn * radius * radius,
            first: Vector2::new(s1 - s0, c0 - c1) * cube,
            second: Matrix2::new(xx, xy, xy, yy) * fourth,
        }
    }

    /// The moments of the region inside an outline.
    pub fn of(outline: &Outline) -> Self {
        let mut out = if outline.hull.len() > 2 { Self::polygon(&outline.hull) } else { Self::default() };
        let n = outline.hull.len();
        let mut edge = 0;
        for part in outline.parts() {
            match part {
                OutlinePart::Arc { centre, radius, start, turn } => {
                    out.add(&Self::sector(radius, start, turn).about(&centre));
                }
                OutlinePart::Line { from, to } => {
                    let (a, b) = (outline.hull[edge % n], outline.hull[(edge + 1) % n]);
                    edge += 1;
                    out.add(&Self::polygon(&[a, from, to, b]));
                }
            }
        }
        out
    }

    /// Subtracts a round hole.
    pub(crate) fn without_hole(&mut self, at: &Point2<f64>, diameter: f64) {
        let radius = 0.5 * diameter;
        let round = Self {
            area: PI * radius * radius,
            first: Vector2::zeros(),
            second: Matrix2::identity() * (0.25 * PI * radius.powi(4)),
        }
        .about(at);
        self.area -= round.area;
        self.first -= round.first;
        self.second -= round.second;
    }
}

/// A plate as a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateBody {
    /// Mass, kilograms.
    pub mass: f64,
    /// Centre of mass, frame of the body, design units.
    pub center: Point3<f64>,
    /// Inertia about it, axes of the body, kilograms times design units squared.
    pub inertia: Matrix3<f64>,
}

impl PlateSolid {
    /// Area of the plate without its holes, and its moments, plate coordinates.
    pub fn moments(&self, plate: &PlateDesign) -> AreaMoments {
        let mut out = AreaMoments::of(&self.outline);
        for seat in &self.seats {
            out.without_hole(&seat.at, plate.hole);
            for bolt in &seat.bolts {
                out.without_hole(bolt, plate.bolts.map_or(0.0, |b| b.hole));
            }
        }
        out
    }

    /// The plate as a rigid body, with the length of a design unit in metres; `None` without a known density.
    pub fn rigid(&self, plate: &PlateDesign, metres: f64) -> Option<PlateBody> {
        let moments = self.moments(plate);
        let per_unit = plate.kilograms_per_cubic_metre()? * metres.powi(3) * self.thickness;
        let mass = moments.area * per_unit;
        let middle = moments.first / moments.area;
        let spread = (moments.second - middle * middle.transpose() * moments.area) * per_unit;
        let across = mass * self.thickness.powi(2) / 12.0;
        let (uu, vv, uv) = (spread[(0, 0)], spread[(1, 1)], spread[(0, 1)]);
        let own = Matrix3::new(vv + across, -uv, 0.0, -uv, uu + across, 0.0, 0.0, 0.0, uu + vv);
        let center = self.axes * Vector3::new(middle.x, middle.y, self.lower() + 0.5 * self.thickness);
        Some(PlateBody {
            mass,
            center: Point3::from(center),
            inertia: self.axes * own * self.axes.transpose(),
        })
    }
}
