//! How many legs come from where: six places whose generic legs are independent.

use super::pool::Pool;
use super::wishes::Wishes;
use crate::manipulator::{Leg, LegIndex};

/// Six places, in the order of the pool.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pattern {
    /// Indices of places.
    pub(super) places: [usize; 6],
    /// Legs that have one base joint whatever the parameters.
    pub(super) same_base: [[bool; 6]; 6],
    /// Likewise on the platform.
    pub(super) same_platform: [[bool; 6]; 6],
    /// Number of joints with two legs or more.
    pub(super) shared: usize,
}

/// Patterns beyond this number are not looked at, and then nothing is called impossible; no platform known has a tenth of them.
const MOST: usize = 50_000;
/// A generic leg less than this out of the span of others, of vectors of unit length, depends on them.
const INDEPENDENT: f64 = 1e-7;
/// Ends of generic legs nearer than this, relative to the size, are one joint.
const SAME: f64 = 1e-8;

/// What was found of the patterns.
#[derive(Debug)]
pub(super) struct Patterns {
    /// Those that fill every hole.
    pub(super) list: Vec<Pattern>,
    /// Whether there are no others: none was left out by the limit or by floating point alone, and no two joints were taken for one by nearness alone.
    pub(super) exhaustive: bool,
}

struct Growing<'a> {
    pool: &'a Pool<'a>,
    list: Vec<Pattern>,
    size: f64,
    exhaustive: bool,
}

/// All patterns that fill every hole.
pub(super) fn patterns(pool: &Pool, wishes: &Wishes, size: f64) -> Patterns {
    let mut growing = Growing { pool, list: Vec::new(), size, exhaustive: true };
    growing.grow(0, &mut Vec::new(), &mut Vec::new());
    let all = wishes.holes.len();
    growing.list.retain(|p| (0..all).all(|h| p.places.iter().any(|k| pool.places[*k].fills.contains(&h))));
    Patterns { list: growing.list, exhaustive: growing.exhaustive }
}

/// Whether no legs from these places are independent, whatever their parameters: some of them have their vectors in the span of fewer legs of the platform
/// (the easy half of Rado's theorem on independent transversals, 1942). Exact: no number is looked at.
fn always_dependent(supports: &[Option<&Vec<LegIndex>>]) -> bool {
    (1..1_u32 << supports.len()).any(|mask| {
        let part: Vec<_> = (0..supports.len()).filter(|i| mask >> i & 1 == 1).map(|i| supports[i]).collect();
        let spanning = LegIndex::all().filter(|l| part.iter().flatten().any(|s| s.contains(l))).count();
        part.iter().all(Option::is_some) && spanning < part.len()
    })
}

impl Growing<'_> {
    /// Adds legs from the places `from..` to those chosen; `basis` is orthonormal and spans their coefficient vectors.
    fn grow(&mut self, from: usize, chosen: &mut Vec<(usize, Leg)>, basis: &mut Vec<[f64; 6]>) {
        if self.list.len() >= MOST {
            self.exhaustive = false;
            return;
        }
        if chosen.len() == 6 {
            self.close(chosen);
            return;
        }
        for k in from..self.pool.places.len() {
            let copy = chosen.iter().filter(|(l, _)| *l == k).count();
            let Some((leg, c)) = self.pool.places[k].generic.get(copy) else { continue };
            let Some(rest) = outside(c, basis) else {
                let supports: Vec<_> = chosen.iter().map(|(l, _)| *l).chain([k]).collect();
                let supports: Vec<_> =
                    supports.iter().map(|l| self.pool.places[*l].support.as_ref()).collect();
                self.exhaustive = self.exhaustive && always_dependent(&supports);
                continue;
            };
            chosen.push((k, *leg));
            basis.push(rest);
            self.grow(k, chosen, basis);
            basis.pop();
            chosen.pop();
        }
    }

    fn close(&mut self, chosen: &[(usize, Leg)]) {
        let limit = SAME * self.size;
        let same = |f: &dyn Fn(&Leg) -> nalgebra::Point3<f64>| -> [[bool; 6]; 6] {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| i != j && (f(&chosen[i].1) - f(&chosen[j].1)).norm() <= limit)
            })
        };
        let (same_base, same_platform) = (same(&|l| l.base), same(&|l| l.platform));
        for (ends, table) in [(false, &same_base), (true, &same_platform)] {
            let held = |i: usize| self.pool.places[chosen[i].0].holds_joint(ends);
            self.exhaustive &= (0..6).all(|i| !table[i].contains(&true) || held(i));
        }
        self.list.push(Pattern {
            places: std::array::from_fn(|i| chosen[i].0),
            shared: shared(&same_base) + shared(&same_platform),
            same_base,
            same_platform,
        });
    }
}

/// Joints that carry two legs or more: legs that have a later, but no earlier partner.
pub(super) fn shared(same: &[[bool; 6]; 6]) -> usize {
    (0..6).filter(|i| same[*i][..*i].iter().all(|x| !x) && same[*i][*i + 1..].iter().any(|x| *x)).count()
}

/// The unit vector along what sticks out of the span of the basis.
fn outside(c: &[f64; 6], basis: &[[f64; 6]]) -> Option<[f64; 6]> {
    let norm = |v: &[f64; 6]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let length = norm(c);
    let mut rest = c.map(|x| x / length);
    for _ in 0..2 {
        for e in basis {
            let along: f64 = rest.iter().zip(e).map(|(x, y)| x * y).sum();
            rest.iter_mut().zip(e).for_each(|(x, y)| *x -= along * y);
        }
    }
    let left = norm(&rest);
    (left > INDEPENDENT).then(|| rest.map(|x| x / left))
}
