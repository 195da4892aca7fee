//! The task of a climb, and its values at a point.

use std::collections::BTreeMap;

use machine::requirements::TermKind;

/// Constraints with a common slack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ConstraintGroup {
    /// Requirements of one kind.
    Term(TermKind),
    /// `|det A|`.
    Determinant,
    /// Distance of joints on families from the others.
    Reach,
    /// A lower bound of an objective.
    Floor(usize),
}

/// The task of one run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Task {
    /// Weight of each objective; 0 leaves it out.
    pub weights: Vec<f64>,
    /// Least gain of each objective.
    pub(crate) floors: Vec<Option<f64>>,
    /// Constraints that are ignored.
    pub dropped: Vec<ConstraintGroup>,
    /// Constraints whose violation has a hundredth of the penalty.
    pub soft: Option<ConstraintGroup>,
}

impl Task {
    /// Relative penalty of a violation.
    pub(crate) fn cost(&self, group: ConstraintGroup) -> f64 {
        if self.soft == Some(group) { 0.01 } else { 1.0 }
    }
}

/// Values at a point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PointValues {
    /// Gain of each objective.
    pub gains: Vec<f64>,
    /// Largest violation of each group (0 when met).
    pub violations: BTreeMap<ConstraintGroup, f64>,
}

impl PointValues {
    pub(crate) fn violation(&self) -> f64 {
        self.violations.values().fold(0.0, |m, v| m.max(*v))
    }

    /// Sum of the largest violations of the groups; soft ones count a hundredth.
    pub(crate) fn total_violation(&self, task: &Task) -> f64 {
        self.violations.iter().map(|(g, v)| task.cost(*g) * v).sum()
    }

    pub(crate) fn gain(&self, task: &Task) -> f64 {
        task.weights.iter().zip(&self.gains).filter(|(w, _)| **w > 0.0).map(|(w, g)| w * g).sum()
    }

    /// Records the value of a constraint, which must be at least `spare`.
    pub(crate) fn hold(&mut self, group: ConstraintGroup, value: f64, spare: f64) {
        let worst = self.violations.entry(group).or_insert(0.0);
        let miss = spare - value;
        *worst = if miss.is_nan() { f64::INFINITY } else { worst.max(miss) };
    }
}
