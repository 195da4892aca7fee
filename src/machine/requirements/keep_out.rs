//! Bodies that the legs must not touch.

use nalgebra::{Point3, Vector3};

use platform::geom::{segment_box_distance, segment_distance};
use platform::manipulator::Body;

/// The shape of a keep-out, design units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeepOutShape {
    /// A box along the axes of the frame: centre and edge lengths. A plate is a flat box.
    Box {
        /// Its centre.
        center: Point3<f64>,
        /// Its edge lengths.
        size: Vector3<f64>,
    },
    /// A ball.
    Sphere {
        /// Its centre.
        center: Point3<f64>,
        /// Its diameter.
        diameter: f64,
    },
    /// A cylinder with half balls at its ends.
    Capsule {
        /// One end of its axis.
        from: Point3<f64>,
        /// The other end.
        to: Point3<f64>,
        /// Its diameter.
        diameter: f64,
    },
}

/// A body that the legs must not touch: a plate, a box, a tool.
#[derive(Debug, Clone, PartialEq)]
pub struct KeepOut {
    /// What it is called in reports.
    pub name: String,
    /// The body it moves with, in whose frame its coordinates are.
    pub fixed_to: Body,
    /// What it looks like.
    pub shape: KeepOutShape,
}

impl KeepOutShape {
    /// Distance of the segment `x y` from the shape, 0 when they meet. (How deep they overlap is not measured
    /// for boxes; for balls and capsules it is: the value is then negative.)
    #[must_use]
    pub fn distance(&self, x: &Point3<f64>, y: &Point3<f64>) -> f64 {
        match self {
            Self::Box { center, size } => segment_box_distance([*x, *y], center, &(size / 2.0)),
            Self::Sphere { center, diameter } => segment_distance([*x, *y], [*center; 2]) - diameter / 2.0,
            Self::Capsule { from, to, diameter } => segment_distance([*x, *y], [*from, *to]) - diameter / 2.0,
        }
    }
}
