//! Joints, legs and the six-legged manipulator.

use nalgebra::{Point3, Vector3};
use thiserror::Error;

use std::sync::Arc;

use super::body::Body;
use super::values::JointValues;

/// A leg number, 0-based in code and printed 1-based ("leg 3") as the papers count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LegIndex(u8);

impl LegIndex {
    /// Leg 1.
    pub const FIRST: Self = Self(0);

    /// The leg with the 0-based index `i`, or `None` unless `i < 6`.
    #[must_use]
    pub fn new(i: usize) -> Option<Self> {
        (i < 6).then_some(Self(i as u8))
    }

    /// 0-based index.
    #[must_use]
    pub fn get(self) -> usize {
        usize::from(self.0)
    }

    /// All six legs in order.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..6).map(Self)
    }
}

impl std::fmt::Display for LegIndex {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "leg {}", self.0 + 1)
    }
}

/// Index of a base joint of a [`Manipulator`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BaseJoint(pub usize);

/// Index of a platform joint of a [`Manipulator`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlatformJoint(pub usize);

/// The two ends of a leg: `a` in the base frame and `b` in the platform frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// Joint centre on the base, base frame.
    pub base: Point3<f64>,
    /// Joint centre on the platform, platform frame.
    pub platform: Point3<f64>,
}

impl Leg {
    /// The end on `body`, in the frame of that body.
    #[must_use]
    pub fn end(&self, body: Body) -> Point3<f64> {
        body.of((self.base, self.platform))
    }
}

/// Six legs between the joints of a base and the joints of a platform.
///
/// Joints are separate from legs. A *shared* joint (one ball joint with two or more legs) thus differs from two joints
/// at the same place.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_platform::{geom, manipulator, topology}; } pub mod prelude { pub use equipod_platform::geom::*; } }
/// use equipod::methods::manipulator::{Leg, Manipulator};
/// use nalgebra::Point3;
/// let legs = std::array::from_fn(|i| {
///     let (s, c) = (f64::from(i as u8)).sin_cos();
///     Leg { base: Point3::new(2.0 * c, 2.0 * s, 0.0), platform: Point3::new(c, -s, 0.1) }
/// });
/// let hexapod = Manipulator::from_legs(legs)?;
/// assert_eq!(hexapod.base_joints().len(), 6);
/// # Ok::<(), equipod::methods::manipulator::InvalidManipulator>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Manipulator {
    base: Vec<Point3<f64>>,
    platform: Vec<Point3<f64>>,
    pub(super) legs: [(usize, usize); 6],
    size: f64,
    /// The exact coordinates of the joints if they differ from the doubles.
    pub(super) values: Option<Arc<JointValues>>,
    /// Whether constructions give the joints, without plain numbers that look rounded: all are exact as given.
    pub(super) constructed: bool,
}

/// Reasons why joints and legs form no manipulator.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidManipulator {
    /// A coordinate is NaN or infinite.
    #[error("{body} joint {} has a coordinate that is not a finite number", .index + 1)]
    NonFinite {
        /// The body.
        body: Body,
        /// 0-based index of the joint, or of its leg if joints were given by legs; messages count from 1.
        index: usize,
    },
    /// A leg names a joint that does not exist.
    #[error("{leg} names {body} joint {}, but there are only {count}", .index + 1)]
    MissingJoint {
        /// The leg.
        leg: LegIndex,
        /// The body.
        body: Body,
        /// The requested index.
        index: usize,
        /// The number of joints of the body.
        count: usize,
    },
    /// An order of legs lacks some leg.
    #[error("{order:?} is no order of six legs, which are counted from 0")]
    NotAnOrder {
        /// The order given.
        order: [usize; 6],
    },
    /// All joints of each body coincide, so the design has no size.
    #[error("all joints of each body coincide: the design has no size")]
    NoSize,
    /// A coordinate whose square, and with it every squared leg length, overflows double precision.
    #[error(
        "{body} joint {} has a coordinate of {coordinate:e}, whose square overflows double precision", .index + 1
    )]
    TooFar {
        /// The body.
        body: Body,
        /// 0-based index of the joint, or of its leg if joints were given by legs; messages count from 1.
        index: usize,
        /// The coordinate.
        coordinate: f64,
    },
    /// The joints differ, but the squares of their distances underflow double precision.
    #[error(
        "the joints of each body are so near to each other that the squares of their distances underflow double precision"
    )]
    TooSmall,
}

/// Greatest coordinate for which squared leg lengths, sums of three squares of differences, are finite:
/// `12 x^2 < 2^1024`.
const FARTHEST: f64 = 3.8e153;

/// Refuses coordinates that are not finite or too large.
fn check_coordinates(body: Body, joints: &[Point3<f64>]) -> Result<(), InvalidManipulator> {
    if let Some(index) = joints.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        return Err(InvalidManipulator::NonFinite { body, index });
    }
    for (index, joint) in joints.iter().enumerate() {
        if let Some(&coordinate) = joint.iter().find(|x| x.abs() > FARTHEST) {
            return Err(InvalidManipulator::TooFar { body, index, coordinate });
        }
    }
    Ok(())
}

impl Manipulator {
    /// Builds a manipulator from joints and six pairs (base joint, platform joint) in leg order.
    ///
    /// # Errors
    /// The first violation found; see [`InvalidManipulator`].
    pub fn try_new(
        base: Vec<Point3<f64>>,
        platform: Vec<Point3<f64>>,
        legs: [(usize, usize); 6],
    ) -> Result<Self, InvalidManipulator> {
        check_coordinates(Body::Base, &base)?;
        check_coordinates(Body::Platform, &platform)?;
        for (leg, &(a, b)) in LegIndex::all().zip(&legs) {
            let ends = [(Body::Base, a, base.len()), (Body::Platform, b, platform.len())];
            for (body, index, count) in ends {
                if index >= count {
                    return Err(InvalidManipulator::MissingJoint { leg, body, index, count });
                }
            }
        }
        let a: Vec<_> = legs.iter().map(|l| base[l.0]).collect();
        let b: Vec<_> = legs.iter().map(|l| platform[l.1]).collect();
        let size = spread(&a).max(spread(&b));
        if [&a, &b].iter().all(|ends| ends.iter().all(|p| *p == ends[0])) {
            return Err(InvalidManipulator::NoSize);
        }
        if !(size * size).is_normal() {
            return Err(InvalidManipulator::TooSmall);
        }
        Ok(Self { base, platform, legs, size, values: None, constructed: false })
    }

    /// Builds a manipulator from six legs; joints with exactly equal coordinates become one shared joint.
    ///
    /// # Errors
    /// The errors of [`Manipulator::try_new`].
    pub fn from_legs(legs: [Leg; 6]) -> Result<Self, InvalidManipulator> {
        // before equal joints are merged, so that the index is that of the leg
        check_coordinates(Body::Base, &legs.map(|l| l.base))?;
        check_coordinates(Body::Platform, &legs.map(|l| l.platform))?;
        let mut base: Vec<Point3<f64>> = Vec::new();
        let mut platform: Vec<Point3<f64>> = Vec::new();
        let index_of = |list: &mut Vec<Point3<f64>>, p: Point3<f64>| {
            list.iter().position(|q| *q == p).unwrap_or_else(|| {
                list.push(p);
                list.len() - 1
            })
        };
        let pairs = legs.map(|l| (index_of(&mut base, l.base), index_of(&mut platform, l.platform)));
        Self::try_new(base, platform, pairs)
    }

    /// The six legs with their coordinates.
    #[must_use]
    pub fn legs(&self) -> [Leg; 6] {
        self.legs.map(|(a, b)| Leg { base: self.base[a], platform: self.platform[b] })
    }

    /// The joints of leg `i`.
    #[must_use]
    pub fn joints_of(&self, i: LegIndex) -> (BaseJoint, PlatformJoint) {
        let (a, b) = self.legs[i.get()];
        (BaseJoint(a), PlatformJoint(b))
    }

    /// Base and platform joint index of every leg, in leg order.
    #[must_use]
    pub fn pairs(&self) -> [(usize, usize); 6] {
        self.legs
    }

    /// The joints of `body`, in its own frame.
    #[must_use]
    pub fn joints(&self, body: Body) -> &[Point3<f64>] {
        body.of((&self.base, &self.platform))
    }

    /// Indices of the joints of `body` that carry legs, ascending.
    #[must_use]
    pub fn used_joints(&self, body: Body) -> Vec<usize> {
        let used = self.legs.map(|pair| body.of(pair));
        (0..self.joints(body).len()).filter(|i| used.contains(i)).collect()
    }

    /// The least distance of two joints of `body` that carry legs, with the indices of the first such pair. `None` if
    /// one joint carries all legs.
    #[must_use]
    pub fn nearest_joints(&self, body: Body) -> Option<(f64, [usize; 2])> {
        let (used, joints) = (self.used_joints(body), self.joints(body));
        let mut nearest: Option<(f64, [usize; 2])> = None;
        for (k, &j) in used.iter().enumerate() {
            for &i in &used[..k] {
                let distance = (joints[j] - joints[i]).norm();
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, [i, j]));
                }
            }
        }
        nearest
    }

    /// The number of joints of base and platform with more than one leg.
    pub fn shared_joints(&self) -> usize {
        let shared = |end: fn(&(usize, usize)) -> usize| {
            let mut ends: Vec<usize> = self.legs.iter().map(end).collect();
            ends.sort_unstable();
            ends.chunk_by(PartialEq::eq).filter(|legs| legs.len() > 1).count()
        };
        shared(|leg| leg.0) + shared(|leg| leg.1)
    }

    /// Base joints, base frame.
    #[must_use]
    pub fn base_joints(&self) -> &[Point3<f64>] {
        &self.base
    }

    /// Platform joints, platform frame.
    #[must_use]
    pub fn platform_joints(&self) -> &[Point3<f64>] {
        &self.platform
    }

    /// The reference length of every tolerance. It is the greatest distance of a leg end from the centroid of the leg
    /// ends of its body, over both bodies. Always positive, in design units.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Means of the six leg ends on the base and on the platform, each in the frame of its body. A joint with two legs
    /// counts twice.
    pub fn mean_leg_ends(&self) -> [Vector3<f64>; 2] {
        let legs = self.legs();
        let mean = |end: fn(&Leg) -> Vector3<f64>| legs.iter().map(end).sum::<Vector3<f64>>() / 6.0;
        [mean(|l| l.base.coords), mean(|l| l.platform.coords)]
    }

    /// Greatest distance of a joint of a body from the centroid of its joints, design units.
    #[must_use]
    pub fn joints_radius(&self, body: Body) -> f64 {
        spread(self.joints(body))
    }

    /// RMS distance of the platform leg ends from their centroid, design units: the default characteristic length of
    /// [`jacobian`](super::jacobian()). It is [`size`](Self::size) if all platform joints coincide.
    #[must_use]
    pub fn platform_rms_radius(&self) -> f64 {
        let b: Vec<_> = self.legs.iter().map(|l| self.platform[l.1]).collect();
        let c = centroid(&b);
        let r = (b.iter().map(|p| (p.coords - c).norm_squared()).sum::<f64>() / 6.0).sqrt();
        if r > 0.0 { r } else { self.size }
    }

    /// The same manipulator with the legs in another order: new leg `i` is old leg `order[i]`.
    ///
    /// # Errors
    /// [`InvalidManipulator::NotAnOrder`].
    pub fn reordered(&self, order: [usize; 6]) -> Result<Self, InvalidManipulator> {
        if (0..6).any(|leg| !order.contains(&leg)) {
            return Err(InvalidManipulator::NotAnOrder { order });
        }
        Ok(Self { legs: order.map(|i| self.legs[i]), ..self.clone() })
    }
}

fn centroid(points: &[Point3<f64>]) -> Vector3<f64> {
    points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / points.len() as f64
}

fn spread(points: &[Point3<f64>]) -> f64 {
    let c = centroid(points);
    points.iter().map(|p| (p.coords - c).norm()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(r: f64) -> Vec<Point3<f64>> {
        vec![Point3::new(r, 0.0, 0.0), Point3::new(-r, r, 0.0), Point3::new(-r, -r, 0.0)]
    }

    #[test]
    fn refuses_missing_joint_nan_and_zero_size() {
        let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        let ok = Manipulator::try_new(triangle(2.0), triangle(1.0), hexagon);
        assert!(ok.is_ok());
        let mut missing = hexagon;
        missing[3].1 = 3;
        assert!(matches!(
            Manipulator::try_new(triangle(2.0), triangle(1.0), missing),
            Err(InvalidManipulator::MissingJoint { index: 3, count: 3, .. })
        ));
        let mut twice = hexagon;
        twice[5] = twice[0];
        let twice = Manipulator::try_new(triangle(2.0), triangle(1.0), twice).unwrap();
        assert_eq!(twice.pairs()[5], (0, 0), "two legs of one line can be asked about");
        for order in [[0, 1, 2, 3, 4, 4], [0, 1, 2, 3, 4, 6]] {
            assert_eq!(twice.reordered(order), Err(InvalidManipulator::NotAnOrder { order }));
        }
        let mut nan = triangle(1.0);
        nan[1].y = f64::NAN;
        assert!(matches!(
            Manipulator::try_new(triangle(2.0), nan, hexagon),
            Err(InvalidManipulator::NonFinite { body: Body::Platform, index: 1 })
        ));
        assert_eq!(
            Manipulator::try_new(triangle(0.0), triangle(0.0), hexagon),
            Err(InvalidManipulator::NoSize)
        );
    }

    /// Bodies of every magnitude of a double: accepted with a size that can be squared, or refused with the reason.
    #[test]
    fn size_can_be_squared() {
        let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        for exponent in (-323..=308).step_by(7).chain([-160, -155, 153, 154, 160, 308]) {
            let r: f64 = format!("1e{exponent}").parse().unwrap();
            for (base, platform) in [(r, r), (r, 0.5 * r), (r, 0.0), (0.0, r)] {
                match Manipulator::try_new(triangle(base), triangle(platform), hexagon) {
                    Ok(m) => {
                        assert!((m.size() * m.size()).is_normal() && m.size() >= r, "1e{exponent}");
                        let far = m.legs().map(|l| (l.base - l.platform).norm_squared());
                        assert!(far.iter().all(|s| s.is_finite()), "1e{exponent}");
                    }
                    Err(InvalidManipulator::TooFar { coordinate, .. }) => {
                        assert!(coordinate.abs() > 1e153, "1e{exponent}");
                    }
                    Err(InvalidManipulator::TooSmall) => assert!(r < 1e-153, "1e{exponent}"),
                    Err(other) => panic!("1e{exponent}: {other}"),
                }
            }
        }
        let sizes =
            |r: f64| Manipulator::try_new(triangle(r), triangle(1.0), hexagon).unwrap_err().to_string();
        assert_eq!(
            sizes(f64::MAX),
            "base joint 1 has a coordinate of 1.7976931348623157e308, whose square overflows double precision"
        );
    }

    #[test]
    fn legs_with_equal_coordinates_share_a_joint() {
        let b = triangle(2.0);
        let p = triangle(1.0);
        let legs =
            [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)].map(|(i, j)| Leg { base: b[i], platform: p[j] });
        let m = Manipulator::from_legs(legs).unwrap();
        assert_eq!((m.base_joints().len(), m.platform_joints().len()), (3, 3));
        assert_eq!(m.legs(), legs);
    }
}
