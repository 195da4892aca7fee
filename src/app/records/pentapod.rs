//! Answers about designs of five legs.

use schemars::JsonSchema;
use serde::Serialize;

use super::{ComplexRecord, Number};
use ask::PentapodReport;
use fk::{LineClass, LinePose};
use num::exact::nearest;
use platform::manipulator::Body;
use synthesis::DecouplingLeg;

/// The answer of `check` and of `fk` about a design of five legs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PentapodAnswer {
    /// The name of the design.
    pub name: String,
    /// How many legs it has: 5.
    pub legs: usize,
    /// A joint is no fraction; the answer is about its nearest doubles.
    pub rounded_joints: bool,
    /// The line that the legs hold; null where no body has all its joints on a line. The other freedom of the platform
    /// is the turn about this line.
    pub line: Option<HeldLineRecord>,
    /// Whether the legs are dependent at every pose; null: not decided.
    pub architecturally_singular: Option<bool>,
    /// The sixth legs with which the platform is solved in steps.
    pub sixth_legs: Vec<DecouplingLeg>,
    /// The lengths that poses were asked for; null: none.
    pub lengths: Option<[f64; 5]>,
    /// All poses of the line for them; null where none were asked for, or there is no answer.
    pub poses: Option<LinePosesRecord>,
    /// Why there are no poses although lengths are given.
    pub no_poses: Option<String>,
}

/// A line of a body that five legs hold.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct HeldLineRecord {
    /// The body.
    pub body: Body,
    /// Where the joint of each leg is on the line, from that of leg 1, in units of `length`.
    pub marks: [Number; 5],
    /// From the joint of leg 1 to the one farthest from it, design units.
    pub length: Number,
    /// By which equation the line is found; null where the legs are dependent.
    pub class: Option<LineClass>,
    /// Poses of the line, real and complex, for generic lengths; null where they were not counted.
    pub generic_poses: Option<usize>,
    /// The poses of the line that are singular.
    pub singular_poses: LineLocusRecord,
}

/// The polynomial `F(p, v)` whose zeros are the singular poses of the line.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LineLocusRecord {
    /// `architecturally singular`, `quadratic in all`, `linear in the position`, `linear in the direction`, or `cubic`.
    pub family: &'static str,
    /// Its degree.
    pub degree: u8,
    /// Its degree in the position.
    pub degree_in_position: u8,
    /// Its degree in the direction.
    pub degree_in_direction: u8,
    /// Its terms. The position is that of the joint of leg 1 in the frame of the other body, and the direction is a
    /// vector as long as `length`.
    pub terms: Vec<LineTermRecord>,
}

/// A term of a polynomial in the position and the direction of a line.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LineTermRecord {
    /// Exponents of `p_x, p_y, p_z, v_x, v_y, v_z`.
    pub exponents: [u8; 6],
    /// The coefficient, an integer as decimal text.
    pub coefficient: String,
}

/// All poses of a line for given lengths.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LinePosesRecord {
    /// How many there are, real and complex, each as often as its multiplicity says: proved in exact arithmetic.
    pub counted: usize,
    /// How many of them are real.
    pub real: usize,
    /// The coefficients of the polynomial that gives them, as decimal text, the constant one first.
    pub coefficients: Vec<String>,
    /// The poses, the real ones first.
    pub poses: Vec<LinePoseRecord>,
}

/// A pose of a line in the frame of the other body.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LinePoseRecord {
    /// The joint of leg 1, design units.
    pub position: ComplexRecord<[Number; 3]>,
    /// The unit vector from the joint of leg 1 towards the one farthest from it.
    pub direction: ComplexRecord<[Number; 3]>,
    /// Whether it is real: decided exactly.
    pub real: bool,
    /// How often it counts.
    pub multiplicity: usize,
    /// No coordinate of the position is farther from the true one.
    pub position_error: Number,
    /// No coordinate of the direction is farther from the true one.
    pub direction_error: Number,
}

impl From<&LinePose> for LinePoseRecord {
    fn from(pose: &LinePose) -> Self {
        Self {
            position: pose.position.into(),
            direction: pose.direction.into(),
            real: pose.real,
            multiplicity: pose.multiplicity,
            position_error: Number(pose.error[0]),
            direction_error: Number(pose.error[1]),
        }
    }
}

impl From<&PentapodReport> for PentapodAnswer {
    fn from(report: &PentapodReport) -> Self {
        let line = report.held.as_ref().map(|held| HeldLineRecord {
            body: held.line.body,
            marks: held.line.marks.each_ref().map(|mark| Number(nearest(mark))),
            length: Number(nearest(&held.line.square()).sqrt()),
            class: held.class,
            generic_poses: held.generic_poses,
            singular_poses: LineLocusRecord {
                family: held.locus.family(),
                degree: held.locus.degree,
                degree_in_position: held.locus.in_position,
                degree_in_direction: held.locus.in_direction,
                terms: held
                    .locus
                    .polynomial
                    .iter()
                    .map(|(exponents, c)| LineTermRecord {
                        exponents: *exponents,
                        coefficient: c.to_string(),
                    })
                    .collect(),
            },
        });
        let (poses, no_poses) = match &report.poses {
            None => (None, None),
            Some(Err(why)) => (None, Some(why.to_string())),
            Some(Ok(found)) => {
                let poses: Vec<_> = found.poses.iter().map(LinePoseRecord::from).collect();
                let record = LinePosesRecord {
                    counted: found.counted,
                    real: poses.iter().filter(|pose| pose.real).count(),
                    coefficients: found.polynomial.coefficients().iter().map(ToString::to_string).collect(),
                    poses,
                };
                (Some(record), None)
            }
        };
        Self {
            name: report.design.name.clone(),
            legs: 5,
            rounded_joints: report.design.rounded,
            line,
            architecturally_singular: report.architecturally_singular,
            sixth_legs: report.sixth_legs.clone(),
            lengths: report.lengths,
            poses,
            no_poses,
        }
    }
}
