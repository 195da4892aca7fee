//! The joints of a platform some legs of which were moved.

use nalgebra::Point3;

use crate::manipulator::{InvalidManipulator, Leg, Manipulator};

/// A new end nearer than this to a joint, relative to the size, is that joint: rounding of formulas, not of data.
const SNAP: f64 = 1e-12;

/// Where a joint of the new platform comes from; indices of joints of the same body of the old one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointOrigin {
    /// It is where it was.
    Kept(usize),
    /// All legs left the old joint, and this is where the first of them went.
    Displaced(usize),
    /// A leg left the old joint for this one.
    Split(usize),
}

/// The new platform.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled {
    /// Joints and legs. Two legs that have become the same leg are no platform.
    pub platform: Result<Manipulator, InvalidManipulator>,
    /// The six legs.
    pub legs: [Leg; 6],
    /// Origins of the base joints.
    pub base: Vec<JointOrigin>,
    /// Origins of the platform joints.
    pub platform_joints: Vec<JointOrigin>,
}

/// Joints of one body and which of them carries each leg.
struct Side {
    points: Vec<Point3<f64>>,
    origins: Vec<JointOrigin>,
    of_leg: [usize; 6],
}

/// Puts the legs that are given in the place of the old ones. An end that is within rounding of a joint shares it.
pub(super) fn assemble(m: &Manipulator, new: &[Option<Leg>; 6]) -> Assembled {
    let limit = SNAP * m.size();
    let pairs = m.pairs();
    let base = side(m.base_joints(), pairs.map(|p| p.0), new.map(|l| l.map(|l| l.base)), limit);
    let platform = side(m.platform_joints(), pairs.map(|p| p.1), new.map(|l| l.map(|l| l.platform)), limit);
    let pairs: [(usize, usize); 6] = std::array::from_fn(|k| (base.of_leg[k], platform.of_leg[k]));
    Assembled {
        legs: pairs.map(|(a, b)| Leg { base: base.points[a], platform: platform.points[b] }),
        platform: Manipulator::try_new(base.points, platform.points, pairs),
        base: base.origins,
        platform_joints: platform.origins,
    }
}

fn side(old: &[Point3<f64>], of_leg: [usize; 6], new: [Option<Point3<f64>>; 6], limit: f64) -> Side {
    let mut points = old.to_vec();
    let mut origins: Vec<JointOrigin> = (0..old.len()).map(JointOrigin::Kept).collect();
    let mut ends = of_leg;
    for (k, p) in new.iter().enumerate().filter_map(|(k, p)| p.map(|p| (k, p))) {
        let near = |q: &Point3<f64>| (p - q).norm() <= limit;
        // the leg's own joint first: two joints may stand at one place
        let found = if near(&points[of_leg[k]]) { Some(of_leg[k]) } else { points.iter().position(near) };
        ends[k] = found.unwrap_or_else(|| {
            points.push(p);
            origins.push(JointOrigin::Split(of_leg[k]));
            points.len() - 1
        });
    }
    // a joint that all legs left goes, and the first new one that came from it takes its place in the list
    let mut order: Vec<(usize, JointOrigin)> = Vec::new();
    for j in 0..old.len() {
        if ends.contains(&j) || !of_leg.contains(&j) {
            order.push((j, JointOrigin::Kept(j)));
        } else if let Some(l) = (old.len()..points.len()).find(|l| origins[*l] == JointOrigin::Split(j)) {
            order.push((l, JointOrigin::Displaced(j)));
        }
    }
    for l in old.len()..points.len() {
        if !order.iter().any(|(x, _)| *x == l) {
            order.push((l, origins[l]));
        }
    }
    Side {
        points: order.iter().map(|(l, _)| points[*l]).collect(),
        origins: order.iter().map(|(_, o)| *o).collect(),
        of_leg: ends.map(|e| order.iter().position(|(l, _)| *l == e).unwrap_or_default()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(r: f64, k: usize) -> Point3<f64> {
        let (s, c) = (std::f64::consts::TAU * k as f64 / 3.0).sin_cos();
        Point3::new(r * c, r * s, 0.0)
    }

    fn octahedral() -> Manipulator {
        let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        Manipulator::from_legs(hexagon.map(|(i, j)| Leg { base: corner(2.0, i), platform: corner(1.0, j) }))
            .unwrap()
    }

    #[test]
    fn a_leg_that_leaves_a_shared_joint_splits_it_and_the_last_one_displaces_it() {
        let m = octahedral();
        let there = Leg { base: Point3::new(0.1, 0.2, 0.0), platform: corner(1.0, 0) };
        let one = assemble(&m, &[Some(there), None, None, None, None, None]);
        assert_eq!(one.base[3], JointOrigin::Split(0));
        assert_eq!(one.platform_joints, [0, 1, 2].map(JointOrigin::Kept));
        assert_eq!(one.legs[0], there);
        // leg 6 was the other one at that base joint
        let mut legs = [Some(there), None, None, None, None, None];
        legs[5] = Some(Leg { base: Point3::new(-0.1, 0.2, 0.0), platform: corner(1.0, 2) });
        let both = assemble(&m, &legs);
        assert_eq!(
            both.base,
            [JointOrigin::Displaced(0), JointOrigin::Kept(1), JointOrigin::Kept(2), JointOrigin::Split(0)]
        );
        assert_eq!(both.legs[5], legs[5].unwrap());
        // onto another joint, off by rounding: shared
        let shared =
            Leg { base: corner(2.0, 2) + nalgebra::Vector3::new(1e-14, 0.0, 0.0), platform: corner(1.0, 0) };
        let third = assemble(&m, &[Some(shared), None, None, None, None, None]);
        assert_eq!(third.base.len(), 3);
        assert_eq!(third.legs[0].base, corner(2.0, 2));
        assert!(third.platform.is_ok());
        // onto another leg: no platform
        let same = Leg { base: corner(2.0, 1), platform: corner(1.0, 0) };
        assert!(assemble(&m, &[Some(same), None, None, None, None, None]).platform.is_err());
    }
}
