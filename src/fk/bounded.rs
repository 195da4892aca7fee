//! Whether all poses up to a distance are listed: the others of the forty are proved to be far out.
//!
//! Six legs have at most forty isolated common points on the closure of the group, points at infinity included. Near
//! poses have certificates, and so have the far ones, in coordinates of their own (`solve::certify::far`). When both
//! together are forty, every pose whose `R` has no entry beyond those of the far ones is in the list. Entries of real
//! rotations are at most one: all real poses are.

use std::cell::LazyCell;

use super::evidence::reject_others;
use super::judge::are_distinct;
use super::{BoundedProof, Completeness, FkError, FkRoot, FkSolutions, Theorem};
use crate::solve::certify::far::{FarPoint, FarRoot, FarSystem};
use crate::solve::certify::{PoseEnclosure, SquareData};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// [`conclude_far`] with the points at infinity of the design, which are looked for once a design, and where poses are
/// missing.
pub(super) fn bounded<F: FnOnce() -> Vec<FarPoint>>(
    found: &mut FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    points: &LazyCell<Vec<FarPoint>, F>,
) -> Result<bool, FkError> {
    let near = found.certified_count();
    if near == 0 || near >= Theorem::SixLegs.bound() || !are_distinct(found) {
        return Ok(false);
    }
    conclude_far(found, m, s, points)
}

/// Proves that what is missing of forty poses is far out, or at infinity; whether that succeeds. `points` are starts.
pub(super) fn conclude_far(
    found: &mut FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    points: &[FarPoint],
) -> Result<bool, FkError> {
    let Some(system) = FarSystem::new(m, &SquareData::from(s)) else { return Ok(false) };
    if !are_distinct(found) {
        return Ok(false);
    }
    let mut far: Vec<FarRoot> = Vec::new();
    let prove = |far: &mut Vec<FarRoot>, start: &FarPoint| {
        let root = system.root_near(start).filter(|root| far.iter().all(|other| root.is_apart(other)));
        far.extend(root);
    };
    for start in points.iter().filter_map(|point| system.starts(point)).flatten() {
        prove(&mut far, &start);
    }
    // of two that are very close, the first one shows where the other is
    if far.len() + found.certified_count() < Theorem::SixLegs.bound() {
        let others: Vec<FarPoint> =
            far.iter().filter_map(|root| Some(system.starts(&root.centre())?[1])).collect();
        for start in &others {
            prove(&mut far, start);
        }
    }
    // roots of the list that are as far out may be among these, and are not counted twice
    let rotation = far.iter().map(|root| root.rotation).fold(f64::INFINITY, f64::min);
    let within = |e: &PoseEnclosure| e.rotation.iter().flatten().all(|entry| entry.magnitude() < rotation);
    let is_near = |r: &&FkRoot| r.certificate.as_ref().is_some_and(|c| within(c.enclosure()));
    let near: usize = found.roots.iter().filter(is_near).map(|r| r.multiplicity as usize).sum();
    if far.is_empty() {
        return Ok(false);
    }
    let (total, bound) = (near + far.len(), Theorem::SixLegs.bound());
    if total > bound {
        let what = format!(
            "{near} near and {} far poses are certified, but six legs have at most {bound}",
            far.len()
        );
        return Err(FkError::Contradiction { what });
    }
    if total < bound {
        return Ok(false);
    }
    let proof = BoundedProof { poses: near, far: far.len(), rotation };
    found.completeness.learn(Completeness::ProvedBounded { proof });
    reject_others(found);
    Ok(true)
}

#[cfg(test)]
mod tests;
