//! A grid of holes in the plane of a body, and triangles on it whose sides carry grid points where joints are wanted.

use nalgebra::{Matrix3, Point3, Vector3};

use crate::num::small::symmetric_eigen3;

/// Joints count as lying in a plane within this times the size of the design.
const FLAT: f64 = 1e-9;
/// Cells farther out than this are not counted exactly.
const FARTHEST: f64 = 1e6;

/// A square grid of holes.
///
/// Its axes are the x and y axes of the body frame, projected on the plane of the joints and turned by the angle; its origin is the projection of the
/// origin of the frame, shifted along these axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Distance of neighbouring holes, design units, positive.
    pub pitch: f64,
    /// A hole, in the axes of the grid before it is turned, design units.
    pub origin: [f64; 2],
    /// Turn about the normal of the plane, degrees.
    pub angle_deg: f64,
}

/// A hole, counted from the origin along both axes.
pub(super) type GridHole = [i64; 2];

/// A grid laid into the plane of the joints of a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyGrid {
    origin: Point3<f64>,
    axes: [Vector3<f64>; 2],
    pitch: f64,
}

/// Normal of the plane through the points, to positive z (then y, then x); `None` when they do not lie in one.
fn normal(points: &[Point3<f64>], size: f64) -> Option<Vector3<f64>> {
    let first = points.first()?;
    if points.iter().all(|p| (p.z - first.z).abs() <= FLAT * size) {
        return Some(Vector3::z());
    }
    let centre = points.iter().map(|p| p - first).sum::<Vector3<f64>>() / points.len() as f64;
    let moments: Matrix3<f64> = points.iter().map(|p| p - first - centre).map(|d| d * d.transpose()).sum();
    let (values, vectors) = symmetric_eigen3(&moments);
    let n: Vector3<f64> = vectors.column(values.imin()).normalize();
    let leading = [n.z, n.y, n.x].into_iter().find(|x| x.abs() > FLAT);
    let n = if leading.is_some_and(|x| x < 0.0) { -n } else { n };
    points.iter().all(|p| (p - first - centre).dot(&n).abs() <= FLAT * size).then_some(n)
}

impl BodyGrid {
    /// `None` when the joints do not lie in a plane.
    pub(super) fn new(points: &[Point3<f64>], grid: &Grid, size: f64) -> Option<Self> {
        let n = normal(points, size)?;
        let along = if n.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        let x = (along - n * n.dot(&along)).normalize();
        let y = n.cross(&x);
        let foot = n * points[0].coords.dot(&n);
        let origin = Point3::from(foot + x * grid.origin[0] + y * grid.origin[1]);
        let (s, c) = grid.angle_deg.to_radians().sin_cos();
        Some(Self { origin, axes: [x * c + y * s, y * c - x * s], pitch: grid.pitch })
    }

    /// A point of the plane in pitches.
    pub(super) fn coordinates(&self, p: &Point3<f64>) -> [f64; 2] {
        self.axes.map(|axis| (p - self.origin).dot(&axis) / self.pitch)
    }

    /// The hole.
    pub(super) fn point(&self, cell: GridHole) -> Point3<f64> {
        let along = |k: usize| self.axes[k] * (cell[k] as f64 * self.pitch);
        self.origin + (along(0) + along(1))
    }

    pub(super) fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Whether all points are near enough for cells to be counted.
    pub(super) fn reaches(&self, points: &[Point3<f64>]) -> bool {
        points.iter().all(|p| self.coordinates(p).iter().all(|x| x.abs() < FARTHEST))
    }
}

/// Reaches that are tried, in pitches: each larger by this factor than the one before.
const GROWTH: f64 = 1.25;
/// The first of them, in pitches.
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
    deviation: f64,
    pub(super) corners: [GridHole; 3],
    /// Side `k` has `parts[k]` equal parts between grid points; its joint is at the end of part `inner[k]` (below 0 or above `parts` on an extension).
    pub(super) parts: [i64; 3],
    pub(super) inner: [i64; 3],
}

impl Triangle {
    /// The joint on a side.
    pub(super) fn joint(&self, k: usize) -> GridHole {
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

fn distance(cell: GridHole, wanted: [f64; 2]) -> f64 {
    (cell[0] as f64 - wanted[0]).hypot(cell[1] as f64 - wanted[1])
}

fn cells_within(centre: [f64; 2], reach: f64) -> Vec<GridHole> {
    let range = |k: usize| (centre[k] - reach).ceil() as i64..=(centre[k] + reach).floor() as i64;
    let all = range(0).flat_map(|i| range(1).map(move |j| [i, j]));
    all.filter(|c| distance(*c, centre) <= reach).collect()
}

/// A side between two cells with its joint: index of the second cell, parts, joint, distance of the joint from where it is wanted.
#[derive(Debug, Clone, Copy)]
struct GridSide {
    to: usize,
    parts: i64,
    inner: i64,
    off: f64,
}

/// The sides from `p` to `q` (cell number `to`) with a joint within `reach` of `wanted` that is not a corner.
fn sides(
    p: GridHole,
    (to, q): (usize, GridHole),
    wanted: Option<[f64; 2]>,
    reach: f64,
    out: &mut Vec<GridSide>,
) {
    let d = [q[0] - p[0], q[1] - p[1]];
    let parts = gcd(d[0], d[1]);
    if parts == 0 {
        return;
    }
    let Some(wanted) = wanted else {
        out.push(GridSide { to, parts, inner: 0, off: 0.0 });
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
            out.push(GridSide { to, parts, inner, off: distance(joint, wanted) });
        }
    }
}

/// All triangles whose corners and joints are within `reach` of their places.
fn within(wanted: &Wanted, reach: f64) -> Vec<Triangle> {
    let cells = wanted.corners.map(|c| cells_within(c, reach));
    // sides of each kind by the number of their first cell
    let table = |k: usize| -> Vec<Vec<GridSide>> {
        let next = &cells[(k + 1) % 3];
        let all = |p: &GridHole| {
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

    const GRID: Grid = Grid { pitch: 0.5, origin: [0.0, 0.0], angle_deg: 0.0 };

    #[test]
    fn cells_of_a_level_plane_are_multiples_of_the_pitch() {
        let points = [Point3::new(1.0, 2.0, 3.0), Point3::new(-1.0, 7.0, 3.0), Point3::new(5.0, 0.0, 3.0)];
        let g = BodyGrid::new(&points, &GRID, 5.0).unwrap();
        assert_eq!(g.point([3, -7]), Point3::new(1.5, -3.5, 3.0));
        let [x, y] = g.coordinates(&Point3::new(1.5, -3.5, 3.0));
        assert!((x - 3.0).abs() < 1e-15 && (y + 7.0).abs() < 1e-15);
    }

    #[test]
    fn a_tilted_plane_keeps_its_points_and_a_body_in_space_is_refused() {
        let (u, v) = (Vector3::new(1.0, 0.2, 0.3), Vector3::new(-0.1, 1.0, 2.0));
        let at = |x: f64, y: f64| Point3::new(0.3, 0.1, -2.0) + u * x + v * y;
        let points = [at(0.0, 1.0), at(1.0, 0.0), at(3.0, 2.0), at(-1.0, 4.0)];
        let grid = Grid { pitch: 0.25, origin: [0.1, 0.2], angle_deg: 17.0 };
        let g = BodyGrid::new(&points, &grid, 5.0).unwrap();
        for p in points {
            let [x, y] = g.coordinates(&p);
            let back = g.origin + (g.axes[0] * x + g.axes[1] * y) * g.pitch;
            assert!((back - p).norm() < 1e-12);
        }
        let mut bent = points;
        bent[0].x += 1e-6;
        assert!(BodyGrid::new(&bent, &grid, 5.0).is_none());
    }

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
                        let line = move |x: &GridHole| {
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
