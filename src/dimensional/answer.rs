//! A refined run as an answer.

use nalgebra::{Unit, Vector3};

use super::cap::smallest_cap;
use super::kinematics::Lines;
use super::model::{Model, Task};
use super::outcome::{DimensionalOutcome, DimensionalSolution};
use super::search::Refined;
use crate::geom::Pose;

/// Sizes of the stationarity that count as none.
const STATIONARY: f64 = 1e-3;

/// The first of the refined runs as an answer.
pub(crate) fn outcome(model: &Model<'_>, task: &Task, refined: &Refined) -> DimensionalOutcome {
    let Some(solution) = solution(model, task, refined) else { return DimensionalOutcome::Undecided(None) };
    let settled = refined.run.converged || refined.run.stationarity.abs() < STATIONARY;
    if settled && refined.complete {
        DimensionalOutcome::Optimal(Box::new(solution))
    } else {
        DimensionalOutcome::NotConverged(Box::new(solution))
    }
}

fn solution(model: &Model<'_>, task: &Task, refined: &Refined) -> Option<DimensionalSolution> {
    let x = &refined.run.x;
    let manipulator = model.shape.manipulator(x).ok()?;
    let home = model.terms.home;
    let lift = model.shape.ends(x).lift;
    let lifted = |pose: &Pose| Pose { position: pose.position + lift, ..*pose };
    let held = refined.poses.iter().map(|at| if at.follows { lifted(&at.pose) } else { at.pose });
    let named = model.shape.free().into_iter().map(|j| (model.shape.names[j].clone(), x[j]));
    // every objective is reported, the ones left out of the last level too
    let all = Task { weights: vec![1.0; task.weights.len()], ..task.clone() };
    let gains = model.judge(&refined.poses, x, &all, model.sign(x)).gains;
    let objectives = model.objectives.iter().zip(gains).map(|(o, g)| (*o, g * model.unit(*o))).collect();
    Some(DimensionalSolution {
        manipulator,
        home: lifted(&home),
        axes: axes(model, refined),
        variables: named.collect(),
        point: x.clone(),
        offsets: model.shape.offsets(x),
        objectives,
        stationarity: refined.run.stationarity,
        poses: held.collect(),
        history: refined.run.history.clone(),
    })
}

/// The axis with the smallest cap for every joint, over the held poses and a sample of the region.
fn axes(model: &Model<'_>, refined: &Refined) -> [Option<[Unit<Vector3<f64>>; 6]>; 2] {
    let ends = model.shape.ends(&refined.run.x);
    let all: Vec<Lines> =
        refined.poses.iter().chain(&model.merit.sample).map(|at| Lines::new(&ends, at)).collect();
    [0, 1].map(|body| {
        let first = model.shape.axes[body]?;
        Some(std::array::from_fn(|i| {
            let seen =
                |l: &Lines| if body == 0 { l.direction[i] } else { l.rotation.inverse() * l.direction[i] };
            let directions: Vec<Vector3<f64>> = all.iter().map(seen).collect();
            let own = || Vector3::from_fn(|k, _| refined.run.x[first + 3 * i + k]);
            Unit::new_normalize(smallest_cap(&directions).map_or_else(own, |cap| cap.0))
        }))
    })
}
