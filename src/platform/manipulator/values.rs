//! Exact coordinates of joints whose doubles are only approximate.

use std::sync::{Arc, OnceLock};

use nalgebra::Point3;

use super::{Body, InvalidManipulator, Leg, Level, Manipulator};
use num::elimination::{Rows, SurdArithmetic, eliminate};
use num::interval::Interval;
use num::surd::Surd;

/// The coordinates of a joint as numbers of one field of square roots.
pub type SurdPoint = [Surd; 3];

/// A leg by the exact coordinates of its ends, on the base and on the platform.
pub type ExactEnds = [SurdPoint; 2];

/// `(1, a) (x) (1, b)`; `None` if it becomes too long.
pub fn vector_of_ends(leg: &ExactEnds) -> Option<Vec<Surd>> {
    let [a, b] = leg.each_ref().map(|p| [Surd::integer(1), p[0].clone(), p[1].clone(), p[2].clone()]);
    a.iter().flat_map(|x| b.iter().map(move |y| x.times(y))).collect()
}

/// `|a|^2 + |b|^2`; `None` if it becomes too long.
pub fn squares_of_ends(leg: &ExactEnds) -> Option<Surd> {
    leg.iter().flatten().try_fold(Surd::zero(), |sum, x| sum.plus(&x.times(x)?))
}

/// Dimension of the flat of the ends on a body: 0 a point, 1 a line, 2 a plane, 3 space; `None` if numbers become too
/// long.
pub fn dimension_of_ends(ends: &[ExactEnds; 6], body: Body) -> Option<usize> {
    let [first, others @ ..] = ends.each_ref().map(|end| &end[body.index()]);
    let difference = |end: &SurdPoint| end.iter().zip(first).map(|(x, y)| x.minus(y)).collect();
    let mut rows = others.into_iter().map(difference).collect::<Option<Rows<SurdArithmetic>>>()?;
    Some(eliminate(&SurdArithmetic, &mut rows)?.len())
}

/// The joints behind the doubles of a [`Manipulator`].
#[derive(Debug, Clone)]
pub struct JointValues {
    /// For base and platform the coordinates of every joint; `None` if one of them is known only between bounds.
    pub exact: Option<[Vec<SurdPoint>; 2]>,
    /// For base and platform the greatest distance of a joint's coordinate from its double.
    pub radius: [Vec<f64>; 2],
    /// The remainders beside the doubles, computed on demand.
    left: OnceLock<[Vec<LeftOver>; 2]>,
}

/// The remainders of a joint's coordinates beside their doubles, as the nearest doubles again (zeros if unknown). The
/// second value is the greatest distance of a coordinate from both doubles together.
type LeftOver = ([f64; 3], f64);

impl PartialEq for JointValues {
    fn eq(&self, other: &Self) -> bool {
        // the rest follows from these
        self.exact == other.exact && self.radius == other.radius
    }
}

impl JointValues {
    /// Joints, with the distances of the doubles from them.
    pub fn new(exact: Option<[Vec<SurdPoint>; 2]>, radius: [Vec<f64>; 2]) -> Self {
        Self { exact, radius, left: OnceLock::new() }
    }

    /// The remainders beside `doubles`, the nearest doubles or the centres of the joints.
    fn left(&self, doubles: [&[Point3<f64>]; 2]) -> &[Vec<LeftOver>; 2] {
        self.left.get_or_init(|| {
            [0, 1].map(|body| {
                let of = |joint: usize| {
                    let point = &self.exact.as_ref()?[body][joint];
                    let both = point.iter().zip(doubles[body][joint].iter());
                    let parts: Vec<(f64, f64)> = both.map(|(x, d)| low_part(x, *d)).collect::<Option<_>>()?;
                    let rest = parts.iter().map(|part| part.1).fold(0.0, f64::max);
                    Some((std::array::from_fn(|k| parts[k].0), rest))
                };
                let radius = &self.radius[body];
                (0..radius.len()).map(|joint| of(joint).unwrap_or(([0.0; 3], radius[joint]))).collect()
            })
        })
    }
}

/// The remainder of a number beside a double, as a double, and an upper bound of the rest beside both.
fn low_part(x: &Surd, double: f64) -> Option<(f64, f64)> {
    let left = x.minus(&Surd::rational(&num::exact::rational(double)?)?)?;
    let low = left.nearest();
    Some((low, left.distance_from(low)))
}

/// Doubles with at least this number of significant digits look like rounded numbers.
const ROUNDED: usize = 15;

/// Significant digits of the shortest decimal that is read as this double.
fn significant_digits(x: f64) -> usize {
    let text = format!("{x:e}");
    let digits = text.split('e').next().unwrap_or_default();
    digits.bytes().filter(u8::is_ascii_digit).count()
}

/// The kind of knowledge about the joints of a [`Manipulator`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKnowledge {
    /// They are the doubles as written.
    Doubles,
    /// They are numbers of a field of square roots, near the doubles.
    Exact,
    /// They are within bounds near the doubles.
    Enclosed,
}

impl Manipulator {
    /// Six legs between exact ends; equal ends of a body are one joint, with the nearest doubles as coordinates.
    ///
    /// # Errors
    /// The errors of [`Manipulator::try_new`].
    pub fn from_exact_ends(ends: &[ExactEnds; 6]) -> Result<Self, InvalidManipulator> {
        let (mut exact, mut radius) = ([Vec::<SurdPoint>::new(), Vec::new()], [Vec::new(), Vec::new()]);
        let mut points = [Vec::new(), Vec::new()];
        let mut joint = |body: Body, end: &SurdPoint| {
            let k = body.index();
            exact[k].iter().position(|p| p == end).unwrap_or_else(|| {
                let double = end.each_ref().map(Surd::nearest);
                let distance = end.iter().zip(double).map(|(x, d)| x.distance_from(d));
                radius[k].push(distance.fold(0.0, f64::max));
                points[k].push(Point3::from(double));
                exact[k].push(end.clone());
                exact[k].len() - 1
            })
        };
        let pairs = ends.each_ref().map(|[a, b]| (joint(Body::Base, a), joint(Body::Platform, b)));
        let values = JointValues::new(Some(exact), radius);
        let [base, platform] = points;
        Ok(Self::try_new(base, platform, pairs)?.with_values(values))
    }

    /// The same doubles with their exact values.
    ///
    /// `values` are those of the joints of this manipulator, in their order.
    ///
    /// # Panics
    /// `values` has another number of joints.
    pub fn with_values(mut self, values: JointValues) -> Self {
        let counts = [self.base_joints().len(), self.platform_joints().len()];
        assert_eq!(values.radius.each_ref().map(Vec::len), counts);
        let plain = values.radius.iter().flatten().all(|r| *r <= 0.0);
        // a joint of plain numbers next to constructions may be rounded, for instance a computed one
        let points = [self.base_joints(), self.platform_joints()];
        let rounded = points.iter().zip(&values.radius).any(|(list, radius)| {
            list.iter()
                .zip(radius)
                .any(|(p, r)| *r <= 0.0 && p.iter().any(|x| significant_digits(*x) >= ROUNDED))
        });
        self.constructed = !rounded;
        self.values = (!plain).then(|| Arc::new(values));
        self
    }

    /// The manipulator with base and platform exchanged, with all exact joints.
    pub fn exchanged(&self) -> Self {
        let pairs = self.pairs().map(|(a, b)| (b, a));
        let mut out = Self::try_new(self.platform_joints().to_vec(), self.base_joints().to_vec(), pairs)
            .unwrap_or_else(|_| unreachable!("the joints and pairs of a design, the other way round"));
        out.constructed = self.constructed;
        out.values = self.values.as_ref().map(|values| {
            let [base, platform] = values.radius.clone();
            let exact = values.exact.clone().map(|[base, platform]| [platform, base]);
            Arc::new(JointValues::new(exact, [platform, base]))
        });
        out
    }

    /// The same doubles, taken as exact joints.
    pub fn without_values(&self) -> Self {
        let mut doubles = self.clone();
        (doubles.values, doubles.constructed) = (None, false);
        doubles
    }

    /// The same legs with coincident ends merged into one joint. Ends are compared by doubles if these are the joints,
    /// or by their exact coordinates if known; joints known only between bounds are not merged.
    pub fn with_merged_joints(&self) -> Self {
        let first = |body: Body, joint: usize| {
            let doubles = self.joints(body);
            let same = |other: &usize| match &self.values {
                None => doubles[*other] == doubles[joint],
                Some(values) => values.exact.as_ref().is_some_and(|exact| {
                    let points = &exact[body.index()];
                    points[*other] == points[joint]
                }),
            };
            (0..joint).find(same).unwrap_or(joint)
        };
        let pairs = self.pairs().map(|(a, b)| (first(Body::Base, a), first(Body::Platform, b)));
        let mut merged = self.clone();
        merged.legs = pairs;
        merged
    }

    /// The kind of knowledge about the joints.
    pub fn joint_knowledge(&self) -> JointKnowledge {
        match &self.values {
            None => JointKnowledge::Doubles,
            Some(values) if values.exact.is_some() => JointKnowledge::Exact,
            Some(_) => JointKnowledge::Enclosed,
        }
    }

    /// The level of a proof about these joints.
    pub fn level(&self) -> Level {
        if self.constructed { Level::ExactJoints } else { Level::DoublesAsWritten }
    }

    /// Greatest distance of the coordinates of the ends of leg `i` on `body` from their doubles.
    pub fn end_radius(&self, leg: usize, body: Body) -> f64 {
        let joint = body.of(self.pairs()[leg]);
        self.values.as_ref().map_or(0.0, |v| v.radius[body.index()][joint])
    }

    /// Remainders of the coordinates of the end of leg `i` on `body` beside their doubles. The second value is the
    /// greatest distance of a coordinate from both together.
    pub fn end_low(&self, leg: usize, body: Body) -> ([f64; 3], f64) {
        let joint = body.of(self.pairs()[leg]);
        let doubles = [self.base_joints(), self.platform_joints()];
        self.values.as_ref().map_or(([0.0; 3], 0.0), |v| v.left(doubles)[body.index()][joint])
    }

    /// The ends of leg `i` on base and platform, by coordinate: the doubles if these are the joints, otherwise
    /// intervals that contain the joints.
    pub fn enclosed_ends(&self, leg: usize) -> [[Interval; 3]; 2] {
        Body::BOTH.map(|body| {
            let (end, radius) = (self.joints(body)[body.of(self.pairs()[leg])], self.end_radius(leg, body));
            [end.x, end.y, end.z].map(|x| {
                if radius <= 0.0 {
                    return Interval::from(x);
                }
                Interval::new((x - radius).next_down(), (x + radius).next_up()).unwrap_or(Interval::WHOLE)
            })
        })
    }

    /// The ends of the legs as exact numbers; `None` if one of them is known only between bounds.
    pub fn exact_ends(&self) -> Option<[ExactEnds; 6]> {
        let ends: Vec<ExactEnds> = match &self.values {
            None => self.legs().iter().map(exact_doubles).collect::<Option<_>>()?,
            Some(values) => {
                let [base, platform] = values.exact.as_ref()?;
                self.pairs().iter().map(|(a, b)| [base[*a].clone(), platform[*b].clone()]).collect()
            }
        };
        ends.try_into().ok()
    }
}

impl Manipulator {
    /// The same doubles, with joints known only to be within a radius of them.
    pub fn enclosed_within(self, radius: f64) -> Self {
        let radius = [self.base_joints(), self.platform_joints()].map(|joints| vec![radius; joints.len()]);
        self.with_values(JointValues::new(None, radius))
    }
}

/// The doubles of a leg as rational numbers.
fn exact_doubles(leg: &Leg) -> Option<ExactEnds> {
    let one = |x: f64| num::exact::rational(x).and_then(|x| Surd::rational(&x));
    let point = |p: &Point3<f64>| Some([one(p.x)?, one(p.y)?, one(p.z)?]);
    Some([point(&leg.base)?, point(&leg.platform)?])
}
