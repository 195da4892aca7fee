//! The requirements of a platform besides regularity, with their margins: space, lengths, joint angles, loads and speed
//! over a set of poses.
//!
//! The types hold the requirements of a design file. [`assess()`] evaluates them directly, pose by pose, from the
//! definitions. Forces, speeds and gaps are one function each. The proof and an optimiser call it with their own number
//! types ([`num::smooth`], [`num::ordered`]). `docs/theory/requirements.md` has the definition and the unit of every
//! term. `docs/theory/requirements.md` has the definition and the unit of every term.

mod assess;
mod bodies;
mod bound;
mod conditioning;
pub mod coupled;
mod cranks;
mod envelope;
mod flexure;
mod goal;
mod hardware;
mod holes;
mod joint_angles;
mod keep_out;
mod limit;
mod load;
mod payload;
mod plate;
mod safety_margin;
mod standing;
mod term;
#[cfg(test)]
mod tests;
mod tiling;
mod universal;
mod vibration;

pub use assess::ViolationSearch;
pub use assess::{AssessOptions, Assessment, LeastMargins, Margin, assess};
pub use bodies::MovingBodies;
pub use bound::prove_telling;
pub use bound::{AssessStage, MarginBound, MarginProof, MarginVerdict, RodRegularity, prove, regular_rods};
pub use conditioning::{LeastConditioning, least_conditioning};
pub(crate) use cranks::CrankClearances;
pub use cranks::{CrankedLeg, Cranks, least_rod_conditioning};
pub use envelope::{Envelope, Envelopes};
pub use envelope::{ball, extent};
pub use flexure::Wrench;
pub use goal::{KeptSymmetry, Objective, StartSymmetry, VariableKind};
pub use hardware::{
    ConeLimits, Hardware, Housing, JointAxes, JointType, LegBody, LegMasses, LegPart, LegSegment,
    LengthLimits,
};
pub use holes::{Grid, HoleCircle, HoleCircles, HolePattern};
pub use joint_angles::JointAngles;
pub use keep_out::{KeepOut, KeepOutShape, NearestOnSegment};
pub use limit::{Limit, Limits, PoseLimit};
pub use load::{HeldLines, LegsWeight, Load, leg_forces};
pub use payload::{ForceUnit, GRAVITY, MassUnit, Payload, PlateMass};
pub use plate::{
    BoltPattern, BoltsFrom, HoleGap, HolePair, MATERIALS, Outline, OutlinePart, OutlineSide, PlateDesign,
    PlateHole, PlateSeat, PlateSolid, Plates, seat_height,
};
pub use plate::{PlateBody, on_circle};
pub use plate::{frame_of, plate_normal};
pub use platform::geom::{CoordinateRange, ListedFrom, PoseSpace, Region};
pub use safety_margin::{SafetyMargin, SafetyMargins};
pub use standing::Standing;
pub use term::{Quantity, Term, TermKind, Terms};
pub use tiling::{LegRequirement, TiledRegion};
pub use universal::HingeAngle;
pub use universal::UniversalJoint;
#[cfg(test)]
pub(crate) use vibration::softest_of;
pub use vibration::{
    LeastStiffness, PlatformStiffness, VibratingMasses, Vibration, least_stiffness, lowest_frequency,
    mass_matrix, stiffness_matrix, vibration,
};
pub use vibration::{mass_of, scaled_mass};

use num::smooth::SmoothNumber;

/// Greatest speed of the platform: every direction of motion up to these rates, together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlatformSpeed {
    /// Speed of the platform origin, design units per second.
    pub linear: f64,
    /// Angular speed, degrees per second.
    pub angular_deg: f64,
}

impl PlatformSpeed {
    /// The greatest rate of a drive over all motions up to these speeds: `|f| linear + |m| angular` for a drive whose
    /// rate is `f . v + m . w`.
    #[must_use]
    pub fn fastest<N: SmoothNumber>(&self, force: N, moment: N) -> N {
        force.times(N::Factor::from(self.linear)) + moment.times(N::radians(self.angular_deg))
    }
}

/// All requirements of a design. Absent entries limit nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Requirements {
    /// Sizes and limits of joints, legs and drives.
    pub hardware: Hardware,
    /// Bodies that the legs must not touch.
    pub keep_outs: Vec<KeepOut>,
    /// Loads that the legs have to hold, one at a time.
    pub loads: Vec<Load>,
    /// The required speed of the platform.
    pub platform_speed: Option<PlatformSpeed>,
    /// The required stiffness of the platform; [`Hardware::leg_stiffness`] is that of a leg.
    pub platform_stiffness: Option<PlatformStiffness>,
    /// The vibrating masses, if masses and units are known.
    pub vibrating: Option<VibratingMasses>,
    /// Least distance of two joint centres of a body, design units.
    pub min_joint_distance: Option<f64>,
    /// Space that plates and machine may occupy.
    pub envelopes: Envelopes,
    /// The plates that carry the joints.
    pub plates: Plates,
    /// The space of the payload, platform frame.
    pub payload_shape: Option<KeepOutShape>,
    /// The required safety margin of each limit.
    pub safety_margins: SafetyMargins,
    /// Cranks with rods of constant length in place of legs of variable length; limits of such legs then have no
    /// effect.
    pub cranks: Option<Box<Cranks>>,
}

impl Requirements {
    /// The requirements of the drives (lengths, forces, speeds, stiffness), and all the others: each kind belongs to
    /// one of the two.
    #[must_use]
    pub fn of_drives_and_rest(&self) -> [Self; 2] {
        let [of_drives, of_rest] = self.hardware.of_drives_and_rest();
        let drives = Self {
            hardware: of_drives,
            loads: self.loads.clone(),
            platform_speed: self.platform_speed,
            platform_stiffness: self.platform_stiffness,
            vibrating: self.vibrating,
            safety_margins: self.safety_margins.clone(),
            cranks: self.cranks.clone(),
            ..Self::default()
        };
        let rest = Self {
            hardware: of_rest,
            keep_outs: self.keep_outs.clone(),
            min_joint_distance: self.min_joint_distance,
            envelopes: self.envelopes,
            plates: self.plates.clone(),
            payload_shape: self.payload_shape,
            safety_margins: self.safety_margins.clone(),
            ..Self::default()
        };
        [drives, rest]
    }

    /// `true` for a natural frequency with leg masses and joint offsets. The motion of such legs is not modelled, so
    /// the frequency is not assessed.
    #[must_use]
    pub fn leaves_out_moving_legs(&self) -> bool {
        let required = self.platform_stiffness.is_some_and(|s| s.natural_frequency.is_some());
        let moving = self.vibrating.as_ref().is_some_and(|v| v.bodies.leg != LegMasses::default());
        required && moving && self.hardware.is_coupled()
    }

    /// The required least stiffness or natural frequency, in the unit of its margin; `None` without one, and for other
    /// kinds.
    #[must_use]
    pub fn least_stiffness_of(&self, kind: TermKind) -> Option<f64> {
        self.platform_stiffness.and_then(|required| required.least(kind))
    }

    /// The reference value that makes margins of different kinds comparable: the size of the design (lengths), 90
    /// degrees, or the limit itself.
    pub fn scale_of(&self, kind: TermKind, size: f64) -> f64 {
        match kind.quantity() {
            Quantity::Length => size,
            Quantity::Angle => 90.0,
            Quantity::Force | Quantity::Speed => self.hardware.drive_limit(kind).unwrap_or(1.0),
            Quantity::LinearStiffness | Quantity::AngularStiffness | Quantity::Frequency => {
                self.least_stiffness_of(kind).unwrap_or(1.0)
            }
            Quantity::Torque | Quantity::AngularSpeed => self.whole(kind),
        }
    }
}
