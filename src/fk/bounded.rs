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

use std::cell::OnceCell;

use super::counted::are_distinct;
use super::evidence::reject_others;
use super::{
    BoundedProof, Completeness, FarPoses, FkError, FkRoot, FkSolutions, PoseCounting, Reason, SolutionSet,
    Theorem,
};
use crate::solve::FarSearch;
use crate::solve::certify::SquareData;
use crate::solve::certify::far::{FarPoint, FarRoots, FarSystem};
use neighbour::Neighbour;
use num::ball::Disc;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Knowledge about the joints of a design that proofs up to a distance need: computed when it is asked for.
pub(super) struct Surroundings<'a> {
    manipulator: &'a Manipulator,
    neighbour: OnceCell<Option<Neighbour>>,
    search: FarSearch,
}

/// The part of it that a proof needed, kept for many lengths of a design.
#[derive(Debug)]
pub(super) enum KnownSurroundings {
    /// Starts of the proof of far poses.
    FarPoints(Vec<FarPoint>),
    /// The design whose poses are next to the real ones.
    Neighbour(Box<Neighbour>),
}

impl<'a> Surroundings<'a> {
    pub(super) fn new(m: &'a Manipulator, seed: u64) -> Self {
        Self { manipulator: m, neighbour: OnceCell::new(), search: FarSearch::new(m, seed) }
    }

    /// Proves, where poses are missing, that those listed are all up to a distance, or all real ones; whether that
    /// succeeds.
    ///
    /// A design next to affine hexagons has far poses that are hard to follow and harder to prove. The real ones come
    /// first if doubles do not see the far ones, or if nobody counts poses.
    pub(super) fn conclude(
        &mut self,
        found: &mut FkSolutions,
        s: &SquaredLegLengths,
        counting: PoseCounting,
    ) -> Result<bool, FkError> {
        if !may_lack_far_poses(found) {
            return Ok(false);
        }
        let real_first = |n: &&Neighbour| counting == PoseCounting::Never || n.hides_far_poses();
        if self.neighbour().filter(real_first).is_some_and(|n| conclude_real(found, n, self.manipulator, s)) {
            return Ok(true);
        }
        conclude_far(found, self.manipulator, s, self.search.points())
    }

    /// The last proof that is tried: about the real poses alone.
    pub(super) fn conclude_last(&self, found: &mut FkSolutions, s: &SquaredLegLengths) {
        let open = matches!(found.completeness, Completeness::Unproved { .. })
            && found.solution_set == SolutionSet::Isolated
            && may_lack_far_poses(found);
        // a neighbour costs exact arithmetic, which an answer that is proved already does without
        if open && let Some(neighbour) = self.neighbour() {
            conclude_real(found, neighbour, self.manipulator, s);
        }
    }

    /// Whether the proof of real poses can apply. Such a design has many far poses that doubles do not see.
    pub(super) fn is_next_to_affine_hexagons(&self) -> bool {
        self.neighbour().is_some()
    }

    fn neighbour(&self) -> Option<&Neighbour> {
        self.neighbour.get_or_init(|| Neighbour::of(self.manipulator)).as_ref()
    }

    /// Starts for other lengths, by their places in a list that is proved to have all poses up to a distance, and the
    /// knowledge for the same proof.
    pub(super) fn of_proved(
        m: &'a Manipulator,
        seed: u64,
        found: &FkSolutions,
        s: &SquaredLegLengths,
    ) -> Result<Option<(Vec<usize>, KnownSurroundings)>, FkError> {
        let Completeness::ProvedBounded { proof } = &found.completeness else { return Ok(None) };
        if proof.far.is_some() {
            let mut search = FarSearch::new(m, seed);
            conclude_far(&mut found.clone(), m, s, search.points())?;
            let points = KnownSurroundings::FarPoints(search.known().to_vec());
            return Ok(Some(((0..found.roots.len()).collect(), points)));
        }
        let kept = Neighbour::of(m).filter(Neighbour::hides_far_poses).and_then(|neighbour| {
            let near = neighbour.near(found, m, s)?;
            Some((near, KnownSurroundings::Neighbour(Box::new(neighbour))))
        });
        Ok(kept)
    }
}

impl KnownSurroundings {
    /// As [`Surroundings::conclude`], with what is known.
    pub(super) fn conclude(
        &self,
        found: &mut FkSolutions,
        m: &Manipulator,
        s: &SquaredLegLengths,
    ) -> Result<bool, FkError> {
        if !may_lack_far_poses(found) {
            return Ok(false);
        }
        match self {
            Self::FarPoints(points) => conclude_far(found, m, s, points.iter().copied()),
            Self::Neighbour(neighbour) => Ok(conclude_real(found, neighbour, m, s)),
        }
    }
}

/// Whether there are certified, distinct poses, fewer than a theorem allows.
fn may_lack_far_poses(found: &FkSolutions) -> bool {
    let near = found.certified_count();
    near > 0 && near < Theorem::SixLegs.bound() && are_distinct(found)
}

/// Proves that the list has all real poses, each next to one of the neighbour; whether that succeeds. The certified
/// roots are distinct.
fn conclude_real(
    found: &mut FkSolutions,
    neighbour: &Neighbour,
    m: &Manipulator,
    s: &SquaredLegLengths,
) -> bool {
    let Some(proof) = neighbour.prove(found, m, s) else { return false };
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
    let listed: Vec<(f64, usize)> = found.roots.iter().filter_map(size).collect();
    let mut far: Vec<FarRoots> = Vec::new();
    let mut best = Separation::default();
    for point in points {
        let before = far.len();
        for roots in system.roots_near(&point) {
            for roots in [roots.conjugate(), roots] {
                if far.iter().all(|other| roots.is_apart(other)) {
                    far.push(roots);
                }
            }
        }
        if far.len() > before {
            best = Separation::best(&listed, &far);
        }
        if best.poses() >= bound {
            break;
        }
    }
    let Separation { near: poses, far: beyond, rotation } = best;
    if best.poses() > bound {
        let what =
            format!("{poses} near and {beyond} far poses are certified, but six legs have at most {bound}");
        return Err(FkError::Contradiction { what });
    }
    if best.poses() < bound {
        if beyond > 0 {
            found.completeness.doubt(Reason::NotSeparated { near: poses, far: beyond });
        }
        return Ok(false);
    }
    far.retain(|roots| roots.rotation >= rotation);
    let mut others: Vec<FarPoses> = far.iter().map(FarPoses::from).collect();
    others.sort_by(|x, y| x.rotation.total_cmp(&y.rotation));
    let proof = BoundedProof { poses, far: Some(beyond), rotation: Some(rotation), neighbour: None, others };
    found.completeness.learn(Completeness::ProvedBounded { proof });
    reject_others(found);
    Ok(true)
}

/// Numbers of proved poses on both sides of a bound of the largest entry of `R`.
#[derive(Clone, Copy, Default)]
struct Separation {
    /// Listed poses with smaller entries.
    near: usize,
    /// Far poses with an entry that is not smaller.
    far: usize,
    /// The bound.
    rotation: f64,
}

impl Separation {
    fn poses(&self) -> usize {
        self.near + self.far
    }

    /// The bound with the most poses.
    ///
    /// Any bound keeps listed and far poses apart, so that none is counted twice. A search for far poses may also find
    /// some of the listed ones. A bound above them counts these as listed.
    fn best(listed: &[(f64, usize)], far: &[FarRoots]) -> Self {
        let at = |rotation: f64| Self {
            near: listed.iter().filter(|(entry, _)| *entry < rotation).map(|(_, number)| number).sum(),
            far: far.iter().filter(|f| f.rotation >= rotation).map(|f| f.multiplicity).sum(),
            rotation,
        };
        far.iter().map(|roots| at(roots.rotation)).max_by_key(Self::poses).unwrap_or_default()
    }
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
