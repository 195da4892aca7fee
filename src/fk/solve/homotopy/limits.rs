//! Limits of the path trackers, all in one place; dimensionless, since solutions are kept at norm one.

use super::paths::SETTLED;

/// Limits of one predictor-corrector step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepLimits {
    /// Size of the last Taylor term aimed at: an estimate of the predictor's error.
    pub truncation: f64,
    /// Largest step as a fraction of the estimated radius of convergence.
    pub(crate) radius_fraction: f64,
    /// A first Newton correction larger than this rejects the step.
    pub(crate) first_correction: f64,
    /// A Newton correction below this ends the corrector.
    pub accuracy: f64,
}

/// Limits of the [tracker](super::tracker) that converges at every step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TrackerLimits {
    /// Limits of a step.
    pub step: StepLimits,
    /// Most Newton corrections a step.
    pub corrections: u32,
    /// Most steps (accepted and rejected) a path.
    pub(crate) most_steps: u32,
}

/// Limits of the [fast tracker](super::fast_tracker).
#[derive(Debug, Clone, Copy)]
pub(super) struct FastTrackerLimits {
    /// Limits of a step; a correction below `accuracy` lets the path go on.
    pub(super) step: StepLimits,
    /// Largest ratio of the next correction to this one, estimated from the curvature of the path.
    pub(super) contraction: f64,
    /// Most iterations of a path.
    pub(super) most_iterations: u32,
    /// Below this `|t|` relative to the corner a path is left to the endgame.
    pub(super) endgame_at: f64,
    /// Below this relative `|t|` a path whose `|e|^2` is less than `small_rotation` is left to the endgame, too. The
    /// condition of the equations grows with `|e|^-2`.
    pub(super) infinity_at: f64,
    /// See `infinity_at`.
    pub(super) small_rotation: f64,
    /// A Newton correction at the target below this, or expected to be, needs no further polishing.
    pub(super) settled: f64,
}

/// Factor on the next step after a rejection.
pub(super) const STEP_REDUCTION: f64 = 0.35;
/// Factor on the next step after an accepted one, up to the step that the predictor proposes.
pub(super) const STEP_GROWTH: f64 = 2.0;
/// Newton corrections that do not shrink by this factor do not converge to the path.
pub(super) const CORRECTION_RATIO: f64 = 0.3;

/// Limits for generic problems: the first attempt at every path, checked at the end.
pub(super) const FAST: FastTrackerLimits = FastTrackerLimits {
    step: StepLimits { truncation: 3e-3, radius_fraction: 0.8, first_correction: 8e-2, accuracy: 1e-2 },
    contraction: 0.02,
    most_iterations: 200,
    endgame_at: 1e-4,
    infinity_at: 3e-2,
    small_rotation: 1e-5,
    settled: SETTLED,
};

/// For paths in the lengths alone: they have no end but a regular one at the target. Steps are as long as the next
/// correction can bear, and the certificate begins with a Newton step of its own.
pub(super) const LENGTHS: FastTrackerLimits = FastTrackerLimits {
    step: StepLimits { truncation: 8e-3, accuracy: 2e-2, ..FAST.step },
    contraction: 0.05,
    endgame_at: f64::MIN_POSITIVE,
    infinity_at: 0.0,
    settled: 1e-9,
    ..FAST
};

/// Limits for paths that the fast tracker left without an end.
pub(super) const BRISK: TrackerLimits = TrackerLimits {
    step: StepLimits { truncation: 1e-2, radius_fraction: 0.8, first_correction: 5e-2, accuracy: 1e-5 },
    corrections: 3,
    most_steps: 400,
};

/// Limits for paths that these could not finish, and for making start systems.
pub(super) const CAREFUL: TrackerLimits = TrackerLimits {
    step: StepLimits { truncation: 2e-5, radius_fraction: 0.4, first_correction: 1e-3, accuracy: 1e-9 },
    corrections: 3,
    most_steps: 4000,
};

/// The last resort for paths that jump or get lost.
pub(super) const VERY_CAREFUL: TrackerLimits = TrackerLimits {
    step: StepLimits { truncation: 1e-7, radius_fraction: 0.15, first_correction: 1e-5, accuracy: 1e-10 },
    corrections: 4,
    most_steps: 20_000,
};

/// Limits for the short arcs of the endgame.
pub(super) const ARC: TrackerLimits = TrackerLimits {
    // at ends with e -> 0 the Newton matrix loses two ranks and rounding stops corrections near 1e-8
    step: StepLimits { truncation: 1e-4, radius_fraction: 0.5, first_correction: 1e-2, accuracy: 1e-7 },
    corrections: 4,
    most_steps: 40,
};
