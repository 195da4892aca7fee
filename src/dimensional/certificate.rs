//! Proof that convex requirements exclude each other.

use super::kinematics::HeldPose;
use super::model::{Group, Model, Task};
use crate::num::conic::{ConicAnswer, ConicProgram, Row};

/// Radius within which all bounded variables lie around any point.
const EVERYWHERE: f64 = 100.0;

/// `true` when no values of the variables within their bounds meet the requirements of `groups` at these poses, by a certificate that is
/// checked in plain arithmetic.
///
/// Only where every one of them is a cone that is exact far from the point: greatest lengths and swing with given axes, the lines affine in the
/// variables. `false` means that nothing is proved.
pub(crate) fn proved_empty(
    model: &Model<'_>,
    poses: &[HeldPose],
    x: &[f64],
    groups: &[Group],
    task: &Task,
) -> bool {
    let Some(all) = model.linearise(poses, x, task, model.sign(x), EVERYWHERE) else { return false };
    let own = all.items.iter().filter(|i| groups.contains(&i.group));
    let n = x.len();
    let mut p = ConicProgram { variables: n, linear: vec![0.0; n], ..Default::default() };
    let mut reach: f64 = 0.0;
    for (j, (low, high)) in model.shape.bounds.iter().enumerate() {
        p.at_least_zero(vec![(j, 1.0)], high - x[j]);
        p.at_least_zero(vec![(j, -1.0)], x[j] - low);
        reach = reach.max((high - x[j]).abs()).max((x[j] - low).abs());
    }
    for item in own {
        let Some(cone) = &item.cone else { return false };
        let row = |(value, gradient): &(f64, Vec<f64>), spare: f64| Row {
            coefficients: gradient.iter().enumerate().map(|(j, g)| (j, -g)).collect(),
            rhs: value + spare,
        };
        // what is proved is about the requirement itself, without the spare
        let head = row(&cone.head, model.backoff * cone.slack);
        p.second_order(std::iter::once(head).chain(cone.tail.iter().map(|t| row(t, 0.0))).collect());
    }
    match p.solve() {
        ConicAnswer::Infeasible(ray) => p.farkas_strength(&ray, reach).is_some(),
        _ => false,
    }
}
