//! The answer: a refined run, with its objectives over many poses evaluated by separate code.

use nalgebra::{Unit, Vector3};

use super::leg_lines::LegLines;
use super::model::Model;
use super::problem::DimensionalProblem;
use super::search::RefinedRun;
use crate::climb::{HistoryStep, Task};
use machine::requirements::{
    Hardware, Objective, PoseSpace, Requirements, TermKind, Terms, leg_forces, lowest_frequency,
};
use num::Purpose;
use num::conic::SolverFailure;
use num::linalg::svd;
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, inverse_condition, jacobian};
use synthesis::{Normalisation, leg_vector};

/// A chosen quantity.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "VariableRecord", transform = num::nullable))]
pub struct ChosenVariable {
    // no component of a joint axis
    /// The name of the quantity.
    pub name: String,
    /// Initial value.
    pub start: f64,
    /// Chosen value.
    pub value: f64,
    /// Least and greatest allowed value.
    pub bounds: [f64; 2],
}

/// A platform that meets the requirements.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DimensionalSolution {
    /// The platform, legs in the order of the design.
    pub manipulator: Manipulator,
    /// Home, lifted if its height was chosen.
    pub home: Pose,
    /// Chosen axes of the base joints (base frame) and of the platform joints (platform frame).
    pub axes: [Option<[Unit<Vector3<f64>>; 6]>; 2],
    /// The variables, without axes.
    pub variables: Vec<ChosenVariable>,
    /// The same in the form of the search, axes included; a start for another search.
    pub point: Vec<f64>,
    /// Offsets in cyclic order, if they were chosen.
    pub offsets: Option<[f64; 6]>,
    /// Value of each objective over the held poses, in its own unit.
    pub objectives: Vec<(Objective, f64)>,
    /// Predicted first-order gain per unit of the variables; near 0 at a local optimum.
    pub stationarity: f64,
    /// Whether the model of the last step predicted no further gain.
    pub converged: bool,
    /// Poses at which the requirements were held at the end, home lifted.
    pub poses: Vec<Pose>,
    /// Steps of the run that found the platform.
    pub history: Vec<HistoryStep>,
}

/// A constraint of a conflict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Demand {
    /// All requirements of this kind.
    Requirement(TermKind),
    /// `|det A|` at least the given value.
    Determinant,
    /// Joints that slide on families within 2.5 reaches of their body.
    Reach,
    /// An objective at least (a cost: at most) a given value.
    Level(Objective),
}

/// The code of the requirement, or the name of the other constraint.
impl std::fmt::Display for Demand {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Requirement(kind) => kind.label(),
            Self::Determinant => "|det A|",
            Self::Reach => "the reach of sliding joints",
            Self::Level(objective) => objective.code(),
        })
    }
}

/// A constraint in a conflict, with its necessary relaxation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Give {
    /// The constraint.
    pub demand: Demand,
    /// Least relaxation, in its own unit, with which the others of the conflict can be met. `None` if none was found.
    pub alone: Option<f64>,
    /// Its violation where the sum of all violations (each in its scale) is least; 0 if it holds there because others
    /// are violated.
    pub together: f64,
}

/// The reason for a failure: an irreducible set of constraints that no start could meet together.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstraintConflict {
    /// The constraints; without any single one the others were met.
    pub demands: Vec<Give>,
    /// Whether the conflict is proved: the constraints are convex and a checked certificate separates them.
    pub proved: bool,
}

/// The answer.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum DimensionalOutcome {
    /// A local optimum, the best of all starts; the requirements hold at all evaluated poses.
    Optimal(Box<DimensionalSolution>),
    /// Requirements hold, but evidence of local optimality is missing.
    NotConverged(Box<DimensionalSolution>),
    /// From every start the violation converged above zero.
    Infeasible(ConstraintConflict),
    /// Neither a solution nor a conflict was found.
    Undecided(Option<SolverFailure>),
}

/// All results of the search.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DimensionalReport {
    /// The answer.
    pub outcome: DimensionalOutcome,
    /// Number of starts of climbs.
    pub starts: usize,
    /// Number of starts with a feasible point in the first pass.
    pub feasible: usize,
    /// The platform with the least violation, if none meets the requirements. It misses some of them.
    pub nearest: Option<Box<DimensionalSolution>>,
    /// Other local optima that meet the requirements at the held poses, best first. They are ends of polished runs with
    /// distinct values and distinct variables.
    pub others: Vec<DimensionalSolution>,
    /// Weighted gains of the polished runs, best first; `None` when infeasible.
    pub polished: Vec<Option<f64>>,
    /// Seed of the populations.
    pub seed: u64,
    /// Whether the search was interrupted; the answer is then the best until then.
    pub interrupted: bool,
    /// Number of solved conic programs.
    pub conic_programs: u64,
}

impl DimensionalReport {
    /// The solution, if there is one.
    #[must_use]
    pub fn solution(&self) -> Option<&DimensionalSolution> {
        match &self.outcome {
            DimensionalOutcome::Optimal(s) | DimensionalOutcome::NotConverged(s) => Some(s),
            DimensionalOutcome::Infeasible(_) | DimensionalOutcome::Undecided(_) => None,
        }
    }
}

/// The first of the refined runs as an answer.
pub(super) fn outcome(model: &Model<'_>, task: &Task, refined: &RefinedRun) -> DimensionalOutcome {
    let Some(solution) = solution(model, task, refined) else { return DimensionalOutcome::Undecided(None) };
    if refined.run.is_settled() && refined.complete {
        DimensionalOutcome::Optimal(Box::new(solution))
    } else {
        DimensionalOutcome::NotConverged(Box::new(solution))
    }
}

/// A refined run as a platform, whether or not it meets the requirements; `None` if its legs form none.
pub(super) fn solution(model: &Model<'_>, task: &Task, refined: &RefinedRun) -> Option<DimensionalSolution> {
    let x = &refined.run.x;
    let manipulator = model.shape.manipulator(x).ok()?;
    let home = model.terms.home;
    let lift = model.shape.ends(x).lift;
    let lifted = |pose: &Pose| Pose { position: pose.position + lift, ..*pose };
    let held = refined.poses.iter().map(|at| if at.follows { lifted(&at.pose) } else { at.pose });
    let shape = &model.shape;
    let chosen = |j: usize| ChosenVariable {
        name: shape.names[j].clone(),
        start: shape.start[j],
        value: x[j],
        bounds: shape.bounds[j].into(),
    };
    // every objective is reported, including those left out of the last level
    let all = Task { weights: vec![1.0; task.weights.len()], ..task.clone() };
    let gains = model.judge(&refined.poses, x, &all, model.sign(x)).gains;
    let objectives = model.objectives.iter().zip(gains).map(|(o, g)| (*o, g * model.unit(*o))).collect();
    Some(DimensionalSolution {
        manipulator,
        home: lifted(&home),
        axes: axes(model, refined),
        variables: shape.free().into_iter().map(chosen).collect(),
        point: x.clone(),
        offsets: model.shape.offsets(x),
        objectives,
        stationarity: refined.run.stationarity,
        converged: refined.run.converged,
        poses: held.collect(),
        history: refined.run.history.clone(),
    })
}

/// The axis of the smallest cone for every joint, over the held poses and a sample of the region.
fn axes(model: &Model<'_>, refined: &RefinedRun) -> [Option<[Unit<Vector3<f64>>; 6]>; 2] {
    let ends = model.shape.ends(&refined.run.x);
    let all: Vec<LegLines> =
        refined.poses.iter().chain(&model.merit.sample).map(|at| LegLines::new(&ends, at)).collect();
    [0, 1].map(|body| {
        let first = model.shape.axes[body]?;
        Some(std::array::from_fn(|i| {
            let seen =
                |l: &LegLines| if body == 0 { l.direction[i] } else { l.rotation.inverse() * l.direction[i] };
            let directions: Vec<Vector3<f64>> = all.iter().map(seen).collect();
            let own = || Vector3::from_fn(|k, _| refined.run.x[first + 3 * i + k]);
            Unit::new_normalize(smallest_cap(&directions).map_or_else(own, |cap| cap.0))
        }))
    })
}

/// Every objective of a platform, in the order of the problem and in its unit (see the theory page).
///
/// `space` has the home of the platform. Besides home, corners and listed poses it evaluates `points` Halton points and
/// as many random ones; the mean is over all of them. `also` are additional poses for the worst case, for instance
/// those of a search. NaN if the platform has no value (forces at a singular pose).
#[must_use]
pub fn evaluate(
    p: &DimensionalProblem,
    m: &Manipulator,
    space: &PoseSpace,
    also: &[Pose],
    points: usize,
    seed: u64,
) -> Vec<f64> {
    let mut poses = also.to_vec();
    poses.extend(space.listed(10));
    let cube = space.cube_points(points, &mut Purpose::EVALUATED_POSES.rng(seed));
    poses.extend(cube.iter().map(|x| space.pose(x)));
    p.objectives.iter().map(|(o, _)| value(p, m, (&poses, also.len()), *o)).collect()
}

/// The value of an objective; the first `apart` poses are left out of the mean.
fn value(p: &DimensionalProblem, m: &Manipulator, (poses, apart): (&[Pose], usize), o: Objective) -> f64 {
    let length = p.characteristic_length;
    let over = |f: &dyn Fn(&Pose) -> f64| poses.iter().map(f).fold(f64::INFINITY, f64::min);
    let conditioning = |pose: &Pose| inverse_condition(&jacobian(m, pose, length));
    let least_singular = |pose: &Pose| {
        let j = jacobian(m, pose, length);
        let rows: Vec<Vec<f64>> = j.row_iter().map(|r| r.iter().copied().collect()).collect();
        svd(&rows).map_or(f64::NAN, |d| d.s[5])
    };
    match o {
        Objective::WorstConditioning => over(&conditioning),
        Objective::MeanConditioning => {
            let sample = &poses[apart..];
            sample.iter().map(conditioning).sum::<f64>() / sample.len() as f64
        }
        Objective::SmallestSingularValue => over(&least_singular),
        Objective::Stiffness => {
            let k = p.requirements.hardware.leg_stiffness.unwrap_or(f64::NAN);
            k * over(&|pose| least_singular(pose).powi(2))
        }
        Objective::NaturalFrequency => {
            let masses = p.requirements.vibrating.as_ref();
            masses.map_or(f64::NAN, |masses| over(&|pose| lowest_frequency(m, pose, masses)))
        }
        Objective::LegForce => -over(&|pose| {
            let loads = p.requirements.loads.iter();
            let worst = loads.map(|load| {
                leg_forces(m, pose, &load.wrench(m, pose), m.size()).map_or(f64::INFINITY, |f| f.amax())
            });
            -worst.fold(0.0, f64::max)
        }),
        Objective::JointSpacing => {
            let nearest = Body::BOTH.map(|body| m.nearest_joints(body).map_or(f64::INFINITY, |n| n.0));
            nearest[0].min(nearest[1])
        }
        Objective::LegClearance => {
            let hardware = Hardware { leg_body: p.requirements.hardware.leg_body, ..Hardware::default() };
            let alone = Requirements { hardware, ..Requirements::default() };
            over(&|pose| {
                let margins = Terms::new(m, &alone, pose).at(pose);
                let own = margins.into_iter().filter(|t| t.0.kind == TermKind::LegClearance);
                own.map(|t| t.1).fold(f64::INFINITY, f64::min)
            })
        }
        Objective::Stroke => {
            let lengths = || poses.iter().flat_map(|pose| m.legs().map(|l| pose.squared_length(&l).sqrt()));
            lengths().fold(0.0, f64::max) - lengths().fold(f64::INFINITY, f64::min)
        }
        Objective::SingularityDistance => {
            let n = Normalisation::of(&p.manipulator);
            let rows: Vec<Vec<f64>> = m.legs().iter().map(|l| leg_vector(&n.apply(l)).to_vec()).collect();
            svd(&rows).map_or(f64::NAN, |d| d.s[5])
        }
    }
}

/// Directions within this angle cosine count as inside; about 1e-7 degrees at 45 degrees.
const SLIP: f64 = 1e-14;

#[derive(Debug, Clone, Copy)]
struct Cap {
    axis: Vector3<f64>,
    cos: f64,
}

impl Cap {
    fn holds(&self, u: &Vector3<f64>) -> bool {
        self.axis.dot(u) >= self.cos - SLIP
    }

    fn of_two(u: &Vector3<f64>, v: &Vector3<f64>) -> Option<Self> {
        let axis = (u + v).try_normalize(1e-9)?;
        Some(Self { axis, cos: axis.dot(u).min(axis.dot(v)) })
    }

    /// The cap whose rim passes through three directions.
    fn of_three(u: &Vector3<f64>, v: &Vector3<f64>, w: &Vector3<f64>) -> Option<Self> {
        let n = (v - u).cross(&(w - u)).try_normalize(1e-300)?;
        let axis = if n.dot(u) < 0.0 { -n } else { n };
        Some(Self { axis, cos: axis.dot(u).min(axis.dot(v)).min(axis.dot(w)) })
    }
}

/// Axis (unit vector) that minimises the greatest angle to the directions, and the cosine of that angle.
///
/// `max_c min_k u_k . c` over `|c| <= 1`. At the optimum two or three directions are on the rim; the incremental
/// algorithm of Welzl (1991) finds them. `None` without directions, or if no open half space contains all.
pub(crate) fn smallest_cap(directions: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    let first = directions.first()?;
    let mut cap = Cap { axis: *first, cos: 1.0 };
    for i in 1..directions.len() {
        if cap.holds(&directions[i]) {
            continue;
        }
        cap = Cap { axis: directions[i], cos: 1.0 };
        for j in 0..i {
            if cap.holds(&directions[j]) {
                continue;
            }
            cap = Cap::of_two(&directions[i], &directions[j])?;
            for k in 0..j {
                if !cap.holds(&directions[k]) {
                    cap = Cap::of_three(&directions[i], &directions[j], &directions[k])?;
                }
            }
        }
    }
    (cap.cos > 0.0 && directions.iter().all(|u| cap.axis.dot(u) >= cap.cos - 1e-9))
        .then_some((cap.axis, cap.cos))
}
