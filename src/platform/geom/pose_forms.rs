//! Other forms of a pose: nalgebra's isometries, 4 x 4 matrices, position with quaternion, named angles, a line of
//! numbers.

use std::str::FromStr;

use nalgebra::{Isometry3, Matrix3, Matrix4, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3};
use thiserror::Error;

use super::convention::angles_of_product;
use super::pose::{ROUNDED, nearest_rotation};
use super::{Pose, PoseConvention};

/// Greatest accepted difference between `R^T R` of a matrix and the identity: matrices written with seven digits pass.
const ORTHOGONAL: f64 = 1e-6;
/// Greatest accepted difference between the norm of a quaternion and 1: quaternions written with three digits pass.
const UNIT: f64 = 1e-3;

/// Reasons why data are no pose.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidPose {
    /// An entry is NaN or infinite.
    #[error("an entry of the pose is not a finite number")]
    NotFinite,
    /// The upper left 3 x 3 part is not a rotation.
    #[error(
        "the matrix is no rotation: R^T R differs from the identity by {error:e}, det R is {determinant}"
    )]
    NotARotation {
        /// Greatest entry of `R^T R - I`.
        error: f64,
        /// `det R`.
        determinant: f64,
    },
    /// The last row of a 4 x 4 matrix is not `0 0 0 1`.
    #[error("the last row of the matrix is {0:?}, not [0, 0, 0, 1]")]
    LastRow([f64; 4]),
    /// A quaternion whose norm is not 1.
    #[error("the quaternion has norm {0:.4}, not 1")]
    QuaternionNorm(f64),
    /// A text that does not have six or seven numbers.
    #[error("{0}")]
    Text(String),
}

/// Roll, pitch and yaw: rotations about the fixed axes x, then y, then z, `R = Rz(yaw) Ry(pitch) Rx(roll)`, as
/// `rpy_deg` in design files.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Angles {
    roll: f64,
    pitch: f64,
    yaw: f64,
}

impl Angles {
    /// Angles in degrees: roll, pitch, yaw.
    #[must_use]
    pub fn from_degrees([roll, pitch, yaw]: [f64; 3]) -> Self {
        Self::from_radians([roll.to_radians(), pitch.to_radians(), yaw.to_radians()])
    }

    /// Angles in radians: roll, pitch, yaw.
    #[must_use]
    pub fn from_radians([roll, pitch, yaw]: [f64; 3]) -> Self {
        Self { roll, pitch, yaw }
    }

    /// Roll, pitch and yaw in degrees.
    #[must_use]
    pub fn degrees(&self) -> [f64; 3] {
        self.radians().map(f64::to_degrees)
    }

    /// Roll, pitch and yaw in radians.
    #[must_use]
    pub fn radians(&self) -> [f64; 3] {
        [self.roll, self.pitch, self.yaw]
    }

    /// The angles of a rotation: pitch from -90 to 90 degrees, the others from -180 to 180. At a pitch of +-90 degrees
    /// only a combination of roll and yaw is determined. The yaw then follows from the rounding of the matrix, or is
    /// zero for zero entries, and the roll matches it.
    #[must_use]
    pub fn of(rotation: &Rotation3<f64>) -> Self {
        let [yaw, pitch, roll] = angles_of_product(rotation.matrix(), [2, 1, 0]).angles;
        Self { roll, pitch, yaw }
    }
}

impl From<Angles> for Rotation3<f64> {
    fn from(angles: Angles) -> Self {
        Self::from_euler_angles(angles.roll, angles.pitch, angles.yaw)
    }
}

impl Pose {
    /// A pose from its position and any form of a rotation: [`Angles`], a unit quaternion, a rotation matrix.
    ///
    /// ```
    /// # mod equipod { pub mod methods { pub use equipod_platform::{geom, manipulator, topology}; } pub mod prelude { pub use equipod_platform::geom::*; } }
    /// use equipod::prelude::*;
    /// let pose = Pose::new([0.0, 0.0, 17.0], Angles::from_degrees([0.0, 10.0, 0.0]));
    /// let isometry: nalgebra::Isometry3<f64> = pose.into();
    /// assert!((pose.matrix() - isometry.to_homogeneous()).amax() < 1e-15);
    /// assert!((Pose::try_from(pose.matrix())?.angles().degrees()[1] - 10.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn new(position: impl Into<Vector3<f64>>, rotation: impl Into<Rotation3<f64>>) -> Self {
        Self { rotation: rotation.into(), position: position.into() }
    }

    /// A pose from its position and the quaternion `[w, x, y, z]` of its rotation, scalar first, of norm 1 within a
    /// thousandth.
    ///
    /// # Errors
    /// Entries are not finite, or the norm differs.
    pub fn from_quaternion(position: impl Into<Vector3<f64>>, wxyz: [f64; 4]) -> Result<Self, InvalidPose> {
        let [w, x, y, z] = wxyz;
        let position = position.into();
        let q = Quaternion::new(w, x, y, z);
        if !position.iter().chain(&wxyz).all(|x| x.is_finite()) {
            return Err(InvalidPose::NotFinite);
        }
        if !((q.norm() - 1.0).abs() <= UNIT) {
            return Err(InvalidPose::QuaternionNorm(q.norm()));
        }
        Ok(Self { rotation: UnitQuaternion::from_quaternion(q).to_rotation_matrix(), position })
    }

    /// Roll, pitch and yaw of the rotation.
    #[must_use]
    pub fn angles(&self) -> Angles {
        Angles::of(&self.rotation)
    }

    /// The 4 x 4 matrix `(R p; 0 1)`.
    #[must_use]
    pub fn matrix(&self) -> Matrix4<f64> {
        let mut m = self.rotation.to_homogeneous();
        m.fixed_view_mut::<3, 1>(0, 3).copy_from(&self.position);
        m
    }
}

/// A 4 x 4 matrix `(R p; 0 1)`. A rotation up to rounding becomes the nearest one.
impl TryFrom<Matrix4<f64>> for Pose {
    type Error = InvalidPose;

    #[inline]
    fn try_from(m: Matrix4<f64>) -> Result<Self, InvalidPose> {
        Self::of_matrix(&m, ORTHOGONAL)
    }
}

impl Pose {
    /// The pose of `(R p; 0 1)` with `R^T R` off by at most `rounding` or by the digits that are always allowed.
    pub(super) fn of_matrix(m: &Matrix4<f64>, rounding: f64) -> Result<Self, InvalidPose> {
        if !m.iter().all(|x| x.is_finite()) {
            return Err(InvalidPose::NotFinite);
        }
        let last = std::array::from_fn(|j| m[(3, j)]);
        if !(last.iter().zip([0.0, 0.0, 0.0, 1.0]).all(|(x, y): (&f64, f64)| (x - y).abs() <= 1e-12)) {
            return Err(InvalidPose::LastRow(last));
        }
        let r: Matrix3<f64> = m.fixed_view::<3, 3>(0, 0).into_owned();
        let error = (r.transpose() * r - Matrix3::identity()).amax();
        let determinant = r.determinant();
        if !(error <= rounding.max(ORTHOGONAL) && determinant > 0.0) {
            return Err(InvalidPose::NotARotation { error, determinant });
        }
        let rotation =
            if error <= ROUNDED { Rotation3::from_matrix_unchecked(r) } else { nearest_rotation(&r) };
        Ok(Self { rotation, position: m.fixed_view::<3, 1>(0, 3).into_owned() })
    }
}

impl From<Pose> for Matrix4<f64> {
    fn from(pose: Pose) -> Self {
        pose.matrix()
    }
}

impl From<Isometry3<f64>> for Pose {
    fn from(m: Isometry3<f64>) -> Self {
        Self { rotation: m.rotation.to_rotation_matrix(), position: m.translation.vector }
    }
}

impl From<Pose> for Isometry3<f64> {
    fn from(pose: Pose) -> Self {
        Self::from_parts(
            Translation3::from(pose.position),
            UnitQuaternion::from_rotation_matrix(&pose.rotation),
        )
    }
}

/// `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`: a pose on a line of a table.
impl FromStr for Pose {
    type Err = InvalidPose;

    fn from_str(text: &str) -> Result<Self, InvalidPose> {
        let nowhere = Self { rotation: Rotation3::identity(), position: Vector3::zeros() };
        PoseConvention::default().read_text(text, &nowhere)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random_rotation;
    use num::Rng;

    #[test]
    fn every_form_gives_the_pose_back() {
        let mut rng = Rng::new(5);
        for _ in 0..500 {
            let position = Vector3::from_fn(|_, _| rng.normal());
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            let same = |other: &Pose| {
                (other.rotation.matrix() - pose.rotation.matrix()).amax() < 1e-14
                    && (other.position - pose.position).amax() < 1e-15
            };
            assert!(same(&Pose::try_from(pose.matrix()).unwrap()));
            assert!(same(&Pose::from(Isometry3::from(pose))));
            assert!(same(&Pose::from_quaternion(pose.position, pose.quaternion()).unwrap()));
            assert!(same(&Pose::new(pose.position, pose.angles())));
            assert!(same(&Pose::new(pose.position, Angles::from_degrees(pose.angles().degrees()))));
            let [qw, qx, qy, qz] = pose.quaternion();
            let line = format!("{},{},{},{qw},{qx},{qy},{qz}", position.x, position.y, position.z);
            assert!(same(&line.parse().unwrap()));
        }
    }

    #[test]
    fn angles_give_the_rotation_back_where_roll_and_yaw_are_not_told_apart() {
        for pitch in [90.0, -90.0, 90.0 - 1e-6, 90.0 - 1e-9, -90.0 + 1e-13] {
            for (roll, yaw) in [(0.0, 0.0), (30.0, 0.0), (0.0, -75.0), (170.0, -160.0)] {
                let rotation = Rotation3::from(Angles::from_degrees([roll, pitch, yaw]));
                let again = Rotation3::from(Angles::of(&rotation));
                assert!((again.matrix() - rotation.matrix()).amax() < 4e-16, "{roll} {pitch} {yaw}");
            }
        }
        assert_eq!(Angles::of(&Rotation3::identity()), Angles::default());
        let half = Angles::of(&Rotation3::from_euler_angles(std::f64::consts::PI, 0.0, 0.0));
        assert!((half.degrees()[0].abs() - 180.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_pose_is_refused() {
        let good = Pose::new([1.0, 2.0, 3.0], Rotation3::identity()).matrix();
        let changed = |i: usize, j: usize, x: f64| {
            let mut m = good;
            m[(i, j)] = x;
            Pose::try_from(m)
        };
        assert_eq!(changed(0, 3, f64::NAN), Err(InvalidPose::NotFinite));
        assert!(matches!(changed(3, 0, 0.1), Err(InvalidPose::LastRow(_))));
        assert!(matches!(changed(0, 0, -1.0), Err(InvalidPose::NotARotation { .. })), "a reflection");
        assert!(matches!(changed(0, 1, 0.01), Err(InvalidPose::NotARotation { .. })), "a shear");
        assert!(changed(0, 1, 1e-8).is_ok(), "rounding");
        assert!(matches!(Pose::from_quaternion([0.0; 3], [0.0; 4]), Err(InvalidPose::QuaternionNorm(_))));
        assert!(matches!(
            Pose::from_quaternion([0.0; 3], [2.0, 0.0, 0.0, 0.0]),
            Err(InvalidPose::QuaternionNorm(_))
        ));
        assert!("1,2,3".parse::<Pose>().is_err() && "1,2,3,4,5,x".parse::<Pose>().is_err());
        assert!("".parse::<Pose>().is_err() && "0,0,1,0,0,inf".parse::<Pose>().is_err());
    }
}
