//! Poses.

use nalgebra::{Matrix3, Matrix4};

use super::design::EqpDesign;
use super::failure::{CallFault, EqpError, EqpStatus, items, read, told, write};
use ask::Error;
use platform::geom::{Angles, Pose};

/// A pose: it moves a platform point `x` to `R x + p` in the base frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpPose {
    /// The rotation matrix `R`, row by row.
    pub rotation: [[f64; 3]; 3],
    /// The position `p`, design units.
    pub position: [f64; 3],
}

impl From<&Pose> for EqpPose {
    fn from(pose: &Pose) -> Self {
        let r = pose.rotation.matrix();
        Self {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| r[(i, j)])),
            position: pose.position.into(),
        }
    }
}

impl EqpPose {
    /// The pose; a matrix that is a rotation up to rounding becomes the nearest rotation.
    pub(super) fn checked(&self) -> Result<Pose, CallFault> {
        let mut matrix = Matrix4::identity();
        let rows = Matrix3::from_fn(|i, j| self.rotation[i][j]);
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&rows);
        for (k, x) in self.position.iter().enumerate() {
            matrix[(k, 3)] = *x;
        }
        Pose::try_from(matrix).map_err(|e| Error::from(e).into())
    }
}

/// Makes the pose with this position, design units, and this roll, pitch and yaw, degrees:
/// `R = Rz(yaw) Ry(pitch) Rx(roll)`.
///
/// # Safety
/// `position` and `rpy_deg` point to three numbers each, and `pose` to a place for a pose. The argument `error` is null
/// or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_pose_from_rpy(
    position: *const f64,
    rpy_deg: *const f64,
    pose: *mut EqpPose,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let position = read(position.cast::<[f64; 3]>(), "position")?;
            let angles = read(rpy_deg.cast::<[f64; 3]>(), "rpy_deg")?;
            if !position.iter().chain(angles).all(|x| x.is_finite()) {
                return Err(CallFault::new(EqpStatus::BadPose, "a number of the pose is not finite"));
            }
            *write(pose, "pose")? = (&Pose::new(*position, Angles::from_degrees(*angles))).into();
            Ok(())
        })
    }
}

/// Roll, pitch and yaw of a pose, degrees.
///
/// # Safety
/// `pose` points to a pose, `rpy_deg` to places for three numbers, `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_pose_rpy(
    pose: *const EqpPose,
    rpy_deg: *mut f64,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let pose = read(pose, "pose")?.checked()?;
            *write(rpy_deg.cast::<[f64; 3]>(), "rpy_deg")? = pose.angles().degrees();
            Ok(())
        })
    }
}

/// Makes the pose of `count` numbers in the convention of a design (`eqp_design_frames`): six are position and angles,
/// seven are position and a unit quaternion.
///
/// # Safety
/// `design` is a design, `numbers` points to `count` numbers, and `pose` to a place for a pose. The argument `error` is
/// null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_pose_from_numbers(
    design: *const EqpDesign,
    numbers: *const f64,
    count: usize,
    pose: *mut EqpPose,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let frames = read(design, "design")?.frames();
            let numbers = items(numbers, count, "numbers")?;
            let found = frames.convention.read(numbers, &frames.home).map_err(Error::from)?;
            *write(pose, "pose")? = (&found).into();
            Ok(())
        })
    }
}

/// Position and angles of a pose in the convention of a design, six numbers, and its quaternion, four numbers;
/// `quaternion` may be null.
///
/// # Safety
/// `design` is a design, `pose` points to a pose, `numbers` to places for six numbers, and `quaternion` is null or
/// points to places for four. The argument `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_pose_numbers(
    design: *const EqpDesign,
    pose: *const EqpPose,
    numbers: *mut f64,
    quaternion: *mut f64,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let frames = read(design, "design")?.frames();
            let written = frames.write(&read(pose, "pose")?.checked()?);
            let numbers = write(numbers.cast::<[f64; 6]>(), "numbers")?;
            if let Some(to) = quaternion.cast::<[f64; 4]>().as_mut() {
                *to = written.quaternion;
            }
            *numbers = written.numbers();
            Ok(())
        })
    }
}
