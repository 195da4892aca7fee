//! Certificates for the roots of a method, and completeness when they reach a proved bound.

use std::fmt::Write as _;

use super::bounds::class_bound;
use super::{Completeness, FkRoot, FkSolutions, Reality, Rejected, RejectionReason};
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::solve::certify::{
    Certificate, CertifiedPose, Certifier, Distinctness, ProvedReality, RootRelation, distinct, relation,
};

/// A proved upper bound on the number of finite poses, counted with multiplicity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    pub(super) count: usize,
    /// Whose bound it is.
    pub(super) argument: &'static str,
}

/// Six legs never have more than 40 isolated finite poses.
pub(super) const GENERAL: Bound = Bound {
    count: 40,
    argument: "40 certified distinct poses, and six leg equations never have more than 40 isolated ones \
               (Ronga, Vust 1992; Lazard 1993; Mourrain 1993)",
};

/// The octic: eight values of the unknown distance, two mirror poses each.
pub(super) const OCTAHEDRAL: Bound = Bound {
    count: 16,
    argument: "16 certified distinct poses, and an octahedral platform never has more than 16 isolated ones \
               (degree of the octic, two mirror poses a root)",
};

/// Tries to certify every root that is not yet; a certified root takes its reality from the proof. `known` are the
/// certificates of those that are. Then [`conclude`].
pub(super) fn attach(
    solutions: &mut FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    bound: Bound,
    mut known: Vec<Certificate>,
) {
    let Ok(certifier) = Certifier::new(m, s) else { return };
    let mut repeated = vec![false; solutions.roots.len()];
    for (root, repeated) in solutions.roots.iter_mut().zip(&mut repeated).filter(|(r, _)| !r.certified()) {
        let Ok(CertifiedPose { pose, certificate }) = certifier.certify_pose(&root.pose) else { continue };
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
    if repeated.contains(&true) {
        let mut repeated = repeated.iter();
        let duplicates = withdraw(solutions, |_| repeated.next() == Some(&true));
        let duplicate = |r: &FkRoot| Rejected { reason: RejectionReason::Duplicate, residual: r.residual };
        solutions.rejected.extend(duplicates.iter().map(duplicate));
        if let Completeness::Unproved { reason, all_paths_accounted } = &mut solutions.completeness {
            let _ = write!(reason, "; {} candidates are roots found already", duplicates.len());
            *all_paths_accounted = false;
        }
    }
    conclude(solutions, m, &known, bound);
}

/// What a certificate proves about reality.
pub(super) fn proved(reality: ProvedReality) -> Reality {
    match reality {
        ProvedReality::Real => Reality::Real,
        ProvedReality::NonReal => Reality::NonReal,
        ProvedReality::Undecided => Reality::Undecided,
    }
}

/// When the certified roots are pairwise distinct and as many as the bound, or as that of the platform's class,
/// completeness is proved. Otherwise regular roots without a certificate, and certificates that may be of one root, are doubts.
fn conclude(solutions: &mut FkSolutions, m: &Manipulator, certificates: &[Certificate], bound: Bound) {
    let distinct = distinct(certificates);
    let count = certificates.len();
    if distinct == Distinctness::AllDistinct {
        if count == bound.count {
            solutions.completeness = Completeness::Proved { argument: bound.argument.to_owned() };
            reject_others(solutions);
            return;
        }
        if let Some(class) = class_bound(m).filter(|b| b.count == count) {
            let argument = format!(
                "{count} certified distinct poses, and no more than {count} are possible: {}",
                class.reason
            );
            solutions.completeness = Completeness::Proved { argument };
            reject_others(solutions);
            return;
        }
    }
    let unproved = solutions.roots.iter().filter(|r| !r.certified() && r.multiplicity == 1).count();
    let Completeness::Unproved { reason, all_paths_accounted } = &mut solutions.completeness else { return };
    if unproved > 0 {
        let _ = write!(reason, "; {unproved} regular poses could not be certified");
        *all_paths_accounted = false;
    }
    if let Distinctness::NotAll(pairs) = distinct {
        let same = pairs.iter().filter(|p| p.2 == RootRelation::Same).count();
        let _ = write!(
            reason,
            "; {} pairs of certified poses are not proved distinct, {same} of them proved equal",
            pairs.len()
        );
        *all_paths_accounted = false;
    }
}

/// With as many certified roots as there can be, what has no certificate is no further root.
pub(super) fn reject_others(solutions: &mut FkSolutions) {
    let others = withdraw(solutions, |r| !r.certified());
    let rejected = |r: &FkRoot| Rejected { reason: RejectionReason::NotCertified, residual: r.residual };
    solutions.rejected.extend(others.iter().map(rejected));
}

/// What has no certificate is no root of the answer: it is named beside them, and the answer is undecided.
pub(super) fn set_unproved_apart(solutions: &mut FkSolutions) {
    let mut unproved = withdraw(solutions, |r| !r.certified());
    if unproved.is_empty() {
        return;
    }
    // near a multiple pose the last digit of a length decides whether there is a real one
    for root in unproved.iter_mut().filter(|r| r.reality == Reality::Real) {
        root.reality = Reality::Undecided;
    }
    if let Completeness::Unproved { reason, all_paths_accounted } = &mut solutions.completeness {
        let paths: u32 = unproved.iter().map(|r| r.multiplicity).sum();
        let _ = write!(
            reason,
            "; {paths} paths end near {} points without a certificate: multiple poses, several close ones, or none",
            unproved.len()
        );
        *all_paths_accounted = false;
    }
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
