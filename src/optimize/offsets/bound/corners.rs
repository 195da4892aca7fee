//! Functions that are affine in every offset: determinants, whose greatest values on a box are at its corners.
//!
//! The rows `N_i(t_i)` are direction and moment of leg `i`, affine in `t_i` since they are not divided by its length
//! `l_i`. Then `J = diag(1 / l_i) N`. For any vectors `x`, `y` by Cramer's rule
//!
//! ```text
//! y^T J^-1 x = (1 / det N) sum_i x_i l_i(t_i) C_i,      C_i = det N with row i replaced by y,
//! ```
//!
//! and `|y^T J^-1 x| <= |x| |y| / sigma_6`. So offsets that reach the limit `g`, where `det N` is not zero, satisfy for
//! either sign
//!
//! ```text
//! |x| |y| |det N| - g sigma_1 (+-) sum_i x_i l_i C_i >= 0.
//! ```
//!
//! `det N` and `C_i` are affine in every offset. `l_i` is convex and at least its chord minus the greatest distance
//! from it; `sigma_1` has a lower bound on the box. `|det N|` is convex in every offset alone. It is hence nowhere
//! above the function that is affine in every offset and agrees with it at the corners. The resulting function is
//! affine in every offset, and so is every combination with multipliers. Its greatest value is at one of the 64
//! corners, even if the functions share offsets.

use std::ops::{Add, Mul, Sub};

use nalgebra::{SVD, U6};

use super::multipliers::game;
use super::rows::LegRow;
use crate::offsets::limits::OffsetRanges;
use num::ball::Real;

/// `a . b`.
fn dot(a: &[Real; 6], b: &[Real; 6]) -> Real {
    (1..6).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

/// Corners of a box; bit `i` of the number selects the end of offset `i`.
pub(super) const CORNERS: usize = 64;

/// Values at the corners of a function that is affine in every offset, and non-negative at offsets that reach the
/// limit.
pub(super) type AtCorners = [Real; CORNERS];

/// Numbers of the determinants: balls for proofs, doubles to see whether a proof is likely.
pub(super) trait Entry: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    const ZERO: Self;
    fn of(ball: Real) -> Self;
    fn ball(self) -> Real;
}

impl Entry for Real {
    const ZERO: Self = Self { centre: 0.0, radius: 0.0 };
    fn of(ball: Real) -> Self {
        ball
    }
    fn ball(self) -> Real {
        self
    }
}

impl Entry for f64 {
    const ZERO: Self = 0.0;
    fn of(ball: Real) -> Self {
        ball.centre
    }
    fn ball(self) -> Real {
        Real::point(self)
    }
}

/// Vectors in the middle of the box.
#[derive(Debug)]
pub(super) struct Vectors {
    x: [f64; 6],
    y: [f64; 6],
    z: [f64; 6],
    w: [f64; 6],
}

impl Vectors {
    /// Singular vectors of the least and of the greatest singular value; `None` without finite ones.
    pub(super) fn of(svd: &SVD<f64, U6, U6>) -> Option<Self> {
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

/// All twenty sets of three columns with their complements and the sign of the expansion by the first three rows.
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

type Row<T> = [T; 6];

/// The twenty determinants of three rows, on the columns of the first (or second) member of each pair of triples.
fn minors<T: Entry>(rows: [&Row<T>; 3], triples: &[(Triple, Triple, bool); 20], second: bool) -> [T; 20] {
    let mut out = [T::ZERO; 20];
    for (value, (first, rest, _)) in out.iter_mut().zip(triples) {
        let [a, b, c] = if second { *rest } else { *first };
        let [p, q, r] = rows;
        *value = p[a] * (q[b] * r[c] - q[c] * r[b]) - p[b] * (q[a] * r[c] - q[c] * r[a])
            + p[c] * (q[a] * r[b] - q[b] * r[a]);
    }
    out
}

/// A determinant of six rows from the minors of its halves.
fn joined<T: Entry>(upper: &[T; 20], lower: &[T; 20], triples: &[(Triple, Triple, bool); 20]) -> T {
    let mut sum = T::ZERO;
    for ((u, l), (_, _, odd)) in upper.iter().zip(lower).zip(triples) {
        // the sign for the columns 0, 1, 2 is positive: their sum is 3
        sum = if *odd { sum + *u * *l } else { sum - *u * *l };
    }
    sum
}

/// Minors of one half of the rows for the eight corners of its offsets, and with one row replaced.
struct Half<T> {
    plain: Vec<[T; 20]>,
    /// `[corner][replaced row]`; the end of the replaced row is irrelevant.
    replaced: Vec<[[T; 20]; 3]>,
}

impl<T: Entry> Half<T> {
    fn new(
        ends: &[[Row<T>; 2]; 6],
        y: &Row<T>,
        triples: &[(Triple, Triple, bool); 20],
        second: bool,
    ) -> Self {
        let first = if second { 3 } else { 0 };
        let rows =
            |corner: usize| -> [&Row<T>; 3] { std::array::from_fn(|k| &ends[first + k][corner >> k & 1]) };
        let plain = (0..8).map(|corner| minors(rows(corner), triples, second)).collect();
        let mut replaced: Vec<[[T; 20]; 3]> = Vec::with_capacity(8);
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

/// Length of a leg at both ends of the range, and a bound of the chord's height above it in between.
fn lengths(row: &LegRow, (low, high): (f64, f64)) -> Option<([Real; 2], f64)> {
    let (_, _, q) = row.balls();
    let root = |t: f64| -> Option<Real> {
        let t = Real::point(t);
        (q[0] + t * (q[1] + t * q[2])).sqrt()
    };
    let (a, b) = (root(low)?, root(high)?);
    // l'' = (q0 q2 - q1^2 / 4) / l^3 <= q2 / l_min, and the chord is above by at most (high - low)^2 / 8 of that
    let least = least_length(q, low, high, &a, &b)?;
    let width = Real::point(high) - Real::point(low);
    let below = (q[0] * q[2]).scaled(4.0) - q[1] * q[1];
    let cube = (least * (least * least)).reciprocal()?;
    let bend = Real::point(0.25) * below * cube;
    let by_bend = (Real::point(0.125) * (width * width) * bend).high();
    Some(([a, b], by_bend.max(0.0)))
}

/// A ball of lower bounds of the length anywhere in the range. It comes from `l >= (l_low + l_high - width |rate|) / 2`
/// (triangle inequality), or from the least distance of the line.
fn least_length(q: &[Real; 3], low: f64, high: f64, a: &Real, b: &Real) -> Option<Real> {
    let width = Real::point(high) - Real::point(low);
    let travel = width * q[2].sqrt()?;
    let half = Real::point(0.5) * (*a + *b - travel);
    let floor = (half.centre - half.radius).next_down();
    (floor > 0.0).then(|| Real::point(floor))
}

/// The function of one pose; `None` if it gives no bound. Its values in doubles are below those in balls, up to the
/// rounding of both.
pub(super) fn at_corners<T: Entry>(
    rows: &[LegRow; 6],
    v: &Vectors,
    bounds: &OffsetRanges,
    limit: f64,
) -> Option<AtCorners> {
    let mut ends: [[Row<T>; 2]; 6] = [[[T::ZERO; 6]; 2]; 6];
    let mut length = [[Real::ZERO; 2]; 6];
    let mut chord = [0.0; 6];
    for i in 0..6 {
        let (constant, rate, _) = rows[i].balls();
        for (end, t) in [bounds[i].0, bounds[i].1].into_iter().enumerate() {
            ends[i][end] = std::array::from_fn(|k| T::of(constant[k] + Real::point(t) * rate[k]));
        }
        (length[i], chord[i]) = lengths(&rows[i], bounds[i])?;
    }
    let triples = triples();
    let y = v.y.map(Real::point);
    let own = y.map(T::of);
    let (upper, lower) = (Half::new(&ends, &own, &triples, false), Half::new(&ends, &own, &triples, true));
    let mut det = [Real::ZERO; CORNERS];
    // sum x_i l_i C_i, and x_i C_i for each leg
    let mut sum = [Real::ZERO; CORNERS];
    let mut parts = [[Real::ZERO; 6]; CORNERS];
    for corner in 0..CORNERS {
        let (u, l) = (corner & 7, corner >> 3);
        det[corner] = joined(&upper.plain[u], &lower.plain[l], &triples).ball();
        for i in 0..6 {
            // C_i has no row of leg i, so that its offset is irrelevant
            parts[corner][i] = if corner >> i & 1 == 1 {
                parts[corner ^ 1 << i][i]
            } else if i < 3 {
                Real::point(v.x[i]) * joined(&upper.replaced[u][i], &lower.plain[l], &triples).ball()
            } else {
                Real::point(v.x[i]) * joined(&upper.plain[u], &lower.replaced[l][i - 3], &triples).ball()
            };
            sum[corner] = sum[corner] + length[i][corner >> i & 1] * parts[corner][i];
        }
    }
    let sign = if sum.iter().map(|s| s.centre).sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    // the excess of the chords over the lengths
    let mut lost = Real::ZERO;
    for i in 0..6 {
        let greatest = parts.iter().map(|p| sign * p[i].centre + p[i].radius).fold(0.0, f64::max).next_up();
        lost = lost + Real::point(chord[i]) * Real::point(greatest);
    }
    let top = greatest_singular_value(rows, v, bounds)?;
    let factor = Real::point(limit) * Real::point(top);
    let norms = dot(&v.x.map(Real::point), &v.x.map(Real::point)) * dot(&y, &y);
    let norms = norms.sqrt()?;
    let scale = det.iter().map(|d| d.centre.abs()).fold(0.0, f64::max);
    if !(scale > f64::MIN_POSITIVE && scale.is_finite()) {
        return None;
    }
    // a power of two, so that scaling has no rounding
    let unit = Real::point(2f64.powi(-(scale.log2().floor() as i32)));
    Some(std::array::from_fn(|k| {
        let size = Real { centre: det[k].centre.abs(), radius: det[k].radius };
        let own = Real { centre: sign * sum[k].centre, radius: sum[k].radius };
        unit * (norms * size - factor * (own - lost))
    }))
}

/// A lower bound of `sigma_1` on the box: `z^T J w / (|z| |w|)` is a sum of functions of one offset each.
fn greatest_singular_value(rows: &[LegRow; 6], v: &Vectors, bounds: &OffsetRanges) -> Option<f64> {
    let (z, w) = (v.z.map(Real::point), v.w.map(Real::point));
    let mut sum = Real::ZERO;
    for i in 0..6 {
        let least = least_along(&rows[i], &w, z[i], bounds[i])?;
        sum = sum + Real::point(least);
    }
    let norm = (dot(&z, &z) * dot(&w, &w)).sqrt()?.reciprocal()?;
    let low = sum * norm;
    let low = (low.centre - low.radius).next_down();
    (low > 0.0).then_some(low)
}

/// Number of parts of a range for this bound.
const PARTS: u32 = 4;

/// A lower bound of `z (row . w) / length` on a range. On each part it is the value in the middle minus the rate over
/// the part times half its width.
fn least_along(row: &LegRow, w: &Row<Real>, z: Real, (low, high): (f64, f64)) -> Option<f64> {
    let (constant, rate, q) = row.balls();
    let (a, b) = (dot(constant, w), dot(rate, w));
    let cut = |k: u32| if k == PARTS { high } else { low + (high - low) * (f64::from(k) / f64::from(PARTS)) };
    let mut least = f64::INFINITY;
    for k in 0..PARTS {
        let (from, to) = (cut(k), cut(k + 1));
        let c = f64::midpoint(from, to);
        let step = Real { centre: 0.0, radius: (to - c).max(c - from).next_up() };
        let middle = Real::point(c);
        let slope = q[1] + middle.scaled(2.0) * q[2];
        let square = q[0] + middle * (q[1] + middle * q[2]);
        let there = square + step * (slope + step * q[2]);
        // f = (a + b t) / l,  f' = (b - f q' / (2 l)) / l = (b q - (a + b t) q' / 2) / l^3
        let (here_length, there_length) = (square.sqrt()?, there.sqrt()?);
        let value = (a + b * middle) * here_length.reciprocal()?;
        let numerator =
            b * there - Real::point(0.5) * (a + b * (middle + step)) * (slope + (step * q[2]).scaled(2.0));
        let rate = numerator * (there * there_length).reciprocal()?;
        let all = z * (value + step * rate);
        least = least.min((all.centre - all.radius).next_down());
        if !(all.radius.is_finite() && all.centre.is_finite()) {
            return None;
        }
    }
    Some(least)
}

/// Multipliers of a combination that is negative at all corners, in doubles.
pub(super) fn combination(functions: &[AtCorners]) -> Option<Vec<f64>> {
    let values: Vec<[f64; CORNERS]> = functions.iter().map(|f| f.map(|b| b.centre)).collect();
    game(&values)
}

/// `true` if a combination of the functions is proved negative at all corners, and so on the whole box.
pub(super) fn excluded(functions: &[AtCorners]) -> bool {
    let Some(mu) = combination(functions) else { return false };
    (0..CORNERS).all(|corner| {
        let mut sum = Real::ZERO;
        for (mu, f) in mu.iter().zip(functions).filter(|(mu, _)| **mu > 0.0) {
            sum = sum + Real::point(*mu) * f[corner];
        }
        sum.high() < 0.0
    })
}
