//! Whether all poses up to a distance are listed: the others of the forty are proved to be far out.
//!
//! Six legs have at most forty isolated common points on the closure of the group, points at infinity included. Near
//! poses have certificates, and so have the far ones, in coordinates of their own (`solve::certify::far`). When both
//! together are forty, every pose whose `R` has no entry beyond those of the far ones is in the list. Entries of real
//! rotations are at most one: all real poses are.
//!
//! Designs next to affine hexagons have far poses that no certificate of single points reaches, and a proof of their
//! own for real poses ([`neighbour`]).

mod neighbour;

use super::evidence::reject_others;
use super::judge::are_distinct;
use super::{BoundedProof, Completeness, FarPoses, FkError, FkRoot, FkSolutions, Reason, Theorem};
use crate::solve::FarSearch;
use crate::solve::certify::SquareData;
use crate::solve::certify::far::{FarPoint, FarRoots, FarSystem};
use neighbour::Neighbour;
use num::ball::Disc;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Knowledge about the joints of a design that proofs up to a distance need: computed when it is asked for.
pub(super) struct Surroundings<'a> {
    manipulator: &'a Manipulator,
    search: FarSearch,
}

/// Starts of the proof of far poses, kept for many lengths of a design.
#[derive(Debug)]
pub(super) struct KnownFarPoints(Vec<FarPoint>);

impl<'a> Surroundings<'a> {
    pub(super) fn new(m: &'a Manipulator, seed: u64) -> Self {
        Self { manipulator: m, search: FarSearch::new(m, seed) }
    }

    /// Proves, where poses are missing, that those listed are all up to a distance; whether that succeeds.
    pub(super) fn conclude_far(
        &mut self,
        found: &mut FkSolutions,
        s: &SquaredLegLengths,
    ) -> Result<bool, FkError> {
        if !may_lack_far_poses(found) {
            return Ok(false);
        }
        conclude_far(found, self.manipulator, s, self.search.points())
    }

    /// The part that does not depend on lengths, as far as it was needed.
    pub(super) fn known(self) -> KnownFarPoints {
        KnownFarPoints(self.search.known().to_vec())
    }
}

impl KnownFarPoints {
    /// As [`Surroundings::conclude_far`], with the starts that are known.
    pub(super) fn conclude(
        &self,
        found: &mut FkSolutions,
        m: &Manipulator,
        s: &SquaredLegLengths,
    ) -> Result<bool, FkError> {
        Ok(are_distinct(found) && conclude_far(found, m, s, self.0.iter().copied())?)
    }
}

/// Whether there are certified, distinct poses, fewer than a theorem allows.
fn may_lack_far_poses(found: &FkSolutions) -> bool {
    let near = found.certified_count();
    near > 0 && near < Theorem::SixLegs.bound() && are_distinct(found)
}

/// Proves that the list has all real poses, each next to one of the neighbour; whether that succeeds. Complex poses may
/// be missing, so that this comes last.
pub(super) fn conclude_real(found: &mut FkSolutions, m: &Manipulator, s: &SquaredLegLengths) -> bool {
    if !may_lack_far_poses(found) {
        return false;
    }
    let Some(proof) = Neighbour::of(m).and_then(|n| n.prove(found, m, s)) else { return false };
    found.completeness.learn(Completeness::ProvedBounded { proof });
    reject_others(found);
    true
}

/// Proves that the rest of forty poses is far out, or at infinity; whether that succeeds. The certified roots are
/// distinct; `points` are starts, one of each conjugate pair.
fn conclude_far(
    found: &mut FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    points: impl Iterator<Item = FarPoint>,
) -> Result<bool, FkError> {
    let Some(system) = FarSystem::new(m, &SquareData::from(s)) else { return Ok(false) };
    let bound = Theorem::SixLegs.bound();
    // roots of the list that are as far out as the others may be among them, and are not counted twice
    let sizes: Vec<(f64, usize)> = found.roots.iter().filter_map(size).collect();
    let mut far: Vec<FarRoots> = Vec::new();
    let count = |far: &[FarRoots]| {
        let rotation = far.iter().map(|root| root.rotation).fold(f64::INFINITY, f64::min);
        let near: usize = sizes.iter().filter(|(entry, _)| *entry < rotation).map(|(_, number)| number).sum();
        (near, far.iter().map(|r| r.multiplicity).sum::<usize>(), rotation)
    };
    for point in points {
        for roots in system.roots_near(&point) {
            for roots in [roots.conjugate(), roots] {
                if far.iter().all(|other| roots.is_apart(other)) {
                    far.push(roots);
                }
            }
        }
        let (near, beyond, _) = count(&far);
        if near + beyond >= bound {
            break;
        }
    }
    let (poses, beyond, rotation) = count(&far);
    if poses + beyond > bound {
        let what =
            format!("{poses} near and {beyond} far poses are certified, but six legs have at most {bound}");
        return Err(FkError::Contradiction { what });
    }
    if poses + beyond < bound {
        if beyond > 0 {
            found.completeness.doubt(Reason::NotSeparated { near: poses, far: beyond });
        }
        return Ok(false);
    }
    let mut others: Vec<FarPoses> = far.iter().map(FarPoses::from).collect();
    others.sort_by(|x, y| x.rotation.total_cmp(&y.rotation));
    let proof = BoundedProof { poses, far: Some(beyond), rotation: Some(rotation), neighbour: None, others };
    found.completeness.learn(Completeness::ProvedBounded { proof });
    reject_others(found);
    Ok(true)
}

impl From<&FarRoots> for FarPoses {
    fn from(roots: &FarRoots) -> Self {
        Self {
            poses: roots.multiplicity,
            rotation: roots.rotation,
            rotation_at_most: roots.rotation_at_most.is_finite().then_some(roots.rotation_at_most),
        }
    }
}

/// The largest entry of `R` of a certified root, and how many roots it stands for.
fn size(root: &FkRoot) -> Option<(f64, usize)> {
    let entries = root.certificate.as_ref()?.enclosure().rotation;
    let largest = entries.iter().flatten().map(Disc::magnitude).fold(0.0, f64::max);
    Some((largest, root.multiplicity as usize))
}

#[cfg(test)]
mod tests;
