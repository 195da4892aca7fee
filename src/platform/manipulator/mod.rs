//! The platform as a mechanism: joints, legs, lengths, inverse kinematics, Jacobian.
//!
//! A Gough-Stewart manipulator has six legs. Leg `i` joins the base joint `a_i` (coordinates in the base
//! frame) to the platform joint `b_i` (coordinates in the platform frame). At the pose `(R, p)` with
//! `x_base = R x_platform + p` its length is `l_i = |R b_i + p - a_i|`.

mod body;
mod exact_legs;
mod home;
mod jacobian;
mod leg;
mod lengths;
mod level;
mod octahedral;
mod over_poses;
mod values;

pub use body::{Body, NoSuchBody};
pub use exact_legs::{
    AlgebraicVector, ExactJoints, ExactLeg, ExactLegs, LegResidues, flat_dimension, homogeneous,
};
pub use home::default_home;
pub use home::height_above_base;
pub use jacobian::jacobian_of_legs;
pub use jacobian::leg_determinant;
pub use jacobian::{inverse_condition, jacobian, plucker_matrix};
pub use leg::{BaseJoint, InvalidManipulator, Leg, LegIndex, Manipulator, PlatformJoint};
pub use lengths::{InvalidLengths, LegLengths, SquaredLegLengths};
pub use level::Level;
pub use octahedral::is_collinear;
pub use octahedral::{NotOctahedral, Octahedral};
pub use over_poses::{least_axis_distance, length_range, worst_conditioning};
pub use values::{ExactEnds, JointKnowledge, dimension_of_ends, squares_of_ends, vector_of_ends};
pub use values::{JointValues, SurdPoint};
