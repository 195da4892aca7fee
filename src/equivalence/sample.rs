//! Leg lengths to compare two platforms at: those of seeded random poses.

use nalgebra::{Rotation3, Vector3};

use crate::fk::FkSolutions;
use crate::geom::Pose;
use crate::manipulator::SquaredLegLengths;
use crate::num::Rng;

use super::matching::PoseMatching;

/// Random poses about a home pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SamplePlan {
    /// Centre of the poses.
    pub home: Pose,
    /// Half widths of the position box, design units.
    pub translation: Vector3<f64>,
    /// Half widths of the rotation-vector box, radians.
    pub rotation: Vector3<f64>,
    /// How many sets of leg lengths; with none the verdict is inconclusive unless the map alone decides.
    pub count: usize,
    /// Seed; pose `k` depends on the seed and `k` only.
    pub seed: u64,
}

impl SamplePlan {
    /// Pose number `k`: `p = home + d`, `R = exp([w]x) R_home`, `d` and `w` uniform in their boxes.
    #[must_use]
    pub fn pose(&self, k: usize) -> Pose {
        let mut rng = Rng::stream(self.seed, k as u64);
        let mut draw = |half: &Vector3<f64>| half.map(|h| rng.uniform(-h, h));
        let (d, w) = (draw(&self.translation), draw(&self.rotation));
        Pose { rotation: Rotation3::new(w) * self.home.rotation, position: self.home.position + d }
    }
}

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
