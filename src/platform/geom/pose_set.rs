//! The poses for which requirements hold.

use nalgebra::{Rotation3, Vector3, Vector6};

use super::Pose;
use super::rotation_vector::turn_between;
use num::Rng;

/// The shape of a region of poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case"),
    schemars(rename = "RegionWord")
)]
pub enum Region {
    /// A box.
    // every component of translation and rotation within its half width
    #[default]
    Box,
    /// An ellipsoid.
    // translations in one, rotation vectors in another, with the half widths as half axes; every translation with every
    // rotation
    Ellipsoid,
}

impl Region {
    /// The word: `"box"` or `"ellipsoid"`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Ellipsoid => "ellipsoid",
        }
    }
}

num::words! {
    /// The reference of the listed poses of a workspace.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum ListedFrom: name {
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

/// All poses that a platform has to reach.
///
/// The region around home `(R0, p0)` contains the poses `(exp([w]x) R0, p0 + d)` (base frame), with `(d, w)` the image
/// of a point `x` of the cube `[-1, 1]^6`. In a box `d_k = h_k x_k`. In an ellipsoid each half of `x` is first
/// shortened by its greatest entry over its norm. This maps the cube onto the ball and its faces onto the sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSpace {
    /// Centre of the region.
    pub home: Pose,
    /// Box or ellipsoid.
    pub region: Region,
    /// Half widths of the translation, design units.
    pub translation: Vector3<f64>,
    /// Half widths of the rotation vector, degrees.
    pub rotation_deg: Vector3<f64>,
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

impl PoseSpace {
    /// Home alone.
    #[must_use]
    pub fn at(home: Pose) -> Self {
        Self {
            home,
            region: Region::Box,
            translation: Vector3::zeros(),
            rotation_deg: Vector3::zeros(),
            poses: Vec::new(),
            trajectory: Vec::new(),
            listed_from: ListedFrom::Base,
        }
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
        let turn = w.component_mul(&self.rotation_deg).map(f64::to_radians);
        Pose {
            rotation: Rotation3::new(turn) * self.home.rotation,
            position: self.home.position + d.component_mul(&self.translation),
        }
    }

    /// Points of the cube spread over the region: the centre, all corners, and `count` points of a Halton sequence.
    /// Another `count` points are random, every second one moved to a face.
    #[must_use]
    pub fn cube_points(&self, count: usize, rng: &mut Rng) -> Vec<Vector6<f64>> {
        let axes = self.axes();
        let mut out = vec![Vector6::zeros()];
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

    /// The poses outside the region: the single ones, and the trajectory with `steps` steps between its poses.
    #[must_use]
    pub fn listed(&self, steps: usize) -> Vec<Pose> {
        let mut out = self.poses.clone();
        out.extend(self.trajectory.first());
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
