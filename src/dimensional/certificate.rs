//! Proof that convex requirements exclude each other.

use super::kinematics::HeldPose;
use super::model::{Group, Model, Task};
use crate::num::conic::{Cone, ConicAnswer, ConicProgram, Row};
use crate::num::farkas::{EnclosedRow, refuted};
use crate::num::interval::Interval;

/// Radius within which all bounded variables lie around any point.
const EVERYWHERE: f64 = 100.0;

/// What rounding can cost a coefficient, relative to the largest length that takes part in it. Every coefficient is a sum of at most a few dozen products and
/// quotients of the data, each of which costs less than `2^-52` of the largest of them: this leaves room for four thousand.
const ROUNDING: f64 = 1.0 / (1u64 << 40) as f64;

/// An interval that holds the coefficient whatever rounding did to it.
fn enclosed(x: f64, scale: f64) -> Interval {
    Interval::new((x - ROUNDING * scale).next_down(), (x + ROUNDING * scale).next_up())
        .unwrap_or(Interval::WHOLE)
}

/// `true` when no values of the variables within their bounds meet the requirements of `groups` at these poses, by a certificate that is
/// judged in intervals.
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
    // what the lines are made of, in the unit of the rows
    let ends = model.shape.ends(x);
    let positions = poses.iter().map(|p| p.pose.position.amax()).fold(ends.lift.amax(), f64::max);
    let coordinates =
        ends.base.iter().chain(&ends.platform).map(nalgebra::Matrix::amax).fold(positions, f64::max);
    let mut p = ConicProgram { variables: n, linear: vec![0.0; n], ..Default::default() };
    let mut rows: Vec<EnclosedRow> = Vec::new();
    for item in own {
        let Some(cone) = &item.cone else { return false };
        let row = |(value, gradient): &(f64, Vec<f64>), spare: f64| Row {
            coefficients: gradient.iter().enumerate().map(|(j, g)| (j, -g)).collect(),
            rhs: value + spare,
        };
        // what is proved is about the requirement itself, without the spare
        let head = row(&cone.head, model.backoff * cone.slack);
        let block: Vec<Row> = std::iter::once(head).chain(cone.tail.iter().map(|t| row(t, 0.0))).collect();
        let rates = block.iter().flat_map(|r| &r.coefficients).map(|c| c.1.abs()).fold(0.0, f64::max);
        let largest = block.iter().map(|r| r.rhs.abs()).fold(rates, f64::max);
        let scale = (coordinates / model.terms.size + largest + 1.0) * cone.slack.abs().max(1.0);
        rows.extend(block.iter().map(|r| EnclosedRow {
            coefficients: r.coefficients.iter().map(|(j, a)| (*j, enclosed(*a, scale))).collect(),
            rhs: enclosed(r.rhs, scale),
        }));
        p.second_order(block);
    }
    let cones: Vec<Cone> = p.cones.clone();
    let mut ranges = Vec::new();
    for (j, (low, high)) in model.shape.bounds.iter().enumerate() {
        p.at_least_zero(vec![(j, 1.0)], high - x[j]);
        p.at_least_zero(vec![(j, -1.0)], x[j] - low);
        ranges.push(
            Interval::new((low - x[j]).next_down(), (high - x[j]).next_up()).unwrap_or(Interval::WHOLE),
        );
    }
    match p.solve() {
        // the ranges of the variables take part as they are, without multipliers
        ConicAnswer::Infeasible(ray) => {
            ray.get(..rows.len()).is_some_and(|ray| refuted(&rows, &cones, ray, &ranges).is_some())
        }
        _ => false,
    }
}
