//! The answer of `optimize`: one record, whichever search found it.
//!
//! A field that does not apply, or of which nothing is known, is null; none is ever absent.

mod branches;
mod conflict;
mod drive;
mod freedom;
mod platform;
mod riding;
mod symmetry;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::branches::{
    BranchConflictRecord, BranchCountsRecord, BranchRecord, BranchWord, GlobalBoundRecord,
};
pub use self::conflict::{ConflictReasonRecord, ConflictRecord, DemandWord, GiveRecord, SpecialDemand};
pub use self::drive::{DriveSearchRecord, DriveSearchWord, SearchedDriveRecord};
pub use self::freedom::{FreedomRecord, FreedomWord};
pub use self::platform::{
    FoundPlatformRecord, FrontMemberRecord, HeldPosesRecord, JointAxesRecord, LocalOptimalityRecord,
    NearestPlatformRecord, ObjectiveRecord, OptimumRecord, SearchMarginsRecord, SearchStepRecord,
    VariableRecord, VerifiedRecord, WorstPoseRecord,
};
pub use self::riding::{RiddenBoundRecord, RiddenWord, RidingRecord};
pub use self::symmetry::{SymmetryRecord, SymmetryWord};
use crate::app::Design;
use crate::app::entrance::OptimizeStatus;
use crate::app::entrance::optimizing::{Checked, dimensional_status, offset_status};
use crate::app::records::{DesignRecord, Number, SourceWord};
use optimize::dimensional::{
    DimensionalOutcome, DimensionalProblem, DimensionalReport, ParetoPoint, ParetoReport,
};
use optimize::offsets::{OffsetOutcome, OffsetProblem, OffsetReport};

/// Runners-up that are listed.
const RUNNERS_UP: usize = 5;

/// The answer of `optimize`. Every field is there whichever search found it; null: it does not apply, or nothing is known of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OptimizeAnswer {
    /// What came of the search.
    pub status: OptimizeWord,
    /// What is known of better ones; null: nothing, or there is no platform.
    pub optimality: Option<OptimalityWord>,
    /// The best platform found; all its fields are null where there is none, or where the answer is a front.
    #[serde(flatten)]
    pub platform: FoundPlatformRecord,
    /// The platform as a design; null: there is none.
    pub design: Option<DesignRecord>,
    /// The file written, with the platform or the one that comes nearest.
    pub output: Option<String>,
    /// Where none that meets the requirements was found: the one with the least violation, which misses some of them.
    pub nearest: Option<Box<NearestPlatformRecord>>,
    /// What cannot be met together, where that is why there is no platform.
    pub conflict: Option<ConflictRecord>,
    /// Why the search failed to decide, a sentence; null: it decided, or nothing failed.
    pub failure: Option<String>,
    /// Where nothing that meets the requirements was found: the freedoms that the design does not have, each with what came of a search that had it; null where none was looked at.
    pub freedoms: Option<Vec<FreedomRecord>>,
    /// What became of the three-fold symmetry of the design; null where it has none, names one, or the search could not break it or did not look at it.
    pub symmetry: Option<SymmetryRecord>,
    /// The drives of a table, with what the search came to with each; null where no table was given. The rest of the answer is about the drive chosen; where none is, about that with which most was reached.
    pub drive_search: Option<DriveSearchRecord>,
    /// Other local optima that meet the requirements at the poses that were held, best first; null where they were not asked for.
    pub candidates: Option<Vec<OptimumRecord>>,
    /// With mode = "pareto": platforms of which none is better in every objective, by falling gain of the first objective; else null.
    pub front: Option<Vec<FrontMemberRecord>>,
    /// Why the sizes of the bodies and the height of home are chosen, a sentence; null: the variables are those of the design, or the usual ones.
    pub choice: Option<String>,
    /// What the search itself was held to.
    pub limits: SearchLimitsRecord,
    /// The poses that were asked for.
    pub region: PoseRegionRecord,
    /// How the search went.
    pub search: SearchRecord,
    /// What no platform that could be chosen can exceed at the poses held; null: not proved, or there is no solution.
    pub global_bound: Option<GlobalBoundRecord>,
    /// Greatest gap to that bound at which the answer counts as optimal; null: the search proves no bound.
    pub tolerance: Option<f64>,
    /// What became of the branches; null: the search has none.
    pub branch_counts: Option<BranchCountsRecord>,
    /// The best other branches.
    pub runners_up: Option<Vec<BranchRecord>>,
    /// All branches: a zone for each offset.
    pub branches: Option<Vec<BranchRecord>>,
}

/// What came of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OptimizeWord {
    /// The requirements are met, and no offsets are better by more than `tolerance`: proved.
    Optimal,
    /// The requirements are met, and the platform is a local optimum, the best of all starts; that none is better is not proved.
    BestFound,
    /// The requirements are met; better platforms may be near, or a bound on all others was asked for and is not proved to within `tolerance`.
    Feasible,
    /// There is no platform: proved where `conflict` says so, else no start met the requirements.
    Infeasible,
    /// Nothing that meets the requirements was found, or what was found is not proved to meet them.
    Undecided,
    /// The platform found misses requirements; the assessment names them.
    Violated,
    /// The search was told to end; the answer is the best until then.
    Interrupted,
    /// With mode = "pareto": a front whose members are proved to meet their requirements.
    Front,
}

impl From<OptimizeStatus> for OptimizeWord {
    fn from(status: OptimizeStatus) -> Self {
        match status {
            OptimizeStatus::Optimal => Self::Optimal,
            OptimizeStatus::BestFound => Self::BestFound,
            OptimizeStatus::Feasible => Self::Feasible,
            OptimizeStatus::Infeasible => Self::Infeasible,
            OptimizeStatus::Undecided => Self::Undecided,
            OptimizeStatus::Violated => Self::Violated,
            OptimizeStatus::Interrupted => Self::Interrupted,
        }
    }
}

impl OptimizeWord {
    /// The word.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::BestFound => "best_found",
            Self::Feasible => "feasible",
            Self::Infeasible => "infeasible",
            Self::Undecided => "undecided",
            Self::Violated => "violated",
            Self::Interrupted => "interrupted",
            Self::Front => "front",
        }
    }

    /// The status of a search for a front; `met`: all members meet their requirements.
    #[must_use]
    pub fn of_front(report: &ParetoReport, met: bool) -> Self {
        match report.failure.as_deref().map(|r| &r.outcome) {
            _ if report.interrupted => Self::Interrupted,
            Some(DimensionalOutcome::Infeasible(_)) => Self::Infeasible,
            None if met => Self::Front,
            _ => Self::Undecided,
        }
    }
}

/// What is known of platforms better than the one found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OptimalityWord {
    /// No platform that could be chosen exceeds it by more than the tolerance: proved by branch and bound.
    ProvedWithinGap,
    /// It is a local optimum, the best of all starts; that there is none better is not proved.
    BestOfStarts,
}

/// Which search found the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SearchMethodWord {
    /// The search for offsets alone, with a bound over all offsets.
    Offsets,
    /// The search under requirements.
    Dimensional,
}

/// How a search went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SearchRecord {
    /// Which search it was.
    pub method: SearchMethodWord,
    /// Starts that were climbed from; null: it begins in the branches.
    pub starts: Option<usize>,
    /// Starts that led to a feasible point.
    pub feasible: Option<usize>,
    /// Gains of the polished runs; null in the list: not feasible.
    pub polished: Option<Vec<Option<Number>>>,
    /// Of a front: runs that met their bounds, and were dominated by others or equal to one.
    pub dominated: Option<usize>,
    /// Of a front: bounds that no run met.
    pub unmet: Option<usize>,
}

impl SearchRecord {
    fn of(method: SearchMethodWord) -> Self {
        Self { method, starts: None, feasible: None, polished: None, dominated: None, unmet: None }
    }
}

/// What a search is held to besides the requirements of the design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SearchLimitsRecord {
    /// Of joint centres of a body, design units; null: none.
    pub min_joint_distance: Option<f64>,
    /// The least |det A| of platforms equivalent to the design.
    pub min_abs_det: f64,
    /// By which the lengths in the Jacobian are divided.
    pub characteristic_length: f64,
    /// Label of the length unit.
    pub units: String,
}

impl SearchLimitsRecord {
    /// Of a search under requirements.
    #[must_use]
    pub fn new(design: &Design, p: &DimensionalProblem) -> Self {
        Self {
            min_joint_distance: p.requirements.min_joint_distance,
            min_abs_det: p.min_abs_det,
            characteristic_length: p.characteristic_length,
            units: design.units.clone(),
        }
    }

    fn of_offsets(design: &Design, p: &OffsetProblem) -> Self {
        Self {
            min_joint_distance: Some(p.min_joint_distance),
            min_abs_det: p.min_abs_det,
            characteristic_length: p.characteristic_length,
            units: design.units.clone(),
        }
    }
}

/// The poses that a design asks for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseRegionRecord {
    /// Where home comes from.
    pub home: SourceWord,
    /// Its position in the design that the search began with.
    pub home_position: [Number; 3],
    /// Where the workspace comes from.
    pub workspace: SourceWord,
}

impl From<&Design> for PoseRegionRecord {
    fn from(design: &Design) -> Self {
        Self {
            home: SourceWord::given(design.home.is_some()),
            home_position: <[f64; 3]>::from(design.home_or_default().position).map(Number),
            workspace: SourceWord::given(!design.workspace.is_empty()),
        }
    }
}

impl OptimizeAnswer {
    /// An answer without a platform: what every search fills.
    fn none(design: &Design, status: OptimizeWord, limits: SearchLimitsRecord, search: SearchRecord) -> Self {
        Self {
            status,
            optimality: None,
            platform: FoundPlatformRecord::default(),
            design: None,
            output: None,
            nearest: None,
            conflict: None,
            failure: None,
            freedoms: None,
            symmetry: None,
            drive_search: None,
            candidates: None,
            front: None,
            choice: None,
            limits,
            region: design.into(),
            search,
            global_bound: None,
            tolerance: None,
            branch_counts: None,
            runners_up: None,
            branches: None,
        }
    }

    /// The answer of a search for offsets, with its platform checked and the file written.
    #[must_use]
    pub fn of_offsets(
        design: &Design,
        p: &OffsetProblem,
        r: &OffsetReport,
        checked: Option<&Checked>,
        output: Option<&str>,
    ) -> Self {
        let found = r.solution().zip(checked);
        let status = offset_status(r, checked);
        let optimality = match (&r.outcome, status) {
            (OffsetOutcome::Optimal(_), OptimizeStatus::Optimal) => Some(OptimalityWord::ProvedWithinGap),
            (OffsetOutcome::LocalOptimum(_), OptimizeStatus::Feasible) => Some(OptimalityWord::BestOfStarts),
            _ => None,
        };
        let branches: Vec<BranchRecord> = r.branches.iter().map(BranchRecord::from).collect();
        let limits = SearchLimitsRecord::of_offsets(design, p);
        let search = SearchRecord::of(SearchMethodWord::Offsets);
        let is_empty = matches!(r.outcome, OffsetOutcome::Infeasible);
        Self {
            optimality,
            platform: found.map_or_else(FoundPlatformRecord::default, |(s, c)| {
                FoundPlatformRecord::of_offsets(design, p, s, c)
            }),
            design: found.map(|(_, c)| (&c.design).into()),
            output: output.map(str::to_owned),
            conflict: is_empty.then(|| ConflictRecord::of_branches(&branches)),
            global_bound: r.bound.as_ref().map(GlobalBoundRecord::from),
            tolerance: Some(r.tolerance),
            branch_counts: Some(r.into()),
            runners_up: Some(
                r.runners_up.iter().take(RUNNERS_UP).map(|k| (&r.branches[*k]).into()).collect(),
            ),
            branches: Some(branches),
            ..Self::none(design, status.into(), limits, search)
        }
    }

    /// The answer of a search under requirements; `checked` is its solution or its nearest platform, if there is one.
    #[must_use]
    pub fn of_platform(
        design: &Design,
        p: &DimensionalProblem,
        report: &DimensionalReport,
        checked: Option<&Checked>,
        output: Option<&str>,
    ) -> Self {
        let solution = report.solution().zip(checked);
        let nearest = report.nearest.as_deref().zip(checked);
        let checked = solution.map(|(_, c)| c);
        let status = OptimizeWord::from(dimensional_status(report, checked));
        let search = SearchRecord {
            starts: Some(report.starts),
            feasible: Some(report.feasible),
            polished: Some(report.polished.iter().map(|g| g.map(Number)).collect()),
            ..SearchRecord::of(SearchMethodWord::Dimensional)
        };
        Self {
            optimality: (status == OptimizeWord::BestFound).then_some(OptimalityWord::BestOfStarts),
            platform: solution.map_or_else(FoundPlatformRecord::default, |(s, c)| {
                FoundPlatformRecord::new(design, p.min_abs_det, s, c)
            }),
            design: checked.map(|c| (&c.design).into()),
            output: output.map(str::to_owned),
            nearest: nearest.map(|(s, c)| Box::new(NearestPlatformRecord::new(s, c))),
            conflict: conflict_of(design, Some(&report.outcome)),
            failure: failure_of(&report.outcome),
            ..Self::none(design, status, SearchLimitsRecord::new(design, p), search)
        }
    }

    /// The answer of a search for a front from a design, its members checked, with the files written.
    #[must_use]
    pub fn of_front(
        design: &Design,
        p: &DimensionalProblem,
        report: &ParetoReport,
        members: &[Checked],
        written: &[Option<String>],
    ) -> Self {
        let member = |((point, c), output): ((&ParetoPoint, &Checked), &Option<String>)| FrontMemberRecord {
            platform: FoundPlatformRecord {
                history: None,
                ..FoundPlatformRecord::new(design, p.min_abs_det, &point.solution, c)
            },
            design: (&c.design).into(),
            output: output.clone(),
            non_dominated_at: point.dense.iter().copied().map(Number).collect(),
        };
        let status = OptimizeWord::of_front(report, members.iter().all(|c| c.met() == Some(true)));
        let search = SearchRecord {
            dominated: Some(report.dominated),
            unmet: Some(report.unmet),
            ..SearchRecord::of(SearchMethodWord::Dimensional)
        };
        let outcome = report.failure.as_deref().map(|r| &r.outcome);
        Self {
            front: Some(report.front.iter().zip(members).zip(written).map(member).collect()),
            conflict: conflict_of(design, outcome),
            failure: outcome.and_then(failure_of),
            ..Self::none(design, status, SearchLimitsRecord::new(design, p), search)
        }
    }
}

fn conflict_of(design: &Design, outcome: Option<&DimensionalOutcome>) -> Option<ConflictRecord> {
    match outcome {
        Some(DimensionalOutcome::Infeasible(c)) => Some(ConflictRecord::new(design, c)),
        _ => None,
    }
}

fn failure_of(outcome: &DimensionalOutcome) -> Option<String> {
    match outcome {
        DimensionalOutcome::Undecided(Some(why)) => Some(why.to_string()),
        _ => None,
    }
}
