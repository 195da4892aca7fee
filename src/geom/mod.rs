//! Poses, quaternions, distance geometry.

mod pose;
mod quaternion;

pub use pose::{ComplexPose, Pose};
pub use quaternion::{random_rotation, rotation_from_quaternion};
