//! A set of poses as coordinates with enclosures; proofs about all poses of a workspace use these.

use nalgebra::Vector3;

use super::enclosed::{IntervalVector, Rotation, apply, exact_rotation};
use super::pose_set::displaced;
use super::rotation_vector::turn_between;
use super::{Pose, PoseSpace, Region};
use num::interval::Interval;
use num::interval::radians;

/// A part of a pose space: `R = exp([w]x) R_0`, and the pivot `q` of the platform is at `p_0 + d`, with
/// `(d, w) = middle + sum_k x_k column_k`. The coordinates `x` are in a cell and in the unit balls of some groups.
///
/// Most charts have the origin of the platform as pivot.
/// All quantities are enclosed, since angles are in degrees and a home rotation is orthogonal only within rounding.
#[derive(Debug, Clone)]
pub struct Chart {
    /// `R_0`.
    pub rotation: Rotation,
    /// `p_0`, design units: the position of the pivot for `d = w = 0`.
    pub position: IntervalVector,
    /// The pivot `q`, platform frame, if it is not the origin.
    pub pivot: Option<IntervalVector>,
    /// `d` (design units) and `w` (radians) where all coordinates are 0.
    pub middle: [Interval; 6],
    /// `d` (design units) and `w` (radians) by coordinate, six coordinates at most.
    pub columns: Vec<[Interval; 6]>,
    /// Groups of coordinates with `|x| <= 1`.
    pub balls: Vec<Vec<usize>>,
    /// The cell of all coordinates.
    pub root: ChartCell,
    /// Rounded pose with `d = w = 0`, pivot, middle and columns.
    home: Pose,
    rounded_pivot: Vector3<f64>,
    rounded_middle: Step,
    steps: Vec<Step>,
}

/// Rounded `d` and `w`.
type Step = (Vector3<f64>, Vector3<f64>);

/// A box of coordinates; missing ones of the chart are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChartCell {
    /// Lower ends.
    pub lo: [f64; 6],
    /// Upper ends.
    pub hi: [f64; 6],
}

/// The position of a cell relative to the balls of its chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Covered {
    /// It is entirely inside.
    Inside,
    /// It is entirely outside.
    Outside,
    /// It may be partly inside.
    Partly,
}

/// Least width of a side that is halved.
const NARROW: f64 = 1e-12;

impl ChartCell {
    /// A point.
    pub fn point(x: [f64; 6]) -> Self {
        Self { lo: x, hi: x }
    }

    /// The interval of a coordinate.
    pub fn side(&self, k: usize) -> Interval {
        Interval::new(self.lo[k], self.hi[k]).unwrap_or(Interval::WHOLE)
    }

    /// A point about the middle.
    pub fn centre(&self) -> [f64; 6] {
        std::array::from_fn(|k| f64::midpoint(self.lo[k], self.hi[k]).clamp(self.lo[k], self.hi[k]))
    }

    /// The greatest distance of a coordinate from that of a point of the cell, rounded up; 0 without width.
    pub fn reach(&self, x: &[f64; 6], k: usize) -> f64 {
        let from = Interval::from(x[k]);
        (self.side(k) - from).magnitude() * if self.lo[k] < self.hi[k] { 1.0 } else { 0.0 }
    }

    /// The halves across an axis; `None` if that side is too narrow.
    pub fn halves(&self, axis: usize) -> Option<[Self; 2]> {
        let middle = self.centre()[axis];
        if !(self.hi[axis] - self.lo[axis] > NARROW) {
            return None;
        }
        let (mut left, mut right) = (*self, *self);
        (left.hi[axis], right.lo[axis]) = (middle, middle);
        Some([left, right])
    }

    /// `|x|^2` of some coordinates over the cell.
    pub fn norm_squared(&self, group: &[usize]) -> Interval {
        group.iter().fold(Interval::ZERO, |sum, k| sum + self.side(*k).square())
    }
}

/// `middle + sum_k x_k column_k` over a cell.
pub fn combination(middle: &[Interval; 6], columns: &[[Interval; 6]], cell: &ChartCell) -> [Interval; 6] {
    let mut out = *middle;
    for (k, column) in columns.iter().enumerate() {
        for (sum, c) in out.iter_mut().zip(column) {
            *sum = *sum + *c * cell.side(k);
        }
    }
    out
}

/// The result of cutting a chart into cells.
#[derive(Debug, Clone, Copy)]
pub enum Bisection {
    /// Every cell is settled.
    Settled,
    /// This point refutes the statement.
    Refuted([f64; 6]),
    /// Cells ran out, or became too narrow, near this point.
    Open([f64; 6]),
}

/// The middles of a displacement.
fn rounded(displacement: &[Interval; 6]) -> Step {
    let part = |from: usize| Vector3::from_fn(|k, _| displacement[from + k].centre_and_radius().0);
    (part(0), part(3))
}

impl Chart {
    /// Cuts the chart in two until each cell is settled, on at most `cells` cells, and counts them.
    ///
    /// `settled` tells whether a cell is settled, or the axis across which to cut it. `refutes` is called for a point
    /// of each other cell.
    pub fn bisected(
        &self,
        cells: usize,
        settled: impl Fn(&ChartCell) -> Result<(), usize>,
        refutes: impl Fn(&[f64; 6]) -> bool,
    ) -> (Bisection, usize) {
        let mut waiting = vec![self.root];
        let mut looked_at = 0;
        while let Some(cell) = waiting.pop() {
            if self.covers(&cell, 1.0) == Covered::Outside {
                continue;
            }
            let inside = self.pulled_inside(cell.centre());
            if looked_at == cells {
                return (Bisection::Open(inside), looked_at);
            }
            looked_at += 1;
            let Err(axis) = settled(&cell) else { continue };
            if refutes(&inside) {
                return (Bisection::Refuted(inside), looked_at);
            }
            let Some(parts) = cell.halves(axis) else { return (Bisection::Open(inside), looked_at) };
            waiting.extend(parts);
        }
        (Bisection::Settled, looked_at)
    }

    /// `R_0` of the pose in both interpretations: its matrix as it is, and the rotation of its quaternion.
    fn home_rotation(home: &Pose) -> Rotation {
        let exact = exact_rotation(home);
        let quarter_turns =
            home.rotation.matrix().iter().all(|x| *x == 0.0 || x.abs().to_bits() == 1.0_f64.to_bits());
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let (x, y) = (home.rotation[(i, j)], exact[i][j]);
                if quarter_turns {
                    return Interval::from(x);
                }
                let slack = 4.0 * f64::EPSILON;
                Interval::new(y.lo().min(x) - slack, y.hi().max(x) + slack).unwrap_or(Interval::WHOLE)
            })
        })
    }

    fn new(home: &Pose, columns: Vec<[Interval; 6]>, balls: Vec<Vec<usize>>, root: ChartCell) -> Self {
        let steps = columns.iter().map(rounded).collect();
        let position = std::array::from_fn(|k| Interval::from(home.position[k]));
        Self {
            rotation: Self::home_rotation(home),
            position,
            pivot: None,
            middle: [Interval::ZERO; 6],
            columns,
            balls,
            root,
            home: *home,
            rounded_pivot: Vector3::zeros(),
            rounded_middle: (Vector3::zeros(), Vector3::zeros()),
            steps,
        }
    }

    /// The same coordinates about another point of the platform, which `R_0` and `p_0` leave in place.
    fn about_pivot(mut self, pivot: &Vector3<f64>) -> Self {
        if *pivot != Vector3::zeros() {
            let exact = std::array::from_fn(|k| Interval::from(pivot[k]));
            let arm = apply(&self.rotation, &exact);
            self.position = std::array::from_fn(|k| self.position[k] + arm[k]);
            (self.pivot, self.rounded_pivot) = (Some(exact), *pivot);
        }
        self
    }

    /// The same coordinates about another middle.
    fn about_middle(self, middle: [Interval; 6]) -> Self {
        Self { rounded_middle: rounded(&middle), middle, ..self }
    }

    /// One pose.
    pub fn of_pose(pose: &Pose) -> Self {
        Self::new(pose, Vec::new(), Vec::new(), ChartCell::point([0.0; 6]))
    }

    /// The region of a pose space, by coordinates `x` for its nonzero half widths. Each is in `[-1, 1]`, and for
    /// ellipsoids in unit balls.
    pub fn of_region(space: &PoseSpace) -> Self {
        let axes = space.axes();
        let width = |k: usize| {
            if k < 3 { Interval::from(space.translation[k]) } else { radians(space.rotation_deg[k - 3]) }
        };
        let column = |k: &usize| std::array::from_fn(|i| if i == *k { width(i) } else { Interval::ZERO });
        let group = |keep: &dyn Fn(usize) -> bool| -> Vec<usize> {
            (0..axes.len()).filter(|j| keep(axes[*j])).collect()
        };
        let balls = match space.region {
            Region::Box => Vec::new(),
            // a ball of one coordinate is its interval
            Region::Ellipsoid => {
                [group(&|k| k < 3), group(&|k| k >= 3)].into_iter().filter(|g| g.len() > 1).collect()
            }
        };
        let mut root = ChartCell::point([0.0; 6]);
        for j in 0..axes.len() {
            (root.lo[j], root.hi[j]) = (-1.0, 1.0);
        }
        let middle = std::array::from_fn(|k| {
            if k < 3 { Interval::from(space.middle[k]) } else { radians(space.middle[k]) }
        });
        let chart = Self::new(&space.home, axes.iter().map(column).collect(), balls, root);
        chart.about_middle(middle).about_pivot(&space.pivot)
    }

    /// The poses between two of a trajectory, `x` from 0 to 1.
    fn of_step(from: &Pose, to: &Pose) -> Self {
        let (shift, turn) = (to.position - from.position, turn_between(&from.rotation, &to.rotation));
        let (reach, angle) = (from.position.amax().max(to.position.amax()), turn.norm());
        // a step is exactly given at its ends
        let about = |x: f64, scale: f64| {
            let slack = 8.0 * f64::EPSILON * scale;
            Interval::new(x - slack, x + slack).unwrap_or(Interval::WHOLE)
        };
        let column = std::array::from_fn(|k| match k {
            0..3 if shift[k] == 0.0 => Interval::ZERO,
            0..3 => about(shift[k], reach),
            _ if angle == 0.0 => Interval::ZERO,
            _ => about(turn[k - 3], 1.0 + angle),
        });
        let mut root = ChartCell::point([0.0; 6]);
        root.hi[0] = 1.0;
        Self::new(from, vec![column], Vec::new(), root)
    }

    /// All poses of a space: its region, its single poses, the steps of its trajectory, its ranges.
    pub fn all(space: &PoseSpace) -> Vec<Self> {
        let mut out = vec![Self::of_region(space)];
        out.extend(space.poses.iter().chain(&space.trajectory).map(Self::of_pose));
        out.extend(space.trajectory.windows(2).map(|w| Self::of_step(&w[0], &w[1])));
        out.extend(space.ranges_alone().map(|range| Self::of_region(&range)));
        out
    }

    /// `d` (design units) and `w` (radians) over a cell.
    pub fn displacement(&self, cell: &ChartCell) -> [Interval; 6] {
        combination(&self.middle, &self.columns, cell)
    }

    /// A point of the platform frame, measured from the pivot.
    pub fn relative_to_pivot(&self, point: &IntervalVector) -> IntervalVector {
        self.pivot.map_or(*point, |pivot| std::array::from_fn(|k| point[k] - pivot[k]))
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.columns.len()
    }

    /// The pose at a point, rounded.
    pub fn pose(&self, x: &[f64; 6]) -> Pose {
        let (mut d, mut w) = self.rounded_middle;
        for ((shift, turn), x) in self.steps.iter().zip(x) {
            d += shift * *x;
            w += turn * *x;
        }
        displaced(&self.home, d, w, &self.rounded_pivot)
    }

    /// Whether a cell lies in the balls of radius `scale`.
    pub fn covers(&self, cell: &ChartCell, scale: f64) -> Covered {
        let limit = Interval::from(scale).square();
        let mut all = Covered::Inside;
        for group in &self.balls {
            let norm = cell.norm_squared(group);
            if norm.lo() > limit.hi() {
                return Covered::Outside;
            }
            if !(norm.hi() <= limit.lo()) {
                all = Covered::Partly;
            }
        }
        all
    }

    /// A scale whose balls and box contain the point, rounded up.
    pub fn scale_of(&self, x: &[f64; 6]) -> f64 {
        let largest = x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let point = ChartCell::point(*x);
        let norm = |g: &Vec<usize>| point.norm_squared(g).sqrt().map_or(f64::INFINITY, Interval::hi);
        self.balls.iter().map(norm).fold(largest, f64::max)
    }

    /// The point, shrunk into the balls of radius 1 if it lies outside: exactly inside.
    pub fn pulled_inside(&self, mut x: [f64; 6]) -> [f64; 6] {
        for group in &self.balls {
            let norm = ChartCell::point(x).norm_squared(group).sqrt().map_or(1.0, Interval::hi);
            if norm > 1.0 {
                for k in group {
                    x[*k] *= (1.0 - 4.0 * f64::EPSILON) / norm;
                }
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::CoordinateRange;
    use crate::geom::turn::turn;
    use nalgebra::{Point3, Rotation3};
    use num::Rng;

    fn space(region: Region) -> PoseSpace {
        let rotation = Rotation3::from_euler_angles(0.3, -0.2, 1.1);
        let home = Pose { rotation, position: Vector3::new(0.5, 0.0, 9.0) };
        let mut space = PoseSpace {
            region,
            translation: Vector3::new(2.0, 0.0, 1.0),
            rotation_deg: Vector3::new(10.0, 20.0, 150.0),
            ..PoseSpace::at(home)
        };
        let end =
            Pose { rotation: Rotation3::new(Vector3::z()) * rotation, position: Vector3::new(4.0, 0.0, 9.0) };
        space.trajectory = vec![home, end];
        space
    }

    /// Random poses of the space lie in the enclosures of its charts.
    #[test]
    fn charts_hold_the_poses_of_their_space() {
        let mut rng = Rng::new(2);
        for region in [Region::Box, Region::Ellipsoid] {
            let s = space(region);
            let charts = Chart::all(&s);
            assert_eq!((charts.len(), charts[0].coordinates(), charts[3].coordinates()), (4, 5, 1));
            for x in s.cube_points(200, &mut rng) {
                let pose = s.pose(&x);
                let d = pose.position - s.home.position;
                let w = turn_between(&s.home.rotation, &pose.rotation).map(f64::to_degrees);
                let q = [d.x / 2.0, d.z, w.x / 10.0, w.y / 20.0, w.z / 150.0, 0.0];
                assert!(charts[0].scale_of(&q) < 1.0 + 1e-12);
                let cell = ChartCell { lo: q.map(|x| x - 1e-9), hi: q.map(|x| x + 1e-9) };
                let there = charts[0].displacement(&cell);
                let turned = turn(&[there[3], there[4], there[5]]);
                for k in 0..3 {
                    assert!((there[k] + charts[0].position[k]).contains(pose.position[k]));
                    let column = apply(&turned, &std::array::from_fn(|i| charts[0].rotation[i][k]));
                    assert!((0..3).all(|i| column[i].contains(pose.rotation[(i, k)])));
                }
                assert!((charts[0].pose(&q).rotation.matrix() - pose.rotation.matrix()).norm() < 1e-12);
            }
        }
    }

    /// Regions to one side of home that rotate about a pivot, and ranges of single coordinates.
    #[test]
    fn charts_hold_the_poses_about_a_pivot() {
        let mut rng = Rng::new(4);
        for region in [Region::Box, Region::Ellipsoid] {
            let mut s = PoseSpace { pivot: Vector3::new(1.0, -2.0, 30.0), ..space(region) };
            let travels = [
                CoordinateRange { min: -0.1, max: 0.3 },
                CoordinateRange::default(),
                CoordinateRange { min: -1.0, max: 0.0 },
            ];
            let angles = [
                CoordinateRange { min: -5.0, max: 0.1 },
                CoordinateRange::within(20.0),
                CoordinateRange { min: -40.0, max: 70.0 },
            ];
            s = s.with_region(region, &travels, &angles);
            s.ranges[2] = CoordinateRange { min: -4.0, max: 1.0 };
            s.ranges[3] = CoordinateRange { min: 0.0, max: 33.0 };
            let charts = Chart::all(&s);
            assert_eq!((charts.len(), charts[4].coordinates(), charts[5].coordinates()), (6, 1, 1));
            let half = |k: usize| if k < 3 { s.translation[k] } else { s.rotation_deg[k - 3].to_radians() };
            let middle = |k: usize| if k < 3 { s.middle[k] } else { s.middle[k].to_radians() };
            let holds = |chart: &Chart, x: [f64; 6], pose: &Pose| {
                let cell = ChartCell { lo: x.map(|x| x - 1e-9), hi: x.map(|x| x + 1e-9) };
                let there = chart.displacement(&cell);
                let turned = turn(&[there[3], there[4], there[5]]);
                // a point of the platform
                let point = [0.3, 0.2, -0.7];
                let arm = chart.relative_to_pivot(&point.map(Interval::from));
                let arm = apply(&turned, &apply(&chart.rotation, &arm));
                let at = pose.transform(&Point3::from(point));
                assert!((0..3).all(|k| (arm[k] + chart.position[k] + there[k]).contains(at[k])), "{x:?}");
                let rounded = chart.pose(&x);
                assert!((rounded.position - pose.position).norm() < 1e-12);
                assert!((rounded.rotation.matrix() - pose.rotation.matrix()).norm() < 1e-12);
            };
            for x in s.cube_points(100, &mut rng) {
                let pose = s.pose(&x);
                let at = s.coordinates(&pose);
                let mut q = [0.0; 6];
                for (j, k) in s.axes().into_iter().enumerate() {
                    q[j] = (at[k] - middle(k)) / half(k);
                }
                holds(&charts[0], q, &pose);
            }
            // along z alone, and about x alone: the pivot stays in place
            let along = s.along_ranges(3);
            assert_eq!(along.len(), 9);
            let pivot = |pose: &Pose| pose.transform(&Point3::from(s.pivot));
            for (k, pose) in along.iter().enumerate() {
                let (shift, at) = (pivot(pose) - pivot(&s.home), s.coordinates(pose));
                let (chart, x) = if k < 6 {
                    let z = [-4.0, 1.0][k / 3] * (k % 3 + 1) as f64 / 3.0;
                    assert!((shift - Vector3::z() * z).norm() < 1e-12 && at[3].abs() < 1e-12);
                    (&charts[4], (z + 1.5) / 2.5)
                } else {
                    let angle = 11.0 * (k - 5) as f64;
                    assert!(shift.norm() < 1e-12 && (at[3].to_degrees() - angle).abs() < 1e-9);
                    (&charts[5], (angle - 16.5) / 16.5)
                };
                holds(chart, [x, 0.0, 0.0, 0.0, 0.0, 0.0], pose);
            }
        }
    }

    #[test]
    fn cells_inside_outside_and_across_a_ball_are_told_apart() {
        let chart = Chart::of_region(&space(Region::Ellipsoid));
        let at = |x: [f64; 6], half: f64| ChartCell { lo: x.map(|x| x - half), hi: x.map(|x| x + half) };
        assert_eq!(chart.covers(&at([0.0; 6], 0.5), 1.0), Covered::Inside);
        assert_eq!(chart.covers(&at([0.9, 0.9, 0.0, 0.0, 0.0, 0.0], 0.1), 1.0), Covered::Outside);
        assert_eq!(chart.covers(&at([0.9, 0.0, 0.0, 0.0, 0.0, 0.0], 0.2), 1.0), Covered::Partly);
        let far = chart.pulled_inside([3.0, 4.0, 1.0, 1.0, 1.0, 0.0]);
        assert!(chart.scale_of(&far) <= 1.0 && (far[0] - 0.6).abs() < 1e-14);
        // the box has no balls: a corner belongs to it
        assert_eq!(Chart::of_region(&space(Region::Box)).covers(&at([0.9; 6], 0.1), 1.0), Covered::Inside);
    }
}
