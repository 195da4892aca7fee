//! The two plates that carry the joints: their description in a design, their bodies, and the positions of their holes.

mod moments;
mod outline;
mod solid;
#[cfg(test)]
mod tests;

use nalgebra::Point2;

use super::hardware::Hardware;
use platform::manipulator::Body;

pub use moments::PlateBody;
pub use outline::on_circle;
pub use outline::{Outline, OutlinePart, OutlineSide};
pub use solid::{HoleGap, HolePair, PlateHole, PlateSeat, PlateSolid};
pub use solid::{frame_of, plate_normal};

/// Named materials, with their densities in kg/m^3: rounded values of tables of engineering materials at room
/// temperature.
pub const MATERIALS: [(&str, f64); 8] = [
    ("aluminium", 2700.0),
    ("steel", 7850.0),
    ("stainless_steel", 7900.0),
    ("cast_iron", 7200.0),
    ("titanium", 4500.0),
    ("brass", 8500.0),
    ("pom", 1410.0),
    ("plywood", 680.0),
];

num::words! {
    /// The reference direction for the angle of the first bolt of a joint.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum BoltsFrom: name, ALL {
        /// The first axis of the plate: all joints have the same pattern.
        #[default]
        Axis = "axis",
        /// The direction from the origin of the plate to the joint. Rotations about the origin that permute the joints
        /// then also permute the patterns.
        Centre = "centre",
    }
}

/// The holes by which a joint is bolted to its plate: equally spaced on a circle about its centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoltPattern {
    /// Number of bolts of a joint, at least one.
    pub count: u32,
    /// Diameter of the circle, design units.
    pub circle: f64,
    /// Diameter of the holes, design units.
    pub hole: f64,
    /// Angle of the first hole, degrees, counter-clockwise seen against the normal of the plate.
    pub first_deg: f64,
    /// The reference direction of this angle.
    pub from: BoltsFrom,
}

impl BoltPattern {
    /// Centres of the bolt holes of a joint whose foot is at `at`, plate coordinates.
    #[must_use]
    pub fn places(&self, at: &Point2<f64>) -> Vec<Point2<f64>> {
        let start = match self.from {
            BoltsFrom::Axis => 0.0,
            BoltsFrom::Centre => at.y.atan2(at.x),
        };
        let angle = |k: u32| {
            start + (self.first_deg + 360.0 * f64::from(k) / f64::from(self.count.max(1))).to_radians()
        };
        (0..self.count).map(|k| on_circle(at, 0.5 * self.circle, angle(k))).collect()
    }
}

/// The plate of a body, as a design describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateDesign {
    /// Thickness, design units.
    pub thickness: f64,
    /// Distance of the outline from the convex hull of the joints, design units.
    pub margin: f64,
    /// Diameter of the hole under each joint, design units.
    pub hole: f64,
    /// Height of the lowest joint centre above the face that carries the joints, design units. `None`: that of a ball
    /// on the edge of the hole ([`seat_height`]).
    pub height: Option<f64>,
    /// Its material.
    pub material: Option<String>,
    /// Density, kg/m^3, if it differs from that of a [known material](MATERIALS).
    pub density: Option<f64>,
    /// Least distance of the edge of a hole from the outline, design units.
    pub edge_distance: f64,
    /// Least distance of the edges of two holes, design units.
    pub hole_distance: f64,
    /// Diameter of the round foot by which a joint stands on the plate, design units.
    pub foot: Option<f64>,
    /// The bolts of each joint.
    pub bolts: Option<BoltPattern>,
}

/// Height of the centre of a ball above a plate on whose hole it sits: `sqrt(ball^2 - hole^2) / 2`.
#[must_use]
pub fn seat_height(ball: f64, hole: f64) -> f64 {
    0.5 * (ball.powi(2) - hole.powi(2)).max(0.0).sqrt()
}

impl PlateDesign {
    /// Density in kg/m^3; `None` without a density or a known material.
    #[must_use]
    pub fn kilograms_per_cubic_metre(&self) -> Option<f64> {
        let known = |name: &String| MATERIALS.iter().find(|(known, _)| known == name).map(|(_, d)| *d);
        self.density.or_else(|| self.material.as_ref().and_then(known))
    }

    /// Height of the lowest joint centre above the face, for the joints of this body. Without a given height it is that
    /// of the widest joint on its hole, since all centres have the same height.
    #[must_use]
    pub fn joint_height(&self, hardware: &Hardware, body: Body) -> f64 {
        let widest = || hardware.joint_widths(body).map_or(0.0, |[_, greatest]| greatest);
        self.height.unwrap_or_else(|| seat_height(widest(), self.hole))
    }

    /// Diameter of the greatest hole.
    pub(crate) fn greatest_hole(&self) -> f64 {
        self.hole.max(self.bolts.map_or(0.0, |b| b.hole))
    }
}

/// The plates of a design. Absent plates require nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plates {
    /// Under the base joints.
    pub base: Option<PlateDesign>,
    /// Under the platform joints.
    pub platform: Option<PlateDesign>,
}

impl Plates {
    /// The plate of a body.
    #[must_use]
    pub fn of(&self, body: Body) -> Option<&PlateDesign> {
        body.of((self.base.as_ref(), self.platform.as_ref()))
    }
}

impl Hardware {
    /// Distance from the joint centre of a leg at this body to the start of the leg's solid part. It is half the least
    /// width of the housing, or 0 without one, minus the offset of the second axis of a universal joint.
    #[must_use]
    pub fn joint_reach(&self, body: Body, leg: usize) -> f64 {
        let offset = self.universal(body).map_or(0.0, |joint| joint.offset);
        (self.housing(body, leg).map_or(0.0, |h| 0.5 * h.least_width()) - offset).max(0.0)
    }
}
