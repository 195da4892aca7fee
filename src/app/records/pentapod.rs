//! Answers about designs of five legs.

use schemars::JsonSchema;
use serde::Serialize;

use super::{ComplexRecord, Number};
use ask::{HeldLine, PentapodReport};
use fk::{LineClass, LinePose};
use num::exact::nearest;
use platform::manipulator::Body;
use synthesis::DecouplingLeg;

view! {
    /// The answer of `check` and of `fk` about a design of five legs.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct PentapodAnswer {
        /// The name of the design.
        pub name: String = report.design.name.clone(),
        /// Number of legs: 5.
        pub legs: usize = 5,
        /// Whether a joint is no fraction, so that the answer is about the nearest doubles.
        pub rounded_joints: bool = report.design.rounded,
        /// The line that the legs hold; the platform can still rotate about it. Null: no body has all its joints on a
        /// line.
        pub line: Option<HeldLineRecord> = line,
        /// Whether the legs are always dependent; null: not decided.
        pub architecturally_singular: Option<bool> = report.architecturally_singular,
        /// Sixth legs that allow solving in steps.
        pub sixth_legs: Vec<DecouplingLeg> = report.sixth_legs.clone(),
        /// The lengths given, design units; null: none.
        pub lengths: Option<[f64; 5]> = report.lengths,
        /// Poses of the line for these lengths; null: no lengths were given, or there is no answer.
        pub poses: Option<LinePosesRecord> = poses,
        /// Reason for no poses; null: there are poses.
        pub no_poses: Option<String> = no_poses,
    }
    impl From(report: &PentapodReport) {
        let line = report.held.as_ref().map(HeldLineRecord::of);
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
    }
}

view! {
    /// A line of a body that five legs hold.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct HeldLineRecord {
        /// The body.
        pub body: Body = held.line.body,
        /// Leg joints along the line, measured from the joint of leg 1 in units of `length`.
        pub marks: [Number; 5] = held.line.marks.each_ref().map(|mark| Number(nearest(mark))),
        /// Distance from leg 1 to the farthest joint, design units.
        pub length: Number = Number(nearest(&held.line.square()).sqrt()),
        /// Equation that gives the line; null: the legs are dependent.
        pub class: Option<LineClass> = held.class,
        /// Number of poses of the line, real and complex, for generic lengths; null: not counted.
        pub generic_poses: Option<usize> = held.generic_poses,
        /// Singular poses of the line.
        pub singular_poses: LineLocusRecord = LineLocusRecord {
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
    }
    fn of(held: &HeldLine) {}
}

/// The polynomial `F(p, v)` whose zeros are the singular poses of the line.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LineLocusRecord {
    /// The form of the polynomial: `architecturally singular`, `quadratic in all`, `linear in the position`,
    /// `linear in the direction`, or `cubic`.
    pub family: &'static str,
    /// The degree of the polynomial.
    pub degree: u8,
    /// The degree in the position.
    pub degree_in_position: u8,
    /// The degree in the direction.
    pub degree_in_direction: u8,
    /// The terms of the polynomial. The position is the joint of leg 1 in the frame of the other body. The direction is
    /// a vector of length `length`.
    pub terms: Vec<LineTermRecord>,
}

/// A term of a polynomial in the position and the direction of a line.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LineTermRecord {
    /// Exponents of `p_x, p_y, p_z, v_x, v_y, v_z`.
    pub exponents: [u8; 6],
    /// Integer as text.
    pub coefficient: String,
}

/// All poses of a line for given lengths.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LinePosesRecord {
    /// Number of poses, real and complex, counted with multiplicity: proved in exact arithmetic.
    pub counted: usize,
    /// Number of real poses.
    pub real: usize,
    /// Polynomial of the poses, as decimal text, the constant first.
    pub coefficients: Vec<String>,
    /// Real ones first.
    pub poses: Vec<LinePoseRecord>,
}

view! {
    /// A pose of a line in the frame of the other body.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct LinePoseRecord {
        /// Joint of leg 1, frame of the other body, design units.
        pub position: ComplexRecord<[Number; 3]> = pose.position.into(),
        /// Unit vector from leg 1 to the farthest joint, frame of the other body.
        pub direction: ComplexRecord<[Number; 3]> = pose.direction.into(),
        /// Whether the pose is real, decided exactly.
        pub real: bool = pose.real,
        /// The multiplicity of the pose.
        pub multiplicity: usize = pose.multiplicity,
        /// Greatest error of a position coordinate, design units.
        pub position_error: Number = Number(pose.error[0]),
        /// Greatest error of a direction coordinate.
        pub direction_error: Number = Number(pose.error[1]),
    }
    impl From(pose: &LinePose) {}
}
