//! What comes out.

use nalgebra::{Unit, Vector3};

use super::problem::Objective;
use super::scp::HistoryStep;
use crate::geom::Pose;
use crate::manipulator::Manipulator;
use crate::num::conic::SolverFailure;
use crate::requirements::TermKind;

/// A platform that meets the requirements.
#[derive(Debug, Clone, PartialEq)]
pub struct DimensionalSolution {
    /// The platform, legs in the order of the design.
    pub manipulator: Manipulator,
    /// Home, lifted when its height was chosen.
    pub home: Pose,
    /// Chosen axes of the base joints (base frame) and of the platform joints (platform frame).
    pub axes: [Option<[Unit<Vector3<f64>>; 6]>; 2],
    /// Names and values of the variables, axes left out.
    pub variables: Vec<(String, f64)>,
    /// The same as the search sees them, axes included; a start for another search.
    pub point: Vec<f64>,
    /// Offsets in cyclic order, when they were chosen.
    pub offsets: Option<[f64; 6]>,
    /// Value of each objective over the held poses, in its own unit.
    pub objectives: Vec<(Objective, f64)>,
    /// First-order gain still promised for a unit of the variables; near 0 at a local optimum.
    pub stationarity: f64,
    /// Poses at which the requirements were held in the end, home lifted.
    pub poses: Vec<Pose>,
    /// Steps of the run that found it.
    pub history: Vec<HistoryStep>,
}

/// A constraint of a conflict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Demand {
    /// All requirements of this kind.
    Requirement(TermKind),
    /// `|det A|` at least the given value.
    Determinant,
    /// Joints that slide on families within 2.5 reaches of their body.
    Reach,
    /// An objective at least (a cost: at most) a given value.
    Level(Objective),
}

/// A constraint that takes part in a conflict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Give {
    /// Which.
    pub demand: Demand,
    /// By how much it would have to give for the others of the conflict to be met, in its own unit; `None` when even that was not found.
    pub alone: Option<f64>,
    /// Its violation where the sum of all violations (each in its scale) is least; 0 where it holds there because others give.
    pub together: f64,
}

/// Why nothing was found: an irreducible set of constraints that no start could meet together.
#[derive(Debug, Clone, PartialEq)]
pub struct Conflict {
    /// Without any one of them the others were met.
    pub demands: Vec<Give>,
    /// Whether the set is proved to be in conflict: the constraints are convex and a checked certificate separates them.
    pub proved: bool,
}

/// The answer.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum DimensionalOutcome {
    /// A local optimum, the best of all starts; the requirements hold at all poses that were looked at.
    Optimal(Box<DimensionalSolution>),
    /// Requirements hold, evidence of local optimality is missing.
    NotConverged(Box<DimensionalSolution>),
    /// From every start the violation settled above zero.
    Infeasible(Conflict),
    /// Neither.
    Undecided(Option<SolverFailure>),
}

/// Everything the search found.
#[derive(Debug, Clone, PartialEq)]
pub struct DimensionalReport {
    /// The answer.
    pub outcome: DimensionalOutcome,
    /// Starts that were climbed from.
    pub starts: usize,
    /// Starts that led to a feasible point in the first pass.
    pub feasible: usize,
    /// Weighted gains of the polished runs, best first; `None` when infeasible.
    pub polished: Vec<Option<f64>>,
    /// Seed of the populations.
    pub seed: u64,
    /// Whether the search was told to end; the answer is then the best until then.
    pub interrupted: bool,
}

impl DimensionalReport {
    /// The solution, when there is one.
    #[must_use]
    pub fn solution(&self) -> Option<&DimensionalSolution> {
        match &self.outcome {
            DimensionalOutcome::Optimal(s) | DimensionalOutcome::NotConverged(s) => Some(s),
            DimensionalOutcome::Infeasible(_) | DimensionalOutcome::Undecided(_) => None,
        }
    }
}
