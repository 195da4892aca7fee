//! Triangles on a grid whose sides carry grid points where joints are wanted.

use super::grid::Cell;

/// Reaches that are tried, in pitches: each larger by this factor than the one before.
const GROWTH: f64 = 1.25;
const FIRST_REACH: f64 = 0.75;
/// Triangles kept of a body, at most: the nearest ones.
const POOL: usize = 3000;

/// Where corners and joints on the sides are wanted, in pitches; side `k` runs from corner `k` to corner `k + 1`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted {
    pub(super) corners: [[f64; 2]; 3],
    /// Absent for a body without joints on its sides.
    pub(super) inner: Option<[[f64; 2]; 3]>,
}

/// A triangle on the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Triangle {
    /// Largest distance of a joint from where it is wanted, pitches.
    pub(super) deviation: f64,
    pub(super) corners: [Cell; 3],
    /// Side `k` has `parts[k]` equal parts between grid points; its joint is at the end of part `inner[k]` (below 0 or above `parts` on an extension).
    pub(super) parts: [i64; 3],
    pub(super) inner: [i64; 3],
}

impl Triangle {
    /// The joint on a side.
    pub(super) fn joint(&self, k: usize) -> Cell {
        let (from, to) = (self.corners[k], self.corners[(k + 1) % 3]);
        [0, 1].map(|i| from[i] + (to[i] - from[i]) / self.parts[k] * self.inner[k])
    }
}

/// The triangles within a reach.
#[derive(Debug, Clone)]
pub(super) struct Pool {
    /// Nearest first.
    pub(super) triangles: Vec<Triangle>,
    /// All triangles whose joints are within this many pitches of their places are among them.
    pub(super) complete_to: f64,
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

fn distance(cell: Cell, wanted: [f64; 2]) -> f64 {
    (cell[0] as f64 - wanted[0]).hypot(cell[1] as f64 - wanted[1])
}

fn cells_within(centre: [f64; 2], reach: f64) -> Vec<Cell> {
    let range = |k: usize| (centre[k] - reach).ceil() as i64..=(centre[k] + reach).floor() as i64;
    let all = range(0).flat_map(|i| range(1).map(move |j| [i, j]));
    all.filter(|c| distance(*c, centre) <= reach).collect()
}

/// A side between two cells with its joint: index of the second cell, parts, joint, distance of the joint from where it is wanted.
#[derive(Debug, Clone, Copy)]
struct Side {
    to: usize,
    parts: i64,
    inner: i64,
    off: f64,
}

/// The sides from `p` to `q` (cell number `to`) with a joint within `reach` of `wanted` that is no corner.
fn sides(p: Cell, (to, q): (usize, Cell), wanted: Option<[f64; 2]>, reach: f64, out: &mut Vec<Side>) {
    let d = [q[0] - p[0], q[1] - p[1]];
    let parts = gcd(d[0], d[1]);
    if parts == 0 {
        return;
    }
    let Some(wanted) = wanted else {
        out.push(Side { to, parts, inner: 0, off: 0.0 });
        return;
    };
    let step = d.map(|x| (x / parts) as f64);
    let length = step[0].hypot(step[1]);
    let from = [wanted[0] - p[0] as f64, wanted[1] - p[1] as f64];
    let across = (from[0] * step[1] - from[1] * step[0]).abs() / length;
    if across > reach {
        return;
    }
    let middle = (from[0] * step[0] + from[1] * step[1]) / (length * length);
    let half = (reach * reach - across * across).sqrt() / length;
    for inner in (middle - half).ceil() as i64..=(middle + half).floor() as i64 {
        if inner != 0 && inner != parts {
            let joint = [0, 1].map(|k| p[k] + d[k] / parts * inner);
            out.push(Side { to, parts, inner, off: distance(joint, wanted) });
        }
    }
}

/// All triangles whose corners and joints are within `reach` of their places.
fn within(wanted: &Wanted, reach: f64) -> Vec<Triangle> {
    let cells = wanted.corners.map(|c| cells_within(c, reach));
    // sides of each kind by the number of their first cell
    let table = |k: usize| -> Vec<Vec<Side>> {
        let next = &cells[(k + 1) % 3];
        let all = |p: &Cell| {
            let mut out = Vec::new();
            for (to, q) in next.iter().enumerate() {
                sides(*p, (to, *q), wanted.inner.map(|w| w[k]), reach, &mut out);
            }
            out
        };
        cells[k].iter().map(all).collect()
    };
    let [first, second, third] = [0, 1, 2].map(table);
    let mut out = Vec::new();
    for (i, a) in cells[0].iter().enumerate() {
        for x in &first[i] {
            let b = cells[1][x.to];
            for y in &second[x.to] {
                let c = cells[2][y.to];
                let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                if doubled == 0 {
                    continue;
                }
                // `third` is sorted by the number of the cell it ends at
                let from = third[y.to].partition_point(|z| z.to < i);
                for z in third[y.to][from..].iter().take_while(|z| z.to == i) {
                    let corners = [*a, b, c];
                    let off = (0..3).map(|k| distance(corners[k], wanted.corners[k]));
                    out.push(Triangle {
                        deviation: off.chain([x.off, y.off, z.off]).fold(0.0, f64::max),
                        corners,
                        parts: [x.parts, y.parts, z.parts],
                        inner: [x.inner, y.inner, z.inner],
                    });
                }
            }
        }
    }
    out
}

/// The nearest triangles: the reach grows until there are `enough` or it passes `limit` (pitches).
pub(super) fn pool(wanted: &Wanted, enough: usize, limit: f64) -> Pool {
    let mut reach = FIRST_REACH.min(limit);
    let mut triangles = within(wanted, reach);
    while triangles.len() < enough && reach * GROWTH <= limit {
        reach *= GROWTH;
        triangles = within(wanted, reach);
    }
    let key = |t: &Triangle| (t.corners, t.inner);
    triangles.sort_by(|a, b| a.deviation.total_cmp(&b.deviation).then_with(|| key(a).cmp(&key(b))));
    let mut complete_to = reach;
    if let Some(first_left_out) = triangles.get(POOL) {
        complete_to = first_left_out.deviation;
        triangles.retain(|t| t.deviation < complete_to);
    }
    Pool { triangles, complete_to }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted() -> Wanted {
        let corners = [[0.3, 0.2], [24.1, 1.4], [11.2, 20.7]];
        let inner = [0, 1, 2].map(|k| {
            let (a, b): ([f64; 2], [f64; 2]) = (corners[k], corners[(k + 1) % 3]);
            [0, 1].map(|i| a[i] + 0.27 * (b[i] - a[i]))
        });
        Wanted { corners, inner: Some(inner) }
    }

    #[test]
    fn joints_are_cells_on_the_lines_of_the_sides() {
        let found = pool(&wanted(), 40, 8.0);
        assert!(found.triangles.len() >= 40, "{}", found.triangles.len());
        for t in &found.triangles {
            for k in 0..3 {
                let (a, b, x) = (t.corners[k], t.corners[(k + 1) % 3], t.joint(k));
                assert_eq!((b[0] - a[0]) * (x[1] - a[1]), (b[1] - a[1]) * (x[0] - a[0]));
                assert!(x != a && x != b);
                assert!(distance(x, wanted().inner.unwrap()[k]) <= t.deviation + 1e-12);
            }
        }
        assert!(found.triangles.windows(2).all(|w| w[0].deviation <= w[1].deviation));
    }

    #[test]
    fn a_search_of_all_cells_finds_no_nearer_triangle() {
        let (w, found) = (wanted(), pool(&wanted(), 5, 8.0));
        let reach = found.complete_to;
        let mut count = 0;
        let inner = w.inner.unwrap();
        for a in cells_within(w.corners[0], reach) {
            for b in cells_within(w.corners[1], reach) {
                for c in cells_within(w.corners[2], reach) {
                    let corners = [a, b, c];
                    // grid points near the wanted joints that are on the line of their side
                    let on = |k: usize| {
                        let (p, q) = (corners[k], corners[(k + 1) % 3]);
                        let line = move |x: &Cell| {
                            (q[0] - p[0]) * (x[1] - p[1]) == (q[1] - p[1]) * (x[0] - p[0])
                                && *x != p
                                && *x != q
                        };
                        cells_within(inner[k], reach).into_iter().filter(line).count()
                    };
                    count += on(0) * on(1) * on(2);
                }
            }
        }
        assert_eq!(count, found.triangles.len());
    }

    #[test]
    fn a_body_without_joints_on_its_sides_is_rounded_corner_by_corner() {
        let found = pool(&Wanted { inner: None, ..wanted() }, 1, 8.0);
        assert_eq!(found.triangles[0].corners, [[0, 0], [24, 1], [11, 21]]);
    }
}
