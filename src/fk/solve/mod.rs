//! Solves six leg equations for all complex poses, and certifies the roots by code that shares nothing with the solver.
//! Nothing here knows where the equations come from.

pub mod certify;
mod dependence;
mod far_points;
#[cfg(feature = "lab")]
pub mod generic_frame;
pub mod homotopy;
mod octuple_sections;
mod planar;
pub mod pose_count;
mod sections;
pub mod special;
#[cfg(feature = "lab")]
pub mod sylvester;
#[cfg(feature = "lab")]
pub mod template;

pub use dependence::{LegDependence, dependence};
pub(crate) use far_points::FarSearch;
pub use planar::mirror;
pub use sections::{ScaledFrames, Sections, quaternion_product, split};
