//! By how much requirements are met.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LightestDriveRecord, Number, PoseQuaternionRecord};
use ask::Design;
use ask::{AssessReport, JudgedPoses};
use files::design::JudgedForces;
use machine::requirements::{Assessment, Margin, MarginBound, MarginVerdict, Standing, TermKind};
use synthesis::singularity::{Regularity, RegularityWord};

/// The least margin of a kind of requirement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MarginRecord {
    /// The kind.
    pub name: TermKind,
    /// Least over the poses looked at; a violation below 0.
    pub margin: Number,
    /// What has to remain of the limit, in the unit of the margin; 0: no reserve is asked for.
    pub reserve: Number,
    /// The margin less the reserve.
    pub margin_with_reserve: Number,
    /// The reserve is kept: proved in `assess` (null where it is not), at the poses looked at elsewhere.
    pub reserve_kept: Option<bool>,
    /// Not violated by more than rounding: proved in `assess` (null where it is not), at the poses looked at elsewhere.
    pub met: Option<bool>,
    /// Rounding does not tell the margin from 0.
    pub at_limit: bool,
    /// What is known of it.
    pub status: MarginVerdict,
    /// No pose of the workspace has a smaller margin; null where nothing is proved.
    pub proved_margin: Number,
    /// Of the margins.
    pub unit: String,
    /// Legs, joints, keep-out or load.
    pub between: Vec<String>,
    /// The legs among them, from 1; those of a joint where the requirement is about joints.
    pub legs: Vec<usize>,
    /// Where it is least; null where the pose has no influence.
    pub pose: Option<PoseQuaternionRecord>,
}

impl MarginRecord {
    fn new(
        design: &Design,
        m: &Margin,
        met: Option<bool>,
        (status, below): (MarginVerdict, f64),
        reserve_kept: Option<bool>,
    ) -> Self {
        let reserve = design.requirements().reserve(m.term.kind);
        Self {
            name: m.term.kind,
            margin: Number(m.value),
            met,
            reserve: Number(reserve),
            margin_with_reserve: Number(m.value - reserve),
            reserve_kept,
            at_limit: m.standing == Standing::AtLimit,
            status,
            proved_margin: Number(below),
            unit: design.unit_of(m.term.kind.quantity()),
            between: design.names_of(m.term),
            legs: design.legs_of(m.term),
            pose: m.pose.as_ref().map(PoseQuaternionRecord::from),
        }
    }

    /// With what is proved of it.
    #[must_use]
    pub fn proved(design: &Design, bound: &MarginBound) -> Self {
        let proved = (bound.verdict, bound.below);
        Self::new(design, &bound.found, bound.verdict.is_met(), proved, bound.keeps_reserve())
    }

    /// Margins that were looked for and not proved: `met` says that no violation was found.
    #[must_use]
    pub fn searched(design: &Design, found: &Assessment) -> Vec<Self> {
        found.margins.iter().map(|m| Self::found(design, m)).collect()
    }

    /// A margin that was found at some pose.
    #[must_use]
    pub fn found(design: &Design, m: &Margin) -> Self {
        let met = m.standing.is_met();
        let status = if met { MarginVerdict::Searched } else { MarginVerdict::Violated };
        let kept = m.value >= design.requirements().reserve(m.term.kind) || m.standing == Standing::AtLimit;
        Self::new(design, m, Some(met), (status, f64::NEG_INFINITY), Some(kept))
    }

    /// Whether the margin found is one of a violation.
    #[must_use]
    pub fn violates(&self) -> bool {
        !self.at_limit && (self.margin.0 < 0.0 || self.margin.0.is_nan())
    }
}

/// The answer of `assess`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AssessAnswer {
    /// The design judged.
    pub name: String,
    /// What it is in this answer.
    pub role: DesignRoleWord,
    /// True: every margin and det J are proved, for all poses that `judged` names; false: a violation or a change of
    /// sign of det J is proved by its pose; null: neither.
    pub met: Option<bool>,
    /// The verdict in a sentence whose subject is the design.
    pub explanation: String,
    /// The poses judged.
    pub judged: JudgedPosesRecord,
    /// The same of the reserves: true: every margin is proved to keep its reserve; false: one does not, at the pose
    /// given; null: neither.
    pub reserve_kept: Option<bool>,
    /// The least of each kind.
    pub requirements: Vec<MarginRecord>,
    /// The requirement with the least room as a share of its limit; null: none has a limit to compare with.
    pub tightest: Option<TightestRecord>,
    /// Whether there are singular poses.
    pub regular: RegularityRecord,
    /// The same in a sentence.
    pub regular_explanation: String,
    /// Where the Jacobian is conditioned worst among the poses looked at: a number found, without a limit and without a
    /// proof.
    pub conditioning: LeastConditioningRecord,
    /// Poses looked at.
    pub poses: usize,
    /// Cells over which margins were bounded.
    pub cells: usize,
    /// The lightest drive of the table that the design names with which its requirements are met; null: it names none,
    /// or the answer is about something else.
    pub lightest_drive: Option<LightestDriveRecord>,
    /// Assumptions about masses that the file leaves open, a sentence each; absent where no force, torque or
    /// natural frequency is judged, and where the answer around this one has the list.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumptions: Vec<String>,
}

impl AssessAnswer {
    /// The table of requirements of a design: the same for every command. `None` for a design that requires nothing.
    #[must_use]
    pub fn of(design: &Design, seed: u64) -> Option<Self> {
        design.assessed(seed).map(|found| Self::new(design, &found))
    }

    /// What is proved of a design.
    #[must_use]
    pub fn new(design: &Design, found: &AssessReport) -> Self {
        Self::beside(design, found, design.characteristic_length())
    }

    /// The same about a design that was made from the one asked about.
    #[must_use]
    pub fn with_role(self, role: DesignRoleWord) -> Self {
        Self { role, ..self }
    }

    /// The same with a conditioning by another length, that of all designs of a comparison.
    pub fn beside(design: &Design, found: &AssessReport, characteristic_length: f64) -> Self {
        let proof = &found.proof;
        Self {
            name: design.name.clone(),
            role: DesignRoleWord::Design,
            met: found.met(),
            explanation: found.to_string(),
            judged: found.judged.into(),
            reserve_kept: proof.all_reserved(),
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
                .assumptions_of(JudgedForces::of(proof.bounds.iter().map(|b| b.found.term.kind))),
        }
    }

    /// The same inside an answer that lists the assumptions itself.
    pub fn without_assumptions(self) -> Self {
        Self { assumptions: Vec::new(), ..self }
    }
}

/// The requirement with the least margin as a share of its limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TightestRecord {
    /// The kind.
    pub name: TermKind,
    /// Its least margin over its limit (travel of the legs, greatest force and so on); below 0 for a violation.
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

/// What a design is in an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DesignRoleWord {
    /// The design that was asked about.
    Design,
    /// The platform that a search found for it.
    Optimised,
    /// The platform that misses its requirements least, where none meets them.
    Closest,
    /// A platform equivalent to it by moves of legs.
    Equivalent,
    /// The platform equivalent to the nearest octahedral one.
    NearestEquivalent,
    /// The platform with its joints on holes.
    OnHoles,
}

impl DesignRoleWord {
    /// A heading.
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

    /// The heading for the word in a document.
    pub fn heading_of(word: &str) -> Option<&'static str> {
        serde_json::from_value(word.into()).ok().map(Self::heading)
    }
}

/// The poses that a judgement is about, with home.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct JudgedPosesRecord {
    /// The design states a workspace; else home alone is judged.
    pub stated: bool,
    /// Every pose of a region about home is judged.
    pub region: bool,
    /// Single poses; nothing is said between them.
    pub listed: usize,
    /// Poses of a trajectory, with the straight motions between them.
    pub trajectory: usize,
    /// The verdict of requirements that are met at these poses, in a few words.
    pub met_in_words: String,
}

impl From<JudgedPoses> for JudgedPosesRecord {
    fn from(judged: JudgedPoses) -> Self {
        Self {
            stated: judged.are_stated(),
            region: judged.region,
            listed: judged.listed,
            trajectory: judged.trajectory,
            met_in_words: judged.met_in_words(),
        }
    }
}

/// The worst conditioned pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LeastConditioningRecord {
    /// Smallest over largest singular value of the Jacobian with unit lines and moments over the characteristic length:
    /// 1 at best, 0 at a singular pose.
    pub inverse_condition: Number,
    /// Where.
    pub pose: PoseQuaternionRecord,
    /// Design units.
    pub characteristic_length: f64,
}

/// Whether det J vanishes at no pose of the workspace.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RegularityRecord {
    /// Null: undecided.
    pub met: Option<bool>,
    /// The same in a word.
    pub status: RegularityWord,
    /// Where det J has the other sign than at home, or where it is undecided.
    pub pose: Option<PoseQuaternionRecord>,
    /// Cells of the workspace that were looked at.
    pub cells: usize,
}

impl RegularityRecord {
    /// What is known, and the number of cells it took.
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
