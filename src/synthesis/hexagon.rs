//! The hexagon of lines of an octahedral platform.
//!
//! The legs `0..6` in cyclic order are the vertices of a hexagon in the space of legs. Side `k` joins leg `k`
//! and leg `k + 1` (indices mod 6), which share a joint; it is the line of all legs that keep that joint and
//! end on the line through the two other joints. On even sides (0, 2, 4) the platform joint is fixed and the
//! base end slides along a side of the base triangle, on odd sides it is the other way round.

use nalgebra::Point3;

use crate::manipulator::Octahedral;

/// One of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "files",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Body {
    /// The fixed body.
    Base,
    /// The moving body.
    Platform,
}

impl std::fmt::Display for Body {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Base => "base",
            Self::Platform => "platform",
        })
    }
}

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
            Self::Vertex(i) => [Body::Base, Body::Platform].map(|b| JointLabel::Corner(corner(b, i))),
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
pub(crate) fn corner(body: Body, i: usize) -> usize {
    match body {
        Body::Base => i.div_ceil(2) % 3,
        Body::Platform => 3 + i / 2,
    }
}

/// The two corners between which the legs of a side slide, those of leg `side` and of leg `side + 1`.
pub(crate) fn edge(side: usize) -> [usize; 2] {
    let body = sliding_body(side);
    [corner(body, side), corner(body, (side + 1) % 6)]
}

/// Where corner `i` is, in the frame of its body.
pub(crate) fn corner_point(o: &Octahedral, i: usize) -> Point3<f64> {
    if i < 3 { o.base()[i] } else { o.platform()[i - 3] }
}

/// The joint at the fraction `t` of the triangle side that belongs to a side of the hexagon.
pub(crate) fn joint_on_edge(o: &Octahedral, side: usize, t: f64) -> Point3<f64> {
    let [x, y] = edge(side).map(|i| corner_point(o, i));
    x + (y - x) * t
}

/// Lengths `d_0 .. d_5` of the triangle sides that belong to the sides of the hexagon, design units.
#[must_use]
pub fn edge_lengths(o: &Octahedral) -> [f64; 6] {
    std::array::from_fn(|k| {
        let [x, y] = edge(k).map(|i| corner_point(o, i));
        (y - x).norm()
    })
}

/// `t = Delta / edge` on the six sides for one offset on all base edges and one on all platform edges.
///
/// This is the parametrisation of Rojas, Borras, Thomas, sec. 6: `Delta1 = base`, `Delta2 = platform`, in
/// design units, measured from leg `k` towards leg `k + 1`; negative offsets lie beyond leg `k`.
#[must_use]
pub fn offsets_from_distances(o: &Octahedral, base: f64, platform: f64) -> [f64; 6] {
    let d = edge_lengths(o);
    std::array::from_fn(|k| if sliding_body(k) == Body::Base { base / d[k] } else { platform / d[k] })
}
