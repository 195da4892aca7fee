//! Designs whose legs span a sum of stars: `L = sum_j alpha_j (x) V_j` with independent points `alpha_j` of one body.
//!
//! Then `(a, b)` with `(1, a) = sum_j lambda_j alpha_j` is replaceable exactly when `(1, b)` lies in `V_j` for every `j` with
//! `lambda_j != 0`, so that the replaceable legs are the legs between the flats `span(alpha_j, j in S)` and `V_S`, the intersection of the `V_j` with `j` in `S`.

use super::piece::{Piece, PieceKind};
use super::sample::{Sample, finite, meet, other, subsets};
use crate::synthesis::components::exact::{Exact, rank};
use crate::synthesis::hexagon::Body;

/// A point of a body and joints of the other one to which it has replaceable legs in every design of the topology.
#[derive(Debug, Clone)]
struct Star {
    point: Exact,
    sees: Vec<usize>,
}

/// All families, and the dimensions of the summands.
#[derive(Debug, Clone)]
pub(super) struct Split {
    pub(super) pieces: Vec<Piece>,
    pub(super) summands: Vec<usize>,
}

/// What was found about a sample.
#[derive(Debug, Clone)]
pub(super) enum Outcome {
    /// All families of the sample, which are those of every general member.
    Found(Split),
    /// An intersection is larger than it is in general: another sample has to be drawn.
    Special,
    /// The span is no such sum.
    None,
}

/// Joints of a body whose legs reach every point of the other body's flat.
fn full(sample: &Sample, body: Body) -> Vec<usize> {
    let enough = sample.dimension(other(body)) + 1;
    (0..sample.joints(body).len()).filter(|k| sample.neighbours(body, *k).len() >= enough).collect()
}

/// The joints of a body, and the points of its plane where the lines of two double joints of the other body cross.
fn stars(sample: &Sample, body: Body) -> Vec<Star> {
    let there = other(body);
    let everywhere = full(sample, there);
    let with = |mut sees: Vec<usize>| {
        sees.extend(&everywhere);
        sees.sort_unstable();
        sees.dedup();
        sees
    };
    let joints = sample.joints(body).iter().enumerate();
    let mut out: Vec<Star> =
        joints.map(|(k, p)| Star { point: p.clone(), sees: with(sample.neighbours(body, k)) }).collect();
    for pair in subsets(sample.joints(there).len()).filter(|s| s.len() == 2) {
        let seen = [0, 1].map(|k| sample.neighbours(there, pair[k]));
        let apart = seen[0].iter().all(|k| !seen[1].contains(k));
        if sample.dimension(body) == 2 && apart && seen.iter().all(|s| s.len() == 2) {
            let [u, v] = seen.map(|s| sample.points(body, &s));
            let crossing = meet(&u, &v).first().and_then(finite);
            out.extend(crossing.map(|point| Star { point, sees: with(pair) }));
        }
    }
    out
}

/// Finds the sum over points of `body`.
pub(super) fn split(sample: &Sample, body: Body) -> Outcome {
    let there = other(body);
    let (own, most) = (sample.dimension(body) + 1, sample.dimension(there) + 1);
    let all = stars(sample, body);
    let chosen = subsets(all.len()).filter(|s| s.len() == own).find(|s| {
        let legs: usize = s.iter().map(|k| all[*k].sees.len()).sum();
        let points: Vec<Exact> = s.iter().map(|k| all[*k].point.clone()).collect();
        legs == 6 && s.iter().all(|k| all[*k].sees.len() <= most) && rank(&points) == own
    });
    let Some(chosen) = chosen else { return Outcome::None };
    let basis: Vec<&Star> = chosen.iter().map(|k| &all[*k]).collect();
    families(sample, body, &basis).map_or(Outcome::Special, Outcome::Found)
}

/// The least dimension that the intersection of the `V_j` has: joints in common, and what counting dimensions guarantees.
fn least(basis: &[&Star], most: usize, set: &[usize]) -> usize {
    let Some((first, rest)) = set.split_first() else { return most };
    let common =
        basis[*first].sees.iter().filter(|k| rest.iter().all(|j| basis[*j].sees.contains(k))).count();
    let parts = subsets(set.len()).filter(|s| s.len() < set.len() && s[0] == 0).map(|s| {
        let (in_it, out): (Vec<usize>, Vec<usize>) = (0..set.len()).partition(|k| s.contains(k));
        let at = |part: Vec<usize>| least(basis, most, &part.iter().map(|k| set[*k]).collect::<Vec<_>>());
        (at(in_it) + at(out)).saturating_sub(most)
    });
    parts.max().unwrap_or(0).max(common)
}

/// The families; `None` when an intersection has more than its least dimension.
fn families(sample: &Sample, body: Body, basis: &[&Star]) -> Option<Split> {
    let there = other(body);
    let most = sample.dimension(there) + 1;
    let mut pieces = Vec::new();
    for set in subsets(basis.len()) {
        let seen: Vec<Vec<Exact>> = basis.iter().map(|s| sample.points(there, &s.sees)).collect();
        let common: Vec<usize> = basis[set[0]]
            .sees
            .iter()
            .copied()
            .filter(|k| set.iter().all(|j| basis[*j].sees.contains(k)))
            .collect();
        let mut flat = set[1..].iter().fold(seen[set[0]].clone(), |flat, j| meet(&flat, &seen[*j]));
        if flat.len() != least(basis, most, &set) {
            return None;
        }
        if flat.len() == common.len() {
            flat = sample.points(there, &common);
        } else {
            flat = flat.iter().map(finite).collect::<Option<_>>()?;
        }
        let inside = |j: usize| rank(&[seen[j].clone(), flat.clone()].concat()) == seen[j].len();
        if flat.is_empty() || (0..basis.len()).any(|j| !set.contains(&j) && inside(j)) {
            continue;
        }
        let weight = flat.len();
        let own: Vec<Exact> = set.iter().map(|j| basis[*j].point.clone()).collect();
        let (base, platform) = if body == Body::Base { (own, flat) } else { (flat, own) };
        pieces.push(Piece { kind: PieceKind::AllPairs, base, platform, parts: set, weight });
    }
    Some(Split { pieces, summands: basis.iter().map(|s| s.sees.len()).collect() })
}
