//! Answers about legs that are moved while the kinematics of the platform stay the same, and about the search for
//! equivalent platforms.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AssessAnswer, DesignRecord, DesignRoleWord, LegEndsRecord, MapRecord, Number, leg_number};
use ask::{Design, MoveSearchReport, MovedAtOnce, MovedPlatform, MovesReport, SearchWord};
use platform::manipulator::Body;
use synthesis::Relation;
use synthesis::relocate::search::{
    self, Hole, HoleAnswer, HoleWord, Placement, SearchVerdict, TargetMargin, Targets,
};
use synthesis::relocate::{MovedLeg, SingularParameters};

/// The answer of `equivalents move`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum MoveAnswer {
    /// The answer with `--search`.
    Search(Box<MoveSearchAnswer>),
    /// Requested moves.
    Moves(Box<MovesAnswer>),
}

view! {
    /// The result of moving legs.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MovesAnswer {
        /// The name of the design.
        pub name: String = design.name.clone(),
        /// The relation after the last move; null: undecided, exit 3.
        pub outcome: Option<Relation> = found.outcome(),
        /// Moves one by one or together.
        pub mode: MoveMode = if found.together { MoveMode::Together } else { MoveMode::Sequence },
        /// The steps in order; each holds the moves made at once.
        pub steps: Vec<MoveStepRecord> = found.steps.iter().map(MoveStepRecord::from).collect(),
        /// Number of moves left undone, because a move before them is not regular.
        pub moves_left_out: usize = found.left_out,
        /// Whether all new coordinates are exact.
        pub exact: bool = moved.all(|m| m.exact),
        /// The leg map from the design to the last platform.
        #[serde(flatten)]
        pub map: MapRecord = (&found.chain.direct).into(),
        /// Largest difference of A and c from the composed steps.
        pub composition_difference: Number = Number(found.chain.disagreement),
        /// The new design; null: two legs coincide.
        pub design: Option<DesignRecord> = found.design.as_ref().map(DesignRecord::from),
        /// The file written.
        pub output: Option<String> = None,
    }
    /// The answer about a design; no file is written yet.
    pub fn new(design: &Design, found: &MovesReport) {
        let mut moved = found.steps.iter().flat_map(|step| &step.relocation.moved);
    }
}

/// The order of moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MoveMode {
    /// One after another.
    Sequence,
    /// All at once, along families of the given design.
    Together,
}

view! {
    /// A step: moves made at once.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MoveStepRecord {
        /// Relation to the platform before; null: undecided.
        pub outcome: Option<Relation> = r.map.relation.decided(),
        /// det A of the step.
        pub det: Number = Number(r.map.determinant),
        /// The moves.
        pub moves: Vec<LegMoveRecord> = r.moved.iter().enumerate().map(|moved| LegMoveRecord::of(step, moved)).collect(),
    }
    impl From(step: &MovedAtOnce) {
        let r = &step.relocation;
    }
}

view! {
    /// One leg moved along a family.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct LegMoveRecord {
        /// The leg, from 1.
        pub leg: usize = leg_number(m.request.leg),
        /// The number of the family, from 1.
        pub component: usize = m.request.family + 1,
        /// Family type.
        #[serde(rename = "type")]
        pub type_name: String = step.families[k].0.clone(),
        /// Joints spanning the family.
        pub along: Option<String> = step.families[k].1.clone(),
        /// Parameters in the family.
        pub parameters: Vec<Number> = m.request.parameters.iter().copied().map(Number).collect(),
        /// Parameters as written, such as 1/5.
        pub parameters_written: Vec<String> = step.written[k].clone(),
        /// The leg before.
        pub from: LegEndsRecord = (&m.from).into(),
        /// The leg after.
        pub to: LegEndsRecord = (&m.to).into(),
        /// Row of A of this leg.
        pub coefficients: [Number; 6] = m.coefficients.map(Number),
        /// Coefficient of the replaced leg.
        pub coefficient: Number = Number(m.coefficients[m.request.leg.get()]),
        /// Residual of the leg vector after subtracting this combination.
        pub residual: Number = Number(m.residual),
        /// Whether the new coordinates are exact.
        pub exact: bool = m.exact,
        /// First parameters with det A = 0.
        pub singular_parameters: SingularParameters = m.singular.clone(),
    }
    fn of(step: &MovedAtOnce, (k, m): (usize, &MovedLeg)) {}
}

view! {
    /// The result of the search for an equivalent platform with requested properties.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct MoveSearchAnswer {
        /// The name of the design.
        pub name: String = design.name.clone(),
        /// Always `search`.
        #[schemars(extend("const" = "search"))]
        pub mode: String = "search".into(),
        /// The outcome of the search.
        pub outcome: SearchWord = found.word(),
        /// Reason for impossibility; null: there is none.
        #[schemars(extend("enum" = ["no_leg_at_hole", "partners_at_infinity", "not_by_those_legs", "shared_joints", "holes_together", null]))]
        pub reason: Option<String> = reason,
        /// Outcome in words.
        pub explanation: String = found.to_string(),
        /// Number of patterns of six independent legs.
        pub patterns: usize = o.patterns,
        /// Number of patterns searched.
        pub patterns_searched: usize = o.searched,
        /// Fewest shared joints of an equivalent platform; null: not known.
        pub least_shared_joints: Option<usize> = o.least_shared,
        /// Whether all replaceable legs are known.
        pub complete: bool = o.complete,
        /// The requested properties.
        pub targets: TargetsRecord = (&o.targets).into(),
        /// Requested holes.
        pub holes: Vec<HoleRecord> = o.holes.iter().map(HoleRecord::from).collect(),
        /// Platforms, best first.
        pub designs: Vec<CandidateRecord> =
            found.platforms.iter().map(|f| CandidateRecord::new(design, f)).collect(),
        /// The files written.
        pub paths: Vec<String> = Vec::new(),
    }
    /// The answer about a design, before files are written.
    pub fn new(design: &Design, found: &MoveSearchReport) {
        let o = &found.outcome;
        let reason = match o.verdict {
            SearchVerdict::Impossible(why) => Some(why.name().to_owned()),
            SearchVerdict::Found | SearchVerdict::Undecided => None,
        };
    }
}

view! {
    /// The requested properties of an equivalent platform.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct TargetsRecord {
        /// Whether the fewest shared joints are requested, at best none.
        pub no_shared_joints: bool = w.no_shared_joints,
        /// Least joint distance, design units.
        pub spacing: Number = Number(w.spacing),
        /// Least leg clearance, design units; null: not requested.
        pub clearance: Option<Number> = w.clearance.map(Number),
        /// Least inverse condition number.
        pub conditioning: Number = Number(w.conditioning),
        /// Greatest distance of a joint from the others, design units.
        pub reach: Number = Number(w.reach),
        /// Number of poses checked.
        pub poses: usize = w.poses.len(),
        /// The characteristic length, by which rotations are weighed, design units.
        pub characteristic_length: Number = Number(w.characteristic_length),
    }
    impl From(w: &Targets) {}
}

view! {
    /// A hole requested for an end of a leg.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct HoleRecord {
        /// Body of the hole.
        pub body: Body = *body,
        /// The position, body frame, design units.
        pub point: [Number; 3] = [point.x, point.y, point.z].map(Number),
        /// Equivalent legs that end in the hole.
        pub answer: HoleWord = h.answer.word(),
        /// Legs requested, from 1; empty: any leg.
        pub legs: Vec<usize> = legs.iter().copied().map(leg_number).collect(),
        /// Dimension of possible opposite ends.
        pub dimension: Option<usize> = dimension,
        /// Rank defect in exact arithmetic; 0: no leg ends there.
        pub exact_rank_defect: Option<usize> = h.exact,
        /// Deciding singular value.
        pub singular_value: Number = Number(h.singular_value),
        /// Threshold of the singular value.
        pub tolerance: Number = Number(h.tolerance),
    }
    impl From(h: &search::CheckedHole) {
        let dimension = match h.answer {
            HoleAnswer::Legs { dimension, .. } => Some(dimension),
            _ => None,
        };
        let Hole { body, point, legs, .. } = &h.hole;
    }
}

view! {
    /// An equivalent platform.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CandidateRecord {
        /// Whether all properties hold and all requirements are proved.
        pub fulfilled: bool = found.is_fulfilled(),
        /// Whether all requested properties hold.
        pub targets_met: bool = c.fulfilled,
        /// The result of `assess`; null: the design has no requirements, or the legs make no platform.
        pub assessment: Option<AssessAnswer> = assessment,
        /// Least margin of a property.
        pub worst: Number = Number(c.worst),
        /// Number of shared joints.
        pub shared_joints: usize = c.shared_joints,
        /// Margins of requested properties.
        pub margins: Vec<TargetMargin> = c.margins.clone(),
        /// The origin of each leg.
        pub moves: Vec<PlacementRecord> =
            c.placements.iter().zip(&found.sources).map(|placed| PlacementRecord::of(c, placed)).collect(),
        /// The leg map to the platform.
        #[serde(flatten)]
        pub map: MapRecord = (&found.map).into(),
        /// The platform as a design.
        pub design: Option<DesignRecord> = found.design.as_ref().map(DesignRecord::from),
    }
    /// A platform that is equivalent to a design.
    pub fn new(given: &Design, found: &MovedPlatform) {
        let c = &found.candidate;
        let assessed = found.design.as_ref().zip(found.assessed.as_ref());
        // the name and the requirements come from the given design
        let assessment = assessed.map(|(design, a)| AssessAnswer {
            name: given.name.clone(),
            role: DesignRoleWord::Equivalent,
            ..AssessAnswer::new(design, a)
        });
    }
}

view! {
    /// The origin of one leg of an equivalent platform.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PlacementRecord {
        /// The leg, from 1.
        pub leg: usize = leg_number(p.leg),
        /// Origin: leg, family or hole.
        pub from: String = source.clone(),
        /// Parameters in the family.
        pub parameters: Vec<Number> = p.parameters.iter().copied().map(Number).collect(),
        /// Ends of the leg.
        pub to: LegEndsRecord = (&c.assembled.legs[p.leg.get()]).into(),
        /// The coefficient of the replaced leg.
        pub coefficient: Number = Number(c.map.closest.a[(p.leg.get(), p.leg.get())]),
        /// Residual of the leg vector after subtracting this combination.
        pub residual: Number = Number(c.map.residuals[p.leg.get()]),
    }
    fn of(c: &search::Candidate, (p, source): (&Placement, &String)) {}
}
