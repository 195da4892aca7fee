//! What was decided by a singular value or a residual, and by how much.

/// What a number decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Question {
    /// Dimension of the flat that base joints span.
    BaseDimension,
    /// Dimension of the flat that platform joints span.
    PlatformDimension,
    /// Rank of leg vectors.
    LegRank,
    /// Rank of `M(a)` at a generic base point of the curve or flat the family stands over.
    RankOverBase,
    /// Rank of the transposed matrix at a generic platform point of the curve or flat the family stands over.
    RankOverPlatform,
    /// Degree of the common factor of the minors of `M`.
    CommonFactor,
    /// Whether a curve contains a line: residual of the curve's equation on the line.
    LineFactor,
    /// Rank of the symmetric matrix of a conic.
    ConicRank,
    /// Whether a curve has a singular point: size of the gradient.
    SingularPoint,
}

impl Question {
    /// The name used in JSON.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::BaseDimension => "base_dimension",
            Self::PlatformDimension => "platform_dimension",
            Self::LegRank => "leg_rank",
            Self::RankOverBase => "rank_over_base",
            Self::RankOverPlatform => "rank_over_platform",
            Self::CommonFactor => "common_factor",
            Self::LineFactor => "line_factor",
            Self::ConicRank => "conic_rank",
            Self::SingularPoint => "singular_point",
        }
    }
}

/// One numerical decision with its gap.
///
/// The numbers are dimensionless: relative to the size of the body, to the largest singular value, or to the norm
/// of an equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decision {
    /// What was asked.
    pub question: Question,
    /// The answer the family was built on.
    pub value: usize,
    /// The answer with the tolerance.
    pub numerical: usize,
    /// The answer of exact arithmetic on the doubles, where it was asked.
    pub exact: Option<usize>,
    /// The smallest number that counted as different from zero.
    pub above: Option<f64>,
    /// The largest number that counted as zero.
    pub below: Option<f64>,
    /// The limit between the two.
    pub tolerance: f64,
}

impl Decision {
    /// A rank read off singular values (largest first); `value` is the numerical rank until told otherwise.
    pub(super) fn rank(question: Question, values: &[f64], scale: f64, tolerance: f64) -> Self {
        let relative: Vec<f64> = values.iter().map(|s| if scale > 0.0 { s / scale } else { 0.0 }).collect();
        let rank = relative.iter().filter(|s| **s > tolerance).count();
        Self {
            question,
            value: rank,
            numerical: rank,
            exact: None,
            above: rank.checked_sub(1).map(|k| relative[k]),
            below: relative.get(rank).copied(),
            tolerance,
        }
    }

    /// The same decision next to what exact arithmetic says.
    pub(super) fn beside(mut self, exact: Option<usize>) -> Self {
        self.exact = exact;
        self
    }

    /// The same decision taken as `value`.
    pub(super) fn taken(mut self, value: usize) -> Self {
        self.value = value;
        self
    }

    /// Whether exact arithmetic gives the answer that was used; `None` when it was not asked.
    #[must_use]
    pub fn agrees(&self) -> Option<bool> {
        self.exact.map(|e| e == self.value)
    }
}
