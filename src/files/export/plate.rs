//! Plates that carry the joints of a body.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Point2, Point3, Vector3};

use super::Outline;
use super::Unsupported;
use super::model::ExportedJoint;
use super::sizes::Sizes;
use machine::requirements::{BoltPattern, PlateDesign, frame_of};
use platform::manipulator::Body;

/// A hole of a plate under a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct DrilledHole {
    /// The joint above it, or several separate joints with the same centre.
    pub joints: Vec<String>,
    /// Its axis in the plate, plate frame.
    pub at: Point2<f64>,
    /// Height of a post between plate and ball, design units; 0 if the ball sits on the edge of the hole.
    pub post: f64,
    /// The middles of the bolt holes around it, plate frame.
    pub bolts: Vec<Point2<f64>>,
}

/// A plate with parallel faces around the joints of a body, on the side of the joints away from the legs.
///
/// If the design gives the joint height, the face is at that distance from the lowest joint. Otherwise each ball of
/// diameter `D` sits on the edge of a hole of diameter `d`. Its centre, exactly the joint centre, is
/// `sqrt(D^2 - d^2)/2` above the face. If the joints are not coplanar, the plate is parallel to the largest triangle of
/// joints, and posts carry the higher ones.
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
    /// Diameter of the posts, equal to that of the balls, design units.
    pub post_diameter: f64,
    /// The holes.
    pub holes: Vec<DrilledHole>,
    /// Diameter of the bolt holes, design units; 0 without bolts.
    pub bolt_diameter: f64,
    /// Its material, if the design names it.
    pub material: Option<String>,
    /// Density, kg/m^3, if known.
    pub density: Option<f64>,
    /// The outline in the plate frame.
    pub outline: Outline,
}

/// Diameters of clearance holes for metric threads, millimetres: nominal diameter, then the fine, the medium and the
/// coarse series (ISO 273:1979).
const CLEARANCE_HOLES: [(f64, [f64; 3]); 14] = [
    (1.6, [1.7, 1.8, 2.0]),
    (2.0, [2.2, 2.4, 2.6]),
    (2.5, [2.7, 2.9, 3.1]),
    (3.0, [3.2, 3.4, 3.6]),
    (4.0, [4.3, 4.5, 4.8]),
    (5.0, [5.3, 5.5, 5.8]),
    (6.0, [6.4, 6.6, 7.0]),
    (8.0, [8.4, 9.0, 10.0]),
    (10.0, [10.5, 11.0, 12.0]),
    (12.0, [13.0, 13.5, 14.5]),
    (14.0, [15.0, 15.5, 16.5]),
    (16.0, [17.0, 17.5, 18.5]),
    (20.0, [21.0, 22.0, 24.0]),
    (24.0, [25.0, 26.0, 28.0]),
];

/// A metric thread with a given clearance hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ClearanceHole {
    /// Nominal diameter of the thread, millimetres.
    pub(super) thread: f64,
    series: &'static str,
}

impl ClearanceHole {
    /// Finds the thread for a hole of this diameter, millimetres; `None` if no series has it.
    pub(super) fn of(diameter: f64) -> Option<Self> {
        CLEARANCE_HOLES.iter().find_map(|(thread, holes)| {
            let series = holes.iter().position(|hole| (hole - diameter).abs() < 1e-6)?;
            Some(Self { thread: *thread, series: ["fine", "medium", "coarse"][series] })
        })
    }
}

impl std::fmt::Display for ClearanceHole {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "M{}, ISO 273 {}", self.thread, self.series)
    }
}

impl Plate {
    /// The plate of a body with these joints across `normal`; `towards_legs` is the mean direction of the legs from the
    /// body, in its frame.
    pub(super) fn under(
        joints: &[ExportedJoint],
        normal: &Vector3<f64>,
        towards_legs: &Vector3<f64>,
        sizes: &Sizes,
        design: Option<&PlateDesign>,
        size: f64,
    ) -> Self {
        let (n, axes) = (normal, frame_of(normal));
        let legs_above = n.dot(towards_legs) >= 0.0;
        let side = if legs_above { 1.0 } else { -1.0 };
        // heights towards the legs; the lowest joint sits on the plate itself
        let height = |p: &Point3<f64>| side * n.dot(&p.coords);
        let lowest = joints.iter().map(|j| height(&j.at)).fold(f64::INFINITY, f64::min);
        let seat = sizes.height;
        let bolts: Option<BoltPattern> = design.and_then(|d| d.bolts);
        let face = side * (lowest - seat);
        let lower = if legs_above { face - sizes.thickness } else { face };
        let tolerance = 1e-9 * size;
        let mut holes: Vec<DrilledHole> = Vec::new();
        for joint in joints {
            let local = axes.transpose() * joint.at.coords;
            let (at, above) = (Point2::new(local.x, local.y), height(&joint.at) - lowest);
            // a joint higher than the reach of its ball stands on a post
            let raised = above > tolerance || seat - 0.5 * sizes.ball > tolerance;
            let post = if raised { (seat + above - 0.5 * sizes.ball).max(0.0) } else { 0.0 };
            let same =
                |h: &&mut DrilledHole| (h.at - at).norm() <= tolerance && (h.post - post).abs() <= tolerance;
            if let Some(hole) = holes.iter_mut().find(same) {
                hole.joints.push(joint.name.clone());
            } else {
                let bolts = bolts.map_or_else(Vec::new, |b| b.places(&at));
                holes.push(DrilledHole { joints: vec![joint.name.clone()], at, post, bolts });
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
            bolt_diameter: bolts.map_or(0.0, |b| b.hole),
            material: design.and_then(|d| d.material.clone()),
            density: design.and_then(PlateDesign::kilograms_per_cubic_metre),
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
        let holes: f64 = self.all_holes().map(|(_, diameter)| 0.25 * PI * diameter * diameter).sum();
        (self.outline.area() - holes) * self.thickness
    }

    /// Mass, kilograms, with the length of a design unit in metres; `None` if the density is unknown.
    #[must_use]
    pub fn mass(&self, metres: f64) -> Option<f64> {
        self.density.map(|density| density * self.volume() * metres.powi(3))
    }

    /// Middles and diameters of all holes, plate frame: those under the joints, then those of the bolts.
    pub fn all_holes(&self) -> impl Iterator<Item = (Point2<f64>, f64)> + '_ {
        let seats = self.holes.iter().map(|h| (h.at, self.hole_diameter));
        seats.chain(self.holes.iter().flat_map(|h| h.bolts.iter().map(|p| (*p, self.bolt_diameter))))
    }

    /// Number of bolt holes.
    #[must_use]
    pub fn bolt_count(&self) -> usize {
        self.holes.iter().map(|h| h.bolts.len()).sum()
    }

    /// Start and end of the post of a hole along the normal.
    #[must_use]
    pub fn post_span(&self, hole: &DrilledHole) -> (f64, f64) {
        if self.legs_above { (self.thickness, self.thickness + hole.post) } else { (-hole.post, 0.0) }
    }

    /// `self` if no seats overlap and no bolt hole overlaps another hole or the outline. Seats keep clear of the
    /// outline, because no hole is wider than twice the margin.
    ///
    /// # Errors
    /// [`Unsupported::SeatsOverlap`], [`Unsupported::HolesMeet`].
    pub fn made(&self, body: Body) -> Result<&Self, Unsupported> {
        for (i, a) in self.holes.iter().enumerate() {
            for b in &self.holes[i + 1..] {
                let distance = (a.at - b.at).norm();
                let raised = a.post > 0.0 || b.post > 0.0;
                let (parts, diameter) =
                    if raised { ("posts", self.post_diameter) } else { ("holes", self.hole_diameter) };
                if distance <= diameter {
                    let name = |h: &DrilledHole| h.joints.join("/");
                    let (first, second) = (name(a), name(b));
                    return Err(Unsupported::SeatsOverlap { body, parts, first, second, distance, diameter });
                }
            }
        }
        self.bolts_keep_clear(body)?;
        Ok(self)
    }

    fn bolts_keep_clear(&self, body: Body) -> Result<(), Unsupported> {
        let radius = 0.5 * self.bolt_diameter;
        let name = |h: &DrilledHole| h.joints.join("/");
        let meet = |hole: &DrilledHole, second: String, gap: f64| {
            if gap > 0.0 {
                return Ok(());
            }
            let first = format!("a bolt hole of {}", name(hole));
            Err(Unsupported::HolesMeet { body, first, second, by: -gap })
        };
        for (i, hole) in self.holes.iter().enumerate() {
            for (k, bolt) in hole.bolts.iter().enumerate() {
                meet(hole, "the outline".to_string(), self.outline.depth(bolt) - radius)?;
                for other in &self.holes {
                    let gap = (bolt - other.at).norm() - radius - 0.5 * self.hole_diameter;
                    meet(hole, format!("the hole of {}", name(other)), gap)?;
                }
                let later = self.holes.iter().skip(i + 1).flat_map(|o| o.bolts.iter().map(move |q| (o, q)));
                let own = hole.bolts[k + 1..].iter().map(|q| (hole, q));
                for (other, q) in own.chain(later) {
                    let gap = (bolt - q).norm() - 2.0 * radius;
                    meet(hole, format!("a bolt hole of {}", name(other)), gap)?;
                }
            }
        }
        Ok(())
    }
}
