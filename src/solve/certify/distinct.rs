//! Telling certified roots of one problem apart, whatever patches they were certified on.

use super::certificate::Certificate;
use crate::num::disc::{Disc, UP};

/// How two certified roots of the same problem relate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RootRelation {
    /// Proved different: some entry of `R` or `p` is.
    Distinct,
    /// Proved to be one root: one lies where the other is the only one.
    Same,
    /// The enclosures overlap and neither uniqueness ball holds the other enclosure.
    Undecided,
}

/// Whether a list of certified roots is free of repetitions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Distinctness {
    /// Proof: all pairs are distinct.
    AllDistinct,
    /// The pairs (indices into the list) that are not proved distinct, with what is known of them.
    NotAll(Vec<(usize, usize, RootRelation)>),
}

/// Relation of the roots of two certificates; both must come from the same manipulator and the same squared lengths.
///
/// Roots are compared by the enclosures of `R` and `p`, which do not depend on the patch.
#[must_use]
pub fn relation(a: &Certificate, b: &Certificate) -> RootRelation {
    if a.enclosure.discs().zip(b.enclosure.discs()).any(|(x, y)| x.is_disjoint(y)) {
        return RootRelation::Distinct;
    }
    if is_captured(a, b) || is_captured(b, a) { RootRelation::Same } else { RootRelation::Undecided }
}

/// Proves that the root of `inner` lies in the uniqueness ball of `outer`: its coordinates, divided by the
/// one that is 1 on the patch of `outer`.
fn is_captured(inner: &Certificate, outer: &Certificate) -> bool {
    // both units are powers of two: products with their ratio are exact
    let ratio = inner.unit / outer.unit;
    let disc = |j: usize| {
        let radius = if j == inner.patch { 0.0 } else { inner.radius };
        Disc { centre: inner.centre[j], radius }.scaled(if j < 4 { 1.0 } else { ratio })
    };
    let comparable = ratio.is_normal();
    let Some(factor) = disc(outer.patch).reciprocal() else { return false };
    comparable
        && (0..8).filter(|j| *j != outer.patch).all(|j| {
            let x = if inner.patch == outer.patch { disc(j) } else { disc(j) * factor };
            let gap = x - Disc::point(outer.centre[j]);
            (gap.centre.norm() + gap.radius) * UP <= outer.uniqueness_radius
        })
}

/// Proves the roots of certificates of one problem pairwise distinct, or lists the pairs for which it cannot.
#[must_use]
pub fn distinct(certificates: &[Certificate]) -> Distinctness {
    let mut doubtful = Vec::new();
    for (i, a) in certificates.iter().enumerate() {
        for (j, b) in certificates.iter().enumerate().skip(i + 1) {
            match relation(a, b) {
                RootRelation::Distinct => {}
                other => doubtful.push((i, j, other)),
            }
        }
    }
    if doubtful.is_empty() { Distinctness::AllDistinct } else { Distinctness::NotAll(doubtful) }
}
