//! The answer of `optimize`: the same record for every search.
//!
//! Every field is present; null means that it does not apply or that nothing is known.

mod active_bounds;
mod branches;
mod conflict;
mod drive;
mod freedom;
mod platform;
mod symmetry;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::active_bounds::{ActiveBoundRecord, ActiveBoundWord, ActiveBoundsRecord};
pub use self::branches::{BranchConflictRecord, BranchRecord};
pub use self::conflict::{ConflictReasonRecord, ConflictRecord, DemandWord, GiveRecord, SpecialDemand};
pub use self::drive::{DriveSearchRecord, DriveSearchWord, SearchedDriveRecord};
pub use self::freedom::FreedomRecord;
pub use self::platform::{
    FoundPlatformRecord, FrontMemberRecord, HeldPosesRecord, JointAxesRecord, LocalOptimalityRecord,
    NearestPlatformRecord, ObjectiveRecord, OptimumRecord, SearchMarginsRecord, VerifiedRecord,
    WorstPoseRecord,
};
pub use self::symmetry::SymmetryRecord;
use crate::{DesignRecord, Number, SourceWord};
use ask::Design;
use ask::{
    Checked, ConflictFreedom, FoundFront, FoundOffsets, FoundPlatform, OpenedFreedom, OptimizeEvidence,
    OptimizeReport, OptimizeStatus,
};
use optimize::dimensional::{DimensionalOutcome, DimensionalProblem, DimensionalSolution, ParetoPoint};
use optimize::offsets::{BranchCounts, GlobalBound, OffsetOutcome, OffsetProblem};

/// The reason why the sizes and the height are chosen.
const SIZES: &str = "no leg of the design can be replaced without another kinematics: the sizes of base and platform and the height of home are chosen";
/// Number of runners-up listed.
const RUNNERS_UP: usize = 5;

view! {
    /// The answer of `optimize`. Every field is present for every search; null: it does not apply, or nothing is known.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct OptimizeAnswer {
        /// The status of the search.
        pub status: OptimizeStatus = status,
        /// The evidence of optimality; null: none, or there is no platform.
        pub optimality: Option<OptimalityWord> = None,
        /// The best platform found; all its fields are null if there is none, or if the answer is a Pareto front.
        #[serde(flatten)]
        pub platform: FoundPlatformRecord = FoundPlatformRecord::default(),
        /// The platform as a design; null: there is none.
        pub design: Option<DesignRecord> = None,
        /// The file written, with the best platform or the one with the least violation.
        pub output: Option<String> = None,
        /// Platform with the least violation; null: a platform meets the requirements.
        pub nearest: Option<Box<NearestPlatformRecord>> = None,
        /// The requirements in conflict; null: no conflict is known.
        pub conflict: Option<ConflictRecord> = None,
        /// Reason for no decision, one sentence; null: it decided, or nothing failed.
        pub failure: Option<String> = None,
        /// The searches with other freedoms, symmetry and drives.
        #[serde(flatten)]
        pub beside: SearchesBesideRecord = SearchesBesideRecord::default(),
        /// Other local optima that meet the requirements, best first; null: not requested.
        pub candidates: Option<Vec<OptimumRecord>> = None,
        /// Pareto front with mode = "pareto": no platform is better than another in every objective. Sorted by falling
        /// gain of the first objective; null in other modes.
        pub front: Option<Vec<FrontMemberRecord>> = None,
        /// Reason for choosing sizes and home height, one sentence. Null: the variables come from the design or are the
        /// usual ones.
        pub choice: Option<String> = None,
        /// Limits of the search.
        pub limits: SearchLimitsRecord = limits,
        /// The poses required.
        pub region: PoseRegionRecord = design.into(),
        /// Search statistics.
        pub search: SearchRecord = search,
        /// Upper bound on the objective at the poses held; null: not proved, or there is no solution.
        pub global_bound: Option<GlobalBound> = None,
        /// Greatest gap that counts as optimal; null: the search proves no bound.
        pub tolerance: Option<f64> = None,
        /// Branches by outcome; null: the search has none.
        pub branch_counts: Option<BranchCounts> = None,
        /// The best other branches.
        pub runners_up: Option<Vec<BranchRecord>> = None,
        /// All branches.
        pub branches: Option<Vec<BranchRecord>> = None,
    }
    /// An answer without a platform, with the fields that every search fills.
    fn none(design: &Design, status: OptimizeStatus, limits: SearchLimitsRecord, search: SearchRecord) {}
}

/// The results of the searches beside the one for the platform.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SearchesBesideRecord {
    /// Searches with one more freedom, each with its search result. Null: a platform meets the requirements, or no
    /// freedom was tried.
    pub freedoms: Option<Vec<FreedomRecord>>,
    /// Result for the three-fold symmetry. Null: the design has none or names one, or the search could not break it or
    /// did not check it.
    pub symmetry: Option<SymmetryRecord>,
    /// Drives of the table with their results; null: no table was given. The rest of the answer is about the chosen
    /// drive, or else about the drive with the best result.
    pub drive_search: Option<DriveSearchRecord>,
}

/// The evidence about platforms better than the one found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OptimalityWord {
    /// Proved by branch and bound: no platform exceeds it by more than the tolerance.
    ProvedWithinGap,
    /// A local optimum, the best of all starts; a better one is possible.
    BestOfStarts,
}

/// The search that found the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SearchMethodWord {
    /// The search for offsets alone, with a bound over all offsets.
    Offsets,
    /// The search under requirements.
    Dimensional,
}

view! {
    /// Statistics of a search.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SearchRecord {
        /// The search method.
        pub method: SearchMethodWord = method,
        /// Number of starts; null: the search begins in the branches.
        pub starts: Option<usize> = None,
        /// Number of starts with a feasible result.
        pub feasible: Option<usize> = None,
        /// Gains of polished runs; null in the list: not feasible.
        pub polished: Option<Vec<Option<Number>>> = None,
        /// Number of runs on a Pareto front dominated by others; null: no front.
        pub dominated: Option<usize> = None,
        /// Number of bounds of a Pareto front that no run met; null: no front.
        pub unmet: Option<usize> = None,
        /// Number of conic programs solved by clarabel; searches with other drives and for freedoms are not counted.
        pub conic_programs: u64 = conic_programs,
    }
    fn of(method: SearchMethodWord, conic_programs: u64) {}
}

view! {
    /// Limits of a search beside the requirements of the design.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SearchLimitsRecord {
        /// Least distance of joint centres of a body, design units; null: none.
        pub min_joint_distance: Option<f64> = p.requirements.min_joint_distance,
        /// Least |det A| of equivalent platforms.
        pub min_abs_det: f64 = p.min_abs_det,
        /// The characteristic length, by which moments in the Jacobian are divided, design units.
        pub characteristic_length: f64 = p.characteristic_length,
        /// Unit of lengths.
        pub units: String = design.units.clone(),
    }
    /// The limits of a search under requirements.
    pub fn new(design: &Design, p: &DimensionalProblem) {}
}

impl SearchLimitsRecord {
    fn of_offsets(design: &Design, p: &OffsetProblem) -> Self {
        Self {
            min_joint_distance: Some(p.min_joint_distance),
            min_abs_det: p.min_abs_det,
            characteristic_length: p.characteristic_length,
            units: design.units.clone(),
        }
    }
}

view! {
    /// The poses that a design requires.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PoseRegionRecord {
        /// The source of home.
        pub home: SourceWord = SourceWord::given(design.home.is_some()),
        /// Home position of the starting design, base frame, design units.
        pub home_position: [Number; 3] = <[f64; 3]>::from(design.home_or_default().position).map(Number),
        /// Source of the workspace.
        pub workspace: SourceWord = SourceWord::given(!design.workspace.is_empty()),
    }
    impl From(design: &Design) {}
}

/// Files in which platforms of an answer were written.
#[derive(Debug, Clone, Default)]
pub struct OptimizeFiles {
    /// The file of the best platform, or of the platform with the least violation.
    pub platform: Option<String>,
    /// The files of the candidates, in order.
    pub candidates: Vec<String>,
    /// The files of the platforms found with further freedoms.
    pub freedoms: Vec<(ConflictFreedom, String)>,
    /// The files of the members of the front, in order.
    pub front: Vec<String>,
}

impl OptimizeAnswer {
    /// The answer of a search, with the files written.
    #[must_use]
    pub fn new(r: &OptimizeReport, written: &OptimizeFiles) -> Self {
        let design = &r.asked;
        let found = match &r.evidence {
            OptimizeEvidence::Offsets(found) => Self::of_offsets(design, r.status, found),
            OptimizeEvidence::Dimensions(found) => Self::of_platform(design, r.status, found),
            OptimizeEvidence::Front(found) => Self::of_front(design, r.status, found, &written.front),
        };
        let opened = |f: &OpenedFreedom| {
            let path = written.freedoms.iter().find(|(freedom, _)| *freedom == f.freedom);
            FreedomRecord::new(design, f, path.map(|(_, path)| path.as_str()))
        };
        Self {
            output: written.platform.clone(),
            beside: SearchesBesideRecord {
                freedoms: r.freedoms.as_ref().map(|list| list.iter().map(opened).collect()),
                symmetry: r.symmetry().map(SymmetryRecord::from),
                drive_search: r.drives.as_ref().map(DriveSearchRecord::new),
            },
            candidates: r.candidates.as_ref().map(|list| candidates(r, list, &written.candidates)),
            choice: r.chooses_sizes.then(|| SIZES.to_owned()),
            ..found
        }
    }

    fn of_offsets(design: &Design, status: OptimizeStatus, f: &FoundOffsets) -> Self {
        let (p, r) = (&f.problem, &f.report);
        let found = r.solution().zip(f.checked.as_ref());
        let optimality = match (&r.outcome, status) {
            (OffsetOutcome::Optimal(_), OptimizeStatus::Optimal) => Some(OptimalityWord::ProvedWithinGap),
            (OffsetOutcome::LocalOptimum(_), OptimizeStatus::Feasible) => Some(OptimalityWord::BestOfStarts),
            _ => None,
        };
        let branches: Vec<BranchRecord> = r.branches.iter().map(BranchRecord::from).collect();
        let limits = SearchLimitsRecord::of_offsets(design, p);
        let search = SearchRecord::of(SearchMethodWord::Offsets, r.conic_programs);
        let is_empty = matches!(r.outcome, OffsetOutcome::Infeasible);
        Self {
            optimality,
            platform: found.map_or_else(FoundPlatformRecord::default, |(s, c)| {
                FoundPlatformRecord::of_offsets(design, p, s, c)
            }),
            design: found.map(|(_, c)| (&c.design).into()),
            conflict: is_empty.then(|| ConflictRecord::of_branches(&branches)),
            global_bound: r.bound,
            tolerance: Some(r.tolerance),
            branch_counts: Some(r.counts()),
            runners_up: Some(
                r.runners_up.iter().take(RUNNERS_UP).map(|k| (&r.branches[*k]).into()).collect(),
            ),
            branches: Some(branches),
            ..Self::none(design, status, limits, search)
        }
    }

    fn of_platform(design: &Design, status: OptimizeStatus, f: &FoundPlatform) -> Self {
        let (p, report) = (&f.problem, &f.report);
        let solution = report.solution().zip(f.checked.as_ref());
        let nearest = report.nearest.as_deref().zip(f.nearest.as_ref()).filter(|_| solution.is_none());
        let search = SearchRecord {
            starts: Some(report.starts),
            feasible: Some(report.feasible),
            polished: Some(report.polished.iter().map(|g| g.map(Number)).collect()),
            ..SearchRecord::of(SearchMethodWord::Dimensional, report.conic_programs)
        };
        Self {
            optimality: (status == OptimizeStatus::BestFound).then_some(OptimalityWord::BestOfStarts),
            platform: solution.map_or_else(FoundPlatformRecord::default, |(s, c)| {
                FoundPlatformRecord::new(design, p.min_abs_det, s, c)
            }),
            design: solution.map(|(_, c)| (&c.design).into()),
            nearest: nearest.map(|(s, c)| Box::new(NearestPlatformRecord::new(s, c))),
            conflict: conflict_of(design, Some(&report.outcome)),
            failure: failure_of(&report.outcome),
            ..Self::none(design, status, SearchLimitsRecord::new(design, p), search)
        }
    }

    fn of_front(design: &Design, status: OptimizeStatus, f: &FoundFront, written: &[String]) -> Self {
        let (p, report) = (&f.problem, &f.report);
        let member = |(k, (point, c)): (usize, (&ParetoPoint, &Checked))| FrontMemberRecord {
            platform: FoundPlatformRecord {
                history: None,
                ..FoundPlatformRecord::new(design, p.min_abs_det, &point.solution, c)
            },
            design: (&c.design).into(),
            output: written.get(k).cloned(),
            non_dominated_at: point.dense.iter().copied().map(Number).collect(),
        };
        let search = SearchRecord {
            dominated: Some(report.dominated),
            unmet: Some(report.unmet),
            ..SearchRecord::of(SearchMethodWord::Dimensional, report.conic_programs)
        };
        let outcome = report.failure.as_deref().map(|r| &r.outcome);
        Self {
            front: Some(report.front.iter().zip(&f.members).enumerate().map(member).collect()),
            conflict: conflict_of(design, outcome),
            failure: outcome.and_then(failure_of),
            ..Self::none(design, status, SearchLimitsRecord::new(design, p), search)
        }
    }
}

/// Other local optima, with their files.
fn candidates(r: &OptimizeReport, list: &[Checked], written: &[String]) -> Vec<OptimumRecord> {
    let OptimizeEvidence::Dimensions(found) = &r.evidence else { return Vec::new() };
    let of = |(k, (s, c)): (usize, (&DimensionalSolution, &Checked))| {
        OptimumRecord::new(&r.asked, s, c, written.get(k).map(String::as_str))
    };
    found.report.others.iter().zip(list).enumerate().map(of).collect()
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
