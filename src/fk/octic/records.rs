//! Sixteen certified poses as records, without the general collection: they are proved distinct, so that nothing is merged or rejected.

use super::{OcticPoses, OcticSolver};
use crate::fk::collect::sort_key;
use crate::fk::evidence::OCTAHEDRAL;
use crate::fk::{Completeness, FkRoot, FkSolutions, Method, Reality, SolutionSet};
use crate::manipulator::SquaredLegLengths;
use crate::poly::LANES;
use crate::solve::certify::ProvedReality;
use crate::solve::certify::octahedral::OctahedralCertificates;

/// The answer for poses all of which are certified and distinct.
pub(super) fn proved(
    solver: &OcticSolver,
    s: &SquaredLegLengths,
    found: &OcticPoses,
    certificates: &OctahedralCertificates,
    seed: u64,
) -> FkSolutions {
    let (m, size) = (solver.manipulator(), solver.manipulator().size());
    let mut roots: Vec<FkRoot> = Vec::with_capacity(2 * LANES);
    for (pair, poses) in certificates.pairs.iter().flatten().zip(found.poses.chunks(2)) {
        let reality = match pair.reality {
            ProvedReality::Real => Reality::Real,
            ProvedReality::NonReal => Reality::NonReal,
            ProvedReality::Undecided => Reality::Undecided,
        };
        roots.extend(poses.iter().map(|pose| FkRoot {
            pose: *pose,
            reality,
            certified: true,
            multiplicity: 1,
            residual: pose.residual(m, s),
            condition: pair.condition,
        }));
    }
    roots.sort_by_cached_key(|root| sort_key(root, size));
    FkSolutions {
        method: Method::Octic,
        roots,
        solution_set: SolutionSet::Isolated,
        completeness: Completeness::Proved { argument: OCTAHEDRAL.argument.to_owned() },
        paths: Vec::new(),
        rejected: Vec::new(),
        seed,
    }
}
