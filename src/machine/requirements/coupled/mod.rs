//! Machines whose drive lengths differ from the distances of their joints. Their universal joints have axes that do not
//! intersect, or screws couple the rotation of a leg about itself to its length.
//!
//! The first axis `a` of a joint goes through its centre `A` in the body. The second axis is perpendicular to it and to
//! the leg, at the distance `d` towards the other end. It passes through `A + d w`, with the unit vector `w` across
//! `a`. At the platform `b`, `B`, `d'`, `w'` have the same meaning, with the second axis at `B - d' w'`. The leg has
//! the line `s = B - d' w' - (A + d w)`, and
//!
//! ```text
//! w = part of (B - d' w' - A) across a,   w' = part of (B - A - d w) across b,   as unit vectors,
//! drive = |s| - lead psi / (2 pi),
//! ```
//!
//! `psi` the angle about `s` from the second axis at the base to that at the platform, counted from home.
//! `docs/theory/joints.md` has derivations and proofs.

mod leg;

use nalgebra::{Matrix6, Vector3};
use thiserror::Error;

use super::Hardware;
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator};

pub use self::leg::{LegNumber, PlacedLeg, Vec3, cross, dot, minus, scaled, unit};

/// Most steps of the fixed point of the two directions of a leg: a factor of a half needs 55.
const STEPS: usize = 400;

/// Reasons why drives have no lengths at a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoDriveLength {
    /// The line of a leg is along a first axis, or so near that the offset of the other end decides.
    #[error("leg {leg} goes along the first axis of its {body} joint, where the joint is singular")]
    AlongFirstAxis {
        /// The leg, counted from 1.
        leg: usize,
        /// The body of the joint.
        body: Body,
    },
    /// The product of the offsets is at least that of the distances across the first axes.
    #[error(
        "the offsets of leg {0} are too large for its length: where its second axes are is not determined"
    )]
    OffsetsTooLarge(usize),
    /// Numbers that are not finite.
    #[error("leg {0} has no finite length at this pose")]
    NotFinite(usize),
    /// A lead without universal joints at both ends.
    #[error("screws need universal joints at both ends of the legs")]
    LeadOfBalls,
}

/// A leg at a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveState {
    /// From the base joint to the second axis there, base frame; zero without an offset.
    pub start: Vector3<f64>,
    /// Length of the drive minus the distance of the joints; exactly 0 without offsets and lead.
    pub correction: f64,
    /// The part of the correction that the offsets cause.
    pub of_offsets: f64,
    /// The angle about the leg from the second axis at the base to that at the platform, relative to home, radians from
    /// -pi to pi. It is 0 for legs without lead.
    pub twist: f64,
    /// The line of the leg, base frame. It joins the second axes at base and platform, or the centres of ball joints.
    pub line: Vector3<f64>,
    /// Rates of the drive length for unit velocities of the platform origin along x, y, z and unit angular velocities
    /// about them, base frame.
    pub rates: [f64; 6],
}

/// The legs of a machine with joint offsets or screw leads.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledLegs {
    /// The joint centres.
    pub manipulator: Manipulator,
    /// First axes at base and platform, in the frames of the bodies.
    pub axes: [[Vector3<f64>; 6]; 2],
    /// Distances of the two axes of a universal joint, at base and platform.
    pub offsets: [f64; 2],
    /// Lead of the screws, design units per radian.
    pub lead: f64,
    /// The pose at which the twists are `at_home`.
    pub home: Pose,
    /// Twists at home, radians.
    pub at_home: [f64; 6],
}

impl CoupledLegs {
    /// Takes joints from a design. Ideal joints are balls here; so are universal joints without offset if there is no
    /// lead.
    ///
    /// # Errors
    /// A lead without universal joints, or no drive length at home, where twists are zero.
    pub fn new(m: &Manipulator, hardware: &Hardware, home: &Pose) -> Result<Self, NoDriveLength> {
        let lead = hardware.screw_lead.unwrap_or(0.0) / std::f64::consts::TAU;
        let joints = Body::BOTH.map(|body| hardware.universal(body));
        if lead != 0.0 && joints.iter().any(|joint| !joint.is_some_and(|j| j.is_of_all())) {
            return Err(NoDriveLength::LeadOfBalls);
        }
        let axes = joints.map(|j| {
            let first = |axis: Option<nalgebra::Unit<Vector3<f64>>>| axis.map_or(Vector3::zeros(), |a| *a);
            j.map_or([Vector3::zeros(); 6], |j| j.first_axes.map(first))
        });
        let offsets = joints.map(|j| j.map_or(0.0, |j| j.offset));
        let mut out = Self { manipulator: m.clone(), axes, offsets, lead, home: *home, at_home: [0.0; 6] };
        if lead != 0.0 {
            let mut at_home = [0.0; 6];
            for (i, twist) in at_home.iter_mut().enumerate() {
                *twist = out.state_of(i, home)?.twist;
            }
            out.at_home = at_home;
        }
        Ok(out)
    }

    /// Joints and legs.
    #[must_use]
    pub fn manipulator(&self) -> &Manipulator {
        &self.manipulator
    }

    /// First axes of the joints of a body in its frame, in leg order: unit vectors, zero for balls.
    #[must_use]
    pub fn first_axes(&self, body: Body) -> &[Vector3<f64>; 6] {
        &self.axes[body.index()]
    }

    /// Distances of the axes of each joint at base and platform, design units.
    #[must_use]
    pub fn offsets(&self) -> [f64; 2] {
        self.offsets
    }

    /// The lengthening of a leg per radian of rotation about itself, design units.
    #[must_use]
    pub fn lead_per_radian(&self) -> f64 {
        self.lead
    }

    /// The angles about the legs from second axis to second axis at home, radians; 0 without a lead.
    #[must_use]
    pub fn turned_at_home(&self) -> [f64; 6] {
        self.at_home
    }

    /// The leg at a pose, without its second axes.
    fn placed(&self, i: usize, pose: &Pose) -> PlacedLeg<f64> {
        let leg = self.manipulator.legs()[i];
        let arm = pose.rotation * leg.platform.coords;
        // the same sum as in the distance of the joints
        let line = pose.transform(&leg.platform) - leg.base;
        let axes = [self.axes[0][i], pose.rotation * self.axes[1][i]];
        PlacedLeg { line: line.into(), arm: arm.into(), axes: axes.map(Into::into), offsets: self.offsets }
    }

    /// Whether the second axis at an end matters.
    pub fn needs(&self, end: usize) -> bool {
        self.offsets[end] != 0.0 || self.lead != 0.0
    }

    /// The directions to the second axes, by a fixed-point iteration. It converges since the product of both maps has
    /// the factor `d d' / (r r')`, with the least distances `r` across the first axes.
    fn ends(&self, i: usize, placed: &PlacedLeg<f64>) -> Result<[Vec3<f64>; 2], NoDriveLength> {
        let mut reach = [f64::INFINITY; 2];
        for (end, body) in Body::BOTH.into_iter().enumerate().filter(|(end, _)| self.needs(*end)) {
            let aside = cross(&placed.axes[end], &placed.line);
            let r = dot(&aside, &aside).sqrt() - self.offsets[1 - end];
            if r.is_nan() {
                return Err(NoDriveLength::NotFinite(i + 1));
            }
            if !(r > 0.0) {
                return Err(NoDriveLength::AlongFirstAxis { leg: i + 1, body });
            }
            reach[end] = r;
        }
        let product = self.offsets[0] * self.offsets[1];
        if product > 0.0 && !(product < reach[0] * reach[1]) {
            return Err(NoDriveLength::OffsetsTooLarge(i + 1));
        }
        let failed = NoDriveLength::NotFinite(i + 1);
        let mut ends = [[0.0; 3]; 2];
        for step in 0..STEPS {
            let before = ends;
            for end in (0..2).filter(|end| self.needs(*end)) {
                ends[end] = placed.direction(end, &ends[1 - end]).ok_or(failed)?;
            }
            let moved = (0..2).flat_map(|e| (0..3).map(move |k| (e, k)));
            let moved = moved.map(|(e, k)| (ends[e][k] - before[e][k]).abs()).fold(0.0, f64::max);
            // with at most one offset the second step changes nothing
            if step > 0 && (product == 0.0 || moved <= 4.0 * f64::EPSILON) {
                return Ok(ends);
            }
        }
        Err(NoDriveLength::OffsetsTooLarge(i + 1))
    }

    /// One leg at a pose.
    ///
    /// # Errors
    /// A pose that the leg cannot reach.
    pub fn state_of(&self, i: usize, pose: &Pose) -> Result<DriveState, NoDriveLength> {
        let placed = self.placed(i, pose);
        let ends = self.ends(i, &placed)?;
        let failed = NoDriveLength::NotFinite(i + 1);
        let s = placed.between(&ends);
        let line = Vector3::from(placed.line);
        let start = Vector3::from(ends[0]) * self.offsets[0];
        let moved = line - Vector3::from(s);
        // |s| - |d|, without the loss of a difference
        let of_offsets =
            (moved.norm_squared() - 2.0 * line.dot(&moved)) / (Vector3::from(s).norm() + line.norm());
        let mut twist = 0.0;
        if self.lead != 0.0 {
            let [sine, cosine] = placed.twist(&ends).ok_or(failed)?;
            let turned = sine.atan2(cosine) - self.at_home[i];
            twist = turned - std::f64::consts::TAU * (turned / std::f64::consts::TAU).round();
        }
        let [length, turn] = placed.rates(&ends, self.lead != 0.0).ok_or(failed)?;
        let rates: [f64; 6] = std::array::from_fn(|k| length[k] - self.lead * turn[k]);
        let correction = of_offsets - self.lead * twist;
        if !correction.is_finite() || rates.iter().any(|x| !x.is_finite()) {
            return Err(failed);
        }
        Ok(DriveState { start, correction, of_offsets, twist, line: s.into(), rates })
    }

    /// Every leg at a pose.
    ///
    /// # Errors
    /// A leg whose drive has no length at this pose.
    pub fn states(&self, pose: &Pose) -> Result<[DriveState; 6], NoDriveLength> {
        let mut out = Vec::with_capacity(6);
        for i in 0..6 {
            out.push(self.state_of(i, pose)?);
        }
        out.try_into().map_err(|_| NoDriveLength::NotFinite(1))
    }

    /// The drive lengths at a pose, in leg order: the commands of a controller.
    ///
    /// # Errors
    /// The errors of [`Self::states`].
    pub fn drives(&self, pose: &Pose) -> Result<[f64; 6], NoDriveLength> {
        let states = self.states(pose)?;
        let legs = self.manipulator.legs();
        Ok(std::array::from_fn(|i| pose.squared_length(&legs[i]).sqrt() + states[i].correction))
    }

    /// Rates of the drives as rows in leg order, moments over a length.
    #[must_use]
    pub fn jacobian(states: &[DriveState; 6], characteristic_length: f64) -> Matrix6<f64> {
        Matrix6::from_fn(
            |i, k| if k < 3 { states[i].rates[k] } else { states[i].rates[k] / characteristic_length },
        )
    }
}
