//! The poses a design has to reach.

use nalgebra::{Vector3, Vector6};

use super::DesignModel;
use machine::requirements::{ListedFrom, PoseSpace, Region};
use platform::geom::Pose;
use platform::manipulator::default_home;

/// Half width of the default box of translations, as a share of the design's size.
const TRANSLATION_SHARE: f64 = 0.15;
/// Half width of the default box of rotation vectors, degrees.
const ROTATION_DEG: f64 = 10.0;

/// A region of poses around the home pose, sampled on a grid, single poses, and a trajectory.
///
/// With home `(R0, p0)` the box holds `(exp([w]x) R0, p0 + d)`, `|d_k| <= translation_k` (base frame,
/// design units), `|w_k| <= rotation_deg_k` (rotation vector, base frame, degrees).
#[derive(Debug, Clone, PartialEq)]
pub struct Workspace {
    /// Half widths of the translations `d`, design units.
    pub translation: Vector3<f64>,
    /// Half widths of the components of the rotation vector `w`, degrees.
    pub rotation_deg: Vector3<f64>,
    /// Points per axis of the grid, 1 to 5. An axis of half width zero has one point.
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
            translation: Vector3::zeros(),
            rotation_deg: Vector3::zeros(),
            grid: 2,
            region: Region::Box,
            poses: Vec::new(),
            trajectory: None,
            listed_from: ListedFrom::Base,
        }
    }
}

impl Workspace {
    /// `true` if some half width is not zero.
    #[must_use]
    pub fn has_box(&self) -> bool {
        self.translation.iter().chain(self.rotation_deg.iter()).any(|w| *w > 0.0)
    }

    /// `true` if nothing is stated about poses.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !self.has_box() && self.poses.is_empty() && self.trajectory.is_none()
    }

    /// All poses to reach, around `home`.
    #[must_use]
    pub fn space(&self, home: &Pose) -> PoseSpace {
        PoseSpace {
            home: *home,
            region: self.region,
            translation: self.translation,
            rotation_deg: self.rotation_deg,
            poses: self.poses.iter().map(|p| self.listed_from.in_base_frame(p, home)).collect(),
            trajectory: self
                .trajectory
                .iter()
                .flat_map(|t| &t.poses)
                .map(|p| self.listed_from.in_base_frame(p, home))
                .collect(),
            listed_from: self.listed_from,
        }
    }

    /// All sampled poses. The home pose (the centre) is first, then the grid with the last axis fastest, the single
    /// poses, and those of the trajectory. On each axis of the cube ([`PoseSpace::pose`]) with a half width above 0,
    /// `grid` points are evenly spaced from -1 to 1. Two points are the corners; one point is the centre alone. The
    /// centre is not repeated.
    #[must_use]
    pub fn sample(&self, home: &Pose) -> Vec<Pose> {
        let space = self.space(home);
        let mut poses = vec![*home];
        poses.extend(self.grid_points(&space.axes()).iter().map(|x| space.pose(x)));
        poses.extend_from_slice(&space.poses);
        poses.extend_from_slice(&space.trajectory);
        poses
    }

    /// Grid points of the cube, without the centre.
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
        points.retain(|p| p.iter().any(|x| *x != 0.0));
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
        let translation = Vector3::repeat(TRANSLATION_SHARE * self.manipulator().size());
        Workspace { translation, rotation_deg: Vector3::repeat(ROTATION_DEG), ..Workspace::default() }
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
            translation: Vector3::new(1.0, 0.0, 2.0),
            rotation_deg: Vector3::new(0.0, 0.0, 90.0),
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
