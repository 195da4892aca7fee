//! Poses.

use nalgebra::{Matrix3, Matrix4};

use super::failure::{CallFault, EqpError, EqpStatus, read, told, write};
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
