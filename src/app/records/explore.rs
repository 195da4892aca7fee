//! Answers of `explore` and the files of its folder.

use schemars::JsonSchema;
use serde::Serialize;

use super::nearest::short;
use super::{
    ActiveBoundsRecord, AssessAnswer, NearestErrorRecord, NoRoundingError, NoRoundingRecord, Number,
    OptimalityWord, OptimizeAnswer, SearchesBesideRecord, SolvedRecord,
};
use ask::rounding::{DesignOnHoles, RoundingWay};
use ask::{
    DefaultSafetyMargin, ExploreVerdict, LengthsOrigin, OptimizeStatus, OwnPoses, SearchWord, Separation,
};
use machine::manufacture::{NoRounding, RoundedJoint};
use optimize::dimensional::ChosenVariable;
use verify::Verification;

/// The poses of the original platform, with their leg lengths.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FkRunRecord {
    /// Leg lengths, design units.
    pub lengths: [f64; 6],
    /// The source of the lengths.
    pub lengths_from: LengthsOrigin,
    /// The unit of lengths.
    pub units: String,
    /// The poses.
    #[serde(flatten)]
    pub solved: SolvedRecord,
}

/// The answer of `explore`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ExploreAnswer {
    /// Octahedral design.
    Octahedral(Box<ExploreOctahedralAnswer>),
    /// Other design.
    General(Box<ExploreGeneralAnswer>),
}

/// The answer of `explore` about a design that is not octahedral.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ExploreGeneralAnswer {
    /// Verdict of the run.
    pub verdict: ExploreVerdict,
    /// Verdict in words, with the numbers that decided.
    pub explanation: String,
    /// The name of the design.
    pub name: String,
    /// Files written.
    pub paths: Vec<String>,
    /// Stages, in order.
    pub stages: Vec<StageRecord>,
    /// The families of replaceable legs.
    pub components: FamiliesFoundRecord,
    /// Search for an equivalent without shared joints; null: no leg can be moved.
    pub moves: Option<MovesFoundRecord>,
    /// The nearest octahedral platform; null: none was found.
    pub nearest: Option<NearestErrorRecord>,
    /// Whether the nearest equivalent platform meets the requirements: true and false are proved. Null: undecided, not
    /// assessed, or nothing is required.
    pub nearest_meets_requirements: Option<bool>,
    /// Comparison with the equivalent platform, or of the nearest octahedral platform with its equivalent. Null:
    /// neither exists.
    pub verify: Option<ComparedRecord>,
    /// Poses of the design.
    pub fk: PoseTotalsRecord,
}

/// The result of one stage of `explore`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct StageRecord {
    /// Stage.
    pub stage: StageWord,
    /// Result in words.
    pub explanation: String,
}

/// The stages of `explore` for a design that is not octahedral.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StageWord {
    /// The families of replaceable legs.
    Components,
    /// The search for equivalent platforms by moving legs.
    Moves,
    /// The nearest octahedral platform.
    Nearest,
    /// The assessment of its equivalent against the requirements of the design.
    Assess,
    /// The comparison of two designs.
    Verify,
    /// Poses of the design.
    Fk,
}

impl StageWord {
    /// The heading of the stage.
    #[must_use]
    pub fn heading(self) -> &'static str {
        match self {
            Self::Components => "Replaceable legs",
            Self::Moves => "Equivalent platforms",
            Self::Nearest => "Nearest octahedral platform",
            Self::Assess => "Requirements at its equivalent",
            Self::Verify => "Comparison",
            Self::Fk => "Assembly modes",
        }
    }
}

/// A summary of the families of replaceable legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FamiliesFoundRecord {
    /// Number of families.
    pub count: usize,
    /// Whether the list of families is complete.
    pub complete: bool,
}

/// A summary of a search for equivalent platforms.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MovesFoundRecord {
    /// The outcome of the search.
    pub outcome: SearchWord,
    /// Legs that differ from the design, from 1; null: no platform is written.
    pub moved_legs: Option<Vec<usize>>,
    /// det A to the written platform; null: no platform is written.
    pub det: Option<Number>,
}

/// The answer of `explore` about an octahedral design.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ExploreOctahedralAnswer {
    /// Verdict of the run.
    pub verdict: ExploreVerdict,
    /// Verdict in words, with the numbers that decided.
    pub explanation: String,
    /// Whether the time limit or the caller ended the search, or an assessment before its verdict.
    pub interrupted: bool,
    /// The name of the design.
    pub name: String,
    /// Files written.
    pub paths: Vec<String>,
    /// The equivalence class.
    pub family: FamilySizeRecord,
    /// Result of `assess`; null: there is none, or the design has no requirements.
    pub assessment: Option<AssessAnswer>,
    /// The platform found; null: none.
    pub optimize: Option<OptimizedRecord>,
    /// Number of conic programs solved by clarabel; searches with other drives, for freedoms and for holes are not
    /// counted.
    pub conic_programs: u64,
    /// The cost of separate joints: figures of the design and of the platform to build; null: there is none.
    pub price: Option<PriceRecord>,
    /// Result for the default safety margin of 5 %; null: the design states its own.
    pub safety_margin: Option<DefaultSafetyMarginRecord>,
    /// Comparison with the optimised platform; null: there is none.
    pub verify: Option<ComparedRecord>,
    /// Platform on holes; null: the design states no holes, or no platform was found. The assessment applies to this
    /// platform.
    pub holes: Option<OnHolesRecord>,
    /// The searches with other freedoms, symmetry and drives.
    #[serde(flatten)]
    pub beside: SearchesBesideRecord,
    /// Poses of the design.
    pub fk: PoseTotalsRecord,
}

view! {
    /// Figures of a design and of the platform with separate joints made from it, in this order.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct PriceRecord {
        /// Worst conditioning over the workspace; both use the characteristic length of the design.
        pub conditioning: [Number; 2] = s.conditioning.map(Number),
        /// Least distance of base ends, design units; 0 for a shared joint.
        pub base_spacing: [Number; 2] = s.spacing[0].map(Number),
        /// Least distance of platform ends, design units; 0 for a shared joint.
        pub platform_spacing: [Number; 2] = s.spacing[1].map(Number),
        /// Greatest distance of base joints from their centre, design units.
        pub base_radius: [Number; 2] = base.map(Number),
        /// Greatest distance of platform joints from their centre, design units.
        pub platform_radius: [Number; 2] = platform.map(Number),
        /// Comparison in words.
        pub message: String = message,
    }
    /// The record of figures in this unit of length.
    pub fn new(s: &Separation, unit: &str) {
        let pair = |[a, b]: [f64; 2]| format!("{} -> {}", short(a), short(b));
        let times = |[a, b]: [f64; 2]| short(b / a);
        let [base, platform] = s.radius;
        let message = format!(
            "price of separate joints: worst conditioning {}; joint distance {} {unit} on the base, {} {unit} on the platform; radius {} {unit} of the base ({} times), {} {unit} of the platform ({} times)",
            pair(s.conditioning),
            pair(s.spacing[0]),
            pair(s.spacing[1]),
            pair(base),
            times(base),
            pair(platform),
            times(platform),
        );
    }
}

/// The result for a default safety margin that the design does not state itself.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DefaultSafetyMarginRecord {
    /// Safety margin of every limit, percent.
    pub percent: f64,
    /// Whether the platform found keeps it. False: no platform with it was found, and the search continued without it.
    /// Null: the search with it was interrupted.
    pub kept: Option<bool>,
    /// Result in words.
    pub message: String,
}

impl DefaultSafetyMarginRecord {
    /// The record of the result for this safety margin.
    #[must_use]
    pub fn new(percent: f64, result: DefaultSafetyMargin) -> Self {
        let (kept, message) = match result {
            DefaultSafetyMargin::Kept => (
                Some(true),
                format!(
                    "by default every limit keeps a safety margin of {percent} %; `safety_margin` in [limits] sets another value"
                ),
            ),
            DefaultSafetyMargin::GivenUp => (
                Some(false),
                format!(
                    "no platform was found that keeps a safety margin of {percent} % on every limit; the search was repeated without it"
                ),
            ),
            DefaultSafetyMargin::Undecided => (
                None,
                format!(
                    "by default every limit requires a safety margin of {percent} %; the search was interrupted before a platform was proved to keep it"
                ),
            ),
        };
        Self { percent, kept, message }
    }
}

view! {
    /// A summary of a platform with its joints on the holes that its design states.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct OnHolesRecord {
        /// The rounding chosen; null: there is none.
        pub variant: Option<RoundingWay> = Some(*way),
        /// Whether rotations by 120 degrees keep both bodies.
        pub three_fold: bool = three_fold,
        /// Largest displacement to a hole, design units.
        pub largest_displacement: Option<Number> = joints.ok().map(farthest).map(Number),
        /// Variables optimised again.
        pub refitted: Vec<String> = on.refitted.iter().map(|kind| kind.code().to_owned()).collect(),
        /// Number of passes of search and rounding.
        pub passes: usize = on.passes,
        /// Reason for no rounding; null: there is one.
        pub error: Option<NoRoundingError> = None,
    }
    impl From(found: &Result<DesignOnHoles, NoRounding>) {
        let none = Self {
            variant: None,
            three_fold: false,
            largest_displacement: None,
            refitted: Vec::new(),
            passes: 1,
            error: None,
        };
        let error = |why: NoRounding| Some(NoRoundingRecord::from(why).error);
        let on = match found {
            Ok(on) => on,
            Err(why) => return Self { error: error(*why), ..none },
        };
        let (exact, nearest) = (on.rounding.exact.as_ref(), on.rounding.nearest.as_ref());
        let Some((way, _)) = &on.found else {
            return Self { error: exact.err().copied().and_then(error), passes: on.passes, ..none };
        };
        let (joints, three_fold) = match way {
            RoundingWay::Exact => (exact.map(|e| &e.joints), exact.is_ok_and(|e| e.three_fold)),
            RoundingWay::Nearest => (nearest.map(|n| &n.joints), nearest.is_ok_and(|n| n.three_fold)),
        };
        let farthest = |list: &Vec<RoundedJoint>| list.iter().map(|j| j.moved.norm()).fold(0.0, f64::max);
    }
}

/// The number of platforms equivalent to an octahedral one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FamilySizeRecord {
    /// Number of patterns of legs.
    pub patterns: usize,
    /// Number of topologies: ways to share joints.
    pub topologies: usize,
}

view! {
    /// A summary of the platform: the main fields of the answer of `optimize`.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct OptimizedRecord {
        /// The status of the search.
        pub status: OptimizeStatus = a.status,
        /// The evidence of optimality; null: none.
        pub optimality: Option<OptimalityWord> = a.optimality,
        /// First objective.
        pub objective: Option<Number> = p.objective,
        /// The chosen variables, without axes.
        pub variables: Vec<ChosenVariable> = p.variables.clone()?,
        /// The offsets `t_i` in cyclic order; null: no offsets were chosen.
        pub offsets: Option<[Number; 6]> = p.offsets,
        /// The displacements `t_i d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
        pub shifts: Option<[Number; 6]> = p.shifts,
        /// det A of the leg map; null: the variables leave the equivalence class of the design.
        pub det: Option<Number> = p.det,
        /// Active bounds; null: none.
        pub active_bounds: Option<ActiveBoundsRecord> = p.active_bounds.clone(),
    }
    /// A summary of an answer of `optimize`; `None` if it has no platform.
    pub fn new(a: &OptimizeAnswer) -> Option<Self> {
        let p = &a.platform;
    }
}

view! {
    /// A summary of a verification.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
    pub struct ComparedRecord {
        /// Number of length sets; both designs were solved at each.
        pub sample_count: usize = v.samples.len(),
        /// The largest distance of matched poses.
        pub worst_distance: Number = Number(v.worst_distance()),
        /// The residual of the affine map.
        pub residual: Number = Number(v.map.residual),
        /// The determinant of the affine map.
        pub det: Number = Number(v.map.determinant),
    }
    impl From(v: &Verification) {}
}

view! {
    /// Numbers of poses.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
    pub struct PoseTotalsRecord {
        /// The source of the lengths.
        pub lengths_from: LengthsOrigin = poses.origin,
        /// Number of finite poses, real and complex.
        pub finite_count: usize = s.roots.len(),
        /// Number of real poses.
        pub real_count: usize = s.assembly_modes().count(),
        /// Number of poses with a certificate.
        pub certified_count: usize = s.roots.iter().filter(|r| r.certified()).count(),
        /// Whether every path is accounted for; false: poses may be missing.
        pub all_paths_accounted: bool = s.all_accounted(),
    }
    /// Counts of the poses of a design.
    pub fn new(poses: &OwnPoses) {
        let s = &poses.solutions;
    }
}

impl FkRunRecord {
    /// The poses of a design in these units.
    #[must_use]
    pub fn new(poses: &OwnPoses, units: &str) -> Self {
        let (lengths, solved) = (poses.lengths.get(), (&poses.solutions).into());
        Self { lengths, lengths_from: poses.origin, units: units.to_owned(), solved }
    }
}
