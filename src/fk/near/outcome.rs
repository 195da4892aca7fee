//! The outcome of following a pose.

use thiserror::Error;

use platform::geom::Pose;

/// Numbers that go with every outcome.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NearEvidence {
    /// Largest error of the leg equations at the pose, over the squared size of the design.
    pub residual: f64,
    /// `6 / (|J|_F |J^-1|_F)` at the pose: 1 at best, 0 at a singularity. `J` is the matrix of unnormalised leg lines
    /// ([`plucker_matrix`](platform::manipulator::plucker_matrix)) with the RMS radius of the platform as
    /// characteristic length. The ratio is cheaper than the inverse condition number of the same matrix, and never
    /// below it.
    pub frobenius_ratio: f64,
    /// Segments the straight line of squared lengths was divided into; 1: the start lies in the Kantorovich ball.
    pub segments: u32,
    /// Newton steps in all.
    pub newton_steps: u32,
    /// Largest Kantorovich number `4 (beta + eta) eta` of the segments; below 1 each is free of singularities.
    pub kantorovich: f64,
    /// Distance that the platform's centroid moved, design units.
    pub distance: f64,
    /// Angle the platform turned by, radians in `[0, pi]`.
    pub angle: f64,
}

impl NearEvidence {
    pub(super) fn accept(&mut self, number: f64) {
        self.segments += 1;
        self.kantorovich = self.kantorovich.max(number);
    }
}

/// Why a pose was lost although no singularity is near.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum WhyLost {
    /// The start has an entry that is not finite, or its matrix is not a rotation (by more than `1e-6`).
    #[error("the start is not a pose: its matrix is not a rotation, or a number is not finite")]
    StartIsNoPose,
    /// [`NearOptions::segments`](super::NearOptions::segments) were not enough.
    #[error("the lengths are too far from those of the start for the number of segments allowed")]
    SegmentsExhausted,
    /// A crank would turn further than a step allows, which `machine::rotary::RotaryTracker` says.
    #[error("the angles are too far from those of the start: a step turns a crank by at most 79 turns")]
    AnglesTooFar,
    /// Newton's method did not end in the ball in which it must; rounding is the only cause known.
    #[error("Newton's method did not converge to the accuracy that the proof needs")]
    NoConvergence,
}

/// The outcome of [`NearSolver::solve`](super::NearSolver::solve).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NearOutcome {
    /// The pose for the lengths asked for, joined to the start by a path free of singularities.
    Tracked {
        /// The pose.
        pose: Pose,
        /// Its evidence.
        evidence: NearEvidence,
    },
    /// A singularity lies on the path or at its end.
    NearSingularity {
        /// The last pose before it; its own leg lengths lie on the path.
        pose: Pose,
        /// Part of the straight line of squared lengths that was covered, from 0 to 1.
        fraction: f64,
        /// Evidence at that pose.
        evidence: NearEvidence,
    },
    /// Given up.
    Lost {
        /// The last pose reached.
        pose: Pose,
        /// Why.
        reason: WhyLost,
        /// Part of the straight line of squared lengths that was covered, from 0 to 1.
        fraction: f64,
        /// Evidence at that pose (all zero when the start is not a pose).
        evidence: NearEvidence,
    },
}

num::answer_words! {
    /// Outcome of following a pose.
    pub enum NearWord as name of NearOutcome {
        /// The pose for the lengths asked for.
        Tracked = "tracked",
        /// A singularity lies on the path or at its end.
        NearSingularity = "near_singularity",
        /// Given up.
        Lost = "lost",
    }
}

impl NearOutcome {
    /// The pose for the lengths asked for, when it was reached.
    #[must_use]
    pub fn tracked(&self) -> Option<&Pose> {
        match self {
            Self::Tracked { pose, .. } => Some(pose),
            Self::NearSingularity { .. } | Self::Lost { .. } => None,
        }
    }

    /// The pose reached, whatever the outcome.
    #[must_use]
    pub fn pose(&self) -> &Pose {
        match self {
            Self::Tracked { pose, .. } | Self::NearSingularity { pose, .. } | Self::Lost { pose, .. } => pose,
        }
    }

    /// The evidence.
    #[must_use]
    pub fn evidence(&self) -> &NearEvidence {
        match self {
            Self::Tracked { evidence, .. }
            | Self::NearSingularity { evidence, .. }
            | Self::Lost { evidence, .. } => evidence,
        }
    }

    /// The name used in JSON.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.word().name()
    }
}
