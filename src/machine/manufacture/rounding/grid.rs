//! A grid of holes in the plane of a body, and triangles on it whose sides carry grid points near given joints.

use nalgebra::{Matrix3, Point3, Vector3};

use crate::requirements::{Grid, HolePattern};
use num::small::symmetric_eigen3;

/// Joints count as lying in a plane within this times the size of the design.
const FLAT: f64 = 1e-9;
/// Cells farther out than this cannot be counted exactly.
const FARTHEST: f64 = 1e6;

/// A hole, counted from the origin along both axes.
pub(super) type GridHole = [i64; 2];

/// Sine of the angle between axes with this dot product.
fn height(skew: f64) -> f64 {
    (1.0 - skew * skew).sqrt()
}

/// Length of a displacement in pitches along axes with this dot product.
pub(super) fn length([x, y]: [f64; 2], skew: f64) -> f64 {
    (x + skew * y).hypot(y * height(skew))
}

/// A grid laid into the plane of the joints of a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyGrid {
    origin: Point3<f64>,
    /// Unit vectors along which holes are counted.
    axes: [Vector3<f64>; 2],
    /// Their dot product.
    skew: f64,
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

/// The plane of the joints of a body, with the axes x and y of its frame projected on it.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointPlane {
    /// The projection of the origin of the frame.
    foot: Point3<f64>,
    x: Vector3<f64>,
    y: Vector3<f64>,
}

impl JointPlane {
    /// `None` when the joints do not lie in a plane.
    pub(super) fn of(points: &[Point3<f64>], size: f64) -> Option<Self> {
        let n = normal(points, size)?;
        let along = if n.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        let x = (along - n * n.dot(&along)).normalize();
        Some(Self { foot: Point3::from(n * points[0].coords.dot(&n)), x, y: n.cross(&x) })
    }

    pub(super) fn normal(&self) -> Vector3<f64> {
        self.x.cross(&self.y)
    }

    /// The point with these coordinates relative to an origin in the plane.
    pub(super) fn point(&self, [u, v]: [f64; 2], origin: [f64; 2]) -> Point3<f64> {
        self.foot + self.x * (origin[0] + u) + self.y * (origin[1] + v)
    }

    /// Coordinates of a point relative to an origin in the plane.
    pub(super) fn coordinates(&self, p: &Point3<f64>, origin: [f64; 2]) -> [f64; 2] {
        let d = p - self.foot;
        [d.dot(&self.x) - origin[0], d.dot(&self.y) - origin[1]]
    }
}

impl BodyGrid {
    /// `None` when the joints do not lie in a plane, and where the pattern has no axes.
    pub(super) fn new(points: &[Point3<f64>], grid: &Grid, size: f64) -> Option<Self> {
        let JointPlane { foot, x, y } = JointPlane::of(points, size)?;
        let origin = foot + x * grid.origin[0] + y * grid.origin[1];
        let (s, c) = grid.angle_deg.to_radians().sin_cos();
        let (first, across) = (x * c + y * s, y * c - x * s);
        let skew = grid.pattern.skew()?;
        let second = first * skew + across * height(skew);
        Some(Self { origin, axes: [first, second], skew, pitch: grid.pitch })
    }

    /// A point of the plane in pitches along the axes.
    pub(super) fn coordinates(&self, p: &Point3<f64>) -> [f64; 2] {
        let [u, v] = self.axes.map(|axis| (p - self.origin).dot(&axis) / self.pitch);
        let g = self.skew;
        [(u - g * v) / (1.0 - g * g), (v - g * u) / (1.0 - g * g)]
    }

    /// Cosine of the angle between the axes.
    pub(super) fn skew(&self) -> f64 {
        self.skew
    }

    /// The hole.
    pub(super) fn point(&self, cell: GridHole) -> Point3<f64> {
        let along = |k: usize| self.axes[k] * (cell[k] as f64 * self.pitch);
        self.origin + (along(0) + along(1))
    }

    pub(super) fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Whether all points are near enough to count cells exactly.
    pub(super) fn reaches(&self, points: &[Point3<f64>]) -> bool {
        points.iter().all(|p| self.coordinates(p).iter().all(|x| x.abs() < FARTHEST))
    }
}

/// Growth factor between successive tried reaches.
const GROWTH: f64 = 1.25;
/// The first tried reach, pitches.
const FIRST_REACH: f64 = 0.75;
/// Greatest number of triangles kept for a body: the nearest ones.
pub(super) const POOL: usize = 3000;

/// Given places of corners and of joints on the sides, pitches; side `k` runs from corner `k` to corner `k + 1`.
#[derive(Debug, Clone, Copy)]
pub(super) struct TargetPlaces {
    pub(super) corners: [[f64; 2]; 3],
    /// Absent for a body without joints on its sides.
    pub(super) inner: Option<[[f64; 2]; 3]>,
    /// Cosine of the angle between the axes of the grid.
    pub(super) skew: f64,
}

/// A triangle on the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GridTriangle {
    /// Largest distance of a joint from its given place, pitches.
    deviation: f64,
    pub(super) corners: [GridHole; 3],
    /// Side `k` has `parts[k]` equal parts between grid points; its joint ends part `inner[k]`, which is below 0 or
    /// above `parts` on an extension.
    pub(super) parts: [i64; 3],
    pub(super) inner: [i64; 3],
}

impl GridTriangle {
    /// The joint on a side.
    pub(super) fn joint(&self, k: usize) -> GridHole {
        let (from, to) = (self.corners[k], self.corners[(k + 1) % 3]);
        [0, 1].map(|i| from[i] + (to[i] - from[i]) / self.parts[k] * self.inner[k])
    }
}

/// The triangles within a reach.
#[derive(Debug, Clone)]
pub(super) struct TrianglePool {
    /// Nearest first.
    pub(super) triangles: Vec<GridTriangle>,
    /// The list holds all triangles whose joints are within this many pitches of their places.
    pub(super) complete_to: f64,
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

fn distance(cell: GridHole, target: [f64; 2], skew: f64) -> f64 {
    length([cell[0] as f64 - target[0], cell[1] as f64 - target[1]], skew)
}

fn cells_within(centre: [f64; 2], reach: f64, skew: f64) -> Vec<GridHole> {
    // a circle reaches farther along skew axes
    let span = reach / height(skew);
    let range = |k: usize| (centre[k] - span).ceil() as i64..=(centre[k] + span).floor() as i64;
    let all = range(0).flat_map(|i| range(1).map(move |j| [i, j]));
    all.filter(|c| distance(*c, centre, skew) <= reach).collect()
}

/// A side between two cells with its joint: index of the second cell, parts, joint, distance of the joint from its
/// given place.
#[derive(Debug, Clone, Copy)]
struct GridSide {
    to: usize,
    parts: i64,
    inner: i64,
    off: f64,
}

/// The sides from `p` to `q` (cell number `to`) with a joint within `reach` of `target` that is not a corner.
fn sides(
    p: GridHole,
    (to, q): (usize, GridHole),
    target: Option<[f64; 2]>,
    (reach, skew): (f64, f64),
    out: &mut Vec<GridSide>,
) {
    let d = [q[0] - p[0], q[1] - p[1]];
    let parts = gcd(d[0], d[1]);
    if parts == 0 {
        return;
    }
    let Some(target) = target else {
        out.push(GridSide { to, parts, inner: 0, off: 0.0 });
        return;
    };
    let step = d.map(|x| (x / parts) as f64);
    let length = length(step, skew);
    let from = [target[0] - p[0] as f64, target[1] - p[1] as f64];
    let across = (from[0] * step[1] - from[1] * step[0]).abs() * height(skew) / length;
    if across > reach {
        return;
    }
    let mixed = skew * (from[0] * step[1] + from[1] * step[0]);
    let middle = (from[0] * step[0] + from[1] * step[1] + mixed) / (length * length);
    let half = (reach * reach - across * across).sqrt() / length;
    for inner in (middle - half).ceil() as i64..=(middle + half).floor() as i64 {
        if inner != 0 && inner != parts {
            let joint = [0, 1].map(|k| p[k] + d[k] / parts * inner);
            out.push(GridSide { to, parts, inner, off: distance(joint, target, skew) });
        }
    }
}

/// All triangles whose corners and joints are within `reach` of their places.
fn within(target: &TargetPlaces, reach: f64) -> Vec<GridTriangle> {
    let skew = target.skew;
    let cells = target.corners.map(|c| cells_within(c, reach, skew));
    // sides of each kind by the number of their first cell
    let table = |k: usize| -> Vec<Vec<GridSide>> {
        let next = &cells[(k + 1) % 3];
        let all = |p: &GridHole| {
            let mut out = Vec::new();
            for (to, q) in next.iter().enumerate() {
                sides(*p, (to, *q), target.inner.map(|w| w[k]), (reach, skew), &mut out);
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
                    let off = (0..3).map(|k| distance(corners[k], target.corners[k], skew));
                    out.push(GridTriangle {
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
pub(super) fn pool(target: &TargetPlaces, enough: usize, limit: f64) -> TrianglePool {
    let mut reach = FIRST_REACH.min(limit);
    let mut triangles = within(target, reach);
    while triangles.len() < enough && reach * GROWTH <= limit {
        reach *= GROWTH;
        triangles = within(target, reach);
    }
    nearest_first(triangles, reach)
}

/// The nearest of the triangles within a reach.
fn nearest_first(mut triangles: Vec<GridTriangle>, reach: f64) -> TrianglePool {
    let key = |t: &GridTriangle| (t.corners, t.inner);
    triangles.sort_by(|a, b| a.deviation.total_cmp(&b.deviation).then_with(|| key(a).cmp(&key(b))));
    let mut complete_to = reach;
    if let Some(first_left_out) = triangles.get(POOL) {
        complete_to = first_left_out.deviation;
        triangles.retain(|t| t.deviation < complete_to);
    }
    TrianglePool { triangles, complete_to }
}

/// Corners and joints within this many pitches of their rotated images count as symmetric.
const TURNED: f64 = 1e-6;

/// The displacement in pitches of a triangular grid, rotated by 120 degrees: its axes `a`, `b` go to `b - a` and `-a`.
fn turned<T: Copy + std::ops::Neg<Output = T> + std::ops::Sub<Output = T>>([i, j]: [T; 2]) -> [T; 2] {
    [-i - j, i]
}

/// The triangles within `limit` (pitches) with three-fold symmetry about the middle of the given one, joints included,
/// nearest first. `None` if the given triangle lacks this symmetry, or the grid has none about its middle.
pub(super) fn three_fold_pool(target: &TargetPlaces, limit: f64) -> Option<TrianglePool> {
    if HolePattern::Triangular.skew() != Some(target.skew) {
        return None;
    }
    let middle = [0, 1].map(|i| target.corners.iter().map(|c| c[i]).sum::<f64>() / 3.0);
    let about = |p: [f64; 2]| {
        let [x, y] = turned([p[0] - middle[0], p[1] - middle[1]]);
        [middle[0] + x, middle[1] + y]
    };
    let near = |p: [f64; 2], q: [f64; 2]| length([p[0] - q[0], p[1] - q[1]], target.skew) <= TURNED;
    // one turn, or two where the corners follow one another the other way round
    let turns = if near(about(target.corners[0]), target.corners[1]) { 1 } else { 2 };
    let turn = |p: [f64; 2]| (0..turns).fold(p, |p, _| about(p));
    let symmetric = |list: &[[f64; 2]; 3]| (0..3).all(|k| near(turn(list[k]), list[(k + 1) % 3]));
    // the image of the hole at the origin
    let shift = turn([0.0; 2]);
    let whole = shift.map(f64::round);
    if !(symmetric(&target.corners) && target.inner.iter().all(symmetric) && near(shift, whole)) {
        return None;
    }
    let turn = |cell: GridHole| {
        let [i, j] = (0..turns).fold(cell, |cell, _| turned(cell));
        [i + whole[0] as i64, j + whole[1] as i64]
    };
    let mut triangles = Vec::new();
    for first in cells_within(target.corners[0], limit, target.skew) {
        let second = turn(first);
        let mut out = Vec::new();
        sides(first, (0, second), target.inner.map(|w| w[0]), (limit, target.skew), &mut out);
        let off = distance(first, target.corners[0], target.skew);
        triangles.extend(out.into_iter().map(|side| GridTriangle {
            deviation: off.max(side.off),
            corners: [first, second, turn(second)],
            parts: [side.parts; 3],
            inner: [side.inner; 3],
        }));
    }
    Some(nearest_first(triangles, limit))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid::square(0.5);

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
        let square = Grid { pitch: 0.25, origin: [0.1, 0.2], angle_deg: 17.0, ..GRID };
        for grid in [Grid { pattern: HolePattern::Triangular, ..square }, square] {
            let g = BodyGrid::new(&points, &grid, 5.0).unwrap();
            for p in points {
                let [x, y] = g.coordinates(&p);
                let back = g.origin + (g.axes[0] * x + g.axes[1] * y) * g.pitch;
                assert!((back - p).norm() < 1e-12);
                // lengths in pitches are those in the plane
                let [u, v] = g.coordinates(&points[0]);
                let apart = length([x - u, y - v], g.skew()) * g.pitch;
                assert!((apart - (p - points[0]).norm()).abs() < 1e-12);
            }
        }
        let grid = square;
        let mut bent = points;
        bent[0].x += 1e-6;
        assert!(BodyGrid::new(&bent, &grid, 5.0).is_none());
    }

    fn target() -> TargetPlaces {
        let corners = [[0.3, 0.2], [24.1, 1.4], [11.2, 20.7]];
        let inner = [0, 1, 2].map(|k| {
            let (a, b): ([f64; 2], [f64; 2]) = (corners[k], corners[(k + 1) % 3]);
            [0, 1].map(|i| a[i] + 0.27 * (b[i] - a[i]))
        });
        TargetPlaces { corners, inner: Some(inner), skew: 0.0 }
    }

    #[test]
    fn joints_are_cells_on_the_lines_of_the_sides() {
        let found = pool(&target(), 40, 8.0);
        assert!(found.triangles.len() >= 40, "{}", found.triangles.len());
        for t in &found.triangles {
            for k in 0..3 {
                let (a, b, x) = (t.corners[k], t.corners[(k + 1) % 3], t.joint(k));
                assert_eq!((b[0] - a[0]) * (x[1] - a[1]), (b[1] - a[1]) * (x[0] - a[0]));
                assert!(x != a && x != b);
                assert!(distance(x, target().inner.unwrap()[k], 0.0) <= t.deviation + 1e-12);
            }
        }
        assert!(found.triangles.windows(2).all(|w| w[0].deviation <= w[1].deviation));
    }

    #[test]
    fn a_search_of_all_cells_finds_no_nearer_triangle() {
        for skew in [0.0, 0.5] {
            let w = TargetPlaces { skew, ..target() };
            let found = pool(&w, 5, 8.0);
            let reach = found.complete_to;
            let mut count = 0;
            let inner = w.inner.unwrap();
            for a in cells_within(w.corners[0], reach, w.skew) {
                for b in cells_within(w.corners[1], reach, w.skew) {
                    for c in cells_within(w.corners[2], reach, w.skew) {
                        let corners = [a, b, c];
                        // grid points near the given joints that are on the line of their side
                        let on = |k: usize| {
                            let (p, q) = (corners[k], corners[(k + 1) % 3]);
                            let line = move |x: &GridHole| {
                                (q[0] - p[0]) * (x[1] - p[1]) == (q[1] - p[1]) * (x[0] - p[0])
                                    && *x != p
                                    && *x != q
                            };
                            cells_within(inner[k], reach, w.skew).into_iter().filter(line).count()
                        };
                        count += on(0) * on(1) * on(2);
                    }
                }
            }
            assert_eq!(count, found.triangles.len());
        }
    }

    #[test]
    fn a_body_without_joints_on_its_sides_is_rounded_corner_by_corner() {
        let found = pool(&TargetPlaces { inner: None, ..target() }, 1, 8.0);
        assert_eq!(found.triangles[0].corners, [[0, 0], [24, 1], [11, 21]]);
    }

    /// A triangle with joints on its sides that is symmetric under rotations by 120 degrees about `middle`, in pitches
    /// of a triangular grid.
    fn three_fold(middle: [f64; 2]) -> TargetPlaces {
        let turns = |start: [f64; 2]| {
            let about = |p: [f64; 2]| [middle[0] + p[0], middle[1] + p[1]];
            [about(start), about(turned(start)), about(turned(turned(start)))]
        };
        let corners = turns([14.2, 3.1]);
        let on = |k: usize| [0, 1].map(|i| corners[k][i] + 0.21 * (corners[(k + 1) % 3][i] - corners[k][i]));
        TargetPlaces { corners, inner: Some([0, 1, 2].map(on)), skew: 0.5 }
    }

    #[test]
    fn three_fold_triangles_of_a_triangular_grid_are_turned_into_themselves() {
        // about a hole, and about the middle of a triangle of holes
        for middle in [[0.0, 0.0], [2.0 / 3.0, -1.0 / 3.0]] {
            for w in [three_fold(middle), mirrored(three_fold(middle))] {
                let found = three_fold_pool(&w, 4.0).unwrap();
                assert!(found.triangles.len() > 5, "{}", found.triangles.len());
                for t in &found.triangles {
                    let side = |k: usize| {
                        let (p, q) = (t.corners[k], t.corners[(k + 1) % 3]);
                        length([(q[0] - p[0]) as f64, (q[1] - p[1]) as f64], 0.5)
                    };
                    assert!((side(0) - side(1)).abs() < 1e-12 && (side(0) - side(2)).abs() < 1e-12);
                    let centre = [0, 1].map(|i| t.corners.iter().map(|c| c[i]).sum::<i64>() as f64 / 3.0);
                    let about = [0, 1].map(|i| w.corners.iter().map(|c| c[i]).sum::<f64>() / 3.0);
                    assert!((centre[0] - about[0]).abs() + (centre[1] - about[1]).abs() < 1e-9);
                }
                // each of them is among all triangles within the reach, and no other of that kind is
                let nearest = found.triangles[0].deviation;
                let all = within(&w, nearest + 1e-9);
                assert!(all.iter().any(|t| t.corners == found.triangles[0].corners));
            }
        }
    }

    /// The other way round.
    fn mirrored(w: TargetPlaces) -> TargetPlaces {
        let [a, b, c] = w.corners;
        let swapped = [a, c, b];
        let on = |k: usize| [0, 1].map(|i| swapped[k][i] + 0.21 * (swapped[(k + 1) % 3][i] - swapped[k][i]));
        TargetPlaces { corners: swapped, inner: Some([0, 1, 2].map(on)), ..w }
    }

    #[test]
    fn what_does_not_turn_has_no_three_fold_triangles() {
        // no symmetry under rotations by 120 degrees: the grid about this middle, the joints, a square grid
        assert!(three_fold_pool(&three_fold([0.25, 0.0]), 4.0).is_none());
        let mut uneven = three_fold([0.0, 0.0]);
        uneven.inner.as_mut().unwrap()[1][0] += 0.01;
        assert!(three_fold_pool(&uneven, 4.0).is_none());
        assert!(three_fold_pool(&TargetPlaces { skew: 0.0, ..three_fold([0.0, 0.0]) }, 4.0).is_none());
    }
}
