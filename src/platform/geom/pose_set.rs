//! The poses for which requirements hold.

use nalgebra::{Rotation3, Vector3, Vector6};

use super::Pose;
use super::rotation_vector::turn_between;
use num::Rng;
use num::double_double::two_sum;

num::answer_words! {
    /// The shape of a region of poses.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    #[cfg_attr(feature = "serde", schemars(rename = "RegionWord"))]
    pub enum Region as name {
        /// A box.
        // every component of translation and rotation within its half width
        #[default]
        Box = "box",
        /// An ellipsoid.
        // translations in one, rotation vectors in another, with the half widths as half axes; every translation with
        // every rotation
        Ellipsoid = "ellipsoid",
    }
}

num::words! {
    /// The reference of the listed poses of a workspace.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum ListedFrom as name {
        /// The base frame: they stay fixed when home moves.
        #[default]
        Base = "base",
        /// Home: they move with it, like the region.
        Home = "home",
    }
}

impl ListedFrom {
    /// The pose in the base frame of one listed as `(R, p)`: itself, or `(R R0, p0 + p)` from home `(R0, p0)`.
    ///
    /// Displacements from home are along the axes of the base frame, like those of the region.
    #[must_use]
    pub fn in_base_frame(self, listed: &Pose, home: &Pose) -> Pose {
        match self {
            Self::Base => *listed,
            Self::Home => {
                Pose { rotation: listed.rotation * home.rotation, position: home.position + listed.position }
            }
        }
    }

    /// The inverse of [`in_base_frame`](Self::in_base_frame).
    pub(super) fn as_listed(self, pose: &Pose, home: &Pose) -> Pose {
        match self {
            Self::Base => *pose,
            Self::Home => Pose {
                rotation: pose.rotation * home.rotation.inverse(),
                position: pose.position - home.position,
            },
        }
    }
}

/// The interval of a coordinate, measured from home, which it contains.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CoordinateRange {
    /// Lower end, at most 0.
    pub min: f64,
    /// Upper end, at least 0.
    pub max: f64,
}

impl CoordinateRange {
    /// The interval with home in its middle.
    #[must_use]
    pub fn within(half: f64) -> Self {
        // not -0 for 0
        Self { min: 0.0 - half, max: half }
    }

    /// Whether home is exactly in the middle.
    #[must_use]
    pub fn is_about_home(self) -> bool {
        self == Self::within(self.max)
    }

    /// Whether the coordinate stays at home.
    #[must_use]
    pub fn is_still(self) -> bool {
        self == Self::default()
    }

    /// The middle, rounded; 0 if home is the middle.
    #[must_use]
    pub fn middle(self) -> f64 {
        f64::midpoint(self.min, self.max)
    }

    /// Half of the width, rounded up, so that both ends are within this distance of the rounded middle.
    #[must_use]
    pub fn half_width(self) -> f64 {
        let up =
            |(difference, error): (f64, f64)| if error > 0.0 { difference.next_up() } else { difference };
        up(two_sum(self.middle(), -self.min)).max(up(two_sum(self.max, -self.middle())))
    }

    /// The greater distance of an end from home.
    #[must_use]
    pub fn reach(self) -> f64 {
        self.max.max(-self.min)
    }
}

/// The pose `(exp([w]x) R0, p)` whose pivot `q` is displaced by `d` from home: `p = p0 + d + R0 q - R q`.
pub(super) fn displaced(home: &Pose, d: Vector3<f64>, w: Vector3<f64>, pivot: &Vector3<f64>) -> Pose {
    let rotation = Rotation3::new(w) * home.rotation;
    let mut position = home.position + d;
    // without a pivot no digit changes
    if *pivot != Vector3::zeros() {
        position += home.rotation * pivot - rotation * pivot;
    }
    Pose { rotation, position }
}

/// All poses that a platform has to reach.
///
/// The region around home `(R0, p0)` contains the poses `(exp([w]x) R0, p0 + d + R0 q - R q)` (base frame) with the
/// pivot `q`, so that the pivot is displaced by `d` alone. `(d, w)` is the image of a point `x` of the cube
/// `[-1, 1]^6`. In a box `d_k = c_k + h_k x_k`, with the middle `c` and the half widths `h` of the intervals. In an
/// ellipsoid each half of `x` is first shortened by its greatest entry over its norm. This maps the cube onto the ball
/// and its faces onto the sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSpace {
    /// The pose from which region and ranges are measured.
    pub home: Pose,
    /// Box or ellipsoid.
    pub region: Region,
    /// Half widths of the translation, design units.
    pub translation: Vector3<f64>,
    /// Half widths of the rotation vector, degrees.
    pub rotation_deg: Vector3<f64>,
    /// Middle of the region, measured from home: translation in design units, rotation vector in degrees.
    pub middle: Vector6<f64>,
    /// The point of the platform about which region and ranges rotate, platform frame.
    pub pivot: Vector3<f64>,
    /// Ranges over which each coordinate moves alone from home: translations in design units, rotations about the axes
    /// x, y, z of the base frame in degrees.
    pub ranges: [CoordinateRange; 6],
    /// Single poses, base frame.
    pub poses: Vec<Pose>,
    /// Poses of a path, in order, base frame. Between them the origin moves on straight lines, with rotations about
    /// fixed axes.
    pub trajectory: Vec<Pose>,
    /// Whether the single poses and the trajectory move with home.
    pub listed_from: ListedFrom,
}

/// Prime bases of the Halton sequence (Halton 1960).
const BASES: [u64; 6] = [2, 3, 5, 7, 11, 13];

/// The radical inverse: the digits of `n` in `base` mirrored at the point, in `[0, 1)`.
fn radical_inverse(mut n: u64, base: u64) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0 / base as f64);
    while n > 0 {
        value += digit * (n % base) as f64;
        n /= base;
        digit /= base as f64;
    }
    value
}

fn onto_ball(x: Vector3<f64>) -> Vector3<f64> {
    let norm = x.norm();
    if norm > 0.0 { x * (x.amax() / norm) } else { x }
}

/// The inverse of [`onto_ball`].
fn from_ball(y: Vector3<f64>) -> Vector3<f64> {
    let most = y.amax();
    if most > 0.0 { y * (y.norm() / most) } else { y }
}

impl PoseSpace {
    /// Home alone.
    #[must_use]
    pub fn at(home: Pose) -> Self {
        Self {
            home,
            region: Region::Box,
            translation: Vector3::zeros(),
            rotation_deg: Vector3::zeros(),
            middle: Vector6::zeros(),
            pivot: Vector3::zeros(),
            ranges: [CoordinateRange::default(); 6],
            poses: Vec::new(),
            trajectory: Vec::new(),
            listed_from: ListedFrom::Base,
        }
    }

    /// The space with a region of these intervals, measured from home.
    #[must_use]
    pub fn with_region(
        self,
        region: Region,
        translation: &[CoordinateRange; 3],
        rotation_deg: &[CoordinateRange; 3],
    ) -> Self {
        let half = |list: &[CoordinateRange; 3]| Vector3::from(list.map(CoordinateRange::half_width));
        let middle = |k: usize| if k < 3 { translation[k] } else { rotation_deg[k - 3] }.middle();
        Self {
            region,
            translation: half(translation),
            rotation_deg: half(rotation_deg),
            middle: Vector6::from_fn(|k, _| middle(k)),
            ..self
        }
    }

    /// The region with all its intervals multiplied by a factor, without ranges and listed poses.
    #[must_use]
    pub fn scaled_region(&self, factor: f64) -> Self {
        Self {
            region: self.region,
            translation: self.translation * factor,
            rotation_deg: self.rotation_deg * factor,
            middle: self.middle * factor,
            pivot: self.pivot,
            ..Self::at(self.home)
        }
    }

    /// The greatest distance of each coordinate from home in the region and the ranges: translations of the pivot in
    /// design units, rotation vector in degrees.
    #[must_use]
    pub fn reach(&self) -> (Vector3<f64>, Vector3<f64>) {
        let reach = |k: usize| (self.middle[k].abs() + self.width(k)).max(self.ranges[k].reach());
        (Vector3::from_fn(|k, _| reach(k)), Vector3::from_fn(|k, _| reach(k + 3)))
    }

    /// Half widths of a box about home that holds all poses of region and ranges: positions of the platform origin in
    /// design units, rotation vector in degrees.
    #[must_use]
    pub fn box_about_home(&self) -> (Vector3<f64>, Vector3<f64>) {
        let (translation, rotation_deg) = self.reach();
        // |R0 q - R q| is at most the angle times |q|
        let arm = self.pivot.norm() * rotation_deg.norm().to_radians();
        (translation.add_scalar(arm), rotation_deg)
    }

    /// Each range of a single coordinate as a region of its own, with one axis.
    pub fn ranges_alone(&self) -> impl Iterator<Item = Self> + '_ {
        (0..6).filter(|k| !self.ranges[*k].is_still()).map(|k| {
            let mut travels = [CoordinateRange::default(); 6];
            travels[k] = self.ranges[k];
            let [x, y, z, roll, pitch, yaw] = travels;
            Self { pivot: self.pivot, ..Self::at(self.home) }.with_region(
                Region::Box,
                &[x, y, z],
                &[roll, pitch, yaw],
            )
        })
    }

    /// Poses along the ranges, with `steps` steps from home to each end, which is exact; home is left out.
    #[must_use]
    pub fn along_ranges(&self, steps: usize) -> Vec<Pose> {
        let mut out = Vec::new();
        for (k, range) in self.ranges.iter().enumerate() {
            let ends = [range.min, range.max].into_iter().filter(|end| *end != 0.0);
            for (end, step) in ends.flat_map(|end| (1..=steps).map(move |step| (end, step))) {
                let mut at = Vector6::zeros();
                at[k] = end * (step as f64 / steps as f64);
                out.push(self.displaced_by(&at));
            }
        }
        out
    }

    /// The pose of region coordinates: translation of the pivot in design units, rotation vector in degrees.
    fn displaced_by(&self, at: &Vector6<f64>) -> Pose {
        let turn = at.fixed_rows::<3>(3).map(f64::to_radians);
        displaced(&self.home, at.fixed_rows::<3>(0).into(), turn, &self.pivot)
    }

    /// The region coordinates of a pose: translation of the pivot in design units, rotation vector in radians.
    #[must_use]
    pub fn coordinates(&self, pose: &Pose) -> Vector6<f64> {
        let arm = pose.rotation * self.pivot - self.home.rotation * self.pivot;
        let d = pose.position - self.home.position + arm;
        let w = turn_between(&self.home.rotation, &pose.rotation);
        Vector6::new(d.x, d.y, d.z, w.x, w.y, w.z)
    }

    /// The point of the cube whose pose is home, if the centre of the cube is another pose.
    #[must_use]
    pub fn home_in_cube(&self) -> Option<Vector6<f64>> {
        if self.middle == Vector6::zeros() {
            return None;
        }
        let mut x =
            Vector6::from_fn(|k, _| if self.width(k) > 0.0 { -self.middle[k] / self.width(k) } else { 0.0 });
        if self.region == Region::Ellipsoid {
            for half in [0, 3] {
                let ball: Vector3<f64> = x.fixed_rows::<3>(half).into();
                x.fixed_rows_mut::<3>(half).copy_from(&from_ball(ball));
            }
        }
        Some(x.map(|x| x.clamp(-1.0, 1.0)))
    }

    /// The space around another home: the region moves with it, and so do listed poses relative to it.
    #[must_use]
    pub fn with_home(&self, home: Pose) -> Self {
        let moved = |pose: &Pose| {
            self.listed_from.in_base_frame(&self.listed_from.as_listed(pose, &self.home), &home)
        };
        Self {
            home,
            poses: self.poses.iter().map(moved).collect(),
            trajectory: self.trajectory.iter().map(moved).collect(),
            ..self.clone()
        }
    }

    /// Half width along a coordinate of the cube, design units or degrees.
    fn width(&self, k: usize) -> f64 {
        if k < 3 { self.translation[k] } else { self.rotation_deg[k - 3] }
    }

    /// The coordinates of the cube along which the pose changes.
    #[must_use]
    pub fn axes(&self) -> Vec<usize> {
        (0..6).filter(|k| self.width(*k) > 0.0).collect()
    }

    /// The pose of a point of the cube `[-1, 1]^6`.
    #[must_use]
    pub fn pose(&self, x: &Vector6<f64>) -> Pose {
        // axes of width zero do not enter the norm
        let used = Vector6::from_fn(|k, _| if self.width(k) > 0.0 { x[k] } else { 0.0 });
        let (mut d, mut w): (Vector3<f64>, Vector3<f64>) =
            (used.fixed_rows::<3>(0).into(), used.fixed_rows::<3>(3).into());
        if self.region == Region::Ellipsoid {
            (d, w) = (onto_ball(d), onto_ball(w));
        }
        let (d, w) = (d.component_mul(&self.translation), w.component_mul(&self.rotation_deg));
        self.displaced_by(&(self.middle + Vector6::new(d.x, d.y, d.z, w.x, w.y, w.z)))
    }

    /// Points of the cube spread over the region: the centre, home if it is another pose, all corners, and `count`
    /// points of a Halton sequence. Another `count` points are random, every second one moved to a face.
    #[must_use]
    pub fn cube_points(&self, count: usize, rng: &mut Rng) -> Vec<Vector6<f64>> {
        let axes = self.axes();
        let mut out = vec![Vector6::zeros()];
        out.extend(self.home_in_cube());
        if axes.is_empty() {
            return out;
        }
        let on_axes = |value: &mut dyn FnMut(usize) -> f64| {
            let mut x = Vector6::zeros();
            for (j, k) in axes.iter().enumerate() {
                x[*k] = value(j);
            }
            x
        };
        out.extend(
            (0..1usize << axes.len()).map(|c| on_axes(&mut |j| if c >> j & 1 == 0 { -1.0 } else { 1.0 })),
        );
        // the first points of the sequence lie on the diagonal
        out.extend(
            (20..20 + count as u64).map(|n| on_axes(&mut |j| 2.0 * radical_inverse(n, BASES[j]) - 1.0)),
        );
        for n in 0..count {
            let mut x = on_axes(&mut |_| rng.uniform(-1.0, 1.0));
            if n % 2 == 1 {
                let k = axes[(rng.next_u64() % axes.len() as u64) as usize];
                x[k] = x[k].signum();
            }
            out.push(x);
        }
        out
    }

    /// The poses outside the region: the single ones, the trajectory with `steps` steps between its poses, and the
    /// ranges with as many steps from home to each end.
    #[must_use]
    pub fn listed(&self, steps: usize) -> Vec<Pose> {
        let mut out = self.poses.clone();
        out.extend(self.along_trajectory(steps));
        out.extend(self.along_ranges(steps));
        out
    }

    /// The trajectory with `steps` steps between its poses.
    #[must_use]
    pub fn along_trajectory(&self, steps: usize) -> Vec<Pose> {
        let mut out: Vec<Pose> = self.trajectory.first().copied().into_iter().collect();
        for pair in self.trajectory.windows(2) {
            let turn = turn_between(&pair[0].rotation, &pair[1].rotation);
            out.extend((1..=steps).map(|k| {
                let t = k as f64 / steps as f64;
                if k == steps {
                    return pair[1];
                }
                Pose {
                    rotation: Rotation3::new(turn * t) * pair[0].rotation,
                    position: pair[0].position.lerp(&pair[1].position, t),
                }
            }));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::rotation_vector;

    fn space(region: Region) -> PoseSpace {
        let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 9.0) };
        PoseSpace {
            region,
            translation: Vector3::new(2.0, 0.0, 1.0),
            rotation_deg: Vector3::new(10.0, 20.0, 30.0),
            ..PoseSpace::at(home)
        }
    }

    #[test]
    fn points_of_the_cube_fill_the_region_and_reach_its_boundary() {
        for region in [Region::Box, Region::Ellipsoid] {
            let s = space(region);
            let points = s.cube_points(200, &mut Rng::new(3));
            assert_eq!(points.len(), 1 + 32 + 400);
            let mut reached: f64 = 0.0;
            for x in &points {
                let pose = s.pose(x);
                let d = (pose.position - s.home.position).component_div(&Vector3::new(2.0, 1.0, 1.0));
                let w = rotation_vector(&pose.rotation).map(f64::to_degrees).component_div(&s.rotation_deg);
                let (a, b) = match region {
                    Region::Box => (d.amax(), w.amax()),
                    Region::Ellipsoid => (d.norm(), w.norm()),
                };
                assert!(a < 1.0 + 1e-12 && b < 1.0 + 1e-12);
                reached = reached.max(a.min(b));
            }
            assert!(reached > 1.0 - 1e-12);
        }
    }

    /// A symmetric pair is the half width itself, so that no digit of an answer changes.
    #[test]
    fn intervals_have_their_middle_and_hold_home() {
        for half in [0.0, 0.1, 1.0 / 3.0, 259.0] {
            let pair = CoordinateRange { min: -half, max: half };
            assert_eq!((pair, pair.half_width(), pair.middle()), (CoordinateRange::within(half), half, 0.0));
        }
        let mut rng = Rng::new(8);
        for _ in 0..1000 {
            let travel = CoordinateRange { min: -rng.unit(), max: rng.unit() };
            let (middle, half) = (travel.middle(), travel.half_width());
            // rounded sums are monotone, so they cannot hide an end that lies outside
            assert!(middle + half >= travel.max && middle - half <= travel.min);
            assert!(half - 0.5 * (travel.max - travel.min) < 1e-15 && travel.reach() >= half);
        }
        for region in [Region::Box, Region::Ellipsoid] {
            let angles = [10.0; 3].map(CoordinateRange::within);
            let sides = [
                CoordinateRange { min: -3.0, max: 9.0 },
                CoordinateRange { min: -2.0, max: 3.0 },
                CoordinateRange::default(),
            ];
            let s = PoseSpace::at(space(region).home).with_region(region, &sides, &angles);
            let home = s.cube_points(5, &mut rng)[1];
            assert!((s.pose(&home).position - s.home.position).norm() < 1e-14);
            assert!(s.pose(&home).rotation.angle_to(&s.home.rotation) < 1e-14);
            let ends = |k: usize| {
                let mut x = Vector6::zeros();
                [-1.0, 1.0].map(|end| {
                    x[k] = end;
                    s.pose(&x).position[k]
                })
            };
            assert_eq!((ends(0), ends(1)), ([-3.0, 9.0], [-2.0, 3.0]));
            let half_size = s.scaled_region(0.5);
            assert_eq!(
                (half_size.reach().0, s.reach().0),
                (Vector3::new(4.5, 1.5, 0.0), Vector3::new(9.0, 3.0, 0.0))
            );
        }
    }

    /// A box of translations to one side is the box about a moved home.
    #[test]
    fn intervals_to_one_side_are_a_region_about_a_moved_home() {
        let home = space(Region::Box).home;
        let sides = [
            CoordinateRange { min: -2.0, max: 6.0 },
            CoordinateRange { min: -1.0, max: 0.0 },
            CoordinateRange::within(3.0),
        ];
        let shift = Vector3::new(2.0, -0.5, 0.0);
        let still = [CoordinateRange::default(); 3];
        for region in [Region::Box, Region::Ellipsoid] {
            let own = PoseSpace::at(home).with_region(region, &sides, &still);
            let moved = Pose { position: home.position + shift, ..home };
            let other = PoseSpace::at(moved).with_region(
                region,
                &[4.0, 0.5, 3.0].map(CoordinateRange::within),
                &still,
            );
            for x in other.cube_points(50, &mut Rng::new(5)) {
                assert!((own.pose(&x).position - other.pose(&x).position).norm() < 1e-14);
            }
        }
    }

    /// The box about home that replaces a pivot holds all poses of region and ranges.
    #[test]
    fn the_box_about_home_holds_the_region_about_a_pivot() {
        let mut s = PoseSpace { pivot: Vector3::new(3.0, 0.0, -20.0), ..space(Region::Box) };
        s.ranges[4] = CoordinateRange { min: -50.0, max: 10.0 };
        let (position, angle) = s.box_about_home();
        let mut poses: Vec<Pose> = s.cube_points(200, &mut Rng::new(6)).iter().map(|x| s.pose(x)).collect();
        poses.extend(s.along_ranges(20));
        for pose in poses {
            let d = (pose.position - s.home.position).abs();
            let w = turn_between(&s.home.rotation, &pose.rotation).map(|x| x.to_degrees().abs());
            assert!((0..3).all(|k| d[k] <= position[k] + 1e-12 && w[k] <= angle[k] + 1e-9), "{d} {w}");
        }
    }

    #[test]
    fn poses_listed_from_home_move_with_it_and_those_from_the_base_stay() {
        let mut s = space(Region::Box);
        let at = Pose { rotation: Rotation3::new(Vector3::x()), position: Vector3::new(1.0, 2.0, 10.0) };
        (s.poses, s.trajectory) = (vec![at], vec![at]);
        let home = Pose {
            rotation: Rotation3::new(Vector3::z()) * s.home.rotation,
            position: s.home.position + Vector3::new(0.0, 0.0, 4.0),
        };
        let stay = s.with_home(home);
        assert_eq!((stay.home, &stay.poses, &stay.trajectory), (home, &s.poses, &s.trajectory));
        s.listed_from = ListedFrom::Home;
        let moved = s.with_home(home).poses[0];
        assert!((moved.position - Vector3::new(1.0, 2.0, 14.0)).norm() < 1e-14);
        // rotated by equal angles about the same axes of the base frame as before
        let turn = |pose: &Pose, from: &Pose| turn_between(&from.rotation, &pose.rotation);
        assert!((turn(&moved, &home) - turn(&at, &s.home)).norm() < 1e-14);
    }

    #[test]
    fn a_trajectory_passes_its_poses_and_turns_evenly_between_them() {
        let mut s = space(Region::Box);
        let end = Pose { rotation: Rotation3::new(Vector3::z()), position: Vector3::new(4.0, 0.0, 9.0) };
        s.trajectory = vec![s.home, end];
        let passed = s.listed(4);
        assert_eq!((passed.len(), passed[0], passed[4]), (5, s.home, end));
        assert!(
            (rotation_vector(&passed[1].rotation).norm() - 0.25).abs() < 1e-15
                && (passed[1].position.x - 1.0).abs() < 1e-15
        );
    }
}
