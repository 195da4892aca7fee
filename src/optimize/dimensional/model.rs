//! The problem prepared for the search: values and linear models at a point.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::leg_lines::HeldPose;
use super::merit::Merit;
use super::problem::{DimensionalProblem, InvalidProblem, Variables};
use super::shape::Shape;
use super::terms::RequirementTerms;
use super::worst_pose::PointJudging;
use crate::climb::{Climbable, Effort, Linearised, PointValues, Run, Task, climb};
use machine::requirements::Objective;
use num::Rng;
use num::conic::ConicTally;

/// The problem with its parametrisation.
#[derive(Debug)]
pub(crate) struct Model<'a> {
    pub problem: &'a DimensionalProblem,
    pub shape: Shape,
    pub terms: RequirementTerms<'a>,
    pub merit: Merit<'a>,
    pub objectives: Vec<Objective>,
    /// Margin with which constraints are held, so that poses in between meet them too.
    pub(crate) backoff: f64,
    pub affine: bool,
    /// Counts the conic programs of the search.
    pub conic: ConicTally,
    /// Set to stop the search with its current result.
    stop: Arc<AtomicBool>,
}

/// Points of the Halton sequence, and random ones, in the sample of the mean.
const SAMPLE: usize = 24;
/// Seed of these poses: they are part of the problem and equal for every seed of the search.
const AVERAGED: u64 = 1;
/// Number of intermediate points, of either kind, at the start of every run.
const BETWEEN: usize = 12;
/// Seed of these points, equal for every seed of the search.
const BETWEEN_CORNERS: u64 = 2;
/// Margin relative to the size (or the limit): with poses between the held ones, and without.
const BACKOFF: (f64, f64) = (1e-6, 2e-8);

impl<'a> Model<'a> {
    pub(super) fn new(problem: &'a DimensionalProblem) -> Result<Self, InvalidProblem> {
        problem.validate()?;
        Self::with_axes(problem, problem.axes_wanted())
    }

    /// The model with axes along the legs at home in place of chosen ones, which are the last variables. `None` if no
    /// axes or only axes are chosen. A point that meets the requirements here also does so with chosen axes.
    pub(crate) fn without_axes(&self) -> Option<Self> {
        if self.shape.axes == [None; 2] {
            return None;
        }
        let out = Self::with_axes(self.problem, [false; 2]).ok()?;
        Some(Self { stop: Arc::clone(&self.stop), conic: self.conic.clone(), ..out })
    }

    fn with_axes(problem: &'a DimensionalProblem, joint_axes: [bool; 2]) -> Result<Self, InvalidProblem> {
        let variables = Variables { joint_axes, ..problem.variables };
        let (m, home) = (&problem.manipulator, problem.space.home);
        let shape = Shape::new(m, &home, &variables)?;
        for (name, (low, high)) in shape.names.iter().zip(&shape.bounds) {
            if !(low <= high && low.is_finite() && high.is_finite()) {
                return Err(InvalidProblem::Bounds { variable: name.clone(), low: *low, high: *high });
            }
        }
        let mut sample = listed(problem);
        let points = problem.space.cube_points(SAMPLE, &mut Rng::new(AVERAGED));
        sample.extend(points.iter().map(|x| HeldPose { pose: problem.space.pose(x), follows: true }));
        let continuous = !problem.space.axes().is_empty()
            || problem.space.trajectory.len() > 1
            || problem.space.ranges_alone().next().is_some();
        Ok(Self {
            problem,
            terms: RequirementTerms::new(&problem.requirements, m.size(), home, &shape),
            merit: Merit::new(problem, sample),
            objectives: problem.objectives.iter().map(|o| o.0).collect(),
            backoff: if continuous { BACKOFF.0 } else { BACKOFF.1 },
            affine: shape.is_affine(),
            shape,
            conic: ConicTally::default(),
            stop: Arc::default(),
        })
    }

    /// Stops the search on request.
    pub(crate) fn heed(&self, flow: ControlFlow<()>) {
        if flow.is_break() {
            self.stop.store(true, Ordering::Relaxed);
        }
    }

    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// The initial poses of every run: home, corners, the ends of the axes, a few points in between, and the listed
    /// poses.
    pub(crate) fn first_poses(&self) -> Vec<HeldPose> {
        let (mut out, space) = (listed(self.problem), &self.problem.space);
        let mut points = space.cube_points(BETWEEN, &mut Rng::new(BETWEEN_CORNERS));
        for (k, sign) in space.axes().into_iter().flat_map(|k| [(k, 1.0), (k, -1.0)]) {
            let mut x = nalgebra::Vector6::zeros();
            x[k] = sign;
            points.push(x);
        }
        out.extend(points.iter().map(|x| HeldPose { pose: space.pose(x), follows: true }));
        out
    }

    /// Factor from the gain of an objective to its value.
    pub(super) fn unit(&self, o: Objective) -> f64 {
        self.merit.unit(o, self.problem.requirements.hardware.leg_stiffness.unwrap_or(1.0))
    }

    pub(super) fn wanted<'b>(&'b self, task: &'b Task) -> impl Iterator<Item = (usize, Objective)> + 'b {
        let used = |m: &usize| task.weights[*m] > 0.0 || task.floors[*m].is_some();
        (0..self.objectives.len()).filter(used).map(|m| (m, self.objectives[m]))
    }

    /// `sign det A` minus the least value, and its gradient, if the variables keep the class of the design.
    pub(super) fn determinant(&self, x: &[f64], sign: f64) -> Option<(f64, Vec<f64>)> {
        let (det, gradient) = self.shape.determinant(x)?;
        Some((sign * det - self.problem.min_abs_det, gradient.into_iter().map(|g| sign * g).collect()))
    }

    /// Sign of `det A` at a point.
    pub(super) fn sign(&self, x: &[f64]) -> f64 {
        self.shape.determinant(x).map_or(1.0, |(det, _)| if det < 0.0 { -1.0 } else { 1.0 })
    }
}

/// A model with a task at the held poses.
struct HeldTask<'h, 'a> {
    model: &'h Model<'a>,
    poses: &'h [HeldPose],
    task: &'h Task,
    /// Kept sign of `det A`.
    sign: f64,
}

impl Climbable for HeldTask<'_, '_> {
    fn task(&self) -> &Task {
        self.task
    }

    fn bounds(&self) -> &[(f64, f64)] {
        &self.model.shape.bounds
    }

    fn conic(&self) -> &ConicTally {
        &self.model.conic
    }

    /// The joint axes: shorter vectors only make the limits harder to meet.
    fn unit_vectors(&self) -> Vec<usize> {
        let axes = self.model.shape.axes.iter().flatten();
        axes.flat_map(|first| (0..6).map(move |leg| first + 3 * leg)).collect()
    }

    fn backoff(&self) -> f64 {
        self.model.backoff
    }

    fn poses(&self) -> usize {
        self.poses.len()
    }

    fn judge(&self, x: &[f64], refused: &dyn Fn(&PointValues) -> bool) -> PointValues {
        let mut judging = PointJudging::new(self.model, x, self.task, self.sign);
        for at in self.poses {
            if refused(&judging.so_far) {
                return judging.so_far;
            }
            judging.pose(at);
        }
        judging.finish()
    }

    fn linearise(&self, x: &[f64], radius: f64) -> Option<Linearised> {
        self.model.linearise(self.poses, x, self.task, self.sign, radius)
    }

    fn is_stopped(&self) -> bool {
        self.model.is_stopped()
    }
}

impl Model<'_> {
    /// Climbs from a point and keeps its sign of `det A`.
    pub(super) fn climb(&self, poses: &[HeldPose], task: &Task, start: &[f64], effort: Effort) -> Run {
        climb(&HeldTask { model: self, poses, task, sign: self.sign(start) }, start, effort)
    }

    /// Values at a point over the poses.
    pub(super) fn judge(&self, poses: &[HeldPose], x: &[f64], task: &Task, sign: f64) -> PointValues {
        HeldTask { model: self, poses, task, sign }.judge(x, &|_| false)
    }
}

fn listed(problem: &DimensionalProblem) -> Vec<HeldPose> {
    let listed = problem.listed().into_iter().map(|(pose, follows)| HeldPose { pose, follows });
    listed.collect()
}
