//! Proof that no offsets of a box reach a given worst-case inverse condition number.

use nalgebra::Matrix6;

use super::corners::{self, AtCorners, at_corners};
use super::multipliers::{SAMPLES, Sampled, multipliers};
use super::rows::{LegRow, Quotient, greatest};
use crate::offsets::conditioning::PoseLegs;
use crate::offsets::enclosure::point;
use crate::offsets::limits::Bounds;

/// Attempts at a proof: poses that are looked at, those of them that take part, those for which vectors are mixed, and those that take part with
/// determinants. Most boxes need the first only, which costs little.
const ATTEMPTS: [(usize, usize, usize, usize); 2] = [(10, 6, 3, 8), (usize::MAX, 30, 20, 14)];

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

/// A function that is not negative at offsets which reach the limit: pose and the two vectors.
struct Function<'a> {
    pose: usize,
    low: &'a [f64; 6],
    high: &'a [f64; 6],
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
    plain: &[PoseLegs],
    candidates: &[usize],
    bounds: &Bounds,
    limit: f64,
) -> Test {
    let middle = bounds.map(|(low, high)| f64::midpoint(low, high));
    let mut found: Vec<(usize, Direction)> = Vec::new();
    let mut seen = 0;
    for (looked_at, taking_part, mixed, at_all_corners) in ATTEMPTS {
        let more = &candidates[seen..candidates.len().min(looked_at)];
        seen += more.len();
        found.extend(more.iter().filter_map(|&k| Some((k, Direction::of(&plain[k].jacobian(&middle))?))));
        found.sort_by(|a, b| a.1.ratio.total_cmp(&b.1.ratio).then(a.0.cmp(&b.0)));
        if excluded(poses, &found[..found.len().min(taking_part)], mixed, bounds, limit) {
            return Test::Excluded;
        }
        let function = |(k, _): &(usize, Direction)| at_corners(&poses[*k].rows, &plain[*k], bounds, limit);
        let functions: Vec<AtCorners> =
            found[..found.len().min(at_all_corners)].iter().filter_map(function).collect();
        if corners::excluded(&functions) {
            return Test::Excluded;
        }
    }
    Test::Kept(found.into_iter().map(|f| f.0).collect())
}

/// One attempt with these poses, worst first.
fn excluded(poses: &[Pose], found: &[(usize, Direction)], mixed: usize, bounds: &Bounds, limit: f64) -> bool {
    let mut functions: Vec<Function<'_>> = Vec::new();
    for (place, (pose, d)) in found.iter().enumerate() {
        // the first vectors with each of the others; for the worst poses only
        let more = |list: &[[f64; 6]]| if place < mixed { list.len() } else { 1 };
        let pairs = (0..more(&d.low)).map(|i| (i, 0)).chain((1..more(&d.high)).map(|j| (0, j)));
        functions.extend(pairs.map(|(i, j)| Function { pose: *pose, low: &d.low[i], high: &d.high[j] }));
    }
    let samples = sampled(poses, &functions, bounds, limit * limit);
    // one function alone often suffices
    let alone = |s: &Sampled| -> f64 { s.iter().map(|v| v.iter().copied().fold(f64::MIN, f64::max)).sum() };
    let single = samples.iter().map(alone).zip(0..).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((value, k)) = single
        && value < 0.0
        && proved(poses, &[(1.0, &functions[k])], bounds, limit)
    {
        return true;
    }
    multipliers(&samples).is_some_and(|mu| {
        let terms: Vec<(f64, &Function<'_>)> =
            mu.into_iter().zip(&functions).filter(|(m, _)| *m > 0.0).collect();
        proved(poses, &terms, bounds, limit)
    })
}

/// In intervals: the greatest values of the sum of the functions with their multipliers add up to less than 0.
fn proved(poses: &[Pose], terms: &[(f64, &Function<'_>)], bounds: &Bounds, limit: f64) -> bool {
    let limit = point(limit).square();
    let greatest_of = |i: usize| -> f64 {
        let quotient = |(mu, f): &(f64, &Function<'_>)| -> Option<(f64, Quotient)> {
            Some((*mu, poses[f.pose].rows[i].excess(f.low, f.high, limit)?))
        };
        let all: Option<Vec<(f64, Quotient)>> = terms.iter().map(quotient).collect();
        all.map_or(f64::INFINITY, |all| greatest(&all, bounds[i]))
    };
    // each partial sum is rounded upwards
    (0..6).map(greatest_of).fold(0.0, |s, x| (s + x.next_up()).next_up()) < 0.0
}

/// Values of every function at the samples of its offsets, in plain arithmetic.
fn sampled(poses: &[Pose], functions: &[Function<'_>], bounds: &Bounds, limit: f64) -> Vec<Sampled> {
    let norm = |v: &[f64; 6]| v.iter().map(|x| x * x).sum::<f64>();
    let last = (SAMPLES - 1) as f64;
    let values = |f: &Function<'_>| -> Sampled {
        let (low, high) = (1.0 / norm(f.low), limit / norm(f.high));
        std::array::from_fn(|i| {
            let row = poses[f.pose].rows[i].plain();
            let ((a, b), (c, d)) = (row.along(f.low), row.along(f.high));
            let range = bounds[i];
            std::array::from_fn(|k| {
                let t = range.0 + (range.1 - range.0) * (k as f64 / last);
                let (v, w) = (a + t * b, c + t * d);
                (low * v * v - high * w * w) / row.square_at(t)
            })
        })
    };
    functions.iter().map(values).collect()
}
