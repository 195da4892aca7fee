//! Legs with complex squared lengths, and the ways to close them on a shared joint.

use nalgebra::Vector3;
use num_complex::Complex64;

use super::circle::{Circle, complex};
use super::product::{Closure, Placed};
use super::rotations::{Arm, Three};
use crate::geom::ComplexPose;
use crate::manipulator::{Manipulator, SquaredLegLengths};

/// One leg, lengths in units of the design's size.
#[derive(Debug, Clone, Copy)]
pub(super) struct HiddenLeg {
    pub(super) base: Vector3<f64>,
    pub(super) platform: Vector3<f64>,
    pub(super) s: Complex64,
}

/// The legs of a design in units of its size.
pub(super) fn scaled(m: &Manipulator, s: &SquaredLegLengths) -> [HiddenLeg; 6] {
    let size = m.size();
    let (legs, s) = (m.legs(), s.get());
    std::array::from_fn(|i| HiddenLeg {
        base: legs[i].base.coords / size,
        platform: legs[i].platform.coords / size,
        s: Complex64::from(s[i] / (size * size)),
    })
}

/// A pose in units of the size as one of the design.
pub(super) fn unscaled(pose: &ComplexPose, m: &Manipulator) -> ComplexPose {
    ComplexPose { rotation: pose.rotation, position: pose.position * Complex64::from(m.size()) }
}

/// Which legs do what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Roles {
    /// The joint is one of the base: the platform is taken for fixed.
    pub(super) exchanged: bool,
    /// Two legs that share it.
    pub(super) pair: [usize; 2],
    /// Three legs for the rotation; those with a common joint on the other body first.
    pub(super) three: [usize; 3],
    /// The leg whose length closes.
    pub(super) last: usize,
}

impl Roles {
    /// All ways, those with four rotations first. Empty unless each body has at most one shared joint, of two legs: two virtual legs.
    pub(super) fn of(pairs: &[(usize, usize); 6]) -> Vec<Self> {
        let base = shared(pairs.map(|p| p.0));
        let platform = shared(pairs.map(|p| p.1));
        if base.len() > 1 || platform.len() > 1 || base.iter().chain(&platform).any(|legs| legs.len() > 2) {
            return Vec::new();
        }
        let mut out = Vec::new();
        for (exchanged, own, other) in [(false, &platform, &base), (true, &base, &platform)] {
            let Some([i, j]) = own.first().map(Vec::as_slice) else { continue };
            let rest: Vec<usize> = (0..6).filter(|k| k != i && k != j).collect();
            let common = other.first().filter(|c| c.iter().all(|k| rest.contains(k)));
            for last in rest.iter().copied().filter(|k| common.is_none_or(|c| !c.contains(k))) {
                let mut three: Vec<usize> = rest.iter().copied().filter(|k| *k != last).collect();
                three.sort_by_key(|k| !common.is_some_and(|c| c.contains(k)));
                out.push(Self { exchanged, pair: [*i, *j], three: [three[0], three[1], three[2]], last });
            }
        }
        out
    }

    /// `None` when joints coincide that must not.
    pub(super) fn closure(&self, legs: &[HiddenLeg; 6]) -> Option<Closure> {
        let ends = |i: usize| {
            let l = &legs[i];
            if self.exchanged { (l.platform, l.base) } else { (l.base, l.platform) }
        };
        let [i, j] = self.pair;
        let joint = ends(i).1;
        let circle = Circle::new([ends(i).0, ends(j).0], [legs[i].s, legs[j].s])?;
        let arm = |k: usize| Arm { base: ends(k).0, b: ends(k).1 - joint, s: legs[k].s };
        Some(Closure { circle, three: Three::new(self.three.map(arm))?, last: arm(self.last) })
    }

    /// The pose with the joint at `at`.
    pub(super) fn pose(
        &self,
        legs: &[HiddenLeg; 6],
        at: &Vector3<Complex64>,
        placed: &Placed,
    ) -> ComplexPose {
        let leg = &legs[self.pair[0]];
        let r = placed.rotation;
        if self.exchanged {
            // found is the pose of the base in the platform's frame: x_platform = r x_base + q
            let q = at - r * complex(&leg.base);
            ComplexPose { rotation: r.transpose(), position: -(r.tr_mul(&q)) }
        } else {
            ComplexPose { rotation: r, position: at - r * complex(&leg.platform) }
        }
    }
}

/// The legs of each joint that has several.
fn shared(joint: [usize; 6]) -> Vec<Vec<usize>> {
    let of = |j: usize| (0..6).filter(|k| joint[*k] == j).collect::<Vec<usize>>();
    let first = (0..6).filter(|k| joint[..*k].iter().all(|j| *j != joint[*k]));
    first.map(|k| of(joint[k])).filter(|legs| legs.len() > 1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_topologies_with_two_virtual_legs_have_ways_and_no_others() {
        use crate::topology::catalogue;
        for n in catalogue() {
            let t = n.topology();
            for legs in [t.legs(), t.legs().map(|l| (l.1, l.0))] {
                let ways = Roles::of(&legs);
                assert_eq!(ways.is_empty(), t.trilateration().virtual_legs.len() != 2, "{}", n.id());
                let count = match n.id().as_str() {
                    "T02" | "T06" => 4,
                    "T05" => 8,
                    _ => 0,
                };
                assert_eq!(ways.len(), count, "{}", n.id());
            }
        }
    }
}
