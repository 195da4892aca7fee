//! Plates that carry the joints of a body.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Point2, Point3, Vector3};

use super::Unsupported;
use super::model::ExportedJoint;
use super::outline::Outline;
use super::sizes::Sizes;
use crate::geom::any_across;
use crate::manipulator::Body;

/// A hole of a plate under a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateHole {
    /// The joint above it, or several separate joints with the same centre.
    pub joints: Vec<String>,
    /// Its axis in the plate, plate frame.
    pub at: Point2<f64>,
    /// Height of a post between plate and ball, design units; 0 where the ball sits on the edge of the hole.
    pub post: f64,
}

/// A plate with parallel faces around the joints of a body, on the far side of the joints from the legs.
///
/// Each ball of diameter `D` sits on the edge of a hole of diameter `d`: its centre, exactly the joint centre, is `sqrt(D^2 - d^2)/2` above the
/// face. Where the joints do not lie in a plane, the plate is parallel to the largest triangle of joints and posts carry the higher ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate {
    /// Origin of the plate frame in the frame of the body.
    pub origin: Point3<f64>,
    /// Axes of the plate frame in the frame of the body, as columns; the third is the normal.
    pub axes: Matrix3<f64>,
    /// `true` when the legs are on the side the normal points to.
    pub legs_above: bool,
    /// Thickness, design units: the plate lies between 0 and this along the normal.
    pub thickness: f64,
    /// Diameter of the holes, design units.
    pub hole_diameter: f64,
    /// Diameter of the posts, that of the balls, design units.
    pub post_diameter: f64,
    /// The holes.
    pub holes: Vec<PlateHole>,
    /// The outline in the plate frame.
    pub outline: Outline,
}

/// Normal of the greatest triangle of the joints, towards positive z (then y, then x); the direction across their line nearest to `along` where they
/// lie on one.
pub(super) fn normal(joints: &[ExportedJoint], along: &Vector3<f64>, size: f64) -> Vector3<f64> {
    let points: Vec<Point3<f64>> = joints.iter().map(|j| j.at).collect();
    let mut best = Vector3::zeros();
    let mut line = Vector3::zeros();
    for (i, p) in points.iter().enumerate() {
        for (j, q) in points.iter().enumerate().skip(i + 1) {
            if (q - p).norm() > line.norm() {
                line = q - p;
            }
            for r in &points[j + 1..] {
                let cross = (q - p).cross(&(r - p));
                // equal triangles are told apart by rounding only: the first one stays
                if cross.norm() > best.norm() * (1.0 + 1e-9) {
                    best = cross;
                }
            }
        }
    }
    if best.norm() <= 1e-9 * size * size {
        let across = match line.try_normalize(1e-9 * size) {
            Some(d) => along - d * d.dot(along),
            None => *along,
        };
        best = across.try_normalize(1e-6).unwrap_or_else(|| any_across(&line));
    }
    let n = best.normalize();
    let leading = [n.z, n.y, n.x].into_iter().find(|x| x.abs() > 1e-9);
    if leading.is_some_and(|x| x < 0.0) { -n } else { n }
}

/// The axes `(u, v, n)`: `u` the body's x-axis in the plane, or its y-axis where x is along `n`.
fn frame_of(n: &Vector3<f64>) -> Matrix3<f64> {
    let first = if n.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let u = (first - n * n.dot(&first)).normalize();
    Matrix3::from_columns(&[u, n.cross(&u), *n])
}

impl Plate {
    /// The plate of a body with these joints across `normal`; `towards_legs` is the mean direction of the legs from the body, in its frame.
    pub(super) fn under(
        joints: &[ExportedJoint],
        normal: &Vector3<f64>,
        towards_legs: &Vector3<f64>,
        sizes: &Sizes,
        size: f64,
    ) -> Self {
        let (n, axes) = (normal, frame_of(normal));
        let legs_above = n.dot(towards_legs) >= 0.0;
        let side = if legs_above { 1.0 } else { -1.0 };
        // heights towards the legs; the lowest joint sits on the plate itself
        let height = |p: &Point3<f64>| side * n.dot(&p.coords);
        let lowest = joints.iter().map(|j| height(&j.at)).fold(f64::INFINITY, f64::min);
        let seat = 0.5 * (sizes.ball.powi(2) - sizes.hole.powi(2)).max(0.0).sqrt();
        let face = side * (lowest - seat);
        let lower = if legs_above { face - sizes.thickness } else { face };
        let tolerance = 1e-9 * size;
        let mut holes: Vec<PlateHole> = Vec::new();
        for joint in joints {
            let local = axes.transpose() * joint.at.coords;
            let (at, above) = (Point2::new(local.x, local.y), height(&joint.at) - lowest);
            let post = if above > tolerance { (seat + above - 0.5 * sizes.ball).max(0.0) } else { 0.0 };
            let same =
                |h: &&mut PlateHole| (h.at - at).norm() <= tolerance && (h.post - post).abs() <= tolerance;
            match holes.iter_mut().find(same) {
                Some(hole) => hole.joints.push(joint.name.clone()),
                None => holes.push(PlateHole { joints: vec![joint.name.clone()], at, post }),
            }
        }
        let centres: Vec<Point2<f64>> = holes.iter().map(|h| h.at).collect();
        Self {
            origin: Point3::from(n * lower),
            axes,
            legs_above,
            thickness: sizes.thickness,
            hole_diameter: sizes.hole,
            post_diameter: sizes.ball,
            holes,
            outline: Outline::around(&centres, sizes.margin, tolerance),
        }
    }

    /// A point of the plate frame in the frame of the body.
    #[must_use]
    pub fn to_body(&self, p: &Point3<f64>) -> Point3<f64> {
        self.origin + self.axes * p.coords
    }

    /// Volume, design units cubed.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let hole = 0.25 * PI * self.hole_diameter * self.hole_diameter;
        (self.outline.area() - hole * self.holes.len() as f64) * self.thickness
    }

    /// Where the post of a hole begins and ends along the normal.
    #[must_use]
    pub fn post_span(&self, hole: &PlateHole) -> (f64, f64) {
        if self.legs_above { (self.thickness, self.thickness + hole.post) } else { (-hole.post, 0.0) }
    }

    /// `self` when its seats keep clear of each other; they keep clear of the outline because no hole is wider than twice the margin.
    ///
    /// # Errors
    /// [`Unsupported::SeatsOverlap`].
    pub fn made(&self, body: Body) -> Result<&Self, Unsupported> {
        for (i, a) in self.holes.iter().enumerate() {
            for b in &self.holes[i + 1..] {
                let distance = (a.at - b.at).norm();
                let raised = a.post > 0.0 || b.post > 0.0;
                let (parts, diameter) =
                    if raised { ("posts", self.post_diameter) } else { ("holes", self.hole_diameter) };
                if distance <= diameter {
                    let name = |h: &PlateHole| h.joints.join("/");
                    let (first, second) = (name(a), name(b));
                    return Err(Unsupported::SeatsOverlap { body, parts, first, second, distance, diameter });
                }
            }
        }
        Ok(self)
    }
}
