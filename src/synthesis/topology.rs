//! Which legs share which joints.

use super::pattern::Pattern;

/// The bipartite multigraph of joints and legs up to isomorphism: joints are nodes, legs are edges.
///
/// Two legs share a joint when their ends coincide by construction, for all offsets. Stored is the least of
/// all ways to number the legs; entry `i` is the number of the joint of leg `i`, joints numbered as they appear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Topology {
    base: [u8; 6],
    platform: [u8; 6],
}

impl Topology {
    /// The topology of a pattern; base and platform are kept apart.
    #[must_use]
    pub fn of(pattern: &Pattern) -> Self {
        let joints = pattern.joints();
        let ends = |body: usize| {
            pattern.legs().map(|p| joints[body].iter().position(|j| *j == p.joints()[body]).unwrap_or(0))
        };
        Self::of_legs(ends(0), ends(1))
    }

    /// The topology of six legs given by joint indices.
    #[must_use]
    pub fn of_legs(base: [usize; 6], platform: [usize; 6]) -> Self {
        let mut least = None;
        each_order(&mut [0, 1, 2, 3, 4, 5], 0, &mut |order| {
            let here = Self {
                base: by_appearance(order.map(|i| base[i])),
                platform: by_appearance(order.map(|i| platform[i])),
            };
            if least.is_none_or(|l| here < l) {
                least = Some(here);
            }
        });
        least.unwrap_or_else(|| unreachable!("there are orders"))
    }

    /// The lesser of this topology and the one with base and platform exchanged.
    #[must_use]
    pub fn up_to_exchange(self) -> Self {
        let widen = |x: [u8; 6]| x.map(usize::from);
        self.min(Self::of_legs(widen(self.platform), widen(self.base)))
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
        let carries_two = |x: [u8; 6], j: u8| x.into_iter().filter(|y| *y == j).nth(1).is_some();
        let shared = |x: [u8; 6]| (0..6).filter(|j| carries_two(x, *j)).count();
        shared(self.base) + shared(self.platform)
    }
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

fn each_order(order: &mut [usize; 6], fixed: usize, visit: &mut impl FnMut([usize; 6])) {
    if fixed == 6 {
        visit(*order);
        return;
    }
    for k in fixed..6 {
        order.swap(fixed, k);
        each_order(order, fixed + 1, visit);
        order.swap(fixed, k);
    }
}
