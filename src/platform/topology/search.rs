//! All trilateration sequences that place one body first.

use std::collections::BTreeSet;

use super::nesting::Nesting;
use super::sequence::{JointIndex, Sequence, Step};

type Legs = [(usize, usize); 6];

/// All sequences that need exactly `count` virtual legs and place every joint, least nested first. The six legs are
/// pairs of a base and a platform joint, with any numbers.
///
/// The start triangle of the first body consists of its first joints; rigid steps place its other joints. Rigid steps
/// also place the joints of the second body beyond three. Other choices of joints would be equivalent. Joints without a
/// leg are not placed.
#[must_use]
pub fn sequences(legs: &[(usize, usize); 6], count: usize) -> Vec<Sequence> {
    let base: BTreeSet<JointIndex> = legs.iter().map(|l| JointIndex::Base(l.0)).collect();
    let platform: BTreeSet<JointIndex> = legs.iter().map(|l| JointIndex::Platform(l.1)).collect();
    let mut found = Vec::new();
    for (first, second) in [(&base, &platform), (&platform, &base)] {
        if first.len() < 3 || second.len() < 3 {
            continue;
        }
        let first: Vec<JointIndex> = first.iter().copied().collect();
        let second: Vec<JointIndex> = second.iter().copied().collect();
        let mut search = SequenceSearch {
            legs,
            count,
            placed: first.clone(),
            first: &first,
            second: &second,
            ..SequenceSearch::new(legs)
        };
        search.extend(&mut found);
    }
    found.sort_by_cached_key(|s| Nesting::of(legs, s));
    found
}

/// A partly built sequence.
struct SequenceSearch<'a> {
    legs: &'a Legs,
    count: usize,
    first: &'a [JointIndex],
    second: &'a [JointIndex],
    placed: Vec<JointIndex>,
    virtual_legs: Vec<(usize, usize)>,
    steps: Vec<Step>,
}

impl<'a> SequenceSearch<'a> {
    fn new(legs: &'a Legs) -> Self {
        let (virtual_legs, steps, placed) = (Vec::new(), Vec::new(), Vec::new());
        Self { legs, count: 0, first: &[], second: &[], placed, virtual_legs, steps }
    }

    /// Tries every next unoriented step.
    fn extend(&mut self, found: &mut Vec<Sequence>) {
        if self.steps.len() == 3 {
            if self.virtual_legs.len() == self.count {
                found.push(self.finished());
            }
            return;
        }
        for place in self.second.iter().copied().filter(|j| !self.placed.contains(j)).collect::<Vec<_>>() {
            for from in triples(&self.placed) {
                let before = self.virtual_legs.len();
                let missing = from.iter().filter_map(|f| f.across(place));
                let missing = missing.filter(|p| !self.legs.contains(p)).collect::<Vec<_>>();
                // a step without any leg would be within the second body, and rigid
                if before + missing.len() > self.count || from.iter().all(|f| f.same_body(place)) {
                    continue;
                }
                self.virtual_legs.extend(missing);
                self.steps.push(Step { from, place, rigid: false });
                self.placed.push(place);
                self.extend(found);
                self.placed.pop();
                self.steps.pop();
                self.virtual_legs.truncate(before);
            }
        }
    }

    /// The sequence with its rigid steps and closures.
    fn finished(&self) -> Sequence {
        let rigid = |from: [JointIndex; 3], place: JointIndex| Step { from, place, rigid: true };
        let start = [self.first[0], self.first[1], self.first[2]];
        let three = [0, 1, 2].map(|k: usize| self.steps[k].place);
        let mut steps: Vec<Step> = self.first[3..].iter().map(|j| rigid(start, *j)).collect();
        steps.extend(&self.steps);
        steps.extend(self.second.iter().filter(|j| !three.contains(j)).map(|j| rigid(three, *j)));
        let used = |x: JointIndex, y: JointIndex| {
            self.steps
                .iter()
                .any(|s| (s.place == x && s.from.contains(&y)) || (s.place == y && s.from.contains(&x)))
        };
        let within = [[three[0], three[1]], [three[0], three[2]], [three[1], three[2]]];
        let legs = self.legs.iter().map(|l| [JointIndex::Base(l.0), JointIndex::Platform(l.1)]);
        let closures = within.into_iter().chain(legs).filter(|[x, y]| !used(*x, *y)).collect();
        Sequence { virtual_legs: self.virtual_legs.clone(), start, steps, closures }
    }
}

/// Every triple from `list`, in order.
#[must_use]
pub fn triples(list: &[JointIndex]) -> Vec<[JointIndex; 3]> {
    let n = list.len();
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    pairs.flat_map(|(i, j)| (j + 1..n).map(move |k| [list[i], list[j], list[k]])).collect()
}
