//! The problem ready to be searched: values and linear models of everything at a point.

use std::collections::BTreeMap;

use super::kinematics::{HeldPose, Lines};
use super::merit::{Merit, Piece};
use super::problem::{DimensionalProblem, InvalidProblem, Objective, Variables};
use super::shape::{Ends, Shape};
use super::terms::Terms;
use crate::num::Rng;
use crate::requirements::TermKind;

/// Constraints that share one slack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Group {
    /// Requirements of one kind.
    Term(TermKind),
    /// `|det A|`.
    Determinant,
    /// Joints that slide on families stay near the others.
    Reach,
    /// An objective that must not fall below a value.
    Floor(usize),
}

/// What is wanted in one run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Task {
    /// Weight of each objective; 0 leaves it out.
    pub(crate) weights: Vec<f64>,
    /// Least gain of each objective.
    pub(crate) floors: Vec<Option<f64>>,
    /// Constraints that are not held.
    pub(crate) dropped: Vec<Group>,
    /// Constraints whose violation costs a hundredth.
    pub(crate) soft: Option<Group>,
}

impl Task {
    /// Relative price of a violation.
    pub(crate) fn cost(&self, group: Group) -> f64 {
        if self.soft == Some(group) { 0.01 } else { 1.0 }
    }
}

/// Values at a point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Judged {
    /// Gain of each objective.
    pub(crate) gains: Vec<f64>,
    /// Largest violation of each group (0 when met).
    pub(crate) violations: BTreeMap<Group, f64>,
}

impl Judged {
    pub(crate) fn violation(&self) -> f64 {
        self.violations.values().fold(0.0, |m, v| m.max(*v))
    }

    /// Sum of the largest violations of the groups; soft ones count a hundredth.
    pub(crate) fn total_violation(&self, task: &Task) -> f64 {
        self.violations.iter().map(|(g, v)| task.cost(*g) * v).sum()
    }

    pub(crate) fn gain(&self, task: &Task) -> f64 {
        task.weights.iter().zip(&self.gains).filter(|(w, _)| **w > 0.0).map(|(w, g)| w * g).sum()
    }
}

/// The problem with its parametrisation.
#[derive(Debug)]
pub(crate) struct Model<'a> {
    pub(crate) problem: &'a DimensionalProblem,
    pub(crate) shape: Shape,
    pub(crate) terms: Terms<'a>,
    pub(crate) merit: Merit<'a>,
    pub(crate) objectives: Vec<Objective>,
    /// Constraints are held with this to spare, so that what lies between the poses meets them too.
    pub(crate) backoff: f64,
    pub(crate) affine: bool,
}

/// Points of the Halton sequence, and random ones, in the sample of the mean.
const SAMPLE: usize = 24;
/// Spare relative to the size (or the limit) where poses lie between those that are held, and where none do.
const BACKOFF: (f64, f64) = (1e-6, 2e-8);

impl<'a> Model<'a> {
    pub(crate) fn new(problem: &'a DimensionalProblem) -> Result<Self, InvalidProblem> {
        problem.validate()?;
        let variables = Variables { joint_axes: problem.axes_wanted(), ..problem.variables };
        let (m, home) = (&problem.manipulator, problem.space.home);
        let shape = Shape::new(m, &home, &variables)?;
        for (name, (low, high)) in shape.names.iter().zip(&shape.bounds) {
            if !(low <= high && low.is_finite() && high.is_finite()) {
                return Err(InvalidProblem::Bounds { variable: name.clone(), low: *low, high: *high });
            }
        }
        let mut sample = listed(problem);
        let points = problem.space.cube_points(SAMPLE, &mut Rng::new(1));
        sample.extend(points.iter().map(|x| HeldPose { pose: problem.space.pose(x), follows: true }));
        let continuous = !problem.space.axes().is_empty() || problem.space.trajectory.len() > 1;
        Ok(Self {
            problem,
            terms: Terms::new(&problem.requirements, m.size(), home, &shape),
            merit: Merit::new(problem, sample),
            objectives: problem.objectives.iter().map(|o| o.0).collect(),
            backoff: if continuous { BACKOFF.0 } else { BACKOFF.1 },
            affine: shape.is_affine(),
            shape,
        })
    }

    /// The poses that every run starts with: home, corners, and those that are listed.
    pub(crate) fn first_poses(&self) -> Vec<HeldPose> {
        let mut out = listed(self.problem);
        let points = self.problem.space.cube_points(0, &mut Rng::new(1));
        out.extend(points.iter().map(|x| HeldPose { pose: self.problem.space.pose(x), follows: true }));
        out
    }

    /// Factor from the gain of an objective to its value.
    pub(crate) fn unit(&self, o: Objective) -> f64 {
        self.merit.unit(o, self.problem.requirements.hardware.leg_stiffness.unwrap_or(1.0))
    }

    pub(crate) fn wanted<'b>(&'b self, task: &'b Task) -> impl Iterator<Item = (usize, Objective)> + 'b {
        let used = |m: &usize| task.weights[*m] > 0.0 || task.floors[*m].is_some();
        (0..self.objectives.len()).filter(used).map(|m| (m, self.objectives[m]))
    }

    /// `sign det A` less the least value, and its gradient, where the variables keep the class of the design.
    pub(crate) fn determinant(&self, x: &[f64], sign: f64) -> Option<(f64, Vec<f64>)> {
        let (det, gradient) = self.shape.determinant(x)?;
        Some((sign * det - self.problem.min_abs_det, gradient.into_iter().map(|g| sign * g).collect()))
    }

    /// Sign of `det A` at a point.
    pub(crate) fn sign(&self, x: &[f64]) -> f64 {
        self.shape.determinant(x).map_or(1.0, |(det, _)| if det < 0.0 { -1.0 } else { 1.0 })
    }

    /// Values at a point over the poses.
    pub(crate) fn judge(&self, poses: &[HeldPose], x: &[f64], task: &Task, sign: f64) -> Judged {
        let ends = self.shape.ends(x);
        let mut violations: BTreeMap<Group, f64> = BTreeMap::new();
        let mut hold = |group: Group, value: f64| {
            if !task.dropped.contains(&group) {
                let worst = violations.entry(group).or_insert(0.0);
                let miss = self.backoff - value;
                *worst = if miss.is_nan() { f64::INFINITY } else { worst.max(miss) };
            }
        };
        let mut gains = vec![f64::INFINITY; self.objectives.len()];
        let mut lengths = (f64::INFINITY, f64::NEG_INFINITY);
        for at in poses {
            let l = Lines::new(&ends, at);
            self.terms.visit(&l, &ends, x, &mut |item| hold(Group::Term(item.id.0), item.value));
            for (m, o) in self.wanted(task).filter(|(_, o)| Merit::is_over_poses(*o)) {
                gains[m] = gains[m].min(self.merit.at_pose(o, &self.terms, &l));
            }
            lengths = l.length.iter().fold(lengths, |r, x| (r.0.min(*x), r.1.max(*x)));
        }
        self.terms.fixed(&ends, &mut |item| hold(Group::Term(item.id.0), item.value));
        if let Some((value, _)) = self.determinant(x, sign) {
            hold(Group::Determinant, value);
        }
        for (_, _, value, _) in self.shape.rooms(&ends) {
            hold(Group::Reach, value);
        }
        for (m, o) in self.wanted(task).filter(|(_, o)| !Merit::is_over_poses(*o)) {
            gains[m] = self.gain_without_pose(o, &ends, lengths);
        }
        for (m, floor) in task.floors.iter().enumerate() {
            if let Some(floor) = floor {
                hold(Group::Floor(m), gains[m] - floor + self.backoff);
            }
        }
        Judged { gains, violations }
    }

    fn gain_without_pose(&self, o: Objective, ends: &Ends, lengths: (f64, f64)) -> f64 {
        match o {
            Objective::Stroke => (lengths.0 - lengths.1) / self.terms.size,
            Objective::MeanConditioning => {
                let all = self.merit.sample.iter();
                let sum: f64 = all
                    .map(|at| {
                        self.merit.at_pose(Objective::WorstConditioning, &self.terms, &Lines::new(ends, at))
                    })
                    .sum();
                sum / self.merit.sample.len() as f64
            }
            _ => {
                let mut least = f64::INFINITY;
                self.merit.pieces_fixed(o, &self.terms, ends, &mut |p| {
                    if let Piece::Linear(value, _) = p {
                        least = least.min(value);
                    }
                });
                least
            }
        }
    }
}

fn listed(problem: &DimensionalProblem) -> Vec<HeldPose> {
    problem.listed().into_iter().map(|pose| HeldPose { pose, follows: false }).collect()
}
