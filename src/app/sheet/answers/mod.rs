//! The sheet of each answer, a file an answer; [`document()`] finds the one of a JSON document.

mod assess;
mod check;
mod compare;
mod derivation;
mod document;
mod drives;
mod family;
mod legs;
mod limits;
mod map;
mod motion;
mod moves;
mod optimize;
mod round;
mod tolerances;
mod verify;

pub use assess::{
    assess, assumptions, requirements, requirements_without_assumptions, sentence,
    table as requirements_table,
};
pub use check::check;
pub use compare::compare;
pub use derivation::derivation;
pub use document::{document, heading, words};
pub use drives::drives;
pub use family::family;
pub use legs::legs;
pub use limits::limits;
pub use map::{leg_map, map};
pub use motion::motion;
pub use moves::{move_search, moves, wishes_in_words};
pub use optimize::{optimize, search, tried_drives};
pub use round::round;
pub use tolerances::tolerances;
pub use verify::verify;
