//! Requirements in conflict.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::BranchRecord;
use crate::Number;
use ask::Design;
use machine::requirements::{Objective, TermKind};
use optimize::dimensional::{ConstraintConflict, Demand, Give};
use optimize::offsets::{BranchWord, Conflict};

/// A conflict: a set of requirements that cannot be met together; without any one of them the others were met.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ConflictRecord {
    /// Whether the conflict is proved.
    pub proved: bool,
    /// The requirements in conflict, with the amounts to relax. Empty: the branches are empty for different reasons.
    pub requirements: Vec<GiveRecord>,
    /// The reasons for empty branches of the offsets, by kind; empty: the search has no branches.
    pub reasons: Vec<ConflictReasonRecord>,
}

/// A kind of proof that branches of the offsets are empty.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ConflictReasonRecord {
    /// A short stable code.
    #[schemars(extend("enum" = Conflict::CODES))]
    pub code: String,
    /// Number of branches with this as their first proof.
    pub branches: usize,
    /// The proof for one of these branches in one sentence, with its numbers.
    pub message: String,
}

impl ConflictRecord {
    /// The record of a conflict in a design.
    #[must_use]
    pub fn new(design: &Design, c: &ConstraintConflict) -> Self {
        Self {
            proved: c.proved,
            requirements: c.demands.iter().map(|g| GiveRecord::new(design, g)).collect(),
            reasons: Vec::new(),
        }
    }

    /// The reasons why all branches are empty.
    pub(super) fn of_branches(branches: &[BranchRecord]) -> Self {
        Self { proved: true, requirements: Vec::new(), reasons: ConflictReasonRecord::all(branches) }
    }
}

impl ConflictReasonRecord {
    /// The reasons of the proved empty branches, by their codes.
    #[must_use]
    pub fn all(branches: &[BranchRecord]) -> Vec<Self> {
        let mut kinds: Vec<Self> = Vec::new();
        let empty = branches.iter().filter(|b| b.verdict == BranchWord::Infeasible);
        for c in empty.filter_map(|b| b.conflicts.first()) {
            match kinds.iter_mut().find(|kind| kind.code == c.code) {
                Some(kind) => kind.branches += 1,
                None => {
                    kinds.push(Self { code: c.code.clone(), branches: 1, message: c.message.clone() });
                }
            }
        }
        kinds.sort_by(|a, b| a.code.cmp(&b.code));
        kinds
    }
}

/// A requirement of a conflict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GiveRecord {
    /// The requirement.
    pub name: DemandWord,
    /// The unit of the amounts.
    pub unit: String,
    /// The amount of relaxation that suffices alone; null: no amount suffices.
    pub alone: Option<Number>,
    /// The amount of relaxation if all requirements give way together; the sum of these amounts, each in its scale, is
    /// least.
    pub together: Number,
    /// The relaxation in one sentence.
    pub message: String,
}

impl GiveRecord {
    fn new(design: &Design, g: &Give) -> Self {
        let (what, unit) = words(design, g.demand);
        let message = match g.alone {
            Some(x) if x > 0.0 => {
                format!("{what} would have to give by {} {unit}", amount(x)).trim_end().to_string()
            }
            Some(_) => format!("{what} would have to give by no more than the spare of the search"),
            None => format!("{what} cannot make room alone, whatever it gives"),
        };
        Self {
            name: g.demand.into(),
            unit,
            alone: g.alone.map(Number),
            together: Number(g.together),
            message,
        }
    }

    /// The amount of relaxation together with the others, for people.
    #[must_use]
    pub fn amount(&self) -> String {
        amount(self.together.0)
    }
}

/// A positive amount with at least four significant digits.
pub(super) fn amount(x: f64) -> String {
    if x < 1e-3 { format!("{x:.3e}") } else { format!("{x:.6}") }
}

/// A constraint in words, and the unit in which it gives.
pub(super) fn words(design: &Design, d: Demand) -> (String, String) {
    match d {
        Demand::Requirement(kind) => {
            let sentence = match kind {
                TermKind::LegTooShort => "the least leg length",
                TermKind::LegTooLong => "the greatest leg length",
                TermKind::BaseSwing => "the swing limit of the base joints",
                TermKind::PlatformSwing => "the swing limit of the platform joints",
                TermKind::BaseFirstAngle => "the limit about the first axes of the base joints",
                TermKind::BaseSecondAngle => "the limit about the second axes of the base joints",
                TermKind::PlatformFirstAngle => "the limit about the first axes of the platform joints",
                TermKind::PlatformSecondAngle => "the limit about the second axes of the platform joints",
                TermKind::LegClearance => "the clearance between legs",
                TermKind::KeepOut => "the clearance from the keep-outs",
                TermKind::LegForce => "the greatest leg force",
                TermKind::LegSpeed => "the greatest leg speed",
                TermKind::BaseSpacing => "the room between base joints",
                TermKind::PlatformSpacing => "the room between platform joints",
                TermKind::BaseEnvelope => "the envelope of the base",
                TermKind::PlatformEnvelope => "the envelope of the platform",
                TermKind::MachineEnvelope => "the envelope of the machine",
                TermKind::BaseHoleEdge => "the edge distance of the holes in the base plate",
                TermKind::PlatformHoleEdge => "the edge distance of the holes in the platform plate",
                TermKind::BaseHoleGap => "the distance of the holes in the base plate",
                TermKind::PlatformHoleGap => "the distance of the holes in the platform plate",
                TermKind::PlateClearance => "the clearance from the plates",
                TermKind::PayloadClearance => "the clearance from the payload",
                TermKind::LinearStiffness => "the least stiffness against forces",
                TermKind::AngularStiffness => "the least stiffness against torques",
                TermKind::NaturalFrequency => "the least natural frequency",
                TermKind::RodTooShort | TermKind::RodTooLong => "the reach of the rods",
                TermKind::CrankTransmission => "the least transmission angle of the cranks",
                TermKind::CrankAngle => "the limits of the angles of the cranks",
                TermKind::TipSwing => "the swing limit of the joints at the tips",
                TermKind::CrankTorque => "the greatest torque of the cranks",
                TermKind::CrankSpeed => "the greatest speed of the cranks",
            };
            (sentence.to_string(), design.unit_of(kind.quantity()))
        }
        Demand::Determinant => {
            let default =
                if design.optimize.min_abs_det.is_none() { ", a default of the search," } else { "" };
            (format!("the least |det A|{default}"), String::new())
        }
        Demand::Reach => ("the reach of sliding joints".to_string(), "reaches".to_string()),
        Demand::Level(o) => (format!("the level of {}", o.code()), String::new()),
    }
}

/// A demand on the platform.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum DemandWord {
    /// A requirement of the design.
    Requirement(TermKind),
    /// A least value of an objective.
    Level(Objective),
    /// A demand of the search itself.
    Special(SpecialDemand),
}

/// A demand of the search itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SpecialDemand {
    /// The least value of |det A|.
    AbsDet,
    /// The greatest distance of sliding joints from their body.
    Reach,
}

impl From<Demand> for DemandWord {
    fn from(d: Demand) -> Self {
        match d {
            Demand::Requirement(kind) => Self::Requirement(kind),
            Demand::Level(o) => Self::Level(o),
            Demand::Determinant => Self::Special(SpecialDemand::AbsDet),
            Demand::Reach => Self::Special(SpecialDemand::Reach),
        }
    }
}

impl DemandWord {
    /// The code of the demand.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::Requirement(kind) => kind.code(),
            Self::Level(o) => o.code(),
            Self::Special(SpecialDemand::AbsDet) => "abs_det",
            Self::Special(SpecialDemand::Reach) => "reach",
        }
    }
}
