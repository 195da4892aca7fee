//! One comparison of two platforms, at the leg lengths of one pose.

use fk::FkSolutions;
use platform::geom::Pose;
use platform::manipulator::SquaredLegLengths;

use super::matching::PoseMatching;

/// One comparison: the lengths, the poses of each platform by forward kinematics, and their matching.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// The source pose of the lengths.
    pub pose: Pose,
    /// Squared leg lengths of A at the pose.
    pub squares_a: SquaredLegLengths,
    /// Squared leg lengths of B: `A s + c` if there is a map, otherwise inverse kinematics of B at the pose.
    pub squares_b: SquaredLegLengths,
    /// Poses of A.
    pub solutions_a: FkSolutions,
    /// Poses of B.
    pub solutions_b: FkSolutions,
    /// Their matching; poses without partner that joints in double precision do not determine are excluded.
    pub matching: PoseMatching,
}

impl Sample {
    /// Whether no part of either solution failed, so that the sets can be compared.
    #[must_use]
    pub fn is_conclusive(&self) -> bool {
        self.solutions_a.all_accounted() && self.solutions_b.all_accounted()
    }

    /// Whether the sample is conclusive and matched one to one, without the excluded poses.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.is_conclusive() && self.matching.is_perfect() && !self.matching.pairs.is_empty()
    }
}
