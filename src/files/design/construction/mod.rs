//! Definitions of joints in a design: coordinates as expressions, points on lines, polar coordinates, rotated and
//! mirrored copies.

mod cranks;
pub(super) mod expression;
mod origins;
pub(super) mod resolve;
#[cfg(test)]
mod tests;

use std::fmt;

use nalgebra::Point3;

pub use self::cranks::CrankLimits;
pub(super) use self::cranks::{CrankCopy, PARTS, WrittenCrank, WrittenCranks};
use self::expression::{Expression, Slip, UnitsBehind};
pub use self::origins::{InvalidShare, Origin, Share, length_in};
use num::exact::rational;
use num::real::RealNumber;
use num::surd::{Surd, generators};
use platform::geom::{FrameAxis, Pose};
use platform::manipulator::Body;

num::words! {
    /// The exactness of the coordinates of a joint.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Exactness as name, Display {
        /// All coordinates are fractions.
        Rational = "rational",
        /// All coordinates are sums of rational multiples of square roots of integers and of cosines.
        Field = "field",
        /// At least one coordinate is known only between two close bounds.
        Interval = "interval",
    }
}

impl Exactness {
    fn of(point: &RealPoint) -> Self {
        let one = |x: &RealNumber| match x.exact() {
            None => Self::Interval,
            Some(x) if x.as_rational().is_some() => Self::Rational,
            Some(_) => Self::Field,
        };
        point.iter().map(one).max().unwrap_or(Self::Rational)
    }
}

/// Coordinates of a joint, as exact as possible.
pub(crate) type RealPoint = [RealNumber; 3];

/// A number of a design file as written: a decimal or an expression.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrittenNumber {
    written: Spelling,
    tree: Expression,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Spelling {
    /// A number without quotes whose double prints with the same digits.
    Number(f64),
    /// A text.
    Text(String),
}

impl WrittenNumber {
    /// An expression.
    pub(super) fn text(text: &str) -> Result<Self, Slip> {
        Ok(Self { written: Spelling::Text(text.to_string()), tree: Expression::parse(text)? })
    }

    /// An expression that may have units of length, and whether it has.
    pub(super) fn with_units(text: &str, units: UnitsBehind) -> Result<(Self, bool), Slip> {
        let (tree, with_unit) = Expression::read(text, units)?;
        Ok((Self { written: Spelling::Text(text.to_string()), tree }, with_unit))
    }

    /// A number as it stands in a file, with the decimal as written.
    pub(super) fn decimal(digits: &str, double: f64) -> Result<Self, Slip> {
        let tree = Expression::parse(digits)?;
        Ok(match Expression::parse(&format!("{double:?}")) {
            Ok(short) if short.decimal() == tree.decimal() => {
                Self { written: Spelling::Number(double), tree: short }
            }
            // numbers with more digits than the double keeps stay text
            _ => Self { written: Spelling::Text(digits.to_string()), tree },
        })
    }

    /// The shortest decimal that reads back to a finite double.
    pub(crate) fn shortest(x: f64) -> Option<Self> {
        Some(Self { written: Spelling::Number(x), tree: Expression::parse(&format!("{x:?}")).ok()? })
    }

    pub(super) fn written(&self) -> &Spelling {
        &self.written
    }

    pub(super) fn expression(&self) -> &Expression {
        &self.tree
    }
}

/// A place on a line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LinePlace {
    /// As a share of the way from the first joint to the second.
    Share(WrittenNumber),
    /// As a length from the first joint, towards the second.
    Offset(WrittenNumber),
}

num::words! {
    /// A plane of two axes of the frame of the body.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(crate) enum CoordinatePlane as name {
        Xy = "xy",
        Xz = "xz",
        Yz = "yz",
    }
}

impl CoordinatePlane {
    /// The axis that changes its sign.
    fn normal(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Xz => 1,
            Self::Yz => 0,
        }
    }
}

/// The plane of a mirror, up to its place.
#[allow(clippy::large_enum_variant, reason = "a design has a dozen of them")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum MirrorPlane {
    Coordinate(CoordinatePlane),
    /// Perpendicular to this vector of any length.
    Normal([WrittenNumber; 3]),
}

/// The definition of a joint by other means than three numbers. Joints are named by their index in the same body.
#[allow(clippy::large_enum_variant, reason = "a design has a dozen of them")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Construction {
    /// `["1/3", "6*sqrt(3)", 0]`.
    Coordinates([WrittenNumber; 3]),
    /// `{ on = ["P1", "P2"], t = "1/5" }`, `{ on = ["P1", "P2"], offset = 2.4 }`.
    OnLine { through: [usize; 2], at: LinePlace },
    /// `{ radius = "r", angle_deg = 30, z = 0 }`: the angle from the x axis towards the y axis.
    Polar { radius: WrittenNumber, angle_deg: WrittenNumber, z: Option<WrittenNumber> },
    /// `{ turn = "A1", deg = 120 }`: about the z axis, or about a parallel to an axis through a point.
    Turned { joint: usize, deg: WrittenNumber, about: FrameAxis, through: Option<[WrittenNumber; 3]> },
    /// `{ mirror = "A1", plane = "xz" }`, `{ mirror = "A1", normal = [1, 2, 0], through = [10, 0, 0] }`.
    Mirrored { joint: usize, plane: MirrorPlane, through: Option<[WrittenNumber; 3]> },
}

impl Construction {
    /// The joints it starts from.
    pub(super) fn joints(&self) -> &[usize] {
        match self {
            Self::Coordinates(_) | Self::Polar { .. } => &[],
            Self::OnLine { through, .. } => through,
            Self::Turned { joint, .. } | Self::Mirrored { joint, .. } => std::slice::from_ref(joint),
        }
    }

    /// The numbers in it, each with its index among the written parts of the construction.
    pub(super) fn quantities(&self) -> Vec<(usize, &WrittenNumber)> {
        match self {
            Self::Coordinates(list) => list.iter().enumerate().collect(),
            Self::OnLine { at: LinePlace::Share(q) | LinePlace::Offset(q), .. } => vec![(2, q)],
            Self::Polar { radius, angle_deg, z } => {
                [(0, Some(radius)), (1, Some(angle_deg)), (2, z.as_ref())]
                    .into_iter()
                    .filter_map(|(i, q)| Some((i, q?)))
                    .collect()
            }
            Self::Turned { deg, through, .. } => {
                std::iter::once(deg).chain(through.iter().flatten()).zip(1..).map(|(q, i)| (i, q)).collect()
            }
            Self::Mirrored { plane, through, .. } => {
                let normal: &[WrittenNumber] =
                    if let MirrorPlane::Normal(normal) = plane { normal } else { &[] };
                normal.iter().chain(through.iter().flatten()).zip(1..).map(|(q, i)| (i, q)).collect()
            }
        }
    }
}

/// The home pose if an expression gives one of its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrittenHome {
    pub position: [WrittenNumber; 3],
    /// Roll, pitch and yaw in degrees; `None` if the rotation is given in another form, without expressions.
    pub rpy_deg: Option<[WrittenNumber; 3]>,
    /// The resulting pose.
    pub pose: Pose,
    /// The values of the numbers.
    pub values: Vec<RealNumber>,
}

impl WrittenHome {
    /// The numbers in it, with their parts.
    pub(super) fn quantities(&self) -> impl Iterator<Item = (usize, &WrittenNumber)> {
        self.position.iter().chain(self.rpy_deg.iter().flatten()).enumerate()
    }
}

/// The constructions of joints and home in a design, with the resulting exact coordinates. Plain numbers are not
/// constructions.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Constructions {
    /// Names and values of `[parameters]`, in the order of the file.
    pub(super) parameters: Vec<(String, WrittenNumber)>,
    /// For each body one entry per joint, or none at all: `None` for joints given by three numbers.
    pub(super) joints: [Vec<Option<Construction>>; 2],
    /// Exact coordinates of all joints of a body that has constructions.
    exact: [Vec<RealPoint>; 2],
    /// The home pose, if an expression gives one of its numbers.
    pub(super) home: Option<WrittenHome>,
    /// The cranks of a design, if it has any.
    pub(super) cranks: Option<WrittenCranks>,
}

impl Constructions {
    /// The construction of a joint that is not given by three numbers.
    pub(crate) fn of(&self, body: Body, joint: usize) -> Option<&Construction> {
        self.joints[body.index()].get(joint)?.as_ref()
    }

    /// Replaces the construction of a joint by its three numbers.
    pub(super) fn forget(&mut self, body: Body, joint: usize) {
        if let Some(own) = self.joints[body.index()].get_mut(joint) {
            *own = None;
        }
        self.tidy();
    }

    /// Drops lists without constructed joints.
    fn tidy(&mut self) {
        for list in self.joints.iter_mut().filter(|list| list.iter().all(Option::is_none)) {
            list.clear();
        }
    }

    /// Whether any joint has a construction.
    pub(super) fn any_joint(&self) -> bool {
        self.joints.iter().flatten().any(Option::is_some)
    }

    /// Whether all joints and home are given by plain numbers.
    pub(super) fn is_empty(&self) -> bool {
        self.parameters.is_empty() && !self.any_joint() && self.home.is_none() && self.cranks.is_none()
    }

    /// The exact coordinates; those of the doubles if the body has no constructions.
    pub(super) fn exact(&self, body: Body, joints: &[Point3<f64>]) -> Vec<RealPoint> {
        let exact = &self.exact[body.index()];
        if exact.len() == joints.len() { exact.clone() } else { joints.iter().map(exact_double).collect() }
    }
}

/// The rational numbers that the coordinates are.
pub(super) fn exact_double(p: &Point3<f64>) -> RealPoint {
    let one = |x: f64| {
        rational(x).and_then(|x| RealNumber::rational(&x).ok()).unwrap_or_else(|| RealNumber::integer(0))
    };
    [one(p.x), one(p.y), one(p.z)]
}

/// A joint of a design with its exact coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactJoint {
    /// The exactness of its coordinates: fractions, sums of square roots and cosines, or values between bounds.
    pub exactness: Exactness,
    /// The three coordinates in the frame of the body, as expressions such as `"6*sqrt(3)"`. A value known between
    /// bounds is `"[low, high]"`, rounded outward to doubles.
    pub coordinates: [String; 3],
}

impl ExactJoint {
    pub(super) fn of(point: &RealPoint) -> Self {
        let shown = |x: &RealNumber| match x {
            RealNumber::Exact(x) => x.to_string(),
            RealNumber::Within(e) => {
                let (low, high) = e.ends();
                let ends = (num::exact::nearest(low), num::exact::nearest(high));
                format!("[{:?}, {:?}]", ends.0.next_down(), ends.1.next_up())
            }
        };
        Self { exactness: Exactness::of(point), coordinates: point.each_ref().map(shown) }
    }
}

/// The exactness of all joints of a design together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DesignExactness {
    /// The least exact kind over its joints; `None` if every joint is given by three plain numbers, which are then
    /// exact doubles.
    pub exactness: Option<Exactness>,
    /// The integers whose square roots generate the field of all exact coordinates, together with the cosines of
    /// `divisions`.
    pub radicands: Vec<u64>,
    /// Numbers `n` whose cosines `cos(360 / n)` degrees generate the field, beside the square roots: some of 9, 16,
    /// 20 and 32.
    pub divisions: Vec<u32>,
    /// The joints that are known only between bounds, with their bodies: `"base.A2"`.
    pub enclosed: Vec<String>,
}

impl DesignExactness {
    /// `constructed`: whether any joint has a construction.
    pub(super) fn of(constructed: bool, bodies: [(Body, &[String], Vec<RealPoint>); 2]) -> Self {
        let (mut all, mut divisions) = (Vec::new(), Vec::new());
        let (mut exactness, mut enclosed) = (Exactness::Rational, Vec::new());
        for (body, names, points) in bodies {
            for (name, point) in names.iter().zip(&points) {
                let own = Exactness::of(point);
                exactness = exactness.max(own);
                if own == Exactness::Interval {
                    enclosed.push(format!("{body}.{name}"));
                }
                let exact = || point.iter().filter_map(RealNumber::exact);
                all.extend(exact().flat_map(Surd::radicands));
                divisions.extend(exact().flat_map(Surd::divisions));
            }
        }
        all.sort_unstable();
        all.dedup();
        divisions.sort_unstable();
        divisions.dedup();
        let radicands = generators(&all, &mut divisions);
        Self { exactness: constructed.then_some(exactness), radicands, divisions, enclosed }
    }
}

impl fmt::Display for DesignExactness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let field = || {
            let roots = self.radicands.iter().map(|r| format!("sqrt({r})"));
            let cosines = self.divisions.iter().map(|n| format!("cos_deg({})", 360.0 / f64::from(*n)));
            format!("numbers of Q({})", roots.chain(cosines).collect::<Vec<_>>().join(", "))
        };
        match self.exactness {
            None => f.write_str("doubles as written"),
            Some(Exactness::Rational) => f.write_str("exact fractions"),
            Some(Exactness::Field) => write!(f, "exact {}", field()),
            Some(Exactness::Interval) => {
                write!(f, "between close bounds ({}), the others exact", self.enclosed.join(", "))?;
                if self.radicands.is_empty() && self.divisions.is_empty() {
                    Ok(())
                } else {
                    write!(f, " {}", field())
                }
            }
        }
    }
}
