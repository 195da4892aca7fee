//! Telling certified roots of one problem apart, whatever patches they were certified on.

use super::certificate::Certificate;
use crate::num::ball::UP;
use crate::num::ball::WideDisc;

/// How two certified roots of the same problem relate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RootRelation {
    /// Proved different: some entry of `R` or `p`, or some ratio of Study coordinates, is.
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
/// Roots are compared by the enclosures of `R` and `p`, which do not depend on the patch, and by those of their Study coordinates: far out
/// (`e.e` near 0) two poses may agree in all the leading digits of `R` and `p` and still have quite different `g`.
#[must_use]
pub fn relation(a: &Certificate, b: &Certificate) -> RootRelation {
    if a.enclosure.is_disjoint(&b.enclosure) {
        return RootRelation::Distinct;
    }
    let seen = [(a, b), (b, a)].map(|(inner, outer)| (on_patch_of(inner, outer), outer));
    let any = |holds: &dyn Fn(&[WideDisc; 8], &Certificate) -> bool| {
        seen.iter().any(|(x, outer)| x.is_some_and(|x| holds(&x, outer)))
    };
    if any(&is_apart) {
        RootRelation::Distinct
    } else if any(&is_captured) {
        RootRelation::Same
    } else {
        RootRelation::Undecided
    }
}

/// Coordinate `j` of the root, where that of its patch is 1.
fn coordinate(c: &Certificate, j: usize) -> WideDisc {
    WideDisc::about(c.centre[j], c.low[j], if j == c.patch { 0.0 } else { c.radius })
}

/// The coordinates of the root of `inner` in the unit of `outer`, divided by the one that is 1 on its patch. `None` when that one may vanish.
fn on_patch_of(inner: &Certificate, outer: &Certificate) -> Option<[WideDisc; 8]> {
    // both units are powers of two: products with their ratio are exact
    let ratio = inner.unit / outer.unit;
    let disc = |j: usize| coordinate(inner, j).scaled(if j < 4 { 1.0 } else { ratio });
    if !ratio.is_normal() {
        return None;
    }
    if inner.patch == outer.patch {
        return Some(std::array::from_fn(disc));
    }
    let factor = disc(outer.patch).reciprocal()?;
    Some(std::array::from_fn(|j| disc(j) * factor))
}

/// Proves that `x` is not the root of `outer`.
fn is_apart(x: &[WideDisc; 8], outer: &Certificate) -> bool {
    (0..8).filter(|j| *j != outer.patch).any(|j| x[j].is_disjoint(&coordinate(outer, j)))
}

/// Proves that `x` lies in the uniqueness ball of `outer`.
fn is_captured(x: &[WideDisc; 8], outer: &Certificate) -> bool {
    (0..8).filter(|j| *j != outer.patch).all(|j| {
        let gap = (x[j] - WideDisc::about(outer.centre[j], outer.low[j], 0.0)).rounded();
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
