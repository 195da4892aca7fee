//! Platforms found by a search: their variables, their objectives and the evidence.

use nalgebra::{Unit, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::active_bounds::{ActiveBoundsRecord, DetMargin};
use crate::map::matrix;
use crate::{
    AssessAnswer, DesignRecord, DesignRoleWord, MarginRecord, Number, PoseQuaternionRecord, PoseRecord,
    leg_number,
};
use ask::Checked;
use ask::Design;
use ask::optimizing::offset_safety_margins;
use machine::requirements::Objective;
use optimize::dimensional::{ChosenVariable, DimensionalSolution, HistoryStep};
use optimize::offsets::{Branch, OffsetProblem, OffsetSolution};
use platform::manipulator::Octahedral;
use synthesis::edge_lengths;
use verify::{VerdictWord, Verification};

/// The notation of the zones of the six offsets.
pub(super) const ZONES: &str = "^[-0+]{6}$";

/// A platform found by a search; every field is null if there is none.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct FoundPlatformRecord {
    /// First objective.
    pub objective: Option<Number>,
    /// All objectives.
    pub objectives: Option<Vec<ObjectiveRecord>>,
    /// The chosen variables, without axes.
    pub variables: Option<Vec<ChosenVariable>>,
    /// The offsets `t_i` in cyclic order; null: no offsets were chosen.
    pub offsets: Option<[Number; 6]>,
    /// The displacements `t_i d_i`, design units; null if `edge_lengths` is null.
    pub shifts: Option<[Number; 6]>,
    /// The edges `d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
    pub edge_lengths: Option<[Number; 6]>,
    /// Legs in cyclic order, from 1; null: no offsets were chosen.
    pub cyclic_order: Option<[usize; 6]>,
    /// Zone of each offset: before, inside or beyond its edge; null: no offsets were chosen.
    #[schemars(extend("pattern" = ZONES))]
    pub branch: Option<String>,
    /// det A of the leg map; null: the variables leave the equivalence class of the design.
    pub det: Option<Number>,
    /// Rows of A: s' = A s + c of squared leg lengths, legs in the order of the design. Null if `det` is null.
    #[serde(rename = "A")]
    pub matrix: Option<[[Number; 6]; 6]>,
    /// The constant terms, design units squared; null if `det` is null.
    #[serde(rename = "c")]
    pub constants: Option<[Number; 6]>,
    /// The home pose, raised if its height was chosen.
    pub home: Option<PoseQuaternionRecord>,
    /// The chosen joint axes.
    pub joint_axes: Option<JointAxesRecord>,
    /// Margins of requirements, over many poses and computed independently of the search.
    pub constraint_margins: Option<Vec<MarginRecord>>,
    /// Margins of the search's extra conditions.
    pub search_margins: Option<SearchMarginsRecord>,
    /// The active bounds: ends of ranges and limits without any margin, and the growth of the bodies. Null: none.
    pub active_bounds: Option<ActiveBoundsRecord>,
    /// Whether all requirements are proved; null: some are unproved.
    pub requirements_met: Option<bool>,
    /// Result of `assess`; null: the design has no requirements.
    pub assessment: Option<AssessAnswer>,
    /// Equivalence with the design; null: the variables leave the equivalence class.
    pub verify: Option<VerifiedRecord>,
    /// Pose with the first objective's value; null: the objective is not the worst conditioning.
    pub worst_pose: Option<WorstPoseRecord>,
    /// Evidence of local optimality.
    pub local_optimality: Option<LocalOptimalityRecord>,
    /// Steps of the successful run; null: a member of a front.
    pub history: Option<Vec<HistoryStep>>,
    /// Numbers of poses held and checked.
    pub poses: Option<HeldPosesRecord>,
}

impl FoundPlatformRecord {
    /// The solution of a search under requirements, with the least |det A| that it held.
    #[must_use]
    pub fn new(design: &Design, min_abs_det: f64, s: &DimensionalSolution, c: &Checked) -> Self {
        let axes = |list: &Option<[Unit<Vector3<f64>>; 6]>| {
            list.map(|list| list.map(|a| [a.x, a.y, a.z].map(Number)))
        };
        let map = c.verification.as_ref().map(|v| &v.map);
        let det = map.map(|m| m.determinant);
        let octahedral = s.offsets.and_then(|t| Some((t, Octahedral::recognise(design.manipulator()).ok()?)));
        // a platform compared with the design has the same triangles
        let base = Self::checked(design, c, &s.objectives, s.poses.len());
        let variables = s.variables.clone();
        let margin = det.map(|det| DetMargin {
            left: det.abs() - min_abs_det,
            least: min_abs_det,
            safety_margin: 0.0,
        });
        let edges = octahedral.as_ref().filter(|_| map.is_some()).map(|(t, o)| (*t, edge_lengths(o)));
        Self {
            active_bounds: ActiveBoundsRecord::new(
                design,
                c,
                &variables,
                base.constraint_margins.as_deref().unwrap_or_default(),
                margin,
            ),
            variables: Some(variables),
            offsets: s.offsets.map(|t| t.map(Number)),
            shifts: edges.map(|(t, d)| std::array::from_fn(|i| Number(t[i] * d[i]))),
            edge_lengths: edges.map(|(_, d)| d.map(Number)),
            cyclic_order: octahedral.as_ref().map(|(_, o)| o.order().map(leg_number)),
            branch: s.offsets.map(|t| Branch::of(&t).to_string()),
            det: det.map(Number),
            matrix: map.map(|m| matrix(&m.closest)),
            constants: map.map(|m| <[f64; 6]>::from(m.closest.c).map(Number)),
            home: Some((&s.home).into()),
            joint_axes: Some(JointAxesRecord { base: axes(&s.axes[0]), platform: axes(&s.axes[1]) }),
            search_margins: Some(SearchMarginsRecord {
                abs_det: det.map(|det| Number(det.abs() - min_abs_det)),
                bounds: Number(s.variables.iter().map(to_bounds).fold(f64::INFINITY, f64::min)),
            }),
            local_optimality: Some(LocalOptimalityRecord {
                converged: s.converged,
                stationarity: Number(s.stationarity),
                pattern_gain: None,
                pattern_trials: None,
            }),
            history: Some(s.history.clone()),
            ..base
        }
    }

    /// The solution of a search for offsets.
    pub(super) fn of_offsets(design: &Design, p: &OffsetProblem, s: &OffsetSolution, c: &Checked) -> Self {
        let (r, count) = (&s.recheck, p.poses.len());
        let variable = |i: usize| ChosenVariable {
            name: format!("t{}", i + 1),
            start: 0.0,
            value: s.offsets[i],
            bounds: [p.bounds[i].0, p.bounds[i].1],
        };
        let base = Self::checked(design, c, &[(Objective::WorstConditioning, r.objective)], count);
        let variables: Vec<ChosenVariable> = (0..6).map(variable).collect();
        let [_, safety_margin] = offset_safety_margins(design, &p.octahedral);
        let margin = DetMargin {
            left: r.margins.det + safety_margin,
            least: p.min_abs_det - safety_margin,
            safety_margin,
        };
        let known = base.constraint_margins.as_deref().unwrap_or_default();
        Self {
            active_bounds: ActiveBoundsRecord::new(design, c, &variables, known, Some(margin)),
            variables: Some(variables),
            offsets: Some(s.offsets.map(Number)),
            shifts: Some(s.shifts.map(Number)),
            edge_lengths: Some(p.edge_lengths().map(Number)),
            cyclic_order: Some(p.octahedral.order().map(leg_number)),
            branch: Some(s.branch.to_string()),
            det: Some(Number(r.det)),
            matrix: Some(matrix(&s.map)),
            constants: Some(<[f64; 6]>::from(s.map.c).map(Number)),
            home: Some((&design.home_or_default()).into()),
            joint_axes: Some(JointAxesRecord { base: None, platform: None }),
            search_margins: Some(SearchMarginsRecord {
                abs_det: Some(Number(margin.left)),
                bounds: Number(r.margins.bounds),
            }),
            local_optimality: Some(LocalOptimalityRecord {
                converged: s.evidence.converged,
                stationarity: Number(s.evidence.stationarity),
                pattern_gain: Some(Number(s.evidence.pattern_gain)),
                pattern_trials: Some(s.evidence.pattern_trials),
            }),
            history: Some(s.history.clone()),
            ..base
        }
    }

    /// The result of the independent check; `at_held` are the values of the objectives over the poses held.
    fn checked(design: &Design, c: &Checked, at_held: &[(Objective, f64)], held: usize) -> Self {
        let objectives = ObjectiveRecord::all(design, at_held, c);
        Self {
            objective: objectives.first().map(|o| o.value),
            objectives: Some(objectives),
            constraint_margins: Some(MarginRecord::searched(&c.design, &c.assessment)),
            requirements_met: c.met(),
            assessment: assessed_as(c, DesignRoleWord::Optimised),
            verify: c.verification.as_ref().map(VerifiedRecord::from),
            worst_pose: c
                .worst_pose
                .as_ref()
                .map(|(index, pose)| WorstPoseRecord { index: *index, pose: pose.into() }),
            poses: Some(HeldPosesRecord { held, checked: c.assessment.poses }),
            ..Self::default()
        }
    }
}

/// The assessment of a platform in its role.
fn assessed_as(c: &Checked, role: DesignRoleWord) -> Option<AssessAnswer> {
    c.assessed.as_ref().map(|found| AssessAnswer::new(&c.design, found).with_role(role))
}

/// Distance of a variable from its nearer bound.
fn to_bounds(v: &ChosenVariable) -> f64 {
    (v.value - v.bounds[0]).min(v.bounds[1] - v.value)
}

/// Margins of the extra conditions of a search.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SearchMarginsRecord {
    /// |det A| less the required value; null: the variables do not keep the class of the design.
    pub abs_det: Option<Number>,
    /// Least distance of a variable from its bounds.
    pub bounds: Number,
}

view! {
    /// A local optimum other than the best one.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct OptimumRecord {
        /// All objectives.
        pub objectives: Vec<ObjectiveRecord> = ObjectiveRecord::all(design, &s.objectives, c),
        /// The chosen variables, without axes.
        pub variables: Vec<ChosenVariable> = s.variables.clone(),
        /// Whether all requirements are proved; null: some are unproved.
        pub requirements_met: Option<bool> = c.met(),
        /// The result of `assess`; null: the design has no requirements.
        pub assessment: Option<AssessAnswer> = assessed_as(c, DesignRoleWord::Optimised),
        /// The platform.
        pub design: DesignRecord = (&c.design).into(),
        /// The design file written; null: none.
        pub output: Option<String> = output.map(str::to_owned),
    }
    /// The record of a candidate for a design.
    pub fn new(design: &Design, s: &DimensionalSolution, c: &Checked, output: Option<&str>) {}
}

view! {
    /// The platform with the least violation of its requirements.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NearestPlatformRecord {
        /// The chosen variables, without axes.
        pub variables: Vec<ChosenVariable> = s.variables.clone(),
        /// Margins of requirements, over many poses and computed independently of the search.
        pub constraint_margins: Vec<MarginRecord> = MarginRecord::searched(&c.design, &c.assessment),
        /// The result of `assess`; null: the design has no requirements.
        pub assessment: Option<AssessAnswer> = assessed_as(c, DesignRoleWord::Closest),
        /// The platform.
        pub design: DesignRecord = (&c.design).into(),
    }
    pub(super) fn new(s: &DimensionalSolution, c: &Checked) {}
}

/// A member of a Pareto front.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrontMemberRecord {
    /// The platform with its evidence.
    #[serde(flatten)]
    pub platform: FoundPlatformRecord,
    /// The platform as a design.
    pub design: DesignRecord,
    /// The file written; null: none.
    pub output: Option<String>,
    /// Objectives as compared on the front.
    pub non_dominated_at: Vec<Number>,
}

/// An objective and its value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ObjectiveRecord {
    /// The name of the objective.
    pub name: Objective,
    /// Value over many poses, computed independently of the search.
    pub value: Number,
    /// Value over the poses held.
    pub at_held_poses: Number,
    /// The unit; empty for a pure number.
    pub unit: String,
}

impl ObjectiveRecord {
    /// All objectives of a platform found for a design.
    fn all(design: &Design, at_held: &[(Objective, f64)], c: &Checked) -> Vec<Self> {
        let one = |((o, held), (_, dense)): (&(Objective, f64), &(Objective, f64))| Self {
            name: *o,
            value: Number(*dense),
            at_held_poses: Number(*held),
            unit: o.quantity().map_or_else(String::new, |q| design.unit_of(q)),
        };
        at_held.iter().zip(&c.objectives).map(one).collect()
    }
}

/// Joint axes: unit vectors, body frame; null: not chosen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointAxesRecord {
    /// Axes at the base ends, base frame.
    pub base: Option<[[Number; 3]; 6]>,
    /// Axes at the platform ends, platform frame.
    pub platform: Option<[[Number; 3]; 6]>,
}

view! {
    /// A summary of a verification.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct VerifiedRecord {
        /// The verdict.
        pub verdict: VerdictWord = v.verdict.word(),
        /// The largest distance of matched poses.
        pub worst_distance: Number = Number(v.worst_distance()),
        /// Number of length sets; both designs were solved at each.
        pub sample_count: usize = v.samples.len(),
    }
    impl From(v: &Verification) {}
}

/// The pose with the worst conditioning.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorstPoseRecord {
    /// Index among the poses held, from 0.
    pub index: usize,
    /// The pose.
    #[serde(flatten)]
    pub pose: PoseRecord,
}

/// Evidence of local optimality.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LocalOptimalityRecord {
    /// Whether it converged: the model of the last step promised no further gain.
    pub converged: bool,
    /// First-order gain per unit of the variables.
    pub stationarity: Number,
    /// Gain of a further pattern search; null: none was made.
    pub pattern_gain: Option<Number>,
    /// Number of points of the pattern search.
    pub pattern_trials: Option<usize>,
}

/// Numbers of poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct HeldPosesRecord {
    /// Number of poses held by the search.
    pub held: usize,
    /// Number of poses evaluated independently.
    pub checked: usize,
}
