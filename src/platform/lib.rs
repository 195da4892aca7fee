//! Describes the device: six legs between two rigid bodies.
//!
//! It knows poses, joints and legs, the lengths and the Jacobian at a pose, and which legs share which joints; it
//! solves nothing and judges nothing. It names `num` alone.
//!
//! * [`Manipulator`](manipulator::Manipulator): the joints of both bodies and the two ends of each leg.
//! * [`Pose`](geom::Pose): where the platform is, `x_base = R x_platform + p`.
//! * [`Topology`](topology::Topology): which legs share a joint.
//!
//! A manipulator is checked once where it is made; lengths follow from it and a pose, and everything else in the
//! library takes both.

pub mod geom;
pub mod manipulator;
pub mod pentapod;
pub mod topology;
