//! Designs with one body or both in space and too many joints for [`super::split`]: families at the joints, and one pairing.
//!
//! A leg that is a combination of legs `S` with coefficients all different from zero needs `|S| >= i + j + 1` (lemma of
//! `docs/theory/components.md`). If the joints of one body used by `S` are independent the argument of [`super::split`] holds for `S`;
//! otherwise `i` and `j` are the dimensions of the bodies, and only a plane and a space with all six legs are left.

use super::piece::{Piece, PieceKind};
use super::sample::{Sample, meet, other, subsets, weighted};
use super::split::Split;
use crate::num::exact::relations;
use crate::synthesis::components::exact::{Exact, rank};
use crate::synthesis::hexagon::Body;

/// The families; `None` when the sample is special.
pub(super) fn at_joints(sample: &Sample, legs: &[(usize, usize); 6]) -> Option<Split> {
    let both = [Body::Base, Body::Platform];
    if !both.into_iter().all(|body| flats_meet_in_joints(sample, body)) {
        return None;
    }
    let mut split = Split { pieces: complete_graphs(sample, legs), summands: vec![1; 6] };
    let flat = both.into_iter().find(|b| sample.dimension(*b) == 2);
    if let Some(pairing) = flat.and_then(|body| pairing(sample, body)) {
        // a single leg at a joint of the line is a leg of the pairing
        let same = |x: &Exact, y: &Exact| rank(&[x.clone(), y.clone()]) == 1;
        let held = |p: &Piece| {
            let mut ends = pairing.base.iter().zip(&pairing.platform);
            p.dimension() == 0 && ends.any(|(a, b)| same(a, &p.base[0]) && same(b, &p.platform[0]))
        };
        split.pieces.retain(|p| !held(p));
        split.pieces.push(pairing);
        split.summands.push(3);
    }
    Some(split)
}

/// Whether the flats that two joints see on the other body have joints in common and nothing else.
fn flats_meet_in_joints(sample: &Sample, body: Body) -> bool {
    let there = other(body);
    subsets(sample.joints(body).len()).filter(|s| s.len() == 2).all(|pair| {
        let seen = [0, 1].map(|k| sample.neighbours(body, pair[k]));
        let common = seen[0].iter().filter(|k| seen[1].contains(k)).count();
        let [u, v] = seen.map(|s| sample.points(there, &s));
        meet(&u, &v).len() == common
    })
}

/// Maximal sets of joints that are all joined to each other, each leg in at least one.
fn complete_graphs(sample: &Sample, legs: &[(usize, usize); 6]) -> Vec<Piece> {
    let count = sample.joints(Body::Base).len();
    let seen: Vec<Vec<usize>> = (0..count).map(|k| sample.neighbours(Body::Base, k)).collect();
    let sets = subsets(count).filter_map(|set| {
        let common: Vec<usize> =
            seen[set[0]].iter().copied().filter(|k| set.iter().all(|j| seen[*j].contains(k))).collect();
        let closed = (0..count).all(|j| set.contains(&j) || !common.iter().all(|k| seen[j].contains(k)));
        (closed && !common.is_empty()).then_some((set, common))
    });
    let piece = |(set, common): (Vec<usize>, Vec<usize>)| Piece {
        kind: PieceKind::AllPairs,
        parts: (0..6).filter(|l| set.contains(&legs[*l].0) && common.contains(&legs[*l].1)).collect(),
        base: sample.points(Body::Base, &set),
        platform: sample.points(Body::Platform, &common),
        weight: 1,
    };
    sets.map(piece).collect()
}

/// The pairing of the line `a1 a2` of a planar body of four joints with the line in space through the double joint `b` that
/// meets the flats which `a1` and `a2` see, where `b` is joined to the other two joints and no other joint is.
///
/// With `b = w1 + w2` (`wk` in the flat of `ak`) and the crossing `c = a1 + a2` (suitably scaled) of `a1 a2` with the line of the other two
/// joints, the legs `(a1, w1)`, `(a2, w2)`, `(c, b)` are replaceable and lie between two lines.
fn pairing(sample: &Sample, planar: Body) -> Option<Piece> {
    let space = other(planar);
    if sample.joints(planar).len() != 4 || sample.joints(space).len() != 5 {
        return None;
    }
    // its rank is counted in a summand of its own, after those of the six legs
    let double = (0..5).find(|k| sample.neighbours(space, *k).len() == 2)?;
    let held = sample.neighbours(space, double);
    let free: Vec<usize> = (0..4).filter(|k| !held.contains(k)).collect();
    let flats = [0, 1].map(|k| sample.points(space, &sample.neighbours(planar, free[k])));
    if flats[0].len() + flats[1].len() != 4 {
        return None;
    }
    let line = sample.points(planar, &free);
    let crossing = meet(&line, &sample.points(planar, &held)).into_iter().next()?;
    let target = &sample.points(space, &[double])[0];
    let on_plane = parts(&crossing, [&line[..1], &line[1..]])?.to_vec();
    let in_space = parts(target, [&flats[0], &flats[1]])?.to_vec();
    let (base, platform) = if planar == Body::Base { (on_plane, in_space) } else { (in_space, on_plane) };
    Some(Piece { kind: PieceKind::Pairing, base, platform, parts: vec![6], weight: 3 })
}

/// `x = u + v` with `u` and `v` in two spans that have only zero in common.
fn parts(x: &Exact, spans: [&[Exact]; 2]) -> Option<[Exact; 2]> {
    let rows: Vec<Exact> = spans[0].iter().chain(spans[1]).chain([x]).cloned().collect();
    let relation = relations(&rows).into_iter().next()?;
    let (last, head) = relation.split_last()?;
    let scaled: Vec<_> = head.iter().map(|c| -(c / last)).collect();
    let (u, v) = scaled.split_at(spans[0].len());
    Some([weighted(spans[0], u), weighted(spans[1], v)])
}
