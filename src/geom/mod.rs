//! Poses, quaternions, distance geometry.

mod hull;
mod pose;
mod quaternion;
mod segment;
mod trilateration;

pub(crate) use hull::convex_hull;
pub use pose::{ComplexPose, Pose};
pub(crate) use pose::{nearest_rotation, reorthogonalised};
pub use quaternion::{random_rotation, rotation_from_quaternion};
pub use segment::{segment_box_distance, segment_distance};
pub use trilateration::trilaterate;
