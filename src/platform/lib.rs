//! The mechanism: six legs between two rigid bodies.
//!
//! The crate has poses, joints and legs, the lengths and the Jacobian at a pose, and the topology of shared joints. It
//! solves and decides nothing. It uses only `num`.
//!
//! * [`Manipulator`](manipulator::Manipulator): the joints of both bodies and the two ends of each leg.
//! * [`Pose`](geom::Pose): the pose of the platform, `x_base = R x_platform + p`.
//! * [`Topology`](topology::Topology): the legs that share joints.
//!
//! A manipulator is checked once, at its construction. Lengths follow from it and a pose, and the rest of the library
//! uses both.

pub mod geom;
pub mod manipulator;
pub mod pentapod;
pub mod topology;
