//! How many legs come from where: six places whose generic legs are independent.

use super::pool::Pool;
use super::wishes::Wishes;
use crate::manipulator::Leg;

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

/// Patterns beyond this number are not looked at; no platform known has a tenth of them.
const MOST: usize = 50_000;
/// A generic leg less than this out of the span of others, of vectors of unit length, depends on them.
const INDEPENDENT: f64 = 1e-7;
/// Ends of generic legs nearer than this, relative to the size, are one joint.
const SAME: f64 = 1e-8;

struct Growing<'a> {
    pool: &'a Pool<'a>,
    list: Vec<Pattern>,
    size: f64,
}

/// All patterns that fill every hole.
pub(super) fn patterns(pool: &Pool, wishes: &Wishes, size: f64) -> Vec<Pattern> {
    let mut growing = Growing { pool, list: Vec::new(), size };
    growing.grow(0, &mut Vec::new(), &mut Vec::new());
    let all = wishes.holes.len();
    growing.list.retain(|p| (0..all).all(|h| p.places.iter().any(|k| pool.places[*k].fills.contains(&h))));
    growing.list
}

impl Growing<'_> {
    /// Adds legs from the places `from..` to those chosen; `basis` is orthonormal and spans their coefficient vectors.
    fn grow(&mut self, from: usize, chosen: &mut Vec<(usize, Leg)>, basis: &mut Vec<[f64; 6]>) {
        if self.list.len() >= MOST {
            return;
        }
        if chosen.len() == 6 {
            self.close(chosen);
            return;
        }
        for k in from..self.pool.places.len() {
            let copy = chosen.iter().filter(|(l, _)| *l == k).count();
            let Some((leg, c)) = self.pool.places[k].generic.get(copy) else { continue };
            let Some(rest) = outside(c, basis) else { continue };
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
