//! Margins of requirements.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LightestDriveRecord, Number, PoseQuaternionRecord, RangeRecord};
use ask::Design;
use ask::{AssessReport, AssessedPoses};
use files::design::AssessedForces;
use machine::requirements::{Assessment, Margin, MarginBound, MarginVerdict, Standing, TermKind};
use synthesis::singularity::{Regularity, RegularityWord};

view! {
    /// The least margin of a kind of requirement.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MarginRecord {
        /// The kind of requirement.
        pub name: TermKind = m.term.kind,
        /// Least margin over sampled poses, negative for a violation.
        pub margin: Number = Number(m.value),
        /// Required safety margin, in the unit of the margin; 0: none. Its name in JSON is older than the word.
        #[serde(rename = "reserve")]
        pub safety_margin: Number = Number(safety_margin),
        /// The margin minus the safety margin.
        pub net_margin: Number = Number(m.value - safety_margin),
        /// Whether the safety margin is kept. In `assess` this is proved, or null; in other answers it holds at the
        /// sampled poses.
        pub safety_margin_kept: Option<bool> = safety_margin_kept,
        /// Whether the requirement is met, apart from rounding. In `assess` this is proved, or null; in other answers
        /// it holds at the sampled poses.
        pub met: Option<bool> = met,
        /// Whether the margin is 0 to rounding.
        pub at_limit: bool = m.standing == Standing::AtLimit,
        /// The status of the requirement.
        pub status: MarginVerdict = status,
        /// Proved lower bound over the workspace; null: nothing is proved.
        pub proved_margin: Number = Number(below),
        /// Unit.
        pub unit: String = design.unit_of(m.term.kind.quantity()),
        /// The parts with the least margin: legs, joints, keep-out or load.
        pub between: Vec<String> = design.names_of(m.term),
        /// Legs, from 1; for a requirement on joints, the legs of the joint.
        pub legs: Vec<usize> = design.legs_of(m.term),
        /// The pose with the least margin; null: the margin is the same at every pose.
        pub pose: Option<PoseQuaternionRecord> = m.pose.as_ref().map(PoseQuaternionRecord::from),
    }
    fn new(
        design: &Design,
        m: &Margin,
        met: Option<bool>,
        (status, below): (MarginVerdict, f64),
        safety_margin_kept: Option<bool>,
    ) {
        let safety_margin = design.requirements().safety_margin(m.term.kind);
    }
}

impl MarginRecord {
    /// The record of a margin with its proved bound.
    #[must_use]
    pub fn proved(design: &Design, bound: &MarginBound) -> Self {
        let proved = (bound.verdict, bound.below);
        Self::new(design, &bound.found, bound.verdict.is_met(), proved, bound.keeps_safety_margin())
    }

    /// The records of sampled margins without a proof; `met` then means that no violation was found.
    #[must_use]
    pub fn searched(design: &Design, found: &Assessment) -> Vec<Self> {
        found.margins.iter().map(|m| Self::found(design, m)).collect()
    }

    /// The record of a margin found at some pose.
    #[must_use]
    pub fn found(design: &Design, m: &Margin) -> Self {
        let met = m.standing.is_met();
        let status = if met { MarginVerdict::Searched } else { MarginVerdict::Violated };
        let kept =
            m.value >= design.requirements().safety_margin(m.term.kind) || m.standing == Standing::AtLimit;
        Self::new(design, m, Some(met), (status, f64::NEG_INFINITY), Some(kept))
    }

    /// Whether the margin found is a violation.
    #[must_use]
    pub fn violates(&self) -> bool {
        !self.at_limit && (self.margin.0 < 0.0 || self.margin.0.is_nan())
    }
}

view! {
    /// The answer of `assess`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct AssessAnswer {
        /// Assessed design.
        pub name: String = design.name.clone(),
        /// Unit of lengths.
        #[serde(default)]
        pub length_unit: String = design.units.clone(),
        /// Role of the design here.
        pub role: DesignRoleWord = DesignRoleWord::Design,
        /// Verdict for `assessed_poses`. True: every margin and det J are proved. False: one pose proves a violation or
        /// a change of sign of det J. Null: neither is proved, or the design states no workspace.
        pub met: Option<bool> = found.met(),
        /// Verdict in words.
        pub explanation: String = found.to_string(),
        /// Poses that the design states.
        pub workspace: StatedPosesWord = found.assessed_poses.into(),
        /// The poses assessed.
        pub assessed_poses: AssessedPosesRecord = found.assessed_poses.into(),
        /// Verdict for safety margins. True: every margin is proved to keep its safety margin. False: the given pose
        /// proves the opposite. Null: neither is proved.
        pub safety_margin_kept: Option<bool> = proof.all_keep_safety_margin(),
        /// The least margin of each kind.
        pub requirements: Vec<MarginRecord> =
            proof.bounds.iter().map(|b| MarginRecord::proved(design, b)).collect(),
        /// Least margin relative to its limit; null: no requirement has a limit to compare with.
        pub tightest: Option<TightestRecord> = TightestRecord::of(design, found),
        /// Whether the workspace is free of singular poses.
        pub regular: RegularityRecord = RegularityRecord::new(&found.regularity, found.regularity_cells),
        /// Result on singular poses.
        pub regular_explanation: String = found.regularity_in_words(),
        /// Worst conditioning over the sampled poses: a value found, without limit and proof.
        pub conditioning: LeastConditioningRecord = LeastConditioningRecord {
            inverse_condition: Number(found.conditioning.value),
            pose: (&found.conditioning.pose).into(),
            characteristic_length,
        },
        /// Ranges of single coordinates with their free parts. Absent: the design states none.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        pub ranges: Vec<RangeRecord> = found.ranges.iter().map(|range| RangeRecord::new(design, range)).collect(),
        /// Number of poses sampled.
        pub poses: usize = proof.poses,
        /// Number of workspace cells of the proof.
        pub cells: usize = proof.bounds.iter().map(|b| b.cells).sum(),
        /// Lightest drive that meets the requirements, from the table that the design names. Null: the design names
        /// none, or the answer has another subject.
        pub lightest_drive: Option<LightestDriveRecord> = None,
        /// Assumptions about masses, one sentence each. Absent: no force, torque or natural frequency is assessed, or
        /// the enclosing answer has the list.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        pub assumptions: Vec<String> = design
            .assumptions_of(AssessedForces::of(proof.bounds.iter().map(|b| b.found.term.kind))),
    }
    /// The answer with a conditioning by the common characteristic length of a comparison.
    pub fn beside(design: &Design, found: &AssessReport, characteristic_length: f64) {
        let proof = &found.proof;
    }
}

impl AssessAnswer {
    /// The answer of `assess` for a design, the same for every command; `None` for a design without requirements.
    #[must_use]
    pub fn of(design: &Design, seed: u64) -> Option<Self> {
        design.assessed(seed).map(|found| Self::new(design, &found))
    }

    /// The answer from the proved margins of a design.
    #[must_use]
    pub fn new(design: &Design, found: &AssessReport) -> Self {
        Self::beside(design, found, design.characteristic_length())
    }

    /// The answer for a design derived from the requested one.
    #[must_use]
    pub fn with_role(self, role: DesignRoleWord) -> Self {
        Self { role, ..self }
    }

    /// Whether the requirements are met at `assessed_poses`, which are home alone without a workspace.
    #[must_use]
    pub fn met_at_assessed_poses(&self) -> Option<bool> {
        let each = || self.requirements.iter().map(|m| m.met).chain([self.regular.met]);
        match self.met {
            None if self.workspace == StatedPosesWord::None && each().all(|met| met == Some(true)) => {
                Some(true)
            }
            met => met,
        }
    }

    /// The answer inside another one that lists the assumptions itself.
    pub fn without_assumptions(self) -> Self {
        Self { assumptions: Vec::new(), ..self }
    }
}

/// The requirement with the least margin as a share of its limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TightestRecord {
    /// The kind of requirement.
    pub name: TermKind,
    /// Margin over its limit, such as the travel of the legs or the greatest force; negative for a violation.
    pub share: Number,
}

impl TightestRecord {
    fn of(design: &Design, found: &AssessReport) -> Option<Self> {
        let required = design.requirements();
        let of = |bound: &MarginBound| {
            let kind = bound.found.term.kind;
            let whole = required.whole(kind);
            (whole > 0.0).then(|| Self { name: kind, share: Number(bound.found.value / whole) })
        };
        found.proof.bounds.iter().filter_map(of).min_by(|a, b| a.share.0.total_cmp(&b.share.0))
    }
}

/// The role of a design in an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DesignRoleWord {
    /// The requested design.
    Design,
    /// The platform that a search found for the design.
    Optimised,
    /// The platform with the least violation, if none meets the requirements.
    Closest,
    /// An equivalent platform made by moving legs.
    Equivalent,
    /// The platform equivalent to the nearest octahedral one.
    NearestEquivalent,
    /// The platform with its joints on holes.
    OnHoles,
}

impl DesignRoleWord {
    /// The heading of the answer for this role.
    #[must_use]
    pub fn heading(self) -> &'static str {
        match self {
            Self::Design => "Original",
            Self::Optimised => "Optimised platform",
            Self::Closest => "Platform that misses the requirements least",
            Self::Equivalent => "Equivalent platform",
            Self::NearestEquivalent => "Equivalent of the nearest octahedral platform",
            Self::OnHoles => "Platform on the holes",
        }
    }

    /// The heading for a role, given by its word in a document.
    pub fn heading_of(word: &str) -> Option<&'static str> {
        serde_json::from_value(word.into()).ok().map(Self::heading)
    }
}

/// The poses that a design states for its assessment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StatedPosesWord {
    /// A region, a trajectory or ranges, with all motions in them.
    Stated,
    /// Single poses, without the motions between them.
    ListedPoses,
    /// None: home alone is assessed.
    None,
}

impl From<AssessedPoses> for StatedPosesWord {
    fn from(poses: AssessedPoses) -> Self {
        match (poses.are_connected(), poses.are_stated()) {
            (true, _) => Self::Stated,
            (false, true) => Self::ListedPoses,
            (false, false) => Self::None,
        }
    }
}

view! {
    /// The poses of an assessment, with home.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct AssessedPosesRecord {
        /// Whether the design states a workspace; otherwise only home is assessed.
        pub stated: bool = poses.are_stated(),
        /// Whether a whole region around home is assessed.
        pub region: bool = poses.region,
        /// Number of single poses; the motions between them are not assessed.
        pub listed: usize = poses.listed,
        /// Number of poses of a trajectory; the straight motions between them are assessed too.
        pub trajectory: usize = poses.trajectory,
        /// Number of coordinates that move alone from home, each over the whole of its range.
        #[serde(default)]
        pub ranges: usize = poses.ranges,
        /// Wording of the verdict if met.
        pub met_in_words: String = poses.met_in_words(),
    }
    impl From(poses: AssessedPoses) {}
}

/// The pose with the worst conditioning.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LeastConditioningRecord {
    /// Inverse condition number of the Jacobian, with unit lines and moments divided by the characteristic length: 1 at
    /// best, 0 at a singular pose.
    pub inverse_condition: Number,
    /// The pose.
    pub pose: PoseQuaternionRecord,
    /// The characteristic length, design units.
    pub characteristic_length: f64,
}

view! {
    /// Whether det J is nonzero at every pose of the workspace.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct RegularityRecord {
        /// Whether every pose is regular; null: undecided.
        pub met: Option<bool> = regularity.is_regular(),
        /// Result.
        pub status: RegularityWord = regularity.word(),
        /// Pose with det J opposite to home, or is undecided.
        pub pose: Option<PoseQuaternionRecord> = regularity.pose().map(PoseQuaternionRecord::from),
        /// Number of cells examined.
        pub cells: usize = cells,
    }
    /// The record of a regularity result and the number of cells used.
    pub fn new(regularity: &Regularity, cells: usize) {}
}
