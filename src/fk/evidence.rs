//! Certificates for the roots of a method, and completeness when they reach a proved bound.

use super::bounds::class_bound;
use super::{Completeness, FkSolutions, Reality};
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::solve::certify::{
    Certificate, CertificateOutcome, Certifier, Distinctness, ProvedReality, distinct, exact_squares,
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

/// Tries to certify every root; a certified root takes its reality from the proof. When the certified roots
/// are pairwise distinct and as many as the bound, or as that of the platform's class, completeness is proved.
pub(super) fn attach(solutions: &mut FkSolutions, m: &Manipulator, s: &SquaredLegLengths, bound: Bound) {
    let Ok(certifier) = Certifier::new(m, &exact_squares(s)) else { return };
    let mut certificates: Vec<Certificate> = Vec::new();
    for root in &mut solutions.roots {
        if let CertificateOutcome::Certified(certificate) = certifier.certify(&root.pose) {
            root.certified = true;
            root.reality = match certificate.reality() {
                ProvedReality::Real => Reality::Real,
                ProvedReality::NonReal => Reality::NonReal,
                ProvedReality::Undecided => Reality::Undecided,
            };
            certificates.push(certificate);
        }
    }
    if distinct(&certificates) != Distinctness::AllDistinct {
        return;
    }
    let count = certificates.len();
    if count == bound.count {
        solutions.completeness = Completeness::Proved { argument: bound.argument.to_owned() };
    } else if let Some(class) = class_bound(m).filter(|b| b.count == count) {
        let argument = format!(
            "{count} certified distinct poses, and no more than {count} are possible: {}",
            class.reason
        );
        solutions.completeness = Completeness::Proved { argument };
    }
}
