//! Recognition of the octahedral 3-3 platform: six legs in a zigzag between two triangles.

use nalgebra::Point3;
use thiserror::Error;

use super::{Body, LegIndex, Manipulator};

/// An octahedral manipulator in cyclic leg order.
///
/// With base triangle `P1 P2 P3` and platform triangle `P4 P5 P6` the cyclic legs are
/// `P1P4, P2P4, P2P5, P3P5, P3P6, P1P6` (Rojas, Borras, Thomas, Fig. 4). Consecutive legs share a joint, alternately on
/// the platform (legs 1-2, 3-4, 5-6) and on the base (2-3, 4-5, 6-1).
#[derive(Debug, Clone, PartialEq)]
pub struct Octahedral {
    order: [LegIndex; 6],
    base: [usize; 3],
    platform: [usize; 3],
    base_points: [Point3<f64>; 3],
    platform_points: [Point3<f64>; 3],
    /// Greatest distance of a coordinate of each corner from its double, on base and platform.
    radii: [[f64; 3]; 2],
}

/// Reasons why a manipulator is not octahedral.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NotOctahedral {
    /// A body does not have exactly three joints in use.
    #[error("the {body} has {count} joints in use; an octahedral platform has three on each body")]
    JointCount {
        /// The body.
        body: Body,
        /// Joints in use.
        count: usize,
    },
    /// A joint does not carry exactly two legs.
    #[error("{body} joint {} carries {count} legs; in an octahedral platform each joint carries two", .index + 1)]
    LegsAtJoint {
        /// The body.
        body: Body,
        /// 0-based joint index.
        index: usize,
        /// Legs at the joint.
        count: usize,
    },
    /// The legs fall into more than one cycle.
    #[error("the six legs do not form one closed zigzag between the two triangles")]
    NotOneCycle,
    /// The three joints of a body are on a line (within `1e-9` of its size).
    #[error("the three {body} joints are on one line: no triangle")]
    Collinear {
        /// The body.
        body: Body,
    },
}

/// `true` if the triangle's height is below `1e-9` of its longest side.
pub fn is_collinear(t: &[Point3<f64>; 3]) -> bool {
    let sides = [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let longest = sides.iter().map(nalgebra::Matrix::norm_squared).fold(0.0, f64::max);
    sides[0].cross(&sides[1]).norm() <= 1e-9 * longest
}

impl Octahedral {
    /// Recognises an octahedral manipulator in any leg order, by its shared joints.
    ///
    /// The cycle starts with the first leg. Its direction is such that the second leg shares the platform joint of the
    /// first.
    ///
    /// # Errors
    /// The reason why it is not octahedral.
    pub fn recognise(m: &Manipulator) -> Result<Self, NotOctahedral> {
        Self::recognise_from(m, LegIndex::FIRST)
    }

    /// [`recognise`](Self::recognise) with the cycle starting at any leg.
    ///
    /// # Errors
    /// The reason why it is not octahedral.
    pub fn recognise_from(m: &Manipulator, first: LegIndex) -> Result<Self, NotOctahedral> {
        let pairs = m.pairs();
        for body in Body::BOTH {
            let end = |l: &(usize, usize)| body.of(*l);
            let mut used: Vec<usize> = pairs.iter().map(end).collect();
            used.sort_unstable();
            used.dedup();
            if used.len() != 3 {
                return Err(NotOctahedral::JointCount { body, count: used.len() });
            }
            for index in used {
                let count = pairs.iter().filter(|l| end(l) == index).count();
                if count != 2 {
                    return Err(NotOctahedral::LegsAtJoint { body, index, count });
                }
            }
        }
        let mut cycle = [first.get(); 6];
        for k in 1..6 {
            let here = cycle[k - 1];
            let next = (0..6).find(|&i| {
                i != here
                    && if k % 2 == 1 { pairs[i].1 == pairs[here].1 } else { pairs[i].0 == pairs[here].0 }
            });
            cycle[k] = next.filter(|i| !cycle[..k].contains(i)).ok_or(NotOctahedral::NotOneCycle)?;
        }
        let base = [pairs[cycle[0]].0, pairs[cycle[1]].0, pairs[cycle[3]].0];
        let platform = [pairs[cycle[0]].1, pairs[cycle[2]].1, pairs[cycle[4]].1];
        let base_points = base.map(|i| m.base_joints()[i]);
        let platform_points = platform.map(|i| m.platform_joints()[i]);
        for (body, t) in [(Body::Base, &base_points), (Body::Platform, &platform_points)] {
            if is_collinear(t) {
                return Err(NotOctahedral::Collinear { body });
            }
        }
        let order =
            cycle.map(|i| LegIndex::new(i).unwrap_or_else(|| unreachable!("cycle indices are below 6")));
        let radii = [
            [cycle[0], cycle[1], cycle[3]].map(|leg| m.end_radius(leg, Body::Base)),
            [cycle[0], cycle[2], cycle[4]].map(|leg| m.end_radius(leg, Body::Platform)),
        ];
        Ok(Self { order, base, platform, base_points, platform_points, radii })
    }

    /// Cyclic order: leg `order()[k]` of the design is leg `k` of the cycle.
    #[must_use]
    pub fn order(&self) -> [LegIndex; 6] {
        self.order
    }

    /// Indices of the base joints `P1, P2, P3` in the manipulator.
    #[must_use]
    pub fn base_indices(&self) -> [usize; 3] {
        self.base
    }

    /// Indices of the platform joints `P4, P5, P6` in the manipulator.
    #[must_use]
    pub fn platform_indices(&self) -> [usize; 3] {
        self.platform
    }

    /// `P1, P2, P3`, base frame.
    #[must_use]
    pub fn base(&self) -> [Point3<f64>; 3] {
        self.base_points
    }

    /// `P4, P5, P6`, platform frame.
    #[must_use]
    pub fn platform(&self) -> [Point3<f64>; 3] {
        self.platform_points
    }

    /// Greatest distances of the coordinates of the corners of `body` from those of [`base`](Self::base) or
    /// [`platform`](Self::platform).
    pub fn corner_radii(&self, body: Body) -> [f64; 3] {
        self.radii[body.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn design(legs: [(usize, usize); 6]) -> Manipulator {
        let t = |r: f64| vec![Point3::new(r, 0.0, 0.0), Point3::new(-r, r, 0.0), Point3::new(-r, -r, 0.0)];
        Manipulator::try_new(t(2.0), t(1.0), legs).unwrap()
    }

    #[test]
    fn finds_the_cycle_in_any_leg_order() {
        let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        for order in [[0, 1, 2, 3, 4, 5], [3, 0, 5, 2, 4, 1], [5, 4, 3, 2, 1, 0]] {
            let m = design(legs).reordered(order).unwrap();
            let o = Octahedral::recognise(&m).unwrap();
            let ends = o.order().map(|i| m.legs()[i.get()]);
            for k in 0..3 {
                assert_eq!(ends[2 * k].platform, ends[2 * k + 1].platform);
                assert_eq!(ends[2 * k + 1].base, ends[(2 * k + 2) % 6].base);
                assert_eq!(ends[2 * k].platform, o.platform()[k]);
            }
            assert_eq!((ends[0].base, ends[1].base, ends[3].base), o.base().into());
            for first in LegIndex::all() {
                let from = Octahedral::recognise_from(&m, first).unwrap().order();
                let joined = |k: usize| m.joints_of(from[2 * k]).1 == m.joints_of(from[2 * k + 1]).1;
                assert!(from[0] == first && (0..3).all(joined));
            }
        }
    }

    #[test]
    fn says_why_other_platforms_are_not_octahedral() {
        // two legs from each vertex, but joined 2-2-2 in parallel: cycles of two are identical legs. So use 4 + 2,
        // which has a joint with three legs.
        let m = design([(0, 0), (0, 1), (1, 0), (1, 1), (2, 1), (2, 2)]);
        assert!(matches!(Octahedral::recognise(&m), Err(NotOctahedral::LegsAtJoint { .. })));
        let line = vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(2.0, 0.0, 0.0)];
        let t = vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)];
        let m = Manipulator::try_new(line, t, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap();
        assert_eq!(Octahedral::recognise(&m), Err(NotOctahedral::Collinear { body: Body::Base }));
    }
}
