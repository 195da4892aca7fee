//! The hexagon of lines of an octahedral platform.
//!
//! The legs `0..6` in cyclic order are the vertices of a hexagon in the space of legs. Side `k` joins leg `k` and leg
//! `k + 1` (indices mod 6), which share a joint. It is the line of all legs with that joint and an end on the line
//! through the two other joints. On even sides (0, 2, 4) the platform joint is fixed and the base end slides along a
//! side of the base triangle. On odd sides the roles are exchanged.

use nalgebra::{Point3, Vector3};

use platform::manipulator::{Body, Leg, Octahedral};

/// The place of an inner point on a side: `t` runs from 0 at leg `side` to 1 at leg `side + 1`.
///
/// Printed `t1` .. `t6` by the number of the side from 1, and `u1` .. `u6` for the second inner point of a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Offset {
    /// Side of the hexagon, `0..6`.
    pub side: usize,
    /// Whether this is the second inner point of its side.
    pub second: bool,
}

impl std::fmt::Display for Offset {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", if self.second { 'u' } else { 't' }, self.side + 1)
    }
}

/// A joint of a member of the class.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum JointLabel {
    /// A corner of a triangle, printed `P1` .. `P6`: 0, 1, 2 on the base, 3, 4, 5 on the platform.
    Corner(usize),
    /// A joint on the line of a triangle side, printed `Q1` .. `Q6` by the side of the hexagon, `Q1b` for a second one.
    OnEdge(Offset),
}

impl std::fmt::Display for JointLabel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Corner(i) => write!(f, "P{}", i + 1),
            Self::OnEdge(o) => write!(f, "Q{}{}", o.side + 1, if o.second { "b" } else { "" }),
        }
    }
}

/// A point of the hexagon: a leg of an equivalent platform.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum HexagonPoint {
    /// An unchanged leg, `0..6` in cyclic order.
    Vertex(usize),
    /// A generic point of a side.
    Inner(Offset),
}

impl HexagonPoint {
    /// The joints of the leg, base then platform.
    #[must_use]
    pub fn joints(self) -> [JointLabel; 2] {
        match self {
            Self::Vertex(i) => Body::BOTH.map(|b| JointLabel::Corner(corner(b, i))),
            Self::Inner(o) => match sliding_body(o.side) {
                Body::Base => [JointLabel::OnEdge(o), JointLabel::Corner(corner(Body::Platform, o.side))],
                Body::Platform => [JointLabel::Corner(corner(Body::Base, o.side)), JointLabel::OnEdge(o)],
            },
        }
    }

    /// Whether the point lies on the closed side `side`.
    #[must_use]
    pub fn is_on_side(self, side: usize) -> bool {
        match self {
            Self::Vertex(i) => i == side || i == (side + 1) % 6,
            Self::Inner(o) => o.side == side,
        }
    }
}

/// The body on which the ends of the legs of a side slide: the base for even sides.
#[must_use]
pub fn sliding_body(side: usize) -> Body {
    if side.is_multiple_of(2) { Body::Base } else { Body::Platform }
}

/// The corner of `body` (0, 1, 2 base; 3, 4, 5 platform) at which leg `i` of the cycle ends:
/// `P1P4, P2P4, P2P5, P3P5, P3P6, P1P6`.
pub fn corner(body: Body, i: usize) -> usize {
    match body {
        Body::Base => i.div_ceil(2) % 3,
        Body::Platform => 3 + i / 2,
    }
}

/// The two corners of the edge along which the legs of a side slide: those of leg `side` and of leg `side + 1`.
pub fn edge(side: usize) -> [usize; 2] {
    let body = sliding_body(side);
    [corner(body, side), corner(body, (side + 1) % 6)]
}

/// Position of corner `i`, frame of its body.
pub(crate) fn corner_point(o: &Octahedral, i: usize) -> Point3<f64> {
    if i < 3 { o.base()[i] } else { o.platform()[i - 3] }
}

/// A side of the hexagon in place: the leg at offset `t` joins `fixed` to `start + t (end - start)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HexagonSide {
    /// The body whose joint slides along the edge.
    pub sliding: Body,
    /// The end of the leg on the other body.
    pub fixed: Point3<f64>,
    /// The joint at offset 0.
    pub start: Point3<f64>,
    /// The joint at offset 1.
    pub end: Point3<f64>,
    /// The vertex of the sliding triangle that is not on the edge.
    pub opposite: Point3<f64>,
}

impl HexagonSide {
    /// Side `k` of the hexagon of `o`.
    pub fn of(o: &Octahedral, k: usize) -> Self {
        let sliding = sliding_body(k);
        let own = |i: usize| corner_point(o, corner(sliding, (k + i) % 6));
        Self {
            sliding,
            fixed: corner_point(o, corner(sliding.other(), k)),
            start: own(0),
            end: own(1),
            opposite: own(3),
        }
    }

    fn shrunk(self, scale: f64) -> Self {
        let shrink = |p: Point3<f64>| Point3::from(p.coords / scale);
        let (fixed, start, end) = (shrink(self.fixed), shrink(self.start), shrink(self.end));
        Self { sliding: self.sliding, fixed, start, end, opposite: shrink(self.opposite) }
    }

    /// `end - start`.
    pub fn edge(&self) -> Vector3<f64> {
        self.end - self.start
    }

    /// Length of the edge.
    pub fn edge_length(&self) -> f64 {
        self.edge().norm()
    }

    /// The sliding joint at offset `t`.
    pub fn joint(&self, t: f64) -> Point3<f64> {
        self.start + self.edge() * t
    }

    /// The leg at offset `t`.
    pub fn leg(&self, t: f64) -> Leg {
        let (slid, fixed) = (self.joint(t), self.fixed);
        let (base, platform) = self.sliding.of(((slid, fixed), (fixed, slid)));
        Leg { base, platform }
    }
}

/// The six sides in cyclic order, lengths divided by `scale`.
pub fn sides(o: &Octahedral, scale: f64) -> [HexagonSide; 6] {
    std::array::from_fn(|k| HexagonSide::of(o, k).shrunk(scale))
}

/// Lengths `d_0 .. d_5` of the triangle sides that belong to the sides of the hexagon, design units.
#[must_use]
pub fn edge_lengths(o: &Octahedral) -> [f64; 6] {
    std::array::from_fn(|k| HexagonSide::of(o, k).edge_length())
}

#[cfg(test)]
pub(super) mod tests {

    use super::*;
    use crate::joint_free;
    use nalgebra::Rotation3;
    use platform::geom::Pose;
    use platform::manipulator::{Manipulator, SquaredLegLengths};

    pub(crate) fn example() -> Octahedral {
        let triangle = |edge: f64| {
            [(0.0, 0.0), (1.0, 0.0), (0.5, 0.75f64.sqrt())]
                .map(|(x, y)| Point3::new(edge * x, edge * y, 0.0))
                .to_vec()
        };
        let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        Octahedral::recognise(&Manipulator::try_new(triangle(12.0), triangle(6.0), legs).unwrap()).unwrap()
    }

    const T: [f64; 6] = [0.3, -0.4, 0.2, 1.3, 0.6, 0.8];

    #[test]
    fn legs_are_those_of_the_leg_map_module() {
        let o = example();
        let (m, map) = joint_free(&o, T).unwrap();
        let old = sides(&o, 1.0);
        let pose = Pose {
            rotation: Rotation3::from_euler_angles(0.2, 0.3, -0.5),
            position: Vector3::new(4.0, 1.0, 13.0),
        };
        let s: [f64; 6] = std::array::from_fn(|i| pose.squared_length(&old[i].leg(0.0)));
        let mapped = map.apply(&SquaredLegLengths::try_new(s).unwrap()).unwrap().get();
        for i in 0..6 {
            assert!((m.legs()[i].base - old[i].leg(T[i]).base).norm() < 1e-13);
            assert!((m.legs()[i].platform - old[i].leg(T[i]).platform).norm() < 1e-13);
            assert!((mapped[i] - pose.squared_length(&old[i].leg(T[i]))).abs() < 1e-9);
        }
    }

    #[test]
    fn side_ends_are_the_consecutive_legs_of_the_cycle() {
        let s = sides(&example(), 1.0);
        for i in 0..6 {
            assert_eq!(s[i].leg(1.0), s[(i + 1) % 6].leg(0.0));
        }
    }
}
