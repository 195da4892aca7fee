//! The exact closure polynomial beside the poses.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::number::left_out;
use crate::{PolynomialRecord, squared_distance};
use ask::Design;
use fk::distance::SingularFactor;
use fk::{Closure, FkSolutions, NoClosure, closure, closure_between, distance_polynomial};
use platform::manipulator::SquaredLegLengths;
use platform::topology::{JointIndex, Step};

/// The closure polynomial beside the poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ClosureRecord {
    /// Polynomial by trilaterations, in exact arithmetic.
    Polynomial(Box<ClosurePolynomialRecord>),
    /// Polynomial from all poses, with enclosed coefficients.
    OfPoses(Box<DistancePolynomialRecord>),
    /// No polynomial.
    None {
        /// The reason.
        error: String,
    },
}

/// The closure polynomial in one squared distance, with its results on the number of real poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClosurePolynomialRecord {
    /// The joints of the virtual leg; null: none is needed.
    pub virtual_leg: Option<[String; 2]>,
    /// Two joints with unknown squared distance.
    pub unknown: [String; 2],
    /// The joints of the first triangle.
    pub start: [String; 3],
    /// The trilaterations after the first triangle.
    pub sequence: Vec<TrilaterationStepRecord>,
    /// The polynomial and its real roots.
    #[serde(flatten)]
    pub polynomial: PolynomialRecord,
    /// Singular factors.
    #[serde(deserialize_with = "left_out")]
    pub factors: Vec<SingularFactor>,
    /// Number of real poses at each real root; null: not determined by the polynomial.
    pub real_poses_at_roots: Option<Vec<usize>>,
    /// Total number of real poses, proved; null: not determined by the polynomial.
    pub poses_real_proved: Option<usize>,
}

/// The polynomial in the squared distance of two joints whose roots are its values at all poses. Mirror images of a
/// planar design have one root.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistancePolynomialRecord {
    /// Two joints with unknown squared distance.
    pub unknown: [String; 2],
    /// The polynomial and its real roots.
    #[serde(flatten)]
    pub polynomial: PolynomialRecord,
    /// Reason for no trilateration polynomial.
    pub no_sequence: String,
}

/// One trilateration: a joint placed by its distances from three others.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct TrilaterationStepRecord {
    /// Joints already placed.
    pub from: [String; 3],
    /// The joint placed.
    pub place: String,
    /// Whether all four joints are on one body: the joint then has one place instead of two.
    pub rigid: bool,
}

impl TrilaterationStepRecord {
    pub(crate) fn new(step: &Step, name: impl Fn(JointIndex) -> String) -> Self {
        Self { from: step.from.map(&name), place: name(step.place), rigid: step.rigid }
    }
}

impl ClosureRecord {
    /// The polynomial of a sequence of trilaterations, for the squared lengths that `found` was computed from.
    #[must_use]
    pub fn of_sequence(design: &Design, squares: &SquaredLegLengths, found: &FkSolutions) -> Self {
        match closure(design.manipulator(), squares, found) {
            Ok(c) => Self::exact(design, &c),
            Err(why) => Self::None { error: why.to_string() },
        }
    }

    /// The polynomial in the squared distance of a base joint and a platform joint, by their numbers: by trilaterations
    /// if a sequence uses this distance, or else from all poses.
    #[must_use]
    pub fn between(
        design: &Design,
        squares: &SquaredLegLengths,
        found: &FkSolutions,
        pair: (usize, usize),
    ) -> Self {
        let m = design.manipulator();
        let why = match closure_between(m, squares, found, pair) {
            Ok(c) => return Self::exact(design, &c),
            Err(why @ NoClosure::Leg) => return Self::None { error: why.to_string() },
            Err(why) => why.to_string(),
        };
        match distance_polynomial(m, found, pair) {
            Ok(p) => {
                let unknown = [design.base_names()[pair.0].clone(), design.platform_names()[pair.1].clone()];
                let name = squared_distance(&unknown);
                let polynomial = PolynomialRecord::of_poses(name, &p);
                Self::OfPoses(Box::new(DistancePolynomialRecord { unknown, polynomial, no_sequence: why }))
            }
            Err(other) => Self::None { error: format!("{why}; from the poses: {other}") },
        }
    }

    fn exact(design: &Design, c: &Closure) -> Self {
        let p = &c.polynomial;
        let name = |j: JointIndex| match j {
            JointIndex::Base(k) => design.base_names()[k].clone(),
            JointIndex::Platform(k) => design.platform_names()[k].clone(),
        };
        let ends = |(a, b): &(usize, usize)| [name(JointIndex::Base(*a)), name(JointIndex::Platform(*b))];
        Self::Polynomial(Box::new(ClosurePolynomialRecord {
            virtual_leg: p.sequence.virtual_legs.first().map(ends),
            unknown: p.unknown.map(name),
            start: p.sequence.start.map(name),
            sequence: p.sequence.steps.iter().map(|s| TrilaterationStepRecord::new(s, name)).collect(),
            polynomial: PolynomialRecord::of_closure(c, &name),
            factors: c.degrees.factors.clone(),
            real_poses_at_roots: c.real_poses.clone(),
            poses_real_proved: c.real_count(),
        }))
    }
}
