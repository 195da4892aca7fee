//! The exact closure polynomial beside the poses.

use schemars::JsonSchema;
use serde::Serialize;

use crate::PolynomialRecord;
use ask::Design;
use fk::distance::SingularFactor;
use fk::{Closure, NoClosure};
use platform::topology::{JointIndex, Step};

/// The exact closure polynomial beside the poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ClosureRecord {
    /// The polynomial exists.
    Polynomial(Box<ClosurePolynomialRecord>),
    /// There is no polynomial.
    None {
        /// The reason.
        error: String,
    },
}

/// The closure polynomial in one squared distance, with its results on the number of real poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ClosurePolynomialRecord {
    /// The joints of the virtual leg; null: none is needed.
    pub virtual_leg: Option<[String; 2]>,
    /// The two joints with the unknown squared distance.
    pub unknown: [String; 2],
    /// The joints of the first triangle.
    pub start: [String; 3],
    /// The trilaterations after the first triangle.
    pub sequence: Vec<TrilaterationStepRecord>,
    /// The polynomial and its real roots.
    #[serde(flatten)]
    pub polynomial: PolynomialRecord,
    /// Singular factors.
    pub factors: Vec<SingularFactor>,
    /// Number of real poses at each real root; null: not determined by the polynomial.
    pub real_poses_at_roots: Option<Vec<usize>>,
    /// Total number of real poses, proved; null: not determined by the polynomial.
    pub poses_real_proved: Option<usize>,
}

/// One trilateration: a joint placed by its distances from three others.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct TrilaterationStepRecord {
    /// Three joints already placed.
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
    /// The record of a closure polynomial, with the names of the design's joints.
    #[must_use]
    pub fn new(design: &Design, closure: &Result<Closure, NoClosure>) -> Self {
        let c = match closure {
            Ok(c) => c,
            Err(why) => return Self::None { error: why.to_string() },
        };
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
