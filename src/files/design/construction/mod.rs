//! How a design says where a joint is: coordinates as expressions, points on lines, polar coordinates, copies turned
//! and mirrored.

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
use platform::geom::Pose;
use platform::manipulator::Body;

/// How well the coordinates of a joint are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exactness {
    /// They are fractions.
    Rational,
    /// They are sums of rational multiples of square roots of integers and of cosines.
    Field,
    /// At least one is known between two close bounds only.
    Interval,
}

impl Exactness {
    /// The name: `"rational"`, `"field"` or `"interval"`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rational => "rational",
            Self::Field => "field",
            Self::Interval => "interval",
        }
    }

    fn of(point: &RealPoint) -> Self {
        let one = |x: &RealNumber| match x.exact() {
            None => Self::Interval,
            Some(x) if x.as_rational().is_some() => Self::Rational,
            Some(_) => Self::Field,
        };
        point.iter().map(one).max().unwrap_or(Self::Rational)
    }
}

impl fmt::Display for Exactness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Coordinates of a joint, as exact as they are known.
pub(crate) type RealPoint = [RealNumber; 3];

/// A number of a design file: a decimal or an expression, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrittenNumber {
    written: Spelling,
    tree: Expression,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Spelling {
    /// A number without quotes, of which the double is written with the same digits.
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

    /// A number as it stands in a file, which is the decimal that is written.
    pub(super) fn decimal(digits: &str, double: f64) -> Result<Self, Slip> {
        let tree = Expression::parse(digits)?;
        Ok(match Expression::parse(&format!("{double:?}")) {
            Ok(short) if short.decimal() == tree.decimal() => {
                Self { written: Spelling::Number(double), tree: short }
            }
            // more digits than the double keeps are kept as a text
            _ => Self { written: Spelling::Text(digits.to_string()), tree },
        })
    }

    /// The decimal with the fewest digits that is read to a finite double.
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

/// Where on a line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LinePlace {
    /// As a share of the way from the first joint to the second.
    Share(WrittenNumber),
    /// As a length from the first joint, towards the second.
    Offset(WrittenNumber),
}

/// A plane of two axes of the frame of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CoordinatePlane {
    Xy,
    Xz,
    Yz,
}

impl CoordinatePlane {
    pub(super) const ALL: [Self; 3] = [Self::Xy, Self::Xz, Self::Yz];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Xy => "xy",
            Self::Xz => "xz",
            Self::Yz => "yz",
        }
    }

    /// The axis that changes its sign.
    fn normal(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Xz => 1,
            Self::Yz => 0,
        }
    }
}

/// How a joint is given, in other ways than by three numbers. Joints are named by their index in the same body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Construction {
    /// `["1/3", "6*sqrt(3)", 0]`.
    Coordinates([WrittenNumber; 3]),
    /// `{ on = ["P1", "P2"], t = "1/5" }`, `{ on = ["P1", "P2"], offset = 2.4 }`.
    OnLine { through: [usize; 2], at: LinePlace },
    /// `{ radius = "r", angle_deg = 30, z = 0 }`: the angle from the x axis towards the y axis.
    Polar { radius: WrittenNumber, angle_deg: WrittenNumber, z: Option<WrittenNumber> },
    /// `{ turn = "A1", deg = 120 }`: about the z axis.
    Turned { joint: usize, deg: WrittenNumber },
    /// `{ mirror = "A1", plane = "xz" }`.
    Mirrored { joint: usize, plane: CoordinatePlane },
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

    /// The numbers in it, with their parts: the place among what is written.
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
            Self::Turned { deg, .. } => vec![(1, deg)],
            Self::Mirrored { .. } => Vec::new(),
        }
    }
}

/// The home pose where an expression gives a number of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrittenHome {
    pub position: [WrittenNumber; 3],
    /// Roll, pitch and yaw in degrees; `None` where the rotation is given in another way, without expressions.
    pub rpy_deg: Option<[WrittenNumber; 3]>,
    /// The pose that follows.
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

/// What a design says about its joints beside three numbers each, with the exact coordinates that follow; and about its
/// home pose beside plain numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Constructions {
    /// Names and values of `[parameters]`, in the order of the file.
    pub(super) parameters: Vec<(String, WrittenNumber)>,
    /// For each body one entry a joint, or none at all: `None` for joints given by three numbers.
    pub(super) joints: [Vec<Option<Construction>>; 2],
    /// Exact coordinates of all joints of a body that has constructions.
    exact: [Vec<RealPoint>; 2],
    /// The home pose, where an expression gives a number of it.
    pub(super) home: Option<WrittenHome>,
    /// The cranks of a design that has some.
    pub(super) cranks: Option<WrittenCranks>,
}

impl Constructions {
    /// How a joint is given, when not by three numbers.
    pub(crate) fn of(&self, body: Body, joint: usize) -> Option<&Construction> {
        self.joints[body.index()].get(joint)?.as_ref()
    }

    /// The joint is given by three numbers from now on.
    pub(super) fn forget(&mut self, body: Body, joint: usize) {
        if let Some(own) = self.joints[body.index()].get_mut(joint) {
            *own = None;
        }
        self.tidy();
    }

    /// No list where no joint is constructed.
    fn tidy(&mut self) {
        for list in self.joints.iter_mut().filter(|list| list.iter().all(Option::is_none)) {
            list.clear();
        }
    }

    /// Whether a joint is given by other than three numbers.
    pub(super) fn any_joint(&self) -> bool {
        self.joints.iter().flatten().any(Option::is_some)
    }

    /// Whether nothing is said beside three numbers a joint, and plain numbers of home.
    pub(super) fn is_empty(&self) -> bool {
        self.parameters.is_empty() && !self.any_joint() && self.home.is_none() && self.cranks.is_none()
    }

    /// The exact coordinates, those of the doubles where the body has no constructions.
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

/// A joint of a design as exactly as it is known.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactJoint {
    /// Whether its coordinates are fractions, sums of square roots and cosines, or known between bounds.
    pub exactness: Exactness,
    /// The three coordinates in the frame of the body, as expressions such as `"6*sqrt(3)"`; one that is known between
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

/// How exactly the joints of a design are known, all together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DesignExactness {
    /// The least exact of its joints; `None` where every joint is given by three plain numbers and so is the three
    /// doubles that are read.
    pub exactness: Option<Exactness>,
    /// The integers whose square roots generate the field of all exact coordinates, with the fractions and the
    /// cosines of `divisions`.
    pub radicands: Vec<u64>,
    /// Numbers `n` whose cosines `cos(360 / n)` degrees generate the field, beside the square roots: some of 9, 16,
    /// 20 and 32.
    pub divisions: Vec<u32>,
    /// The joints that are known between bounds only, with their bodies: `"base.A2"`.
    pub enclosed: Vec<String>,
}

impl DesignExactness {
    /// `constructed`: whether any joint is given by other than three plain numbers.
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
