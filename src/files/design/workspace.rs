//! The poses a design has to reach.

use nalgebra::{Vector3, Vector6};

use super::DesignModel;
use machine::requirements::{CoordinateRange, ListedFrom, PoseSpace, Region};
use platform::geom::Pose;
use platform::manipulator::default_home;

/// Half width of the default box of translations, as a share of the design's size.
const TRANSLATION_SHARE: f64 = 0.15;
/// Half width of the default box of rotation vectors, degrees.
const ROTATION_DEG: f64 = 10.0;

/// A region of poses around the home pose, sampled on a grid, single poses, a trajectory, and ranges of single
/// coordinates.
///
/// With home `(R0, p0)` and pivot `q` the box holds `(exp([w]x) R0, p0 + d + R0 q - R q)`. `d_k` is in `translation_k`
/// (base frame, design units), `w_k` in `rotation_deg_k` (rotation vector, base frame, degrees).
#[derive(Debug, Clone, PartialEq)]
pub struct Workspace {
    /// Intervals of the translations `d`, design units.
    pub translation: [CoordinateRange; 3],
    /// Intervals of the components of the rotation vector `w`, degrees.
    pub rotation_deg: [CoordinateRange; 3],
    /// The point of the platform about which region and ranges rotate, platform frame, if the table states one.
    pub pivot: Option<Vector3<f64>>,
    /// The pivot otherwise: the one of `[frames]`, or the origin.
    pub frames_pivot: Vector3<f64>,
    /// Ranges over which each coordinate moves alone from home: translations along the axes of the base frame in design
    /// units, rotations about these axes in degrees.
    pub ranges: [CoordinateRange; 6],
    /// Points per axis of the grid, 1 to 5. An axis of width zero has one point.
    pub grid: usize,
    /// Box or ellipsoids with these half axes.
    pub region: Region,
    /// Single poses, as listed.
    pub poses: Vec<Pose>,
    /// Poses of a path, in order.
    pub trajectory: Option<Trajectory>,
    /// The reference of single poses and those of the trajectory.
    pub listed_from: ListedFrom,
}

/// A trajectory from a separate table.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// The file name of the table, as in the design.
    pub file: String,
    /// Its poses, as listed. The parser leaves them empty: the program reads files.
    pub poses: Vec<Pose>,
}

impl Default for Workspace {
    /// No box, no poses, two points per axis (the corners).
    fn default() -> Self {
        Self {
            translation: [CoordinateRange::default(); 3],
            rotation_deg: [CoordinateRange::default(); 3],
            pivot: None,
            frames_pivot: Vector3::zeros(),
            ranges: [CoordinateRange::default(); 6],
            grid: 2,
            region: Region::Box,
            poses: Vec::new(),
            trajectory: None,
            listed_from: ListedFrom::Base,
        }
    }
}

impl Workspace {
    /// `true` if some interval of the region has a width.
    #[must_use]
    pub fn has_box(&self) -> bool {
        !self.translation.iter().chain(&self.rotation_deg).all(|travel| travel.is_still())
    }

    /// The number of coordinates with a range of their own.
    #[must_use]
    pub fn ranged_coordinates(&self) -> usize {
        self.ranges.iter().filter(|range| !range.is_still()).count()
    }

    /// `true` if nothing is stated about poses.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !self.has_box()
            && self.poses.is_empty()
            && self.trajectory.is_none()
            && self.ranged_coordinates() == 0
    }

    /// `true` if some key of the table differs from its default.
    pub(super) fn states_anything(&self) -> bool {
        *self != Self { frames_pivot: self.frames_pivot, ..Self::default() }
    }

    /// All poses to reach, around `home`.
    #[must_use]
    pub fn space(&self, home: &Pose) -> PoseSpace {
        PoseSpace {
            pivot: self.pivot.unwrap_or(self.frames_pivot),
            ranges: self.ranges,
            poses: self.poses.iter().map(|p| self.listed_from.in_base_frame(p, home)).collect(),
            trajectory: self
                .trajectory
                .iter()
                .flat_map(|t| &t.poses)
                .map(|p| self.listed_from.in_base_frame(p, home))
                .collect(),
            listed_from: self.listed_from,
            ..PoseSpace::at(*home).with_region(self.region, &self.translation, &self.rotation_deg)
        }
    }

    /// All sampled poses. The home pose is first, then the grid with the last axis fastest, the single poses, those of
    /// the trajectory, and the ends of the ranges. On each axis of the cube ([`PoseSpace::pose`]) with a width above 0,
    /// `grid` points are evenly spaced from -1 to 1. Two points are the corners; one point is the centre alone. A
    /// centre at home is not repeated.
    #[must_use]
    pub fn sample(&self, home: &Pose) -> Vec<Pose> {
        let space = self.space(home);
        let mut poses = vec![*home];
        let points = self.grid_points(&space.axes());
        let is_home = |x: &Vector6<f64>| space.home_in_cube().is_none() && *x == Vector6::zeros();
        poses.extend(points.iter().filter(|x| !is_home(x)).map(|x| space.pose(x)));
        poses.extend_from_slice(&space.poses);
        poses.extend_from_slice(&space.trajectory);
        poses.extend(space.along_ranges(1));
        poses
    }

    /// Grid points of the cube.
    fn grid_points(&self, axes: &[usize]) -> Vec<Vector6<f64>> {
        // 2k - (n-1) is exactly zero in the middle, so that the centre is recognised
        let last = self.grid as f64 - 1.0;
        let steps: Vec<f64> = match self.grid {
            0 | 1 => vec![0.0],
            n => (0..n).map(|k| (2.0 * k as f64 - last) / last).collect(),
        };
        let mut points = vec![Vector6::zeros()];
        for &k in axes {
            let extend = |p: &Vector6<f64>| {
                let p = *p;
                steps.iter().map(move |s| {
                    let mut q = p;
                    q[k] = *s;
                    q
                })
            };
            points = points.iter().flat_map(extend).collect();
        }
        points
    }
}

impl DesignModel {
    /// The home pose of the design, or [`default_home`] without one.
    #[must_use]
    pub fn home_or_default(&self) -> Pose {
        self.home.unwrap_or_else(|| default_home(self.manipulator()))
    }

    /// The workspace of the design. Without one it is a box about home, 15 % of the size to each side and 10 degrees
    /// about each axis.
    #[must_use]
    pub fn workspace_or_default(&self) -> Workspace {
        if !self.workspace.is_empty() {
            return self.workspace.clone();
        }
        Workspace {
            translation: [CoordinateRange::within(TRANSLATION_SHARE * self.manipulator().size()); 3],
            rotation_deg: [CoordinateRange::within(ROTATION_DEG); 3],
            frames_pivot: self.workspace.frames_pivot,
            ..Workspace::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn samples_centre_corners_and_single_poses_in_order() {
        let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 5.0) };
        let far = Pose { rotation: Rotation3::identity(), position: Vector3::new(9.0, 0.0, 5.0) };
        let mut box_ = Workspace {
            translation: [1.0, 0.0, 2.0].map(CoordinateRange::within),
            rotation_deg: [0.0, 0.0, 90.0].map(CoordinateRange::within),
            grid: 2,
            poses: vec![far],
            ..Workspace::default()
        };
        let poses = box_.sample(&home);
        assert_eq!(poses.len(), 1 + 8 + 1);
        assert_eq!((poses[0], poses[9]), (home, far));
        assert!((poses[1].position - Vector3::new(-1.0, 0.0, 3.0)).norm() < 1e-15);
        let turned = poses[2].rotation * Vector3::x();
        assert!((turned - Vector3::y()).norm() < 1e-15, "last axis fastest, degrees");
        box_.grid = 3;
        assert_eq!(box_.sample(&home).len(), 27 + 1, "the centre is counted once");
        assert_eq!(Workspace::default().sample(&home), [home]);
        box_.listed_from = ListedFrom::Home;
        let moved = box_.sample(&home)[27].position;
        assert!((moved - (home.position + far.position)).norm() < 1e-15, "counted from home");
    }
}
