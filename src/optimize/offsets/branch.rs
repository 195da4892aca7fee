//! The 3^6 branches of the offsets, their division into cells with constraints of one form, and starting points of a
//! cell.

use super::climb::violation;
use super::conditioning::worst_case_above;
use super::limits::{OffsetLimits, OffsetRanges, SlidingPair};
use super::problem::{OffsetModel, OffsetProblem};
use super::verdict::Conflict;
use num::Rng;
use synthesis::{HexagonSide, offset_determinant};

/// The position of a joint relative to its edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Zone {
    /// `t < 0`: on the extension before the start of the edge.
    Before,
    /// `0 < t < 1`.
    Inside,
    /// `t > 1`: on the extension beyond the end.
    Beyond,
}

impl Zone {
    const ALL: [Self; 3] = [Self::Before, Self::Inside, Self::Beyond];

    /// One character for tables: `-`, `0`, `+`.
    #[must_use]
    pub fn symbol(self) -> char {
        match self {
            Self::Before => '-',
            Self::Inside => '0',
            Self::Beyond => '+',
        }
    }

    /// The zone of a [`symbol`](Self::symbol).
    #[must_use]
    pub fn of_symbol(symbol: char) -> Option<Self> {
        Self::ALL.into_iter().find(|zone| zone.symbol() == symbol)
    }

    /// The zone in words, for messages.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Before => "before the edge",
            Self::Inside => "inside the edge",
            Self::Beyond => "beyond the edge",
        }
    }

    /// The offsets of the zone.
    pub fn range(self) -> (f64, f64) {
        match self {
            Self::Before => (f64::NEG_INFINITY, 0.0),
            Self::Inside => (0.0, 1.0),
            Self::Beyond => (1.0, f64::INFINITY),
        }
    }
}

/// A branch: the zone of each of the six offsets, cyclic order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Branch(pub [Zone; 6]);

impl Branch {
    /// All 729 branches, in the order of their base-3 numbers.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let digit = |n: usize, i: usize| Zone::ALL[n / 3usize.pow(5 - i as u32) % 3];
        (0..729).map(|n| Self(std::array::from_fn(|i| digit(n, i)))).collect()
    }

    /// The branch of offsets; those on a vertex count as inside.
    pub fn of(t: &[f64; 6]) -> Self {
        let zone = |t: f64| {
            if t < 0.0 {
                Zone::Before
            } else if t > 1.0 {
                Zone::Beyond
            } else {
                Zone::Inside
            }
        };
        Self(t.map(zone))
    }

    /// Place in [`Branch::all`].
    pub fn index(self) -> usize {
        self.0.iter().fold(0, |n, z| 3 * n + *z as usize)
    }
}

impl std::fmt::Display for Branch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|z| write!(f, "{}", z.symbol()))
    }
}

/// A closed interval of one offset.
type Range = (f64, f64);

/// A part of a zone outside of which some vertex is too close, and the parts of it in which the search moves. In these
/// the spacing from the vertices holds with the back-off; a part too short for that is used as a whole.
#[derive(Debug, Clone, PartialEq)]
struct ZonePiece {
    outer: Range,
    kept: Vec<Range>,
}

/// The rest of a zone, or the proof that it is empty.
type ZoneRoom = Result<Vec<ZonePiece>, Conflict>;

fn remove(intervals: &mut Vec<Range>, centre: f64, half: f64) {
    let (a, b) = (centre - half, centre + half);
    let pieces = intervals.iter().flat_map(|&(low, high)| [(low, high.min(a)), (low.max(b), high)]);
    *intervals = pieces.filter(|(low, high)| low <= high).collect();
}

fn free_intervals(side: &HexagonSide, range: Range, spacing: f64) -> Vec<Range> {
    let (edge, length) = (side.edge(), side.edge_length());
    let mut left = vec![range];
    for vertex in [side.start, side.end, side.opposite] {
        let foot = (vertex - side.start).dot(&edge) / (length * length);
        let height = (vertex - side.joint(foot)).norm();
        if height < spacing {
            remove(&mut left, foot, (spacing * spacing - height * height).sqrt() / length);
        }
    }
    left
}

fn room(side: usize, zone: Zone, m: &OffsetModel, limits: &OffsetLimits) -> ZoneRoom {
    let (bounds, range) = (limits.bounds()[side], zone.range());
    let cut = (bounds.0.max(range.0), bounds.1.min(range.1));
    if cut.0 > cut.1 {
        return Err(Conflict::OutsideBounds { side, zone });
    }
    let kept = |outer: &Range| {
        let inner = free_intervals(&m.sides[side], *outer, m.kept_spacing(side));
        if inner.is_empty() { vec![*outer] } else { inner }
    };
    let pieces: Vec<ZonePiece> =
        limits.room(side, cut).into_iter().map(|outer| ZonePiece { outer, kept: kept(&outer) }).collect();
    if pieces.is_empty() {
        let available = (cut.1 - cut.0) * m.sides[side].edge_length() * m.scale;
        return Err(Conflict::NoSpace { side, zone, available });
    }
    Ok(pieces)
}

/// A part of a branch: a box, the order of close pairs (the joint farther from the common vertex) and the
/// sign of `det A`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BranchCell {
    pub branch: usize,
    /// The box of the search, which keeps the back-off from the vertices.
    pub bounds: OffsetRanges,
    /// The box of the proofs: outside of it the limits are violated.
    pub outer: OffsetRanges,
    /// Pairs whose spacing can be violated inside the box; `true` if the first joint is farther out.
    pub pairs: Vec<(SlidingPair, bool)>,
    pub sign: f64,
}

/// A branch with its cells and the conflicts that emptied the others.
#[derive(Debug, Clone)]
pub(super) struct Division {
    pub branch: Branch,
    pub cells: Vec<BranchCell>,
    pub conflicts: Vec<Conflict>,
    /// Boxes that contain all offsets of the branch that may meet the limits; all others are proved to violate them.
    pub boxes: Vec<OffsetRanges>,
}

impl BranchCell {
    /// `+-(|1 - t_i| d_i - |t_j| d_j) >= 0` of each ordered pair as `constant + by first + by second`. The two orders
    /// have exactly opposite coefficients, so every point is in one of them.
    pub(crate) fn order_rows(&self) -> Vec<(usize, usize, [f64; 3])> {
        let row = |(pair, first_farther): &(SlidingPair, bool)| {
            let (e, f) = pair.edges();
            let (x, y) = (self.outer[pair.first], self.outer[pair.second]);
            let outward = if x.0 + x.1 < 2.0 { 1.0 } else { -1.0 };
            let along = if y.0 + y.1 > 0.0 { 1.0 } else { -1.0 };
            let s = if *first_farther { 1.0 } else { -1.0 };
            (pair.first, pair.second, [s * outward * e, -s * outward * e, -s * along * f])
        };
        self.pairs.iter().map(row).collect()
    }
}

/// Boxes as products of one range for each offset.
fn products(lists: &[Vec<Range>; 6]) -> Vec<OffsetRanges> {
    let mut boxes: Vec<OffsetRanges> = vec![[(0.0, 0.0); 6]];
    for (i, list) in lists.iter().enumerate() {
        let extend = |b: &OffsetRanges, range: &Range| {
            let mut b = *b;
            b[i] = *range;
            b
        };
        boxes = boxes.iter().flat_map(|b| list.iter().map(move |r| extend(b, r))).collect();
    }
    boxes
}

/// All branches with their cells. Lengths in conflicts are in design units.
pub(super) fn divide(m: &OffsetModel, limits: &OffsetLimits) -> Vec<Division> {
    let rooms: Vec<[ZoneRoom; 3]> = (0..6).map(|i| Zone::ALL.map(|z| room(i, z, m, limits))).collect();
    let pairs = SlidingPair::all(&m.sides);
    let divide_one = |(index, branch): (usize, Branch)| {
        let mut out = Division { branch, cells: Vec::new(), conflicts: Vec::new(), boxes: Vec::new() };
        let own = |i: usize| &rooms[i][branch.0[i] as usize];
        out.conflicts.extend((0..6).filter_map(|i| own(i).as_ref().err().cloned()));
        // one conflict empties the branch, since its list of pieces and thus the product is empty
        let pieces: [&[ZonePiece]; 6] = std::array::from_fn(|i| own(i).as_deref().unwrap_or(&[]));
        let outer = products(&pieces.map(|list| list.iter().map(|p| p.outer).collect()));
        for outer in outer {
            let kept = |i: usize| {
                let piece = pieces[i].iter().find(|p| p.outer == outer[i]);
                piece.map_or_else(Vec::new, |p| p.kept.clone())
            };
            split(index, outer, &products(&std::array::from_fn(kept)), &pairs, m, limits, &mut out);
        }
        out
    };
    Branch::all().into_iter().enumerate().map(divide_one).collect()
}

/// The cells of a box, for every box of the search.
fn split(
    branch: usize,
    outer: OffsetRanges,
    kept: &[OffsetRanges],
    pairs: &[SlidingPair; 6],
    m: &OffsetModel,
    limits: &OffsetLimits,
    out: &mut Division,
) {
    if let Some((sides, greatest)) = limits.pair_too_close(&outer) {
        out.conflicts.push(Conflict::PairTooClose { sides, greatest });
        return;
    }
    let mut signs = Vec::new();
    for (sign, greatest) in [1i8, -1].into_iter().zip(OffsetLimits::determinant_reach(&outer)) {
        if limits.determinant_too_small(greatest) {
            out.conflicts.push(Conflict::DetTooSmall { sign, greatest });
        } else {
            signs.push(f64::from(sign));
        }
    }
    if !signs.is_empty() {
        out.boxes.push(outer);
    }
    let may_be_close = |p: &&SlidingPair| p.least(p.box_of(&outer)) < m.kept_spacing(p.first).powi(2);
    let close: Vec<SlidingPair> = pairs.iter().filter(may_be_close).copied().collect();
    for sign in signs {
        for order in 0..1usize << close.len() {
            let pairs: Vec<(SlidingPair, bool)> =
                close.iter().enumerate().map(|(k, p)| (*p, order >> k & 1 == 1)).collect();
            out.cells.extend(kept.iter().map(|&bounds| BranchCell {
                branch,
                bounds,
                outer,
                pairs: pairs.clone(),
                sign,
            }));
        }
    }
}

/// A feasible point with its worst case.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FeasibleSample {
    pub t: [f64; 6],
    pub value: f64,
}

fn draw(cell: &BranchCell, rng: &mut Rng) -> [f64; 6] {
    cell.bounds.map(|(low, high)| rng.uniform(low, high).min(high))
}

pub(super) fn in_order(cell: &BranchCell, t: &[f64; 6]) -> bool {
    cell.order_rows().iter().all(|&(i, j, [c, x, y])| c + x * t[i] + y * t[j] >= 0.0)
}

/// `true` for a point of the cell that meets all limits.
pub(crate) fn is_feasible(m: &OffsetModel, cell: &BranchCell, t: &[f64; 6]) -> bool {
    in_order(cell, t) && violation(m, cell, t) <= 0.0
}

/// The best of `wanted` feasible points among at most `draws` uniform ones.
pub(crate) fn best_sample(
    m: &OffsetModel,
    cell: &BranchCell,
    rng: &mut Rng,
    wanted: usize,
    draws: usize,
) -> Option<FeasibleSample> {
    let mut best: Option<FeasibleSample> = None;
    let mut hint = 0;
    for t in feasible_points(m, cell, rng, wanted, draws) {
        // -1: the first sample is kept whatever its value
        let floor = best.map_or(-1.0, |b| b.value);
        match worst_case_above(&m.poses, &t, floor, hint) {
            Ok((value, pose)) => {
                hint = pose;
                best = Some(FeasibleSample { t, value });
            }
            Err((_, pose)) => hint = pose,
        }
    }
    best
}

/// At most `wanted` feasible points among `draws` uniform ones.
pub(crate) fn feasible_points(
    m: &OffsetModel,
    cell: &BranchCell,
    rng: &mut Rng,
    wanted: usize,
    draws: usize,
) -> Vec<[f64; 6]> {
    (0..draws).map(|_| draw(cell, rng)).filter(|t| is_feasible(m, cell, t)).take(wanted).collect()
}

/// Distances from the corners of a box in the search for feasible offsets, in units in the last place of an offset.
const NUDGES: [f64; 5] = [0.0, 1.0, 4.0, 16.0, 64.0];

/// Offsets that meet all limits in exact arithmetic, possibly without any margin: at the end of a restoration, or at a
/// corner of the box.
pub(crate) fn tight_point(
    problem: &OffsetProblem,
    cell: &BranchCell,
    restored: &[f64; 6],
) -> Option<[f64; 6]> {
    let corner = |k: usize, nudge: f64| -> [f64; 6] {
        std::array::from_fn(|i| {
            let (low, high) = cell.outer[i];
            let inwards = |end: f64, other: f64| {
                (end + (other - end).signum() * nudge * f64::EPSILON * end.abs()).clamp(low, high)
            };
            if k >> i & 1 == 0 { inwards(low, high) } else { inwards(high, low) }
        })
    };
    // this test saves most of the exact arithmetic
    let may_do = |t: &[f64; 6]| cell.sign * offset_determinant(t) > problem.min_abs_det * (1.0 - 1e-6);
    let corners = (0..64).flat_map(|k| NUDGES.map(|nudge| corner(k, nudge)));
    std::iter::once(*restored)
        .chain(corners.filter(may_do))
        .find(|t| problem.margins(t).is_some_and(|m| m.all_met()))
}

/// The start of the search for a feasible point if sampling finds none: the box vertex with the greatest `sign det A`,
/// pulled slightly inwards.
pub(crate) fn hopeful_point(cell: &BranchCell) -> [f64; 6] {
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

#[cfg(test)]
mod tests {
    use super::super::problem::OffsetProblem;
    use super::super::tests::{example, poses};
    use super::*;

    fn divisions(change: &dyn Fn(&mut OffsetProblem)) -> Vec<Division> {
        let mut p = OffsetProblem::with_defaults(example(), poses());
        change(&mut p);
        divide(&OffsetModel::new(&p), &OffsetLimits::new(&p))
    }

    #[test]
    fn there_are_729_branches_and_every_one_has_cells_or_a_reason() {
        let all = divisions(&|_| ());
        assert_eq!(all.len(), 729);
        assert!(all.iter().all(|d| !d.cells.is_empty() || !d.conflicts.is_empty()));
        assert_eq!(all[364].branch.to_string(), "000000");
        assert_eq!(all[0].branch.to_string(), "------");
        assert_eq!(all[728].branch.to_string(), "++++++");
        // inside everywhere: det A takes both signs
        let signs: Vec<f64> = all[364].cells.iter().map(|c| c.sign).collect();
        assert!(signs.contains(&1.0) && signs.contains(&-1.0));
        // two before, four inside: prod(1 - t) > 0, prod t > 0: both signs; one before: det A > 0 only
        let one = all.iter().find(|d| d.branch.to_string() == "-00000").unwrap();
        assert!(one.cells.iter().all(|c| c.sign > 0.0));
    }

    #[test]
    fn spacing_wider_than_half_an_edge_leaves_no_space_inside() {
        // platform edge 6, spacing 3.1: nothing inside platform edges, base edges keep space
        let all = divisions(&|p| p.min_joint_distance = 3.1);
        for d in &all {
            let platform_inside = [1, 3, 5].iter().any(|&i| d.branch.0[i] == Zone::Inside);
            assert_eq!(d.cells.is_empty(), platform_inside, "{}", d.branch);
        }
        let d = &all[364];
        assert!(d.conflicts.iter().all(|c| matches!(c, Conflict::NoSpace { zone: Zone::Inside, .. })));
        assert_eq!(d.conflicts.len(), 3);
    }

    #[test]
    fn a_vertex_near_an_edge_splits_the_zone() {
        let all = divisions(&|p| p.min_joint_distance = 5.5);
        // The height of the platform triangle is 5.196 < 5.5. Base edges (height 10.39) are not split, and platform
        // zones before and beyond begin one spacing from the vertices.
        let d = all.iter().find(|d| d.branch.to_string() == "0-0-0-").unwrap();
        assert!(d.cells.iter().all(|c| c.bounds[1].1 < -5.4 / 6.0));
        let inside = free_intervals(
            &OffsetModel::new(&OffsetProblem::with_defaults(example(), poses())).sides[1],
            (-1.0, 2.0),
            0.1,
        );
        assert_eq!(inside.len(), 3);
    }

    #[test]
    fn bounds_inside_the_edges_leave_one_branch() {
        let all = divisions(&|p| p.bounds = [(0.1, 0.9); 6]);
        assert_eq!(all.iter().filter(|d| !d.cells.is_empty()).count(), 1);
        assert!(matches!(all[0].conflicts[0], Conflict::OutsideBounds { side: 0, zone: Zone::Before }));
    }
}
