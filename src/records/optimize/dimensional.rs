//! Answers about a dimensional problem.

use nalgebra::{Unit, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ConflictRecord, DriveSearchRecord, FreedomRecord, OptimalityWord, SymmetryRecord};
use crate::design::Design;
use crate::dimensional::{DimensionalOutcome, DimensionalReport, DimensionalSolution, HistoryStep};
use crate::entrance::OptimizeStatus;
use crate::entrance::optimizing::{Checked, dimensional_status};
use crate::equivalence::Verification;
use crate::records::{
    AllOrNone, AssessAnswer, DesignRecord, MarginRecord, Number, PoseQuaternionRecord, VerdictWord,
};
use crate::requirements::Objective;

/// The answer of `optimize` about a design that asks for more than offsets.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DimensionalAnswer {
    /// What came of the search.
    pub status: DimensionalStatus,
    /// What is known of better ones; null: nothing, or there is no platform.
    pub optimality: Option<OptimalityWord>,
    /// The best platform found.
    #[serde(flatten)]
    pub solution: AllOrNone<DimensionalSolutionRecord>,
    /// Where none that meets the requirements was found: the one with the least violation, which misses some of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Box<NearestPlatformRecord>>,
    /// When infeasible.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conflict: Option<ConflictRecord>,
    /// Where nothing that meets the requirements was found: the freedoms that the design does not have, each with what came of a search that had it; absent where none was looked at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub freedoms: Option<Vec<FreedomRecord>>,
    /// What became of the three-fold symmetry of the design; absent where it has none, names one, or the search could not break it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<SymmetryRecord>,
    /// The drives of a table, with what the search came to with each; absent where no table was given. The rest of the answer is about the drive chosen; where none is, about that with which most was reached.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drive_search: Option<DriveSearchRecord>,
    /// Other local optima that meet the requirements at the poses that were held, best first; absent where they were not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub candidates: Option<Vec<OptimumRecord>>,
    /// How the search went.
    pub search: SearchRecord,
    /// The platform; null: there is none.
    pub design: Option<DesignRecord>,
    /// The file written, with the platform or the one that comes nearest.
    pub output: Option<String>,
}

/// A local optimum beside the best one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OptimumRecord {
    /// All objectives.
    pub objectives: Vec<ObjectiveRecord>,
    /// What was chosen, axes left out.
    pub variables: Vec<VariableRecord>,
    /// Whether the platform meets its requirements, proved by the assessment; null: not all is proved.
    pub requirements_met: Option<bool>,
    /// What `assess` says of it; null: the design requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// The platform.
    pub design: DesignRecord,
    /// The file it was written to.
    pub output: Option<String>,
}

impl OptimumRecord {
    /// The record of a candidate for a design.
    #[must_use]
    pub fn new(design: &Design, s: &DimensionalSolution, c: &Checked, output: Option<&str>) -> Self {
        Self {
            objectives: ObjectiveRecord::all(design, s, c),
            variables: VariableRecord::all(s),
            requirements_met: c.met(),
            assessment: c.assessed.as_ref().map(|found| AssessAnswer::new(&c.design, found)),
            design: (&c.design).into(),
            output: output.map(str::to_owned),
        }
    }
}

/// The platform that comes nearest to its requirements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearestPlatformRecord {
    /// What was chosen, axes left out.
    pub variables: Vec<VariableRecord>,
    /// The requirements, over many poses and by other code.
    pub constraint_margins: Vec<MarginRecord>,
    /// What `assess` says of it; null: the design requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// The platform.
    pub design: DesignRecord,
}

impl NearestPlatformRecord {
    fn new(s: &DimensionalSolution, c: &Checked) -> Self {
        Self {
            variables: VariableRecord::all(s),
            constraint_margins: MarginRecord::searched(&c.design, &c.assessment),
            assessment: c.assessed.as_ref().map(|found| AssessAnswer::new(&c.design, found)),
            design: (&c.design).into(),
        }
    }
}

impl DimensionalAnswer {
    /// The answer of a search from a design; `checked` is its solution or its nearest platform, if there is one.
    #[must_use]
    pub fn new(
        design: &Design,
        report: &DimensionalReport,
        checked: Option<&Checked>,
        output: Option<&str>,
    ) -> Self {
        let solution = report.solution().zip(checked);
        let nearest = report.nearest.as_deref().zip(checked);
        let checked = solution.map(|(_, c)| c);
        let status = DimensionalStatus::from(dimensional_status(report, checked));
        Self {
            status,
            optimality: (status == DimensionalStatus::Optimal).then_some(OptimalityWord::BestOfStarts),
            solution: solution.map(|(s, c)| DimensionalSolutionRecord::new(design, s, c)).into(),
            nearest: nearest.map(|(s, c)| Box::new(NearestPlatformRecord::new(s, c))),
            conflict: match &report.outcome {
                DimensionalOutcome::Infeasible(c) => Some(ConflictRecord::new(design, c)),
                _ => None,
            },
            freedoms: None,
            symmetry: None,
            drive_search: None,
            candidates: None,
            search: SearchRecord {
                starts: report.starts,
                feasible: report.feasible,
                polished: report.polished.iter().map(|g| g.map(Number)).collect(),
            },
            design: checked.map(|c| (&c.design).into()),
            output: output.map(str::to_owned),
        }
    }
}

/// What came of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DimensionalStatus {
    /// Locally optimal by the evidence, and the requirements are met.
    Optimal,
    /// The requirements are met; better platforms may be near.
    Feasible,
    /// No start met the requirements.
    Infeasible,
    /// Neither: nothing that meets the requirements was found, or what was found is not proved to meet them.
    Undecided,
    /// A platform was found that misses requirements; the assessment names them.
    Violated,
    /// The search was told to end.
    Interrupted,
}

impl From<OptimizeStatus> for DimensionalStatus {
    fn from(status: OptimizeStatus) -> Self {
        match status {
            OptimizeStatus::Optimal => Self::Optimal,
            OptimizeStatus::Feasible => Self::Feasible,
            OptimizeStatus::Infeasible => Self::Infeasible,
            OptimizeStatus::Undecided => Self::Undecided,
            OptimizeStatus::Violated => Self::Violated,
            OptimizeStatus::Interrupted => Self::Interrupted,
        }
    }
}

impl DimensionalStatus {
    /// The word.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Feasible => "feasible",
            Self::Infeasible => "infeasible",
            Self::Undecided => "undecided",
            Self::Violated => "violated",
            Self::Interrupted => "interrupted",
        }
    }
}

/// How a search went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SearchRecord {
    /// Starts that were climbed from.
    pub starts: usize,
    /// Starts that led to a feasible point.
    pub feasible: usize,
    /// Gains; null: not feasible.
    pub polished: Vec<Option<Number>>,
}

/// A platform found by a search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DimensionalSolutionRecord {
    /// Value of the first objective.
    pub objective: Number,
    /// All of them.
    pub objectives: Vec<ObjectiveRecord>,
    /// What was chosen, axes left out.
    pub variables: Vec<VariableRecord>,
    /// In cyclic order; null: not chosen.
    pub offsets: Option<[Number; 6]>,
    /// Home, lifted when its height was chosen.
    pub home: PoseQuaternionRecord,
    /// The axes chosen.
    pub joint_axes: JointAxesRecord,
    /// The requirements, over many poses and by other code.
    pub constraint_margins: Vec<MarginRecord>,
    /// Whether the platform meets its requirements, proved by the assessment; null: not all is proved.
    pub requirements_met: Option<bool>,
    /// What `assess` says of the platform; null: the design requires nothing.
    pub assessment: Option<AssessAnswer>,
    /// Whether it is equivalent to the design; null: the variables do not keep the class.
    pub verify: Option<VerifiedRecord>,
    /// Steps of the run that found it; absent in a front.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub history: Option<Vec<DimensionalStepRecord>>,
    /// Evidence of local optimality.
    pub local_optimality: StationarityRecord,
    /// Numbers of poses.
    pub poses: HeldPosesRecord,
}

impl DimensionalSolutionRecord {
    /// The record of a solution for a design.
    #[must_use]
    pub fn new(design: &Design, s: &DimensionalSolution, c: &Checked) -> Self {
        let objectives = ObjectiveRecord::all(design, s, c);
        let axes = |list: &Option<[Unit<Vector3<f64>>; 6]>| {
            list.map(|list| list.map(|a| [a.x, a.y, a.z].map(Number)))
        };
        Self {
            objective: objectives.first().map_or(Number(f64::NAN), |o| o.value),
            objectives,
            variables: VariableRecord::all(s),
            offsets: s.offsets.map(|t| t.map(Number)),
            home: (&s.home).into(),
            joint_axes: JointAxesRecord { base: axes(&s.axes[0]), platform: axes(&s.axes[1]) },
            constraint_margins: MarginRecord::searched(&c.design, &c.assessment),
            requirements_met: c.met(),
            assessment: c.assessed.as_ref().map(|found| AssessAnswer::new(&c.design, found)),
            verify: c.verification.as_ref().map(VerifiedRecord::from),
            history: Some(s.history.iter().map(DimensionalStepRecord::from).collect()),
            local_optimality: StationarityRecord { stationarity: Number(s.stationarity) },
            poses: HeldPosesRecord { held: s.poses.len(), checked: c.assessment.poses },
        }
    }
}

/// An objective and its value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ObjectiveRecord {
    /// Which.
    pub name: Objective,
    /// By the dense evaluation.
    pub value: Number,
    /// Over the poses at which the optimiser kept the requirements.
    pub at_held_poses: Number,
    /// Empty for a pure number.
    pub unit: String,
}

impl ObjectiveRecord {
    /// All objectives of a platform found for a design.
    fn all(design: &Design, s: &DimensionalSolution, c: &Checked) -> Vec<Self> {
        let one = |((o, held), (_, dense)): (&(Objective, f64), &(Objective, f64))| Self {
            name: *o,
            value: Number(*dense),
            at_held_poses: Number(*held),
            unit: o.quantity().map_or_else(String::new, |q| design.unit_of(q)),
        };
        s.objectives.iter().zip(&c.objectives).map(one).collect()
    }
}

/// A quantity that was chosen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VariableRecord {
    /// Which.
    pub name: String,
    /// Its value.
    pub value: Number,
}

impl VariableRecord {
    fn all(s: &DimensionalSolution) -> Vec<Self> {
        s.variables.iter().map(|(name, x)| Self { name: name.clone(), value: Number(*x) }).collect()
    }
}

/// Axes of joints: unit vectors, frame of the body; null: not chosen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointAxesRecord {
    /// Of the base ends of the legs.
    pub base: Option<[[Number; 3]; 6]>,
    /// Of their platform ends.
    pub platform: Option<[[Number; 3]; 6]>,
}

/// A verification in short.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VerifiedRecord {
    /// The verdict.
    pub verdict: VerdictWord,
    /// The largest distance of matched poses.
    pub worst_distance: Number,
    /// Sets of lengths at which both were solved.
    pub sample_count: usize,
}

impl From<&Verification> for VerifiedRecord {
    fn from(v: &Verification) -> Self {
        Self {
            verdict: (&v.verdict).into(),
            worst_distance: Number(v.worst_distance()),
            sample_count: v.samples.len(),
        }
    }
}

/// A step of the run that found a platform.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DimensionalStepRecord {
    /// Weighted gain.
    pub objective: Number,
    /// In the scale of its constraint.
    pub violation: Number,
    /// Of the trust region.
    pub radius: Number,
    /// Held.
    pub poses: usize,
    /// The step was taken.
    pub accepted: bool,
}

impl From<&HistoryStep> for DimensionalStepRecord {
    fn from(h: &HistoryStep) -> Self {
        Self {
            objective: Number(h.gain),
            violation: Number(h.violation),
            radius: Number(h.radius),
            poses: h.poses,
            accepted: h.accepted,
        }
    }
}

/// Evidence of local optimality.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StationarityRecord {
    /// Gain still promised for a unit of the variables.
    pub stationarity: Number,
}

/// Numbers of poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct HeldPosesRecord {
    /// Where the optimiser kept the requirements.
    pub held: usize,
    /// Of the dense evaluation.
    pub checked: usize,
}
