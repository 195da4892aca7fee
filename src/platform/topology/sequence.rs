//! Trilateration sequences and the virtual legs they need.
//!
//! A point with known distances to three placed points has two possible places. It has one if the four are points of
//! one body of known orientation. Source: Porta, Thomas, sec. II.

use nalgebra::Point3;

use super::graph::Topology;
use super::search::sequences;
use crate::manipulator::Manipulator;

/// A joint of a [`Topology`], numbered as in [`Topology::legs`], or of a design, numbered as in the design.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum JointIndex {
    /// On the base.
    Base(usize),
    /// On the platform.
    Platform(usize),
}

impl JointIndex {
    /// Whether both are on one body, so that the design gives their distance.
    #[must_use]
    pub fn same_body(self, other: Self) -> bool {
        matches!(self, Self::Base(_)) == matches!(other, Self::Base(_))
    }

    /// The two as a pair of a base and a platform joint; `None` if they are on one body.
    #[must_use]
    pub fn across(self, other: Self) -> Option<(usize, usize)> {
        match (self, other) {
            (Self::Base(a), Self::Platform(b)) | (Self::Platform(b), Self::Base(a)) => Some((a, b)),
            _ => None,
        }
    }

    /// The joint in the frame of its body.
    #[must_use]
    pub fn point(self, m: &Manipulator) -> Point3<f64> {
        match self {
            Self::Base(k) => m.base_joints()[k],
            Self::Platform(k) => m.platform_joints()[k],
        }
    }
}

/// One trilateration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// The placed joints.
    pub from: [JointIndex; 3],
    /// The joint to place.
    pub place: JointIndex,
    /// Whether all four are on one body: one place instead of two (in brackets in the paper).
    pub rigid: bool,
}

/// A sequence of steps that places all joints from distances.
///
/// One body, the *first*, is placed initially: its start triangle, and its other joints by rigid steps. Unoriented
/// steps then place three joints of the other body, and rigid ones the rest. The known distances are those of the legs
/// and between the three joints. As many of them as there are virtual legs remain unused: the closures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sequence {
    /// Required distances besides the legs, as pairs of a base and a platform joint, in the order in which steps need
    /// them.
    pub virtual_legs: Vec<(usize, usize)>,
    /// The triangle that is placed first: three joints of one body.
    pub start: [JointIndex; 3],
    /// One step for each other joint.
    pub steps: Vec<Step>,
    /// Known distances that no step uses, one for each virtual leg: conditions on the result.
    pub closures: Vec<[JointIndex; 2]>,
}

impl Sequence {
    /// The unoriented steps: always three, each with two possible places of its joint.
    pub fn unoriented(&self) -> impl Iterator<Item = &Step> {
        self.steps.iter().filter(|s| !s.rigid)
    }
}

impl Topology {
    /// A sequence with the fewest virtual legs, of these the least [`Nesting`](super::Nesting), of these the first.
    #[must_use]
    pub fn trilateration(self) -> Sequence {
        let all = (0..=3).map(|count| sequences(&self.legs(), count)).find(|found| !found.is_empty());
        let best = all.and_then(|all| all.into_iter().next());
        best.unwrap_or_else(|| unreachable!("three virtual legs are enough for six legs"))
    }

    /// Whether one joint carries three legs and one virtual leg is needed: position and orientation are then decoupled
    /// (Porta, Thomas, Table II).
    #[must_use]
    pub fn is_decoupled(self) -> bool {
        let legs = self.legs();
        let three = |joint: fn(&(usize, usize)) -> usize| {
            (0..6).any(|j| legs.iter().filter(|l| joint(l) == j).count() == 3)
        };
        (three(|l| l.0) || three(|l| l.1)) && self.trilateration().virtual_legs.len() == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::catalogue;

    #[test]
    fn the_search_finds_the_five_classes_of_porta_and_thomas() {
        let mut sizes = [0; 5];
        for n in catalogue() {
            let t = n.topology();
            let class = match (t.trilateration().virtual_legs.len(), t.is_decoupled()) {
                (0, false) => 0,
                (1, true) => 1,
                (1, false) => 2,
                (2, false) => 3,
                (3, false) => 4,
                other => panic!("{}: {other:?}", n.id()),
            };
            sizes[class] += 1;
        }
        assert_eq!(sizes, [10, 7, 13, 3, 1]);
    }

    /// For any numbering of the joints and order of the legs, every joint is placed once, from known distances. Every
    /// known distance is used once: by a step, within a body, or as a closure.
    fn check(legs: &[(usize, usize); 6], s: &Sequence) {
        let known = |x: JointIndex, y: JointIndex| {
            x.across(y).is_none_or(|pair| legs.contains(&pair) || s.virtual_legs.contains(&pair))
        };
        assert!(s.start[0].same_body(s.start[1]) && s.start[0].same_body(s.start[2]));
        let mut placed = s.start.to_vec();
        let mut used = Vec::new();
        for step in &s.steps {
            assert!(step.from.iter().all(|f| placed.contains(f)) && !placed.contains(&step.place));
            assert!(step.from.iter().all(|f| known(*f, step.place)));
            assert_eq!(step.rigid, step.from.iter().all(|f| f.same_body(step.place)));
            used.extend(step.from.iter().filter_map(|f| f.across(step.place)));
            placed.push(step.place);
        }
        for [x, y] in &s.closures {
            assert!(known(*x, *y) && placed.contains(x) && placed.contains(y));
            match x.across(*y) {
                Some(pair) => used.push(pair),
                None => assert!(!s.start[0].same_body(*x)),
            }
        }
        for pair in legs.iter().chain(&s.virtual_legs) {
            assert_eq!(used.iter().filter(|u| *u == pair).count(), 1);
        }
        for joint in legs.iter().flat_map(|l| [JointIndex::Base(l.0), JointIndex::Platform(l.1)]) {
            assert!(placed.contains(&joint));
        }
        assert_eq!((s.unoriented().count(), s.closures.len()), (3, s.virtual_legs.len()));
    }

    #[test]
    fn sequences_place_every_joint_once_and_use_every_distance_once() {
        for n in catalogue() {
            for t in [n.topology(), n.topology().exchanged()] {
                let legs = t.legs();
                let s = t.trilateration();
                check(&legs, &s);
                // unused joints in between, legs in another order
                let odd = [3, 0, 5, 1, 4, 2].map(|i| (2 * legs[i].0 + 1, 9 - legs[i].1));
                let count = s.virtual_legs.len();
                assert!(count == 0 || sequences(&odd, count - 1).is_empty(), "{}", n.id());
                let all = sequences(&odd, count);
                assert!(!all.is_empty(), "{}", n.id());
                all.iter().step_by(1 + all.len() / 50).for_each(|s| check(&odd, s));
            }
        }
    }
}
