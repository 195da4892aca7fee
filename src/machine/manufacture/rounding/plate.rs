//! The holes of a plate in the plane of its joints: on two axes, on circles, or anywhere.

use nalgebra::{Point3, Vector3};

use super::grid::{BodyGrid, GridHole, JointPlane, length};
use crate::requirements::{Grid, HolePattern};

/// Circles farther out than this cannot be counted.
const LAST_CIRCLE: f64 = 1e6;
/// Points count as holes within this share of the distance to the next hole.
const ON_HOLE: f64 = 1e-6;

/// Holes on circles in the plane of the joints of a body. A hole is counted as `[circle, number on it]`, both from 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyCircles {
    grid: Grid,
    plane: JointPlane,
}

impl BodyCircles {
    /// The place as radius and angle (radians) from the first hole of each circle.
    fn polar(&self, p: &Point3<f64>) -> (f64, f64) {
        let [x, y] = self.plane.coordinates(p, self.grid.origin);
        let turn = if x == 0.0 && y == 0.0 { 0.0 } else { y.atan2(x) };
        (x.hypot(y), turn - self.grid.angle_deg.to_radians())
    }

    fn point(&self, [circle, number]: GridHole) -> Option<Point3<f64>> {
        let circle = self.grid.circle(usize::try_from(circle).ok()?)?;
        let share = number as f64 / f64::from(circle.holes);
        let (s, c) = (self.grid.angle_deg + 360.0 * share).to_radians().sin_cos();
        Some(self.plane.point([circle.radius * c, circle.radius * s], self.grid.origin))
    }

    /// Numbers of the circles next to a radius, inside and outside.
    fn circles_about(&self, radius: f64) -> Vec<i64> {
        let listed = self.grid.circles.as_slice();
        if self.grid.circle(listed.len()).is_some() {
            // circles without end
            let first = listed.first().map_or(0.0, |c| c.radius);
            // inside the first ring there is no other one
            if radius < first {
                return vec![0];
            }
            let low = ((radius - first) / self.grid.pitch).floor() as i64;
            return vec![low, low + 1];
        }
        let inside = listed.iter().enumerate().filter(|(_, c)| c.radius <= radius);
        let outside = listed.iter().enumerate().filter(|(_, c)| c.radius > radius);
        let nearest = [
            inside.max_by(|a, b| a.1.radius.total_cmp(&b.1.radius)),
            outside.min_by(|a, b| a.1.radius.total_cmp(&b.1.radius)),
        ];
        nearest.into_iter().flatten().filter_map(|(k, _)| i64::try_from(k).ok()).collect()
    }

    /// The holes next to a place: two on the circle inside and two on the one outside, as far as there are any.
    fn around(&self, p: &Point3<f64>) -> Vec<GridHole> {
        let (radius, turn) = self.polar(p);
        let mut out = Vec::new();
        for k in self.circles_about(radius) {
            let Some(circle) = usize::try_from(k).ok().and_then(|k| self.grid.circle(k)) else { continue };
            let holes = i64::from(circle.holes);
            let low = (turn / std::f64::consts::TAU * f64::from(circle.holes)).floor() as i64;
            for number in [low, low + 1].map(|n| n.rem_euclid(holes)) {
                if !out.contains(&[k, number]) {
                    out.push([k, number]);
                }
            }
        }
        out
    }
}

/// The allowed places of the joints of a body.
#[derive(Debug, Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "there are two of them, and they are copied")]
pub(super) enum PlateHoles {
    /// On holes counted along two axes.
    Lattice(BodyGrid),
    /// On holes of circles.
    Circles(BodyCircles),
    /// The given places.
    AsGiven,
}

impl PlateHoles {
    /// `None` when the joints do not lie in a plane.
    pub(super) fn new(points: &[Point3<f64>], grid: Option<&Grid>, size: f64) -> Option<Self> {
        let Some(grid) = grid else { return Some(Self::AsGiven) };
        if grid.pattern.skew().is_some() {
            return BodyGrid::new(points, grid, size).map(Self::Lattice);
        }
        Some(Self::Circles(BodyCircles { grid: *grid, plane: JointPlane::of(points, size)? }))
    }

    /// The grid of two axes, if the holes lie on one.
    pub(super) fn lattice(&self) -> Option<&BodyGrid> {
        match self {
            Self::Lattice(grid) => Some(grid),
            _ => None,
        }
    }

    /// Whether all points are near enough to count the holes.
    pub(super) fn reaches(&self, points: &[Point3<f64>]) -> bool {
        match self {
            Self::Lattice(grid) => grid.reaches(points),
            Self::Circles(circles) => {
                let pitch = circles.grid.pitch;
                points.iter().all(|p| !(pitch > 0.0) || circles.polar(p).0 < LAST_CIRCLE * pitch)
            }
            Self::AsGiven => true,
        }
    }

    /// The hole; `target` itself for a joint that stays.
    pub(super) fn point(&self, cell: GridHole, target: &Point3<f64>) -> Point3<f64> {
        match self {
            Self::Lattice(grid) => grid.point(cell),
            Self::Circles(circles) => circles.point(cell).unwrap_or(*target),
            Self::AsGiven => *target,
        }
    }

    /// The holes around a place, nearest first, at least one. A joint that stays has one hole: the number `joint`,
    /// unique in its body.
    pub(super) fn around(&self, target: &Point3<f64>, joint: usize) -> Vec<GridHole> {
        let mut out = match self {
            Self::Lattice(grid) => {
                let low = grid.coordinates(target).map(|x| x.floor() as i64);
                [[0, 0], [1, 0], [0, 1], [1, 1]].map(|d: [i64; 2]| [low[0] + d[0], low[1] + d[1]]).to_vec()
            }
            Self::Circles(circles) => circles.around(target),
            Self::AsGiven => vec![[i64::try_from(joint).unwrap_or(i64::MAX), 0]],
        };
        let distance = |c: &GridHole| match self {
            Self::Lattice(grid) => {
                let at = grid.coordinates(target);
                length([c[0] as f64 - at[0], c[1] as f64 - at[1]], grid.skew())
            }
            _ => (self.point(*c, target) - target).norm(),
        };
        out.sort_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b)));
        out
    }

    /// The hole at a place; `None` where there is none within rounding.
    pub(super) fn hole_at(&self, place: &Point3<f64>, joint: usize) -> Option<GridHole> {
        let nearest = *self.around(place, joint).first()?;
        let spacing = match self {
            Self::Lattice(grid) => grid.pitch(),
            Self::Circles(circles) => {
                let circle = circles.grid.circle(usize::try_from(nearest[0]).ok()?)?;
                circle.radius * (std::f64::consts::TAU / f64::from(circle.holes)).min(1.0)
            }
            Self::AsGiven => return Some(nearest),
        };
        ((self.point(nearest, place) - place).norm() <= ON_HOLE * spacing).then_some(nearest)
    }
}

/// Whether the holes allow a platform with three-fold symmetry about the middle of its joints. A triangular grid must
/// have this symmetry about that middle. Circles must be centred there, one of them with a multiple of three holes.
/// `true` without a grid; `false` for joints without this symmetry.
pub fn holes_turn(points: &[Point3<f64>], grid: Option<&Grid>, size: f64) -> bool {
    let Some(grid) = grid else { return true };
    let (Some(symmetry), Some(plate)) =
        (ThreeFold::of(points, size), PlateHoles::new(points, Some(grid), size))
    else {
        return false;
    };
    let stays = |p: &Point3<f64>, spacing: f64| (symmetry.turned(p) - p).norm() <= ON_HOLE * spacing;
    match &plate {
        PlateHoles::Lattice(lattice) => {
            // the rotation keeps the directions of a triangular grid, so one hole decides
            HolePattern::Triangular.skew() == Some(lattice.skew())
                && plate.hole_at(&symmetry.turned(&lattice.point([0, 0])), 0).is_some()
        }
        PlateHoles::Circles(circles) => {
            let centre = circles.plane.point([0.0; 2], circles.grid.origin);
            let list = circles.grid.circles.as_slice();
            list.iter().any(|c| c.holes.is_multiple_of(3) && stays(&centre, c.radius))
        }
        PlateHoles::AsGiven => true,
    }
}

/// Joints of a body with three-fold symmetry: `next[k]` is the image of joint `k` in a rotation by 120 degrees.
#[derive(Debug, Clone)]
pub(super) struct ThreeFold {
    pub(super) next: Vec<usize>,
    centre: Point3<f64>,
    turn: nalgebra::Rotation3<f64>,
}

impl ThreeFold {
    /// `None` if the joints lack this symmetry within rounding of the size of the design.
    pub(super) fn of(points: &[Point3<f64>], size: f64) -> Option<Self> {
        let count = points.len();
        if count == 0 || !count.is_multiple_of(3) {
            return None;
        }
        let axis = nalgebra::Unit::new_normalize(JointPlane::of(points, size)?.normal());
        let turn = nalgebra::Rotation3::from_axis_angle(&axis, std::f64::consts::TAU / 3.0);
        let centre = Point3::from(points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / count as f64);
        let all = Self { next: Vec::new(), centre, turn };
        let near = |p: &Point3<f64>, q: &Point3<f64>| (p - q).norm() <= SAME * size;
        let image = |p: &Point3<f64>| points.iter().position(|q| near(&all.turned(p), q));
        let next: Vec<usize> = points.iter().map(image).collect::<Option<_>>()?;
        (0..count).all(|k| next[k] != k).then(|| Self { next, ..all.clone() })
    }

    /// The place rotated by 120 degrees about the middle of the joints.
    pub(super) fn turned(&self, p: &Point3<f64>) -> Point3<f64> {
        self.centre + self.turn * (p - self.centre)
    }
}

/// Joints within this share of the size of the design from their rotated images count as symmetric.
const SAME: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::requirements::{HoleCircle, HoleCircles};

    fn plane() -> [Point3<f64>; 3] {
        [Point3::new(3.0, 0.0, 1.0), Point3::new(0.0, 4.0, 1.0), Point3::new(-2.0, -2.0, 1.0)]
    }

    #[test]
    fn the_holes_around_a_place_are_those_of_the_next_circles() {
        let polar = Grid {
            origin: [0.5, -0.25],
            angle_deg: 10.0,
            ..Grid::polar(HoleCircle { radius: 1.0, holes: 12 }, 0.5)
        };
        let holes = PlateHoles::new(&plane(), Some(&polar), 5.0).unwrap();
        for cell in [[0, 0], [2, 5], [7, 11]] {
            let at = holes.point(cell, &Point3::origin());
            let radius = 1.0 + 0.5 * cell[0] as f64;
            let (s, c) = (10.0 + 30.0 * cell[1] as f64).to_radians().sin_cos();
            assert!((at - Point3::new(0.5 + radius * c, -0.25 + radius * s, 1.0)).norm() < 1e-14);
            assert_eq!(holes.hole_at(&at, 0), Some(cell));
            assert_eq!(holes.around(&(at + Vector3::new(0.01, 0.01, 0.0)), 0)[0], cell);
            assert!(holes.hole_at(&(at + Vector3::new(0.01, 0.0, 0.0)), 0).is_none());
        }
        // inside the first ring there is no other one, in its centre neither
        for place in [Point3::new(0.6, -0.2, 1.0), Point3::new(0.5, -0.25, 1.0)] {
            let around = holes.around(&place, 0);
            assert!(around.len() == 2 && around.iter().all(|c| c[0] == 0), "{around:?}");
        }
        let list = [HoleCircle { radius: 2.0, holes: 8 }, HoleCircle { radius: 1.5, holes: 3 }];
        let bolts = Grid::bolt_circles(HoleCircles::new(&list).unwrap());
        let holes = PlateHoles::new(&plane(), Some(&bolts), 5.0).unwrap();
        assert_eq!(holes.around(&Point3::new(1.6, 0.0, 1.0), 0)[0], [1, 0]);
        assert_eq!(holes.around(&Point3::new(1.6, 0.0, 1.0), 0).len(), 4);
        assert!(holes.around(&Point3::new(9.0, 0.0, 1.0), 0).iter().all(|c| c[0] == 0));
    }

    #[test]
    fn grids_that_turn_about_the_middle_of_a_triangle_are_told_from_others() {
        let turned = |deg: f64| {
            let (s, c) = deg.to_radians().sin_cos();
            Point3::new(3.0 + 4.0 * c, -1.0 + 4.0 * s, 0.5)
        };
        let triangle = [20.0, 140.0, 260.0].map(turned);
        let holds = |grid: Grid| holes_turn(&triangle, Some(&grid), 4.0);
        let pattern = |pattern, origin| Grid { pattern, origin, angle_deg: 7.0, ..Grid::square(0.7) };
        // a hole in the middle; the middle of a triangle of holes, `pitch / sqrt(3)` from one at 30 degrees from the
        // axis; neither
        assert!(holds(pattern(HolePattern::Triangular, [3.0, -1.0])));
        let (s, c) = 37f64.to_radians().sin_cos();
        let away = 0.7 / 3f64.sqrt();
        assert!(holds(pattern(HolePattern::Triangular, [3.0 - away * c, -1.0 - away * s])));
        assert!(!holds(pattern(HolePattern::Triangular, [3.1, -1.0])));
        assert!(!holds(pattern(HolePattern::Square, [3.0, -1.0])));
        let polar = |holes, origin| Grid { origin, ..Grid::polar(HoleCircle { radius: 1.0, holes }, 0.5) };
        assert!(
            holds(polar(24, [3.0, -1.0])) && !holds(polar(20, [3.0, -1.0])) && !holds(polar(24, [3.0, 0.0]))
        );
        let bolts = |list: &[HoleCircle]| Grid {
            origin: [3.0, -1.0],
            ..Grid::bolt_circles(HoleCircles::new(list).unwrap())
        };
        let circle = |holes| HoleCircle { radius: 4.0, holes };
        assert!(holds(bolts(&[circle(8), circle(9)])) && !holds(bolts(&[circle(8), circle(10)])));
        // no grid; a grid whose holes are not symmetric about the middle
        assert!(holes_turn(&plane(), None, 5.0));
        assert!(!holes_turn(&plane(), Some(&pattern(HolePattern::Triangular, [0.0; 2])), 5.0));
    }

    #[test]
    fn joints_that_turn_by_120_degrees_are_told_from_others() {
        let at = |deg: f64| Point3::new(2.0 * deg.to_radians().cos(), 2.0 * deg.to_radians().sin(), 3.0);
        let points: Vec<_> = [10.0, 50.0, 130.0, 170.0, 250.0, 290.0].map(at).to_vec();
        let found = ThreeFold::of(&points, 2.0).unwrap();
        assert_eq!(found.next, [2, 3, 4, 5, 0, 1]);
        let mut off = points;
        off[3].x += 1e-6;
        assert!(ThreeFold::of(&off, 2.0).is_none());
    }
}
