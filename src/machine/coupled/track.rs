//! The pose for given lengths of drives, near a known one.
//!
//! The distances of the joints are the requested lengths minus the correction at the last pose. [`NearSolver`] follows
//! the pose for them, and its correction gives the next distances. This is the fixed-point iteration
//! `rho -> c - corr(pose(rho))`, which contracts by the derivative of the correction times the inverse Jacobian of the
//! distances.

use super::proof::PoseBound;
use super::{CoupledLegs, DriveState, NoDriveLength};
use fk::{NearOutcome, NearSolver};
use platform::geom::Pose;
use platform::manipulator::LegLengths;

/// Most steps of the fixed point.
const STEPS: u32 = 200;

/// Steps in which the change has to become smaller at least once.
const PATIENCE: u32 = 8;

/// The result of the tracking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CoupledStatus {
    /// The pose is proved within the bound: exactly one pose of a neighbourhood has these drive lengths.
    Proved(PoseBound),
    /// The iteration reached its fixed point, but no error bound is proved.
    Unproved,
    /// The corrections did not converge: no pose is given.
    NotContracting,
    /// The solver could not follow the pose for the distances.
    NotTracked,
    /// A drive has no length at a pose on the way.
    NoLength(NoDriveLength),
}

impl CoupledStatus {
    /// `true` where the pose reached has the lengths asked for.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        matches!(self, Self::Proved(_) | Self::Unproved)
    }

    /// Why there is no pose.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        match self {
            Self::Proved(_) | Self::Unproved => None,
            Self::NotContracting => {
                Some("the corrections of the joints do not settle: no contraction".into())
            }
            Self::NotTracked => {
                Some("the pose of the distances of the joints was not followed to its end".into())
            }
            Self::NoLength(why) => Some(why.to_string()),
        }
    }

    /// The proved bound of the pose.
    #[must_use]
    pub fn bound(&self) -> Option<PoseBound> {
        match self {
            Self::Proved(bound) => Some(*bound),
            _ => None,
        }
    }
}

num::answer_words! {
    /// The status of the pose for drive lengths.
    pub enum DriveSolutionWord as name of CoupledStatus {
        /// There is exactly one pose with these lengths in a neighbourhood, within the bound.
        Proved = "proved",
        /// The corrections converged, and no bound is proved.
        Unproved = "unproved",
        /// The corrections did not converge.
        NotContracting = "not_contracting",
        /// The solver could not follow the pose for the distances.
        NotTracked = "not_tracked",
        /// A drive has no length at a pose on the way.
        NoLength = "no_length",
    }
}

/// The pose for lengths of drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledOutcome {
    /// Result of the last solver run; its pose is the last one.
    pub near: NearOutcome,
    /// Status of the pose.
    pub status: CoupledStatus,
    /// Distances of the joints that the last pose was followed to.
    pub distances: [f64; 6],
    /// Steps of the fixed point.
    pub steps: u32,
    /// The largest ratio of changes of the corrections in two successive steps above rounding; 0 without such steps.
    pub factor: f64,
}

impl CoupledOutcome {
    /// The pose, where the corrections converged.
    #[must_use]
    pub fn pose(&self) -> Option<&Pose> {
        self.near.tracked().filter(|_| self.status.is_reached())
    }
}

/// Follows a pose of a machine whose joints are not ideal.
#[derive(Debug, Clone)]
pub struct CoupledTracker {
    legs: CoupledLegs,
    solver: NearSolver,
    pose: Pose,
}

fn corrections(states: &[DriveState; 6]) -> [f64; 6] {
    states.map(|s| s.correction)
}

impl CoupledTracker {
    /// Begins at a pose.
    #[must_use]
    pub fn new(legs: CoupledLegs, pose: Pose) -> Self {
        Self { solver: NearSolver::new(legs.manipulator()), legs, pose }
    }

    /// The current pose of the platform.
    #[must_use]
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Moves to other drive lengths; the tracker keeps its pose if no new one is found.
    pub fn step(&mut self, drives: &[f64; 6]) -> CoupledOutcome {
        let found = self.find(drives);
        if let Some(pose) = found.pose() {
            self.pose = *pose;
        }
        found
    }

    /// The pose for lengths of drives near that of the tracker.
    #[must_use]
    pub fn find(&self, drives: &[f64; 6]) -> CoupledOutcome {
        let stay = NearOutcome::Lost {
            pose: self.pose,
            reason: fk::WhyLost::NoConvergence,
            fraction: 0.0,
            evidence: fk::NearEvidence::default(),
        };
        let mut out = CoupledOutcome {
            near: stay,
            status: CoupledStatus::NotContracting,
            distances: *drives,
            steps: 0,
            factor: 0.0,
        };
        let size = self.legs.manipulator().size();
        let mut from = self.pose;
        let mut states = match self.legs.states(&from) {
            Ok(states) => states,
            Err(why) => return CoupledOutcome { status: CoupledStatus::NoLength(why), ..out },
        };
        let (mut last, mut least, mut since) = (f64::INFINITY, f64::INFINITY, 0);
        while out.steps < STEPS {
            let before = corrections(&states);
            out.distances = std::array::from_fn(|i| drives[i] - before[i]);
            let Ok(lengths) = LegLengths::try_new(out.distances) else {
                return CoupledOutcome { status: CoupledStatus::NotTracked, ..out };
            };
            out.near = self.solver.solve(&lengths.squared(), &from);
            out.steps += 1;
            let Some(pose) = out.near.tracked() else {
                return CoupledOutcome { status: CoupledStatus::NotTracked, ..out };
            };
            from = *pose;
            states = match self.legs.states(&from) {
                Ok(states) => states,
                Err(why) => return CoupledOutcome { status: CoupledStatus::NoLength(why), ..out },
            };
            let after = corrections(&states);
            let change = (0..6).map(|i| (after[i] - before[i]).abs()).fold(0.0, f64::max);
            // rounding limit of a change
            let settled = change <= 16.0 * f64::EPSILON * size;
            if !settled {
                if last.is_finite() && out.steps > 2 {
                    out.factor = out.factor.max(change / last);
                }
                since = if change < 0.9 * least { 0 } else { since + 1 };
                (last, least) = (change, least.min(change));
                if since < PATIENCE {
                    continue;
                }
            }
            // rounding of the pose can keep corrections from converging to the last bit; growing corrections did not
            // converge
            if settled || last <= 1e-13 * size {
                let bound = self.legs.bound(&from, &states, drives);
                out.status = bound.map_or(CoupledStatus::Unproved, CoupledStatus::Proved);
            }
            return out;
        }
        out
    }
}
