//! The poses a design has to reach.

use nalgebra::{Rotation3, Vector3};

use crate::geom::Pose;

/// A box of poses around the home pose, sampled on a grid, and single poses.
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
    /// Single poses.
    pub poses: Vec<Pose>,
}

impl Default for Workspace {
    /// No box, no poses, two points per axis (the corners).
    fn default() -> Self {
        Self { translation: Vector3::zeros(), rotation_deg: Vector3::zeros(), grid: 2, poses: Vec::new() }
    }
}

impl Workspace {
    /// `true` when some half width of the box is not zero.
    #[must_use]
    pub fn has_box(&self) -> bool {
        self.translation.iter().chain(self.rotation_deg.iter()).any(|w| *w > 0.0)
    }

    /// All sampled poses: the home pose (the centre) first, then the grid of the box with the last axis
    /// fastest, then the single poses. `grid` points are spread evenly from `-h` to `h` on each axis of half
    /// width `h > 0`; two points are the corners, one point is the centre alone. The centre is not repeated.
    /// Without `home` only the single poses.
    #[must_use]
    pub fn sample(&self, home: Option<&Pose>) -> Vec<Pose> {
        let mut poses: Vec<Pose> = Vec::new();
        if let Some(home) = home {
            poses.push(*home);
            if self.has_box() {
                poses.extend(self.grid_offsets().iter().map(|(d, w)| Pose {
                    rotation: Rotation3::new(w.map(f64::to_radians)) * home.rotation,
                    position: home.position + d,
                }));
            }
        }
        poses.extend_from_slice(&self.poses);
        poses
    }

    /// Offsets `(d, w)` of the grid points, without the centre.
    fn grid_offsets(&self) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let half_widths: Vec<f64> =
            self.translation.iter().chain(self.rotation_deg.iter()).copied().collect();
        let mut points = vec![Vec::new()];
        for h in half_widths {
            let steps = self.axis_steps(h);
            points = points
                .iter()
                .flat_map(|p: &Vec<f64>| {
                    steps.iter().map(move |s| p.iter().copied().chain([*s]).collect::<Vec<f64>>())
                })
                .collect();
        }
        points
            .into_iter()
            .filter(|p| p.iter().any(|x| *x != 0.0))
            .map(|p| (Vector3::new(p[0], p[1], p[2]), Vector3::new(p[3], p[4], p[5])))
            .collect()
    }

    fn axis_steps(&self, half_width: f64) -> Vec<f64> {
        if self.grid < 2 || half_width <= 0.0 {
            return vec![0.0];
        }
        // 2k - (n-1) is exactly zero in the middle, so that the centre can be told
        let last = self.grid as f64 - 1.0;
        (0..self.grid).map(|k| half_width * ((2.0 * k as f64 - last) / last)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_centre_corners_and_single_poses_in_order() {
        let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 5.0) };
        let far = Pose { rotation: Rotation3::identity(), position: Vector3::new(9.0, 0.0, 5.0) };
        let mut box_ = Workspace {
            translation: Vector3::new(1.0, 0.0, 2.0),
            rotation_deg: Vector3::new(0.0, 0.0, 90.0),
            grid: 2,
            poses: vec![far],
        };
        let poses = box_.sample(Some(&home));
        assert_eq!(poses.len(), 1 + 8 + 1);
        assert_eq!((poses[0], poses[9]), (home, far));
        assert!((poses[1].position - Vector3::new(-1.0, 0.0, 3.0)).norm() < 1e-15);
        let turned = poses[2].rotation * Vector3::x();
        assert!((turned - Vector3::y()).norm() < 1e-15, "last axis fastest, degrees");
        box_.grid = 3;
        assert_eq!(box_.sample(Some(&home)).len(), 27 + 1, "the centre is counted once");
        assert_eq!(box_.sample(None), [far]);
        assert_eq!(Workspace::default().sample(Some(&home)), [home]);
    }
}
