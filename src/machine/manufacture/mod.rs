//! Manufacture of a design: tolerances of the joints, the correction in a controller, and joints on a grid of holes.
//!
//! * [`budget()`] and [`trials()`]: allowed joint errors that keep the pose of the nominal formula within a bound, to
//!   first order and by random errors.
//! * [`error_map()`]: the error of the pose by joints, leg lengths and temperature together, over the workspace.
//! * [`MachineUncertainty`]: the uncertainty of poses of a calibrated machine.
//! * [`Controller`]: the octahedral formula and Newton steps on calibrated joints.
//! * [`round_to_grid`]: joints on a grid, exactly equivalent to an octahedral platform or as near to it as the grid
//!   allows.
//!
//! Theory: `docs/theory/manufacture.md`.

mod budget;
mod correction;
mod error_map;
mod gauge;
mod joint;
mod product;
mod rounding;
mod sample;
mod sensitivity;
#[cfg(test)]
mod tests;
mod trials;
mod uncertainty;

pub use budget::{Budget, JointBudget, LimitedAllowance, budget, joint_allowance};
pub use correction::{Controller, NoFormula, equivalent_octahedral, octahedral_of};
pub use error_map::{ErrorAtPose, ErrorParts, MachineErrors, error_map, errors_at};
pub use joint::{Joint, displaced, joints};
pub use rounding::holes_turn;
pub use rounding::{
    Evaluation, ExactRounding, LeastMargin, NearestRounding, NoRounding, NoRoundingWord, RoundedJoint,
    Rounding, RoundingProblem, round_to_grid,
};
pub use sample::{ErrorBound, ErrorKind, PoseSearch, ToleranceError};
pub use sensitivity::Sensitivity;
pub use trials::{ErrorSpread, JointErrors, Quantiles, Trials, solved_error, trials};
pub use uncertainty::{MachineUncertainty, PoseCovariance};
