//! The 3^6 branches of the offsets and their division into cells on which the constraints have one shape.

use super::conflict::Conflict;
use super::hexagon::{Side, offset_determinant};
use super::problem::{BACKOFF, Model};
use super::spacing::Pair;

/// Where a joint sits relative to its edge.
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

    /// For messages.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Before => "before the edge",
            Self::Inside => "inside the edge",
            Self::Beyond => "beyond the edge",
        }
    }

    /// The offsets of the zone.
    pub(crate) fn range(self) -> (f64, f64) {
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
    pub(crate) fn of(t: &[f64; 6]) -> Self {
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
    pub(crate) fn index(self) -> usize {
        self.0.iter().fold(0, |n, z| 3 * n + *z as usize)
    }
}

impl std::fmt::Display for Branch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|z| write!(f, "{}", z.symbol()))
    }
}

/// A closed interval of one offset on which the spacing from all vertices holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// What is left of a zone: intervals, or the reason why there are none (`None`: less than rounding is left).
pub(crate) type Room = Result<Vec<Interval>, Option<Conflict>>;

fn remove(intervals: &mut Vec<Interval>, centre: f64, half: f64) {
    let (a, b) = (centre - half, centre + half);
    let pieces = intervals.iter().flat_map(|i| {
        [Interval { low: i.low, high: i.high.min(a) }, Interval { low: i.low.max(b), high: i.high }]
    });
    *intervals = pieces.filter(|i| i.low <= i.high).collect();
}

fn free_intervals(side: &Side, range: (f64, f64), spacing: f64) -> Vec<Interval> {
    let (edge, length) = (side.edge(), side.edge_length());
    let mut left = vec![Interval { low: range.0, high: range.1 }];
    for vertex in [side.start, side.end, side.opposite] {
        let foot = (vertex - side.start).dot(&edge) / (length * length);
        let height = (vertex - side.joint(foot)).norm();
        if height < spacing {
            remove(&mut left, foot, (spacing * spacing - height * height).sqrt() / length);
        }
    }
    left
}

fn room(side: usize, zone: Zone, m: &Model, scale: f64) -> Room {
    let (bounds, range) = (m.bounds[side], zone.range());
    let cut = (bounds.0.max(range.0), bounds.1.min(range.1));
    if cut.0 > cut.1 {
        return Err(Some(Conflict::OutsideBounds { side, zone }));
    }
    let kept = free_intervals(&m.sides[side], cut, m.kept_spacing());
    if !kept.is_empty() {
        return Ok(kept);
    }
    let exact = free_intervals(&m.sides[side], cut, m.spacing - BACKOFF);
    let available = (cut.1 - cut.0) * m.sides[side].edge_length() * scale;
    Err(exact.is_empty().then_some(Conflict::NoRoom { side, zone, available }))
}

/// A part of a branch: a box, the order of close pairs (the joint farther from the common vertex) and the
/// sign of `det A`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cell {
    pub(crate) branch: usize,
    pub(crate) bounds: [(f64, f64); 6],
    /// Pairs whose spacing can be violated inside the box, with `true` when the first joint is farther out.
    pub(crate) pairs: Vec<(Pair, bool)>,
    pub(crate) sign: f64,
}

/// A branch with its cells and the conflicts that emptied the others.
#[derive(Debug, Clone)]
pub(crate) struct Division {
    pub(crate) branch: Branch,
    pub(crate) cells: Vec<Cell>,
    pub(crate) conflicts: Vec<Conflict>,
    /// Parts that are empty only to within rounding: neither searched nor proved empty.
    pub(crate) unproved: usize,
}

/// Least and greatest value of `det A` on a box, at vertices: it is affine in every offset.
pub(crate) fn determinant_range(bounds: &[(f64, f64); 6]) -> (f64, f64) {
    let corner = |k: usize| -> [f64; 6] {
        std::array::from_fn(|i| if k >> i & 1 == 0 { bounds[i].0 } else { bounds[i].1 })
    };
    let values = (0..64).map(|k| offset_determinant(&corner(k)));
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |r, d| (r.0.min(d), r.1.max(d)))
}

impl Cell {
    /// `+-(|1 - t_i| d_i - |t_j| d_j) >= 0` of each ordered pair as `constant + by first + by second`.
    pub(crate) fn order_rows(&self) -> Vec<(usize, usize, [f64; 3])> {
        let row = |(pair, first_farther): &(Pair, bool)| {
            let (e, f) = pair.edges();
            let (x, y) = (self.bounds[pair.first], self.bounds[pair.second]);
            let outward = if x.0 + x.1 < 2.0 { 1.0 } else { -1.0 };
            let along = if y.0 + y.1 > 0.0 { 1.0 } else { -1.0 };
            let s = if *first_farther { 1.0 } else { -1.0 };
            (pair.first, pair.second, [s * outward * e, -s * outward * e, -s * along * f])
        };
        self.pairs.iter().map(row).collect()
    }
}

/// All branches with their cells. Lengths in conflicts are in design units (`scale` times the model's).
pub(crate) fn divide(m: &Model, scale: f64) -> Vec<Division> {
    let rooms: Vec<[Room; 3]> = (0..6).map(|i| Zone::ALL.map(|z| room(i, z, m, scale))).collect();
    let pairs = Pair::all(&m.sides);
    let divide_one = |(index, branch): (usize, Branch)| {
        let mut out = Division { branch, cells: Vec::new(), conflicts: Vec::new(), unproved: 0 };
        let mut boxes: Vec<[(f64, f64); 6]> = vec![[(0.0, 0.0); 6]];
        for (i, zone) in branch.0.iter().enumerate() {
            match &rooms[i][*zone as usize] {
                Ok(list) => {
                    let extend = |b: &[(f64, f64); 6], v: &Interval| {
                        let mut b = *b;
                        b[i] = (v.low, v.high);
                        b
                    };
                    boxes = boxes.iter().flat_map(|b| list.iter().map(move |v| extend(b, v))).collect();
                }
                Err(why) => {
                    boxes.clear();
                    match why {
                        Some(conflict) => out.conflicts.push(conflict.clone()),
                        None => out.unproved += 1,
                    }
                }
            }
        }
        if !out.conflicts.is_empty() {
            out.unproved = 0; // one proved conflict empties the branch
        }
        for bounds in boxes {
            split(index, bounds, &pairs, m, scale, &mut out);
        }
        out
    };
    Branch::all().into_iter().enumerate().map(divide_one).collect()
}

fn split(
    branch: usize,
    bounds: [(f64, f64); 6],
    pairs: &[Pair; 6],
    m: &Model,
    scale: f64,
    out: &mut Division,
) {
    let (spacing, kept) = (m.spacing, m.kept_spacing());
    for pair in pairs {
        let greatest = pair.greatest(pair.box_of(&bounds)).sqrt();
        if greatest < spacing - BACKOFF {
            let sides = (pair.first, pair.second);
            out.conflicts.push(Conflict::PairTooClose { sides, greatest: greatest * scale });
            return;
        }
    }
    let close: Vec<Pair> =
        pairs.iter().filter(|p| p.least(p.box_of(&bounds)) < kept * kept).copied().collect();
    let range = determinant_range(&bounds);
    for (sign, greatest) in [(1i8, range.1), (-1, -range.0)] {
        if greatest < m.min_abs_det - BACKOFF {
            out.conflicts.push(Conflict::DetTooSmall { sign, greatest });
            continue;
        }
        for order in 0..1usize << close.len() {
            let pairs = close.iter().enumerate().map(|(k, p)| (*p, order >> k & 1 == 1)).collect();
            out.cells.push(Cell { branch, bounds, pairs, sign: f64::from(sign) });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::problem::OffsetProblem;
    use super::super::tests::{example, poses};
    use super::*;

    fn divisions(change: &dyn Fn(&mut OffsetProblem)) -> Vec<Division> {
        let mut p = OffsetProblem::with_defaults(example(), poses());
        change(&mut p);
        divide(&Model::new(&p), p.size())
    }

    #[test]
    fn there_are_729_branches_and_every_one_has_cells_or_a_reason() {
        let all = divisions(&|_| ());
        assert_eq!(all.len(), 729);
        assert!(all.iter().all(|d| !d.cells.is_empty() || !d.conflicts.is_empty() || d.unproved > 0));
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
    fn spacing_wider_than_half_an_edge_leaves_no_room_inside() {
        // platform edge 6, spacing 3.1: nothing inside platform edges, base edges keep room
        let all = divisions(&|p| p.min_joint_distance = 3.1);
        for d in &all {
            let platform_inside = [1, 3, 5].iter().any(|&i| d.branch.0[i] == Zone::Inside);
            assert_eq!(d.cells.is_empty(), platform_inside, "{}", d.branch);
        }
        let d = &all[364];
        assert!(d.conflicts.iter().all(|c| matches!(c, Conflict::NoRoom { zone: Zone::Inside, .. })));
        assert_eq!(d.conflicts.len(), 3);
    }

    #[test]
    fn a_vertex_near_an_edge_splits_the_zone() {
        let all = divisions(&|p| p.min_joint_distance = 5.5);
        // the height of the platform triangle is 5.196 < 5.5; base edges (height 10.39) are not split,
        // platform zones before and beyond start one spacing away from the vertices
        let d = all.iter().find(|d| d.branch.to_string() == "0-0-0-").unwrap();
        assert!(d.cells.iter().all(|c| c.bounds[1].1 < -5.4 / 6.0));
        let inside = free_intervals(
            &Model::new(&OffsetProblem::with_defaults(example(), poses())).sides[1],
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
