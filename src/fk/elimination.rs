//! What the two published eliminations share: candidates of several attempts, refined, merged and certified.

use super::collect::{Candidate, collect};
use super::evidence::{GENERAL, attach};
use super::{Completeness, FkOptions, FkRoot, FkSolutions, Method, Rejected, RejectionReason, SolutionSet};
use crate::geom::ComplexPose;
use crate::manipulator::{Manipulator, SquaredLegLengths};

/// Candidates so far; `None` where an eigenvector or root gives no finite pose.
#[derive(Debug, Clone, Default)]
pub(super) struct Candidates {
    poses: Vec<Candidate>,
    infinite: usize,
    attempts: usize,
}

impl Candidates {
    /// Adds everything one elimination gave.
    pub(super) fn add(&mut self, found: impl IntoIterator<Item = Option<ComplexPose>>) {
        self.attempts += 1;
        for pose in found {
            match pose {
                Some(pose) => {
                    let source = self.poses.len() + self.infinite;
                    self.poses.push(Candidate { pose, singular: false, condition: 1.0, source });
                }
                None => self.infinite += 1,
            }
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.attempts == 0
    }

    /// Refines and certifies every candidate; what is not certified is rejected. Complete when 40 distinct poses are certified.
    pub(super) fn solutions(
        &self,
        method: Method,
        m: &Manipulator,
        s: &SquaredLegLengths,
        o: &FkOptions,
    ) -> FkSolutions {
        let collected = collect(m, s, &o.tolerances, &self.poses);
        let mut rejected = collected.rejected;
        let at_infinity = Rejected { reason: RejectionReason::NotFinite, residual: f64::INFINITY };
        rejected.extend(std::iter::repeat_n(at_infinity, self.infinite));
        let mut solutions = FkSolutions {
            method,
            roots: collected.roots,
            solution_set: SolutionSet::Isolated,
            completeness: Completeness::Unproved { reason: String::new(), all_paths_accounted: false },
            paths: Vec::new(),
            rejected,
            pose_count: None,
            unproved: Vec::new(),
            seed: o.seed,
        };
        attach(&mut solutions, m, s, GENERAL, Vec::new());
        // rounding in the frames makes every problem a general one with 40 roots near by; on a special platform
        // those that are none of its own lie far out or near e.e = 0 and may pass for roots by their residual
        let (certified, others): (Vec<_>, Vec<_>) = solutions.roots.into_iter().partition(FkRoot::certified);
        let unproved =
            others.iter().map(|r| Rejected { reason: RejectionReason::NotCertified, residual: r.residual });
        solutions.rejected.extend(unproved);
        solutions.roots = certified;
        if let Completeness::Unproved { reason, .. } = &mut solutions.completeness {
            *reason = format!(
                "{} candidates of {} elimination(s) gave {} certified poses and {} that could not be certified; a \
                 general platform has 40, so that roots may be missing or the platform is a special one",
                self.poses.len() + self.infinite,
                self.attempts,
                solutions.roots.len(),
                others.len(),
            );
        }
        solutions
    }
}
