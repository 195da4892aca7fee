//! Requirements in conflict.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::BranchRecord;
use crate::Number;
use ask::Design;
use machine::requirements::{Objective, TermKind};
use optimize::dimensional::{ConstraintConflict, Demand, Give};
use optimize::offsets::{BranchWord, Conflict};

view! {
    /// A conflict: a set of requirements that cannot be met together; without any one of them the others were met.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct ConflictRecord {
        /// Whether the conflict is proved.
        pub proved: bool = c.proved,
        /// The requirements in conflict, with the amounts to relax. Empty: the branches are empty for different
        /// reasons.
        pub requirements: Vec<GiveRecord> = c.demands.iter().map(|g| GiveRecord::new(design, g)).collect(),
        /// Reasons for empty branches, by kind; empty: the search has no branches.
        pub reasons: Vec<ConflictReasonRecord> = Vec::new(),
    }
    /// The record of a conflict in a design.
    pub fn new(design: &Design, c: &ConstraintConflict) {}
}

/// A kind of proof that branches of the offsets are empty.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ConflictReasonRecord {
    /// A short stable code.
    #[schemars(extend("enum" = Conflict::CODES))]
    pub code: String,
    /// Number of branches with this first proof.
    pub branches: usize,
    /// Proof for one branch, with its numbers.
    pub message: String,
}

impl ConflictRecord {
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

view! {
    /// A requirement of a conflict.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct GiveRecord {
        /// The requirement.
        pub name: DemandWord = g.demand.into(),
        /// Unit.
        pub unit: String = unit,
        /// Relaxation that suffices alone; null: no amount suffices.
        pub alone: Option<Number> = g.alone.map(Number),
        /// Relaxation if all give way together; the sum of these amounts, each in its scale, is least.
        pub together: Number = Number(g.together),
        /// Relaxation in words.
        pub message: String = message,
    }
    fn new(design: &Design, g: &Give) {
        let (what, unit) = words(design, g.demand);
        let message = match g.alone {
            Some(x) if x > 0.0 => format!("{what}: relax it by {} {unit}", amount(x)).trim_end().to_string(),
            Some(_) => format!("{what}: relax it by less than the tolerance of the search"),
            None => format!("{what}: relaxing it alone does not resolve the conflict"),
        };
    }
}

/// An amount in a sentence.
pub(super) fn amount(x: f64) -> String {
    num::shown::rounded(x, 3)
}

/// A constraint in words, and the unit of its relaxation.
pub(super) fn words(design: &Design, d: Demand) -> (String, String) {
    match d {
        Demand::Requirement(kind) => (kind.label().to_owned(), design.unit_of(kind.quantity())),
        Demand::Determinant => {
            let default =
                if design.optimize.min_abs_det.is_none() { " (a default of the search)" } else { "" };
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
    pub fn label(self) -> String {
        match self {
            Self::Requirement(kind) => kind.label().into(),
            Self::Level(o) => o.code().replace('_', " "),
            Self::Special(SpecialDemand::AbsDet) => "|det A|, minimum".into(),
            Self::Special(SpecialDemand::Reach) => "reach of sliding joints".into(),
        }
    }
}
