//! The common part of the two published eliminations: candidates of several attempts, refined, merged and certified.

use super::collect::{PoseCandidate, collect};
use super::evidence::{certify, conclude, reject_others};
use super::{
    Completeness, FkError, FkOptions, FkSolutions, Method, Reason, Rejected, RejectionReason, SolutionSet,
    Theorem,
};
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Candidates so far; `None` where an eigenvector or root gives no finite pose.
#[derive(Debug, Clone, Default)]
pub(super) struct PoseCandidates {
    poses: Vec<PoseCandidate>,
    infinite: usize,
    attempts: usize,
}

impl PoseCandidates {
    /// Adds everything one elimination gave.
    pub(super) fn add(&mut self, found: impl IntoIterator<Item = Option<ComplexPose>>) {
        self.attempts += 1;
        for pose in found {
            match pose {
                Some(pose) => {
                    let source = self.poses.len() + self.infinite;
                    self.poses.push(PoseCandidate { pose, singular: false, condition: 1.0, source });
                }
                None => self.infinite += 1,
            }
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.attempts == 0
    }

    /// Refines and certifies every candidate; candidates without a certificate are rejected. The answer is complete
    /// when 40 distinct poses are certified.
    pub(super) fn solutions(
        &self,
        method: Method,
        m: &Manipulator,
        s: &SquaredLegLengths,
        o: &FkOptions,
    ) -> Result<FkSolutions, FkError> {
        let collected = collect(m, s, &o.tolerances, &self.poses);
        let mut rejected = collected.rejected;
        let at_infinity = Rejected { reason: RejectionReason::NotFinite, residual: f64::INFINITY };
        rejected.extend(std::iter::repeat_n(at_infinity, self.infinite));
        let mut solutions = FkSolutions {
            method,
            roots: collected.roots,
            solution_set: SolutionSet::Isolated,
            completeness: Completeness::unproved([]),
            paths: Vec::new(),
            rejected,
            pose_count: None,
            library_calls: Vec::new(),
            unproved: Vec::new(),
            seed: o.seed,
        };
        let certificates = certify(&mut solutions, m, s, Vec::new()).unwrap_or_default();
        // Rounding in the frames makes every problem a general one with 40 roots near by. The additional roots of a
        // special platform lie far out or near e.e = 0 and may pass for roots by their residual.
        let refined = solutions.roots.len();
        reject_others(&mut solutions);
        let certified = solutions.roots.len();
        solutions.completeness.doubt(Reason::CandidatesEliminated {
            candidates: self.poses.len() + self.infinite,
            eliminations: self.attempts,
            certified,
            uncertified: refined - certified,
        });
        conclude(&mut solutions, m, &certificates, Theorem::SixLegs)?;
        Ok(solutions)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FkTolerances;
    use nalgebra::{Point3, Rotation3, Vector3};
    use num::Rng;
    use platform::geom::Pose;
    use platform::manipulator::Leg;

    /// Certification finds that candidates repeat a root; the counts of the elimination are told beside that, not in
    /// its place.
    #[test]
    fn what_certification_found_doubtful_is_still_told_after_the_counts_of_the_elimination() {
        let mut rng = Rng::new(17);
        let mut point =
            || Point3::new(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
        let m = Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() }))
            .unwrap();
        let pose = Pose {
            rotation: Rotation3::from_euler_angles(0.2, -0.4, 0.9),
            position: Vector3::new(0.3, 0.1, 1.9),
        };
        let s = pose.squared_lengths(&m).unwrap();
        let mut moved = pose;
        moved.position.x += 2e-16;
        let mut candidates = PoseCandidates::default();
        candidates.add([pose, moved].map(|p| Some(ComplexPose::from(p))));
        // with no tolerance at all only certificates tell that the two are one
        let tolerances = FkTolerances { distinct: 0.0, ..FkTolerances::default() };
        let o = FkOptions { tolerances, ..FkOptions::default() };
        let found = candidates.solutions(Method::Template, &m, &s, &o).unwrap();
        assert_eq!((found.roots.len(), found.rejected.len()), (1, 1));
        let said = found.completeness.to_string();
        assert!(said.contains("2 candidates of 1 elimination(s) gave 1 certified poses"), "{said}");
        assert!(said.contains("1 candidates are roots found already"), "{said}");
    }
}
