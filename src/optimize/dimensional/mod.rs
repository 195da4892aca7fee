//! Dimensional synthesis: chooses the dimensions of a platform that meets all its requirements, with the best
//! objectives found.
//!
//! Variables are offsets, triangles, the height of home and joint axes. Requirements are those of
//! [`machine::requirements`], in formulas of this module with derivatives. The method is sequential convex programming
//! from many starts, over poses that are added where the requirements have the least margin. Definitions, method and
//! limits: `docs/theory/dimensional-synthesis.md`.

mod conflict;
mod leg_gaps;
mod leg_lines;
mod linear;
mod merit;
mod model;
mod outcome;
mod pareto;
mod plates;
mod population;
mod problem;
mod pull;
mod search;
mod shape;
mod skeleton;
mod stiffness;
mod terms;
#[cfg(test)]
mod tests;
mod worst_pose;

pub use self::outcome::evaluate;
pub use crate::climb::HistoryStep;
pub use outcome::{
    ChosenVariable, ConstraintConflict, Demand, DimensionalOutcome, DimensionalReport, DimensionalSolution,
    Give,
};
pub use pareto::{ParetoPoint, ParetoReport, pareto};
pub use problem::{DimensionalProblem, InvalidProblem, Mode, Triangles, Variables};
pub use search::{Progress, ShapeSearchOptions, Stage, optimize};
pub use search::{meet, optimize_without_conflict, why_not};
