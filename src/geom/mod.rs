//! Poses, quaternions, distance geometry.

mod pose;
mod quaternion;
mod trilateration;

pub use pose::{ComplexPose, Pose};
pub(crate) use pose::{nearest_rotation, reorthogonalised};
pub use quaternion::{random_rotation, rotation_from_quaternion};
pub use trilateration::trilaterate;
