//! What the optimiser may choose and what is best.

use crate::dimensional::{Objective, VariableKind};

/// How several objectives are combined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Combination {
    /// The weighted sum of the gains.
    Weighted,
    /// One after the other; later levels may take this share of the gains of the earlier ones.
    Lexicographic {
        /// Share, positive.
        slack: f64,
    },
    /// Designs of which none is better in every objective.
    Pareto {
        /// Steps between the extremes of each objective but the first.
        points: usize,
    },
}

/// The keys of `[optimize]` that ask for more than the six offsets with the best worst-case conditioning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SearchTable {
    /// What may be chosen; empty: the offsets.
    pub variables: Vec<VariableKind>,
    /// Objectives with weights, or in the order of their levels; empty: the worst-case conditioning.
    pub objectives: Vec<(Objective, f64)>,
    /// How objectives are combined, weighted when absent.
    pub mode: Option<Combination>,
    /// Least and greatest offset; 0 and 1 are the ends of the edge.
    pub offset_bounds: Option<(f64, f64)>,
    /// Least and greatest change of a triangle, as a share of its size.
    pub stretch_bounds: Option<(f64, f64)>,
    /// Least and greatest change of the height of home, in sizes of the design.
    pub height_bounds: Option<(f64, f64)>,
}
