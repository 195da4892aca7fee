//! Margins of requirements.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LightestDriveRecord, Number, PoseQuaternionRecord};
use ask::Design;
use ask::{AssessReport, AssessedPoses};
use files::design::AssessedForces;
use machine::requirements::{Assessment, Margin, MarginBound, MarginVerdict, Standing, TermKind};
use synthesis::singularity::{Regularity, RegularityWord};

/// The least margin of a kind of requirement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MarginRecord {
    /// The kind of requirement.
    pub name: TermKind,
    /// Least margin over sampled poses, negative for a violation.
    pub margin: Number,
    /// Required safety margin, in the unit of the margin; 0: none. Its name in JSON is older than the word.
    #[serde(rename = "reserve")]
    pub safety_margin: Number,
    /// The margin minus the safety margin.
    pub net_margin: Number,
    /// Whether the safety margin is kept. In `assess` this is proved, or null; in other answers it holds at the sampled
    /// poses.
    pub safety_margin_kept: Option<bool>,
    /// Whether the requirement is met, apart from rounding. In `assess` this is proved, or null; in other answers it
    /// holds at the sampled poses.
    pub met: Option<bool>,
    /// Whether the margin is 0 to rounding.
    pub at_limit: bool,
    /// The status of the requirement.
    pub status: MarginVerdict,
    /// Proved lower bound over the workspace; null: nothing is proved.
    pub proved_margin: Number,
    /// Unit.
    pub unit: String,
    /// The parts with the least margin: legs, joints, keep-out or load.
    pub between: Vec<String>,
    /// Legs, from 1; for a requirement on joints, the legs of the joint.
    pub legs: Vec<usize>,
    /// The pose with the least margin; null: the margin is the same at every pose.
    pub pose: Option<PoseQuaternionRecord>,
}

impl MarginRecord {
    fn new(
        design: &Design,
        m: &Margin,
        met: Option<bool>,
        (status, below): (MarginVerdict, f64),
        safety_margin_kept: Option<bool>,
    ) -> Self {
        let safety_margin = design.requirements().safety_margin(m.term.kind);
        Self {
            name: m.term.kind,
            margin: Number(m.value),
            met,
            safety_margin: Number(safety_margin),
            net_margin: Number(m.value - safety_margin),
            safety_margin_kept,
            at_limit: m.standing == Standing::AtLimit,
            status,
            proved_margin: Number(below),
            unit: design.unit_of(m.term.kind.quantity()),
            between: design.names_of(m.term),
            legs: design.legs_of(m.term),
            pose: m.pose.as_ref().map(PoseQuaternionRecord::from),
        }
    }

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

/// The answer of `assess`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AssessAnswer {
    /// Assessed design.
    pub name: String,
    /// Unit of lengths.
    #[serde(default)]
    pub length_unit: String,
    /// Role of the design here.
    pub role: DesignRoleWord,
    /// Verdict for `assessed_poses`. True: every margin and det J are proved. False: one pose proves a violation or a
    /// change of sign of det J. Null: neither is proved, or the design states no workspace.
    pub met: Option<bool>,
    /// Verdict in words.
    pub explanation: String,
    /// Poses that the design states.
    pub workspace: StatedPosesWord,
    /// The poses assessed.
    pub assessed_poses: AssessedPosesRecord,
    /// Verdict for safety margins. True: every margin is proved to keep its safety margin. False: the given pose proves
    /// the opposite. Null: neither is proved.
    pub safety_margin_kept: Option<bool>,
    /// The least margin of each kind.
    pub requirements: Vec<MarginRecord>,
    /// Least margin relative to its limit; null: no requirement has a limit to compare with.
    pub tightest: Option<TightestRecord>,
    /// Whether the workspace is free of singular poses.
    pub regular: RegularityRecord,
    /// Result on singular poses.
    pub regular_explanation: String,
    /// Worst conditioning over the sampled poses: a value found, without limit and proof.
    pub conditioning: LeastConditioningRecord,
    /// Number of poses sampled.
    pub poses: usize,
    /// Number of workspace cells of the proof.
    pub cells: usize,
    /// Lightest drive that meets the requirements, from the table that the design names. Null: the design names none,
    /// or the answer has another subject.
    pub lightest_drive: Option<LightestDriveRecord>,
    /// Assumptions about masses, one sentence each. Absent: no force, torque or natural frequency is assessed, or the
    /// enclosing answer has the list.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumptions: Vec<String>,
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

    /// The answer with a conditioning by the common characteristic length of a comparison.
    pub fn beside(design: &Design, found: &AssessReport, characteristic_length: f64) -> Self {
        let proof = &found.proof;
        Self {
            name: design.name.clone(),
            length_unit: design.units.clone(),
            role: DesignRoleWord::Design,
            met: found.met(),
            explanation: found.to_string(),
            workspace: found.assessed_poses.into(),
            assessed_poses: found.assessed_poses.into(),
            safety_margin_kept: proof.all_keep_safety_margin(),
            requirements: proof.bounds.iter().map(|b| MarginRecord::proved(design, b)).collect(),
            tightest: TightestRecord::of(design, found),
            regular: RegularityRecord::new(&found.regularity, found.regularity_cells),
            regular_explanation: found.regularity_in_words(),
            conditioning: LeastConditioningRecord {
                inverse_condition: Number(found.conditioning.value),
                pose: (&found.conditioning.pose).into(),
                characteristic_length,
            },
            poses: proof.poses,
            cells: proof.bounds.iter().map(|b| b.cells).sum(),
            lightest_drive: None,
            assumptions: design
                .assumptions_of(AssessedForces::of(proof.bounds.iter().map(|b| b.found.term.kind))),
        }
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
    /// A region around home, or a trajectory.
    Stated,
    /// Single poses.
    ListedPoses,
    /// None: home alone is assessed.
    None,
}

impl From<AssessedPoses> for StatedPosesWord {
    fn from(poses: AssessedPoses) -> Self {
        match poses {
            AssessedPoses { region: false, trajectory: 0, listed: 0 } => Self::None,
            AssessedPoses { region: false, trajectory: 0, .. } => Self::ListedPoses,
            _ => Self::Stated,
        }
    }
}

/// The poses of an assessment, with home.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct AssessedPosesRecord {
    /// Whether the design states a workspace; otherwise only home is assessed.
    pub stated: bool,
    /// Whether a whole region around home is assessed.
    pub region: bool,
    /// Number of single poses; the motions between them are not assessed.
    pub listed: usize,
    /// Number of poses of a trajectory; the straight motions between them are assessed too.
    pub trajectory: usize,
    /// Wording of the verdict if met.
    pub met_in_words: String,
}

impl From<AssessedPoses> for AssessedPosesRecord {
    fn from(poses: AssessedPoses) -> Self {
        Self {
            stated: poses.are_stated(),
            region: poses.region,
            listed: poses.listed,
            trajectory: poses.trajectory,
            met_in_words: poses.met_in_words(),
        }
    }
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

/// Whether det J is nonzero at every pose of the workspace.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RegularityRecord {
    /// Whether every pose is regular; null: undecided.
    pub met: Option<bool>,
    /// Result.
    pub status: RegularityWord,
    /// Pose with det J opposite to home, or is undecided.
    pub pose: Option<PoseQuaternionRecord>,
    /// Number of cells examined.
    pub cells: usize,
}

impl RegularityRecord {
    /// The record of a regularity result and the number of cells used.
    #[must_use]
    pub fn new(regularity: &Regularity, cells: usize) -> Self {
        Self {
            met: regularity.is_regular(),
            status: regularity.word(),
            pose: regularity.pose().map(PoseQuaternionRecord::from),
            cells,
        }
    }
}
