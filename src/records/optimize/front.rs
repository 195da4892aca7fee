//! Answers about a front: platforms of which none is better in every objective.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ConflictRecord, DimensionalSolutionRecord, FreedomRecord, SymmetryRecord};
use crate::design::Design;
use crate::dimensional::{DimensionalOutcome, ParetoReport};
use crate::entrance::optimizing::Checked;
use crate::records::{DesignRecord, Number};

/// The answer of `optimize` with mode = "pareto".
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrontAnswer {
    /// What came of the search.
    pub status: FrontStatus,
    /// The members, by falling gain of the first objective.
    pub front: Vec<FrontMemberRecord>,
    /// Runs that met their bounds, and were dominated by others or equal to one.
    pub dominated: usize,
    /// Bounds that no run met.
    pub unmet: usize,
    /// When infeasible.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conflict: Option<ConflictRecord>,
    /// Where there is no front because nothing meets the requirements: the freedoms that the design does not have, each with what came of a search that had it; absent where none was looked at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub freedoms: Option<Vec<FreedomRecord>>,
    /// What became of the three-fold symmetry of the design; absent where it has none, names one, or the search could not break it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<SymmetryRecord>,
}

impl FrontAnswer {
    /// The answer of a search from a design, its members checked, with the files written.
    #[must_use]
    pub fn new(
        design: &Design,
        report: &ParetoReport,
        members: &[Checked],
        written: &[Option<String>],
    ) -> Self {
        let member = |((point, c), output): ((&crate::dimensional::ParetoPoint, _), &Option<String>)| {
            let c: &Checked = c;
            FrontMemberRecord {
                solution: DimensionalSolutionRecord {
                    history: None,
                    ..DimensionalSolutionRecord::new(design, &point.solution, c)
                },
                design: Some((&c.design).into()),
                output: output.clone(),
                non_dominated_at: point.dense.iter().copied().map(Number).collect(),
            }
        };
        Self {
            status: FrontStatus::of(report, members.iter().all(|c| c.met() == Some(true))),
            front: report.front.iter().zip(members).zip(written).map(member).collect(),
            dominated: report.dominated,
            unmet: report.unmet,
            conflict: match report.failure.as_deref().map(|r| &r.outcome) {
                Some(DimensionalOutcome::Infeasible(c)) => Some(ConflictRecord::new(design, c)),
                _ => None,
            },
            freedoms: None,
            symmetry: None,
        }
    }
}

/// A member of a front.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrontMemberRecord {
    /// The platform with its evidence.
    #[serde(flatten)]
    pub solution: DimensionalSolutionRecord,
    /// The platform as a design.
    pub design: Option<DesignRecord>,
    /// The file written.
    pub output: Option<String>,
    /// The objectives in the evaluation that compared the members.
    pub non_dominated_at: Vec<Number>,
}

/// What came of a search for a front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FrontStatus {
    /// A front whose members are proved to meet their requirements.
    Front,
    /// The search for the first objective alone met no requirements.
    Infeasible,
    /// Neither.
    Undecided,
    /// The search was told to end: the front as far as it was found.
    Interrupted,
}

impl FrontStatus {
    /// The status of a search; `met`: all members meet their requirements.
    #[must_use]
    pub fn of(report: &ParetoReport, met: bool) -> Self {
        match report.failure.as_deref().map(|r| &r.outcome) {
            _ if report.interrupted => Self::Interrupted,
            Some(DimensionalOutcome::Infeasible(_)) => Self::Infeasible,
            None if met => Self::Front,
            _ => Self::Undecided,
        }
    }

    /// The word.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Infeasible => "infeasible",
            Self::Undecided => "undecided",
            Self::Interrupted => "interrupted",
        }
    }
}
