//! Answers of `explore` and the files of its folder.

use schemars::JsonSchema;
use serde::Serialize;

use super::nearest::short;
use super::{
    AssessAnswer, DriveSearchRecord, FreedomRecord, NearestRecord, NoRoundingError, NoRoundingRecord, Number,
    OptimalityWord, OptimizeAnswer, RidingRecord, SolvedRecord, SymmetryRecord,
};
use ask::rounding::{DesignOnHoles, RoundingWay};
use ask::{ExploreVerdict, LengthsOrigin, OptimizeStatus, OwnPoses, SearchWord, Separation};
use machine::manufacture::{NoRounding, RoundedJoint};
use optimize::dimensional::ChosenVariable;
use verify::Verification;

/// The poses of the original, with the lengths they belong to.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FkRunRecord {
    /// Leg lengths, design units.
    pub lengths: [f64; 6],
    /// Where the lengths come from.
    pub lengths_from: LengthsOrigin,
    /// The poses.
    #[serde(flatten)]
    pub solved: SolvedRecord,
}

/// The answer of `explore`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ExploreAnswer {
    /// About an octahedral design.
    Octahedral(Box<ExploreOctahedralAnswer>),
    /// About another design.
    General(Box<ExploreGeneralAnswer>),
}

/// The answer of `explore` about a design that is not octahedral.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ExploreGeneralAnswer {
    /// Of the whole run.
    pub verdict: ExploreVerdict,
    /// One sentence with the numbers that decided.
    pub explanation: String,
    /// The name of the design.
    pub name: String,
    /// The files written.
    pub paths: Vec<String>,
    /// What was done, in order.
    pub stages: Vec<StageRecord>,
    /// The families of replaceable legs.
    pub components: FamiliesFoundRecord,
    /// The search for an equivalent platform without shared joints; null: no leg can be moved.
    pub moves: Option<MovesFoundRecord>,
    /// The nearest octahedral platform; null: none was found.
    pub nearest: Option<NearestErrorRecord>,
    /// Whether the platform equivalent to the nearest octahedral one meets the requirements of the design: true and
    /// false are proved; null: undecided, not looked at, or nothing is required.
    pub nearest_meets_requirements: Option<bool>,
    /// The comparison of the design with the equivalent found, else of the nearest octahedral platform with its
    /// equivalent; null: there is neither.
    pub verify: Option<ComparedRecord>,
    /// The poses of the design.
    pub fk: PoseTotalsRecord,
}

/// What a stage of `explore` did.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct StageRecord {
    /// Which.
    pub stage: StageWord,
    /// What came out, a sentence.
    pub explanation: String,
}

/// The stages of `explore` for a design that is not octahedral.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StageWord {
    /// The families of replaceable legs.
    Components,
    /// The search for equivalent platforms by moves of legs.
    Moves,
    /// The nearest octahedral platform.
    Nearest,
    /// Its equivalent under the requirements of the design.
    Assess,
    /// Two designs compared.
    Verify,
    /// The poses of the design.
    Fk,
}

impl StageWord {
    /// A heading.
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

/// The families of replaceable legs in short.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FamiliesFoundRecord {
    /// How many.
    pub count: usize,
    /// There are no others.
    pub complete: bool,
}

/// A search for equivalent platforms in short.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MovesFoundRecord {
    /// What came out.
    pub outcome: SearchWord,
    /// Legs of the platform written that are not legs of the design, from 1; null: none is written.
    pub moved_legs: Option<Vec<usize>>,
    /// det A of the map to it; null: none is written.
    pub det: Option<Number>,
}

/// The nearest octahedral platform in short.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct NearestErrorRecord {
    /// The largest displacement of a leg end, design units.
    pub largest_displacement: Number,
    /// The same over the size of the design.
    pub relative_displacement: Number,
    /// The largest difference of leg lengths over the poses of the workspace.
    pub largest_length_deviation: Number,
    /// det A of the map from the octahedral platform to the one beside the design.
    pub det: Number,
}

impl From<&NearestRecord> for NearestErrorRecord {
    fn from(n: &NearestRecord) -> Self {
        Self {
            largest_displacement: n.largest_displacement,
            relative_displacement: n.relative_displacement,
            largest_length_deviation: n.largest_length_deviation,
            det: n.det,
        }
    }
}

/// The answer of `explore` about an octahedral design.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ExploreOctahedralAnswer {
    /// Of the whole run.
    pub verdict: ExploreVerdict,
    /// One sentence with the numbers that decided.
    pub explanation: String,
    /// The name of the design.
    pub name: String,
    /// The files written.
    pub paths: Vec<String>,
    /// The equivalence class.
    pub family: FamilySizeRecord,
    /// What `assess` says of the platform found; null: there is none, or the design requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// The platform; null: none was found.
    pub optimize: Option<OptimizedRecord>,
    /// Conic programs that the library clarabel solved in the search for the platform; those with other drives, for
    /// freedoms and for holes are not counted.
    pub conic_programs: u64,
    /// What separate joints cost: figures of the design and of the platform to build; null: there is none.
    pub price: Option<PriceRecord>,
    /// What became of the reserve of 5 % on every limit; null: the design states a reserve.
    pub reserve: Option<DefaultReserveRecord>,
    /// The comparison of the design with the optimised one; null: there is none.
    pub verify: Option<ComparedRecord>,
    /// The platform with its joints on holes; null: the design states no holes, or no platform was found. The
    /// assessment is then that of this platform.
    pub holes: Option<OnHolesRecord>,
    /// What became of the three-fold symmetry of the design; null where it has none, names one, or the search could not
    /// break it or did not look at it.
    pub symmetry: Option<SymmetryRecord>,
    /// The drives of a table, with what the search came to with each; null where no table was given.
    pub drive_search: Option<DriveSearchRecord>,
    /// Where nothing that meets the requirements was found: the freedoms that the design does not have, each with what
    /// came of a search that had it; null where none was looked at.
    pub freedoms: Option<Vec<FreedomRecord>>,
    /// The poses of the design.
    pub fk: PoseTotalsRecord,
}

/// Figures of a design and of the platform with separate joints made from it, in this order.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PriceRecord {
    /// Worst conditioning over the poses of the workspace, both by the characteristic length of the design.
    pub conditioning: [Number; 2],
    /// Least distance of the ends of two legs on the base, design units; 0 where they share a joint.
    pub base_spacing: [Number; 2],
    /// The same on the platform.
    pub platform_spacing: [Number; 2],
    /// Greatest distance of a base joint from the centre of the joints.
    pub base_radius: [Number; 2],
    /// The same of the platform.
    pub platform_radius: [Number; 2],
    /// One sentence.
    pub message: String,
}

impl PriceRecord {
    /// Of figures in a unit of length.
    #[must_use]
    pub fn new(s: &Separation, unit: &str) -> Self {
        let pair = |[a, b]: [f64; 2]| format!("{} -> {}", short(a), short(b));
        let times = |[a, b]: [f64; 2]| short(b / a);
        let [base, platform] = s.radius;
        let message = format!(
            "price of separate joints: worst conditioning {}; joint spacing {} {unit} on the base, {} {unit} on the platform; radius {} {unit} of the base ({} times), {} {unit} of the platform ({} times)",
            pair(s.conditioning),
            pair(s.spacing[0]),
            pair(s.spacing[1]),
            pair(base),
            times(base),
            pair(platform),
            times(platform),
        );
        Self {
            conditioning: s.conditioning.map(Number),
            base_spacing: s.spacing[0].map(Number),
            platform_spacing: s.spacing[1].map(Number),
            base_radius: base.map(Number),
            platform_radius: platform.map(Number),
            message,
        }
    }
}

/// What became of the reserve that a design does not state.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DefaultReserveRecord {
    /// On every limit.
    pub percent: f64,
    /// The platform found keeps it; false: no platform that keeps it was found, and the search went on without.
    pub kept: bool,
    /// One sentence.
    pub message: String,
}

impl DefaultReserveRecord {
    /// Whether it is kept.
    #[must_use]
    pub fn new(percent: f64, kept: bool) -> Self {
        let message = if kept {
            format!(
                "{percent} % of every limit is kept in reserve by default; `reserve` in [limits] sets another share"
            )
        } else {
            format!(
                "no platform was found that keeps {percent} % of every limit in reserve; the search was made without a reserve"
            )
        };
        Self { percent, kept, message }
    }
}

/// A platform with its joints on the holes that its design states, in short.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct OnHolesRecord {
    /// Which rounding was taken; null: there is none.
    pub variant: Option<RoundingWay>,
    /// Turns by 120 degrees take both triangles with their joints to themselves.
    pub three_fold: bool,
    /// The farthest that a joint went to its hole.
    pub largest_displacement: Option<Number>,
    /// Variables that were chosen again after rounding.
    pub refitted: Vec<String>,
    /// How often a platform was sought and rounded.
    pub passes: usize,
    /// Why there is no rounding; null: there is one.
    pub error: Option<NoRoundingError>,
}

impl From<&Result<DesignOnHoles, NoRounding>> for OnHolesRecord {
    fn from(found: &Result<DesignOnHoles, NoRounding>) -> Self {
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
        Self {
            variant: Some(*way),
            three_fold,
            largest_displacement: joints.ok().map(farthest).map(Number),
            refitted: on.refitted.iter().map(|kind| kind.code().to_owned()).collect(),
            passes: on.passes,
            error: None,
        }
    }
}

/// How many platforms are equivalent to an octahedral one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FamilySizeRecord {
    /// Patterns of legs.
    pub patterns: usize,
    /// Ways to share joints.
    pub topologies: usize,
}

/// The platform in short: the fields of the answer of `optimize` that say most.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct OptimizedRecord {
    /// What came of the search.
    pub status: OptimizeStatus,
    /// What is known of better ones; null: nothing.
    pub optimality: Option<OptimalityWord>,
    /// Value of the first objective.
    pub objective: Option<Number>,
    /// What was chosen, axes left out.
    pub variables: Vec<ChosenVariable>,
    /// The numbers `t_i` in cyclic order; null: no offsets were chosen.
    pub offsets: Option<[Number; 6]>,
    /// `t_i d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
    pub shifts: Option<[Number; 6]>,
    /// det A of the leg map; null: the variables do not keep the class of the design.
    pub det: Option<Number>,
    /// What the platform rides on; null: nothing.
    pub riding: Option<RidingRecord>,
}

impl OptimizedRecord {
    /// Of an answer of `optimize`; `None` where it has no platform.
    #[must_use]
    pub fn new(a: &OptimizeAnswer) -> Option<Self> {
        let p = &a.platform;
        Some(Self {
            status: a.status,
            optimality: a.optimality,
            objective: p.objective,
            variables: p.variables.clone()?,
            offsets: p.offsets,
            shifts: p.shifts,
            det: p.det,
            riding: p.riding.clone(),
        })
    }
}

/// A verification in short.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ComparedRecord {
    /// Sets of lengths at which both designs were solved.
    pub sample_count: usize,
    /// The largest distance of matched poses.
    pub worst_distance: Number,
    /// Of the affine map.
    pub residual: Number,
    /// Its determinant.
    pub det: Number,
}

impl From<&Verification> for ComparedRecord {
    fn from(v: &Verification) -> Self {
        Self {
            sample_count: v.samples.len(),
            worst_distance: Number(v.worst_distance()),
            residual: Number(v.map.residual),
            det: Number(v.map.determinant),
        }
    }
}

/// Poses counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct PoseTotalsRecord {
    /// Where the lengths come from.
    pub lengths_from: LengthsOrigin,
    /// Finite poses, real and complex.
    pub finite_count: usize,
    /// Real ones.
    pub real_count: usize,
    /// Poses with a certificate.
    pub certified_count: usize,
    /// False: poses may be missing.
    pub all_paths_accounted: bool,
}

impl PoseTotalsRecord {
    /// Counts of the poses of a design.
    #[must_use]
    pub fn new(poses: &OwnPoses) -> Self {
        let s = &poses.solutions;
        Self {
            lengths_from: poses.origin,
            finite_count: s.roots.len(),
            real_count: s.assembly_modes().count(),
            certified_count: s.roots.iter().filter(|r| r.certified()).count(),
            all_paths_accounted: s.all_accounted(),
        }
    }
}

impl From<&OwnPoses> for FkRunRecord {
    fn from(poses: &OwnPoses) -> Self {
        Self { lengths: poses.lengths.get(), lengths_from: poses.origin, solved: (&poses.solutions).into() }
    }
}
