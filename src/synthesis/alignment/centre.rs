//! The origin of each body that belongs to a span of leg vectors, whatever frames it is written in.
//!
//! Three linear least-squares problems one after the other, each invariant under rotations of both bodies; what one leaves open the next decides.
//! What the last one leaves open are translations that map the span to itself. See `docs/theory/alignment.md`.

use nalgebra::Vector3;

use super::super::components::spectrum::without;
use super::TOLERANCE;
use super::leg_space::{Head, LegSpace, pair};
use crate::num::linalg::{LinalgError, svd};

/// A span about its own origins.
#[derive(Debug, Clone)]
pub(super) struct Centred {
    pub(super) space: LegSpace,
    /// What was added to base and platform coordinates.
    pub(super) shift: (Vector3<f64>, Vector3<f64>),
    /// Dimensions that tell spans apart: of `L`, of its heads, of what each least-squares problem left open.
    pub(super) dimensions: [usize; 5],
    /// The singular values nearest to the decisions on these dimensions: smallest kept, largest dropped.
    pub(super) gap: (f64, f64),
}

/// Moves the span to its own origins.
pub(super) fn centred(space: &LegSpace) -> Result<Centred, LinalgError> {
    let mut open: Vec<Vec<f64>> =
        (0..6).map(|k| (0..6).map(|i| f64::from(u8::from(i == k))).collect()).collect();
    let mut space = space.clone();
    let mut total = (Vector3::zeros(), Vector3::zeros());
    let mut dimensions = [space.dimension(), space.head()?.dimension(), 0, 0, 0];
    let mut gap = narrower(space.gap, space.head()?.gap);
    for (k, problem) in [differences, heads, means].iter().enumerate() {
        let head = space.head()?;
        let (columns, target) = problem(&head, &open)?;
        let found = solve(&open, &columns, &target)?;
        let (s, t) = pair(&found.shift);
        space = space.shifted(&s, &t)?;
        total = (total.0 + s, total.1 + t);
        (open, gap) = (found.open, narrower(gap, found.gap));
        dimensions[k + 2] = open.len();
    }
    Ok(Centred { space, shift: total, dimensions, gap })
}

/// What shifts along each open direction add to a list of numbers, and the list to be cancelled.
type Problem = (Vec<Vec<f64>>, Vec<f64>);

/// The blocks `C` of the elements `(0, a, b, C)`: a shift adds `s b^T + a t^T`.
fn differences(head: &Head, open: &[Vec<f64>]) -> Result<Problem, LinalgError> {
    let level = head.split()?.1;
    let column = |x: &Vec<f64>| {
        let (s, t) = pair(x);
        let added = |d: &Vec<f64>| {
            let (a, b) = pair(&d[1..]);
            sum(&head.product(&s, &b), &head.product(&a, &t), 1.0)
        };
        level.iter().flat_map(added).collect()
    };
    Ok((open.iter().map(column).collect(), level.iter().flat_map(|d| head.tail(d)).collect()))
}

/// The part of `(a, b)` of the elements `(1, a, b, C)` across those with first entry zero.
fn heads(head: &Head, open: &[Vec<f64>]) -> Result<Problem, LinalgError> {
    let (first, level) = head.split()?;
    let level: Vec<Vec<f64>> = level.iter().map(|d| d[1..].to_vec()).collect();
    Ok((open.iter().map(|x| without(x, &level)).collect(), first[1..].to_vec()))
}

/// The block `C` of the element `(1, a, b, C)` with `(a, b)` across those with first entry zero.
///
/// An open shift `(s, t)` is itself the head of an element `(0, s, t, C')`, and `s t^T` is a moment: the block changes by
/// `s b^T + a t^T - C'`.
fn means(head: &Head, open: &[Vec<f64>]) -> Result<Problem, LinalgError> {
    let first = head.split()?.0;
    let (a, b) = pair(&first[1..]);
    let column = |x: &Vec<f64>| {
        let (s, t) = pair(x);
        let own: Vec<f64> = std::iter::once(0.0).chain(x.iter().copied()).collect();
        let moved = sum(&head.product(&s, &b), &head.product(&a, &t), 1.0);
        sum(&moved, &head.tail(&own), -1.0)
    };
    Ok((open.iter().map(column).collect(), head.tail(&first)))
}

fn sum(x: &[f64], y: &[f64], factor: f64) -> Vec<f64> {
    x.iter().zip(y).map(|(p, q)| p + factor * q).collect()
}

fn narrower(x: (f64, f64), y: (f64, f64)) -> (f64, f64) {
    (x.0.min(y.0), x.1.max(y.1))
}

/// Solution of one least-squares problem.
struct Solution {
    shift: Vec<f64>,
    open: Vec<Vec<f64>>,
    gap: (f64, f64),
}

/// The shift within the open directions that makes `target` smallest, and the directions that do not change it.
fn solve(open: &[Vec<f64>], columns: &[Vec<f64>], target: &[f64]) -> Result<Solution, LinalgError> {
    let mut shift = vec![0.0; 6];
    if open.is_empty() || target.is_empty() {
        return Ok(Solution { shift, open: open.to_vec(), gap: (1.0, 0.0) });
    }
    let d = svd(columns)?;
    let rank = d.s.iter().filter(|s| **s > TOLERANCE).count();
    let kept = if rank > 0 { d.s[rank - 1] } else { 1.0 };
    let gap = (kept, d.s.get(rank).copied().unwrap_or(0.0));
    let direction = |k: usize| -> Vec<f64> {
        (0..6).map(|i| open.iter().enumerate().map(|(l, x)| d.u[l][k] * x[i]).sum()).collect()
    };
    for k in 0..rank {
        let along: f64 = target.iter().zip(&d.v).map(|(t, row)| t * row[k]).sum::<f64>() / d.s[k];
        shift.iter_mut().zip(direction(k)).for_each(|(x, y)| *x -= along * y);
    }
    let rest: Vec<Vec<f64>> = (rank..open.len()).map(direction).collect();
    Ok(Solution { shift, open: rest, gap })
}
