//! Proved upper bounds on the number of isolated finite poses of platforms with special joints.
//!
//! Statements and proofs: `docs/theory/completeness.md`. Which joints coincide and which are coplanar is
//! decided exactly, on the doubles as they are.

use crate::manipulator::Manipulator;
use crate::num::exact::affine_rank;

type Point = [f64; 3];

/// A bound with the reason, in words for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ClassBound {
    pub(super) count: usize,
    pub(super) reason: String,
}

/// The smallest bound known for this platform below 40, if any.
pub(super) fn class_bound(m: &Manipulator) -> Option<ClassBound> {
    let legs = m.legs().map(|l| (Point::from(l.base.coords), Point::from(l.platform.coords)));
    let turned = legs.map(|(a, b)| (b, a));
    let bodies = [(legs, "platform"), (turned, "base")];
    let bounds = bodies.iter().flat_map(|(legs, body)| {
        let joints = Joints::of(legs);
        planar_bound(&joints, body).into_iter().chain(triple_bound(&joints, body))
    });
    bounds.filter(|b| b.count < 40).min_by_key(|b| b.count)
}

/// Joints of one body with the opposite ends of their legs.
struct Joints(Vec<(Point, Vec<Point>)>);

impl Joints {
    fn of(legs: &[(Point, Point); 6]) -> Self {
        let mut joints: Vec<(Point, Vec<Point>)> = Vec::new();
        for (far, near) in legs {
            // adding zero makes -0 and 0 one number
            let same =
                |p: &Point| p.iter().zip(near).all(|(x, y)| (x + 0.0).to_bits() == (y + 0.0).to_bits());
            match joints.iter_mut().find(|(p, _)| same(p)) {
                Some((_, ends)) => ends.push(*far),
                None => joints.push((*near, vec![*far])),
            }
        }
        Self(joints)
    }
}

/// Bound for a body with exactly coplanar joints, from the places of three of them.
fn planar_bound(joints: &Joints, body: &str) -> Option<ClassBound> {
    let points: Vec<Point> = joints.0.iter().map(|(p, _)| *p).collect();
    if affine_rank(&points)? != 2 {
        return None;
    }
    let mut best: Option<(usize, [usize; 3])> = None;
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            for k in j + 1..points.len() {
                if affine_rank(&[points[i], points[j], points[k]]) != Some(2) {
                    continue;
                }
                let legs = [i, j, k].map(|q| joints.0[q].1.len());
                let count = three_points(legs);
                if count > 0 && best.is_none_or(|(b, _)| count < b) {
                    best = Some((count, legs));
                }
            }
        }
    }
    let (count, legs) = best?;
    let reason = format!(
        "the {body} has coplanar joints, three of which carry {}, {} and {} legs: multihomogeneous Bezout number of the \
         places of these three",
        legs[0], legs[1], legs[2]
    );
    Some(ClassBound { count, reason })
}

/// Bound for three legs at one joint.
fn triple_bound(joints: &Joints, body: &str) -> Option<ClassBound> {
    let triple = joints.0.iter().any(|(_, ends)| ends.len() == 3 && affine_rank(ends) == Some(2));
    triple.then(|| ClassBound {
        count: 16,
        reason: format!(
            "three legs meet in a {body} joint, which has at most two places; three quadrics in the quaternion \
             have at most eight isolated solutions for each"
        ),
    })
}

/// Multihomogeneous Bezout number of nine equations for the places of three joints that carry `legs` legs.
///
/// Joint `k`: `legs[k] - 1` linear equations and one sphere; three distances of bidegree (1, 1); every other
/// leg is linear in the three places together. It is the coefficient of `h0^3 h1^3 h2^3`.
fn three_points(legs: [usize; 3]) -> usize {
    let mut forms: Vec<[usize; 3]> = vec![[1, 1, 0], [0, 1, 1], [1, 0, 1]];
    for (k, n) in legs.into_iter().enumerate() {
        for i in 0..n {
            let mut form = [0; 3];
            form[k] = if i == 0 { 2 } else { 1 };
            forms.push(form);
        }
    }
    forms.resize(9, [1, 1, 1]);
    let mut product = [[[0usize; 4]; 4]; 4];
    product[0][0][0] = 1;
    for f in forms {
        let old = product;
        for a in 0..4 {
            for b in 0..4 {
                for c in 0..4 {
                    let x = if a > 0 { f[0] * old[a - 1][b][c] } else { 0 };
                    let y = if b > 0 { f[1] * old[a][b - 1][c] } else { 0 };
                    let z = if c > 0 { f[2] * old[a][b][c - 1] } else { 0 };
                    product[a][b][c] = x + y + z;
                }
            }
        }
    }
    product[3][3][3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manipulator::Leg;
    use nalgebra::Point3;

    fn joints(k: u32, z: f64) -> Point3<f64> {
        let t = f64::from(k);
        Point3::new((1.3 * t).cos() + 0.1 * t, (1.7 * t).sin(), z * (0.9 * t).cos())
    }

    fn platform(base: [u32; 6], platform: [u32; 6], height: f64) -> Manipulator {
        let leg = |i: usize| Leg { base: joints(base[i], 1.0), platform: joints(platform[i] + 7, height) };
        Manipulator::from_legs(std::array::from_fn(leg)).unwrap()
    }

    #[test]
    fn bezout_numbers_of_three_joints() {
        assert_eq!(three_points([2, 2, 2]), 16);
        assert_eq!(three_points([3, 2, 1]), 8);
        assert_eq!(three_points([2, 2, 1]), 32);
        assert_eq!(three_points([3, 1, 1]), 16);
        assert_eq!(three_points([1, 1, 1]), 240);
    }

    #[test]
    fn bounds_follow_the_shared_joints_and_the_planes() {
        let all = [0, 1, 2, 3, 4, 5];
        let count = |base, feet, h| class_bound(&platform(base, feet, h)).map(|b| b.count);
        assert_eq!(count(all, all, 0.0), None, "240 says nothing");
        assert_eq!(count(all, [0, 0, 1, 1, 2, 2], 1.0), Some(16), "three points are coplanar");
        assert_eq!(count(all, [0, 0, 1, 1, 2, 3], 0.0), Some(32));
        assert_eq!(count(all, [0, 0, 1, 1, 2, 3], 1.0), None, "not coplanar");
        assert_eq!(count([0, 0, 1, 1, 2, 2], all, 1.0), Some(16), "base and platform exchanged");
        assert_eq!(count(all, [0, 0, 0, 1, 2, 3], 1.0), Some(16), "triple joint");
        assert_eq!(count([0, 1, 2, 0, 1, 0], [0, 0, 0, 1, 1, 2], 1.0), Some(8));
    }
}
