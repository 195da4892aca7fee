//! Sixteen certified poses as records, without the general collection: they are proved distinct, so that nothing is
//! merged or rejected.

use super::{OcticPoses, OcticSolver};
use crate::collect::sort_key;
use crate::evidence::proved as proved_reality;
use crate::solve::certify::octahedral::{OctahedralCertificates, PairCertificate};
use crate::solve::certify::{
    Certificate, CertifiedPose, Certifier, Distinctness, NewtonStart, RootCertificate, distinct,
};
use crate::{Completeness, FkRoot, FkSolutions, Method, SolutionSet, Theorem};
use num::batch::LANES;
use platform::geom::ComplexPose;
use platform::manipulator::SquaredLegLengths;

/// The answer for poses all of which are certified and distinct.
pub(super) fn proved(
    solver: &OcticSolver,
    found: &OcticPoses,
    certificates: &OctahedralCertificates,
    seed: u64,
) -> FkSolutions {
    // records are large: sorted by their keys they are written once, where they stay
    let size = solver.manipulator().size();
    let known = certificates.pairs.iter().enumerate().filter_map(|(k, pair)| Some((k, pair.as_ref()?)));
    let mut order: Vec<_> = known
        .flat_map(|(k, pair)| [0, 1].map(|image| (k, pair, image)))
        .map(|(k, pair, image)| {
            let key = sort_key(proved_reality(pair.reality), &found.poses[2 * k + image], size);
            (key, k, pair, image)
        })
        .collect();
    order.sort_by_key(|entry| entry.0);
    let mut roots = Vec::with_capacity(order.len());
    for (_, k, pair, image) in order {
        roots.push(of_pair(solver, found, k, pair, image));
    }
    answer(roots, seed)
}

/// A root of pair `k`.
fn of_pair(
    solver: &OcticSolver,
    found: &OcticPoses,
    k: usize,
    pair: &PairCertificate,
    image: usize,
) -> FkRoot {
    let pose = found.poses[2 * k + image];
    FkRoot {
        pose,
        reality: proved_reality(pair.reality),
        certificate: solver.certificate(pair, &pose, image == 1).map(RootCertificate::Octahedral),
        multiplicity: 1,
        residual: found.residuals[2 * k + image],
        condition: pair.condition,
        dual_quaternion: None,
    }
}

/// The same where some pairs have no certificate as pairs: their poses get certificates of their own. `None` unless all
/// sixteen are certified and distinct.
pub(super) fn proved_one_by_one(
    solver: &OcticSolver,
    found: &OcticPoses,
    certificates: &OctahedralCertificates,
    s: &SquaredLegLengths,
    seed: u64,
) -> Option<FkSolutions> {
    let m = solver.manipulator();
    let certifier = Certifier::new(m, s).ok()?;
    let mut roots: Vec<FkRoot> = Vec::with_capacity(2 * LANES);
    let mut pairs: Vec<&PairCertificate> = Vec::with_capacity(LANES);
    let mut single: Vec<Certificate> = Vec::new();
    let mut unpaired: Vec<ComplexPose> = Vec::with_capacity(LANES);
    for (k, pair) in certificates.pairs.iter().enumerate() {
        if let Some(pair) = pair {
            pairs.push(pair);
            roots.extend([0, 1].map(|image| of_pair(solver, found, k, pair, image)));
        } else {
            unpaired.extend_from_slice(&found.poses[2 * k..2 * k + 2]);
        }
    }
    for batch in unpaired.chunks(LANES) {
        for (root, pose) in certifier.roots_near_poses(batch).into_iter().zip(batch) {
            let root = root.or_else(|| certifier.root_near(NewtonStart::Pose(pose)).ok());
            let CertifiedPose { pose, certificate } = root?;
            single.push(certificate);
            roots.push(FkRoot {
                pose,
                reality: proved_reality(certificate.reality()),
                certificate: Some(certificate.into()),
                multiplicity: 1,
                residual: pose.residual(m, s),
                condition: 1.0,
                dual_quaternion: Some(certificate.point()),
            });
        }
    }
    // two poses of a pair are distinct by the theorem of pairs, those of different pairs by their corners
    let pairs_apart = pairs.iter().enumerate().all(|(i, p)| pairs[..i].iter().all(|q| p.is_distinct_from(q)));
    let enclosure = |r: &FkRoot| r.certificate.map(|c| *c.enclosure());
    let by_pair = |r: &&FkRoot| matches!(r.certificate, Some(RootCertificate::Octahedral(_)));
    let apart = |c: &Certificate| {
        roots.iter().filter(by_pair).filter_map(enclosure).all(|known| known.is_disjoint(c.enclosure()))
    };
    let whole = roots.len() == 2 * LANES
        && pairs_apart
        && distinct(&single) == Distinctness::AllDistinct
        && single.iter().all(apart);
    whole.then(|| {
        let size = m.size();
        roots.sort_by_cached_key(|root| sort_key(root.reality, &root.pose, size));
        answer(roots, seed)
    })
}

/// Roots in their order.
fn answer(roots: Vec<FkRoot>, seed: u64) -> FkSolutions {
    FkSolutions {
        method: Method::Octic,
        roots,
        solution_set: SolutionSet::Isolated,
        completeness: Completeness::Proved { theorem: Theorem::Octahedral },
        paths: Vec::new(),
        rejected: Vec::new(),
        pose_count: None,
        library_calls: Vec::new(),
        unproved: Vec::new(),
        seed,
    }
}
