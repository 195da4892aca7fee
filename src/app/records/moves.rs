//! Answers about legs that are moved without changing the platform, and about the search for equivalent platforms.

use schemars::JsonSchema;
use serde::Serialize;

use super::{AssessAnswer, DesignRecord, DesignRoleWord, LegEndsRecord, MapRecord, Number, leg_number};
use ask::{Design, MoveSearchReport, MovedAtOnce, MovedPlatform, MovesReport, SearchWord};
use platform::manipulator::Body;
use synthesis::Relation;
use synthesis::relocate::search::{
    self, Hole, HoleAnswer, HoleWord, Placement, SearchVerdict, WishMargin, Wishes,
};
use synthesis::relocate::{MovedLeg, SingularParameters};

/// The answer of `equivalents move`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum MoveAnswer {
    /// With `--search`.
    Search(Box<MoveSearchAnswer>),
    /// Of moves that were asked for.
    Moves(Box<MovesAnswer>),
}

/// What moves of legs came to.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MovesAnswer {
    /// The name of the design.
    pub name: String,
    /// Of the last move; null: undecided, exit 3.
    pub outcome: Option<Relation>,
    /// One after another, or all at once.
    pub mode: MoveMode,
    /// Moves made at once, one after another.
    pub steps: Vec<MoveStepRecord>,
    /// Moves that were not made, because one before them is not regular.
    pub moves_left_out: usize,
    /// All new coordinates are exact.
    pub exact: bool,
    /// The map from the design to the last one.
    #[serde(flatten)]
    pub map: MapRecord,
    /// Largest difference of A and c between this map and the composition of the steps.
    pub composition_difference: Number,
    /// The new design; null: two legs have become one.
    pub design: Option<DesignRecord>,
    /// The file written.
    pub output: Option<String>,
}

impl MovesAnswer {
    /// The answer about a design; no file is written yet.
    #[must_use]
    pub fn new(design: &Design, found: &MovesReport) -> Self {
        let mut moved = found.steps.iter().flat_map(|step| &step.relocation.moved);
        Self {
            name: design.name.clone(),
            outcome: found.outcome(),
            mode: if found.together { MoveMode::Together } else { MoveMode::Sequence },
            steps: found.steps.iter().map(MoveStepRecord::from).collect(),
            moves_left_out: found.left_out,
            exact: moved.all(|m| m.exact),
            map: (&found.chain.direct).into(),
            composition_difference: Number(found.chain.disagreement),
            design: found.design.as_ref().map(DesignRecord::from),
            output: None,
        }
    }
}

/// How moves are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MoveMode {
    /// One after another.
    Sequence,
    /// All at once, along families of the given design.
    Together,
}

/// Moves made at once.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MoveStepRecord {
    /// What the new platform has to do with the one before; null: undecided.
    pub outcome: Option<Relation>,
    /// det A of the step.
    pub det: Number,
    /// The moves.
    pub moves: Vec<LegMoveRecord>,
}

impl From<&MovedAtOnce> for MoveStepRecord {
    fn from(step: &MovedAtOnce) -> Self {
        let r = &step.relocation;
        let one = |(k, m): (usize, &MovedLeg)| {
            let (type_name, name) = &step.families[k];
            LegMoveRecord {
                leg: leg_number(m.request.leg),
                component: m.request.family + 1,
                type_name: type_name.clone(),
                along: name.clone(),
                parameters_written: step.written[k].clone(),
                parameters: m.request.parameters.iter().copied().map(Number).collect(),
                from: (&m.from).into(),
                to: (&m.to).into(),
                coefficients: m.coefficients.map(Number),
                coefficient: Number(m.coefficients[m.request.leg.get()]),
                residual: Number(m.residual),
                exact: m.exact,
                singular_parameters: (&m.singular).into(),
            }
        };
        Self {
            outcome: r.map.relation.decided(),
            det: Number(r.map.determinant),
            moves: r.moved.iter().enumerate().map(one).collect(),
        }
    }
}

/// One leg moved along a family.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LegMoveRecord {
    /// The leg, from 1.
    pub leg: usize,
    /// The number of the family, from 1.
    pub component: usize,
    /// The type of the family.
    #[serde(rename = "type")]
    pub type_name: String,
    /// The joints that span the family.
    pub along: Option<String>,
    /// Where on the family.
    pub parameters: Vec<Number>,
    /// The same as it was written, such as 1/5.
    pub parameters_written: Vec<String>,
    /// The leg before.
    pub from: LegEndsRecord,
    /// The leg after.
    pub to: LegEndsRecord,
    /// Its row of A.
    pub coefficients: [Number; 6],
    /// The coefficient of the leg replaced.
    pub coefficient: Number,
    /// What is left of its leg vector.
    pub residual: Number,
    /// The new coordinates are exact.
    pub exact: bool,
    /// Values of the first parameter with det A = 0.
    pub singular_parameters: SingularParametersRecord,
}

/// Values of the first parameter with det A = 0.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum SingularParametersRecord {
    /// These.
    At(Vec<Number>),
    /// All of them.
    Everywhere(#[schemars(extend("const" = "everywhere"))] String),
}

impl From<&SingularParameters> for SingularParametersRecord {
    fn from(s: &SingularParameters) -> Self {
        match s {
            SingularParameters::Everywhere => Self::Everywhere("everywhere".into()),
            SingularParameters::At(list) => Self::At(list.iter().copied().map(Number).collect()),
        }
    }
}

/// What the search for an equivalent platform that fulfils wishes found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MoveSearchAnswer {
    /// The name of the design.
    pub name: String,
    /// Always `search`.
    #[schemars(extend("const" = "search"))]
    pub mode: String,
    /// What came of it.
    pub outcome: SearchWord,
    /// Why it is impossible.
    #[schemars(extend("enum" = ["no_leg_at_hole", "partners_at_infinity", "not_by_those_legs", "shared_joints", "holes_together", null]))]
    pub reason: Option<String>,
    /// One sentence.
    pub explanation: String,
    /// Patterns of six independent legs.
    pub patterns: usize,
    /// Patterns looked at.
    pub patterns_searched: usize,
    /// The fewest shared joints of an equivalent platform; null: not known.
    pub least_shared_joints: Option<usize>,
    /// All replaceable legs are known.
    pub complete: bool,
    /// The wishes.
    pub wishes: WishesRecord,
    /// The holes that legs should end at.
    pub holes: Vec<HoleRecord>,
    /// The platforms found, best first.
    pub designs: Vec<CandidateRecord>,
    /// The files written.
    pub paths: Vec<String>,
}

/// What an equivalent platform should fulfil.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct WishesRecord {
    /// Fewest shared joints.
    pub no_shared_joints: bool,
    /// Least distance of two joints.
    pub spacing: Number,
    /// Least distance of two legs; null: not wished.
    pub clearance: Option<Number>,
    /// Least inverse condition number.
    pub conditioning: Number,
    /// Greatest distance of a joint from the others.
    pub reach: Number,
    /// Poses at which legs are looked at.
    pub poses: usize,
    /// The length by which rotations are weighed.
    pub characteristic_length: Number,
}

impl From<&Wishes> for WishesRecord {
    fn from(w: &Wishes) -> Self {
        Self {
            no_shared_joints: w.no_shared_joints,
            spacing: Number(w.spacing),
            clearance: w.clearance.map(Number),
            conditioning: Number(w.conditioning),
            reach: Number(w.reach),
            poses: w.poses.len(),
            characteristic_length: Number(w.characteristic_length),
        }
    }
}

/// A hole that a leg should end at.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct HoleRecord {
    /// The body it is in.
    pub body: Body,
    /// Where, frame of the body.
    pub point: [Number; 3],
    /// Which legs of equivalent platforms end there.
    pub answer: HoleWord,
    /// The legs of the design that should, from 1; empty: any.
    pub legs: Vec<usize>,
    /// Dimension of the flat of partners.
    pub dimension: Option<usize>,
    /// 0: none, exactly.
    pub exact_rank_defect: Option<usize>,
    /// What decided.
    pub singular_value: Number,
    /// What it was compared with.
    pub tolerance: Number,
}

impl From<&search::JudgedHole> for HoleRecord {
    fn from(h: &search::JudgedHole) -> Self {
        let dimension = match h.answer {
            HoleAnswer::Legs { dimension, .. } => Some(dimension),
            _ => None,
        };
        let Hole { body, point, legs, .. } = &h.hole;
        Self {
            body: *body,
            point: [point.x, point.y, point.z].map(Number),
            answer: h.answer.word(),
            legs: legs.iter().copied().map(leg_number).collect(),
            dimension,
            exact_rank_defect: h.exact,
            singular_value: Number(h.singular_value),
            tolerance: Number(h.tolerance),
        }
    }
}

/// An equivalent platform.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CandidateRecord {
    /// It fulfils every wish, and is proved to meet the requirements of the design.
    pub fulfilled: bool,
    /// It fulfils every wish.
    pub wishes_fulfilled: bool,
    /// What `assess` says of it; null: the design requires nothing, or the legs make no platform.
    pub assessment: Option<AssessAnswer>,
    /// The least slack of a wish.
    pub worst: Number,
    /// Its shared joints.
    pub shared_joints: usize,
    /// By how much it fulfils the wishes.
    pub margins: Vec<WishMargin>,
    /// How its legs are made.
    pub moves: Vec<PlacementRecord>,
    /// The map to it.
    #[serde(flatten)]
    pub map: MapRecord,
    /// The platform as a design.
    pub design: Option<DesignRecord>,
}

/// How a leg of an equivalent platform is made.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PlacementRecord {
    /// The leg, from 1.
    pub leg: usize,
    /// The leg, family or hole it is taken from.
    pub from: String,
    /// Where on the family.
    pub parameters: Vec<Number>,
    /// The leg.
    pub to: LegEndsRecord,
    /// The coefficient of the leg it replaces.
    pub coefficient: Number,
    /// What is left of its leg vector.
    pub residual: Number,
}

impl MoveSearchAnswer {
    /// The answer about a design; no file is written yet.
    #[must_use]
    pub fn new(design: &Design, found: &MoveSearchReport) -> Self {
        let o = &found.outcome;
        let reason = match o.verdict {
            SearchVerdict::Impossible(why) => Some(why.name().to_owned()),
            SearchVerdict::Found | SearchVerdict::Undecided => None,
        };
        Self {
            name: design.name.clone(),
            mode: "search".into(),
            outcome: found.word(),
            reason,
            explanation: found.to_string(),
            patterns: o.patterns,
            patterns_searched: o.searched,
            least_shared_joints: o.least_shared,
            complete: o.complete,
            wishes: (&o.wishes).into(),
            holes: o.holes.iter().map(HoleRecord::from).collect(),
            designs: found.platforms.iter().map(|f| CandidateRecord::new(design, f)).collect(),
            paths: Vec::new(),
        }
    }
}

impl CandidateRecord {
    /// A platform that is equivalent to a design.
    #[must_use]
    pub fn new(given: &Design, found: &MovedPlatform) -> Self {
        let c = &found.candidate;
        let place = |(p, source): (&Placement, &String)| PlacementRecord {
            leg: leg_number(p.leg),
            from: source.clone(),
            parameters: p.parameters.iter().copied().map(Number).collect(),
            to: (&c.assembled.legs[p.leg.get()]).into(),
            coefficient: Number(c.map.closest.a[(p.leg.get(), p.leg.get())]),
            residual: Number(c.map.residuals[p.leg.get()]),
        };
        let judged = found.design.as_ref().zip(found.assessed.as_ref());
        // the requirements are those of the given design, and so is the name
        let assessment = judged.map(|(design, a)| AssessAnswer {
            name: given.name.clone(),
            role: DesignRoleWord::Equivalent,
            ..AssessAnswer::new(design, a)
        });
        Self {
            fulfilled: found.is_fulfilled(),
            wishes_fulfilled: c.fulfilled,
            assessment,
            worst: Number(c.worst),
            shared_joints: c.shared_joints,
            margins: c.margins.clone(),
            moves: c.placements.iter().zip(&found.sources).map(place).collect(),
            map: (&found.map).into(),
            design: found.design.as_ref().map(DesignRecord::from),
        }
    }
}
