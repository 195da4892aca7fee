//! Certificates for the roots of a method, and completeness when they reach a proved bound.

use num_complex::Complex64;

use super::bounds::{class_bound, special_bound};
use super::{
    Completeness, FkError, FkRoot, FkSolutions, Reality, Reason, Rejected, RejectionReason, Theorem,
};
use crate::solve::certify::{
    Certificate, CertifiedPose, Certifier, ClusterCertificate, Distinctness, NewtonStart, PoseEnclosure,
    ProvedCluster, ProvedReality, RootCertificate, RootRelation, distinct, is_of, relation,
};
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Candidates closer than this, in design sizes and rotation entries, may be of one cluster.
const NEARBY: f64 = 1e-3;

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
    let mut known = Known { certifier: &certifier, simple: known, clusters: Vec::new() };
    let further = certify_clusters(doubtful, &mut known, m, s);
    if repeated.contains(&true) {
        let mut repeated = repeated.iter();
        let duplicates = withdraw(solutions, |_| repeated.next() == Some(&true));
        let duplicate = |r: &FkRoot| Rejected { reason: RejectionReason::Duplicate, residual: r.residual };
        solutions.rejected.extend(duplicates.iter().map(duplicate));
        solutions.completeness.doubt(Reason::CandidatesRepeated { candidates: duplicates.len() });
    }
    let of_one = |r: &FkRoot| match &r.certificate {
        Some(RootCertificate::Study(c)) => known.clusters.iter().any(|k| is_of(c, k)),
        _ => false,
    };
    if !known.clusters.is_empty() {
        let counted = withdraw(solutions, of_one);
        let rejected = |r: &FkRoot| Rejected { reason: RejectionReason::Duplicate, residual: r.residual };
        solutions.rejected.extend(counted.iter().map(rejected));
    }
    solutions.roots.extend(further);
    Some(known.simple)
}

/// The proved facts about poses that coincide, or are too close to be told apart.
struct Together {
    cluster: ProvedCluster,
    /// A simple root beside them that no candidate stands for.
    beside: Option<CertifiedPose>,
}

/// The clusters proved so far, and the certificates of single roots that are of none of them.
struct Known<'a> {
    certifier: &'a Certifier,
    simple: Vec<Certificate>,
    clusters: Vec<ClusterCertificate>,
}

impl Known<'_> {
    /// Whether it is known which single roots are of the cluster: one that may have a root and may not is none to
    /// count.
    fn may_count(&self, cluster: &ClusterCertificate) -> bool {
        self.simple.iter().all(|c| c.enclosure().is_disjoint(cluster.enclosure()) || is_of(c, cluster))
    }

    /// The smallest cluster near a pose at which `ends` paths ended, with the root beside it where there is just one.
    /// Without such a cluster it is the largest that can be proved.
    fn together(&self, pose: &ComplexPose, ends: usize) -> Option<Together> {
        let mut best: Option<ProvedCluster> = None;
        // more roots than paths would be those of paths that went elsewhere
        for found in self.certifier.clusters_near(pose, ends.max(2)) {
            let apart = |k: &ClusterCertificate| k.enclosure().is_disjoint(found.1.enclosure());
            if !self.clusters.iter().all(apart) {
                break;
            }
            if !self.may_count(&found.1) {
                continue;
            }
            let one_less = |b: &ProvedCluster| b.1.multiplicity() + 1 == found.1.multiplicity();
            let beside = best.as_ref().filter(|b| one_less(b)).and_then(|b| self.beside(b, &found));
            if let (Some(cluster), Some(root)) = (best, beside) {
                return Some(Together { cluster, beside: Some(root) });
            }
            let enough = found.1.multiplicity() >= ends;
            if best.as_ref().is_none_or(|b| b.1.multiplicity() < found.1.multiplicity()) {
                best = Some(found);
            }
            if enough {
                break;
            }
        }
        best.map(|cluster| Together { cluster, beside: None })
    }

    /// The one root that a cluster has beside those of a smaller one: the middles are means of the roots, to first
    /// order.
    fn beside(&self, fewer: &ProvedCluster, all: &ProvedCluster) -> Option<CertifiedPose> {
        let (m, one) = (Complex64::from(fewer.1.multiplicity() as f64), Complex64::ONE);
        let rest = |all, fewer| -> ComplexPose {
            let (all, fewer): (&ComplexPose, &ComplexPose) = (all, fewer);
            ComplexPose {
                rotation: all.rotation * (m + one) - fewer.rotation * m,
                position: all.position * (m + one) - fewer.position * m,
            }
        };
        let root = self.certifier.root_near(NewtonStart::Pose(&rest(&all.0, &fewer.0))).ok()?;
        let apart = |e: &PoseEnclosure| e.is_disjoint(root.certificate.enclosure());
        let new = self.simple.iter().all(|c| apart(c.enclosure())) && apart(fewer.1.enclosure());
        (new && is_of(&root.certificate, &all.1)).then_some(root)
    }
}

/// Proves poses together that coincide, or are too close to be told apart. The first of two candidates in one cluster
/// gets the cluster, and its count includes the single roots in it. Roots that are found beside clusters are returned.
fn certify_clusters(
    mut roots: Vec<&mut FkRoot>,
    known: &mut Known<'_>,
    m: &Manipulator,
    s: &SquaredLegLengths,
) -> Vec<FkRoot> {
    let mut further = Vec::new();
    let places: Vec<(ComplexPose, usize)> = roots.iter().map(|r| (r.pose, r.multiplicity as usize)).collect();
    for root in &mut roots {
        let near = |p: &&(ComplexPose, usize)| p.0.distance(&root.pose, m.size()) < NEARBY;
        let ends = places.iter().filter(near).map(|p| p.1).sum();
        let Some(Together { cluster: (pose, cluster), beside }) = known.together(&root.pose, ends) else {
            continue;
        };
        known.simple.retain(|c| !is_of(c, &cluster));
        known.clusters.push(cluster);
        root.pose = pose;
        root.residual = pose.residual(m, s);
        root.reality = proved(cluster.reality());
        root.dual_quaternion = Some(cluster.point());
        root.certificate = Some(RootCertificate::Cluster(cluster));
        root.multiplicity = cluster.multiplicity() as u32;
        if let Some(CertifiedPose { pose, certificate }) = beside {
            known.simple.push(certificate);
            further.push(FkRoot {
                pose,
                reality: proved(certificate.reality()),
                certificate: Some(certificate.into()),
                multiplicity: 1,
                residual: pose.residual(m, s),
                condition: root.condition,
                dual_quaternion: Some(certificate.point()),
            });
        }
    }
    further
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

/// The certificates of certified roots, as far as they matter for their distinctness.
#[derive(Debug)]
pub(super) enum KnownCertificates {
    /// All roots are certified, with disjoint enclosures: they are pairwise distinct.
    AllApart,
    /// Certificates that have to be compared.
    Listed(Vec<Certificate>),
}

/// The upper bounds that the number of certified roots is compared with.
#[derive(Debug, Clone, Copy)]
pub(super) enum Bounds {
    /// The bound of this theorem, then the bounds that the joints of the design have.
    First(Theorem),
    /// The bound of this theorem alone: the bounds of the joints are known not to be reached.
    Only(Theorem),
}

impl From<Theorem> for Bounds {
    fn from(theorem: Theorem) -> Self {
        Self::First(theorem)
    }
}

/// [`certify`], then [`conclude`].
pub(super) fn attach(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    bounds: impl Into<Bounds>,
    known: KnownCertificates,
) -> Result<(), FkError> {
    let bounds = bounds.into();
    let known = match known {
        KnownCertificates::AllApart => {
            return conclude_by_number(solutions, m, solutions.roots.len(), bounds).map(|_| ());
        }
        KnownCertificates::Listed(known) => known,
    };
    match certify(solutions, m, s, known) {
        Some(certificates) => conclude(solutions, m, &certificates, bounds),
        None => Ok(()),
    }
}

/// The reality that a certificate proves.
pub(super) fn proved(reality: ProvedReality) -> Reality {
    match reality {
        ProvedReality::Real => Reality::Real,
        ProvedReality::NonReal => Reality::NonReal,
        ProvedReality::Undecided => Reality::Undecided,
    }
}

/// Completeness is proved when the certified roots are pairwise distinct and as many as one of the `bounds` allows.
/// More roots are a contradiction. Otherwise regular roots without a certificate, and certificates that may be of one
/// root, are doubts.
pub(super) fn conclude(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    certificates: &[Certificate],
    bounds: impl Into<Bounds>,
) -> Result<(), FkError> {
    let clusters = cluster_certificates(solutions);
    let distinct = all_distinct(certificates, &clusters);
    let count = certificates.len() + clusters.iter().map(ClusterCertificate::multiplicity).sum::<usize>();
    if distinct == Distinctness::AllDistinct && conclude_by_number(solutions, m, count, bounds.into())? {
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

/// Compares the number of certified roots, which are distinct, with the bounds of the theorem and of the platform's
/// class. Returns whether completeness is proved.
fn conclude_by_number(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    count: usize,
    bounds: Bounds,
) -> Result<bool, FkError> {
    let (theorem, number) = match bounds {
        Bounds::First(theorem) => (theorem, 3),
        Bounds::Only(theorem) => (theorem, 1),
    };
    // the work for a bound is done only where the one before is not met
    let bounds: [&dyn Fn() -> Option<Theorem>; 3] =
        [&|| Some(theorem), &|| class_bound(m), &|| special_bound(m)];
    for theorem in bounds[..number].iter().filter_map(|bound| bound()) {
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

/// Rejects roots without a certificate when all poses, or all real ones, are certified: they are no further roots, or
/// not real.
pub(super) fn reject_others(solutions: &mut FkSolutions) {
    // most answers: a record has a kilobyte, and none is moved
    if solutions.roots.iter().all(FkRoot::certified) {
        return;
    }
    let others = withdraw(solutions, |r| !r.certified());
    let rejected = |r: &FkRoot| Rejected { reason: RejectionReason::NotCertified, residual: r.residual };
    solutions.rejected.extend(others.iter().map(rejected));
}

/// Sets roots without a certificate apart from the roots of the answer: they are named, and the answer is undecided.
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
