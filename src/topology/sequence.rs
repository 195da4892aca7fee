//! Trilateration sequences and the virtual legs they need.
//!
//! A point with known distances to three points that are in place has two places, one when the four are points of one body, whose
//! orientation is known. Placing points never stops a later one from being placed, so that the closure of a triangle under such steps
//! is found greedily. Source: Porta, Thomas, sec. II.

use super::graph::Topology;

/// A joint of a [`Topology`], numbered as in [`Topology::legs`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Joint {
    /// On the base.
    Base(usize),
    /// On the platform.
    Platform(usize),
}

/// One trilateration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Joints in place.
    pub from: [Joint; 3],
    /// The joint that is placed.
    pub place: Joint,
    /// All four are on one body: one place instead of two (in brackets in the paper).
    pub rigid: bool,
}

/// How to place all joints from distances.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sequence {
    /// Distances that have to be known beside the legs, as pairs of a base and a platform joint.
    pub virtual_legs: Vec<(usize, usize)>,
    /// The triangle that is laid out first.
    pub start: [Joint; 3],
    /// One step for each other joint.
    pub steps: Vec<Step>,
}

impl Topology {
    /// A sequence with the fewest virtual legs; of these the first, virtual legs and triangles in lexicographic order.
    #[must_use]
    pub fn trilateration(self) -> Sequence {
        let joints = self.joints();
        let (n, m) = (self.base_joints(), self.platform_joints());
        let legs = self.legs();
        let free: Vec<(usize, usize)> =
            (0..n).flat_map(|a| (0..m).map(move |b| (a, b))).filter(|pair| !legs.contains(pair)).collect();
        for count in 0..=free.len() {
            let found = first_choice(&free, count, &mut |chosen| {
                let known = |x: Joint, y: Joint| match (x, y) {
                    (Joint::Base(a), Joint::Platform(b)) | (Joint::Platform(b), Joint::Base(a)) => {
                        legs.contains(&(a, b)) || chosen.contains(&(a, b))
                    }
                    _ => true,
                };
                place_all(&joints, &known).map(|(start, steps)| Sequence {
                    virtual_legs: chosen.to_vec(),
                    start,
                    steps,
                })
            });
            if let Some(sequence) = found {
                return sequence;
            }
        }
        unreachable!("with all distances known every joint can be placed")
    }

    /// Whether one joint holds three legs and one virtual leg is needed: then position and orientation separate (Porta, Thomas,
    /// Table II).
    #[must_use]
    pub fn is_decoupled(self) -> bool {
        let legs = self.legs();
        let three = |joint: fn(&(usize, usize)) -> usize| {
            (0..6).any(|j| legs.iter().filter(|l| joint(l) == j).count() == 3)
        };
        (three(|l| l.0) || three(|l| l.1)) && self.trilateration().virtual_legs.len() == 1
    }

    /// Base joints, then platform joints.
    fn joints(self) -> Vec<Joint> {
        let base = (0..self.base_joints()).map(Joint::Base);
        base.chain((0..self.platform_joints()).map(Joint::Platform)).collect()
    }
}

fn same_body(x: Joint, y: Joint) -> bool {
    matches!((x, y), (Joint::Base(_), Joint::Base(_)) | (Joint::Platform(_), Joint::Platform(_)))
}

/// Every triple `i < j < k` below `n`, in lexicographic order.
fn triples(n: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..n).flat_map(move |i| (i + 1..n).flat_map(move |j| (j + 1..n).map(move |k| [i, j, k])))
}

/// The first triangle from which all joints are reached.
fn place_all(joints: &[Joint], known: &impl Fn(Joint, Joint) -> bool) -> Option<([Joint; 3], Vec<Step>)> {
    triples(joints.len()).find_map(|t| {
        let start = t.map(|i| joints[i]);
        if !(known(start[0], start[1]) && known(start[1], start[2]) && known(start[0], start[2])) {
            return None;
        }
        let mut placed = start.to_vec();
        let mut steps = Vec::new();
        while placed.len() < joints.len() {
            let step = next_step(joints, &placed, known)?;
            placed.push(step.place);
            steps.push(step);
        }
        Some((start, steps))
    })
}

/// A rigid step when there is one, otherwise the first.
fn next_step(joints: &[Joint], placed: &[Joint], known: &impl Fn(Joint, Joint) -> bool) -> Option<Step> {
    let mut best: Option<Step> = None;
    for place in joints.iter().copied().filter(|j| !placed.contains(j)) {
        for t in triples(placed.len()) {
            let from = t.map(|i| placed[i]);
            if from.iter().all(|f| known(*f, place)) {
                let rigid = from.iter().all(|f| same_body(*f, place));
                if rigid {
                    return Some(Step { from, place, rigid });
                }
                best = best.or(Some(Step { from, place, rigid }));
            }
        }
    }
    best
}

/// Tries the subsets of `count` elements in lexicographic order.
fn first_choice<T>(
    free: &[(usize, usize)],
    count: usize,
    attempt: &mut impl FnMut(&[(usize, usize)]) -> Option<T>,
) -> Option<T> {
    fn choose<T>(
        free: &[(usize, usize)],
        count: usize,
        chosen: &mut Vec<(usize, usize)>,
        attempt: &mut impl FnMut(&[(usize, usize)]) -> Option<T>,
    ) -> Option<T> {
        if count == 0 {
            return attempt(chosen);
        }
        (0..free.len()).find_map(|i| {
            chosen.push(free[i]);
            let found = choose(&free[i + 1..], count - 1, chosen, attempt);
            chosen.pop();
            found
        })
    }
    choose(free, count, &mut Vec::new(), attempt)
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

    #[test]
    fn sequences_place_every_joint_once_from_known_distances() {
        for n in catalogue() {
            let t = n.topology();
            let s = t.trilateration();
            let mut placed = s.start.to_vec();
            for step in &s.steps {
                assert!(step.from.iter().all(|f| placed.contains(f)) && !placed.contains(&step.place));
                let pair = |f: &Joint| match (*f, step.place) {
                    (Joint::Base(a), Joint::Platform(b)) | (Joint::Platform(b), Joint::Base(a)) => {
                        Some((a, b))
                    }
                    _ => None,
                };
                let measured = step.from.iter().filter_map(pair).collect::<Vec<_>>();
                assert!(measured.iter().all(|p| t.legs().contains(p) || s.virtual_legs.contains(p)));
                assert_eq!(step.rigid, measured.is_empty());
                placed.push(step.place);
            }
            assert_eq!(placed.len(), t.base_joints() + t.platform_joints(), "{}", n.id());
        }
    }
}
