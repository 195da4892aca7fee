//! Functions that are affine in every offset: determinants, whose greatest values on a box are at its corners.
//!
//! With rows `N_i(t_i)` (direction and moment of leg `i`, not divided by its length `l_i`) affine in `t_i`, `J = diag(1 / l_i) N`. For any vectors `x`, `y` by Cramer's rule
//!
//! ```text
//! y^T J^-1 x = (1 / det N) sum_i x_i l_i(t_i) C_i,      C_i = det N with row i replaced by y,
//! ```
//!
//! and `|y^T J^-1 x| <= |x| |y| / sigma_6`. So offsets that reach the limit `g`, where `det N` is not zero, satisfy for either sign
//!
//! ```text
//! |x| |y| |det N| - g sigma_1 (+-) sum_i x_i l_i C_i >= 0.
//! ```
//!
//! `det N` and `C_i` are affine in every offset; `l_i` is convex: its chord minus at most the greatest distance from it; `sigma_1` is at least a number on the box. `|det N|` is convex
//! in every offset alone and hence nowhere above the function that is affine in every offset and agrees with it at the corners. What results is affine in
//! every offset, and so is every combination with multipliers: its greatest value is at one of the 64 corners, however the functions share offsets.

use nalgebra::Matrix6;

use super::ball::{Ball, dot};
use super::multipliers::game;
use super::rows::LegRow;
use crate::num::small::bounded_svd;
use crate::offsets::conditioning::PoseLegs;
use crate::offsets::limits::OffsetRanges;

/// Corners of a box; bit `i` of the number tells the end of offset `i`.
pub(super) const CORNERS: usize = 64;

/// Values at the corners of a function that is affine in every offset, and not below 0 at offsets which reach the limit.
pub(super) type AtCorners = [Ball; CORNERS];

/// Vectors in the middle of the box.
struct Vectors {
    x: [f64; 6],
    y: [f64; 6],
    z: [f64; 6],
    w: [f64; 6],
}

impl Vectors {
    /// Singular vectors of the least and of the greatest singular value; `None` when the decomposition fails.
    fn of(j: &Matrix6<f64>) -> Option<Self> {
        let svd = bounded_svd(j)?;
        let (u, v_t) = (svd.u?, svd.v_t?);
        let sigma = svd.singular_values;
        let (least, greatest) = (sigma.imin(), sigma.imax());
        let left = |k: usize| -> [f64; 6] { std::array::from_fn(|c| u[(c, k)]) };
        let right = |k: usize| -> [f64; 6] { std::array::from_fn(|c| v_t[(k, c)]) };
        let out = Self { x: left(least), y: right(least), z: left(greatest), w: right(greatest) };
        let finite = [&out.x, &out.y, &out.z, &out.w].into_iter().flatten().all(|x| x.is_finite());
        finite.then_some(out)
    }
}

/// Three columns.
type Triple = [usize; 3];

/// All twenty sets of three columns with those that are left and the sign of the expansion by the first three rows.
fn triples() -> [(Triple, Triple, bool); 20] {
    let mut out = [([0; 3], [0; 3], false); 20];
    let mut count = 0;
    for a in 0..6 {
        for b in a + 1..6 {
            for c in b + 1..6 {
                let mut rest = (0..6).filter(|k| ![a, b, c].contains(k));
                let left = std::array::from_fn(|_| rest.next().unwrap_or(0));
                // columns are numbered from 0, and so are the rows 0, 1, 2
                out[count] = ([a, b, c], left, (a + b + c) % 2 == 1);
                count += 1;
            }
        }
    }
    out
}

type Row = [Ball; 6];

/// The twenty determinants of three rows, on the columns of the first (or second) member of each pair of triples.
fn minors(rows: [&Row; 3], triples: &[(Triple, Triple, bool); 20], second: bool) -> [Ball; 20] {
    let mut out = [Ball::ZERO; 20];
    for (value, (first, rest, _)) in out.iter_mut().zip(triples) {
        let [a, b, c] = if second { *rest } else { *first };
        let [p, q, r] = rows;
        *value = p[a] * (q[b] * r[c] - q[c] * r[b]) - p[b] * (q[a] * r[c] - q[c] * r[a])
            + p[c] * (q[a] * r[b] - q[b] * r[a]);
    }
    out
}

/// A determinant of six rows from the minors of its halves.
fn joined(upper: &[Ball; 20], lower: &[Ball; 20], triples: &[(Triple, Triple, bool); 20]) -> Ball {
    let mut sum = Ball::ZERO;
    for ((u, l), (_, _, odd)) in upper.iter().zip(lower).zip(triples) {
        // the sign for the columns 0, 1, 2 is positive: their sum is 3
        sum = if *odd { sum + *u * *l } else { sum - *u * *l };
    }
    sum
}

/// Minors of one half of the rows for the eight corners of its offsets, and with one row replaced.
struct Half {
    plain: Vec<[Ball; 20]>,
    /// `[corner][replaced row]`; the end of the replaced row does not matter.
    replaced: Vec<[[Ball; 20]; 3]>,
}

impl Half {
    fn new(ends: &[[Row; 2]; 6], y: &Row, triples: &[(Triple, Triple, bool); 20], second: bool) -> Self {
        let first = if second { 3 } else { 0 };
        let rows =
            |corner: usize| -> [&Row; 3] { std::array::from_fn(|k| &ends[first + k][corner >> k & 1]) };
        let plain = (0..8).map(|corner| minors(rows(corner), triples, second)).collect();
        let mut replaced: Vec<[[Ball; 20]; 3]> = Vec::with_capacity(8);
        for corner in 0..8 {
            replaced.push(std::array::from_fn(|k| {
                let twin = corner & !(1 << k);
                if twin != corner {
                    return replaced[twin][k];
                }
                let mut own = rows(corner);
                own[k] = y;
                minors(own, triples, second)
            }));
        }
        Self { plain, replaced }
    }
}

/// Length of a leg at both ends of the range and a bound of how far the chord is above it between.
fn lengths(row: &LegRow, (low, high): (f64, f64)) -> Option<([Ball; 2], f64)> {
    let (_, _, q) = row.balls();
    let root = |t: f64| -> Option<Ball> {
        let t = Ball::point(t);
        (q[0] + t * (q[1] + t * q[2])).root()
    };
    let (a, b) = (root(low)?, root(high)?);
    // l'' = (q0 q2 - q1^2 / 4) / l^3 <= q2 / l_min, and the chord is above by at most (high - low)^2 / 8 of that
    let least = least_length(q, low, high, &a, &b)?;
    let width = Ball::point(high) - Ball::point(low);
    let below = (q[0] * q[2]).twice().twice() - q[1].square();
    let cube = (least * least.square()).inverse()?;
    let bend = Ball { c: 0.25, r: 0.0 } * below * cube;
    let by_bend = (Ball { c: 0.125, r: 0.0 } * width.square() * bend).high();
    Some(([a, b], by_bend.max(0.0)))
}

/// A ball of which all numbers are at most the length anywhere in the range: `l >= (l_low + l_high - width |rate|) / 2` by the triangle inequality, or the least distance of the line.
fn least_length(q: &[Ball; 3], low: f64, high: f64, a: &Ball, b: &Ball) -> Option<Ball> {
    let width = Ball::point(high) - Ball::point(low);
    let travel = width * q[2].root()?;
    let half = Ball { c: 0.5, r: 0.0 } * (*a + *b - travel);
    let floor = (half.c - half.r).next_down();
    (floor > 0.0).then(|| Ball::point(floor))
}

/// The function of one pose; `None` where nothing can be said.
pub(super) fn at_corners(
    rows: &[LegRow; 6],
    plain: &PoseLegs,
    bounds: &OffsetRanges,
    limit: f64,
) -> Option<AtCorners> {
    let middle = bounds.map(|(low, high)| f64::midpoint(low, high));
    let v = Vectors::of(&plain.jacobian(&middle))?;
    let mut ends: [[Row; 2]; 6] = [[[Ball::ZERO; 6]; 2]; 6];
    let mut length = [[Ball::ZERO; 2]; 6];
    let mut chord = [0.0; 6];
    for i in 0..6 {
        let (constant, rate, _) = rows[i].balls();
        for (end, t) in [bounds[i].0, bounds[i].1].into_iter().enumerate() {
            ends[i][end] = std::array::from_fn(|k| constant[k] + Ball::point(t) * rate[k]);
        }
        (length[i], chord[i]) = lengths(&rows[i], bounds[i])?;
    }
    let triples = triples();
    let y = v.y.map(Ball::point);
    let (upper, lower) = (Half::new(&ends, &y, &triples, false), Half::new(&ends, &y, &triples, true));
    let mut det = [Ball::ZERO; CORNERS];
    // sum x_i l_i C_i, and x_i C_i for each leg
    let mut sum = [Ball::ZERO; CORNERS];
    let mut parts = [[Ball::ZERO; 6]; CORNERS];
    for corner in 0..CORNERS {
        let (u, l) = (corner & 7, corner >> 3);
        det[corner] = joined(&upper.plain[u], &lower.plain[l], &triples);
        for i in 0..6 {
            let cofactor = if i < 3 {
                joined(&upper.replaced[u][i], &lower.plain[l], &triples)
            } else {
                joined(&upper.plain[u], &lower.replaced[l][i - 3], &triples)
            };
            parts[corner][i] = Ball::point(v.x[i]) * cofactor;
            sum[corner] = sum[corner] + length[i][corner >> i & 1] * parts[corner][i];
        }
    }
    let sign = if sum.iter().map(|s| s.c).sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    // what the chords are above the lengths
    let mut lost = Ball::ZERO;
    for i in 0..6 {
        let greatest = parts.iter().map(|p| sign * p[i].c + p[i].r).fold(0.0, f64::max).next_up();
        lost = lost + Ball::point(chord[i]) * Ball::point(greatest);
    }
    let top = greatest_singular_value(rows, &v, bounds)?;
    let factor = Ball::point(limit) * Ball::point(top);
    let norms = dot(&v.x.map(Ball::point), &v.x.map(Ball::point)) * dot(&y, &y);
    let norms = norms.root()?;
    let scale = det.iter().map(|d| d.c.abs()).fold(0.0, f64::max);
    if !(scale > f64::MIN_POSITIVE && scale.is_finite()) {
        return None;
    }
    // a power of two, so that scaling costs nothing
    let unit = Ball::point(2f64.powi(-(scale.log2().floor() as i32)));
    Some(std::array::from_fn(|k| {
        let size = Ball { c: det[k].c.abs(), r: det[k].r };
        let own = Ball { c: sign * sum[k].c, r: sum[k].r };
        unit * (norms * size - factor * (own - lost))
    }))
}

/// A lower bound of `sigma_1` on the box: `z^T J w / (|z| |w|)` is a sum of functions of one offset each.
fn greatest_singular_value(rows: &[LegRow; 6], v: &Vectors, bounds: &OffsetRanges) -> Option<f64> {
    let (z, w) = (v.z.map(Ball::point), v.w.map(Ball::point));
    let mut sum = Ball::ZERO;
    for i in 0..6 {
        let least = least_along(&rows[i], &w, z[i], bounds[i])?;
        sum = sum + Ball::point(least);
    }
    let norm = (dot(&z, &z) * dot(&w, &w)).root()?.inverse()?;
    let low = sum * norm;
    let low = (low.c - low.r).next_down();
    (low > 0.0).then_some(low)
}

/// Parts into which a range is cut for that.
const PARTS: u32 = 4;

/// A lower bound of `z (row . w) / length` on a range: on each part the value in the middle less the rate over the part times half its width.
fn least_along(row: &LegRow, w: &Row, z: Ball, (low, high): (f64, f64)) -> Option<f64> {
    let (constant, rate, q) = row.balls();
    let (a, b) = (dot(constant, w), dot(rate, w));
    let cut = |k: u32| if k == PARTS { high } else { low + (high - low) * (f64::from(k) / f64::from(PARTS)) };
    let mut least = f64::INFINITY;
    for k in 0..PARTS {
        let (from, to) = (cut(k), cut(k + 1));
        let c = f64::midpoint(from, to);
        let step = Ball { c: 0.0, r: (to - c).max(c - from).next_up() };
        let middle = Ball::point(c);
        let slope = q[1] + middle.twice() * q[2];
        let square = q[0] + middle * (q[1] + middle * q[2]);
        let there = square + step * (slope + step * q[2]);
        // f = (a + b t) / l,  f' = (b - f q' / (2 l)) / l = (b q - (a + b t) q' / 2) / l^3
        let (here_length, there_length) = (square.root()?, there.root()?);
        let value = (a + b * middle) * here_length.inverse()?;
        let numerator =
            b * there - Ball { c: 0.5, r: 0.0 } * (a + b * (middle + step)) * (slope + (step * q[2]).twice());
        let rate = numerator * (there * there_length).inverse()?;
        let all = z * (value + step * rate);
        least = least.min((all.c - all.r).next_down());
        if !(all.r.is_finite() && all.c.is_finite()) {
            return None;
        }
    }
    Some(least)
}

/// `true` when a combination of the functions is below 0 at all corners, and so on the whole box: proved.
pub(super) fn excluded(functions: &[AtCorners]) -> bool {
    let values: Vec<[f64; CORNERS]> = functions.iter().map(|f| f.map(|b| b.c)).collect();
    let Some(mu) = game(&values) else { return false };
    (0..CORNERS).all(|corner| {
        let mut sum = Ball::ZERO;
        for (mu, f) in mu.iter().zip(functions).filter(|(mu, _)| **mu > 0.0) {
            sum = sum + Ball::point(*mu) * f[corner];
        }
        sum.high() < 0.0
    })
}
