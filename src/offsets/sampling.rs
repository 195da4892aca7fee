//! Starting points of a cell.

use super::branch::Cell;
use super::conditioning::worst_case_above;
use super::hexagon::offset_determinant;
use super::problem::{Model, OffsetProblem};
use super::subproblem::violation;
use crate::num::Rng;

/// A feasible point with its worst case.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) t: [f64; 6],
    pub(crate) value: f64,
}

fn draw(cell: &Cell, rng: &mut Rng) -> [f64; 6] {
    cell.bounds.map(|(low, high)| rng.uniform(low, high).min(high))
}

pub(crate) fn in_order(cell: &Cell, t: &[f64; 6]) -> bool {
    cell.order_rows().iter().all(|&(i, j, [c, x, y])| c + x * t[i] + y * t[j] >= 0.0)
}

/// `true` for a point of the cell that meets all limits.
pub(crate) fn is_feasible(m: &Model, cell: &Cell, t: &[f64; 6]) -> bool {
    in_order(cell, t) && violation(m, cell, t) <= 0.0
}

/// The best of `wanted` feasible points among at most `draws` uniform ones.
pub(crate) fn best_sample(
    m: &Model,
    cell: &Cell,
    rng: &mut Rng,
    wanted: usize,
    draws: usize,
) -> Option<Sample> {
    let mut best: Option<Sample> = None;
    let mut hint = 0;
    for t in feasible_points(m, cell, rng, wanted, draws) {
        // -1: the first sample is kept whatever its value
        let floor = best.map_or(-1.0, |b| b.value);
        match worst_case_above(&m.poses, &t, floor, hint) {
            Ok((value, pose)) => {
                hint = pose;
                best = Some(Sample { t, value });
            }
            Err((_, pose)) => hint = pose,
        }
    }
    best
}

/// At most `wanted` feasible points among `draws` uniform ones.
pub(crate) fn feasible_points(
    m: &Model,
    cell: &Cell,
    rng: &mut Rng,
    wanted: usize,
    draws: usize,
) -> Vec<[f64; 6]> {
    (0..draws).map(|_| draw(cell, rng)).filter(|t| is_feasible(m, cell, t)).take(wanted).collect()
}

/// Distances from the corners of a box at which feasible offsets are looked for, in units of the last place of an offset.
const NUDGES: [f64; 5] = [0.0, 1.0, 4.0, 16.0, 64.0];

/// Offsets that meet all limits in exact arithmetic though nothing may be left to spare: where a restoration ended, or at a corner of the box.
pub(crate) fn tight_point(problem: &OffsetProblem, cell: &Cell, restored: &[f64; 6]) -> Option<[f64; 6]> {
    let corner = |k: usize, nudge: f64| -> [f64; 6] {
        std::array::from_fn(|i| {
            let (low, high) = cell.outer[i];
            let inwards = |end: f64, other: f64| {
                (end + (other - end).signum() * nudge * f64::EPSILON * end.abs()).clamp(low, high)
            };
            if k >> i & 1 == 0 { inwards(low, high) } else { inwards(high, low) }
        })
    };
    // saves most of the exact arithmetic
    let may_do = |t: &[f64; 6]| cell.sign * offset_determinant(t) > problem.min_abs_det * (1.0 - 1e-6);
    let corners = (0..64).flat_map(|k| NUDGES.map(|nudge| corner(k, nudge)));
    std::iter::once(*restored)
        .chain(corners.filter(may_do))
        .find(|t| problem.margins(t).is_some_and(|m| m.all_met()))
}

/// Where the search for a feasible point starts when sampling finds none: the box vertex with the greatest
/// `sign det A`, pulled slightly inwards.
pub(crate) fn hopeful_point(cell: &Cell) -> [f64; 6] {
    let corner = |k: usize| -> [f64; 6] {
        std::array::from_fn(|i| {
            let (low, high) = cell.bounds[i];
            let share = if k >> i & 1 == 0 { 0.02 } else { 0.98 };
            low + share * (high - low)
        })
    };
    let score = |t: &[f64; 6]| cell.sign * offset_determinant(t);
    let ordered = |t: &[f64; 6]| in_order(cell, t);
    let all: Vec<[f64; 6]> = (0..64).map(corner).collect();
    let better = |a: [f64; 6], b: &[f64; 6]| {
        let (ka, kb) = ((ordered(&a), score(&a)), (ordered(b), score(b)));
        if kb.0.cmp(&ka.0).then(kb.1.total_cmp(&ka.1)).is_gt() { *b } else { a }
    };
    all.iter().skip(1).fold(all[0], better)
}
