//! Derivative-free search around a solution: evidence that does not use the conic solver or any derivative.

use super::branch::Cell;
use super::conditioning::worst_case_above;
use super::problem::Model;
use super::subproblem::violation;
use crate::num::Rng;

/// Result of the search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Polished {
    pub(crate) t: [f64; 6],
    pub(crate) value: f64,
    pub(crate) trials: usize,
}

/// Tries steps along the axes, along pairs of axes and in random directions, at radii from 1e-2 down to 1e-6
/// (offset units); steps are cut off at the box, points that violate a constraint are dropped.
pub(crate) fn pattern_search(m: &Model, cell: &Cell, start: [f64; 6], value: f64, rng: &mut Rng) -> Polished {
    let mut best = Polished { t: start, value, trials: 0 };
    let mut hint = 0;
    for step in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        for k in 0..132 {
            let direction = direction(k, rng);
            let t: [f64; 6] = std::array::from_fn(|i| {
                let (low, high) = cell.bounds[i];
                (best.t[i] + step * direction[i]).clamp(low, high)
            });
            best.trials += 1;
            if violation(m, cell, &t) > 0.0 {
                continue;
            }
            match worst_case_above(&m.poses, &t, best.value, hint) {
                Ok((value, _)) => (best.t, best.value) = (t, value),
                Err((_, pose)) => hint = pose,
            }
        }
    }
    best
}

/// 12 axis directions, 60 along two axes, then random ones.
fn direction(k: usize, rng: &mut Rng) -> [f64; 6] {
    let sign = |bit: bool| if bit { 1.0 } else { -1.0 };
    let mut d = [0.0; 6];
    if k < 12 {
        d[k / 2] = sign(k.is_multiple_of(2));
    } else if k < 72 {
        let (pair, signs) = ((k - 12) / 4, (k - 12) % 4);
        let (i, j) = (1..6).flat_map(|i| (0..i).map(move |j| (i, j))).nth(pair).unwrap_or((1, 0));
        (d[i], d[j]) = (sign(signs & 1 == 0), sign(signs & 2 == 0));
    } else {
        d = std::array::from_fn(|_| rng.normal());
    }
    d
}
