//! Bodies that the legs must not touch.

use nalgebra::{Point3, Vector3};

use platform::geom::{LinePair, segment_box_nearest};
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
    /// The name in reports.
    pub name: String,
    /// The body that it moves with; its coordinates are in this frame.
    pub fixed_to: Body,
    /// Its shape.
    pub shape: KeepOutShape,
}

/// The point of a segment that is nearest to a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestOnSegment {
    /// Share of the segment before the point.
    pub share: f64,
    /// Distance from the shape, negative inside.
    pub distance: f64,
    /// Unit vector away from the shape: the gradient of the distance.
    pub away: Vector3<f64>,
}

impl KeepOutShape {
    /// Distance of the segment `x y` from the shape, 0 when they meet. The overlap depth is measured for balls and
    /// capsules only: their value is then negative.
    #[must_use]
    pub fn distance(&self, x: &Point3<f64>, y: &Point3<f64>) -> f64 {
        self.nearest_outside(x, y).distance
    }

    /// The point of the segment `x y` that is nearest, or deepest inside, also in boxes.
    #[must_use]
    pub fn nearest(&self, x: &Point3<f64>, y: &Point3<f64>) -> NearestOnSegment {
        let found = self.nearest_outside(x, y);
        match self {
            Self::Box { center, size } if found.distance <= TOUCHING * size.norm() => {
                deepest_in_box(&(x - center), &(y - x), &(size / 2.0))
            }
            _ => found,
        }
    }

    fn nearest_outside(&self, x: &Point3<f64>, y: &Point3<f64>) -> NearestOnSegment {
        let round = |from: &Point3<f64>, to: &Point3<f64>, diameter: f64| {
            let (e, f, apart) = (y - x, to - from, x - from);
            let (share, other) = LinePair::new(apart, &e, &f).closest((0.0, 1.0), (0.0, 1.0));
            (share, apart + e * share - f * other, diameter / 2.0)
        };
        let (share, way, radius) = match self {
            Self::Box { center, size } => {
                let (share, way) = segment_box_nearest([*x, *y], center, &(size / 2.0));
                (share, way, 0.0)
            }
            Self::Sphere { center, diameter } => round(center, center, *diameter),
            Self::Capsule { from, to, diameter } => round(from, to, *diameter),
        };
        let away = way.try_normalize(0.0).unwrap_or_else(Vector3::z);
        NearestOnSegment { share, distance: way.norm() - radius, away }
    }
}

/// A segment nearer to a box than this share of its size touches it.
const TOUCHING: f64 = 5e-13;
/// Sections in the enclosure of the deepest point.
const SECTIONS: usize = 80;

/// The deepest point of the segment `a + t e` in a box around the origin: the depth is concave along it.
fn deepest_in_box(a: &Vector3<f64>, e: &Vector3<f64>, half: &Vector3<f64>) -> NearestOnSegment {
    let face = |t: f64| {
        let q = a + e * t;
        let outside = q.abs() - half;
        let k = outside.imax();
        (outside[k], Vector3::ith(k, q[k].signum()))
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..SECTIONS {
        let (x, y) = (low + (high - low) * 0.4, low + (high - low) * 0.6);
        if face(x).0 < face(y).0 { high = y } else { low = x }
    }
    let share = f64::midpoint(low, high);
    let (distance, normal) = face(share);
    // two faces may be equally near, one before and one behind; their mean is constant along the segment
    let (before, behind) = (face((share - 1e-7).max(0.0)).1, face((share + 1e-7).min(1.0)).1);
    let (falls, rises) = (before.dot(e), behind.dot(e));
    let away = if falls < 0.0 && rises > 0.0 {
        before * (rises / (rises - falls)) - behind * (falls / (rises - falls))
    } else {
        normal
    };
    NearestOnSegment { share, distance, away }
}
