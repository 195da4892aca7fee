//! Poses, quaternions, distance geometry.

mod pose;
mod quaternion;
mod trilateration;

pub(crate) use pose::reorthogonalised;
pub use pose::{ComplexPose, Pose};
pub use quaternion::{random_rotation, rotation_from_quaternion};
pub use trilateration::trilaterate;
