//! What is asked of an equivalent platform.

use nalgebra::Point3;

use super::SearchError;
use crate::geom::Pose;
use crate::manipulator::LegIndex;
use crate::synthesis::hexagon::Body;

/// A place where a joint has to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole {
    /// The body it is drilled into.
    pub body: Body,
    /// Frame of the body, design units.
    pub point: Point3<f64>,
    /// The new leg there has to be able to replace one of these legs, and is given its number; empty: any leg.
    pub legs: Vec<LegIndex>,
}

/// The wishes. Lengths are in design units.
#[derive(Debug, Clone, PartialEq)]
pub struct Wishes {
    /// Every joint carries one leg.
    pub no_shared_joints: bool,
    /// Smallest distance of two joints of one body.
    pub spacing: f64,
    /// `Some(d)`: legs that share no joint keep the distance `d` at all poses, as straight segments.
    pub clearance: Option<f64>,
    /// Places for joints.
    pub holes: Vec<Hole>,
    /// Least `sigma_min / sigma_max` of the length-normalised Jacobian at the poses.
    pub conditioning: f64,
    /// Greatest distance of a joint from the centroid of the leg ends of its body.
    pub reach: f64,
    /// The poses, at least one.
    pub poses: Vec<Pose>,
    /// Length that turns angles into lengths in the Jacobian.
    pub characteristic_length: f64,
}

impl Wishes {
    pub(super) fn validate(&self) -> Result<(), SearchError> {
        let limits = [
            ("spacing", self.spacing),
            ("clearance", self.clearance.unwrap_or(0.0)),
            ("conditioning", self.conditioning),
            ("reach", self.reach),
            ("characteristic_length", self.characteristic_length),
        ];
        if let Some((what, value)) = limits.into_iter().find(|(_, x)| !(*x >= 0.0 && x.is_finite())) {
            return Err(SearchError::Limit { what, value });
        }
        if self.poses.is_empty() { Err(SearchError::NoPoses) } else { Ok(()) }
    }
}

/// One of the wishes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wish {
    /// Distance of joints; those that the pattern makes one joint count only when none may be shared.
    Spacing,
    /// Distance of legs.
    Clearance,
    /// Condition of the Jacobian.
    Conditioning,
    /// How far out the joints are.
    Reach,
}

impl Wish {
    /// The name used in JSON.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Spacing => "spacing",
            Self::Clearance => "clearance",
            Self::Conditioning => "conditioning",
            Self::Reach => "reach",
        }
    }
}

/// A wish with the number that decides it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margin {
    /// The wish.
    pub wish: Wish,
    /// Its value on the platform; design units, a ratio for the conditioning.
    pub value: f64,
    /// What it must not fall below (for the reach: not exceed).
    pub required: f64,
    /// How much is left, over the size of the design (the conditioning as it is); negative when the wish is missed.
    pub slack: f64,
}
