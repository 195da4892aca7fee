//! One comparison of two platforms, at the leg lengths of one pose.

use fk::FkSolutions;
use platform::geom::Pose;
use platform::manipulator::SquaredLegLengths;

use super::matching::PoseMatching;

/// One comparison: the lengths, what forward kinematics of each platform found, how the poses match.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// The pose the lengths come from.
    pub pose: Pose,
    /// Squared leg lengths of A at the pose.
    pub squares_a: SquaredLegLengths,
    /// Squared leg lengths of B: `A s + c` when there is a map, else inverse kinematics of B at the pose.
    pub squares_b: SquaredLegLengths,
    /// Poses of A.
    pub solutions_a: FkSolutions,
    /// Poses of B.
    pub solutions_b: FkSolutions,
    /// Their matching; poses without partner that joints in double precision do not determine are set aside.
    pub matching: PoseMatching,
}

impl Sample {
    /// Nothing failed in either solution, so that the sets can be compared.
    #[must_use]
    pub fn is_conclusive(&self) -> bool {
        self.solutions_a.all_accounted() && self.solutions_b.all_accounted()
    }

    /// Conclusive and matched one to one, poses that were set aside left out.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.is_conclusive() && self.matching.is_perfect() && !self.matching.pairs.is_empty()
    }
}
