//! Proof that no offsets of a box reach a given worst-case inverse condition number.

use nalgebra::Matrix6;

use super::rows::{LegRow, Quotient, greatest, point};
use crate::num::conic::{ConicAnswer, ConicProgram};

/// Poses that take part in a proof.
const POSES: usize = 20;
/// Poses for which vectors are mixed.
const MIXED: usize = 8;
/// Offsets at which the multipliers are chosen, for each coordinate.
const SAMPLES: u32 = 7;
/// Multipliers below this share of the largest are dropped; any set of multipliers is valid.
const NEGLIGIBLE: f64 = 1e-4;

/// Six ranges of offsets.
pub(crate) type Bounds = [(f64, f64); 6];

/// The poses of the problem as rows in intervals and the singular vectors that bound the singular values.
#[derive(Debug)]
pub(super) struct Pose {
    pub(super) rows: [LegRow; 6],
}

/// Vectors that bound the smallest and the largest singular value, and the quotient of these.
///
/// The first of each is the right singular vector. Where another singular value is near, the eigenvectors turn quickly with the offsets, and one vector
/// bounds to first order only: then the other vector and the two halfway directions are added, so that the
/// multipliers can mix them.
pub(super) struct Direction {
    pub(super) ratio: f64,
    low: Vec<[f64; 6]>,
    high: Vec<[f64; 6]>,
}

/// Singular values within this factor count as near.
const NEAR: f64 = 1.6;

impl Direction {
    /// `None` when the decomposition fails.
    pub(super) fn of(j: &Matrix6<f64>) -> Option<Self> {
        let svd = j.clone_owned().try_svd(false, true, f64::EPSILON, 200)?;
        let v = svd.v_t?;
        let sigma = svd.singular_values;
        let mut order = [0, 1, 2, 3, 4, 5];
        order.sort_by(|&a, &b| sigma[a].total_cmp(&sigma[b]));
        let row = |k: usize| -> [f64; 6] { std::array::from_fn(|c| v[(k, c)]) };
        let ratio = sigma[order[0]] / sigma[order[5]];
        let mixed = |first: usize, second: usize| -> Vec<[f64; 6]> {
            let (x, y) = (row(first), row(second));
            let near = sigma[first].max(sigma[second]) < NEAR * sigma[first].min(sigma[second]);
            if !near {
                return vec![x];
            }
            let halfway = |sign: f64| std::array::from_fn(|c| x[c] + sign * y[c]);
            vec![x, y, halfway(1.0), halfway(-1.0)]
        };
        ratio.is_finite().then(|| Self {
            ratio,
            low: mixed(order[0], order[1]),
            high: mixed(order[5], order[4]),
        })
    }
}

/// What was found out about a box.
#[derive(Debug)]
pub(super) enum Test {
    /// No offsets of the box reach the limit at all poses: proved.
    Excluded,
    /// Not shown; the poses worst in the middle come first, for the parts of the box.
    Kept(Vec<usize>),
}

/// Tries to prove that no offsets in `bounds` have an inverse condition number of `limit` or more at all poses.
///
/// For every pose `k` and all vectors, `sigma_6 <= |J v| / |v|` and `sigma_1 >= |J w| / |w|`. If offsets `t` reached the limit, then
/// `|J_k v_k|^2 / |v_k|^2 - limit^2 |J_k w_k|^2 / |w_k|^2 >= 0` for all `k`. Row `i` of `J_k` depends on `t_i` alone, so for any multipliers
/// `mu_k >= 0` the sum over `k` is a sum of six functions of one offset each, and the box is excluded when their greatest values
/// add up to less than 0. `v_k`, `w_k` are the singular vectors in the middle of the box; the multipliers come from a linear
/// program over samples; both only decide how sharp the proof is.
pub(super) fn test(
    poses: &[Pose],
    candidates: &[usize],
    bounds: &Bounds,
    limit: f64,
    jacobian: &dyn Fn(usize, &[f64; 6]) -> Matrix6<f64>,
) -> Test {
    let middle = bounds.map(|(low, high)| f64::midpoint(low, high));
    let mut found: Vec<(usize, Direction)> =
        candidates.iter().filter_map(|&k| Some((k, Direction::of(&jacobian(k, &middle))?))).collect();
    found.sort_by(|a, b| a.1.ratio.total_cmp(&b.1.ratio).then(a.0.cmp(&b.0)));
    let order: Vec<usize> = found.iter().map(|f| f.0).collect();
    found.truncate(POSES);
    let limit = point(limit).square();
    let mut functions: Vec<[Quotient; 6]> = Vec::new();
    for (place, (k, d)) in found.iter().enumerate() {
        // the first vectors with each of the others; for the worst poses only
        let more = |list: &[[f64; 6]]| if place < MIXED { list.len() } else { 1 };
        let pairs = (0..more(&d.low)).map(|i| (i, 0)).chain((1..more(&d.high)).map(|j| (0, j)));
        for (i, j) in pairs {
            let all: Option<Vec<Quotient>> =
                poses[*k].rows.iter().map(|row| row.excess(&d.low[i], &d.high[j], limit)).collect();
            functions.extend(all.and_then(|all| <[Quotient; 6]>::try_from(all).ok()));
        }
    }
    let samples = sampled(&functions, bounds);
    // one pose alone often suffices
    let alone = |values: &[Vec<f64>; 6]| -> f64 {
        values.iter().map(|v| v.iter().copied().fold(f64::MIN, f64::max)).sum()
    };
    let single = samples.iter().enumerate().map(|(k, s)| (alone(s), k)).min_by(|a, b| a.0.total_cmp(&b.0));
    let proved = |mu: &[f64]| -> bool {
        let sum: f64 = (0..6)
            .map(|i| {
                let terms: Vec<(f64, &Quotient)> =
                    mu.iter().zip(&functions).filter(|(m, _)| **m > 0.0).map(|(m, f)| (*m, &f[i])).collect();
                greatest(&terms, bounds[i]).next_up()
            })
            // each partial sum is rounded upwards
            .fold(0.0, |s, x| (s + x).next_up());
        sum < 0.0
    };
    if let Some((value, k)) = single {
        let mut mu = vec![0.0; functions.len()];
        mu[k] = 1.0;
        if value < 0.0 && proved(&mu) {
            return Test::Excluded;
        }
    }
    match multipliers(&samples) {
        Some(mu) if proved(&mu) => Test::Excluded,
        _ => Test::Kept(order),
    }
}

/// Values of every function at the samples of its offset.
fn sampled(functions: &[[Quotient; 6]], bounds: &Bounds) -> Vec<[Vec<f64>; 6]> {
    let at = |(low, high): (f64, f64), k: u32| low + (high - low) * f64::from(k) / f64::from(SAMPLES - 1);
    let values = |f: &[Quotient; 6]| {
        std::array::from_fn(|i| (0..SAMPLES).map(|k| f[i].estimate(at(bounds[i], k))).collect())
    };
    functions.iter().map(values).collect()
}

/// Multipliers in `[0, 1]` that make the sum of the greatest sampled values least; `None` when it is not negative.
fn multipliers(samples: &[[Vec<f64>; 6]]) -> Option<Vec<f64>> {
    let n = samples.len();
    let mut p = ConicProgram { variables: n + 6, linear: vec![0.0; n + 6], ..Default::default() };
    for i in 0..6 {
        p.linear[n + i] = 1.0;
        for j in 0..SAMPLES as usize {
            let mut row: Vec<(usize, f64)> = (0..n).map(|k| (k, samples[k][i][j])).collect();
            row.push((n + i, -1.0));
            p.at_least_zero(row, 0.0);
        }
    }
    for k in 0..n {
        p.at_least_zero(vec![(k, 1.0)], 1.0);
        p.at_least_zero(vec![(k, -1.0)], 0.0);
    }
    let ConicAnswer::Point(found) = p.solve() else { return None };
    let value: f64 = found.x[n..].iter().sum();
    let largest = found.x[..n].iter().copied().fold(0.0, f64::max);
    if !(value < 0.0 && largest > 0.0) {
        return None;
    }
    Some(found.x[..n].iter().map(|m| if *m < NEGLIGIBLE * largest { 0.0 } else { *m }).collect())
}
