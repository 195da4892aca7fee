//! Certificates for the roots of a method, and completeness when they reach a proved bound.

use super::bounds::{class_bound, special_bound};
use super::{
    Completeness, FkError, FkRoot, FkSolutions, Reality, Reason, Rejected, RejectionReason, Theorem,
};
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::solve::certify::{
    Certificate, CertifiedPose, Certifier, ClusterCertificate, Distinctness, NewtonStart, PoseEnclosure,
    ProvedReality, RootCertificate, RootRelation, distinct, is_of, relation,
};

/// Tries to certify every root that is not yet; a certified root takes its reality from the proof. `known` are the
/// certificates of those that are; all certificates together are the result, `None` where nothing can be certified.
pub(super) fn certify(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    mut known: Vec<Certificate>,
) -> Option<Vec<Certificate>> {
    let certifier = Certifier::new(m, s).ok()?;
    let mut repeated = vec![false; solutions.roots.len()];
    let mut doubtful: Vec<&mut FkRoot> = Vec::new();
    for (root, repeated) in solutions.roots.iter_mut().zip(&mut repeated).filter(|(r, _)| !r.certified()) {
        let Ok(CertifiedPose { pose, certificate }) = certifier.root_near(NewtonStart::Pose(&root.pose))
        else {
            doubtful.push(root);
            continue;
        };
        let same = |k: &Certificate| relation(k, &certificate) == RootRelation::Same;
        if known.iter().any(same) {
            *repeated = true;
            continue;
        }
        root.pose = pose;
        root.residual = pose.residual(m, s);
        root.reality = proved(certificate.reality());
        root.certificate = Some(certificate.into());
        // a certified root is simple, however many paths came near it
        root.multiplicity = 1;
        known.push(certificate);
    }
    let counted_together = certify_clusters(doubtful, &certifier, m, s, &mut known);
    if repeated.contains(&true) {
        let mut repeated = repeated.iter();
        let duplicates = withdraw(solutions, |_| repeated.next() == Some(&true));
        let duplicate = |r: &FkRoot| Rejected { reason: RejectionReason::Duplicate, residual: r.residual };
        solutions.rejected.extend(duplicates.iter().map(duplicate));
        solutions.completeness.doubt(Reason::CandidatesRepeated { candidates: duplicates.len() });
    }
    if counted_together {
        let clusters = cluster_certificates(solutions);
        let of_one = |r: &FkRoot| match &r.certificate {
            Some(RootCertificate::Study(c)) => clusters.iter().any(|k| is_of(c, k)),
            _ => false,
        };
        let counted = withdraw(solutions, of_one);
        let rejected = |r: &FkRoot| Rejected { reason: RejectionReason::Duplicate, residual: r.residual };
        solutions.rejected.extend(counted.iter().map(rejected));
    }
    Some(known)
}

/// Poses that are one, or too close to be told apart, are proved together. Of two candidates in one such cluster the first has it, and the roots certified alone that are of
/// it count with it; they are told by `true`.
fn certify_clusters(
    roots: Vec<&mut FkRoot>,
    certifier: &Certifier,
    m: &Manipulator,
    s: &SquaredLegLengths,
    simple: &mut Vec<Certificate>,
) -> bool {
    let mut known: Vec<ClusterCertificate> = Vec::new();
    let before = simple.len();
    for root in roots {
        let near = root.pose;
        for (pose, cluster) in certifier.clusters_near(&near) {
            let apart = |e: &PoseEnclosure| e.is_disjoint(cluster.enclosure());
            if !known.iter().all(|k| apart(k.enclosure())) {
                break;
            }
            // a cluster that may have some of them and may not is none to count
            if !simple.iter().all(|c| apart(c.enclosure()) || is_of(c, &cluster)) {
                continue;
            }
            simple.retain(|c| !is_of(c, &cluster));
            root.pose = pose;
            root.residual = pose.residual(m, s);
            root.reality = proved(cluster.reality());
            root.dual_quaternion = Some(cluster.point());
            root.certificate = Some(RootCertificate::Cluster(cluster));
            root.multiplicity = cluster.multiplicity() as u32;
            known.push(cluster);
            break;
        }
    }
    simple.len() < before
}

/// The certificates of poses that are close or one.
pub(super) fn cluster_certificates(solutions: &FkSolutions) -> Vec<ClusterCertificate> {
    let cluster = |r: &FkRoot| match r.certificate {
        Some(RootCertificate::Cluster(c)) => Some(c),
        _ => None,
    };
    solutions.roots.iter().filter_map(cluster).collect()
}

/// Whether all certified poses are proved to be different ones, those of clusters apart from all others.
pub(super) fn all_distinct(certificates: &[Certificate], clusters: &[ClusterCertificate]) -> Distinctness {
    let enclosures = certificates
        .iter()
        .map(Certificate::enclosure)
        .chain(clusters.iter().map(ClusterCertificate::enclosure));
    let mut doubtful = match distinct(certificates) {
        Distinctness::AllDistinct => Vec::new(),
        Distinctness::NotAll(pairs) => pairs,
    };
    for (j, cluster) in clusters.iter().enumerate().map(|(k, c)| (certificates.len() + k, c)) {
        let others = enclosures.clone().take(j).enumerate();
        let near = others.filter(|(_, e)| !e.is_disjoint(cluster.enclosure()));
        doubtful.extend(near.map(|(i, _)| (i, j, RootRelation::Undecided)));
    }
    if doubtful.is_empty() { Distinctness::AllDistinct } else { Distinctness::NotAll(doubtful) }
}

/// What is known of the certificates of certified roots.
#[derive(Debug)]
pub(super) enum KnownCertificates {
    /// All roots are certified, with disjoint enclosures: they are pairwise distinct.
    AllApart,
    /// These, to be compared.
    Listed(Vec<Certificate>),
}

/// [`certify`], then [`conclude`].
pub(super) fn attach(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    theorem: Theorem,
    known: KnownCertificates,
) -> Result<(), FkError> {
    let known = match known {
        KnownCertificates::AllApart => {
            return conclude_by_number(solutions, m, solutions.roots.len(), theorem).map(|_| ());
        }
        KnownCertificates::Listed(known) => known,
    };
    match certify(solutions, m, s, known) {
        Some(certificates) => conclude(solutions, m, &certificates, theorem),
        None => Ok(()),
    }
}

/// What a certificate proves about reality.
pub(super) fn proved(reality: ProvedReality) -> Reality {
    match reality {
        ProvedReality::Real => Reality::Real,
        ProvedReality::NonReal => Reality::NonReal,
        ProvedReality::Undecided => Reality::Undecided,
    }
}

/// When the certified roots are pairwise distinct and as many as the theorem allows, or as that of the platform's class does,
/// completeness is proved; more are a contradiction. Otherwise regular roots without a certificate, and certificates that may be of one root, are doubts.
pub(super) fn conclude(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    certificates: &[Certificate],
    theorem: Theorem,
) -> Result<(), FkError> {
    let clusters = cluster_certificates(solutions);
    let distinct = all_distinct(certificates, &clusters);
    let count = certificates.len() + clusters.iter().map(ClusterCertificate::multiplicity).sum::<usize>();
    if distinct == Distinctness::AllDistinct && conclude_by_number(solutions, m, count, theorem)? {
        return Ok(());
    }
    let unproved = solutions.roots.iter().filter(|r| !r.certified() && r.multiplicity == 1).count();
    if unproved > 0 {
        solutions.completeness.doubt(Reason::PosesUncertified { poses: unproved });
    }
    if let Distinctness::NotAll(pairs) = distinct {
        let equal = pairs.iter().filter(|p| p.2 == RootRelation::Same).count();
        solutions.completeness.doubt(Reason::PairsNotDistinct { pairs: pairs.len(), equal });
    }
    Ok(())
}

/// Compares the number of certified roots, which are distinct, with what the theorem and those of the platform's class allow; whether completeness is proved.
fn conclude_by_number(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    count: usize,
    theorem: Theorem,
) -> Result<bool, FkError> {
    // the work for a bound is done only where the one before is not met
    let bounds: [&dyn Fn() -> Option<Theorem>; 3] =
        [&|| Some(theorem), &|| class_bound(m), &|| special_bound(m)];
    for theorem in bounds.iter().filter_map(|bound| bound()) {
        if theorem.bound() == count {
            solutions.completeness.learn(Completeness::Proved { theorem });
            reject_others(solutions);
            return Ok(true);
        }
        if theorem.bound() < count {
            let what =
                format!("{count} poses are certified, multiplicities counted, but {}", theorem.statement());
            return Err(FkError::Contradiction { what });
        }
    }
    Ok(false)
}

/// With as many certified roots as there can be, what has no certificate is no further root.
pub(super) fn reject_others(solutions: &mut FkSolutions) {
    let others = withdraw(solutions, |r| !r.certified());
    let rejected = |r: &FkRoot| Rejected { reason: RejectionReason::NotCertified, residual: r.residual };
    solutions.rejected.extend(others.iter().map(rejected));
}

/// What has no certificate is not a root of the answer: it is named beside them, and the answer is undecided.
pub(super) fn set_unproved_apart(solutions: &mut FkSolutions) {
    let mut unproved = withdraw(solutions, |r| !r.certified());
    if unproved.is_empty() {
        return;
    }
    // near a multiple pose the last digit of a length decides whether there is a real one
    for root in unproved.iter_mut().filter(|r| r.reality == Reality::Real) {
        root.reality = Reality::Undecided;
    }
    let paths: u32 = unproved.iter().map(|r| r.multiplicity).sum();
    solutions.completeness.doubt(Reason::EndsUnproved { paths, points: unproved.len() });
    solutions.unproved.extend(unproved);
}

/// Takes roots out of the list and out of the records of the paths.
fn withdraw(solutions: &mut FkSolutions, mut which: impl FnMut(&FkRoot) -> bool) -> Vec<FkRoot> {
    let mut place = Vec::new();
    let (mut kept, mut out) = (Vec::new(), Vec::new());
    for root in std::mem::take(&mut solutions.roots) {
        let goes = which(&root);
        place.push((!goes).then_some(kept.len()));
        if goes { out.push(root) } else { kept.push(root) }
    }
    solutions.roots = kept;
    for path in &mut solutions.paths {
        path.root = path.root.and_then(|r| place[r]);
        path.mirror_root = path.mirror_root.and_then(|r| place[r]);
    }
    out
}
