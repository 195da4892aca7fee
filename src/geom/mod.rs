//! Poses, quaternions, distance geometry.

mod pose;
mod quaternion;
mod segment;
mod trilateration;

pub use pose::{ComplexPose, Pose};
pub(crate) use pose::{nearest_rotation, reorthogonalised};
pub use quaternion::{random_rotation, rotation_from_quaternion};
pub use segment::{segment_box_distance, segment_distance};
pub use trilateration::trilaterate;
