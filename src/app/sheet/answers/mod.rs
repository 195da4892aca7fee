//! The sheet of each answer, one file for each; [`document()`] chooses the sheet for a JSON document.

mod assess;
mod at_pose;
#[cfg(feature = "lab")]
mod bench;
mod calibrate;
mod check;
mod compare;
mod components;
mod derivation;
mod document;
mod drives;
mod export;
mod family;
mod fk;
mod frames;
mod legs;
mod limits;
mod locus;
mod map;
mod motion;
mod moves;
mod nearest;
mod new_design;
mod optimize;
mod pentapod;
mod poses;
mod round;
mod self_motion;
mod singular_locus;
mod singular_poses;
mod tolerances;
mod topologies;
mod verify;

pub use assess::{
    MarginsAtPose, assess, assumptions, requirements, requirements_table, requirements_without_assumptions,
    sentence, verdict,
};
pub use at_pose::at_pose;
#[cfg(feature = "lab")]
pub use bench::bench;
pub use calibrate::calibrate;
pub use check::check;
pub use compare::compare;
pub use components::components;
pub use derivation::{derivation, derivation_steps};
pub use document::{document, heading, words};
pub use drives::drives;
pub use export::export;
pub use family::family;
pub use fk::fk;
pub use legs::legs;
pub use limits::{data_sheet, limits};
pub use locus::locus;
pub use map::{leg_map, map};
pub use motion::motion;
pub use moves::{move_search, moves};
pub use nearest::nearest;
pub use new_design::new_design;
pub use optimize::{optimize, search, symmetry_and_drives};
pub use pentapod::pentapod;
pub use round::round;
pub use self_motion::self_motion;
pub use singular_locus::singular_locus;
pub use singular_poses::singular_poses;
pub use tolerances::tolerances;
pub use topologies::topologies;
pub use verify::verify;
