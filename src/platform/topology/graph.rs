//! The graph of joints and legs.

use crate::manipulator::Manipulator;

/// The bipartite graph of joints and legs up to isomorphism: joints are nodes, legs are edges, and base and platform
/// are distinguished.
///
/// The stored form is the least over all orders of the legs. Entry `i` is the number of the joint of leg `i`, with
/// joints numbered in order of appearance. Equal graphs are equal values.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_platform::{geom, manipulator, topology}; } pub mod prelude { pub use equipod_platform::geom::*; } }
/// use equipod::methods::topology::Topology;
/// // the octahedral zigzag, from wherever one starts
/// let one = Topology::of_legs([0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]);
/// assert_eq!(one, Topology::of_legs([7, 7, 4, 4, 5, 5], [0, 1, 1, 2, 2, 0]));
/// assert_eq!((one.base_joints(), one.shared_joints()), (3, 6));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Topology {
    base: [u8; 6],
    platform: [u8; 6],
}

num::words! {
    /// Reasons why six legs can never hold a platform: the Jacobian has rank 5 or less at every pose, for all joints.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum AlwaysSingular as words, Display {
        /// Two legs join the same two joints, so their lines coincide.
        CoincidentLegs = "two legs join the same two joints",
        /// Four lines through one point have rank 3.
        FourLegsAtOneJoint = "four or more legs meet in one joint",
        /// All six legs pass through two joints, so every leg meets the line of the two, about which the platform can
        /// rotate.
        TwoJointsHoldAllLegs = "two joints hold all six legs",
    }
}

impl Topology {
    /// The topology of six legs given by joint indices.
    #[must_use]
    pub fn of_legs(base: [usize; 6], platform: [usize; 6]) -> Self {
        let mut least = None;
        each_order(&mut [0, 1, 2, 3, 4, 5], 0, &mut |order| {
            let along = |joints: [usize; 6]| std::array::from_fn(|leg| joints[order[leg]]);
            let here = Self::unordered(along(base), along(platform));
            if least.is_none_or(|l| here < l) {
                least = Some(here);
            }
        });
        least.unwrap_or_else(|| unreachable!("there are orders"))
    }

    /// The graph with the legs in the given order. [`is_merger_of`](Self::is_merger_of) and
    /// [`always_singular`](Self::always_singular) need no least form and are faster than its computation.
    pub fn unordered(base: [usize; 6], platform: [usize; 6]) -> Self {
        Self { base: by_appearance(base), platform: by_appearance(platform) }
    }

    /// The topology of a design, by its shared joints: two coincident joints count as two.
    #[must_use]
    pub fn of_manipulator(m: &Manipulator) -> Self {
        Self::of_legs(m.pairs().map(|p| p.0), m.pairs().map(|p| p.1))
    }

    /// Base and platform exchanged.
    #[must_use]
    pub fn exchanged(self) -> Self {
        Self::of_legs(self.platform.map(usize::from), self.base.map(usize::from))
    }

    /// The lesser of this topology and the one with base and platform exchanged.
    #[must_use]
    pub fn up_to_exchange(self) -> Self {
        self.min(self.exchanged())
    }

    /// Base and platform joint of every leg, numbered from 0 in order of appearance.
    #[must_use]
    pub fn legs(self) -> [(usize, usize); 6] {
        std::array::from_fn(|i| (usize::from(self.base[i]), usize::from(self.platform[i])))
    }

    /// Number of joints on the base.
    #[must_use]
    pub fn base_joints(self) -> usize {
        1 + usize::from(self.base.into_iter().max().unwrap_or(0))
    }

    /// Number of joints on the platform.
    #[must_use]
    pub fn platform_joints(self) -> usize {
        1 + usize::from(self.platform.into_iter().max().unwrap_or(0))
    }

    /// Number of joints that carry two or more legs.
    #[must_use]
    pub fn shared_joints(self) -> usize {
        let shared = |x: [u8; 6]| counts(x).into_iter().filter(|n| *n > 1).count();
        shared(self.base) + shared(self.platform)
    }

    /// Whether the legs share at least the joints of `finer`: merging joints of it gives this topology (within base and
    /// within platform). A topology is a merger of itself.
    #[must_use]
    pub fn is_merger_of(self, finer: Self) -> bool {
        merges(&self, &finer, &mut [0; 6], 0)
    }

    /// The reason why no platform of this topology can be held; `None` if some can.
    ///
    /// The conditions are also necessary. Every topology without them has a platform and a pose with a regular
    /// Jacobian, and so almost all platforms do (`docs/theory/topologies.md`; tested in exact arithmetic).
    #[must_use]
    pub fn always_singular(self) -> Option<AlwaysSingular> {
        let legs = self.legs();
        if (0..6).any(|i| legs[..i].contains(&legs[i])) {
            return Some(AlwaysSingular::CoincidentLegs);
        }
        let (base, platform) = (counts(self.base), counts(self.platform));
        if base.into_iter().chain(platform).any(|n| n > 3) {
            return Some(AlwaysSingular::FourLegsAtOneJoint);
        }
        // a joint as the set of its legs
        let sets: Vec<u8> = (0..6).flat_map(|j| [legs_at(self.base, j), legs_at(self.platform, j)]).collect();
        let covered = sets.iter().any(|x| sets.iter().any(|y| x | y == 0b11_1111));
        covered.then_some(AlwaysSingular::TwoJointsHoldAllLegs)
    }
}

fn counts(x: [u8; 6]) -> [u32; 6] {
    std::array::from_fn(|j| legs_at(x, j as u8).count_ones())
}

fn legs_at(x: [u8; 6], joint: u8) -> u8 {
    (0..6).filter(|i| x[*i] == joint).fold(0, |set, i| set | 1 << i)
}

/// Tries every leg of `coarse` as leg `next` of `fine`, with the earlier ones placed.
fn merges(coarse: &Topology, fine: &Topology, placed: &mut [usize; 6], next: usize) -> bool {
    if next == 6 {
        return true;
    }
    (0..6).any(|leg| {
        let fits = (0..next).all(|k| {
            let joined = |f: &[u8; 6], c: &[u8; 6]| f[k] != f[next] || c[placed[k]] == c[leg];
            placed[k] != leg && joined(&fine.base, &coarse.base) && joined(&fine.platform, &coarse.platform)
        });
        if fits {
            placed[next] = leg;
        }
        fits && merges(coarse, fine, placed, next + 1)
    })
}

fn by_appearance(x: [usize; 6]) -> [u8; 6] {
    let (mut seen, mut count) = ([usize::MAX; 6], 0);
    x.map(|joint| {
        let known = seen[..count].iter().position(|s| *s == joint);
        known.unwrap_or_else(|| {
            seen[count] = joint;
            count += 1;
            count - 1
        }) as u8
    })
}

/// Visits every order of the elements from `fixed` on.
pub(super) fn each_order(order: &mut [usize], fixed: usize, visit: &mut impl FnMut(&[usize])) {
    if fixed >= order.len() {
        visit(order);
        return;
    }
    for k in fixed..order.len() {
        order.swap(fixed, k);
        each_order(order, fixed + 1, visit);
        order.swap(fixed, k);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_three_ways_to_be_always_singular() {
        let all = [0, 1, 2, 3, 4, 5];
        let why = |base, platform| Topology::of_legs(base, platform).always_singular();
        assert_eq!(why([0, 0, 1, 2, 3, 4], [0, 0, 1, 2, 3, 4]), Some(AlwaysSingular::CoincidentLegs));
        assert_eq!(why([0, 0, 0, 0, 1, 2], all), Some(AlwaysSingular::FourLegsAtOneJoint));
        assert_eq!(why([0, 0, 0, 1, 1, 1], all), Some(AlwaysSingular::TwoJointsHoldAllLegs));
        // one triple joint on each body, without a common leg
        assert_eq!(why([0, 0, 0, 1, 2, 3], [0, 1, 2, 3, 3, 3]), Some(AlwaysSingular::TwoJointsHoldAllLegs));
        // with a common leg the sixth leg meets neither joint
        assert_eq!(why([0, 0, 0, 1, 2, 3], [0, 1, 2, 0, 0, 3]), None);
        assert_eq!(why(all, all), None);
    }

    #[test]
    fn mergers_go_one_way() {
        let all = [0, 1, 2, 3, 4, 5];
        let general = Topology::of_legs(all, all);
        let two_pairs = Topology::of_legs([0, 0, 1, 1, 2, 3], all);
        let octahedral = Topology::of_legs([0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]);
        assert!(octahedral.is_merger_of(two_pairs) && two_pairs.is_merger_of(general));
        assert!(!general.is_merger_of(two_pairs) && !two_pairs.is_merger_of(octahedral));
        assert!(!two_pairs.is_merger_of(two_pairs.exchanged()), "base and platform are kept apart");
        let triple = Topology::of_legs([0, 0, 0, 1, 2, 3], all);
        assert!(!octahedral.is_merger_of(triple) && triple.is_merger_of(triple));
    }
}
