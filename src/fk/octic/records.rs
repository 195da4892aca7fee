//! Sixteen certified poses as records, without the general collection: they are proved distinct, so that nothing is merged or rejected.

use super::{OcticPoses, OcticSolver};
use crate::fk::collect::sort_key;
use crate::fk::evidence::proved as proved_reality;
use crate::fk::{Completeness, FkRoot, FkSolutions, Method, SolutionSet, Theorem};
use crate::num::batch::LANES;
use crate::solve::certify::RootCertificate;
use crate::solve::certify::octahedral::OctahedralCertificates;

/// The answer for poses all of which are certified and distinct.
pub(super) fn proved(
    solver: &OcticSolver,
    found: &OcticPoses,
    certificates: &OctahedralCertificates,
    seed: u64,
) -> FkSolutions {
    let size = solver.manipulator().size();
    let mut roots: Vec<FkRoot> = Vec::with_capacity(2 * LANES);
    let pairs = certificates.pairs.iter().flatten();
    for ((pair, poses), residuals) in pairs.zip(found.poses.chunks(2)).zip(found.residuals.chunks(2)) {
        roots.extend(poses.iter().zip(residuals).enumerate().map(|(image, (pose, residual))| FkRoot {
            pose: *pose,
            reality: proved_reality(pair.reality),
            certificate: solver.certificate(pair, pose, image == 1).map(RootCertificate::Octahedral),
            multiplicity: 1,
            residual: *residual,
            condition: pair.condition,
            dual_quaternion: None,
        }));
    }
    roots.sort_by_cached_key(|root| sort_key(root, size));
    FkSolutions {
        method: Method::Octic,
        roots,
        solution_set: SolutionSet::Isolated,
        completeness: Completeness::Proved { theorem: Theorem::Octahedral },
        paths: Vec::new(),
        rejected: Vec::new(),
        pose_count: None,
        unproved: Vec::new(),
        seed,
    }
}
