//! How six legs can be spread over the families, and how many joints they then share.

use super::piece::Piece;

/// Number of legs taken from each family, with what they share at least.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Spread {
    /// Joints with two or more legs.
    pub(super) shared: usize,
    /// Twelve less the number of joints.
    pub(super) merged: usize,
    /// Legs from each family.
    pub(super) counts: Vec<usize>,
}

/// An upper bound of the rank of the legs of some families: in every summand the sum of their dimensions, at most its own.
pub(super) fn rank_bound<'a>(pieces: impl Iterator<Item = &'a Piece>, summands: &[usize]) -> usize {
    let mut filled = vec![0; summands.len()];
    for piece in pieces {
        piece.parts.iter().for_each(|k| filled[*k] += piece.weight);
    }
    filled.iter().zip(summands).map(|(f, s)| f.min(s)).sum()
}

/// All ways to take six legs such that no families hold more of them than their rank bound, those that share fewest joints first.
pub(super) fn spreads(pieces: &[Piece], summands: &[usize]) -> Vec<Spread> {
    let bounds: Vec<usize> = (0..1usize << pieces.len())
        .map(|set| {
            rank_bound(pieces.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).map(|(_, p)| p), summands)
        })
        .collect();
    let mut out = Vec::new();
    let mut counts = vec![0; pieces.len()];
    spread(pieces, &bounds, &mut counts, 0, 6, &mut out);
    out.sort_by_key(|s: &Spread| (s.shared, s.merged));
    out
}

fn spread(
    pieces: &[Piece],
    bounds: &[usize],
    counts: &mut [usize],
    next: usize,
    left: usize,
    out: &mut Vec<Spread>,
) {
    if next == pieces.len() {
        let held = |set: usize| {
            counts.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).map(|(_, n)| n).sum::<usize>()
        };
        if left == 0 && (1..bounds.len()).all(|set| held(set) <= bounds[set]) {
            let common = || pieces.iter().zip(&*counts).filter(|(p, n)| p.has_common_joint() && **n > 1);
            let merged = common().map(|(_, n)| n - 1).sum();
            out.push(Spread { shared: common().count(), merged, counts: counts.to_vec() });
        }
        return;
    }
    for n in 0..=left.min(pieces[next].rank()) {
        counts[next] = n;
        spread(pieces, bounds, counts, next + 1, left - n, out);
    }
    counts[next] = 0;
}

/// Why six independent legs cannot be had with few shared joints: even if any number of legs is taken from the families
/// `allowed` (with a joint in common) and one from each of the others with a joint in common, no more than `most` are independent.
///
/// `most` is the rank bound of the families `within`, and for each family outside its rank, or 1 where its joint must not be shared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Obstruction {
    /// Families whose joint may be shared.
    pub allowed: Vec<usize>,
    /// Families counted together.
    pub within: Vec<usize>,
    /// At most so many independent legs; below six.
    pub most: usize,
}

/// One obstruction for every choice of `fewest - 1` families whose joints may be shared; `None` when one is missing.
///
/// The rank bound is submodular, so that the least sum over `within` is the greatest number of legs (Edmonds 1970).
pub(super) fn obstructions(pieces: &[Piece], summands: &[usize], fewest: usize) -> Option<Vec<Obstruction>> {
    let Some(free) = fewest.checked_sub(1) else { return Some(Vec::new()) };
    let common: Vec<usize> = (0..pieces.len()).filter(|k| pieces[*k].has_common_joint()).collect();
    let sets = (0..1usize << pieces.len()).filter(|set| {
        set.count_ones() as usize == free
            && (0..pieces.len()).all(|k| set >> k & 1 == 0 || common.contains(&k))
    });
    sets.map(|set| {
        let of = |set: usize| (0..pieces.len()).filter(|k| set >> k & 1 == 1).collect::<Vec<_>>();
        let allowed = of(set);
        let capacity = |k: usize| {
            if common.contains(&k) && !allowed.contains(&k) { 1 } else { pieces[k].rank() }
        };
        let total = |set: usize| {
            let outside: usize = (0..pieces.len()).filter(|k| set >> k & 1 == 0).map(capacity).sum();
            outside + rank_bound(of(set).iter().map(|k| &pieces[*k]), summands)
        };
        let (most, within) = (0..1usize << pieces.len()).map(|s| (total(s), s)).min()?;
        (most < 6).then(|| Obstruction { allowed: allowed.clone(), within: of(within), most })
    })
    .collect()
}
