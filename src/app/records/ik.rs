//! Answers of inverse kinematics: the leg lengths at given poses.

use schemars::JsonSchema;
use serde::Serialize;

use super::{
    DriveLengthsRecord, Number, PoseConventionRecord, PoseInFrames, PoseRecord, PoseUncertaintyRecord,
    RotaryIkRecord, RotaryIkRowsAnswer,
};
use ask::{Design, PoseFrames, meets_all};
use machine::coupled::{CoupledLegs, DriveState};
use machine::manufacture::MachineUncertainty;
use machine::requirements::{JointAngles, LeastMargins, Term, TermKind, Terms};
use platform::geom::{Pose, PoseConvention};
use platform::manipulator::{inverse_condition, jacobian};

/// The answer of `ik`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum IkAnswer {
    /// Several poses or a table.
    Rows(IkRowsAnswer),
    /// One pose.
    One(Box<IkRecord>),
    /// Several poses with cranks.
    CrankRows(RotaryIkRowsAnswer),
    /// One pose with cranks.
    Cranks(Box<RotaryIkRecord>),
}

impl IkAnswer {
    /// With the convention of its poses.
    #[must_use]
    pub fn with_frames(mut self, convention: &PoseConvention) -> Self {
        let record = PoseConventionRecord::from(convention);
        match &mut self {
            Self::Rows(answer) => answer.frames = record,
            Self::One(one) => one.frames = Some(record),
            Self::CrankRows(answer) => answer.frames = record,
            Self::Cranks(one) => one.frames = Some(record),
        }
        self
    }
}

/// The lengths at several poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct IkRowsAnswer {
    /// Convention in which poses were read, and of `in_frames`.
    pub frames: PoseConventionRecord,
    /// The poses in the order given.
    pub rows: Vec<IkRecord>,
}

view! {
    /// The lengths at a pose.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct IkRecord {
        /// The line of the table, from 1; null: no table.
        pub line: Option<usize> = None,
        /// The time of the row, if the table has a column of times.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub time: Option<f64> = None,
        /// Convention in which poses were read, and of `in_frames`; of several poses that of the whole answer.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub frames: Option<PoseConventionRecord> = None,
        /// The pose.
        pub pose: PoseRecord = pose.into(),
        /// Pose in the convention of `frames`.
        pub in_frames: PoseInFrames = (&frames.write(pose)).into(),
        /// Lengths shown, in leg order, design units: joint distances plus the offsets of a calibration. For joints
        /// that are not ideal, the joint distances alone.
        pub lengths: [f64; 6] = std::array::from_fn(|i| distances[i] + offsets[i]),
        /// The drive lengths, for joints that are not ideal. In this case `within_limits`, `outside`, `J` and the
        /// angles refer to drives and real axes, and there are no margins.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub drives: Option<DriveLengthsRecord> = None,
        /// Whether the pose meets all requirements of the design, the length limits included; null: it has none. For
        /// joints that are not ideal, whether the drive lengths are within `leg_length`.
        pub within_limits: Option<bool> = (!margins.is_empty()).then_some(outside.is_empty() && all_met),
        /// Legs outside `leg_length`, from 1.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        pub outside: Vec<usize> = outside,
        /// Joint angles.
        pub joints: JointAnglesRecord = JointAnglesRecord::new(&terms.joint_angles(pose)),
        /// Jacobian, rows `[u, (R b) x u]`, base frame. It gives leg speeds from the velocity of the platform origin
        /// and the angular velocity in radians. Null: a leg of length zero.
        #[serde(rename = "J")]
        pub jacobian: [[Number; 6]; 6] =
            std::array::from_fn(|i| std::array::from_fn(|j| Number(rows[(i, j)]))),
        /// Inverse condition number of the Jacobian, moments divided by the characteristic length of the design: 1 at
        /// best, 0 at a singular pose.
        pub inverse_condition: Number = Number(inverse_condition(&scaled)),
        /// Wrench of bent flexures on the platform, if the design has flexures.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub flexures: Option<FlexureRecord> = terms.flexure_wrench(pose).map(|wrench| {
            let three = |v: &nalgebra::Vector3<f64>| [v.x, v.y, v.z].map(Number);
            FlexureRecord { force: three(&wrench.force), torque: three(&wrench.torque) }
        }),
        /// Uncertainty of the pose computed from the lengths. Present for ideal joints and a design with standard
        /// deviations of a calibration.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub uncertainty: Option<PoseUncertaintyRecord> = None,
        /// Least margin by kind of requirement.
        pub margins: Vec<PoseMarginRecord> = PoseMarginRecord::least(design, margins),
    }
    /// The record of a pose with these joint distances; `terms` are the requirements of the design.
    pub fn new(
        design: &Design,
        terms: &Terms<'_>,
        (pose, frames): (&Pose, &PoseFrames),
        distances: [f64; 6],
    ) {
        let m = design.manipulator();
        let limits = design.hardware.leg_length.map(|limits| limits.range());
        let outside: Vec<usize> = match limits {
            Some((least, greatest)) => {
                (1..=6).filter(|leg| !(least..=greatest).contains(&distances[leg - 1])).collect()
            }
            None => Vec::new(),
        };
        let margins = terms.at(pose);
        let all_met = meets_all(terms, &margins, pose);
        let offsets = design.leg_offsets();
        let rows = jacobian(m, pose, 1.0);
        let scaled = jacobian(m, pose, design.characteristic_length());
    }
}

view! {
    /// Joint angles in leg order, measured from the joint axes: `base_axes` and `platform_axes` of the design, else the
    /// legs at home.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct JointAnglesRecord {
        /// Joint angles (cone angles) at the base: between each leg and its joint axis, degrees.
        pub base_cone_angle_deg: [Number; 6] = cone_angle(base),
        /// Joint angles (cone angles) at the platform: between each leg and its joint axis, degrees.
        pub platform_cone_angle_deg: [Number; 6] = cone_angle(platform),
        /// Universal joint angles at the base, degrees: `u = Rx(first) Ry(second) n` in the joint frame, with z along
        /// its axis n and x across it.
        pub base_universal_deg: [[Number; 2]; 6] = universal(base),
        /// Universal joint angles at the platform, degrees, in its frame, for the direction from base to platform.
        pub platform_universal_deg: [[Number; 2]; 6] = universal(platform),
    }
    fn new([base, platform]: &[[JointAngles; 6]; 2]) {
        let cone_angle = |all: &[JointAngles; 6]| all.map(|j| Number(j.cone_angle_deg));
        let universal = |all: &[JointAngles; 6]| all.map(|j| j.universal_deg.map(Number));
    }
}

/// The force and torque of the flexures on the platform about its origin, base frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct FlexureRecord {
    /// The force, force units.
    pub force: [Number; 3],
    /// Torque, force units times design units.
    pub torque: [Number; 3],
}

/// The margin of a kind of requirement at a pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PoseMarginRecord {
    /// The kind of requirement.
    pub name: TermKind,
    /// The least margin at this pose, negative for a violation; null: minus infinity.
    pub margin: Number,
    /// Unit.
    pub unit: String,
    /// The parts with the least margin: legs, joints, keep-out or load.
    pub between: Vec<String>,
    /// Legs, from 1.
    pub legs: Vec<usize>,
}

impl IkRecord {
    /// Adds the covariance of the pose that the calibrated machine computes here.
    #[must_use]
    pub fn with_uncertainty(mut self, design: &Design, known: &MachineUncertainty, pose: &Pose) -> Self {
        self.uncertainty = PoseUncertaintyRecord::at(design, known, pose);
        self
    }

    /// Replaces the lengths and angles by those of joints that are not ideal, with the legs at the pose.
    #[must_use]
    pub fn with_drives(
        mut self,
        design: &Design,
        terms: &Terms<'_>,
        pose: &Pose,
        (distances, states): (&[f64; 6], &[DriveState; 6]),
    ) -> Self {
        let mut drives = DriveLengthsRecord::new(distances, states);
        self.lengths = *distances;
        if let Some((least, greatest)) = design.hardware.leg_length.map(|limits| limits.range()) {
            self.outside =
                (1..=6).filter(|leg| !(least..=greatest).contains(&drives.lengths[leg - 1])).collect();
            self.within_limits = Some(self.outside.is_empty());
        }
        self.joints = JointAnglesRecord::new(&terms.angles_of(&states.map(|s| s.line), pose));
        let rows = CoupledLegs::jacobian(states, 1.0);
        self.jacobian = std::array::from_fn(|i| std::array::from_fn(|j| Number(rows[(i, j)])));
        let scaled = CoupledLegs::jacobian(states, design.characteristic_length());
        self.inverse_condition = Number(inverse_condition(&scaled));
        // flexures bend about centres of ideal joints
        self.flexures = None;
        for (length, offset) in drives.lengths.iter_mut().zip(design.leg_offsets()) {
            *length += offset;
        }
        self.drives = Some(drives);
        self
    }
}

impl PoseMarginRecord {
    /// The least margin of each kind at a pose.
    pub(super) fn all(design: &Design, terms: &Terms<'_>, pose: &Pose) -> Vec<Self> {
        Self::least(design, terms.at(pose))
    }

    /// The least of these margins of each kind.
    fn least(design: &Design, margins: Vec<(Term, f64)>) -> Vec<Self> {
        let mut least = LeastMargins::default();
        least.see(margins, ());
        let record = |(term, margin, ()): (Term, f64, ())| Self {
            name: term.kind,
            margin: Number(margin),
            unit: design.unit_of(term.kind.quantity()),
            between: design.names_of(term),
            legs: design.legs_of(term),
        };
        least.each().map(record).collect()
    }
}
