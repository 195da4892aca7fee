//! Proved bounds of margins.

use crate::requirements::assess::Margin;

num::answer_words! {
    /// The proved state of the least margin of a kind of requirement over all poses.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum MarginVerdict as name | label, Display {
        /// Proved: no margin is negative.
        Met = "met" | "met",
        /// Proved: no margin is negative by more than the rounding of its evaluation
        /// ([`Terms::rounding`](crate::requirements::Terms::rounding)).
        AtLimit = "at_limit" | "at limit",
        /// Proved: the margin is negative at the pose given, by more than that.
        Violated = "violated" | "violated",
        /// Unproved: no violation was found.
        Searched = "searched" | "not proved",
    }
}

impl MarginVerdict {
    /// `Some` if it is proved.
    #[must_use]
    pub fn is_met(self) -> Option<bool> {
        match self {
            Self::Met | Self::AtLimit => Some(true),
            Self::Violated => Some(false),
            Self::Searched => None,
        }
    }
}

/// The least margin of a kind with its proved bound.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MarginBound {
    /// The least margin found.
    pub found: Margin,
    /// Proved: no pose of the workspace has a smaller margin; minus infinity without a proof.
    pub below: f64,
    /// The verdict.
    pub verdict: MarginVerdict,
    /// Cells bounded.
    pub cells: usize,
    /// The safety margin on this limit and its state; `None` if the design requires none.
    pub safety_margin: Option<SafetyMarginBound>,
}

/// A safety margin, and whether the margin keeps it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafetyMarginBound {
    /// The required safety margin, in the unit of the margin.
    pub safety_margin: f64,
    /// Proved either way, or `None`.
    pub kept: Option<bool>,
}

impl MarginBound {
    /// Whether both the margin and its safety margin are decided.
    pub(super) fn is_decided(&self) -> bool {
        self.verdict.is_met().is_some() && self.keeps_safety_margin().is_some()
    }

    /// Whether the safety margin is kept; `Some(true)` without a safety margin.
    #[must_use]
    pub fn keeps_safety_margin(&self) -> Option<bool> {
        self.safety_margin.map_or(Some(true), |r| r.kept)
    }
}

/// The least margins of all kinds with their proved bounds.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct MarginProof {
    /// By kind.
    pub bounds: Vec<MarginBound>,
    /// Number of poses evaluated by sampling and searches.
    pub poses: usize,
}

impl MarginProof {
    /// `Some(false)` when a requirement is violated, `Some(true)` when all are proved to be met.
    #[must_use]
    pub fn all_met(&self) -> Option<bool> {
        let each = || self.bounds.iter().map(|b| b.verdict.is_met());
        if each().any(|x| x == Some(false)) {
            return Some(false);
        }
        each().all(|x| x == Some(true)).then_some(true)
    }

    /// The same decision for the safety margins.
    #[must_use]
    pub fn all_keep_safety_margin(&self) -> Option<bool> {
        let each = || self.bounds.iter().map(MarginBound::keeps_safety_margin);
        if each().any(|x| x == Some(false)) {
            return Some(false);
        }
        each().all(|x| x == Some(true)).then_some(true)
    }
}

pub(super) fn verdict(below: f64, upper: f64, rounding: f64) -> MarginVerdict {
    if upper < -rounding {
        MarginVerdict::Violated
    } else if below >= 0.0 {
        MarginVerdict::Met
    } else if below >= -rounding {
        MarginVerdict::AtLimit
    } else {
        MarginVerdict::Searched
    }
}
